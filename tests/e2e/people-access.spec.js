import { expect } from '@playwright/test';
import { expectAccessible } from './axe.js';
import { FIGURE_FACTS } from './figures.js';
import { REDUCED_MOTION, readBananaResults, readBox, readCentre, waitForFrames, mountFigure, openBanana, readPicture, countPixelsOfRole, printedValueOf, showPage, readState, test, testEach, openDisclosures, waitUntilReady } from './support.js';

/** @import { Locator, Page } from '@playwright/test' */

test.use(REDUCED_MOTION);

/**
 * Opens a page with a figure, with all disclosures open.
 *
 * @param {Page} page
 * @param {string} figureName
 * @param {{ attributes?: string, htmlBefore?: string, htmlAfter?: string }} [options]
 */
async function openWithDisclosures(page, figureName, { attributes = '', htmlBefore = '', htmlAfter = '' } = {}) {
  await showPage(page, `<main><h1>Bare</h1>${htmlBefore}<${figureName} heading-level="2" ${attributes}></${figureName}>${htmlAfter}</main>`, {
    headHtml: '<meta name="viewport" content="width=device-width"><style>body { margin: 0 }</style>',
    scriptHtml: ['motion-widgets', 'de'].map((scriptName) => `<script type="module" src="/${scriptName}.js"></script>`).join(''),
  });
  const widget = page.locator(figureName);
  await waitUntilReady(widget);
  await openDisclosures(widget);
  return widget;
}

/** Media, attributes and widths of figures that are tested for accessibility. Daily tests use the first two entries, and nightly tests use all. */
const TESTED_APPEARANCES = /** @type {[Parameters<Page['emulateMedia']>[0], string, number][]} */ ([
  [{ colorScheme: 'light' }, 'theme="light"', 1280],
  [{ colorScheme: 'light' }, 'theme="dark"', 1280],
  [{ forcedColors: 'active', colorScheme: 'light' }, '', 1280],
  [{ forcedColors: 'active', colorScheme: 'dark' }, '', 1280],
  [{ colorScheme: 'light', forcedColors: 'none' }, 'lang="de"', 320],
]);

testEach('a figure has no accessibility violations in any colour scheme and width', async (page, figureName, isNightly) => {
  for (const [emulatedMedia, attributes, figureWidth] of isNightly ? TESTED_APPEARANCES : TESTED_APPEARANCES.slice(0, 2)) {
    await page.emulateMedia(emulatedMedia);
    await page.setViewportSize({ width: figureWidth, height: 812 });
    await openWithDisclosures(page, figureName, { attributes });
    await expectAccessible(page, JSON.stringify([emulatedMedia, attributes]));
  }
});

test('in forced colours a figure keeps its colour roles, and its pressed button differs from others', async ({ page }) => {
  await page.emulateMedia({ forcedColors: 'active' });
  const widget = await openBanana(page);
  for (const colorRole of ['prior', 'prediction', 'posterior', 'truth']) {
    expect(await countPixelsOfRole(widget.locator('canvas.plane'), colorRole), colorRole).toBeGreaterThan(25);
  }
  const [pressedColor, otherColor] = await Promise.all(['Banana', 'Straight'].map((buttonName) =>
    widget.getByRole('button', { name: buttonName }).evaluate((buttonElement) => getComputedStyle(buttonElement).backgroundColor)));
  expect(pressedColor).not.toBe(otherColor);
});

testEach('Tab reaches every handle and control of a figure exactly once, and then leaves the figure', async (page, name) => {
  const widget = await openWithDisclosures(page, name, { htmlBefore: '<a id="before" href="#">Before</a>', htmlAfter: '<a id="after" href="#">After</a>' });
  await widget.evaluate((element) => {
    const shadowRoot = /** @type {ShadowRoot} */ (element.shadowRoot);
    const tabStops = [...shadowRoot.querySelectorAll('button, input, select, textarea, summary, a[href], .handle')].filter((tabStopElement) => {
      const { type, name, checked } = /** @type {HTMLInputElement} */ (tabStopElement);
      // Tab skips the text field of a slider, which is reached from the slider. Tab also skips radio buttons whose group has a selected
      // button.
      if (tabStopElement.matches(':disabled, .typed, [tabindex="-1"]') || !tabStopElement.checkVisibility({ visibilityProperty: true })) return false;
      return type !== 'radio' || checked || !shadowRoot.querySelector(`input[name="${name}"]:checked`);
    });
    Object.assign(window, { stops: tabStops });
  });
  await page.locator('#before').focus();
  /** @type {(number | string)[]} */
  const reachedTabStops = [];
  const readFocusedStop = () => page.evaluate((widgetTag) => {
    const focusedElement = document.querySelector(widgetTag)?.shadowRoot?.activeElement;
    return focusedElement ? Reflect.get(window, 'stops').indexOf(focusedElement) : `${document.activeElement?.id}`;
  }, name);
  const [tabStopCount, tabStopTexts] = await page.evaluate(() => {
    const tabStops = /** @type {Element[]} */ (Reflect.get(window, 'stops'));
    return [tabStops.length, tabStops.map((stopElement) => stopElement.outerHTML.slice(0, 120))];
  });
  expect(tabStopCount).toBeGreaterThan(10);
  do {
    await page.keyboard.press('Tab');
    reachedTabStops.push(await readFocusedStop());
  } while (reachedTabStops.at(-1) !== 'after' && reachedTabStops.length <= tabStopCount + 5);
  expect(reachedTabStops.at(-1)).toBe('after');
  const unreachedTabStops = tabStopTexts.filter((_, i) => !reachedTabStops.includes(i));
  expect(unreachedTabStops).toEqual([]);
  expect(reachedTabStops.length).toBe(tabStopCount + 1);
});

test('if a control removes or disables itself, a nearby control gets the focus', async ({ page }) => {
  const focusedGroupClassOf = (/** @type {Locator} */ widget) => widget.evaluate(({ shadowRoot }) => shadowRoot?.activeElement?.closest('.buttons, section')?.className);
  await showPage(page, '<map-squeeze></map-squeeze>');
  const mapSqueeze = page.locator('map-squeeze');
  await waitUntilReady(mapSqueeze);
  await mapSqueeze.evaluate((element) => void Object.assign(element, { map: { bounds: [0, 0, 6, 4], walls: [[3, 0, 3, 1.5]] } }));
  await mapSqueeze.getByRole('button', { name: 'Back to the apartment' }).press('Enter');
  await expect(mapSqueeze.getByRole('button', { name: 'Back to the apartment' })).toHaveCount(0);
  expect(await focusedGroupClassOf(mapSqueeze)).toContain('presets');
  await mapSqueeze.evaluate((element) => void Object.assign(element, { samples: 1 }));
  await mapSqueeze.getByRole('button', { name: 'Clear' }).press('Enter');
  const stepButton = mapSqueeze.getByRole('button', { name: 'Step' });
  // Waits until the button is enabled, because a disabled button would ignore the key.
  await expect(stepButton).toBeEnabled();
  await stepButton.press('Enter');
  await expect(stepButton).toBeDisabled();
  expect(await focusedGroupClassOf(mapSqueeze)).toBe('buttons');
});

test('screen readers get the value of a slider with its unit, and no announcement while a slider moves', async ({ page }) => {
  const widget = await openBanana(page);
  const statusLine = widget.locator('p[role=status]');
  const speedSlider = widget.locator('#v');
  await speedSlider.scrollIntoViewIfNeeded();
  await expect(speedSlider).toHaveAttribute('aria-valuetext', '1.00 m/s');
  const { x, y, width, height } = await readBox(speedSlider);
  await page.mouse.move(x + 0.83 * width, y + height / 2);
  await page.mouse.down();
  for (const pointerShare of [0.7, 0.6, 0.5]) {
    await page.mouse.move(x + pointerShare * width, y + height / 2);
    await waitForFrames(page);
    expect(await statusLine.textContent()).toBe('');
  }
  await page.mouse.up();
  await expect(statusLine).not.toBeEmpty();
  expect(await statusLine.innerText()).toBe(await widget.locator('p[part=caption]').innerText());
  for (const otherSlider of await widget.locator('input[type=range]').all()) {
    expect(await otherSlider.getAttribute('aria-valuetext')).toMatch(/\d/);
  }
});

test('the touch targets of a figure are large enough for a finger', async ({ page, figureName }) => {
  await page.setViewportSize({ width: 375, height: 812 });
  const widget = await openWithDisclosures(page, figureName);
  const smallTargets = await widget.evaluate((element) =>
    [.../** @type {ShadowRoot} */ (element.shadowRoot).querySelectorAll('button, input[type=range], label:has(input):not(td label, th label), .handle')]
      .filter((touchTarget) => touchTarget.checkVisibility())
      .map((touchTarget) => ({ html: touchTarget.outerHTML.slice(0, 80), box: touchTarget.getBoundingClientRect() }))
      .filter(({ box: elementBox }) => Math.min(elementBox.width, elementBox.height) < 24));
  expect(smallTargets).toEqual([]);
});

test.describe('a finger on a figure', () => {
  test.use({ hasTouch: true, viewport: { width: 375, height: 812 } });

  /** Swipes upwards from a point by touch events. @param {Page} page @param {{ x: number, y: number }} startPoint */
  async function swipeUpFrom(page, startPoint) {
    const cdpSession = await page.context().newCDPSession(page);
    await cdpSession.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints: [startPoint] });
    for (let moveIndex = 1; moveIndex <= 10; moveIndex++) {
      const touchPoint = { x: startPoint.x + moveIndex / 5, y: startPoint.y - 16 * moveIndex };
      await cdpSession.send('Input.dispatchTouchEvent', { type: 'touchMove', touchPoints: [touchPoint] });
    }
    await cdpSession.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
    await waitForFrames(page);
  }

  /** Scrolls a part of a figure to the lower half of the screen, because a sticky picture covers the upper half. @param {Locator} partLocator */
  async function scrollToLowerHalf(partLocator) {
    await partLocator.evaluate((element) => {
      const { top: topEdge, height } = element.getBoundingClientRect();
      scrollBy({ top: topEdge + height / 2 - 0.7 * innerHeight, behavior: 'instant' });
    });
    await waitForFrames(partLocator.page());
  }
  const surroundingHtml = { htmlBefore: '<div style="height: 300px"></div>', htmlAfter: '<div style="height: 1500px"></div>' };

  test('moves each handle without scrolling the page', async ({ page, handleFigureName }) => {
    const widget = await openWithDisclosures(page, handleFigureName, surroundingHtml);
    for (const handleSelector of FIGURE_FACTS[handleFigureName].handleSelectors ?? []) {
      const figureHandle = widget.locator(handleSelector);
      await scrollToLowerHalf(figureHandle);
      const stateBefore = await readState(widget);
      const [handleCentre, scrollYBefore] = [await readCentre(figureHandle), await page.evaluate(() => scrollY)];
      await swipeUpFrom(page, handleCentre);
      expect(await page.evaluate(() => scrollY), handleSelector).toBe(scrollYBefore);
      expect(await readState(widget), handleSelector).not.toEqual(stateBefore);
    }
  });

  test('that swipes vertically over a picture or a slider scrolls the page, and changes no setting', async ({ page, figureName }) => {
    const widget = await openWithDisclosures(page, figureName, surroundingHtml);
    for (const swipedSelector of ['canvas.plane', `#${FIGURE_FACTS[figureName].sliderId}`]) {
      const swipedElement = widget.locator(swipedSelector);
      await scrollToLowerHalf(swipedElement);
      const stateBefore = await readState(widget);
      const { x, y, width, height } = await readBox(swipedElement);
      const scrollYBefore = await page.evaluate(() => scrollY);
      // The swipe starts on the slider's track, because no slider has its thumb at a third of the width.
      await swipeUpFrom(page, { x: x + 0.3 * width, y: y + height / 2 });
      await expect.poll(() => page.evaluate(() => scrollY)).toBeGreaterThan(scrollYBefore + 60);
      expect(await readState(widget), swipedSelector).toEqual(stateBefore);
    }
  });

  test('that taps a chart sets ω, and one that taps a robot marks it @nightly', async ({ page }) => {
    const widget = await openWithDisclosures(page, 'banana-machine');
    const omegaChart = widget.locator('#chart-omega');
    await scrollToLowerHalf(omegaChart);
    const { x, y, width, height } = await readBox(omegaChart);
    await page.touchscreen.tap(x + 0.8 * width, y + height / 2);
    await expect.poll(async () => (await readBananaResults(widget)).config.command.omega).toBeGreaterThan(1);
    const planeCanvas = widget.locator('canvas.plane');
    await widget.evaluate((element) => element.scrollIntoView());
    const [xShare, yShare] = await widget.evaluate((element) => {
      const { pictures: [{ pictureView }], poses, viewModel: { arcEnd } } = /** @type {any} */ (element);
      const robotPixelOf = (/** @type {number} */ i) => [pictureView.toPixelX(poses[3 * i]), pictureView.toPixelY(poses[3 * i + 1])];
      const handlePixel = [pictureView.toPixelX(arcEnd[0]), pictureView.toPixelY(arcEnd[1])];
      // Finds a robot that is in the plot area and not covered by the handle.
      for (let i = 0; i < poses.length / 3; i++) {
        const [x, y] = robotPixelOf(i);
        const { leftEdge, rightEdge, topEdge, bottomEdge } = pictureView.plotArea;
        if (Math.hypot(x - handlePixel[0], y - handlePixel[1]) > 60 && x > leftEdge && x < rightEdge && y > topEdge && y < bottomEdge) return [x / pictureView.width, y / pictureView.height];
      }
      throw new Error('No robot is clear of the handle.');
    });
    const elementBox = await readBox(planeCanvas);
    await page.touchscreen.tap(elementBox.x + xShare * elementBox.width, elementBox.y + yShare * elementBox.height);
    await expect(widget.locator('#robot')).not.toHaveValue('');
  });
});

test('a printed figure has its picture and settings in light colours, and no controls', async ({ page }) => {
  await page.emulateMedia({ colorScheme: 'light' });
  const widget = await mountFigure(page, 'banana-machine', { headHtml: '<style>:root { color-scheme: light dark }</style>' });
  const planeCanvas = widget.locator('canvas.plane');
  // The events `beforeprint` and `afterprint` are fired in one task, without an animation frame between them.
  const takePrintedPicture = () => planeCanvas.evaluate((element) => {
    dispatchEvent(new Event('beforeprint'));
    const printedPixels = /** @type {HTMLCanvasElement} */ (element).toDataURL();
    dispatchEvent(new Event('afterprint'));
    return printedPixels;
  });
  const printedPicture = await takePrintedPicture();
  const screenPicture = await readPicture(planeCanvas);
  await page.emulateMedia({ colorScheme: 'dark' });
  await expect.poll(() => readPicture(planeCanvas)).not.toBe(screenPicture);
  expect((await takePrintedPicture()) === printedPicture).toBe(true);
  await page.emulateMedia({ colorScheme: 'dark', media: 'print' });
  const readAspectRatio = () => planeCanvas.evaluate((element) => {
    const { width, height, clientWidth, clientHeight } = /** @type {HTMLCanvasElement} */ (element);
    return (width * clientHeight) / (height * clientWidth);
  });
  await expect.poll(readAspectRatio).toBeCloseTo(1, 1);
  await expect(widget.locator('.on-paper')).toHaveText(/α1\s=\s0\.002\s+α2\s=.*\sα6\s=\s0\.002/);
  for (const [settingKey, valueText] of [['v', '1.00 m/s'], ['dt', '2.00 s']]) {
    await expect(printedValueOf(widget, settingKey)).toHaveText(valueText);
  }
  // In print, the height of a canvas follows from the aspect ratio of its pixels. If every frame set the pixel size again, the canvas would keep changing.
  await page.evaluate(() => {
    addEventListener('error', ({ message: errorMessage }) => Object.assign(window, { recordedError: errorMessage }));
    document.querySelector('banana-machine')?.replaceWith(document.createElement('banana-machine'));
  });
  await waitUntilReady(widget);
  const readCanvasSize = () => planeCanvas.evaluate((element) => ['width', 'height'].map((dimensionName) => Reflect.get(element, dimensionName)));
  for (const width of [600, 701, 1127, 1920]) {
    await page.setViewportSize({ width, height: 900 });
    await waitForFrames(page);
    const sizeBefore = await readCanvasSize();
    await waitForFrames(page);
    expect([await readCanvasSize(), await page.evaluate(() => Reflect.get(window, 'recordedError'))]).toEqual([sizeBefore, undefined]);
  }
});

test('all lines of Table 5.1 are printed', async ({ page }) => {
  const widget = await mountFigure(page, 'arc-anatomy');
  await openDisclosures(widget);
  await page.emulateMedia({ media: 'print' });
  for (const lineLabel of await widget.locator('.lines label').all()) await expect(lineLabel).toBeVisible();
  await expect(widget.locator('.lines label')).not.toHaveCount(0);
});

test('a printed Map Squeeze names its map, without the controls that open another one', async ({ page }) => {
  const widget = await mountFigure(page, 'map-squeeze');
  await openDisclosures(widget);
  await page.emulateMedia({ media: 'print' });
  expect((await widget.locator('.own-map').innerText()).trim()).toMatch(/^The apartment: [^\n]*\.$/);
});

test('a printed page contains figures far from the window, with their pictures @nightly', async ({ page }) => {
  await showPage(page, '<banana-machine></banana-machine><div style="height: 3000px"></div><map-squeeze></map-squeeze>');
  await waitUntilReady(page.locator('banana-machine'));
  const farFigure = page.locator('map-squeeze');
  expect(await farFigure.evaluate((element) => Reflect.get(element, 'simulation'))).toBe(undefined);
  await page.evaluate(() => {
    addEventListener('afterprint', () => {
      const canvas = document.querySelector('map-squeeze')?.shadowRoot?.querySelector('canvas');
      const canvasPixels = canvas?.width ? canvas.getContext('2d')?.getImageData(0, 0, canvas.width, canvas.height).data : [];
      Object.assign(window, { inked: canvasPixels?.some((colorChannel) => colorChannel > 0) });
    }, { once: true, capture: true });
  });
  await page.pdf();
  expect(await page.evaluate(() => Reflect.get(window, 'inked'))).toBe(true);
});

test('a print shows the disclosures that the user opened, and no controls @nightly', async ({ page, figureName }) => {
  const widget = await mountFigure(page, figureName);
  const { disclosureIndex, partSelector } = FIGURE_FACTS[figureName].printedPart;
  const foldDisclosure = widget.locator('.folds details').nth(disclosureIndex);
  await expect(foldDisclosure).toBeVisible();
  await page.emulateMedia({ media: 'print' });
  await expect(foldDisclosure.locator(partSelector).first()).toBeHidden();
  await page.emulateMedia({ media: 'screen' });
  await foldDisclosure.locator('summary').click();
  await expect(foldDisclosure.locator(partSelector).first()).toBeVisible();
  await page.emulateMedia({ media: 'print' });
  await expect(foldDisclosure.locator(partSelector).first()).toBeVisible();
  await expect(widget.locator('.readouts').first()).toBeVisible();
  await expect(widget.locator('[part=caption]')).toBeVisible();
  await expect(widget.locator(':is(button, input, summary, textarea):visible')).toHaveCount(0);
});

testEach('a figure with all disclosures open fits into a width of 320 px', async (page, name, isNightly) => {
  await page.setViewportSize({ width: 320, height: 812 });
  const widget = await openWithDisclosures(page, name);
  /** Returns the widths of the page, and the elements beyond the right edge of the window that cannot be scrolled to. */
  const findOverflow = () => widget.evaluate((element) => {
    const { body } = document;
    const isVisibleOverflow = (/** @type {Element} */ figurePart) => {
      for (let ancestorElement = figurePart.parentElement; ancestorElement; ancestorElement = ancestorElement.parentElement) if (getComputedStyle(ancestorElement).overflowX !== 'visible') return false;
      return figurePart.checkVisibility({ visibilityProperty: true });
    };
    const overflowingParts = [.../** @type {ShadowRoot} */ (element.shadowRoot).querySelectorAll('*')].filter((figurePart) => figurePart.getBoundingClientRect().right > innerWidth + 0.5 && isVisibleOverflow(figurePart));
    return [document.documentElement.scrollWidth, body.scrollWidth, ...overflowingParts.map(({ outerHTML }) => outerHTML.slice(0, 80))];
  });
  for (const figureLanguage of isNightly ? ['en', 'de'] : ['en']) {
    await widget.evaluate((element, newLanguage) => element.setAttribute('lang', newLanguage), figureLanguage);
    await waitForFrames(page);
    expect(await findOverflow(), figureLanguage).toEqual([320, 320]);
  }
});

testEach('the help text of a slider covers no other slider and no separator line, and no focus outline crosses the text', async (page, figureName) => {
  const widget = await openWithDisclosures(page, figureName);
  for (const [width, figureLanguage] of /** @type {const} */ ([[320, 'en'], [700, 'de']])) {
    await page.setViewportSize({ width, height: 812 });
    await widget.evaluate((element, newLanguage) => element.setAttribute('lang', newLanguage), figureLanguage);
    await waitForFrames(page);
    const coveredSliders = await widget.evaluate((element) => {
      const shadowRoot = /** @type {ShadowRoot} */ (element.shadowRoot);
      const foldsTop = /** @type {Element} */ (shadowRoot.querySelector('.folds')).getBoundingClientRect().top;
      return [...shadowRoot.querySelectorAll('.slider')].flatMap((sliderRow) => {
        const slider = /** @type {HTMLInputElement} */ (sliderRow.querySelector('input[type=range]'));
        slider.focus();
        const helpBox = sliderRow.querySelector('.effect')?.getBoundingClientRect();
        if (!helpBox) return [];
        return [.../** @type {Element} */ (sliderRow.closest('fieldset, .controls, .with-button')).querySelectorAll('.slider input[type=range]')]
          .map((controlElement) => controlElement.getBoundingClientRect())
          .filter(({ top: topEdge, bottom: bottomEdge }) => bottomEdge - 0.5 > helpBox.top && (topEdge + bottomEdge) / 2 < helpBox.bottom)
          .map(() => slider.id)
          .concat(helpBox.top < foldsTop && helpBox.bottom > foldsTop ? `${slider.id} on the rule` : []);
      });
    });
    expect(coveredSliders, `${width} px, ${figureLanguage}`).toEqual([]);
  }
});
