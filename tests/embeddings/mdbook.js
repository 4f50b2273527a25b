/** A book by mdBook: built, and while it is written. */

import assert from 'node:assert/strict';
import { join } from 'node:path';
import { isProgram } from '../../scripts/process.mjs';
import { CACHE, nativeRust } from '../../scripts/toolchain.mjs';
import { copyScript, expected, follow, unpack } from './book.mjs';
import { asLightAsThePage } from './lightness.mjs';
import { files, program } from './serving.mjs';

const VERSION = '0.5.4';

/** For all clones of this user: it takes minutes to compile. */
const root = join(CACHE, `mdbook-${VERSION}`);
const mdbook = join(root, 'bin/mdbook');

const PAGES = { first: 'outcomes.html', second: 'map.html' };

/**
 * @param {import('@playwright/test').Page} page
 * @param {string} theme
 */
async function choose(page, theme) {
  const list = page.locator('#mdbook-theme-list');
  // It stays open.
  if (!(await list.isVisible())) await page.locator('#mdbook-theme-toggle').click();
  await list.locator(`#mdbook-theme-${theme}`).click();
}

/** @type {import('./project.mjs').Engine} */
export default {
  heading: 'mdBook',
  versions: () => `mdbook ${VERSION}`,
  async install(directory, tools) {
    await unpack(directory, tools);
    if (isProgram(mdbook)) return;
    const { bin, env } = await nativeRust();
    await tools.run(join(bin, 'cargo'), ['install', 'mdbook', '--version', VERSION, '--locked', '--quiet', '--root', root], env);
  },
  async build(directory, { run }) {
    copyScript(directory, '.');
    await run(mdbook, ['build']);
  },
  servings: [
    { name: 'production', serve: files('book', '/a/book/') },
    { name: 'development', serve: program((port) => [mdbook, ['serve', '--port', port]]) },
  ],
  pages: PAGES,
  go: follow,
  wholePages: true,
  movesItself: true,
  dark: (page, on) => choose(page, on ? 'navy' : 'light'),
  expected,
  also: {
    async 'every theme'(page) {
      for (const theme of ['rust', 'coal', 'navy', 'ayu', 'light']) {
        await choose(page, theme);
        await asLightAsThePage(page, page.locator('banana-machine'));
      }
    },
    'arrow keys': arrowKeys,
  },
};

/**
 * They turn the pages of the book, but where a figure takes them.
 *
 * @param {import('@playwright/test').Page} page
 */
async function arrowKeys(page) {
  const turns = await page.evaluateHandle(() => {
    /** @type {(string | null)[]} */
    const addresses = [];
    navigation.addEventListener('navigate', (event) => {
      event.preventDefault();
      addresses.push(event.destination.url);
    });
    return addresses;
  });
  const taking = await page.locator('banana-machine').locator('[role="slider"], input').filter({ visible: true }).all();
  assert.ok(taking.length > 4, `${taking.length} things take arrow keys.`);
  for (const each of taking) await each.press('ArrowRight');
  assert.deepEqual(await turns.jsonValue(), []);
  await page.locator('h1 a.header').press('ArrowRight');
  assert.deepEqual(await turns.jsonValue(), [new URL(PAGES.second, page.url()).href]);
}
