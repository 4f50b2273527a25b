import { expect } from '@playwright/test';
import { expectAccessible } from './axe.js';
import { REDUCED_MOTION, waitForFrames, openBananaWithDisclosures, printedValueOf, readProperty, takeEvents, test, valueFieldOf } from './support.js';

/** @typedef {import('@playwright/test').Locator} Locator */

test.use(REDUCED_MOTION);

/** Returns the help text of a slider. @param {Locator} widget @param {string} settingKey */
const helpOf = (widget, settingKey) => widget.locator(`#${settingKey}-effect`);

test('a digit typed on a slider edits its value, Enter returns to the slider, and the value may exceed the slider’s range', async ({ page }) => {
  const widget = await openBananaWithDisclosures(page);
  const alpha1Slider = widget.locator('#alpha1');
  await alpha1Slider.focus();
  await page.keyboard.type('0.4');
  await expect(valueFieldOf(widget, 'alpha1')).toBeFocused();
  await page.keyboard.press('Enter');
  await expect(alpha1Slider).toBeFocused();
  expect(await readProperty(widget, 'alpha1')).toBe(0.4);
  expect((await takeEvents(page, ['input', 'change'])).map(({ name }) => name)).toEqual(['input', 'change']);
  await expect(alpha1Slider).toHaveValue('0.2');
  await expect(alpha1Slider).toHaveAttribute('aria-valuetext', '0.400');
  await expect(helpOf(widget, 'alpha1')).toHaveText('Ends at 0.200; type values beyond.');
  await expect(helpOf(widget, 'alpha1')).toBeVisible();
  // An arrow key starts from the end of the slider's range, even if the typed value is beyond this end.
  await page.keyboard.press('ArrowLeft');
  expect(await readProperty(widget, 'alpha1')).toBeLessThan(0.2);
  await page.keyboard.press('End');
  await expect(helpOf(widget, 'alpha1')).toHaveText('Ends at 0.200; type values beyond.');
  await page.keyboard.press('Home');
  await expect(helpOf(widget, 'alpha1')).not.toContainText('Ends at');
});

test('arrow keys in the field of a value step as the slider does, and not beyond its end', async ({ page }) => {
  const widget = await openBananaWithDisclosures(page);
  const valueInput = valueFieldOf(widget, 'dt');
  await valueInput.click();
  for (const [pressedKey, expectedDuration] of /** @type {const} */ ([['ArrowUp', 2.05], ['ArrowDown', 2]])) {
    await page.keyboard.press(pressedKey);
    await expect(printedValueOf(widget, 'dt')).toHaveText(`${expectedDuration.toFixed(2)} s`);
    expect(await readProperty(widget, 'dt')).toBe(expectedDuration);
  }
  expect((await takeEvents(page, ['input', 'change'])).map(({ name }) => name)).toEqual(['input', 'change', 'input', 'change']);
  // A typed value beyond the end of the slider's range is kept.
  await valueInput.fill('7');
  await page.keyboard.press('ArrowUp');
  await page.keyboard.press('Enter');
  expect(await readProperty(widget, 'dt')).toBe(7);
});

test('a typed value may have more decimals, a copied minus sign or a decimal comma, and Escape cancels typing', async ({ page }) => {
  const widget = await openBananaWithDisclosures(page);
  const valueInput = valueFieldOf(widget, 'v');
  await expect(helpOf(widget, 'v')).toHaveText('How far the robot drives: vΔt; below zero it backs up.');
  for (const [typedText, endKey, expectedSpeed] of [['0,5', 'Enter', 0.5], ['\u22122.125 m/s', 'Tab', -2.125]]) {
    await valueInput.click();
    await page.keyboard.insertText(String(typedText));
    await page.keyboard.press(String(endKey));
    expect(await readProperty(widget, 'v')).toBe(expectedSpeed);
  }
  await expect(printedValueOf(widget, 'v')).toHaveText('\u22122.125 m/s');
  await expect(helpOf(widget, 'v')).toHaveText('Ends at \u22121.50 m/s; type values beyond.');
  await valueInput.click();
  await page.keyboard.type('7');
  await page.keyboard.press('Escape');
  await expect(widget.locator('#v')).toBeFocused();
  await expect(valueInput).toHaveValue('-2.125');
  expect(await readProperty(widget, 'v')).toBe(-2.125);
  // Enter moves the focus from the slider to its field, and changes no value.
  await takeEvents(page);
  await page.keyboard.press('Enter');
  await expect(valueInput).toBeFocused();
  await page.keyboard.press('Enter');
  await expect(widget.locator('#v')).toBeFocused();
  expect(await takeEvents(page)).toEqual([]);
});

test('a number that is not allowed is reported by the browser, and the last valid value stays', async ({ page }) => {
  const widget = await openBananaWithDisclosures(page);
  for (const [settingKey, typedText, violatedLimit] of [['alpha1', '-1', 'rangeUnderflow'], ['omega', '1e7', 'rangeOverflow'], ['omega', '1e', 'badInput'], ['omega', '', 'valueMissing'], ['samples', '2.5', 'stepMismatch']]) {
    const valueBefore = await readProperty(widget, settingKey);
    const valueInput = valueFieldOf(widget, settingKey);
    await valueInput.click();
    await page.keyboard.press('Delete');
    await page.keyboard.type(typedText);
    await page.keyboard.press('Enter');
    await expect(valueInput).toBeFocused();
    expect(await valueInput.evaluate((element, violatedLimit) => [element.matches(':user-invalid'), Reflect.get(/** @type {HTMLInputElement} */ (element).validity, violatedLimit)], violatedLimit)).toEqual([true, true]);
    if (settingKey === 'samples') await expectAccessible(page, undefined, 'banana-machine');
    await valueInput.blur();
    await expect(valueInput).toHaveValue(String(valueBefore));
    expect(await readProperty(widget, settingKey)).toBe(valueBefore);
    expect(await takeEvents(page, ['input', 'change', 'error'])).toEqual([]);
  }
});

test('a change by the page does not replace text that the user is typing @nightly', async ({ page }) => {
  const widget = await openBananaWithDisclosures(page);
  const valueInput = valueFieldOf(widget, 'alpha1');
  const setAlpha1 = (/** @type {number} */ newAlpha1) => widget.evaluate(async (element, newAlpha1) => {
    /** @type {any} */ (element).alpha1 = newAlpha1;
    await /** @type {import('lit').LitElement} */ (element).updateComplete;
  }, newAlpha1);
  await valueInput.focus();
  await page.keyboard.type('0.1');
  await setAlpha1(0.15);
  await waitForFrames(page);
  await expect(valueInput).toHaveValue('0.1');
  await page.keyboard.type('2');
  await page.keyboard.press('Enter');
  expect(await readProperty(widget, 'alpha1')).toBe(0.12);
  await valueInput.focus();
  await page.keyboard.type('9');
  await setAlpha1(0.17);
  await waitForFrames(page);
  await page.keyboard.press('Escape');
  await expect(valueInput).toHaveValue('0.17');
  expect(await readProperty(widget, 'alpha1')).toBe(0.17);
});

test('numbers in German have a decimal comma, and may be typed with a comma or a point', async ({ page }) => {
  const widget = await openBananaWithDisclosures(page);
  await page.addScriptTag({ type: 'module', url: '/de.js' });
  await page.evaluate(() => (document.documentElement.lang = 'de'));
  await waitForFrames(page);
  for (const [name, typedText, expectedValue] of /** @type {const} */ ([['alpha1', '0,35', 0.35], ['alpha1', '0.45', 0.45], ['samples', '20.000', 20_000]])) {
    await widget.locator(`#${name}`).focus();
    await page.keyboard.type(typedText);
    await page.keyboard.press('Enter');
    expect(await readProperty(widget, name)).toBe(expectedValue);
  }
  await expect(printedValueOf(widget, 'alpha1')).toHaveText('0,450');
  await expect(helpOf(widget, 'alpha1')).toContainText('Endet bei 0,200');
});
