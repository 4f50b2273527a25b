/**
 * Numbers as they are printed: a true minus sign, thin spaces between thousands, and a dash where
 * there is no number.
 *
 * @module
 */

const MINUS = '\u2212';
const THIN_SPACE = '\u202f';
export const NOTHING = '\u2014';

/**
 * @param {number} value
 * @param {number} decimals
 * @returns {string} "−0.301"; "0.000" rather than "−0.000"; "—" for NaN
 */
export function fixed(value, decimals) {
  if (Number.isNaN(value)) return NOTHING;
  const digits = Math.abs(value).toFixed(decimals);
  return value < 0 && Number(digits) !== 0 ? MINUS + digits : digits;
}

/** Below this a number is taken for a 0 that rounding has passed over. */
const NOTHING_BELOW = 1e-13;

const SUPERSCRIPTS = '⁰¹²³⁴⁵⁶⁷⁸⁹';

/**
 * @param {number} value
 * @param {number} digits significant ones
 * @returns {string} "0.0070020"; from 0.0001 downwards "1.2500·10⁻⁵"
 */
export function significant(value, digits) {
  if (Number.isNaN(value)) return NOTHING;
  const size = Math.abs(value);
  if (size < NOTHING_BELOW) return '0';
  const sign = value < 0 ? MINUS : '';
  if (size >= 1e-4 && size < 1e5) return sign + size.toPrecision(digits);
  const [mantissa, exponent] = size.toExponential(digits - 1).split('e');
  const power = exponent.replace(/[-+]/, '').replace(/\d/g, (digit) => SUPERSCRIPTS[Number(digit)]);
  return `${sign}${mantissa}·10${exponent.startsWith('-') ? '⁻' : ''}${power}`;
}

/**
 * @param {number} value above 0
 * @param {number} digits significant ones
 * @returns {string} "0.47", "12", "1 200"
 */
export function rounded(value, digits) {
  const near = Number(value.toPrecision(digits));
  const decimals = digits - 1 - Math.floor(Math.log10(near));
  return decimals > 0 ? fixed(near, decimals) : whole(near);
}

/**
 * @param {number} count
 * @returns {string} "100 000"
 */
export function whole(count) {
  return String(count).replace(/\B(?=(\d{3})+$)/g, THIN_SPACE);
}

/**
 * @param {number} share between 0 and 1
 * @returns {string} "86.5 %"
 */
export function percent(share) {
  return Number.isNaN(share) ? NOTHING : `${fixed(100 * share, 1)}${THIN_SPACE}%`;
}

/**
 * @param {number} value
 * @param {number} error its standard error
 * @param {number} decimals
 * @returns {string} "−0.412 ± 0.031"
 */
export function withError(value, error, decimals) {
  if (Number.isNaN(value)) return NOTHING;
  return `${fixed(value, decimals)} ± ${fixed(error, decimals)}`;
}

/**
 * The label of an axis tick, with as many decimals as the step between ticks needs.
 *
 * @param {number} value
 * @param {number} step
 */
export function tick(value, step) {
  return fixed(value, Math.max(0, -Math.floor(Math.log10(step) + 1e-9)));
}
