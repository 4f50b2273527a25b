import { expect } from '@playwright/test';
import { expectAccessible } from './axe.js';
import { makeMapFile, openSqueeze, makePgmFile, readSqueezeResults, makeYamlFile } from './squeeze-support.js';
import { REDUCED_MOTION, dropFiles, waitForFrames, readPicture, countPixelsOfRole, test, openDisclosures } from './support.js';

/** @typedef {import('./squeeze-support.js').MapFile} MapFile */
/** @typedef {import('@playwright/test').Locator} Locator */

test.use(REDUCED_MOTION);

/** White image of a corridor of 4 m × 1 m. The right half is transparent, and therefore unknown. */
const CORRIDOR_PNG =
  'iVBORw0KGgoAAAANSUhEUgAAAFAAAAAUCAQAAACw0XJcAAAAKklEQVR4nO3OMQ0AAAgDsPkXDZjYRZoaaGbL0hVBQUFBQUFBQUFBwc/BAwzfUOhgpknpAAAAAElFTkSuQmCC';

const ROOM_PLAN = {
  bounds: [0, 0, 6, 4],
  walls: [[0, 0, 6, 0], [6, 0, 6, 4], [6, 4, 0, 4], [0, 4, 0, 0], [3, 0, 3, 1.5]],
};

/** Room of 60 × 40 cells whose border is occupied. */
const ROOM_COLUMNS = 60;
const ROOM_ROWS = 40;
const isOnBorder = (/** @type {number} */ columnIndex, /** @type {number} */ rowIndex) =>
  columnIndex === 0 || rowIndex === 0 || columnIndex === ROOM_COLUMNS - 1 || rowIndex === ROOM_ROWS - 1;

const YAML_FIELDS = { image: 'room.pgm', resolution: 0.05, origin: '[0.0, 0.0, 0.0]', negate: 0, occupied_thresh: 0.65, free_thresh: 0.1 };

const mapErrorOf = (/** @type {Locator} */ widget) => widget.locator('.own-map [role=alert]');
const currentMapOf = (/** @type {Locator} */ widget) => widget.locator('.own-map .present');

/** Chooses files in the file input. @param {Locator} widget @param {MapFile[]} mapFiles */
async function chooseFiles(widget, mapFiles) {
  await openDisclosures(widget);
  await widget.getByLabel('Choose map files').setInputFiles(mapFiles);
}

test('a JSON floor plan replaces the apartment, and the robot starts at a free place', async ({ page }) => {
  const widget = await openSqueeze(page);
  const pictureBefore = await readPicture(widget.locator('canvas.plane'));
  await widget.getByRole('button', { name: 'Open corridor' }).click();
  await chooseFiles(widget, [makeMapFile('room.json', JSON.stringify(ROOM_PLAN))]);
  await expect(currentMapOf(widget)).toHaveText('room.json: 6.0 m × 4.0 m, 5 walls.');
  const { bounds: mapBounds, walls, startFree, openPlace, config: figureConfig, shown: shownCount } = await readSqueezeResults(widget);
  expect(mapBounds).toEqual(ROOM_PLAN.bounds);
  expect(walls).toEqual(ROOM_PLAN.walls.flat());
  // The start in the corridor, (1.4, 4.4), is outside of the tested room.
  expect(startFree).toBe(true);
  expect(figureConfig.start).toEqual(openPlace);
  expect(shownCount).toBe(figureConfig.samples);
  expect(await readPicture(widget.locator('canvas.plane'))).not.toBe(pictureBefore);
  await expect(widget.locator('canvas.plane')).toHaveAttribute('aria-label', /room\.json/);

  await widget.getByRole('button', { name: 'Back to the apartment' }).click();
  expect((await readSqueezeResults(widget)).bounds).toEqual([0, 0, 12, 9]);
  expect(await readPicture(widget.locator('canvas.plane'))).toBe(pictureBefore);
});

test('a button restores the apartment and its presets', async ({ page }) => {
  const widget = await openSqueeze(page);
  await chooseFiles(widget, [makeMapFile('room.json', JSON.stringify(ROOM_PLAN))]);
  await expect(currentMapOf(widget)).toContainText('room.json');
  // The presets are positions in the apartment, and are not offered in another map.
  for (const name of ['Facing a doorway', 'Facing a wall', 'Open corridor']) {
    await expect(widget.getByRole('button', { name })).toHaveCount(0);
  }
  await widget.getByRole('button', { name: 'Back to the apartment' }).click();
  await widget.getByRole('button', { name: 'Facing a wall' }).click();
  expect((await readSqueezeResults(widget)).bounds).toEqual([0, 0, 12, 9]);
});

test('unknown cells are hatched, and free or blocked as the user chooses', async ({ page }) => {
  const widget = await openSqueeze(page);
  await expect(widget.getByRole('radiogroup', { name: 'Unknown cells' })).toHaveCount(0);
  const imageFile = makeMapFile('map.png', Buffer.from(CORRIDOR_PNG, 'base64'));
  await chooseFiles(widget, [makeYamlFile('map.yaml', { ...YAML_FIELDS, image: 'map.png', mode: 'scale' }), imageFile]);
  await expect(currentMapOf(widget)).toContainText('map.yaml');
  // The robot is in the left half of the corridor, whose cells are known.
  expect((await readSqueezeResults(widget)).config.start.x).toBeLessThan(2);
  await widget.evaluate((element) => Object.assign(element, { theta: 0 }));
  const planeCanvas = widget.locator('canvas.plane');
  const unknownCellsChoice = widget.getByRole('radiogroup', { name: 'Unknown cells' });
  await expect(unknownCellsChoice.getByLabel('free')).toBeChecked();
  const resultsIfUnknownFree = await readSqueezeResults(widget);
  const pictureIfUnknownFree = await readPicture(planeCanvas);
  await unknownCellsChoice.getByLabel('blocked').check();
  const resultsIfUnknownBlocked = await readSqueezeResults(widget);
  expect(resultsIfUnknownBlocked.config.unknown).toBe('blocked');
  expect(resultsIfUnknownBlocked.poses).toEqual(resultsIfUnknownFree.poses);
  expect(resultsIfUnknownBlocked.stats.accepted).toBeLessThan(resultsIfUnknownFree.stats.accepted);
  expect(resultsIfUnknownBlocked.walls.length).toBeGreaterThan(resultsIfUnknownFree.walls.length);
  expect(await readPicture(planeCanvas)).not.toBe(pictureIfUnknownFree);
  await expect(widget.locator('.legend').getByLabel('unknown cells')).toBeChecked();

  // A state contains the map and the setting for unknown cells. `setState` restores the map and this setting.
  const stateJson = await widget.evaluate((element) => JSON.stringify(/** @type {any} */ (element).getState()));
  await widget.getByRole('button', { name: 'Back to the apartment' }).click();
  await expect(unknownCellsChoice).toHaveCount(0);
  await widget.evaluate((element, stateText) => /** @type {any} */ (element).setState(JSON.parse(stateText)), stateJson);
  await expect(unknownCellsChoice.getByLabel('blocked')).toBeChecked();
  expect(await readSqueezeResults(widget)).toEqual(resultsIfUnknownBlocked);
});

test('a floor plan can be typed into a text field', async ({ page }) => {
  const widget = await openSqueeze(page);
  await openDisclosures(widget);
  const planField = widget.getByLabel('Or a floor plan here');
  const usePlanButton = widget.getByRole('button', { name: 'Use this plan' });
  await usePlanButton.click();
  await expect(currentMapOf(widget)).toHaveText('Pasted plan: 6.0 m × 4.0 m, 6 walls.');
  await planField.fill('{"bounds": [0, 0, 3, 3],\n"walls": [[0, 0, 3, 3]}');
  await usePlanButton.click();
  await expect(mapErrorOf(widget)).toHaveText(/^Pasted plan: .+; expected is \{"bounds": .+ in metres\.$/);
  expect((await readSqueezeResults(widget)).bounds).toEqual([0, 0, 6, 4]);
  await planField.fill(JSON.stringify({ bounds: [0, 0, 3, 3], walls: [[0, 0, 3, 3]] }));
  await usePlanButton.click();
  await expect(mapErrorOf(widget)).toBeHidden();
  expect((await readSqueezeResults(widget)).walls).toEqual([0, 0, 3, 3]);
});

test('a YAML file and an image for map_server can be dropped on the figure', async ({ page }) => {
  const widget = await openSqueeze(page);
  await expect(currentMapOf(widget)).toHaveCount(0);
  await dropFiles(widget.locator('.stage'), [makeYamlFile('room.yaml', YAML_FIELDS), makePgmFile('room.pgm', ROOM_COLUMNS, ROOM_ROWS, isOnBorder)]);
  await expect(currentMapOf(widget)).toContainText('room.yaml: 3.0 m × 2.0 m');
  await expect(currentMapOf(widget)).toBeVisible();
  const { bounds: mapBounds, walls, startFree, config: figureConfig, openPlace } = await readSqueezeResults(widget);
  expect(mapBounds.map((planBound) => Number(planBound.toFixed(12)))).toEqual([0, 0, 3, 2]);
  // The floor plan has eight walls: four along the outer outline of the border, and four along the inner one.
  expect(walls).toHaveLength(8 * 4);
  expect(startFree).toBe(true);
  expect(figureConfig.start).toEqual(openPlace);
  expect(await countPixelsOfRole(widget.locator('canvas.plane'), 'truth')).toBeGreaterThan(1000);
});

test('the error message about a refused map is scrolled into view @nightly', async ({ page }) => {
  await page.setViewportSize({ width: 375, height: 812 });
  const widget = await openSqueeze(page);
  const resultsBefore = await readSqueezeResults(widget);
  await widget.locator('.stage').evaluate((pictureFrameElement) => pictureFrameElement.scrollIntoView());
  await dropFiles(widget.locator('.stage'), [makeMapFile('room.txt', 'a room')]);
  const errorAlert = widget.getByRole('alert');
  await expect(errorAlert).toHaveText(/^room\.txt: expected is one \.json floor plan/);
  // Browsers scroll to whole pixels, which can hide half a pixel.
  await expect(errorAlert).toBeInViewport({ ratio: 1 - 0.5 / (await errorAlert.evaluate((element) => element.clientHeight)) });
  expect(await readSqueezeResults(widget)).toEqual(resultsBefore);
  await expect(currentMapOf(widget)).toContainText('The apartment');
});

test('a refused map is reported in a sentence, and the previous map stays', async ({ page }) => {
  const imageFile = makePgmFile('room.pgm', ROOM_COLUMNS, ROOM_ROWS, isOnBorder);
  const roomYaml = makeYamlFile('room.yaml', YAML_FIELDS);
  const widget = await openSqueeze(page);
  const resultsBefore = await readSqueezeResults(widget);
  await chooseFiles(widget, [roomYaml]);
  await expect(mapErrorOf(widget)).toHaveText(/^room\.yaml: image names room\.pgm, which is not there; expected are both files/);
  // The image has a valid header and too few pixels. The page accepts the file, and the core refuses it.
  await chooseFiles(widget, [roomYaml, makeMapFile('room.pgm', 'P5\n60 40\n255\nabc')]);
  await expect(mapErrorOf(widget)).toHaveText(/^room\.pgm.*(2400|60 × 40)/);
  expect(await readSqueezeResults(widget)).toEqual(resultsBefore);
  await expect(currentMapOf(widget)).toContainText('The apartment');
  await expectAccessible(page);
  await chooseFiles(widget, [roomYaml, imageFile]);
  await expect(currentMapOf(widget)).toContainText('room.yaml');
  await expect(mapErrorOf(widget)).toBeHidden();
});

test('a map set by a page is shown, an equal one changes nothing, and an incomplete one is refused', async ({ page }) => {
  const widget = await openSqueeze(page);
  const mapOutcomes = await widget.evaluate(async (element, roomPlan) => {
    const mapSqueeze = /** @type {any} */ (element);
    /** Sets a map, and returns the keys of the map or the error message. @param {any} newMap @returns {Promise<string>} */
    const setMap = (newMap) => new Promise((resolve) => {
      mapSqueeze.addEventListener('stats', () => resolve(Object.keys(mapSqueeze.map).join()), { once: true });
      mapSqueeze.addEventListener('error', (/** @type {ErrorEvent} */ errorEvent) => {
        errorEvent.preventDefault();
        resolve(errorEvent.message);
      }, { once: true });
      mapSqueeze.map = newMap;
    });
    const gridMap = { name: 'grid', columns: 8, rows: 1, resolution: 0.5, origin: [0, 0, 0], occupied: 'gA==' };
    const mapOutcomes = [];
    for (const roomMap of [roomPlan, { bounds: roomPlan.bounds }, gridMap]) mapOutcomes.push(await setMap(roomMap));
    let statsEventCount = 0;
    mapSqueeze.addEventListener('stats', () => statsEventCount++);
    mapSqueeze.map = { ...gridMap };
    for (let i = 0; i < 5; i++) await new Promise(requestAnimationFrame);
    return [...mapOutcomes, statsEventCount];
  }, ROOM_PLAN);
  expect(mapOutcomes).toEqual([
    'name,bounds,walls', expect.stringMatching(/^map\.walls is undefined; /), 'name,columns,rows,resolution,origin,occupied', 0,
  ]);
});

test('a message is shown while a large map is opened, and another map can replace it @nightly', async ({ page }) => {
  test.setTimeout(120_000);
  const widget = await openSqueeze(page);
  const gridSide = 4000;
  const isPillarCell = (/** @type {number} */ c, /** @type {number} */ r) => c === 0 || r === 0 || c === gridSide - 1 || r === gridSide - 1 || (c % 100 === 50 && r % 100 === 50);
  await chooseFiles(widget, [makeYamlFile('hall.yaml', { ...YAML_FIELDS, image: 'hall.pgm' }), makePgmFile('hall.pgm', gridSide, gridSide, isPillarCell)]);
  await expect(currentMapOf(widget)).toContainText('hall.yaml: 200.0 m × 200.0 m', { timeout: 60_000 });
  const { stats, config: figureConfig } = await readSqueezeResults(widget);
  expect(stats.attempts).toBe(figureConfig.samples);
  await chooseFiles(widget, [makeMapFile('room.json', JSON.stringify(ROOM_PLAN))]);
  await expect(currentMapOf(widget)).toContainText('room.json');
  await waitForFrames(page);
  expect(await countPixelsOfRole(widget.locator('canvas.plane'), 'truth')).toBeGreaterThan(100);
});
