import AxeBuilder from '@axe-core/playwright';
import { expect, test as plain } from '@playwright/test';
import { STILL, boxOf, frames, open, pictureOf, state, test } from './support.js';

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

  for (const colorScheme of /** @type {const} */ (['light', 'dark'])) {
    test(`has no accessibility violations in ${colorScheme}`, async ({ page }) => {
      await page.emulateMedia({ colorScheme });
      const widget = await open(page);
      expect((await new AxeBuilder({ page }).analyze()).violations).toEqual([]);

      await widget.getByRole('button', { name: 'Straight' }).click();
      await widget.getByLabel('Isolate one').check();
      await expect(widget.locator('.note')).toBeVisible();
      expect((await new AxeBuilder({ page }).analyze()).violations).toEqual([]);
    });
  }

  test('repaints its canvases when the colour scheme changes', async ({ page }) => {
    const widget = await open(page);
    const canvas = widget.locator('canvas.plane');
    const light = await pictureOf(canvas);
    await page.emulateMedia({ colorScheme: 'dark' });
    await expect.poll(() => pictureOf(canvas)).not.toBe(light);
    await page.emulateMedia({ colorScheme: 'light' });
    await expect.poll(() => pictureOf(canvas)).toBe(light);
  });

  test('fits a phone: nothing to scroll sideways, and targets for a finger', async ({ page }) => {
    await page.setViewportSize({ width: 375, height: 812 });
    const widget = await open(page);
    await widget.getByLabel('Isolate one').check();
    const overflow = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    expect(overflow).toBeLessThanOrEqual(0);
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

  test('stands twice on a page without sharing anything', async ({ page }) => {
    const first = await open(page);
    await page.evaluate(() => document.querySelector('main')?.append(document.createElement('banana-machine')));
    const second = page.locator('banana-machine').nth(1);
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
    await page.evaluate(() => document.querySelector('main')?.append(Reflect.get(window, 'kept')));
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
  const sentence = page.locator('banana-machine').getByRole('alert');
  await expect(sentence).toBeVisible();
  await expect(sentence).toHaveText('This interactive figure cannot run here. WebAssembly is not available here, and motion-widgets needs it.');
  await frames(page);
  const heard = await page.evaluate(() =>
    Reflect.get(window, 'failures').map((/** @type {ErrorEvent} */ event) => [
      event.constructor.name,
      /** @type {Element} */ (event.target).localName,
    ]),
  );
  expect(heard).toEqual([['ErrorEvent', 'banana-machine'], ['ErrorEvent', 'map-squeeze']]);
});

plain('without JavaScript the page says what is missing', async ({ browser, baseURL }) => {
  const context = await browser.newContext({ javaScriptEnabled: false, baseURL });
  const page = await context.newPage();
  await page.goto('/');
  await expect(page.getByText('needs a browser with JavaScript and WebAssembly')).toBeVisible();
  await context.close();
});
