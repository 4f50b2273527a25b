/** Curves through a few points. */

/**
 * Interpolates a curve linearly in the logarithm of its abscissa.
 *
 * @param {ArrayLike<number>} at where its points are, rising
 * @param {ArrayLike<number>} values
 * @param {number} where
 * @returns {number} NaN beyond its ends, and beside a point that is not finite
 */
export function between(at, values, where) {
  const after = Array.from(at).findIndex((each) => each >= where);
  if (after < 0 || (after === 0 && at[0] > where)) return NaN;
  if (at[after] === where) return values[after];
  const share = Math.log(where / at[after - 1]) / Math.log(at[after] / at[after - 1]);
  const value = values[after - 1] + share * (values[after] - values[after - 1]);
  return Number.isFinite(value) ? value : NaN;
}

/** Size beyond which a half cannot be seen. */
const BEYOND = 1e9;

/**
 * Range of an axis that shows the highest points of a curve. Values of more than 10⁹ count as infinite.
 *
 * @param {ArrayLike<number>} values
 * @param {number} depth below the highest of them
 * @returns {{ from: number, to: number }} around 0 where none is finite
 */
export function axisOf(values, depth) {
  const finite = Array.from(values).filter((value) => Math.abs(value) < BEYOND);
  const best = finite.length > 0 ? Math.max(...finite) : 0;
  return { from: Math.max(Math.min(best - 0.5, ...finite), best - depth), to: best + 0.5 };
}

/**
 * Range of an axis of squares: all bins and the line, and half as much again of their bars. The bar of a single leg would leave the
 * others no room.
 *
 * @param {number[]} squares of bins
 * @param {number[]} error of each
 * @param {number} line its highest square
 * @returns {{ from: number, to: number }}
 */
export function axisOfSquares(squares, error, line) {
  const [lowest, highest] = [Math.min(0, ...squares), Math.max(0, line, ...squares)];
  const ends = (/** @type {number} */ side) => squares.map((square, i) => square + side * error[i]);
  const room = (highest - lowest) / 2;
  return {
    from: Math.max(lowest - room, Math.min(lowest, ...ends(-1))),
    to: Math.min(highest + room, Math.max(highest, ...ends(1))),
  };
}
