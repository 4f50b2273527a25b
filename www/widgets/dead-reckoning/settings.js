/** Dead Reckoning's settings as attributes, in its state, and as the eye sees them. */

import { attributesOf, presetsOf } from '../../figure/attributes.js';
import { cloudState } from '../../figure/cloud.js';
import { presets, settings } from '../../settings.js';
import { commandLooks } from '../shared/command.js';
import { ALPHA, alphaLooks } from '../shared/noise.js';

/** @import { DeadReckoningSettings } from '../../types.d.ts' */

export const declared = settings['dead-reckoning'];

/** The key of its words in the catalogues. */
export const vocabulary = 'reckoning';

/** The recursions in the order in which they are offered. */
export const RECURSIONS = /** @type {DeadReckoningSettings['compounding'][]} */ (declared.find(({ key }) => key === 'compounding')?.words);

/** @type {Record<string, import('../../figure/state.js').Owned>} */
export const own = cloudState;

/** Of what each step is. @type {Record<string, import('../../figure/controls.js').Look>} */
export const COMMAND = commandLooks(1);

export const NOISE = alphaLooks(6);

/** @type {import('../../figure/attributes.js').Attributes} */
export const attributes = { preset: presetsOf(presets['dead-reckoning'], declared), ...attributesOf(declared) };

/** @type {Record<string, import('../../figure/controls.js').Look>} */
export const looks = {
  ...COMMAND,
  ...NOISE,
  step: { symbol: '*k*', role: 'truth', min: 1, max: 200, step: 1, decimals: 0 },
  steps: { symbol: '*n*', role: 'prior', min: 1, max: 200, step: 1, decimals: 0 },
  headingNoise: {
    ...ALPHA,
    symbol: '*h*',
    step: 0.005,
    // Where they are not those of a level, the first of them stands for all.
    value: ({ alphas, headingNoise = alphas[2] }) => headingNoise,
  },
};

/** Sample counts of the slider; a larger cloud is slow to follow one. */
export const SAMPLE_COUNTS = [2, 3, 4].flatMap((decade) => [1, 2, 5].map((step) => step * 10 ** decade)).concat(100_000, 200_000);
