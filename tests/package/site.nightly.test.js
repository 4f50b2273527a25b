// Site that `npm run build:site` writes. Each page is opened on a phone, with its figures. The build script checks the links.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { join } from 'node:path';
import { test } from 'node:test';
import { REPOSITORY_ROOT, filesOf } from '../../scripts/process.mjs';
import { serveDirectory } from './support.js';

const builtSite = serveDirectory(() => {
  execFileSync(process.execPath, [join(REPOSITORY_ROOT, 'scripts/site.mjs')], { stdio: 'inherit' });
  return join(REPOSITORY_ROOT, 'build/site');
}, '/book/');

test('pages of the site fit a phone, load without errors, and start their figures', async () => {
  const page = await builtSite.openPage({ viewport: { width: 375, height: 800 } });
  const pagePaths = filesOf('build/site').map((filePath) => filePath.slice('build/site/'.length)).filter((filePath) => /^(?!rust|classroom|embed\.).*html$/.test(filePath));
  let figureCount = 0;
  for (const filePath of pagePaths) {
    await page.goto(builtSite.address + filePath);
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `${filePath} is too wide`);
    for (const figureLocator of await page.locator('main :is(banana-machine, map-squeeze)').all()) {
      await figureLocator.evaluate((figureElement) => figureElement.scrollIntoView());
      await figureLocator.locator('canvas').first().waitFor();
      figureCount++;
    }
  }
  assert.ok(figureCount >= 10, `${figureCount} figures`);
});
