import { expect } from '@playwright/test';
import {
  STILL,
  boxOf,
  centreOf,
  detail,
  dragSlider,
  frames,
  inspectFirst,
  open,
  openWhole,
  pictureOf,
  pixelsOf,
  readout,
  state,
  test,
} from './support.js';

/** @typedef {import('./support.js').BananaMachineElement} BananaMachineElement */

test.use(STILL);

/** The presets that the page offers. */
const PRESETS = {
  Straight: { v: 1, omega: 0, dt: 2 },
  'Gentle arc': { v: 1, omega: 0.5, dt: 1 },
  'Hard arc': { v: 1, omega: 1.2, dt: 1.4 },
  Pivot: { v: 0.06, omega: 1.5, dt: 1 },
};

/** Those with noise parameters of their own. */
const WITH_ALPHAS = {
  Banana: { command: { v: 1, omega: 0, dt: 2 }, alphas: [0.002, 0.002, 0.1, 0.1, 0.002, 0.002] },
  'Worked example': { command: { v: 1, omega: 0.5, dt: 1 }, alphas: [0.02, 0.02, 0.02, 0.02, 0, 0] },
};
const OPENING_ALPHAS = [0.05, 0.05, 0.05, 0.09, 0.01, 0.01];

test.describe('command', () => {
  test('presets set the whole command', async ({ page }) => {
    const widget = await openWhole(page);
    for (const [name, command] of Object.entries(PRESETS)) {
      const button = widget.getByRole('button', { name });
      await button.click();
      expect((await state(widget)).config.command).toEqual(command);
      await expect(button).toHaveAttribute('aria-pressed', 'true');
    }
  });

  test('presets with noise of their own set it, and others bring the opening’s back, but none that was set by hand', async ({ page }) => {
    const widget = await openWhole(page);
    const press = (/** @type {string} */ name) => widget.getByRole('button', { name, exact: true }).click();
    const preset = () => widget.evaluate((element) => Reflect.get(element, 'preset'));
    for (const [name, { command, alphas }] of Object.entries(WITH_ALPHAS)) {
      await press(name);
      expect((await state(widget)).config).toMatchObject({ command, alphas });
      expect(await preset()).toBe({ Banana: 'banana', 'Worked example': 'worked' }[name]);
      await expect(widget.locator('.presets [aria-pressed=true]')).toHaveText([name]);
      await press('Gentle arc');
      expect((await state(widget)).config).toMatchObject({ command: PRESETS['Gentle arc'], alphas: OPENING_ALPHAS });
      expect(await preset()).toBe('gentle');
    }
    // What was set by hand stays.
    await press('Banana');
    await widget.locator('#alpha1').fill('0.01');
    await frames(page);
    expect(await preset()).toBe('straight');
    await press('Hard arc');
    expect((await state(widget)).config.alphas).toEqual([0.01, 0.002, 0.1, 0.1, 0.002, 0.002]);
    // Their noise is that of the velocity model, all of it.
    await widget.getByLabel('Isolate one').check();
    await widget.getByLabel('odometry').check();
    await press('Banana');
    expect((await state(widget)).config).toMatchObject({ model: 'velocity', isolate: null, alphas: WITH_ALPHAS.Banana.alphas });
  });

  test('sliders dragged with the mouse set v, ω and Δt', async ({ page }) => {
    const widget = await openWhole(page);
    const before = await pictureOf(widget.locator('canvas.plane'));
    for (const [name, key] of [['v,', 'v'], ['ω,', 'omega'], ['Δt,', 'dt']]) {
      const slider = widget.locator('.controls').getByRole('slider', { name });
      await dragSlider(slider, 0.7);
      const value = Number(await slider.inputValue());
      expect(value).toBeGreaterThan(0);
      const { config } = await state(widget);
      expect(config.command).toMatchObject({ [key]: value });
    }
    expect(await pictureOf(widget.locator('canvas.plane'))).not.toBe(before);
  });

  test('the end of the arc can be dragged', async ({ page }) => {
    const widget = await openWhole(page);
    const handle = widget.getByRole('slider', { name: 'End of the commanded arc' });
    const from = await centreOf(handle);
    const start = await state(widget);
    await page.mouse.move(from.x, from.y);
    await page.mouse.down();
    await page.mouse.move(from.x + 60, from.y - 45, { steps: 6 });
    const held = await state(widget);
    const at = await centreOf(handle);
    // It stays under the pointer, and the view stays still under it: up on the screen is up in y.
    expect(Math.abs(at.x - from.x - 60)).toBeLessThan(1);
    expect(Math.abs(at.y - from.y + 45)).toBeLessThan(1);
    const [perX, perY] = [(held.end[0] - start.end[0]) / 60, (held.end[1] - start.end[1]) / 45];
    expect(perX).toBeGreaterThan(0);
    // A pixel is a pixel: the pointer's place is exact to half of one.
    expect(Math.abs(perX / perY - 1)).toBeLessThan(1 / 45);
    await page.mouse.up();

    const reached = await widget.evaluate((element, [x, y]) => {
      const { motion } = /** @type {BananaMachineElement} */ (element);
      return motion.commandReaching(x, y, { v: 1, omega: 0.5, dt: 1 });
    }, held.end);
    const { v, omega, dt } = held.config.command;
    expect(dt).toBe(1);
    expect(v).toBeCloseTo(reached.v, 9);
    expect(omega).toBeCloseTo(reached.omega, 9);
    expect((await state(widget)).config.command).toEqual(held.config.command);
    await expect(widget.locator('p[role=status]')).toContainText(`v = ${v.toFixed(2)} m/s`);
  });

  test('the end of the arc can be moved from the keyboard', async ({ page }) => {
    const widget = await openWhole(page);
    const handle = widget.getByRole('slider', { name: 'End of the commanded arc' });
    await handle.focus();
    const ways = /** @type {const} */ ([
      ['ArrowUp', 0, 0.02],
      ['ArrowRight', 0.02, 0],
      ['Shift+ArrowDown', 0, -0.1],
      ['Shift+ArrowLeft', -0.1, 0],
    ]);
    let { end } = await state(widget);
    for (const [key, dx, dy] of ways) {
      await handle.press(key);
      const next = await state(widget);
      expect(next.end[0] - end[0]).toBeCloseTo(dx, 9);
      expect(next.end[1] - end[1]).toBeCloseTo(dy, 9);
      ({ end } = next);
    }
    const { v, omega } = (await state(widget)).config.command;
    await expect(handle).toHaveAttribute('aria-valuetext', `v = ${v.toFixed(2)} m/s, ω = ${omega.toFixed(2)} rad/s`);
  });

  test('the ring says where the sliders end, to the eye and to the ear', async ({ page }) => {
    const widget = await openWhole(page);
    const handle = widget.getByRole('slider', { name: 'End of the commanded arc' });
    const hint = () => handle.evaluate((element) => getComputedStyle(element, '::before').content);
    await widget.evaluate((element) => void Object.assign(element, { v: 1.49, omega: 0 }));
    await handle.press('ArrowLeft');
    await expect(handle).toHaveAttribute('aria-valuetext', /m\/s, ω = −?0\.00 rad\/s$/);
    expect(await hint()).toBe('none');
    for (let i = 0; i < 3; i++) await handle.press('ArrowRight');
    await expect(handle).toHaveAttribute('aria-valuetext', /^v = 1\.50 m\/s, .* rad\/s\. The sliders end here$/);
    expect(await hint()).toBe('"The sliders end here"');
    await handle.blur();
    expect(await hint()).toBe('none');
  });

  test('the chart sets ω by pointer and by keyboard', async ({ page }) => {
    const widget = await openWhole(page);
    const marker = widget.getByRole('slider', { name: 'Commanded ω on the chart' });
    await marker.focus();
    await marker.press('ArrowRight');
    expect((await state(widget)).config.command.omega).toBeCloseTo(0.51, 12);
    const chart = widget.locator('svg.plot');
    await chart.scrollIntoViewIfNeeded();
    const { x, y } = await centreOf(chart);
    await page.mouse.click(x + 80, y);
    const { config, table } = await state(widget);
    expect(config.command.omega).toBeGreaterThan(0.51);
    await expect(marker).toHaveAttribute('aria-valuetext', new RegExp(`skew −${Math.abs(table.exact.crossTrackSkew).toFixed(3)}`));
  });
});

test.describe('noise', () => {
  test('a dragged α moves the same robots', async ({ page }) => {
    const widget = await openWhole(page);
    const before = await state(widget);
    const robots = await inspectFirst(widget, 200);
    const picture = await pictureOf(widget.locator('canvas.plane'));
    const skew = await readout(widget, 'cross-track skew').textContent();
    await dragSlider(widget.getByRole('slider', { name: 'α4' }), 0.85);
    const after = await state(widget);

    const alpha = after.config.alphas[3];
    expect(alpha).toBeGreaterThan(0.16);
    expect(after.config).toEqual({ ...before.config, alphas: before.config.alphas.with(3, alpha) });
    expect(after.shown).toBe(before.shown);
    expect(await pictureOf(widget.locator('canvas.plane'))).not.toBe(picture);
    expect(await readout(widget, 'cross-track skew').textContent()).not.toBe(skew);

    // α₄ scales the error of ω̂ by the ratio of standard deviations, and leaves v̂ and γ̂ alone.
    const { v, omega } = after.config.command;
    const variance = (/** @type {number[]} */ alphas) => alphas[2] * v * v + alphas[3] * omega * omega;
    const ratio = Math.sqrt(variance(after.config.alphas) / variance(before.config.alphas));
    const moved = await inspectFirst(widget, 200);
    for (const [i, robot] of moved.entries()) {
      expect(robot.vHat).toBeCloseTo(robots[i].vHat, 9);
      expect(robot.gammaHat).toBeCloseTo(robots[i].gammaHat, 9);
      expect(robot.omegaHat - omega).toBeCloseTo(ratio * (robots[i].omegaHat - omega), 9);
    }
  });

  test('the canonical parameters have the chapter’s exact skew', async ({ page }) => {
    const widget = await openWhole(page);
    for (const [index, alpha] of [0.02, 0.02, 0.02, 0.02, 0, 0].entries()) {
      await widget.getByRole('slider', { name: `α${index + 1}` }).fill(String(alpha));
    }
    const { config, table } = await state(widget);
    expect(config.alphas).toEqual([0.02, 0.02, 0.02, 0.02, 0, 0]);
    expect(Math.abs(table.exact.crossTrackSkew + 0.30056)).toBeLessThan(5e-6);
    const row = widget.getByRole('row', { name: 'cross-track skew' });
    await expect(row.getByRole('cell').nth(1)).toHaveText('−0.30056');
  });

  test('many inputs between two frames cost one configuration', async ({ page }) => {
    const widget = await openWhole(page);
    const calls = await widget.evaluate(async (node) => {
      const element = /** @type {BananaMachineElement} */ (node);
      const { machine } = element;
      let count = 0;
      Object.defineProperty(machine, 'begin', {
        value(/** @type {object} */ settings) {
          count++;
          Object.getPrototypeOf(machine).begin.call(machine, settings);
        },
      });
      const slider = /** @type {HTMLInputElement} */ (element.shadowRoot?.querySelector('#alpha1'));
      for (const value of ['0.06', '0.07', '0.08', '0.09']) {
        slider.value = value;
        slider.dispatchEvent(new Event('input'));
      }
      await new Promise(requestAnimationFrame);
      await new Promise(requestAnimationFrame);
      return count;
    });
    expect(calls).toBe(1);
    expect((await state(widget)).config.alphas[0]).toBe(0.09);
  });

  test('each model keeps its own α’s', async ({ page }) => {
    const widget = await openWhole(page);
    await widget.getByRole('slider', { name: 'α1' }).fill('0.123');
    await widget.getByLabel('odometry').check();
    let { config } = await state(widget);
    expect(config.model).toBe('odometry');
    expect(config.alphas).toHaveLength(4);
    await expect(widget.locator('.alphas input[type=range]')).toHaveCount(4);
    await widget.getByLabel('velocity').check();
    ({ config } = await state(widget));
    expect(config.alphas).toEqual([0.123, 0.05, 0.05, 0.09, 0.01, 0.01]);
  });

  test('triangular noise is bounded, normal noise is not', async ({ page }) => {
    const widget = await openWhole(page);
    const { config } = await state(widget);
    const { v, omega } = config.command;
    const deviation = Math.sqrt(config.alphas[0] * v * v + config.alphas[1] * omega * omega);
    const farthest = async () =>
      Math.max(...(await inspectFirst(widget, 2000)).map(({ vHat }) => Math.abs(vHat - v))) / deviation;
    // Of 2000 normal variates all but 3 in 10 000 sets reach beyond √6 standard deviations.
    expect(await farthest()).toBeGreaterThan(Math.sqrt(6));
    await widget.getByLabel('triangular').check();
    expect((await state(widget)).config.noise).toBe('triangular');
    expect(await farthest()).toBeLessThanOrEqual(Math.sqrt(6) + 1e-9);
  });
});

test('the help of N is one line, and on a screen covers neither the seed nor a fold', async ({ page }) => {
  await page.setViewportSize({ width: 1280, height: 720 });
  const widget = await open(page);
  await widget.locator('#samples').focus();
  const help = widget.locator('#samples-effect');
  await expect(help).toBeVisible();
  const [text, seed, folds] = await Promise.all([help, widget.locator('.seed'), widget.locator('.folds')].map(boxOf));
  expect(text.height).toBeLessThan(20);
  await expect(widget.locator('.seed')).toBeVisible();
  expect(seed.y + seed.height).toBeLessThanOrEqual(text.y);
  expect(text.y + text.height).toBeLessThanOrEqual(folds.y);
});

test.describe('Isolate', () => {
  test('leaves one α in effect, shows the others as off, and lets go again', async ({ page }) => {
    const widget = await openWhole(page);
    const before = await state(widget);
    await widget.getByLabel('Isolate one').check();
    expect((await state(widget)).config).toEqual({ ...before.config, isolate: 4 });
    await expect(widget.locator('.alphas .value', { hasText: 'off' })).toHaveCount(5);
    await widget.getByRole('radio', { name: 'Only α₁' }).check();
    expect((await state(widget)).config.isolate).toBe(1);
    // Only v̂ is noisy now.
    for (const { omegaHat, gammaHat } of await inspectFirst(widget, 50)) {
      expect(omegaHat).toBeCloseTo(0.5, 9);
      expect(gammaHat).toBeCloseTo(0, 9);
    }
    // Taking hold of another α selects it.
    await widget.getByRole('slider', { name: 'α3' }).fill('0.06');
    const { config } = await state(widget);
    expect(config).toMatchObject({ isolate: 3, alphas: before.config.alphas.with(2, 0.06) });
    await widget.getByLabel('Isolate one').uncheck();
    expect((await state(widget)).config.isolate).toBeNull();
    await expect(widget.locator('.alphas .value', { hasText: 'off' })).toHaveCount(0);
  });

  test('exercise 4: α₄ alone, then α₆ alone, on a straight and in a turn', async ({ page }) => {
    const widget = await openWhole(page);
    const note = widget.locator('.note');
    const plane = widget.locator('canvas.plane');
    await widget.getByRole('button', { name: 'Straight' }).click();
    await widget.getByLabel('Isolate one').check();

    for (const [radio, symbol] of [['Only α₄', 'α₄'], ['Only α₆', 'α₆']]) {
      await widget.getByRole('radio', { name: radio }).check();
      await frames(page);
      await expect(note).toContainText(`${symbol} multiplies ω², and ω is 0: no noise at all.`);
      const { poses } = await state(widget);
      expect(new Set(poses.map((value) => value.toFixed(9))).size).toBe(2);
      await expect(readout(widget, 'cross-track skew')).toHaveText('—');
      expect(await widget.evaluate((element) => element.shadowRoot?.textContent?.includes('NaN'))).toBe(false);
      // The heap around the handle: at least the ring that shows beside it.
      expect(await pixelsOf(plane, 'prediction')).toBeGreaterThan(200);
    }

    // In a turn α₆ still moves no robot, but it fans the headings.
    await widget.locator('.controls').getByRole('slider', { name: 'ω,' }).fill('0.5');
    await expect(note).toContainText('only the headings fan out');
    let { stats } = await state(widget);
    expect(Math.max(stats.cartesian.cov[0][0], stats.cartesian.cov[1][1])).toBeLessThan(1e-18);
    // Δt² α₆ ω², within five standard errors of a variance.
    const spread = 4 * 0.01 * 0.25;
    expect(Math.abs(stats.cartesian.cov[2][2] / spread - 1)).toBeLessThan(5 * Math.sqrt(2 / stats.n));
    const fan = await pictureOf(plane);

    await widget.getByRole('radio', { name: 'Only α₄' }).check();
    await expect(note).toContainText('the robots lie on a line');
    await expect(detail(widget, 'area of ellipse')).toHaveText(/^inside: [\d.]+\u202f% and —$/);
    // A curve on the floor that is straight in ξ: no error of an infinite gain.
    await expect(readout(widget, 'gain on the floor')).toHaveText('∞');
    await expect(detail(widget, 'gain on the floor')).toHaveText('no bound: in ξ all on one line');
    ({ stats } = await state(widget));
    expect(stats.cartesian.cov[1][1]).toBeGreaterThan(0.01);
    expect(stats.rhoCrossHeading).toBeGreaterThan(0.99);
    expect(await pictureOf(plane)).not.toBe(fan);
  });
});

test('controls show what the reader did last, whenever they are rendered', async ({ page }) => {
  const widget = await openWhole(page);
  const { values, v } = await widget.evaluate(async (element) => {
    const figure = /** @type {any} */ (element);
    const root = /** @type {ShadowRoot} */ (element.shadowRoot);
    const slider = /** @type {HTMLInputElement} */ (root.querySelector('#v'));
    const values = [];
    for (const step of ['stepUp', 'stepUp', 'stepDown']) {
      /** @type {any} */ (slider)[step]();
      slider.dispatchEvent(new Event('input'));
      // Before the frame in which the machine hears of it.
      figure.requestUpdate();
      await figure.updateComplete;
      values.push(slider.valueAsNumber);
    }
    return { values, v: figure.v };
  });
  expect(values).toEqual([1.01, 1.02, 1.01]);
  expect(v).toBe(1.01);
});
