/** Numbers in bytes of text, at the speed of a file of a hundred megabytes. */

/** Powers of ten that doubles hold exactly. */
const POWERS = Float64Array.from({ length: 23 }, (_, power) => Number(`1e${power}`));

/** Digits that a whole number may have to be exact for certain. */
const EXACT = 15;

const [ZERO, NINE, DOT, PLUS, MINUS, SMALL_E, LARGE_E] = [...'09.+-eE'].map((each) => each.charCodeAt(0));

/** Words for what is no finite number. */
const NOT_FINITE = /^(?:[+-]?(?:nan|inf(?:inity)?)|null|none|na|n\/a)?$/i;

const latin1 = new TextDecoder('latin1');

/** @param {Uint8Array} bytes @param {number} from @param {number} to */
export const textOf = (bytes, from, to) => latin1.decode(bytes.subarray(from, to));

/** What stands between two places: where its digits are. One for all, as there are millions of numbers. */
const found = { negative: false, whole: 0, dot: 0, end: 0, power: 0, isPlain: false };

/**
 * Finds the parts of a decimal number.
 *
 * @param {Uint8Array} bytes
 * @param {number} from
 * @param {number} to
 * @returns {boolean} whether it is one
 */
function scan(bytes, from, to) {
  let at = from;
  found.negative = bytes[at] === MINUS;
  if (found.negative || bytes[at] === PLUS) at += 1;
  found.whole = at;
  while (at < to && bytes[at] >= ZERO && bytes[at] <= NINE) at += 1;
  found.dot = at;
  let digits = at - found.whole;
  if (at < to && bytes[at] === DOT) {
    at += 1;
    const start = at;
    while (at < to && bytes[at] >= ZERO && bytes[at] <= NINE) at += 1;
    digits += at - start;
  }
  found.end = at;
  found.isPlain = at === to;
  if (digits === 0 || found.isPlain) return digits > 0;
  if (bytes[at] !== SMALL_E && bytes[at] !== LARGE_E) return false;
  at += 1;
  if (bytes[at] === PLUS || bytes[at] === MINUS) at += 1;
  const start = at;
  while (at < to && bytes[at] >= ZERO && bytes[at] <= NINE) at += 1;
  return at > start && at === to;
}

/**
 * @param {Uint8Array} bytes
 * @param {number} from
 * @param {number} to
 * @returns {number} the nearest double; NaN where it says so or is empty; undefined where it is something else
 */
export function numberIn(bytes, from, to) {
  if (!scan(bytes, from, to)) return notANumber(bytes, from, to);
  const { whole, dot, end, negative } = found;
  if (!found.isPlain || end - whole > EXACT + 1) return Number(textOf(bytes, from, to));
  let value = 0;
  for (let at = whole; at < dot; at++) value = 10 * value + bytes[at] - ZERO;
  for (let at = dot + 1; at < end; at++) value = 10 * value + bytes[at] - ZERO;
  // A quotient of two exact numbers is rounded once, as the decimal is.
  if (end > dot) value /= POWERS[end - dot - 1];
  return negative ? -value : value;
}

/**
 * @param {Uint8Array} bytes
 * @param {number} from
 * @param {number} to
 * @returns {number} undefined where it is not meant to be one: types say a number for the sake of the usual case
 */
function notANumber(bytes, from, to) {
  return to - from < 12 && NOT_FINITE.test(textOf(bytes, from, to)) ? NaN : /** @type {any} */ (undefined);
}

/** A time as its whole seconds and the rest, so that nanoseconds of a century keep their digits. */
export const time = { seconds: 0, rest: 0 };

/**
 * Reads a time into `time`.
 *
 * @param {Uint8Array} bytes
 * @param {number} from
 * @param {number} to
 * @param {number} power of ten that a second has of the unit: 9 where it is nanoseconds
 * @returns {boolean} whether it is a number, or NaN, which is told in both
 */
export function timeIn(bytes, from, to, power) {
  if (!scan(bytes, from, to)) {
    time.seconds = time.rest = notANumber(bytes, from, to);
    return time.seconds !== undefined;
  }
  const { whole, dot, end, negative } = found;
  const border = dot - power;
  if (!found.isPlain || border - whole > EXACT) {
    const value = Number(textOf(bytes, from, to)) / POWERS[power];
    const floor = Math.floor(value);
    // Beyond this, doubles know no seconds.
    [time.seconds, time.rest] = Math.abs(value) < 1e15 ? [floor, value - floor] : [NaN, NaN];
    return true;
  }
  let seconds = 0;
  for (let at = whole; at < border; at++) seconds = 10 * seconds + bytes[at] - ZERO;
  let [rest, digits] = [0, Math.max(whole - border, 0)];
  for (let at = Math.max(whole, border); at < end && digits < EXACT; at++) {
    if (at === dot) continue;
    rest = 10 * rest + bytes[at] - ZERO;
    digits += 1;
  }
  rest /= POWERS[digits];
  [time.seconds, time.rest] = negative ? [-seconds, -rest] : [seconds, rest];
  return true;
}
