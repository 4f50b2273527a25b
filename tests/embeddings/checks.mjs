/**
 * Checks that run on the pages of every engine, a tool that makes web pages, such as Hugo, Next or JupyterLab.
 *
 * @module
 */

import assert from 'node:assert/strict';
import { join } from 'node:path';
import { ROOT } from '../../scripts/process.mjs';

/** @typedef {import('@playwright/test').Page} Page */
/** @typedef {{ name: string, definition: import('./project.mjs').Engine, serving: import('./project.mjs').Serving, url: string }} Site */

/** Time limit in milliseconds; it is long because a development server compiles a page at the first request. */
const TIMEOUT_MS = 90_000;

/** Runs the checks of a site. @param {import('@playwright/test').Browser} browser @param {Site} site */
export async function runChecks(browser, site) {
  const { definition, serving } = site;
  /** @type {string[]} */
  const consoleMessages = [];
  const failures = [];
  let passedCount = 0;
  for (const [checkName, checkFunction] of Object.entries(serving.checks ?? checksOf(site))) {
    const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, colorScheme: 'light' });
    const page = await context.newPage();
    page.setDefaultTimeout(TIMEOUT_MS);
    recordMessages(page, consoleMessages);
    try {
      await checkFunction(page, site);
      passedCount++;
    } catch (error) {
      failures.push(`${checkName}: ${error instanceof Error ? error.message : error}`);
    }
    await page.screenshot({ path: join(ROOT, `test-results/embeddings/${[site.name, serving.name, checkName].join(' ').replaceAll(' ', '-')}.png`) }).catch(() => {});
    await context.close();
  }
  // An aborted request means that the page was left.
  const allowedPatterns = [/ net::ERR_ABORTED$/, ...(definition.allowed ?? []).map(({ message }) => message)];
  const unexpectedMessages = [...new Set(consoleMessages)].filter((message) => !allowedPatterns.some((pattern) => pattern.test(message)));
  if (unexpectedMessages.length > 0) failures.push(`console: ${unexpectedMessages.join('\n')}`);
  else passedCount++;
  return { passed: passedCount, failures };
}

/** Returns the checks of a site, by name. @param {Site} site @returns {NonNullable<import('./project.mjs').Serving['checks']>} */
function checksOf({ definition, serving }) {
  const { go, pages } = definition;
  return {
    'first load': checkFirstLoad,
    ...(go && { 'away and back': checkAwayAndBack }),
    ...(go && pages.second && { 'from a page without figures': checkFromOtherPage }),
    ...((serving.dark ?? definition.dark) && { 'dark mode': checkDarkMode }),
  };
}

/** Collects errors and warnings of the console and failed requests of a page. @param {Page} page @param {string[]} messages */
export function recordMessages(page, messages) {
  page.on('console', (message) => {
    // The events requestfailed and response have the addresses of failed requests.
    if (/^Failed to load resource/.test(message.text())) return;
    if (['error', 'warning', 'assert'].includes(message.type())) messages.push(message.text());
  });
  page.on('pageerror', (error) => messages.push(String(error)));
  page.on('requestfailed', (request) => messages.push(`${request.url()} ${request.failure()?.errorText}`));
  page.on('response', (response) => {
    // Browsers request the icon on their own.
    const isIcon = new URL(response.url()).pathname === '/favicon.ico';
    if (response.status() >= 400 && !isIcon) messages.push(`${response.url()} ${response.status()}`);
  });
}

/** Returns the address of a page. @param {Site} site @param {string} path */
const addressOf = ({ url }, path) => new URL(path.replace(/^\//, ''), url).href;

/** Waits until every figure has drawn its present settings. @param {Page} page @param {Site} site */
export async function untilLive(page, { definition }) {
  assert.ok(definition.expected.length > 0, 'No figure is expected.');
  for (const { selector, properties } of definition.expected) {
    const figure = page.locator(selector);
    await figure.waitFor({ state: 'attached' });
    // An element without height is not visible, and a locator would wait for it.
    await figure.evaluate((element) => element.scrollIntoView({ block: 'center' }));
    await figure.locator('canvas').first().waitFor();
    assert.deepEqual(await figure.evaluate(propertiesOf, Object.keys(properties)), properties, selector);
    await figure.evaluate(untilComplete);
  }
}

/**
 * Returns properties of a figure, arrays of numbers as plain arrays. Runs in the page.
 *
 * @param {Element} element
 * @param {string[]} names
 */
export function propertiesOf(element, names) {
  const toPlainValue = (/** @type {any} */ value) => (ArrayBuffer.isView(value) ? Array.from(/** @type {any} */ (value)) : value);
  return Object.fromEntries(names.map((name) => [name, toPlainValue(/** @type {any} */ (element)[name])]));
}

/** Resolves when a figure has all of its samples, and its picture more than one colour. Runs in the page. @param {Element} element */
export async function untilComplete(element) {
  const figure = /** @type {any} */ (element);
  const canvas = /** @type {HTMLCanvasElement} */ (figure.shadowRoot.querySelector('canvas'));
  const isDrawn = () => {
    const context = /** @type {CanvasRenderingContext2D} */ (Object.assign(document.createElement('canvas'), { width: 64, height: 64 }).getContext('2d'));
    context.drawImage(canvas, 0, 0, 64, 64);
    return new Set(new Uint32Array(context.getImageData(0, 0, 64, 64).data.buffer)).size > 1;
  };
  while ((figure.stats?.n ?? figure.stats?.drawn ?? figure.stats?.attempts) !== figure.samples || !isDrawn()) await new Promise(requestAnimationFrame);
}

/** Opens the page of the figures. @type {(page: Page, site: Site) => Promise<void>} */
async function checkFirstLoad(page, site) {
  await page.goto(addressOf(site, site.definition.pages.first));
  await untilLive(page, site);
}

/**
 * Follows a link of the page, and waits until the first figure is on the page or no longer there.
 *
 * @param {Page} page
 * @param {Site} site
 * @param {'first' | 'second'} which
 */
async function followLink(page, { definition }, which) {
  await definition.go?.(page, definition.pages[which] ?? which);
  await page.locator(definition.expected[0].selector).waitFor({ state: which === 'first' ? 'attached' : 'detached' });
}

/** Follows a link away from the figures, and another one back. @type {(page: Page, site: Site) => Promise<void>} */
async function checkAwayAndBack(page, site) {
  await checkFirstLoad(page, site);
  await followLink(page, site, 'second');
  await followLink(page, site, 'first');
  await untilLive(page, site);
}

/** Opens the figure by a link on another page. It is created before its class is defined, and must apply properties that were set before. @type {(page: Page, site: Site) => Promise<void>} */
async function checkFromOtherPage(page, site) {
  await page.goto(addressOf(site, site.definition.pages.second ?? ''));
  // When the network is idle, the engine's script handles links.
  await page.waitForLoadState('networkidle');
  await followLink(page, site, 'first');
  await untilLive(page, site);
}

/** Turns dark mode on and off. @type {(page: Page, site: Site) => Promise<void>} */
async function checkDarkMode(page, site) {
  const setDark = site.serving.dark ?? site.definition.dark;
  await checkFirstLoad(page, site);
  for (const on of [true, false]) {
    await setDark?.(page, on);
    await page.locator(site.definition.expected[0].selector).evaluate(untilScheme, on ? 'dark' : 'light');
  }
}

/**
 * Resolves when a figure has a colour scheme. Runs in the page.
 *
 * @param {Element} figure
 * @param {string} scheme "dark" or "light"
 */
export async function untilScheme(figure, scheme) {
  const surface = /** @type {HTMLElement} */ (figure.shadowRoot?.querySelector('.surface'));
  while (getComputedStyle(surface).colorScheme !== scheme) await new Promise(requestAnimationFrame);
}
