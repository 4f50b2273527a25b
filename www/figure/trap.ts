/** What ends a core, and what does not. */

/**
 * Whether an error is the core's end: a trap, or what its glue throws where a machine is used after one: see writeGlue in
 * scripts/build.mjs. Others are refusals, or come from what the page gave.
 */
export function isTrap(error: unknown) {
  return typeof WebAssembly !== 'undefined' && error instanceof WebAssembly.RuntimeError;
}
