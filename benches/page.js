/**
 * The measurements for a page: `scripts/bench.mjs` calls `measurePage` there.
 *
 * @module
 */

import { load } from '../dist/core.js';
import { measure } from './suite.js';

Object.assign(globalThis, {
  /** @param {boolean} quick */
  measurePage: (quick) =>
    measure({
      load: /** @type {() => Promise<import('../www/types.d.ts').Motion>} */ (load),
      // Of the script that drives the page, which may collect garbage.
      heap: () => /** @type {any} */ (globalThis).heapInUse(),
      quick,
      progress: (text) => console.log(text),
    }),
});
