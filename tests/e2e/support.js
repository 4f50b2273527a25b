/**
 * Helpers of the browser tests: the test function, test pages, results of a simulation, and actions on controls.
 *
 * @module
 */

import { expect, test as playwrightTest } from '@playwright/test';
import { ALL_NAMES, CLOUD_NAMES, NAMES_WITH_HANDLES, figureNameFor } from './figures.js';

/**
 * @typedef {import('@playwright/test').Page} Page
 * @typedef {import('@playwright/test').Locator} Locator
 * @typedef {import('../../www/types.d.ts').BananaMachine} BananaMachine
 * @typedef {import('../../www/types.d.ts').Motion} Motion
 * @typedef {import('./figures.js').Name} Name
 * @typedef {import('../../www/types.d.ts').FigureElement<any, any> & import('../../www/types.d.ts').BananaMachineElement & { simulation: any, motion: any }} AnyElement
 * @typedef {{ name: string, target: string, message: string }} FiredEvent
 * @typedef {HTMLElement & { simulation: BananaMachine, motion: Motion }} BananaMachineElement
 */

/**
 * Fixtures. The first three are names of the element on which a test about all figures, all clouds or all handles runs; the test's title
 * decides. With the last one, the page behaves as if the user had seen the introduction that a figure shows on the first visit.
 *
 * @typedef {{ figureName: Name, cloudFigureName: Name, handleFigureName: Name, isIntroductionSkipped: boolean }} FigureFixtures
 */

/**
 * Test that fails on any warning or error in the console.
 *
 * @type {import('@playwright/test').TestType<import('@playwright/test').PlaywrightTestArgs & import('@playwright/test').PlaywrightTestOptions & FigureFixtures, import('@playwright/test').PlaywrightWorkerArgs & import('@playwright/test').PlaywrightWorkerOptions>}
 */
export const test = playwrightTest.extend({
  /* oxlint-disable no-empty-pattern */
  figureName: async ({}, use, { title }) => use(figureNameFor(title)),
  cloudFigureName: async ({}, use, { title }) => use(figureNameFor(title, CLOUD_NAMES)),
  handleFigureName: async ({}, use, { title }) => use(figureNameFor(title, NAMES_WITH_HANDLES)),
  /* oxlint-enable no-empty-pattern */
  isIntroductionSkipped: [true, { option: true }],
  page: async ({ page, isIntroductionSkipped }, use) => {
    if (isIntroductionSkipped) await page.addInitScript(skipIntroduction);
    /** @type {string[]} */
    const consoleMessages = [];
    page.on('console', (message) => {
      if (['error', 'warning'].includes(message.type())) consoleMessages.push(message.text());
    });
    page.on('pageerror', (error) => consoleMessages.push(String(error)));
    await use(page);
    expect(consoleMessages).toEqual([]);
  },
});

/**
 * Declares a test about all figures. Daily tests run it with one figure, chosen by the title. Nightly tests run it with each figure.
 *
 * @param {string} title
 * @param {(page: Page, name: Name, isFull: boolean) => Promise<void>} testBody body of the test; `isFull` is true in nightly tests
 * @param {{ tag?: string }} [details]
 */
export function testEach(title, testBody, details = {}) {
  test(title, details, ({ page, figureName }) => testBody(page, figureName, false));
  for (const name of ALL_NAMES) {
    test(`${title}: ${name} @nightly`, details, ({ page }) => {
      test.slow();
      return testBody(page, name, true);
    });
  }
}

/** Marks the introduction of a figure as seen. It runs in the page before the page's scripts. */
function skipIntroduction() {
  try {
    sessionStorage.setItem('motion-widgets.introduced', 'yes');
  } catch {
    // On a page without storage a figure shows no introduction.
  }
}

/** Tag of tests of a first visit or of the browser history. They get a new page, see playwright.config.js. */
export const NEW_PAGE_TAG = { tag: '@fresh' };

/** Options of tests that need a complete cloud. With reduced motion a cloud is complete at once. */
export const REDUCED_MOTION = { contextOptions: { reducedMotion: /** @type {const} */ ('reduce') } };

/**
 * Opens a page with a body, and records the events of its elements.
 *
 * @param {Page} page
 * @param {string} body
 * @param {{ head?: string, fragment?: string, script?: string }} [options]
 */
export async function showPage(page, body, { head = '', fragment = '', script = '<script type="module" src="/motion-widgets.js"></script>' } = {}) {
  await page.addInitScript(() => {
    const firedEvents = /** @type {FiredEvent[]} */ ([]);
    Object.assign(window, { heard: firedEvents });
    for (const name of ['load', 'input', 'change', 'stats', 'error']) {
      document.addEventListener(name, (event) => {
        const target = /** @type {Element} */ (event.target);
        if (!(target instanceof Element) || !target.localName.includes('-')) return;
        const { message = '' } = /** @type {ErrorEvent} */ (event);
        // With a listener that handles errors, the figure prints no warning.
        event.preventDefault();
        firedEvents.push({ name, target: target.localName, message });
        // Error events do not bubble.
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

/** Waits until an element has its simulation, and has drawn its picture if it is visible. @param {Locator} widget */
export async function waitUntilReady(widget) {
  await widget.evaluate(async (element) => {
    while (Reflect.get(element, 'simulation') === undefined) await new Promise(requestAnimationFrame);
  });
  await waitForFrames(widget.page());
}

/**
 * Opens a page with one figure.
 *
 * @param {Page} page
 * @param {string} name of the element
 * @param {Parameters<typeof showPage>[2] & { attributes?: string }} [options]
 * @returns {Promise<Locator>} the figure, running
 */
export async function mountFigure(page, name, { attributes = '', ...options } = {}) {
  await showPage(page, `<${name} ${attributes}></${name}>`, options);
  const widget = page.locator(name);
  await waitUntilReady(widget);
  return widget;
}

/** Takes the events of the elements since the last call. @param {Page} page @param {string[]} [names] */
export async function takeEvents(page, names = ['load', 'input', 'change', 'error']) {
  await waitForFrames(page);
  const takenEvents = /** @type {FiredEvent[]} */ (await page.evaluate(() => Reflect.get(window, 'heard').splice(0)));
  return takenEvents.filter(({ name }) => names.includes(name));
}

/** Returns a property of a figure. @param {Locator} widget @param {string} name */
export function readProperty(widget, name) {
  return widget.evaluate((element, key) => Reflect.get(element, key), name);
}

/**
 * Sets a property of a figure.
 *
 * @param {Locator} widget
 * @param {string} name
 * @param {unknown} value
 * @returns {Promise<string>} error of the error event; empty if there is none
 */
export function setProperty(widget, name, value) {
  return widget.evaluate(
    (element, [key, newValue]) => {
      let errorText = '';
      const recordError = (/** @type {Event} */ event) => void (errorText = String(/** @type {ErrorEvent} */ (event).error));
      element.addEventListener('error', recordError);
      Reflect.set(element, /** @type {string} */ (key), newValue);
      element.removeEventListener('error', recordError);
      return errorText;
    },
    [name, value],
  );
}

/**
 * Plays a slider by its button. The code runs in the page, where it misses no step.
 *
 * @param {Locator} widget
 * @param {string} key of the setting in a state, and class of its group
 * @param {number} [maxSteps] steps until it is paused
 * @returns {Promise<{ sliderValues: number[], buttonLabel: string }>} value at each step, and the label of the button at the first
 */
export function playSlider(widget, key, maxSteps = Infinity) {
  return widget.evaluate(
    (element, [key, maxSteps]) =>
      new Promise((resolve) => {
        const figure = /** @type {AnyElement} */ (element);
        const playButton = /** @type {HTMLButtonElement} */ (figure.shadowRoot?.querySelector(`.${key} button`));
        const sliderValues = /** @type {number[]} */ ([]);
        let buttonLabel = '';
        const recordStep = async () => {
          sliderValues.push(/** @type {any} */ (figure.getState())[key]);
          if (sliderValues.length === 1) {
            await /** @type {any} */ (figure).updateComplete;
            buttonLabel = playButton.innerText;
          }
          if (sliderValues.length === maxSteps) playButton.click();
        };
        figure.addEventListener('input', recordStep);
        figure.addEventListener('change', () => {
          figure.removeEventListener('input', recordStep);
          resolve({ sliderValues, buttonLabel });
        }, { once: true });
        playButton.click();
      }),
    /** @type {const} */ ([key, maxSteps]),
  );
}

/** Returns the state of a figure. @param {Locator} widget */
export function readState(widget) {
  return widget.evaluate((element) => /** @type {AnyElement} */ (element).getState());
}

/** Holds requests of a page until the returned function is called. @param {Page} page @param {string} addressPattern */
export async function holdRequests(page, addressPattern) {
  let allowRequests = () => {};
  const permissionPromise = new Promise((resolve) => (allowRequests = () => resolve(undefined)));
  await page.route(addressPattern, async (route) => {
    await permissionPromise;
    await route.continue();
  });
  return allowRequests;
}

/** Opens a page with a Banana Machine. @param {Page} page @param {string} [attributes] */
export async function openBanana(page, attributes = '') {
  return mountFigure(page, 'banana-machine', { attributes });
}

/**
 * Pauses the first figure with this name after one step of its cloud's growth. The code runs in the page, because a test could be too late.
 *
 * @param {Page} page which is opened later
 * @param {string} name of the widget
 */
export async function pauseEarly(page, name) {
  await page.addInitScript((tag) => {
    const pauseAnimation = () => {
      const figure = /** @type {any} */ (document.querySelector(tag));
      const playButton = figure.shadowRoot.querySelector('.cloud button');
      if (!playButton || !figure.playing || figure.simulation.shown === 0) return;
      document.removeEventListener('stats', pauseAnimation);
      playButton.click();
    };
    document.addEventListener('stats', pauseAnimation);
  }, name);
}

/** Opens every disclosure of a widget. @param {Locator} widget */
export async function openDisclosures(widget) {
  await widget.evaluate(async ({ shadowRoot }) => {
    for (const disclosure of shadowRoot?.querySelectorAll('details') ?? []) disclosure.open ||= disclosure.matches('[part=fold]');
    // Contents are rendered after the browser's `toggle` event.
    while (shadowRoot?.querySelector('details[open] > .folded:empty')) await new Promise(requestAnimationFrame);
  });
  await waitForFrames(widget.page());
}

/** Returns the text field of a slider's value. @param {Locator} widget @param {string} key of the setting */
export function valueField(widget, key) {
  return widget.locator(`.slider:has(#${key}) .typed`);
}

/** Waits until all requested frames have been drawn. @param {Page} page */
export async function waitForFrames(page) {
  await page.evaluate(async () => {
    for (let i = 0; i < 3; i++) await new Promise(requestAnimationFrame);
  });
}

/** Returns results of a Banana Machine after the next frames, without its many poses. @param {Locator} widget */
export async function readBananaResults(widget) {
  await waitForFrames(widget.page());
  return widget.evaluate((element) => {
    const { config, shown, stats, table, contours } = /** @type {BananaMachineElement} */ (element).simulation;
    return { config, shown, stats, table, end: [...contours.command.slice(-2)] };
  });
}

/** Returns the poses of a simulation after the next frames. @param {Locator} widget @returns {Promise<number[]>} */
export async function readPoses(widget) {
  await waitForFrames(widget.page());
  return [...(await widget.evaluate((element) => /** @type {BananaMachineElement} */ (element).simulation.poses))];
}

/** Sets sliders by their ids. @param {Locator} widget @param {Record<string, number>} values */
export async function setSliders(widget, values) {
  for (const [id, value] of Object.entries(values)) await widget.locator(`#${id}`).fill(String(value));
  await waitForFrames(widget.page());
}

/**
 * Drags a slider's thumb with the mouse.
 *
 * @param {Locator} slider
 * @param {number} endShare position at which the thumb is released, as a fraction of the range
 */
export async function dragSlider(slider, endShare) {
  const page = slider.page();
  await slider.scrollIntoViewIfNeeded();
  const { x, y, width, height } = await readBox(slider);
  const startShare = await slider.evaluate((element) => {
    const { value, min, max } = /** @type {HTMLInputElement} */ (element);
    return (Number(value) - Number(min)) / (Number(max) - Number(min));
  });
  // The centre of the thumb moves over the width of the input minus the width of the thumb.
  const xAtShare = (/** @type {number} */ share) => x + height * 0.3 + share * (width - height * 0.6);
  await page.mouse.move(xAtShare(startShare), y + height / 2);
  await page.mouse.down();
  await page.mouse.move(xAtShare((startShare + endShare) / 2), y + height / 2, { steps: 4 });
  await page.mouse.move(xAtShare(endShare), y + height / 2, { steps: 4 });
  await page.mouse.up();
}

/** Returns the bounding box of an element. @param {Locator} locator */
export async function readBox(locator) {
  const box = await locator.boundingBox();
  if (!box) throw new Error('It is not on the page.');
  return box;
}

/** Returns the centre of an element. @param {Locator} locator */
export async function readCentre(locator) {
  const { x, y, width, height } = await readBox(locator);
  return { x: x + width / 2, y: y + height / 2 };
}

/** Returns the pixels of a canvas as text. @param {Locator} canvas @returns {Promise<string>} */
export async function readPicture(canvas) {
  await waitForFrames(canvas.page());
  return canvas.evaluate((element) => /** @type {HTMLCanvasElement} */ (element).toDataURL());
}

/**
 * Returns the colours of roles on a figure, or on a part of it.
 *
 * @param {Locator} part
 * @param {string[]} roles names of custom properties
 * @returns {Promise<number[][]>} red, green, blue, 0 to 255
 */
export async function readColours(part, roles) {
  await waitForFrames(part.page());
  return part.evaluate((element, names) => {
    const context = /** @type {OffscreenCanvasRenderingContext2D} */ (new OffscreenCanvas(1, 1).getContext('2d', { willReadFrequently: true }));
    return names.map((name) => {
      const colourSwatch = document.createElement('span');
      // The figures keep the hues of their colour roles in forced colours. Without this property the swatch would not.
      colourSwatch.style.cssText = `color: var(--${name}); forced-color-adjust: none`;
      (element.shadowRoot?.querySelector('.surface') ?? element).append(colourSwatch);
      // The canvas converts colours of any notation to numbers.
      context.fillStyle = getComputedStyle(colourSwatch).color;
      colourSwatch.remove();
      context.fillRect(0, 0, 1, 1);
      return [...context.getImageData(0, 0, 1, 1).data.slice(0, 3)];
    });
  }, roles);
}

/** Returns the number of pixels of a canvas that have a role's colour. @param {Locator} canvas @param {string} role */
export async function countPixelsOfRole(canvas, role) {
  const [roleColour] = await readColours(canvas, [role]);
  return canvas.evaluate((element, colour) => {
    const { width, height } = /** @type {HTMLCanvasElement} */ (element);
    const context = /** @type {OffscreenCanvasRenderingContext2D} */ (new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true }));
    context.drawImage(/** @type {HTMLCanvasElement} */ (element), 0, 0);
    const { data } = context.getImageData(0, 0, width, height);
    let pixelCount = 0;
    for (let i = 0; i < data.length; i += 4) {
      const channelDifference = Math.max(...colour.map((channel, k) => Math.abs(channel - data[i + k])));
      if (data[i + 3] > 250 && channelDifference < 8) pixelCount++;
    }
    return pixelCount;
  }, roleColour);
}

/** Returns the element with the value of a readout, without its detail. @param {Locator} widget @param {string | RegExp} name */
export function readoutValue(widget, name) {
  return widget.locator('.readouts div').filter({ hasText: name }).locator('dd').first();
}

/** Returns the line of detail below a readout. @param {Locator} widget @param {string | RegExp} name */
export function readoutDetail(widget, name) {
  return widget.locator('.readouts div').filter({ hasText: name }).locator('dd.detail');
}

/** Drops files on a part of the widget. @param {Locator} part @param {{ name: string, buffer: Buffer }[]} files */
export function dropFiles(part, files) {
  return part.evaluate(
    (target, newFiles) => {
      const dataTransfer = new DataTransfer();
      for (const { name, bytes } of newFiles) dataTransfer.items.add(new File([new Uint8Array(bytes)], name));
      const dragEvent = (/** @type {string} */ name) => new DragEvent(name, { dataTransfer, bubbles: true, composed: true, cancelable: true });
      const [overEvent, dropEvent] = [dragEvent('dragover'), dragEvent('drop')];
      target.dispatchEvent(overEvent);
      if (!overEvent.defaultPrevented || !target.closest('.dropping')) throw new Error('It does not take files.');
      target.dispatchEvent(dropEvent);
      if (!dropEvent.defaultPrevented) throw new Error('The browser takes the file.');
      if (target.closest('.dropping')) throw new Error('It is still marked.');
    },
    files.map(({ name, buffer }) => ({ name, bytes: [...buffer] })),
  );
}

/** Opens a page with a running Banana Machine, with all disclosures open. @param {Page} page @param {string} [attributes] */
export async function openBananaWithDisclosures(page, attributes = '') {
  const widget = await openBanana(page, attributes);
  await openDisclosures(widget);
  await page.evaluate(() => scrollTo(0, 0));
  await waitForFrames(page);
  return widget;
}

/** Parses a number in the notation of the widgets. @param {string | null} text */
export function parseNumberIn(text) {
  const [mantissa, power = '0'] = (text ?? '').replace('\u2212', '-').replace(/[\u202f%]/g, '').split('·10');
  const exponent = power.replace('⁻', '-').replace(/[⁰¹²³⁴⁵⁶⁷⁸⁹]/g, (digit) => String('⁰¹²³⁴⁵⁶⁷⁸⁹'.indexOf(digit)));
  return Number(mantissa) * 10 ** Number(exponent);
}

/** Waits until a figure has computed and drawn everything. @param {Locator} widget */
export async function waitUntilSettled(widget) {
  await widget.evaluate((element) => /** @type {AnyElement} */ (element).settled);
  await waitForFrames(widget.page());
}
