/**
 * Helpers for tests of Map Squeeze: a page with the figure, readings of its machine, and map files.
 *
 * @module
 */

import { pngOf } from '../png.js';
import { frames, ready, show, unfolded } from './support.js';

/**
 * @typedef {import('@playwright/test').Page} Page
 * @typedef {import('@playwright/test').Locator} Locator
 * @typedef {import('../../www/types.d.ts').MapSqueeze} MapSqueeze
 * @typedef {import('../../www/types.d.ts').Motion} Motion
 * @typedef {HTMLElement & { machine: MapSqueeze, motion: Motion }} MapSqueezeElement
 * @typedef {{ name: string, mimeType: string, buffer: Buffer }} MapFile
 * @typedef {(column: number, row: number) => boolean} Occupied by column and row from the top left
 */

/**
 * Opens a page with a Map Squeeze.
 *
 * @param {Page} page
 * @param {string} [attributes]
 */
export async function openSqueeze(page, attributes = '') {
  await show(page, `<main><h1>Bare</h1><map-squeeze heading-level="2" ${attributes}></map-squeeze></main>`);
  const widget = page.locator('map-squeeze');
  await ready(widget);
  return widget;
}

/**
 * Opens what is folded away, as a reader would.
 *
 * @param {Locator} widget
 * @param {string} name
 */
export async function unfold(widget, name) {
  const fold = widget.locator('details').filter({ has: widget.page().locator('summary', { hasText: name }) });
  if ((await fold.getAttribute('open')) === null) await fold.locator('summary').click();
  await unfolded(widget);
  return fold;
}

/**
 * Returns the present results of the machine behind the widget.
 *
 * @param {Locator} widget
 */
export async function squeezed(widget) {
  await frames(widget.page());
  const { plan, poses, verdicts, ...said } = await widget.evaluate((element) => {
    const { config, shown, stats, startFree, openPlace, plan, poses, verdicts } = /** @type {MapSqueezeElement} */ (element).machine;
    return { config, shown, stats, startFree, openPlace, plan, poses, verdicts };
  });
  const { bounds, walls } = plan;
  return { ...said, bounds: [...bounds], walls: [...walls], poses: [...poses], verdicts: [...verdicts] };
}

/**
 * @param {string} name
 * @param {string | Uint8Array} contents
 * @returns {MapFile}
 */
export function file(name, contents) {
  return { name, mimeType: 'application/octet-stream', buffer: Buffer.from(contents) };
}

/**
 * A map's YAML file.
 *
 * @param {string} name
 * @param {Record<string, unknown>} fields
 */
export function yaml(name, fields) {
  return file(name, Object.entries(fields).map(([key, value]) => `${key}: ${value}\n`).join(''));
}

/**
 * @param {string} name
 * @param {number} columns
 * @param {number} rows
 * @param {Occupied} occupied
 * @param {{ black?: number, white?: number }} [shades]
 */
export function pgm(name, columns, rows, occupied, { black = 0, white = 254 } = {}) {
  const pixels = shadesOf(columns, rows, occupied, black, white);
  const header = `P5\n# by hand\n${columns} ${rows}\n# and another comment\n255\n`;
  return file(name, Buffer.concat([Buffer.from(header), pixels]));
}

/**
 * A PNG image in shades of grey, with or without opacity.
 *
 * @param {string} name
 * @param {number} columns
 * @param {number} rows
 * @param {Occupied} occupied
 * @param {Occupied} [transparent]
 */
export function png(name, columns, rows, occupied, transparent) {
  const sample = (/** @type {number} */ column, /** @type {number} */ row, /** @type {number} */ part) => {
    if (part) return transparent?.(column, row) ? 0 : 255;
    return occupied(column, row) ? 0 : 254;
  };
  return file(name, pngOf({ width: columns, height: rows, opacity: transparent !== undefined, sample }));
}

/**
 * @param {number} columns
 * @param {number} rows
 * @param {Occupied} occupied
 * @param {number} black
 * @param {number} white
 */
function shadesOf(columns, rows, occupied, black, white) {
  const pixels = Buffer.alloc(columns * rows, white);
  for (let i = 0; i < pixels.length; i++) {
    if (occupied(i % columns, Math.floor(i / columns))) pixels[i] = black;
  }
  return pixels;
}
