import { expect } from '@playwright/test';
import { STILL, boxOf, centreOf, counted, detail, frames, numberIn, openWhole, pauseEarly, pictureOf, pixelsOf, readout, state, test } from './support.js';

/** @typedef {import('./support.js').BananaMachineElement} BananaMachineElement */

const printed = (/** @type {number} */ value, /** @type {number} */ decimals) => value.toFixed(decimals).replace('-', '−');

/** Steps in which a cloud grows. */
const BATCHES = 150;

test.describe('growth', () => {
  test('the cloud grows by itself, pauses, and goes on', async ({ page }) => {
    await pauseEarly(page, 'banana-machine');
    const widget = await openWhole(page);
    await expect(widget.getByRole('button', { name: 'Play' })).toBeVisible();
    const paused = await state(widget);
    expect(paused.shown).toBeGreaterThan(0);
    expect(paused.shown).toBeLessThan(paused.config.samples);
    await frames(page);
    expect((await state(widget)).shown).toBe(paused.shown);
    await expect(readout(widget, 'robots shown')).toHaveText(`${counted(paused.shown)} of 50\u202f000`);

    await widget.getByRole('button', { name: 'Play' }).click();
    await expect.poll(async () => (await state(widget)).shown, { timeout: 20_000 }).toBe(paused.config.samples);
    await expect(widget.getByRole('button', { name: 'Play' })).toBeVisible();
    // The robots of the paused cloud are the first of the complete one.
    const { poses } = await state(widget);
    expect(poses.slice(0, paused.poses.length)).toEqual(paused.poses);
  });

  test.describe('from a complete cloud', () => {
    test.use(STILL);

    test('Reset empties it, Step adds a batch of the same robots', async ({ page }) => {
      const widget = await openWhole(page);
      const whole = await state(widget);
      await widget.getByRole('button', { name: 'Reset' }).click();
      expect((await state(widget)).shown).toBe(0);
      await expect(readout(widget, 'cross-track skew')).toHaveText('—');
      await expect(widget.getByRole('img', { name: 'No robots yet' }).first()).toBeVisible();

      const batch = Math.ceil(whole.config.samples / BATCHES);
      for (const [name, title] of [
        ['Play', 'Grow the cloud'],
        ['Step', `Add ${batch} robots`],
        ['Reset', 'Empty the cloud; the same seed sends the same robots'],
        ['New seed', 'Send other robots'],
      ]) {
        await expect(widget.getByRole('button', { name, exact: true })).toHaveAttribute('title', title);
      }
      for (const shown of [batch, 2 * batch]) {
        await widget.getByRole('button', { name: 'Step' }).click();
        const { shown: now, poses } = await state(widget);
        expect(now).toBe(shown);
        expect(poses).toEqual(whole.poses.slice(0, 3 * shown));
      }
    });

    test('Play sends a complete cloud again', async ({ page }) => {
      const widget = await openWhole(page);
      const [label, shown, samples] = await widget.evaluate(async (element) => {
        const { machine, shadowRoot, updateComplete } = /** @type {any} */ (element);
        const play = shadowRoot.querySelector('.cloud button');
        const begun = new Promise((resolve) => element.addEventListener('stats', resolve, { once: true }));
        play.click();
        await begun;
        await updateComplete;
        return [play.innerText, machine.shown, machine.config.samples];
      });
      expect(label).toBe('Pause');
      expect(shown).toBeLessThan(samples);
    });

    test('New seed sends other robots, and no other control does', async ({ page }) => {
      const widget = await openWhole(page);
      const before = await state(widget);
      await widget.getByRole('button', { name: 'New seed' }).click();
      const after = await state(widget);
      expect(after.config).toEqual({ ...before.config, seed: after.config.seed });
      expect(after.config.seed).not.toBe(before.config.seed);
      expect(after.shown).toBe(before.shown);
      expect(after.poses).not.toEqual(before.poses);
      await expect(widget.getByText(`seed ${after.config.seed}`)).toBeVisible();
    });

    test('100 000 robots are drawn as a density and agree with the exact figures', async ({ page }) => {
      const widget = await openWhole(page);
      await widget.evaluate((element) => {
        const { machine } = /** @type {BananaMachineElement} */ (element);
        Object.assign(window, { densities: 0 });
        Object.defineProperty(machine, 'picture', {
          value(/** @type {unknown[]} */ ...grid) {
            Object.assign(window, { densities: Reflect.get(window, 'densities') + 1 });
            return Object.getPrototypeOf(machine).picture.apply(machine, grid);
          },
        });
      });
      const densities = () => page.evaluate(() => Reflect.get(window, 'densities'));
      // A thousand robots are dots.
      await widget.getByRole('slider', { name: 'robots in the whole cloud' }).fill('6');
      await frames(page);
      expect((await state(widget)).shown).toBe(1000);
      const before = await densities();
      await widget.getByRole('checkbox', { name: 'linearized' }).check();
      await frames(page);
      expect(await densities()).toBe(before);

      const slider = widget.getByRole('slider', { name: 'robots in the whole cloud' });
      await slider.focus();
      for (const count of [2000, 5000, 10_000, 20_000, 50_000, 100_000]) {
        await slider.press('ArrowRight');
        await expect(slider).toHaveAttribute('aria-valuetext', counted(count));
      }
      const { shown, stats, table } = await state(widget);
      expect(shown).toBe(100_000);
      expect(await densities()).toBeGreaterThanOrEqual(before + 2);
      await expect(readout(widget, 'robots shown')).toHaveText('100\u202f000 of 100\u202f000');
      expect(Math.abs(stats.crossTrackSkew - table.exact.crossTrackSkew)).toBeLessThan(5 * stats.crossTrackSkewError);
      for (const i of [0, 1, 2]) {
        const error = Math.sqrt(table.exact.cov[i][i] / stats.n);
        expect(Math.abs(stats.cartesian.mean[i] - table.exact.mean[i])).toBeLessThan(5 * error);
      }
    });
  });
});

test.describe('figures', () => {
  test.use(STILL);

  test('every number shown is the machine’s', async ({ page }) => {
    const widget = await openWhole(page);
    const { config, stats, table } = await state(widget);
    const shown = async (/** @type {string | RegExp} */ name) => (await readout(widget, name).textContent()) ?? '';

    const [skew, error] = (await shown('cross-track skew')).split(' ± ').map(numberIn);
    expect(skew).toBeCloseTo(stats.crossTrackSkew, 3);
    expect(error).toBeCloseTo(stats.crossTrackSkewError, 3);
    expect(numberIn(await shown('predicts'))).toBeCloseTo(stats.gaussianSkew, 3);
    expect(await detail(widget, 'cross-track skew').textContent()).toBe(`exactly ${printed(table.exact.crossTrackSkew, 3)}`);
    expect(numberIn(await shown('ρ'))).toBeCloseTo(stats.rhoCrossHeading, 3);
    expect((await shown('robots shown')).split(' of ').map(numberIn)).toEqual([stats.n, config.samples]);
    const { coverage, likelihoodGain, likelihoodGainError, areaRatio } = stats;
    const [gain, gainError] = (await shown('gain of a Gaussian')).split(' ± ').map(numberIn);
    expect(gain).toBeCloseTo(likelihoodGain.pose, 3);
    expect(gainError).toBeCloseTo(likelihoodGainError.pose, 3);
    const nats = Math.round(stats.n * likelihoodGain.pose);
    const power = String(nats).replace(/\d/g, (digit) => '⁰¹²³⁴⁵⁶⁷⁸⁹'[Number(digit)]);
    await expect(detail(widget, 'gain of a Gaussian')).toHaveText(`${counted(nats)} for all ${counted(stats.n)}: e${power} times likelier`);
    expect(numberIn(await shown('area of ellipse'))).toBeCloseTo(areaRatio, 2);
    const shares = [coverage.ellipse, coverage.exponential].map((share) => `${printed(100 * share, 1)}\u202f%`);
    await expect(detail(widget, 'area of ellipse')).toHaveText(`inside: ${shares.join(' and ')}`);
    expect(numberIn(await shown('of any Gaussian'))).toBeCloseTo(100 * (1 - Math.exp(-2)), 1);
    expect(numberIn(await shown('exact gain'))).toBeCloseTo(table.exact.likelihoodGain.pose, 4);
    expect(numberIn(await shown('exact area'))).toBeCloseTo(table.exact.areaRatio, 3);

    const cellsOf = async (/** @type {string} */ name) => {
      const row = widget.locator('tr').filter({ has: page.getByRole('rowheader', { name, exact: true }) });
      return row.getByRole('cell').allTextContents();
    };
    // Five digits of what is computed and three of what is measured: half a unit of the last one.
    const expectPrinted = (/** @type {string} */ text, /** @type {number} */ value, /** @type {number} */ digits) => {
      const off = Math.abs(numberIn(text) - value);
      expect(off, `${text} for ${value}`).toBeLessThanOrEqual(0.5000001 * 10 ** (1 - digits) * Math.abs(value) + 1e-13);
    };
    /** @type {[string, (column: typeof table.exact) => number][]} */
    const rows = [
      ['mean x', ({ mean }) => mean[0]],
      ['mean y', ({ mean }) => mean[1]],
      ['mean θ', ({ mean }) => mean[2]],
      ['Σxx', ({ cov }) => cov[0][0]],
      ['Σyy', ({ cov }) => cov[1][1]],
      ['Σxy', ({ cov }) => cov[0][1]],
      ['Σxθ', ({ cov }) => cov[0][2]],
      ['Σyθ', ({ cov }) => cov[1][2]],
      ['Σθθ', ({ cov }) => cov[2][2]],
      ['ρyθ', ({ cov }) => cov[1][2] / Math.sqrt(cov[1][1] * cov[2][2])],
    ];
    for (const [name, of] of rows) {
      const [linearized, exact, measured] = await cellsOf(name);
      expectPrinted(linearized, of(table.linearized), 5);
      expectPrinted(exact, of(table.exact), 5);
      expectPrinted(measured, of(table.measured), 3);
    }
    const [linearized, exact, measured] = await cellsOf('cross-track skew');
    expect(linearized).toBe('0');
    expectPrinted(exact, table.exact.crossTrackSkew, 5);
    expect(measured).toBe(await shown('cross-track skew'));

    const { tangent } = table;
    if (!tangent) throw new Error('The velocity model has moments of its twist.');
    for (const [i, axis] of ['along', 'lateral', 'heading'].entries()) {
      for (const [name, of] of /** @type {[string, (moments: import('../../www/types.d.ts').Moments) => number][]} */ ([
        [`mean ξ ${axis}`, ({ mean }) => mean[i]],
        [`variance of ξ ${axis}`, ({ cov }) => cov[i][i]],
      ])) {
        const [command, measured] = await cellsOf(name);
        expectPrinted(command, of(tangent), 5);
        expectPrinted(measured, of(stats.exponential), 3);
      }
    }
    await widget.getByLabel('odometry').check();
    await frames(page);
    expect((await cellsOf('mean ξ along'))[0]).toBe('—');
  });

  test('small noise is printed, not rounded away', async ({ page }) => {
    const widget = await openWhole(page);
    await widget.getByLabel('Isolate one').check();
    await widget.getByRole('slider', { name: 'α4' }).fill('0.001');
    const { table } = await state(widget);
    expect(table.exact.cov[0][0]).toBeLessThan(1e-4);
    const cells = await widget.getByRole('row', { name: 'Σxx' }).getByRole('cell').allTextContents();
    for (const [i, column] of [table.linearized, table.exact, table.measured].entries()) {
      expect(cells[i]).toMatch(/·10⁻/);
      expect(Math.abs(numberIn(cells[i]) / column.cov[0][0] - 1)).toBeLessThan(0.5 * 10 ** -2);
    }
  });

  test('each overlay has a toggle', async ({ page }) => {
    const widget = await openWhole(page);
    const plane = widget.locator('canvas.plane');
    const twist = widget.locator('canvas.twist');
    const first = await pictureOf(plane);
    for (const [label, role] of [
      ['commanded arc', 'prior'],
      ['2σ Gaussian in (x, y)', 'prediction'],
      ['linearized (EKF) ellipse', 'prediction'],
      ['noise added to the pose', 'prediction'],
      ['2σ Gaussian in exponential coordinates', 'posterior'],
    ]) {
      const box = widget.getByRole('checkbox', { name: label });
      const shown = await box.isChecked();
      const before = await pixelsOf(plane, role);
      await box.setChecked(!shown);
      const change = (await pixelsOf(plane, role)) - before;
      expect(shown ? -change : change, label).toBeGreaterThan(60);
      await box.setChecked(shown);
      expect(await pictureOf(plane)).toBe(first);
    }
    await widget.getByRole('checkbox', { name: 'exponential coordinates' }).uncheck();
    expect(await pixelsOf(twist, 'posterior')).toBe(0);
  });

  test('a robot pointed at in one view is marked in both, with what it executed', async ({ page }) => {
    const widget = await openWhole(page);
    const plane = widget.locator('canvas.plane');
    const twist = widget.locator('canvas.twist');
    const field = widget.getByRole('spinbutton', { name: 'Robot' });
    const marks = async () => [await pixelsOf(plane, 'accent'), await pixelsOf(twist, 'accent')];
    expect(await marks()).toEqual([0, 0]);

    const executed = async () => {
      const index = Number(await field.inputValue()) - 1;
      const { vHat, omegaHat, gammaHat } = await widget.evaluate(
        (element, i) => /** @type {BananaMachineElement} */ (element).machine.inspect(i),
        index,
      );
      const text = (await widget.locator('.marked output').textContent()) ?? '';
      const printed = [...text.matchAll(/= (\S+)/g)].map(([, number]) => numberIn(number));
      expect(printed).toHaveLength(3);
      for (const [i, value] of [vHat, omegaHat, gammaHat].entries()) expect(printed[i]).toBeCloseTo(value, 3);
      return index;
    };

    const handle = await centreOf(widget.locator('.handle'));
    await page.mouse.move(handle.x + 30, handle.y + 20);
    for (const count of await marks()) expect(count).toBeGreaterThan(20);
    const inPlane = await executed();

    await twist.scrollIntoViewIfNeeded();
    const { x, y, width, height } = await boxOf(twist);
    await page.mouse.move(x + width * 0.45, y + height * 0.45);
    for (const count of await marks()) expect(count).toBeGreaterThan(20);
    expect(await executed()).not.toBe(inPlane);

    await field.fill('5');
    await frames(page);
    expect(await executed()).toBe(4);
    await field.fill('');
    expect(await marks()).toEqual([0, 0]);
  });

  test('the first robot is marked as any other, and stays so while the pointer is over nothing', async ({ page }) => {
    const widget = await openWhole(page);
    const twist = widget.locator('canvas.twist');
    const marked = () => widget.evaluate((element) => Reflect.get(element, 'marked'));
    await widget.evaluate((element) => void Object.assign(element, { samples: 1 }));
    await frames(page);
    await twist.scrollIntoViewIfNeeded();
    const { x, y, width, height } = await boxOf(twist);
    // As shares of the width.
    const [left, top] = await widget.evaluate((element) => {
      const { twists, pictures } = /** @type {any} */ (element);
      const { view } = pictures[1];
      return [view.toPixelX(twists[0]), view.toPixelY(twists[2])].map((pixels) => pixels / view.width);
    });
    await page.mouse.move(x + width * left, y + width * top);
    expect(await marked()).toBe(0);
    expect(await pixelsOf(twist, 'accent')).toBeGreaterThan(20);
    await expect(widget.locator('.marked output')).toContainText('m/s');
    // While it stays there, nothing is drawn anew.
    const asked = await twist.evaluate((canvas, [clientX, clientY]) => {
      const request = window.requestAnimationFrame;
      let count = 0;
      window.requestAnimationFrame = () => ++count;
      canvas.dispatchEvent(new PointerEvent('pointermove', { clientX, clientY }));
      window.requestAnimationFrame = request;
      return count;
    }, [x + width * left, y + width * top]);
    expect(asked).toBe(0);
    await page.mouse.move(x + 3, y + height - 3);
    expect(await marked()).toBe(0);
    // A click there is meant.
    await page.mouse.click(x + 3, y + height - 3);
    expect(await marked()).toBe(null);
  });

  test('the pictures have a text equivalent that follows the state', async ({ page }) => {
    const widget = await openWhole(page);
    const plane = widget.locator('canvas.plane');
    const { stats } = await state(widget);
    await expect(plane).toHaveAttribute('aria-label', new RegExp(`end around x ${stats.cartesian.mean[0].toFixed(2)} m`));
    await expect(plane).toHaveAttribute('aria-label', /Drawn over it: commanded arc, 2σ Gaussian in \(x, y\), 2σ/);
    await widget.getByRole('button', { name: 'Hard arc' }).click();
    await expect(plane).toHaveAttribute('aria-label', /ω = 1\.20 rad\/s/);
    await expect(widget.locator('p[role=status]')).toContainText('ω = 1.20 rad/s');
  });
});
