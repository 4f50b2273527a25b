import { expect } from '@playwright/test';
import { openSqueeze, squeezed } from './squeeze-support.js';
import { STILL, frames, open, posesOf, state, test } from './support.js';

/** @typedef {import('@playwright/test').Locator} Locator */

// The chapter's exercises 4 and 5, from the keyboard alone: Tab, Enter, Space, arrows and digits.
test.use(STILL);

/**
 * Goes on by Tab until the focus is there.
 *
 * @param {Locator} target
 */
async function tabTo(target) {
  const page = target.page();
  for (let presses = 0; presses < 150; presses++) {
    if ((await target.count()) && (await target.evaluate((element) => element.matches(':focus')))) return;
    await page.keyboard.press('Tab');
  }
  throw new Error(`Tab does not lead to ${target}.`);
}

/**
 * @param {Locator} target
 * @param {string[]} keys
 */
async function press(target, ...keys) {
  await tabTo(target);
  for (const key of keys) await target.page().keyboard.press(key);
  await frames(target.page());
}

/**
 * Types a slider's value.
 *
 * @param {Locator} slider
 * @param {string} value
 */
async function type(slider, value) {
  await tabTo(slider);
  await slider.page().keyboard.type(value);
  await slider.page().keyboard.press('Enter');
  await frames(slider.page());
}

/** Returns the standard deviations of the end positions and of the headings. @param {Locator} widget */
async function spreads(widget) {
  const poses = await posesOf(widget);
  const deviation = (/** @type {number} */ at) => {
    const values = poses.filter((_, i) => i % 3 === at);
    const mean = values.reduce((sum, value) => sum + value, 0) / values.length;
    return Math.sqrt(values.reduce((sum, value) => sum + (value - mean) ** 2, 0) / values.length);
  };
  return { place: Math.hypot(deviation(0), deviation(1)), heading: deviation(2) };
}

test('exercise 4: what α₄ alone and α₆ alone do, on a straight and in a turn', async ({ page }) => {
  // A hundred keys and more, each awaited.
  test.slow();
  const widget = await open(page, 'samples="2000"');
  await press(widget.getByRole('button', { name: 'Straight' }), 'Enter');
  await press(widget.locator('summary', { hasText: 'Model' }), 'Enter');
  await press(widget.getByLabel('Isolate one'), 'Space');
  const only = (/** @type {string} */ alpha) => widget.getByRole('radio', { name: `Only ${alpha}` });
  // From the figure's start again; the arrows go through the group.
  const choose = async (/** @type {number} */ number) => {
    await page.evaluate(() => /** @type {HTMLElement | null} */ (document.activeElement)?.blur());
    for (let presses = 0; presses < 300 && !(await widget.evaluate(({ shadowRoot }) => shadowRoot?.activeElement?.getAttribute('name') === 'isolate')); presses++) {
      await page.keyboard.press('Tab');
    }
    for (let step = 0; step < 6 && !(await only(`α${'₀₁₂₃₄₅₆'[number]}`).isChecked()); step++) {
      await page.keyboard.press('ArrowDown');
      await frames(page);
    }
    expect((await state(widget)).config.isolate).toBe(number);
  };
  for (const number of [4, 6]) {
    await choose(number);
    expect(await spreads(widget)).toEqual({ place: 0, heading: 0 });
  }
  await page.evaluate(() => /** @type {HTMLElement | null} */ (document.activeElement)?.blur());
  await type(widget.locator('#omega'), '0.5');
  await choose(4);
  const fan = await spreads(widget);
  expect(fan.place).toBeGreaterThan(0.05);
  await choose(6);
  const blur = await spreads(widget);
  expect(blur.place).toBeLessThan(1e-9);
  expect(blur.heading).toBeGreaterThan(0.02);
});

test('exercise 5: the share through a wall is pushed above 40 % by ω, and a repair brings it to 0', async ({ page }) => {
  const widget = await openSqueeze(page);
  await expect(widget.getByLabel(/Condition on/)).toBeChecked();
  const share = async () => (await squeezed(widget)).stats.throughWallRate;
  await type(widget.locator('#samples'), '4000');
  const straight = await share();
  expect(straight).toBeLessThan(0.4);
  await page.keyboard.press('Shift+Tab');
  await page.evaluate(() => /** @type {HTMLElement | null} */ (document.activeElement)?.blur());
  await type(widget.locator('#omega'), '0.45');
  expect(await share()).toBeGreaterThan(0.4);
  await page.evaluate(() => /** @type {HTMLElement | null} */ (document.activeElement)?.blur());
  await press(widget.getByRole('radio', { name: 'endpoint' }), 'ArrowRight');
  await expect(widget.getByRole('radio', { name: 'whole arc' })).toBeChecked();
  expect(await share()).toBe(0);
});
