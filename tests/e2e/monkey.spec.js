// Monkey test: random clicks, drags, keys, numbers, files, attributes, sizes and languages. No event may cause an error message, a crash of
// the core or a broken figure. A second figure in the same state must show the same results.
//
// MONKEY_EVENTS is the number of events, and MONKEY_SEED is the seed. The message of a failure contains number and seed, for a replay.

import { expect } from '@playwright/test';
import { createRandomGenerator } from '../random.js';
import { makeMapFile, makePgmFile, makeYamlFile } from './squeeze-support.js';
import { NEW_PAGE_TAG, waitForFrames, test, waitUntilReady } from './support.js';
import { ALL_FIGURE_NAMES } from './figures.js';

/**
 * @typedef {import('@playwright/test').Page} Page
 * @typedef {import('./support.js').AnyElement} AnyElement
 * @typedef {{ integerBelow: (end: number) => number, itemOf: <T>(list: readonly T[]) => T }} Random random numbers, and random elements of lists
 * @typedef {(page: Page, random: Random) => Promise<string>} Action random action, which returns a description of itself
 */

const EVENT_COUNT = Number(process.env.MONKEY_EVENTS ?? 600);
const FIRST_SEED = Number(process.env.MONKEY_SEED ?? 1);

/** Number of events between two checks of the page. */
const EVENTS_PER_CHECK = 250;

/** Parts of a widget that are clicked and dragged. */
const PART_SELECTOR = 'button, summary, input, .handle, canvas, textarea, label';

const TYPED_NUMBERS = ['0', '1', '0.5', '-3', '\u22120.25', '1,5', '1e-300', '1e9', '12345678901', '100', '7', 'NaN', 'Infinity', '', ' ', 'abc', '2 m', '0x10', '1e'];
const PRESSABLE_KEYS = ['Tab', 'Shift+Tab', 'Enter', ' ', 'Escape', 'ArrowLeft', 'ArrowRight', 'ArrowUp', 'ArrowDown', 'PageUp', 'PageDown', 'Home', 'End', 'c', 'C', '5', 'Backspace', 'Delete'];
const ATTRIBUTE_TEXTS = ['', 'null', 'true', 'false', 'toString', '__proto__', '\u0000', 'velocity', 'odometry', 'normal', 'triangular', 'close', 'whole', 'endpoint', 'whole-arc', 'sub-stepped', 'free', 'occupied', 'unknown', 'command ellipse', 'Banana', 'Hard arc', 'doorway', ...TYPED_NUMBERS];
const LANGUAGE_CODES = ['en', 'de', 'de-AT', 'fr', '', 'constructor', 'x'];
const WINDOW_SIZES = [[1280, 720], [375, 667], [320, 480], [800, 400], [1920, 1080], [600, 900]];

const HALL_IMAGE = makePgmFile('hall.pgm', 30, 20, (column, row) => column % 29 === 0 || row % 19 === 0);
/** Groups of files that users may drop. The first group is a valid map. */
const DROPPABLE_FILE_GROUPS = [
  [makeYamlFile('hall.yaml', { image: 'hall.pgm', resolution: 0.1, origin: '[0, 0, 0]', negate: 0, occupied_thresh: 0.65, free_thresh: 0.2 }), HALL_IMAGE],
  [makeMapFile('plan.json', JSON.stringify({ bounds: [0, 0, 5, 4], walls: [[0, 0, 5, 0], [5, 0, 5, 4], [5, 4, 0, 4], [0, 4, 0, 0]] }))],
  [HALL_IMAGE],
  [makeMapFile('hall.yaml', 'image: &a [*a]')],
  [makeMapFile('cut.pgm', HALL_IMAGE.buffer.subarray(0, 200))],
  [makeMapFile('plan.json', '{"walls": 7}')],
  [makeMapFile('notes.txt', 'no map')],
];

/** Returns a generator of random integers and of random list elements. @param {number} seed @returns {Random} */
function createRandom(seed) {
  const drawUniform = createRandomGenerator(seed);
  const drawIntegerBelow = (/** @type {number} */ exclusiveEnd) => Math.floor(exclusiveEnd * drawUniform());
  return { integerBelow: drawIntegerBelow, itemOf: (itemList) => itemList[drawIntegerBelow(itemList.length)] };
}

/** Scrolls a random part of a widget into view, and returns a random point in it. @param {Page} page @param {Random} randomSource @param {string} partSelector */
async function findReachablePart(page, randomSource, partSelector) {
  const [figureName, choiceNumber, x, y] = [randomSource.itemOf(ALL_FIGURE_NAMES), randomSource.integerBelow(1e6), randomSource.integerBelow(99) + 1, randomSource.integerBelow(99) + 1];
  const partBox = await page.evaluate(
    ([figureName, partSelector, choiceNumber]) => {
      const visibleParts = [...(document.querySelector(`${figureName}`)?.shadowRoot?.querySelectorAll(`${partSelector}`) ?? [])].filter((pointedPart) => pointedPart.checkVisibility());
      const pointedPart = visibleParts[Number(choiceNumber) % visibleParts.length];
      if (!pointedPart) return;
      pointedPart.scrollIntoView({ block: 'nearest', behavior: 'instant' });
      const { left: leftEdge, top: topEdge, width, height } = pointedPart.getBoundingClientRect();
      return { left: leftEdge, top: topEdge, width, height, description: `${pointedPart.localName} ${pointedPart.id || pointedPart.className} ${pointedPart.textContent?.trim().slice(0, 20)}` };
    },
    [figureName, partSelector, choiceNumber],
  );
  return partBox && { x: partBox.left + (partBox.width * x) / 100, y: partBox.top + (partBox.height * y) / 100, description: `${figureName} ${partBox.description}` };
}

/** @type {Record<string, Action>} */
const RANDOM_ACTIONS = {
  async clickPart(page, randomSource) {
    const pointedPart = await findReachablePart(page, randomSource, PART_SELECTOR);
    if (pointedPart) await page.mouse.click(pointedPart.x, pointedPart.y, { clickCount: randomSource.itemOf([1, 1, 1, 2]) });
    return `${pointedPart?.description}`;
  },
  async tapPart(page, randomSource) {
    const pointedPart = await findReachablePart(page, randomSource, PART_SELECTOR);
    if (pointedPart) await page.touchscreen.tap(pointedPart.x, pointedPart.y);
    return `${pointedPart?.description}`;
  },
  async dragPart(page, randomSource) {
    const pointedPart = await findReachablePart(page, randomSource, 'input[type=range], .handle, canvas');
    if (!pointedPart) return 'nothing';
    const dragOffset = [randomSource.integerBelow(400) - 200, randomSource.integerBelow(200) - 100];
    await page.mouse.move(pointedPart.x, pointedPart.y);
    await page.mouse.down();
    await page.mouse.move(pointedPart.x + dragOffset[0], pointedPart.y + dragOffset[1], { steps: 4 });
    // One drag in four is not released, so that other random actions happen during the drag.
    if (randomSource.integerBelow(4) > 0) await page.mouse.up();
    return `${pointedPart.description} by ${dragOffset}`;
  },
  async pressKeys(page, randomSource) {
    const pressedKeys = Array.from({ length: 1 + randomSource.integerBelow(4) }, () => randomSource.itemOf(PRESSABLE_KEYS));
    for (const pressedKey of pressedKeys) await page.keyboard.press(pressedKey);
    return pressedKeys.join(' ');
  },
  async typeText(page, randomSource) {
    const pointedPart = await findReachablePart(page, randomSource, 'input:not([type=range], [type=checkbox], [type=radio]), textarea');
    const [typedText, endKey] = [randomSource.itemOf(TYPED_NUMBERS), randomSource.itemOf(['Enter', 'Tab', 'Escape'])];
    if (pointedPart) {
      await page.mouse.click(pointedPart.x, pointedPart.y, { clickCount: 3 });
      await page.keyboard.insertText(typedText);
      await page.keyboard.press(endKey);
    }
    return `${pointedPart?.description}: ${JSON.stringify(typedText)} ${endKey}`;
  },
  async turnWheel(page, randomSource) {
    const scrollDelta = randomSource.integerBelow(2000) - 1000;
    await page.mouse.wheel(0, scrollDelta);
    return `${scrollDelta}`;
  },
  async setAttribute(page, randomSource) {
    const [figureName, choiceNumber, attributeText] = [randomSource.itemOf(ALL_FIGURE_NAMES), randomSource.integerBelow(1e6), randomSource.integerBelow(4) === 0 ? null : randomSource.itemOf(ATTRIBUTE_TEXTS)];
    return page.evaluate(([figureName, choiceNumber, attributeText]) => {
      const attributeNames = [.../** @type {any} */ (customElements.get(`${figureName}`)).observedAttributes, 'lang', 'dir', 'id', 'hidden'];
      const attributeName = attributeNames[Number(choiceNumber) % attributeNames.length];
      const figureElement = document.querySelector(`${figureName}`);
      if (attributeText === null) figureElement?.removeAttribute(attributeName);
      else figureElement?.setAttribute(attributeName, `${attributeText}`);
      return `${figureName} ${attributeName}=${attributeText}`;
    }, [figureName, choiceNumber, attributeText]);
  },
  async resizeWindow(page, randomSource) {
    const [width, height] = randomSource.itemOf(WINDOW_SIZES);
    await page.setViewportSize({ width, height });
    return `${width} × ${height}`;
  },
  async emulateMedia(page, randomSource) {
    const mediaFeatures = { colorScheme: randomSource.itemOf(/** @type {const} */ (['light', 'dark'])), reducedMotion: randomSource.itemOf(/** @type {const} */ (['reduce', 'no-preference'])), media: randomSource.itemOf(/** @type {const} */ (['screen', 'screen', 'print'])) };
    await page.emulateMedia(mediaFeatures);
    return JSON.stringify(mediaFeatures);
  },
  async changeLanguage(page, randomSource) {
    const newLanguage = randomSource.itemOf(LANGUAGE_CODES);
    await page.evaluate((language) => (document.documentElement.lang = language), newLanguage);
    return newLanguage;
  },
  async openFragment(page, randomSource) {
    const [name, choiceNumber] = [randomSource.itemOf(ALL_FIGURE_NAMES), randomSource.integerBelow(4)];
    return page.evaluate(async ([name, choiceNumber]) => {
      const shareLink = await /** @type {AnyElement} */ (document.querySelector(`${name}`)).shareLink();
      const { hash } = new URL(shareLink);
      location.hash = [hash, hash.slice(0, -9), `#${name}.1=`, '#top'][Number(choiceNumber)];
      return location.hash.slice(0, 60);
    }, [name, choiceNumber]);
  },
  async dropFiles(page, randomSource) {
    const droppedFiles = randomSource.itemOf(DROPPABLE_FILE_GROUPS);
    await page.evaluate(async (transferFiles) => {
      const mapSection = document.querySelector('map-squeeze')?.shadowRoot?.querySelector('section');
      const dataTransfer = new DataTransfer();
      for (const { name, bytes } of transferFiles) dataTransfer.items.add(new File([new Uint8Array(bytes)], name));
      for (const eventType of ['dragover', 'drop']) mapSection?.dispatchEvent(new DragEvent(eventType, { dataTransfer, bubbles: true, composed: true, cancelable: true }));
    }, droppedFiles.map(({ name, buffer: fileBuffer }) => ({ name, bytes: [...fileBuffer] })));
    return droppedFiles.map(({ name }) => name).join(' ');
  },
  async setState(page, randomSource) {
    const [name, choiceNumber, fieldIndex, newValue] = [randomSource.itemOf(ALL_FIGURE_NAMES), randomSource.integerBelow(3), randomSource.integerBelow(1e6), randomSource.itemOf([0, 1, -1, 0.5, 1e9, null, 'x', [], {}, true])];
    return page.evaluate(([name, choiceNumber, fieldIndex, newValue]) => {
      const element = /** @type {any} */ (document.querySelector(`${name}`));
      const keptStates = /** @type {any} */ (window).keptStates;
      const figureState = element.getState();
      if (figureState) keptStates.push(figureState);
      const { widget, version, ...fields } = figureState ?? {};
      const fieldNames = Object.keys(fields);
      const fieldName = fieldNames[Number(fieldIndex) % fieldNames.length];
      const nextState = choiceNumber === 0 ? { widget, version, [fieldName]: newValue } : keptStates[Number(fieldIndex) % keptStates.length];
      try {
        element.setState(nextState);
      } catch (error) {
        if (!(error instanceof TypeError || error instanceof RangeError)) throw error;
      }
      return `${name} ${choiceNumber === 0 ? `${fieldName}: ${JSON.stringify(newValue)}` : 'a former state'}`;
    }, [name, choiceNumber, fieldIndex, newValue]);
  },
  /** Sets a small number of samples, because handling an event takes long with millions of samples. */
  async reduceSamples(page, randomSource) {
    const [figureName, sampleCount] = [randomSource.itemOf(ALL_FIGURE_NAMES), randomSource.itemOf([1, 20, 300, 2000])];
    return page.evaluate(([figureName, sampleCount]) => {
      Object.assign(/** @type {Element} */ (document.querySelector(`${figureName}`)), { samples: sampleCount });
      return `${figureName} ${sampleCount}`;
    }, [figureName, sampleCount]);
  },
  async moveFigure(page, randomSource) {
    const [name, choiceNumber] = [randomSource.itemOf(ALL_FIGURE_NAMES), randomSource.integerBelow(3)];
    return page.evaluate(async ([name, choiceNumber]) => {
      const element = document.querySelector(`${name}`);
      const moveMarker = document.createComment('');
      element?.after(moveMarker);
      const movedElement = /** @type {Element} */ (element);
      movedElement.remove();
      if (choiceNumber === 1) await new Promise(requestAnimationFrame);
      moveMarker.replaceWith(choiceNumber === 2 ? Object.assign(document.createElement(`${name}`), { id: movedElement.id }) : movedElement);
      return `${name} ${['moved', 'taken away for a while', 'another one in its place'][Number(choiceNumber)]}`;
    }, [name, choiceNumber]);
  },
};

/** Relative frequencies of the random actions. @type {Record<string, number>} */
const ACTION_FREQUENCIES = {
  clickPart: 12, tapPart: 3, dragPart: 12, pressKeys: 8, typeText: 6, turnWheel: 3, setAttribute: 6, resizeWindow: 1, emulateMedia: 1, changeLanguage: 1, openFragment: 1, dropFiles: 1, setState: 2,
  reduceSamples: 4, moveFigure: 1,
};
const WEIGHTED_ACTION_NAMES = Object.entries(ACTION_FREQUENCIES).flatMap(([actionName, frequency]) => Array(frequency).fill(actionName));

/**
 * Returns faults of a widget. Faults are a wrong picture, wrong texts, and results that differ from those of a second widget in the same
 * state.
 *
 * @param {Page} page
 * @param {string} name
 */
function readFaults(page, name) {
  return page.evaluate(async (name) => {
    const element = /** @type {any} */ (document.querySelector(name));
    const waitUntilShown = async (/** @type {any} */ element) => {
      element.scrollIntoView({ block: 'start', behavior: 'instant' });
      await element.settled;
      await element.updateComplete;
    };
    element.hidden = false;
    await waitUntilShown(element);
    const failureElement = element.shadowRoot.querySelector('.failure');
    if (failureElement || !element.simulation) return [`it shows ${failureElement?.textContent ?? 'nothing'}`];
    const faultMessages = [...element.shadowRoot.querySelectorAll('dd, td, output, .value, .note, .caption')]
      .map((textElement) => textElement.value ?? textElement.textContent)
      .filter((visibleText) => /NaN|Infinity|undefined|\[object/.test(visibleText))
      .map((text) => `it says ${text}`);

    const resultTextOf = async (/** @type {any} */ figureElement) => {
      const resultBytes = new Uint8Array(await new Blob([figureElement.poses, figureElement.simulation.verdicts ?? figureElement.simulation.executed]).arrayBuffer());
      const resultHash = [...new Uint8Array(await crypto.subtle.digest('SHA-256', resultBytes))].join();
      return JSON.stringify([figureElement.getState(), figureElement.stats, resultHash], (_, resultValue) => (Number.isFinite(resultValue) || typeof resultValue !== 'number' ? resultValue : String(resultValue)));
    };
    // A growing cloud is paused before its results are read, because it would have more samples a moment later.
    element.setState({ ...element.getState(), ...('playing' in element.getState() && { playing: false }) });
    await element.settled;
    const resultText = await resultTextOf(element);
    const state = element.getState();
    const secondElement = /** @type {any} */ (document.createElement(name));
    secondElement.setState(JSON.parse(JSON.stringify(state)));
    element.after(secondElement);
    await waitUntilShown(secondElement);
    const secondResultText = await resultTextOf(secondElement);
    secondElement.remove();
    if (secondResultText !== resultText) faultMessages.push(`a second figure with its state differs: ${resultText.slice(0, 2000)} became ${secondResultText.slice(0, 2000)}`);
    return faultMessages;
  }, name);
}

test.use({ hasTouch: true });

test('random actions cause no fault in any figure @nightly', NEW_PAGE_TAG, async ({ page }) => {
  test.setTimeout(60_000 + EVENT_COUNT * 400);
  page.on('dialog', (dialog) => dialog.dismiss());
  await page.addInitScript(() => {
    Object.assign(window, { keptStates: [], unexpectedErrors: [] });
    // Full screen is refused, as in many iframes. The test resizes the window, which is impossible in full screen.
    Element.prototype.requestFullscreen = () => Promise.reject(new TypeError('Fullscreen is not permitted'));
    // A refused value fires an `error` event, which is expected. Other errors are not expected.
    addEventListener('error', (errorEvent) => {
      const { error } = errorEvent;
      errorEvent.preventDefault();
      const isExpectedError = errorEvent.target instanceof Element && (error instanceof TypeError || error instanceof RangeError) && /allowed|state/.test(error.message);
      if (!isExpectedError) Reflect.get(window, 'unexpectedErrors').push(`${error?.stack ?? errorEvent.message}`);
    }, true);
  });
  await page.goto('/');
  for (const name of ALL_FIGURE_NAMES) {
    await page.locator(name).first().scrollIntoViewIfNeeded();
    await waitUntilReady(page.locator(name).first());
  }

  const randomSource = createRandom(FIRST_SEED);
  /** @type {string[]} */
  const eventLog = [];
  const describeReplay = () => `MONKEY_SEED=${FIRST_SEED} MONKEY_EVENTS=${EVENT_COUNT}, after ${eventLog.length} events; the last:\n${eventLog.slice(-12).join('\n')}\n`;
  while (eventLog.length < EVENT_COUNT) {
    const name = randomSource.itemOf(WEIGHTED_ACTION_NAMES);
    eventLog.push(`${name} …`);
    await test.step(name, async () => eventLog.push(`${name} ${await RANDOM_ACTIONS[name](page, randomSource)}`), { box: true }).catch((error) => {
      throw new Error(describeReplay(), { cause: error });
    });
    eventLog.splice(-2, 1);
    if (eventLog.length % EVENTS_PER_CHECK > 0 && eventLog.length < EVENT_COUNT) continue;
    await page.mouse.up();
    await page.keyboard.press('Escape');
    await page.emulateMedia({ media: 'screen' });
    await waitForFrames(page);
    for (const widget of ALL_FIGURE_NAMES) expect(await readFaults(page, widget), `${widget}: ${describeReplay()}`).toEqual([]);
    expect(await page.evaluate(() => Reflect.get(window, 'unexpectedErrors').splice(0)), describeReplay()).toEqual([]);
  }
});
