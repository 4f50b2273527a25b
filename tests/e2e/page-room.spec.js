import { expect } from '@playwright/test';
import { ALL, ready, show } from './element-support.js';
import { FRESH, STILL, boxOf, frames, test } from './support.js';

test.use(STILL);

/** Greatest difference between the room that is kept and the room that a figure takes, in any font and in widths between classes, em. */
const TOLERANCE = 8;

for (const name of ALL) {
  test(`the room that is kept for ${name} before its script has come is about as high as the figure`, FRESH, async ({ page }) => {
    await show(page, '', {
      head: '<style>body { margin: 0; font: 16px "Liberation Serif", serif }</style>',
      script: '<script type="module" src="/external.js"></script>',
    });
    let come = () => {};
    const coming = new Promise((resolve) => (come = () => resolve(undefined)));
    await page.route('**/chunks/**', async (route) => {
      await coming;
      await route.continue();
    });
    await page.evaluate((tag) => document.body.append(document.createElement(tag)), name);
    const widget = page.locator(name);
    const heights = async () => {
      const all = [];
      for (const width of [375, 700, 1280]) {
        await page.setViewportSize({ width, height: 900 });
        await frames(page);
        all.push((await boxOf(widget)).height / 16);
      }
      return all;
    };
    const before = await heights();
    expect(await widget.evaluate((element) => element.matches(':defined'))).toBe(false);
    come();
    await ready(widget);
    await expect(widget.locator('.folds')).toBeVisible();
    for (const [i, after] of (await heights()).entries()) {
      expect(after).toBeGreaterThanOrEqual(before[i]);
      expect(after - before[i]).toBeLessThan(TOLERANCE);
    }
    // Not much is left empty below the figure.
    const emptied = await widget.evaluate((element) => {
      const [machine, folds] = ['.machine', '.folds'].map((part) => element.shadowRoot?.querySelector(part)?.getBoundingClientRect().bottom ?? NaN);
      return (machine - folds) / 16;
    });
    expect(emptied).toBeLessThan(TOLERANCE);
  });
}
