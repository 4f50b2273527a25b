// Helpers for tests of Map Squeeze: a page with the figure, results of its simulation, and map files.

import { waitForFrames, showPage, waitUntilReady } from './support.js';

/**
 * @import { Locator, Page } from '@playwright/test'
 * @typedef {import('../../www/types.d.ts').MapSqueeze} MapSqueeze
 * @typedef {import('../../www/types.d.ts').Motion} Motion
 * @typedef {HTMLElement & { simulation: MapSqueeze, motion: Motion }} MapSqueezeElement
 * @typedef {{ name: string, mimeType: string, buffer: Buffer }} MapFile
 * @typedef {(column: number, row: number) => boolean} CellTest of a column and a row, from the top left
 */

/** Opens a page with a Map Squeeze. @param {Page} page @param {string} [attributes] */
export async function openSqueeze(page, attributes = '') {
  await showPage(page, `<main><h1>Bare</h1><map-squeeze heading-level="2" ${attributes}></map-squeeze></main>`);
  const widget = page.locator('map-squeeze');
  await waitUntilReady(widget);
  return widget;
}

/** Waits for all requested animation frames, and returns the results of the simulation. @param {Locator} widget */
export async function readSqueezeResults(widget) {
  await waitForFrames(widget.page());
  const { plan: { bounds: mapBounds, walls }, poses, verdicts: poseVerdicts, ...otherResults } = await widget.evaluate((element) => {
    const { config: figureConfig, shown: shownCount, stats, startFree, openPlace, plan, poses, verdicts: poseVerdicts } = /** @type {MapSqueezeElement} */ (element).simulation;
    return { config: figureConfig, shown: shownCount, stats, startFree, openPlace, plan, poses, verdicts: poseVerdicts };
  });
  return { ...otherResults, bounds: [...mapBounds], walls: [...walls], poses: [...poses], verdicts: [...poseVerdicts] };
}

/** Returns a file for a file input. @param {string} fileName @param {string | Uint8Array} fileContents @returns {MapFile} */
export function makeMapFile(fileName, fileContents) {
  return { name: fileName, mimeType: 'application/octet-stream', buffer: Buffer.from(fileContents) };
}

/** Returns the YAML file that describes a map. @param {string} fileName @param {Record<string, unknown>} yamlFields */
export function makeYamlFile(fileName, yamlFields) {
  return makeMapFile(fileName, Object.entries(yamlFields).map(([fieldName, fieldValue]) => `${fieldName}: ${fieldValue}\n`).join(''));
}

/**
 * Returns a PGM image of black and white cells.
 *
 * @param {string} fileName
 * @param {number} columnCount
 * @param {number} rowCount
 * @param {CellTest} isBlack
 */
export function makePgmFile(fileName, columnCount, rowCount, isBlack) {
  const cellBytes = Buffer.from(Array.from({ length: columnCount * rowCount }, (_, i) => (isBlack(i % columnCount, Math.floor(i / columnCount)) ? 0 : 254)));
  const pgmHeader = `P5\n# by hand\n${columnCount} ${rowCount}\n# and another comment\n255\n`;
  return makeMapFile(fileName, Buffer.concat([Buffer.from(pgmHeader), cellBytes]));
}
