import { expect } from '@playwright/test';
import { ALL_FIGURE_NAMES, FIGURE_FACTS } from './figures.js';
import { REDUCED_MOTION, waitForFrames, mountFigure, readPicture, showPage, readState, takeEvents, test, waitUntilReady } from './support.js';

/** @typedef {import('./support.js').AnyElement} AnyElement */
/** @typedef {import('@playwright/test').Locator} Locator */

test.use(REDUCED_MOTION);

/** Makes the next call of the core crash, and fires an event of a slider that causes this call. @param {Locator} widget @param {string} sliderId */
function trapNextCall(widget, sliderId) {
  return widget.evaluate((element, inputId) => {
    const { simulation, shadowRoot } = /** @type {AnyElement} */ (element);
    Object.assign(window, { trapped: simulation });
    // The simulation's pointer is set to an address outside of the core's memory, so that the next call crashes.
    simulation.__wbg_ptr = 0x7ffffff0;
    shadowRoot?.querySelector(`#${inputId}`)?.dispatchEvent(new Event('input', { bubbles: true, composed: true }));
  }, sliderId);
}

/** Waits until a figure has a new simulation after a crash. @param {Locator} widget */
const expectRestarted = (widget) =>
  expect.poll(() => widget.evaluate((element) => {
    const { simulation } = /** @type {AnyElement} */ (element);
    return simulation !== undefined && simulation !== Reflect.get(window, 'trapped');
  })).toBe(true);

test('after a trap the core restarts with the same state and picture, and other elements are not affected', async ({ page, figureName }) => {
  const otherName = ALL_FIGURE_NAMES[(ALL_FIGURE_NAMES.indexOf(figureName) + 1) % ALL_FIGURE_NAMES.length];
  const { sliderId, sliderValues } = FIGURE_FACTS[figureName];
  await showPage(page, `<${figureName}></${figureName}><div style="position: fixed; top: 0; width: 300px; opacity: 0.5"><${otherName} id="other"></${otherName}></div>`);
  const widget = page.locator(figureName).first();
  const otherWidget = page.locator('#other');
  await waitUntilReady(widget);
  await waitUntilReady(otherWidget);
  await widget.locator(`#${sliderId}`).fill(String(sliderValues[0]));
  await waitForFrames(page);
  const [stateBefore, pictureBefore] = [await readState(widget), await readPicture(widget.locator('canvas.plane'))];
  await otherWidget.evaluate((element) => void Object.assign(window, { otherSimulation: /** @type {AnyElement} */ (element).simulation }));
  await takeEvents(page);
  await trapNextCall(widget, sliderId);
  await expectRestarted(widget);
  const errorEvents = await takeEvents(page, ['error', 'load']);
  expect(errorEvents.map(({ name, target }) => [name, target])).toEqual([['error', figureName]]);
  expect(errorEvents[0].message).toMatch(/memory access out of bounds|unreachable/);
  expect(await readState(widget)).toEqual(stateBefore);
  expect(await readPicture(widget.locator('canvas.plane'))).toBe(pictureBefore);
  expect(await otherWidget.evaluate((element) => /** @type {AnyElement} */ (element).simulation === Reflect.get(window, 'otherSimulation'))).toBe(true);
  await widget.locator(`#${sliderId}`).fill(String(sliderValues[1]));
  await expect(widget).toHaveAttribute(sliderId, String(sliderValues[1]));
  // A figure that has drawn a picture after a crash recovers from a second crash too.
  await waitForFrames(page);
  await trapNextCall(widget, sliderId);
  await expectRestarted(widget);
  expect(await takeEvents(page, ['error', 'load'])).toHaveLength(1);
});

test('if the core traps again before the next picture, the figure stops with an error message @nightly', async ({ page }) => {
  const widget = await mountFigure(page, 'banana-machine');
  await takeEvents(page);
  await widget.evaluate((element) => {
    const widget = /** @type {any} */ (element);
    const { createSimulation } = widget;
    widget.createSimulation = (/** @type {unknown[]} */ ...constructorArguments) => Object.assign(createSimulation.apply(widget, constructorArguments), { __wbg_ptr: 0x7ffffff0 });
  });
  await trapNextCall(widget, 'v');
  await expect(widget.getByRole('alert')).toContainText('This interactive figure cannot run here.');
  expect(await takeEvents(page, ['error'])).toHaveLength(2);
  await waitForFrames(page);
  expect(await takeEvents(page, ['error'])).toEqual([]);
});
