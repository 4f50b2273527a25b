/**
 * How light a page is, and the figures on it.
 *
 * @module
 */

import assert from 'node:assert/strict';
import { expect } from '@playwright/test';

/**
 * @param {import('@playwright/test').Page} page
 * @param {Buffer} screenshot
 * @returns {Promise<number>} its mean, from 0, black, to 1
 */
export async function lightness(page, screenshot) {
  const blank = await page.context().newPage();
  const mean = await blank.evaluate(async (base64) => {
    const bytes = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
    const bitmap = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
    const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
    const context = /** @type {OffscreenCanvasRenderingContext2D} */ (canvas.getContext('2d'));
    context.drawImage(bitmap, 0, 0);
    const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
    let sum = 0;
    for (let i = 0; i < data.length; i += 4) sum += 0.2126 * data[i] + 0.7152 * data[i + 1] + 0.0722 * data[i + 2];
    return sum / (data.length / 4) / 255;
  }, screenshot.toString('base64'));
  await blank.close();
  return mean;
}

/**
 * @param {import('@playwright/test').Page} page
 * @param {import('@playwright/test').Locator} figure
 * @returns {Promise<void>} when the ground of its picture is nearly as light as the page beside it
 */
export async function asLightAsThePage(page, figure) {
  const canvas = figure.locator('canvas').first();
  await canvas.scrollIntoViewIfNeeded();
  await expect(async () => {
    const { x, y, height } = /** @type {NonNullable<Awaited<ReturnType<typeof figure.boundingBox>>>} */ (await figure.boundingBox());
    const margin = await page.screenshot({ clip: { x: x - 6, y: Math.max(0, y) + 1, width: 5, height: Math.min(height, 40) } });
    const [around, inside] = [await lightness(page, margin), await lightness(page, await canvas.screenshot())];
    assert.ok(Math.abs(inside - around) < 0.2, `The page has a lightness of ${around.toFixed(2)}, and the picture of ${inside.toFixed(2)}.`);
  }).toPass({ timeout: 20_000 });
}
