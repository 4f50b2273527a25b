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

/** Those with a handle, and sliders of the command in sight. */
export const NAMES = /** @type {const} */ (['banana-machine', 'map-squeeze']);

/** All elements. */
export const ALL = /** @type {const} */ ([...NAMES, 'arc-anatomy', 'odometry-decomposer', 'dead-reckoning']);

/** Those with a cloud that grows, by Play, Step and Reset. */
export const CLOUDS = /** @type {const} */ ([...NAMES, 'odometry-decomposer', 'dead-reckoning']);

/** Those with a handle in a picture. */
export const HANDLED = /** @type {const} */ ([...NAMES, 'arc-anatomy', 'odometry-decomposer']);

/**
 * What tests of its life, of print and of help need to know of each.
 *
 * @typedef {object} Known
 * @property {[string, number]} slider in sight, and a value that it can be put to
 * @property {string[]} path where a state has that value
 * @property {[string, number]} other a setting that the first picture shows, and another value than it opens with
 * @property {{ at: number, field: string, value: string }} fold which of the folds has a field, and what can be typed there
 * @property {{ at: number, part: string }} paper which of the folds has something for paper, and what
 * @property {string} [fewer] attributes for a test of times, where the machine drives every robot of its cloud many steps
 */

/** @type {Record<typeof ALL[number], Known>} */
export const KNOWN = {
  'banana-machine': { slider: ['v', 0.25], path: ['command', 'v'], other: ['omega', 1.25], fold: { at: 0, field: 'input[type=number]', value: '7' }, paper: { at: 1, part: 'table' } },
  'map-squeeze': { slider: ['v', 0.25], path: ['command', 'v'], other: ['omega', 1.25], fold: { at: 0, field: 'input[type=number]', value: '7' }, paper: { at: 1, part: 'table' } },
  'arc-anatomy': { slider: ['v', 0.25], path: ['command', 'v'], other: ['omega', 1.25], fold: { at: 1, field: '.slider:has(#alpha1) .typed', value: '0.070' }, paper: { at: 2, part: '.lines' } },
  'odometry-decomposer': { slider: ['phase', 0.25], path: ['phase'], other: ['toY', -0.75], fold: { at: 0, field: '.slider:has(#alpha1) .typed', value: '0.070' }, paper: { at: 1, part: '.readouts' } },
  'dead-reckoning': { slider: ['headingNoise', 0.15], path: ['alphas', '2'], other: ['omega', 1.25], fold: { at: 0, field: 'input[type=number]', value: '7' }, paper: { at: 0, part: 'table' }, fewer: 'samples="10000"' },
};

/**
 * What tests of states, links and traps need to know of each element: a slider in sight, where its setting is in the state, and two values for it; a number in a
 * group; a button in sight that changes settings; how many canvases there are, the first of them called `plane`; and where in the catalogue a
 * message stands that is said in a fold, for those that have one.
 *
 * @type {Record<typeof ALL[number], { slider: string, at: string[], values: [number, number], group: string[], button: string, canvases: number, folded?: string[] }>}
 */
export const ABOUT = {
  'banana-machine': { slider: 'v', at: ['command', 'v'], values: [0.7, 0.4], group: ['command', 'v'], button: 'New seed', canvases: 2, folded: ['banana', 'table', 'mean'] },
  'map-squeeze': { slider: 'v', at: ['command', 'v'], values: [0.7, 0.4], group: ['command', 'v'], button: 'New seed', canvases: 1, folded: ['squeeze', 'tally', 'tests'] },
  'arc-anatomy': { slider: 'v', at: ['command', 'v'], values: [0.7, 0.4], group: ['next', 'y'], button: '›', canvases: 1 },
  'odometry-decomposer': { slider: 'drift', at: ['drift'], values: [70, 20], group: ['from', 'theta'], button: 'Drive, turn', canvases: 2, folded: ['decomposer', 'readouts', 'exactly'] },
  'dead-reckoning': { slider: 'step', at: ['step'], values: [7, 4], group: ['command', 'dt'], button: 'New seed', canvases: 2, folded: ['reckoning', 'misses', 'endOf'] },
};

/** Those whose room is known. */
export const RESERVED = /** @type {const} */ ([...NAMES, 'dead-reckoning']);

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

/** @param {Locator} widget */
export function stateOf(widget) {
  return widget.evaluate((element) => /** @type {AnyElement} */ (element).getState());
}
