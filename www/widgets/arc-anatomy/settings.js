/** Arc Anatomy's settings as attributes, in its state, and as the eye sees them. */

import { WORD, attributesOf } from '../../figure/attributes.js';
import { wholeNumber, word } from '../../figure/checks.js';
import { presets, settings } from '../../settings.js';
import { commandLooks } from '../shared/command.js';
import { alphaLooks } from '../shared/noise.js';

/** @typedef {import('../../types.d.ts').ArcAnatomySettings} Settings */

export const declared = settings['arc-anatomy'];

/** The key of its words in the catalogues. */
export const vocabulary = 'anatomy';

export const PRESETS = presets['arc-anatomy'];
const PRESET_NAMES = PRESETS.map(({ name }) => name);

/** All of them start here. */
const ORIGIN = { x: 0, y: 0, theta: 0 };

/** Lines of Table 5.1. */
export const LINES = 9;

/** All of the time that the robot is underway, per cent. */
export const WHOLE = 100;

const TWISTS = ['hidden', 'shown'];

/**
 * The settings to make for a preset.
 *
 * @param {typeof PRESETS[number]} preset
 */
const settingsFor = ({ v, omega, dt, nextX, nextY, nextTheta }) => ({
  start: ORIGIN,
  command: { v, omega, dt },
  next: { x: nextX, y: nextY, theta: nextTheta },
});

/**
 * The name of the preset that the settings are; null where they are none's.
 *
 * @param {Pick<Settings, 'start' | 'command' | 'next'>} config
 */
export function presetIn(config) {
  const fits = (/** @type {typeof PRESETS[number]} */ preset) =>
    Object.entries(settingsFor(preset)).every(([group, wanted]) => {
      const present = /** @type {any} */ (config)[group];
      return Object.entries(wanted).every(([key, value]) => present[key] === value);
    });
  return PRESETS.find(fits)?.name ?? null;
}

/**
 * @param {unknown} name
 * @returns {Record<string, unknown>} the settings to make for the preset of that name
 */
export function presetNamed(name) {
  return settingsFor(PRESETS[PRESET_NAMES.indexOf(word('preset', name, PRESET_NAMES))]);
}

/** @type {import('../../figure/attributes.js').Attributes} */
export const attributes = {
  preset: {
    kind: WORD,
    covers: () => ['startX', 'startY', 'startTheta', 'v', 'omega', 'dt', 'nextX', 'nextY', 'nextTheta'],
    words: PRESET_NAMES,
    get: ({ config }) => presetIn(/** @type {any} */ (config)),
    change: presetNamed,
  },
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
