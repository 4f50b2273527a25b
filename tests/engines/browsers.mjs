// Browser engines, driven by WebDriver. All engines report reduced motion, so that clouds are complete immediately. A growing cloud would
// depend on the number of frames, and therefore on the load of the computer.

import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { Builder, Capabilities, Key } from 'selenium-webdriver';
import { CHROME_ARGUMENTS, ensureBrowser } from '../../scripts/browser.mjs';
import { serveByProgram, startProgram } from '../embeddings/serving.mjs';
import { ensureFirefox, ensureWebKit } from './programs.mjs';

/**
 * @typedef {object} BrowserSession
 * @property {string} browserVersion
 * @property {(url: string) => Promise<unknown>} openPage resolved when the page is loaded
 * @property {<G, R>(work: (given: G) => R | Promise<R>, given: G) => Promise<R>} callInPage calls a function in the page; it has no access
 *   to variables around it, and its argument and result are JSON
 * @property {(points: [x: number, y: number][]) => Promise<unknown>} dragAlong drags with the left button along points, in CSS pixels of the window
 * @property {(...keys: (keyof typeof KEY_CODES)[]) => Promise<unknown>} pressKeys presses keys one after the other, for the element with the focus
 * @property {() => Promise<Uint8Array>} takeScreenshot returns a PNG
 * @property {() => Promise<unknown>} endSession closes the browser
 */

/** Size of the page within the window of the browser, CSS pixels. */
const PAGE_SIZE = { width: 1280, height: 800 };

/** Time limit of a script in a page, ms. The longest script computes hashes of the results of all simulations. */
const SCRIPT_TIMEOUT_MS = 240_000;

const KEY_CODES = { ArrowRight: Key.ARROW_RIGHT, ArrowLeft: Key.ARROW_LEFT, ArrowUp: Key.ARROW_UP, ArrowDown: Key.ARROW_DOWN };

/** Starts Chromium. @returns {Promise<BrowserSession>} */
async function startChromium() {
  const { chromePath, driverPath } = await ensureBrowser();
  const chromeArguments = [...CHROME_ARGUMENTS, '--headless=new', '--force-prefers-reduced-motion'];
  return startBrowserByDriver(driverPath, {}, { browserName: 'chrome', 'goog:chromeOptions': { binary: chromePath, args: chromeArguments } });
}

/** Starts Firefox. @returns {Promise<BrowserSession>} */
async function startFirefox() {
  const { firefoxPath, driverPath } = await ensureFirefox();
  const firefoxPreferences = { 'ui.prefersReducedMotion': 1 };
  return startBrowserByDriver(driverPath, {}, { browserName: 'firefox', 'moz:firefoxOptions': { binary: firefoxPath, args: ['-headless'], prefs: firefoxPreferences } });
}

/** Starts WebKit's MiniBrowser on a virtual screen. @returns {Promise<BrowserSession>} */
async function startWebKit() {
  const { driverPath, xvfbPath } = await ensureWebKit();
  // Xvfb takes the first free display number, and prints it when it is ready.
  const xvfbProcess = startProgram(xvfbPath, ['-displayfd', '1', '-screen', '0', '1600x1200x24', '-nolisten', 'tcp']);
  const displayNumber = await xvfbProcess.waitForOutput(/^(\d+)\n/m);
  const configDirectory = mkdtempSync(join(tmpdir(), 'motion-engines-'));
  mkdirSync(join(configDirectory, 'gtk-3.0'));
  writeFileSync(join(configDirectory, 'gtk-3.0/settings.ini'), '[Settings]\ngtk-enable-animations=false\n');
  const displayEnvironment = { DISPLAY: `:${displayNumber}`, XDG_CONFIG_HOME: configDirectory };
  // WebKit's driver starts MiniBrowser by itself.
  return startBrowserByDriver(driverPath, displayEnvironment, { browserName: 'MiniBrowser' }, async () => {
    await xvfbProcess.stop();
    rmSync(configDirectory, { recursive: true });
  });
}

/**
 * Starts a browser by its WebDriver program.
 *
 * @param {string} driverPath program that speaks WebDriver
 * @param {Record<string, string>} driverEnvironment
 * @param {object} browserCapabilities
 * @param {() => Promise<unknown>} [cleanUp] called after the driver has ended
 * @returns {Promise<BrowserSession>}
 */
async function startBrowserByDriver(driverPath, driverEnvironment, browserCapabilities, cleanUp = async () => {}) {
  const driverServer = await serveByProgram((port) => [driverPath, [`--port=${port}`], driverEnvironment], '/status')('', {
    start: (command, args) => startProgram(command, args, { env: driverEnvironment }),
    run: () => Promise.reject(new Error('It runs nothing.')),
  });
  const stopDriver = async () => {
    await driverServer.stop();
    await cleanUp();
  };
  try {
    return await openSession(driverServer.url.replace('/status', ''), browserCapabilities, stopDriver);
  } catch (error) {
    await stopDriver();
    throw error;
  }
}

/**
 * Opens a session of a running driver.
 *
 * @param {string} driverUrl
 * @param {object} capabilities
 * @param {() => Promise<void>} stopDriver
 * @returns {Promise<BrowserSession>}
 */
async function openSession(driverUrl, capabilities, stopDriver) {
  const driverSession = await new Builder().usingServer(driverUrl).withCapabilities(new Capabilities(/** @type {any} */ (capabilities))).build();
  await driverSession.manage().setTimeouts({ script: SCRIPT_TIMEOUT_MS, pageLoad: SCRIPT_TIMEOUT_MS });
  const browserWindow = driverSession.manage().window();
  await browserWindow.setRect(PAGE_SIZE);
  const [innerWidth, innerHeight] = /** @type {number[]} */ (await driverSession.executeScript('return [innerWidth, innerHeight]'));
  await browserWindow.setRect({ width: 2 * PAGE_SIZE.width - innerWidth, height: 2 * PAGE_SIZE.height - innerHeight });
  return {
    browserVersion: (await driverSession.getCapabilities()).get('browserVersion'),
    openPage: (pageUrl) => driverSession.get(pageUrl),
    async callInPage(pageFunction, functionArgument) {
      // A script of the page runs the function. Firefox runs scripts of WebDriver in a sandbox, whose arrays differ in type from arrays of
      // the page.
      const pageScript = `(async () => (${pageFunction})(${JSON.stringify(functionArgument) ?? 'undefined'}))().then((result) => [result], (error) => [null, \`\${error}\\n\${error.stack}\`])`;
      const answerJson = await driverSession.executeAsyncScript(
        `const [run, done] = arguments;
        const script = document.createElement('script');
        script.textContent = run;
        addEventListener('answer', () => done(script.dataset.answer), { once: true });
        document.head.append(script);`,
        `{ const script = document.currentScript; ${pageScript}.then((answer) => { script.dataset.answer = JSON.stringify(answer); script.remove(); dispatchEvent(new Event('answer')); }); }`,
      );
      const [functionResult, error] = /** @type {[any, string?]} */ (JSON.parse(answerJson));
      if (error) throw new Error(error);
      return functionResult;
    },
    async dragAlong([[x, y], ...nextPoints]) {
      // The drag is one chain of actions, because some drivers release the mouse button between two chains. Each move takes longer than an
      // animation frame.
      const dragActions = driverSession.actions({ async: false }).move({ x, y, duration: 0 }).press();
      for (const [x, y] of nextPoints) dragActions.move({ x, y, duration: 40 });
      await dragActions.release().perform();
    },
    pressKeys: (...keyNames) => driverSession.actions().sendKeys(...keyNames.map((keyName) => KEY_CODES[keyName])).perform(),
    takeScreenshot: async () => Buffer.from(await driverSession.takeScreenshot(), 'base64'),
    async endSession() {
      await driverSession.quit();
      await stopDriver();
    },
  };
}

/** Functions that start the engines, by the engine names of the command line. @type {Record<string, () => Promise<BrowserSession>>} */
export const browserStarters = { chromium: startChromium, firefox: startFirefox, webkit: startWebKit };
