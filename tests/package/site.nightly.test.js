// The site that `npm run build:site` writes: each page on a phone, and the figures on it. That script checks the links.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { join } from 'node:path';
import { test } from 'node:test';
import { ROOT, filesOf } from '../../scripts/process.mjs';
import { serveDirectory } from './support.js';

const site = serveDirectory(() => {
  execFileSync(process.execPath, [join(ROOT, 'scripts/site.mjs')], { stdio: 'inherit' });
  return join(ROOT, 'build/site');
}, '/book/');

test('pages fit a phone, load without complaints, and start their figures', async () => {
  const page = await site.openPage({ viewport: { width: 375, height: 800 } });
  const pagePaths = filesOf('build/site').map((path) => path.slice('build/site/'.length)).filter((path) => /^(?!rust|classroom|embed\.).*html$/.test(path));
  let figureCount = 0;
  for (const path of pagePaths) {
    await page.goto(site.address + path);
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `${path} is too wide`);
    for (const figure of await page.locator('.stand > *, .document > :is(banana-machine, map-squeeze)').all()) {
      await figure.evaluate((element) => element.scrollIntoView());
      await figure.locator('canvas').first().waitFor();
      figureCount++;
    }
  }
  assert.ok(figureCount >= 10, `${figureCount} figures`);
});
