import { expect, test as plain } from '@playwright/test';
import { expectAccessible } from './axe.js';
import { ALL } from './element-support.js';
import { STILL, boxOf, frames, open, openWhole, pictureOf, pixelsOf, state, test } from './support.js';

/** @typedef {import('./support.js').BananaMachineElement} BananaMachineElement */

test.describe('the page', () => {
  test.use(STILL);

  test('opens with the whole cloud of the opening command', async ({ page }) => {
    const widget = await open(page);
    const { config, shown, table } = await state(widget);
    expect(config).toMatchObject({
      model: 'velocity',
      noise: 'normal',
      command: { v: 1, omega: 0.5, dt: 1 },
      alphas: [0.05, 0.05, 0.05, 0.09, 0.01, 0.01],
      isolate: null,
    });
    expect(shown).toBe(config.samples);
    // Printed to five decimals.
    expect(Math.abs(table.exact.crossTrackSkew + 0.43093)).toBeLessThan(5e-6);
    await expect(page.getByRole('heading', { level: 1 })).toHaveText('The Banana Machine');
  });

  test('repaints its canvases when the colour scheme changes', async ({ page }) => {
    const widget = await open(page);
    const canvas = widget.locator('canvas.plane');
    const light = await pictureOf(canvas);
    await page.emulateMedia({ colorScheme: 'dark' });
    await expect.poll(() => pictureOf(canvas)).not.toBe(light);
    await page.emulateMedia({ colorScheme: 'light' });
    await expect.poll(() => pictureOf(canvas)).toBe(light);
  });

  test('keeps its roles, its tracks and its pressed button in forced colours', async ({ page }) => {
    await page.emulateMedia({ forcedColors: 'active' });
    const widget = await openWhole(page);
    await widget.getByRole('checkbox', { name: 'linearized' }).check();
    for (const role of ['prior', 'prediction', 'posterior', 'truth']) {
      expect(await pixelsOf(widget.locator('canvas.plane'), role), role).toBeGreaterThan(25);
    }
    const [pressed, other] = await Promise.all(
      ['Gentle arc', 'Straight'].map((name) =>
        widget.getByRole('button', { name }).evaluate((button) => getComputedStyle(button).backgroundColor),
      ),
    );
    expect(pressed).not.toBe(other);
    // The track is the only thing at the right end of a slider near its left end.
    const slider = widget.getByRole('slider', { name: 'α5' });
    const withTrack = await slider.screenshot();
    await slider.evaluate((element) => element.style.setProperty('--muted', 'Canvas'));
    expect(withTrack.equals(await slider.screenshot())).toBe(false);
    await expectAccessible(page);
  });

  for (const width of [375, 320]) {
    test(`fits a phone of ${width} px: nothing to scroll sideways`, async ({ page }) => {
      await page.setViewportSize({ width, height: 812 });
      const widget = await openWhole(page);
      await widget.getByLabel('Isolate one').check();
      await widget.getByRole('button', { name: 'Pivot' }).click();
      await frames(page);
      const right = await widget.evaluate((element) => {
        const all = [...(element.shadowRoot?.querySelectorAll('*:not(.visually-hidden)') ?? [])];
        return Math.max(...all.map((each) => each.getBoundingClientRect().right)) - element.getBoundingClientRect().right;
      });
      expect(right).toBeLessThanOrEqual(0.5);
      expect(await page.evaluate(() => document.documentElement.scrollWidth - innerWidth)).toBeLessThanOrEqual(0);
      await expectAccessible(page);
    });
  }

  test('has targets for a finger', async ({ page }) => {
    await page.setViewportSize({ width: 375, height: 812 });
    const widget = await openWhole(page);
    await widget.getByLabel('Isolate one').check();
    const targets = widget.locator('button, input[type=range], label:has(input), .handle');
    for (const target of await targets.all()) {
      const { width, height } = await boxOf(target);
      expect(Math.min(width, height), await target.evaluate((e) => e.outerHTML)).toBeGreaterThanOrEqual(24);
    }
  });

  test('keeps the floor in sight on a phone while the sliders are used', async ({ page }) => {
    await page.setViewportSize({ width: 375, height: 812 });
    const widget = await open(page);
    await widget.getByRole('slider', { name: 'α6' }).scrollIntoViewIfNeeded();
    await expect(widget.locator('canvas.plane')).toBeInViewport({ ratio: 0.95 });
  });

  test('never hides the focus behind the floor', async ({ page }) => {
    await page.setViewportSize({ width: 375, height: 812 });
    const widget = await openWhole(page);
    await widget.getByLabel('Isolate one').check();
    await widget.getByRole('slider', { name: 'Commanded ω on the chart' }).focus();
    let seen = 0;
    for (;;) {
      await page.keyboard.press('Shift+Tab');
      await frames(page);
      const [name, hidden] = await widget.evaluate((element) => {
        const focused = /** @type {Element} */ (element.shadowRoot?.activeElement);
        const stage = /** @type {Element} */ (element.shadowRoot?.querySelector('.stage'));
        if (stage.contains(focused)) return ['', 0];
        return [focused.outerHTML, stage.getBoundingClientRect().bottom - focused.getBoundingClientRect().top];
      });
      if (name === '') break;
      seen++;
      expect(hidden, String(name)).toBeLessThanOrEqual(0);
    }
    expect(seen).toBeGreaterThan(15);
  });

  test('no slider moves under the finger when there is something to note', async ({ page }) => {
    for (const width of [375, 320, 1280]) {
      await page.setViewportSize({ width, height: 812 });
      const widget = await openWhole(page);
      const slider = widget.locator('#omega');
      /** @type {number[]} */
      const places = [];
      const place = async () => {
        await frames(page);
        places.push(await slider.evaluate((element) => element.getBoundingClientRect().top + scrollY));
      };
      const note = widget.locator('.note');
      await place();
      await expect(note).toHaveCount(0);
      await widget.getByLabel('Isolate one').check();
      await place();
      await expect(note).toContainText('the robots lie on a line');
      await slider.fill('0');
      await place();
      await expect(note).toContainText('no noise at all');
      await widget.getByLabel('Isolate one').uncheck();
      await slider.fill('2');
      await widget.locator('#dt').fill('3');
      await place();
      await expect(note).toContainText('full circle');
      await widget.locator('#dt').fill('1');
      await widget.getByLabel('odometry').check();
      await widget.locator('#v').fill('-1');
      await place();
      await expect(note).toContainText('two half turns');
      expect(Math.max(...places) - Math.min(...places), `${width} px`).toBeLessThan(0.5);
    }
  });

  test('gives its canvases the pixels of the screen, also after a change of size', async ({ page }) => {
    const widget = await open(page);
    const canvas = widget.locator('canvas.plane');
    for (const width of [1280, 700]) {
      await page.setViewportSize({ width, height: 800 });
      await frames(page);
      const [pixels, css, ratio] = await canvas.evaluate((element) => {
        const target = /** @type {HTMLCanvasElement} */ (element);
        return [target.width, target.getBoundingClientRect().width, devicePixelRatio];
      });
      expect(Math.abs(pixels - css * ratio)).toBeLessThanOrEqual(1);
    }
  });

  test.describe('on a screen of 1.3 pixels a CSS pixel', () => {
    test.use({ deviceScaleFactor: 1.3 });

    for (const exact of [true, false]) {
      test(`gives its canvases the very pixels under them, ${exact ? 'as the browser tells them' : 'where no browser tells them, the nearest'}`, async ({ page }) => {
        if (!exact) {
          await page.addInitScript(() => {
            const { observe } = ResizeObserver.prototype;
            ResizeObserver.prototype.observe = function (target, options) {
              if (options?.box === 'device-pixel-content-box') throw new TypeError('no such box');
              observe.call(this, target, options);
            };
            Reflect.deleteProperty(ResizeObserverEntry.prototype, 'devicePixelContentBoxSize');
          });
        }
        const widget = await open(page);
        for (const width of [1111, 703]) {
          await page.setViewportSize({ width, height: 801 });
          await frames(page);
          const sizes = await widget.locator('canvas.plane').evaluate(async (element, exact) => {
            const target = /** @type {HTMLCanvasElement} */ (element);
            const [entry] = await new Promise((resolve) => new ResizeObserver(resolve).observe(target));
            const { inlineSize, blockSize } = exact ? entry.devicePixelContentBoxSize[0] : entry.contentBoxSize[0];
            const ratio = exact ? 1 : devicePixelRatio;
            return [[target.width, target.height], [Math.round(ratio * inlineSize), Math.round(ratio * blockSize)]];
          }, exact);
          expect(sizes[0]).toEqual(sizes[1]);
        }
      });
    }
  });

  test('asks for no frames when nothing happens', async ({ page }) => {
    await page.addInitScript(() => {
      const request = window.requestAnimationFrame.bind(window);
      Object.assign(window, { asked: 0, quietFrame: request });
      window.requestAnimationFrame = (callback) => {
        Object.assign(window, { asked: Reflect.get(window, 'asked') + 1 });
        return request(callback);
      };
    });
    const widget = await open(page);
    await state(widget);
    const idle = await page.evaluate(async () => {
      const before = Reflect.get(window, 'asked');
      for (let i = 0; i < 5; i++) await new Promise(Reflect.get(window, 'quietFrame'));
      return Reflect.get(window, 'asked') - before;
    });
    expect(idle).toBe(0);
  });
});

test.describe('the element', () => {
  test.use(STILL);

  test('outlives a closed tab, and shows what was changed meanwhile', async ({ page }) => {
    const widget = await open(page);
    // As many as are drawn as a density, which wants an extent.
    await widget.getByRole('slider', { name: 'robots in the whole cloud' }).fill('9');
    const hide = (/** @type {boolean} */ hidden) =>
      page.evaluate((value) => {
        /** @type {HTMLElement} */ (document.querySelector('main')).style.display = value ? 'none' : '';
      }, hidden);
    const canvas = widget.locator('canvas.plane');
    const before = await pictureOf(canvas);
    expect((await state(widget)).shown).toBe(10_000);
    await hide(true);
    await frames(page);
    await widget.evaluate((element) => {
      const slider = /** @type {HTMLInputElement} */ (element.shadowRoot?.querySelector('#alpha4'));
      slider.value = '0.15';
      slider.dispatchEvent(new Event('input'));
    });
    await frames(page);
    await hide(false);
    await expect(widget.getByRole('button', { name: 'Straight' })).toBeVisible();
    await expect.poll(() => pixelsOf(canvas, 'prior')).toBeGreaterThan(60);
    expect(await pictureOf(canvas)).not.toBe(before);
    expect((await state(widget)).config.alphas[3]).toBe(0.15);
  });

  test('can be freed again by a page that holds its machine', async ({ page }) => {
    const widget = await open(page);
    const freed = await widget.evaluate((element) => {
      const { motion } = /** @type {BananaMachineElement} */ (element);
      const machine = new motion.BananaMachine();
      machine.free();
      machine.free();
      machine[Symbol.dispose]();
      try {
        return machine.shown < 0;
      } catch (error) {
        return error instanceof Error;
      }
    });
    expect(freed).toBe(true);
  });

  test('stands twice on a page without sharing anything', async ({ page }) => {
    const first = await open(page);
    await page.evaluate(() => document.querySelector('main')?.append(document.createElement('banana-machine')));
    const second = page.locator('banana-machine').last();
    await second.scrollIntoViewIfNeeded();
    await second.getByRole('button', { name: 'Pivot' }).click();
    expect((await state(second)).config.command).toEqual({ v: 0.06, omega: 1.5, dt: 1 });
    expect((await state(first.first())).config.command).toEqual({ v: 1, omega: 0.5, dt: 1 });
  });

  test('survives being moved, with the same machine', async ({ page }) => {
    const widget = await open(page);
    await widget.getByRole('button', { name: 'Hard arc' }).click();
    const before = await state(widget);
    const same = await widget.evaluate(async (node) => {
      const element = /** @type {BananaMachineElement} */ (node);
      const { machine } = element;
      const box = document.createElement('div');
      document.querySelector('main')?.prepend(box);
      element.remove();
      box.append(element);
      await new Promise(requestAnimationFrame);
      return element.machine === machine;
    });
    expect(same).toBe(true);
    expect(await state(widget)).toEqual(before);
    await widget.getByRole('button', { name: 'Straight' }).click();
    expect((await state(widget)).config.command).toEqual({ v: 1, omega: 0, dt: 2 });
  });

  test('frees its machine when removed, and takes up its settings when it comes back', async ({ page }) => {
    const widget = await open(page);
    await widget.getByRole('button', { name: 'Hard arc' }).click();
    const before = await state(widget);
    const answers = await widget.evaluate(async (node) => {
      const element = /** @type {BananaMachineElement} */ (node);
      const { machine } = element;
      const answersNow = () => {
        try {
          return machine.shown > 0;
        } catch {
          return false;
        }
      };
      Object.assign(window, { kept: element });
      const inPlace = answersNow();
      element.remove();
      await new Promise(requestAnimationFrame);
      return [inPlace, answersNow()];
    });
    expect(answers).toEqual([true, false]);
    await page.evaluate(() => document.querySelector('main')?.prepend(Reflect.get(window, 'kept')));
    await widget.scrollIntoViewIfNeeded();
    await expect(widget.getByRole('button', { name: 'Straight' })).toBeVisible();
    expect((await state(widget)).config).toEqual(before.config);
  });
});

plain('a browser that cannot run the module shows a sentence and tells the page', async ({ page }) => {
  await page.addInitScript(() => {
    Reflect.deleteProperty(window, 'WebAssembly');
    Object.assign(window, { failures: [] });
    document.addEventListener('error', (event) => Reflect.get(window, 'failures').push(event), true);
  });
  await page.goto('/');
  const sentence = page.locator('banana-machine').first().getByRole('alert');
  await expect(sentence).toBeVisible();
  await expect(sentence).toHaveText('This interactive figure cannot run here. WebAssembly is not available here, and motion-widgets needs it.');
  // What is near starts too, and how near it is depends on how high the sentences are that have come.
  for (const name of ALL) {
    const figure = page.locator(name).first();
    await figure.scrollIntoViewIfNeeded();
    await expect(figure.getByRole('alert')).toBeVisible();
  }
  await frames(page);
  const heard = await page.evaluate(() =>
    Reflect.get(window, 'failures').map((/** @type {ErrorEvent} */ event) => [
      event.constructor.name,
      /** @type {Element} */ (event.target).localName,
    ]),
  );
  expect(heard.sort()).toEqual(ALL.map((name) => ['ErrorEvent', name]).sort());
});

plain('without JavaScript the page says what is missing', async ({ browser, baseURL }) => {
  const context = await browser.newContext({ javaScriptEnabled: false, baseURL });
  const page = await context.newPage();
  await page.goto('/');
  await expect(page.getByText('needs a browser with JavaScript and WebAssembly')).toBeVisible();
  await context.close();
});
