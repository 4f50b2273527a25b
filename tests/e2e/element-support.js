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

export const NAMES = /** @type {const} */ (['banana-machine', 'map-squeeze']);

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
