import { expect } from '@playwright/test';
import { FIGURE_FACTS } from './figures.js';
import { REDUCED_MOTION, setProperty, readBox, readCentre, dragSlider, waitForFrames, mountFigure, showPage, readState, takeEvents, test, testEach, openDisclosures, waitUntilReady, waitUntilSettled } from './support.js';

/** @typedef {import('@playwright/test').Locator} Locator */
/** @typedef {import('./figures.js').Name} Name */

test.use(REDUCED_MOTION);

/** @param {{ name: string }[]} recordedEvents */
const eventNamesOf = (recordedEvents) => recordedEvents.map(({ name: eventName }) => eventName);

test('a drag fires an input event at each step and one change event at its end, both composed', async ({ page }) => {
  await showPage(page, '<div id="host"></div>');
  await page.evaluate(() => {
    const shadowRoot = /** @type {Element} */ (document.querySelector('#host')).attachShadow({ mode: 'open' });
    shadowRoot.innerHTML = '<banana-machine></banana-machine>';
    const recordedEvents = /** @type {unknown[]} */ ([]);
    Object.assign(window, { recordedEvents });
    for (const eventName of ['input', 'change', 'load', 'stats']) {
      document.addEventListener(eventName, (recordedEvent) => {
        const [eventOrigin] = recordedEvent.composedPath();
        recordedEvents.push([eventName, /** @type {Element} */ (eventOrigin).localName, Reflect.get(eventOrigin, 'v'), recordedEvent.bubbles, recordedEvent.composed]);
      });
    }
  });
  const widget = page.locator('banana-machine');
  await waitUntilReady(widget);
  const takeRecordedEvents = () => page.evaluate(() => /** @type {unknown[][]} */ (Reflect.get(window, 'recordedEvents')).splice(0));
  const openingEvents = await takeRecordedEvents();
  expect(openingEvents.map(([eventName]) => eventName).sort()).toEqual(['load', 'stats']);
  await dragSlider(widget.locator('#v'), 0.75);
  await waitForFrames(page);
  const recordedEvents = await takeRecordedEvents();
  // All recorded events come from the element itself. None comes from a native control inside the element.
  for (const [, eventOrigin, , bubbles, composed] of [...openingEvents, ...recordedEvents]) expect([eventOrigin, bubbles, composed]).toEqual(['banana-machine', true, true]);
  const gestureEvents = recordedEvents.filter(([eventName]) => eventName !== 'stats');
  expect(gestureEvents.length).toBeGreaterThan(3);
  expect(gestureEvents.map(([eventName]) => eventName)).toEqual([...Array(gestureEvents.length - 1).fill('input'), 'change']);
  const eventSpeeds = gestureEvents.map(([, , v]) => v);
  expect(eventSpeeds.at(-1)).toBe(Number(await widget.locator('#v').inputValue()));
  expect(new Set(eventSpeeds).size).toBeGreaterThan(2);
  expect(recordedEvents.some(([eventName]) => eventName === 'stats')).toBe(true);
});

/** Actions of a user other than dragging. All disclosures are open. @type {Record<Name, [string, (widget: Locator) => Promise<void>][]>} */
const USER_ACTIONS = {
  'banana-machine': [
    ['preset', (widget) => widget.getByRole('button', { name: 'Hard arc' }).click()],
    ['radio', (widget) => widget.getByLabel('triangular').check()],
    ['model', (widget) => widget.getByLabel('odometry').check()],
    ['toggle', (widget) => widget.getByLabel('Isolate one').check()],
    ['overlay', (widget) => widget.getByRole('checkbox', { name: 'linearized' }).check()],
    ['slider by key', (widget) => widget.locator('#omega').press('ArrowRight')],
    ['handle by key', (widget) => widget.locator('.handle').press('ArrowUp')],
    ['marker by key', (widget) => widget.locator('#chart-omega').press('ArrowRight')],
    ['seed', (widget) => widget.getByRole('button', { name: 'New seed' }).click()],
    ['clear', (widget) => widget.getByRole('button', { name: 'Clear' }).click()],
    ['step', (widget) => widget.getByRole('button', { name: 'Step' }).click()],
  ],
  'map-squeeze': [
    ['place', (widget) => widget.getByRole('button', { name: 'Facing a wall' }).click()],
    ['view', (widget) => widget.getByLabel('whole map').check()],
    ['condition', (widget) => widget.getByLabel('Check samples against the map').uncheck()],
    ['robot by key', (widget) => widget.locator('.handle.body').press('ArrowUp')],
    ['map', async (widget) => {
      await widget.getByRole('button', { name: 'Use this plan' }).click();
      await expect(widget.getByRole('button', { name: 'Back to the apartment' })).toBeVisible();
    }],
  ],
  'arc-anatomy': [
    ['preset', (widget) => widget.getByRole('button', { name: 'Right turn' }).click()],
    ['radio', (widget) => widget.getByLabel('triangular').check()],
    ['map', (widget) => widget.locator('input[name=map]').nth(1).check()],
    ['as printed', (widget) => widget.getByRole('checkbox', { name: /as printed/ }).check()],
    ['legend', (widget) => widget.getByRole('checkbox', { name: 'constant twist' }).check()],
    ['line', (widget) => widget.locator('.lines input').last().check()],
    ['slider by key', (widget) => widget.locator('#omega').press('ArrowRight')],
    ['underway by key', (widget) => widget.locator('#underway').press('ArrowLeft')],
    ['value typed', async (widget) => {
      await widget.locator('.slider:has(#alpha1) .typed').fill('0.12');
      await widget.locator('.slider:has(#alpha1) .typed').press('Enter');
    }],
    ['start by key', (widget) => widget.locator('.handle.body.start').press('ArrowUp')],
    ['its heading by key', (widget) => widget.locator('.handle.turn.start').press('ArrowUp')],
    ['robot by key', (widget) => widget.locator('.handle.body.next').press('ArrowUp')],
    ['heading by key', (widget) => widget.locator('.handle.turn.next').press('ArrowUp')],
  ],
  'odometry-decomposer': [
    ['preset', (widget) => widget.locator('.presets button').nth(2).click()],
    ['rule', (widget) => widget.locator('input[name=rule]').nth(1).check()],
    ['radio', (widget) => widget.locator('input[name=noise]').nth(1).check()],
    ['slider by key', (widget) => widget.locator('#phase').press('ArrowLeft')],
    ['drift by key', (widget) => widget.locator('#drift').press('ArrowRight')],
    ['correlation by key', (widget) => widget.locator('#correlation').press('ArrowRight')],
    ['earlier robot by key', (widget) => widget.locator('.handle.body.from').press('ArrowDown')],
    ['later robot by key', (widget) => widget.locator('.handle.body.to').press('ArrowUp')],
    ['heading by key', (widget) => widget.locator('.handle.turn.to').press('ArrowUp')],
    ['seed', (widget) => widget.getByRole('button', { name: 'New seed' }).click()],
    ['clear', (widget) => widget.getByRole('button', { name: 'Clear' }).click()],
    ['step', (widget) => widget.getByRole('button', { name: 'Step', exact: true }).click()],
  ],
  'dead-reckoning': [
    ['preset', (widget) => widget.locator('.presets button').nth(1).click()],
    ['recursion', (widget) => widget.locator('input[name=compounding]').nth(1).check()],
    ['noise of the path', (widget) => widget.locator('input[name=per]').nth(1).check()],
    ['slider by key', (widget) => widget.locator('#headingNoise').press('ArrowRight')],
    ['step by key', (widget) => widget.locator('#step').press('ArrowLeft')],
    ['steps by key', (widget) => widget.locator('#steps').press('ArrowLeft')],
    ['seed', (widget) => widget.getByRole('button', { name: 'New seed' }).click()],
    ['clear', (widget) => widget.getByRole('button', { name: 'Clear' }).click()],
    ['batch', (widget) => widget.getByRole('button', { name: 'Step', exact: true }).click()],
  ],
  'alpha-calibrator': [
    ['model', (widget) => widget.locator('input[name=kind]').nth(1).check()],
    ['noise', (widget) => widget.locator('input[name=noise]').nth(1).check()],
    ['outliers', (widget) => widget.locator('input[name=outliers]').nth(1).check()],
    ['legend', (widget) => widget.getByRole('checkbox', { name: 'odometry' }).uncheck()],
    ['systematic error', (widget) => widget.getByRole('checkbox', { name: /^mount yaw/ }).uncheck()],
    ['slider by key', (widget) => widget.locator('#distance').press('ArrowRight')],
    ['leg by key', (widget) => widget.locator('#leg').press('ArrowRight')],
    ['largest residual', (widget) => widget.getByRole('button', { name: 'Next largest residual' }).click()],
    ['inflation by key', (widget) => widget.locator('#inflation').press('ArrowRight')],
    ['start over', (widget) => widget.getByRole('button', { name: 'Start over' }).click()],
  ],
};

testEach('a frame after an input event calls the core at most six times, and the end of a drag only to zoom views in', async (page, figureName) => {
  const widget = await mountFigure(page, figureName);
  await openDisclosures(widget);
  await waitUntilSettled(widget);
  await widget.evaluate((element) => {
    const callsByFrame = /** @type {string[][]} */ ([[]]);
    Object.assign(element, { callsByFrame });
    const { prototype } = /** @type {import('./support.js').AnyElement} */ (element).simulation.constructor;
    for (const [memberName, { get, value }] of Object.entries(Object.getOwnPropertyDescriptors(prototype))) {
      const recordCallsOf = (/** @type {Function} */ simulationMethod) => /** @this {unknown} */ function (/** @type {any[]} */ ...methodArguments) {
        /** @type {string[]} */ (callsByFrame.at(-1)).push(memberName);
        return simulationMethod.apply(this, methodArguments);
      };
      if (get) Object.defineProperty(prototype, memberName, { get: recordCallsOf(get) });
      else if (!['constructor', '__destroy_into_raw'].includes(memberName)) Object.defineProperty(prototype, memberName, { value: recordCallsOf(value) });
    }
    const startNextFrame = () => {
      callsByFrame.push([]);
      requestAnimationFrame(startNextFrame);
    };
    startNextFrame();
  });
  // Returns the called methods of the simulation, as one list for each animation frame.
  const takeCallsByFrame = async () => {
    await waitUntilSettled(widget);
    return widget.evaluate((element) => /** @type {string[][]} */ (Reflect.get(element, 'callsByFrame')).splice(0, Infinity, []));
  };
  const figureSlider = widget.locator(`#${FIGURE_FACTS[figureName].sliderId}`);
  await figureSlider.scrollIntoViewIfNeeded();
  await takeCallsByFrame();
  const { x, y, width, height } = await readBox(figureSlider);
  const thumbShare = await figureSlider.evaluate((rangeInput) => {
    const { value, min: minValue, max: maxValue } = /** @type {HTMLInputElement} */ (rangeInput);
    return (Number(value) - Number(minValue)) / (Number(maxValue) - Number(minValue));
  });
  await page.mouse.move(x + thumbShare * width, y + height / 2);
  await page.mouse.down();
  await page.mouse.move(x + (thumbShare < 0.5 ? thumbShare + 0.1 : thumbShare - 0.1) * width, y + height / 2, { steps: 3 });
  const callsByFrame = await takeCallsByFrame();
  const callsSinceInput = callsByFrame.slice(callsByFrame.findIndex((frameCalls) => frameCalls.some((calledMember) => calledMember.startsWith('configure'))));
  expect(Math.max(...callsSinceInput.map(({ length }) => length)), `${figureName}: ${JSON.stringify(callsSinceInput)}`).toBeLessThanOrEqual(6);
  expect(callsSinceInput.flat(), figureName).toEqual(expect.arrayContaining([expect.stringMatching(/^configure/), 'read']));
  await page.mouse.up();
  expect((await takeCallsByFrame()).flat().filter((memberName) => !['picture', 'surface'].includes(memberName)), figureName).toEqual([]);
});

testEach('each control of a figure fires one input event and one change event', async (page, figureName) => {
  const widget = await mountFigure(page, figureName);
  await openDisclosures(widget);
  await takeEvents(page);
  for (const [actionName, runAction] of USER_ACTIONS[figureName]) {
    await runAction(widget);
    expect.soft(eventNamesOf(await takeEvents(page, ['input', 'change', 'error'])), actionName).toEqual(['input', 'change']);
  }
});

test('a dragged handle fires an input event at each step, and one change event', async ({ page, handleFigureName }) => {
  const widget = await mountFigure(page, handleFigureName);
  await takeEvents(page);
  const { x, y } = await readCentre(widget.locator('.handle').first());
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 40, y - 20, { steps: 4 });
  expect(eventNamesOf(await takeEvents(page))).toEqual(Array(4).fill('input'));
  await page.mouse.up();
  expect(eventNamesOf(await takeEvents(page))).toEqual(['change']);
  // A handle that is pressed and released without a move fires no event.
  await page.mouse.down();
  await page.mouse.up();
  expect(eventNamesOf(await takeEvents(page))).toEqual([]);
});

test('changes by the page fire only stats events, even if the figure is out of sight', async ({ page, figureName }) => {
  await showPage(page, `<${figureName}></${figureName}><div style="height: 4000px"></div>`);
  const widget = page.locator(figureName);
  await waitUntilReady(widget);
  await takeEvents(page);
  await page.evaluate(() => scrollTo(0, 4000));
  await takeEvents(page, ['stats']);
  const stateBefore = await readState(widget);
  const [settingName, settingValue] = FIGURE_FACTS[figureName].otherSetting;
  for (const newValue of [settingValue, null, settingValue, undefined]) {
    expect(await setProperty(widget, settingName, newValue)).toBe('');
    expect(eventNamesOf(await takeEvents(page, ['load', 'input', 'change', 'error', 'stats'])), String(newValue)).toEqual(['stats']);
  }
  expect(await readState(widget)).toEqual(stateBefore);
  await widget.evaluate((element, [attributeName, newValue]) => element.setAttribute(attributeName, String(newValue)), FIGURE_FACTS[figureName].otherSetting);
  expect(eventNamesOf(await takeEvents(page, ['load', 'input', 'change', 'error', 'stats']))).toEqual(['stats']);
  const changedState = await readState(widget);
  expect(changedState).not.toEqual(stateBefore);
  await widget.evaluate((element, restoredState) => Reflect.get(element, 'setState').call(element, restoredState), stateBefore);
  expect(eventNamesOf(await takeEvents(page, ['load', 'input', 'change', 'error', 'stats']))).toEqual(['stats']);
  expect(await readState(widget)).toEqual(stateBefore);
});

test('the pointer, a redraw and an export fire no input, change or stats event', async ({ page, figureName }) => {
  const widget = await mountFigure(page, figureName);
  await takeEvents(page, ['stats']);
  await widget.locator('canvas.plane').hover({ position: { x: 100, y: 100 } });
  await page.emulateMedia({ colorScheme: 'dark' });
  await widget.evaluate((element) => {
    const figureElement = /** @type {import('./support.js').AnyElement} */ (element);
    figureElement.toSVG();
    figureElement.toCSV();
    figureElement.getState();
  });
  expect(await takeEvents(page, ['input', 'change', 'stats'])).toEqual([]);
});

test('the page receives all keys except arrow keys and spaces that a control has used', async ({ page }) => {
  const selectorsByFigure = {
    'arc-anatomy': ['.handle.body.start', '#omega', 'input[type=radio] >> nth=0'],
    'banana-machine': ['#chart-omega', '.to-present'],
  };
  for (const [figureName, controlSelectors] of Object.entries(selectorsByFigure)) {
    const widget = await mountFigure(page, figureName);
    await openDisclosures(widget);
    await page.evaluate(() => {
      const pressedKeys = /** @type {string[]} */ ([]);
      Object.assign(window, { keys: pressedKeys });
      addEventListener('keydown', ({ key: pressedKey }) => pressedKeys.push(pressedKey));
    });
    for (const controlSelector of controlSelectors) {
      await widget.locator(controlSelector).focus();
      const usedKeys = controlSelector === '.to-present' ? ['Space'] : ['ArrowRight', 'ArrowLeft'];
      for (const pressedKey of [...usedKeys, 's', '/', 'Escape']) await page.keyboard.press(pressedKey);
      const keysReceivedByPage = await page.evaluate(() => /** @type {string[]} */ (Reflect.get(window, 'keys')).splice(0));
      expect(keysReceivedByPage, controlSelector).toEqual(['s', '/', 'Escape']);
    }
  }
});
