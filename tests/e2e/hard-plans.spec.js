// Maps that take long to look at: the page goes on meanwhile, says so, and lets the reader stop it.

import { expect } from '@playwright/test';
import { expectAccessible } from './axe.js';
import { file, openSqueeze, squeezed, unfold } from './squeeze-support.js';
import { STILL, frames, pictureOf, test } from './support.js';

/**
 * @typedef {import('../../www/types.d.ts').MapSqueezeElement} Element
 * @typedef {import('@playwright/test').Locator} Locator
 */

test.use(STILL);

/** As many walls as are allowed, from one point to everywhere: it takes seconds to look at. */
const STAR = {
  name: 'star',
  bounds: [0, 0, 10, 10],
  walls: Array.from({ length: 100_000 }, (_, i) => {
    const angle = (2 * Math.PI * i) / 100_000;
    return [5, 5, 5 + 4.9 * Math.cos(angle), 5 + 4.9 * Math.sin(angle)];
  }),
};

const progress = (/** @type {Locator} */ widget) => widget.getByRole('progressbar');
const status = (/** @type {Locator} */ widget) => widget.locator('[role=status]');

/**
 * Gives the element a map and lets it be.
 *
 * @param {Locator} widget
 * @param {object} map
 */
function give(widget, map) {
  return widget.evaluate((element, given) => {
    /** @type {Element} */ (element).map = /** @type {any} */ (given);
  }, map);
}

test('a hard map is looked at in slices, with progress, and the page goes on', async ({ page }) => {
  const widget = await openSqueeze(page);
  const before = await pictureOf(widget.locator('canvas.plane'));
  // Frames in which the page could do something else, and how far the work was in them.
  const told = await widget.evaluate(async (element, map) => {
    const squeeze = /** @type {Element} */ (element);
    squeeze.map = /** @type {any} */ (map);
    const shares = [];
    while (squeeze.map === null) {
      await new Promise(requestAnimationFrame);
      shares.push(squeeze.shadowRoot?.querySelector('progress')?.value);
    }
    return shares;
  }, STAR);
  const shares = told.filter((share) => share !== undefined);
  expect(shares.length).toBeGreaterThan(10);
  expect(new Set(shares).size).toBeGreaterThan(5);
  for (const share of shares) expect(share).toBeGreaterThanOrEqual(0);
  await frames(page);
  await expect(progress(widget)).toHaveCount(0);
  const { config, stats, walls } = await squeezed(widget);
  expect(walls).toHaveLength(400_000);
  expect(stats.attempts).toBe(config.samples);
  expect(await pictureOf(widget.locator('canvas.plane'))).not.toBe(before);
});

for (const [way, act] of /** @type {[string, (widget: Locator) => Promise<void>][]} */ ([
  ['the button', (widget) => widget.getByRole('button', { name: 'Stop' }).click()],
  ['Escape', (widget) => widget.getByRole('slider', { name: 'Robot', exact: true }).press('Escape')],
])) {
  test(`${way} stops it, and all is as it was`, async ({ page }) => {
    const widget = await openSqueeze(page);
    const before = await squeezed(widget);
    const picture = await pictureOf(widget.locator('canvas.plane'));
    await give(widget, STAR);
    await expect(progress(widget)).toBeVisible();
    await expect(status(widget)).toHaveText('This takes a moment. Escape stops it.');
    await act(widget);
    await expect(progress(widget)).toHaveCount(0);
    await expect(status(widget)).toHaveText('Stopped: everything is as it was.');
    expect(await squeezed(widget)).toEqual(before);
    expect(await pictureOf(widget.locator('canvas.plane'))).toBe(picture);
    // It was nothing that lasts.
    await give(widget, { name: 'room', bounds: [0, 0, 6, 4], walls: [[0, 0, 6, 0]] });
    expect((await squeezed(widget)).walls).toEqual([0, 0, 6, 0]);
  });
}

test('a link with a hard map shows the figure at once, and the map when it was looked at', async ({ page }) => {
  const widget = await openSqueeze(page);
  const link = await widget.evaluate(async (element, map) => {
    const squeeze = /** @type {Element} */ (element);
    squeeze.map = /** @type {any} */ (map);
    return squeeze.shareLink();
  }, { ...STAR, walls: STAR.walls.map(([, , x, y]) => [5, 5, Math.round(x), Math.round(y)]) });
  expect(link.length).toBeLessThan(10_000);
  await page.goto('about:blank');
  await page.goto(link);
  const opened = page.locator('map-squeeze').first();
  await opened.scrollIntoViewIfNeeded();
  await expect.poll(() => opened.evaluate((element) => /** @type {Element} */ (element).map?.name)).toBe('star');
  expect((await squeezed(opened)).walls).toHaveLength(400_000);
});

test('what is said of the work is accessible', async ({ page }) => {
  const widget = await openSqueeze(page);
  await unfold(widget, 'A map of your own');
  await widget.getByLabel('Map files').setInputFiles([file('star.json', JSON.stringify({ bounds: [0, 0, 10, 10], walls: STAR.walls.slice(0, 3000) }))]);
  await expect(widget.locator('.own-map .present')).toContainText('star.json');
  await give(widget, STAR);
  await expect(progress(widget)).toHaveAccessibleName('Computing');
  await expect(widget.getByRole('button', { name: 'Stop' })).toBeVisible();
  await expectAccessible(page);
});
