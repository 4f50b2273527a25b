// Monkey test: random clicks, drags, keys, numbers, files, attributes, sizes and languages. No event may cause an error message, a trap or
// a broken figure, and a figure that is opened with the state of another shows the same.
//
// MONKEY_EVENTS and MONKEY_SEED ask for more, and for another one; a failure names what replays it.

import { expect } from '@playwright/test';
import { generator } from '../random.js';
import { mapFile, pgmFile, yamlFile } from './squeeze-support.js';
import { FRESH, frames, test, untilReady } from './support.js';
import { ALL_NAMES } from './figures.js';

/**
 * @typedef {import('@playwright/test').Page} Page
 * @typedef {import('./support.js').AnyElement} AnyElement
 * @typedef {{ below: (end: number) => number, one: <T>(of: readonly T[]) => T }} Luck random numbers, and random elements of lists
 * @typedef {(page: Page, luck: Luck) => Promise<string>} Deed random action, which returns a description of itself
 */

const EVENTS = Number(process.env.MONKEY_EVENTS ?? 600);
const SEED = Number(process.env.MONKEY_SEED ?? 1);

/** Number of events between two checks of the page. */
const ROUND = 250;

/** Parts of a widget that are clicked and dragged. */
const PARTS = 'button, summary, input, .handle, canvas, textarea, label';

const NUMBERS = ['0', '1', '0.5', '-3', '\u22120.25', '1,5', '1e-300', '1e9', '12345678901', '100', '7', 'NaN', 'Infinity', '', ' ', 'abc', '2 m', '0x10', '1e'];
const KEYS = ['Tab', 'Shift+Tab', 'Enter', ' ', 'Escape', 'ArrowLeft', 'ArrowRight', 'ArrowUp', 'ArrowDown', 'PageUp', 'PageDown', 'Home', 'End', 'c', 'C', '5', 'Backspace', 'Delete'];
const TEXTS = ['', 'null', 'true', 'false', 'toString', '__proto__', '\u0000', 'velocity', 'odometry', 'normal', 'triangular', 'close', 'whole', 'endpoint', 'whole-arc', 'sub-stepped', 'free', 'occupied', 'unknown', 'command ellipse', 'Banana', 'Hard arc', 'doorway', ...NUMBERS];
const LANGUAGES = ['en', 'de', 'de-AT', 'fr', '', 'constructor', 'x'];
const SIZES = [[1280, 720], [375, 667], [320, 480], [800, 400], [1920, 1080], [600, 900]];

const HALL = pgmFile('hall.pgm', 30, 20, (column, row) => column % 29 === 0 || row % 19 === 0);
/** Files that readers may drop, the first of them a map. */
const FILES = [
  [yamlFile('hall.yaml', { image: 'hall.pgm', resolution: 0.1, origin: '[0, 0, 0]', negate: 0, occupied_thresh: 0.65, free_thresh: 0.2 }), HALL],
  [mapFile('plan.json', JSON.stringify({ bounds: [0, 0, 5, 4], walls: [[0, 0, 5, 0], [5, 0, 5, 4], [5, 4, 0, 4], [0, 4, 0, 0]] }))],
  [HALL],
  [mapFile('hall.yaml', 'image: &a [*a]')],
  [mapFile('cut.pgm', HALL.buffer.subarray(0, 200))],
  [mapFile('plan.json', '{"walls": 7}')],
  [mapFile('notes.txt', 'no map')],
];

/** @param {number} seed @returns {Luck} */
function luckOf(seed) {
  const next = generator(seed);
  const below = (/** @type {number} */ end) => Math.floor(end * next());
  return { below, one: (of) => of[below(of.length)] };
}

/** Brings a part of a widget to where the pointer can reach it. @param {Page} page @param {Luck} luck @param {string} selector */
async function partAt(page, luck, selector) {
  const [name, choice, x, y] = [luck.one(ALL_NAMES), luck.below(1e6), luck.below(99) + 1, luck.below(99) + 1];
  const place = await page.evaluate(
    ([name, selector, choice]) => {
      const parts = [...(document.querySelector(`${name}`)?.shadowRoot?.querySelectorAll(`${selector}`) ?? [])].filter((part) => part.checkVisibility());
      const part = parts[Number(choice) % parts.length];
      if (!part) return;
      part.scrollIntoView({ block: 'nearest', behavior: 'instant' });
      const { left, top, width, height } = part.getBoundingClientRect();
      return { left, top, width, height, what: `${part.localName} ${part.id || part.className} ${part.textContent?.trim().slice(0, 20)}` };
    },
    [name, selector, choice],
  );
  return place && { x: place.left + (place.width * x) / 100, y: place.top + (place.height * y) / 100, what: `${name} ${place.what}` };
}

/** @type {Record<string, Deed>} */
const DEEDS = {
  async click(page, luck) {
    const part = await partAt(page, luck, PARTS);
    if (part) await page.mouse.click(part.x, part.y, { clickCount: luck.one([1, 1, 1, 2]) });
    return `${part?.what}`;
  },
  async tap(page, luck) {
    const part = await partAt(page, luck, PARTS);
    if (part) await page.touchscreen.tap(part.x, part.y);
    return `${part?.what}`;
  },
  async drag(page, luck) {
    const part = await partAt(page, luck, 'input[type=range], .handle, canvas');
    if (!part) return 'nothing';
    const by = [luck.below(400) - 200, luck.below(200) - 100];
    await page.mouse.move(part.x, part.y);
    await page.mouse.down();
    await page.mouse.move(part.x + by[0], part.y + by[1], { steps: 4 });
    // Sometimes another event happens during a drag.
    if (luck.below(4) > 0) await page.mouse.up();
    return `${part.what} by ${by}`;
  },
  async key(page, luck) {
    const keys = Array.from({ length: 1 + luck.below(4) }, () => luck.one(KEYS));
    for (const key of keys) await page.keyboard.press(key);
    return keys.join(' ');
  },
  async type(page, luck) {
    const part = await partAt(page, luck, 'input:not([type=range], [type=checkbox], [type=radio]), textarea');
    const [text, end] = [luck.one(NUMBERS), luck.one(['Enter', 'Tab', 'Escape'])];
    if (part) {
      await page.mouse.click(part.x, part.y, { clickCount: 3 });
      await page.keyboard.insertText(text);
      await page.keyboard.press(end);
    }
    return `${part?.what}: ${JSON.stringify(text)} ${end}`;
  },
  async wheel(page, luck) {
    const by = luck.below(2000) - 1000;
    await page.mouse.wheel(0, by);
    return `${by}`;
  },
  async attribute(page, luck) {
    const [name, choice, text] = [luck.one(ALL_NAMES), luck.below(1e6), luck.below(4) === 0 ? null : luck.one(TEXTS)];
    return page.evaluate(([name, choice, text]) => {
      const attributes = [.../** @type {any} */ (customElements.get(`${name}`)).observedAttributes, 'lang', 'dir', 'id', 'hidden'];
      const attribute = attributes[Number(choice) % attributes.length];
      const element = document.querySelector(`${name}`);
      if (text === null) element?.removeAttribute(attribute);
      else element?.setAttribute(attribute, `${text}`);
      return `${name} ${attribute}=${text}`;
    }, [name, choice, text]);
  },
  async resize(page, luck) {
    const [width, height] = luck.one(SIZES);
    await page.setViewportSize({ width, height });
    return `${width} × ${height}`;
  },
  async media(page, luck) {
    const media = { colorScheme: luck.one(/** @type {const} */ (['light', 'dark'])), reducedMotion: luck.one(/** @type {const} */ (['reduce', 'no-preference'])), media: luck.one(/** @type {const} */ (['screen', 'screen', 'print'])) };
    await page.emulateMedia(media);
    return JSON.stringify(media);
  },
  async language(page, luck) {
    const lang = luck.one(LANGUAGES);
    await page.evaluate((to) => (document.documentElement.lang = to), lang);
    return lang;
  },
  async hash(page, luck) {
    const [name, choice] = [luck.one(ALL_NAMES), luck.below(4)];
    return page.evaluate(async ([name, choice]) => {
      const link = await /** @type {AnyElement} */ (document.querySelector(`${name}`)).shareLink();
      const { hash } = new URL(link);
      location.hash = [hash, hash.slice(0, -9), `#${name}.1=`, '#top'][Number(choice)];
      return location.hash.slice(0, 60);
    }, [name, choice]);
  },
  async files(page, luck) {
    const given = luck.one(FILES);
    await page.evaluate(async (files) => {
      const section = document.querySelector('map-squeeze')?.shadowRoot?.querySelector('section');
      const dataTransfer = new DataTransfer();
      for (const { name, bytes } of files) dataTransfer.items.add(new File([new Uint8Array(bytes)], name));
      for (const type of ['dragover', 'drop']) section?.dispatchEvent(new DragEvent(type, { dataTransfer, bubbles: true, composed: true, cancelable: true }));
    }, given.map(({ name, buffer }) => ({ name, bytes: [...buffer] })));
    return given.map(({ name }) => name).join(' ');
  },
  async state(page, luck) {
    const [name, choice, key, text] = [luck.one(ALL_NAMES), luck.below(3), luck.below(1e6), luck.one([0, 1, -1, 0.5, 1e9, null, 'x', [], {}, true])];
    return page.evaluate(([name, choice, key, text]) => {
      const element = /** @type {any} */ (document.querySelector(`${name}`));
      const kept = /** @type {any} */ (window).kept;
      const state = element.getState();
      if (state) kept.push(state);
      const { widget, version, ...values } = state ?? {};
      const names = Object.keys(values);
      const field = names[Number(key) % names.length];
      const given = choice === 0 ? { widget, version, [field]: text } : kept[Number(key) % kept.length];
      try {
        element.setState(given);
      } catch (error) {
        if (!(error instanceof TypeError || error instanceof RangeError)) throw error;
      }
      return `${name} ${choice === 0 ? `${field}: ${JSON.stringify(text)}` : 'a former state'}`;
    }, [name, choice, key, text]);
  },
  /** Sets a small number of samples: with millions everything else would be slow. */
  async few(page, luck) {
    const [name, samples] = [luck.one(ALL_NAMES), luck.one([1, 20, 300, 2000])];
    return page.evaluate(([name, samples]) => {
      Object.assign(/** @type {Element} */ (document.querySelector(`${name}`)), { samples });
      return `${name} ${samples}`;
    }, [name, samples]);
  },
  async move(page, luck) {
    const [name, choice] = [luck.one(ALL_NAMES), luck.below(3)];
    return page.evaluate(async ([name, choice]) => {
      const element = document.querySelector(`${name}`);
      const mark = document.createComment('');
      element?.after(mark);
      const place = /** @type {Element} */ (element);
      place.remove();
      if (choice === 1) await new Promise(requestAnimationFrame);
      mark.replaceWith(choice === 2 ? Object.assign(document.createElement(`${name}`), { id: place.id }) : place);
      return `${name} ${['moved', 'taken away for a while', 'another one in its place'][Number(choice)]}`;
    }, [name, choice]);
  },
};

/** Relative frequencies of the actions. @type {Record<string, number>} */
const SHARES = { click: 12, tap: 3, drag: 12, key: 8, type: 6, wheel: 3, attribute: 6, resize: 1, media: 1, language: 1, hash: 1, files: 1, state: 2, few: 4, move: 1 };
const DRAWN = Object.entries(SHARES).flatMap(([name, share]) => Array(share).fill(name));

/**
 * Returns faults of a widget: in its picture and words, and where its state does not bring back the same machine.
 *
 * @param {Page} page
 * @param {string} name
 */
function complaintsAbout(page, name) {
  return page.evaluate(async (name) => {
    const element = /** @type {any} */ (document.querySelector(name));
    const there = async (/** @type {any} */ element) => {
      element.scrollIntoView({ block: 'start', behavior: 'instant' });
      await element.settled;
      await element.updateComplete;
    };
    element.hidden = false;
    await there(element);
    const failure = element.shadowRoot.querySelector('.failure');
    if (failure || !element.machine) return [`it shows ${failure?.textContent ?? 'nothing'}`];
    const complaints = [...element.shadowRoot.querySelectorAll('dd, td, output, .typed, .note, .caption')]
      .map((each) => each.value ?? each.textContent)
      .filter((text) => /NaN|Infinity|undefined|\[object/.test(text))
      .map((text) => `it says ${text}`);

    const resultsOf = async (/** @type {any} */ one) => {
      const bytes = new Uint8Array(await new Blob([one.poses, one.verdicts ?? one.executed]).arrayBuffer());
      const hash = [...new Uint8Array(await crypto.subtle.digest('SHA-256', bytes))].join();
      return JSON.stringify([one.getState(), one.stats, hash], (_, value) => (Number.isFinite(value) || typeof value !== 'number' ? value : String(value)));
    };
    // A growing cloud would have more samples a moment later.
    element.setState({ ...element.getState(), ...('playing' in element.getState() && { playing: false }) });
    await element.settled;
    const before = await resultsOf(element);
    const state = element.getState();
    const fresh = /** @type {any} */ (document.createElement(name));
    fresh.setState(JSON.parse(JSON.stringify(state)));
    element.after(fresh);
    await there(fresh);
    const after = await resultsOf(fresh);
    fresh.remove();
    if (after !== before) complaints.push(`another one in its state is another: ${before.slice(0, 2000)} became ${after.slice(0, 2000)}`);
    return complaints;
  }, name);
}

test.use({ hasTouch: true });

test('random actions leave every figure sound @nightly', FRESH, async ({ page }) => {
  test.setTimeout(60_000 + EVENTS * 400);
  page.on('dialog', (dialog) => dialog.dismiss());
  await page.addInitScript(() => {
    Object.assign(window, { kept: [], trouble: [] });
    // A window in full screen has one size, so presentations are refused it, as in many frames.
    Element.prototype.requestFullscreen = () => Promise.reject(new TypeError('Fullscreen is not permitted'));
    // A refused value fires an `error` event, which is expected. Other errors are not.
    addEventListener('error', (event) => {
      const { error } = event;
      event.preventDefault();
      const refused = event.target instanceof Element && (error instanceof TypeError || error instanceof RangeError) && /allowed|state/.test(error.message);
      if (!refused) Reflect.get(window, 'trouble').push(`${error?.stack ?? event.message}`);
    }, true);
  });
  await page.goto('/');
  for (const name of ALL_NAMES) {
    await page.locator(name).first().scrollIntoViewIfNeeded();
    await untilReady(page.locator(name).first());
  }

  const luck = luckOf(SEED);
  /** @type {string[]} */
  const done = [];
  const replay = () => `MONKEY_SEED=${SEED} MONKEY_EVENTS=${EVENTS}, after ${done.length} events; the last:\n${done.slice(-12).join('\n')}\n`;
  while (done.length < EVENTS) {
    const name = luck.one(DRAWN);
    done.push(`${name} …`);
    await test.step(name, async () => done.push(`${name} ${await DEEDS[name](page, luck)}`), { box: true }).catch((error) => {
      throw new Error(replay(), { cause: error });
    });
    done.splice(-2, 1);
    if (done.length % ROUND > 0 && done.length < EVENTS) continue;
    await page.mouse.up();
    await page.keyboard.press('Escape');
    await page.emulateMedia({ media: 'screen' });
    await frames(page);
    for (const widget of ALL_NAMES) expect(await complaintsAbout(page, widget), `${widget}: ${replay()}`).toEqual([]);
    expect(await page.evaluate(() => Reflect.get(window, 'trouble').splice(0)), replay()).toEqual([]);
  }
});
