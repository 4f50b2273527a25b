import { expect } from '@playwright/test';
import { STILL, boxOf, counted, detail, frames, numberIn, openWhole, pictureOf, readout, state, test, unfold, valueField } from './support.js';

/**
 * @typedef {import('@playwright/test').Page} Page
 * @typedef {import('@playwright/test').Locator} Locator
 */

test.use(STILL);

/**
 * The figure in a column as wide as the window, at its top.
 *
 * @param {Page} page
 * @param {{ width: number, height: number }} size
 * @param {string} [attributes]
 */
async function alone(page, size, attributes = '') {
  await page.setViewportSize(size);
  await page.goto('/');
  await page.evaluate((html) => {
    document.body.innerHTML = html;
    document.body.style.cssText = 'margin: 0; padding: 0; max-width: none';
  }, `<banana-machine ${attributes}></banana-machine>`);
  const widget = page.locator('banana-machine');
  await expect(widget.locator('.presets')).toBeVisible();
  await frames(page);
  return widget;
}

for (const [size, language] of /** @type {const} */ ([
  [{ width: 700, height: 720 }, 'en'],
  [{ width: 1280, height: 720 }, 'en'],
  [{ width: 700, height: 720 }, 'de'],
])) {
  test(`pictures, sentence, figures and controls are seen at once at ${size.width} × ${size.height}, ${language}`, async ({ page }) => {
    const widget = await alone(page, size, `lang="${language}"`);
    const seen = ['canvas.plane', 'canvas.twist', '.caption > span', '.readouts', '.presets', '#v', '#omega', '#dt', '#samples', '.cloud .buttons', '#alpha1', '#alpha6'];
    for (const selector of seen) {
      const { x, y, width, height } = await boxOf(widget.locator(selector).first());
      expect(Math.min(x, y), selector).toBeGreaterThanOrEqual(0);
      expect(x + width, selector).toBeLessThanOrEqual(size.width);
      expect(y + height, selector).toBeLessThanOrEqual(size.height);
    }
    const [plane, twist] = [await boxOf(widget.locator('canvas.plane')), await boxOf(widget.locator('canvas.twist'))];
    expect(twist.y).toBe(plane.y);
    expect(twist.width).toBe(plane.width);
    expect(twist.height).toBe(plane.height);
    expect(twist.x).toBeGreaterThan(plane.x + plane.width);
    await expect(widget.locator('.machine > .readouts > div')).toHaveCount(3);
    await expectLines(widget, 1);
  });
}

/**
 * How many lines each of the three figures has below it.
 *
 * @param {Locator} widget
 * @param {number} lines
 */
async function expectLines(widget, lines) {
  const details = widget.locator('.machine > .readouts .detail');
  await expect(details).toHaveCount(3);
  const counts = await details.evaluateAll((all) =>
    all.map((each) => Math.round(each.getBoundingClientRect().height / parseFloat(getComputedStyle(each).lineHeight))),
  );
  expect(counts).toEqual([lines, lines, lines]);
}

for (const language of ['en', 'de']) {
  test(`on a phone the figure is at most 2000 px tall, and its figures are a line each, ${language}`, async ({ page }) => {
    const widget = await alone(page, { width: 375, height: 812 }, `lang="${language}"`);
    expect((await boxOf(widget)).height).toBeLessThanOrEqual(2000);
    await expectLines(widget, 1);
  });
}

/** @param {Locator} widget */
const sentence = (widget) => widget.locator('.caption > span');

test('the sentence says what the model decides and the robots show', async ({ page }) => {
  const widget = await openWhole(page);
  const press = (/** @type {string} */ name) => widget.getByRole('button', { name, exact: true }).click();
  await expect(sentence(widget)).toHaveText(/^The cloud is bent, with its tail to the right of the mean heading: skew −0\.431\s±\s0\.013, where any Gaussian in \(x, y\) has 0\.$/);
  await widget.locator('#omega').fill('-0.5');
  await expect(sentence(widget)).toHaveText(/tail to the left/);

  // Symmetric: exactly no skew, however many robots there are, and the ellipse covers twice the floor.
  await press('Banana');
  await frames(page);
  const { table } = await state(widget);
  expect(Math.abs(table.exact.crossTrackSkew)).toBeLessThan(1e-9);
  expect(Math.abs(table.exact.areaRatio - 1.97)).toBeLessThan(0.005);
  // Of one thing one number: what the sentence says stands beside it.
  const ratio = await readout(widget, 'area of ellipse').textContent();
  await expect(sentence(widget)).toHaveText(
    new RegExp(`^The cloud leans to neither side: skew −?0\\.\\d+\\s±\\s0\\.\\d+, exactly 0 by symmetry\\. Yet it is bent: its ellipse covers ${ratio} times the floor of the ξ outline\\.$`),
  );
  // However many robots, within what.
  await valueField(widget, 'samples').fill('300000');
  await valueField(widget, 'samples').press('Enter');
  await expect(sentence(widget)).toHaveText(/^The cloud leans to neither side: skew −?0\.00\d\s±\s0\.00\d, exactly 0 by symmetry\./);
  // Nearly symmetric, and as bent.
  await widget.locator('#omega').fill('0.02');
  await expect(sentence(widget)).toHaveText(/^The cloud hardly leans to either side: skew −?0\.\d+\s±\s0\.\d+, exactly −?0\.0\d+\. Yet it is bent: its ellipse covers/);
  await press('Straight');
  await frames(page);
  const gain = await readout(widget, 'gain of a Gaussian').textContent();
  await expect(sentence(widget)).toHaveText(new RegExp(`^The cloud leans to neither side: skew .*, exactly 0 by symmetry\\. Yet it is bent, with a gain of ${gain?.replaceAll(' ', '\\s')} nats a robot\\.$`));
  // Hardly any noise in the turn: nothing is bent.
  for (const id of ['alpha3', 'alpha4']) await widget.locator(`#${id}`).fill('0.001');
  await expect(sentence(widget)).toHaveText(/^The cloud leans to neither side: skew [^.]*\.\d+\s±\s[\d.]+, exactly 0 by symmetry\.$/);
});

test('few robots do not show the lean; the Pivot’s bow-tie has its reason', async ({ page }) => {
  const widget = await openWhole(page);
  await widget.getByRole('button', { name: 'Pivot' }).click();
  const { table, config } = await state(widget);
  const [, a2] = config.alphas;
  const deviation = Math.sqrt(config.alphas[0] * 0.06 ** 2 + a2 * 1.5 ** 2);
  await expect(sentence(widget)).toContainText(`v̂ is 0.06 ± ${deviation.toFixed(2)} m/s`);
  await expect(sentence(widget)).toContainText('ahead of the start and behind it');
  expect(Math.abs(table.exact.crossTrackSkew)).toBeGreaterThan(0.01);
  const behind = (await state(widget)).poses.filter((x, i) => i % 3 === 0 && x < 0).length;
  expect(behind / config.samples).toBeGreaterThan(0.3);

  // Under the odometry model the drive is what is left of the arc, and both rotations are noisy.
  await widget.getByLabel('odometry').check();
  const { config: turning } = await state(widget);
  const drive = 0.06 * (Math.sin(0.75) / 0.75);
  const spread = Math.sqrt(turning.alphas[2] * drive ** 2 + 2 * turning.alphas[3] * 0.75 ** 2);
  await expect(sentence(widget)).toContainText(`α₄ spreads a drive of ${drive.toFixed(2)} m by ${spread.toFixed(2)} m`);
  await widget.getByLabel('velocity').check();

  await widget.getByRole('button', { name: 'Gentle arc' }).click();
  await widget.locator('#samples').fill('3');
  const { stats, table: few } = await state(widget);
  expect(Math.abs(stats.crossTrackSkew)).toBeLessThan(2 * stats.crossTrackSkewError);
  await expect(sentence(widget)).toHaveText(new RegExp(`^Too few robots to show the lean: .*exactly −${Math.abs(few.exact.crossTrackSkew).toFixed(3)}\\.$`));
});

test('figures without meaning are a dash: α₅ alone leaves all robots in one place', async ({ page }) => {
  const widget = await openWhole(page);
  await widget.getByLabel('Isolate one').check();
  await widget.getByRole('radio', { name: 'Only α₅' }).check();
  await frames(page);
  for (const name of ['cross-track skew', 'gain of a Gaussian', 'area of ellipse', 'predicts', 'exact gain', 'exact area']) await expect(readout(widget, name)).toHaveText('—');
  await expect(detail(widget, 'gain of a Gaussian')).toHaveText('—');
  await expect(detail(widget, 'cross-track skew')).toHaveText('—');
  await expect(detail(widget, 'area of ellipse')).toHaveText('—');
  await widget.getByRole('radio', { name: 'Only α₄' }).check();
  await widget.locator('#omega').fill('0');
  await frames(page);
  const [plane, twist] = await widget.locator('canvas').evaluateAll((canvases) => canvases.map((canvas) => canvas.getAttribute('aria-label') ?? ''));
  const { shown, end } = await state(widget);
  expect(plane).toContain(`All ${counted(shown)} end at one place, x ${end[0].toFixed(2)} m, y 0.00 m.`);
  // Of the outlines on at first only the command has a length.
  expect(plane).toContain('Drawn over it: commanded arc.');
  expect(plane + twist).not.toContain('—');
  const picture = await widget.evaluate((element) => /** @type {any} */ (element).toSVG());
  expect(picture).toContain('>command</text>');
  expect(picture).not.toContain('>Gaussian in');
});

test('without γ̂ the gain is unbounded, and said of the floor', async ({ page }) => {
  const widget = await openWhole(page);
  await widget.getByRole('button', { name: 'Worked example' }).click();
  const { stats, table } = await state(widget);
  expect(table.exact.likelihoodGain.pose).toBe(Infinity);
  const gain = numberIn(((await readout(widget, 'gain on the floor').textContent()) ?? '').split(' ± ')[0]);
  expect(Math.abs(gain - stats.likelihoodGain.floor)).toBeLessThan(0.001);
  await expect(detail(widget, 'gain on the floor')).toHaveText(`${counted(stats.n * stats.likelihoodGain.floor)} for all ${counted(stats.n)}; with θ no bound: no γ̂`);
  await expect(detail(widget, 'cross-track skew')).toHaveText('exactly −0.301');
});

test('the odometry model shows its reading, the hinge noises of a marked robot, and backs up as one likes', async ({ page }) => {
  const widget = await openWhole(page);
  const plane = widget.locator('canvas.plane');
  await expect(widget.getByLabel('Reverse without half-turn noise')).toHaveCount(0);
  await widget.getByLabel('odometry').check();
  const withReading = await pictureOf(plane);
  await widget.getByRole('checkbox', { name: 'commanded arc' }).uncheck();
  expect(await pictureOf(plane)).not.toBe(withReading);
  await widget.getByRole('checkbox', { name: 'commanded arc' }).check();

  await widget.getByRole('spinbutton', { name: 'Robot' }).fill('5');
  await frames(page);
  const noises = await widget.evaluate((element) => {
    const { machine } = /** @type {import('./support.js').BananaMachineElement} */ (element);
    const { legs } = machine.inspect(4);
    if (!legs) throw new Error('Odometry drives legs.');
    const { rot1, trans, rot2 } = machine.reading;
    return [rot1 - legs.rot1, trans - legs.trans, rot2 - legs.rot2];
  });
  const text = (await widget.locator('.marked output').textContent()) ?? '';
  const printed = [...text.matchAll(/= (\S+)/g)].map(([, number]) => numberIn(number));
  expect(printed).toHaveLength(3);
  noises.forEach((noise, i) => expect(printed[i]).toBeCloseTo(noise, 3));

  await widget.locator('#v').fill('-1');
  await expect(sentence(widget)).toContainText('two half turns');
  const before = (await state(widget)).table.exact.cov[2][2];
  await widget.getByLabel('Reverse without half-turn noise').check();
  await expect(sentence(widget)).not.toContainText('two half turns');
  expect((await state(widget)).table.exact.cov[2][2]).toBeLessThan(before / 5);
  expect(await widget.evaluate((element) => [Reflect.get(element, 'reverseAware'), element.getAttribute('reverseaware')])).toEqual([true, 'true']);
  await widget.evaluate((element) => element.removeAttribute('reverseaware'));
  expect((await state(widget)).config.reverseAware).toBe(false);
});

test('noise added to the pose is an overlay that no command changes', async ({ page }) => {
  const widget = await alone(page, { width: 1280, height: 720 }, 'overlays="additive"');
  await unfold(widget);
  await expect(widget.getByRole('checkbox', { name: 'noise added to the pose' })).toBeChecked();
  const radius = () =>
    widget.evaluate((element) => {
      const { contours } = /** @type {import('./support.js').BananaMachineElement} */ (element).machine;
      const [x, y] = contours.command.slice(-2);
      return Math.hypot(contours.additive[0] - x, contours.additive[1] - y);
    });
  expect(await radius()).toBeCloseTo(0.4, 9);
  await widget.locator('#dt').fill('0.1');
  await frames(page);
  expect(await radius()).toBeCloseTo(0.4, 9);
});
