// Digests of simulation results, read through the JavaScript interface, to the last bit. Node and web pages can run this module.
// tests/native/digest computes the same digests in Rust.

import { presets } from '../../build/settings.js';

/**
 * @typedef {import('../../www/types.d.ts').Motion} Motion
 * @typedef {number | boolean | string | null | ArrayLike<unknown> | object} Encodable
 * @typedef {{ preset?: string, map?: string, bounds?: number[], settings: Record<string, any> }} Configuration
 * @typedef {object} Configurations as configurations.json has them
 * @property {{ columns: number, rows: number }} picture
 * @property {Record<string, string[]>} images lines of PGM files
 * @property {Record<string, any>} maps
 * @property {Record<string, { bounds: number[], configurations: Record<string, Configuration> }>} widgets
 */

/** Bits that replace those of every NaN, because the sign and payload of a computed NaN are not specified. */
const NAN_BITS = 0x7ff8_0000_0000_0000n;

/** Returns the settings of a widget's preset, or an empty object if the configuration has no preset. @param {keyof typeof presets} widgetTag @param {string} [presetName] @returns {Record<string, any>} */
const presetSettingsOf = (widgetTag, presetName) => presets[widgetTag].find(({ name }) => name === presetName)?.settings ?? {};

/**
 * Functions that return the results of each widget's simulation, divided into named parts.
 * @type {Record<string, (motion: Motion, document: Configurations, configuration: Configuration) => Record<string, Encodable>>}
 */
export const resultFunctions = {
  'banana-machine'({ BananaMachine, commandReaching }, configurationFile, { preset, bounds = configurationFile.widgets['banana-machine'].bounds, settings }) {
    const { command: presetCommand } = presetSettingsOf('banana-machine', preset);
    const simulation = new BananaMachine({ command: presetCommand, ...settings });
    const { shown, config: { command } } = simulation;
    const { columns, rows } = configurationFile.picture;
    const readPictureOf = (/** @type {number} */ morph) =>
      simulation.picture(morph, bounds, columns, rows, createRamps(1)).slice();
    // The standard error of the area ratio is left out, because the native digest does not contain it.
    const { areaRatioError: _, ...stats } = simulation.stats;
    const simulationResults = {
      poses: simulation.poses,
      twists: simulation.twists,
      executed: simulation.executed,
      statistics: { shown, chartHolds: simulation.chartHolds, reading: simulation.reading, stats },
      table: simulation.table,
      contours: simulation.contours,
      curve: simulation.skewCurve(-3, 3, 25),
      samples: {
        inspected: listMultiplesBelow(shown, 501).map((sampleIndex) => simulation.inspect(sampleIndex)).map((inspectedSample) => ({ ...inspectedSample, heading: inspectedSample.pose[2] })),
        nearest: MORPH_ENDS.map((morph) => simulation.nearest(morph, 0.9, 0.2, 0.5, 0.3)),
        reaching: [[1, 0.5], [-0.3, 0.8], [0, 0], [2, -1.5]].map(([x, y]) => commandReaching(x, y, command)),
      },
      densities: MORPH_ENDS.map((morph) => simulation.density(morph, bounds, columns, rows)),
      plane: readPictureOf(0),
      twist: readPictureOf(1),
    };
    simulation.free();
    return simulationResults;
  },

  'map-squeeze'({ MapSqueeze }, configurationFile, { preset, map, bounds = configurationFile.widgets['map-squeeze'].bounds, settings }) {
    const { start } = presetSettingsOf('map-squeeze', preset);
    const simulation = new MapSqueeze({ start, ...settings });
    const { plan, description, image } = map === undefined ? {} : configurationFile.maps[map];
    if (plan) simulation.setPlan(plan);
    if (description) simulation.setGrid(description, new TextEncoder().encode(`${configurationFile.images[image].join('\n')}\n`));
    const { shown, startFree, openPlace, noise, stats } = simulation;
    const { columns, rows } = configurationFile.picture;
    const simulationResults = {
      map: { ...simulation.plan, grid: simulation.grid },
      poses: simulation.poses,
      verdicts: simulation.verdicts,
      statistics: { shown, startFree, openPlace, noise, stats },
      paths: {
        commanded: simulation.commanded,
        driven: listMultiplesBelow(shown, 101).map((sampleIndex) => simulation.path(sampleIndex)),
        nearest: simulation.nearest(2.1, 2.4, 0.5),
      },
      trials: SAMPLER_NAMES.map((sampler) => {
        try {
          return simulation.trial(sampler, 4, 50);
        } catch {
          // `trial` throws if the robot cannot move.
          return null;
        }
      }),
      picture: simulation.picture(bounds, columns, rows, createRamps(3)).slice(),
    };
    simulation.free();
    return simulationResults;
  },

  'arc-anatomy'({ ArcAnatomy }, configurationFile, { preset, bounds = configurationFile.widgets['arc-anatomy'].bounds, settings }) {
    const { command, next } = presetSettingsOf('arc-anatomy', preset);
    const simulation = new ArcAnatomy({ command, next, ...settings });
    const simulationResults = {
      statistics: simulation.stats,
      table: simulation.table,
      paths: { ...simulation.paths, underway: [0, 0.3, 1].map((pathFraction) => simulation.underway(pathFraction)) },
      surface: simulation.surface(bounds),
      forms: ArcAnatomy.formErrors(),
    };
    simulation.free();
    return simulationResults;
  },

  'dead-reckoning'({ DeadReckoning }, _, { preset, settings }) {
    const { command, steps, alphas } = presetSettingsOf('dead-reckoning', preset);
    const simulation = new DeadReckoning({ command, steps, alphas, ...settings });
    const { shown, config, headingNoise, stats } = simulation;
    // Poses after the first step, of the robots that the picture shows.
    const robotIndices = Array.from({ length: simulation.poses.length / 3 }, (_, robotIndex) => robotIndex);
    const firstPoses = Float64Array.from(robotIndices.flatMap((index) => [...simulation.rollout(index).subarray(0, 3)]));
    const simulationResults = {
      statistics: { shown, headingNoise, stats },
      steps: {
        ratios: simulation.ratios, predicted: simulation.predicted, measured: simulation.measured, relativeErrors: simulation.relativeErrors,
      },
      ways: { commanded: simulation.commanded, nominal: simulation.nominal },
      poses: { poses: simulation.poses, twists: simulation.twists, first: firstPoses },
      rollouts: {
        driven: listMultiplesBelow(shown, 501).map((index) => simulation.rollout(index)),
        nearest: simulation.nearest(config.command.v * config.command.dt * config.step, 0.1, 0.5),
      },
      outlines: simulation.outlines,
      straight: simulation.straightGrowth,
    };
    simulation.free();
    return simulationResults;
  },

  'alpha-calibrator'({ AlphaCalibrator }, _, { settings }) {
    const simulation = new AlphaCalibrator(settings);
    const { stats: { alphas, intervals, systematicErrors, referenceNoise, persistence, logLikelihood, diagnostics, recommended }, legs, truth } = simulation;
    const { checks, windows } = diagnostics;
    const simulationResults = {
      alphas: { alphas, intervals, logLikelihood },
      systematic: Object.values(systematicErrors),
      noise: { stds: Object.values(referenceNoise), persistence },
      diagnostics: {
        checks: checks.map(({ value, expected, passed }) => ({ value, expected, passed })),
        windows,
        recommended: recommended && { alphas: recommended.alphas, inflation: recommended.inflation },
      },
      legs,
      truth,
      panels: ['turn', 'distance'].map((regressor) => simulation.panels(/** @type {'turn' | 'distance'} */ (regressor))),
      leg: simulation.leg(5),
      nearest: simulation.nearest(0.5, 1, 3),
    };
    // The poses at the starts of the legs are given to the calibrator as a second log.
    const { count, times, odometry, reference } = legs;
    const columnOf = (/** @type {Float64Array} */ flatArray, /** @type {number} */ itemSize, /** @type {number} */ columnOffset) =>
      Float64Array.from({ length: count }, (_, leg) => flatArray[itemSize * leg + columnOffset]);
    const legPoseColumnsOf = (/** @type {Float64Array} */ legPoses) => ({ t: columnOf(times, 2, 0), x: columnOf(legPoses, 6, 0), y: columnOf(legPoses, 6, 1), theta: columnOf(legPoses, 6, 2) });
    if (count > 1) simulation.setLog(legPoseColumnsOf(odometry), legPoseColumnsOf(reference));
    const resultsOfLog = [simulation.fits, simulation.stats.alphas, simulation.stats.intervals];
    simulation.free();
    return { ...simulationResults, log: resultsOfLog };
  },

  'odometry-decomposer'({ OdometryDecomposer }, _, { preset, settings }) {
    const { from, to } = presetSettingsOf('odometry-decomposer', preset);
    const simulation = new OdometryDecomposer({ from, to, ...settings });
    const { shown, stats, poses, linkage, robot, rules, drifted } = simulation;
    const simulationResults = {
      poses,
      linkages: { linkage, ghosts: simulation.ghosts.subarray(0, 9 * 12), robot },
      rules: rules.map(({ legs, deviations, crossTrack, heading }) => ({ legs, deviations, crossTrack, heading })),
      statistics: { shown, stats, nearest: simulation.nearest(1, 0.8, 0.5) },
      curve: simulation.curve(3, 31),
      drifted,
    };
    simulation.free();
    return simulationResults;
  },
};

/** Stages of a cloud’s deformation (morph): positions in the plane, and exponential coordinates. */
const MORPH_ENDS = [0, 1];
const SAMPLER_NAMES = /** @type {const} */ (['endpoint', 'whole-arc', 'sub-stepped']);

/** Returns the multiples of `indexStep` below `count`. @type {(count: number, indexStep: number) => number[]} */
const listMultiplesBelow = (count, indexStep) => Array.from({ length: Math.ceil(count / indexStep) }, (_, i) => i * indexStep);

/** Returns colour ramps whose colours all differ, equal to those of configuration.rs. @param {number} count number of ramps */
const createRamps = (count) => Uint8Array.from({ length: 1024 * count }, (_, byteOffset) => {
  const i = (byteOffset >> 2) & 255;
  return [i, 255 - i, 85 * (byteOffset >> 10), 255][byteOffset & 3];
});

/** Returns true for arrays and typed arrays. @param {any} value @returns {value is ArrayLike<unknown>} */
const isList = (value) => Array.isArray(value) || ArrayBuffer.isView(value);

/**
 * Appends a value to a list of numbers. A list becomes its length and its items. A string becomes the list of its character codes. An
 * object becomes its values in order, and null becomes NaN.
 *
 * @param {Encodable} value
 * @param {number[]} encodedNumbers
 */
function appendNumbers(value, encodedNumbers) {
  if (value === null) encodedNumbers.push(NaN);
  else if (typeof value === 'number' || typeof value === 'boolean') encodedNumbers.push(Number(value));
  else if (typeof value === 'string') appendNumbers(Uint16Array.from(value, (_, i) => value.charCodeAt(i)), encodedNumbers);
  else if (typeof value !== 'object') throw new TypeError(`${typeof value} cannot be encoded.`);
  else if (isList(value)) {
    encodedNumbers.push(value.length);
    for (let i = 0; i < value.length; i++) appendNumbers(/** @type {any} */ (value)[i], encodedNumbers);
  } else for (const memberValue of Object.values(value)) appendNumbers(memberValue, encodedNumbers);
}

/** Returns a hash of every bit of a value. @param {Encodable} value */
export async function computeHash(value) {
  /** @type {number[]} */
  const encodedNumbers = [];
  appendNumbers(value, encodedNumbers);
  const dataView = new DataView(new ArrayBuffer(8 * encodedNumbers.length));
  encodedNumbers.forEach((encodedNumber, i) => {
    if (Number.isNaN(encodedNumber)) dataView.setBigUint64(8 * i, NAN_BITS, true);
    else dataView.setFloat64(8 * i, encodedNumber, true);
  });
  return toHex(await crypto.subtle.digest('SHA-256', dataView)).slice(0, 16);
}

/** Returns bytes as hexadecimal digits. @param {ArrayBuffer} hashBytes */
const toHex = (hashBytes) => Array.from(new Uint8Array(hashBytes), (byte) => byte.toString(16).padStart(2, '0')).join('');

/**
 * Computes the digest: the text that golden.txt must equal, or only its lines about `widgetTags`.
 *
 * @param {Motion} core
 * @param {Configurations} configurationFile
 * @param {string[]} [widgetTags] of these widgets
 */
export async function computeDigest(core, configurationFile, widgetTags = Object.keys(configurationFile.widgets)) {
  const digestLines = [];
  for (const widgetTag of widgetTags) {
    for (const [configurationName, configuration] of Object.entries(configurationFile.widgets[widgetTag].configurations)) {
      const resultParts = Object.entries(resultFunctions[widgetTag](core, configurationFile, configuration));
      const partHashes = await Promise.all(resultParts.map(async ([partName, partResult]) => ` ${partName}:${await computeHash(partResult)}`));
      digestLines.push(`${widgetTag}/${configurationName}${partHashes.join('')}\n`);
    }
  }
  return digestLines.sort().join('');
}

/** Returns a line for each configuration whose digest differs. @param {string} goldenText @param {string} computedText */
export function findDifferences(goldenText, computedText) {
  const hashesByNameOf = (/** @type {string} */ digestText) =>
    new Map(digestText.trimEnd().split('\n').map((digestLine) => /** @type {[string, string[]]} */ ([digestLine.split(' ')[0], digestLine.split(' ').slice(1)])));
  const [expectedByName, computedByName] = [hashesByNameOf(goldenText), hashesByNameOf(computedText)];
  const configurationNames = [...new Set([...expectedByName.keys(), ...computedByName.keys()])];
  return configurationNames.flatMap((name) => {
    const [expectedHashes, computedHashes] = [expectedByName.get(name), computedByName.get(name)];
    if (expectedHashes === undefined) return [`${name} is not in golden.txt`];
    if (computedHashes === undefined) return [`${name} is gone`];
    const changedParts = computedHashes.filter((partHash) => !expectedHashes.includes(partHash)).map((partHash) => partHash.split(':')[0]);
    return changedParts.length > 0 || expectedHashes.length !== computedHashes.length ? [`${name}: ${changedParts.join(', ')}`] : [];
  });
}
