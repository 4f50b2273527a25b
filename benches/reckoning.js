/**
 * Dead Reckoning: all rollouts of a path driven anew, with the moments of every step.
 *
 * @module
 */

import { race, spread } from './timing.js';

/**
 * @typedef {import('../www/types.d.ts').Motion} Motion
 * @typedef {import('../www/types.d.ts').DeadReckoning} Machine
 * @typedef {import('./timing.js').Spread} Spread
 */

export const STEPS = 20;
/** As many as there may be. */
const MANY_STEPS = 200;

/**
 * The slider of the heading noise never stays.
 *
 * @param {Machine} machine
 * @param {number} event
 */
export function driveAgain(machine, event) {
  machine.configure({ headingNoise: 0.02 + 0.0001 * (event % 100) });
  return machine.stats;
}

/**
 * @param {Motion} motion
 * @param {{ rollouts: number, seconds: number }} options
 * @returns {Promise<{ rollouts: number, few: Spread, many: Spread }>} ms for all rollouts, of twenty steps and of 200
 */
export async function timeReckoning(motion, { rollouts, seconds }) {
  const machines = [STEPS, MANY_STEPS].map((steps) => new motion.DeadReckoning({ steps, step: 1, samples: rollouts, seed: 1 }));
  const [few, many] = machines.map((machine) => (/** @type {number} */ event) => void driveAgain(machine, event));
  const turns = await race({ few, many }, { seconds, most: 20 });
  for (const machine of machines) machine.free();
  return { rollouts, few: spread(turns.few), many: spread(turns.many) };
}
