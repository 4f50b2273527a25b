import { expect } from '@playwright/test';
import { NAMES, ready, show } from './element-support.js';
import { FRESH, STILL, boxOf, frames, test } from './support.js';

test.use(STILL);

/** Columns of books, phones and screens. */
const WIDTHS = [320, 360, 375, 414, 480, 560, 600, 640, 700, 760, 820, 900, 1024, 1150, 1280, 1600, 1920];

/** Two lines of text: what is kept need not know how sentences break. */
const TOLERANCE = 45;

for (const name of NAMES) {
  test(`the room that is kept for ${name} is that which it takes, at any width`, FRESH, async ({ page }) => {
    test.slow();
    await show(page, `<${name} id="here"></${name}><div style="height: 9000px"></div><${name} id="later"></${name}>`, {
      head: '<style>body { margin: 0 }</style>',
    });
    await ready(page.locator('#here'));
    /** @type {string[]} */
    const wrong = [];
    for (const width of WIDTHS) {
      await page.setViewportSize({ width, height: 800 });
      await frames(page);
      const [taken, kept] = [await boxOf(page.locator('#here')), await boxOf(page.locator('#later'))];
      if (Math.abs(taken.height - kept.height) > TOLERANCE) {
        wrong.push(`${width} px (${width / 16} rem): ${(taken.height / 16).toFixed(1)} rem taken, ${(kept.height / 16).toFixed(1)} rem kept`);
      }
    }
    expect(wrong).toEqual([]);
  });
}
