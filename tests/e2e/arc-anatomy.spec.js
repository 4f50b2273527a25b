import { expect } from '@playwright/test';
import { REDUCED_MOTION, readCentre, waitForFrames, mountFigure, parseNumberIn, readPicture, countPixelsOfRole, playSliderOf, readoutValueOf, test, openDisclosures } from './support.js';

/** @import { Locator, Page } from '@playwright/test' */
/** @import { ArcAnatomy } from '../../www/types.d.ts' */
/** @typedef {HTMLElement & { simulation: ArcAnatomy, getState(): any, toCSV(): string, toSVG(): string }} ArcAnatomyElement */

test.use(REDUCED_MOTION);

/** Opens a page with an Arc Anatomy. @param {Page} page @param {string} [attributes] */
const openArcAnatomy = (page, attributes) => mountFigure(page, 'arc-anatomy', { attributes });

/** Waits for all requested animation frames, and returns the results of the simulation. @param {Locator} widget */
async function readResults(widget) {
  await waitForFrames(widget.page());
  return widget.evaluate((element) => {
    const { config: figureConfig, stats, table: resultTable } = /** @type {ArcAnatomyElement} */ (element).simulation;
    return { config: figureConfig, stats, table: resultTable };
  });
}

const bodyHandleOf = (/** @type {Locator} */ widget) => widget.getByRole('slider', { name: 'Robot, where it is found', exact: true });
const headingHandleOf = (/** @type {Locator} */ widget) => widget.getByRole('slider', { name: 'Heading of the robot, where it is found' });
const canvasOf = (/** @type {Locator} */ widget) => widget.locator('canvas.plane');
const verdictOf = (/** @type {Locator} */ widget) => widget.locator('.verdict');

test('the figure opens with the robot beside the commanded arc, and names the least likely factor', async ({ page }) => {
  const widget = await openArcAnatomy(page);
  const { config: figureConfig, stats } = await readResults(widget);
  expect(figureConfig).toMatchObject({ start: { x: 0, y: 0, theta: 0 }, next: { x: 1.1, y: 0.5, theta: 1.1 }, command: { v: 1, omega: 0.5, dt: 1 } });
  await expect(widget.getByRole('button', { name: 'Left turn' })).toHaveAttribute('aria-pressed', 'true');
  await expect(verdictOf(widget)).toContainText('The last turn γ̂ fits worst: 2.2 standard deviations off');
  await expect(widget.locator('.headline')).toHaveText(new RegExp(`^\\s*The robot’s pose is\\s+${(100 * stats.share).toFixed(1)}\u202f%\\s+as likely as the best pose`));
  const factorRows = widget.locator('.factors li');
  await expect(factorRows).toHaveCount(3);
  await expect(factorRows.nth(2)).toHaveClass(/weakest/);
  for (const [i, { estimate: factorEstimate, deviations: factorDeviations, share: factorShare }] of stats.factors.entries()) {
    expect(parseNumberIn(((await factorRows.nth(i).locator('.estimate').textContent()) ?? '').split('=')[1].split(' ')[1])).toBeCloseTo(factorEstimate, 2);
    expect(parseNumberIn(((await factorRows.nth(i).locator('.off').textContent()) ?? '').split('= ')[1])).toBeCloseTo([-1, -1, 1][i] * factorDeviations, 1);
    await expect(factorRows.nth(i).locator('.keeps')).toHaveText(`factor: ${(100 * factorShare).toFixed(1)}\u202f% of its peak`);
  }
  await openDisclosures(widget);
  expect(parseNumberIn(await readoutValueOf(widget, 'p of the tables').textContent())).toBeCloseTo(stats.prob, 3);
  expect(parseNumberIn(await readoutValueOf(widget, 'density').textContent())).toBeCloseTo(stats.density ?? NaN, 3);
  // The pointer must not be on an entry of the legend, because the entry would highlight its line.
  await page.mouse.move(0, 0);
  for (const colorRole of ['prior', 'prediction', 'accent', 'truth']) expect(await countPixelsOfRole(canvasOf(widget), colorRole), colorRole).toBeGreaterThan(colorRole === 'accent' ? 10 : 20);
});

test('the robot’s handles move and turn the robot, and stay under the pointer', async ({ page }) => {
  const widget = await openArcAnatomy(page);
  const centreBefore = await readCentre(bodyHandleOf(widget));
  await page.mouse.move(centreBefore.x + 4, centreBefore.y + 3);
  await page.mouse.down();
  await page.mouse.move(centreBefore.x - 56, centreBefore.y + 33, { steps: 5 });
  await waitForFrames(page);
  const centreAfter = await readCentre(bodyHandleOf(widget));
  expect(Math.abs(centreAfter.x - centreBefore.x + 60)).toBeLessThan(1);
  expect(Math.abs(centreAfter.y - centreBefore.y - 30)).toBeLessThan(1);
  await page.mouse.up();
  const resultsAfterMove = await readResults(widget);
  expect(resultsAfterMove.config.next.x).toBeLessThan(1.1);
  expect(resultsAfterMove.config.next.y).toBeLessThan(0.5);
  expect(resultsAfterMove.config.next.theta).toBe(1.1);
  await expect(widget.getByRole('button', { name: 'Left turn' })).toHaveAttribute('aria-pressed', 'false');

  const [bodyCentre, headingCentre] = [await readCentre(bodyHandleOf(widget)), await readCentre(headingHandleOf(widget))];
  await page.mouse.move(headingCentre.x, headingCentre.y);
  await page.mouse.down();
  await page.mouse.move(bodyCentre.x + 80, bodyCentre.y, { steps: 5 });
  await page.mouse.up();
  const resultsAfterTurn = await readResults(widget);
  expect(Math.abs(resultsAfterTurn.config.next.theta)).toBeLessThan(1 / 80);
  expect(resultsAfterTurn.stats.driven).toEqual(resultsAfterMove.stats.driven);
  expect(resultsAfterTurn.stats.lastTurn).not.toBe(resultsAfterMove.stats.lastTurn);
  await expect(widget.locator('p[role=status]').last()).toContainText('fits worst');
});

test('the robot moves and turns by keyboard, and stops where the floor ends', async ({ page }) => {
  const widget = await openArcAnatomy(page, 'nextx="3.98"');
  await bodyHandleOf(widget).press('ArrowUp');
  await bodyHandleOf(widget).press('[');
  expect((await readResults(widget)).config.next).toEqual({ x: 3.98, y: 0.55, theta: 1.1 + Math.PI / 36 });
  await bodyHandleOf(widget).press('ArrowRight');
  expect((await readResults(widget)).config.next.x).toBe(4);
  await expect(bodyHandleOf(widget)).toHaveAttribute('aria-valuetext', /The floor ends here$/);
});

test('the handles of the start move the commanded arc, and the robot’s end pose stays', async ({ page }) => {
  const widget = await openArcAnatomy(page);
  const [startHandle, startHeadingHandle] = ['Start', 'Heading at the start'].map((accessibleName) => widget.getByRole('slider', { name: accessibleName, exact: true }));
  const resultsBefore = await readResults(widget);
  await startHandle.press('ArrowRight');
  await startHandle.press('ArrowDown');
  const resultsAfterMove = await readResults(widget);
  expect(resultsAfterMove.config.start).toEqual({ x: 0.05, y: -0.05, theta: 0 });
  expect(resultsAfterMove.config.next).toEqual(resultsBefore.config.next);
  const [endX, endY, endTheta] = resultsBefore.stats.commanded.end;
  for (const [i, expectedCoordinate] of [endX + 0.05, endY - 0.05, endTheta].entries()) expect(resultsAfterMove.stats.commanded.end[i]).toBeCloseTo(expectedCoordinate, 12);
  await expect(widget).toHaveAttribute('startx', '0.05');
  await startHeadingHandle.press('ArrowLeft');
  expect((await readResults(widget)).config.start.theta).toBe(Math.PI / 36);
});

test('if a centre of rotation is outside the picture, its angle is labelled inside the picture @nightly', async ({ page }) => {
  const widget = await openArcAnatomy(page);
  const readSVG = () => widget.evaluate((element) => /** @type {ArcAnatomyElement} */ (element).toSVG());
  await widget.evaluate((element) => void Object.assign(element, { omega: 0.025, nextY: 0.012 }));
  await waitForFrames(page);
  const centreLabels = [...(await readSVG()).matchAll(/<text x="([\d.]+)" y="([\d.]+)"[^>]*>(ω[^<]*)</g)];
  expect(centreLabels.map(([, , , labelText]) => labelText).sort()).toEqual(['ω̂Δt = 0.02', 'ωΔt = 0.03']);
  // The labels of both angles do not overlap. They are 60 px wide and 12 px high.
  const [[, firstX, firstY], [, secondX, secondY]] = centreLabels.map((labelParts) => labelParts.map(Number));
  expect(Math.max(Math.abs(firstX - secondX) / 60, Math.abs(firstY - secondY) / 12)).toBeGreaterThan(1);
});

test('a narrow picture contains the whole wedge of the final turn', async ({ page }) => {
  await page.setViewportSize({ width: 375, height: 812 });
  const widget = await openArcAnatomy(page, 'preset="straight"');
  const [wedgeEndX, plotRightX] = await widget.evaluate((element) => {
    const { pictures: [{ pictureView }], simulation: { config: { next }, stats: { lastTurn } } } = /** @type {any} */ (element);
    return [pictureView.headingLineFrom({ ...next, theta: next.theta - lastTurn }, 64)[1][0], pictureView.plotArea.rightEdge];
  });
  expect(wedgeEndX).toBeLessThan(plotRightX);
});

test('with the formula as printed in the book, p is 0 after a right turn, and the verdict explains why', async ({ page }) => {
  const widget = await openArcAnatomy(page);
  await openDisclosures(widget);
  const printedCheckbox = widget.getByRole('checkbox', { name: 'radius without sign, as printed' });
  await widget.getByRole('button', { name: 'Right turn' }).click();
  const pictureBefore = await readPicture(canvasOf(widget));
  await printedCheckbox.check();
  await expect(verdictOf(widget)).toContainText('the radius has no sign');
  expect(await readPicture(canvasOf(widget))).not.toBe(pictureBefore);
  await widget.getByRole('button', { name: 'Left turn' }).click();
  await printedCheckbox.check();
  await expect(verdictOf(widget)).toContainText('fits worst');
});

test('each line of the table highlights its construction in the picture, and its text contains its value', async ({ page }) => {
  const widget = await openArcAnatomy(page);
  await openDisclosures(widget);
  const lineRadios = widget.locator('.lines input');
  await expect(lineRadios.first()).toBeChecked();
  const { lines } = (await readResults(widget)).table;
  const planePictures = [await readPicture(canvasOf(widget))];
  for (const [i, lineValue] of lines.entries()) {
    await (i === 0 ? lineRadios.nth(1).check() : lineRadios.nth(i).press('ArrowDown'));
    const lineContent = (await widget.locator('.lines li').nth(i + 1).innerText()).trim();
    expect(parseNumberIn(/= ([−\d.]+)(?: \S+)?$/.exec(lineContent)?.[1] ?? '')).toBeCloseTo(lineValue, 2);
    planePictures.push(await readPicture(canvasOf(widget)));
  }
  // The last row of the table highlights the bars of the density's factors.
  await expect(widget.locator('.factors')).toHaveClass(/lit/);
  // The table rows of x* and y* both highlight the centre of the arc, so that their pictures are equal.
  expect(new Set(planePictures.slice(0, 9)).size).toBe(8);
  expect(planePictures[2]).toBe(planePictures[3]);
  expect(planePictures[9]).toBe(planePictures[0]);
});

test('heat maps of p and of the density are drawn below the arcs, with contours of both quantities', async ({ page }) => {
  const widget = await openArcAnatomy(page);
  await openDisclosures(widget);
  const planePictures = [await readPicture(canvasOf(widget))];
  for (const accessibleName of ['p', 'density']) {
    await widget.getByRole('radio', { name: accessibleName, exact: true }).check();
    planePictures.push(await readPicture(canvasOf(widget)));
  }
  expect(new Set(planePictures).size).toBe(3);
  await expect(widget).toHaveAttribute('map', 'density');
  expect(await widget.evaluate((element) => /** @type {ArcAnatomyElement} */ (element).toSVG())).toContain('<image');
});

test('entries of the legend show and hide the lines', async ({ page }) => {
  const widget = await openArcAnatomy(page);
  expect(await countPixelsOfRole(canvasOf(widget), 'posterior')).toBe(0);
  // A toggle in the legend highlights its line while the pointer or the focus is on the toggle.
  const clickToggle = async (/** @type {string} */ accessibleName) => {
    await widget.getByRole('checkbox', { name: accessibleName }).click();
    await page.mouse.move(0, 0);
    await widget.getByRole('checkbox', { name: accessibleName }).blur();
    await waitForFrames(page);
  };
  await clickToggle('constant twist');
  expect(await countPixelsOfRole(canvasOf(widget), 'posterior')).toBeGreaterThan(20);
  for (const [accessibleName, colorRole] of /** @type {const} */ ([['commanded arc', 'prior'], ['the one arc to the robot', 'prediction'], ['last turn', 'accent'], ['constant twist', 'posterior']])) {
    const pixelCountBefore = await countPixelsOfRole(canvasOf(widget), colorRole);
    await clickToggle(accessibleName);
    expect(await countPixelsOfRole(canvasOf(widget), colorRole), accessibleName).toBeLessThan(pixelCountBefore);
  }
  await expect(widget).toHaveAttribute('overlays', 'chord');
});

test('a robot is drawn on each arc at the time that the slider selects @nightly', async ({ page }) => {
  const widget = await openArcAnatomy(page);
  const pictureAtEnd = await readPicture(canvasOf(widget));
  const timeSlider = widget.getByRole('slider', { name: 'time along the arc' });
  await expect(widget.getByRole('button', { name: 'Play' })).toHaveCount(0);
  await timeSlider.fill('40');
  await expect(timeSlider).toHaveAttribute('aria-valuetext', '40 %');
  expect(await readPicture(canvasOf(widget))).not.toBe(pictureAtEnd);
  await timeSlider.fill('100');
  expect(await readPicture(canvasOf(widget))).toBe(pictureAtEnd);
});

test('the factors are exported as CSV', async ({ page }) => {
  const widget = await openArcAnatomy(page);
  const { stats } = await readResults(widget);
  const [settingsLine, headerLine, ...dataLines] = (await widget.evaluate((element) => /** @type {ArcAnatomyElement} */ (element).toCSV())).trim().split('\n');
  expect(JSON.parse(settingsLine.slice(2))).toMatchObject({ element: 'arc-anatomy', next: { x: 1.1, y: 0.5, theta: 1.1 } });
  expect(headerLine).toBe('estimate,residual,standard_deviation,residual_over_deviation,prob,share_of_peak');
  expect(dataLines.map((csvRow) => csvRow.split(',').map(Number))).toEqual(
    stats.factors.map(({ estimate: factorEstimate, residual: factorResidual, deviation: factorDeviation, deviations: factorDeviations, value, share: factorShare }) => [factorEstimate, factorResidual, factorDeviation, factorDeviations, value, factorShare]),
  );
});

test('the plot of exercise 1 shows the errors of three formulas, their crossover and the chapter’s threshold', async ({ page }) => {
  const widget = await openArcAnatomy(page);
  await openDisclosures(widget);
  const errorPlot = widget.locator('.plot');
  await expect(errorPlot.locator('path.curve')).toHaveCount(3);
  await expect(errorPlot.locator('.marked')).toHaveText(['2·10⁻⁸/Δt', '10⁻⁶']);
});

test('without noise the figure says that there is none, and draws no heat map @nightly', async ({ page }) => {
  const widget = await openArcAnatomy(page, 'map="density" alpha5="0" alpha6="0"');
  await expect(verdictOf(widget)).toHaveText('The last turn γ̂ has zero variance but a non-zero residual, so p = 0.');
  await openDisclosures(widget);
  await expect(readoutValueOf(widget, 'density')).toHaveText('none: a variance is 0');
  await expect(widget.locator('.lines li')).toHaveCount(10);
});

test('a resize during playback of a slider does not advance the slider', async ({ page }) => {
  await page.emulateMedia({ reducedMotion: 'no-preference' });
  const widget = await openArcAnatomy(page);
  // Each step of the animation changes the size of the figure, so that the figure draws again before any time has elapsed.
  await widget.evaluate((element) => element.addEventListener('input', () => {
    /** @type {HTMLElement} */ (element).style.width = `${element.clientWidth - 1}px`;
  }));
  const { sliderValues } = await playSliderOf(widget, 'underway', 8);
  expect(new Set(sliderValues).size).toBe(sliderValues.length);
});
