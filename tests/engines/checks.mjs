/**
 * Checks of every browser engine: the bits of the results, and the reactions of the page to a reader.
 *
 * @module
 */

import assert from 'node:assert/strict';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { ROOT } from '../../scripts/process.mjs';
import { settings } from '../../www/settings.js';
import { differences } from '../digest/digest.js';
import { figures, machineOf } from './figures.mjs';
import { machineState } from './inside.js';

/** @typedef {import('./browsers.mjs').Engine} Engine */

/** Number of steps of a drag, as a hand moves in steps. */
const STEPS = 8;

/** Number of colours from which a picture is not blank: lines, letters and a cloud have many shades. */
const COLOURS = 16;

const read = (/** @type {string} */ path) => readFileSync(join(ROOT, path), 'utf8');

/** A page of one engine, which is asked what inside.js exports. */
class Page {
  /**
   * @param {string} name
   * @param {Engine} engine
   * @param {string} address
   */
  constructor(name, engine, address) {
    this.name = name;
    this.engine = engine;
    this.address = address;
  }

  /**
   * @template {keyof typeof import('./inside.js')} Name
   * @param {Name} name
   * @param {Parameters<typeof import('./inside.js')[Name]>[0]} [given]
   * @returns {Promise<Awaited<ReturnType<typeof import('./inside.js')[Name]>>>}
   */
  ask(name, given) {
    return this.engine.ask(
      async ({ name, given }) => (await import(new URL('/tests/engines/inside.js', location.href).href))[name](given),
      { name, given },
    );
  }

  /** As a reader gets it. @param {string} [tag] of a figure that is brought into sight */
  async open(tag) {
    await this.engine.open(this.address);
    if (tag !== undefined) await this.settled(tag);
  }

  /** Presses keys one after the other, without waiting for pictures. @param {Parameters<Engine['press']>[0][]} keys */
  async press(...keys) {
    for (const key of keys) await this.engine.press(key);
  }

  /** @param {string} tag */
  async settled(tag) {
    const { stats, samples } = await this.ask('settled', tag);
    assert.equal(stats, samples, `The statistics are of ${stats} samples.`);
    for (const count of await this.ask('coloursOf', tag)) assert.ok(count > COLOURS, `A picture has ${count} colours.`);
  }

  /** @param {string} what */
  async keep(what) {
    const directory = join(ROOT, 'test-results/engines');
    mkdirSync(directory, { recursive: true });
    writeFileSync(join(directory, `${this.name}-${what}.png`), await this.engine.screenshot());
  }

  /** @returns {Promise<string[]>} since it was opened */
  async complaints() {
    const noted = await this.engine.ask(() => /** @type {string[]} */ (/** @type {any} */ (globalThis).complaints.splice(0)), null);
    return [...new Set(noted)];
  }
}

/**
 * @param {string} name of the engine
 * @param {Engine} engine
 * @param {string} address
 * @returns {Promise<{ passed: number, failures: string[] }>}
 */
export async function check(name, engine, address) {
  const page = new Page(name, engine, address);
  /** @type {string[]} */
  const failures = [];
  let passed = 0;
  const attempt = async (/** @type {string} */ what, /** @type {() => Promise<unknown>} */ work) => {
    try {
      await work();
      assert.deepEqual(await page.complaints(), [], 'The console has something to say.');
      passed++;
      console.log(`ok     ${name}: ${what}`);
    } catch (error) {
      failures.push(`${name}: ${what}: ${error instanceof Error ? error.message : error}`);
      console.log(`FAILED ${failures.at(-1)}`);
      await page.keep('failed').catch(() => {});
    }
  };

  await attempt('the digest', () => bits(page));
  for (const tag of Object.keys(settings)) {
    const { handles } = figures[tag];
    await attempt(`${tag} opens`, () => opens(page, tag));
    for (const handle of handles) {
      await attempt(`${tag} is dragged by its handle "${handle.name}"`, () => dragged(page, tag, handle));
      await attempt(`the handle "${handle.name}" of ${tag} follows the keyboard`, () => handleByKeys(page, tag, handle));
    }
    await attempt(`sliders of ${tag} follow the keyboard`, () => slidersByKeys(page, tag));
  }
  return { passed, failures };
}

/** @param {Page} page */
async function bits(page) {
  await page.open();
  assert.deepEqual(differences(read('tests/digest/golden.txt'), await page.ask('wholeDigest')), []);
}

/**
 * Compares the results of a figure with those of a machine of the same settings in Node, to the last bit.
 *
 * @param {Page} page
 * @param {string} tag
 * @returns {Promise<{ machine: any, hash: string }>} the machine in Node
 */
async function asInNode(page, tag) {
  const { config, hash } = await page.ask('stateOf', tag);
  const machine = await machineOf(tag, config);
  assert.equal(hash, (await machineState(machine)).hash, `Node has other bits for ${JSON.stringify(config)}.`);
  return { machine, hash };
}

/** @type {(page: Page, tag: string) => Promise<void>} */
async function opens(page, tag) {
  await page.open(tag);
  await asInNode(page, tag);
  await page.keep(`${tag}-opened`);
}

/**
 * Checks that a dragged handle moves to the pointer, to within a pixel.
 *
 * @param {Page} page
 * @param {string} tag
 * @param {import('./figures.mjs').Handle} handle
 */
async function dragged(page, tag, { name, to, placeOf }) {
  await page.open(tag);
  const before = await page.ask('pixelsOf', tag);
  const places = await page.ask('placesOf', { tag, handle: name, to });
  // Pointer positions are whole pixels. A handle that is grasped beside its middle keeps that offset.
  const from = [Math.round(places.from.x), Math.round(places.from.y)];
  const way = [places.to.x - places.from.x, places.to.y - places.from.y];
  const at = (/** @type {number} */ share) => /** @type {[number, number]} */ (from.map((start, i) => Math.round(start + share * way[i])));
  await page.engine.drag(Array.from({ length: STEPS + 1 }, (_, i) => at(i / STEPS)));
  await page.settled(tag);
  await page.keep(`${tag}-${name}-dragged`);
  const { machine } = await asInNode(page, tag);
  const [x, y] = placeOf(machine, to);
  const off = Math.hypot(x - to[0], y - to[1]) / places.pixel;
  assert.ok(off <= 1, `It is ${off.toFixed(2)} pixels beside where it was dragged.`);
  assert.notEqual(await page.ask('pixelsOf', tag), before, 'The picture is as it was.');
}

/** Moves a handle by keys. @param {Page} page @param {string} tag @param {import('./figures.mjs').Handle} handle */
async function handleByKeys(page, tag, { name }) {
  await page.open(tag);
  const { hash: before } = await page.ask('stateOf', tag);
  assert.ok(await page.ask('focus', { tag, selector: `.handle.${name}` }), 'It does not take the focus.');
  await page.press('ArrowUp', 'ArrowUp', 'ArrowLeft');
  await page.settled(tag);
  const { hash } = await asInNode(page, tag);
  assert.notEqual(hash, before, 'Nothing has moved.');
}

/** @type {(page: Page, tag: string) => Promise<void>} */
async function slidersByKeys(page, tag) {
  await page.open(tag);
  await page.ask('renderSteps', tag);
  const sliders = await page.ask('slidersOf', tag);
  assert.ok(sliders.length >= 2, `${sliders.length} sliders are to be seen.`);
  for (const { key } of sliders) {
    const sliderOf = async () => (await page.ask('slidersOf', tag)).find((slider) => slider.key === key);
    const before = await sliderOf();
    assert.ok(before && (await page.ask('focus', { tag, selector: `#${key}` })), `${key} does not take the focus.`);
    await page.press('ArrowRight', 'ArrowRight', 'ArrowLeft');
    await page.settled(tag);
    const after = await sliderOf();
    const to = Math.min(before.shown + 2 * before.step, before.end) - before.step;
    assert.ok(after && Math.abs(after.shown - to) < 1e-9, `The slider of ${key} was at ${before.shown} and is at ${after?.shown}.`);
    assert.ok((after.value - before.value) * (to - before.shown) > 0, `${key} was ${before.value} and is ${after.value}.`);
  }
  await asInNode(page, tag);
}
