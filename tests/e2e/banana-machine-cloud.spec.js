import { expect } from '@playwright/test';
import { REDUCED_MOTION, readBananaResults, readBox, readCentre, waitForFrames, parseNumberIn, openBanana, openBananaWithDisclosures, pauseAfterFirstStep, readPicture, countPixelsOfRole, readPoses, readoutValueOf, readoutDetailOf, setSliders, test } from './support.js';

/** @typedef {import('./support.js').BananaMachineElement} BananaMachineElement */
/** @typedef {import('@playwright/test').Locator} Locator */

test.use(REDUCED_MOTION);

const OPENING_ALPHAS = [0.002, 0.002, 0.1, 0.1, 0.002, 0.002];

/** Number of steps in which a cloud grows to its full size. */
const GROWTH_STEPS = 150;

/** @param {Locator} widget */
const captionOf = (widget) => widget.locator('p[part=caption]');

/** Returns the three numbers that the figure prints for the marked robot. @param {Locator} widget */
async function readNumbersOfMarkedSample(widget) {
  const outputText = (await widget.locator('.marked output').textContent()) ?? '';
  const printedNumbers = [...outputText.matchAll(/= (\S+)/g)].map(([, printedNumber]) => parseNumberIn(printedNumber));
  expect(printedNumbers).toHaveLength(3);
  return printedNumbers;
}

test('the cloud grows automatically, and can be paused and resumed', async ({ page }) => {
  await page.emulateMedia({ reducedMotion: 'no-preference' });
  await pauseAfterFirstStep(page, 'banana-machine');
  const widget = await openBanana(page);
  const playButton = widget.locator('.cloud').getByRole('button', { name: 'Draw samples' });
  await expect(playButton).toBeVisible();
  const [pausedResults, firstPoses] = [await readBananaResults(widget), await readPoses(widget)];
  expect(pausedResults.shown).toBeGreaterThan(0);
  expect(pausedResults.shown).toBeLessThan(pausedResults.config.samples);
  await waitForFrames(page);
  expect((await readBananaResults(widget)).shown).toBe(pausedResults.shown);

  await playButton.click();
  await widget.getByRole('button', { name: 'Pin' }).click();
  await expect.poll(async () => (await readBananaResults(widget)).shown, { timeout: 20_000 }).toBe(pausedResults.config.samples);
  // If the readouts are pinned while the cloud grows, the pinned numbers are replaced by those of the complete cloud.
  await expect(readoutValueOf(widget, 'cross-track skew')).toHaveText(/^(.+ ± .+) pinned: \1$/);
  await expect(playButton).toBeVisible();
  expect((await readPoses(widget)).slice(0, firstPoses.length)).toEqual(firstPoses);
});

test('the figure opens with the whole cloud of the default command, and shows the statistics of the simulation', async ({ page }) => {
  const widget = await openBananaWithDisclosures(page);
  const { config: figureConfig, shown: shownCount, stats, table: resultTable } = await readBananaResults(widget);
  expect(figureConfig).toMatchObject({ model: 'velocity', noise: 'normal', command: { v: 1, omega: 0, dt: 2 }, alphas: OPENING_ALPHAS, isolate: null });
  expect(shownCount).toBe(figureConfig.samples);
  expect(Math.abs(resultTable.exact.areaRatio - 1.967)).toBeLessThan(5e-4);
  const readReadoutText = async (/** @type {string | RegExp} */ readoutName) => (await readoutValueOf(widget, readoutName).textContent()) ?? '';
  const [printedSkew, skewError] = (await readReadoutText('cross-track skew')).split(' ± ').map(parseNumberIn);
  expect(printedSkew).toBeCloseTo(stats.crossTrackSkew, 3);
  expect(skewError).toBeCloseTo(stats.crossTrackSkewError, 3);
  await expect(readoutDetailOf(widget, 'cross-track skew')).toHaveText('exactly 0.000');
  expect(parseNumberIn(await readReadoutText('predicts'))).toBeCloseTo(stats.gaussianSkew, 3);
  expect(parseNumberIn(await readReadoutText('ρ'))).toBeCloseTo(stats.rhoCrossHeading, 3);
  expect((await readReadoutText('robots shown')).split(' of ').map(parseNumberIn)).toEqual([stats.n, figureConfig.samples]);
  const [printedGain, gainError] = (await readReadoutText('gain in fit')).split(' ± ').map(parseNumberIn);
  expect(printedGain).toBeCloseTo(stats.likelihoodGain.pose, 3);
  expect(gainError).toBeCloseTo(stats.likelihoodGainError.pose, 3);
  expect(await readReadoutText('area covered')).toBe(`${stats.areaRatio.toFixed(2)} ×`);
  const coverageTexts = [stats.coverage.ellipse, stats.coverage.exponential].map((coverageShare) => `${(100 * coverageShare).toFixed(1)}\u202f%`);
  await expect(readoutDetailOf(widget, 'area covered')).toHaveText(`± ${stats.areaRatioError.toPrecision(1)}; inside: ellipse ${coverageTexts.join(', outline ')}`);
  await expect(readoutDetailOf(widget, 'gain in fit')).toHaveText(new RegExp(`^exactly ${resultTable.exact.likelihoodGain.pose.toFixed(3)}; a robot is \\d\\.\\d\\d times as likely$`));
  const varianceRow = widget.locator('tr').filter({ has: page.getByRole('rowheader', { name: 'Σxx', exact: true }) });
  const xVariances = (await varianceRow.getByRole('cell').allTextContents()).map(parseNumberIn);
  for (const [i, tableColumn] of [resultTable.linearized, resultTable.exact, resultTable.measured].entries()) expect(xVariances[i] / tableColumn.cov[0][0]).toBeCloseTo(1, 2);
  const floorCanvas = widget.locator('canvas.plane');
  await expect(floorCanvas).toHaveAttribute('aria-label', /^On the floor: no ellipse fits\. Command: v = .*\. The cloud is bent: /);
});

test('Clear empties the cloud, and Step adds the same robots again, batch by batch', async ({ page }) => {
  const widget = await openBanana(page, 'samples="3000"');
  const [wholeCloud, wholeCloudPoses] = [await readBananaResults(widget), await readPoses(widget)];
  await widget.getByRole('button', { name: 'Clear' }).click();
  expect((await readBananaResults(widget)).shown).toBe(0);
  await expect(readoutValueOf(widget, 'cross-track skew')).toHaveText('—');
  await expect(widget.getByRole('img', { name: 'No robots yet' }).first()).toBeVisible();

  const batchSize = Math.ceil(wholeCloud.config.samples / GROWTH_STEPS);
  for (const expectedCount of [batchSize, 2 * batchSize]) {
    await widget.getByRole('button', { name: 'Step' }).click();
    expect((await readBananaResults(widget)).shown).toBe(expectedCount);
    expect(await readPoses(widget)).toEqual(wholeCloudPoses.slice(0, 3 * expectedCount));
  }
});

test('each overlay has a toggle', async ({ page }) => {
  const widget = await openBananaWithDisclosures(page, 'preset="gentle"');
  const floorCanvas = widget.locator('canvas.plane');
  const twistCanvas = widget.locator('canvas.twist');
  const pictureBefore = await readPicture(floorCanvas);
  for (const [legendLabel, colorRole] of [
    ['commanded arc', 'prior'],
    ['Gaussian in (x, y)', 'prediction'],
    ['linearized (EKF)', 'prediction'],
    ['noise added to the pose', 'prediction'],
    ['Gaussian in ξ', 'posterior'],
  ]) {
    const legendCheckbox = widget.getByRole('checkbox', { name: legendLabel });
    const isShown = await legendCheckbox.isChecked();
    const pixelCountBefore = await countPixelsOfRole(floorCanvas, colorRole);
    await legendCheckbox.setChecked(!isShown);
    await page.mouse.move(0, 0);
    const pixelCountChange = (await countPixelsOfRole(floorCanvas, colorRole)) - pixelCountBefore;
    expect(isShown ? -pixelCountChange : pixelCountChange, legendLabel).toBeGreaterThan(30);
    if (colorRole === 'posterior') expect(await countPixelsOfRole(twistCanvas, colorRole)).toBe(0);
    await legendCheckbox.setChecked(isShown);
    await page.mouse.move(0, 0);
  }
  expect(await readPicture(floorCanvas)).toBe(pictureBefore);
});

test('a robot under the pointer is marked in both views, with the motion that it executed', async ({ page }) => {
  const widget = await openBananaWithDisclosures(page, 'preset="gentle"');
  const floorCanvas = widget.locator('canvas.plane');
  const twistCanvas = widget.locator('canvas.twist');
  const robotField = widget.getByRole('spinbutton', { name: 'Robot', exact: true });
  const countMarkPixels = async () => [await countPixelsOfRole(floorCanvas, 'accent'), await countPixelsOfRole(twistCanvas, 'accent')];
  expect(await countMarkPixels()).toEqual([0, 0]);

  const checkMarkedRobot = async () => {
    const robotIndex = Number(await robotField.inputValue()) - 1;
    const { vHat, omegaHat, gammaHat } = await widget.evaluate((element, i) => /** @type {BananaMachineElement} */ (element).simulation.inspect(i), robotIndex);
    const printedNumbers = await readNumbersOfMarkedSample(widget);
    for (const [i, executedValue] of [vHat, omegaHat, gammaHat].entries()) expect(printedNumbers[i]).toBeCloseTo(executedValue, 3);
    return robotIndex;
  };

  const handleCentre = await readCentre(widget.locator('.handle'));
  await page.mouse.move(handleCentre.x + 30, handleCentre.y + 20);
  for (const markPixelCount of await countMarkPixels()) expect(markPixelCount).toBeGreaterThan(20);
  const indexInPlane = await checkMarkedRobot();

  await twistCanvas.scrollIntoViewIfNeeded();
  const { x, y, width, height } = await readBox(twistCanvas);
  await page.mouse.move(x + width * 0.45, y + height * 0.45);
  for (const markPixelCount of await countMarkPixels()) expect(markPixelCount).toBeGreaterThan(20);
  expect(await checkMarkedRobot()).not.toBe(indexInPlane);

  await robotField.fill('');
  await robotField.press('Enter');
  expect(await countMarkPixels()).toEqual([0, 0]);
});

test('the caption states the exact statistics of the model, and those of the robots', async ({ page }) => {
  const widget = await openBananaWithDisclosures(page, 'preset="gentle"');
  const pressPreset = (/** @type {string} */ accessibleName) => widget.getByRole('button', { name: accessibleName, exact: true }).click();
  await expect(captionOf(widget)).toHaveText(/^The cloud is bent, with its tail to the right of the mean heading: skew −0\.4\d\d\s±\s0\.01\d, where any Gaussian in \(x, y\) has 0\.$/);
  await widget.locator('#omega').fill('-0.5');
  await expect(captionOf(widget)).toHaveText(/tail to the left/);

  // The cloud of the preset "Banana" is symmetric: its exact skew is 0. Its 2σ ellipse has twice the area of the outline in ξ.
  await pressPreset('Banana');
  await waitForFrames(page);
  const { table: resultTable } = await readBananaResults(widget);
  expect(Math.abs(resultTable.exact.crossTrackSkew)).toBeLessThan(1e-9);
  expect(Math.abs(resultTable.exact.areaRatio - 1.97)).toBeLessThan(0.005);
  const [areaRatioText] = (await readoutValueOf(widget, 'area covered').innerText()).split(' ');
  await expect(captionOf(widget)).toHaveText(
    new RegExp(`^The cloud is bent: its ellipse covers ${areaRatioText} times the area of the ξ outline\\. Both sides are alike: skew −?0\\.\\d+\\s±\\s0\\.\\d+, exactly 0 by symmetry\\.$`),
  );
  // With ω = 0.02 the cloud is nearly symmetric, and is still strongly bent.
  await widget.locator('#omega').fill('0.02');
  await expect(captionOf(widget)).toHaveText(/^The cloud is bent: its ellipse covers .* Both sides are nearly alike: skew −?0\.\d+\s±\s0\.\d+, exactly −?0\.0\d+\.$/);
  await widget.locator('#omega').fill('0');
  // A cloud with little noise of the turn rate is not bent.
  for (const sliderId of ['alpha3', 'alpha4']) await widget.locator(`#${sliderId}`).fill('0.001');
  await expect(captionOf(widget)).toHaveText(/^Both sides are alike: skew [^.]*\.\d+\s±\s[\d.]+, exactly 0 by symmetry\.$/);
});

test('the caption explains the bow-tie shape of the preset Pivot, and claims no lean if there are few robots @nightly', async ({ page }) => {
  const widget = await openBananaWithDisclosures(page);
  await widget.getByRole('button', { name: 'Pivot' }).click();
  const { table: resultTable, config: figureConfig, stats: { exponential: { mean, cov } } } = await readBananaResults(widget);
  const cloudSizeText = `a drive of ${mean[0].toFixed(2)} m by ${Math.sqrt(cov[0][0]).toFixed(2)} m, ahead of the start and behind it`;
  await expect(captionOf(widget)).toContainText(cloudSizeText);
  expect(Math.abs(resultTable.exact.crossTrackSkew)).toBeGreaterThan(0.01);
  const behindStartCount = (await readPoses(widget)).filter((x, i) => i % 3 === 0 && x < 0).length;
  expect(behindStartCount / figureConfig.samples).toBeGreaterThan(0.3);

  await widget.getByRole('button', { name: 'Gentle arc' }).click();
  await widget.locator('#samples').fill('3');
  const { stats, table: tableOfSmallCloud } = await readBananaResults(widget);
  expect(Math.abs(stats.crossTrackSkew)).toBeLessThan(2 * stats.crossTrackSkewError);
  await expect(captionOf(widget)).toHaveText(new RegExp(`^Too few robots to show the lean: .*exactly −${Math.abs(tableOfSmallCloud.exact.crossTrackSkew).toFixed(3)}\\.$`));
});

test('the figure states that a cloud with full turns has no exponential coordinates @nightly', async ({ page }) => {
  const widget = await openBananaWithDisclosures(page);
  await setSliders(widget, { omega: 2, dt: 3 });
  await expect(widget.locator('.note')).toContainText('there are no statistics in ξ');
  await expect(readoutDetailOf(widget, 'area covered')).toHaveText(/inside: ellipse [\d.]+\u202f%, outline —$/);
  for (const readoutName of ['predicts', 'area covered', 'gain in fit']) await expect(readoutValueOf(widget, readoutName)).toHaveText('—');
});

test('with the odometry model, the figure shows the noise of a marked robot’s three motions, and has an option for reverse drives', async ({ page }) => {
  const widget = await openBananaWithDisclosures(page, 'preset="gentle"');
  await expect(widget.getByLabel('Reverse without half-turn noise')).toHaveCount(0);
  await widget.getByLabel('odometry').check();
  await widget.getByRole('spinbutton', { name: 'Robot', exact: true }).fill('5');
  await page.keyboard.press('Enter');
  await waitForFrames(page);
  const expectedNoises = await widget.evaluate((element) => {
    const { simulation } = /** @type {BananaMachineElement} */ (element);
    const { legs } = simulation.inspect(4);
    if (!legs) throw new Error('Odometry drives legs.');
    const { rot1, trans, rot2 } = simulation.reading;
    return [rot1 - legs.rot1, trans - legs.trans, rot2 - legs.rot2];
  });
  const printedNumbers = await readNumbersOfMarkedSample(widget);
  expectedNoises.forEach((noise, i) => expect(printedNumbers[i]).toBeCloseTo(noise, 3));

  await widget.locator('#v').fill('-1');
  await expect(captionOf(widget)).toContainText('two half turns');
  await widget.getByLabel('Reverse without half-turn noise').check();
  await expect(captionOf(widget)).not.toContainText('two half turns');
});

test('captions and notes depend on the model and its noise', async ({ page }) => {
  const widget = await openBananaWithDisclosures(page);
  const cloudCaption = widget.locator('.figures figure p');
  await expect(cloudCaption).toContainText('nearly a Gaussian');
  await setSliders(widget, { alpha5: 0, alpha6: 0 });
  await expect(cloudCaption).toContainText('exactly a Gaussian');
  await widget.getByLabel('triangular').check();
  await expect(cloudCaption).toContainText('triangular noise is not Gaussian');
  await widget.getByLabel('odometry').check();
  await expect(cloudCaption).toContainText('only roughly');
  await setSliders(widget, { v: -1 });
  await expect(widget.locator('.note')).toContainText('Odometry reads a drive in reverse as two half turns');
  await widget.getByLabel('velocity').check();
  await expect(widget.locator('.note')).toHaveCount(0);
});

test('the range of the marked robot and the size of a step depend on the size of the cloud @nightly', async ({ page }) => {
  const widget = await openBananaWithDisclosures(page);
  const robotField = widget.getByRole('spinbutton', { name: 'Robot', exact: true });
  const stepButton = widget.getByRole('button', { name: 'Step' });
  await expect(stepButton).toBeDisabled();
  await expect(robotField).toHaveAttribute('placeholder', '1–50\u202f000');
  await robotField.fill('1500');
  await robotField.blur();
  await waitForFrames(page);
  await expect(widget.locator('.marked output')).toContainText('m/s');
  await setSliders(widget, { samples: 3 });
  await expect(robotField).toHaveValue('');
  await expect(widget.locator('.marked output')).toContainText('Point at one');
  await robotField.fill('100');
  await robotField.blur();
  await expect(widget.locator('.marked output')).toContainText('m/s');
  await widget.getByRole('button', { name: 'Clear' }).click();
  await expect(robotField).toBeDisabled();
  await expect(stepButton).toBeEnabled();
});
