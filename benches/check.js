/**
 * Comparison of the baseline with the core on the core's own samples.
 *
 * @module
 */

import { Baseline } from './baseline.js';
import { ALPHAS, COLOUR_RAMP, PICTURE_VIEW, commandAt, readDensityPixels, readStatsAndContours } from './scene.js';

/** Maximum difference (m, rad or a fraction) between both implementations, which add numbers in different orders. */
const MAX_DIFFERENCE = 1e-9;

/** Returns the names and values of the statistics in which the core and the baseline differ. @param {import('../www/types.d.ts').Motion} motion @param {number} samples */
export function differencesFromCore(motion, samples) {
  const simulation = new motion.BananaMachine({ alphas: ALPHAS, samples, seed: 11, command: commandAt(0) });
  const baseline = new Baseline(ALPHAS, unitNoiseOf(simulation));
  /** @type {string[]} */
  const differenceTexts = [];
  for (const event of [0, 30]) {
    const { stats } = readStatsAndContours(simulation, event);
    const baselineResult = baseline.refresh(commandAt(event), PICTURE_VIEW, COLOUR_RAMP);
    for (const [name, value] of numbersWithPaths(baselineResult.stats)) {
      const coreValue = name.split('.').reduce((part, key) => part[key], /** @type {any} */ (stats));
      // The negation also reports NaN.
      if (!(Math.abs(value - coreValue) <= MAX_DIFFERENCE)) differenceTexts.push(`${name}: ${value}, core ${coreValue}`);
    }
    const pixels = readDensityPixels(simulation);
    const differingPixelCount = baselineResult.pixels.filter((value, i) => value !== pixels[i]).length;
    if (differingPixelCount > 0) differenceTexts.push(`pixels: ${differingPixelCount} differ`);
  }
  simulation.free();
  return differenceTexts;
}

/**
 * Returns the standard normal noise of a simulation's samples: executed command minus given command, over the deviations of the model.
 *
 * @param {import('../www/types.d.ts').BananaMachine} simulation
 */
export function unitNoiseOf({ config: { command: { v, omega }, alphas: [a1, a2, a3, a4, a5, a6] }, executed }) {
  const stdDevs = [[a1, a2], [a3, a4], [a5, a6]].map(([byV, byOmega]) => Math.sqrt(byV * v * v + byOmega * omega * omega));
  return executed.map((value, i) => (value - [v, omega, 0][i % 3]) / stdDevs[i % 3]);
}

/** Returns every number of an object with its path. @param {object | number} value @param {string[]} path @returns {[string, number][]} */
function numbersWithPaths(value, ...path) {
  if (typeof value === 'number') return [[path.join('.'), value]];
  return Object.entries(value).flatMap(([key, member]) => numbersWithPaths(member, ...path, key));
}
