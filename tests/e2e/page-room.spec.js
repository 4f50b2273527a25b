import { expect } from '@playwright/test';
import { NEW_PAGE_TAG, REDUCED_MOTION, boxOf, waitForFrames, mount, showPage, test, testEach, untilReady } from './support.js';


test.use(REDUCED_MOTION);

/** Maximum difference between the reserved height and the height of a figure, em, in any font and at any width up to 80 em. */
const MAX_DIFFERENCE_EM = 8;

testEach('the height reserved for a figure until its script is loaded is about that of the figure', async (page, name, isFull) => {
  const widths = isFull ? [320, 375, 414, 480, 560, 640, 700, 760, 900, 1024, 1280] : [375, 700, 1280];
  await showPage(page, '', {
    head: '<style>body { margin: 0; font: 16px "Liberation Serif", serif }</style>',
    script: '<script type="module" src="/external.js"></script>',
  });
  let allowScript = () => {};
  const scriptIsAllowed = new Promise((resolve) => (allowScript = () => resolve(undefined)));
  await page.route('**/chunks/**', async (route) => {
    await scriptIsAllowed;
    await route.continue();
  });
  await page.evaluate((tag) => document.body.append(document.createElement(tag)), name);
  const widget = page.locator(name);
  const heights = async () => {
    const heightsInEm = [];
    for (const width of widths) {
      await page.setViewportSize({ width, height: 900 });
      await waitForFrames(page);
      heightsInEm.push((await boxOf(widget)).height / 16);
    }
    return heightsInEm;
  };
  const reservedHeights = await heights();
  expect(await widget.evaluate((element) => element.matches(':defined'))).toBe(false);
  allowScript();
  await untilReady(widget);
  await expect(widget.locator('.folds')).toBeVisible();
  for (const [i, height] of (await heights()).entries()) {
    expect(height).toBeGreaterThanOrEqual(reservedHeights[i]);
    expect(height - reservedHeights[i]).toBeLessThan(MAX_DIFFERENCE_EM);
  }
  // Little space is left empty below the figure.
  const emptySpace = await widget.evaluate((element) => {
    const [simulation, folds] = ['.simulation', '.folds'].map((part) => element.shadowRoot?.querySelector(part)?.getBoundingClientRect().bottom ?? NaN);
    return (simulation - folds) / 16;
  });
  expect(emptySpace).toBeLessThan(MAX_DIFFERENCE_EM);
}, NEW_PAGE_TAG);

test('a title and a caption move nothing when the script is loaded', async ({ page }) => {
  let allowScript = () => {};
  const scriptIsAllowed = new Promise((resolve) => (allowScript = () => resolve(undefined)));
  await page.route('**/motion-widgets.js', async (route) => {
    await scriptIsAllowed;
    await route.continue();
  });
  const content = '<banana-machine><span slot="title">Figure 9.3</span><p slot="caption">Drag the ring.</p></banana-machine><p id="after">After</p>';
  const pageIsShown = showPage(page, content, { head: '<link rel="stylesheet" href="/motion-widgets.css">' });
  const text = page.locator('#after');
  const topOfText = async () => (await boxOf(text)).y;
  await text.waitFor();
  // The first frame comes after the stylesheet, which reserves the height.
  await waitForFrames(page);
  const topBefore = await topOfText();
  allowScript();
  await pageIsShown;
  await untilReady(page.locator('banana-machine'));
  expect(await topOfText()).toBe(topBefore);
});

testEach('a figure is no wider than a phone, the column of a book or a screen, also in a wide font, and at most a third higher than a screen', async (page, name) => {
  const widget = await mount(page, name, { head: '<style>body { margin: 0 }</style>' });
  await expect(widget.locator('.folds')).toBeVisible();
  for (const width of [375, 480, 640, 900, 1280]) {
    await page.setViewportSize({ width, height: 720 });
    for (const spacing of ['0.1em', '0']) {
      await page.evaluate((letterSpacing) => void Object.assign(document.body.style, { letterSpacing }), spacing);
      await waitForFrames(page);
      expect.soft(await page.evaluate(() => document.documentElement.scrollWidth), `${width} px, ${spacing}`).toBeLessThanOrEqual(width);
    }
    if (width >= 640) expect.soft((await boxOf(widget)).height / 720, `${width} px`).toBeLessThanOrEqual(4 / 3);
  }
}, NEW_PAGE_TAG);
