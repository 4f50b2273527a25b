// Production builds by bundlers that leave the WebAssembly modules behind: they do not know `new URL(…, import.meta.url)`.

import assert from 'node:assert/strict';
import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { build } from 'esbuild';
import { serve } from '../../scripts/serve.mjs';
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
  writeFileSync(join(project.directory, 'main.js'), "import 'motion-widgets';\n");
});

after(async () => {
  server?.close();
  await browser?.close();
  project?.remove();
});

/** @param {import('esbuild').BuildOptions} options */
const byEsbuild = (options) => async (/** @type {string} */ outdir) => {
  const entryPoints = [join(project.directory, 'main.js')];
  const { warnings } = await build({ entryPoints, outdir, bundle: true, minify: true, logLevel: 'silent', ...options });
  assert.deepEqual(warnings, []);
};

/** Each writes main.js into a directory. @type {Record<string, (outdir: string) => Promise<void>>} */
const BUILDS = {
  'esbuild with chunks': byEsbuild({ format: 'esm', splitting: true }),
  "esbuild in one file, as Hugo's js.Build": byEsbuild({ format: 'esm' }),
  'esbuild as a classic script': byEsbuild({ format: 'iife' }),
};

for (const [name, bundle] of Object.entries(BUILDS)) {
  test(`${name}: a figure is live from the embedded module, and no file is asked for in vain`, async () => {
    const path = name.replaceAll(/\W+/g, '-');
    const directory = join(project.directory, path);
    mkdirSync(directory);
    await bundle(directory);
    const script = `<script ${name.endsWith('classic script') ? 'defer' : 'type="module"'} src="main.js"></script>`;
    writeFileSync(join(directory, 'index.html'), `<!doctype html><link rel="icon" href="data:,">${script}<banana-machine></banana-machine>`);
    const { page, requests } = await openWithCloud(browser, `${server.address}${path}/`);
    assert.deepEqual(requests.filter((address) => address.includes('.wasm')), []);
    await page.close();
  });
}
