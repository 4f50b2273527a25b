import { expect } from '@playwright/test';
import { NEW_PAGE_TAG, REDUCED_MOTION, readBox, waitForFrames, mountFigure, showPage, test, waitUntilReady, waitUntilSettled } from './support.js';

/** @typedef {import('@playwright/test').Page} Page */

test.use(REDUCED_MOTION);

/** Preferred width of a figure in CSS pixels, equal to `preferredWidthCss`. */
const PREFERRED_WIDTH = 44 * 16;

/** HTML of containers in which the width of an element (X) may depend on its contents. @type {Record<string, string>} */
const CONTAINERS_BY_NAME = {
  block: 'X',
  'flex with auto margins': '<div style="display: flex"><X style="margin: auto"></X></div>',
  'flex row': '<div style="display: flex"><X></X></div>',
  'flex column, centred': '<div style="display: flex; flex-direction: column; align-items: center"><X></X></div>',
  'inline-block': '<X style="display: inline-block"></X>',
  'in an inline-block': '<div style="display: inline-block"><X></X></div>',
  'table cell': '<table style="border-spacing: 0"><tr><td style="padding: 0"><X></X></td></tr></table>',
  'auto track of a grid': '<div style="display: grid; grid-template-columns: auto 1fr"><X></X><i></i></div>',
  'start of a grid': '<div style="display: grid; justify-items: start"><X></X></div>',
  float: '<X style="float: left"></X>',
  'in a float': '<div style="float: left"><X></X></div>',
  'fit-content': '<X style="width: fit-content"></X>',
  'in fit-content': '<div style="width: fit-content"><X></X></div>',
  'in max-content, at most all': '<div style="width: max-content; max-width: 100%"><X></X></div>',
  'positioned absolutely': '<div style="position: relative; height: 9000px"><X style="position: absolute"></X></div>',
};

test('a figure has its preferred width or the available width in every kind of container, before and after its script runs', NEW_PAGE_TAG, async ({ page, figureName }) => {
  const htmlSections = Object.entries(CONTAINERS_BY_NAME).map(([containerName, htmlPattern]) => {
    const containerHtml = htmlPattern === 'X' ? '<X></X>' : htmlPattern;
    return `<section data-box="${containerName}" style="display: flow-root">${containerHtml.replace('<X', `<${figureName}`).replace('</X>', `</${figureName}>`)}</section>`;
  });
  const pageHead = '<link rel="stylesheet" href="/motion-widgets.css"><style>body { margin: 0; font: 16px/1.5 sans-serif }</style>';
  const findWrongWidths = async (/** @type {number} */ pageWidth) => {
    await page.setViewportSize({ width: pageWidth, height: 900 });
    await waitForFrames(page);
    const figureWidths = await page.locator(figureName).evaluateAll((figureElements) =>
      figureElements.map((element) => [/** @type {HTMLElement} */ (element.closest('section')).dataset.box ?? '', element.getBoundingClientRect().width]));
    expect(figureWidths).toHaveLength(htmlSections.length);
    return figureWidths.filter(([, figureWidth]) => Number(figureWidth) > pageWidth + 0.5 || Number(figureWidth) < Math.min(PREFERRED_WIDTH, pageWidth) - 0.5);
  };
  for (const scriptTag of ['', '<script type="module" src="/motion-widgets.js"></script>']) {
    await showPage(page, htmlSections.join(''), { headHtml: pageHead, scriptHtml: scriptTag });
    if (scriptTag) await page.waitForFunction((widgetTag) => customElements.get(widgetTag) !== undefined, figureName);
    for (const w of [320, 600, 1280]) expect.soft(await findWrongWidths(w), `${scriptTag ? 'defined' : 'not defined'}, ${w} px`).toEqual([]);
  }
});

/** Returns the bounding boxes of all parts of a figure, in em. @param {Page} page @param {string} figureName @param {number} pixelsPerEm CSS pixels */
const partBoxesOf = (page, figureName, pixelsPerEm) =>
  page.locator(figureName).evaluate(
    (element, emPixels) => {
      const elementBox = element.getBoundingClientRect();
      return [...(element.shadowRoot?.querySelectorAll('.surface *') ?? [])].map((partElement) => {
        const { left: leftEdge, top: topEdge, width, height } = partElement.getBoundingClientRect();
        const boxInEm = [leftEdge - elementBox.left, topEdge - elementBox.top, width, height].map((boxPixels) => boxPixels / emPixels);
        return { part: `${partElement.localName}.${partElement.getAttribute('class')}`, numbers: boxInEm };
      });
    },
    pixelsPerEm,
  );

test('the size of a figure is proportional to the surrounding font size, and does not depend on the root’s font size', async ({ page, figureName }) => {
  const partLayouts = [];
  for (const [rootFontSize, fontSize] of [['100%', 16], ['62.5%', 24]]) {
    await page.setViewportSize({ width: 1400, height: 2400 });
    await showPage(page, `<div style="width: 43.75em"><${figureName}></${figureName}></div>`, {
      headHtml: `<style>html { font-size: ${rootFontSize} } body { margin: 0; font: ${fontSize}px/1.5 Arial, 'Liberation Sans', 'Nimbus Sans', sans-serif }</style>`,
    });
    await waitUntilReady(page.locator(figureName));
    await expect(page.locator(figureName).locator('.folds')).toBeVisible();
    await waitForFrames(page);
    partLayouts.push({ root: rootFontSize, em: fontSize, boxes: await partBoxesOf(page, figureName, Number(fontSize)) });
  }
  const [firstLayout, ...otherLayouts] = partLayouts;
  for (const { root, em, boxes: elementBoxes } of otherLayouts) {
    expect(elementBoxes.map(({ part: figurePart }) => figurePart)).toEqual(firstLayout.boxes.map(({ part: figurePart }) => figurePart));
    // Browsers round the widths of letters to pixels. Boxes may therefore differ by a quarter of the font size.
    const differingBoxes = elementBoxes.filter(({ numbers: boxNumbers }, i) => boxNumbers.some((boxNumber, k) => Math.abs(boxNumber - firstLayout.boxes[i].numbers[k]) > 0.25));
    expect(differingBoxes, `${em} px, root ${root}`).toEqual([]);
  }
});

test('the picture of a figure stays in sight on a phone, below the header of the site', async ({ page, figureName }) => {
  await page.setViewportSize({ width: 375, height: 812 });
  await showPage(page, `<header style="position: sticky; top: 0; height: 56px; z-index: 9; background: #fff">Site</header><${figureName}></${figureName}><div style="height: 2000px"></div>`, {
    headHtml: '<style>:root { --motion-sticky-top: 56px } body { margin: 0 }</style>',
  });
  const widget = page.locator(figureName);
  await waitUntilReady(widget);
  const pictureLocator = widget.locator('[part=picture]').first();
  await widget.locator('.slider input[type=range]').nth(1).evaluate((element) => element.scrollIntoView({ block: 'start' }));
  await waitForFrames(page);
  const { y, height } = await readBox(pictureLocator);
  expect(y).toBeCloseTo(56, 0);
  expect((await readBox(widget.locator('.slider input[type=range]').nth(1))).y).toBeGreaterThanOrEqual(y + height);
});

for (const figureName of ['map-squeeze', 'dead-reckoning']) {
  test(`at 200 % zoom the picture of ${figureName} stays in sight and covers no slider`, async ({ page }) => {
    await page.setViewportSize({ width: 640, height: 400 });
    await showPage(page, `<${figureName}></${figureName}><div style="height: 2000px"></div>`);
    const widget = page.locator(figureName);
    await waitUntilReady(widget);
    for (const rangeInput of await widget.locator('.slider input[type=range]').all()) {
      await rangeInput.evaluate((element) => element.scrollIntoView({ block: 'start' }));
      await waitForFrames(page);
      expect(await rangeInput.evaluate((element) => {
        const { left: leftEdge, top: topEdge, width, height } = element.getBoundingClientRect();
        return /** @type {ShadowRoot} */ (element.getRootNode()).elementFromPoint(leftEdge + width / 2, topEdge + height / 2) === element;
      })).toBe(true);
      await expect(widget.locator('.plotted, .stage[part=picture]').first()).toBeInViewport({ ratio: 0.9 });
    }
  });
}

test('tables scroll over the sticky picture of a figure, unless a handle of the picture has the focus', async ({ page }) => {
  await page.setViewportSize({ width: 640, height: 400 });
  await showPage(page, '<dead-reckoning></dead-reckoning><div style="height: 2000px"></div>');
  const widget = page.locator('dead-reckoning');
  await waitUntilReady(widget);
  await widget.getByText('Numbers and data').click();
  const numbersTable = widget.locator('#numbers table').first();
  await numbersTable.evaluate((element) => element.scrollIntoView({ block: 'start' }));
  await waitForFrames(page);
  const isTableOnTop = () => numbersTable.evaluate((element) => {
    const { left: leftEdge, top: topEdge } = element.getBoundingClientRect();
    return element.contains(/** @type {ShadowRoot} */ (element.getRootNode()).elementFromPoint(leftEdge + 5, Math.max(topEdge, 0) + 5));
  });
  expect(await isTableOnTop()).toBe(true);
  await widget.locator('#numbers button').last().focus();
  const stepHandle = widget.getByRole('slider', { name: 'selected step', exact: true });
  await stepHandle.press('ArrowLeft');
  await waitForFrames(page);
  expect(await stepHandle.evaluate((element) => {
    const { left: leftEdge, top: topEdge, width, height } = element.getBoundingClientRect();
    return /** @type {ShadowRoot} */ (element.getRootNode()).elementFromPoint(leftEdge + width / 2, topEdge + height / 2)?.closest('#numbers') === null;
  })).toBe(true);
});

test.describe('on a screen with two device pixels per CSS pixel', () => {
  test.use({ deviceScaleFactor: 2 });

  test('canvases have the pixel density of the screen, also of a screen that developer tools emulate', async ({ page, figureName }) => {
    await showPage(page, `<${figureName}></${figureName}>`);
    const widget = page.locator(figureName);
    await waitUntilReady(widget);
    const pixelRatios = await widget.locator('canvas:visible').evaluateAll((canvasElements) => canvasElements.map((canvasElement) => /** @type {HTMLCanvasElement} */ (canvasElement).width / canvasElement.getBoundingClientRect().width));
    expect(pixelRatios.length).toBeGreaterThan(0);
    for (const pixelRatio of pixelRatios) expect(pixelRatio).toBeCloseTo(2, 1);
  });
});

/** Sliders below texts of variable length. Each item has element, language, page width, slider, and slider values for short and long texts. */
const SLIDERS_BELOW_TEXTS = /** @type {const} */ ([
  ['arc-anatomy', 'de', 375, 'v', ['1', '-0.25', '0.3']],
  ['alpha-calibrator', 'en', 375, 'angle', ['0.25', '0.96']],
  ['alpha-calibrator', 'en', 700, 'distance', ['0.3', '0.05']],
  ['map-squeeze', 'en', 700, 'v', ['1', '-1.12', '-0.25']],
  ['map-squeeze', 'de', 700, 'v', ['1', '1.25']],
  ['banana-machine', 'de', 700, 'v', ['1', '-1.5']],
  ['banana-machine', 'en', 375, 'alpha3', ['0.1', '0.05', '0.02', '0', '0.2']],
  ['banana-machine', 'en', 700, 'alpha3', ['0.1', '0.05', '0.02', '0', '0.2']],
  ['banana-machine', 'en', 1280, 'alpha3', ['0.1', '0.05', '0.02', '0', '0.2']],
]);

for (const [figureName, figureLanguage, pageWidth, sliderId, sliderValues] of SLIDERS_BELOW_TEXTS) {
  test(`texts do not move the slider ${sliderId} while it is dragged, and do not overlap: ${figureName}, ${figureLanguage}, ${pageWidth} px @nightly`, async ({ page }) => {
    await page.setViewportSize({ width: pageWidth, height: 900 });
    const scriptTag = ['motion-widgets', 'de'].map((scriptName) => `<script type="module" src="/${scriptName}.js"></script>`).join('');
    const widget = await mountFigure(page, figureName, { attributes: `lang="${figureLanguage}"`, scriptHtml: scriptTag, headHtml: "<style>body { margin: 16px; font: 16px 'DejaVu Sans', Verdana }</style>" });
    const sliderTops = [];
    for (const sliderValue of sliderValues) {
      await widget.locator(`#${sliderId}`).fill(sliderValue);
      await waitUntilSettled(widget);
      sliderTops.push(await widget.locator(`#${sliderId}`).evaluate((element) => element.getBoundingClientRect().top + scrollY));
    }
    expect(Math.max(...sliderTops) - Math.min(...sliderTops)).toBeLessThan(0.5);
    const textBoxes = await widget.locator('.controls .slider [for], .controls .slider .value, .controls button').evaluateAll((textElements) =>
      textElements.map((element) => ({ text: element.textContent, box: element.getBoundingClientRect() })).filter(({ box: elementBox }) => elementBox.width > 0));
    const overlappingTexts = textBoxes.flatMap((textBox, i) => textBoxes.slice(i + 1).filter(({ box: elementBox }) =>
      elementBox.left < textBox.box.right - 1 && elementBox.right - 1 > textBox.box.left && elementBox.top < textBox.box.bottom - 1 && elementBox.bottom - 1 > textBox.box.top).map((otherBox) => [textBox.text, otherBox.text]));
    expect([textBoxes.length > 3, overlappingTexts]).toEqual([true, []]);
  });
}
