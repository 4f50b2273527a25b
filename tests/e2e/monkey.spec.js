// Monkey test: random clicks, drags, keys, numbers, files, attributes, sizes and languages. No event may cause an error message, a crash of
// the core or a broken figure. A second figure that gets the state of the first has to show the same results.
//
// MONKEY_EVENTS is the number of events, MONKEY_SEED the seed. The message of a failure contains both, for a replay.

import { expect } from '@playwright/test';
import { randomGenerator } from '../random.js';
import { makeMapFile, makePgmFile, makeYamlFile } from './squeeze-support.js';
import { NEW_PAGE_TAG, waitForFrames, test, untilReady } from './support.js';
import { ALL_NAMES } from './figures.js';

/**
 * @typedef {import('@playwright/test').Page} Page
 * @typedef {import('./support.js').AnyElement} AnyElement
 * @typedef {{ below: (end: number) => number, one: <T>(of: readonly T[]) => T }} Random random numbers, and random elements of lists
 * @typedef {(page: Page, random: Random) => Promise<string>} Action random action, which returns a description of itself
 */

const EVENT_COUNT = Number(process.env.MONKEY_EVENTS ?? 600);
const SEED = Number(process.env.MONKEY_SEED ?? 1);

/** Number of events between two checks of the page. */
const EVENTS_PER_CHECK = 250;

/** Parts of a widget that are clicked and dragged. */
const PART_SELECTOR = 'button, summary, input, .handle, canvas, textarea, label';

const TYPED_NUMBERS = ['0', '1', '0.5', '-3', '\u22120.25', '1,5', '1e-300', '1e9', '12345678901', '100', '7', 'NaN', 'Infinity', '', ' ', 'abc', '2 m', '0x10', '1e'];
const PRESSABLE_KEYS = ['Tab', 'Shift+Tab', 'Enter', ' ', 'Escape', 'ArrowLeft', 'ArrowRight', 'ArrowUp', 'ArrowDown', 'PageUp', 'PageDown', 'Home', 'End', 'c', 'C', '5', 'Backspace', 'Delete'];
const ATTRIBUTE_TEXTS = ['', 'null', 'true', 'false', 'toString', '__proto__', '\u0000', 'velocity', 'odometry', 'normal', 'triangular', 'close', 'whole', 'endpoint', 'whole-arc', 'sub-stepped', 'free', 'occupied', 'unknown', 'command ellipse', 'Banana', 'Hard arc', 'doorway', ...TYPED_NUMBERS];
const LANGUAGES = ['en', 'de', 'de-AT', 'fr', '', 'constructor', 'x'];
const WINDOW_SIZES = [[1280, 720], [375, 667], [320, 480], [800, 400], [1920, 1080], [600, 900]];

const HALL_IMAGE = makePgmFile('hall.pgm', 30, 20, (column, row) => column % 29 === 0 || row % 19 === 0);
/** Files that users may drop, the first of them a map. */
const DROPPED_FILES = [
  [makeYamlFile('hall.yaml', { image: 'hall.pgm', resolution: 0.1, origin: '[0, 0, 0]', negate: 0, occupied_thresh: 0.65, free_thresh: 0.2 }), HALL_IMAGE],
  [makeMapFile('plan.json', JSON.stringify({ bounds: [0, 0, 5, 4], walls: [[0, 0, 5, 0], [5, 0, 5, 4], [5, 4, 0, 4], [0, 4, 0, 0]] }))],
  [HALL_IMAGE],
  [makeMapFile('hall.yaml', 'image: &a [*a]')],
  [makeMapFile('cut.pgm', HALL_IMAGE.buffer.subarray(0, 200))],
  [makeMapFile('plan.json', '{"walls": 7}')],
  [makeMapFile('notes.txt', 'no map')],
];

/** Returns a generator of random numbers and list elements. @param {number} seed @returns {Random} */
function randomOf(seed) {
  const random = randomGenerator(seed);
  const randomBelow = (/** @type {number} */ end) => Math.floor(end * random());
  return { below: randomBelow, one: (list) => list[randomBelow(list.length)] };
}

/** Brings a part of a widget to where the pointer can reach it. @param {Page} page @param {Random} random @param {string} selector */
async function partAt(page, random, selector) {
  const [name, choice, x, y] = [random.one(ALL_NAMES), random.below(1e6), random.below(99) + 1, random.below(99) + 1];
  const box = await page.evaluate(
    ([name, selector, choice]) => {
      const visibleParts = [...(document.querySelector(`${name}`)?.shadowRoot?.querySelectorAll(`${selector}`) ?? [])].filter((part) => part.checkVisibility());
      const part = visibleParts[Number(choice) % visibleParts.length];
      if (!part) return;
      part.scrollIntoView({ block: 'nearest', behavior: 'instant' });
      const { left, top, width, height } = part.getBoundingClientRect();
      return { left, top, width, height, what: `${part.localName} ${part.id || part.className} ${part.textContent?.trim().slice(0, 20)}` };
    },
    [name, selector, choice],
  );
  return box && { x: box.left + (box.width * x) / 100, y: box.top + (box.height * y) / 100, what: `${name} ${box.what}` };
}

/** @type {Record<string, Action>} */
const ACTIONS = {
  async click(page, random) {
    const part = await partAt(page, random, PART_SELECTOR);
    if (part) await page.mouse.click(part.x, part.y, { clickCount: random.one([1, 1, 1, 2]) });
    return `${part?.what}`;
  },
  async tap(page, random) {
    const part = await partAt(page, random, PART_SELECTOR);
    if (part) await page.touchscreen.tap(part.x, part.y);
    return `${part?.what}`;
  },
  async drag(page, random) {
    const part = await partAt(page, random, 'input[type=range], .handle, canvas');
    if (!part) return 'nothing';
    const offset = [random.below(400) - 200, random.below(200) - 100];
    await page.mouse.move(part.x, part.y);
    await page.mouse.down();
    await page.mouse.move(part.x + offset[0], part.y + offset[1], { steps: 4 });
    // Sometimes another event happens during a drag.
    if (random.below(4) > 0) await page.mouse.up();
    return `${part.what} by ${offset}`;
  },
  async key(page, random) {
    const keys = Array.from({ length: 1 + random.below(4) }, () => random.one(PRESSABLE_KEYS));
    for (const key of keys) await page.keyboard.press(key);
    return keys.join(' ');
  },
  async type(page, random) {
    const part = await partAt(page, random, 'input:not([type=range], [type=checkbox], [type=radio]), textarea');
    const [text, end] = [random.one(TYPED_NUMBERS), random.one(['Enter', 'Tab', 'Escape'])];
    if (part) {
      await page.mouse.click(part.x, part.y, { clickCount: 3 });
      await page.keyboard.insertText(text);
      await page.keyboard.press(end);
    }
    return `${part?.what}: ${JSON.stringify(text)} ${end}`;
  },
  async wheel(page, random) {
    const scrollDelta = random.below(2000) - 1000;
    await page.mouse.wheel(0, scrollDelta);
    return `${scrollDelta}`;
  },
  async attribute(page, random) {
    const [name, choice, text] = [random.one(ALL_NAMES), random.below(1e6), random.below(4) === 0 ? null : random.one(ATTRIBUTE_TEXTS)];
    return page.evaluate(([name, choice, text]) => {
      const attributes = [.../** @type {any} */ (customElements.get(`${name}`)).observedAttributes, 'lang', 'dir', 'id', 'hidden'];
      const attribute = attributes[Number(choice) % attributes.length];
      const element = document.querySelector(`${name}`);
      if (text === null) element?.removeAttribute(attribute);
      else element?.setAttribute(attribute, `${text}`);
      return `${name} ${attribute}=${text}`;
    }, [name, choice, text]);
  },
  async resize(page, random) {
    const [width, height] = random.one(WINDOW_SIZES);
    await page.setViewportSize({ width, height });
    return `${width} × ${height}`;
  },
  async media(page, random) {
    const media = { colorScheme: random.one(/** @type {const} */ (['light', 'dark'])), reducedMotion: random.one(/** @type {const} */ (['reduce', 'no-preference'])), media: random.one(/** @type {const} */ (['screen', 'screen', 'print'])) };
    await page.emulateMedia(media);
    return JSON.stringify(media);
  },
  async language(page, random) {
    const lang = random.one(LANGUAGES);
    await page.evaluate((to) => (document.documentElement.lang = to), lang);
    return lang;
  },
  async hash(page, random) {
    const [name, choice] = [random.one(ALL_NAMES), random.below(4)];
    return page.evaluate(async ([name, choice]) => {
      const link = await /** @type {AnyElement} */ (document.querySelector(`${name}`)).shareLink();
      const { hash } = new URL(link);
      location.hash = [hash, hash.slice(0, -9), `#${name}.1=`, '#top'][Number(choice)];
      return location.hash.slice(0, 60);
    }, [name, choice]);
  },
  async files(page, random) {
    const files = random.one(DROPPED_FILES);
    await page.evaluate(async (files) => {
      const section = document.querySelector('map-squeeze')?.shadowRoot?.querySelector('section');
      const dataTransfer = new DataTransfer();
      for (const { name, bytes } of files) dataTransfer.items.add(new File([new Uint8Array(bytes)], name));
      for (const type of ['dragover', 'drop']) section?.dispatchEvent(new DragEvent(type, { dataTransfer, bubbles: true, composed: true, cancelable: true }));
    }, files.map(({ name, buffer }) => ({ name, bytes: [...buffer] })));
    return files.map(({ name }) => name).join(' ');
  },
  async state(page, random) {
    const [name, choice, key, text] = [random.one(ALL_NAMES), random.below(3), random.below(1e6), random.one([0, 1, -1, 0.5, 1e9, null, 'x', [], {}, true])];
    return page.evaluate(([name, choice, key, text]) => {
      const element = /** @type {any} */ (document.querySelector(`${name}`));
      const keptStates = /** @type {any} */ (window).kept;
      const state = element.getState();
      if (state) keptStates.push(state);
      const { widget, version, ...values } = state ?? {};
      const names = Object.keys(values);
      const field = names[Number(key) % names.length];
      const nextState = choice === 0 ? { widget, version, [field]: text } : keptStates[Number(key) % keptStates.length];
      try {
        element.setState(nextState);
      } catch (error) {
        if (!(error instanceof TypeError || error instanceof RangeError)) throw error;
      }
      return `${name} ${choice === 0 ? `${field}: ${JSON.stringify(text)}` : 'a former state'}`;
    }, [name, choice, key, text]);
  },
  /** Sets a small number of samples, because events are slow with millions. */
  async few(page, random) {
    const [name, samples] = [random.one(ALL_NAMES), random.one([1, 20, 300, 2000])];
    return page.evaluate(([name, samples]) => {
      Object.assign(/** @type {Element} */ (document.querySelector(`${name}`)), { samples });
      return `${name} ${samples}`;
    }, [name, samples]);
  },
  async move(page, random) {
    const [name, choice] = [random.one(ALL_NAMES), random.below(3)];
    return page.evaluate(async ([name, choice]) => {
      const element = document.querySelector(`${name}`);
      const placeholder = document.createComment('');
      element?.after(placeholder);
      const movedElement = /** @type {Element} */ (element);
      movedElement.remove();
      if (choice === 1) await new Promise(requestAnimationFrame);
      placeholder.replaceWith(choice === 2 ? Object.assign(document.createElement(`${name}`), { id: movedElement.id }) : movedElement);
      return `${name} ${['moved', 'taken away for a while', 'another one in its place'][Number(choice)]}`;
    }, [name, choice]);
  },
};

/** Relative frequencies of the actions. @type {Record<string, number>} */
const FREQUENCIES = { click: 12, tap: 3, drag: 12, key: 8, type: 6, wheel: 3, attribute: 6, resize: 1, media: 1, language: 1, hash: 1, files: 1, state: 2, few: 4, move: 1 };
const WEIGHTED_ACTIONS = Object.entries(FREQUENCIES).flatMap(([name, share]) => Array(share).fill(name));

/**
 * Returns faults of a widget: in its picture and texts, and results that a second widget with its state does not have.
 *
 * @param {Page} page
 * @param {string} name
 */
function faultsOf(page, name) {
  return page.evaluate(async (name) => {
    const element = /** @type {any} */ (document.querySelector(name));
    const untilShown = async (/** @type {any} */ element) => {
      element.scrollIntoView({ block: 'start', behavior: 'instant' });
      await element.settled;
      await element.updateComplete;
    };
    element.hidden = false;
    await untilShown(element);
    const failure = element.shadowRoot.querySelector('.failure');
    if (failure || !element.simulation) return [`it shows ${failure?.textContent ?? 'nothing'}`];
    const faults = [...element.shadowRoot.querySelectorAll('dd, td, output, .typed, .note, .caption')]
      .map((field) => field.value ?? field.textContent)
      .filter((text) => /NaN|Infinity|undefined|\[object/.test(text))
      .map((text) => `it says ${text}`);

    const resultTextOf = async (/** @type {any} */ figure) => {
      const bytes = new Uint8Array(await new Blob([figure.poses, figure.verdicts ?? figure.executed]).arrayBuffer());
      const hash = [...new Uint8Array(await crypto.subtle.digest('SHA-256', bytes))].join();
      return JSON.stringify([figure.getState(), figure.stats, hash], (_, value) => (Number.isFinite(value) || typeof value !== 'number' ? value : String(value)));
    };
    // A growing cloud is paused. Otherwise it would have more samples a moment later.
    element.setState({ ...element.getState(), ...('playing' in element.getState() && { playing: false }) });
    await element.settled;
    const resultText1 = await resultTextOf(element);
    const state = element.getState();
    const element2 = /** @type {any} */ (document.createElement(name));
    element2.setState(JSON.parse(JSON.stringify(state)));
    element.after(element2);
    await untilShown(element2);
    const resultText2 = await resultTextOf(element2);
    element2.remove();
    if (resultText2 !== resultText1) faults.push(`a second figure with its state differs: ${resultText1.slice(0, 2000)} became ${resultText2.slice(0, 2000)}`);
    return faults;
  }, name);
}

test.use({ hasTouch: true });

test('random actions leave every figure sound @nightly', NEW_PAGE_TAG, async ({ page }) => {
  test.setTimeout(60_000 + EVENT_COUNT * 400);
  page.on('dialog', (dialog) => dialog.dismiss());
  await page.addInitScript(() => {
    Object.assign(window, { kept: [], trouble: [] });
    // Full screen is refused, as in many frames, because a window in full screen cannot be resized.
    Element.prototype.requestFullscreen = () => Promise.reject(new TypeError('Fullscreen is not permitted'));
    // A refused value fires an `error` event, which is expected. Other errors are not.
    addEventListener('error', (event) => {
      const { error } = event;
      event.preventDefault();
      const isExpected = event.target instanceof Element && (error instanceof TypeError || error instanceof RangeError) && /allowed|state/.test(error.message);
      if (!isExpected) Reflect.get(window, 'trouble').push(`${error?.stack ?? event.message}`);
    }, true);
  });
  await page.goto('/');
  for (const name of ALL_NAMES) {
    await page.locator(name).first().scrollIntoViewIfNeeded();
    await untilReady(page.locator(name).first());
  }

  const random = randomOf(SEED);
  /** @type {string[]} */
  const log = [];
  const replayHint = () => `MONKEY_SEED=${SEED} MONKEY_EVENTS=${EVENT_COUNT}, after ${log.length} events; the last:\n${log.slice(-12).join('\n')}\n`;
  while (log.length < EVENT_COUNT) {
    const name = random.one(WEIGHTED_ACTIONS);
    log.push(`${name} …`);
    await test.step(name, async () => log.push(`${name} ${await ACTIONS[name](page, random)}`), { box: true }).catch((error) => {
      throw new Error(replayHint(), { cause: error });
    });
    log.splice(-2, 1);
    if (log.length % EVENTS_PER_CHECK > 0 && log.length < EVENT_COUNT) continue;
    await page.mouse.up();
    await page.keyboard.press('Escape');
    await page.emulateMedia({ media: 'screen' });
    await waitForFrames(page);
    for (const widget of ALL_NAMES) expect(await faultsOf(page, widget), `${widget}: ${replayHint()}`).toEqual([]);
    expect(await page.evaluate(() => Reflect.get(window, 'trouble').splice(0)), replayHint()).toEqual([]);
  }
});
