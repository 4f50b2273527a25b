// Ways to embed the package as npm packs it: plain pages, and production builds of bundlers.

import assert from 'node:assert/strict';
import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { build } from 'esbuild';
import { rollup } from 'rollup';
import { REPOSITORY_ROOT } from '../../scripts/process.mjs';
import { openWithCloud, serveProject } from './support.js';

const installedProject = serveProject(() => writeFileSync(join(installedProject.directory, 'main.js'), "import 'motion-widgets';\n"));

test('the example page with a module script shows its figure', async () => {
  await openWithCloud(installedProject, `${installedProject.address}plain/`);
});

test('an iframe in the example adapts its height to its figure', async () => {
  const { page } = await openWithCloud(installedProject, `${installedProject.address}iframe/`);
  const readHeights = () =>
    page.evaluate(() => {
      const iframeElement = /** @type {HTMLIFrameElement} */ (document.querySelector('iframe'));
      const innerRoot = /** @type {Document} */ (iframeElement.contentDocument).documentElement;
      return { frameHeight: iframeElement.clientHeight, contentHeight: innerRoot.scrollHeight, scrolls: innerRoot.scrollHeight > innerRoot.clientHeight };
    });
  for (const pageWidth of [1100, 420]) {
    await page.setViewportSize({ width: pageWidth, height: 800 });
    await page.waitForFunction(() => {
      const iframeElement = /** @type {HTMLIFrameElement} */ (document.querySelector('iframe'));
      const innerBody = /** @type {Document} */ (iframeElement.contentDocument).body;
      return iframeElement.style.height === `${Math.ceil(innerBody.getBoundingClientRect().height)}px`;
    });
    const { frameHeight, contentHeight, scrolls } = await readHeights();
    assert.equal(frameHeight, contentHeight);
    assert.ok(!scrolls);
  }
});

test('an iframe names the error in its address @nightly', async () => {
  const page = await installedProject.browser.newPage();
  for (const [urlQuery, expectedMessage] of [
    ['', /widget is missing; allowed is banana-machine or map-squeeze/],
    ['?widget=banana', /widget is "banana"; allowed is/],
    ['?widget=banana-machine&omga=1', /omga is an unknown parameter of banana-machine; allowed are .*\bomega\b/],
    ['?widget=map-squeeze&v=1&v=2', /v is given more than once/],
  ]) {
    await page.goto(`${installedProject.address}iframe/embed.html${urlQuery}`);
    assert.match(await page.getByRole('alert').innerText(), /** @type {RegExp} */ (expectedMessage));
  }
});

test('the example page with a classic script works from a server and from a disk', async () => {
  const fileAddress = pathToFileURL(join(installedProject.directory, 'classic-script/index.html')).href;
  for (const pageUrl of [`${installedProject.address}classic-script/`, fileAddress]) {
    const { requests: requestedUrls } = await openWithCloud(installedProject, pageUrl);
    assert.equal(requestedUrls.length, 3, requestedUrls.join(' '));
  }
});

test('the single-file page for classrooms works from a disk', async () => {
  const { href } = pathToFileURL(join(REPOSITORY_ROOT, 'dist/classroom.html'));
  assert.deepEqual((await openWithCloud(installedProject, href)).requests, [href]);
});

// Esbuild and Rollup do not copy the WebAssembly modules to their output: they do not process `new URL(…, import.meta.url)`.

/** Returns a function by which esbuild bundles main.js into a directory. @param {import('esbuild').BuildOptions} buildOptions */
const createEsbuildBundler = (buildOptions) => async (/** @type {string} */ outputDirectory) => {
  const entryPoints = [join(installedProject.directory, 'main.js')];
  const { warnings: consoleWarnings } = await build({ entryPoints, outdir: outputDirectory, bundle: true, minify: true, logLevel: 'silent', ...buildOptions });
  assert.deepEqual(consoleWarnings, []);
};

/** Bundlers by the names of their tests. Each bundler writes main.js into a directory. @type {Record<string, (outdir: string) => Promise<void>>} */
const BUNDLERS = {
  'esbuild with chunks': createEsbuildBundler({ format: 'esm', splitting: true }),
  "esbuild in one file, as Hugo's js.Build": createEsbuildBundler({ format: 'esm' }),
  'esbuild as a classic script': createEsbuildBundler({ format: 'iife' }),
  async Rollup(outputDirectory) {
    // Rollup needs a plugin to find packages.
    const rollupBundle = await rollup({ input: { main: join(installedProject.directory, 'node_modules/motion-widgets/dist/external.js') } });
    await rollupBundle.write({ dir: outputDirectory });
  },
};

for (const [bundlerName, writeBundle] of Object.entries(BUNDLERS)) {
  test(`${bundlerName}: a figure runs with the embedded module, and no request fails${bundlerName.includes('chunks') ? '' : ' @nightly'}`, async () => {
    const directoryName = bundlerName.replaceAll(/\W+/g, '-');
    const outputDirectory = join(installedProject.directory, directoryName);
    mkdirSync(outputDirectory);
    await writeBundle(outputDirectory);
    const scriptTag = `<script ${bundlerName.endsWith('classic script') ? 'defer' : 'type="module"'} src="main.js"></script>`;
    writeFileSync(join(outputDirectory, 'index.html'), `<!doctype html><link rel="icon" href="data:,">${scriptTag}<banana-machine></banana-machine>`);
    const { requests: requestedUrls } = await openWithCloud(installedProject, `${installedProject.address}${directoryName}/`);
    assert.deepEqual(requestedUrls.filter((pageAddress) => pageAddress.includes('.wasm')), []);
  });
}
