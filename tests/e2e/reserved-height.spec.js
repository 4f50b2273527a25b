import { expect } from '@playwright/test';
import { NEW_PAGE_TAG, REDUCED_MOTION, readBox, holdBackRequests, waitForFrames, mountFigure, showPage, test, testEach, waitUntilReady } from './support.js';

test.use(REDUCED_MOTION);

/** Maximum difference between the reserved height and the height of a figure, em, in any font and at any width up to 80 em. */
const MAX_HEIGHT_DIFFERENCE_EM = 8;

testEach('the height reserved for a figure until its script is loaded is about the height of the figure', async (page, figureName, isNightly) => {
  const pageWidths = isNightly ? [320, 375, 414, 480, 560, 640, 700, 760, 900, 1024, 1280] : [375, 700, 1280];
  await showPage(page, '', {
    headHtml: '<style>body { margin: 0; font: 16px "Liberation Serif", serif }</style>',
    scriptHtml: '<script type="module" src="/external.js"></script>',
  });
  const allowScript = await holdBackRequests(page, '**/chunks/**');
  await page.evaluate((widgetTag) => document.body.append(document.createElement(widgetTag)), figureName);
  const widget = page.locator(figureName);
  const readHeightsInEm = async () => {
    const heightsInEm = [];
    for (const pageWidth of pageWidths) {
      await page.setViewportSize({ width: pageWidth, height: 900 });
      await waitForFrames(page);
      heightsInEm.push((await readBox(widget)).height / 16);
    }
    return heightsInEm;
  };
  const reservedHeights = await readHeightsInEm();
  expect(await widget.evaluate((element) => element.matches(':defined'))).toBe(false);
  allowScript();
  await waitUntilReady(widget);
  await expect(widget.locator('.folds')).toBeVisible();
  for (const [i, height] of (await readHeightsInEm()).entries()) {
    expect(height).toBeGreaterThanOrEqual(reservedHeights[i]);
    expect(height - reservedHeights[i]).toBeLessThan(MAX_HEIGHT_DIFFERENCE_EM);
  }
  const emptyHeightEm = await widget.evaluate((element) => {
    const [simulationBottom, foldsBottom] = ['.simulation', '.folds'].map((partSelector) => element.shadowRoot?.querySelector(partSelector)?.getBoundingClientRect().bottom ?? NaN);
    return (simulationBottom - foldsBottom) / 16;
  });
  expect(emptyHeightEm).toBeLessThan(MAX_HEIGHT_DIFFERENCE_EM);
}, NEW_PAGE_TAG);

test('with a title and a caption, loading the script does not move the text below the figure', async ({ page }) => {
  const allowScript = await holdBackRequests(page, '**/motion-widgets.js');
  const pageBody = '<banana-machine><span slot="title">Figure 9.3</span><p slot="caption">Drag the ring.</p></banana-machine><p id="after">After</p>';
  const pageOpening = showPage(page, pageBody, { headHtml: '<link rel="stylesheet" href="/motion-widgets.css">' });
  const textBelow = page.locator('#after');
  const readTextTop = async () => (await readBox(textBelow)).y;
  await textBelow.waitFor();
  // The first frame is drawn after the stylesheet is loaded, which reserves the height of the figure.
  await waitForFrames(page);
  const topBefore = await readTextTop();
  allowScript();
  await pageOpening;
  await waitUntilReady(page.locator('banana-machine'));
  expect(await readTextTop()).toBe(topBefore);
});

testEach('a figure fits the width of a phone, a book column and a screen in a wide font, and is at most a third higher than a screen', async (page, figureName) => {
  const widget = await mountFigure(page, figureName, { headHtml: '<style>body { margin: 0 }</style>' });
  await expect(widget.locator('.folds')).toBeVisible();
  for (const width of [375, 480, 640, 900, 1280]) {
    await page.setViewportSize({ width, height: 720 });
    for (const letterSpacing of ['0.1em', '0']) {
      await page.evaluate((letterSpacing) => void Object.assign(document.body.style, { letterSpacing }), letterSpacing);
      await waitForFrames(page);
      expect.soft(await page.evaluate(() => document.documentElement.scrollWidth), `${width} px, ${letterSpacing}`).toBeLessThanOrEqual(width);
    }
    if (width >= 640) expect.soft((await readBox(widget)).height / 720, `${width} px`).toBeLessThanOrEqual(4 / 3);
  }
}, NEW_PAGE_TAG);
