/**
 * Everything that is measured in Node and in a page alike.
 *
 * @module
 */

import { checkClouds, checkDraws } from './checks.js';
import { bytesPerPose, growth, watchMemory } from './memory.js';
import { timeReckoning } from './reckoning.js';
import { timeRefresh, timeSeed } from './refresh.js';
import { timeRoofline } from './roofline.js';
import { timeSqueeze, timeWalls } from './squeeze.js';

/**
 * @typedef {object} Measured
 * @property {import('./refresh.js').Refresh[]} refresh by the number of samples
 * @property {Awaited<ReturnType<typeof timeSeed>>} seed
 * @property {Awaited<ReturnType<typeof timeSqueeze>>} squeeze
 * @property {Awaited<ReturnType<typeof timeWalls>>} walls
 * @property {Awaited<ReturnType<typeof timeReckoning>>} reckoning
 * @property {import('./memory.js').Memory} memory
 * @property {Awaited<ReturnType<typeof timeRoofline>>} roofline
 */

/**
 * @typedef {object} Counted in Node, for both
 * @property {number[]} kernels the bytes of roofline.wat's module
 * @property {import('./operations.js').Operations[]} operations of each kind of sample
 */

/** The counts of the curve, as far as the core goes. */
const COUNTS = [1e3, 1e4, 1e5, 1e6, 1e7];
/** Beyond, an array of objects takes gigabytes. */
const BASELINES_UP_TO = 1e6;
const WALLS = [10, 100, 1000, 10_000];

/**
 * @param {object} options
 * @param {() => Promise<import('../www/types.d.ts').Motion>} options.load of a core that has not been loaded before
 * @param {() => number | Promise<number>} options.heap collects garbage and returns the bytes left
 * @param {Counted} options.counted
 * @param {boolean} options.quick
 * @param {(text: string) => void} options.progress
 * @returns {Promise<Measured>}
 */
export async function measure({ load, heap, counted, quick, progress }) {
  const { result: motion, memory } = await watchMemory(load);
  // First: what a large cloud leaves free would hide what events leave behind.
  progress('memory');
  const grown = await growth(motion, memory, { events: quick ? 3000 : 100_000, heap });
  const perPose = bytesPerPose(motion, memory);

  progress('the baselines against the core');
  const wrong = [...checkDraws(motion, 4000), ...checkClouds(motion, quick ? 20_000 : 1_000_000)];
  if (wrong.length > 0) throw new Error(`The baselines do not compute what the core does:\n${wrong.join('\n')}`);

  const seconds = quick ? 0.2 : 1.5;
  // In a hurry, only those that targets are set for.
  const counts = quick ? [1e5, 1e6] : COUNTS.filter((count) => count <= motion.BananaMachine.maxSamples);
  const refresh = [];
  for (const samples of counts) {
    progress(`${samples.toLocaleString('en')} samples`);
    const baselines = samples <= (quick ? 1e5 : BASELINES_UP_TO);
    refresh.push(await timeRefresh(motion, { samples, baselines, seconds: samples === 1e6 ? 2 * seconds : seconds }));
  }

  progress('new seeds');
  const seed = await timeSeed(motion, { samples: 1e5, seconds });
  progress('Map Squeeze');
  const squeeze = await timeSqueeze(motion, { samples: 1e5, seconds });
  const walls = await timeWalls(motion, { samples: quick ? 1000 : 5000, seconds, counts: quick ? [10, 10_000] : WALLS });
  progress('Dead Reckoning');
  const reckoning = await timeReckoning(motion, { rollouts: 50_000, seconds });
  progress('roofline');
  const roofline = await timeRoofline(motion, { ...counted, seconds });
  return { refresh, seed, squeeze, walls, reckoning, roofline, memory: { bytesPerPose: perPose, ...grown } };
}
