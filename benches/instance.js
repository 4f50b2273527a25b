/**
 * What the core exports to its glue, which keeps it to itself: taken on its way.
 *
 * @module
 */

/**
 * @template T
 * @param {() => Promise<T>} start what instantiates the module
 * @returns {Promise<{ result: T, exports: WebAssembly.Exports }>}
 */
export async function watchInstance(start) {
  const { instantiate } = WebAssembly;
  /** @type {WebAssembly.Exports | undefined} */
  let exports;
  WebAssembly.instantiate = /** @type {typeof instantiate} */ (
    /** @type {unknown} */ (async (/** @type {any} */ source, /** @type {any} */ imports) => {
      const started = /** @type {any} */ (await instantiate(source, imports));
      ({ exports } = started.instance ?? started);
      return started;
    })
  );
  try {
    const result = await start();
    if (!exports) throw new Error('The module was instantiated before, or by another function.');
    return { result, exports };
  } finally {
    WebAssembly.instantiate = instantiate;
  }
}
