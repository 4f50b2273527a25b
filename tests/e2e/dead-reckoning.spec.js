import { expect } from '@playwright/test';
import { STILL, detail, dragSlider, frames, pictureOf, pixelsOf, readout, show, test, unfold } from './support.js';

/**
 * @typedef {import('@playwright/test').Page} Page
 * @typedef {import('@playwright/test').Locator} Locator
 * @typedef {import('../../www/types.d.ts').DeadReckoning} DeadReckoning
 * @typedef {HTMLElement & { machine: DeadReckoning }} DeadReckoningElement
 */

test.use(STILL);

/**
 * Opens a page with the figure, and waits for all of its robots.
 *
 * @param {Page} page
 * @param {string} [attributes]
 */
async function openReckoning(page, attributes = '') {
  await show(page, `<main><h1>Bare</h1><dead-reckoning heading-level="2" ${attributes}></dead-reckoning></main>`);
  const widget = page.locator('dead-reckoning');
  await expect(widget.locator('.folds')).toBeVisible();
  await settled(widget);
  return widget;
}

/** Waits until all robots are driven and shown. @param {Locator} widget */
async function settled(widget) {
  await expect.poll(() => widget.evaluate((element) => {
    const { machine, settings } = /** @type {any} */ (element);
    return !settings.stale && machine.shown === machine.config.samples && machine.stats.n === machine.shown;
  })).toBe(true);
  await frames(widget.page());
}

/** @param {Locator} widget */
const config = (widget) => widget.evaluate((element) => /** @type {DeadReckoningElement} */ (element).machine.config);
const caption = (/** @type {Locator} */ widget) => widget.locator('p[part=caption]');
const plotOf = (/** @type {Locator} */ widget) => widget.locator('.ratios svg.plot');

/** Returns the texts of the three readouts of the components. @param {Locator} widget */
const missed = (widget) => Promise.all(['along', 'lateral', 'heading'].map((name) => readout(widget, new RegExp(`^\\s*${name}`)).textContent()));

test('opens with the lateral miss that the chapter’s 6 % hides', async ({ page }) => {
  const widget = await openReckoning(page);
  expect(await config(widget)).toMatchObject({
    command: { v: 1, omega: 0.5, dt: 0.2 }, steps: 20, step: 2, alphas: [0.02, 0.02, 0.02, 0.02, 0.005, 0.005], compounding: 'chapter', samples: 50_000,
  });
  await expect(caption(widget)).toHaveText(
    'The −6.1\u202f% along the track at the end hides a worse miss: of the lateral variance it predicts 0.00 at step 1, 0.44 at step 2, 0.77 at step 5.',
  );
  expect(await missed(widget)).toEqual(['steps 15–20', 'steps 1–15', 'never']);
  await expect(detail(widget, /^\s*along/)).toHaveText('−6.1 ± 0.6\u202f%');
  await expect(plotOf(widget)).toHaveAttribute('aria-label', /At step 2: along 1.009 ± 0.006, lateral 0.445 ± 0.003, heading/);
  for (const [canvas, role] of [['plane', 'prior'], ['plane', 'posterior'], ['twist', 'posterior'], ['twist', 'truth']]) {
    expect(await pixelsOf(widget.locator(`canvas.${canvas}`), role), `${role} in ${canvas}`).toBeGreaterThan(20);
  }
});

test('a slider walks along the path, from the keyboard too, and drives nobody', async ({ page }) => {
  const widget = await openReckoning(page);
  const slider = widget.locator('#step');
  const before = await widget.evaluate((element) => /** @type {DeadReckoningElement} */ (element).machine.measured);
  const pictures = () => Promise.all(['plane', 'twist'].map((name) => pictureOf(widget.locator(`canvas.${name}`))));
  const [plane, twist] = await pictures();
  await slider.press('End');
  await frames(page);
  expect((await config(widget)).step).toBe(20);
  const [planeAtEnd, twistAtEnd] = await pictures();
  expect(planeAtEnd).not.toBe(plane);
  expect(twistAtEnd).not.toBe(twist);
  expect(await widget.evaluate((element) => /** @type {DeadReckoningElement} */ (element).machine.measured)).toEqual(before);
  await expect(widget.locator('.walk .effect')).toHaveText('Walks along the path: 4.00 of 4.00 s are driven.');
  await slider.press('Home');
  await frames(page);
  await expect(widget.locator('canvas.twist')).toHaveAttribute('aria-label', /measured 0.0316 m and 0.0035 m, predicted 0.0316 m and 0.0000 m/);
  await expect(plotOf(widget)).toContainText('step 1');
  await dragSlider(slider, 0.5);
  await frames(page);
  expect((await config(widget)).step).toBe(11);
});

test('a step beyond the last is refused where it is typed', async ({ page }) => {
  const widget = await openReckoning(page, 'samples="1000"');
  const field = widget.locator('.walk .typed');
  for (const [typed, said] of [['25', 'k is 25; allowed is a whole number from 1 to 20.'], ['0', 'k is 0; allowed is a whole number from 1 to 20.']]) {
    await field.fill(typed);
    await field.press('Enter');
    await expect(widget.locator('.walk').getByRole('alert')).toHaveText(said);
    await expect(widget.locator('.walk').getByRole('alert')).toBeVisible();
    await expect(field).toHaveValue('2');
    await expect(widget.locator('#step')).toHaveValue('2');
  }
  await field.fill('20');
  await field.press('Enter');
  await frames(page);
  expect((await config(widget)).step).toBe(20);
});

test('with J_r, and to fourth order, every component is right', async ({ page }) => {
  const widget = await openReckoning(page);
  for (const name of ['with Jᵣ', 'fourth order']) {
    await widget.getByRole('radio', { name }).check();
    await frames(page);
    expect(await missed(widget)).toEqual(['never', 'never', 'never']);
    await expect(caption(widget)).toHaveText('Within 5 % of what 50\u202f000 robots do, in every component at every step.');
  }
  expect((await config(widget)).compounding).toBe('fourth-order');
  await unfold(widget);
  const cells = await widget.locator('table tbody tr').first().locator('td').allTextContents();
  expect(cells).toEqual(['steps 15–20', 'never', 'never']);
});

test('presets are paths, and tell which one it is', async ({ page }) => {
  const widget = await openReckoning(page);
  const button = (/** @type {string} */ name) => widget.getByRole('button', { name });
  await expect(button('The chapter’s 20 steps')).toHaveAttribute('aria-pressed', 'true');
  await expect(button('Heading noise doubled')).toHaveAttribute('title', /deviation is doubled: .* fourfold/);
  await button('Heading noise doubled').click();
  await settled(widget);
  expect((await config(widget)).alphas).toEqual([0.02, 0.02, 0.08, 0.08, 0.02, 0.02]);
  expect((await missed(widget))[0]).toBe('steps 9–20');
  await expect(widget).toHaveAttribute('preset', 'doubled');
  await button('Same path, 200 steps').click();
  await settled(widget);
  expect(await config(widget)).toMatchObject({ steps: 200, command: { dt: 0.02 } });
  expect((await missed(widget))[0]).toBe('never');
  await widget.locator('#headingNoise').press('ArrowRight');
  await settled(widget);
  expect((await config(widget)).alphas).toEqual([0.02, 0.02, 0.025, 0.025, 0.00625, 0.00625]);
  await expect(widget).not.toHaveAttribute('preset');
});

test('more steps are shorter ones of the same path, seen from the same place', async ({ page }) => {
  const widget = await openReckoning(page, 'step="10" samples="1000"');
  const end = (/** @type {Locator} */ of) => of.evaluate((element) => [.../** @type {DeadReckoningElement} */ (element).machine.commanded.slice(-2)]);
  const [x, y] = await end(widget);
  await dragSlider(widget.locator('#steps'), 0.5);
  await settled(widget);
  const { steps, step, command } = await config(widget);
  expect(steps).toBeGreaterThan(80);
  expect(Math.abs(steps * command.dt - 4)).toBeLessThan(1e-12);
  expect(Math.abs(step / steps - 0.5)).toBeLessThan(0.02);
  const [atX, atY] = await end(widget);
  expect(Math.hypot(atX - x, atY - y)).toBeLessThan(1e-12);
});

test('too few robots tell nothing, and none at all say so', async ({ page }) => {
  const widget = await openReckoning(page, 'samples="1000"');
  await expect(caption(widget)).toHaveText('Too few robots to tell 5 %: the bands are wider than that.');
  expect(await missed(widget)).toEqual(['too few', 'too few', 'too few']);
  await widget.getByRole('button', { name: 'Clear' }).click();
  await frames(page);
  await expect(caption(widget)).toHaveText('No robots yet.');
  expect(await missed(widget)).toEqual(['—', '—', '—']);
  await widget.getByRole('button', { name: 'Step', exact: true }).click();
  await frames(page);
  expect(await widget.evaluate((element) => /** @type {DeadReckoningElement} */ (element).machine.shown)).toBe(7);
});

test('no noise has no ratio, and a fourth order without a covariance neither', async ({ page }) => {
  const widget = await openReckoning(page, 'samples="500" alpha1="0" alpha2="0" alpha3="0" alpha4="0" alpha5="0" alpha6="0"');
  await expect(caption(widget)).toHaveText(/^No noise:/);
  await expect(plotOf(widget)).toHaveAttribute('aria-label', /along —/);
  const wild = await widget.evaluate((element) => {
    Object.assign(element, { headingNoise: 60, compounding: 'fourth-order', step: 20 });
    return /** @type {DeadReckoningElement} */ (element).machine.stats.predicted['fourth-order'];
  });
  expect(wild).toBeNull();
  await settled(widget);
  await expect(caption(widget)).toHaveText(/has left no covariance/);
});

test('a robot that is pointed at shows its way', async ({ page }) => {
  const widget = await openReckoning(page, 'step="20"');
  await unfold(widget);
  const canvas = widget.locator('canvas.plane');
  const before = await pixelsOf(canvas, 'accent');
  await widget.getByRole('spinbutton', { name: 'Robot' }).fill('40000');
  await frames(page);
  expect(await pixelsOf(canvas, 'accent')).toBeGreaterThan(before + 100);
  const end = await widget.evaluate((element) => [.../** @type {DeadReckoningElement} */ (element).machine.rollout(39_999)].slice(-3));
  await expect(widget.locator('.marked output')).toContainText(`x ${end[0].toFixed(3)} m`);
});

test('CSV has a row a step', async ({ page }) => {
  const widget = await openReckoning(page);
  const { text, measured, predicted } = await widget.evaluate((element) => {
    const { machine } = /** @type {DeadReckoningElement} */ (element);
    return { text: /** @type {any} */ (element).toCSV(), measured: [...machine.measured], predicted: [...machine.predicted['first-order']] };
  });
  const lines = text.trimEnd().split('\n');
  const [, columns, ...rows] = lines;
  const names = columns.split(',');
  expect(rows).toHaveLength(20);
  const value = (/** @type {number} */ row, /** @type {string} */ name) => Number(rows[row].split(',')[names.indexOf(name)]);
  expect(value(0, 'step')).toBe(1);
  expect(value(4, 'measured_lateral_m2')).toBe(measured[13]);
  expect(value(19, 'first_order_heading_rad2')).toBe(predicted[59]);
  expect(value(0, 'chapter_lateral_m2')).toBe(0);
});

test('variances of a straight drive cross where the formula says', async ({ page }) => {
  const widget = await openReckoning(page);
  await unfold(widget);
  const plot = widget.locator('figure svg.plot');
  await expect(plot).toHaveAttribute('aria-label', /Equal to first order after 2.00 s\.$/);
  await widget.evaluate((element) => Object.assign(element, { headingNoise: 0.08 }));
  await settled(widget);
  await expect(plot).toHaveAttribute('aria-label', /after 1.00 s\.$/);
  await widget.evaluate((element) => Object.assign(element, { headingNoise: 0 }));
  await settled(widget);
  await expect(plot).toHaveAttribute('aria-label', /never cross\.$/);
});

test('a change that takes long shows its progress, and can be stopped', async ({ page }) => {
  const widget = await openReckoning(page);
  const before = await config(widget);
  await widget.evaluate((element) => Object.assign(element, { samples: 1_000_000 }));
  await expect(widget.locator('[part=progress]')).toBeVisible();
  await page.keyboard.press('Escape');
  await expect(widget.locator('[part=progress]')).toHaveCount(0);
  expect(await config(widget)).toEqual(before);
  expect(await missed(widget)).toEqual(['steps 15–20', 'steps 1–15', 'never']);
});
