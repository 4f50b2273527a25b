import { readFileSync } from 'node:fs';
import { expect } from '@playwright/test';
import { SEEDS, anyOf } from './any-state.js';
import { ALL, KNOWN, NAMES, assign, heard, property, ready, show } from './element-support.js';
import { STILL, frames, test, unfold } from './support.js';

/** @typedef {import('./element-support.js').AnyElement} AnyElement */

test.use(STILL);

test.describe('attributes', () => {
  test('of every kind say how the figure opens', async ({ page }) => {
    await show(
      page,
      `<banana-machine seed="11" samples="300" alpha4="0.125" model="odometry" noise="triangular" preset="hard" v="-0.5"
         isolate="3" overlays="linearized command"></banana-machine>
       <map-squeeze preset="wall" x="3.25" noise="0.2" conditioned="false" sampler="sub-stepped" steps="4"
         clearance="0.2" samples="77" seed="5" view="close"></map-squeeze>`,
    );
    const [banana, squeeze] = NAMES.map((name) => page.locator(name));
    await ready(banana);
    await squeeze.scrollIntoViewIfNeeded();
    await ready(squeeze);
    const config = await banana.evaluate((element) => Reflect.get(element, 'machine').config);
    expect(config).toMatchObject({
      model: 'odometry',
      noise: 'triangular',
      command: { v: -0.5, omega: 1.2, dt: 1.4 },
      isolate: 3,
      samples: 300,
      seed: 11,
    });
    expect(config.alphas[3]).toBe(0.125);
    expect(await property(banana, 'overlays')).toEqual(['command', 'linearized']);
    expect(await squeeze.evaluate((element) => Reflect.get(element, 'machine').config)).toMatchObject({
      start: { x: 3.25, y: 2.6, theta: Math.PI / 2 },
      alphas: [0.2, 0.2, 0.2, 0.2, 0.05, 0.05],
      conditioned: false,
      sampler: 'sub-stepped',
      steps: 4,
      clearance: 0.2,
      samples: 77,
      seed: 5,
    });
    expect(await property(squeeze, 'view')).toBe('close');
    expect((await heard(page)).map(({ name, target }) => [name, target])).toEqual(NAMES.map((name) => ['load', name]));
  });

  test('stay as they are until something changes, and then say it', async ({ page }) => {
    await show(page, '<banana-machine preset="hard" seed="3"></banana-machine><map-squeeze></map-squeeze>');
    const [banana, squeeze] = NAMES.map((name) => page.locator(name));
    await ready(banana);
    await unfold(banana);
    const attributes = (/** @type {import('@playwright/test').Locator} */ widget) =>
      widget.evaluate((element) => Object.fromEntries([...element.attributes].map(({ name, value }) => [name, value])));
    expect(await attributes(banana)).toEqual({ preset: 'hard', seed: '3' });
    // The preset was for them too.
    const alphas = { alpha1: '0.05', alpha2: '0.05', alpha3: '0.05', alpha4: '0.09', alpha5: '0.01', alpha6: '0.01' };
    await banana.locator('#v').fill('0.5');
    await frames(page);
    expect(await attributes(banana)).toEqual({ v: '0.5', omega: '1.2', dt: '1.4', seed: '3', ...alphas });
    await banana.getByRole('button', { name: 'Pivot' }).click();
    await frames(page);
    expect(await attributes(banana)).toEqual({ preset: 'pivot', v: '0.06', omega: '1.5', dt: '1', seed: '3', ...alphas });
    await banana.getByLabel('Isolate one').check();
    await banana.getByRole('checkbox', { name: 'linearized' }).check();
    await frames(page);
    expect(await attributes(banana)).toMatchObject({ isolate: '4', overlays: 'command ellipse linearized exponential' });
    await banana.getByLabel('Isolate one').uncheck();
    await frames(page);
    expect(await attributes(banana)).not.toHaveProperty('isolate');

    await squeeze.scrollIntoViewIfNeeded();
    await ready(squeeze);
    await unfold(squeeze);
    await squeeze.getByRole('button', { name: 'Facing a wall' }).click();
    await squeeze.getByLabel('Condition on the map').uncheck();
    await frames(page);
    expect(await attributes(squeeze)).toEqual({ preset: 'wall', x: '3.3', conditioned: 'false' });
  });

  test('say by "true" what they say by nothing, and words with any space between them and around', async ({ page }) => {
    await show(page, '<banana-machine overlays=" linearized\n  command "></banana-machine><map-squeeze conditioned="true"></map-squeeze>');
    const [banana, squeeze] = NAMES.map((name) => page.locator(name));
    await ready(banana);
    expect(await property(banana, 'overlays')).toEqual(['command', 'linearized']);
    await banana.evaluate((element) => element.setAttribute('overlays', ''));
    expect(await property(banana, 'overlays')).toEqual([]);
    await squeeze.scrollIntoViewIfNeeded();
    await ready(squeeze);
    for (const [text, value] of /** @type {const} */ ([['false', false], ['true', true], ['false', false], ['', true]])) {
      await squeeze.evaluate((element, given) => element.setAttribute('conditioned', given), text);
      expect(await property(squeeze, 'conditioned')).toBe(value);
    }
    expect(await heard(page, ['error'])).toEqual([]);
  });

  test('that could not be read are written again', async ({ page }) => {
    await show(page, '<banana-machine v="1"></banana-machine>');
    const widget = page.locator('banana-machine');
    await ready(widget);
    const texts = await widget.evaluate((element) => {
      const figure = /** @type {any} */ (element);
      Object.defineProperty(element, 'v', { configurable: true, set: () => { throw new Error('not now'); } });
      let thrown;
      try {
        figure.reflection.hear('v', '2');
      } catch (error) {
        thrown = String(error);
      }
      delete figure.v;
      figure.v = 0.5;
      return [thrown, element.getAttribute('v')];
    });
    expect(texts).toEqual(['Error: not now', '0.5']);
  });

  test('and the page that they are copied to shows the same', async ({ page }) => {
    await show(page, '<banana-machine></banana-machine>');
    const widget = page.locator('banana-machine').first();
    await ready(widget);
    await widget.getByRole('button', { name: 'Hard arc' }).click();
    await widget.locator('#alpha2').fill('0.111');
    await frames(page);
    const code = await widget.evaluate((element) => /** @type {AnyElement} */ (element).embedCode());
    expect(code).toContain(`<script type="module" src="${new URL(page.url()).origin}/motion-widgets.js"></script>`);
    expect(code).toContain('<banana-machine preset="hard" alpha2="0.111"></banana-machine>');
    const same = await widget.evaluate(async (element, html) => {
      const copies = [html, element.outerHTML].map((text) => {
        const box = document.createElement('div');
        box.style.cssText = 'position: fixed; inset: 0';
        box.innerHTML = text;
        element.before(box);
        return /** @type {any} */ (box.querySelector('banana-machine'));
      });
      await Promise.all(copies.map((copy) => new Promise((resolve) => copy.addEventListener('load', resolve))));
      return [element, ...copies].map((each) => JSON.stringify(/** @type {AnyElement} */ (each).getState()));
    }, code);
    expect(same[1]).toBe(same[0]);
    expect(same[2]).toBe(same[0]);
  });

  /** What of a state is in no attribute, as it opens, or at a level that is in one. */
  const untold = { 'map-squeeze': { map: null, alphas: [0.2, 0.2, 0.2, 0.2, 0.05, 0.05] } };

  for (const name of ALL) {
    test(`of ${name} in the code to embed, in any order, open any state's settings`, async ({ page }) => {
      await show(page, `<${name}></${name}>`);
      const widget = page.locator(name).first();
      await ready(widget);
      for (const seed of SEEDS) {
        const state = { ...anyOf(seed)[name], ...Reflect.get(untold, name) };
        const [original, ...copies] = await widget.evaluate(async (element, given) => {
          /** @type {any} */ (element).setState(given);
          const code = /** @type {AnyElement} */ (element).embedCode().split('\n')[1];
          const template = document.createElement('div');
          template.innerHTML = code;
          const [told] = template.children;
          const again = document.createElement(element.localName);
          for (const { name, value } of [...told.attributes].reverse()) again.setAttribute(name, value);
          const boxes = [told, again].map((copy) => {
            const box = document.createElement('div');
            box.style.cssText = 'position: fixed; inset: 0';
            box.append(copy);
            return box;
          });
          const loaded = [told, again].map((copy) => new Promise((resolve) => copy.addEventListener('load', resolve)));
          element.before(...boxes);
          await Promise.all(loaded);
          // A state that takes long is entered in slices, a frame each.
          while (/** @type {any} */ (element).settings.next) await new Promise(requestAnimationFrame);
          const configs = [element, told, again].map((each) => /** @type {AnyElement} */ (each).machine.config);
          for (const box of boxes) box.remove();
          return configs;
        }, /** @type {any} */ (state));
        for (const copy of copies) expect(copy, `seed ${seed}`).toEqual(original);
      }
      expect(await heard(page, ['error'])).toEqual([]);
    });

    test(`of ${name} follow its controls, and lead back where they are taken away`, async ({ page }) => {
      await show(page, `<${name}></${name}>`);
      const widget = page.locator(name);
      await ready(widget);
      const { slider, values: [first, second] } = KNOWN[name];
      const opening = await property(widget, slider);
      await widget.locator(`#${slider}`).fill(String(first));
      await expect(widget).toHaveAttribute(slider, String(first));
      expect(await property(widget, slider)).toBe(first);
      await widget.evaluate((element, [key, value]) => element.setAttribute(key, value), [slider, String(second)]);
      expect(await property(widget, slider)).toBe(second);
      await expect(widget.locator(`#${slider}`)).toHaveValue(String(second));
      const [, message] = await widget.evaluate((element, key) => {
        const told = /** @type {string[]} */ ([]);
        element.addEventListener('error', (event) => told.push(/** @type {ErrorEvent} */ (event).message), { once: true });
        element.setAttribute(key, 'fast');
        return [element.getAttribute(key), ...told];
      }, slider);
      expect(message).toMatch(/ is "fast"; allowed is a (whole )?number/);
      expect(await property(widget, slider)).toBe(second);
      await widget.evaluate((element, key) => element.removeAttribute(key), slider);
      expect(await property(widget, slider)).toBe(opening);
    });
  }

  test('that are refused are reported in the words of the core, and the last good value stays', async ({ page }) => {
    await show(page, '<banana-machine v="fast" omega="0.7" model="walking" samples="0" overlays="ellipse stars"></banana-machine>');
    const widget = page.locator('banana-machine');
    await ready(widget);
    const errors = (await heard(page, ['error'])).map(({ message }) => message);
    expect(errors).toEqual([
      'model is "walking"; allowed is "velocity" or "odometry"',
      'command.v is "fast"; allowed is a number',
      'samples is 0; allowed is a whole number from 1 to 10000000',
      'overlays[1] is "stars"; allowed is "command" or "ellipse" or "linearized" or "additive" or "exponential"',
    ]);
    const values = async () => Promise.all(['v', 'omega', 'model', 'samples'].map((name) => property(widget, name)));
    expect(await values()).toEqual([1, 0.7, 'velocity', 50000]);
    await widget.evaluate((element) => element.setAttribute('dt', '-1'));
    expect((await heard(page, ['error'])).map(({ message }) => message)).toEqual([
      'command.dt is -1; allowed is a number from 0.000001 to 1000000',
    ]);
    expect(await property(widget, 'dt')).toBe(1);
    // Nothing is no number, nor a zero.
    await widget.evaluate((element) => element.setAttribute('omega', ' '));
    expect((await heard(page, ['error'])).map(({ message }) => message)).toEqual(['command.omega is " "; allowed is a number']);
    expect(await property(widget, 'omega')).toBe(0.7);
    await widget.evaluate((element) => element.setAttribute('dt', '2'));
    expect(await property(widget, 'dt')).toBe(2);
    await widget.getByRole('button', { name: 'Pivot' }).click();
    expect(await values()).toEqual([0.06, 1.5, 'velocity', 50000]);
  });

  test('that are removed leave what the figure opens with', async ({ page }) => {
    await show(page, '<banana-machine v="2" alpha1="0.2" overlays="ellipse" isolate="2"></banana-machine>');
    const widget = page.locator('banana-machine');
    await ready(widget);
    await widget.evaluate((element) => {
      for (const name of ['v', 'alpha1', 'overlays', 'isolate']) element.removeAttribute(name);
    });
    const values = await Promise.all(['v', 'alpha1', 'overlays', 'isolate'].map((name) => property(widget, name)));
    expect(values).toEqual([1, 0.05, ['command', 'ellipse', 'exponential'], null]);
    // Also of what others depend on.
    await widget.evaluate((element) => {
      element.setAttribute('model', 'odometry');
      element.removeAttribute('model');
    });
    expect(await property(widget, 'model')).toBe('velocity');
  });
});

test('what doc/embedding.md has an element show, it takes', async ({ page }) => {
  const document = readFileSync(new URL('../../doc/embedding.md', import.meta.url), 'utf8');
  const examples = [...document.matchAll(/^\| [^|]* \| `<([a-z-]+)( [^`]*)>` \|$/gm)].map(([, name, attributes]) => ({ name, attributes }));
  expect(new Set(examples.map(({ name }) => name)).size).toBe(ALL.length);
  for (const { name, attributes } of examples) {
    await show(page, `<${name}${attributes}></${name}>`);
    const widget = page.locator(name);
    await ready(widget);
    const unknown = await widget.evaluate((element) => {
      const { observedAttributes } = /** @type {any} */ (element.constructor);
      return [...element.attributes].map((attribute) => attribute.name).filter((attribute) => !observedAttributes.includes(attribute));
    });
    expect(unknown, `${name}${attributes}`).toEqual([]);
    expect(await heard(page, ['error'])).toEqual([]);
  }
});

test.describe('properties', () => {
  test('that were set before the element was one are taken up', async ({ page }) => {
    await show(page, '<banana-machine v="2"></banana-machine>', { script: '' });
    expect(await page.evaluate(() => customElements.get('banana-machine') === undefined)).toBe(true);
    await page.evaluate(async () => {
      const element = Object.assign(/** @type {Element} */ (document.querySelector('banana-machine')), {
        v: 3, omega: 0.25, alphas: [0.1, 0.1, 0.1, 0.1, 0, 0], overlays: ['ellipse'], theme: 'dark', marked: 4,
      });
      // What is the page's own may not let itself be taken up.
      Object.defineProperty(element, 'fixed', { enumerable: true, value: 5 });
      await import(/** @type {any} */ ('/motion-widgets.js'));
    });
    const widget = page.locator('banana-machine');
    await ready(widget);
    const values = await widget.evaluate((element) => {
      const { v, omega, alphas, overlays, theme, marked } = /** @type {any} */ (element);
      return { v, omega, alphas, overlays, theme, marked, own: Object.hasOwn(element, 'v') };
    });
    expect(values).toEqual({ v: 3, omega: 0.25, alphas: [0.1, 0.1, 0.1, 0.1, 0, 0], overlays: ['ellipse'], theme: 'dark', marked: 4, own: false });
    expect(await heard(page, ['error'])).toEqual([]);
  });

  test('that others depend on come first, in whatever order they were given; a state comes when it was given', async ({ page }) => {
    await show(page, '', { script: '' });
    const told = await page.evaluate(async () => {
      const map = { bounds: [0, 0, 6, 4], walls: [[3, 0, 3, 1.5]] };
      const given = /** @type {[string, Record<string, unknown>, string[]][]} */ ([
        ['dead-reckoning', { step: 30, steps: 40 }, ['step', 'steps']],
        ['banana-machine', { omega: 0.7, preset: 'hard', alpha2: 0.3, alphas: [0.1, 0.1, 0.1, 0.1], model: 'odometry' }, ['omega', 'v', 'dt', 'alphas']],
        ['banana-machine', { marked: 60_000, samples: 70_000 }, ['marked', 'samples']],
        ['map-squeeze', { marked: 3, start: { x: 3, y: 1, theta: 0 }, map }, ['marked', 'start']],
        ['map-squeeze', { preset: 'wall', map }, ['preset']],
      ]);
      const figures = given.flatMap(([tag, values]) => [Object.entries(values), Object.entries(values).reverse()].map((entries) =>
        Object.assign(document.createElement(tag), Object.fromEntries(entries))));
      await import(/** @type {any} */ ('/motion-widgets.js'));
      const late = /** @type {any} */ (document.createElement('dead-reckoning'));
      late.setState({ widget: 'dead-reckoning', version: 1, steps: 10, step: 4 });
      late.step = 7;
      late.setState({ widget: 'dead-reckoning', version: 1, steps: 5 });
      const later = /** @type {any} */ (document.createElement('dead-reckoning'));
      later.setState({ widget: 'dead-reckoning', version: 1, steps: 10 });
      later.preset = 'fine';
      figures.push(late, later);
      const loaded = figures.map((figure) => new Promise((resolve) => figure.addEventListener('load', resolve)));
      document.body.append(...figures.map((figure) => {
        const box = document.createElement('div');
        box.style.cssText = 'position: fixed; inset: 0';
        box.append(figure);
        return box;
      }));
      await Promise.all(loaded);
      const names = given.flatMap(([, , asked]) => [asked, asked]);
      return [...figures].map((figure, i) => (names[i] ?? ['step', 'steps']).map((name) => Reflect.get(figure, name)));
    });
    const [hard, alphas] = [[0.7, 1, 1.4], [0.1, 0.3, 0.1, 0.1]];
    expect(told).toEqual([
      ...Array(2).fill([30, 40]),
      ...Array(2).fill([...hard, alphas]),
      ...Array(2).fill([60_000, 70_000]),
      ...Array(2).fill([3, { x: 3, y: 1, theta: 0 }]),
      ...Array(2).fill([null]),
      [5, 5],
      [2, 200],
    ]);
    expect(await heard(page, ['error'])).toEqual([]);
  });

  for (const [after, leg] of /** @type {const} */ ([[false, null], [true, 3]])) test(`come before a log that is given with them${after ? ', and a state that is given then comes later' : ''}`, async ({ page }) => {
    await show(page, '<alpha-calibrator></alpha-calibrator>', { script: '' });
    const told = await page.evaluate(async (after) => {
      await import(/** @type {any} */ ('/motion-widgets.js'));
      const figure = /** @type {any} */ (document.querySelector('alpha-calibrator'));
      const read = /** @type {number[]} */ ([]);
      const t = Float64Array.from({ length: 2000 }, (_, i) => i / 20);
      const poses = { t, x: t.map((time) => time / 2), y: t.map(() => 0), theta: t.map(Math.sin) };
      const log = {
        reference: poses,
        get odometry() {
          read.push(figure.machine.config.distance);
          return poses;
        },
      };
      const loaded = new Promise((resolve) => figure.addEventListener('load', resolve));
      const look = (/** @type {number} */ leg) => figure.setState({ widget: 'alpha-calibrator', version: 1, leg });
      look(2);
      figure.log = log;
      figure.distance = 0.4;
      if (after) look(3);
      await loaded;
      while (figure.settings.next) await new Promise(requestAnimationFrame);
      return [read.splice(0)[0], figure.log === log, figure.getState().leg];
    }, after);
    expect(told).toEqual([0.4, true, leg]);
    expect(await heard(page, ['error'])).toEqual([]);
  });

  for (const name of ALL) {
    test(`of ${name} that were set before the element was one, in any order, are its settings, as are those that are set later`, async ({ page }) => {
      await show(page, '', { script: '' });
      for (const seed of SEEDS.slice(0, 4)) {
        const state = anyOf(seed)[name];
        const [opened, set] = await page.evaluate(async (given) => {
          const { widget, alphas, map, ...rest } = /** @type {any} */ (given);
          const own = ['version', 'marked', 'shown', 'playing', 'isolateChoice', 'line', 'underway', 'leg', 'driver'];
          const others = Object.entries(rest).filter(([key]) => !own.includes(key));
          const settings = { ...Object.fromEntries(others), ...(alphas && { alphas: alphas[rest.model] ?? alphas }), ...(typeof map === 'string' && { map }) };
          const [early, other] = [Object.entries(settings), Object.entries(settings).reverse()].map((entries) =>
            Object.assign(document.createElement(widget), Object.fromEntries(entries)));
          await import(/** @type {any} */ ('/motion-widgets.js'));
          const late = document.createElement(widget);
          const figures = [early, other, late];
          const boxes = figures.map((figure) => {
            const box = document.createElement('div');
            box.style.cssText = 'position: fixed; inset: 0';
            box.append(figure);
            return box;
          });
          const loaded = figures.map((figure) => new Promise((resolve) => figure.addEventListener('load', resolve)));
          document.body.append(...boxes);
          await Promise.all(loaded);
          Object.assign(late, settings);
          const values = figures.map((figure) => Object.fromEntries(Object.keys(settings).map((key) => [key, figure[key]])));
          for (const box of boxes) box.remove();
          return [values, settings];
        }, /** @type {any} */ (state));
        for (const each of opened) expect(each, `seed ${seed}`).toEqual(set);
      }
      expect(await heard(page, ['error'])).toEqual([]);
    });

    test(`of ${name} that are null or undefined are as the figure opens`, async ({ page }) => {
      await show(page, `<${name}></${name}>`);
      const widget = page.locator(name);
      await ready(widget);
      const [opening, ...again] = await widget.evaluate((element, state) => {
        const figure = /** @type {any} */ (element);
        const names = Object.keys(state).filter((key) => key in figure && !['playing', 'map'].includes(key));
        const values = () => Object.fromEntries(names.map((key) => [key, figure[key]]));
        const told = [values()];
        for (const none of [null, undefined]) {
          figure.setState(state);
          for (const key of names) figure[key] = none;
          told.push(values());
        }
        return told;
      }, /** @type {any} */ (anyOf(1)[name]));
      for (const each of again) expect(each).toEqual(opening);
      expect(await heard(page, ['error'])).toEqual([]);
    });

    test(`of ${name} that are given once more do nothing`, async ({ page }) => {
      await show(page, `<${name}></${name}>`);
      const widget = page.locator(name);
      await ready(widget);
      await widget.evaluate((element, state) => /** @type {any} */ (element).setState(state), /** @type {any} */ (anyOf(2)[name]));
      await heard(page, ['stats']);
      const count = await widget.evaluate((element, keys) => {
        const figure = /** @type {any} */ (element);
        const names = keys.filter((key) => key in figure && key !== 'playing');
        for (const key of names) figure[key] = structuredClone(figure[key]);
        for (const { name, value } of [...element.attributes]) element.setAttribute(name, value);
        return names.length;
      }, Object.keys(anyOf(2)[name]));
      expect(count).toBeGreaterThan(6);
      expect(await heard(page, ['stats', 'error', 'input', 'change'])).toEqual([]);
    });
  }

  test('of dead-reckoning have a step that is on the path, whatever becomes of that', async ({ page }) => {
    await show(page, '<dead-reckoning steps="1"></dead-reckoning>');
    const widget = page.locator('dead-reckoning');
    await ready(widget);
    const steps = () => Promise.all(['steps', 'step'].map((name) => property(widget, name)));
    expect(await steps()).toEqual([1, 1]);
    expect(await assign(widget, 'step', null)).toBe('');
    expect(await steps()).toEqual([1, 1]);
    expect(await widget.evaluate((element) => /** @type {AnyElement} */ (element).embedCode())).toContain('<dead-reckoning steps="1"></dead-reckoning>');
    expect(await assign(widget, 'steps', null)).toBe('');
    expect(await assign(widget, 'step', null)).toBe('');
    expect(await steps()).toEqual([20, 2]);
  });

  test('that the present model has none of are refused with the name of the last', async ({ page }) => {
    await show(page, '<banana-machine model="odometry"></banana-machine>');
    const widget = page.locator('banana-machine');
    await ready(widget);
    expect(await assign(widget, 'alpha5', 0.1)).toBe('RangeError: alpha5 is 0.1; allowed is none, as the last one at present is alpha4');
    expect(await assign(widget, 'alpha4', 0.1)).toBe('');
  });

  test('of the other model are taken right after that is, whatever was set before in the same breath', async ({ page }) => {
    await show(page, '<banana-machine samples="100"></banana-machine>');
    const widget = page.locator('banana-machine');
    await ready(widget);
    await widget.evaluate((element) => Object.assign(element, { alphas: [1, 2, 3, 4, 5, 6], model: 'odometry', alpha4: 0.25, alpha5: 1 }));
    expect(await property(widget, 'alphas')).toEqual([0.05, 0.05, 0.05, 0.25]);
    expect((await heard(page, ['error'])).map(({ message }) => message)).toEqual(['alpha5 is 1; allowed is none, as the last one at present is alpha4']);
  });

  test('that are no settings leave nothing on the element', async ({ page }) => {
    await show(page, '<banana-machine theme="dark"></banana-machine>');
    const widget = page.locator('banana-machine');
    await ready(widget);
    const keys = await widget.evaluate((element) => {
      const before = Object.keys(element);
      for (const [name, text] of [['theme', 'light'], ['share', ''], ['heading-level', '2']]) element.setAttribute(name, text);
      return [before.includes('undefined'), Object.keys(element).filter((key) => !before.includes(key))];
    });
    expect(keys).toEqual([false, []]);
  });

  test('mark a robot that is still to come', async ({ page }) => {
    await page.emulateMedia({ reducedMotion: 'no-preference' });
    await show(page, '<banana-machine samples="2000"></banana-machine>', { script: '' });
    const widget = page.locator('banana-machine');
    const wanted = await widget.evaluate(async (element) => {
      Object.assign(element, { marked: 1999 });
      const loaded = new Promise((resolve) => element.addEventListener('load', resolve, { once: true }));
      await import(/** @type {any} */ ('/motion-widgets.js'));
      await loaded;
      const { playing, marked, machine, getState } = /** @type {any} */ (element);
      return { playing, marked, there: machine.shown > marked, kept: getState.call(element).marked };
    });
    expect(wanted).toEqual({ playing: true, marked: 1999, there: false, kept: 1999 });
    await expect.poll(() => property(widget, 'playing'), { timeout: 20_000 }).toBe(false);
    expect(await property(widget, 'marked')).toBe(1999);
    expect(await assign(widget, 'marked', 2000)).toBe('RangeError: marked is 2000; allowed is a whole number from 0 to 1999');
    // Where nothing grows, what is not shown is not marked.
    await widget.getByRole('button', { name: 'Reset' }).click();
    await frames(page);
    expect(await property(widget, 'marked')).toBe(null);
    // The next to come is not there either.
    const drawn = await widget.evaluate((element) => {
      const { setState, toSVG } = /** @type {any} */ (element);
      setState.call(element, { widget: element.localName, version: 1, shown: 10, playing: true, marked: 10 });
      return toSVG.call(element);
    });
    expect(drawn).toContain('<svg');
    expect((await heard(page, ['error'])).map(({ message }) => message)).toEqual(['marked is 2000; allowed is a whole number from 0 to 1999']);
  });

  test('and a part of a state, before the figure is there, leave all else as it opens', async ({ page }) => {
    await show(page, '<banana-machine></banana-machine>', { script: '' });
    const states = await page.evaluate(async () => {
      await import(/** @type {any} */ ('/motion-widgets.js'));
      const element = /** @type {any} */ (document.querySelector('banana-machine'));
      element.marked = 7;
      element.setState({ widget: 'banana-machine', version: 1, samples: 3000 });
      await new Promise((resolve) => element.addEventListener('load', resolve, { once: true }));
      const { samples, shown, marked } = element.getState();
      return { samples, shown, marked };
    });
    expect(states).toEqual({ samples: 3000, shown: 3000, marked: 7 });
    expect(await heard(page, ['error'])).toEqual([]);
  });

  test('take effect at once and reflect; those out of range are reported and change nothing', async ({ page }) => {
    await show(page, '<banana-machine></banana-machine><map-squeeze></map-squeeze>');
    const [banana, squeeze] = NAMES.map((name) => page.locator(name));
    await ready(banana);
    expect(await assign(banana, 'omega', 1.1)).toBe('');
    expect(await banana.getAttribute('omega')).toBe('1.1');
    const { stats } = await banana.evaluate((element) => ({ stats: /** @type {AnyElement} */ (element).stats }));
    expect(stats?.n).toBe(await property(banana, 'samples'));
    await squeeze.scrollIntoViewIfNeeded();
    await ready(squeeze);
    for (const [widget, name, value, message] of /** @type {const} */ ([
      [banana, 'v', 'fast', 'TypeError: command.v is "fast"; allowed is a number'],
      [banana, 'omega', NaN, 'RangeError: command.omega is NaN; allowed is a number from -1000000 to 1000000'],
      [banana, 'v', 1e7, 'RangeError: command.v is 10000000; allowed is a number from -1000000 to 1000000'],
      [banana, 'preset', 'loop', 'RangeError: preset is "loop"; allowed is "straight" or "gentle" or "hard" or "pivot" or "banana" or "worked"'],
      [banana, 'theme', 'sepia', 'RangeError: theme is "sepia"; allowed is "auto" or "light" or "dark"'],
      [banana, 'marked', 50000, 'RangeError: marked is 50000; allowed is a whole number from 0 to 49999'],
      // As those begin that it has.
      [banana, 'alphas', [0.05, 0.05], 'RangeError: alphas has length 2; allowed is an array of 6 numbers'],
      [banana, 'alphas', [1, 2], 'RangeError: alphas has length 2; allowed is an array of 6 numbers'],
      [banana, 'alpha4', -1, 'RangeError: alpha4 is -1; allowed is a number from 0 to 1000000'],
      [squeeze, 'noise', -1, 'RangeError: noise is -1; allowed is a number from 0 to 1000000'],
      [squeeze, 'conditioned', 'maybe', 'TypeError: conditioned is "maybe"; allowed is true or false'],
      [squeeze, 'conditioned', 'toString', 'TypeError: conditioned is "toString"; allowed is true or false'],
      [banana, 'model', 'constructor', 'RangeError: model is "constructor"; allowed is "velocity" or "odometry"'],
      [squeeze, 'view', 'near', 'RangeError: view is "near"; allowed is "close" or "whole"'],
      [squeeze, 'map', { bounds: [0, 0, 1], walls: [] }, 'RangeError: map.bounds has length 3; allowed is an array of 4 numbers'],
    ])) {
      const before = await widget.evaluate((element) => JSON.stringify(/** @type {AnyElement} */ (element).getState()));
      expect(await assign(widget, name, value)).toBe(message);
      expect(await widget.evaluate((element) => JSON.stringify(/** @type {AnyElement} */ (element).getState()))).toBe(before);
    }
    expect(await assign(banana, 'model', 'odometry')).toBe('');
    expect(await property(banana, 'alpha5')).toBe(null);
    expect(await assign(banana, 'alpha5', 0.1)).toContain('alpha5 is 0.1; allowed is none');
  });

  test('take what the attribute takes, before the element is one and after', async ({ page }) => {
    const values = {
      v: '2', omega: '0.8', samples: '20000', model: 'odometry', alpha4: '0.125', isolate: '3', overlays: 'ellipse command', theme: 'dark',
      share: '', 'heading-level': '3',
    };
    const asAttributes = Object.entries(values).map(([name, text]) => `${name}="${text}"`).join(' ');
    await show(page, `<banana-machine ${asAttributes}></banana-machine><banana-machine></banana-machine>`, { script: '' });
    const states = await page.evaluate(async (given) => {
      const { 'heading-level': headingLevel, ...rest } = given;
      const [told, early] = /** @type {NodeListOf<any>} */ (document.querySelectorAll('banana-machine'));
      Object.assign(early, { ...rest, headingLevel });
      await import(/** @type {any} */ ('/motion-widgets.js'));
      const late = /** @type {any} */ (document.createElement('banana-machine'));
      early.after(late);
      for (const each of [told, early, late]) {
        each.scrollIntoView();
        if (!each.machine) await new Promise((resolve) => each.addEventListener('load', resolve, { once: true }));
      }
      Object.assign(late, { ...rest, headingLevel });
      return [told, early, late].map((each) => {
        const { theme, share, headingLevel: level } = each;
        // Not those that have only begun to grow.
        return { ...each.getState(), shown: 0, playing: true, theme, share, headingLevel: level };
      });
    }, values);
    expect(states[0]).toMatchObject({ command: { v: 2, omega: 0.8 }, samples: 20000, model: 'odometry', isolate: 3, overlays: ['command', 'ellipse'], theme: 'dark', share: true, headingLevel: '3' });
    expect(states[1]).toEqual(states[0]);
    expect(states[2]).toEqual(states[0]);
    expect(await heard(page, ['error'])).toEqual([]);
  });

  test('that are null or undefined are as the figure opens', async ({ page }) => {
    await show(page, '<banana-machine v="2" alpha1="0.2" overlays="ellipse" isolate="2" theme="dark"></banana-machine>');
    const widget = page.locator('banana-machine');
    await ready(widget);
    const opening = { v: 1, alpha1: 0.05, overlays: ['command', 'ellipse', 'exponential'], isolate: null, marked: null, theme: 'auto', alphas: [0.05, 0.05, 0.05, 0.09, 0.01, 0.01] };
    for (const none of [null, undefined]) {
      await widget.evaluate((element) => Object.assign(element, { v: 3, alphas: Array(6).fill(0.1), overlays: ['ellipse'], isolate: 2, marked: 3, theme: 'light' }));
      const values = await widget.evaluate((element, [names, value]) => {
        for (const name of names) Reflect.set(element, name, value);
        return Object.fromEntries(names.map((name) => [name, Reflect.get(element, name)]));
      }, /** @type {[string[], null | undefined]} */ ([Object.keys(opening), none]));
      expect(values).toEqual(opening);
    }
    expect(await heard(page, ['error'])).toEqual([]);
  });

  test('that are given once more do nothing: no sample is driven, and what the reader holds stays in their hand', async ({ page }) => {
    await show(page, '<banana-machine></banana-machine><map-squeeze></map-squeeze>');
    const [banana, squeeze] = NAMES.map((name) => page.locator(name));
    await squeeze.scrollIntoViewIfNeeded();
    await ready(squeeze);
    const map = { bounds: [0, 0, 8, 6], walls: [[2, 0, 2, 6]], name: 'mine' };
    await squeeze.evaluate((element, given) => Object.assign(element, { map: given }), map);
    await banana.scrollIntoViewIfNeeded();
    await ready(banana);
    await heard(page);
    for (const [widget, values] of /** @type {const} */ ([
      [banana, { alphas: [0.05, 0.05, 0.05, 0.09, 0.01, 0.01], command: { dt: 1, v: 1 }, omega: '0.5', overlays: ['command', 'ellipse', 'exponential'], isolate: undefined, samples: 50000, marked: null }],
      [squeeze, { map, conditioned: '', view: 'close', start: { x: 4 } }],
    ])) {
      await widget.evaluate((element, given) => {
        if ('start' in given) given.start.x = /** @type {any} */ (element).start.x;
        Object.assign(element, given);
      }, /** @type {any} */ (values));
      expect(await heard(page, ['stats', 'error'])).toEqual([]);
    }
    // As a framework does that sets every list anew whenever there are statistics.
    await banana.evaluate((element) => {
      const { alphas } = /** @type {any} */ (element);
      element.addEventListener('stats', () => Object.assign(element, { alphas: [...alphas] }));
    });
    await banana.locator('#v').fill('0.4');
    await frames(page);
    expect(await property(banana, 'v')).toBe(0.4);
    expect((await heard(page, ['stats'])).length).toBe(1);
    // An attribute says where a gesture began until it ends.
    const held = await banana.evaluate((element) => {
      const slider = /** @type {HTMLInputElement} */ (element.shadowRoot?.querySelector('#v'));
      slider.value = '0.7';
      slider.dispatchEvent(new Event('input'));
      element.setAttribute('v', element.getAttribute('v') ?? '');
      return [element.getAttribute('v'), Reflect.get(element, 'v')];
    });
    expect(held).toEqual(['0.4', 0.7]);
    // Nor does it hurry what the reader does, which takes effect once a frame.
    const begun = await banana.evaluate(async (element) => {
      const figure = /** @type {any} */ (element);
      const { machine } = figure;
      let begun = 0;
      machine.begin = (/** @type {object} */ values) => {
        begun++;
        Object.getPrototypeOf(machine).begin.call(machine, values);
      };
      element.addEventListener('input', (event) => {
        Object.assign(element, { samples: 50000 });
        // What these tests note of an event asks the machine.
        event.stopPropagation();
      });
      for (const value of ['0.5', '0.6', '0.7']) {
        const heard = new Promise((resolve) => element.addEventListener('input', resolve, { once: true }));
        const slider = figure.renderRoot.querySelector('#v');
        slider.value = value;
        slider.dispatchEvent(new Event('input', { bubbles: true, composed: true }));
        await heard;
      }
      const meanwhile = begun;
      while (figure.v !== 0.7) await new Promise(requestAnimationFrame);
      return [meanwhile, begun];
    });
    expect(begun).toEqual([0, 1]);
  });

  test('that are refused are told by an error event that stays on the element, and by the console where nobody minds', async ({ page }) => {
    await show(page, '<banana-machine></banana-machine>');
    const widget = page.locator('banana-machine');
    await ready(widget);
    const told = await widget.evaluate((element) => {
      const at = /** @type {string[]} */ ([]);
      for (const target of [window, document, document.body]) target.addEventListener('error', () => at.push('above'));
      element.addEventListener('error', (event) => at.push(/** @type {ErrorEvent} */ (event).message));
      Object.assign(element, { omega: NaN });
      return at;
    });
    expect(told).toEqual(['command.omega is NaN; allowed is a number from -1000000 to 1000000']);
    // One where nobody listens.
    const other = await page.context().newPage();
    await other.goto('/embed.html?widget=banana-machine');
    const unheard = other.waitForEvent('console', (message) => message.type() === 'warning');
    await other.locator('banana-machine').evaluate((element) => Object.assign(element, { theme: 'sepia' }));
    const message = await unheard;
    expect(message.text()).toContain('theme is "sepia"; allowed is "auto" or "light" or "dark"');
    expect(await message.args()[1].evaluate((element) => element.localName)).toBe('banana-machine');
    await other.close();
  });
});
