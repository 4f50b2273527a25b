// A figure that the reader comes to from the keyboard before it has started.

import { expect } from '@playwright/test';
import { ALL, property, ready, show } from './element-support.js';
import { STILL, frames, test } from './support.js';

/** @typedef {import('@playwright/test').Page} Page */

test.use(STILL);

/**
 * A page with a figure that nothing starts but the reader's coming, between two things of the page.
 *
 * @param {Page} page
 * @param {string} name
 * @param {boolean} [seen] whether anything tells the figure that it comes in sight then
 */
async function showFar(page, name, seen = false) {
  if (!seen) await page.addInitScript(() => {
    window.IntersectionObserver = /** @type {any} */ (
      class {
        observe() {}
        unobserve() {}
      }
    );
  });
  await show(
    page,
    `<a id="before" tabindex="-1">Before</a><div style="position: absolute; top: 4000px; width: 600px"><${name}></${name}></div><button id="after">After</button>`,
    { script: '<script type="module" src="/external.js"></script>' },
  );
  const widget = page.locator(name);
  await widget.locator('.reserved').waitFor({ state: 'attached' });
  expect(await property(widget, 'machine')).toBe(undefined);
  return widget;
}

/**
 * Keeps the core from coming.
 *
 * @param {Page} page
 * @returns {Promise<() => void>} lets it come
 */
async function holdCore(page) {
  /** @type {() => void} */
  let arrive = () => {};
  const arrived = new Promise((resolve) => (arrive = () => resolve(undefined)));
  await page.route('**/*.wasm', async (route) => {
    await arrived;
    await route.continue();
  });
  return () => arrive();
}

for (const name of ALL) {
  for (const [way, origin, key] of /** @type {const} */ ([
    ['above', '#before', 'Tab'],
    ['below', '#after', 'Shift+Tab'],
    ['nowhere', undefined, 'Tab'],
  ])) {
    test(`${name} that is reached from ${way} has the focus where it would be, had the figure been there`, async ({ page }) => {
      const widget = await showFar(page, name);
      const stop = () => widget.evaluate(({ shadowRoot }) => shadowRoot?.activeElement?.outerHTML);
      if (origin) await page.locator(origin).focus();
      await page.keyboard.press(key);
      await ready(widget);
      const reached = await stop();
      await page.locator(origin ?? '#before').focus();
      await page.keyboard.press(key);
      expect(reached).toBe(await stop());
      expect(reached).toBeTruthy();
    });
  }

  for (const [way, origin, key] of /** @type {const} */ ([['above', '#before', 'Tab'], ['below', '#after', 'Shift+Tab']])) {
    test(`${name} that is reached from ${way} has the focus as well where its first picture is seen before all else`, async ({ page }) => {
      const widget = await showFar(page, name, true);
      const stop = () => widget.evaluate(({ shadowRoot }) => shadowRoot?.activeElement?.outerHTML);
      await page.locator(origin).focus();
      await page.keyboard.press(key);
      await expect.poll(stop).toBeTruthy();
      await ready(widget);
      const reached = await stop();
      await page.locator(origin).focus();
      await page.keyboard.press(key);
      expect(reached).toBe(await stop());
    });
  }

  test(`${name} that starts when the reader has gone on leaves the focus where it is`, async ({ page }) => {
    const arrive = await holdCore(page);
    const widget = await showFar(page, name);
    const asked = page.waitForRequest(/\.wasm$/);
    await page.locator('#before').focus();
    await page.keyboard.press('Tab');
    await asked;
    await page.keyboard.press('Tab');
    arrive();
    await ready(widget);
    await frames(page);
    await expect(page.locator('#after')).toBeFocused();
  });
}

test('a figure that is hidden when it starts has no focus', async ({ page }) => {
  const arrive = await holdCore(page);
  const widget = await showFar(page, 'banana-machine');
  await page.locator('#before').focus();
  await page.keyboard.press('Tab');
  await page.evaluate(() => void (document.body.style.display = 'none'));
  arrive();
  await ready(widget);
  await frames(page);
  expect(await widget.evaluate(({ shadowRoot }) => shadowRoot?.activeElement)).toBe(null);
});

test('a figure that is reached as it opens before an audience has the focus where it can be seen', async ({ page }) => {
  const arrive = await holdCore(page);
  await show(page, '<dead-reckoning presentation></dead-reckoning>', { script: '<script type="module" src="/external.js"></script>' });
  const widget = page.locator('dead-reckoning');
  await widget.locator('.reserved').waitFor({ state: 'attached' });
  await frames(page);
  await widget.evaluate((element) => {
    const root = /** @type {any} */ (element.shadowRoot);
    root.activeElement.blur();
    root.querySelector('.reserved').focus();
  });
  arrive();
  await ready(widget);
  await expect(widget.getByRole('button', { name: 'Controls' })).toBeFocused();
});
