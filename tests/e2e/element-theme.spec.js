import { expect } from '@playwright/test';
import { ALL, ready, show } from './element-support.js';
import { STILL, frames, pixelsOf, test } from './support.js';

/** @typedef {import('@playwright/test').Locator} Locator */

test.use(STILL);

/** @param {Locator} widget @returns {Promise<number[]>} red, green, blue, 0 to 255 */
async function paperOf(widget) {
  await frames(widget.page());
  return widget.evaluate((element) => {
    const swatch = document.createElement('span');
    swatch.style.color = 'var(--paper)';
    element.shadowRoot?.querySelector('.surface')?.append(swatch);
    const paper = (getComputedStyle(swatch).color.match(/[\d.]+/g) ?? []).map(Number);
    swatch.remove();
    return paper;
  });
}

/** @param {Locator} widget */
const lookOf = async (widget) => ((await paperOf(widget))[0] > 128 ? 'light' : 'dark');

/** @param {Locator} widget */
async function expectDrawn(widget) {
  // Paths and frames in the colours of the present look, not of the one before.
  await expect.poll(() => pixelsOf(widget.locator('canvas.plane'), 'prior')).toBeGreaterThan(50);
}

const SETTINGS = /** @type {[string, string, (scheme: 'light' | 'dark') => string][]} */ ([
  ['the inherited color-scheme', '<style>body { color: #333 }</style>', (scheme) => `document.body.style.colorScheme = '${scheme}'`],
  [
    'a switch of the page that changes colours alone',
    '<style>body { background: white; color: #222 } .night body { background: #111; color: oklch(0.9 0 0) }</style>',
    (scheme) => `document.documentElement.classList.toggle('night', ${scheme === 'dark'})`,
  ],
  ['the attribute', '<style>:root { color-scheme: light }</style>', (scheme) => `document.querySelector('#it').theme = '${scheme}'`],
]);

for (const name of ALL) for (const [what, head, to] of SETTINGS) {
  test(`${name} follows ${what}`, async ({ page }) => {
    await show(page, `<${name} id="it"></${name}>`, { head });
    const widget = page.locator(name);
    await ready(widget);
    expect(await lookOf(widget)).toBe('light');
    for (const scheme of /** @type {const} */ (['dark', 'light', 'dark'])) {
      await page.evaluate(to(scheme));
      await expect.poll(() => lookOf(widget)).toBe(scheme);
      await expectDrawn(widget);
    }
  });
}

test('follows the system where the page does', async ({ page }) => {
  await page.emulateMedia({ colorScheme: 'dark' });
  await show(page, '<banana-machine></banana-machine>', { head: '<style>:root { color-scheme: light dark }</style>' });
  const widget = page.locator('banana-machine');
  await ready(widget);
  expect(await lookOf(widget)).toBe('dark');
  await page.emulateMedia({ colorScheme: 'light' });
  await expect.poll(() => lookOf(widget)).toBe('light');
  await expectDrawn(widget);
});

for (const name of ALL) {
  test(`the theme of ${name} itself stands against everything around it`, async ({ page }) => {
    await show(page, `<${name} theme="light"></${name}>`, { head: '<style>:root { color-scheme: dark; color: white }</style>' });
    const widget = page.locator(name);
    await ready(widget);
    expect(await lookOf(widget)).toBe('light');
    await widget.evaluate((element) => element.removeAttribute('theme'));
    await expect.poll(() => lookOf(widget)).toBe('dark');
  });
}

for (const [scheme, look] of /** @type {const} */ ([['normal', 'dark'], ['light', 'light'], ['dark', 'dark']])) {
  test(`takes the ground for ${look} where the page's is an image, its text light and its color-scheme ${scheme}`, async ({ page }) => {
    await show(page, '<banana-machine></banana-machine>', {
      head: `<style>:root { color-scheme: ${scheme} } body { background: linear-gradient(#222, #333); color: #eee }</style>`,
    });
    const widget = page.locator('banana-machine');
    await ready(widget);
    expect(await lookOf(widget)).toBe(look);
    // Where the page has not said which dark it is, one on which a halo is not blacker than the image.
    if (scheme === 'normal') expect(await paperOf(widget)).toEqual([18, 18, 18]);
  });
}
