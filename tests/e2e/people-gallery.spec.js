import { expect, test as plainTest } from '@playwright/test';
import { expectAccessible } from './axe.js';
import { ALL_FIGURE_NAMES } from './figures.js';
import { REDUCED_MOTION, readBox, waitForFrames, mountFigure, readPicture, readProperty, test, testEach, waitUntilReady } from './support.js';

test.use(REDUCED_MOTION);

test('examples on the reference page have the attributes of the code above them', async ({ page }) => {
  await page.goto('/reference.html');
  const exampleFigures = page.locator('pre + :is(banana-machine, map-squeeze)');
  await expect(exampleFigures).toHaveCount(5);
  for (const exampleFigure of await exampleFigures.all()) {
    await exampleFigure.scrollIntoViewIfNeeded();
    await waitUntilReady(exampleFigure);
    const exampleCode = await exampleFigure.evaluate((figureElement) => figureElement.previousElementSibling?.textContent ?? '');
    const figureConfig = await exampleFigure.evaluate((figureElement) => Reflect.get(figureElement, 'simulation').config);
    for (const [, name, value] of exampleCode.replace(/>[^]*/, '').matchAll(/([\w-]+)="([^"]*)"/g)) {
      // A figure removes its preset if other attributes change the settings of the preset.
      if (name !== 'preset') await expect(exampleFigure).toHaveAttribute(name, value);
      if (name === 'samples' || name === 'isolate') expect(String(figureConfig[name])).toBe(value);
      if (name === 'lang') await expect(exampleFigure.getByRole('button', { name: 'Stichproben ziehen' })).toBeVisible();
    }
  }
});

/** Settings that gallery items set in addition to the settings of a preset. */
const KEYS_OUTSIDE_PRESETS = ['preset', 'samples', 'overlays', 'line', 'morph'];

testEach('each gallery item sets its complete state, independent of items pressed before', async (page, name) => {
  await page.goto('/');
  const figureArticle = page.locator('article', { has: page.locator(name) });
  const figureLocator = figureArticle.locator(name);
  await figureLocator.scrollIntoViewIfNeeded();
  await waitUntilReady(figureLocator);
  const itemButtons = await figureArticle.locator('button[data-try]').all();
  const pressAndReadState = async (/** @type {import('@playwright/test').Locator} */ presetButton) => {
    // The button is clicked by a script, because some buttons are in a closed disclosure.
    await presetButton.evaluate((exampleFigure) => /** @type {HTMLElement} */ (exampleFigure).click());
    await expect(presetButton).toHaveAttribute('aria-current', 'true');
    await waitForFrames(page);
    const itemSettings = JSON.parse((await presetButton.getAttribute('data-try')) ?? '{}');
    const [figureState, figureProperties] = await figureLocator.evaluate((exampleFigure, propertyKeys) => {
      const figureState = /** @type {any} */ (exampleFigure).getState();
      return [figureState, Object.fromEntries(propertyKeys.map((propertyKey) => [propertyKey, propertyKey in exampleFigure ? Reflect.get(exampleFigure, propertyKey) : Reflect.get(figureState, propertyKey)]))];
    }, Object.keys(itemSettings));
    const expectedPreset = Object.keys(itemSettings).every((settingKey) => KEYS_OUTSIDE_PRESETS.includes(settingKey)) ? itemSettings.preset : figureProperties.preset;
    expect(figureProperties).toEqual({ ...itemSettings, ...(itemSettings.preset && { preset: expectedPreset }) });
    return figureState;
  };
  const firstStates = [];
  for (const itemButton of itemButtons) firstStates.push(await pressAndReadState(itemButton));
  for (const [i, pressedButton] of [...itemButtons.entries()].reverse()) expect(await pressAndReadState(pressedButton)).toEqual(firstStates[i]);
});

test('an entry of the legend highlights its curve in the chart', async ({ page }) => {
  const widget = await mountFigure(page, 'dead-reckoning');
  await widget.getByRole('checkbox', { name: 'lateral' }).hover();
  await expect(widget.locator('.plot .curve.lit')).toHaveAttribute('stroke', 'var(--prediction)');
  await expect(widget.locator('.plot .curve.unlit')).toHaveCount(2);
});

test('a term in the text and an entry of the legend highlight their line in the picture', async ({ page }) => {
  await page.goto('/');
  const figureArticle = page.locator('#banana');
  const figureElement = figureArticle.locator('banana-machine');
  await waitUntilReady(figureElement);
  const planeCanvas = figureElement.locator('canvas.plane');
  const pictureBefore = await readPicture(planeCanvas);
  const termElement = figureArticle.getByText('dashed ellipse', { exact: true });
  await termElement.focus();
  expect(await readProperty(figureElement, 'highlight')).toBe('ellipse');
  await waitForFrames(page);
  const highlightedPicture = await readPicture(planeCanvas);
  expect(highlightedPicture).not.toBe(pictureBefore);
  await termElement.blur();
  await waitForFrames(page);
  expect(await readPicture(planeCanvas)).toBe(pictureBefore);
  await figureElement.locator('.legend').getByText('Gaussian in (x, y)').hover();
  await waitForFrames(page);
  expect(await readPicture(planeCanvas)).toBe(highlightedPicture);
});

test('the table of contents links to every section', async ({ page }) => {
  await page.goto('/');
  const contentsLinks = page.getByRole('navigation', { name: 'Contents' }).getByRole('link');
  const linkTargets = await contentsLinks.evaluateAll((linkElements) => linkElements.map((linkElement) => linkElement.getAttribute('href')));
  expect(linkTargets).toEqual(await page.locator('main > :is(article, section)').evaluateAll((targetElements) => targetElements.map(({ id }) => `#${id}`)));
});

for (const [pageWidth, pageHeight] of [[1280, 720], [375, 760]]) {
  test(`a figure is below its heading, and remains visible next to its items, on a page ${pageWidth} px wide`, async ({ page }) => {
    await page.setViewportSize({ width: pageWidth, height: pageHeight });
    await page.goto('/');
    const figureArticle = page.locator('#banana');
    await waitUntilReady(figureArticle.locator('banana-machine'));
    const [headingBox, pictureFrameBox] = [await readBox(figureArticle.locator('p').first()), await readBox(figureArticle.locator('.stand'))];
    expect(pictureFrameBox.y).toBeGreaterThanOrEqual(headingBox.y + headingBox.height);
    await figureArticle.getByRole('button', { name: 'Odometry model' }).evaluate((pressedButton) => pressedButton.scrollIntoView({ block: 'end' }));
    await waitForFrames(page);
    await expect(figureArticle.locator('canvas.plane')).toBeInViewport({ ratio: 0.95 });
    await expect(figureArticle.getByRole('button', { name: 'Odometry model' })).toBeInViewport();
  });
}

test('nothing on the page moves while figures load', async ({ page }) => {
  await page.addInitScript(() => {
    const layoutShifts = /** @type {string[]} */ ([]);
    Object.assign(window, { layoutShifts });
    new PerformanceObserver((entryList) => {
      const layoutShiftSources = entryList.getEntries().flatMap((layoutShiftEntry) => [...Reflect.get(layoutShiftEntry, 'sources')]);
      for (const { node, previousRect, currentRect } of layoutShiftSources) layoutShifts.push(`${node?.className ?? node?.nodeName}: ${JSON.stringify([previousRect, currentRect])}`);
    }).observe({ type: 'layout-shift', buffered: true });
  });
  await page.goto('/');
  for (const name of ALL_FIGURE_NAMES) {
    await page.locator(name).first().scrollIntoViewIfNeeded();
    await waitUntilReady(page.locator(name).first());
  }
  expect(await page.evaluate(() => Reflect.get(window, 'layoutShifts'))).toEqual([]);
});

for (const pagePath of ['/', '/reference.html']) {
  test(`the page ${pagePath} has no accessibility violations`, async ({ page }) => {
    await page.goto(pagePath);
    await expectAccessible(page, undefined, 'body > *');
  });
}

plainTest('the gallery says what is missing without JavaScript', async ({ browser, baseURL }) => {
  const scriptlessContext = await browser.newContext({ javaScriptEnabled: false, baseURL });
  const page = await scriptlessContext.newPage();
  await page.goto('/');
  await expect(page.getByText('needs a browser with JavaScript and WebAssembly')).toBeVisible();
  await scriptlessContext.close();
});
