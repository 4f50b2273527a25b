import { expect } from '@playwright/test';
import { STILL, frames, property, showPage, test, untilReady } from './support.js';

/** @typedef {import('@playwright/test').Page} Page */

test.use(STILL);

/**
 * Opens a page with a figure far below the window, between a link and a button, that no observer starts.
 *
 * @param {Page} page
 * @param {string} name
 */
async function showFar(page, name) {
  await page.addInitScript(() => {
    window.IntersectionObserver = /** @type {any} */ (
      class {
        observe() {}
        unobserve() {}
      }
    );
  });
  await showPage(
    page,
    `<a id="before" tabindex="-1">Before</a><div style="position: absolute; top: 4000px; width: 600px"><${name}></${name}></div><button id="after">After</button>`,
    { script: '<script type="module" src="/external.js"></script>' },
  );
  const widget = page.locator(name);
  await widget.locator('.reserved').waitFor({ state: 'attached' });
  expect(await property(widget, 'machine')).toBe(undefined);
  return widget;
}

for (const [way, origin, key] of /** @type {const} */ ([['above', '#before', 'Tab'], ['below', '#after', 'Shift+Tab']])) {
  test(`a figure that Tab reaches from ${way} before it has started has the focus where it would be`, async ({ page, figure }) => {
    const widget = await showFar(page, figure);
    const stop = () => widget.evaluate(({ shadowRoot }) => shadowRoot?.activeElement?.outerHTML);
    await page.locator(origin).focus();
    await page.keyboard.press(key);
    await untilReady(widget);
    const reached = await stop();
    await page.locator(origin).focus();
    await page.keyboard.press(key);
    expect(reached).toBe(await stop());
    expect(reached).toBeTruthy();
  });
}

test('a figure that starts when the reader has gone on leaves the focus where it is @nightly', async ({ page, figure }) => {
  let arrive = () => {};
  const arrived = new Promise((resolve) => (arrive = () => resolve(undefined)));
  await page.route('**/*.wasm', async (route) => {
    await arrived;
    await route.continue();
  });
  const widget = await showFar(page, figure);
  const asked = page.waitForRequest(/\.wasm$/);
  await page.locator('#before').focus();
  await page.keyboard.press('Tab');
  await asked;
  await page.keyboard.press('Tab');
  arrive();
  await untilReady(widget);
  await frames(page);
  await expect(page.locator('#after')).toBeFocused();
});
