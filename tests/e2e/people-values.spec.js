import { expect } from '@playwright/test';
import { expectAccessible } from './axe.js';
import { REDUCED_MOTION, waitForFrames, openBananaWithDisclosures, readProperty, takeEvents, test, valueFieldOf } from './support.js';

/** @typedef {import('@playwright/test').Locator} Locator */

test.use(REDUCED_MOTION);

/** Returns the help text of a slider. @param {Locator} widget @param {string} settingKey of the setting */
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

test('arrow keys in the field of a value move the slider by a step, and not beyond its end', async ({ page }) => {
  const widget = await openBananaWithDisclosures(page);
  const valueInput = valueFieldOf(widget, 'v');
  await valueInput.click();
  for (const [pressedKey, expectedSpeed] of /** @type {const} */ ([['ArrowUp', 1.01], ['ArrowDown', 1]])) {
    await page.keyboard.press(pressedKey);
    await expect(valueInput).toHaveValue(`${expectedSpeed.toFixed(2)} m/s`);
    expect(await readProperty(widget, 'v')).toBe(expectedSpeed);
  }
  expect((await takeEvents(page, ['input', 'change'])).map(({ name }) => name)).toEqual(['input', 'change', 'input', 'change']);
  // A typed value beyond the end of the slider's range is kept.
  await page.keyboard.type('7');
  for (const pressedKey of ['ArrowUp', 'ArrowUp']) await page.keyboard.press(pressedKey);
  expect(await readProperty(widget, 'v')).toBe(7);
});

test('a typed value may have its unit, a minus sign U+2212 and more decimals, and Escape cancels typing', async ({ page }) => {
  const widget = await openBananaWithDisclosures(page);
  const valueInput = valueFieldOf(widget, 'v');
  await expect(helpOf(widget, 'v')).toHaveText('How far the robot drives: vΔt; below zero it backs up.');
  // This field needs the full keyboard of a phone, because the numeric keyboard has no minus sign.
  await expect(valueInput).toHaveAttribute('inputmode', 'text');
  await valueInput.click();
  await page.keyboard.type('\u22122.125 m/s');
  await page.keyboard.press('Tab');
  expect(await readProperty(widget, 'v')).toBe(-2.125);
  await expect(valueInput).toHaveValue('\u22122.125 m/s');
  await expect(helpOf(widget, 'v')).toHaveText('Ends at \u22121.50 m/s; type values beyond.');
  await valueInput.click();
  await page.keyboard.type('7');
  await page.keyboard.press('Escape');
  await expect(widget.locator('#v')).toBeFocused();
  await expect(valueInput).toHaveValue('\u22122.125 m/s');
  expect(await readProperty(widget, 'v')).toBe(-2.125);
  // Enter moves the focus from the slider to its text field, and changes no value.
  await takeEvents(page);
  await page.keyboard.press('Enter');
  await expect(valueInput).toBeFocused();
  await page.keyboard.press('Enter');
  expect(await takeEvents(page)).toEqual([]);
});

test('a refused value is reported with the allowed range, and the last valid value stays', async ({ page }) => {
  const widget = await openBananaWithDisclosures(page);
  for (const [settingKey, typedText, expectedError] of [
    ['alpha1', ' -1 ', 'α₁ must be a number between 0 and 1\u202f000\u202f000 (got −1).'],
    ['omega', '1,5', 'ω must be a number between −1\u202f000\u202f000 and 1\u202f000\u202f000, with a decimal point (got "1,5").'],
    ['omega', 'abc', 'ω must be a number between −1\u202f000\u202f000 and 1\u202f000\u202f000 (got "abc").'],
    ['samples', '2.5', 'N must be a whole number between 1 and 10\u202f000\u202f000 (got 2.5).'],
  ]) {
    const valueBefore = await readProperty(widget, settingKey);
    const valueInput = valueFieldOf(widget, settingKey);
    const shownText = await valueInput.inputValue();
    await valueInput.click();
    await valueInput.fill(typedText);
    await page.keyboard.press('Enter');
    await expect(widget.locator('[role=alert]')).toHaveText(expectedError);
    await expect(helpOf(widget, settingKey)).toBeVisible();
    await expect(valueInput).toBeFocused();
    await expect(valueInput).toHaveValue(shownText);
    await expect(valueInput).toHaveAttribute('aria-describedby', `${settingKey}-effect`);
    await expect(valueInput).toHaveAttribute('aria-invalid', 'true');
    expect(await readProperty(widget, settingKey)).toBe(valueBefore);
    expect(await takeEvents(page, ['input', 'change', 'error'])).toEqual([]);
    if (settingKey === 'samples') await expectAccessible(page, undefined, 'banana-machine');
    await page.keyboard.type('1');
    await expect(widget.locator('[role=alert]')).toHaveCount(0);
    await expect(valueInput).toHaveAttribute('aria-invalid', 'false');
    await page.keyboard.press('Escape');
  }
  // Thousands separators are accepted in the notation of English and in that of the page's language.
  for (const numberText of ['2,000', '3\u202f000']) {
    await valueFieldOf(widget, 'samples').fill(numberText);
    await page.keyboard.press('Enter');
    expect(await readProperty(widget, 'samples')).toBe(Number(numberText.replace(/\D/, '')));
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
  await expect(valueInput).toHaveValue('0.170');
  expect(await readProperty(widget, 'alpha1')).toBe(0.17);
});

test('numbers in German have a decimal comma, and may be typed with a decimal point', async ({ page }) => {
  const widget = await openBananaWithDisclosures(page);
  await page.addScriptTag({ type: 'module', url: '/de.js' });
  await page.evaluate(() => (document.documentElement.lang = 'de'));
  await waitForFrames(page);
  for (const [typedText, expectedValue] of [['0,35', 0.35], ['0.45', 0.45]]) {
    await widget.locator('#alpha1').focus();
    await page.keyboard.type(String(typedText));
    await page.keyboard.press('Enter');
    expect(await readProperty(widget, 'alpha1')).toBe(expectedValue);
  }
  await expect(valueFieldOf(widget, 'alpha1')).toHaveValue('0,450');
  // The number of robots is an integer, so that a point before three digits separates thousands.
  await widget.locator('#samples').focus();
  await page.keyboard.type('20.000');
  await page.keyboard.press('Enter');
  expect(await readProperty(widget, 'samples')).toBe(20_000);
  await expect(helpOf(widget, 'alpha1')).toContainText('Endet bei 0,200');
});
