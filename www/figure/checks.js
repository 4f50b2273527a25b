/** Refusals in the words of the core, of what the page gives to the element itself. */

/**
 * @param {string} field
 * @param {unknown} value
 * @param {string} allowed
 * @returns {TypeError | RangeError} a TypeError where the kind of value is wrong
 */
export function refusal(field, value, allowed, Kind = RangeError) {
  return new Kind(`${field} is ${described(value)}; allowed is ${allowed}`);
}

/**
 * The error of a refused change, in the name by which it was asked for.
 *
 * @param {unknown} error
 * @param {string} name
 * @param {string} [path] what it is called where it was refused, if not so
 */
export function renamed(error, name, path = name) {
  if (error instanceof Error && error.message.startsWith(path)) {
    error.message = name + error.message.slice(path.length);
  }
  return error;
}

/** @param {unknown} value */
function described(value) {
  if (typeof value === 'string') return JSON.stringify(beginning(value));
  if (typeof value === 'object' && value !== null) return Array.isArray(value) ? 'an array' : 'an object';
  return ['function', 'symbol', 'bigint'].includes(typeof value) ? `a ${typeof value}` : String(value);
}

/** The first characters of a text, whole ones: enough to recognize it. @param {string} text */
function beginning(text) {
  const first = String(/.{0,40}/su.exec(text));
  return first === text ? text : `${first}…`;
}

/**
 * @param {string} field
 * @param {unknown} value
 * @param {readonly string[]} keys that it may have
 * @param {(value: Record<string, unknown>) => void} [heed] what matters more than its keys
 */
export function object(field, value, keys, heed) {
  if (typeof value !== 'object' || value === null || Array.isArray(value)) {
    throw refusal(field, value, `an object with keys from ${keys.join(', ')}`, TypeError);
  }
  heed?.(/** @type {Record<string, unknown>} */ (value));
  const stranger = Object.keys(value).find((key) => !keys.includes(key));
  if (stranger !== undefined) {
    throw new TypeError(`${field}.${beginning(stranger)} is an unknown key; allowed are ${keys.join(', ')}`);
  }
  return /** @type {Record<string, unknown>} */ (value);
}

/**
 * @template {string} Word
 * @param {string} field
 * @param {unknown} value
 * @param {readonly Word[]} allowed
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
 */
export function wholeNumber(field, value, least, most) {
  const allowed = `a whole number from ${least} to ${most}`;
  if (typeof value !== 'number') throw refusal(field, value, allowed, TypeError);
  if (!Number.isInteger(value) || value < least || value > most) throw refusal(field, value, allowed);
  return value;
}

/**
 * @param {string} field
 * @param {unknown} value
 * @param {number} least
 * @param {number} most
 */
export function numberWithin(field, value, least, most) {
  const allowed = `${least} to ${most}`;
  if (typeof value !== 'number') throw refusal(field, value, allowed, TypeError);
  if (!(value >= least && value <= most)) throw refusal(field, value, allowed);
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
 * Tells whether a value has every part of another one; parts that the other one lacks do not count.
 *
 * @param {any} present
 * @param {any} given
 * @returns {boolean}
 */
export function has(present, given) {
  if (Object.is(present, given)) return true;
  if (typeof present !== 'object' || typeof given !== 'object' || !present || !given || present.length !== given.length) return false;
  return Object.keys(given).every((key) => Object.hasOwn(present, key) && has(present[key], given[key]));
}
