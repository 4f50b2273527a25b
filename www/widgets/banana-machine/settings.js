/** The Banana Machine's settings as attributes, in its state, and as the eye sees them. */

import { NUMBER, attributesOf, presetsOf } from '../../figure/attributes.js';
import { numberWithin, wholeNumber } from '../../figure/checks.js';
import { cloudState } from '../../figure/cloud.js';
import { overlaysOf } from '../../figure/overlays.js';
import { openingAlphas, presets, settings } from '../../settings.js';
import { COMMAND_DASH, commandLooks } from '../shared/command.js';
import { alphaLooks } from '../shared/noise.js';

export const declared = settings['banana-machine'];

/** The key of its words in the catalogues. */
export const vocabulary = 'banana';

/** Styles of the lines in the pictures. @satisfies {Record<string, import('../../figure/overlays.js').LineStyle>} */
export const LINES = {
  command: { role: 'prior', width: 2.5, dash: COMMAND_DASH },
  ellipse: { role: 'prediction', width: 2, dash: [7, 4] },
  exponential: { role: 'posterior', width: 2.25, dash: [] },
  linearized: { role: 'prediction', width: 1.75, dash: [9, 3, 2, 3] },
  additive: { role: 'prediction', width: 2.5, dash: [1.5, 5] },
};

/** @typedef {keyof typeof LINES} LineName */

export const OVERLAYS = /** @type {LineName[]} */ (Object.keys(LINES));
const { attribute, state } = overlaysOf(OVERLAYS, ['command', 'ellipse', 'exponential']);

/** @type {import('../../figure/attributes.js').Attributes} */
export const attributes = {
  preset: presetsOf(presets['banana-machine'], declared),
  ...attributesOf(declared),
  overlays: attribute,
  morph: { kind: NUMBER, own: true },
};

/** @type {Record<string, import('../../figure/state.js').Owned>} */
export const own = {
  ...cloudState,
  /** The α that Isolate leaves, from 1; remembered while Isolate is off. */
  isolateChoice: { opening: 4, check: (field, number) => wholeNumber(field, number, 1, openingAlphas.velocity.length) },
  overlays: state,
  /** Share of the way from the floor to exponential coordinates. */
  morph: { opening: 0, check: (field, morph) => numberWithin(field, morph, 0, 1) },
};

/** @type {import('../../figure/attributes.js').Documentation} */
export const documentation = {
  state: {
    alphas: { type: '{ velocity: number[]; odometry: number[] }', sentence: 'Six and four, of either model.' },
    isolateChoice: { type: 'number', sentence: 'What Isolate leaves when it is turned on, from 1.' },
  },
};

export const COMMAND = commandLooks(3);

export const looks = { ...COMMAND, ...alphaLooks(6) };

/** Sample counts of the slider, in the 1–2–5 steps of a logarithmic scale; beyond a million a drag no longer follows the finger. */
export const SAMPLE_COUNTS = [1, 2, 3, 4, 5].flatMap((decade) => [1, 2, 5].map((step) => step * 10 ** decade)).concat(1_000_000);
