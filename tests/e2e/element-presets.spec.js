import { expect } from '@playwright/test';
import { REDUCED_MOTION, waitForFrames, mountFigure, readProperty, readState, test, openDisclosures } from './support.js';

test.use(REDUCED_MOTION);

test('a preset sets all settings except samples and seed, and its button is marked while these settings hold', async ({ page }) => {
  const widget = await mountFigure(page, 'map-squeeze', { attributes: 'samples="50" seed="4"' });
  const presetButton = widget.locator('.presets button').nth(1);
  await presetButton.click();
  await expect(presetButton).toHaveAttribute('aria-pressed', 'true');
  await widget.evaluate((element) => void Reflect.set(element, 'clearance', 0.2));
  await expect(presetButton).toHaveAttribute('aria-pressed', 'false');
  await presetButton.click();
  await expect(presetButton).toHaveAttribute('aria-pressed', 'true');
  expect(await Promise.all(['clearance', 'samples', 'seed'].map((settingKey) => readProperty(widget, settingKey)))).toEqual([0.13, 50, 4]);
});

test('Start over restores the settings, the seed and the overlays with which the figure opened', async ({ page }) => {
  const widget = await mountFigure(page, 'banana-machine', { attributes: 'preset="hard" samples="2000" seed="5" overlays="ellipse"' });
  const openingState = await readState(widget);
  await openDisclosures(widget);
  await widget.locator('#alpha4').fill('0.15');
  await widget.getByRole('button', { name: 'Pivot' }).click();
  await widget.getByRole('button', { name: 'New seed' }).click();
  await widget.getByRole('checkbox', { name: 'Gaussian in ξ' }).check();
  await widget.getByRole('button', { name: 'Clear' }).click();
  await waitForFrames(page);
  expect(await readState(widget)).not.toEqual(openingState);
  await widget.getByRole('button', { name: 'Start over' }).click();
  await expect.poll(() => readState(widget)).toEqual(openingState);
});

test('a seed can be typed, and an invalid seed is refused', async ({ page, cloudFigureName }) => {
  const widget = await mountFigure(page, cloudFigureName);
  await openDisclosures(widget);
  const seedField = widget.getByRole('spinbutton', { name: 'seed', exact: true });
  await seedField.fill('42');
  await seedField.press('Enter');
  await expect.poll(() => readProperty(widget, 'seed')).toBe(42);
  await seedField.fill('4.5');
  await seedField.press('Enter');
  await expect(widget.locator('.seed :user-invalid')).toBeFocused();
  expect(await readProperty(widget, 'seed')).toBe(42);
  await seedField.blur();
  await expect(seedField).toHaveValue('42');
});
