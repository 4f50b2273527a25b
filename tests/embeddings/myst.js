/**
 * What can be had of MyST from package registries: its parser and its theme's renderer of widgets, which imports the
 * module into a shadow root and gives it a model that keeps nothing. The theme itself is downloaded from elsewhere.
 */

import assert from 'node:assert/strict';
import { copyFileSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { build as bundle } from 'esbuild';
import { ROOT } from '../../scripts/process.mjs';
import { live, settled } from './checks.mjs';
import { files } from './serving.mjs';

const PACKAGES = { 'myst-parser': '1.7.3', '@myst-theme/anywidget': '1.4.1', react: '19.2.0', 'react-dom': '19.2.0' };

const PAGE = '<!doctype html><html lang="en"><meta charset="utf-8"><title>Motion models</title><link rel="icon" href="data:,"><div id="root"></div><script type="module" src="./host.js"></script></html>';

/** @type {import('./project.mjs').Engine} */
export default {
  heading: 'MyST',
  versions: () => Object.entries(PACKAGES).slice(0, 2).map(([name, version]) => `${name} ${version}`).join(', '),
  async install(directory, { run, tarball }) {
    writeFileSync(join(directory, 'package.json'), '{ "private": true, "type": "module" }');
    const packages = Object.entries(PACKAGES).map(([name, version]) => `${name}@${version}`);
    await run('npm', ['install', '--ignore-scripts', '--no-audit', '--no-fund', '--prefer-offline', '--loglevel', 'error', ...packages, tarball]);
  },
  async build(directory) {
    const modules = join(directory, 'node_modules');
    const { mystParse } = await import(pathToFileURL(join(modules, 'myst-parser/dist/index.js')).href);
    const chapter = mystParse(readFileSync(join(directory, 'motion.md'), 'utf8'));
    /** @type {(node: any) => any[]} */
    const widgetsIn = (node) => (node.type === 'anywidget' ? [node] : (node.children ?? []).flatMap(widgetsIn));
    writeFileSync(join(directory, 'nodes.json'), JSON.stringify(widgetsIn(chapter)));
    copyFileSync(join(ROOT, 'tests/embeddings/myst-host.mjs'), join(directory, 'host.mjs'));
    copyFileSync(join(modules, 'motion-widgets/dist/anywidget.js'), join(directory, 'anywidget.js'));
    writeFileSync(join(directory, 'index.html'), PAGE);
    const define = { 'process.env.NODE_ENV': '"production"' };
    await bundle({ entryPoints: [join(directory, 'host.mjs')], outfile: join(directory, 'host.js'), bundle: true, format: 'esm', define, logLevel: 'error' });
  },
  servings: [
    {
      name: "the theme's renderer",
      serve: files('.'),
      checks: {
        async 'live, and again after another chapter'(page, site) {
          await page.goto(site.url);
          await live(page, site);
          for (let i = 0; i < 3; i++) {
            await page.getByRole('button', { name: 'Next chapter' }).click();
            await page.locator('banana-machine').waitFor({ state: 'detached' });
            await page.getByRole('button', { name: 'Back' }).click();
            await live(page, site);
          }
        },
        async 'the reader changes what nobody keeps'(page, site) {
          await page.goto(site.url);
          await live(page, site);
          const slider = page.locator('banana-machine').getByRole('slider', { name: /ω/ }).first();
          await slider.focus();
          await page.keyboard.press('ArrowRight');
          await page.keyboard.press('Tab');
          await settled(page);
          assert.notEqual(await page.locator('banana-machine').evaluate((element) => /** @type {any} */ (element).omega), 0.8);
        },
      },
    },
  ],
  pages: { first: '', second: '' },
  go: async () => {},
  expected: [
    { selector: 'banana-machine', properties: { omega: 0.8, samples: 20000, alphas: [0.1, 0.1, 0.1, 0.1, 0.01, 0.01] } },
    { selector: 'map-squeeze', properties: { preset: 'corridor', samples: 1000 } },
  ],
};
