/**
 * Measurements that run in Node and in a page alike.
 *
 * @module
 */

import { Baseline } from './baseline.js';
import { differences, noiseOf } from './check.js';
import { ALPHAS, RAMP, VIEW, command, figures, picture } from './scene.js';
import { race } from './timing.js';

/** @typedef {import('../www/types.d.ts').Motion} Motion */

/**
 * @typedef {object} Measured ms, turn by turn
 * @property {{ samples: number, core: number[], baseline: number[] }[]} refresh one event of the slider, by core and baseline
 * @property {number[]} calibration of the example log
 */

/**
 * @param {Motion} motion
 * @param {object} options
 * @param {boolean} options.quick
 * @param {{ odometry: string, reference: string }} options.log CSV
 * @returns {Promise<Measured>}
 */
export async function measure(motion, { quick, log }) {
  const wrong = differences(motion, 4000);
  if (wrong.length > 0) throw new Error(`The baseline does not compute what the core does:\n${wrong.join('\n')}`);
  const seconds = quick ? 0.2 : 2;
  const refresh = [];
  for (const samples of [1e4, 1e5, 1e6]) {
    const machine = new motion.BananaMachine({ alphas: ALPHAS, samples, seed: 1, command: command(0) });
    const contender = new Baseline(ALPHAS, noiseOf(machine));
    const core = (/** @type {number} */ event) => {
      figures(machine, event);
      picture(machine);
    };
    const baseline = (/** @type {number} */ event) => void contender.refresh(command(event), VIEW, RAMP);
    refresh.push({ samples, ...(await race({ core, baseline }, seconds)) });
    machine.free();
  }
  const [odometry, reference] = [log.odometry, log.reference].map(columns);
  const { calibration } = await race({ calibration: () => void motion.calibrate({ odometry, reference }) }, seconds);
  return { refresh, calibration };
}

/** @param {string} csv */
function columns(csv) {
  const rows = csv.trim().split('\n').slice(1).map((line) => line.split(',').map(Number));
  const [t, x, y, theta] = [0, 1, 2, 3].map((i) => Float64Array.from(rows, (row) => row[i]));
  return { t, x, y, theta };
}
