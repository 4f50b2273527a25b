import { expect } from '@playwright/test';
import { STILL, centreOf, detail, frames, openWhole, readout, state, test } from './support.js';

/** @typedef {import('./support.js').BananaMachineElement} BananaMachineElement */
/** @typedef {import('@playwright/test').Locator} Locator */

test.use(STILL);

/**
 * Sets sliders by their ids.
 *
 * @param {Locator} widget
 * @param {Record<string, number>} values
 */
async function set(widget, values) {
  for (const [id, value] of Object.entries(values)) await widget.locator(`#${id}`).fill(String(value));
  await frames(widget.page());
}

/**
 * A cloud of which only the first robots are shown.
 *
 * @param {Locator} widget
 * @param {number} count
 */
async function few(widget, count) {
  await set(widget, { samples: 0 });
  await widget.getByRole('button', { name: 'Reset' }).click();
  for (let i = 0; i < count; i++) await widget.getByRole('button', { name: 'Step' }).click();
  await frames(widget.page());
}

test.describe('the handle', () => {
  test('does not leap to another arc with the same end', async ({ page }) => {
    const widget = await openWhole(page);
    const handle = widget.locator('.handle');
    // Turns beyond half a circle, and in reverse: the shortest way there would be another.
    for (const command of [{ v: 1, omega: 1.8, dt: 2.5 }, { v: -1, omega: 0.4, dt: 1 }]) {
      await set(widget, command);
      const before = await state(widget);
      await handle.press('ArrowUp');
      const after = await state(widget);
      expect(after.end[0]).toBeCloseTo(before.end[0], 9);
      expect(after.end[1]).toBeCloseTo(before.end[1] + 0.02, 9);
      expect(Math.abs(after.config.command.v - command.v)).toBeLessThan(0.2);
      expect(Math.abs(after.config.command.omega - command.omega)).toBeLessThan(0.2);
    }
  });

  test('is not moved by being taken at its edge, nor by another button', async ({ page }) => {
    const widget = await openWhole(page);
    const before = await state(widget);
    const { x, y } = await centreOf(widget.locator('.handle'));
    await page.mouse.move(x + 10, y + 8);
    await page.mouse.down();
    await page.mouse.move(x + 11, y + 8);
    await page.mouse.move(x + 10, y + 8);
    const held = await state(widget);
    for (const i of [0, 1]) expect(held.end[i]).toBeCloseTo(before.end[i], 6);
    await page.mouse.up();
    await page.mouse.down({ button: 'right' });
    await page.mouse.move(x + 40, y + 40, { steps: 3 });
    await page.mouse.up({ button: 'right' });
    expect((await state(widget)).config.command).toEqual(held.config.command);
  });

  test('counts every key, also two within a frame', async ({ page }) => {
    const widget = await openWhole(page);
    const before = await state(widget);
    await widget.evaluate((element) => {
      const press = (/** @type {string} */ selector, /** @type {string} */ key) =>
        element.shadowRoot?.querySelector(selector)?.dispatchEvent(new KeyboardEvent('keydown', { key }));
      for (let i = 0; i < 2; i++) press('.handle', 'ArrowUp');
    });
    const { end } = await state(widget);
    expect(end[1] - before.end[1]).toBeCloseTo(0.04, 9);
  });
});

test.describe('what is undefined', () => {
  test('a cloud that turns a full circle has no exponential coordinates, and says so', async ({ page }) => {
    const widget = await openWhole(page);
    await set(widget, { omega: 2, dt: 3 });
    await expect(widget.locator('.note')).toContainText('Exponential coordinates end there');
    await expect(readout(widget, 'predicts')).toHaveText('—');
    await expect(detail(widget, 'area of ellipse')).toHaveText(/^inside: [\d.]+\u202f% and —$/);
    for (const name of ['area of ellipse', 'gain of a Gaussian', 'exact gain', 'exact area']) await expect(readout(widget, name)).toHaveText('—');
    await expect(readout(widget, 'cross-track skew')).not.toHaveText('—');
    const measured = widget.getByRole('row', { name: 'mean ξ along' }).getByRole('cell').last();
    await expect(measured).toHaveText('—');
    await set(widget, { omega: 0.5, dt: 1 });
    await expect(widget.locator('.note')).toHaveCount(0);
    await expect(measured).not.toHaveText('—');
  });

  test('two robots have no skew', async ({ page }) => {
    const widget = await openWhole(page);
    await few(widget, 2);
    expect((await state(widget)).shown).toBe(2);
    await expect(readout(widget, 'cross-track skew')).toHaveText('—');
    await expect(widget.locator('.caption')).toHaveText('Too few robots for a skew.');
    await widget.getByRole('button', { name: 'Step' }).click();
    await expect(readout(widget, 'cross-track skew')).toHaveText(/^−?\d\.\d{3} ± \d\.\d{3}$/);
  });
});

test('the view in exponential coordinates has room for its cloud', async ({ page }) => {
  const widget = await openWhole(page);
  // Bent so far that the spread in the plane is much less than along the arc.
  await set(widget, { omega: 2, dt: 2, alpha3: 0.01, alpha4: 0.01, alpha6: 0, samples: 9 });
  const { stats, table } = await state(widget);
  expect(table.exact.cov[0][0]).toBeLessThan(0.7 * stats.exponential.cov[0][0]);
  const extent = await widget.evaluate(async (element) => {
    const { machine } = /** @type {BananaMachineElement} */ (element);
    /** @type {number[]} */
    let seen = [];
    Object.defineProperty(machine, 'picture', {
      configurable: true,
      value(/** @type {[string, ...number[]]} */ ...grid) {
        if (grid[0] === 'twist') seen = grid.slice(1, 5).map(Number);
        return Object.getPrototypeOf(machine).picture.apply(machine, grid);
      },
    });
    /** @type {HTMLElement | null | undefined} */ (element.shadowRoot?.querySelector('.legend input'))?.click();
    for (let i = 0; i < 3; i++) await new Promise(requestAnimationFrame);
    return seen;
  });
  const { mean, cov } = stats.exponential;
  for (const [axis, i] of [[0, 0], [1, 2]]) {
    const room = 3 * Math.sqrt(cov[i][i]);
    expect(extent[axis]).toBeLessThan(mean[i] - room);
    expect(extent[axis + 2]).toBeGreaterThan(mean[i] + room);
  }
});

test('what is said depends on the model and its noise', async ({ page }) => {
  const widget = await openWhole(page);
  const caption = widget.locator('.figures figure p');
  await expect(caption).toContainText('nearly a Gaussian');
  await set(widget, { alpha5: 0, alpha6: 0 });
  await expect(caption).toContainText('exactly a Gaussian');
  await widget.getByLabel('triangular').check();
  await expect(caption).toContainText('triangular noise is not Gaussian');
  await widget.getByLabel('odometry').check();
  await expect(caption).toContainText('only roughly');
  await set(widget, { v: -1 });
  await expect(widget.locator('.note')).toContainText('Odometry reads backing up as two half turns');
  await widget.getByLabel('velocity').check();
  await expect(widget.locator('.note')).toHaveCount(0);
});

test('the marked robot and Step follow the size of the cloud', async ({ page }) => {
  const widget = await openWhole(page);
  const field = widget.getByRole('spinbutton', { name: 'Robot' });
  const step = widget.getByRole('button', { name: 'Step' });
  await expect(step).toBeDisabled();
  await expect(field).toHaveAttribute('placeholder', '1–50\u202f000');
  await field.fill('1500');
  await frames(page);
  await expect(widget.locator('.marked output')).toContainText('m/s');
  await set(widget, { samples: 3 });
  await expect(field).toHaveValue('');
  await expect(widget.locator('.marked output')).toContainText('Point at one');
  await field.fill('500');
  await expect(widget.getByRole('alert')).toHaveText('Robot is 500; allowed is a whole number from 1 to 100.');
  await field.fill('100');
  await expect(widget.getByRole('alert')).toHaveCount(0);
  await expect(widget.locator('.marked output')).toContainText('m/s');
  await widget.getByRole('button', { name: 'Reset' }).click();
  await expect(field).toBeDisabled();
  await expect(step).toBeEnabled();
});
