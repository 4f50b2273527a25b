/**
 * Measurements in a page: `scripts/bench.mjs` calls `measurePage` there.
 *
 * @module
 */

import { load } from '../dist/core.js';
import { measure } from './suite.js';

Object.assign(globalThis, {
  /** @param {{ quick: boolean, log: { odometry: string, reference: string } }} options */
  measurePage: async (options) => {
    const motion = /** @type {import('../www/types.d.ts').Motion} */ (await load());
    return measure(motion, { ...options, progress: (text) => console.log(text) });
  },
});
