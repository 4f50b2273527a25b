// Comparison of the baseline with the core, for the same samples.

import { Baseline } from './baseline.js';
import { ALPHAS, COLOUR_RAMP, PICTURE_VIEW, commandOfEvent, readDensityPixels, readStatsAndContours } from './scene.js';

/** Maximum difference (m, rad or a fraction) between the baseline and the core, which add numbers in different orders. */
const MAX_DIFFERENCE = 1e-9;

/** Returns the names and values of the statistics in which the core and the baseline differ. @param {import('../www/types.d.ts').Motion} core @param {number} sampleCount */
export function findDifferencesFromCore(core, sampleCount) {
  const simulation = new core.BananaMachine({ alphas: ALPHAS, samples: sampleCount, seed: 11, command: commandOfEvent(0) });
  const baseline = new Baseline(ALPHAS, unitNoiseOf(simulation));
  /** @type {string[]} */
  const differenceTexts = [];
  for (const eventNumber of [0, 30]) {
    const { stats } = readStatsAndContours(simulation, eventNumber);
    const baselineResult = baseline.refresh(commandOfEvent(eventNumber), PICTURE_VIEW, COLOUR_RAMP);
    differenceTexts.push(...findDifferingNumbers(baselineResult.stats, stats));
    const corePixels = readDensityPixels(simulation);
    const differingPixelCount = baselineResult.pixels.filter((baselinePixel, i) => baselinePixel !== corePixels[i]).length;
    if (differingPixelCount > 0) differenceTexts.push(`pixels: ${differingPixelCount} differ`);
  }
  simulation.free();
  return differenceTexts;
}

/**
 * Returns the standard normal noise of a simulation's samples: executed minus given command, divided by the model's standard deviations.
 *
 * @param {import('../www/types.d.ts').BananaMachine} simulation
 */
export function unitNoiseOf({ config: { command: { v, omega }, alphas: [a1, a2, a3, a4, a5, a6] }, executed: executedMotions }) {
  const stdDevs = [[a1, a2], [a3, a4], [a5, a6]].map(([alphaOfSpeed, alphaOfTurnRate]) => Math.sqrt(alphaOfSpeed * v * v + alphaOfTurnRate * omega * omega));
  return executedMotions.map((executedValue, i) => (executedValue - [v, omega, 0][i % 3]) / stdDevs[i % 3]);
}

/** Returns the numbers of the baseline that differ from those of the core, with their paths. @param {any} baselineValue @param {any} coreValue @param {string[]} parentKeys @returns {string[]} */
function findDifferingNumbers(baselineValue, coreValue, ...parentKeys) {
  if (typeof baselineValue === 'object') return Object.entries(baselineValue).flatMap(([memberKey, memberValue]) => findDifferingNumbers(memberValue, coreValue[memberKey], ...parentKeys, memberKey));
  // A comparison with NaN is false, so that a difference of NaN counts as too large.
  return Math.abs(baselineValue - coreValue) <= MAX_DIFFERENCE ? [] : [`${parentKeys.join('.')}: ${baselineValue}, core ${coreValue}`];
}
