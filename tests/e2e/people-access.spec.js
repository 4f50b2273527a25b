import { expect } from '@playwright/test';
import { expectAccessible } from './axe.js';
import { ALL, KNOWN, ready, show } from './element-support.js';
import { openSqueeze, squeezed } from './squeeze-support.js';
import { STILL, boxOf, centreOf, frames, open, pictureOf, pixelsOf, state, test, unfold } from './support.js';

/**
 * @typedef {import('@playwright/test').Page} Page
 * @typedef {import('@playwright/test').Locator} Locator
 * @typedef {import('../../www/types.d.ts').BananaMachineElement} BananaMachineElement
 * @typedef {import('../../www/types.d.ts').MapSqueezeElement} MapSqueezeElement
 */

/** @typedef {import('./element-support.js').Name} Name */

/**
 * Whatever differs in looks: colours, size, words.
 *
 * @type {Record<string, { media?: Parameters<Page['emulateMedia']>[0], width?: number, german?: boolean }>}
 */
const LOOKS = {
  light: { media: { colorScheme: 'light' } },
  dark: { media: { colorScheme: 'dark' } },
  'forced colours, light': { media: { forcedColors: 'active', colorScheme: 'light' } },
  'forced colours, dark': { media: { forcedColors: 'active', colorScheme: 'dark' } },
  'a phone of 320 px, German': { width: 320, german: true },
};

/** The states of both widgets that have something of their own to show; each goes on from the one before. */
const STATES = /** @type {[string, (banana: Locator, squeeze: Locator) => Promise<unknown>][]} */ ([
  ['as it opens', async () => {}],
  ['with all folds open', async (banana, squeeze) => {
    await unfold(banana);
    await unfold(squeeze);
  }],
  ['isolated, with a note', async (banana) => {
    await banana.locator('.toggle', { hasText: /Isolate one|Nur ein α/ }).locator('input').check();
    await banana.locator('#omega').fill('0');
    await expect(banana.locator('.note')).toBeVisible();
  }],
  ['odometry, with a mark', async (banana) => {
    await banana.locator('input[name=model]').nth(1).check();
    await banana.locator('#robot').fill('7');
  }],
  ['a robot that stands still', async (banana) => {
    await banana.locator('#v').fill('0');
  }],
  ['as a density, with the menu open', async (banana) => {
    await banana.locator('#v').fill('1');
    await banana.locator('#samples').fill('9');
    await banana.locator('.exports summary').click();
  }],
  ['empty', async (banana) => {
    await banana.locator('.cloud button').nth(2).click();
  }],
  ['in parts, costs measured', async (_, squeeze) => {
    await squeeze.locator('input[name=sampler]').nth(2).check();
    await expect(squeeze.locator('.table')).toHaveAttribute('aria-busy', 'false');
  }],
  ['close, without the condition', async (_, squeeze) => {
    await squeeze.locator('input[name=view]').nth(1).check();
    await squeeze.locator('.judge .toggle input').uncheck();
    await squeeze.locator('#sample').fill('3');
  }],
  ['a map of one’s own, then one refused', async (_, squeeze) => {
    await squeeze.locator('.own-map button').last().click();
    await squeeze.locator('#map-files').setInputFiles({ name: 'a.txt', mimeType: 'text/plain', buffer: Buffer.from('') });
    await expect(squeeze.locator('.own-map .note')).toBeVisible();
  }],
]);

test.describe('no accessibility violations', () => {
  test.use(STILL);
  for (const [look, { media, width, german }] of Object.entries(LOOKS)) {
    test(`in ${look}`, async ({ page }) => {
      test.slow();
      if (media) await page.emulateMedia(media);
      if (width) await page.setViewportSize({ width, height: 812 });
      const banana = await open(page);
      const squeeze = await openSqueeze(page);
      if (german) {
        await page.addScriptTag({ type: 'module', url: '/de.js' });
        await page.evaluate(() => (document.documentElement.lang = 'de'));
      }
      for (const [name, reach] of STATES) {
        await reach(banana, squeeze);
        await frames(page);
        // A state of one widget leaves the rest of the page as it was.
        await expectAccessible(page, name, [':root', 'banana-machine', 'map-squeeze'][reach.length]);
        if (width) expect(await page.evaluate(() => document.documentElement.scrollWidth - innerWidth), name).toBeLessThanOrEqual(0);
      }
    });
  }
});

/** @param {Locator} widget */
const stateOf = (widget) =>
  widget.evaluate((element) => /** @type {BananaMachineElement | MapSqueezeElement} */ (element).getState());

test.describe('from the keyboard alone', () => {
  test.use(STILL);

  /** Stops of Tab on a page of all figures are fewer. */
  const MANY_STOPS = 300;

  /**
   * Goes on by Tab until the focus is there.
   *
   * @param {Locator} target
   */
  async function tabTo(target) {
    const page = target.page();
    for (let presses = 0; presses < MANY_STOPS; presses++) {
      if (await target.evaluate((element) => element.matches(':focus'))) return;
      await page.keyboard.press('Tab');
    }
    throw new Error(`Tab does not lead to ${target}.`);
  }

  for (const name of ALL) {
    test(`Tab leads to every handle and control of ${name}, once, and beyond`, async ({ page }) => {
      await show(page, `<a id="before" href="#">Before</a><${name}></${name}><a id="after" href="#">After</a>`);
      const widget = page.locator(name);
      await ready(widget);
      await unfold(widget);
      await widget.evaluate((element) => {
        const root = /** @type {ShadowRoot} */ (element.shadowRoot);
        const stops = [...root.querySelectorAll('button, input, select, textarea, summary, a[href], .handle')].filter((each) => {
          const { type, name, checked } = /** @type {HTMLInputElement} */ (each);
          // The field of a slider's value is reached from the slider, the others of a group from the one that is chosen.
          if (each.matches(':disabled, .typed') || !each.checkVisibility()) return false;
          return type !== 'radio' || checked || !root.querySelector(`input[name="${name}"]:checked`);
        });
        Object.assign(window, { stops });
      });
      await page.locator('#before').focus();
      /** @type {(number | string)[]} */
      const reached = [];
      const stop = () => page.evaluate((tag) => {
        const inside = document.querySelector(tag)?.shadowRoot?.activeElement;
        return inside ? Reflect.get(window, 'stops').indexOf(inside) : `${document.activeElement?.id}`;
      }, name);
      const [count, names] = await page.evaluate(() => {
        const stops = /** @type {Element[]} */ (Reflect.get(window, 'stops'));
        return [stops.length, stops.map((each) => each.outerHTML.slice(0, 120))];
      });
      expect(count).toBeGreaterThan(10);
      do {
        await page.keyboard.press('Tab');
        reached.push(await stop());
      } while (reached.at(-1) !== 'after' && reached.length <= count + 5);
      expect(reached.at(-1)).toBe('after');
      const missed = names.filter((_, i) => !reached.includes(i));
      expect(missed).toEqual([]);
      expect(reached.length).toBe(count + 1);
    });
  }

  test('the Banana Machine comes to the state that a pointer brings it to', async ({ page }) => {
    const widget = await open(page);
    const opening = await stateOf(widget);
    await unfold(widget);
    await widget.getByRole('button', { name: 'Hard arc' }).click();
    await widget.getByLabel('triangular').click();
    await widget.getByLabel('Isolate one').click();
    await widget.getByRole('radio', { name: 'Only α₂' }).click();
    await widget.getByRole('checkbox', { name: 'linearized' }).click();
    await widget.getByRole('button', { name: 'Reset' }).click();
    await widget.getByRole('button', { name: 'Step' }).click();
    const byPointer = await stateOf(widget);
    expect(byPointer).not.toEqual(opening);

    await open(page);
    expect(await stateOf(widget)).toEqual(opening);
    const press = async (/** @type {Locator} */ target, /** @type {string[]} */ ...keys) => {
      await tabTo(target);
      for (const key of keys) await page.keyboard.press(key);
    };
    await press(widget.getByRole('button', { name: 'Hard arc' }), 'Enter');
    await press(widget.locator('summary', { hasText: 'Model' }), 'Enter');
    await press(widget.getByLabel('normal'), 'ArrowRight');
    await press(widget.getByLabel('Isolate one'), 'Space');
    await press(widget.getByRole('checkbox', { name: 'linearized' }), 'Space');
    await page.evaluate(() => /** @type {HTMLElement | null} */ (document.activeElement)?.blur());
    // The isolated one of the group has the focus; the arrows go through them.
    await press(widget.getByRole('radio', { name: 'Only α₄' }), 'ArrowUp', 'ArrowUp');
    await page.evaluate(() => /** @type {HTMLElement | null} */ (document.activeElement)?.blur());
    await press(widget.getByRole('button', { name: 'Reset' }), 'Enter');
    await page.keyboard.press('Shift+Tab');
    await press(widget.getByRole('button', { name: 'Step' }), 'Enter');
    expect(await stateOf(widget)).toEqual(byPointer);
  });

  test('the robot in the map comes to the place that a pointer drags it to', async ({ page }) => {
    const widget = await openSqueeze(page);
    const body = widget.getByRole('slider', { name: 'Robot', exact: true });
    await body.focus();
    for (const key of ['ArrowRight', 'ArrowRight', 'ArrowUp', '[']) await page.keyboard.press(key);
    const byKeys = await squeezed(widget);
    expect(byKeys.config.start.x).toBeCloseTo(2.15, 9);
    expect(byKeys.config.start.y).toBeCloseTo(2.65, 9);
    await widget.getByRole('button', { name: 'Facing a doorway' }).click();
    const from = await centreOf(body);
    const before = (await squeezed(widget)).config.start;
    await page.mouse.move(from.x, from.y);
    await page.mouse.down();
    await page.mouse.move(from.x + 10, from.y, { steps: 3 });
    await page.mouse.up();
    const perPixel = ((await squeezed(widget)).config.start.x - before.x) / 10;
    // To the nearest pixel, the pointer brings it where the keys did.
    await page.mouse.move(from.x + 10, from.y);
    await page.mouse.down();
    await page.mouse.move(from.x + Math.round(0.1 / perPixel), from.y - Math.round(0.05 / perPixel), { steps: 4 });
    await page.mouse.up();
    const { start } = (await squeezed(widget)).config;
    expect(Math.abs(start.x - byKeys.config.start.x)).toBeLessThanOrEqual(perPixel);
    expect(Math.abs(start.y - byKeys.config.start.y)).toBeLessThanOrEqual(perPixel);
  });
});

test.describe('what is said', () => {
  test.use(STILL);

  test('sliders speak their value with its unit, and nothing is announced while one moves', async ({ page }) => {
    const widget = await open(page);
    const status = widget.locator('p[role=status]');
    const slider = widget.locator('#v');
    await slider.scrollIntoViewIfNeeded();
    await expect(slider).toHaveAttribute('aria-valuetext', '1.00 m/s');
    const { x, y, width, height } = await boxOf(slider);
    await page.mouse.move(x + 0.83 * width, y + height / 2);
    await page.mouse.down();
    for (const share of [0.7, 0.6, 0.5]) {
      await page.mouse.move(x + share * width, y + height / 2);
      await frames(page);
      expect(await status.textContent()).toBe('');
    }
    const { config } = await state(widget);
    await page.mouse.up();
    await expect(status).toContainText(`v = ${config.command.v.toFixed(2).replace('-', '−')} m/s`);
    for (const each of await widget.locator('input[type=range]').all()) {
      expect(await each.getAttribute('aria-valuetext')).toMatch(/\d/);
    }
  });
});

test.describe('a finger', () => {
  test.use({ ...STILL, hasTouch: true, viewport: { width: 375, height: 812 } });

  /**
   * Swipes upwards from a place, as fingers do.
   *
   * @param {Page} page
   * @param {{ x: number, y: number }} from
   */
  async function swipe(page, from) {
    const client = await page.context().newCDPSession(page);
    await client.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints: [from] });
    for (let step = 1; step <= 10; step++) {
      const point = { x: from.x + step / 5, y: from.y - 16 * step };
      await client.send('Input.dispatchTouchEvent', { type: 'touchMove', touchPoints: [point] });
    }
    await client.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
    await frames(page);
  }

  /** Where a finger may swipe over each figure. @type {Record<Name, string[]>} */
  const SWIPED = {
    'banana-machine': ['canvas.plane', 'canvas.twist', '#omega', '#alpha3', '#samples', '#chart-omega'],
    'map-squeeze': ['canvas.plane', '#omega', '#clearance', '#samples', '[part=table]'],
    'arc-anatomy': ['canvas.plane', '#omega', '#underway', '#alpha3'],
    'odometry-decomposer': ['canvas.plane', 'canvas.world', '#phase', '#drift', '#correlation', '.rules'],
    'dead-reckoning': ['canvas.plane', 'canvas.twist', '#step', '#headingNoise', '#samples', '.ratios'],
    'alpha-calibrator': ['canvas.plane', 'canvas.leg', '#leg', '#distance', '.tables', '#inflation'],
  };

  /**
   * A figure between what can be scrolled, with a place of it in the lower half of the screen, clear of the picture that stays in
   * sight above.
   *
   * @param {Page} page
   * @param {Name} name
   * @param {string} target
   */
  async function placed(page, name, target) {
    await show(page, `<div style="height: 300px"></div><${name}></${name}><div style="height: 1500px"></div>`, {
      head: '<meta name="viewport" content="width=device-width">',
    });
    const widget = page.locator(name);
    await ready(widget);
    await unfold(widget);
    const place = widget.locator(target);
    await place.evaluate((element) => {
      const { top, height } = element.getBoundingClientRect();
      scrollBy({ top: top + height / 2 - 0.7 * innerHeight, behavior: 'instant' });
    });
    await frames(page);
    return { widget, place };
  }

  for (const name of ALL) for (const handle of KNOWN[name].handles ?? []) {
    test(`that goes up on ${handle} of ${name} moves it and not the page`, async ({ page }) => {
      const { widget, place } = await placed(page, name, handle);
      const before = await stateOf(widget);
      const [from, scrolled] = [await centreOf(place), await page.evaluate(() => scrollY)];
      await swipe(page, from);
      expect(await page.evaluate(() => scrollY)).toBe(scrolled);
      expect(await stateOf(widget)).not.toEqual(before);
    });
  }

  for (const name of ALL) for (const target of SWIPED[name]) {
    test(`that swipes over ${target} of ${name} scrolls the page and changes nothing`, async ({ page }) => {
      const { widget, place } = await placed(page, name, target);
      const before = await stateOf(widget);
      const { x, y, width, height } = await boxOf(place);
      const scrolled = await page.evaluate(() => scrollY);
      // A third from its left: no thumb is there.
      await swipe(page, { x: x + 0.3 * width, y: y + height / 2 });
      await expect.poll(() => page.evaluate(() => scrollY)).toBeGreaterThan(scrolled + 60);
      expect(await stateOf(widget)).toEqual(before);
    });
  }

  test('that taps sets the chart and marks a robot', async ({ page }) => {
    const widget = await open(page);
    await unfold(widget);
    const chart = widget.locator('#chart-omega');
    await chart.scrollIntoViewIfNeeded();
    const { x, y, width, height } = await boxOf(chart);
    await page.touchscreen.tap(x + 0.8 * width, y + height / 2);
    expect((await state(widget)).config.command.omega).toBeGreaterThan(1);
    const canvas = widget.locator('canvas.twist');
    await canvas.scrollIntoViewIfNeeded();
    const centre = await centreOf(canvas);
    await page.touchscreen.tap(centre.x, centre.y);
    await expect(widget.locator('#robot')).not.toHaveValue('');
  });
});

test.describe('on paper', () => {
  test.use(STILL);

  test('there are the figure and what it was made with, light, and nothing to press', async ({ page }) => {
    await page.emulateMedia({ colorScheme: 'light' });
    const widget = await open(page);
    const canvas = widget.locator('canvas.plane');
    const light = await pictureOf(canvas);
    await page.emulateMedia({ colorScheme: 'dark' });
    await expect.poll(() => pictureOf(canvas)).not.toBe(light);
    await page.emulateMedia({ colorScheme: 'dark', media: 'print' });
    expect(await pictureOf(canvas)).toBe(light);
    expect(await widget.locator('.surface').evaluate((element) => getComputedStyle(element).backgroundColor)).toBe('rgb(255, 254, 251)');
    for (const control of await widget.locator('button, input, summary, .handle').all()) await expect(control).toBeHidden();
    for (const value of ['1.00 m/s', '0.50 rad/s', '0.090']) await expect(widget.getByText(value, { exact: true }).first()).toBeVisible();
    await page.emulateMedia({ colorScheme: 'dark', media: 'screen' });
    expect(await pictureOf(canvas)).not.toBe(light);
  });

  test('the figure is light where the browser says that it prints before its styles are those of paper', async ({ page }) => {
    await page.emulateMedia({ colorScheme: 'light' });
    const widget = await open(page);
    const canvas = widget.locator('canvas.plane');
    const light = await pictureOf(canvas);
    await page.emulateMedia({ colorScheme: 'dark' });
    await expect.poll(() => pictureOf(canvas)).not.toBe(light);
    // At once: no frame comes between.
    const printed = await canvas.evaluate((element) => {
      dispatchEvent(new Event('beforeprint'));
      return /** @type {HTMLCanvasElement} */ (element).toDataURL();
    });
    expect(printed).toBe(light);
    await page.evaluate(() => void dispatchEvent(new Event('afterprint')));
    expect(await pictureOf(canvas)).not.toBe(light);
  });
});

test.describe('theming', () => {
  test.use(STILL);

  test('custom properties colour controls and canvases alike, also when they change', async ({ page }) => {
    const widget = await open(page);
    const canvas = widget.locator('canvas.plane');
    const before = await pictureOf(canvas);
    await page.addStyleTag({ content: 'banana-machine { --motion-posterior: rgb(200, 20, 90); --motion-font: monospace }' });
    await expect.poll(() => pictureOf(canvas)).not.toBe(before);
    expect(await pixelsOf(canvas, 'posterior')).toBeGreaterThan(100);
    expect(await widget.evaluate((element) => getComputedStyle(element).fontFamily)).toBe('monospace');
  });

  for (const name of ALL) {
    test(`the parts of ${name} that are documented are there, and can be styled from outside`, async ({ page }) => {
      await show(page, `<${name}></${name}>`);
      const widget = page.locator(name);
      await ready(widget);
      await unfold(widget);
      const manifest = await (await page.request.get('/custom-elements.json')).json();
      const declarations = manifest.modules.flatMap((/** @type {any} */ each) => each.declarations ?? []);
      const { cssParts } = declarations.find((/** @type {any} */ each) => each.tagName === name);
      // The progress is there while there is some.
      const parts = /** @type {string[]} */ (cssParts.map((/** @type {any} */ each) => each.name)).filter((part) => part !== 'progress');
      expect(parts.length).toBeGreaterThan(8);
      await page.addStyleTag({ content: parts.map((part) => `${name}::part(${part}) { outline-color: rgb(1, 2, 3) }`).join('\n') });
      const [missing, others] = await widget.evaluate((element, documented) => {
        const all = [...(element.shadowRoot?.querySelectorAll('[part]') ?? [])];
        const styled = all.filter((each) => getComputedStyle(each).outlineColor === 'rgb(1, 2, 3)').map((each) => each.getAttribute('part') ?? '');
        return [documented.filter((part) => !styled.includes(part)), all.map((each) => each.getAttribute('part') ?? '').filter((part) => !documented.includes(part))];
      }, parts);
      expect(missing).toEqual([]);
      expect(others).toEqual([]);
    });
  }
});

for (const name of ALL) for (const lang of ['en', 'de']) {
  test(`${name} with all folds open fits into 320 px, also in the moment it becomes so narrow, in ${lang}`, async ({ page }) => {
    await page.setViewportSize({ width: 320, height: 812 });
    await show(page, `<${name} lang="${lang}"></${name}>`, {
      head: '<style>body { margin: 0 }</style>',
      script: '<script type="module" src="/motion-widgets.js"></script><script type="module" src="/de.js"></script>',
    });
    const widget = page.locator(name);
    await ready(widget);
    await unfold(widget);
    /** What of it is right of the window, other than what can be scrolled to. */
    const beyond = () => widget.evaluate((element) => {
      const { body } = document;
      const isReached = (/** @type {Element} */ part) => {
        for (let at = part.parentElement; at; at = at.parentElement) if (getComputedStyle(at).overflowX !== 'visible') return false;
        return part.checkVisibility({ visibilityProperty: true });
      };
      const parts = [.../** @type {ShadowRoot} */ (element.shadowRoot).querySelectorAll('*')].filter((part) => part.getBoundingClientRect().right > innerWidth + 0.5 && isReached(part));
      return [document.documentElement.scrollWidth, body.scrollWidth, ...parts.map(({ outerHTML }) => outerHTML.slice(0, 80))];
    });
    await frames(page);
    expect(await beyond()).toEqual([320, 320]);
    await page.evaluate(() => void (document.body.style.width = '1280px'));
    await expect.poll(() => widget.evaluate((element) => /** @type {any} */ (element).pictures[0].view.width)).toBeGreaterThan(400);
    await frames(page);
    // At once: no frame comes between.
    const narrow = await page.evaluate(() => {
      document.body.style.width = '';
      return document.documentElement.scrollWidth;
    });
    expect(narrow).toBe(320);
  });
}

for (const name of ALL) {
  test(`${name}: the help of a slider covers no slider of its group, and no outline crosses it`, async ({ page }) => {
    for (const [width, lang] of /** @type {const} */ ([[320, 'en'], [375, 'de'], [700, 'en'], [700, 'de']])) {
      await page.setViewportSize({ width, height: 812 });
      await show(page, `<${name} lang="${lang}"></${name}>`, {
        script: '<script type="module" src="/motion-widgets.js"></script><script type="module" src="/de.js"></script>',
      });
      const widget = page.locator(name);
      await ready(widget);
      await expect(widget.locator(`#${KNOWN[name].slider}`)).toBeVisible();
      const crossed = await widget.evaluate((element) => {
        const root = /** @type {ShadowRoot} */ (element.shadowRoot);
        return [...root.querySelectorAll('.slider')].flatMap((row) => {
          const slider = /** @type {HTMLInputElement} */ (row.querySelector('input[type=range]'));
          slider.focus();
          const help = /** @type {Element} */ (row.querySelector('.effect')).getBoundingClientRect();
          // The outline of a thumb is 4 px about it, and a thumb 0.525 rem about its middle.
          return [.../** @type {Element} */ (row.closest('fieldset')).querySelectorAll('.slider input[type=range]')]
            .map((each) => each.getBoundingClientRect())
            .filter(({ top, bottom }) => (top + bottom) / 2 + 0.525 * 16 + 4 > help.top && (top + bottom) / 2 < help.bottom)
            .map(() => slider.id);
        });
      });
      expect(crossed, `${width} px, ${lang}`).toEqual([]);
    }
  });

  test(`${name} has on paper what the reader opened, and nothing to press`, async ({ page }) => {
    await show(page, `<${name}></${name}>`);
    const widget = page.locator(name);
    await ready(widget);
    const { at, part } = KNOWN[name].paper;
    const fold = widget.locator('.folds details').nth(at);
    await expect(fold).toBeVisible();
    await page.emulateMedia({ media: 'print' });
    await expect(fold.locator(part).first()).toBeHidden();
    await page.emulateMedia({ media: 'screen' });
    await fold.locator('summary').click();
    await expect(fold.locator(part).first()).toBeVisible();
    await page.emulateMedia({ media: 'print' });
    await expect(fold.locator(part).first()).toBeVisible();
    await expect(widget.locator('.readouts').first()).toBeVisible();
    await expect(widget.locator('[part=caption]')).toBeVisible();
    await expect(widget.locator(':is(button, input, summary, textarea):visible')).toHaveCount(0);
  });
}
