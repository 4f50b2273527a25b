import { readFileSync } from 'node:fs';
import { expect } from '@playwright/test';
import { openSqueeze, readSqueezeResults } from './squeeze-support.js';
import { REDUCED_MOTION, readBananaResults, readBox, waitForFrames, mountFigure, openBanana, readPoses, readProperty, test, openDisclosures } from './support.js';

/** @import { Locator } from '@playwright/test' */
/** @typedef {import('../../www/types.d.ts').BananaMachineElement} Figure stands for any figure, because all have the same methods to export pictures and data */

test.use(REDUCED_MOTION);

/** Parses a CSV export of a figure. @param {string} csvText */
function parseCSV(csvText) {
  const [commentLine, headerLine, ...dataLines] = csvText.trimEnd().split('\n');
  expect(commentLine.startsWith('# ')).toBe(true);
  return { settings: JSON.parse(commentLine.slice(2)), columns: headerLine.split(','), rows: dataLines.map((csvLine) => csvLine.split(',').map(Number)) };
}

const readCSV = (/** @type {Locator} */ widget) => widget.evaluate((element) => /** @type {Figure} */ (element).toCSV());
const readSVG = (/** @type {Locator} */ widget) => widget.evaluate((element) => /** @type {Figure} */ (element).toSVG());

/** Returns the title, description and size of an SVG file, and the counts of its elements. @param {import('@playwright/test').Page} page @param {string} svgText */
function describeSVG(page, svgText) {
  return page.evaluate((svgText) => {
    const svgDocument = new DOMParser().parseFromString(svgText, 'image/svg+xml');
    if (svgDocument.querySelector('parsererror')) throw new Error(svgDocument.documentElement.textContent ?? '');
    const countElements = (/** @type {string} */ svgSelector) => svgDocument.querySelectorAll(svgSelector).length;
    return {
      title: svgDocument.querySelector('title')?.textContent,
      description: svgDocument.querySelector('desc')?.textContent,
      pathCount: countElements('path'),
      textCount: countElements('text'),
      imageCount: countElements('image'),
      dashedElementCount: countElements('[stroke-dasharray]'),
      size: [svgDocument.documentElement.getAttribute('width'), svgDocument.documentElement.getAttribute('height')].map(Number),
    };
  }, svgText);
}

test('CSV of the Banana Machine contains the samples, and the settings that reproduce them', async ({ page }) => {
  const widget = await openBanana(page, 'samples="2000"');
  await widget.getByRole('button', { name: 'Hard arc' }).click();
  const { config: figureConfig, shown: shownCount } = await readBananaResults(widget);
  const cloudPoses = await readPoses(widget);
  const { settings: figureSettings, columns: csvColumns, rows: csvRows } = parseCSV(await readCSV(widget));
  expect(csvColumns).toEqual([
    ...['x_m', 'y_m', 'theta_rad', 'xi_along_m', 'xi_lateral_m', 'xi_heading_rad'],
    ...['v_hat_m_per_s', 'omega_hat_rad_per_s', 'gamma_hat_rad_per_s'],
  ]);
  expect(csvRows).toHaveLength(shownCount);
  expect(csvRows.flatMap((csvRow) => csvRow.slice(0, 3))).toEqual(cloudPoses);
  expect(figureSettings).toEqual({ element: 'banana-machine', ...figureConfig });
  const recomputedPoses = await widget.evaluate((element, { element: _name, ...exportedSettings }) => {
    const { motion } = /** @type {import('./support.js').BananaMachineElement} */ (element);
    const simulation = new motion.BananaMachine(exportedSettings);
    const copiedPoses = [...simulation.poses];
    simulation.free();
    return copiedPoses;
  }, figureSettings);
  expect(recomputedPoses).toEqual(cloudPoses);
});

test('CSV of Map Squeeze contains the verdicts, whose counts equal the readouts', async ({ page }) => {
  const widget = await openSqueeze(page);
  const { config: figureConfig, stats } = await readSqueezeResults(widget);
  const { settings: figureSettings, columns: csvColumns, rows: csvRows } = parseCSV(await readCSV(widget));
  expect(figureSettings).toEqual({ element: 'map-squeeze', map: null, ...figureConfig });
  expect(csvColumns).toEqual(['x_m', 'y_m', 'theta_rad', 'end_free', 'path_free', 'accepted']);
  expect(csvRows).toHaveLength(stats.attempts);
  expect(csvRows.filter((csvRow) => csvRow[5] === 1)).toHaveLength(stats.accepted);
  expect(csvRows.filter((csvRow) => csvRow[5] === 1 && csvRow[4] === 0)).toHaveLength(stats.throughWall);
});

test('SVG has a title, a description and vector graphics; few samples are dots, and many samples are an image', async ({ page }) => {
  const widget = await openBanana(page);
  const floorCanvas = widget.locator('canvas.plane');
  await openDisclosures(widget);
  // Position 6 of the slider stands for a thousand samples.
  await widget.locator('#samples').fill('6');
  await waitForFrames(page);
  const svgOfFewSamples = await describeSVG(page, await readSVG(widget));
  const { width, height } = await readBox(floorCanvas);
  expect(svgOfFewSamples.title).toBe('The Banana Machine');
  expect(svgOfFewSamples.description).toBe(await floorCanvas.getAttribute('aria-label'));
  expect(svgOfFewSamples.size).toEqual([Math.round(width), Math.round(height)]);
  expect(svgOfFewSamples.imageCount).toBe(0);
  expect(svgOfFewSamples.pathCount).toBeGreaterThan(1000);
  expect(svgOfFewSamples.textCount).toBeGreaterThan(8);
  const svgText = await readSVG(widget);
  for (const labelText of ['Gaussian in (x, y)', 'Gaussian in ξ', 'command']) expect(svgText).toContain(`>${labelText}`);
  // The handle is an element on the page. In an export it is drawn as a ring.
  expect(svgText).toMatch(/<path[^>]*a7\.5,7\.5[^>]*stroke-width="3"/);
  await widget.locator('#samples').fill('9');
  await waitForFrames(page);
  const svgOfManySamples = await describeSVG(page, await readSVG(widget));
  expect(svgOfManySamples.imageCount).toBe(1);
  expect(svgOfManySamples.pathCount).toBeLessThan(60);

  const svgOfMap = await describeSVG(page, await readSVG(await openSqueeze(page)));
  expect(svgOfMap.title).toBe('Map Squeeze');
  expect(svgOfMap.imageCount).toBe(0);
  expect(svgOfMap.pathCount).toBeGreaterThan(400);
});

test('PNG of a figure has twice the resolution and an opaque background', async ({ page, figureName }) => {
  await page.emulateMedia({ colorScheme: 'dark' });
  const widget = await mountFigure(page, figureName);
  const pngMeasures = await widget.evaluate(async (element) => {
    const figureElement = /** @type {Figure} */ (element);
    const svgRoot = new DOMParser().parseFromString(figureElement.toSVG(), 'image/svg+xml').documentElement;
    const pngBlob = await figureElement.toPNG();
    const pngBitmap = await createImageBitmap(pngBlob);
    const pngContext = /** @type {OffscreenCanvasRenderingContext2D} */ (new OffscreenCanvas(pngBitmap.width, pngBitmap.height).getContext('2d'));
    pngContext.drawImage(pngBitmap, 0, 0);
    const pngPixels = new Uint32Array(pngContext.getImageData(0, 0, pngBitmap.width, pngBitmap.height).data.buffer);
    return {
      type: pngBlob.type, width: pngBitmap.width, height: pngBitmap.height, opaque: pngPixels.every((pngPixel) => pngPixel >>> 24 === 255),
      colours: new Set(pngPixels).size, svg: ['width', 'height'].map((name) => Number(svgRoot.getAttribute(name))),
    };
  });
  expect(pngMeasures).toMatchObject({ type: 'image/png', opaque: true });
  expect(Math.abs(pngMeasures.width - 2 * pngMeasures.svg[0])).toBeLessThanOrEqual(1);
  expect(Math.abs(pngMeasures.height - 2 * pngMeasures.svg[1])).toBeLessThanOrEqual(1);
  expect(pngMeasures.colours).toBeGreaterThan(50);
});

test('the menu saves files with descriptive names, also by keyboard', async ({ page }) => {
  const widget = await openBanana(page, 'samples="2000"');
  await openDisclosures(widget);
  await widget.locator('.exports button').first().focus();
  for (const fileEnding of ['png', 'svg', 'csv']) {
    const [csvDownload] = await Promise.all([page.waitForEvent('download'), page.keyboard.press('Enter')]);
    expect(csvDownload.suggestedFilename()).toBe(`banana-machine-${await readProperty(widget, 'seed')}.${fileEnding}`);
    const fileContents = readFileSync(await csvDownload.path());
    expect(fileContents.length).toBeGreaterThan(1000);
    if (fileEnding === 'csv') expect(fileContents.toString()).toBe(await readCSV(widget));
    await page.keyboard.press('Tab');
  }
});

/** Characters that XML forbids, and character sequences that end a comment, a CDATA section or an element. */
const HOSTILE_TEXT = ']]> --> <!-- <![CDATA[ </svg><script>alert(1)</script> & &amp; " \u0027 \u0000\u0001\u0008\u000b\u000c\u001f\ufffe\uffff \ud800 \udc00 \u{1f916} é';

/** Returns a text in which characters that XML forbids are replaced, as in an export to SVG. @param {string} originalText */
// oxlint-disable-next-line no-control-regex
const replaceForbiddenCharacters = (originalText) => originalText.replace(/[\0-\x08\x0b\x0c\x1f\ufffe\uffff\p{Cs}]/gu, '\ufffd');

test('SVG is well-formed even if names set by a page contain forbidden characters @nightly', async ({ page }) => {
  const widget = await openSqueeze(page);
  await widget.evaluate(async (element, stateJson) => {
    // The text is passed as JSON, whose escapes keep unpaired surrogates.
    const hostileText = JSON.parse(stateJson);
    element.append(Object.assign(document.createElement('span'), { slot: 'title', textContent: hostileText }));
    element.style.setProperty('--motion-font', `"${hostileText.replaceAll('"', '').replaceAll('\0', '')}", serif`);
    Object.assign(element, { map: { bounds: [0, 0, 6, 4], walls: [[3, 0, 3, 1.5]], name: hostileText } });
    for (let i = 0; i < 3; i++) await new Promise(requestAnimationFrame);
  }, JSON.stringify(HOSTILE_TEXT));
  const svg = await readSVG(widget);
  const { title, description } = await describeSVG(page, svg);
  expect(title).toBe(replaceForbiddenCharacters(HOSTILE_TEXT.replace(/\s+/g, ' ')));
  expect(description).toContain(replaceForbiddenCharacters(HOSTILE_TEXT));
  expect(await page.evaluate((text) => new DOMParser().parseFromString(text, 'image/svg+xml').querySelectorAll('script').length, svg)).toBe(0);
});
