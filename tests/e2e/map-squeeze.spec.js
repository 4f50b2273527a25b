import { expect } from '@playwright/test';
import { openSqueeze, readSqueezeResults } from './squeeze-support.js';
import { REDUCED_MOTION, readCentre, waitForFrames, parseNumberIn, readPicture, readoutValueOf, readState, test, openDisclosures } from './support.js';

/** @typedef {import('@playwright/test').Locator} Locator */

test.use(REDUCED_MOTION);

const bodyHandleOf = (/** @type {Locator} */ widget) => widget.getByRole('slider', { name: 'Robot', exact: true });
const headingHandleOf = (/** @type {Locator} */ widget) => widget.getByRole('slider', { name: 'Heading of the robot' });

/** Returns the number of CSS pixels per metre of the map. @param {Locator} widget */
const readPixelsPerMetre = (widget) => widget.evaluate((element) => {
  const { pictureView } = /** @type {any} */ (element).picture;
  return pictureView.toPixelX(1) - pictureView.toPixelX(0);
});

test('the robot moves and turns by keyboard', async ({ page }) => {
  const widget = await openSqueeze(page);
  let { start } = /** @type {any} */ (await readState(widget));
  const fiveDegrees = Math.PI / 36;
  const keyEffects = /** @type {const} */ ([
    [bodyHandleOf, 'ArrowRight', 0.05, 0, 0],
    [bodyHandleOf, 'ArrowUp', 0, 0.05, 0],
    [bodyHandleOf, '[', 0, 0, fiveDegrees],
    [bodyHandleOf, ']', 0, 0, -fiveDegrees],
    [bodyHandleOf, 'Shift+ArrowLeft', -0.25, 0, 0],
    [bodyHandleOf, 'PageDown', 0, -0.5, 0],
    [headingHandleOf, 'ArrowUp', 0, 0, fiveDegrees],
    [headingHandleOf, 'Shift+ArrowRight', 0, 0, -5 * fiveDegrees],
    [headingHandleOf, 'PageDown', 0, 0, -10 * fiveDegrees],
  ]);
  for (const [handleOf, keyName, expectedDx, expectedDy, expectedTurn] of keyEffects) {
    await handleOf(widget).press(keyName);
    const movedStart = /** @type {any} */ (await readState(widget)).start;
    expect(movedStart.x - start.x, keyName).toBeCloseTo(expectedDx, 9);
    expect(movedStart.y - start.y, keyName).toBeCloseTo(expectedDy, 9);
    expect(movedStart.theta - start.theta, keyName).toBeCloseTo(expectedTurn, 9);
    start = movedStart;
  }
  await expect(bodyHandleOf(widget)).toHaveAttribute('aria-valuetext', `x = ${start.x.toFixed(2)} m, y = ${start.y.toFixed(2)} m`);
  await expect(headingHandleOf(widget)).toHaveAttribute('aria-valuetext', `${start.theta.toFixed(2)} rad`);
});

test('the robot stops at the edge of the map, where a label and a spoken text say so', async ({ page }) => {
  const widget = await openSqueeze(page);
  const { x, y } = await readCentre(bodyHandleOf(widget));
  const readEdgeLabel = async () => {
    await waitForFrames(page);
    return bodyHandleOf(widget).evaluate((element) => getComputedStyle(element, '::before').content);
  };
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x - 20, y, { steps: 3 });
  expect(await readEdgeLabel()).toBe('none');
  await page.mouse.move(1, y, { steps: 3 });
  expect(await readEdgeLabel()).toBe('"The floor ends here"');
  await page.mouse.move(x - 20, y, { steps: 3 });
  expect(await readEdgeLabel()).toBe('none');
  await page.mouse.move(1, y, { steps: 3 });
  await page.mouse.up();
  expect(await readEdgeLabel()).toBe('none');
  expect((await readSqueezeResults(widget)).config.start.x).toBe(0);

  // If the robot is moved by keyboard, its position and the obstacle are announced.
  const valueTextAtEdge = /^x = 0\.00 m, y = \d\.\d\d m\. The floor ends here$/;
  await expect(bodyHandleOf(widget)).toHaveAttribute('aria-valuetext', valueTextAtEdge);
  await bodyHandleOf(widget).press('ArrowRight');
  await expect(bodyHandleOf(widget)).toHaveAttribute('aria-valuetext', /^x = 0\.05 m, y = \d\.\d\d m$/);
  expect(await readEdgeLabel()).toBe('none');
  for (let i = 0; i < 2; i++) {
    await bodyHandleOf(widget).press('ArrowLeft');
    await expect(bodyHandleOf(widget)).toHaveAttribute('aria-valuetext', valueTextAtEdge);
    expect(await readEdgeLabel()).toBe('"The floor ends here"');
  }
  expect((await readSqueezeResults(widget)).config.start.x).toBe(0);
});

test('if a key moves the robot into a wall, the figure reports that @nightly', async ({ page }) => {
  const widget = await openSqueeze(page);
  await widget.evaluate((element) => void Reflect.set(element, 'start', { x: 4.2, y: 2.6, theta: 0 }));
  expect((await readSqueezeResults(widget)).startFree).toBe(true);
  for (let i = 0; i < 2; i++) await bodyHandleOf(widget).press('ArrowLeft');
  expect((await readSqueezeResults(widget)).startFree).toBe(false);
  await expect(widget.getByRole('status').filter({ hasText: 'The start pose is in collision' })).toHaveCount(1);
  await expect(widget.locator('.verdict')).toContainText('The start pose is in collision');
  for (let i = 0; i < 2; i++) await bodyHandleOf(widget).press('ArrowRight');
  await expect(widget.locator('.verdict')).not.toContainText('start pose is in collision');
});

test('the sampler is selected by its name, and the readouts show the results of the simulation', async ({ page }) => {
  const widget = await openSqueeze(page);
  const samplersByLabel = { Endpoint: 'endpoint', 'Whole arc': 'whole-arc' };
  await openDisclosures(widget);
  await widget.getByRole('button', { name: 'Facing a wall' }).click();
  for (const [samplerLabel, samplerName] of Object.entries(samplersByLabel)) {
    await widget.getByLabel(samplerLabel, { exact: true }).check();
    const { config: figureConfig, stats } = await readSqueezeResults(widget);
    expect(figureConfig.sampler).toBe(samplerName);
    const readNumber = async (/** @type {string | RegExp} */ name) => parseNumberIn(await readoutValueOf(widget, name).textContent());
    expect(await readNumber(/^\s*drawn/)).toBe(stats.drawn);
    expect(await readNumber('samples drawn per accepted sample')).toBeCloseTo(stats.drawsPerAccepted, 2);
    expect(await readNumber('wall distances computed per accepted sample')).toBeCloseTo(stats.wallTestsPerAccepted, 2);
    const intervalText = stats.throughWallInterval.map((intervalLimit) => (100 * intervalLimit).toFixed(1)).join('\u2060–\u2060');
    const throughWallText = `${stats.throughWall} of them, ${(100 * stats.throughWallRate).toFixed(1)}\u202f%, went through a wall (95\u202f% interval ${intervalText}\u202f%)`;
    await expect(widget.locator('.verdict')).toHaveText(new RegExp(`^${stats.accepted} of 600 motions .* and are accepted; `));
    await expect(widget.locator('.verdict')).toContainText(samplerName === 'whole-arc' ? 'none of them went through a wall.' : throughWallText);
  }
});

test('the headline states the share of samples through walls, and has its own sentences for none', async ({ page }) => {
  const widget = await openSqueeze(page);
  const resultHeadline = widget.locator('.headline');
  await expect(resultHeadline).toHaveText(/^3\d\.\d\u202f% of the accepted motions went through a wall$/);
  const { size: fontSize } = await resultHeadline.evaluate((element) => ({ size: parseFloat(getComputedStyle(element).fontSize) }));
  expect(fontSize).toBeGreaterThanOrEqual(28);
  expect(fontSize).toBeLessThanOrEqual(32);
  const headlineCases = /** @type {[Record<string, unknown>, string][]} */ ([
    [{ sampler: 'whole-arc' }, 'No accepted motion went through a wall'],
    [{ x: 3.9, y: 2.6, theta: 0 }, 'No motion was accepted'],
    [{ sampler: 'endpoint', conditioned: false }, '100.0\u202f% of the accepted motions went through a wall'],
  ]);
  for (const [changedSettings, headlineText] of headlineCases) {
    await widget.evaluate((element, changedValues) => Object.assign(element, changedValues), changedSettings);
    await expect(resultHeadline).toHaveText(headlineText);
  }
});

test('the table of costs lists each sampler, with its time and the share of a processor core', async ({ page }) => {
  const widget = await openSqueeze(page);
  await widget.getByRole('button', { name: 'Facing a wall' }).click();
  await openDisclosures(widget);
  const costTable = widget.locator('.table');
  await costTable.getByRole('button').click();
  await expect(costTable.locator('tbody tr')).toHaveCount(3);
  const cellTextsOfRows = await costTable.locator('tbody tr').evaluateAll((rowElements) =>
    rowElements.map((tableRow) => [...tableRow.querySelectorAll('td')].map((tableCell) => tableCell.textContent ?? '')),
  );
  for (const [, , printedMicroseconds, corePercent] of cellTextsOfRows.map((rowTexts) => rowTexts.map(parseNumberIn))) {
    expect(printedMicroseconds).toBeGreaterThan(0);
    // At 2000 motions per update and 20 updates per second, each microsecond per motion takes 4 % of a processor core. Microseconds and
    // percentage are rounded to two digits.
    expect(Math.abs(corePercent / (4 * printedMicroseconds) - 1)).toBeLessThan(0.11);
  }
});

test('for a robot without any free path, the figure states the number of attempts @nightly', async ({ page }) => {
  const widget = await openSqueeze(page);
  const verdictNote = widget.locator('.verdict.note');
  await expect(verdictNote).toHaveCount(0);
  await openDisclosures(widget);
  await widget.getByRole('button', { name: 'Facing a wall' }).click();
  await widget.getByLabel('Each sub-step').check();
  await widget.getByRole('slider', { name: 'sub-steps' }).fill('32');
  const { stats, config: figureConfig } = await readSqueezeResults(widget);
  expect(stats.gaveUp).toBe(true);
  await expect(verdictNote).toContainText('The robot is wedged');
  const noteText = ((await verdictNote.textContent()) ?? '').replaceAll('\u202f', '');
  // The note is a single sentence. It states only once how many motions went through a wall.
  const throughWallText = stats.throughWall === 0 ? 'none of them' : `${stats.throughWall} of them, ${(100 * stats.throughWallRate).toFixed(1)}%,`;
  const completedText = `completed only ${stats.accepted} of ${figureConfig.samples} motions; ${throughWallText} went through a wall`;
  expect(noteText.trim()).toBe(`The robot is wedged: ${stats.drawn} sub-steps drawn ${completedText}.`);
  expect(((await widget.locator('canvas.plane').getAttribute('aria-label')) ?? '').replaceAll('\u202f', '')).toContain(noteText.trim());

  // The start is dragged into the wall, from which no path is free.
  await widget.getByLabel('Whole arc').check();
  const { x, y } = await readCentre(bodyHandleOf(widget));
  const wallDistancePx = 1.2 * (await readPixelsPerMetre(widget));
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x, y - wallDistancePx, { steps: 4 });
  await page.mouse.up();
  const blockedResults = await readSqueezeResults(widget);
  expect(blockedResults.startFree).toBe(false);
  expect(blockedResults.stats.accepted).toBe(0);
  await expect(verdictNote).toHaveText('No sample was accepted: none of the 600 drawn is collision-free.');
  await expect(widget.locator('p[role=status]')).toContainText('No sample was accepted');
});

test('a sample under the pointer, or with an entered number, shows its verdict', async ({ page }) => {
  const widget = await openSqueeze(page);
  const { verdicts: poseVerdicts, poses } = await readSqueezeResults(widget);
  const throughWallIndex = poseVerdicts.indexOf(5);
  const rejectedIndex = poseVerdicts.findIndex((verdictBits) => (verdictBits & 4) === 0);
  const sampleField = widget.getByRole('spinbutton', { name: 'Sample', exact: true });
  const verdictOutput = widget.locator('.marked output');
  const planeCanvas = widget.locator('canvas.plane');
  await openDisclosures(widget);
  const pictureBefore = await readPicture(planeCanvas);

  const enterSampleNumber = async (/** @type {string | number} */ sampleNumber) => {
    await sampleField.fill(String(sampleNumber));
    await sampleField.press('Enter');
  };

  await enterSampleNumber(throughWallIndex + 1);
  await expect(verdictOutput).toHaveText('accepted through a wall');
  expect(await readPicture(planeCanvas)).not.toBe(pictureBefore);
  await enterSampleNumber(rejectedIndex + 1);
  await expect(verdictOutput).toHaveText('rejected');
  await enterSampleNumber(poseVerdicts.indexOf(7) + 1);
  await expect(verdictOutput).toHaveText('accepted');
  await enterSampleNumber('');
  expect(await readPicture(planeCanvas)).toBe(pictureBefore);

  // The pointer is moved to the rightmost sample, because it has no near neighbour.
  let rightmostIndex = 0;
  for (let i = 0; i < poseVerdicts.length; i++) if (poses[3 * i] > poses[3 * rightmostIndex]) rightmostIndex = i;
  const { x, y } = await readCentre(bodyHandleOf(widget));
  const pixelsPerMetre = await readPixelsPerMetre(widget);
  await page.mouse.move(x + (poses[3 * rightmostIndex] - 2.05) * pixelsPerMetre, y - (poses[3 * rightmostIndex + 1] - 2.6) * pixelsPerMetre);
  await expect(sampleField).toHaveValue(String(rightmostIndex + 1));
});

test('only a marked motion through a wall has a label at that wall @nightly', async ({ page }) => {
  const widget = await openSqueeze(page);
  const { verdicts: poseVerdicts } = await readSqueezeResults(widget);
  const hasWallLabel = (/** @type {number | null} */ attemptIndex) => widget.evaluate((element, markedIndex) => {
    Object.assign(element, { marked: markedIndex });
    return /** @type {any} */ (element).toSVG().includes('through this wall');
  }, attemptIndex);
  expect(await hasWallLabel(null)).toBe(false);
  expect(await hasWallLabel(poseVerdicts.indexOf(5))).toBe(true);
  expect(await hasWallLabel(poseVerdicts.indexOf(7))).toBe(false);
});

test('the edge of a doorway and a wall can be dragged, and Back to the apartment restores the walls', async ({ page }) => {
  const widget = await openSqueeze(page);
  const resultsBefore = await readSqueezeResults(widget);
  const dragHandle = async (/** @type {Locator} */ draggedHandle, /** @type {number} */ dx, /** @type {number} */ dy) => {
    const { x, y } = await readCentre(draggedHandle);
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + dx, y + dy, { steps: 4 });
    await page.mouse.up();
    return readSqueezeResults(widget);
  };
  // The left edge of the doorway ahead is dragged from x = 1.6 m to near the right edge, where it stops at 2.5 m.
  const resultsAfterEdgeDrag = await dragHandle(widget.locator('.handle.to-4'), 300, 40);
  expect(resultsAfterEdgeDrag.walls.slice(16, 20)).toEqual([0, 3.8, expect.closeTo(2.45, 9), 3.8]);
  expect(resultsAfterEdgeDrag.stats.throughWall).toBeGreaterThan(resultsBefore.stats.throughWall);
  expect(resultsAfterEdgeDrag.config).toEqual(resultsBefore.config);
  const resultsAfterWallDrag = await dragHandle(widget.locator('.handle.side-8'), 10, -20);
  const [wallStartX, wallStartY, wallEndX, wallEndY] = resultsAfterWallDrag.walls.slice(32, 36);
  expect([wallStartX, wallEndX]).toEqual([0, 2.8]);
  expect(wallStartY).toBeGreaterThan(5);
  expect(wallEndY).toBe(wallStartY);
  await expect(widget.locator('canvas.plane')).toHaveAttribute('aria-label', /Edited apartment/);
  // The full number of samples is tested after the walls have stopped moving.
  await widget.evaluate((element) => Object.assign(element, { samples: 5000 }));
  const resultsAfterSecondDrag = await dragHandle(widget.locator('.handle.side-8'), 0, -20);
  expect(resultsAfterSecondDrag.walls[33]).toBeGreaterThan(wallStartY + 0.1);
  expect(resultsAfterSecondDrag.shown).toBe(5000);
  await widget.getByRole('button', { name: 'Back to the apartment' }).click();
  expect((await readSqueezeResults(widget)).walls).toEqual(resultsBefore.walls);
});

test('all wall handles share one tab stop, have names, and move walls by arrow keys', async ({ page }) => {
  const widget = await openSqueeze(page);
  const { walls } = await readSqueezeResults(widget);
  await bodyHandleOf(widget).focus();
  await page.keyboard.press('Shift+Tab');
  const readFocusedHandle = () => widget.evaluate(({ shadowRoot }) => shadowRoot?.activeElement?.className.split(' ')[2]);
  expect(await readFocusedHandle()).toBe('to-4');
  await page.keyboard.press('ArrowRight');
  expect((await readSqueezeResults(widget)).walls[18]).toBeCloseTo(walls[18] + 0.05, 9);
  await expect(widget.locator('.handle.to-4')).toHaveAttribute('aria-valuetext', `x = ${(walls[18] + 0.05).toFixed(2)} m, y = ${walls[19].toFixed(2)} m`);
  await page.keyboard.press(']');
  expect(await readFocusedHandle()).toBe('side-4');
  await page.keyboard.press('Shift+ArrowDown');
  const resultsAfterMove = await readSqueezeResults(widget);
  expect(resultsAfterMove.walls[17]).toBeCloseTo(walls[17] - 0.25, 9);
  await page.keyboard.press('Shift+Tab');
  expect(await widget.evaluate(({ shadowRoot }) => shadowRoot?.activeElement?.classList.contains('handle') ?? false)).toBe(false);
});

test('the picture has a description, and a change by the user is announced to screen readers', async ({ page }) => {
  const widget = await openSqueeze(page);
  const { stats } = await readSqueezeResults(widget);
  const planeCanvas = widget.locator('canvas.plane');
  await expect(planeCanvas).toHaveAttribute('aria-label', /The apartment: 12\.0 m × 9\.0 m, 18 walls/);
  await expect(planeCanvas).toHaveAttribute('aria-label', new RegExp(`; ${stats.throughWall} of them, [^;]* went through a wall`));
  await widget.getByLabel('Whole arc').check();
  const statsAfter = (await readSqueezeResults(widget)).stats;
  const statusLine = widget.locator('p[role=status]');
  const expectedAnnouncement = `${statsAfter.accepted} of 600 motions keep clear of walls all the way and are accepted; none of them went through a wall.`;
  await expect(statusLine).toHaveText(expectedAnnouncement);
  await expect(widget.locator('.verdict')).toHaveText(expectedAnnouncement);
  await openDisclosures(widget);
  await widget.getByLabel('Check samples against the map').uncheck();
  const { throughWall } = (await readSqueezeResults(widget)).stats;
  await expect(statusLine).toContainText(`Without the map all 600 motions are accepted; ${throughWall} of them, `);
  // A change by the page is not announced, and clears the announcement of the previous change.
  await widget.evaluate((element) => Object.assign(element, { conditioned: true }));
  await expect(statusLine).toBeEmpty();
  await widget.evaluate((element) => Object.assign(element, { conditioned: false }));
  await expect(statusLine).toBeEmpty();
  await expect(planeCanvas).toHaveAttribute('aria-label', new RegExp(`all 600 motions are accepted; ${throughWall} of them, `));
});

test('both views stay inside the apartment, and the close view has an overview of the whole map', async ({ page }) => {
  const widget = await openSqueeze(page);
  const mapOverview = widget.locator('.overview');
  await expect(mapOverview).toBeVisible();
  const readViewExtent = () => widget.evaluate((element) => /** @type {any} */ (element).picture.pictureView.shownExtent);
  const maxMargin = 0.301;
  for (const name of ['Facing a doorway', 'Facing a wall', 'Open corridor']) {
    await widget.getByRole('button', { name }).click();
    const { xMin, yMin, xMax, yMax } = await readViewExtent();
    expect(Math.min(xMin, yMin)).toBeGreaterThan(-maxMargin);
    expect(xMax).toBeLessThan(12 + maxMargin);
    expect(yMax).toBeLessThan(9 + maxMargin);
  }
  await openDisclosures(widget);
  await expect(widget.getByLabel('close-up')).toBeChecked();
  await widget.getByLabel('whole map').check();
  const wholeMapExtent = await readViewExtent();
  expect(Math.min(13 / (wholeMapExtent.xMax - wholeMapExtent.xMin), 10 / (wholeMapExtent.yMax - wholeMapExtent.yMin))).toBeGreaterThan(0.9);
  await expect(mapOverview).toHaveCount(0);
});

test('each entry of the legend hides the marks that it names', async ({ page }) => {
  const widget = await openSqueeze(page);
  const outcomeLegend = widget.locator('.legend');
  const canvas = widget.locator('canvas.plane');
  for (const name of ['accepted', 'accepted through a wall', 'rejected', 'commanded path']) {
    const pictureBefore = await readPicture(canvas);
    await outcomeLegend.getByLabel(name, { exact: true }).uncheck();
    expect(await readPicture(canvas), name).not.toBe(pictureBefore);
  }
  expect(await widget.getAttribute('overlays')).toBe('unknown');
  await expect(outcomeLegend.getByLabel('unknown cells')).toHaveCount(0);
});

test('many samples are drawn as a density, with a separate colour for samples that went through a wall', async ({ page }) => {
  const widget = await openSqueeze(page);
  const densityNote = widget.locator('.about');
  await expect(densityNote).toHaveCount(0);
  await widget.evaluate((element) => Object.assign(element, { samples: 20_000 }));
  await expect(densityNote).toContainText('Density');
  expect((await readSqueezeResults(widget)).stats.throughWall).toBeGreaterThan(4000);
  // All samples behind the wall at y = 5 went through a wall. Samples between the posts of the doorway hardly ever went through a wall.
  const [greenExcessBehindWall, greenExcessBetweenPosts] = await widget.evaluate((element) => {
    const { picture: { pictureView }, renderRoot } = /** @type {any} */ (element);
    const canvas = renderRoot.querySelector('canvas.plane');
    const pixelRatio = canvas.width / canvas.clientWidth;
    const pixelCopy = Object.assign(document.createElement('canvas'), { width: canvas.width, height: canvas.height });
    const pixelContext = /** @type {CanvasRenderingContext2D} */ (pixelCopy.getContext('2d', { willReadFrequently: true }));
    pixelContext.drawImage(canvas, 0, 0);
    return [[1.75, 5.4], [2.35, 4.2]].map(([x, y]) => {
      const [sampledLeft, sampledTop] = [pixelRatio * pictureView.toPixelX(x) - 8, pixelRatio * pictureView.toPixelY(y) - 8];
      const { data } = pixelContext.getImageData(sampledLeft, sampledTop, 16, 16);
      let greenExcess = 0;
      for (let i = 0; i < data.length; i += 4) greenExcess += data[i + 3] * (data[i + 1] - data[i + 2]);
      return greenExcess;
    });
  });
  // Purple samples went through a wall, and orange samples did not. Only purple has more blue than green.
  expect(greenExcessBehindWall).toBeLessThan(0);
  expect(greenExcessBetweenPosts).toBeGreaterThan(0);
  await widget.evaluate((element) => Object.assign(element, { samples: 600 }));
  await expect(densityNote).toHaveCount(0);
});
