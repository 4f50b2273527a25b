/** Arc Anatomy's settings as attributes, in its state, and as the eye sees them. */

import { WORD, attributesOf, presetsOf } from '../../figure/attributes.js';
import { wholeNumber, word } from '../../figure/checks.js';
import { presets, settings } from '../../settings.js';
import { commandLooks } from '../shared/command.js';
import { alphaLooks } from '../shared/noise.js';

/** @typedef {import('../../types.d.ts').ArcAnatomySettings} Settings */

export const declared = settings['arc-anatomy'];

/** The key of its words in the catalogues. */
export const vocabulary = 'anatomy';

/** Lines of Table 5.1. */
export const LINES = 9;

/** All of the time that the robot is underway, per cent. */
export const WHOLE = 100;

const TWISTS = ['hidden', 'shown'];

/** @type {import('../../figure/attributes.js').Attributes} */
export const attributes = {
  preset: presetsOf(presets['arc-anatomy'], declared),
  ...attributesOf(declared),
  twist: { kind: WORD, own: true, words: TWISTS },
};

/** @type {Record<string, import('../../figure/state.js').Owned>} */
export const own = {
  twist: { opening: 'hidden', check: (field, twist) => word(field, twist, TWISTS) },
  line: { opening: 0, check: (field, line) => wholeNumber(field, line, 0, LINES) },
  underway: { opening: WHOLE, check: (field, share) => wholeNumber(field, share, 0, WHOLE) },
};

/** @type {import('../../figure/attributes.js').Documentation} */
export const documentation = {
  state: {
    line: { type: 'number', sentence: 'The line of Table 5.1 that is lit, from 1; 0 for none.' },
    underway: { type: 'number', sentence: 'How much of the time the robot has been underway, in per cent.' },
  },
};

export const COMMAND = commandLooks(4);

export const ALPHAS = alphaLooks(6);

/** @type {Record<string, import('../../figure/controls.js').Look>} */
export const looks = { ...COMMAND, ...ALPHAS };

/** How far the poses can be dragged from the origin, m. */
export const REACH = 4;
