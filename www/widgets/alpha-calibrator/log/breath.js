/** Work in slices: a page answers in between. */

/**
 * @typedef {object} Watching
 * @property {(share: number) => void} [onProgress] is told how much is done, from 0 to 1
 * @property {AbortSignal} [signal] stops the work
 */

/** Milliseconds of work at a time: with what a page does of its own, well below a twentieth of a second. */
const SLICE = 12;

/** Rows or messages between two looks at the clock. */
export const ROWS_A_LOOK = 2048;

/**
 * @param {Watching} watching
 * @returns {(share: number) => Promise<void>} to be awaited every now and then: lets others have their turn when it is time
 */
export function breathing({ onProgress, signal }) {
  let last = performance.now();
  return async (share) => {
    signal?.throwIfAborted();
    if (performance.now() - last < SLICE) return;
    onProgress?.(share);
    await new Promise((go) => setTimeout(go));
    signal?.throwIfAborted();
    last = performance.now();
  };
}
