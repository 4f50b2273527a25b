import { expect } from '@playwright/test';
import { expectAccessible } from './axe.js';
import { heard, property, ready, show } from './element-support.js';
import { settings } from '../../www/settings.js';
import { STILL, counted, frames, test, unfold, valueField } from './support.js';

/** @typedef {import('@playwright/test').Locator} Locator */

test.use(STILL);

/**
 * @param {import('@playwright/test').Page} page
 * @param {string} name
 */
async function widgetOf(page, name) {
  await show(page, `<${name}></${name}>`);
  const widget = page.locator(name);
  await ready(widget);
  await heard(page);
  return widget;
}

/** What is said of the row. @param {Locator} widget @param {string} key */
const help = (widget, key) => widget.locator(`#${key}-effect`);

test('a digit on a slider leads into its value, Enter back, and the value may lie beyond the slider', async ({ page }) => {
  const widget = await widgetOf(page, 'banana-machine');
  const slider = widget.locator('#alpha1');
  await slider.focus();
  await page.keyboard.type('0.4');
  await expect(valueField(widget, 'alpha1')).toBeFocused();
  await page.keyboard.press('Enter');
  await expect(slider).toBeFocused();
  expect(await property(widget, 'alpha1')).toBe(0.4);
  expect((await heard(page, ['input', 'change'])).map(({ name }) => name)).toEqual(['input', 'change']);
  // The thumb stands at its end, and is marked.
  await expect(slider).toHaveValue('0.2');
  await expect(slider).toHaveAttribute('aria-valuetext', '0.400');
  await expect(widget.locator('.slider.above')).toHaveCount(1);
  await expect(help(widget, 'alpha1')).toHaveText('The slider ends at 0.200; values beyond can be typed.');
  await expect(help(widget, 'alpha1')).toBeVisible();
  // Back on the slider, it goes on from its end.
  await page.keyboard.press('ArrowLeft');
  expect(await property(widget, 'alpha1')).toBeLessThan(0.2);
  await expect(widget.locator('.slider.above')).toHaveCount(0);
  // At its end, values beyond can be typed.
  await page.keyboard.press('End');
  await expect(help(widget, 'alpha1')).toHaveText('The slider ends at 0.200; values beyond can be typed.');
  await expect(widget.locator('.slider.above')).toHaveCount(0);
  // Below its least value, none is allowed.
  await page.keyboard.press('Home');
  await expect(help(widget, 'alpha1')).not.toContainText('The slider ends');
});

for (const [name, key, fold] of [
  ['odometry-decomposer', 'phase'],
  ['odometry-decomposer', 'correlation', 'Noise and outcomes'],
  ['odometry-decomposer', 'samples', 'Noise and outcomes'],
  ['dead-reckoning', 'steps'],
]) {
  test(`at either end of ${name}’s ${key} nothing is said of values beyond, as there are none`, async ({ page }) => {
    const widget = await widgetOf(page, name);
    if (fold) await widget.locator('summary', { hasText: fold }).click();
    for (const end of key === 'samples' ? ['End'] : ['End', 'Home']) {
      await widget.locator(`#${key}`).press(end);
      await expect(widget.locator('.slider:focus-within .effect')).toBeVisible();
      await expect(help(widget, key)).not.toContainText('The slider ends');
    }
  });
}

test('a value is typed with its unit, a true minus and few more decimals, and Escape takes it back', async ({ page }) => {
  const widget = await widgetOf(page, 'banana-machine');
  const field = valueField(widget, 'v');
  await expect(help(widget, 'v')).toHaveText('How far along the arc; below zero the robot backs up.');
  await field.click();
  await page.keyboard.type('\u22122.125 m/s');
  await page.keyboard.press('Tab');
  expect(await property(widget, 'v')).toBe(-2.125);
  await expect(field).toHaveValue('\u22122.125 m/s');
  await expect(help(widget, 'v')).toHaveText('The slider ends at \u22121.50 m/s; values beyond can be typed.');
  await field.click();
  await page.keyboard.type('7');
  await page.keyboard.press('Escape');
  await expect(widget.locator('#v')).toBeFocused();
  await expect(field).toHaveValue('\u22122.125 m/s');
  expect(await property(widget, 'v')).toBe(-2.125);
  // From the slider by Enter, and nothing is changed by that alone.
  await heard(page);
  await page.keyboard.press('Enter');
  await expect(field).toBeFocused();
  await page.keyboard.press('Enter');
  expect(await heard(page)).toEqual([]);
});

for (const [key, text, complaint] of [
  ['alpha1', '-1', 'α₁ is −1; allowed is 0 to 1\u202f000\u202f000.'],
  ['alpha1', ' -1 ', 'α₁ is −1; allowed is 0 to 1\u202f000\u202f000.'],
  ['omega', 'quick', 'ω is "quick"; allowed is −1\u202f000\u202f000 to 1\u202f000\u202f000.'],
  ['omega', '1,5', 'ω is "1,5"; allowed is −1\u202f000\u202f000 to 1\u202f000\u202f000, with a decimal point.'],
  ['omega', '', 'ω is ""; allowed is −1\u202f000\u202f000 to 1\u202f000\u202f000.'],
  ['dt', '0', 'Δt is 0; allowed is 1·10⁻⁶ to 1\u202f000\u202f000.'],
  ['samples', '2.5', 'N is 2.5; allowed is a whole number from 1 to 10\u202f000\u202f000.'],
]) {
  test(`${key} refuses "${text}", says what is allowed, and keeps its value`, async ({ page }) => {
    const widget = await widgetOf(page, 'banana-machine');
    const before = await property(widget, key);
    const field = valueField(widget, key);
    const shown = await field.inputValue();
    await field.click();
    await field.fill(text);
    await page.keyboard.press('Enter');
    await expect(widget.locator('[role=alert]')).toHaveText(complaint);
    await expect(help(widget, key)).toBeVisible();
    await expect(field).toBeFocused();
    await expect(field).toHaveValue(shown);
    await expect(field).toHaveAttribute('aria-describedby', `${key}-effect`);
    expect(await property(widget, key)).toBe(before);
    expect(await heard(page)).toEqual([]);
    await expectAccessible(page, undefined, 'banana-machine');
    await page.keyboard.type('1');
    // Something else is of interest now.
    await expect(widget.locator('[role=alert]')).toHaveCount(0);
    await page.keyboard.press('Enter');
    await expect.poll(() => property(widget, key)).toBe(1);
  });
}

for (const text of ['2,000', '2\u202f000']) {
  test(`a value is taken as ${text.includes(',') ? 'English groups' : 'the page prints'} it: ${text}`, async ({ page }) => {
    const widget = await widgetOf(page, 'banana-machine');
    await valueField(widget, 'samples').fill(text);
    await page.keyboard.press('Enter');
    expect(await property(widget, 'samples')).toBe(2000);
  });
}

test('a number that no sample has is refused and kept until it is right or left', async ({ page }) => {
  for (const [name, id, label] of [['banana-machine', 'robot', 'Robot'], ['map-squeeze', 'sample', 'Sample']]) {
    const widget = await widgetOf(page, name);
    await unfold(widget);
    const field = widget.locator(`#${id}`);
    const said = widget.locator('.marked [role=alert]');
    const samples = await property(widget, 'samples');
    for (const text of ['0', '2.5', '-4', String(samples + 1), '999999999']) {
      await field.fill('7');
      await field.fill(text);
      const given = text.replace('-', '\u2212');
      await expect(said).toHaveText(`${label} is ${given}; allowed is a whole number from 1 to ${counted(samples)}.`);
      await expect(field).toHaveValue(text);
      expect(await property(widget, 'marked')).toBe(6);
      await field.blur();
      await expect(field).toHaveValue('7');
      await expect(said).toHaveCount(0);
    }
    for (const number of [1, samples]) {
      await field.fill('0');
      await expect(said).toHaveCount(1);
      await field.fill(String(number));
      await expect(said).toHaveCount(0);
      expect(await property(widget, 'marked')).toBe(number - 1);
    }
    await field.fill('');
    expect(await property(widget, 'marked')).toBe(null);
  }
});

test('every slider takes the least and the greatest value of the core', async ({ page }) => {
  for (const name of ['banana-machine', 'map-squeeze']) {
    const widget = await widgetOf(page, name);
    const keys = await widget.locator('.slider input[type=range]').evaluateAll((sliders) => sliders.map(({ id }) => id));
    expect(keys.length).toBeGreaterThan(5);
    for (const key of keys) {
      const { min = NaN, max = NaN } = settings[name].find((setting) => setting.key === key) ?? {};
      // The other keys of a phone have no minus.
      if (min < 0) await expect(valueField(widget, key)).toHaveAttribute('inputmode', 'text');
      // A million samples take their time, and are no other case.
      for (const value of key === 'samples' ? [min] : [min, max]) {
        await valueField(widget, key).click();
        await valueField(widget, key).fill(String(value));
        await page.keyboard.press('Enter');
        expect(await property(widget, key), `${name}: ${key}`).toBe(value);
      }
      await widget.evaluate((element, name) => element.removeAttribute(name), key);
    }
  }
});

test('what is typed before the picture of the former value is there is not lost, and what is not typed is not taken', async ({ page }) => {
  const widget = await widgetOf(page, 'banana-machine');
  const field = valueField(widget, 'alpha1');
  const set = (/** @type {number} */ value) => widget.evaluate(async (element, value) => {
    /** @type {any} */ (element).alpha1 = value;
    await /** @type {import('lit').LitElement} */ (element).updateComplete;
  }, value);
  await field.focus();
  await page.keyboard.type('0.1');
  await set(0.15);
  await frames(page);
  await expect(field).toHaveValue('0.1');
  await page.keyboard.type('2');
  await page.keyboard.press('Enter');
  expect(await property(widget, 'alpha1')).toBe(0.12);
  // Escape leads back to the value that is there now.
  await field.focus();
  await page.keyboard.type('9');
  await set(0.17);
  await frames(page);
  await page.keyboard.press('Escape');
  await expect(field).toHaveValue('0.170');
  expect(await property(widget, 'alpha1')).toBe(0.17);
  // A value that changes under a field in which nobody has typed is shown, and stays what it is to its last digit.
  await field.focus();
  await set(0.123456);
  await expect(field).toHaveValue('0.123');
  await heard(page);
  await page.keyboard.press('Enter');
  await expect(widget.locator('#alpha1')).toBeFocused();
  expect(await property(widget, 'alpha1')).toBe(0.123456);
  expect(await heard(page)).toEqual([]);
  for (const value of [0.15, 0.17]) {
    await set(value);
    await expect(field).toHaveValue(`${value}0`);
  }
});

test('German has a decimal comma, and takes a point too', async ({ page }) => {
  const widget = await widgetOf(page, 'banana-machine');
  await page.addScriptTag({ type: 'module', url: '/de.js' });
  await page.evaluate(() => (document.documentElement.lang = 'de'));
  await frames(page);
  for (const [text, value] of [['0,35', 0.35], ['0.45', 0.45]]) {
    await widget.locator('#alpha1').focus();
    await page.keyboard.type(String(text));
    await page.keyboard.press('Enter');
    expect(await property(widget, 'alpha1')).toBe(value);
  }
  await expect(valueField(widget, 'alpha1')).toHaveValue('0,450');
  // Of robots there are whole ones: a point before three digits is no decimal one.
  await widget.locator('#samples').focus();
  await page.keyboard.type('20.000');
  await page.keyboard.press('Enter');
  expect(await property(widget, 'samples')).toBe(20_000);
  await expect(help(widget, 'alpha1')).toContainText('Der Regler endet bei 0,200');
});

test('the focus cuts through no line of help', async ({ page }) => {
  const widget = await widgetOf(page, 'banana-machine');
  for (const key of await widget.locator('.slider input[type=range]').evaluateAll((sliders) => sliders.map(({ id }) => id))) {
    await widget.locator(`#${key}`).focus();
    await page.keyboard.press('Shift+Tab');
    await page.keyboard.press('Tab');
    const outline = await widget.locator(`#${key}`).evaluate((slider) => {
      const { outlineStyle } = getComputedStyle(slider);
      return [outlineStyle, getComputedStyle(slider, '::-webkit-slider-thumb').outlineStyle];
    });
    expect(outline[0], key).toBe('none');
  }
});
