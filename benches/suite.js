// Measurements of the benchmark that run both in Node and in a page.

import { Baseline } from './baseline.js';
import { findDifferencesFromCore, unitNoiseOf } from './check.js';
import { ALPHAS, COLOUR_RAMP, PICTURE_VIEW, commandOfEvent, readDensityPixels, readStatsAndContours } from './scene.js';
import { raceContenders } from './timing.js';

/** @typedef {import('../www/types.d.ts').Motion} Motion */

/**
 * @typedef {object} Timings in ms, one time for each round
 * @property {{ samples: number, core: number[], baseline: number[] }[]} refreshTimings one event of the slider, by core and baseline
 * @property {number[]} calibrationTimes of the example log
 */

/**
 * Measures the core, and the baseline for tasks that the baseline implements.
 *
 * @param {Motion} core
 * @param {object} options
 * @param {boolean} options.isQuickRun
 * @param {{ odometry: string, reference: string }} options.log CSV
 * @returns {Promise<Timings>}
 */
export async function measureCore(core, { isQuickRun, log: logCsv }) {
  const differingStatistics = findDifferencesFromCore(core, 4000);
  if (differingStatistics.length > 0) throw new Error(`The baseline does not compute what the core does:\n${differingStatistics.join('\n')}`);
  const secondsPerRace = isQuickRun ? 0.2 : 2;
  const refreshTimings = [];
  for (const sampleCount of [1e4, 1e5, 1e6]) {
    const simulation = new core.BananaMachine({ alphas: ALPHAS, samples: sampleCount, seed: 1, command: commandOfEvent(0) });
    const baselineSimulation = new Baseline(ALPHAS, unitNoiseOf(simulation));
    const refreshCore = (/** @type {number} */ eventNumber) => {
      readStatsAndContours(simulation, eventNumber);
      readDensityPixels(simulation);
    };
    const refreshBaseline = (/** @type {number} */ eventNumber) => void baselineSimulation.refresh(commandOfEvent(eventNumber), PICTURE_VIEW, COLOUR_RAMP);
    refreshTimings.push({ samples: sampleCount, ...(await raceContenders({ core: refreshCore, baseline: refreshBaseline }, secondsPerRace)) });
    simulation.free();
  }
  const [odometry, reference] = [logCsv.odometry, logCsv.reference].map(parseCSVColumns);
  const { calibration: calibrationTimes } = await raceContenders({ calibration: () => void core.calibrate({ odometry, reference }) }, secondsPerRace);
  return { refreshTimings, calibrationTimes };
}

/** Parses a log in CSV format into columns. @param {string} csvText */
function parseCSVColumns(csvText) {
  const csvRows = csvText.trim().split('\n').slice(1).map((csvLine) => csvLine.split(',').map(Number));
  const [t, x, y, theta] = [0, 1, 2, 3].map((i) => Float64Array.from(csvRows, (csvRow) => csvRow[i]));
  return { t, x, y, theta };
}
