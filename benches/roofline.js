/**
 * How near the core is to what the machine can do: the limits of its arithmetic, of its memory and of whatever else a sample
 * takes, measured by kernels that do nothing else, and what a sample of each kind would take at these limits.
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
 * @typedef {Record<keyof typeof KERNELS, number>} Limits the shortest times that one operation of each kernel took, ns: what
 *   disturbs only ever makes them longer
 *
 * @typedef {object} Roof of one kind of sample, ns
 * @property {string} what
 * @property {Operations} operations
 * @property {number} arithmetic at the limit, with quotients and roots
 * @property {number} memory its draws, read in a row as often as they are read
 * @property {Record<Rest, number>} rest what else it does, each at its own limit
 * @property {Spread} measured
 *
 * @typedef {(typeof REST)[number]} Rest
 */

const SAMPLES = 50_000;
/** Of three draws. */
const DRAW_BYTES = 24;
const PAGE = 65_536;
/** How often the loop of each runs, and what a turn of it does: `reading` once over the draws of a million samples. */
export const KERNELS = {
  arithmetic: { turns: 200_000, each: 12 },
  divisions: { turns: 100_000, each: 6 },
  choices: { turns: 100_000, each: 12 },
  memory: { turns: 200_000, each: 12 },
  whole: { turns: 200_000, each: 12 },
  reading: { turns: (1e6 * DRAW_BYTES) / 64, each: 64 },
};

/** What of a sample's operations is no arithmetic, and has a limit of its own. */
export const REST = /** @type {const} */ (['choices', 'memory', 'whole']);

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
  const { pages, ...run } = /** @type {any} */ (instance.exports);
  pages.grow(Math.ceil((1e6 * DRAW_BYTES) / PAGE));
  const machines = KINDS.map(({ make }) => make(motion, SAMPLES));
  const times = /** @type {Record<string, number[]>} */ (await race(
    {
      ...Object.fromEntries(Object.entries(KERNELS).map(([kernel, { turns }]) => [kernel, () => run[kernel](turns)])),
      ...Object.fromEntries(KINDS.map(({ what, event }, i) => [what, (/** @type {number} */ at) => event(machines[i], at)])),
    },
    { seconds },
  ));
  for (const machine of machines) machine.free();
  const limits = /** @type {Limits} */ (
    Object.fromEntries(Object.entries(KERNELS).map(([kernel, { turns, each }]) => [kernel, (Math.min(...times[kernel]) * 1e6) / (turns * each)]))
  );
  const roofs = KINDS.map(({ what, passes }, i) => ({
    what,
    operations: operations[i],
    arithmetic: operations[i].arithmetic * limits.arithmetic + operations[i].divisions * limits.divisions,
    memory: passes * DRAW_BYTES * limits.reading,
    rest: /** @type {Record<Rest, number>} */ (Object.fromEntries(REST.map((kind) => [kind, operations[i][kind] * limits[kind]]))),
    measured: spread(times[what].map((time) => (time * 1e6) / SAMPLES)),
  }));
  return { limits, roofs };
}

/** @param {Roof} roof @returns {number} the share of its limit that a kind of sample reaches */
export function shareOfLimit({ arithmetic, memory, measured }) {
  return Math.max(arithmetic, memory) / measured.median;
}
