import { expect } from '@playwright/test';
import { expectAccessible } from './axe.js';
import { REDUCED_MOTION, readBox, readCentre, waitForFrames, mountFigure, showPage, readState, test, testEach, waitUntilReady } from './support.js';

test.use({ ...REDUCED_MOTION, viewport: { width: 1920, height: 1080 } });

/** Returns true if a figure in presentation mode fits without scrolling. @param {import('@playwright/test').Locator} widget */
const fitsSurface = (widget) => widget.locator('.surface').evaluate((element) => element.scrollHeight <= element.clientHeight && element.scrollWidth <= element.clientWidth);

test('the button presents the figure in full screen, C shows the controls, and Escape ends the presentation', async ({ page }) => {
  await showPage(page, '<div style="height: 300px"></div><banana-machine></banana-machine><div style="height: 3000px"></div>');
  const widget = page.locator('banana-machine');
  await waitUntilReady(widget);
  await widget.getByRole('button', { name: 'Present' }).click();
  await expect.poll(() => page.evaluate(() => document.fullscreenElement?.localName)).toBe('banana-machine');
  const controlsButton = widget.getByRole('button', { name: 'C Controls' });
  // After a click no focus ring is visible to the audience.
  await expect(widget.locator('.presenting')).toBeFocused();
  await expect(widget.locator('.presenting')).toHaveCSS('outline-style', 'none');
  await expect(widget.locator('.title-slot')).toBeVisible();
  await expect(widget.locator('.slider:has(#v)')).toBeHidden();
  await expectAccessible(page, undefined, 'banana-machine');
  await page.keyboard.press('Control+c');
  await expect(controlsButton).toHaveAttribute('aria-pressed', 'false');
  await page.keyboard.press('c');
  await expect(controlsButton).toHaveAttribute('aria-pressed', 'true');
  await expect(widget.locator('.slider:has(#v)')).toBeVisible();
  // In the text field of a value, the key C types a letter, and Escape leaves the field. Neither key acts on the presentation.
  await widget.locator('.typed').first().click();
  await page.keyboard.press('c');
  await expect(controlsButton).toHaveAttribute('aria-pressed', 'true');
  await page.keyboard.press('Escape');
  await expect(widget).toHaveAttribute('presentation');
  await page.keyboard.press('Escape');
  await expect(widget).not.toHaveAttribute('presentation');
  await expect.poll(() => page.evaluate(() => document.fullscreenElement)).toBe(null);
  await expect(widget.getByRole('button', { name: 'Present' })).toBeFocused();
  await expect(widget.getByRole('button', { name: 'Present' })).toBeInViewport();
});

test('if full screen is refused, a presented figure fills the window, and the button ends the presentation', async ({ page }) => {
  await page.addInitScript(() => (Element.prototype.requestFullscreen = () => Promise.reject(new TypeError('refused'))));
  const widget = await mountFigure(page, 'banana-machine');
  // Slides are scaled by a transform. An element with `position: fixed` would be placed relative to the transformed slide.
  await page.evaluate(() => (document.body.style.transform = 'scale(0.5)'));
  const boxBefore = await readBox(widget);
  await widget.evaluate((element) => void Object.assign(element, { presentation: true }));
  await expect.poll(() => readBox(widget)).toEqual({ x: 0, y: 0, width: 1920, height: 1080 });
  // A dragged handle stays under the pointer at any font size.
  const arcEndHandle = widget.getByRole('slider', { name: 'End of the commanded arc' });
  await waitForFrames(page);
  const centreBefore = await readCentre(arcEndHandle);
  await page.mouse.move(centreBefore.x, centreBefore.y);
  await page.mouse.down();
  await page.mouse.move(centreBefore.x + 60, centreBefore.y - 40, { steps: 4 });
  await waitForFrames(page);
  const centreAfter = await readCentre(arcEndHandle);
  expect(Math.hypot(centreAfter.x - centreBefore.x - 60, centreAfter.y - centreBefore.y + 40)).toBeLessThan(2);
  await page.mouse.up();
  await widget.getByRole('button', { name: 'Esc Exit' }).click();
  await expect(widget).not.toHaveAttribute('presentation');
  await expect.poll(() => readBox(widget)).toEqual(boxBefore);
});

test('the keys 1 to 9 select presets, and a presentation started by keyboard focuses a button', async ({ page }) => {
  const widget = await mountFigure(page, 'banana-machine');
  await widget.getByRole('button', { name: 'Present' }).press('Enter');
  await expect(widget.getByRole('button', { name: 'C Controls' })).toBeFocused();
  const presetNames = await widget.evaluate((element) => /** @type {any} */ (element).definition.attributes.preset.words);
  for (const i of [1, 2, 0]) {
    await widget.evaluate((element) => void Object.assign(element, { morph: 0.5 }));
    await page.keyboard.press(String(i + 1));
    await expect(widget).toHaveAttribute('preset', presetNames[i]);
    await expect(widget).toHaveAttribute('morph', '0');
  }
  await page.keyboard.press('9');
  await expect(widget).toHaveAttribute('preset', presetNames[0]);
});

test('the key 0 restores the state in which the presentation began', async ({ page }) => {
  const widget = await mountFigure(page, 'banana-machine');
  await widget.evaluate((element) => void Object.assign(element, { preset: 'hard', omega: 0.7 }));
  const preparedState = await readState(widget);
  await widget.getByRole('button', { name: 'Present' }).click();
  // The test leaves the focus on a slider, where digit keys must still act on the presentation.
  await page.keyboard.press('c');
  await widget.locator('#v').press('ArrowUp');
  expect(await readState(widget)).not.toEqual(preparedState);
  await page.keyboard.press('0');
  expect(await readState(widget)).toEqual(preparedState);
  const statusLine = widget.locator('p[role=status]');
  await expect(statusLine).not.toBeEmpty();
  expect(await statusLine.innerText()).toBe(await widget.locator('p[part=caption]').innerText());
});

test('the key 0 restores the opening state of a figure that starts within a presentation @nightly', async ({ page }) => {
  const widget = await mountFigure(page, 'banana-machine', { attributes: 'preset="pivot" presentation' });
  await page.keyboard.press('1');
  await expect(widget).toHaveAttribute('preset', 'straight');
  await page.keyboard.press('0');
  await expect(widget).toHaveAttribute('preset', 'pivot');
});

test('a presented Map Squeeze has buttons for its places and samplers', async ({ page }) => {
  const widget = await mountFigure(page, 'map-squeeze', { attributes: 'presentation' });
  await expect(widget.getByRole('button', { name: 'Facing a wall' })).toBeInViewport();
  await expect(widget.getByRole('radio', { name: 'Whole arc' })).toBeInViewport();
});

test('the browser’s own key for leaving full screen ends the presentation @nightly', async ({ page }) => {
  const widget = await mountFigure(page, 'banana-machine');
  await widget.getByRole('button', { name: 'Present' }).click();
  await expect.poll(() => page.evaluate(() => document.fullscreenElement?.localName)).toBe('banana-machine');
  await page.evaluate(() => document.exitFullscreen());
  await expect(widget).not.toHaveAttribute('presentation');
});

testEach('a presented figure has large pictures and legible text, with and without controls', async (page, name) => {
  const widget = await mountFigure(page, name);
  await expect(widget.locator('[part~=caption]').first()).toBeVisible();
  const readFontSizes = () => widget.locator('canvas, .readouts dt').evaluateAll((textElements) => textElements.map((textElement) => parseFloat(getComputedStyle(textElement).fontSize)));
  const fontSizesOnPage = await readFontSizes();
  await widget.evaluate((element) => void Object.assign(element, { presentation: true }));
  await expect(widget.locator('[part~=caption]').first()).toBeVisible();
  await waitForFrames(page);
  expect(await fitsSurface(widget)).toBe(true);
  const pictureBoxes = await Promise.all((await widget.locator('.stage canvas').all()).map(readBox));
  for (const { height } of pictureBoxes) expect(height).toBeGreaterThan(1080 * 0.5);
  for (const [i, fontSize] of (await readFontSizes()).entries()) expect(fontSize / fontSizesOnPage[i]).toBeCloseTo(1.5, 5);
  await page.keyboard.press('c');
  await expect(widget.locator('.folds')).toBeInViewport({ ratio: 0.99 });
  await waitForFrames(page);
  expect(await fitsSurface(widget)).toBe(true);
  const buttonsBottom = Math.max(...(await Promise.all((await widget.locator('.presenting button').all()).map(readBox))).map(({ y, height }) => y + height));
  for (const canvasLocator of await widget.locator('.stage canvas').all()) {
    const { y, height } = await readBox(canvasLocator);
    expect(y).toBeGreaterThanOrEqual(buttonsBottom);
    expect(height).toBeGreaterThanOrEqual(0.3 * 1080);
  }
});

testEach('a figure presented on a phone has its pictures below their titles, and no part overlaps the next one', async (page, name) => {
  for (const viewport of [{ width: 375, height: 760 }, { width: 760, height: 375 }]) {
    await page.setViewportSize(viewport);
    const widget = await mountFigure(page, name, { attributes: 'presentation' });
    await waitForFrames(page);
    const panelTitles = await widget.evaluate(({ shadowRoot }) => [...(shadowRoot?.querySelectorAll('.panel') ?? [])].map((panelElement) => {
      const [titleBox, pictureBox] = ['.panel-title', '.stage, .plotted'].map((boxSelector) => panelElement.querySelector(boxSelector)?.getBoundingClientRect());
      return { title: titleBox, picture: pictureBox };
    }));
    const shownPanels = panelTitles.filter(({ picture: figurePicture }) => figurePicture && figurePicture.height > 0);
    expect(shownPanels.length).toBeGreaterThan(0);
    for (const { title, picture: figurePicture } of shownPanels) {
      expect(figurePicture?.height).toBeGreaterThan(125);
      expect(figurePicture?.top).toBeGreaterThanOrEqual(Number(title?.bottom) - 1);
      expect(figurePicture?.left).toBeLessThan(Number(title?.right));
    }
    const overlapPixels = await widget.evaluate(({ shadowRoot }) => {
      const viewsElement = /** @type {Element} */ (shadowRoot?.querySelector('.views'));
      const lowestPicture = Math.max(...[...viewsElement.querySelectorAll('.stage')].map((pictureFrameElement) => pictureFrameElement.getBoundingClientRect().bottom));
      const elementsBelow = [...(viewsElement.parentElement?.children ?? [])].filter((element) => viewsElement.compareDocumentPosition(element) === Node.DOCUMENT_POSITION_FOLLOWING);
      const followingTops = elementsBelow.map((element) => element.getBoundingClientRect()).filter(({ height }) => height > 0).map(({ top: topEdge }) => topEdge);
      return lowestPicture - Math.min(...followingTops);
    });
    expect(overlapPixels).toBeLessThanOrEqual(0);
  }
});
