/**
 * The measurements for a page: `scripts/bench.mjs` calls `measurePage` there.
 *
 * @module
 */

import { load } from '../dist/core.js';
import { measure } from './suite.js';

Object.assign(globalThis, {
  /** @param {{ quick: boolean, counted: import('./suite.js').Counted }} options */
  measurePage: (options) =>
    measure({
      load: /** @type {() => Promise<import('../www/types.d.ts').Motion>} */ (load),
      // Of the script that drives the page, which may collect garbage.
      heap: () => /** @type {any} */ (globalThis).heapInUse(),
      ...options,
      progress: (text) => console.log(text),
    }),
});
