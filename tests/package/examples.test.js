// Each way to embed, as a stranger would have it: the packed package, the examples, and their own tools.

import assert from 'node:assert/strict';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { build as viteBuild, createServer as viteServer } from 'vite';
import webpack from 'webpack';
import { serve } from '../../scripts/serve.mjs';
import { MOST_SHIFT, comeLate } from '../embeddings/checks.mjs';
import { shifts, textOf, watchShifts } from '../embeddings/looking.mjs';
import { installed, launch, openWithCloud } from './support.js';

/** @type {ReturnType<typeof installed>} */
let project;
/** @type {import('@playwright/test').Browser} */
let browser;
/** @type {Awaited<ReturnType<typeof serve>>} */
let server;

before(async () => {
  project = installed();
  browser = await launch();
  server = await serve(project.directory, { port: 0 });
});

after(async () => {
  server?.close();
  await browser?.close();
  project?.remove();
});

/** @param {string[]} requests */
const wasmIn = (requests) => requests.filter((address) => address.includes('.wasm'));

test('a page with a module script', async () => {
  const { page, requests } = await openWithCloud(browser, `${server.address}plain/`);
  // Everything is inside: the page, a stylesheet and one script.
  assert.equal(requests.length, 3, requests.join(' '));
  await page.close();
});

test('a frame that takes the height of its widget', async () => {
  const { page } = await openWithCloud(browser, `${server.address}iframe/`);
  const heightOf = () =>
    page.evaluate(() => {
      const frame = /** @type {HTMLIFrameElement} */ (document.querySelector('iframe'));
      const inside = /** @type {Document} */ (frame.contentDocument).documentElement;
      return { given: frame.clientHeight, needed: inside.scrollHeight, scrolls: inside.scrollHeight > inside.clientHeight };
    });
  for (const width of [1100, 420]) {
    await page.setViewportSize({ width, height: 800 });
    await page.waitForFunction(() => {
      const frame = /** @type {HTMLIFrameElement} */ (document.querySelector('iframe'));
      const body = /** @type {Document} */ (frame.contentDocument).body;
      return frame.style.height === `${Math.ceil(body.getBoundingClientRect().height)}px`;
    });
    const { given, needed, scrolls } = await heightOf();
    assert.equal(given, needed);
    assert.ok(!scrolls);
  }
  await page.close();
});

test('a frame names what is wrong with its address', async () => {
  const page = await browser.newPage();
  for (const [query, sentence] of [
    ['', /widget is missing; allowed is banana-machine or map-squeeze/],
    ['?widget=banana', /widget is "banana"; allowed is/],
    ['?widget=banana-machine&omga=1', /omga is an unknown parameter of banana-machine; allowed are .*\bomega\b/],
    ['?widget=map-squeeze&v=1&v=2', /v is given more than once/],
  ]) {
    await page.goto(`${server.address}iframe/node_modules/motion-widgets/dist/embed.html${query}`);
    assert.match(await page.getByRole('alert').innerText(), /** @type {RegExp} */ (sentence));
  }
  await page.close();
});

test('a classic script, from a server and from a disk', async () => {
  const fromDisk = pathToFileURL(join(project.directory, 'classic-script/index.html')).href;
  for (const address of [`${server.address}classic-script/`, fromDisk]) {
    const { page, requests } = await openWithCloud(browser, address);
    assert.equal(requests.length, 3, requests.join(' '));
    await page.close();
  }
});

test('nothing on a page moves when its figure comes, and the figure has its letters', async () => {
  for (const example of ['plain', 'classic-script', 'iframe']) {
    for (const viewport of [{ width: 1280, height: 800 }, { width: 375, height: 812 }]) {
      const { page } = await openWithCloud(browser, `${server.address}${example}/`, async (page) => {
        await page.setViewportSize(viewport);
        await page.addInitScript(watchShifts);
        await comeLate(page);
      });
      const { total, sources } = await page.evaluate(shifts, false);
      assert.ok(total < MOST_SHIFT, `${example} at ${viewport.width} px: things moved by ${total}: ${sources.join('; ')}`);
      if (example !== 'iframe') {
        const { page: around, figure } = await page.locator('banana-machine').evaluate(textOf);
        assert.deepEqual(figure, around, example);
      }
      await page.close();
    }
  }
});

test('the one file of a classroom, from a disk', async () => {
  const page = join(project.directory, 'node_modules/motion-widgets/dist/classroom.html');
  const opened = await openWithCloud(browser, pathToFileURL(page).href);
  assert.deepEqual(opened.requests, [pathToFileURL(page).href]);
  await opened.page.close();
});

test('Vite, building and developing', async () => {
  const root = join(project.directory, 'vite');
  const configFile = join(root, 'vite.config.js');
  await viteBuild({ root, configFile, logLevel: 'warn' });
  const built = await openWithCloud(browser, `${server.address}vite/dist/`);
  assert.equal(wasmIn(built.requests).length, 1, built.requests.join(' '));
  await built.page.close();

  const developing = await viteServer({ root, configFile, logLevel: 'warn', server: { port: 0, host: 'localhost' } });
  try {
    await developing.listen();
    const address = developing.resolvedUrls?.local[0];
    assert.ok(address);
    const { page, requests } = await openWithCloud(browser, address);
    assert.equal(wasmIn(requests).length, 1, requests.join(' '));
    await page.close();
  } finally {
    await developing.close();
  }
});

test('webpack', async () => {
  const context = join(project.directory, 'webpack');
  const { default: config } = await import(pathToFileURL(join(context, 'webpack.config.js')).href);
  const stats = await new Promise((resolve, reject) => {
    const output = { ...config.output, path: join(context, 'dist') };
    webpack({ ...config, context, output }, (error, result) => (error ? reject(error) : resolve(result)));
  });
  assert.deepEqual(stats.toJson({ all: false, errors: true }).errors, []);
  const { page, requests } = await openWithCloud(browser, `${server.address}webpack/dist/`);
  assert.equal(wasmIn(requests).length, 1, requests.join(' '));
  await page.close();
});
