/**
 * What has to be so on a page of whatever engine.
 *
 * @module
 */

import assert from 'node:assert/strict';
import { join } from 'node:path';
import { ROOT } from '../../scripts/process.mjs';
import { asLightAsThePage, lightness } from './lightness.mjs';
import { cloudPixels, shifts, textOf, watchShifts } from './looking.mjs';

/** @typedef {import('@playwright/test').Page} Page */
/** @typedef {{ name: string, definition: import('./project.mjs').Engine, serving: import('./project.mjs').Serving, url: string }} Site */

/** Milliseconds. */
const PATIENCE = 20_000;

/** Milliseconds: a development server compiles a page when it is first asked for it. */
const PATIENCE_AT_FIRST = 90_000;

/** What readers see of a page that moves while it loads, at most. */
export const MOST_SHIFT = 0.02;

/** Milliseconds that scripts come late, so that the page stands before they do, as it does on the network. */
const LATE = 400;

const DESKTOP = { width: 1280, height: 800 };
const PHONE = { width: 375, height: 812 };

/**
 * @param {import('@playwright/test').Browser} browser
 * @param {Site} site
 * @returns {Promise<{ passed: number, failures: string[] }>}
 */
export async function check(browser, site) {
  const { definition, serving } = site;
  /** @type {string[]} */
  const messages = [];
  /** @type {string[]} */
  const failures = [];
  let passed = 0;
  /**
   * @param {string} name
   * @param {(page: Page) => Promise<void>} work
   * @param {{ viewport?: typeof DESKTOP, colorScheme?: 'light' | 'dark', patience?: number }} [options]
   */
  const attempt = async (name, work, { viewport = DESKTOP, colorScheme = 'light', patience = PATIENCE } = {}) => {
    const context = await browser.newContext({ viewport, colorScheme });
    const page = await context.newPage();
    page.setDefaultTimeout(patience);
    listen(page, messages);
    try {
      await work(page);
      passed++;
    } catch (error) {
      await page.screenshot({ path: picture(site, 'failed') }).catch(() => {});
      failures.push(`${name}: ${error instanceof Error ? error.message : error}`);
    }
    await context.close();
  };

  if (serving.checks) {
    for (const [what, work] of Object.entries(serving.checks)) await attempt(what, (page) => work(page, site), { patience: PATIENCE_AT_FIRST });
  } else {
    await ofSite(attempt, site, failures);
  }

  const own = definition.allowed ?? [];
  const unexplained = [...new Set(messages)].filter((message) => !own.some((each) => each.message.test(message)));
  if (unexplained.length > 0) failures.push(`console: ${unexplained.join('\n')}`);
  else passed++;
  return { passed, failures };
}

/**
 * @param {(name: string, work: (page: Page) => Promise<void>, options?: { viewport?: typeof DESKTOP, colorScheme?: 'light' | 'dark', patience?: number }) => Promise<void>} attempt
 * @param {Site} site
 * @param {string[]} failures so far
 */
async function ofSite(attempt, site, failures) {
  const { definition, serving } = site;
  await attempt('first load', (page) => firstLoad(page, site), { patience: PATIENCE_AT_FIRST });
  // All else begins with it.
  if (failures.length > 0) return;
  await attempt('three navigations and back', (page) => navigations(page, site));
  await attempt('from a page without figures', (page) => fromElsewhere(page, site));
  await attempt('text of the page', (page) => text(page, site));
  if (switchOf(site) !== undefined) await attempt('dark mode', (page) => darkMode(page, site));
  await attempt('a dark system', (page) => darkSystem(page, site), { colorScheme: 'dark' });
  for (const [what, work] of Object.entries(definition.also ?? {})) {
    await attempt(what, async (page) => {
      await firstLoad(page, site);
      await work(page);
    });
  }
  if (serving.name !== 'development') {
    for (const viewport of [DESKTOP, PHONE]) await attempt(`nothing moves at ${viewport.width} px`, (page) => still(page, site), { viewport });
    await attempt('pictures', (page) => pictures(page, site));
  }
}

/**
 * @param {Page} page
 * @param {string[]} messages
 */
function listen(page, messages) {
  page.on('console', (message) => {
    // Told with their addresses below.
    if (/^Failed to load resource/.test(message.text())) return;
    if (['error', 'warning', 'assert'].includes(message.type())) messages.push(message.text());
  });
  page.on('pageerror', (error) => messages.push(String(error)));
  page.on('requestfailed', (request) => {
    const reason = request.failure()?.errorText;
    // The page was left while it was asking.
    if (reason !== 'net::ERR_ABORTED') messages.push(`${request.url()} ${reason}`);
  });
  page.on('response', (response) => {
    // A browser asks for it by itself.
    const icon = new URL(response.url()).pathname === '/favicon.ico';
    if (response.status() >= 400 && !icon) messages.push(`${response.url()} ${response.status()}`);
  });
}

/**
 * @param {Site} site
 * @param {'first' | 'second'} which
 */
const address = ({ definition, url }, which) => new URL(definition.pages[which].replace(/^\//, ''), url).href;

/**
 * @param {Site} site
 * @param {string} what
 */
export const picture = ({ name, definition, serving }, what) => {
  const which = serving === definition.servings[0] ? '' : `-${serving.name.replaceAll(' ', '-')}`;
  return join(ROOT, `test-results/embeddings/${name}${which}-${what}.png`);
};

/** @param {Site} site */
const switchOf = ({ definition, serving }) => serving.dark ?? definition.dark;

/**
 * Waits until every figure is drawn as it was asked for.
 *
 * @param {Page} page
 * @param {Site} site
 */
export async function live(page, { definition }) {
  assert.ok(definition.expected.length > 0, 'No figure is expected.');
  for (const { selector, properties } of definition.expected) {
    const figure = page.locator(selector);
    await figure.waitFor({ state: 'attached' });
    // An element without height is not to be seen, and would be waited for.
    await figure.evaluate((element) => element.scrollIntoView({ block: 'center' }));
    const canvas = figure.locator('canvas').first();
    await canvas.waitFor();
    const names = Object.keys(properties);
    const is = await figure.evaluate(asked, names);
    assert.deepEqual(is, properties, selector);
    const { drawn, stats, samples } = await canvas.evaluate(cloudPixels);
    assert.ok(drawn > 200, `${selector}: the picture has ${drawn} pixels of a cloud.`);
    assert.equal(stats, samples, `${selector}: the statistics are of ${stats} samples.`);
  }
}

/**
 * What the properties of a figure are. Runs in the page.
 *
 * @param {Element} element
 * @param {string[]} names
 */
function asked(element, names) {
  // Arrays of numbers as arrays, whatever carries them.
  const plain = (/** @type {any} */ value) => (ArrayBuffer.isView(value) ? Array.from(/** @type {any} */ (value)) : value);
  return Object.fromEntries(names.map((name) => [name, plain(/** @type {any} */ (element)[name])]));
}

/** @type {(page: Page, site: Site) => Promise<void>} */
async function firstLoad(page, site) {
  await page.goto(address(site, 'first'));
  await live(page, site);
}

/**
 * @param {Page} page
 * @param {Site} site
 * @param {'first' | 'second'} which
 */
async function go(page, { definition, url }, which) {
  const path = definition.pages[which];
  const before = page.url();
  await page.evaluate(() => Object.assign(globalThis, { sameDocument: true }));
  await definition.go(page, path);
  await page.waitForURL((now) => now.href !== before && now.href.startsWith(url));
  await arrived(page, definition, which);
  const same = await page.evaluate(() => 'sameDocument' in globalThis);
  assert.equal(same, !definition.wholePages, `${path} ${same ? 'is' : 'is not'} in the same document.`);
}

/**
 * @param {Page} page
 * @param {import('./project.mjs').Engine} definition
 * @param {'first' | 'second'} which
 */
async function arrived(page, { expected }, which) {
  const figure = page.locator(expected[0].selector);
  await figure.waitFor({ state: which === 'first' ? 'attached' : 'detached' });
}

/** @type {(page: Page, site: Site) => Promise<void>} */
async function navigations(page, site) {
  await page.goto(address(site, 'first'));
  await live(page, site);
  await go(page, site, 'second');
  await go(page, site, 'first');
  await live(page, site);
  await go(page, site, 'second');
  // A page that was kept as it was is not loaded once more.
  await page.goBack({ waitUntil: 'commit' });
  await arrived(page, site.definition, 'first');
  await live(page, site);
}

/** The element is made before it is defined: what it is given waits on it. @type {(page: Page, site: Site) => Promise<void>} */
async function fromElsewhere(page, site) {
  await page.goto(address(site, 'second'));
  // The engine's own script has the links from then on.
  await page.waitForLoadState('networkidle');
  await go(page, site, 'first');
  await live(page, site);
}

/** @type {(page: Page, site: Site) => Promise<void>} */
async function text(page, site) {
  await firstLoad(page, site);
  for (const { selector } of site.definition.expected) {
    const { page: around, figure, median } = await page.locator(selector).evaluate(textOf);
    assert.equal(figure.family, around.family, `${selector}: its family`);
    assert.equal(figure.size, around.size, `${selector}: its size`);
    // What explains is a little smaller.
    assert.ok(median >= 0.8 * around.size && median <= around.size, `${selector}: half of its text has less than ${median} px, the page ${around.size}.`);
  }
}

/** @type {(page: Page, site: Site) => Promise<void>} */
async function darkMode(page, site) {
  const dark = switchOf(site);
  assert.ok(dark);
  await firstLoad(page, site);
  const figure = page.locator(site.definition.expected[0].selector);
  for (const on of [true, false, true]) {
    await dark(page, on);
    await page.evaluate(() => scrollTo(0, 0));
    await live(page, site);
    // Colours go over into each other.
    await settled(page);
    const light = await lightness(page, await figure.locator('canvas').first().screenshot());
    assert.ok(on ? light < 0.35 : light > 0.75, `${on ? 'Dark' : 'Light'} was chosen, and the picture has a lightness of ${light.toFixed(2)}.`);
  }
}

/** A page that follows the system has figures that do, and one that stays light has light ones. @type {(page: Page, site: Site) => Promise<void>} */
async function darkSystem(page, site) {
  await firstLoad(page, site);
  await asLightAsThePage(page, page.locator(site.definition.expected[0].selector));
}

/** @param {Page} page */
export function settled(page) {
  return page.evaluate(async () => {
    for (let i = 0; i < 2; i++) await new Promise(requestAnimationFrame);
    await Promise.allSettled(document.getAnimations().filter(({ effect }) => effect?.getTiming().iterations !== Infinity).map(({ finished }) => finished));
    for (let i = 0; i < 2; i++) await new Promise(requestAnimationFrame);
  });
}

/** Scripts do, as on the network. @param {Page} page */
export function comeLate(page) {
  return page.route(/\.m?js(\?|$)/, async (route) => {
    await new Promise((resolve) => setTimeout(resolve, LATE));
    await route.continue();
  });
}

/** @type {(page: Page, site: Site) => Promise<void>} */
async function still(page, site) {
  await page.addInitScript(watchShifts);
  await comeLate(page);
  await firstLoad(page, site);
  await settled(page);
  const { movesItself = false } = site.definition;
  const { total, sources, grown } = await page.evaluate(shifts, movesItself);
  assert.ok(total < MOST_SHIFT, `things moved by ${total.toFixed(3)}: ${sources.join('; ')}`);
  // Where not all is counted that moves, nothing of it is the figures'. On a phone they may be a few lines higher than what
  // is kept where letters are as wide as those that stand in here for a system's own: see www/figure/page/room.js.
  if (!movesItself || page.viewportSize()?.width === PHONE.width) return;
  assert.ok(grown.length > 0, 'No figure was seen before its script came.');
  assert.ok(grown.every((pixels) => Math.abs(pixels) < 1), `The figures became higher by ${grown.join(', ')} px.`);
}

/** @type {(page: Page, site: Site) => Promise<void>} */
async function pictures(page, site) {
  const dark = switchOf(site);
  const take = async (/** @type {string} */ what, fullPage = false) => {
    await page.evaluate(() => scrollTo(0, 0));
    await settled(page);
    await page.screenshot({ path: picture(site, what), fullPage });
  };
  await firstLoad(page, site);
  await take('light');
  for (const width of [375, 700]) {
    await page.setViewportSize({ width, height: 800 });
    // Engines decide by the width on loading what is open.
    await firstLoad(page, site);
    const wide = await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
    assert.ok(wide <= 0, `At ${width} px the page scrolls sideways by ${wide} px.`);
    await take(`${width}`, true);
  }
  if (dark === undefined) return;
  await page.setViewportSize(DESKTOP);
  await dark(page, true);
  await live(page, site);
  await take('dark');
}
