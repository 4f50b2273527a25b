/** The Odometry Decomposer's settings as attributes, in its state, and as the eye sees them. */

import { attributesOf, presetsOf } from '../../figure/attributes.js';
import { cloudState } from '../../figure/cloud.js';
import { presets, settings } from '../../settings.js';
import { alphaLooks } from '../shared/noise.js';

export const declared = settings['odometry-decomposer'];

/** The key of its words in the catalogues. */
export const vocabulary = 'decomposer';

/** @type {import('../../figure/attributes.js').Attributes} */
export const attributes = { preset: presetsOf(presets['odometry-decomposer'], declared), ...attributesOf(declared) };

export const own = cloudState;

/** Of the noise. */
export const NOISE = {
  ...alphaLooks(5, 'odometry'),
  correlation: { symbol: '*ρ*', role: /** @type {const} */ ('prediction'), min: -1, max: 1, step: 0.05, decimals: 2 },
};

/** @type {Record<string, import('../../figure/controls.js').Look>} */
export const looks = {
  ...NOISE,
  phase: { symbol: '*s*', role: 'prior', min: 0, max: 3, step: 0.01, decimals: 2 },
  drift: { symbol: '*t*', role: 'truth', min: 0, max: 120, step: 1, decimals: 0 },
};

export const SAMPLE_COUNTS = [10, 20, 50, 100, 200, 500, 1000, 2000, 5000];
