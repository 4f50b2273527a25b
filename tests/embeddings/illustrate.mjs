/**
 * `node tests/embeddings/illustrate.mjs [ENGINE…]`: the pictures of doc/embedding.md, from those that `npm run test:embeddings` has
 * taken. A picture in few colours has a quarter of the bytes.
 *
 * @module
 */

import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { crc32, deflateSync } from 'node:zlib';
import { chromium } from '@playwright/test';
import { CHROME_ARGUMENTS, ensureBrowser } from '../../scripts/browser.mjs';
import { Missing, ROOT, runAsScript } from '../../scripts/process.mjs';
import { engines } from './project.mjs';

/** Bytes that a picture may have. */
const MOST = 60_000;

/** How many colours are tried, until the picture is small enough. */
const COLOURS = [128, 96, 64, 48, 32, 24, 16];

/** @typedef {{ width: number, height: number, pixels: Uint8Array }} Picture `pixels` are red, green, blue and alpha, one byte each */

/**
 * @param {import('@playwright/test').Page} page
 * @param {string} path
 * @returns {Promise<Picture>}
 */
async function decoded(page, path) {
  const { width, height, text } = await page.evaluate(async (base64) => {
    const bitmap = await createImageBitmap(await (await fetch(`data:image/png;base64,${base64}`)).blob());
    const context = /** @type {OffscreenCanvasRenderingContext2D} */ (new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d'));
    context.drawImage(bitmap, 0, 0);
    const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
    let text = '';
    for (let i = 0; i < data.length; i += 0x8000) text += String.fromCharCode(...data.subarray(i, i + 0x8000));
    return { width: bitmap.width, height: bitmap.height, text: btoa(text) };
  }, readFileSync(path, 'base64'));
  return { width, height, pixels: Buffer.from(text, 'base64') };
}

/** @typedef {{ value: number[], count: number, weight: number, key: number }} Colour */

/** A colour that this share of a picture has is flat ground, and stays what it is. */
const FLAT = 0.002;

/**
 * @param {Picture} picture
 * @returns {Colour[]} those that it has. Rare ones weigh more than they are: thin lines have them
 */
function coloursOf({ pixels }) {
  /** @type {Map<number, number>} */
  const counts = new Map();
  for (let i = 0; i < pixels.length; i += 4) {
    const key = keyAt(pixels, i);
    counts.set(key, (counts.get(key) ?? 0) + 1);
  }
  return [...counts].map(([key, count]) => ({ key, count, value: [key >> 16, (key >> 8) & 255, key & 255], weight: Math.sqrt(count) }));
}

const keyAt = (/** @type {Uint8Array} */ pixels, /** @type {number} */ i) => (pixels[i] << 16) | (pixels[i + 1] << 8) | pixels[i + 2];

/**
 * Median cut: again and again, the set that spreads widest is divided where half of its weight is.
 *
 * @param {Colour[]} colours
 * @param {number} most
 */
function setsOf(colours, most) {
  const sets = [widestOf(colours)];
  while (sets.length < most && sets[0].spread > 0) {
    const { set, channel } = /** @type {ReturnType<typeof widestOf>} */ (sets.shift());
    set.sort((a, b) => a.value[channel] - b.value[channel]);
    let left = set.reduce((sum, { weight }) => sum + weight, 0) / 2;
    const half = set.findIndex(({ weight }) => (left -= weight) <= 0);
    const at = Math.min(Math.max(half, 1), set.length - 1);
    sets.push(widestOf(set.slice(0, at)), widestOf(set.slice(at)));
    sets.sort((a, b) => b.spread - a.spread);
  }
  return sets.map(({ set }) => set);
}

/**
 * @param {Colour[]} set
 * @returns {{ set: Colour[], channel: number, spread: number }} in which channel it spreads widest, and how far
 */
function widestOf(set) {
  const spreads = [0, 1, 2].map((channel) => {
    let [least, most] = [255, 0];
    for (const { value } of set) [least, most] = [Math.min(least, value[channel]), Math.max(most, value[channel])];
    return most - least;
  });
  const spread = Math.max(...spreads);
  return { set, channel: spreads.indexOf(spread), spread };
}

/**
 * @param {Picture} picture
 * @param {number} most colours, at most 256
 * @returns {Buffer} a PNG with a palette
 */
function encoded(picture, most) {
  const { width, height, pixels } = picture;
  const colours = coloursOf(picture).sort((a, b) => b.count - a.count);
  const flat = colours.filter(({ count }) => count > FLAT * width * height).slice(0, most / 2);
  const sets = [...flat.map((colour) => [colour]), ...setsOf(colours.slice(flat.length), most - flat.length)];
  const palette = sets.flatMap((set) => {
    const weight = set.reduce((sum, each) => sum + each.weight, 0);
    return [0, 1, 2].map((channel) => Math.round(set.reduce((sum, each) => sum + each.weight * each.value[channel], 0) / weight));
  });
  const numbers = new Map(sets.flatMap((set, number) => set.map(({ key }) => [key, number])));
  // Each row begins with its filter, which is none.
  const rows = Buffer.alloc(height * (width + 1));
  for (let i = 0; i < width * height; i++) {
    rows[Math.floor(i / width) * (width + 1) + 1 + (i % width)] = numbers.get(keyAt(pixels, 4 * i)) ?? 0;
  }
  const header = Buffer.alloc(13);
  header.writeUInt32BE(width, 0);
  header.writeUInt32BE(height, 4);
  // Eight bits that name a colour.
  header.set([8, 3], 8);
  const chunks = [chunk('IHDR', header), chunk('PLTE', Buffer.from(palette)), chunk('IDAT', deflateSync(rows, { level: 9 })), chunk('IEND', Buffer.alloc(0))];
  return Buffer.concat([Buffer.from('\x89PNG\r\n\x1a\n', 'latin1'), ...chunks]);
}

/**
 * @param {string} type
 * @param {Buffer} data
 */
function chunk(type, data) {
  const content = Buffer.concat([Buffer.from(type), data]);
  const [length, check] = [Buffer.alloc(4), Buffer.alloc(4)];
  length.writeUInt32BE(data.length);
  check.writeUInt32BE(crc32(content));
  return Buffer.concat([length, content, check]);
}

await runAsScript(import.meta.url, async () => {
  const wanted = process.argv.slice(2);
  const browser = await chromium.launch({ executablePath: (await ensureBrowser()).chrome, args: CHROME_ARGUMENTS });
  const page = await browser.newPage();
  mkdirSync(join(ROOT, 'doc/embedding'), { recursive: true });
  for (const name of wanted.length > 0 ? wanted : engines()) {
    const taken = join(ROOT, `test-results/embeddings/${name}-light.png`);
    if (!existsSync(taken)) throw new Missing(`${taken} is missing: \`npm run test:embeddings -- ${name}\` takes it.`);
    const picture = await decoded(page, taken);
    const small = COLOURS.map((most) => encoded(picture, most)).find(({ length }) => length <= MOST);
    if (small === undefined) throw new Missing(`${taken} does not fit into ${MOST} bytes.`);
    writeFileSync(join(ROOT, `doc/embedding/${name}.png`), small);
    console.log(`doc/embedding/${name}.png has ${small.length} bytes.`);
  }
  await browser.close();
});
