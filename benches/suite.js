/**
 * Measurements that run in Node and in a page alike.
 *
 * @module
 */

import { differences } from './check.js';
import { timeRefresh } from './refresh.js';
import { race, quartiles } from './timing.js';

/** @typedef {import('../www/types.d.ts').Motion} Motion */

/**
 * @typedef {object} Measured
 * @property {import('./refresh.js').Refresh[]} refresh by the number of samples
 * @property {import('./timing.js').Quartiles} calibration of the example log, ms
 */

/**
 * @param {Motion} motion
 * @param {object} options
 * @param {boolean} options.quick
 * @param {{ odometry: string, reference: string }} options.log CSV
 * @param {(text: string) => void} options.progress
 * @returns {Promise<Measured>}
 */
export async function measure(motion, { quick, log, progress }) {
  progress('comparison of the baseline with the core');
  const wrong = differences(motion, 4000);
  if (wrong.length > 0) throw new Error(`The baseline does not compute what the core does:\n${wrong.join('\n')}`);
  const seconds = quick ? 0.2 : 2;
  const refresh = [];
  for (const samples of [1e4, 1e5, 1e6]) {
    progress(`${samples.toLocaleString('en')} samples`);
    refresh.push(await timeRefresh(motion, { samples, seconds }));
  }
  progress('calibration');
  const [odometry, reference] = [log.odometry, log.reference].map(columns);
  const { calibration } = await race({ calibration: () => void motion.calibrate({ odometry, reference }) }, { seconds });
  return { refresh, calibration: quartiles(calibration) };
}

/** @param {string} csv */
function columns(csv) {
  const rows = csv.trim().split('\n').slice(1).map((line) => line.split(',').map(Number));
  const [t, x, y, theta] = [0, 1, 2, 3].map((i) => Float64Array.from(rows, (row) => row[i]));
  return { t, x, y, theta };
}
