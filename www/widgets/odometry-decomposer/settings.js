/** The Odometry Decomposer's settings as attributes, in its state, and as the eye sees them. */

import { WORD, attributesOf } from '../../figure/attributes.js';
import { word } from '../../figure/checks.js';
import { cloudState } from '../../figure/cloud.js';
import { presets, settings } from '../../settings.js';
import { alphaLooks } from '../shared/noise.js';

export const declared = settings['odometry-decomposer'];

/** The key of its words in the catalogues. */
export const vocabulary = 'decomposer';

export const PRESETS = presets['odometry-decomposer'];
const PRESET_NAMES = PRESETS.map(({ name }) => name);

/** @typedef {import('../../types.d.ts').Pose} Pose */

/** @param {Pose} one @param {Pose} other */
const areSame = (one, other) => one.x === other.x && one.y === other.y && one.theta === other.theta;

/**
 * The name of the preset that a reading is; null where it is another.
 *
 * @param {{ from: Pose, to: Pose }} config
 */
export function presetIn({ from, to }) {
  return PRESETS.find((preset) => areSame(preset.from, from) && areSame(preset.to, to))?.name ?? null;
}

/**
 * @param {unknown} name
 * @returns {{ from: Pose, to: Pose }} the settings to make for the preset of that name
 */
export function presetNamed(name) {
  const { from, to } = PRESETS[PRESET_NAMES.indexOf(word('preset', name, PRESET_NAMES))];
  return { from, to };
}

/** @type {import('../../figure/attributes.js').Attributes} */
export const attributes = {
  preset: {
    kind: WORD,
    covers: () => ['fromX', 'fromY', 'fromTheta', 'toX', 'toY', 'toTheta'],
    words: PRESET_NAMES,
    get: ({ config }) => presetIn(/** @type {any} */ (config)),
    change: (name) => presetNamed(name),
  },
  ...attributesOf(declared),
};

export const own = cloudState;

/** Of the noise. */
export const NOISE = {
  ...alphaLooks(5),
  correlation: { symbol: '*ρ*', role: /** @type {const} */ ('prediction'), min: -1, max: 1, step: 0.05, decimals: 2 },
};

/** @type {Record<string, import('../../figure/controls.js').Look>} */
export const looks = {
  ...NOISE,
  phase: { symbol: '*s*', role: 'prior', min: 0, max: 3, step: 0.01, decimals: 2 },
  drift: { symbol: '*t*', role: 'truth', min: 0, max: 120, step: 1, decimals: 0 },
};

export const SAMPLE_COUNTS = [10, 20, 50, 100, 200, 500, 1000, 2000, 5000];
