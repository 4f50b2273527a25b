import { expect } from '@playwright/test';
import { REDUCED_MOTION, holdBackRequests, waitForFrames, readProperty, showPage, test, waitUntilReady } from './support.js';

/** @typedef {import('@playwright/test').Page} Page */

test.use(REDUCED_MOTION);

/**
 * Opens a page with a figure far below the window, between a link and a button. Intersection observers are disabled, so that they do not
 * start the figure.
 *
 * @param {Page} page
 * @param {string} figureName
 */
async function showFigureFarBelow(page, figureName) {
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
    `<a id="before" tabindex="-1">Before</a><div style="position: absolute; top: 4000px; width: 600px"><${figureName}></${figureName}></div><button id="after">After</button>`,
    { scriptHtml: '<script type="module" src="/external.js"></script>' },
  );
  const widget = page.locator(figureName);
  await widget.locator('.reserved').waitFor({ state: 'attached' });
  expect(await readProperty(widget, 'simulation')).toBe(undefined);
  return widget;
}

for (const [sideOfFigure, originSelector, tabKey] of /** @type {const} */ ([['above', '#before', 'Tab'], ['below', '#after', 'Shift+Tab']])) {
  test(`Tab from ${sideOfFigure} a figure that has not started focuses the same element as in a running figure`, async ({ page, figureName }) => {
    const widget = await showFigureFarBelow(page, figureName);
    const readFocusedHtml = () => widget.evaluate(({ shadowRoot }) => shadowRoot?.activeElement?.outerHTML);
    await page.locator(originSelector).focus();
    await page.keyboard.press(tabKey);
    await waitUntilReady(widget);
    const firstFocusedHtml = await readFocusedHtml();
    await page.locator(originSelector).focus();
    await page.keyboard.press(tabKey);
    expect(firstFocusedHtml).toBe(await readFocusedHtml());
    expect(firstFocusedHtml).toBeTruthy();
  });
}

test('a starting figure does not take the focus that the user has meanwhile moved elsewhere @nightly', async ({ page, figureName }) => {
  const allowModule = await holdBackRequests(page, '**/*.wasm');
  const widget = await showFigureFarBelow(page, figureName);
  const moduleRequest = page.waitForRequest(/\.wasm$/);
  await page.locator('#before').focus();
  await page.keyboard.press('Tab');
  await moduleRequest;
  await page.keyboard.press('Tab');
  allowModule();
  await waitUntilReady(widget);
  await waitForFrames(page);
  await expect(page.locator('#after')).toBeFocused();
});
