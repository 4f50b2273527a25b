import { expect } from '@playwright/test';
import { REDUCED_MOTION, setProperty, readBox, mountFigure, readProperty, showPage, takeEvents, test, waitUntilReady } from './support.js';

test.use(REDUCED_MOTION);

test('a figure shows the page’s title above its picture and the page’s caption below it', async ({ page, figureName }) => {
  await showPage(page, `<${figureName} heading-level="3"><span slot="title">Figure 9.3 One command</span><p slot="caption">As <b>measured</b>.</p></${figureName}>`);
  const widget = page.locator(figureName);
  await waitUntilReady(widget);
  await expect(widget.getByRole('heading', { name: 'Figure 9.3 One command', level: 3 })).toBeVisible();
  await expect(widget.getByRole('region', { name: 'Figure 9.3 One command' })).toBeVisible();
  const [titleBox, pictureBox, captionBox] = await Promise.all([widget.getByText('Figure 9.3'), widget.locator('canvas').first(), widget.getByText('measured', { exact: true })].map(readBox));
  expect(titleBox.y + titleBox.height).toBeLessThanOrEqual(pictureBox.y);
  expect(captionBox.y).toBeGreaterThan(pictureBox.y + pictureBox.height);
  await page.emulateMedia({ media: 'print' });
  await expect(widget.getByText('Figure 9.3')).toBeVisible();
  await expect(widget.getByText('measured', { exact: true })).toBeVisible();
  await page.emulateMedia({ media: 'screen' });
  await widget.evaluate((element) => element.removeAttribute('heading-level'));
  await expect(widget.getByRole('heading')).toHaveCount(0);
  await widget.evaluate((element) => element.replaceChildren());
  await expect(widget.getByRole('region', { name: /^(The Banana Machine|Map Squeeze|Arc Anatomy|The Odometry Decomposer|Dead Reckoning|The Alpha Calibrator)$/ })).toBeVisible();
  await widget.evaluate((element) => element.setAttribute('heading-level', '3'));
  await expect(widget.getByRole('heading')).toHaveCount(0);
});

test('heading-level accepts the levels 1 to 6, as an attribute and as a property @nightly', async ({ page }) => {
  const widget = await mountFigure(page, 'map-squeeze', { attributes: 'heading-level="9"' });
  expect((await takeEvents(page, ['error'])).map(({ message: errorMessage }) => errorMessage)).toEqual(['headingLevel is "9"; allowed is "1" or "2" or "3" or "4" or "5" or "6"']);
  expect(await setProperty(widget, 'headingLevel', 7)).toContain('RangeError: headingLevel is "7"');
  expect(await setProperty(widget, 'headingLevel', 2)).toBe('');
  expect([await readProperty(widget, 'headingLevel'), await widget.getAttribute('heading-level')]).toEqual(['2', '2']);
  expect(await setProperty(widget, 'headingLevel', null)).toBe('');
  expect(await widget.getAttribute('heading-level')).toBe(null);
});
