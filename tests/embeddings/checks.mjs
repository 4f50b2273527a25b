// Checks that run on the pages of every platform. A platform is a tool that makes web pages, such as Hugo, Next or JupyterLab.

import { join } from 'node:path';
import { expect } from '@playwright/test';
import { REPOSITORY_ROOT } from '../../scripts/process.mjs';

/** @typedef {import('@playwright/test').Page} Page */
/** @typedef {{ name: string, definition: import('./project.mjs').Platform, serverMode: import('./project.mjs').ServerMode, url: string }} Site */

/** Time limit (ms) of each step on a page. It is long, because a development server compiles a page at the first request. */
const TIMEOUT_MS = 90_000;

/** Runs the checks of a site. @param {import('@playwright/test').Browser} browser @param {Site} servedSite */
export async function runChecks(browser, servedSite) {
  const { definition: platformDefinition, serverMode } = servedSite;
  /** @type {string[]} */
  const consoleMessages = [];
  const failedChecks = [];
  let passedCount = 0;
  for (const [checkName, checkFunction] of Object.entries(serverMode.checks ?? checksOf(servedSite))) {
    const browserContext = await browser.newContext({ viewport: { width: 1280, height: 800 }, colorScheme: 'light' });
    const page = await browserContext.newPage();
    page.setDefaultTimeout(TIMEOUT_MS);
    recordMessages(page, consoleMessages);
    try {
      await checkFunction(page, servedSite);
      passedCount++;
    } catch (error) {
      failedChecks.push(`${checkName}: ${error instanceof Error ? error.message : error}`);
    }
    await page.screenshot({ path: join(REPOSITORY_ROOT, `test-results/embeddings/${[servedSite.name, serverMode.name, checkName].join(' ').replaceAll(' ', '-')}.png`) }).catch(() => {});
    await browserContext.close();
  }
  // An aborted request means that the browser has left the page.
  const allowedPatterns = [/ net::ERR_ABORTED$/, ...(platformDefinition.allowedMessages ?? []).map(({ messagePattern }) => messagePattern)];
  const unexpectedMessages = [...new Set(consoleMessages)].filter((consoleMessage) => !allowedPatterns.some((allowedPattern) => allowedPattern.test(consoleMessage)));
  if (unexpectedMessages.length > 0) failedChecks.push(`console: ${unexpectedMessages.join('\n')}`);
  else passedCount++;
  return { passed: passedCount, failures: failedChecks };
}

/** Returns the checks of a site, by name. @param {Site} servedSite @returns {NonNullable<import('./project.mjs').ServerMode['checks']>} */
function checksOf({ definition: platformDefinition, serverMode }) {
  const { goToPage, pages: pagePaths } = platformDefinition;
  return {
    'first load': checkFirstLoad,
    ...(goToPage && { 'away and back': checkAwayAndBack }),
    ...(goToPage && pagePaths.otherPath && { 'from a page without figures': checkFromOtherPage }),
    ...((serverMode.setDarkMode ?? platformDefinition.setDarkMode) && { 'dark mode': checkDarkMode }),
  };
}

/** Collects errors and warnings of the console and failed requests of a page. @param {Page} page @param {string[]} consoleMessages */
export function recordMessages(page, consoleMessages) {
  page.on('console', (consoleMessage) => {
    // This message does not name the address. The events requestfailed and response do, and are recorded below.
    if (/^Failed to load resource/.test(consoleMessage.text())) return;
    if (['error', 'warning', 'assert'].includes(consoleMessage.type())) consoleMessages.push(consoleMessage.text());
  });
  page.on('pageerror', (error) => consoleMessages.push(String(error)));
  page.on('requestfailed', (failedRequest) => consoleMessages.push(`${failedRequest.url()} ${failedRequest.failure()?.errorText}`));
  page.on('response', (pageResponse) => {
    // Browsers request the site's icon by themselves. A missing icon is not a failure.
    const isIcon = new URL(pageResponse.url()).pathname === '/favicon.ico';
    if (pageResponse.status() >= 400 && !isIcon) consoleMessages.push(`${pageResponse.url()} ${pageResponse.status()}`);
  });
}

/** Returns the address of a page of the site. @param {Site} servedSite @param {string} pagePath */
const addressOf = ({ url }, pagePath) => new URL(pagePath.replace(/^\//, ''), url).href;

/** Waits until every figure has drawn its present settings. @param {Page} page @param {Site} servedSite */
export async function waitUntilLive(page, { definition: platformDefinition }) {
  expect(platformDefinition.expectedFigures, 'No figure is expected.').not.toHaveLength(0);
  for (const { selector: figureSelector, properties: figureProperties } of platformDefinition.expectedFigures) {
    const figureLocator = page.locator(figureSelector);
    // A development server may reload the page at any moment. The figure is then awaited again.
    await expect(async () => {
      // An element without height is not visible, so that a locator would wait for it.
      await figureLocator.evaluate((element) => element.scrollIntoView({ block: 'center' }));
      await figureLocator.locator('canvas').first().waitFor();
      expect(await figureLocator.evaluate(propertiesOf, Object.keys(figureProperties)), figureSelector).toEqual(figureProperties);
      await figureLocator.evaluate(waitUntilComplete);
    }).toPass({ timeout: TIMEOUT_MS });
  }
}

/** Returns properties of a figure, with arrays of numbers as plain arrays. Runs in the page. @param {Element} element @param {string[]} propertyNames */
export function propertiesOf(element, propertyNames) {
  const toPlainValue = (/** @type {any} */ propertyValue) => (ArrayBuffer.isView(propertyValue) ? Array.from(/** @type {any} */ (propertyValue)) : propertyValue);
  return Object.fromEntries(propertyNames.map((propertyName) => [propertyName, toPlainValue(/** @type {any} */ (element)[propertyName])]));
}

/** Resolves when a figure has all its samples, and its picture has more than one colour. Runs in the page. @param {Element} element */
export async function waitUntilComplete(element) {
  const figureElement = /** @type {any} */ (element);
  const firstCanvas = /** @type {HTMLCanvasElement} */ (figureElement.shadowRoot.querySelector('canvas'));
  const isDrawn = () => {
    const canvasContext = /** @type {CanvasRenderingContext2D} */ (Object.assign(document.createElement('canvas'), { width: 64, height: 64 }).getContext('2d'));
    canvasContext.drawImage(firstCanvas, 0, 0, 64, 64);
    return new Set(new Uint32Array(canvasContext.getImageData(0, 0, 64, 64).data.buffer)).size > 1;
  };
  while ((figureElement.stats?.n ?? figureElement.stats?.drawn ?? figureElement.stats?.attempts) !== figureElement.samples || !isDrawn()) await new Promise(requestAnimationFrame);
}

/** Opens the page of the figures. @type {(page: Page, site: Site) => Promise<void>} */
async function checkFirstLoad(page, servedSite) {
  await page.goto(addressOf(servedSite, servedSite.definition.pages.figuresPath));
  await waitUntilLive(page, servedSite);
}

/**
 * Follows a link of the page, and waits until the first figure has appeared or disappeared.
 *
 * @param {Page} page
 * @param {Site} servedSite
 * @param {'figuresPath' | 'otherPath'} pathKey
 */
async function followLink(page, { definition: platformDefinition }, pathKey) {
  await platformDefinition.goToPage?.(page, platformDefinition.pages[pathKey] ?? pathKey);
  await page.locator(platformDefinition.expectedFigures[0].selector).waitFor({ state: pathKey === 'figuresPath' ? 'attached' : 'detached' });
}

/** Follows a link away from the figures, and a link back to them. @type {(page: Page, site: Site) => Promise<void>} */
async function checkAwayAndBack(page, servedSite) {
  await checkFirstLoad(page, servedSite);
  await followLink(page, servedSite, 'otherPath');
  await followLink(page, servedSite, 'figuresPath');
  await waitUntilLive(page, servedSite);
}

/**
 * Opens the figure by a link on another page. The figure is created before its class is defined, and must apply properties that were set
 * before.
 * @type {(page: Page, site: Site) => Promise<void>}
 */
async function checkFromOtherPage(page, servedSite) {
  await page.goto(addressOf(servedSite, servedSite.definition.pages.otherPath ?? ''));
  // The platform handles clicks on links only after its script has loaded. The network is idle then.
  await page.waitForLoadState('networkidle');
  await followLink(page, servedSite, 'figuresPath');
  await waitUntilLive(page, servedSite);
}

/** Turns dark mode on and off again. @type {(page: Page, site: Site) => Promise<void>} */
async function checkDarkMode(page, servedSite) {
  const setDarkMode = servedSite.serverMode.setDarkMode ?? servedSite.definition.setDarkMode;
  await checkFirstLoad(page, servedSite);
  for (const isDark of [true, false]) {
    await setDarkMode?.(page, isDark);
    await page.locator(servedSite.definition.expectedFigures[0].selector).evaluate(waitForColorScheme, isDark ? 'dark' : 'light');
  }
}

/** Resolves when a figure has a given colour scheme. Runs in the page. @param {Element} figureElement @param {string} expectedScheme "dark" or "light" */
export async function waitForColorScheme(figureElement, expectedScheme) {
  const figureSurface = /** @type {HTMLElement} */ (figureElement.shadowRoot?.querySelector('.surface'));
  while (getComputedStyle(figureSurface).colorScheme !== expectedScheme) await new Promise(requestAnimationFrame);
}
