/**
 * The Banana Machine's settings: which attributes they have, and a machine in a given state.
 *
 * @module
 */

import { DASHES } from '../../scene/draw.js';
import { NUMBER, WORD, WORDS, field, plain, preset } from '../../figure/attributes.js';
import { showOnly } from '../../figure/cloud.js';
import { refusal } from '../../figure/checks.js';

/**
 * @typedef {import('../../types.d.ts').Motion} Motion
 * @typedef {import('../../types.d.ts').OverlayName} Overlay
 */

export const OVERLAYS = /** @type {Overlay[]} */ (Object.keys(DASHES));

/** Those that are shown when the widget opens. @type {readonly Overlay[]} */
export const OPENING_OVERLAYS = ['command', 'ellipse', 'exponential'];

/** Largest sample count of the slider: beyond it a drag no longer follows the finger. */
const MOST_SAMPLES = 1_000_000;

/** Sample counts of the slider, in the 1–2–5 steps of a logarithmic scale. */
export const SAMPLE_COUNTS = [1, 2, 3, 4, 5, 6]
  .flatMap((decade) => [1, 2, 5].map((step) => step * 10 ** decade))
  .filter((count) => count <= MOST_SAMPLES);

/** The sliders of the command, with the range that the handle and the chart keep to as well. */
export const COMMAND_SLIDERS = {
  v: { symbol: 'v', unit: 'm/s', min: -1.5, max: 1.5, step: 0.01 },
  omega: { symbol: 'ω', unit: 'rad/s', min: -2, max: 2, step: 0.01 },
  dt: { symbol: 'Δt', unit: 's', min: 0.1, max: 3, step: 0.05 },
};

/** Noise parameters of each model. */
export const ALPHAS = { velocity: 6, odometry: 4 };

/**
 * A noise parameter of the present model.
 *
 * @param {number} index from 0
 * @returns {import('../../figure/attributes.js').Setting}
 */
function alpha(index) {
  return {
    kind: NUMBER,
    get: ({ alphas }) => alphas[index] ?? null,
    change: (value, { model, alphas }) => {
      if (index < alphas.length) return { alphas: alphas.with(index, value) };
      throw refusal(`alpha${index + 1}`, value, `none, as the ${model} model has alpha1 to alpha${alphas.length}`);
    },
  };
}

/** What others depend on comes first. @type {import('../../figure/attributes.js').Attributes} */
export const ATTRIBUTES = {
  preset: preset(
    ({ BananaMachine }) => BananaMachine.presets,
    ({ v, omega, dt }) => ({ command: { v, omega, dt } }),
    ['v', 'omega', 'dt'],
  ),
  model: plain('model', WORD),
  noise: plain('noise', WORD),
  v: field('command', 'v'),
  omega: field('command', 'omega'),
  dt: field('command', 'dt'),
  ...Object.fromEntries([0, 1, 2, 3, 4, 5].map((index) => [`alpha${index + 1}`, alpha(index)])),
  isolate: { ...plain('isolate', NUMBER), get: ({ isolate }) => isolate ?? null },
  samples: plain('samples', NUMBER),
  seed: plain('seed', NUMBER),
  overlays: { kind: WORDS, own: true },
};

/**
 * A machine in a state; in that of the opening where there is none.
 *
 * @param {Motion} motion
 * @param {import('../../figure/state.js').State} [state]
 * @throws {TypeError | RangeError} and there is none then
 */
export function machineIn(motion, state) {
  const machine = new motion.BananaMachine();
  if (!state) return machine;
  const { model, noise, command, alphas, isolate, samples, seed, shown } = state;
  try {
    const other = model === 'velocity' ? 'odometry' : 'velocity';
    machine.configure({ model: other, alphas: alphas[other] });
    machine.configure({ model, noise, command, alphas: alphas[model], isolate, samples, seed });
    showOnly(machine, shown);
  } catch (error) {
    machine.free();
    throw error;
  }
  return machine;
}

/**
 * The settings that the widget opens with, in a model.
 *
 * @param {Motion} motion
 * @param {{ model: import('../../types.d.ts').ModelName }} settings
 */
export function openingOf(motion, { model }) {
  const machine = new motion.BananaMachine({ model });
  const { config } = machine;
  machine.free();
  return config;
}
