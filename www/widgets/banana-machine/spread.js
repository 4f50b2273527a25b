/**
 * How wide a cloud spreads.
 *
 * @module
 */

/** Below this, metres or radians, a spread is none: rounding of the quadrature, not noise. */
const NO_SPREAD = 1e-9;

/** @param {number} variance whose quadrature may round to less than 0 */
export function deviation(variance) {
  return Math.sqrt(Math.max(0, variance));
}

/**
 * What kind of spread the cloud has, by the exact covariance.
 *
 * @param {import('../../types.d.ts').Table} table
 * @returns {'point' | 'headings' | 'cloud'} one pose; one place but many headings; or a spread
 */
export function spreadOf({ exact: { cov } }) {
  if (deviation(Math.max(cov[0][0], cov[1][1])) > NO_SPREAD) return 'cloud';
  return deviation(cov[2][2]) > NO_SPREAD ? 'headings' : 'point';
}
