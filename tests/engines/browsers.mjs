/**
 * The engines, each with one page that is read and touched in the same way whatever protocol it speaks: WebDriver BiDi where there
 * is one (Chromium, Firefox), WebDriver (WebKit). All of them are told that the reader has asked for less motion, who gets a complete
 * cloud at once: how fast one grows is a matter of frames, of which a busy machine has few.
 *
 * @module
 */

import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import puppeteer from 'puppeteer-core';
import { Builder, Capabilities, Key } from 'selenium-webdriver';
import { CHROME_ARGUMENTS, ensureBrowser } from '../../scripts/browser.mjs';
import { ensureFirefox, ensureWebKit } from '../../scripts/engines.mjs';
import { start } from '../../scripts/process.mjs';
import { program } from '../embeddings/serving.mjs';

/**
 * @typedef {object} Engine
 * @property {string} version
 * @property {(url: string) => Promise<unknown>} open resolved when the page is loaded
 * @property {<G, R>(work: (given: G) => R | Promise<R>, given: G) => Promise<R>} ask what a function says that runs in the
 *   page; it sees nothing from around it, and what it is given and gives is of JSON
 * @property {(way: [x: number, y: number][]) => Promise<unknown>} drag by the left button, from the first point, in CSS pixels of
 *   the window, to the last
 * @property {(key: 'ArrowRight' | 'ArrowLeft' | 'ArrowUp' | 'ArrowDown') => Promise<unknown>} press for what has the focus
 * @property {() => Promise<Uint8Array>} screenshot as PNG
 * @property {() => string[]} complaints that it had of the page, beside what the page has noted itself
 * @property {() => Promise<unknown>} close
 */

/** Of the page inside of the window, CSS pixels. */
const SIZE = { width: 1280, height: 800 };

/** Milliseconds that a script in a page may take: all machines of the digest. */
const PATIENCE = 240_000;

/**
 * @param {import('puppeteer-core').LaunchOptions} options
 * @returns {Promise<Engine>}
 */
async function byBiDi(options) {
  const browser = await puppeteer.launch({ ...options, protocol: 'webDriverBiDi', defaultViewport: SIZE, protocolTimeout: PATIENCE });
  const page = await browser.newPage();
  page.setDefaultTimeout(PATIENCE);
  /** @type {string[]} */
  const complaints = [];
  page.on('console', (message) => {
    if (['error', 'warn', 'assert'].includes(message.type())) complaints.push(message.text());
  });
  page.on('pageerror', (error) => complaints.push(String(error)));
  page.on('requestfailed', (request) => complaints.push(`${request.url()} ${request.failure()?.errorText}`));
  page.on('response', (response) => {
    if (response.status() >= 400) complaints.push(`${response.url()} ${response.status()}`);
  });
  return {
    version: (await browser.version()).split('/')[1],
    open: (url) => page.goto(url, { waitUntil: 'load' }),
    // Its type has no place for what is awaited.
    ask: (work, given) => /** @type {Promise<any>} */ (page.evaluate(/** @type {any} */ (work), given)),
    async drag([[x, y], ...way]) {
      await page.mouse.move(x, y);
      await page.mouse.down();
      for (const [x, y] of way) await page.mouse.move(x, y);
      await page.mouse.up();
    },
    press: (key) => page.keyboard.press(key),
    screenshot: () => page.screenshot(),
    complaints: () => complaints,
    close: () => browser.close(),
  };
}

/** @returns {Promise<Engine>} */
async function chromium() {
  const { chrome } = await ensureBrowser();
  return byBiDi({ browser: 'chrome', executablePath: chrome, args: [...CHROME_ARGUMENTS, '--force-prefers-reduced-motion'] });
}

/** @returns {Promise<Engine>} */
async function firefox() {
  return byBiDi({ browser: 'firefox', executablePath: await ensureFirefox(), extraPrefsFirefox: { 'ui.prefersReducedMotion': 1 } });
}

/** @returns {Promise<Engine>} */
async function webkit() {
  const { driver, browser, display } = await ensureWebKit();
  const screen = await displayOf(display);
  const config = mkdtempSync(join(tmpdir(), 'motion-engines-'));
  mkdirSync(join(config, 'gtk-3.0'));
  writeFileSync(join(config, 'gtk-3.0/settings.ini'), '[Settings]\ngtk-enable-animations=false\n');
  const env = { DISPLAY: screen.name, XDG_CONFIG_HOME: config };
  const server = await program((port) => [driver, [`--port=${port}`], env], '/status')('', {
    start: (command, args) => start(command, args, { env }),
    run: () => Promise.reject(new Error('It runs nothing.')),
  });
  const stop = async () => {
    await server.stop();
    await screen.stop();
    rmSync(config, { recursive: true });
  };
  try {
    return await byWebDriver(server.url.replace('/status', ''), browser, stop);
  } catch (error) {
    await stop();
    throw error;
  }
}

/**
 * @param {string} url of the driver
 * @param {string} binary
 * @param {() => Promise<void>} stop
 * @returns {Promise<Engine>}
 */
async function byWebDriver(url, binary, stop) {
  const capabilities = new Capabilities({ browserName: 'MiniBrowser', 'webkitgtk:browserOptions': { binary, args: ['--automation'] } });
  const session = await new Builder().usingServer(url).withCapabilities(capabilities).build();
  await session.manage().setTimeouts({ script: PATIENCE, pageLoad: PATIENCE });
  const window = session.manage().window();
  const inside = async () => /** @type {number[]} */ (await session.executeScript('return [innerWidth, innerHeight]'));
  await window.setRect(SIZE);
  const [width, height] = await inside();
  await window.setRect({ width: 2 * SIZE.width - width, height: 2 * SIZE.height - height });
  const mouse = () => session.actions({ async: false });
  return {
    version: (await session.getCapabilities()).get('browserVersion'),
    open: (url) => session.get(url),
    async ask(work, given) {
      const [result, error] = /** @type {[any, string?]} */ (
        await session.executeAsyncScript(
          `const [given, done] = arguments; (async () => (${work})(given))().then((result) => done([result]), (error) => done([null, String(error.stack || error)]));`,
          given,
        )
      );
      if (error) throw new Error(error);
      return result;
    },
    async drag([[x, y], ...way]) {
      await mouse().move({ x, y, duration: 0 }).press().perform();
      for (const [x, y] of way) await mouse().move({ x, y, duration: 0 }).perform();
      await mouse().release().perform();
    },
    press: (key) => session.actions().sendKeys(KEYS[key]).perform(),
    screenshot: async () => Buffer.from(await session.takeScreenshot(), 'base64'),
    complaints: () => [],
    async close() {
      await session.quit();
      await stop();
    },
  };
}

const KEYS = { ArrowRight: Key.ARROW_RIGHT, ArrowLeft: Key.ARROW_LEFT, ArrowUp: Key.ARROW_UP, ArrowDown: Key.ARROW_DOWN };

/**
 * A screen that nobody looks at.
 *
 * @param {string} program
 * @returns {Promise<{ name: string, stop: () => Promise<void> }>}
 */
async function displayOf(program) {
  // It takes the first number that is free, and tells it when it is ready.
  const display = start(program, ['-displayfd', '1', '-screen', '0', '1600x1200x24', '-nolisten', 'tcp']);
  const number = await display.said(/^(\d+)\n/m);
  return { name: `:${number}`, stop: display.stop };
}

/** By the names that the command line takes. @type {Record<string, () => Promise<Engine>>} */
export const engines = { chromium, firefox, webkit };
