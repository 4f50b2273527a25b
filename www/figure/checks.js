/**
 * A widget's state as plain data: checks, and the text that a link carries.
 *
 * @module
 */

/** Version of the states that `getState` gives; `setState` refuses any other. */
export const VERSION = 1;

/**
 * Bytes of a state at most when it is unpacked: a link is anybody's, and a short text may say "a billion
 * times a". The outlines of the largest maps that are of use take a tenth of it.
 */
const MOST_BYTES = 4_000_000;

/**
 * @param {string} field
 * @param {unknown} value
 * @param {string} allowed
 * @returns {TypeError | RangeError} in the words of the core; a TypeError where the kind of value is wrong
 */
export function refusal(field, value, allowed, Kind = RangeError) {
  return new Kind(`${field} is ${described(value)}; allowed is ${allowed}`);
}

/** @param {unknown} value */
function described(value) {
  if (typeof value === 'string') return JSON.stringify(value.length > 40 ? `${value.slice(0, 40)}…` : value);
  if (Array.isArray(value)) return 'an array';
  if (typeof value === 'object' && value !== null) return 'an object';
  return typeof value === 'function' ? 'a function' : String(value);
}

/**
 * @param {string} field
 * @param {unknown} value
 * @param {readonly string[]} keys that it may have
 * @returns {Record<string, unknown>}
 */
export function object(field, value, keys) {
  if (typeof value !== 'object' || value === null || Array.isArray(value)) {
    throw refusal(field, value, `an object with keys from ${keys.join(', ')}`, TypeError);
  }
  const stranger = Object.keys(value).find((key) => !keys.includes(key));
  if (stranger !== undefined) {
    throw new TypeError(`${field}.${stranger} is an unknown key; allowed are ${keys.join(', ')}`);
  }
  return /** @type {Record<string, unknown>} */ (value);
}

/**
 * @template {string} Word
 * @param {string} field
 * @param {unknown} value
 * @param {readonly Word[]} allowed
 * @returns {Word}
 */
export function word(field, value, allowed) {
  const found = allowed.find((each) => each === value);
  if (found !== undefined) return found;
  const Kind = typeof value === 'string' ? RangeError : TypeError;
  throw refusal(field, value, allowed.map((each) => JSON.stringify(each)).join(' or '), Kind);
}

/**
 * @param {string} field
 * @param {unknown} value
 * @returns {boolean}
 */
export function truth(field, value) {
  if (typeof value === 'boolean') return value;
  throw refusal(field, value, 'true or false', TypeError);
}

/**
 * @param {string} field
 * @param {unknown} value
 * @param {number} least
 * @param {number} most
 * @returns {number}
 */
export function whole(field, value, least, most) {
  const allowed = `a whole number from ${least} to ${most}`;
  if (typeof value !== 'number') throw refusal(field, value, allowed, TypeError);
  if (!Number.isInteger(value) || value < least || value > most) throw refusal(field, value, allowed);
  return value;
}

/**
 * @param {string} field
 * @param {unknown} value
 * @param {readonly string[]} allowed
 * @returns {string[]} those of them that it names, in their own order
 */
export function subset(field, value, allowed) {
  if (!Array.isArray(value)) throw refusal(field, value, `an array of ${allowed.join(', ')}`, TypeError);
  const names = value.map((name, i) => word(`${field}[${i}]`, name, allowed));
  return allowed.filter((name) => names.includes(name));
}

/**
 * @param {object} state
 * @returns {Promise<string>} letters, digits, - and _
 */
export async function pack(state) {
  const text = new Blob([JSON.stringify(state)]).stream().pipeThrough(new CompressionStream('deflate-raw'));
  const bytes = new Uint8Array(await new Response(text).arrayBuffer());
  return toBase64(bytes).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '');
}

/**
 * @param {string} text
 * @returns {Promise<unknown>} what was packed
 * @throws {RangeError} if it is no such text
 */
export async function unpack(text) {
  try {
    const bytes = fromBase64(text.replaceAll('-', '+').replaceAll('_', '/'));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate-raw'));
    const reader = stream.getReader();
    /** @type {BlobPart[]} */
    const parts = [];
    for (let size = 0; ; ) {
      const { done, value } = await reader.read();
      if (done) break;
      size += value.byteLength;
      if (size > MOST_BYTES) throw new RangeError('too long');
      parts.push(value);
    }
    return JSON.parse(await new Blob(parts).text());
  } catch {
    throw refusal('state in the address', text, 'what shareLink gives');
  }
}

/** @param {Uint8Array} bytes */
export function toBase64(bytes) {
  let text = '';
  for (const byte of bytes) text += String.fromCharCode(byte);
  return btoa(text);
}

/**
 * @param {string} text
 * @returns {Uint8Array<ArrayBuffer>}
 * @throws {DOMException} if it is not base64
 */
export function fromBase64(text) {
  return Uint8Array.from(atob(text), (character) => character.charCodeAt(0));
}
