import assert from 'node:assert/strict';
import { waitUntilLive } from './checks.mjs';
import { installNpmPackages, pinnedVersionsOf } from './project.mjs';
import { serveFiles } from './serving.mjs';

/** @type {NonNullable<import('./project.mjs').ServerMode['checks']>} */
const SLIDE_CHECKS = {
  async 'a figure fits its slide, keeps its keys, and is presented'(page, servedSite) {
    await page.goto(new URL('index.html#/1', servedSite.url).href);
    await waitUntilLive(page, servedSite);
    const bananaMachine = page.locator('banana-machine');
    assert.ok((await bananaMachine.evaluate((element) => element.clientHeight)) <= 700);
    await bananaMachine.getByRole('button', { name: 'Pivot' }).press('Space');
    assert.equal(new URL(page.url()).hash, '#/1');
    await bananaMachine.evaluate((element) => Object.assign(element, { presentation: true }));
    await page.waitForFunction(() => document.querySelector('banana-machine')?.getBoundingClientRect().width === innerWidth);
  },
};

/** @type {import('./project.mjs').Platform} */
export default {
  heading: 'reveal.js',
  readVersions: () => pinnedVersionsOf('reveal', 'reveal.js'),
  installPackages: installNpmPackages,
  serverModes: [{ name: 'page', serve: serveFiles('.'), checks: SLIDE_CHECKS }],
  pages: { figuresPath: '/' },
  expectedFigures: [{ selector: 'banana-machine', properties: { omega: 0.8, samples: 20000 } }],
};
