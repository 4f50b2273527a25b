// Helpers of the tests of the Alpha Calibrator: the element on its page, its parts, and logs.

import { readFileSync } from 'node:fs';
import { odometryMessageOf, poseOf, recordingOf, stampOf } from '../mcap.js';
import { mountFigure, waitUntilSettled } from './support.js';

/**
 * @import { Locator, Page } from '@playwright/test'
 * @typedef {import('../../www/types.d.ts').AlphaCalibrator} Simulation
 * @typedef {HTMLElement & { simulation: Simulation, log: import('../../www/types.d.ts').CalibrationLog | null, settings: any, logService: { isBusy: boolean } }} AlphaCalibratorElement
 */

/** Opens a page with the figure, and waits until its log is fitted. @param {Page} page @param {string} [attributes] */
export async function openCalibrator(page, attributes) {
  const widget = await mountFigure(page, 'alpha-calibrator', {
    attributes, scriptHtml: ['motion-widgets', 'de'].map((scriptName) => `<script type="module" src="/${scriptName}.js"></script>`).join(''),
  });
  await waitUntilSettled(widget);
  return widget;
}

export const captionOf = (/** @type {Locator} */ widget) => widget.locator('p[part=caption]');
export const alphaRowsOf = (/** @type {Locator} */ widget) => widget.locator('.alphas tbody tr');
export const findFoldedGroup = (/** @type {Locator} */ widget, /** @type {string} */ groupName) => widget.locator('.folded fieldset', { has: widget.page().locator('> legend', { hasText: groupName }) });
export const readStats = (/** @type {Locator} */ widget) => widget.evaluate((element) => /** @type {AlphaCalibratorElement} */ (element).simulation.stats);

/** Returns two tables of the simulated drive, in the form of a user's files. @param {Locator} widget */
export const simulatedTablesOf = (widget) =>
  widget.evaluate((element) => {
    const { legs } = /** @type {AlphaCalibratorElement} */ (element).simulation;
    const poseTableOf = (/** @type {Float64Array} */ legPoses) =>
      ['t,x,y,yaw', ...Array.from({ length: legs.count }, (_, legIndex) => [legs.times[2 * legIndex], ...legPoses.subarray(6 * legIndex, 6 * legIndex + 3)].join(','))].join('\n');
    return { odometry: poseTableOf(legs.odometry), reference: poseTableOf(legs.reference) };
  });

/** Chooses a recording in the file input. @param {Locator} widget @param {string} fileName @param {Buffer} recordingBytes */
export const chooseRecording = (widget, fileName, recordingBytes) =>
  widget.locator('#log-files').setInputFiles({ name: fileName, mimeType: 'application/octet-stream', buffer: recordingBytes });

/** Chooses tables in the file input. @param {Locator} widget @param {Record<string, string>} textByName */
export async function chooseTables(widget, textByName) {
  await widget.locator('#log-files').setInputFiles(Object.entries(textByName).map(([fileName, tableText]) => ({ name: fileName, mimeType: 'text/csv', buffer: Buffer.from(tableText) })));
}

/** Returns a table of the example log. @param {'odometry' | 'reference'} logRole */
export const readExampleTable = (logRole) => readFileSync(new URL(`../../examples/calibration/${logRole}.csv`, import.meta.url), 'utf8');

/** Returns t, x, y and yaw of each row of a table of the example log. @param {'odometry' | 'reference'} logRole */
export const exampleRowsOf = (logRole) => readExampleTable(logRole).trim().split('\n').slice(1).map((csvLine) => csvLine.split(',').map(Number));

/** Returns the example log as a recording. @param {string[]} referenceTopics names of the topics with the poses of the reference */
export async function createExampleRecording(referenceTopics) {
  const referenceMessages = referenceTopics.flatMap((referenceTopic) => exampleRowsOf('reference').map(([t, x, y, yaw]) => ({
    topic: referenceTopic, type: 'geometry_msgs/msg/PoseStamped', t, message: { header: { stamp: stampOf(t), frame_id: 'map' }, pose: poseOf(x, y, yaw) },
  })));
  const odometryMessages = exampleRowsOf('odometry').map(([t, x, y, yaw]) => ({ topic: '/odom', type: 'nav_msgs/msg/Odometry', t, message: odometryMessageOf(t, x, y, yaw) }));
  return recordingOf([...odometryMessages, ...referenceMessages].sort((messageA, messageB) => messageA.t - messageB.t), { compression: 'zstd', chunkSize: 100_000 });
}
