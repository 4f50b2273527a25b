import { expect } from '@playwright/test';
import { REDUCED_MOTION, waitForFrames, test, waitUntilReady } from './support.js';

/** @import { Locator, Page } from '@playwright/test' */

// Exercises 4, 5 and 7 of the chapter on the page, by keyboard only. A user predicts the answer, and then reveals it.
test.use(REDUCED_MOTION);

/** Opens the page at the section of a figure. @param {Page} page @param {string} sectionId */
async function openSection(page, sectionId) {
  await page.goto(`/#${sectionId}`);
  const sectionArticle = page.locator(`#${sectionId}`);
  await waitUntilReady(sectionArticle.locator('.stand'));
  return sectionArticle;
}

/** Presses the button of a form, and returns the answer that it reveals. @param {Locator} betForm */
async function revealAnswer(betForm) {
  await betForm.getByRole('button').press('Enter');
  await expect(betForm.getByRole('status')).not.toHaveText('');
  await waitForFrames(betForm.page());
  return (await betForm.getByRole('status').textContent())?.replaceAll('\u00a0', ' ') ?? '';
}

test('exercise 4: the figure shows the clouds with α₄ alone and α₆ alone, and says whether there is one', async ({ page }) => {
  const sectionArticle = await openSection(page, 'banana');
  const bananaMachine = sectionArticle.locator('banana-machine');
  const readIsolateAndOmega = () => bananaMachine.evaluate((figureElement) => [Reflect.get(figureElement, 'isolate'), Reflect.get(figureElement, 'omega')]);
  /** @type {[string, number, number, RegExp][]} */
  const expectedOutcomes = [
    ['α4, straight ahead', 4, 0, /no noise at all, so every robot stops exactly where it was told to/],
    ['α6, straight ahead', 6, 0, /no noise at all, so every robot stops exactly where it was told to/],
    ['α4, ω = 0.5', 4, 0.5, /Only one noise displaces the robots: they lie on a line/],
    ['α6, ω = 0.5', 6, 0.5, /every robot stops at the same point, and only the headings fan out/],
  ];
  for (const [buttonName, alphaNumber, omega, expectedCaption] of expectedOutcomes) {
    await sectionArticle.getByRole('button', { name: buttonName }).press('Enter');
    await expect(bananaMachine.locator('[part=caption]')).toHaveText(expectedCaption);
    expect(await readIsolateAndOmega()).toEqual([alphaNumber, omega]);
  }
  const { alphas, command } = await bananaMachine.evaluate((figureElement) => /** @type {any} */ (figureElement).getState());
  expect([alphas.velocity[3], alphas.velocity[5], command.v * command.dt, command.dt]).toEqual([0.09, 0.01, 2, 2]);
});

test('exercise 5: noise alone leads less than 40 % of the motions through walls, and a curve more than 70 %', async ({ page }) => {
  const sectionArticle = await openSection(page, 'squeeze');
  const answerPercents = [];
  for (const betForm of await sectionArticle.locator('.try form').all()) {
    await betForm.getByRole('slider').press('End');
    await expect(betForm.locator('.value')).toHaveText('100 %');
    const revealedText = await revealAnswer(betForm);
    const [, answerText] = /^Your bet: 100 %\. The figure’s answer, ▲: ([\d.]+) %\.$/.exec(revealedText) ?? [];
    answerPercents.push(Number(answerText));
  }
  expect(answerPercents[0]).toBeLessThan(40);
  expect(answerPercents[1]).toBeGreaterThan(70);
  expect(await sectionArticle.locator('map-squeeze').evaluate((figureElement) => Reflect.get(figureElement, 'omega'))).toBe(0.6);
});

test('exercise 7: after the user has bet on the steps of both noises, the variance along the track is shown', async ({ page }) => {
  const sectionArticle = await openSection(page, 'reckoning');
  const curveCheckbox = sectionArticle.getByRole('checkbox', { name: 'along the track' });
  const stepsExplanation = sectionArticle.getByText('Does twice the σ halve the steps?');
  for (const [betIndex, expectedStep] of [15, 9].entries()) {
    const betForm = sectionArticle.locator('.try form').nth(betIndex);
    await expect(betForm.getByRole('button')).toBeDisabled();
    await expect(stepsExplanation).toBeHidden();
    await betForm.getByRole('slider').press('ArrowRight');
    await expect(curveCheckbox).toBeChecked({ checked: false });
    expect(await revealAnswer(betForm)).toBe(`Your bet: 11. The figure’s answer, ▲: ${expectedStep}.`);
  }
  await expect(curveCheckbox).toBeChecked();
  await expect(stepsExplanation).toBeVisible();
  await expect(sectionArticle.getByText('predicted along-track variance', { exact: true })).toBeVisible();
});

test('on a phone, the sticky picture next to a gallery item shows the settings of the item', async ({ page }) => {
  await page.setViewportSize({ width: 375, height: 800 });
  const sectionArticle = await openSection(page, 'reckoning');
  const takePicture = () => sectionArticle.locator('dead-reckoning canvas').first().evaluate((canvasElement) => /** @type {HTMLCanvasElement} */ (canvasElement).toDataURL());
  const stepsButton = sectionArticle.getByRole('button', { name: '200 steps', exact: true });
  await stepsButton.scrollIntoViewIfNeeded();
  const pictureBefore = await takePicture();
  await stepsButton.click();
  await expect.poll(takePicture).not.toBe(pictureBefore);
});
