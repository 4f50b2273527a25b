/**
 * Helpers for tests of Map Squeeze: a page with the figure, results of its simulation, and map files.
 *
 * @module
 */

import { waitForFrames, showPage, waitUntilReady } from './support.js';

/**
 * @typedef {import('@playwright/test').Page} Page
 * @typedef {import('@playwright/test').Locator} Locator
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

/** Returns the results of the simulation after the next frames. @param {Locator} widget */
export async function readSqueezeResults(widget) {
  await waitForFrames(widget.page());
  const { plan: { bounds, walls }, poses, verdicts, ...others } = await widget.evaluate((element) => {
    const { config, shown, stats, startFree, openPlace, plan, poses, verdicts } = /** @type {MapSqueezeElement} */ (element).simulation;
    return { config, shown, stats, startFree, openPlace, plan, poses, verdicts };
  });
  return { ...others, bounds: [...bounds], walls: [...walls], poses: [...poses], verdicts: [...verdicts] };
}

/** Returns a file to choose. @param {string} name @param {string | Uint8Array} contents @returns {MapFile} */
export function makeMapFile(name, contents) {
  return { name, mimeType: 'application/octet-stream', buffer: Buffer.from(contents) };
}

/** Returns the YAML file of a map. @param {string} name @param {Record<string, unknown>} fields */
export function makeYamlFile(name, fields) {
  return makeMapFile(name, Object.entries(fields).map(([key, value]) => `${key}: ${value}\n`).join(''));
}

/**
 * Returns a PGM image of black and white cells.
 *
 * @param {string} name
 * @param {number} columns
 * @param {number} rows
 * @param {CellTest} isBlack
 */
export function makePgmFile(name, columns, rows, isBlack) {
  const cellBytes = Buffer.from(Array.from({ length: columns * rows }, (_, i) => (isBlack(i % columns, Math.floor(i / columns)) ? 0 : 254)));
  const pgmHeader = `P5\n# by hand\n${columns} ${rows}\n# and another comment\n255\n`;
  return makeMapFile(name, Buffer.concat([Buffer.from(pgmHeader), cellBytes]));
}
