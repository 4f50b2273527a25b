/**
 * One event of the slider, for the core and both baselines: targets 1 and 2, and the curve over the number of samples.
 *
 * @module
 */

import * as obvious from './obvious.js';
import { drawNoise } from './random.js';
import { ALPHAS, RAMP, VIEW, command, figures, picture } from './scene.js';
import { ratio, race, spread } from './timing.js';
import { TypedMachine } from './typed.js';

/**
 * @typedef {import('../www/types.d.ts').Motion} Motion
 * @typedef {import('./timing.js').Spread} Spread
 */

/**
 * @typedef {object} Refresh times in ms
 * @property {number} samples
 * @property {Spread} core
 * @property {Spread} figures of that, all but the picture
 * @property {Spread} [put] putImageData of the picture, after it
 * @property {Spread} [typed]
 * @property {Spread} [obvious]
 * @property {Spread} [overTyped] ratios
 * @property {Spread} [overObvious]
 */

/**
 * @param {Motion} motion
 * @param {{ samples: number, baselines: boolean, seconds: number }} options
 * @returns {Promise<Refresh>}
 */
export async function timeRefresh(motion, { samples, baselines, seconds }) {
  const machine = new motion.BananaMachine({ alphas: ALPHAS, samples, seed: 1 });
  /** @type {Record<string, (event: number) => void>} */
  const contenders = {
    core: (event) => {
      figures(machine, event);
      picture(machine);
    },
    figures: (event) => figures(machine, event),
  };
  const context = canvas();
  if (context) {
    const image = new ImageData(new Uint8ClampedArray(picture(machine)), VIEW.columns, VIEW.rows);
    contenders.put = () => context.putImageData(image, 0, 0);
  }
  if (baselines) {
    const typed = new TypedMachine(ALPHAS, drawNoise(samples, 1));
    contenders.typed = (event) => typed.refresh(command(event), VIEW, RAMP);
    contenders.obvious = (event) => {
      obvious.refresh({ command: command(event), alphas: ALPHAS, samples, seed: event }, VIEW, RAMP);
    };
  }
  const turns = await race(contenders, { seconds });
  machine.free();
  const times = Object.fromEntries(Object.entries(turns).map(([name, values]) => [name, spread(values)]));
  const ratios = baselines
    ? { overTyped: ratio(turns.typed, turns.core), overObvious: ratio(turns.obvious, turns.core) }
    : {};
  return /** @type {Refresh} */ (/** @type {unknown} */ ({ samples, ...times, ...ratios }));
}

/** @returns {CanvasRenderingContext2D | null | undefined} of a canvas as large as the picture, in a page */
function canvas() {
  if (typeof document === 'undefined') return undefined;
  const element = document.createElement('canvas');
  element.width = VIEW.columns;
  element.height = VIEW.rows;
  document.body.append(element);
  return element.getContext('2d');
}

/**
 * A new seed: every robot drawn anew, and all figures. Target 3.
 *
 * @param {Motion} motion
 * @param {{ samples: number, seconds: number }} options
 */
export async function timeSeed(motion, { samples, seconds }) {
  const machine = new motion.BananaMachine({ alphas: ALPHAS, samples, seed: 0 });
  const turns = await race(
    {
      seed: (event) => {
        machine.configure({ seed: event + 1 });
        return machine.stats;
      },
    },
    { seconds },
  );
  machine.free();
  return { samples, seed: spread(turns.seed) };
}
