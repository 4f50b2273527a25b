import { expect } from '@playwright/test';
import { REDUCED_MOTION, readBananaResults, readCentre, dragSlider, waitForFrames, openBanana, openBananaWithDisclosures, readPicture, readoutValueOf, test, waitUntilSettled } from './support.js';

test.use(REDUCED_MOTION);

/** Attribute for a bent cloud, in which every α has an effect. */
const GENTLE_PRESET = 'preset="gentle"';

/** Returns the fraction of the robots that are inside the view of exponential coordinates. @param {import('@playwright/test').Locator} widget @returns {Promise<number>} */
const visibleTwistShareOf = (widget) => widget.evaluate((element) => {
  const { simulation: { twists }, pictures: figurePictures } = /** @type {any} */ (element);
  const { xMin, xMax, yMin, yMax } = figurePictures[1].pictureView.shownExtent;
  const isInView = (/** @type {number} */ twistCoordinate, /** @type {number} */ i) =>
    i % 3 === 0 && twistCoordinate >= xMin && twistCoordinate <= xMax && twists[i + 2] >= yMin && twists[i + 2] <= yMax;
  return twists.filter(isInView).length / (twists.length / 3);
});

test('the view keeps its scale while its handle is dragged, and zooms out at the end of the drag', async ({ page }) => {
  const widget = await openBanana(page, 'preset="banana"');
  const arcEndHandle = widget.getByRole('slider', { name: 'End of the commanded arc' });
  const readViewExtent = () => widget.evaluate((element) => ({ .../** @type {any} */ (element).pictures[0].pictureView.shownExtent }));
  const handleBefore = await readCentre(arcEndHandle);
  const extentBefore = await readViewExtent();
  await page.mouse.move(handleBefore.x, handleBefore.y);
  await page.mouse.down();
  for (const [dx, dy] of [[-40, 60], [-90, 120]]) {
    await page.mouse.move(handleBefore.x + dx, handleBefore.y + dy, { steps: 8 });
    await waitForFrames(page);
    const { x, y } = await readCentre(arcEndHandle);
    expect(Math.hypot(x - handleBefore.x - dx, y - handleBefore.y - dy)).toBeLessThan(2);
    expect(await readViewExtent()).toEqual(extentBefore);
    expect(await visibleTwistShareOf(widget)).toBeGreaterThan(0.95);
  }
  await page.mouse.up();
  await expect.poll(readViewExtent).not.toEqual(extentBefore);
  await waitForFrames(page);
  const extentAfter = await readViewExtent();
  expect(extentAfter.xMin).toBeLessThanOrEqual(extentBefore.xMin);
  expect(extentAfter.yMin).toBeLessThanOrEqual(extentBefore.yMin);
  expect(extentAfter.xMax).toBeGreaterThanOrEqual(extentBefore.xMax);
  expect(extentAfter.yMax).toBeGreaterThanOrEqual(extentBefore.yMax);
  // If the cloud becomes smaller, the view does not zoom in. A preset fits the view again.
  await dragSlider(widget.locator('#dt'), 0.05);
  await waitForFrames(page);
  expect(await readViewExtent()).toEqual(extentAfter);
  await widget.getByRole('button', { name: 'Banana' }).click();
  await expect.poll(readViewExtent).toEqual(extentBefore);
});

test('the view of exponential coordinates shows most robots, even if turns near 2π produce coordinates of kilometres', async ({ page }) => {
  const widget = await openBanana(page, 'v="1.35" omega="2"');
  expect(await visibleTwistShareOf(widget)).toBeGreaterThan(0.94);
});

test('the keys Home and End set v to the ends of its range, and no key of the handle scrolls the page', async ({ page }) => {
  const widget = await openBanana(page, 'style="margin-bottom: 3000px"');
  const arcEndHandle = widget.locator('.handle');
  await arcEndHandle.focus();
  await page.evaluate(() => scrollTo(0, 100));
  for (const [keyName, expectedSpeed] of /** @type {const} */ ([['End', 1.5], ['Home', -1.5], ['PageDown', undefined], ['ArrowDown', undefined]])) {
    await page.keyboard.press(keyName);
    const { command } = (await readBananaResults(widget)).config;
    if (expectedSpeed) expect(command.v).toBeCloseTo(expectedSpeed, 1);
  }
  expect(await page.evaluate(() => scrollY)).toBe(100);
});

test('where the range of a slider ends, the handle shows and speaks that the sliders end', async ({ page }) => {
  const widget = await openBanana(page);
  const arcEndHandle = widget.getByRole('slider', { name: 'End of the commanded arc' });
  const readHandleHint = () => arcEndHandle.evaluate((element) => getComputedStyle(element, '::before').content);
  await widget.evaluate((element) => void Object.assign(element, { v: 1.49, omega: 0 }));
  await arcEndHandle.press('ArrowLeft');
  await expect(arcEndHandle).toHaveAttribute('aria-valuetext', /m\/s, ω = −?0\.00 rad\/s$/);
  expect(await readHandleHint()).toBe('none');
  for (let i = 0; i < 3; i++) await arcEndHandle.press('ArrowRight');
  await expect(arcEndHandle).toHaveAttribute('aria-valuetext', /^v = 1\.50 m\/s, .* rad\/s\. The sliders end here$/);
  expect(await readHandleHint()).toBe('"The sliders end here"');
  await arcEndHandle.blur();
  expect(await readHandleHint()).toBe('none');
});

test('clicks and keys in the skew chart set ω', async ({ page }) => {
  const widget = await openBananaWithDisclosures(page, GENTLE_PRESET);
  const omegaMarker = widget.getByRole('slider', { name: 'Commanded ω on the chart' });
  await omegaMarker.focus();
  await omegaMarker.press('ArrowRight');
  expect((await readBananaResults(widget)).config.command.omega).toBeCloseTo(0.51, 12);
  const skewChart = widget.locator('svg.plot');
  await skewChart.scrollIntoViewIfNeeded();
  const { x, y } = await readCentre(skewChart);
  await page.mouse.click(x + 80, y);
  const { config: figureConfig, table: resultTable } = await readBananaResults(widget);
  expect(figureConfig.command.omega).toBeGreaterThan(0.51);
  await expect(omegaMarker).toHaveAttribute('aria-valuetext', new RegExp(`skew −${Math.abs(resultTable.exact.crossTrackSkew).toFixed(3)}`));
});

test('a change of an α moves the same robots, and updates the figure once per frame', async ({ page }) => {
  // Clouds are computed in blocks of samples. The first block has all 10,000 samples, so that no later block changes the statistics.
  const widget = await openBananaWithDisclosures(page, `${GENTLE_PRESET} samples="10000"`);
  const resultsBefore = await readBananaResults(widget);
  const pictureBefore = await readPicture(widget.locator('canvas.plane'));
  const skewTextBefore = await readoutValueOf(widget, 'cross-track skew').textContent();
  await dragSlider(widget.getByRole('slider', { name: 'α4' }), 0.85);
  await waitUntilSettled(widget);
  const resultsAfter = await readBananaResults(widget);
  const changedAlpha = resultsAfter.config.alphas[3];
  expect(changedAlpha).toBeGreaterThan(0.16);
  expect(resultsAfter.config).toEqual({ ...resultsBefore.config, alphas: resultsBefore.config.alphas.with(3, changedAlpha) });
  expect(resultsAfter.shown).toBe(resultsBefore.shown);
  expect(await readPicture(widget.locator('canvas.plane'))).not.toBe(pictureBefore);
  expect(await readoutValueOf(widget, 'cross-track skew').textContent()).not.toBe(skewTextBefore);
  const statsChangeCount = await widget.evaluate(async (element) => {
    let statsEventCount = 0;
    element.addEventListener('stats', () => statsEventCount++);
    const alpha1Slider = /** @type {HTMLInputElement} */ (element.shadowRoot?.querySelector('#alpha1'));
    for (const alphaText of ['0.06', '0.07', '0.08', '0.09']) {
      alpha1Slider.value = alphaText;
      alpha1Slider.dispatchEvent(new Event('input', { bubbles: true, composed: true }));
    }
    await /** @type {{ settled: Promise<void> }} */ (/** @type {unknown} */ (element)).settled;
    return statsEventCount;
  });
  expect(statsChangeCount).toBe(1);
  expect((await readBananaResults(widget)).config.alphas[0]).toBe(0.09);
});

test('Isolate sets all α’s except one to 0, marks them as off, and can be switched off', async ({ page }) => {
  const widget = await openBananaWithDisclosures(page, GENTLE_PRESET);
  const resultsBefore = await readBananaResults(widget);
  await widget.getByLabel('Isolate one').check();
  expect((await readBananaResults(widget)).config).toEqual({ ...resultsBefore.config, isolate: 4 });
  await expect(widget.locator('.slider .value', { hasText: ' off' })).toHaveCount(5);
  await widget.getByRole('radio', { name: 'Only α₁' }).check();
  expect((await readBananaResults(widget)).config.isolate).toBe(1);
  await widget.getByRole('slider', { name: 'α3' }).fill('0.06');
  const { config: figureConfig } = await readBananaResults(widget);
  expect(figureConfig).toMatchObject({ isolate: 3, alphas: resultsBefore.config.alphas.with(2, 0.06) });
  await widget.getByLabel('Isolate one').uncheck();
  expect((await readBananaResults(widget)).config.isolate).toBeNull();
  await expect(widget.locator('.slider .value', { hasText: ' off' })).toHaveCount(0);
});

test('sliders keep their position when a note appears or disappears', async ({ page }) => {
  await page.setViewportSize({ width: 375, height: 812 });
  const widget = await openBananaWithDisclosures(page, GENTLE_PRESET);
  const omegaSlider = widget.locator('#omega');
  const chapterNote = widget.locator('.note');
  const readSliderTop = async () => {
    await waitForFrames(page);
    return omegaSlider.evaluate((element) => element.getBoundingClientRect().top + scrollY);
  };
  const topBefore = await readSliderTop();
  await widget.getByLabel('Isolate one').check();
  await expect(chapterNote).toContainText('they lie on a line');
  expect(Math.abs((await readSliderTop()) - topBefore)).toBeLessThan(0.5);
  await omegaSlider.fill('0');
  await expect(chapterNote).toContainText('no noise at all');
  expect(Math.abs((await readSliderTop()) - topBefore)).toBeLessThan(0.5);
});

test('a slider keeps its position when a text above it becomes shorter', async ({ page }) => {
  await page.setViewportSize({ width: 700, height: 900 });
  const widget = await openBananaWithDisclosures(page);
  const readReadoutsHeight = () => widget.locator('.readouts').first().evaluate((element) => element.getBoundingClientRect().height);
  await waitForFrames(page);
  const heightBefore = await readReadoutsHeight();
  await widget.locator('#v').fill('0');
  await expect(widget.locator('.readouts').first()).toContainText('—');
  await waitForFrames(page);
  expect(await readReadoutsHeight()).toBe(heightBefore);
  await page.setViewportSize({ width: 740, height: 900 });
  await expect.poll(readReadoutsHeight).toBeLessThan(heightBefore);
});
