/** Bytes and plain data as text. */

import { refusal } from './checks.js';

/**
 * Bytes of a state at most when it is unpacked: a link is anybody's, and a short text may say "a billion
 * times a". The largest grid has 11.2 million.
 */
const MAX_BYTES = 12_000_000;

/**
 * @param {object} data
 * @returns {Promise<string>} letters, digits, - and _
 */
export async function pack(data) {
  const text = new Blob([JSON.stringify(data)]).stream().pipeThrough(new CompressionStream('deflate-raw'));
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
    const parts = [];
    let size = 0;
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate-raw'));
    for (const reader = stream.getReader(); ; ) {
      const { done, value } = await reader.read();
      if (done) break;
      size += value.length;
      if (size > MAX_BYTES) throw new RangeError();
      parts.push(value);
    }
    return JSON.parse(await new Blob(parts).text());
  } catch {
    throw refusal('state in the address', text, 'what shareLink gives');
  }
}

/** As many arguments as any engine takes. */
const ARGUMENTS = 4096;

/** @param {Uint8Array & { toBase64?: () => string }} bytes */
export function toBase64(bytes) {
  // In a hundredth of the time, where the browser has it.
  if (bytes.toBase64) return bytes.toBase64();
  let text = '';
  for (let at = 0; at < bytes.length; at += ARGUMENTS) text += String.fromCharCode(...bytes.subarray(at, at + ARGUMENTS));
  return btoa(text);
}

/**
 * @param {string} text
 * @throws {DOMException | SyntaxError} if it is not base64
 */
export function fromBase64(text) {
  const { fromBase64: native } = /** @type {{ fromBase64?: (text: string) => Uint8Array<ArrayBuffer> }} */ (Uint8Array);
  if (native) return native.call(Uint8Array, text);
  return Uint8Array.from(atob(text), (character) => character.charCodeAt(0));
}
