/**
 * How near the core is to what the machine can do: the limit of its arithmetic and of its memory, measured by kernels that
 * do nothing else, and what a sample of each kind would take at these limits.
 *
 * @module
 */

import { driveAgain, STEPS } from './reckoning.js';
import { ALPHAS, figures } from './scene.js';
import { drag, SETTINGS } from './squeeze.js';
import { race, spread } from './timing.js';

/**
 * @typedef {import('../www/types.d.ts').Motion} Motion
 * @typedef {import('./operations.js').Operations} Operations
 * @typedef {import('./timing.js').Spread} Spread
 *
 * @typedef {object} Limits the shortest times that the kernels took, ns: what disturbs only ever makes them longer
 * @property {number} operation one of two lanes
 * @property {number} division
 * @property {number} byte read in a row, of as many as a million samples have
 *
 * @typedef {object} Roof of one kind of sample, ns
 * @property {string} what
 * @property {Operations} operations
 * @property {number} bytes of its draws, as often as they are read
 * @property {number} arithmetic at the limit
 * @property {number} memory
 * @property {Spread} measured
 */

const SAMPLES = 50_000;
/** Of three draws. */
const DRAW_BYTES = 24;
const PAGE = 65_536;
/** Of each kernel's loop; of reading, once over the draws of a million samples. */
const TURNS = { arithmetic: 200_000, division: 100_000, reading: (1e6 * DRAW_BYTES) / 64 };
/** What a turn of each does. */
const OF_A_TURN = { arithmetic: 12, division: 6, reading: 64 };

/**
 * What is measured: an event of a machine, and how often that reads its draws.
 *
 * @type {{ what: string, passes: number, make: (motion: Motion, samples: number) => any, event: (machine: any, event: number) => void }[]}
 */
export const KINDS = [
  {
    what: 'refresh, all but the picture',
    passes: 2,
    make: ({ BananaMachine }, samples) => new BananaMachine({ alphas: ALPHAS, samples, seed: 1 }),
    event: figures,
  },
  {
    what: 'conditioned sample, both verdicts',
    passes: 1,
    make: ({ MapSqueeze }, samples) => new MapSqueeze({ ...SETTINGS, samples }),
    event: drag,
  },
  {
    what: `rollout of ${STEPS} steps`,
    // They are drawn again each time.
    passes: 0,
    make: ({ DeadReckoning }, samples) => new DeadReckoning({ steps: STEPS, step: 1, samples, seed: 1 }),
    event: driveAgain,
  },
];

/**
 * @param {Motion} motion
 * @param {{ kernels: number[], operations: Operations[], seconds: number }} options operations of each of `KINDS`
 * @returns {Promise<{ limits: Limits, roofs: Roof[] }>}
 */
export async function timeRoofline(motion, { kernels, operations, seconds }) {
  const { instance } = await WebAssembly.instantiate(Uint8Array.from(kernels));
  const { memory, arithmetic, division, reading } = /** @type {any} */ (instance.exports);
  memory.grow(Math.ceil((TURNS.reading * OF_A_TURN.reading) / PAGE));
  const machines = KINDS.map(({ make }) => make(motion, SAMPLES));
  const turns = /** @type {Record<string, number[]>} */ (await race(
    {
      arithmetic: () => arithmetic(TURNS.arithmetic),
      division: () => division(TURNS.division),
      reading: () => reading(TURNS.reading),
      ...Object.fromEntries(KINDS.map(({ what, event }, i) => [what, (/** @type {number} */ at) => event(machines[i], at)])),
    },
    { seconds },
  ));
  for (const machine of machines) machine.free();
  const least = (/** @type {keyof typeof TURNS} */ kernel) => (Math.min(...turns[kernel]) * 1e6) / (TURNS[kernel] * OF_A_TURN[kernel]);
  const limits = { operation: least('arithmetic'), division: least('division'), byte: least('reading') };
  const roofs = KINDS.map(({ what, passes }, i) => ({
    what,
    operations: operations[i],
    bytes: passes * DRAW_BYTES,
    arithmetic: operations[i].arithmetic * limits.operation + operations[i].divisions * limits.division,
    memory: passes * DRAW_BYTES * limits.byte,
    measured: spread(turns[what].map((time) => (time * 1e6) / SAMPLES)),
  }));
  return { limits, roofs };
}

/** @param {Roof} roof @returns {number} the share of its limit that a kind of sample reaches */
export function shareOfLimit({ arithmetic, memory, measured }) {
  return Math.max(arithmetic, memory) / measured.median;
}
