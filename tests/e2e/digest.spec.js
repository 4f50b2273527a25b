// Same seed, same bits, in Chromium, with the module that ships.

import { readFileSync } from 'node:fs';
import { expect } from '@playwright/test';
import { differences } from '../digest/digest.js';
import { test } from './support.js';

const at = (/** @type {string} */ name) => new URL(`../digest/${name}`, import.meta.url).pathname;

test('a seed gives the bits that it gives natively and in Node @nightly', async ({ page }) => {
  // Some seconds for all machines, and many times that beside other work.
  test.setTimeout(180_000);
  await page.route('**/digest/*', (route) => route.fulfill({ path: at(new URL(route.request().url()).pathname.split('/')[2]) }));
  await page.goto('/custom-elements.json');
  const computed = await page.evaluate(async () => {
    const [{ load }, { digest }, list] = await Promise.all([
      import(new URL('/core.js', location.href).href),
      import(new URL('/digest/digest.js', location.href).href),
      fetch('/digest/configurations.json'),
    ]);
    return digest(await load(), await list.json());
  });
  expect(differences(readFileSync(at('golden.txt'), 'utf8'), computed)).toEqual([]);
});
