import { expect } from '@playwright/test';
import { ALL, HANDLED, KNOWN, assign, heard, ready, show, stateOf } from './element-support.js';
import { STILL, centreOf, dragSlider, frames, test, unfold } from './support.js';

/** @typedef {import('@playwright/test').Locator} Locator */
/** @typedef {import('./element-support.js').Name} Name */

test.use(STILL);

/** @param {{ name: string }[]} events */
const names = (events) => events.map(({ name }) => name);

test('a drag tells of its steps by input and of its end by one change, composed, with the value there', async ({ page }) => {
  await show(page, '<div id="host"></div>');
  await page.evaluate(() => {
    const root = /** @type {Element} */ (document.querySelector('#host')).attachShadow({ mode: 'open' });
    root.innerHTML = '<banana-machine></banana-machine>';
    const all = /** @type {unknown[]} */ ([]);
    Object.assign(window, { all });
    for (const name of ['input', 'change', 'load', 'stats']) {
      document.addEventListener(name, (event) => {
        const [origin] = event.composedPath();
        all.push([name, /** @type {Element} */ (origin).localName, Reflect.get(origin, 'v'), event.bubbles, event.composed]);
      });
    }
  });
  const widget = page.locator('banana-machine');
  await ready(widget);
  const take = () => page.evaluate(() => /** @type {unknown[][]} */ (Reflect.get(window, 'all')).splice(0));
  const opening = await take();
  expect(opening.map(([name]) => name).sort()).toEqual(['load', 'stats']);
  await dragSlider(widget.locator('#v'), 0.75);
  await frames(page);
  const all = await take();
  // One listener hears all of them, each from the element itself, whatever native controls are inside.
  for (const [, origin, , bubbles, composed] of [...opening, ...all]) expect([origin, bubbles, composed]).toEqual(['banana-machine', true, true]);
  const gestures = all.filter(([name]) => name !== 'stats');
  expect(gestures.length).toBeGreaterThan(3);
  expect(gestures.map(([name]) => name)).toEqual([...Array(gestures.length - 1).fill('input'), 'change']);
  const values = gestures.map(([, , v]) => v);
  expect(values.at(-1)).toBe(Number(await widget.locator('#v').inputValue()));
  expect(new Set(values).size).toBeGreaterThan(2);
  expect(all.some(([name]) => name === 'stats')).toBe(true);
});

/** What a reader may do besides dragging, with all folds open. @type {Record<Name, [string, (widget: Locator) => Promise<void>][]>} */
const ACTS = {
  'banana-machine': [
    ['preset', (widget) => widget.getByRole('button', { name: 'Hard arc' }).click()],
    ['radio', (widget) => widget.getByLabel('triangular').check()],
    ['model', (widget) => widget.getByLabel('odometry').check()],
    ['toggle', (widget) => widget.getByLabel('Isolate one').check()],
    ['overlay', (widget) => widget.getByRole('checkbox', { name: 'linearized' }).check()],
    ['slider by key', (widget) => widget.locator('#omega').press('ArrowRight')],
    ['handle by key', (widget) => widget.locator('.handle').press('ArrowUp')],
    ['marker by key', (widget) => widget.locator('#chart-omega').press('ArrowRight')],
    ['seed', (widget) => widget.getByRole('button', { name: 'New seed' }).click()],
    ['reset', (widget) => widget.getByRole('button', { name: 'Reset' }).click()],
    ['step', (widget) => widget.getByRole('button', { name: 'Step' }).click()],
  ],
  'map-squeeze': [
    ['place', (widget) => widget.getByRole('button', { name: 'Facing a wall' }).click()],
    ['view', (widget) => widget.getByLabel('whole map').check()],
    ['condition', (widget) => widget.getByLabel('Condition on the map').uncheck()],
    ['robot by key', (widget) => widget.locator('.handle.body').press('ArrowUp')],
    ['map', async (widget) => {
      await widget.getByRole('button', { name: 'Use this plan' }).click();
      await expect(widget.getByRole('button', { name: 'Back to the apartment' })).toBeVisible();
    }],
  ],
  'arc-anatomy': [
    ['preset', (widget) => widget.getByRole('button', { name: 'Right turn' }).click()],
    ['radio', (widget) => widget.getByLabel('triangular').check()],
    ['map', (widget) => widget.locator('input[name=map]').nth(1).check()],
    ['as printed', (widget) => widget.locator('.as-printed input').check()],
    ['twist', (widget) => widget.locator('.drawn input[type=checkbox]').check()],
    ['line', (widget) => widget.locator('.stepper button').last().click()],
    ['slider by key', (widget) => widget.locator('#omega').press('ArrowRight')],
    ['underway by key', (widget) => widget.locator('#underway').press('ArrowLeft')],
    ['value typed', async (widget) => {
      await widget.locator('.slider:has(#alpha1) .typed').fill('0.12');
      await widget.locator('.slider:has(#alpha1) .typed').press('Enter');
    }],
    ['start by key', (widget) => widget.locator('.handle.body.start').press('ArrowUp')],
    ['its heading by key', (widget) => widget.locator('.handle.turn.start').press('ArrowUp')],
    ['robot by key', (widget) => widget.locator('.handle.body.next').press('ArrowUp')],
    ['heading by key', (widget) => widget.locator('.handle.turn.next').press('ArrowUp')],
  ],
  'odometry-decomposer': [
    ['preset', (widget) => widget.locator('.presets button').nth(2).click()],
    ['rule', (widget) => widget.locator('input[name=rule]').nth(1).check()],
    ['radio', (widget) => widget.locator('input[name=noise]').nth(1).check()],
    ['slider by key', (widget) => widget.locator('#phase').press('ArrowLeft')],
    ['drift by key', (widget) => widget.locator('#drift').press('ArrowRight')],
    ['correlation by key', (widget) => widget.locator('#correlation').press('ArrowRight')],
    ['earlier robot by key', (widget) => widget.locator('.handle.body.from').press('ArrowDown')],
    ['later robot by key', (widget) => widget.locator('.handle.body.to').press('ArrowUp')],
    ['heading by key', (widget) => widget.locator('.handle.turn.to').press('ArrowUp')],
    ['seed', (widget) => widget.getByRole('button', { name: 'New seed' }).click()],
    ['reset', (widget) => widget.getByRole('button', { name: 'Reset' }).click()],
    ['step', (widget) => widget.getByRole('button', { name: 'Step', exact: true }).click()],
  ],
  'dead-reckoning': [
    ['preset', (widget) => widget.locator('.presets button').nth(1).click()],
    ['recursion', (widget) => widget.locator('input[name=compounding]').nth(1).check()],
    ['noise of the path', (widget) => widget.locator('input[name=per]').nth(1).check()],
    ['slider by key', (widget) => widget.locator('#headingNoise').press('ArrowRight')],
    ['step by key', (widget) => widget.locator('#step').press('ArrowRight')],
    ['steps by key', (widget) => widget.locator('#steps').press('ArrowLeft')],
    ['seed', (widget) => widget.getByRole('button', { name: 'New seed' }).click()],
    ['reset', (widget) => widget.getByRole('button', { name: 'Reset' }).click()],
    ['batch', (widget) => widget.getByRole('button', { name: 'Step', exact: true }).click()],
  ],
  'alpha-calibrator': [
    ['model', (widget) => widget.locator('input[name=kind]').nth(1).check()],
    ['noise', (widget) => widget.locator('input[name=noise]').nth(1).check()],
    ['bad legs', (widget) => widget.getByRole('checkbox', { name: 'Some legs may be bad' }).uncheck()],
    ['systematic error', (widget) => widget.getByRole('checkbox', { name: /^mount yaw/ }).uncheck()],
    ['slider by key', (widget) => widget.locator('#distance').press('ArrowRight')],
    ['leg by key', (widget) => widget.locator('#leg').press('ArrowRight')],
    ['worst leg', (widget) => widget.getByRole('button', { name: 'Next worst leg' }).click()],
    ['inflation by key', (widget) => widget.locator('#inflation').press('ArrowRight')],
  ],
};

for (const name of ALL) {
  test(`every other act of the reader of ${name} is one input and one change`, async ({ page }) => {
    await show(page, `<${name}></${name}>`);
    const widget = page.locator(name);
    await ready(widget);
    await unfold(widget);
    await heard(page);
    for (const [act, go] of ACTS[name]) {
      await go(widget);
      expect(names(await heard(page, ['input', 'change', 'error'])), act).toEqual(['input', 'change']);
    }
  });
}

for (const name of HANDLED) {
  test(`a handle of ${name} that is dragged tells of its steps and its end`, async ({ page }) => {
    await show(page, `<${name}></${name}>`);
    const widget = page.locator(name);
    await ready(widget);
    await heard(page);
    const { x, y } = await centreOf(widget.locator('.handle').first());
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + 40, y - 20, { steps: 4 });
    expect(names(await heard(page))).toEqual(Array(4).fill('input'));
    await page.mouse.up();
    expect(names(await heard(page))).toEqual(['change']);
    // Taken and let go: nothing has changed.
    await page.mouse.down();
    await page.mouse.up();
    expect(names(await heard(page))).toEqual([]);
  });
}

for (const name of ALL) {
  test(`what the page does itself to ${name} is told by stats alone, also out of sight`, async ({ page }) => {
    await show(page, `<${name}></${name}><div style="height: 4000px"></div>`);
    const widget = page.locator(name);
    await ready(widget);
    await heard(page);
    await page.evaluate(() => scrollTo(0, 4000));
    await heard(page, ['stats']);
    const before = await stateOf(widget);
    const [key, value] = KNOWN[name].other;
    for (const to of [value, null]) {
      expect(await assign(widget, key, to)).toBe('');
      expect(names(await heard(page, ['load', 'input', 'change', 'error', 'stats'])), String(to)).toEqual(['stats']);
    }
    expect(await stateOf(widget)).toEqual(before);
    await widget.evaluate((element, [attribute, to]) => element.setAttribute(attribute, String(to)), KNOWN[name].other);
    expect(names(await heard(page, ['load', 'input', 'change', 'error', 'stats']))).toEqual(['stats']);
    const other = await stateOf(widget);
    expect(other).not.toEqual(before);
    await widget.evaluate((element, state) => Reflect.get(element, 'setState').call(element, state), before);
    expect(names(await heard(page, ['load', 'input', 'change', 'error', 'stats']))).toEqual(['stats']);
    expect(await stateOf(widget)).toEqual(before);
  });
}

test('statistics out of sight are those of the moment', async ({ page }) => {
  await show(page, '<banana-machine></banana-machine><div style="height: 4000px"></div>');
  const widget = page.locator('banana-machine');
  await ready(widget);
  await heard(page);
  await page.evaluate(() => scrollTo(0, 4000));
  await heard(page, ['stats']);
  expect(await assign(widget, 'v', 0.3)).toBe('');
  const state = await widget.evaluate((element) => Reflect.get(element, 'getState').call(element));
  await widget.evaluate((element, next) => Reflect.get(element, 'setState').call(element, next), { ...state, seed: 99 });
  await widget.evaluate((element) => element.setAttribute('omega', '0.9'));
  expect(names(await heard(page, ['load', 'input', 'change', 'error', 'stats']))).toEqual(['stats', 'stats', 'stats']);
  const means = await widget.evaluate(
    (element) =>
      new Promise((resolve) => {
        element.addEventListener('stats', (event) => {
          const { detail } = /** @type {CustomEvent} */ (event);
          resolve([detail.cartesian.mean[0], /** @type {any} */ (element).machine.stats.cartesian.mean[0]]);
        });
        element.setAttribute('v', '2');
      }),
  );
  expect(/** @type {number[]} */ (means)[0]).toBe(/** @type {number[]} */ (means)[1]);
  expect(/** @type {number[]} */ (means)[0]).toBeGreaterThan(1.2);
});

for (const name of ALL) {
  test(`${name} tells again of nothing that has not changed, whatever is drawn and asked`, async ({ page }) => {
    await show(page, `<${name}></${name}>`);
    const widget = page.locator(name);
    await ready(widget);
    await heard(page, ['stats']);
    await widget.locator('canvas.plane').hover({ position: { x: 100, y: 100 } });
    await page.emulateMedia({ colorScheme: 'dark' });
    await widget.evaluate((element) => {
      const figure = /** @type {import('./element-support.js').AnyElement} */ (element);
      figure.toSVG();
      figure.toCSV();
      figure.getState();
    });
    expect(await heard(page, ['input', 'change', 'stats'])).toEqual([]);
    expect(await assign(widget, ...KNOWN[name].other)).toBe('');
    expect(await heard(page, ['stats'])).toHaveLength(1);
  });
}

test('words come with a quick picture, and under a hand that goes on with some of the slow ones', async ({ page }) => {
  await show(page, '<banana-machine samples="300"></banana-machine>');
  const widget = page.locator('banana-machine');
  await ready(widget);
  const [quick, slow] = await widget.evaluate(async (element) => {
    const slider = /** @type {HTMLInputElement} */ (element.shadowRoot?.querySelector('#v'));
    let now = performance.now();
    const told = [];
    for (const step of [0, 10]) {
      // Each look at the clock is so much later.
      performance.now = () => (now += step);
      const texts = new Set();
      for (let i = 1; i <= 20; i++) {
        slider.value = String((i + step) / 40);
        slider.dispatchEvent(new Event('input', { bubbles: true, composed: true }));
        await new Promise(requestAnimationFrame);
        await /** @type {any} */ (element).updateComplete;
        texts.add(slider.getAttribute('aria-valuetext'));
      }
      told.push(texts.size);
    }
    Reflect.deleteProperty(performance, 'now');
    return told;
  });
  expect(quick).toBe(20);
  expect(slow).toBeGreaterThan(2);
  expect(slow).toBeLessThan(15);
});

test('words of a slow picture come in the next frame, which draws nothing, or at once where the reader leaves', async ({ page }) => {
  await show(page, '<banana-machine samples="300"></banana-machine>');
  const widget = page.locator('banana-machine');
  await ready(widget);
  const told = await widget.evaluate(async (element) => {
    const figure = /** @type {any} */ (element);
    const slider = figure.shadowRoot.querySelector('#v');
    const [picture] = figure.pictures;
    const { draw } = picture;
    let now = performance.now();
    let drawn = 0;
    picture.draw = function (/** @type {any[]} */ ...given) {
      drawn++;
      return draw.apply(this, given);
    };
    const look = async () => {
      await figure.updateComplete;
      const seen = `${drawn} ${slider.getAttribute('aria-valuetext')} ${figure.getAttribute('v')}`;
      drawn = 0;
      return seen;
    };
    const want = (/** @type {string} */ v) => {
      slider.value = v;
      slider.dispatchEvent(new Event('input', { bubbles: true, composed: true }));
    };
    const seen = [];
    // Each look at the clock is later.
    performance.now = () => (now += 10);
    want('0.5');
    for (let i = 0; i < 3; i++) {
      await new Promise(requestAnimationFrame);
      seen.push(await look());
    }
    want('0.75');
    await new Promise(requestAnimationFrame);
    figure.stage.sight(false);
    seen.push(await look());
    Reflect.deleteProperty(performance, 'now');
    return seen;
  });
  expect(told).toEqual(['1 1.00 m/s null', '0 0.50 m/s 0.5', '0 0.50 m/s 0.5', '1 0.75 m/s 0.75']);
  // So has who leaves before the first picture.
  const controls = await page.evaluate(async () => {
    const figure = /** @type {any} */ (document.createElement('banana-machine'));
    const loaded = new Promise((resolve) => figure.addEventListener('load', () => {
      const count = () => figure.shadowRoot.querySelectorAll('input').length;
      const before = count();
      figure.stage.sight(false);
      figure.updateComplete.then(() => resolve([before, count() > 0]));
    }, { once: true }));
    document.body.prepend(figure);
    return loaded;
  });
  expect(controls).toEqual([0, true]);
});

test('a key that was used goes no further; any other does', async ({ page }) => {
  await show(page, '<banana-machine></banana-machine><map-squeeze></map-squeeze>');
  const [banana, squeeze] = ['banana-machine', 'map-squeeze'].map((name) => page.locator(name));
  await ready(banana);
  await unfold(banana);
  await page.evaluate(() => {
    const keys = /** @type {string[]} */ ([]);
    Object.assign(window, { keys });
    addEventListener('keydown', ({ key }) => keys.push(key));
  });
  const passed = () => page.evaluate(() => /** @type {string[]} */ (Reflect.get(window, 'keys')).splice(0));
  for (const part of ['.handle', '#chart-omega', '#omega', 'input[type=radio] >> nth=0']) {
    await banana.locator(part).focus();
    for (const key of ['ArrowRight', 'ArrowLeft']) await page.keyboard.press(key);
    expect(await passed(), part).toEqual([]);
    for (const key of ['s', '/', 'Escape']) await page.keyboard.press(key);
    expect(await passed(), part).toEqual(['s', '/', 'Escape']);
  }
  // What is typed into a field is nobody else's.
  await banana.locator('#omega').focus();
  await page.keyboard.type('0.7s/');
  expect(await passed()).toEqual([]);
  await page.keyboard.press('Enter');
  await page.keyboard.press('Control+ArrowRight');
  expect(await passed()).toEqual(['Control', 'ArrowRight']);
  await banana.locator('#robot').focus();
  await page.keyboard.type('7e');
  expect(await passed()).toEqual([]);
  // It does nothing there.
  await page.keyboard.press('Escape');
  expect(await passed()).toEqual(['Escape']);
  await banana.getByRole('button', { name: 'Reset' }).press('ArrowRight');
  expect(await passed()).toEqual(['ArrowRight']);
  await squeeze.scrollIntoViewIfNeeded();
  await ready(squeeze);
  await squeeze.locator('.handle.body').press('ArrowUp');
  expect(await passed()).toEqual([]);
});

for (const [name, parts] of /** @type {[string, string[]][]} */ ([
  ['arc-anatomy', ['.handle.body.start', '.handle.turn.next', '#omega', '#underway', 'input[type=radio] >> nth=0']],
  ['odometry-decomposer', ['.handle.body.from', '.handle.turn.to', '#phase', '#correlation', 'input[type=radio] >> nth=0']],
  ['dead-reckoning', ['#step', '#headingNoise', 'input[type=radio] >> nth=0']],
  ['alpha-calibrator', ['#leg', '#distance', '#inflation', 'input[type=radio] >> nth=0']],
])) {
  test(`an arrow that ${name} used goes no further; any other key does`, async ({ page }) => {
    await show(page, `<${name}></${name}>`);
    const widget = page.locator(name);
    await ready(widget);
    await unfold(widget);
    await page.evaluate(() => {
      const keys = /** @type {string[]} */ ([]);
      Object.assign(window, { keys });
      addEventListener('keydown', ({ key }) => keys.push(key));
    });
    const passed = () => page.evaluate(() => /** @type {string[]} */ (Reflect.get(window, 'keys')).splice(0));
    for (const part of parts) {
      await widget.locator(part).focus();
      for (const key of ['ArrowRight', 'ArrowLeft']) await page.keyboard.press(key);
      expect(await passed(), part).toEqual([]);
      for (const key of ['s', '/', 'Escape']) await page.keyboard.press(key);
      expect(await passed(), part).toEqual(['s', '/', 'Escape']);
    }
  });
}
