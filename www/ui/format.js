/**
 * Numbers as they are printed: fixed decimals, a true minus sign, thin spaces between thousands,
 * and a dash where there is no number.
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
