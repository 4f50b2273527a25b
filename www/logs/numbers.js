/** Numbers and times in text. */

/** Words that stand for a missing or infinite number. */
const NOT_FINITE = /^(?:[+-]?(?:nan|inf(?:inity)?)|null|none|na|n\/a)?$/i;

const DECIMAL = /^([+-]?)(\d+)(?:\.(\d*))?$/;

/**
 * Parses a decimal number.
 *
 * @param {string} cell
 * @returns {number | undefined} NaN for an empty cell or a word for no number; undefined for any other text
 */
export function numberOf(cell) {
  const value = Number(cell);
  // Number also takes empty cells and hexadecimal digits, both as whole numbers, which parseFloat does not.
  if (value === value && (value % 1 !== 0 || value === parseFloat(cell))) return value;
  return NOT_FINITE.test(cell.trim()) ? NaN : undefined;
}

/**
 * Parses a time into whole seconds and the rest, so that nanoseconds since 1970 keep their digits.
 *
 * @param {string} cell
 * @param {number} power of ten that a second has of the unit: 9 for nanoseconds
 * @returns {[seconds: number, rest: number] | undefined} NaN or undefined as of `numberOf`
 */
export function timeOf(cell, power) {
  const decimal = DECIMAL.exec(cell.trim());
  if (!decimal) {
    const number = numberOf(cell);
    if (number === undefined) return undefined;
    const time = number / 10 ** power;
    return [Math.floor(time), time - Math.floor(time)];
  }
  const [, sign, whole, fraction = ''] = decimal;
  const point = Math.max(0, whole.length - power);
  const seconds = Number(whole.slice(0, point));
  const rest = Number(`.${whole.slice(point).padStart(power, '0')}${fraction}0`);
  return sign === '-' ? [-seconds, -rest] : [seconds, rest];
}
