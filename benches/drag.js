/**
 * What the frame after a step of a drag takes, at the opening sizes and with a processor four times slower: the step's
 * share of JavaScript and WebAssembly, and the browser's of style, layout and paint.
 *
 * @module
 */

import { spread } from './timing.js';

/** How many times slower Chromium makes the processor. */
export const THROTTLE = 4;

/** What is dragged: every slider that shows, and every handle. */
const DRAGGED = '.slider input[type=range], .handle';

/**
 * @typedef {{ widget: string, what: string, time: import('./timing.js').Spread }} Drag times in ms
 *
 * @param {import('@playwright/test').Browser} browser
 * @param {string} address of drag.html
 * @param {number} steps of each drag
 * @returns {Promise<Drag[]>}
 */
export async function timeDrags(browser, address, steps) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, reducedMotion: 'reduce' });
  const page = await context.newPage();
  await page.goto(address);
  const session = await context.newCDPSession(page);
  /** @type {Drag[]} */
  const drags = [];
  for (const widget of ['banana-machine', 'map-squeeze']) {
    await page.locator(widget).scrollIntoViewIfNeeded();
    await page.waitForFunction((tag) => document.querySelector(tag)?.shadowRoot?.querySelector('.slider'), widget);
    await page.locator(widget).evaluate((element) => element.scrollIntoView({ block: 'start' }));
    const count = await page.locator(widget).locator(DRAGGED).count();
    await session.send('Emulation.setCPUThrottlingRate', { rate: THROTTLE });
    for (let i = 0; i < count; i++) {
      const { what, times } = await page.evaluate(drag, { widget, selector: DRAGGED, i, steps });
      if (times.length > 0) drags.push({ widget, what, time: spread(times) });
    }
    await session.send('Emulation.setCPUThrottlingRate', { rate: 1 });
  }
  await context.close();
  return drags;
}

/**
 * Runs in the page.
 *
 * @param {{ widget: string, selector: string, i: number, steps: number }} wanted
 */
async function drag({ widget, selector, i, steps }) {
  const root = /** @type {ShadowRoot} */ (document.querySelector(widget)?.shadowRoot);
  const target = /** @type {HTMLInputElement} */ (root.querySelectorAll(selector)[i]);
  /** @type {number[]} */
  const times = [];
  const slider = target.localName === 'input';
  const opening = target.value;
  // The first steps compile what the others run.
  for (let step = -5; step < steps; step++) {
    await new Promise(requestAnimationFrame);
    const frame = new Promise((resolve) =>
      requestAnimationFrame(() => {
        const began = performance.now();
        // A message is read once the frame that is being made has been handed over.
        const { port1, port2 } = new MessageChannel();
        port1.onmessage = () => resolve(performance.now() - began);
        port2.postMessage(undefined);
      }),
    );
    if (slider) {
      if (step % 2) target.stepUp();
      else target.stepDown();
      target.dispatchEvent(new InputEvent('input', { bubbles: true, composed: true }));
    } else {
      // Keys move a handle as a pointer does, by steps.
      target.dispatchEvent(new KeyboardEvent('keydown', { key: step % 2 ? 'ArrowLeft' : 'ArrowRight', bubbles: true, composed: true }));
    }
    const time = /** @type {number} */ (await frame);
    if (step >= 0) times.push(time);
  }
  if (slider) {
    target.value = opening;
    for (const name of ['input', 'change']) target.dispatchEvent(new Event(name, { bubbles: true, composed: true }));
    await new Promise(requestAnimationFrame);
  }
  return { what: target.id || (target.getAttribute('aria-label') ?? ''), times };
}
