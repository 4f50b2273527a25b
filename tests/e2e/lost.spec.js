// What a browser takes from a page for a while comes back: canvases, sizes, pixels, sight, and the page itself.

import { chromium, expect } from '@playwright/test';
import { CHROME_ARGUMENTS, findChrome } from '../../scripts/browser.mjs';
import { ALL, KNOWN, assign, heard, property, ready, show, stateOf } from './element-support.js';
import { STILL, centreOf, frames, pictureOf, pixelsOf, test } from './support.js';

/** @typedef {import('./element-support.js').AnyElement} AnyElement */
/** @typedef {import('@playwright/test').Locator} Locator */
/** @typedef {import('@playwright/test').Page} Page */

test.use(STILL);

/**
 * Work in a browser of its own, with other arguments than the tests' has.
 *
 * @param {string} address of the tests' server
 * @param {{ args?: string[], ignoreDefaultArgs?: string[] }} options
 * @param {(page: Page, browser: import('@playwright/test').Browser) => Promise<void>} work
 */
async function withBrowser(address, { args = CHROME_ARGUMENTS, ignoreDefaultArgs }, work) {
  const browser = await chromium.launch({ executablePath: process.env.CHROME ?? findChrome(), args, ignoreDefaultArgs });
  try {
    await work(await browser.newPage({ baseURL: address, reducedMotion: 'reduce' }), browser);
  } finally {
    await browser.close();
  }
}

/** The canvases are drawn as by a graphics card, in a process of its own: what the processor draws has nothing to lose. */
const BY_GRAPHICS = [
  ...CHROME_ARGUMENTS.filter((argument) => argument !== '--disable-gpu'),
  '--use-angle=swiftshader',
  '--enable-unsafe-swiftshader',
  '--ignore-gpu-blocklist',
  '--enable-gpu-rasterization',
];

/**
 * How much a colour may differ, of 255: the process for graphics that follows one that died rounds some by 2, and by a few where
 * shades lie over each other. What is lost differs by all of its ink.
 */
const ROUNDED = 8;

/** Every pixel of a figure's pictures. @param {Locator} widget @returns {Promise<number[][]>} */
async function pixelsIn(widget) {
  await frames(widget.page());
  return widget.evaluate((element) =>
    Promise.all(
      [...(element.shadowRoot?.querySelectorAll('canvas') ?? [])].map(async (canvas) => {
        const copy = new OffscreenCanvas(canvas.width, canvas.height);
        const context = /** @type {OffscreenCanvasRenderingContext2D} */ (copy.getContext('2d', { willReadFrequently: true }));
        // A canvas that is read itself is drawn by the processor from then on.
        context.drawImage(await createImageBitmap(canvas), 0, 0);
        return [...context.getImageData(0, 0, copy.width, copy.height).data];
      }),
    ),
  );
}

/** The digest of everything that a figure shows. @param {Locator} widget */
function digest(widget) {
  return widget.evaluate(async (element) => {
    const { machine } = /** @type {AnyElement} */ (element);
    const state = JSON.stringify(/** @type {AnyElement} */ (element).getState());
    const shown = new Blob([machine.poses, JSON.stringify(machine.stats), state]);
    const hash = await crypto.subtle.digest('SHA-256', await shown.arrayBuffer());
    return [...new Uint8Array(hash)].map((byte) => byte.toString(16).padStart(2, '0')).join('');
  });
}

for (const name of ALL) {
  test(`${name} is drawn again after a trap within 100 ms, the same to the bit, and its neighbours go on as they are`, async ({ page }) => {
    const others = ALL.map((each, i) => `<${each} class="other" style="position: fixed; top: 0; right: ${330 * i}px; width: 320px; opacity: 0.5"></${each}>`);
    await show(page, `<${name} id="it" seed="11" ${KNOWN[name].fewer ?? ''}></${name}>${others.join('')}`);
    const widget = page.locator('#it');
    await ready(widget);
    for (const other of await page.locator('.other').all()) await ready(other);
    const before = [await digest(widget), await pictureOf(widget.locator('canvas.plane'))];
    const neighbours = () => Promise.all(ALL.map((each) => digest(page.locator(`${each}.other`))));
    const around = await neighbours();
    await page.evaluate(() => {
      const machines = [...document.querySelectorAll('.other')].map((each) => /** @type {any} */ (each).machine);
      Object.assign(window, { machines });
    });
    await heard(page);
    // What else runs on the machine is not the figure's: the page's own thread tells what it worked, and frames that pass what it waited.
    const session = await page.context().newCDPSession(page);
    await session.send('Performance.enable');
    const worked = async () => 1000 * ((await session.send('Performance.getMetrics')).metrics.find((metric) => metric.name === 'ThreadTime')?.value ?? NaN);
    const [times, waits] = [/** @type {number[]} */ ([]), /** @type {number[]} */ ([])];
    for (let i = 0; i < 9; i++) {
      const start = await worked();
      waits.push(await widget.evaluate(async (element) => {
        const figure = /** @type {any} */ (element);
        const [picture] = figure.pictures;
        const { machine } = figure;
        machine.__wbg_ptr = 0x7ffffff0;
        let frames = 0;
        let request = requestAnimationFrame(function count() {
          frames++;
          request = requestAnimationFrame(count);
        });
        const drawn = new Promise((resolve) => {
          picture.constructor.prototype.draw = /** @this {any} */ function (/** @type {any[]} */ ...given) {
            const moving = Object.getPrototypeOf(picture.constructor.prototype).draw.apply(this, given);
            if (figure.machine && figure.machine !== machine) resolve(undefined);
            return moving;
          };
        });
        figure.gesture.commit();
        await drawn;
        cancelAnimationFrame(request);
        delete picture.constructor.prototype.draw;
        return frames;
      }));
      times.push((await worked()) - start);
      await frames(page);
    }
    const median = (/** @type {number[]} */ all) => all.toSorted((one, other) => one - other)[all.length >> 1];
    console.log(`${name}: drawn again after ${times.map((time) => time.toFixed(0)).join(', ')} ms and ${waits.join(', ')} frames`);
    expect(median(times)).toBeLessThan(100);
    // As many as 100 ms have.
    expect(median(waits)).toBeLessThanOrEqual(6);
    expect([await digest(widget), await pictureOf(widget.locator('canvas.plane'))]).toEqual(before);
    expect((await heard(page)).map(({ name, target }) => [name, target])).toEqual(times.map(() => ['error', name]));
    // Not one of them was made anew.
    expect(await page.evaluate(() => Reflect.get(window, 'machines').map((/** @type {unknown} */ machine, /** @type {number} */ i) => machine === /** @type {any} */ (document.querySelectorAll('.other')[i]).machine))).toEqual(ALL.map(() => true));
    expect(await neighbours()).toEqual(around);
  });

  test(`${name} is drawn again when its canvas has got its context back`, async ({ page }) => {
    await show(page, `<${name}></${name}>`);
    const widget = page.locator(name);
    await ready(widget);
    const canvas = widget.locator('canvas.plane');
    const before = await pictureOf(canvas);
    const blank = await canvas.evaluate((element) => {
      const canvas = /** @type {HTMLCanvasElement} */ (element);
      // As a browser does it.
      canvas.getContext('2d')?.reset();
      const blank = canvas.toDataURL();
      canvas.dispatchEvent(new Event('contextrestored'));
      return blank;
    });
    expect(blank).not.toBe(before);
    expect(await pictureOf(canvas)).toBe(before);
  });

  test(`${name} comes back from a size of zero with what was set meanwhile`, async ({ page }) => {
    await show(page, `<div id="box" style="width: 900px"><${name}></${name}></div>`);
    const widget = page.locator(name);
    await ready(widget);
    const box = page.locator('#box');
    const canvas = widget.locator('canvas.plane');
    const [setting, other] = KNOWN[name].other;
    const put = (/** @type {number | null} */ to) => assign(widget, setting, to);
    /** The picture with a view that is fitted anew, as it is to another size. */
    const fitted = async () => {
      for (const width of ['800px', '900px']) {
        await box.evaluate((element, value) => element.style.setProperty('width', value), width);
        await frames(page);
      }
      return pictureOf(canvas);
    };
    const before = await fitted();
    await put(other);
    // The view holds still while a setting changes.
    const wanted = [await pictureOf(canvas), await fitted()];
    expect(wanted).not.toContain(before);
    await put(null);
    expect(await fitted()).toBe(before);
    for (const [property, none] of [['display', 'none'], ['width', '0'], ['zoom', '0.001'], ['content-visibility', 'hidden']]) {
      await box.evaluate((element, [key, value]) => element.style.setProperty(key, value), [property, none]);
      await frames(page);
      await put(other);
      await frames(page);
      await box.evaluate((element, key) => element.style.removeProperty(key), property);
      await box.evaluate((element) => element.style.setProperty('width', '900px'));
      await expect.poll(async () => wanted.includes(await pictureOf(canvas)), property).toBe(true);
      await put(null);
      expect(await fitted(), property).toBe(before);
    }
    expect(await heard(page, ['error'])).toEqual([]);
  });

  test(`${name} has the screen’s pixels when these change`, async ({ page }) => {
    await page.addInitScript(() => {
      // As in WebKit. What tells of pixels in others, an emulated screen leaves out.
      const { observe } = ResizeObserver.prototype;
      ResizeObserver.prototype.observe = function (target, options) {
        if (options?.box === 'device-pixel-content-box') throw new TypeError('no such box');
        observe.call(this, target);
      };
      Reflect.deleteProperty(ResizeObserverEntry.prototype, 'devicePixelContentBoxSize');
      // It leaves out the news as well.
      const { matchMedia } = window;
      const screens = /** @type {{ list: MediaQueryList, matches: boolean }[]} */ ([]);
      Object.assign(window, { screens });
      window.matchMedia = (query) => {
        const list = matchMedia.call(window, query);
        if (query.includes('resolution')) screens.push({ list, matches: list.matches });
        return list;
      };
    });
    await show(page, `<div style="width: 900px"><${name}></${name}></div>`);
    const widget = page.locator(name);
    await ready(widget);
    const canvas = widget.locator('canvas.plane');
    const before = await pictureOf(canvas);
    const session = await page.context().newCDPSession(page);
    const screen = async (/** @type {number} */ deviceScaleFactor) => {
      await session.send('Emulation.setDeviceMetricsOverride', { width: 1280, height: 720, deviceScaleFactor, mobile: false });
      await page.evaluate(() => {
        for (const each of [...Reflect.get(window, 'screens')]) {
          if (each.list.matches !== each.matches) each.list.dispatchEvent(new Event('change'));
          each.matches = each.list.matches;
        }
      });
    };
    const size = () => canvas.evaluate((element) => [/** @type {HTMLCanvasElement} */ (element).width, /** @type {HTMLCanvasElement} */ (element).height]);
    const [width, height] = await size();
    for (const ratio of [2, 1.5, 3]) {
      await screen(ratio);
      // Lengths on the page are rounded here, and pixels there.
      await expect.poll(async () => (await size()).map((length, i) => Math.abs(length - ratio * [width, height][i]) < ratio)).toEqual([true, true]);
      expect(await pixelsOf(canvas, 'prior')).toBeGreaterThan(0);
    }
    await widget.evaluate((element) => {
      const { stage } = /** @type {any} */ (element);
      const { measure } = stage;
      Object.assign(window, { measured: 0 });
      stage.measure = () => {
        Object.assign(window, { measured: Reflect.get(window, 'measured') + 1 });
        measure.call(stage);
      };
    });
    await screen(1);
    await expect.poll(() => pictureOf(canvas)).toBe(before);
    expect(await page.evaluate(() => Reflect.get(window, 'measured'))).toBe(1);
    await session.detach();
  });

  test(`${name} has the pixels that it is enlarged by`, async ({ page }) => {
    await show(page, `<div id="box" style="width: 600px"><${name}></${name}></div>`);
    const widget = page.locator(name);
    await ready(widget);
    const canvas = widget.locator('canvas.plane');
    const size = () => canvas.evaluate((element) => [/** @type {HTMLCanvasElement} */ (element).width, /** @type {HTMLCanvasElement} */ (element).height]);
    const [width, height] = await size();
    await page.locator('#box').evaluate((element) => element.style.setProperty('zoom', '1.5'));
    // Both are rounded to whole pixels.
    await expect.poll(async () => (await size()).map((length, i) => Math.abs(length - 1.5 * [width, height][i]) < 1.5)).toEqual([true, true]);
    expect(await pixelsOf(canvas, 'prior')).toBeGreaterThan(0);
    await page.locator('#box').evaluate((element) => element.style.removeProperty('zoom'));
    await expect.poll(size).toEqual([width, height]);
    expect(await pixelsOf(canvas, 'prior')).toBeGreaterThan(0);
  });

  test(`${name} in a hidden tab asks for no frame, and shows afterwards what was set meanwhile`, async ({ page }) => {
    await show(page, `<${name}></${name}>`);
    const widget = page.locator(name);
    await ready(widget);
    const canvas = widget.locator('canvas.plane');
    const [setting, other] = KNOWN[name].other;
    await assign(widget, setting, other);
    const wanted = await pictureOf(canvas);
    await assign(widget, setting, null);
    const before = await pictureOf(canvas);
    const [meanwhile, afterwards] = await widget.evaluate(async (element, [key, last]) => {
      const hide = (/** @type {boolean} */ value) => {
        Object.defineProperty(document, 'hidden', { configurable: true, value });
        document.dispatchEvent(new Event('visibilitychange'));
      };
      const { requestAnimationFrame: request } = window;
      let requested = 0;
      window.requestAnimationFrame = (callback) => {
        requested++;
        return request.call(window, callback);
      };
      hide(true);
      const figure = /** @type {AnyElement} */ (element);
      for (let i = 0; i < 10; i++) {
        Reflect.set(figure, key, last + i / 100);
        /** @type {any} */ (figure).gesture.commit();
        await new Promise((resolve) => setTimeout(resolve, 20));
      }
      Reflect.set(figure, key, last);
      const meanwhile = requested;
      // The frame that it asks for then is still to come, and no second one, when the page is seen the next time.
      for (const hidden of [false, true, false]) hide(hidden);
      window.requestAnimationFrame = request;
      return [meanwhile, requested];
    }, /** @type {const} */ ([setting, other]));
    expect(meanwhile).toBe(0);
    expect(afterwards).toBe(1);
    expect(before).not.toBe(wanted);
    await expect.poll(() => pictureOf(canvas)).toBe(wanted);
  });
}

test('pictures are drawn again when the process for graphics has died', async ({ baseURL }) => {
  // Ten times what it takes where nothing else runs: a processor stands in for the graphics card.
  test.setTimeout(200_000);
  await withBrowser(String(baseURL), { args: BY_GRAPHICS }, async (page, browser) => {
    await show(page, '<banana-machine></banana-machine>');
    const widget = page.locator('banana-machine');
    await ready(widget);
    const before = await pixelsIn(widget);
    expect(before).toHaveLength(2);
    // There is ink that can be lost: values that are not those of the first corner.
    for (const pixels of before) expect(pixels.filter((value, i) => Math.abs(value - pixels[i % 4]) > ROUNDED).length).toBeGreaterThan(10_000);
    const restored = widget.evaluate(async (element) => {
      const figure = /** @type {any} */ (element);
      const drawn = (/** @type {HTMLCanvasElement} */ canvas) =>
        new Promise((resolve) =>
          canvas.addEventListener('contextrestored', () => {
            // The next frame may come before anything else is back.
            figure.stage.frame(0);
            resolve(true);
          }),
        );
      await Promise.all([...figure.renderRoot.querySelectorAll('canvas')].map(drawn));
    });
    const session = await browser.newBrowserCDPSession();
    await session.send('Browser.crashGpuProcess');
    await restored;
    const after = await pixelsIn(widget);
    expect(after.map(({ length }) => length)).toEqual(before.map(({ length }) => length));
    const lost = after.map((pixels, i) => pixels.filter((value, j) => Math.abs(value - before[i][j]) > ROUNDED).length);
    expect(lost).toEqual([0, 0]);
  });
});

test('a page that comes back from the back-forward cache is alive', async ({ baseURL }) => {
  await withBrowser(String(baseURL), { ignoreDefaultArgs: ['--disable-back-forward-cache'] }, async (page) => {
    await show(page, ALL.map((name) => `<${name} share></${name}>`).join(''));
    const widgets = ALL.map((name) => page.locator(name));
    const [banana, squeeze] = widgets;
    for (const widget of widgets) {
      await widget.scrollIntoViewIfNeeded();
      await ready(widget);
    }
    await banana.scrollIntoViewIfNeeded();
    await banana.evaluate((element) => void (/** @type {AnyElement} */ (element).omega = 1.25));
    const shown = () => Promise.all([pictureOf(banana.locator('canvas.plane')), ...widgets.map(digest)]);
    const before = await shown();
    await page.evaluate(() => addEventListener('pageshow', ({ persisted }) => void Object.assign(window, { persisted })));
    await page.goto('/embed.html?widget=map-squeeze');
    await page.goBack({ waitUntil: 'commit' });
    await expect.poll(() => page.evaluate(() => Reflect.get(window, 'persisted'))).toBe(true);
    await frames(page);
    expect(await shown()).toEqual(before);
    // It goes on: a handle can be dragged, and the picture follows.
    const { x, y } = await centreOf(banana.locator('.handle'));
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x - 40, y + 30, { steps: 4 });
    await page.mouse.up();
    await frames(page);
    expect(await property(banana, 'omega')).not.toBe(1.25);
    expect(await pictureOf(banana.locator('canvas.plane'))).not.toBe(before[0]);
    expect(await stateOf(squeeze)).toMatchObject({ widget: 'map-squeeze' });
  });
});
