import { expect } from '@playwright/test';
import { ALL, CLOUDS, KNOWN, heard, property, ready, show, stateOf } from './element-support.js';
import { FRESH, STILL, boxOf, frames, pictureOf, state, test, unfold } from './support.js';

/** @typedef {import('./element-support.js').AnyElement} AnyElement */
/** @typedef {import('@playwright/test').Page} Page */

/**
 * Counts calls of what starts work.
 *
 * @param {Page} page
 */
async function count(page) {
  await page.addInitScript(() => {
    const counts = { frames: 0, compiled: 0, instances: 0 };
    Object.assign(window, { counts, quietFrame: requestAnimationFrame.bind(window) });
    const { requestAnimationFrame: request } = window;
    window.requestAnimationFrame = (callback) => {
      counts.frames++;
      return request.call(window, callback);
    };
    const { compile, compileStreaming, instantiate } = WebAssembly;
    WebAssembly.compile = (...given) => (counts.compiled++, compile.apply(WebAssembly, given));
    WebAssembly.compileStreaming = (...given) => (counts.compiled++, compileStreaming.apply(WebAssembly, given));
    WebAssembly.instantiate = /** @type {any} */ (
      (/** @type {[any, any]} */ ...given) => (counts.instances++, instantiate.apply(WebAssembly, given))
    );
  });
}

/**
 * @param {Page} page
 * @returns {Promise<{ frames: number, compiled: number, instances: number }>}
 */
const counted = (page) => page.evaluate(() => Reflect.get(window, 'counts'));

/**
 * Lets frames pass that are nobody's.
 *
 * @param {Page} page
 */
const pass = (page) =>
  page.evaluate(async () => {
    for (let i = 0; i < 6; i++) await new Promise(Reflect.get(window, 'quietFrame'));
  });

/**
 * Has something of a widget play until it has moved, scrolls it out of sight, and waits until it has been told.
 *
 * @param {Page} page
 * @param {string} name of the widget
 * @param {string} [played] what is to be played; the growth of its cloud where it is left out
 */
const leave = (page, name, played) =>
  page.evaluate(
    async ([tag, play]) => {
      const figure = /** @type {AnyElement} */ (/** @type {unknown} */ (document.querySelector(tag)));
      const moved = new Promise((resolve) => figure.addEventListener(play ? 'input' : 'stats', resolve, { once: true }));
      if (play) /** @type {HTMLElement | null | undefined} */ (figure.shadowRoot?.querySelector(`.${play} button`))?.click();
      else figure.setState({ widget: tag, version: 1, shown: 0, playing: true });
      await moved;
      scrollTo(0, 6000);
      // Observers look in the same frame.
      await new Promise((resolve) => {
        const observer = new IntersectionObserver(([{ isIntersecting }]) => {
          if (isIntersecting) return;
          observer.disconnect();
          resolve(undefined);
        });
        observer.observe(figure);
      });
    },
    /** @type {const} */ ([name, played]),
  );

test.describe('far from the window', () => {
  test.use(STILL);

  test('what a page opens with is there before any observer has looked, and nothing else is', async ({ page }) => {
    await page.addInitScript(() => {
      window.IntersectionObserver = /** @type {any} */ (
        class {
          observe() {}
          unobserve() {}
        }
      );
    });
    // What touches the window is not in it.
    const [above, seen, below] = ['position: absolute; bottom: 100%', '', 'position: absolute; top: 100vh'];
    await show(page, [above, seen, below].map((style) => `<div style="width: 600px; ${style}"><banana-machine style="margin: 0"></banana-machine></div>`).join(''));
    const widgets = page.locator('banana-machine');
    await ready(widgets.nth(1));
    const plane = widgets.nth(1).locator('canvas.plane');
    const opening = await pictureOf(plane);
    await widgets.nth(1).getByRole('button', { name: 'Straight' }).click();
    await expect.poll(() => pictureOf(plane)).not.toBe(opening);
    for (const i of [0, 2]) expect(await property(widgets.nth(i), 'machine')).toBe(undefined);
  });

  test('the picture comes first, and what is around it with the next frame, also where the reader leaps to it', async ({ page }) => {
    await page.addInitScript(() => {
      const first = /** @type {boolean[][]} */ ([]);
      Object.assign(window, { first });
      document.addEventListener('load', ({ target }) => {
        const { shadowRoot } = /** @type {Element} */ (target);
        first.push(['canvas', 'input'].map((part) => shadowRoot?.querySelector(part) !== null));
      });
    });
    await show(page, '<map-squeeze></map-squeeze><div style="height: 5000px"></div><map-squeeze></map-squeeze>');
    for (const widget of await page.locator('map-squeeze').all()) {
      await widget.scrollIntoViewIfNeeded();
      await ready(widget);
      await expect(widget.locator('#v')).toBeVisible();
    }
    expect(await page.evaluate(() => Reflect.get(window, 'first'))).toEqual([[true, false], [true, false]]);
  });

  test('what comes within six hundred pixels is there before the reader is, and what is further off is not', async ({ page }) => {
    const places = [560, 620].map((below) => `<div style="position: absolute; top: calc(100vh + ${below}px); width: 600px"><map-squeeze></map-squeeze></div>`);
    await show(page, places.join(''));
    const widgets = page.locator('map-squeeze');
    await ready(widgets.nth(0));
    expect(await property(widgets.nth(1), 'machine')).toBe(undefined);
  });

  test('nothing is fetched or computed, and one module serves all', FRESH, async ({ page }) => {
    /** @type {string[]} */
    const fetched = [];
    page.on('request', (request) => fetched.push(new URL(request.url()).pathname));
    await count(page);
    await show(page, `<div style="height: 5000px"></div>${ALL.map((name) => `<${name}></${name}>`).join('')}`, {
      script: '<script type="module" src="/external.js"></script>',
    });
    // Not by polling, which asks for frames.
    await page.evaluate((tags) => Promise.all(tags.map((tag) => customElements.whenDefined(tag))).then(() => true), [...ALL]);
    await pass(page);
    expect(await counted(page)).toEqual({ frames: 0, compiled: 0, instances: 0 });
    expect(fetched.filter((path) => path.endsWith('.wasm'))).toEqual([]);
    for (const name of ALL) {
      await page.locator(name).scrollIntoViewIfNeeded();
      await ready(page.locator(name));
    }
    expect(await counted(page)).toMatchObject({ compiled: 1, instances: ALL.length });
    expect(fetched.filter((path) => path.endsWith('.wasm'))).toEqual(['/motion.wasm']);
  });

  test('a page with one widget fetches what it needs of the module', async ({ page }) => {
    for (const name of ALL) {
      const module = page.waitForRequest(/\.wasm$/);
      await show(page, `<${name}></${name}>`, { script: '<script type="module" src="/external.js"></script>' });
      await ready(page.locator(name));
      expect(new URL((await module).url()).pathname).toMatch(new RegExp(`^/chunks/${name}-\\w+\\.wasm$`));
    }
  });

  for (const width of [320, 375, 768, 1280]) {
    test(`room is kept, ${width} px wide: nothing moves when the figure comes`, FRESH, async ({ page }) => {
      // Lower than a figure: what comes after it is out of sight, whatever a page keeps for it before the script is there.
      await page.setViewportSize({ width, height: 500 });
      await page.addInitScript(() => {
        const shifts = /** @type {string[]} */ ([]);
        Object.assign(window, { shifts });
        new PerformanceObserver((list) => {
          for (const entry of list.getEntries()) {
            // What is inside of an element has no node here; of the page, nothing may move.
            for (const { node } of Reflect.get(entry, 'sources')) if (node) shifts.push(String(node.textContent));
          }
        }).observe({ type: 'layout-shift', buffered: true });
      });
      // The script comes after the page is there, as it does on a slow line.
      const [first, ...others] = ALL;
      const tags = ALL.join(', ');
      await show(page, `<p>Before</p>${ALL.map((name) => `<${name}></${name}>`).join('<p>Between</p><div style="height: 1500px"></div>')}<p>After</p>`, {
        // As doc/embedding.md tells pages to: before the script is there, nobody else can.
        head: `<style>${tags} { display: block } :is(${tags}):not(:defined) { min-height: 150vh }</style>`,
      });
      const heights = () => Promise.all(others.map((name) => page.locator(name).evaluate((element) => element.getBoundingClientRect().height)));
      await page.waitForFunction((names) => names.every((name) => document.querySelector(name)?.shadowRoot?.querySelector('.reserved')), others);
      const reserved = await heights();
      await ready(page.locator(first));
      await page.evaluate(async () => {
        for (let y = 0; y < document.body.scrollHeight; y += 400) {
          scrollTo(0, y);
          for (let i = 0; i < 3; i++) await new Promise(requestAnimationFrame);
        }
      });
      for (const name of others) await ready(page.locator(name));
      for (const [i, height] of (await heights()).entries()) expect(Math.abs(reserved[i] - height) / height, others[i]).toBeLessThan(0.15);
      await frames(page);
      expect(await page.evaluate(() => Reflect.get(window, 'shifts'))).toEqual([]);
    });
  }
});

test.describe('out of sight', () => {
  for (const name of CLOUDS) {
    test(`${name} asks for no frames while it grows, and goes on where it was`, async ({ page }) => {
      await count(page);
      await show(page, `<${name}></${name}><div style="height: 6000px"></div>`);
      const widget = page.locator(name);
      await ready(widget);
      const shown = () => widget.evaluate((element) => /** @type {AnyElement} */ (element).machine.shown);
      const samples = Number(await property(widget, 'samples'));
      await leave(page, name);
      expect(await property(widget, 'playing')).toBe(true);
      await pass(page);
      const before = [(await counted(page)).frames, await shown()];
      expect(before[1]).toBeLessThan(samples);
      await pass(page);
      expect([(await counted(page)).frames, await shown()]).toEqual(before);
      await page.evaluate(() => scrollTo(0, 0));
      await expect.poll(shown, { timeout: 20_000 }).toBe(samples);
    });
  }

  for (const [name, key, end] of /** @type {const} */ ([['arc-anatomy', 'underway', 100], ['odometry-decomposer', 'phase', 3], ['odometry-decomposer', 'drift', 120]])) {
    test(`${name} asks for no frames while ${key} is played, and goes on where it was`, async ({ page }) => {
      await count(page);
      await show(page, `<${name}></${name}><div style="height: 6000px"></div>`);
      const widget = page.locator(name);
      await ready(widget);
      const at = async () => Number(/** @type {any} */ (await stateOf(widget))[key]);
      await expect(widget.locator(`.${key} button`)).toHaveText('Play');
      // It sets out from the beginning where it stood at the end.
      await leave(page, name, key);
      await pass(page);
      const before = [(await counted(page)).frames, await at()];
      expect(before[1]).toBeLessThan(end);
      await pass(page);
      expect([(await counted(page)).frames, await at()]).toEqual(before);
      // Meanwhile the time goes on.
      const next = await page.evaluate(async ([tag, name]) => {
        const now = performance.now.bind(performance);
        performance.now = () => now() + 60_000;
        const figure = /** @type {AnyElement} */ (/** @type {unknown} */ (document.querySelector(tag)));
        const input = new Promise((resolve) => figure.addEventListener('input', resolve, { once: true }));
        scrollTo(0, 0);
        await input;
        return Number(/** @type {any} */ (figure.getState())[name]);
      }, /** @type {const} */ ([name, key]));
      // A frame is at most a tenth of a second.
      expect(next - before[1]).toBeLessThan(end / 8);
      await expect.poll(at, { timeout: 20_000 }).toBe(end);
    });
  }

  test('nor does a hidden page', async ({ page }) => {
    await count(page);
    await show(page, '<banana-machine></banana-machine>');
    const widget = page.locator('banana-machine');
    await ready(widget);
    const hide = (/** @type {boolean} */ hidden) =>
      widget.evaluate((element, value) => {
        // From its beginning: it may have come to its end meanwhile.
        if (value) /** @type {AnyElement} */ (element).setState({ widget: element.localName, version: 1, shown: 0, playing: true });
        Object.defineProperty(document, 'hidden', { configurable: true, value });
        document.dispatchEvent(new Event('visibilitychange'));
      }, hidden);
    await hide(true);
    await pass(page);
    const before = await counted(page);
    const shown = await widget.evaluate((element) => /** @type {AnyElement} */ (element).machine.shown);
    await pass(page);
    expect(await counted(page)).toEqual(before);
    expect(await widget.evaluate((element) => /** @type {AnyElement} */ (element).machine.shown)).toBe(shown);
    await hide(false);
    await expect.poll(() => widget.evaluate((element) => /** @type {AnyElement} */ (element).machine.shown)).toBeGreaterThan(shown);
  });
});

test('a figure that goes while the page is hidden is not kept for the frame that it has asked for', async ({ page }) => {
  await show(page, '<banana-machine></banana-machine>');
  const widget = page.locator('banana-machine');
  await ready(widget);
  // It grows, and so there is always a frame to come.
  await page.evaluate(() => void Object.defineProperty(document, 'hidden', { configurable: true, value: true }));
  await frames(page);
  await widget.evaluate((element) => {
    element.remove();
    Object.assign(window, { gone: new WeakRef(element) });
  });
  const session = await page.context().newCDPSession(page);
  await expect
    .poll(async () => {
      await session.send('HeapProfiler.collectGarbage');
      return page.evaluate(() => Reflect.get(window, 'gone').deref() === undefined);
    })
    .toBe(true);
});

test.describe('moved and removed', () => {
  for (const name of CLOUDS) {
    test.describe('with less motion', () => {
      test.use(STILL);

      test(`${name} keeps its cloud, half grown, over a move and over a removal`, async ({ page }) => {
        await show(page, `<div id="a"><${name}></${name}></div><div id="b"></div>`);
        const widget = page.locator(name);
        await ready(widget);
        // One of which no robot gets out of the picture: for it the view would open, and stay so until a new one is made.
        await widget.evaluate((element) => void (/** @type {any} */ (element).seed = 11));
        await unfold(widget);
        const press = (/** @type {string} */ button) => widget.locator('.cloud').getByRole('button', { name: button, exact: true }).click();
        await press('Reset');
        for (let i = 0; i < 5; i++) await press('Step');
        const before = await stateOf(widget);
        expect(/** @type {any} */ (before).shown).toBeGreaterThan(0);
        expect(/** @type {any} */ (before).shown).toBeLessThan(/** @type {any} */ (before).samples);
        const picture = await pictureOf(widget.locator('canvas.plane'));
        const kept = await widget.evaluate((element) => {
          const { machine } = /** @type {AnyElement} */ (element);
          document.querySelector('#b')?.append(element);
          return machine === /** @type {AnyElement} */ (element).machine;
        });
        expect(kept).toBe(true);
        await frames(page);
        expect(await stateOf(widget)).toEqual(before);
        await widget.evaluate(async (element) => {
          element.remove();
          await new Promise(requestAnimationFrame);
          document.querySelector('#a')?.append(element);
        });
        await ready(widget);
        expect(await stateOf(widget)).toEqual(before);
        await expect.poll(() => pictureOf(widget.locator('canvas.plane'))).toBe(picture);
      });
    });

    test(`${name} goes on growing after a removal`, async ({ page }) => {
      await show(page, `<${name}></${name}>`);
      const widget = page.locator(name);
      await ready(widget);
      const [shown, samples] = await widget.evaluate(async (element) => {
        const parent = /** @type {Element} */ (element.parentElement);
        const { machine } = /** @type {AnyElement} */ (element);
        const before = machine.shown;
        element.remove();
        await new Promise(requestAnimationFrame);
        const again = new Promise((resolve) => element.addEventListener('load', resolve));
        parent.append(element);
        await again;
        const now = /** @type {AnyElement} */ (element).machine;
        return [now.shown - before, now.config.samples];
      });
      expect(shown).toBeGreaterThanOrEqual(0);
      await expect.poll(() => widget.evaluate((element) => /** @type {AnyElement} */ (element).machine.shown), { timeout: 20_000 }).toBe(samples);
    });

  }

  for (const name of ALL) {
    test(`${name} stays as the reader had it over a move and over a removal`, async ({ page }) => {
      await show(page, `<div id="a"><${name}></${name}></div><div id="b"></div>`);
      const widget = page.locator(name);
      await ready(widget);
      const { fold } = KNOWN[name];
      const folds = widget.locator('details');
      await expect.poll(() => folds.count()).toBeGreaterThan(3);
      await folds.nth(fold.at).locator('summary').click();
      await folds.last().locator('summary').click();
      const open = () => folds.evaluateAll((all) => all.map((each) => /** @type {HTMLDetailsElement} */ (each).open));
      const before = await open();
      expect(before.filter(Boolean)).toHaveLength(2);
      const field = folds.nth(fold.at).locator(fold.field);
      await field.fill(fold.value);
      await widget.evaluate((element) => document.querySelector('#b')?.append(element));
      await frames(page);
      expect(await open()).toEqual(before);
      const height = (await boxOf(widget)).height;
      const heights = await widget.evaluate(async (element) => {
        element.remove();
        await new Promise(requestAnimationFrame);
        const again = new Promise((resolve) => element.addEventListener('load', resolve));
        document.querySelector('#a')?.append(element);
        const heights = [element.getBoundingClientRect().height];
        await again;
        return [...heights, element.getBoundingClientRect().height];
      });
      await ready(widget);
      expect(await open()).toEqual(before);
      await expect(field).toHaveValue(fold.value);
      await expect(folds.nth(fold.at).locator('.folded')).not.toBeEmpty();
      // All the while it takes the room that it took.
      expect(heights).toEqual([height, height]);
      // It goes on: what is pressed has its effect.
      await folds.last().locator('summary').click();
      await expect.poll(open).toEqual(before.with(-1, false));
      const { slider, values: [value] } = KNOWN[name];
      await widget.locator(`#${slider}`).fill(String(value));
      await expect.poll(() => property(widget, slider)).toBe(value);
    });

    test(`${name} keeps what the reader did in the very moment before it was removed`, async ({ page }) => {
      await show(page, `<${name}></${name}>`);
      const widget = page.locator(name);
      await ready(widget);
      const { slider, at, values: [value] } = KNOWN[name];
      const kept = await widget.evaluate(async (element, [id, to]) => {
        const slider = /** @type {HTMLInputElement} */ (element.shadowRoot?.querySelector(`#${id}`));
        slider.value = String(to);
        slider.dispatchEvent(new Event('input', { bubbles: true, composed: true }));
        element.remove();
        await new Promise(requestAnimationFrame);
        return /** @type {AnyElement} */ (element).getState();
      }, /** @type {const} */ ([slider, value]));
      expect(kept).toHaveProperty(at, value);
    });

    test(`${name}, removed, leaves nothing behind`, async ({ page }) => {
      await count(page);
      await show(page, `<${name} share></${name}><p>Stays</p>`);
      await ready(page.locator(name));
      const pixels = await page.evaluate(async ([tag, slider]) => {
        const element = /** @type {any} */ (document.querySelector(tag));
        const { machine, motion, createMachine } = element;
        Object.assign(window, { made: 1, freed: 0 });
        const count = (/** @type {string} */ what) => Object.assign(window, { [what]: Reflect.get(window, what) + 1 });
        const watched = (/** @type {any} */ each) => {
          const { free } = each;
          /** @this {object} */
          each.free = function () {
            count('freed');
            free.call(this);
          };
          return each;
        };
        watched(machine);
        // Others are asked how the figure opens.
        element.createMachine = (/** @type {any[]} */ ...given) => {
          count('made');
          return watched(createMachine.apply(element, given));
        };
        element[slider] = null;
        element.embedCode();
        const refs = [element, machine, motion, element.shadowRoot].map((each) => new WeakRef(each));
        element.remove();
        await new Promise(requestAnimationFrame);
        Object.assign(window, { refs });
        return [...(element.shadowRoot?.querySelectorAll('canvas') ?? [])].map(({ width, height }) => width * height);
      }, [name, KNOWN[name].slider]);
      expect(new Set(pixels)).toEqual(new Set([0]));
      const [made, freed] = await page.evaluate(() => ['made', 'freed'].map((what) => Reflect.get(window, what)));
      expect(made).toBeGreaterThan(2);
      expect(freed).toBe(made);
      await pass(page);
      const before = await counted(page);
      await pass(page);
      expect(await counted(page)).toEqual(before);
      const session = await page.context().newCDPSession(page);
      await expect
        .poll(async () => {
          await session.send('HeapProfiler.collectGarbage');
          return page.evaluate(() => Reflect.get(window, 'refs').map((/** @type {WeakRef<object>} */ ref) => ref.deref() !== undefined));
        })
        .toEqual([false, false, false, false]);
    });
  }
});

test('two copies of the bundle on one page are one', async ({ page }) => {
  await page.route('**/copy.js', async (route) => {
    const original = await page.request.get('/motion-widgets.js');
    await route.fulfill({ contentType: 'text/javascript', body: await original.text() });
  });
  await show(page, ALL.map((name) => `<${name}></${name}>`).join(''), {
    script: '<script type="module" src="/motion-widgets.js"></script><script type="module" src="/copy.js"></script><script src="/motion-widgets.iife.js" defer></script>',
  });
  const widget = page.locator('banana-machine');
  await ready(widget);
  expect((await state(widget)).config.samples).toBe(50000);
  expect((await heard(page, ['error'])).length).toBe(0);
});
