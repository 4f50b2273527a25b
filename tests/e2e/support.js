// Helpers of the browser tests: the test function, test pages, results of a simulation, and actions on controls.

import { expect, test as playwrightTest } from '@playwright/test';
import { ALL_FIGURE_NAMES, CLOUD_FIGURE_NAMES, HANDLE_FIGURE_NAMES, chooseFigureName } from './figures.js';

/**
 * @import { Locator, Page } from '@playwright/test'
 * @typedef {import('../../www/types.d.ts').BananaMachine} BananaMachine
 * @typedef {import('../../www/types.d.ts').Motion} Motion
 * @typedef {import('./figures.js').Name} Name
 * @typedef {import('../../www/types.d.ts').FigureElement<any, any> & import('../../www/types.d.ts').BananaMachineElement & { simulation: any, motion: any }} AnyElement
 * @typedef {{ name: string, target: string, message: string }} FiredEvent
 * @typedef {HTMLElement & { simulation: BananaMachine, motion: Motion }} BananaMachineElement
 */

/**
 * Fixtures. The first three fixtures are names of elements, for tests of the common behaviour of all figures, clouds or handles. The title
 * of the test selects the element. The last fixture marks the introduction of a figure as seen.
 *
 * @typedef {{ figureName: Name, cloudFigureName: Name, handleFigureName: Name, isIntroductionSkipped: boolean }} FigureFixtures
 */

/**
 * Playwright's test function, extended by the fixtures, and by a failure on any warning or error in the console.
 *
 * @type {import('@playwright/test').TestType<import('@playwright/test').PlaywrightTestArgs & import('@playwright/test').PlaywrightTestOptions & FigureFixtures, import('@playwright/test').PlaywrightWorkerArgs & import('@playwright/test').PlaywrightWorkerOptions>}
 */
export const test = playwrightTest.extend({
  /* oxlint-disable no-empty-pattern */
  figureName: async ({}, useFixture, { title }) => useFixture(chooseFigureName(title)),
  cloudFigureName: async ({}, useFixture, { title }) => useFixture(chooseFigureName(title, CLOUD_FIGURE_NAMES)),
  handleFigureName: async ({}, useFixture, { title }) => useFixture(chooseFigureName(title, HANDLE_FIGURE_NAMES)),
  /* oxlint-enable no-empty-pattern */
  isIntroductionSkipped: [true, { option: true }],
  page: async ({ page, isIntroductionSkipped }, useFixture) => {
    if (isIntroductionSkipped) await page.addInitScript(skipIntroduction);
    /** @type {string[]} */
    const consoleMessages = [];
    page.on('console', (consoleMessage) => {
      if (['error', 'warning'].includes(consoleMessage.type())) consoleMessages.push(consoleMessage.text());
    });
    page.on('pageerror', (pageError) => consoleMessages.push(String(pageError)));
    await useFixture(page);
    expect(consoleMessages).toEqual([]);
  },
});

/**
 * Declares a test of behaviour that all figures share. Daily it runs with one figure, chosen by the title, and nightly with each figure.
 *
 * @param {string} testTitle
 * @param {(page: Page, name: Name, isNightly: boolean) => Promise<void>} testBody body of the test; `isNightly` is true in nightly tests
 * @param {{ tag?: string }} [testDetails]
 */
export function testEach(testTitle, testBody, testDetails = {}) {
  test(testTitle, testDetails, ({ page, figureName }) => testBody(page, figureName, false));
  for (const figureName of ALL_FIGURE_NAMES) {
    test(`${testTitle}: ${figureName} @nightly`, testDetails, ({ page }) => {
      test.slow();
      return testBody(page, figureName, true);
    });
  }
}

/** Marks the introduction of a figure as seen. This function runs in the page before the page's scripts. */
function skipIntroduction() {
  try {
    sessionStorage.setItem('motion-widgets.introduced', 'yes');
  } catch {
    // A page without storage shows no introduction of a figure.
  }
}

/** Tag of tests of a first visit or of the browser history. Each of these tests gets a new page, see playwright.config.js. */
export const NEW_PAGE_TAG = { tag: '@fresh' };

/** Options of tests that need a complete cloud. With reduced motion a cloud is complete immediately. */
export const REDUCED_MOTION = { contextOptions: { reducedMotion: /** @type {const} */ ('reduce') } };

/**
 * Opens a page with a body, and records the events of its elements.
 *
 * @param {Page} page
 * @param {string} bodyHtml
 * @param {{ headHtml?: string, urlFragment?: string, scriptHtml?: string }} [options]
 */
export async function showPage(page, bodyHtml, { headHtml = '', urlFragment = '', scriptHtml = '<script type="module" src="/motion-widgets.js"></script>' } = {}) {
  await page.addInitScript(() => {
    const firedEvents = /** @type {FiredEvent[]} */ ([]);
    Object.assign(window, { firedEvents });
    for (const eventName of ['load', 'input', 'change', 'stats', 'error']) {
      document.addEventListener(eventName, (figureEvent) => {
        const figureElement = /** @type {Element} */ (figureEvent.target);
        if (!(figureElement instanceof Element) || !figureElement.localName.includes('-')) return;
        const { message: errorMessage = '' } = /** @type {ErrorEvent} */ (figureEvent);
        // If a listener handles errors, the figure prints no warning.
        figureEvent.preventDefault();
        firedEvents.push({ name: eventName, target: figureElement.localName, message: errorMessage });
        // Error events do not bubble. Only a capturing listener receives them here.
      }, { capture: eventName === 'error' });
    }
  });
  await page.route('**/bare.html', (route) =>
    route.fulfill({
      contentType: 'text/html',
      body: `<!doctype html><html lang="en"><head><meta charset="utf-8"><title>Bare</title><link rel="icon" href="data:,">${headHtml}${scriptHtml}</head><body>${bodyHtml}</body></html>`,
    }),
  );
  await page.goto(`/bare.html${urlFragment}`);
}

/** Waits until an element has its simulation. If the element is visible, waits until it has drawn its picture. @param {Locator} widget */
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
 * @param {string} figureName
 * @param {Parameters<typeof showPage>[2] & { attributes?: string }} [options]
 * @returns {Promise<Locator>} the figure, running
 */
export async function mountFigure(page, figureName, { attributes = '', ...pageOptions } = {}) {
  await showPage(page, `<${figureName} ${attributes}></${figureName}>`, pageOptions);
  const widget = page.locator(figureName);
  await waitUntilReady(widget);
  return widget;
}

/** Returns the events of the elements since the last call, and forgets them. @param {Page} page @param {string[]} [eventNames] */
export async function takeEvents(page, eventNames = ['load', 'input', 'change', 'error']) {
  await waitForFrames(page);
  const takenEvents = /** @type {FiredEvent[]} */ (await page.evaluate(() => Reflect.get(window, 'firedEvents').splice(0)));
  return takenEvents.filter(({ name }) => eventNames.includes(name));
}

/** Returns a property of a figure. @param {Locator} widget @param {string} name */
export function readProperty(widget, name) {
  return widget.evaluate((element, propertyName) => Reflect.get(element, propertyName), name);
}

/**
 * Sets a property of a figure.
 *
 * @param {Locator} widget
 * @param {string} name
 * @param {unknown} propertyValue
 * @returns {Promise<string>} error of the error event; empty if there is none
 */
export function setProperty(widget, name, propertyValue) {
  return widget.evaluate(
    (element, [propertyName, newValue]) => {
      let errorText = '';
      const recordError = (/** @type {Event} */ event) => void (errorText = String(/** @type {ErrorEvent} */ (event).error));
      element.addEventListener('error', recordError);
      Reflect.set(element, /** @type {string} */ (propertyName), newValue);
      element.removeEventListener('error', recordError);
      return errorText;
    },
    [name, propertyValue],
  );
}

/**
 * Plays a slider by its button. The code runs in the page, where no step can be missed.
 *
 * @param {Locator} widget
 * @param {string} settingKey key of the setting in a state, and class of its group
 * @param {number} [maxSteps] steps until it is paused
 * @returns {Promise<{ sliderValues: number[], buttonLabel: string }>} value at each step, and the label of the button at the first step
 */
export function playSliderOf(widget, settingKey, maxSteps = Infinity) {
  return widget.evaluate(
    (element, [settingKey, maxSteps]) =>
      new Promise((resolve) => {
        const figureElement = /** @type {AnyElement} */ (element);
        const playButton = /** @type {HTMLButtonElement} */ (figureElement.shadowRoot?.querySelector(`.${settingKey} button`));
        const sliderValues = /** @type {number[]} */ ([]);
        let buttonLabel = '';
        const recordSliderValue = async () => {
          sliderValues.push(/** @type {any} */ (figureElement.getState())[settingKey]);
          if (sliderValues.length === 1) {
            await /** @type {any} */ (figureElement).updateComplete;
            buttonLabel = playButton.innerText;
          }
          if (sliderValues.length === maxSteps) playButton.click();
        };
        figureElement.addEventListener('input', recordSliderValue);
        figureElement.addEventListener('change', () => {
          figureElement.removeEventListener('input', recordSliderValue);
          resolve({ sliderValues, buttonLabel });
        }, { once: true });
        playButton.click();
      }),
    /** @type {const} */ ([settingKey, maxSteps]),
  );
}

/** Returns the state of a figure. @param {Locator} widget */
export function readState(widget) {
  return widget.evaluate((element) => /** @type {AnyElement} */ (element).getState());
}

/** Holds requests of a page until the returned function is called. @param {Page} page @param {string} addressPattern */
export async function holdBackRequests(page, addressPattern) {
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
 * Pauses the first figure with this name after one step of its cloud's growth. The code runs in the page, because a call from the test
 * could come too late.
 *
 * @param {Page} page page that is opened later
 * @param {string} name of the widget
 */
export async function pauseAfterFirstStep(page, name) {
  await page.addInitScript((tag) => {
    const pauseAnimation = () => {
      const figureElement = /** @type {any} */ (document.querySelector(tag));
      const playButton = figureElement.shadowRoot.querySelector('.cloud button');
      if (!playButton || !figureElement.playing || figureElement.simulation.shown === 0) return;
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
    // A disclosure renders its contents after the browser's `toggle` event.
    while (shadowRoot?.querySelector('details[open] > .folded:empty')) await new Promise(requestAnimationFrame);
  });
  await waitForFrames(widget.page());
}

/** Returns the printed value of a slider. @param {Locator} widget @param {string} settingKey */
export const printedValueOf = (widget, settingKey) => widget.locator(`.slider:has(#${settingKey}) .value`);

/** Returns the field of a slider's value. @param {Locator} widget @param {string} settingKey */
export const valueFieldOf = (widget, settingKey) => printedValueOf(widget, settingKey).locator('input');

/** Waits until all requested animation frames have been drawn. @param {Page} page */
export async function waitForFrames(page) {
  await page.evaluate(async () => {
    for (let i = 0; i < 3; i++) await new Promise(requestAnimationFrame);
  });
}

/** Waits for all requested animation frames, and returns the results of a Banana Machine without its poses. @param {Locator} widget */
export async function readBananaResults(widget) {
  await waitForFrames(widget.page());
  return widget.evaluate((element) => {
    const { config: figureConfig, shown: shownCount, stats, table: resultTable, contours } = /** @type {BananaMachineElement} */ (element).simulation;
    return { config: figureConfig, shown: shownCount, stats, table: resultTable, end: [...contours.command.slice(-2)] };
  });
}

/** Waits for all requested animation frames, and returns the poses of a simulation. @param {Locator} widget @returns {Promise<number[]>} */
export async function readPoses(widget) {
  await waitForFrames(widget.page());
  return [...(await widget.evaluate((element) => /** @type {BananaMachineElement} */ (element).simulation.poses))];
}

/** Sets sliders, given by their ids. @param {Locator} widget @param {Record<string, number>} valuesById */
export async function setSliders(widget, valuesById) {
  for (const [sliderId, sliderValue] of Object.entries(valuesById)) await widget.locator(`#${sliderId}`).fill(String(sliderValue));
  await waitForFrames(widget.page());
}

/**
 * Drags a slider's thumb with the mouse.
 *
 * @param {Locator} sliderLocator
 * @param {number} endShare position at which the thumb is released, as a fraction of the range
 */
export async function dragSlider(sliderLocator, endShare) {
  const page = sliderLocator.page();
  await sliderLocator.scrollIntoViewIfNeeded();
  const { x, y, width, height } = await readBox(sliderLocator);
  const startShare = await sliderLocator.evaluate((element) => {
    const { value, min: minValue, max: maxValue } = /** @type {HTMLInputElement} */ (element);
    return (Number(value) - Number(minValue)) / (Number(maxValue) - Number(minValue));
  });
  // The centre of the thumb moves over the width of the input, less the width of the thumb.
  const thumbXOf = (/** @type {number} */ widthShare) => x + height * 0.3 + widthShare * (width - height * 0.6);
  await page.mouse.move(thumbXOf(startShare), y + height / 2);
  await page.mouse.down();
  await page.mouse.move(thumbXOf((startShare + endShare) / 2), y + height / 2, { steps: 4 });
  await page.mouse.move(thumbXOf(endShare), y + height / 2, { steps: 4 });
  await page.mouse.up();
}

/** Returns the bounding box of an element. @param {Locator} boxLocator */
export async function readBox(boxLocator) {
  const boundingBox = await boxLocator.boundingBox();
  if (!boundingBox) throw new Error('It is not on the page.');
  return boundingBox;
}

/** Returns the centre of an element. @param {Locator} boxLocator */
export async function readCentre(boxLocator) {
  const { x, y, width, height } = await readBox(boxLocator);
  return { x: x + width / 2, y: y + height / 2 };
}

/** Returns the pixels of a canvas as text. @param {Locator} canvasLocator @returns {Promise<string>} */
export async function readPicture(canvasLocator) {
  await waitForFrames(canvasLocator.page());
  return canvasLocator.evaluate((element) => /** @type {HTMLCanvasElement} */ (element).toDataURL());
}

/**
 * Returns the colours that custom properties (CSS variables) have on a figure, or on a part of it.
 *
 * @param {Locator} coloredPart
 * @param {string[]} colorRoles names of custom properties
 * @returns {Promise<number[][]>} red, green, blue, 0 to 255
 */
export async function readColours(coloredPart, colorRoles) {
  await waitForFrames(coloredPart.page());
  return coloredPart.evaluate((element, roleNames) => {
    const colorContext = /** @type {OffscreenCanvasRenderingContext2D} */ (new OffscreenCanvas(1, 1).getContext('2d', { willReadFrequently: true }));
    return roleNames.map((name) => {
      const colourSwatch = document.createElement('span');
      // In forced colours, figures keep their own colours. The swatch keeps them only with `forced-color-adjust: none`.
      colourSwatch.style.cssText = `color: var(--${name}); forced-color-adjust: none`;
      (element.shadowRoot?.querySelector('.surface') ?? element).append(colourSwatch);
      // The canvas converts a colour of any notation to numbers.
      colorContext.fillStyle = getComputedStyle(colourSwatch).color;
      colourSwatch.remove();
      colorContext.fillRect(0, 0, 1, 1);
      return [...colorContext.getImageData(0, 0, 1, 1).data.slice(0, 3)];
    });
  }, colorRoles);
}

/** Returns the number of a canvas's pixels in the colour of a custom property. @param {Locator} canvasLocator @param {string} colorRole */
export async function countPixelsOfRole(canvasLocator, colorRole) {
  const [roleColour] = await readColours(canvasLocator, [colorRole]);
  return canvasLocator.evaluate((element, roleColour) => {
    const { width, height } = /** @type {HTMLCanvasElement} */ (element);
    const pixelContext = /** @type {OffscreenCanvasRenderingContext2D} */ (new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true }));
    pixelContext.drawImage(/** @type {HTMLCanvasElement} */ (element), 0, 0);
    const { data } = pixelContext.getImageData(0, 0, width, height);
    let pixelCount = 0;
    for (let i = 0; i < data.length; i += 4) {
      const channelDifference = Math.max(...roleColour.map((channelValue, k) => Math.abs(channelValue - data[i + k])));
      if (data[i + 3] > 250 && channelDifference < 8) pixelCount++;
    }
    return pixelCount;
  }, roleColour);
}

/** Returns the element with the value of a readout. The element does not contain the line of detail. @param {Locator} widget @param {string | RegExp} name */
export function readoutValueOf(widget, name) {
  return widget.locator('.readouts div').filter({ hasText: name }).locator('dd').first();
}

/** Returns the line of detail below a readout. @param {Locator} widget @param {string | RegExp} name */
export function readoutDetailOf(widget, name) {
  return widget.locator('.readouts div').filter({ hasText: name }).locator('dd.detail');
}

/** Drops files on a part of the widget. @param {Locator} dropTarget @param {{ name: string, buffer: Buffer }[]} droppedFiles */
export function dropFiles(dropTarget, droppedFiles) {
  return dropTarget.evaluate(
    (dropTarget, newFiles) => {
      const dataTransfer = new DataTransfer();
      for (const { name, bytes } of newFiles) dataTransfer.items.add(new File([new Uint8Array(bytes)], name));
      const dragEvent = (/** @type {string} */ name) => new DragEvent(name, { dataTransfer, bubbles: true, composed: true, cancelable: true });
      const [dragOverEvent, dropEvent] = [dragEvent('dragover'), dragEvent('drop')];
      dropTarget.dispatchEvent(dragOverEvent);
      if (!dragOverEvent.defaultPrevented || !dropTarget.closest('.dropping')) throw new Error('It does not take files.');
      dropTarget.dispatchEvent(dropEvent);
      if (!dropEvent.defaultPrevented) throw new Error('The browser takes the file.');
      if (dropTarget.closest('.dropping')) throw new Error('It is still marked.');
    },
    droppedFiles.map(({ name, buffer: fileBuffer }) => ({ name, bytes: [...fileBuffer] })),
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

/** Parses a number in the notation of the figures. @param {string | null} numberText */
export function parseNumberIn(numberText) {
  const [mantissaText, powerText = '0'] = (numberText ?? '').replace('\u2212', '-').replace(/[\u202f%]/g, '').split('·10');
  const exponentText = powerText.replace('⁻', '-').replace(/[⁰¹²³⁴⁵⁶⁷⁸⁹]/g, (digit) => String('⁰¹²³⁴⁵⁶⁷⁸⁹'.indexOf(digit)));
  return Number(mantissaText) * 10 ** Number(exponentText);
}

/** Waits until a figure has computed and drawn all its results. @param {Locator} widget */
export async function waitUntilSettled(widget) {
  await widget.evaluate((element) => /** @type {AnyElement} */ (element).settled);
  await waitForFrames(widget.page());
}
