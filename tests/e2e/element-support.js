/**
 * What the tests of the elements as a page has them share: pages of their own, and what a page hears.
 *
 * @module
 */

import { expect } from '@playwright/test';
import { frames } from './support.js';

/**
 * @typedef {import('@playwright/test').Page} Page
 * @typedef {import('@playwright/test').Locator} Locator
 * @typedef {import('../../www/types.d.ts').WidgetElement<any, any> & { machine: any, motion: any }} AnyElement
 * @typedef {{ name: string, target: string, message: string, path: number, value: unknown }} Heard
 */

/**
 * What tests need to know of each element.
 *
 * @typedef {object} Known
 * @property {boolean} [cloud] whether it has one that grows, by Play, Step and Reset
 * @property {string[]} [handles] in its pictures
 * @property {string} slider in sight
 * @property {string[]} at where the slider's setting is in a state
 * @property {[number, number]} values that the slider can be put to
 * @property {string[]} group where a number of a group is in a state, or a number of no group
 * @property {[string, number]} other a setting that the first picture shows, and another value than it opens with
 * @property {string} button in sight, which changes the state
 * @property {number} canvases how many there are: the first of them is called `plane`
 * @property {string[]} [folded] where in the catalogue a message is that is said in a fold
 * @property {{ at: number, field: string, value: string }} fold which of the folds has a field, and what can be typed there
 * @property {{ at: number, part: string }} paper which of the folds has something for paper, and what
 * @property {string} [fewer] attributes for a test of times, where the machine drives every robot of its cloud many steps
 */

/** @satisfies {Partial<Known>} */
const COMMAND = { slider: 'v', at: ['command', 'v'], values: /** @type {[number, number]} */ ([0.7, 0.4]), other: /** @type {[string, number]} */ (['omega', 1.25]) };
const MARKED = { at: 0, field: 'input[type=number]', value: '7' };

/** @typedef {'banana-machine' | 'map-squeeze' | 'arc-anatomy' | 'odometry-decomposer' | 'dead-reckoning' | 'alpha-calibrator'} Name */

/** @type {Record<Name, Known>} */
export const KNOWN = {
  'banana-machine': {
    ...COMMAND, cloud: true, handles: ['.handle'], group: ['command', 'v'], button: 'New seed', canvases: 2,
    folded: ['banana', 'table', 'mean'], fold: MARKED, paper: { at: 1, part: 'table' },
  },
  'map-squeeze': {
    ...COMMAND, cloud: true, handles: ['.handle.body', '.handle.turn'], group: ['command', 'v'], button: 'New seed', canvases: 1,
    folded: ['squeeze', 'tally', 'tests'], fold: MARKED, paper: { at: 1, part: 'table' },
  },
  'arc-anatomy': {
    ...COMMAND, handles: ['.handle.body.start', '.handle.turn.start', '.handle.body.next', '.handle.turn.next'], group: ['next', 'y'], button: 'The next line', canvases: 1,
    fold: { at: 1, field: '.slider:has(#alpha1) .typed', value: '0.070' }, paper: { at: 2, part: '.lines' },
  },
  'odometry-decomposer': {
    cloud: true, handles: ['.handle.body.from', '.handle.turn.from', '.handle.body.to', '.handle.turn.to'],
    slider: 'drift', at: ['drift'], values: [70, 20], group: ['from', 'theta'], other: ['toY', -0.75], button: 'Drive, turn', canvases: 2,
    folded: ['decomposer', 'readouts', 'exactly'], fold: { at: 0, field: '.slider:has(#alpha1) .typed', value: '0.070' }, paper: { at: 1, part: '.readouts' },
  },
  'dead-reckoning': {
    cloud: true, slider: 'step', at: ['step'], values: [7, 4], group: ['command', 'dt'], other: ['omega', 1.25], button: 'New seed', canvases: 2,
    folded: ['reckoning', 'misses', 'endOf'], fold: MARKED, paper: { at: 0, part: 'table' }, fewer: 'samples="10000"',
  },
  'alpha-calibrator': {
    slider: 'distance', at: ['distance'], values: [0.4, 0.3], group: ['distance'], other: ['angle', 0.35], button: 'Next worst leg', canvases: 2,
    folded: ['calibrator', 'inflation', 'coverageLabel'], fold: { at: 2, field: '.slider:has(#inflation) .typed', value: '2.50' }, paper: { at: 1, part: 'table' },
  },
};

/** All elements. */
export const ALL = /** @type {Name[]} */ (Object.keys(KNOWN));

/** Two of them, for tests of what happens between elements or of what these alone have. */
export const NAMES = /** @type {const} */ (['banana-machine', 'map-squeeze']);

/** Those with a cloud. */
export const CLOUDS = ALL.filter((name) => KNOWN[name].cloud);

/** Those with a handle. */
export const HANDLED = ALL.filter((name) => KNOWN[name].handles);

/**
 * A page with a body of its own. It notes what its document hears of the elements.
 *
 * @param {Page} page
 * @param {string} body
 * @param {{ head?: string, fragment?: string, script?: string }} [options]
 */
export async function show(page, body, { head = '', fragment = '', script = '<script type="module" src="/motion-widgets.js"></script>' } = {}) {
  await page.addInitScript(() => {
    const heard = /** @type {Heard[]} */ ([]);
    Object.assign(window, { heard });
    for (const name of ['load', 'input', 'change', 'stats', 'error']) {
      document.addEventListener(name, (event) => {
        const target = /** @type {Element} */ (event.target);
        if (!(target instanceof Element) || !target.localName.includes('-')) return;
        const { message = '' } = /** @type {ErrorEvent} */ (event);
        // It is attended to, and nothing for the console.
        event.preventDefault();
        const value = /** @type {AnyElement} */ (target).v;
        heard.push({ name, target: target.localName, message, path: event.composedPath().length, value });
        // Errors do not bubble.
      }, { capture: name === 'error' });
    }
  });
  await page.route('**/bare.html', (route) =>
    route.fulfill({
      contentType: 'text/html',
      body: `<!doctype html><html lang="en"><head><meta charset="utf-8"><title>Bare</title><link rel="icon" href="data:,">${head}${script}</head><body>${body}</body></html>`,
    }),
  );
  await page.goto(`/bare.html${fragment}`);
}

/**
 * Waits until an element has its machine, and a picture where it is in sight.
 *
 * @param {Locator} widget
 */
export async function ready(widget) {
  await expect.poll(() => widget.evaluate((element) => Reflect.get(element, 'machine') !== undefined)).toBe(true);
  await frames(widget.page());
}

/**
 * What the page has heard since it was last asked, without the statistics unless they are wanted.
 *
 * @param {Page} page
 * @param {string[]} [names]
 * @returns {Promise<Heard[]>}
 */
export async function heard(page, names = ['load', 'input', 'change', 'error']) {
  await frames(page);
  const all = /** @type {Heard[]} */ (await page.evaluate(() => Reflect.get(window, 'heard').splice(0)));
  return all.filter(({ name }) => names.includes(name));
}

/**
 * @param {Locator} widget
 * @param {string} name
 */
export function property(widget, name) {
  return widget.evaluate((element, key) => Reflect.get(element, key), name);
}

/**
 * @param {Locator} widget
 * @param {string} name
 * @param {unknown} value
 * @returns {Promise<string>} what it refuses by an error event; empty where it does not
 */
export function assign(widget, name, value) {
  return widget.evaluate(
    (element, [key, to]) => {
      let refused = '';
      const listen = (/** @type {Event} */ event) => void (refused = String(/** @type {ErrorEvent} */ (event).error));
      element.addEventListener('error', listen);
      Reflect.set(element, /** @type {string} */ (key), to);
      element.removeEventListener('error', listen);
      return refused;
    },
    [name, value],
  );
}

/**
 * Plays what a slider sets, by its button, from and to the page: a hand from outside may come when it is over.
 *
 * @param {Locator} widget
 * @param {string} key of what is played in a state, and class of its group
 * @param {number} [most] after so many steps it is paused
 * @returns {Promise<{ values: number[], label: string }>} the value at each step until it rests, and what the button said meanwhile
 */
export function played(widget, key, most = Infinity) {
  return widget.evaluate(
    (element, [key, most]) =>
      new Promise((resolve) => {
        const figure = /** @type {AnyElement} */ (element);
        const button = /** @type {HTMLButtonElement} */ (figure.shadowRoot?.querySelector(`.${key} button`));
        const values = /** @type {number[]} */ ([]);
        let label = '';
        const listen = async () => {
          values.push(/** @type {any} */ (figure.getState())[key]);
          if (values.length === 1) {
            await /** @type {any} */ (figure).updateComplete;
            label = button.innerText;
          }
          if (values.length === most) button.click();
        };
        figure.addEventListener('input', listen);
        figure.addEventListener('change', () => {
          figure.removeEventListener('input', listen);
          resolve({ values, label });
        }, { once: true });
        button.click();
      }),
    /** @type {const} */ ([key, most]),
  );
}

/** @param {Locator} widget */
export function stateOf(widget) {
  return widget.evaluate((element) => /** @type {AnyElement} */ (element).getState());
}
