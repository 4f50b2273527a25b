import { expect } from '@playwright/test';
import { REDUCED_MOTION, waitForFrames, test, untilReady } from './support.js';

/** @import { Locator, Page } from '@playwright/test' */

// The chapter's exercises 4, 5 and 7 on the page, by keyboard only: a user predicts the answer, and then reveals it.
test.use(REDUCED_MOTION);

/** Opens the page at the section of a figure. @param {Page} page @param {string} section */
async function openSection(page, section) {
  await page.goto(`/#${section}`);
  const article = page.locator(`#${section}`);
  await untilReady(article.locator('.stand > *'));
  return article;
}

/** Presses the button of a form, and returns the answer that it reveals. @param {Locator} form */
async function revealAnswer(form) {
  await form.getByRole('button').press('Enter');
  await expect(form.getByRole('status')).not.toHaveText('');
  await waitForFrames(form.page());
  return (await form.getByRole('status').textContent())?.replaceAll('\u00a0', ' ') ?? '';
}

test('exercise 4: a sketch is chosen, and the robots of α₄ alone and α₆ alone appear below it', async ({ page }) => {
  const article = await openSection(page, 'banana');
  const form = article.locator('.sketch');
  const readIsolateAndOmega = () => article.locator('banana-machine').evaluate((figure) => [Reflect.get(figure, 'isolate'), Reflect.get(figure, 'omega')]);
  const caseRadios = form.locator('[name=case]');
  const predictAndReveal = async (shape = 'an ellipse') => {
    await expect(form.getByRole('button')).toBeDisabled();
    await form.getByLabel(shape).press('Space');
    await expect(form.locator('.drawn')).toHaveAttribute('d', /^M.*Z$/);
    const revealedText = await revealAnswer(form);
    await expect(form.locator('.robots')).toHaveAttribute('d', /^M/);
    return revealedText;
  };
  const noCloudText = 'Not what you expected. Every robot stops at the same point, with the same heading. There is no cloud.';
  expect(await predictAndReveal()).toBe(noCloudText);
  expect(await readIsolateAndOmega()).toEqual([4, 0]);
  const { alphas, command } = await article.locator('banana-machine').evaluate((figure) => /** @type {any} */ (figure).getState());
  expect([alphas.velocity[3], alphas.velocity[5], command.v * command.dt, command.dt]).toEqual([0.09, 0.01, 2, 2]);
  await caseRadios.nth(0).press('ArrowDown');
  expect(await predictAndReveal()).toBe(noCloudText);
  expect(await readIsolateAndOmega()).toEqual([6, 0]);
  await caseRadios.nth(1).press('ArrowDown');
  expect(await predictAndReveal()).toMatch(/^Not what you expected\. The robots spread over a curved band, by 0\.\d+ m \(1σ\), their headings by 0\.\d+ rad\.$/);
  expect(await readIsolateAndOmega()).toEqual([4, 0.5]);
  await caseRadios.nth(2).press('ArrowDown');
  expect(await predictAndReveal('a point')).toMatch(/^Right\. Every robot stops at the same point\. Only the headings differ, by 0\.\d+ rad/);
  expect(await readIsolateAndOmega()).toEqual([6, 0.5]);
});

test('exercise 4: a sketch drawn with the pointer stays over the robots', async ({ page }) => {
  const form = (await openSection(page, 'banana')).locator('.sketch');
  const pad = form.locator('.pad');
  await pad.scrollIntoViewIfNeeded();
  await pad.dragTo(pad, { sourcePosition: { x: 150, y: 40 }, targetPosition: { x: 220, y: 120 } });
  const sketchPath = await form.locator('.drawn').getAttribute('d');
  expect(sketchPath?.split('L').length).toBeGreaterThan(1);
  // The first case has no noise.
  expect(await revealAnswer(form)).toMatch(/^Not what you expected\. Every robot stops at the same point/);
  expect(await form.locator('.drawn').getAttribute('d')).toBe(sketchPath);
  await form.locator('[name=case]').nth(2).check();
  // The outline is a rectangle along the edge of the pad, which contains every robot.
  const { x: left, y: top, width, height } = /** @type {{ x: number, y: number, width: number, height: number }} */ (await pad.boundingBox());
  const rectangleCorners = [[2, 2], [width - 2, 2], [width - 2, height - 2], [2, height - 2]];
  await pad.hover({ position: { x: 2, y: 2 } });
  await form.page().mouse.down();
  for (const [x, y] of rectangleCorners.slice(1)) await form.page().mouse.move(left + x, top + y);
  await form.page().mouse.up();
  expect(await revealAnswer(form)).toMatch(/^100 % of the robots stop inside your outline\. The robots spread/);
});

test('exercise 5: noise alone stays below 40 %, and a curve does not', async ({ page }) => {
  const article = await openSection(page, 'squeeze');
  const answerPercents = [];
  for (const form of await article.locator('.bet').all()) {
    await form.getByRole('slider').press('End');
    await expect(form.locator('.value')).toHaveText('100 %');
    const revealedText = await revealAnswer(form);
    const [, answerText] = /^Your bet: 100 %\. The figure’s answer, ▲: ([\d.]+) %\.$/.exec(revealedText) ?? [];
    answerPercents.push(Number(answerText));
  }
  expect(answerPercents[0]).toBeLessThan(40);
  expect(answerPercents[1]).toBeGreaterThan(70);
  expect(await article.locator('map-squeeze').evaluate((figure) => Reflect.get(figure, 'omega'))).toBe(0.6);
});

test('exercise 7: the steps of both noises are bet on, and then the curve of the variance along the track is shown', async ({ page }) => {
  const article = await openSection(page, 'reckoning');
  const curveCheckbox = article.getByRole('checkbox', { name: 'along the track' });
  const explanation = article.getByText('Does twice the σ halve the steps?');
  for (const [betIndex, expectedStep] of [15, 9].entries()) {
    const form = article.locator('.bet').nth(betIndex);
    await expect(form.getByRole('button')).toBeDisabled();
    await expect(explanation).toBeHidden();
    await form.getByRole('slider').press('ArrowRight');
    await expect(curveCheckbox).toBeChecked({ checked: false });
    expect(await revealAnswer(form)).toBe(`Your bet: 11. The figure’s answer, ▲: ${expectedStep}.`);
  }
  await expect(curveCheckbox).toBeChecked();
  await expect(explanation).toBeVisible();
  await expect(article.getByText('predicted along-track variance', { exact: true })).toBeVisible();
});

test('on a phone, the picture that stays beside an item shows what the item sets', async ({ page }) => {
  await page.setViewportSize({ width: 375, height: 800 });
  const article = await openSection(page, 'reckoning');
  const takePicture = () => article.locator('dead-reckoning canvas').first().evaluate((canvas) => /** @type {HTMLCanvasElement} */ (canvas).toDataURL());
  const stepsButton = article.getByRole('button', { name: '200 steps', exact: true });
  await stepsButton.scrollIntoViewIfNeeded();
  const pictureBefore = await takePicture();
  await stepsButton.click();
  await expect.poll(takePicture).not.toBe(pictureBefore);
});
