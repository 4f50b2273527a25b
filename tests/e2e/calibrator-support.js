/**
 * Helpers of the tests of the Alpha Calibrator: the element on its page, its parts, and logs.
 *
 * @module
 */

import { readFileSync } from 'node:fs';
import { odometryMessageOf, poseOf, recordingOf, stampOf } from '../mcap.js';
import { mountFigure, waitUntilSettled } from './support.js';

/**
 * @typedef {import('@playwright/test').Page} Page
 * @typedef {import('@playwright/test').Locator} Locator
 * @typedef {import('../../www/types.d.ts').AlphaCalibrator} Simulation
 * @typedef {HTMLElement & { simulation: Simulation, log: import('../../www/types.d.ts').CalibrationLog | null, settings: any, service: { isBusy: boolean } }} AlphaCalibratorElement
 */

/** Opens a page with the figure, and waits until its log is fitted. @param {Page} page @param {string} [attributes] */
export async function openCalibrator(page, attributes) {
  const widget = await mountFigure(page, 'alpha-calibrator', {
    attributes, script: ['motion-widgets', 'de'].map((name) => `<script type="module" src="/${name}.js"></script>`).join(''),
  });
  await waitUntilSettled(widget);
  return widget;
}

export const captionOf = (/** @type {Locator} */ widget) => widget.locator('p[part=caption]');
export const alphaRowsOf = (/** @type {Locator} */ widget) => widget.locator('.alphas tbody tr');
export const findFoldedGroup = (/** @type {Locator} */ widget, /** @type {string} */ name) => widget.locator('.folded fieldset', { has: widget.page().locator('> legend', { hasText: name }) });
export const readStats = (/** @type {Locator} */ widget) => widget.evaluate((element) => /** @type {AlphaCalibratorElement} */ (element).simulation.stats);

/** Returns two tables of the simulated drive, as a user's files have them. @param {Locator} widget */
export const simulatedTablesOf = (widget) =>
  widget.evaluate((element) => {
    const { legs } = /** @type {AlphaCalibratorElement} */ (element).simulation;
    const tableOfPoses = (/** @type {Float64Array} */ poses) =>
      ['t,x,y,yaw', ...Array.from({ length: legs.count }, (_, leg) => [legs.times[2 * leg], ...poses.subarray(6 * leg, 6 * leg + 3)].join(','))].join('\n');
    return { odometry: tableOfPoses(legs.odometry), reference: tableOfPoses(legs.reference) };
  });

/** Chooses a recording, as a user does. @param {Locator} widget @param {string} name @param {Buffer} buffer */
export const chooseRecording = (widget, name, buffer) =>
  widget.locator('#log-files').setInputFiles({ name, mimeType: 'application/octet-stream', buffer });

/** Chooses tables, as a user does. @param {Locator} widget @param {Record<string, string>} files */
export async function chooseTables(widget, files) {
  await widget.locator('#log-files').setInputFiles(Object.entries(files).map(([name, text]) => ({ name, mimeType: 'text/csv', buffer: Buffer.from(text) })));
}

/** Returns a table of the example log. @param {'odometry' | 'reference'} name */
export const readExampleTable = (name) => readFileSync(new URL(`../../examples/calibration/${name}.csv`, import.meta.url), 'utf8');

/** Returns t, x, y and yaw of each row of a table of the example log. @param {'odometry' | 'reference'} name */
export const exampleRowsOf = (name) => readExampleTable(name).trim().split('\n').slice(1).map((line) => line.split(',').map(Number));

/** Returns the example log as a recording. @param {string[]} topics that have the poses of the reference */
export async function exampleRecordingWith(topics) {
  const referenceMessages = topics.flatMap((topic) => exampleRowsOf('reference').map(([t, x, y, yaw]) => ({
    topic, type: 'geometry_msgs/msg/PoseStamped', t, message: { header: { stamp: stampOf(t), frame_id: 'map' }, pose: poseOf(x, y, yaw) },
  })));
  const odometryMessages = exampleRowsOf('odometry').map(([t, x, y, yaw]) => ({ topic: '/odom', type: 'nav_msgs/msg/Odometry', t, message: odometryMessageOf(t, x, y, yaw) }));
  return recordingOf([...odometryMessages, ...referenceMessages].sort((one, other) => one.t - other.t), { compression: 'zstd', chunkSize: 100_000 });
}
