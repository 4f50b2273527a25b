import { expect } from '@playwright/test';
import { NAMES, assign, heard, ready, show } from './element-support.js';
import { STILL, centreOf, dragSlider, frames, test, unfold } from './support.js';

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

test('every other act of the reader is one input and one change', async ({ page }) => {
  await show(page, '<banana-machine></banana-machine><map-squeeze></map-squeeze>');
  const [banana, squeeze] = NAMES.map((name) => page.locator(name));
  await ready(banana);
  await unfold(banana);
  await heard(page);
  const acts = /** @type {[string, () => Promise<void>][]} */ ([
    ['preset', () => banana.getByRole('button', { name: 'Hard arc' }).click()],
    ['radio', () => banana.getByLabel('triangular').check()],
    ['model', () => banana.getByLabel('odometry').check()],
    ['toggle', () => banana.getByLabel('Isolate one').check()],
    ['overlay', () => banana.getByRole('checkbox', { name: 'linearized' }).check()],
    ['slider by key', () => banana.locator('#omega').press('ArrowRight')],
    ['handle by key', () => banana.locator('.handle').press('ArrowUp')],
    ['marker by key', () => banana.locator('.chart-marker').press('ArrowRight')],
    ['seed', () => banana.getByRole('button', { name: 'New seed' }).click()],
    ['reset', () => banana.getByRole('button', { name: 'Reset' }).click()],
    ['step', () => banana.getByRole('button', { name: 'Step' }).click()],
    ['place', () => squeeze.getByRole('button', { name: 'Facing a wall' }).click()],
    ['view', () => squeeze.getByLabel('whole map').check()],
    ['condition', () => squeeze.getByLabel('Condition on the map').uncheck()],
    ['robot by key', () => squeeze.locator('.handle.body').press('ArrowUp')],
    ['map', () => squeeze.getByRole('button', { name: 'Use this plan' }).click()],
  ]);
  for (const [act, go] of acts) {
    if (act === 'place') {
      await squeeze.scrollIntoViewIfNeeded();
      await ready(squeeze);
      await unfold(squeeze);
      await heard(page);
    }
    await go();
    if (act === 'map') await expect(squeeze.getByRole('button', { name: 'Back to the apartment' })).toBeVisible();
    expect(names(await heard(page, ['input', 'change', 'error'])), act).toEqual(['input', 'change']);
  }
});

test('a handle that is dragged tells of its steps and its end', async ({ page }) => {
  await show(page, '<banana-machine></banana-machine>');
  const widget = page.locator('banana-machine');
  await ready(widget);
  await heard(page);
  const { x, y } = await centreOf(widget.locator('.handle'));
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

test('what the page does itself is told by stats alone, also out of sight', async ({ page }) => {
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

test('what has not changed is not told again, whatever is drawn and asked', async ({ page }) => {
  await show(page, '<banana-machine></banana-machine>');
  const widget = page.locator('banana-machine');
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
  expect(await heard(page, ['stats'])).toEqual([]);
  expect(await assign(widget, 'v', 0.3)).toBe('');
  expect(await heard(page, ['stats'])).toHaveLength(1);
});

test('a key that was used goes no further; any other does', async ({ page }) => {
  await show(page, '<banana-machine></banana-machine><map-squeeze></map-squeeze>');
  const [banana, squeeze] = NAMES.map((name) => page.locator(name));
  await ready(banana);
  await unfold(banana);
  await page.evaluate(() => {
    const keys = /** @type {string[]} */ ([]);
    Object.assign(window, { keys });
    addEventListener('keydown', ({ key }) => keys.push(key));
  });
  const passed = () => page.evaluate(() => /** @type {string[]} */ (Reflect.get(window, 'keys')).splice(0));
  for (const part of ['.handle', '.chart-marker', '#omega', 'input[type=radio] >> nth=0']) {
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
