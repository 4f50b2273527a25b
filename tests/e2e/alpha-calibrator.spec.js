import { readFileSync } from 'node:fs';
import { expect } from '@playwright/test';
import { captionOf, openCalibrator, alphaRowsOf, findFoldedGroup, readStats } from './calibrator-support.js';
import { REDUCED_MOTION, readBox, waitForFrames, countPixelsOfRole, readState, test, openDisclosures, waitUntilSettled } from './support.js';

test.use(REDUCED_MOTION);

test('the figure opens with a simulated log, which is labelled as simulated, and shows its true α’s', async ({ page }) => {
  const widget = await openCalibrator(page);
  await expect(captionOf(widget)).toHaveText(/^✓ Trust\s+All 14 checks passed\. \d+ legs of the simulated log, \d outliers\.$/);
  await expect(widget.locator('.to-do')).toHaveText(/^Use the recommended α’s with legs of this length\. First multiply the odometry’s distances by 1\.0\d\d and turns by 0\.9\d\d: the α’s are those of the corrected robot\.$/);
  const { truth: trueParameters } = await widget.evaluate((element) => /** @type {any} */ (element).viewModel);
  await expect(widget.locator('.alphas tr > :last-child')).toHaveText(['simulated', ...trueParameters.alphas.map(String)]);
  for (const colorRole of /** @type {const} */ (['truth', 'prediction', 'accent'])) {
    expect(await countPixelsOfRole(widget.locator('canvas.plane'), colorRole), colorRole).toBeGreaterThan(20);
  }
  expect(await countPixelsOfRole(widget.locator('canvas.leg'), 'prediction')).toBeGreaterThan(20);
  expect(await widget.evaluate((element) => /** @type {any} */ (element).toCSV())).toMatch(/^# \{"element":"alpha-calibrator","model":/);
});

test('the true α’s are shown only if the fit uses the rule and the leg length of the simulation', async ({ page }) => {
  const widget = await openCalibrator(page);
  await openDisclosures(widget);
  await widget.getByRole('radio', { name: 'AMCL of Nav2' }).check();
  await waitUntilSettled(widget);
  await expect(widget.locator('.alphas thead')).not.toContainText('simulated');
  await widget.getByRole('radio', { name: 'velocity' }).check();
  await waitUntilSettled(widget);
  await expect(alphaRowsOf(widget)).toHaveCount(6);
  expect(await readState(widget)).toMatchObject({ model: 'velocity', rule: 'thrun' });
  await widget.getByRole('radio', { name: 'omnidirectional' }).check();
  await waitUntilSettled(widget);
  await expect(alphaRowsOf(widget)).toHaveCount(5);
  expect(await readState(widget)).toMatchObject({ model: 'omnidirectional', rule: 'omni' });
});

test('the meaning of each α is shown next to its numbers, and fits on a phone, in German and in a wide font', async ({ page }) => {
  const widget = await openCalibrator(page, 'lang="de"');
  await expect(alphaRowsOf(widget).locator('th')).toHaveText(['α1 Drehrauschen durch Drehen', 'α2 Drehrauschen durch Fahren', 'α3 Streckenrauschen durch Fahren', 'α4 Streckenrauschen durch Drehen']);
  for (const [pageWidth, letterSpacing] of [[375, 0], [920, 0.1], [1280, 0], [1280, 0.1]]) {
    await page.setViewportSize({ width: pageWidth, height: 900 });
    await page.evaluate((spacingEm) => void (document.body.style.letterSpacing = `${spacingEm}em`), letterSpacing);
    await waitForFrames(page);
    expect(await page.evaluate(() => document.documentElement.scrollWidth), `${pageWidth} px, ${letterSpacing} em`).toBeLessThanOrEqual(pageWidth);
    // Table rows of 40 px show the name of the α in at most two lines.
    if (letterSpacing === 0 && pageWidth === 1280) for (const alphaRow of await alphaRowsOf(widget).all()) expect((await readBox(alphaRow)).height, `${pageWidth} px`).toBeLessThan(40);
  }
});

test('outliers are marked by rings, and change the fit strongly if they are not excluded', async ({ page }) => {
  const widget = await openCalibrator(page);
  await openDisclosures(widget);
  const statsBefore = await readStats(widget);
  const inkPixelCount = await countPixelsOfRole(widget.locator('canvas.plane'), 'ink');
  await widget.getByRole('checkbox', { name: 'outlier', exact: true }).uncheck();
  expect(await countPixelsOfRole(widget.locator('canvas.plane'), 'ink')).toBeLessThan(inkPixelCount - 40);
  await widget.getByRole('radio', { name: 'fit as noise' }).check();
  await waitUntilSettled(widget);
  const statsAfter = await readStats(widget);
  expect(statsAfter.referenceNoise.positionStd.value).toBeGreaterThan(10 * statsBefore.referenceNoise.positionStd.interval[1]);
  // The ratios in the text of www/index.md must equal the computed ratios.
  const outlierCheck = statsBefore.diagnostics.checks.find(({ name: checkName }) => checkName === 'outliers-few');
  const [outlierRatioText, alpha3RatioText] = [10 * Math.round(0.1 / (outlierCheck?.value ?? NaN)), Number(statsAfter.alphas[2]) / Number(statsBefore.alphas[2])].map((computedRatio) => ({ 6: 'six', 60: 'sixty' })[Math.round(computedRatio)]);
  expect(readFileSync(new URL('../../www/index.md', import.meta.url), 'utf8')).toMatch(RegExp(`One in ${outlierRatioText} is an outlier[^]* becomes ${alpha3RatioText} times as large, and two checks fail`));
  await expect(captionOf(widget)).toHaveText(/^! Caution\s+Failed: correlation of neighbouring residuals; .* \(2 of 14 checks\)\. \d+ legs of the simulated log\.$/);
  await expect(widget.locator('.to-do')).toHaveText(/ If the log cannot be improved, use the recommended α’s\. First multiply the odometry’s turns by 0\.9\d\d: the α’s are those of the corrected robot\.$/);
});

test('a systematic error that is not corrected is named in the advice', async ({ page }) => {
  const widget = await openCalibrator(page);
  await openDisclosures(widget);
  const statsBefore = await readStats(widget);
  await widget.getByRole('checkbox', { name: /^mount yaw/ }).uncheck();
  await waitUntilSettled(widget);
  const statsAfter = await readStats(widget);
  expect(statsAfter.systematicErrors.mountYaw.corrected).toBe(false);
  expect(statsAfter.systematicErrors.mountYaw.value).toBeCloseTo(0.07, 2);
  // The two estimates in the text of www/index.md must equal the computed estimates.
  const [yawStdBefore, yawStdAfter] = [statsBefore, statsAfter].map(({ referenceNoise: { yawStd } }) => yawStd.value.toFixed(3));
  expect(readFileSync(new URL('../../www/index.md', import.meta.url), 'utf8')).toContain(`goes from ${yawStdBefore} to ${yawStdAfter}&nbsp;rad`);
  await expect(captionOf(widget)).toHaveText(/^! Caution\s+Failed: correlation of neighbouring residuals \(1 of 14 checks\)\.\s+\d+ legs /);
  await expect(widget.locator('.to-do')).toHaveText(/^Not corrected: mount yaw \(rad\) 0\.070\d \(0\.06\d\d – 0\.07\d\d\) \(see More controls\)\. Errors of neighbouring legs /);
  await expect(widget.getByRole('row', { name: /mount yaw/ })).toContainText('not corrected');
});

test('every check shows its value and the range that passes, and a failed check shows what to do', async ({ page }) => {
  const widget = await openCalibrator(page, 'outliers="keep" lang="de"');
  await openDisclosures(widget);
  const { diagnostics: { checks: checkResults } } = await readStats(widget);
  const checkRows = findFoldedGroup(widget, 'Prüfungen').locator('tbody tr');
  await expect(checkRows).toHaveCount(checkResults.length);
  expect(checkResults.filter(({ passed: hasPassed }) => !hasPassed).length).toBeGreaterThan(1);
  for (const [i, { passed: hasPassed }] of checkResults.entries()) await expect(checkRows.nth(i)).toContainText(hasPassed ? '✓ bestanden' : '✕ nicht bestanden');
  await expect(checkRows.filter({ hasText: 'Korrelation benachbarter Residuen' })).toContainText('Fehler benachbarter Etappen sind korreliert');
  await expect(checkRows.filter({ hasText: 'Anzahl der Etappen' })).toContainText('≥ 100');
});

test('a leg is selected in the picture, by a slider, or by a button that leads to the next large residual', async ({ page }) => {
  const widget = await openCalibrator(page);
  const { worstLegs } = await widget.evaluate((element) => /** @type {any} */ (element).viewModel);
  const nextResidualButton = widget.getByRole('button', { name: 'Next largest residual' });
  await nextResidualButton.click();
  expect(await readState(widget)).toMatchObject({ leg: worstLegs[0] });
  await nextResidualButton.click();
  expect(await readState(widget)).toMatchObject({ leg: worstLegs[1] });
  await waitForFrames(page);
  await widget.locator('#leg').press('ArrowRight');
  expect(await readState(widget)).toMatchObject({ leg: worstLegs[1] + 1 });
  const planeCanvas = widget.locator('canvas.plane');
  const clickTarget = await widget.evaluate((element) => {
    const { pictures: [{ pictureView }], simulation } = /** @type {any} */ (element);
    const { reference } = simulation.legs;
    const legMidpoint = [0, 1].map((axisIndex) => (reference[6 * 40 + axisIndex] + reference[6 * 40 + 3 + axisIndex]) / 2);
    return { x: pictureView.toPixelX(legMidpoint[0]), y: pictureView.toPixelY(legMidpoint[1]), leg: simulation.nearest(legMidpoint[0], legMidpoint[1], 1) };
  });
  await planeCanvas.click({ position: { x: clickTarget.x, y: clickTarget.y } });
  expect(await readState(widget)).toMatchObject({ leg: clickTarget.leg });
  await expect(widget.locator('canvas.leg')).toHaveAttribute('aria-label', new RegExp(`^Leg ${clickTarget.leg + 1},`));
});

test('an exported picture has a legend, and describes the verdict @nightly', async ({ page }) => {
  const widget = await openCalibrator(page);
  const captionText = ((await captionOf(widget).textContent()) ?? '').replace(/^\s*✓?!?\s*/, '').replace(/\s+/g, ' ').trim();
  const { texts: svgTexts, description } = await widget.evaluate((element) => {
    const { documentElement: svgRoot } = new DOMParser().parseFromString(/** @type {any} */ (element).toSVG(), 'image/svg+xml');
    return { texts: [...svgRoot.querySelectorAll('text')].map((textElement) => textElement.textContent), description: svgRoot.querySelector('desc')?.textContent ?? '' };
  });
  expect(description.replaceAll(/(Trust|Caution)\./g, '$1')).toContain(captionText);
  for (const legendText of ['p > 0.5', 'p 0.05–0.5', 'p 0.001–0.05', 'p < 0.001']) expect(svgTexts).toContain(legendText);
});

test('the lines for Nav2 contain the numbers of the table, and the button next to the α’s copies them', async ({ page, context: browserContext }) => {
  await browserContext.grantPermissions(['clipboard-read', 'clipboard-write']);
  const widget = await openCalibrator(page, 'rule="nav2" distance="0.3"');
  await openDisclosures(widget);
  const nav2Yaml = await widget.locator('textarea.yaml').inputValue();
  const alphaTexts = await alphaRowsOf(widget).evaluateAll((rowElements) => rowElements.map((rowElement) => [...rowElement.querySelectorAll('td div, td strong')].map((cellElement) => cellElement.textContent?.trim() ?? '')));
  expect(alphaTexts).toHaveLength(4);
  alphaTexts.forEach(([fittedText, intervalText, recommendedText], i) => expect(nav2Yaml).toContain(`    alpha${i + 1}: ${recommendedText}  # fitted ${fittedText}, 95 % ${intervalText.replace(' – ', ' to ')}\n`));
  await page.setViewportSize({ width: 360, height: 400 });
  await widget.getByRole('button', { name: 'Copy for Nav2' }).click();
  await expect(widget.getByText('Copied.')).toBeInViewport({ ratio: 1 });
  expect(await page.evaluate(() => navigator.clipboard.readText())).toBe(nav2Yaml);
  await widget.getByRole('radio', { name: 'velocity' }).check();
  await waitUntilSettled(widget);
  await expect(widget.locator('textarea.yaml')).toHaveCount(0);
  await widget.getByRole('button', { name: 'Fit for Nav2' }).click();
  await waitUntilSettled(widget);
  await expect(widget.locator('textarea.yaml')).toHaveValue(nav2Yaml);
});

test('sliders set the duration of the legs and the noise of the reference', async ({ page }) => {
  const widget = await openCalibrator(page, 'rule="nav2"');
  await openDisclosures(widget);
  const statsBefore = await readStats(widget);
  const durationSlider = widget.locator('.slider:has(#duration)');
  await expect(durationSlider.locator('.value')).toHaveText('—');
  await durationSlider.locator('.typed').fill('0.8');
  await durationSlider.locator('.typed').press('Enter');
  await waitUntilSettled(widget);
  expect(await readState(widget)).toMatchObject({ duration: 0.8, distance: 0.25, angle: 0.2 });
  await expect(widget.locator('.slider.off:is(:has(#distance), :has(#angle))')).toHaveCount(2);
  await expect(widget.locator('textarea.yaml')).toHaveValue(/# \d+ legs of 0\.8 s of the simulated log/);
  await expect(widget.locator('textarea.yaml')).not.toHaveValue(/update_min/);
  await durationSlider.locator('#duration').fill('0');
  await waitUntilSettled(widget);
  expect((await readStats(widget)).alphas).toEqual(statsBefore.alphas);
  // If the noise of the reference is set instead of estimated, the estimated noise of the wheels is lower.
  await expect(widget.locator('.slider:has(#positionStd) .value')).toHaveText('estimated');
  await widget.getByRole('slider', { name: /reference position σ/ }).fill('0.004');
  await widget.getByRole('slider', { name: /reference yaw σ/ }).fill('0.003');
  await waitUntilSettled(widget);
  expect(await readState(widget)).toMatchObject({ positionStd: 0.004, yawStd: 0.003, duration: 0 });
  expect(Number((await readStats(widget)).alphas[3])).toBeLessThan(0.9 * Number(statsBefore.alphas[3]));
});

test('the table states why a log does not determine an α, and which motions to add', async ({ page }) => {
  const widget = await openCalibrator(page);
  await widget.evaluate((element) => {
    const sampleCount = 2000;
    const t = Float64Array.from({ length: sampleCount }, (_, i) => i / 20);
    const zeroColumn = new Float64Array(sampleCount);
    const createNoisyXColumn = (/** @type {number} */ noiseAmplitude) => t.map((rowTime, i) => 0.5 * rowTime + noiseAmplitude * Math.sin(i * i));
    Object.assign(element, { log: { odometry: { t, x: createNoisyXColumn(0), y: zeroColumn, theta: zeroColumn }, reference: { t, x: createNoisyXColumn(0.002), y: zeroColumn, theta: zeroColumn } } });
  });
  await waitUntilSettled(widget);
  await expect(alphaRowsOf(widget).nth(0)).toHaveText(/not determined: too little rotation in this log; add ~50 in-place rotations/);
  await expect(alphaRowsOf(widget).nth(2)).not.toHaveText(/not determined/);
});
