/**
 * Map Squeeze's settings: which attributes they have, and a machine in a given state.
 *
 * @module
 */

import { NUMBER, TRUTH, WORD, field, plain } from '../../figure/attributes.js';
import { showOnly } from '../../figure/cloud.js';
import { applyMap } from './maps/data.js';

/**
 * @typedef {import('../../types.d.ts').Motion} Motion
 * @typedef {import('../../types.d.ts').MapSqueeze} MapSqueeze
 */

export const VIEWS = /** @type {const} */ (['whole', 'close']);

/** Bits of a verdict. */
export const VERDICT = { endFree: 1, pathFree: 2, accepted: 4 };

export const SAMPLERS = /** @type {import('../../types.d.ts').SamplerName[]} */ (['endpoint', 'whole-arc', 'sub-stepped']);

/** Sample counts of the slider. The machine takes more, but their marks would be one blot. */
export const SAMPLE_COUNTS = [1, 2, 5, 10, 20, 50, 100, 200, 300, 600, 1000, 2000, 5000, 10_000];

export const COMMAND_SLIDERS = {
  v: { symbol: 'v', unit: 'm/s', min: -1.5, max: 1.5, step: 0.01 },
  omega: { symbol: 'ω', unit: 'rad/s', min: -2, max: 2, step: 0.01 },
  dt: { symbol: 'Δt', unit: 's', min: 0.1, max: 4, step: 0.05 },
};

export const NOISE_SLIDER = { min: 0, max: 0.4, step: 0.005 };
export const CLEARANCE_SLIDER = { min: 0, max: 0.4, step: 0.01 };
export const STEPS_SLIDER = { min: 1, max: 64, step: 1 };

/** What others depend on comes first. @type {import('../../figure/attributes.js').Attributes} */
export const ATTRIBUTES = {
  preset: { kind: WORD, own: true, covers: ['x', 'y', 'theta'] },
  x: field('start', 'x'),
  y: field('start', 'y'),
  theta: field('start', 'theta'),
  v: field('command', 'v'),
  omega: field('command', 'omega'),
  dt: field('command', 'dt'),
  noise: {
    kind: NUMBER,
    get: ({ alphas }, { MapSqueeze }) => {
      const level = /** @type {number[]} */ ([...MapSqueeze.alphasOfNoise(alphas[0])]);
      return level.every((alpha, i) => alpha === alphas[i]) ? alphas[0] : null;
    },
    change: (level, _, { MapSqueeze }) => ({ alphas: [...MapSqueeze.alphasOfNoise(level)] }),
  },
  clearance: plain('clearance', NUMBER),
  conditioned: plain('conditioned', TRUTH),
  sampler: plain('sampler', WORD),
  steps: plain('steps', NUMBER),
  samples: plain('samples', NUMBER),
  seed: plain('seed', NUMBER),
  view: { kind: WORD, own: true },
};

/**
 * A machine in a state; in that of the opening where there is none.
 *
 * @param {Motion} motion
 * @param {import('../../figure/state.js').State} [state]
 * @throws {TypeError | RangeError} and there is none then
 */
export function machineIn(motion, state) {
  const machine = new motion.MapSqueeze();
  if (!state) return machine;
  const { start, command, alphas, clearance, conditioned, sampler, steps, samples, seed, shown, map } = state;
  try {
    if (map !== null) applyMap(machine, map);
    machine.configure({ start, command, alphas, clearance, conditioned, sampler, steps, samples, seed });
    showOnly(machine, shown);
  } catch (error) {
    machine.free();
    throw error;
  }
  return machine;
}

/**
 * The settings that the widget opens with.
 *
 * @param {Motion} motion
 */
export function openingOf(motion) {
  const machine = new motion.MapSqueeze();
  const { config } = machine;
  machine.free();
  return config;
}

/**
 * Moves the robot to where it fits. In an occupancy grid it does so anyhow: the unknown is free there,
 * so that a place which is free may lie outside of everything that was mapped.
 *
 * @param {MapSqueeze} machine
 */
export function findRoom(machine) {
  if (machine.startFree && machine.grid === null) return;
  const { freePoint, config, plan } = machine;
  const [left, bottom, right, top] = plan.bounds;
  const [x, y] = freePoint ?? [(left + right) / 2, (bottom + top) / 2];
  machine.configure({ start: { ...config.start, x, y } });
}
