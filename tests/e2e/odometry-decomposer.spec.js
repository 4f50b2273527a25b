import { expect } from '@playwright/test';
import { REDUCED_MOTION, waitForFrames, mountFigure, readPicture, playSliderOf, readoutValueOf, test, openDisclosures } from './support.js';

/** @import { Locator, Page } from '@playwright/test' */
/** @typedef {HTMLElement & { simulation: import('../../www/types.d.ts').OdometryDecomposer }} DecomposerElement */

test.use(REDUCED_MOTION);

/** Opens a page with an Odometry Decomposer. @param {Page} page @param {string} [attributes] */
const openDecomposer = (page, attributes) => mountFigure(page, 'odometry-decomposer', { attributes });

/** Waits for all requested animation frames, and returns the results of the simulation. @param {Locator} widget */
async function readResults(widget) {
  await waitForFrames(widget.page());
  return widget.evaluate((element) => {
    const { config: figureConfig, stats, shown: shownCount, poses, robot, drifted } = /** @type {DecomposerElement} */ (element).simulation;
    return { config: figureConfig, stats, shown: shownCount, poses: [...poses], robot, drifted: [...drifted.poses] };
  });
}

const sliderOf = (/** @type {Locator} */ widget, /** @type {string} */ sliderName) => widget.getByRole('slider', { name: sliderName, exact: true });

test('the views contain the arcs of the turns and nearly all sampled poses', async ({ page }) => {
  await page.setViewportSize({ width: 656, height: 900 });
  const widget = await openDecomposer(page);
  await waitForFrames(page);
  const viewMeasures = await widget.evaluate((element) => {
    const { pictures: figurePictures, scene: drawnScene } = /** @type {any} */ (element);
    const outsidePoseCounts = figurePictures.map((/** @type {any} */ { pictureView: { shownExtent: extent } }) => Array.from({ length: drawnScene.poses.length / 3 }, (_, i) => drawnScene.poses.subarray(3 * i, 3 * i + 2))
      .filter(([x, y]) => x < extent.xMin || x > extent.xMax || y < extent.yMin || y > extent.yMax).length);
    // `pixelsBelow` is the space below the end of the drive. A half turn at that end is drawn as a ring with a radius of about 64 pixels.
    const { pictureView } = figurePictures[0];
    return { outsideCounts: outsidePoseCounts, pixelsBelow: pictureView.plotArea.bottomEdge - pictureView.toPixelY(drawnScene.linkage[7]) };
  });
  expect(Math.max(...viewMeasures.outsideCounts)).toBeLessThanOrEqual(1);
  expect(viewMeasures.pixelsBelow).toBeGreaterThan(64);
});

test('the scale of the legs depends only on the size of the window @nightly', async ({ page }) => {
  const windowSize = { width: 375, height: 740 };
  await page.setViewportSize(windowSize);
  const widget = await openDecomposer(page);
  const readLegScale = async () => {
    await waitForFrames(page);
    return widget.evaluate((element) => /** @type {any} */ (element).pictures[0].pictureView.scaleX);
  };
  const scaleBefore = await readLegScale();
  for (const newSize of [{ width: 375, height: 1700 }, { width: 740, height: 375 }, windowSize]) {
    await page.setViewportSize(newSize);
    await readLegScale();
  }
  await expect.poll(readLegScale).toBeCloseTo(scaleBefore, 6);
});

test('the figure opens with the preset Reverse, and presets set the odometry readings', async ({ page }) => {
  const widget = await openDecomposer(page);
  const { config: figureConfig, shown: shownCount } = await readResults(widget);
  expect(shownCount).toBe(figureConfig.samples);
  await expect(widget).toHaveJSProperty('preset', 'reverse');
  await expect(widget.locator('[part=caption]')).toContainText('two rotations beyond π/2');
  // The heading deviations are 0.743 rad by Table 5.6 and 0.182 rad by Nav2.
  await expect(readoutValueOf(widget, 'Table 5.6 expects')).toHaveText('4.1 ×');
  await widget.getByRole('button', { name: 'Turn, drive, turn' }).click();
  const resultsAfter = await readResults(widget);
  expect(resultsAfter.config).toEqual({ ...figureConfig, to: { x: 1.2, y: 1, theta: 1.2 } });
  await expect(widget).toHaveJSProperty('preset', 'all');
  await expect(widget).toHaveAttribute('preset', 'all');
  await expect(readoutValueOf(widget, 'Table 5.6 expects')).toHaveText('1.0 ×');
});

test('the picture names the deviations of two noise models, which are drawn to the same scale', async ({ page }) => {
  const widget = await openDecomposer(page);
  const readPictureFacts = async () => {
    await waitForFrames(page);
    return widget.evaluate((element) => {
      const { pictures: [{ pictureView }], toSVG } = /** @type {any} */ (element);
      const deviationTexts = toSVG.call(element).match(/(?<=>)by [^<]*/g);
      return { scale: pictureView.scaleX, names: deviationTexts.toSorted() };
    });
  };
  const factsBefore = await readPictureFacts();
  expect(factsBefore.names).toEqual(['by AMCL of Nav2', 'by Table 5.6']);
  await widget.getByRole('radio', { name: 'AMCL of Nav2' }).check();
  expect(await readPictureFacts()).toEqual(factsBefore);
  // On a forward drive Table 5.6 and Nav2 have the same noise.
  await widget.getByRole('button', { name: 'Turn, drive, turn' }).click();
  expect((await readPictureFacts()).names).toEqual(['by Table 5.6']);
});

test('the later pose has one handle that moves it and one that turns it', async ({ page }) => {
  const widget = await openDecomposer(page);
  const resultsBefore = await readResults(widget);
  const pictureBefore = await readPicture(widget.locator('canvas.plane'));
  await sliderOf(widget, 'Odometry after').press('ArrowRight');
  const resultsAfterMove = await readResults(widget);
  expect(resultsAfterMove.config.to).toEqual({ ...resultsBefore.config.to, x: expect.closeTo(resultsBefore.config.to.x + 0.05, 12) });
  expect(resultsAfterMove.config.from).toEqual(resultsBefore.config.from);
  expect(await readPicture(widget.locator('canvas.plane'))).not.toBe(pictureBefore);
  await expect(widget).toHaveJSProperty('preset', null);
  await sliderOf(widget, 'Heading after').press('ArrowLeft');
  const resultsAfterTurn = await readResults(widget);
  expect(resultsAfterTurn.config.to.theta - resultsAfterMove.config.to.theta).toBeCloseTo(Math.PI / 36, 12);
});

test('a noise rule is selected in the table, which shows the deviations of each rule', async ({ page }) => {
  const widget = await openDecomposer(page, 'preset="reverse"');
  const rowOf = (/** @type {string} */ name) => widget.locator('tbody tr').filter({ has: page.getByText(name, { exact: true }) });
  await expect(rowOf('Table 5.6').locator('td')).toHaveText(['0.517', '0.602', '0.534', '0.000', '0.626', '0.743']);
  await expect(rowOf('AMCL of Nav2').locator('td')).toHaveText(['0.131', '0.130', '0.126', '0.000', '0.161', '0.182']);
  await expect(rowOf('AMCL, omnidirectional').locator('td')).toHaveText(['0.000', '0.124', '0.125', '0.124', '0.124', '0.125']);
  // Cells of the table are marked if they differ from the table printed in the book.
  await expect(rowOf('Table 5.6').locator('strong')).toHaveCount(0);
  await expect(rowOf('AMCL of Nav2').locator('strong')).toHaveText(['0.131', '0.130', '0.126', '0.161', '0.182']);
  const resultsBefore = await readResults(widget);
  await widget.getByRole('radio', { name: 'AMCL of Nav2' }).check();
  const resultsAfter = await readResults(widget);
  expect(resultsAfter.config).toEqual({ ...resultsBefore.config, rule: 'nav2' });
  expect(resultsAfter.stats.exactCrossTrack).toBeLessThan(resultsBefore.stats.exactCrossTrack / 3);
  await expect(widget.locator('p[role=status]')).toContainText('The first rotation has the long lever');
});

test('on paper every noise rule has its name, and the selected rule is highlighted @nightly', async ({ page }) => {
  const widget = await openDecomposer(page);
  const ruleLabelOf = (/** @type {string} */ rule) => widget.locator('.rules th').getByText(rule, { exact: true });
  await page.emulateMedia({ media: 'print' });
  for (const rule of ['Table 5.6', 'AMCL of Nav2', 'Beluga 2', 'AMCL, omnidirectional']) await expect(ruleLabelOf(rule)).toBeVisible();
  await expect(ruleLabelOf('Table 5.6')).toHaveCSS('font-weight', '700');
  await expect(ruleLabelOf('Beluga 2')).not.toHaveCSS('font-weight', '700');
  // A group of radio buttons other than the noise rules is printed with its selected button only.
  await page.emulateMedia({ media: 'screen' });
  await openDisclosures(widget);
  await page.emulateMedia({ media: 'print' });
  await expect(widget.getByText('normal', { exact: true })).toBeVisible();
  await expect(widget.getByText('triangular', { exact: true })).toBeHidden();
});

test('drift of the odometry frame does not move the sampled poses', async ({ page }) => {
  const widget = await openDecomposer(page);
  const resultsBefore = await readResults(widget);
  const legPictureBefore = await readPicture(widget.locator('canvas.plane'));
  const worldPictureBefore = await readPicture(widget.locator('canvas.world'));
  await sliderOf(widget, 'drift time').press('End');
  const resultsAfter = await readResults(widget);
  expect(resultsAfter.config.drift).toBe(120);
  expect(resultsAfter.drifted).not.toEqual(resultsBefore.drifted);
  expect(resultsAfter.poses).toEqual(resultsBefore.poses);
  expect(await readPicture(widget.locator('canvas.plane'))).toBe(legPictureBefore);
  expect(await readPicture(widget.locator('canvas.world'))).not.toBe(worldPictureBefore);
});

test('the plot of the deviation against the drive compares the sampled poses with the exact curve', async ({ page }) => {
  const widget = await openDecomposer(page, 'preset="all"');
  await openDisclosures(widget);
  const deviationPlot = widget.locator('svg.plot');
  await expect(deviationPlot).toHaveAttribute('aria-label', /across the path, exact: 0\.305 m$/);
  await expect(deviationPlot.locator('circle')).toHaveCount(1);
  await expect(widget.locator('.readouts').last()).toContainText('exactly 0.305 m');
  await widget.getByRole('button', { name: 'Clear' }).click();
  await expect(deviationPlot.locator('circle')).toHaveCount(0);
});

test('a slider moves along the path, and Play runs it to its end and again from its beginning', async ({ page }) => {
  const widget = await openDecomposer(page, 'phase="2.8"');
  // Users who prefer reduced motion get no play button.
  await expect(widget.locator('.playable button')).toHaveCount(0);
  await sliderOf(widget, 'progress of the motion').press('Home');
  const { robot, config: figureConfig } = await readResults(widget);
  expect(robot).toEqual(figureConfig.from);
  await page.emulateMedia({ reducedMotion: 'no-preference' });
  const secondWidget = await openDecomposer(page, 'phase="2.8"');
  const playButton = secondWidget.locator('.playable.phase button');
  const { sliderValues: valuesToEnd, buttonLabel } = await playSliderOf(secondWidget, 'phase');
  expect(buttonLabel).toBe('Pause');
  expect(valuesToEnd[0]).toBeGreaterThan(2.8);
  expect(valuesToEnd.at(-1)).toBe(3);
  await expect(playButton).toHaveText('Play the motion');
  const { sliderValues: valuesFromStart } = await playSliderOf(secondWidget, 'phase', 3);
  expect(valuesFromStart[0]).toBe(0);
  expect(valuesFromStart[2]).toBeGreaterThan(valuesFromStart[1]);
  await expect(playButton).toHaveText('Play the motion');
  const { config: { phase } } = await readResults(secondWidget);
  expect(phase).toBe(valuesFromStart[2]);
  await waitForFrames(page);
  expect((await readResults(secondWidget)).config.phase).toBe(phase);
});
