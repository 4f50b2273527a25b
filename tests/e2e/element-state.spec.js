import { expect } from '@playwright/test';
import { SEEDS, anyOf } from './any-state.js';
import { ALL, CLOUDS, heard, ready, show, stateOf } from './element-support.js';
import { STILL, frames, test, unfold } from './support.js';

/** @typedef {import('./element-support.js').AnyElement} AnyElement */

test.use(STILL);

for (const name of ALL) {
  test(`any state of ${name} goes in and comes out, and a second element is the same then`, async ({ page }) => {
    await show(page, `<${name} id="one"></${name}><div style="position: fixed; inset: 0 0 auto"><${name} id="two"></${name}></div>`);
    const [one, two] = ['#one', '#two'].map((id) => page.locator(id));
    await ready(one);
    await ready(two);
    for (const seed of SEEDS) {
      const state = anyOf(seed)[name];
      const [first, second] = await page.evaluate(async (given) => {
        const elements = ['one', 'two'].map((id) => /** @type {AnyElement} */ (/** @type {unknown} */ (document.getElementById(id))));
        elements[0].setState(given);
        elements[1].setState(JSON.parse(JSON.stringify(elements[0].getState())));
        return elements.map((element) => ({ state: element.getState(), stats: element.stats, poses: [...(element.poses ?? [])] }));
      }, /** @type {any} */ (state));
      expect(first.state, `seed ${seed}`).toEqual(state);
      expect(second).toEqual(first);
      expect(first.poses.length > 0, 'whether it has samples').toBe('shown' in state);
    }
    await frames(page);
    expect(await heard(page, ['error', 'input', 'change'])).toEqual([]);
  });
}

test('a state that is refused names the field, and changes nothing', async ({ page }) => {
  await show(page, ALL.map((name) => `<${name}></${name}>`).join(''));
  const cases = /** @type {[string, object, string][]} */ ([
    ['banana-machine', { version: 2 }, 'RangeError: state.version is 2; allowed is 1'],
    ['banana-machine', { widget: 'map-squeeze' }, 'RangeError: state.widget is "map-squeeze"; allowed is "banana-machine"'],
    ['banana-machine', { speed: 1 }, 'TypeError: state.speed is an unknown key; allowed are'],
    // Of another widget, or of another day, it has other keys too, which is not what is wrong with it.
    ['banana-machine', { widget: 'map-squeeze', start: {} }, 'RangeError: state.widget is "map-squeeze"; allowed is "banana-machine"'],
    ['banana-machine', { version: 2, speed: 1 }, 'RangeError: state.version is 2; allowed is 1'],
    ['banana-machine', { version: {} }, 'RangeError: state.version is an object; allowed is 1'],
    ['banana-machine', { version: null }, 'RangeError: state.version is null; allowed is 1'],
    ['banana-machine', { version: [1] }, 'RangeError: state.version is an array; allowed is 1'],
    ['banana-machine', { widget: 'w'.repeat(40) }, `RangeError: state.widget is "${'w'.repeat(40)}"; allowed`],
    ['banana-machine', { widget: 'w'.repeat(41) }, `RangeError: state.widget is "${'w'.repeat(40)}…"; allowed`],
    ['banana-machine', { overlays: 'ellipse' }, 'TypeError: state.overlays is "ellipse"; allowed is an array of command, ellipse, linearized, additive, exponential'],
    ['banana-machine', { samples: 0 }, 'RangeError: samples is 0; allowed is a whole number from 1 to 10000000'],
    ['banana-machine', { command: { v: 'fast', omega: 0, dt: 1 } }, 'TypeError: command.v is "fast"; allowed is a number'],
    ['banana-machine', { alphas: { walking: [] } }, 'TypeError: state.alphas.walking is an unknown key; allowed are velocity, odometry'],
    ['banana-machine', { alphas: { odometry: [1] } }, 'RangeError: alphas has length 1; allowed is an array of 4 numbers'],
    ['banana-machine', { shown: 60000 }, 'RangeError: state.shown is 60000; allowed is a whole number from 0 to 50000'],
    ['banana-machine', { shown: -1 }, 'RangeError: state.shown is -1; allowed is a whole number from 0 to 50000'],
    ['banana-machine', { shown: '10' }, 'TypeError: state.shown is "10"; allowed is a whole number from 0 to 50000'],
    ['map-squeeze', { shown: -1 }, 'RangeError: state.shown is -1; allowed is a whole number from 0 to 600'],
    ['map-squeeze', { shown: 0.5 }, 'RangeError: state.shown is 0.5; allowed is a whole number from 0 to 600'],
    ['banana-machine', { ['🤖'.repeat(1000)]: 1 }, `TypeError: state.${'🤖'.repeat(40)}… is an unknown key; allowed are`],
    ['map-squeeze', { view: '🤖'.repeat(1000) }, `RangeError: state.view is "${'🤖'.repeat(40)}…"; allowed is "close" or "whole"`],
    ['banana-machine', { shown: 10, marked: 10 }, 'RangeError: state.marked is 10; allowed is a whole number from 0 to 9'],
    ['banana-machine', { overlays: ['stars'] }, 'RangeError: state.overlays[0] is "stars"; allowed is'],
    ['banana-machine', { playing: 'yes' }, 'TypeError: state.playing is "yes"; allowed is true or false'],
    ['banana-machine', { isolateChoice: 7 }, 'RangeError: state.isolateChoice is 7; allowed is a whole number from 1 to 6'],
    ['map-squeeze', { sampler: 'guess' }, 'RangeError: sampler is "guess"; allowed is'],
    ['map-squeeze', { view: 1 }, 'TypeError: state.view is 1; allowed is "close" or "whole"'],
    ['map-squeeze', { map: 'apartment' }, 'TypeError: map is "apartment"; allowed is a plan, an object of name, bounds, walls, or a grid, one of name, columns'],
    ['map-squeeze', { map: [] }, 'TypeError: map is an array; allowed is a plan, an object of name, bounds, walls, or a grid'],
    ['map-squeeze', { map: { bounds: [0, 0, 1, 1] } }, 'TypeError: map.walls is undefined; allowed is'],
    ['map-squeeze', { map: { bounds: [0, 0, 1, 1], walls: [3] } }, 'TypeError: map.walls[0] is 3; allowed is'],
    ['map-squeeze', { map: { bounds: [0, 0, 1, 1], walls: [], floor: 1 } }, 'TypeError: map.floor is an unknown key; allowed are name, bounds, walls'],
    ['map-squeeze', { map: { columns: 2, rows: 2, resolution: 1, origin: [0, 0, 0] } }, 'TypeError: map.occupied is undefined; allowed is base64 of 1 bytes'],
    ['map-squeeze', { map: { columns: 2, rows: 2, resolution: 1, origin: [0, 0, 0], walls: [] } }, 'TypeError: map.walls is an unknown key; allowed are name, columns'],
    ['map-squeeze', { map: { columns: 2, rows: 2, resolution: 0, origin: [0, 0, 0], occupied: 'gA==' } }, 'RangeError: map.resolution is 0; allowed is'],
    ['map-squeeze', { map: { columns: 2, rows: 2, resolution: 1, origin: [0], occupied: 'gA==' } }, 'RangeError: map.origin'],
    ['map-squeeze', { map: { columns: 2, rows: 2, resolution: 1, origin: [0, 0, 0], occupied: '?' } }, 'RangeError: map.occupied is "?"; allowed is base64 of 1 bytes'],
    ['map-squeeze', { map: { columns: 2, rows: 2, resolution: 1, origin: [0, 0, 0], occupied: 'gA==', unknown: 3 } }, 'TypeError: map.unknown is 3; allowed is base64 of 1 bytes'],
    ['map-squeeze', { unknown: 'maybe' }, 'RangeError: unknown is "maybe"; allowed is "free" or "blocked"'],
    ['map-squeeze', { map: { columns: 1e9, rows: 2, resolution: 1, origin: [0, 0, 0], occupied: '' } }, 'RangeError: map.columns is 1000000000; allowed is a whole number'],
    ['arc-anatomy', { twist: true }, 'TypeError: state.twist is true; allowed is "hidden" or "shown"'],
    ['arc-anatomy', { line: 10 }, 'RangeError: state.line is 10; allowed is a whole number from 0 to 9'],
    ['arc-anatomy', { underway: 0.5 }, 'RangeError: state.underway is 0.5; allowed is a whole number from 0 to 100'],
    ['arc-anatomy', { next: { x: 1 } }, 'TypeError: next.y is'],
    ['arc-anatomy', { samples: 100 }, 'TypeError: state.samples is an unknown key; allowed are'],
    ['arc-anatomy', { playing: false }, 'TypeError: state.playing is an unknown key; allowed are'],
    ['odometry-decomposer', { samples: 5001 }, 'RangeError: samples is 5001; allowed is a whole number from 1 to 5000'],
    ['odometry-decomposer', { shown: 501 }, 'RangeError: state.shown is 501; allowed is a whole number from 0 to 500'],
    ['odometry-decomposer', { rule: 'amcl' }, 'RangeError: rule is "amcl"; allowed is'],
    ['odometry-decomposer', { phase: 3.5 }, 'RangeError: phase is 3.5; allowed is a number from 0 to 3'],
    ['odometry-decomposer', { marked: 500 }, 'RangeError: state.marked is 500; allowed is a whole number from 0 to 499'],
    ['odometry-decomposer', { from: 'here' }, 'TypeError: from is "here"; allowed is an object'],
    ['dead-reckoning', { shown: 50001 }, 'RangeError: state.shown is 50001; allowed is a whole number from 0 to 50000'],
    ['dead-reckoning', { step: 21 }, 'RangeError: step is 21; allowed is a whole number from 1 to 20'],
    ['dead-reckoning', { steps: 0 }, 'RangeError: steps is 0; allowed is a whole number from 1 to 200'],
    ['dead-reckoning', { steps: 'few' }, 'TypeError: steps is "few"; allowed is'],
    ['dead-reckoning', { steps: 1, step: 2 }, 'RangeError: step is 2; allowed is'],
    ['dead-reckoning', { compounding: 'none' }, 'RangeError: compounding is "none"; allowed is'],
    ['dead-reckoning', { shown: 10, marked: 10 }, 'RangeError: state.marked is 10; allowed is a whole number from 0 to 9'],
    ['dead-reckoning', { headingNoise: 0.1 }, 'TypeError: state.headingNoise is an unknown key; allowed are'],
  ]);
  for (const name of ALL) {
    const widget = page.locator(name);
    await widget.scrollIntoViewIfNeeded();
    await ready(widget);
    const before = await stateOf(widget);
    for (const [, change, message] of cases.filter(([of]) => of === name)) {
      const [thrown, after] = await widget.evaluate((element, part) => {
        const widget = /** @type {AnyElement} */ (element);
        try {
          widget.setState({ widget: element.localName, version: 1, ...part });
          return ['nothing', widget.getState()];
        } catch (error) {
          return [String(error), widget.getState()];
        }
      }, change);
      expect(thrown).toContain(message);
      expect(after).toEqual(before);
    }
  }
  const ofOthers = await page.locator('banana-machine').evaluate((element) =>
    [() => 1, 1n].map((version) => {
      try {
        /** @type {any} */ (element).setState({ widget: element.localName, version });
      } catch (error) {
        return String(error);
      }
    }),
  );
  expect(ofOthers).toEqual(['function', 'bigint'].map((kind) => `RangeError: state.version is a ${kind}; allowed is 1`));
});

test('what a page does to a state that it was given changes nothing of the element', async ({ page }) => {
  await show(page, ALL.map((name) => `<${name}></${name}>`).join(''));
  for (const name of ALL) {
    const widget = page.locator(name);
    await widget.scrollIntoViewIfNeeded();
    await ready(widget);
    const changed = await widget.evaluate(async (element) => {
      const figure = /** @type {AnyElement & { map: any }} */ (element);
      if (figure.localName === 'map-squeeze') {
        const arrived = new Promise((resolve) => figure.addEventListener('stats', resolve, { once: true }));
        figure.map = { bounds: [0, 0, 2, 2], walls: [[0, 0, 2, 0], [0, 1, 0, 2]] };
        await arrived;
      }
      let refused = 0;
      /** @param {any} part */
      const spoil = (part) => {
        for (const [key, value] of Object.entries(part)) {
          if (typeof value === 'object' && value !== null) spoil(value);
          refused += Number(!Reflect.set(part, key, 'spoilt'));
        }
      };
      const told = () => JSON.stringify(figure.getState());
      const before = told();
      spoil(figure.getState());
      const after = told();
      const parent = figure.parentNode;
      figure.remove();
      spoil(figure.getState());
      const away = told();
      parent?.append(figure);
      return { before, after, away, refused };
    });
    expect(changed.before).not.toContain('spoilt');
    expect([changed.after, changed.away]).toEqual([changed.before, changed.before]);
    // A map may be large, and is frozen in the place of being copied.
    expect(changed.refused > 0).toBe(name === 'map-squeeze');
  }
});

test('a part of a state leaves the rest, and both models keep their noise', async ({ page }) => {
  await show(page, '<banana-machine></banana-machine>');
  const widget = page.locator('banana-machine');
  await ready(widget);
  await unfold(widget);
  await widget.locator('#alpha1').fill('0.15');
  await widget.getByLabel('odometry').check();
  await widget.locator('#alpha2').fill('0.07');
  const before = /** @type {any} */ (await stateOf(widget));
  expect(before.alphas.velocity[0]).toBe(0.15);
  expect(before.alphas.odometry[1]).toBe(0.07);
  await widget.evaluate((element) => /** @type {AnyElement} */ (element).setState({ widget: 'banana-machine', version: 1, model: 'velocity', samples: 500 }));
  expect(await stateOf(widget)).toEqual({ ...before, model: 'velocity', samples: 500, shown: 500 });
  expect(await widget.evaluate((element) => /** @type {AnyElement} */ (element).alphas[0])).toBe(0.15);
  // Over a removal too.
  const after = await stateOf(widget);
  await widget.evaluate(async (element) => {
    const parent = /** @type {Element} */ (element.parentElement);
    element.remove();
    await new Promise(requestAnimationFrame);
    parent.append(element);
  });
  await ready(widget);
  expect(await stateOf(widget)).toEqual(after);
});

for (const [name, group, key, value] of /** @type {const} */ ([
  ['arc-anatomy', '.underway', 'underway', 30],
  ['odometry-decomposer', '.playable.phase', 'phase', 1],
  ['odometry-decomposer', '.playable.drift', 'drift', 30],
])) {
  test(`a state of ${name} that comes while ${key} plays is what is shown from then on, as is one that is left and come back to`, async ({ page }) => {
    await page.emulateMedia({ reducedMotion: 'no-preference' });
    await show(page, `<${name}></${name}>`);
    const widget = page.locator(name);
    await ready(widget);
    const play = widget.locator(group).getByRole('button');
    const present = async () => /** @type {any} */ (await stateOf(widget))[key];
    /** Plays it until it has moved, and then does what is asked, before it may have come to its end. @param {Record<string, unknown>} [part] */
    const interrupt = (part) =>
      widget.evaluate(async (element, [selector, part]) => {
        const figure = /** @type {AnyElement} */ (element);
        const button = /** @type {HTMLButtonElement} */ (element.shadowRoot?.querySelector(`${selector} button`));
        // The first may be the leap to the beginning.
        for (let steps = 0; steps < 2; steps++) {
          const moved = new Promise((resolve) => element.addEventListener('input', resolve, { once: true }));
          if (steps === 0) button.click();
          await moved;
        }
        await /** @type {any} */ (figure).updateComplete;
        const label = button.innerText;
        if (part) {
          figure.setState({ widget: element.localName, version: 1, ...part });
          return [label, part];
        }
        const parent = /** @type {Element} */ (element.parentElement);
        element.remove();
        await new Promise(requestAnimationFrame);
        const left = figure.getState();
        const again = new Promise((resolve) => element.addEventListener('load', resolve, { once: true }));
        parent.append(element);
        await again;
        return [label, left];
      }, /** @type {const} */ ([group, part]));
    for (const part of [{ [key]: value }, undefined]) {
      const [label, state] = /** @type {[string, any]} */ (await interrupt(part));
      expect(label).toBe('Pause');
      await expect(play).toHaveText('Play');
      await frames(page);
      expect(await present()).toBe(state[key]);
      if (!part) expect(state[key]).toBeGreaterThan(value);
    }
    expect(await heard(page, ['error'])).toEqual([]);
  });
}

test('a state of dead-reckoning in part with a shorter path looks at where that ends, as the property does', async ({ page }) => {
  await show(page, '<dead-reckoning step="9"></dead-reckoning>');
  const widget = page.locator('dead-reckoning');
  await ready(widget);
  const steps = await widget.evaluate((element) => {
    const figure = /** @type {any} */ (element);
    return [12, 5, 20].map((steps) => {
      figure.setState({ widget: element.localName, version: 1, steps });
      return [figure.steps, figure.step];
    });
  });
  expect(steps).toEqual([[12, 9], [5, 5], [20, 5]]);
});

for (const name of CLOUDS) {
  test(`a state of ${name} in part shows as many samples as there were, and grows for no reader who wants less motion`, async ({ page }) => {
    await show(page, `<${name} samples="300"></${name}>`);
    const widget = page.locator(name);
    await ready(widget);
    const states = await widget.evaluate((element) => {
      const figure = /** @type {AnyElement} */ (element);
      return [{ shown: 100 }, { seed: 5 }, { samples: 50 }, { samples: 300 }, { shown: 100, playing: true }].map((part) => {
        figure.setState({ widget: element.localName, version: 1, ...part });
        const { shown, playing } = /** @type {any} */ (figure.getState());
        return [shown, playing];
      });
    });
    // What was all of them stays all.
    expect(states).toEqual([[100, false], [100, false], [50, false], [300, false], [300, false]]);
  });

  test(`a sample of ${name} that is marked and no longer shown leaves a state that can be entered`, async ({ page }) => {
    await show(page, `<${name}></${name}>`);
    const widget = page.locator(name);
    await ready(widget);
    await unfold(widget);
    const marks = await widget.evaluate((element) => {
      const figure = /** @type {AnyElement} */ (element);
      figure.marked = 5;
      const before = figure.getState()?.marked;
      const reset = [...(figure.shadowRoot?.querySelectorAll('button') ?? [])].find(({ innerText }) => innerText === 'Reset');
      reset?.click();
      figure.setState(/** @type {any} */ (figure.getState()));
      const marks = [before, figure.getState()?.marked];
      // The sixth is none of five.
      for (const part of [{ shown: 6, marked: 5 }, { shown: 5 }]) {
        figure.setState({ widget: element.localName, version: 1, ...part });
        marks.push(figure.getState()?.marked);
      }
      return marks;
    });
    expect(marks).toEqual([5, null, 5, null]);
    expect(await heard(page, ['error'])).toEqual([]);
  });
}

for (const [name, large] of /** @type {const} */ ([
  ['banana-machine', { samples: 1_000_000 }],
  ['map-squeeze', { samples: 20_000, sampler: 'sub-stepped', steps: 30, conditioned: false }],
  ['dead-reckoning', { samples: 100_000, steps: 40 }],
])) {
  for (const way of ['state', 'properties']) {
    test(`${name} opens in ${way} that it was given before and that take long to make`, async ({ page }) => {
      await show(page, '');
      const [asked, state] = await page.evaluate(async ([tag, settings, how]) => {
        const element = /** @type {any} */ (document.createElement(tag));
        if (how === 'state') element.setState({ widget: tag, version: 1, ...settings, seed: 12 });
        else Object.assign(element, settings, { seed: 12 });
        document.body.append(element);
        while (!element.machine) await new Promise(requestAnimationFrame);
        for (let i = 0; i < 3; i++) await new Promise(requestAnimationFrame);
        return [settings, element.getState()];
      }, /** @type {const} */ ([name, large, way]));
      expect(state).toMatchObject({ ...asked, seed: 12, shown: large.samples });
    });
  }
}
