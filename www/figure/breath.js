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

/** Others have their turn. A timer would not wait for them alone: of several in a row, browsers have each last four milliseconds. */
export const turn = () =>
  new Promise((go) => {
    const { port1, port2 } = new MessageChannel();
    port1.onmessage = () => {
      port1.close();
      go(undefined);
    };
    port2.postMessage(null);
  });

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
    await turn();
    signal?.throwIfAborted();
    last = performance.now();
  };
}
