/** Quantiles of long columns. */

/** Maximum number of items from which a quantile is computed. */
const MAX_ITEMS = 10_000;

/** Evaluates `value` at evenly spaced indices below `count`, at most `MAX_ITEMS` of them. */
export function sampleEvenly(count: number, value: (i: number) => number): Float64Array {
  const stride = Math.max(1, Math.ceil(count / MAX_ITEMS));
  const values = new Float64Array(Math.max(0, Math.ceil(count / stride)));
  for (let i = 0; i < values.length; i++) values[i] = value(i * stride);
  return values;
}

/** Sorts the values in place and returns a quantile of them; NaN of no values. */
export const quantile = (values: Float64Array, fraction: number) => values.sort()[Math.floor(fraction * (values.length - 1))] ?? NaN;
