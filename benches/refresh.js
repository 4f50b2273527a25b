/**
 * One event of the slider, by the core and by the baseline.
 *
 * @module
 */

import { Baseline } from './baseline.js';
import { noiseOf } from './check.js';
import { ALPHAS, RAMP, VIEW, command, figures, picture } from './scene.js';
import { quartiles, race, ratio } from './timing.js';

/**
 * @typedef {import('./timing.js').Quartiles} Quartiles
 *
 * @typedef {object} Refresh times in ms
 * @property {number} samples
 * @property {Quartiles} core
 * @property {Quartiles} baseline
 * @property {Quartiles} times time of the baseline over that of the core, turn by turn
 */

/**
 * @param {import('../www/types.d.ts').Motion} motion
 * @param {{ samples: number, seconds: number }} options
 * @returns {Promise<Refresh>}
 */
export async function timeRefresh(motion, { samples, seconds }) {
  const machine = new motion.BananaMachine({ alphas: ALPHAS, samples, seed: 1, command: command(0) });
  const contender = new Baseline(ALPHAS, noiseOf(machine));
  const { core, baseline } = await race(
    {
      core: (event) => {
        figures(machine, event);
        picture(machine);
      },
      baseline: (event) => void contender.refresh(command(event), VIEW, RAMP),
    },
    { seconds },
  );
  machine.free();
  return { samples, core: quartiles(core), baseline: quartiles(baseline), times: ratio(baseline, core) };
}
