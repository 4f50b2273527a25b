/** Dead Reckoning's settings as attributes, in its state, and as the eye sees them. */

import { attributesOf, presetsOf } from '../../figure/attributes.js';
import { cloudState } from '../../figure/cloud.js';
import { overlaysOf } from '../../figure/overlays.js';
import { presets, settings } from '../../settings.js';
import { COMMAND_DASH, commandLooks } from '../shared/command.js';
import { ALPHA, alphaLooks } from '../shared/noise.js';

/** @import { DeadReckoningSettings } from '../../types.d.ts' */

export const declared = settings['dead-reckoning'];

/** The key of its words in the catalogues. */
export const vocabulary = 'reckoning';

/** The recursions in the order in which they are offered. */
export const RECURSIONS = /** @type {DeadReckoningSettings['compounding'][]} */ (declared.find(({ key }) => key === 'compounding')?.words);

/** Styles of the ratios in the chart. @satisfies {Record<string, import('../../figure/overlays.js').LineStyle>} */
export const CURVES = {
  lateral: { role: 'prediction', width: 1.9 },
  along: { role: 'ink', width: 1.9, dash: [8, 4] },
  heading: { role: 'muted', width: 1.9, dash: [9, 3, 2, 3] },
  tolerance: { role: 'truth', mark: 'area' },
};

/** Styles of the outlines in the pictures, in the order in which they are painted. @satisfies {Record<string, import('../../figure/overlays.js').LineStyle>} */
export const OUTLINES = {
  command: { role: 'prior', width: 2.25, dash: COMMAND_DASH },
  measured: { role: 'truth', width: 2.25, dash: [3, 3] },
  ellipse: { role: 'prediction', width: 2, dash: [7, 4] },
  exponential: { role: 'posterior', width: 2.25, dash: [] },
};

export const OVERLAYS = Object.keys({ ...CURVES, ...OUTLINES });
const { attribute, state } = overlaysOf(OVERLAYS);

/** @type {Record<string, import('../../figure/state.js').Owned>} */
export const own = { ...cloudState, overlays: state };

/** Of what each step is. @type {Record<string, import('../../figure/controls.js').Look>} */
export const COMMAND = commandLooks(1);

export const NOISE = alphaLooks(6);

/** @type {import('../../figure/attributes.js').Attributes} */
export const attributes = { preset: presetsOf(presets['dead-reckoning'], declared), ...attributesOf(declared), overlays: attribute };

/** @type {Record<string, import('../../figure/controls.js').Look>} */
export const looks = {
  ...COMMAND,
  ...NOISE,
  step: { symbol: '*k*', role: 'truth', min: 1, max: 200, step: 1, decimals: 0 },
  steps: { symbol: '*K*', role: 'prior', min: 1, max: 200, step: 1, decimals: 0 },
  headingNoise: {
    ...ALPHA,
    step: 0.005,
    // Where they are not those of a level, the first of them stands for all.
    value: ({ alphas, headingNoise = alphas[2] }) => headingNoise,
  },
};

/** Sample counts of the slider; a larger cloud is slow to follow one. */
export const SAMPLE_COUNTS = [2, 3, 4].flatMap((decade) => [1, 2, 5].map((step) => step * 10 ** decade)).concat(100_000, 200_000);
