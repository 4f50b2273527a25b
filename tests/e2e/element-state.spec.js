import { expect } from '@playwright/test';
import { STATE_SEEDS, createRandomStates } from './random-states.js';
import { REDUCED_MOTION, waitForFrames, mountFigure, showPage, readState, takeEvents, test, testEach, openDisclosures, waitUntilReady } from './support.js';

/** @typedef {import('./support.js').AnyElement} AnyElement */

test.use(REDUCED_MOTION);

testEach('a random state can be set and read back, and a second element in the same state has the same results', async (page, figureName, isNightly) => {
  await showPage(page, `<${figureName} id="one"></${figureName}><div style="position: fixed; inset: 0 0 auto"><${figureName} id="two"></${figureName}></div>`);
  const [firstWidget, secondWidget] = ['#one', '#two'].map((elementSelector) => page.locator(elementSelector));
  await waitUntilReady(firstWidget);
  await waitUntilReady(secondWidget);
  for (const seed of isNightly ? STATE_SEEDS : STATE_SEEDS.slice(0, 2)) {
    const randomState = createRandomStates(seed)[figureName];
    const [firstResults, secondResults] = await page.evaluate(async (newState) => {
      const figureElements = ['one', 'two'].map((elementId) => /** @type {AnyElement} */ (/** @type {unknown} */ (document.getElementById(elementId))));
      figureElements[0].setState(newState);
      figureElements[1].setState(JSON.parse(JSON.stringify(figureElements[0].getState())));
      return figureElements.map((element) => ({ state: element.getState(), stats: element.stats, poses: [...(element.poses ?? [])] }));
    }, /** @type {any} */ (randomState));
    expect(firstResults.state, `seed ${seed}`).toEqual(randomState);
    expect(secondResults).toEqual(firstResults);
  }
  await waitForFrames(page);
  expect(await takeEvents(page, ['error', 'input', 'change'])).toEqual([]);
});

test('a refused state changes nothing, and the error message names the invalid field', async ({ page }) => {
  const refusedStates = /** @type {[string, object, string][]} */ ([
    ['banana-machine', { version: 2, speed: 1 }, 'RangeError: state.version is 2; allowed is 1'],
    ['banana-machine', { speed: 1 }, 'TypeError: state.speed is an unknown key; allowed are'],
    ['banana-machine', { overlays: ['stars'] }, 'RangeError: state.overlays[0] is "stars"; allowed is'],
    ['banana-machine', { shown: 10, marked: 10 }, 'RangeError: state.marked is 10; allowed is a whole number from 0 to 9'],
    ['banana-machine', { samples: 'x', marked: 3 }, 'TypeError: samples is "x"; allowed is a number'],
    ['map-squeeze', { view: '🤖'.repeat(1000) }, `RangeError: state.view is "${'🤖'.repeat(40)}…"; allowed is "close" or "whole"`],
    ['map-squeeze', { map: { columns: 2, rows: 2, resolution: 1, origin: [0, 0, 0], occupied: '?' } }, 'RangeError: map.occupied is "?"; allowed is base64 of 1 bytes'],
    ['dead-reckoning', { steps: 1, step: 2 }, 'RangeError: step is 2; allowed is'],
  ]);
  for (const figureName of new Set(refusedStates.map(([widgetTag]) => widgetTag))) {
    const widget = await mountFigure(page, figureName);
    const stateBefore = await readState(widget);
    for (const [, refusedFields, expectedMessage] of refusedStates.filter(([widgetTag]) => widgetTag === figureName)) {
      const [thrownMessage, stateAfter] = await widget.evaluate((element, statePart) => {
        const widget = /** @type {AnyElement} */ (element);
        try {
          widget.setState({ widget: element.localName, version: 1, ...statePart });
          return ['nothing', widget.getState()];
        } catch (error) {
          return [String(error), widget.getState()];
        }
      }, refusedFields);
      expect(thrownMessage).toContain(expectedMessage);
      expect(stateAfter).toEqual(stateBefore);
    }
  }
});

test('a partial state changes only its own fields, and both models keep their α’s', async ({ page }) => {
  const widget = await mountFigure(page, 'banana-machine');
  await openDisclosures(widget);
  await widget.locator('#alpha1').fill('0.15');
  await widget.getByLabel('odometry').check();
  // The element `.pair` has the two sliders that are always visible: those of α₂ and α₃ in the odometry model.
  await widget.locator('.pair #alpha2').fill('0.07');
  const stateBefore = /** @type {any} */ (await readState(widget));
  expect(stateBefore.alphas.velocity[0]).toBe(0.15);
  expect(stateBefore.alphas.odometry[1]).toBe(0.07);
  await widget.evaluate((element) => /** @type {AnyElement} */ (element).setState({ widget: 'banana-machine', version: 1, model: 'velocity', samples: 500 }));
  expect(await readState(widget)).toEqual({ ...stateBefore, model: 'velocity', samples: 500, shown: 500 });
  expect(await widget.evaluate((element) => /** @type {AnyElement} */ (element).alphas[0])).toBe(0.15);
});

test('a property that is set right after a state takes effect, even if applying the state takes long @nightly', async ({ page }) => {
  const widget = await mountFigure(page, 'banana-machine');
  await widget.evaluate((element) => {
    const bananaMachine = /** @type {any} */ (element);
    bananaMachine.setState({ widget: 'banana-machine', version: 1, samples: 3e6, shown: 3e6, playing: false, morph: 0 });
    bananaMachine.morph = 0.5;
  });
  await waitForFrames(page);
  await expect.poll(() => readState(widget)).toMatchObject({ samples: 3e6, morph: 0.5 });
});

test('a state that is set during playback of a slider replaces the playback @nightly', async ({ page }) => {
  await page.emulateMedia({ reducedMotion: 'no-preference' });
  const widget = await mountFigure(page, 'odometry-decomposer');
  await widget.evaluate((element) => element.addEventListener('input', () => {
    /** @type {AnyElement} */ (element).setState({ widget: element.localName, version: 1, phase: 1 });
  }, { once: true }));
  await widget.locator('.playable.phase').getByRole('button').click();
  await expect.poll(async () => /** @type {any} */ (await readState(widget)).phase).toBe(1);
  await expect(widget.locator('.playable.phase').getByRole('button')).toHaveText('Play the motion');
  await waitForFrames(page);
  expect(/** @type {any} */ (await readState(widget)).phase).toBe(1);
});

test('a partial state keeps the fraction of shown samples, and the marked sample if it is shown @nightly', async ({ page }) => {
  const widget = await mountFigure(page, 'banana-machine', { attributes: 'samples="300"' });
  const statesAfter = await widget.evaluate((element) => {
    const figureElement = /** @type {AnyElement} */ (element);
    const partialStates = [{ shown: 100, marked: 50 }, { seed: 5 }, { shown: 50 }, { samples: 30 }, { samples: 300 }, { shown: 100, playing: true }];
    return partialStates.map((partialState) => {
      figureElement.setState({ widget: element.localName, version: 1, ...partialState });
      const { shown: shownCount, playing, marked } = /** @type {any} */ (figureElement.getState());
      return [shownCount, playing, marked];
    });
  });
  expect(statesAfter).toEqual([[100, false, 50], [100, false, 50], [50, false, null], [30, false, null], [300, false, null], [300, false, null]]);
});
