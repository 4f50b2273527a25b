import { expect } from '@playwright/test';
import { REDUCED_MOTION, dragSlider, waitForFrames, mountFigure, readPicture, countPixelsOfRole, readoutValueOf, readoutDetailOf, test, openDisclosures, waitUntilSettled } from './support.js';

/** @import { Locator, Page } from '@playwright/test' */
/** @import { DeadReckoning } from '../../www/types.d.ts' */
/** @typedef {HTMLElement & { simulation: DeadReckoning }} DeadReckoningElement */

test.use(REDUCED_MOTION);

/** Opens a page with a Dead Reckoning, and waits for all its robots. @param {Page} page @param {string} [attributes] */
async function openDeadReckoning(page, attributes) {
  const widget = await mountFigure(page, 'dead-reckoning', { attributes });
  await waitUntilSettled(widget);
  return widget;
}

/** @param {Locator} widget */
const readConfig = (widget) => widget.evaluate((element) => /** @type {DeadReckoningElement} */ (element).simulation.config);
const captionOf = (/** @type {Locator} */ widget) => widget.locator('p[part=caption]');
const ratioPlotOf = (/** @type {Locator} */ widget) => widget.locator('.ratios svg.plot');

/**
 * Returns a text such as "steps 15–20" for each variance. It names the steps at which the predicted variance is wrong by more than 5 %.
 *
 * @param {Locator} widget
 * @param {number} [recursionColumn] index of a column of the table; each has the predictions of one recursion
 */
async function readMissedSteps(widget, recursionColumn = 0) {
  await openDisclosures(widget);
  return Promise.all([0, 2, 4].map((tableRow) => widget.locator('.folds tbody tr').nth(tableRow).locator('td').nth(recursionColumn).textContent()));
}

test('the figure opens with the chapter’s error of 6 % along the track, and states that the lateral variance is off earlier', async ({ page }) => {
  const widget = await openDeadReckoning(page);
  expect(await readConfig(widget)).toMatchObject({
    command: { v: 1, omega: 0.5, dt: 0.2 }, steps: 20, step: 20, alphas: [0.02, 0.02, 0.02, 0.02, 0.005, 0.005], compounding: 'chapter', samples: 50_000,
  });
  await expect(captionOf(widget)).toHaveText(
    'At the end the predicted along-track variance is off by −6.1\u202f%. Before, the lateral one is 0.00 (step 1), 0.44 (step 2), 0.77 (step 5) of the measured one.',
  );
  await expect(readoutValueOf(widget, 'predicted along-track variance')).toHaveText('0.94');
  await expect(readoutDetailOf(widget, 'predicted along-track variance')).toHaveText('± 0.01 times the measured, at step 20, 50\u202f000 robots');
  expect(await readMissedSteps(widget)).toEqual(['steps 15–20', 'steps 1–15', 'never']);
  await expect(widget.locator('.folded svg.plot')).toHaveAttribute('aria-label', /: 2\.00 s$/);
  await expect(widget.getByRole('row', { name: 'along the track, at the end' }).locator('td').first()).toHaveText('−6.1 ± 0.6\u202f%');
  await expect(ratioPlotOf(widget)).toHaveAttribute('aria-label', /At step 20: along the track 0.939 ± 0.006, lateral 0.970 ± 0.006, heading/);
  for (const [canvasClass, colorRole] of [['plane', 'prior'], ['plane', 'posterior'], ['twist', 'posterior'], ['twist', 'truth']]) {
    expect(await countPixelsOfRole(widget.locator(`canvas.${canvasClass}`), colorRole), `${colorRole} in ${canvasClass}`).toBeGreaterThan(10);
  }
});

test('the line in the chart selects a step by pointer or keyboard, and starts no new simulation', async ({ page }) => {
  const widget = await openDeadReckoning(page);
  const stepSlider = widget.getByRole('slider', { name: 'selected step', exact: true });
  const variancesBefore = await widget.evaluate((element) => /** @type {DeadReckoningElement} */ (element).simulation.measured);
  const takePictures = () => Promise.all(['plane', 'twist'].map((canvasClass) => readPicture(widget.locator(`canvas.${canvasClass}`))));
  const [floorPictureAtEnd, twistPictureAtEnd] = await takePictures();
  await stepSlider.press('ArrowLeft');
  await waitForFrames(page);
  expect((await readConfig(widget)).step).toBe(19);
  const [floorPicture, twistPicture] = await takePictures();
  expect(floorPicture).not.toBe(floorPictureAtEnd);
  expect(twistPicture).not.toBe(twistPictureAtEnd);
  expect(await widget.evaluate((element) => /** @type {DeadReckoningElement} */ (element).simulation.measured)).toEqual(variancesBefore);
  await expect(stepSlider).toHaveAttribute('aria-valuetext', 'step 19');
  await stepSlider.press('Home');
  await waitForFrames(page);
  await expect(widget.locator('canvas.twist')).toHaveAttribute('aria-label', 'Step 1 in exponential coordinates');
  await expect(ratioPlotOf(widget)).toContainText('step 1');
  await dragSlider(stepSlider, 0.5);
  await waitForFrames(page);
  expect((await readConfig(widget)).step).toBe(10);
});

test('with the right Jacobian J_r and fourth-order terms, every predicted variance is correct', async ({ page }) => {
  const widget = await openDeadReckoning(page);
  for (const [i, accessibleName] of ['with Jᵣ, the turn during a step', 'fourth order'].entries()) {
    await widget.getByRole('radio', { name: accessibleName }).check();
    await waitForFrames(page);
    expect(await readMissedSteps(widget, i + 1)).toEqual(['never', 'never', 'never']);
    await expect(captionOf(widget)).toHaveText('Within 5 % of what 50\u202f000 robots do, in every component at every step.');
  }
  expect((await readConfig(widget)).compounding).toBe('fourth-order');
});

test('entries of the legends show and hide curves and outlines', async ({ page }) => {
  const widget = await openDeadReckoning(page, 'overlays="lateral tolerance measured exponential"');
  await expect(widget.locator('[part=caption]')).toHaveText(/^At the end the predicted lateral variance is off by [−+][\d.]+\s%\. Before, the lateral one is /);
  await expect(ratioPlotOf(widget).locator('path.curve, circle')).toHaveCount(2);
  const twistPicture = await readPicture(widget.locator('canvas.twist'));
  await widget.getByRole('checkbox', { name: 'measured' }).uncheck();
  await widget.getByRole('checkbox', { name: 'lateral' }).uncheck();
  await expect(widget).toHaveAttribute('overlays', 'tolerance exponential');
  await expect(ratioPlotOf(widget).locator('path.curve, circle')).toHaveCount(0);
  await waitForFrames(page);
  expect(await readPicture(widget.locator('canvas.twist'))).not.toBe(twistPicture);
});

test('presets set the path, and the button of the present path is marked', async ({ page }) => {
  const widget = await openDeadReckoning(page);
  const presetButtonOf = (/** @type {string} */ accessibleName) => widget.getByRole('button', { name: accessibleName });
  await expect(presetButtonOf('The chapter’s 20 steps')).toHaveAttribute('aria-pressed', 'true');
  await presetButtonOf('Heading σ doubled').click();
  await waitUntilSettled(widget);
  expect((await readConfig(widget)).alphas).toEqual([0.02, 0.02, 0.08, 0.08, 0.02, 0.02]);
  expect((await readMissedSteps(widget))[0]).toBe('steps 9–20');
  await expect(widget).toHaveAttribute('preset', 'doubled');
  await presetButtonOf('Same path, 200 steps').click();
  await waitUntilSettled(widget);
  expect(await readConfig(widget)).toMatchObject({ steps: 200, command: { dt: 0.02 } });
  expect((await readMissedSteps(widget))[0]).toBe('never');
  await widget.locator('#headingNoise').press('ArrowRight');
  await waitUntilSettled(widget);
  expect((await readConfig(widget)).alphas).toEqual([0.02, 0.02, 0.025, 0.025, 0.00625, 0.00625]);
  await expect(widget).not.toHaveAttribute('preset');
});

test('more steps divide the same path into shorter steps, and the views stay', async ({ page }) => {
  const widget = await openDeadReckoning(page, 'step="10" samples="1000"');
  const commandedEndOf = (/** @type {Locator} */ deadReckoning) => deadReckoning.evaluate((element) => [.../** @type {DeadReckoningElement} */ (element).simulation.commanded.slice(-2)]);
  const [xBefore, yBefore] = await commandedEndOf(widget);
  await dragSlider(widget.locator('#steps'), 0.5);
  await waitUntilSettled(widget);
  const { steps: stepCount, step: selectedStep, command } = await readConfig(widget);
  expect(stepCount).toBeGreaterThan(80);
  expect(Math.abs(stepCount * command.dt - 4)).toBeLessThan(1e-12);
  expect(Math.abs(selectedStep / stepCount - 0.5)).toBeLessThan(0.02);
  const [endX, endY] = await commandedEndOf(widget);
  expect(Math.hypot(endX - xBefore, endY - yBefore)).toBeLessThan(1e-12);
});

test('with too few robots no step is judged, and without robots the caption says that there are none @nightly', async ({ page }) => {
  const widget = await openDeadReckoning(page, 'samples="1000"');
  await expect(captionOf(widget)).toHaveText('Too few robots to detect an error of 5 %: the bands are wider.');
  expect(await readMissedSteps(widget)).toEqual(['too few', 'too few', 'too few']);
  await widget.getByRole('button', { name: 'Clear' }).click();
  await waitForFrames(page);
  await expect(captionOf(widget)).toHaveText('No robots yet.');
  expect(await readMissedSteps(widget)).toEqual(['—', '—', '—']);
  await widget.getByRole('button', { name: 'Step', exact: true }).click();
  await waitForFrames(page);
  expect(await widget.evaluate((element) => /** @type {DeadReckoningElement} */ (element).simulation.shown)).toBe(7);
});

test('without noise, or if fourth-order terms leave no valid covariance, the figure shows no ratio @nightly', async ({ page }) => {
  const widget = await openDeadReckoning(page, 'samples="500" alpha1="0" alpha2="0" alpha3="0" alpha4="0" alpha5="0" alpha6="0"');
  await expect(captionOf(widget)).toHaveText(/^No noise:/);
  await expect(ratioPlotOf(widget)).toHaveAttribute('aria-label', /along the track —/);
  await widget.evaluate((element) => Object.assign(element, { headingNoise: 60, compounding: 'fourth-order', step: 20 }));
  await waitUntilSettled(widget);
  await expect(captionOf(widget)).toHaveText(/gives no valid covariance/);
});

test('the exported CSV has a row for each step', async ({ page }) => {
  const widget = await openDeadReckoning(page);
  const { text: csvText, measured, predicted } = await widget.evaluate((element) => {
    const { simulation } = /** @type {DeadReckoningElement} */ (element);
    return { text: /** @type {any} */ (element).toCSV(), measured: [...simulation.measured], predicted: [...simulation.predicted['first-order']] };
  });
  const csvLines = csvText.trimEnd().split('\n');
  const [, headerLine, ...dataLines] = csvLines;
  const columnNames = headerLine.split(',');
  expect(dataLines).toHaveLength(20);
  const readCsvValue = (/** @type {number} */ lineIndex, /** @type {string} */ columnName) => Number(dataLines[lineIndex].split(',')[columnNames.indexOf(columnName)]);
  expect(readCsvValue(0, 'step')).toBe(1);
  expect(readCsvValue(4, 'measured_lateral_m2')).toBe(measured[13]);
  expect(readCsvValue(19, 'first_order_heading_rad2')).toBe(predicted[59]);
  expect(readCsvValue(0, 'chapter_lateral_m2')).toBe(0);
});

test('with a million robots, the results of the first block appear at once, and other blocks follow', async ({ page }) => {
  const widget = await openDeadReckoning(page);
  const [countInFirstBlock, finalCount] = await widget.evaluate(async (element) => {
    const deadReckoning = /** @type {any} */ (element);
    await deadReckoning.settled;
    Object.assign(deadReckoning, { samples: 1_000_000 });
    const { n } = deadReckoning.stats;
    await deadReckoning.settled;
    return [n, deadReckoning.stats.n];
  });
  expect(countInFirstBlock).toBeLessThan(1_000_000);
  expect(finalCount).toBe(1_000_000);
});
