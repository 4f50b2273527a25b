import { expect } from '@playwright/test';
import { NEW_PAGE_TAG, REDUCED_MOTION, readBananaResults, readBox, readCentre, openBanana, readPicture, readProperty, readoutValueOf, showPage, readState, test, waitUntilReady } from './support.js';

test.use(REDUCED_MOTION);

const countCalloutsOf = (/** @type {import('@playwright/test').Locator} */ widget) => widget.evaluate((element) => /** @type {any} */ (element).scene.callouts.length);

test('a slider morphs the floor into exponential coordinates and back, and callouts appear on the floor only', async ({ page }) => {
  const widget = await openBanana(page);
  const floorCanvas = widget.locator('canvas.plane');
  const morphSlider = widget.getByRole('slider', { name: 'From the floor' });
  const floorPictures = [await readPicture(floorCanvas)];
  for (const [morphText, panelTitle] of [['0.5', 'On the way'], ['1', 'The floor, morphed'], ['0', 'On the floor']]) {
    await morphSlider.fill(morphText);
    floorPictures.push(await readPicture(floorCanvas));
    expect(/** @type {any} */ (await readState(widget)).morph).toBe(Number(morphText));
    await expect(widget).toHaveAttribute('morph', morphText);
    await expect(widget.locator('.panel-title').first()).toContainText(panelTitle);
    expect(await countCalloutsOf(widget)).toBe(morphText === '0' ? 2 : 0);
  }
  expect(new Set(floorPictures).size).toBe(3);
  expect(floorPictures[3]).toBe(floorPictures[0]);
});

test('every preset ends the morph, even the preset that is selected already', async ({ page }) => {
  const widget = await openBanana(page);
  for (const accessibleName of ['Hard arc', 'Hard arc']) {
    await widget.getByRole('slider', { name: 'From the floor' }).fill('1');
    await widget.getByRole('button', { name: accessibleName }).click();
    await expect(widget).toHaveAttribute('morph', '0');
  }
});

test('the handle at the end of the arc can be dragged during the morph @nightly', async ({ page }) => {
  const widget = await openBanana(page, 'morph="1"');
  const arcEndHandle = widget.locator('.handle');
  await arcEndHandle.press('ArrowUp');
  await arcEndHandle.press('ArrowRight');
  let { command } = (await readBananaResults(widget)).config;
  expect(command.omega * command.dt).toBeCloseTo(0.02, 9);
  expect(command.v * command.dt).toBeCloseTo(2.02, 9);
  await widget.evaluate((element) => void Reflect.set(element, 'morph', 0.4));
  const [x, y] = /** @type {number[]} */ (await readProperty(widget, 'visibleArcEnd'));
  await arcEndHandle.press('ArrowUp');
  const [shownX, shownY] = /** @type {number[]} */ (await readProperty(widget, 'visibleArcEnd'));
  expect(shownX).toBeCloseTo(x, 9);
  expect(shownY).toBeCloseTo(y + 0.02, 9);
  ({ command } = (await readBananaResults(widget)).config);
  expect(command.omega).toBeGreaterThan(0.01);
});

test('Pin keeps numbers and outlines for comparison, and a second press removes them', async ({ page }) => {
  const widget = await openBanana(page);
  const pinButton = widget.getByRole('button', { name: 'Pin' });
  const areaReadout = widget.locator('.readouts div').filter({ hasText: 'area covered' });
  const areaTextBefore = await readoutValueOf(widget, 'area covered').innerText();
  const sliderBox = await readBox(widget.locator('#v'));
  await pinButton.click();
  await expect(pinButton).toHaveText('Unpin');
  expect(await readBox(widget.locator('#v'))).toEqual(sliderBox);
  await widget.getByRole('button', { name: 'Hard arc' }).click();
  await expect(areaReadout).toContainText(`pinned: ${areaTextBefore}`);
  const hiddenCoordinates = await widget.evaluate((element) => {
    const { scene: drawnScene, pictures: floorPictures } = /** @type {any} */ (element);
    const { xMin, xMax, yMin, yMax } = floorPictures[0].pictureView.shownExtent;
    return drawnScene.pinnedPointsAt(0).filter((/** @type {number} */ pointCoordinate, /** @type {number} */ i) => (i % 2 ? pointCoordinate < yMin || pointCoordinate > yMax : pointCoordinate < xMin || pointCoordinate > xMax));
  });
  expect(hiddenCoordinates).toEqual([]);
  const pinnedState = await readState(widget);
  expect(pinnedState.pinned).toMatchObject({ command: { v: 1 }, samples: 50_000 });
  const pictureWithPin = await readPicture(widget.locator('canvas.plane'));
  await pinButton.click();
  await expect(areaReadout).not.toContainText('pinned');
  expect(await readPicture(widget.locator('canvas.plane'))).not.toBe(pictureWithPin);
  await pinButton.click();
  await widget.getByRole('button', { name: 'Start over' }).click();
  await expect(pinButton).toHaveText('Pin to compare');
  const restoreState = (/** @type {object} */ savedState) => widget.evaluate((element, newState) => void (/** @type {any} */ (element).setState(newState)), savedState);
  await restoreState(pinnedState);
  await expect(areaReadout).toContainText(`pinned: ${areaTextBefore}`);
  expect(await readPicture(widget.locator('canvas.plane'))).toBe(pictureWithPin);
  await expect(restoreState({ ...pinnedState, pinned: { ...pinnedState.pinned, samples: 0 } })).rejects.toThrow('state.pinned.samples is 0; allowed is');
  await expect(areaReadout).toContainText(`pinned: ${areaTextBefore}`);
  // The pinned likelihood gain is that of the poses. It must not appear next to the gain of the positions on the floor.
  await widget.getByRole('button', { name: 'Worked example' }).click();
  await expect(widget.locator('.readouts div').filter({ hasText: 'gain in fit on the floor' })).not.toContainText('pinned');
});

test('the title of the floor view states how well the ellipse fits', async ({ page }) => {
  const widget = await openBanana(page);
  const panelTitle = widget.locator('.panel-title').first();
  for (const [changedSettings, expectedTitle, expectedCallouts] of /** @type {const} */ ([
    [{ preset: 'banana' }, 'no ellipse fits', 2],
    [{ preset: 'pivot' }, 'the ellipse fits in size only', 0],
    // In the preset "gentle" the cloud is visibly skewed, and not visibly bent.
    [{ preset: 'gentle' }, 'the ellipse fits in size only', 0],
    [{ preset: 'straight', alphas: [0.002, 0.002, 0.002, 0.002, 0, 0] }, 'the ellipse nearly fits', 0],
    // The straight cloud is symmetric. Its ellipse has the area of the outline in ξ. Only the likelihood gain of the poses shows a bend.
    [{ preset: 'straight', alpha3: 0.2 }, 'the ellipse fits in size only', 0],
    // In 3 s some robots turn by π or more, where no exact statistics exist.
    [{ preset: 'straight', alpha3: 0.2, dt: 3 }, 'the ellipse fits in size only', 0],
  ])) {
    await widget.evaluate((element, figureSettings) => void Object.assign(element, figureSettings), changedSettings);
    await expect(panelTitle).toHaveText(`On the floor: ${expectedTitle}`);
    expect(await countCalloutsOf(widget)).toBe(expectedCallouts);
  }
});

test('callouts are hidden while the cloud is dragged under them @nightly', async ({ page }) => {
  const widget = await openBanana(page);
  const countCallouts = () => countCalloutsOf(widget);
  const { x, y } = await readCentre(widget.locator('.handle'));
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x - 10, y);
  await expect.poll(countCallouts).toBe(0);
  await page.mouse.up();
  await expect.poll(countCallouts).toBeGreaterThan(0);
});

test('a narrow figure has a single picture, which shows both ends of the morph', async ({ page }) => {
  await page.setViewportSize({ width: 375, height: 812 });
  const widget = await openBanana(page);
  await expect(widget.locator('canvas.twist')).toBeHidden();
  const floorCanvas = widget.locator('canvas.plane');
  const floorPicture = await readPicture(floorCanvas);
  await widget.getByRole('slider', { name: 'From the floor' }).fill('1');
  expect(await readPicture(floorCanvas)).not.toBe(floorPicture);
});

test.describe('when the figure first appears', () => {
  test.use({ isIntroductionSkipped: false });

  test('an animation of driving robots runs once per session, until a key or the pointer is pressed', NEW_PAGE_TAG, async ({ page }) => {
    await page.emulateMedia({ reducedMotion: 'no-preference' });
    const countDrivingRobots = () => page.locator('banana-machine').evaluate((element) => /** @type {any} */ (element).cloud.drivingProgress?.robotCount);
    await showPage(page, '<banana-machine></banana-machine>');
    await page.waitForFunction(() => /** @type {any} */ (document.querySelector('banana-machine'))?.cloud?.drivingProgress?.robotCount > 0);
    await page.keyboard.press('Shift');
    expect(await countDrivingRobots()).toBeUndefined();
    await expect.poll(async () => (await readBananaResults(page.locator('banana-machine'))).shown).toBeGreaterThan(10);
    await page.reload();
    await waitUntilReady(page.locator('banana-machine'));
    expect(await countDrivingRobots()).toBeUndefined();
  });

  test('the animation of driving robots does not run if the page has set the state of the figure @nightly', NEW_PAGE_TAG, async ({ page }) => {
    await page.emulateMedia({ reducedMotion: 'no-preference' });
    const widget = await openBanana(page, 'preset="gentle"');
    expect(await widget.evaluate((element) => /** @type {any} */ (element).cloud.drivingProgress)).toBeUndefined();
  });
});
