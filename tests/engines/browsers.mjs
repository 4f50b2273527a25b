/**
 * The browser engines, driven by WebDriver. All of them report reduced motion, so that clouds are complete at once. The growth of a cloud
 * would depend on the number of frames, and so on the load of the computer.
 *
 * @module
 */

import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { Builder, Capabilities, Key } from 'selenium-webdriver';
import { CHROME_ARGUMENTS, ensureBrowser } from '../../scripts/browser.mjs';
import { program, start } from '../embeddings/serving.mjs';
import { ensureFirefox, ensureWebKit } from './programs.mjs';

/**
 * @typedef {object} Engine
 * @property {string} version
 * @property {(url: string) => Promise<unknown>} open resolved when the page is loaded
 * @property {<G, R>(work: (given: G) => R | Promise<R>, given: G) => Promise<R>} ask calls a function in the page; it has no access
 *   to variables around it, and its argument and result are JSON
 * @property {(points: [x: number, y: number][]) => Promise<unknown>} drag with the left button along points, in CSS pixels of the window
 * @property {(key: 'ArrowRight' | 'ArrowLeft' | 'ArrowUp' | 'ArrowDown') => Promise<unknown>} press a key, for the element with the focus
 * @property {() => Promise<Uint8Array>} screenshot as PNG
 * @property {() => Promise<unknown>} close
 */

/** Size of the page within the window of the browser, CSS pixels. */
const PAGE_SIZE = { width: 1280, height: 800 };

/** Time limit of a script in a page, ms. The digest of all simulations takes longest. */
const SCRIPT_TIMEOUT = 240_000;

const KEYS = { ArrowRight: Key.ARROW_RIGHT, ArrowLeft: Key.ARROW_LEFT, ArrowUp: Key.ARROW_UP, ArrowDown: Key.ARROW_DOWN };

/** @returns {Promise<Engine>} */
async function chromium() {
  const { chrome, driver } = await ensureBrowser();
  const args = [...CHROME_ARGUMENTS, '--headless=new', '--force-prefers-reduced-motion'];
  return engineWith(driver, {}, { browserName: 'chrome', 'goog:chromeOptions': { binary: chrome, args } });
}

/** @returns {Promise<Engine>} */
async function firefox() {
  const { firefox, driver } = await ensureFirefox();
  const prefs = { 'ui.prefersReducedMotion': 1 };
  return engineWith(driver, {}, { browserName: 'firefox', 'moz:firefoxOptions': { binary: firefox, args: ['-headless'], prefs } });
}

/** @returns {Promise<Engine>} */
async function webkit() {
  const { driver, browser, display } = await ensureWebKit();
  // Xvfb takes the first number that is free, and prints it when it is ready.
  const screen = start(display, ['-displayfd', '1', '-screen', '0', '1600x1200x24', '-nolisten', 'tcp']);
  const number = await screen.said(/^(\d+)\n/m);
  const config = mkdtempSync(join(tmpdir(), 'motion-engines-'));
  mkdirSync(join(config, 'gtk-3.0'));
  writeFileSync(join(config, 'gtk-3.0/settings.ini'), '[Settings]\ngtk-enable-animations=false\n');
  const env = { DISPLAY: `:${number}`, XDG_CONFIG_HOME: config };
  const capabilities = { browserName: 'MiniBrowser', 'webkitgtk:browserOptions': { binary: browser, args: ['--automation'] } };
  return engineWith(driver, env, capabilities, async () => {
    await screen.stop();
    rmSync(config, { recursive: true });
  });
}

/**
 * @param {string} driver program that speaks WebDriver
 * @param {Record<string, string>} env
 * @param {object} capabilities
 * @param {() => Promise<unknown>} [end] called after the driver has ended
 * @returns {Promise<Engine>}
 */
async function engineWith(driver, env, capabilities, end = async () => {}) {
  const server = await program((port) => [driver, [`--port=${port}`], env], '/status')('', {
    start: (command, args) => start(command, args, { env }),
    run: () => Promise.reject(new Error('It runs nothing.')),
  });
  const stop = async () => {
    await server.stop();
    await end();
  };
  try {
    return await inSession(server.url.replace('/status', ''), capabilities, stop);
  } catch (error) {
    await stop();
    throw error;
  }
}

/**
 * @param {string} url of the driver
 * @param {object} capabilities
 * @param {() => Promise<void>} stop
 * @returns {Promise<Engine>}
 */
async function inSession(url, capabilities, stop) {
  const session = await new Builder().usingServer(url).withCapabilities(new Capabilities(/** @type {any} */ (capabilities))).build();
  await session.manage().setTimeouts({ script: SCRIPT_TIMEOUT, pageLoad: SCRIPT_TIMEOUT });
  const window = session.manage().window();
  await window.setRect(PAGE_SIZE);
  const [width, height] = /** @type {number[]} */ (await session.executeScript('return [innerWidth, innerHeight]'));
  await window.setRect({ width: 2 * PAGE_SIZE.width - width, height: 2 * PAGE_SIZE.height - height });
  return {
    version: (await session.getCapabilities()).get('browserVersion'),
    open: (url) => session.get(url),
    async ask(work, given) {
      // Run by a script of the page: Firefox runs scripts of WebDriver in a sandbox, whose arrays are not of the page's type.
      const run = `(async () => (${work})(${JSON.stringify(given) ?? 'undefined'}))().then((result) => [result], (error) => [null, \`\${error}\\n\${error.stack}\`])`;
      const answer = await session.executeAsyncScript(
        `const [run, done] = arguments;
        const script = document.createElement('script');
        script.textContent = run;
        addEventListener('answer', () => done(script.dataset.answer), { once: true });
        document.head.append(script);`,
        `{ const script = document.currentScript; ${run}.then((answer) => { script.dataset.answer = JSON.stringify(answer); script.remove(); dispatchEvent(new Event('answer')); }); }`,
      );
      const [result, error] = /** @type {[any, string?]} */ (JSON.parse(answer));
      if (error) throw new Error(error);
      return result;
    },
    async drag([[x, y], ...points]) {
      // One chain of actions: some drivers release the button between two chains. Each move takes longer than a frame.
      const actions = session.actions({ async: false }).move({ x, y, duration: 0 }).press();
      for (const [x, y] of points) actions.move({ x, y, duration: 40 });
      await actions.release().perform();
    },
    press: (key) => session.actions().sendKeys(KEYS[key]).perform(),
    screenshot: async () => Buffer.from(await session.takeScreenshot(), 'base64'),
    async close() {
      await session.quit();
      await stop();
    },
  };
}

/** Functions that start the engines, by the names that the command line takes. @type {Record<string, () => Promise<Engine>>} */
export const engineStarters = { chromium, firefox, webkit };
