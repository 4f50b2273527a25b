/** The Banana Machine's settings as attributes, in its state, and as the eye sees them. */

import { WORDS, attributesOf } from '../../figure/attributes.js';
import { subset, wholeNumber } from '../../figure/checks.js';
import { cloudState } from '../../figure/cloud.js';
import { openingAlphas, settings } from '../../settings.js';
import { COMMAND_DASH, commandLooks } from '../shared/command.js';
import { alphaLooks } from '../shared/noise.js';
import { presetAttribute } from './presets.js';

export const declared = settings['banana-machine'];

/** The key of its words in the catalogues. */
export const vocabulary = 'banana';

/** Dashes of the outlines on the floor, CSS pixels. @satisfies {Record<string, number[]>} */
export const DASHES = { command: COMMAND_DASH, ellipse: [7, 4], linearized: [9, 3, 2, 3], additive: [1.5, 5], exponential: [] };
export const OVERLAYS = /** @type {(keyof typeof DASHES)[]} */ (Object.keys(DASHES));
const OPENING_OVERLAYS = ['command', 'ellipse', 'exponential'];

/** @type {import('../../figure/attributes.js').Attributes} */
export const attributes = {
  preset: presetAttribute,
  ...attributesOf(declared),
  overlays: { kind: WORDS, own: true, words: OVERLAYS },
};

/** @type {Record<string, import('../../figure/state.js').Owned>} */
export const own = {
  ...cloudState,
  /** The α that Isolate leaves, from 1; remembered while Isolate is off. */
  isolateChoice: { opening: 4, check: (field, number) => wholeNumber(field, number, 1, openingAlphas.velocity.length) },
  overlays: { opening: OPENING_OVERLAYS, check: (field, overlays) => subset(field, overlays, OVERLAYS) },
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
