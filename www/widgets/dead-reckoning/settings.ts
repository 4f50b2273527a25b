/** Dead Reckoning's settings: their attributes, their part of the state, and their sliders. */

import { attributesOf, presetsOf } from '../../figure/attributes.ts';
import { cloudState } from '../../figure/cloud.ts';
import { overlaysOf } from '../../figure/overlays.ts';
import { presets, settings } from '../../settings.js';
import { COMMAND_DASH, commandLooks } from '../shared/command.ts';
import { ALPHA, alphaLooks } from '../shared/noise.ts';
import type { DeadReckoningSettings } from '../../types.d.ts';

export const declared = settings['dead-reckoning'];

/** Key of the words in the catalogues. */
export const vocabulary = 'reckoning';

/** Recursions in the order in which they are offered. */
export const RECURSIONS = declared.find(({ key }) => key === 'compounding')?.words as DeadReckoningSettings['compounding'][];

/** Styles of the ratios in the chart. */
export const CURVES = {
  lateral: { role: 'prediction', width: 1.9 },
  along: { role: 'ink', width: 1.9, dash: [8, 4] },
  heading: { role: 'muted', width: 1.9, dash: [9, 3, 2, 3] },
  tolerance: { role: 'truth', mark: 'area' },
} satisfies Record<string, import('../../figure/overlays.ts').LineStyle>;

/** Styles of the outlines in the pictures, in the order in which they are painted. */
export const OUTLINES = {
  command: { role: 'prior', width: 2.25, dash: COMMAND_DASH },
  measured: { role: 'truth', width: 2.25, dash: [3, 3] },
  ellipse: { role: 'prediction', width: 2, dash: [7, 4] },
  exponential: { role: 'posterior', width: 2.25, dash: [] },
} satisfies Record<string, import('../../figure/overlays.ts').LineStyle>;

export const OVERLAYS = Object.keys({ ...CURVES, ...OUTLINES });
const { attribute, state } = overlaysOf(OVERLAYS);

export const own: Record<string, import('../../figure/state.ts').Owned> = { ...cloudState, overlays: state };

/** Sliders of the command of a step. */
export const COMMAND: Record<string, import('../../figure/controls.ts').Look> = commandLooks(1);

export const NOISE = alphaLooks(6);

export const attributes: import('../../figure/attributes.ts').Attributes = { preset: presetsOf(presets['dead-reckoning'], declared), ...attributesOf(declared), overlays: attribute };

export const looks: Record<string, import('../../figure/controls.ts').Look> = {
  ...COMMAND,
  ...NOISE,
  step: { symbol: '*k*', role: 'truth', min: 1, max: 200, step: 1, decimals: 0 },
  steps: { symbol: '*K*', role: 'prior', min: 1, max: 200, step: 1, decimals: 0 },
  headingNoise: {
    ...ALPHA,
    step: 0.005,
    // The slider shows α₃, even if the other three are not in the usual ratio to it.
    value: ({ alphas, headingNoise = alphas[2] }) => headingNoise,
  },
};

/** Sample counts of the slider; larger clouds would not follow the slider. */
export const SAMPLE_COUNTS = [2, 3, 4].flatMap((decade) => [1, 2, 5].map((step) => step * 10 ** decade)).concat(100_000, 200_000);
