/**
 * Helpers of the browser tests: the test function, the gallery page, readings of a machine, and actions on controls.
 *
 * @module
 */

import { expect, test as base } from '@playwright/test';
import { ALL_NAMES, CLOUD_NAMES, NAMES_WITH_HANDLES, figureFor } from './figures.js';

/**
 * @typedef {import('@playwright/test').Page} Page
 * @typedef {import('@playwright/test').Locator} Locator
 * @typedef {import('../../www/types.d.ts').BananaMachine} BananaMachine
 * @typedef {import('../../www/types.d.ts').Motion} Motion
 * @typedef {import('./figures.js').Name} Name
 * @typedef {import('../../www/types.d.ts').WidgetElement<any, any> & { machine: any, motion: any }} AnyElement
 * @typedef {{ name: string, target: string, message: string, path: number, value: unknown }} Heard
 * @typedef {HTMLElement & { machine: BananaMachine, motion: Motion }} BananaMachineElement
 */

/**
 * Names of elements that a test's title chooses, for claims about all figures, all clouds and all handles; and whether the session has
 * seen what a figure shows at first sight.
 *
 * @typedef {{ figure: Name, cloud: Name, handled: Name, introduced: boolean }} Chosen
 */

/**
 * Test that fails on any warning or error in the console.
 *
 * @type {import('@playwright/test').TestType<import('@playwright/test').PlaywrightTestArgs & import('@playwright/test').PlaywrightTestOptions & Chosen, import('@playwright/test').PlaywrightWorkerArgs & import('@playwright/test').PlaywrightWorkerOptions>}
 */
export const test = base.extend({
  /* oxlint-disable no-empty-pattern */
  figure: async ({}, use, { title }) => use(figureFor(title)),
  cloud: async ({}, use, { title }) => use(figureFor(title, CLOUD_NAMES)),
  handled: async ({}, use, { title }) => use(figureFor(title, NAMES_WITH_HANDLES)),
  /* oxlint-enable no-empty-pattern */
  introduced: [true, { option: true }],
  page: async ({ page, introduced }, use) => {
    if (introduced) await page.addInitScript(skipIntroduction);
    /** @type {string[]} */
    const complaints = [];
    page.on('console', (message) => {
      if (['error', 'warning'].includes(message.type())) complaints.push(message.text());
    });
    page.on('pageerror', (error) => complaints.push(String(error)));
    await use(page);
    expect(complaints).toEqual([]);
  },
});

/**
 * Declares the test of a claim about all figures. By day it is tested with one figure, which the title chooses, and at night with each.
 *
 * @param {string} title
 * @param {(page: Page, name: Name, isFull: boolean) => Promise<void>} claim is tested in full at night
 * @param {{ tag?: string }} [details]
 */
export function testEach(title, claim, details = {}) {
  test(title, details, ({ page, figure }) => claim(page, figure, false));
  for (const name of ALL_NAMES) {
    test(`${title}: ${name} @nightly`, details, ({ page }) => {
      test.slow();
      return claim(page, name, true);
    });
  }
}

/** Marks the introduction of a figure as seen. It runs in the page before the page's scripts. */
function skipIntroduction() {
  try {
    sessionStorage.setItem('motion-widgets.introduced', 'yes');
  } catch {
    // A page without storage shows no introduction.
  }
}

/** Tag of tests of a first visit or of the history. They get a new page, see playwright.config.js. */
export const FRESH = { tag: '@fresh' };

/** Options of tests of a complete cloud. With reduced motion it is complete at once. */
export const STILL = { contextOptions: { reducedMotion: /** @type {const} */ ('reduce') } };

/**
 * Opens a page with a body, and records the events of its elements.
 *
 * @param {Page} page
 * @param {string} body
 * @param {{ head?: string, fragment?: string, script?: string }} [options]
 */
export async function showPage(page, body, { head = '', fragment = '', script = '<script type="module" src="/motion-widgets.js"></script>' } = {}) {
  await page.addInitScript(() => {
    const heard = /** @type {Heard[]} */ ([]);
    Object.assign(window, { heard });
    for (const name of ['load', 'input', 'change', 'stats', 'error']) {
      document.addEventListener(name, (event) => {
        const target = /** @type {Element} */ (event.target);
        if (!(target instanceof Element) || !target.localName.includes('-')) return;
        const { message = '' } = /** @type {ErrorEvent} */ (event);
        // Listens to errors, so that the figure prints no warning.
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

/** Waits until an element has its machine, and a picture where it is in sight. @param {Locator} widget */
export async function untilReady(widget) {
  await widget.evaluate(async (element) => {
    while (Reflect.get(element, 'machine') === undefined) await new Promise(requestAnimationFrame);
  });
  await frames(widget.page());
}

/**
 * Opens a page with one figure.
 *
 * @param {Page} page
 * @param {string} name of the element
 * @param {Parameters<typeof showPage>[2] & { attributes?: string }} [options]
 * @returns {Promise<Locator>} the figure, running
 */
export async function mount(page, name, { attributes = '', ...options } = {}) {
  await showPage(page, `<${name} ${attributes}></${name}>`, options);
  const widget = page.locator(name);
  await untilReady(widget);
  return widget;
}

/**
 * Takes the events of the elements since the last call.
 *
 * @param {Page} page
 * @param {string[]} [names]
 * @returns {Promise<Heard[]>}
 */
export async function takeEvents(page, names = ['load', 'input', 'change', 'error']) {
  await frames(page);
  const all = /** @type {Heard[]} */ (await page.evaluate(() => Reflect.get(window, 'heard').splice(0)));
  return all.filter(({ name }) => names.includes(name));
}

/** Returns a property of a figure. @param {Locator} widget @param {string} name */
export function property(widget, name) {
  return widget.evaluate((element, key) => Reflect.get(element, key), name);
}

/**
 * @param {Locator} widget
 * @param {string} name
 * @param {unknown} value
 * @returns {Promise<string>} error of the error event; empty if there is none
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
 * Plays a slider by its button, inside of the page, where no step is missed.
 *
 * @param {Locator} widget
 * @param {string} key of the setting in a state, and class of its group
 * @param {number} [most] steps until it is paused
 * @returns {Promise<{ values: number[], label: string }>} value at each step, and the label of the button at the first
 */
export function playSlider(widget, key, most = Infinity) {
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

/** Opens a page with a Banana Machine. @param {Page} page @param {string} [attributes] */
export async function openBanana(page, attributes = '') {
  return mount(page, 'banana-machine', { attributes });
}

/**
 * Pauses the cloud of a page's first figure of a kind after one step of growth. A test from outside of the page might be too late.
 *
 * @param {Page} page that is opened after this
 * @param {string} name of the widget
 */
export async function pauseEarly(page, name) {
  await page.addInitScript((tag) => {
    const pause = () => {
      const figure = /** @type {any} */ (document.querySelector(tag));
      const button = figure.shadowRoot.querySelector('.cloud button');
      if (!button || !figure.playing || figure.machine.shown === 0) return;
      document.removeEventListener('stats', pause);
      button.click();
    };
    document.addEventListener('stats', pause);
  }, name);
}

/** Opens every fold of a widget. @param {Locator} widget */
export async function unfold(widget) {
  await widget.evaluate(({ shadowRoot }) => {
    for (const fold of shadowRoot?.querySelectorAll('details') ?? []) fold.open ||= fold.matches('[part=fold]');
  });
  await untilUnfolded(widget);
}

/** Waits for the contents of open disclosures, which are rendered after the browser's `toggle` event. @param {Locator} widget */
export async function untilUnfolded(widget) {
  await widget.evaluate(async ({ shadowRoot }) => {
    while (shadowRoot?.querySelector('details[open] > .folded:empty')) await new Promise(requestAnimationFrame);
  });
  await frames(widget.page());
}

/** The field of a slider's value. @param {Locator} widget @param {string} key of the setting */
export function valueField(widget, key) {
  return widget.locator(`.slider:has(#${key}) .typed`);
}

/** Waits until all requested frames have been drawn. @param {Page} page */
export async function frames(page) {
  await page.evaluate(async () => {
    for (let i = 0; i < 3; i++) await new Promise(requestAnimationFrame);
  });
}

/** Returns the readings of a machine after the next frames, other than its poses, which are many. @param {Locator} widget */
export async function bananaReadings(widget) {
  await frames(widget.page());
  return widget.evaluate((element) => {
    const { config, shown, stats, table, contours } = /** @type {BananaMachineElement} */ (element).machine;
    return { config, shown, stats, table, end: [...contours.command.slice(-2)] };
  });
}

/** Returns the poses of a machine after the next frames. @param {Locator} widget @returns {Promise<number[]>} */
export async function posesOf(widget) {
  await frames(widget.page());
  return [...(await widget.evaluate((element) => /** @type {BananaMachineElement} */ (element).machine.poses))];
}

/** Sets sliders by their ids. @param {Locator} widget @param {Record<string, number>} values */
export async function setSliders(widget, values) {
  for (const [id, value] of Object.entries(values)) await widget.locator(`#${id}`).fill(String(value));
  await frames(widget.page());
}

/**
 * Drags a slider's thumb with the mouse.
 *
 * @param {Locator} slider
 * @param {number} to where the thumb is let go, as a share of the range
 */
export async function dragSlider(slider, to) {
  const page = slider.page();
  await slider.scrollIntoViewIfNeeded();
  const { x, y, width, height } = await boxOf(slider);
  const from = await slider.evaluate((element) => {
    const { value, min, max } = /** @type {HTMLInputElement} */ (element);
    return (Number(value) - Number(min)) / (Number(max) - Number(min));
  });
  // The centre of the thumb moves over the width of the input minus the width of the thumb.
  const at = (/** @type {number} */ share) => x + height * 0.3 + share * (width - height * 0.6);
  await page.mouse.move(at(from), y + height / 2);
  await page.mouse.down();
  await page.mouse.move(at((from + to) / 2), y + height / 2, { steps: 4 });
  await page.mouse.move(at(to), y + height / 2, { steps: 4 });
  await page.mouse.up();
}

/** @param {Locator} locator */
export async function boxOf(locator) {
  const box = await locator.boundingBox();
  if (!box) throw new Error('It is not on the page.');
  return box;
}

/** @param {Locator} locator */
export async function centreOf(locator) {
  const { x, y, width, height } = await boxOf(locator);
  return { x: x + width / 2, y: y + height / 2 };
}

/** Returns the pixels of a canvas as text. @param {Locator} canvas @returns {Promise<string>} */
export async function pictureOf(canvas) {
  await frames(canvas.page());
  return canvas.evaluate((element) => /** @type {HTMLCanvasElement} */ (element).toDataURL());
}

/**
 * Returns the number of pixels of a canvas that have a role's colour.
 *
 * @param {Locator} canvas
 * @param {string} role name of the custom property
 */
export async function pixelsOf(canvas, role) {
  await frames(canvas.page());
  return canvas.evaluate((element, name) => {
    const target = /** @type {HTMLCanvasElement} */ (element);
    const probe = document.createElement('span');
    // In forced colours too, the roles keep their hues.
    probe.style.cssText = `color: var(--${name}); forced-color-adjust: none`;
    target.after(probe);
    const copy = document.createElement('canvas');
    copy.width = target.width;
    copy.height = target.height;
    const context = /** @type {CanvasRenderingContext2D} */ (copy.getContext('2d', { willReadFrequently: true }));
    // Colours in any notation.
    context.fillStyle = getComputedStyle(probe).color;
    probe.remove();
    context.fillRect(0, 0, 1, 1);
    const wanted = context.getImageData(0, 0, 1, 1).data.slice(0, 3);
    context.clearRect(0, 0, 1, 1);
    context.drawImage(target, 0, 0);
    const { data } = context.getImageData(0, 0, copy.width, copy.height);
    let count = 0;
    for (let i = 0; i < data.length; i += 4) {
      const off = Math.max(...[...wanted].map((channel, k) => Math.abs(channel - data[i + k])));
      if (data[i + 3] > 250 && off < 8) count++;
    }
    return count;
  }, role);
}

/** Returns the number of a readout, without the text next to it. @param {Locator} widget @param {string | RegExp} name */
export function readout(widget, name) {
  return widget.locator('.readouts div').filter({ hasText: name }).locator('dd').first();
}

/** Returns the small print below a readout. @param {Locator} widget @param {string | RegExp} name */
export function readoutDetail(widget, name) {
  return widget.locator('.readouts div').filter({ hasText: name }).locator('dd.detail');
}

/**
 * The page, with its widget running and everything open that is folded away.
 *
 * @param {Page} page
 * @param {string} [attributes]
 * @returns {Promise<Locator>} the widget
 */
export async function openUnfoldedBanana(page, attributes = '') {
  const widget = await openBanana(page, attributes);
  await unfold(widget);
  await page.evaluate(() => scrollTo(0, 0));
  await frames(page);
  return widget;
}

/** @param {number} count @returns {string} as the widget prints it, rounded */
export const printedCount = (count) => String(Math.round(count)).replace(/\B(?=(\d{3})+$)/g, '\u202f');

/** Returns a number that a widget prints. @param {string | null} text */
export function numberIn(text) {
  const [mantissa, power = '0'] = (text ?? '').replace('\u2212', '-').replace(/[\u202f%]/g, '').split('·10');
  const exponent = power.replace('⁻', '-').replace(/[⁰¹²³⁴⁵⁶⁷⁸⁹]/g, (digit) => String('⁰¹²³⁴⁵⁶⁷⁸⁹'.indexOf(digit)));
  return Number(mantissa) * 10 ** Number(exponent);
}

/** Waits until all is calculated and shown. @param {Locator} widget */
export async function untilSettled(widget) {
  await widget.evaluate((element) => /** @type {AnyElement} */ (element).settled);
  await frames(widget.page());
}
