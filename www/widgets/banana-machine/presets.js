/**
 * What the Banana Machine's presets set. Each is a command; some have noise parameters besides, of the velocity model.
 * One without leaves the noise as it is set, but for that of another preset: there the opening's comes back, so that
 * pressing one preset after another shows each as it is meant, and what was set by hand is never lost.
 */

import { WORD } from '../../figure/attributes.js';
import { word } from '../../figure/checks.js';
import { openingAlphas, presets } from '../../settings.js';

/** @typedef {typeof PRESETS[number]} Preset */

/** Those with noise parameters of their own come first when a preset is recognized. */
export const PRESETS = presets['banana-machine'];
const NAMES = PRESETS.map(({ name }) => name);
const RECOGNIZED = PRESETS.toSorted((one, other) => Number(other.alphas !== null) - Number(one.alphas !== null));

const COMMAND = ['v', 'omega', 'dt'];
const ALPHAS = openingAlphas.velocity.map((_, i) => `alpha${i + 1}`);

/**
 * @param {readonly number[]} one
 * @param {readonly number[]} other
 */
const areSame = (one, other) => one.length === other.length && one.every((alpha, i) => alpha === other[i]);

/**
 * The name of the preset that the settings are; null where they are none's.
 *
 * @param {import('../../types.d.ts').Settings} config
 */
export function presetIn({ model, command, alphas }) {
  const fits = (/** @type {Preset} */ { v, omega, dt, alphas: own }) =>
    v === command.v && omega === command.omega && dt === command.dt &&
    (own === null || (model === 'velocity' && areSame(own, alphas)));
  return RECOGNIZED.find(fits)?.name ?? null;
}

/**
 * The settings to make for a preset.
 *
 * @param {Preset} preset
 * @param {import('../../types.d.ts').Settings} config
 */
function settingsFor({ v, omega, dt, alphas }, { model, alphas: present }) {
  const command = { v, omega, dt };
  // All of them are in effect then: their point would be lost otherwise.
  if (alphas) return { command, model: 'velocity', alphas, isolate: null };
  const borrowed = model === 'velocity' && PRESETS.some(({ alphas: own }) => own && areSame(own, present));
  return borrowed ? { command, alphas: openingAlphas.velocity } : { command };
}

/**
 * @param {unknown} name
 * @param {import('../../types.d.ts').Settings} config
 * @returns {Record<string, unknown>} the settings to make for the preset of that name
 */
export function presetNamed(name, config) {
  return settingsFor(PRESETS[NAMES.indexOf(word('preset', name, NAMES))], config);
}

/** @type {import('../../figure/attributes.js').Attributes[string]} */
export const presetAttribute = {
  kind: WORD,
  covers: (name) => (PRESETS.find((preset) => preset.name === name)?.alphas === null ? COMMAND : [...COMMAND, ...ALPHAS]),
  words: NAMES,
  get: ({ config }) => presetIn(/** @type {any} */ (config)),
  change: (name, { config }) => presetNamed(name, /** @type {any} */ (config)),
};
