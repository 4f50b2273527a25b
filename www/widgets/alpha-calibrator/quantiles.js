/** Quantiles of residuals and of their sums of squares under the noise of the model. */

/** @typedef {import('../../types.d.ts').AlphaCalibratorSettings['noise']} Noise */

/**
 * Shares of the legs below the squared error of each class if the model is true: the last class has one leg in a thousand.
 */
export const SHARES = [0.5, 0.95, 0.999];

/**
 * Quantiles of the sum of 0 to 3 squares of variables of variance 1 at these shares, by how the variables are distributed: of
 * normal ones it is χ².
 *
 * @type {Record<Noise, number[][]>}
 */
export const SQUARED = {
  normal: [[0, 0, 0], [0.455, 3.841, 10.828], [1.386, 5.991, 13.816], [2.366, 7.815, 16.266]],
  triangular: [[0, 0, 0], [0.515, 3.617, 5.626], [1.573, 5.27, 8.943], [2.632, 6.863, 11.186]],
};

/** Largest normal quantile, standard deviations. */
export const REACH = 4;

/** Quantiles of variance 1 at each hundredth from 0.01 to 0.99. @type {Record<Noise, Float64Array>} */
export const QUANTILES = { normal: atHundredths(normalQuantile), triangular: atHundredths(triangularQuantile) };

/** @param {(share: number) => number} quantile */
function atHundredths(quantile) {
  return Float64Array.from({ length: 99 }, (_, i) => quantile((i + 1) / 100));
}

/** By bisection of a series of the distribution function, to a thousandth and better. @param {number} share */
function normalQuantile(share) {
  let [low, high] = [-REACH, REACH];
  while (high - low > 1e-4) {
    const middle = (low + high) / 2;
    // Φ(x) = ½ + φ(x)·(x + x³/3 + x⁵/15 + …).
    let [term, sum] = [middle, middle];
    for (let n = 3; Math.abs(term) > 1e-7; n += 2) sum += term *= (middle * middle) / n;
    const below = 0.5 + (Math.exp((-middle * middle) / 2) / Math.sqrt(2 * Math.PI)) * sum;
    if (below < share) low = middle;
    else high = middle;
  }
  return (low + high) / 2;
}

/** Quantile of the triangular distribution on −√6 to √6. @param {number} share @returns {number} */
function triangularQuantile(share) {
  return share <= 0.5 ? Math.sqrt(6) * (Math.sqrt(2 * share) - 1) : -triangularQuantile(1 - share);
}
