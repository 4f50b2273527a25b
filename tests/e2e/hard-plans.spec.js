// Maps that take long to look at: the page goes on meanwhile, says so, and lets the reader stop it.

import { expect } from '@playwright/test';
import { expectAccessible } from './axe.js';
import { openSqueeze, pgm, squeezed, unfold, yaml } from './squeeze-support.js';
import { FRESH, STILL, boxOf, frames, pictureOf, test } from './support.js';

/**
 * @typedef {import('../../www/types.d.ts').MapSqueezeElement} Element
 * @typedef {import('./squeeze-support.js').MapSqueezeElement} MapSqueezeElement
 * @typedef {import('@playwright/test').Locator} Locator
 */

test.use(STILL);

/** Walls of a star: it takes long to look at, and longer than a map of so many that lie apart. */
const MANY = 30_000;

/**
 * Does work on a machine that is several times as slow, so that what takes long does so on any.
 *
 * @param {import('@playwright/test').Page} page
 * @param {() => Promise<void>} work
 */
async function slowly(page, work) {
  const session = await page.context().newCDPSession(page);
  await session.send('Emulation.setCPUThrottlingRate', { rate: 6 });
  await work();
  await session.send('Emulation.setCPUThrottlingRate', { rate: 1 });
  await session.detach();
}

const progress = (/** @type {Locator} */ widget) => widget.getByRole('progressbar');
const status = (/** @type {Locator} */ widget) => widget.locator('[role=status]');

/**
 * Gives the element a map of walls from one point to everywhere, made in the page, and lets it be.
 *
 * @param {Locator} widget
 * @param {number} [count]
 */
function giveStar(widget, count = MANY) {
  return widget.evaluate((element, length) => {
    const ray = (/** @type {number} */ angle) => [5, 5, 5 + 4.9 * Math.cos(angle), 5 + 4.9 * Math.sin(angle)];
    const walls = Array.from({ length }, (_, i) => ray((2 * Math.PI * i) / length));
    /** @type {Element} */ (element).map = /** @type {any} */ ({ name: 'star', bounds: [0, 0, 10, 10], walls });
  }, count);
}

test('a hard map is looked at in slices, with progress, and the page goes on', async ({ page }) => {
  const widget = await openSqueeze(page);
  const before = await pictureOf(widget.locator('canvas.plane'));
  // Frames in which the page could do something else, and how far the work was in them.
  /** @type {([number, string] | undefined)[]} */
  let told = [];
  await slowly(page, async () => {
    await giveStar(widget);
    told = await widget.evaluate(async (element) => {
      const squeeze = /** @type {Element} */ (element);
      const shares = [];
      while (squeeze.map === null) {
        await new Promise(requestAnimationFrame);
        const bar = squeeze.shadowRoot?.querySelector('progress');
        shares.push(bar ? /** @type {[number, string]} */ ([bar.value, bar.nextElementSibling?.textContent ?? '']) : undefined);
      }
      return shares;
    });
  });
  const shares = told.filter((share) => share !== undefined);
  expect(shares.length).toBeGreaterThan(10);
  expect(new Set(shares.map(([share]) => share)).size).toBeGreaterThan(5);
  for (const [share, text] of shares) {
    expect(share).toBeGreaterThanOrEqual(0);
    expect(text).toBe(`Computing ${Math.floor(100 * share)} %`);
  }
  await frames(page);
  await expect(progress(widget)).toHaveCount(0);
  const { config, stats } = await widget.evaluate((element) => {
    const { config, stats } = /** @type {MapSqueezeElement} */ (element).machine;
    return { config, stats };
  });
  expect(stats.attempts).toBe(config.samples);
  expect(await pictureOf(widget.locator('canvas.plane'))).not.toBe(before);
});

test('a hard map is looked at out of sight too, where there are no frames, and told when it is there', async ({ page }) => {
  const widget = await openSqueeze(page);
  await page.evaluate(() => scrollTo(0, 0));
  await expect(widget).not.toBeInViewport();
  await widget.evaluate((element) => {
    element.addEventListener('stats', () => Object.assign(window, { told: /** @type {Element} */ (element).map?.name }), { once: true });
  });
  await slowly(page, async () => {
    await giveStar(widget);
    expect(await page.evaluate(() => 'told' in window)).toBe(false);
  });
  await page.waitForFunction(() => 'told' in window);
  expect(await page.evaluate(() => Reflect.get(window, 'told'))).toBe('star');
});

for (const [way, act] of /** @type {[string, (widget: Locator) => Promise<void>][]} */ ([
  ['the button', (widget) => widget.getByRole('button', { name: 'Stop' }).click()],
  ['Escape', (widget) => widget.getByRole('slider', { name: 'Robot', exact: true }).press('Escape')],
  ['Escape where nothing has the focus', (widget) => widget.page().keyboard.press('Escape')],
])) {
  test(`${way} stops it, and all is as it was`, async ({ page }) => {
    const widget = await openSqueeze(page);
    const before = await squeezed(widget);
    const picture = await pictureOf(widget.locator('canvas.plane'));
    await slowly(page, async () => {
      await giveStar(widget);
      await expect(progress(widget)).toBeVisible();
      // Elsewhere, Escape means something else.
      await page.locator('banana-machine').first().dispatchEvent('keydown', { key: 'Escape' });
      await expect(status(widget)).toHaveText('This takes a moment. Escape stops it.');
      await act(widget);
    });
    await expect(progress(widget)).toHaveCount(0);
    await expect(status(widget)).toHaveText('Stopped: everything is as it was.');
    expect(await squeezed(widget)).toEqual(before);
    expect(await pictureOf(widget.locator('canvas.plane'))).toBe(picture);
    // It was nothing that lasts.
    await widget.evaluate((element) => {
      /** @type {Element} */ (element).map = { name: 'room', bounds: [0, 0, 6, 4], walls: [[0, 0, 6, 0]] };
    });
    expect((await squeezed(widget)).walls).toEqual([0, 0, 6, 0]);
  });
}

test('many samples in the map that is there are drawn in slices too, and stopped', async ({ page }) => {
  const widget = await openSqueeze(page);
  const before = await squeezed(widget);
  await slowly(page, async () => {
    // Seconds of work.
    await widget.evaluate((element) => void (/** @type {Element} */ (element).samples = 1_000_000));
    await expect(progress(widget)).toBeVisible();
    await widget.getByRole('button', { name: 'Stop' }).click();
  });
  await expect(progress(widget)).toHaveCount(0);
  expect(await squeezed(widget)).toEqual(before);
});

test('a cloud that grows slowly takes several frames for a step, and is seen after each', async ({ page }) => {
  const widget = await openSqueeze(page);
  // A hundred a step.
  await widget.evaluate((element) => void (/** @type {Element} */ (element).samples = 15_000));
  await widget.getByRole('button', { name: 'Reset' }).click();
  await frames(page);
  await widget.evaluate((element) => {
    const { machine } = /** @type {MapSqueezeElement} */ (element);
    const { advance } = machine;
    const slices = /** @type {number[]} */ ([]);
    const seen = /** @type {number[]} */ ([]);
    let count = 0;
    // A few distances at a time, and long over them.
    machine.advance = () => {
      const end = performance.now() + 10;
      while (performance.now() < end);
      count++;
      return advance.call(machine, 20);
    };
    element.addEventListener('stats', () => machine.shown > 0 && seen.push(machine.shown));
    const note = () => {
      slices.push(count);
      count = 0;
      if (seen.length < 2) requestAnimationFrame(note);
      else Object.assign(window, { grown: { slices, seen } });
    };
    requestAnimationFrame(note);
  });
  await widget.getByRole('button', { name: 'Play' }).click();
  await page.waitForFunction(() => 'grown' in window);
  const { slices, seen } = await page.evaluate(() => Reflect.get(window, 'grown'));
  expect(seen).toEqual([100, 200]);
  // Three are longer than the 25 ms that a frame has for it.
  expect(Math.max(...slices)).toBeLessThanOrEqual(3);
  expect(slices.filter((/** @type {number} */ count) => count > 0).length).toBeGreaterThan(5);
});

test('another map does not wait for what is being done, which begins anew where the map is stopped', async ({ page }) => {
  const widget = await openSqueeze(page);
  const worked = await widget.evaluate((element) => {
    const squeeze = /** @type {any} */ (element);
    const { prototype } = squeeze.machine.constructor;
    const { advance } = prototype;
    const machines = new Set();
    prototype.advance = function (/** @type {number} */ work) {
      machines.add(this);
      return advance.call(this, work);
    };
    // Seconds of work each.
    squeeze.samples = 1_000_000;
    const beside = Array.from({ length: 60_000 }, (_, i) => [5, 5, 5 + 4 * Math.cos(i), 5 + 4 * Math.sin(i)]);
    machines.clear();
    for (const name of ['one', 'two']) squeeze.map = { name, bounds: [0, 0, 10, 10], walls: beside };
    const { size } = machines;
    const own = machines.has(squeeze.machine);
    prototype.advance = advance;
    return { size, own, config: squeeze.machine.config.samples, map: squeeze.map };
  });
  expect(worked).toEqual({ size: 2, own: false, config: 600, map: null });
  await slowly(page, async () => {
    await expect(progress(widget)).toBeVisible();
    await widget.getByRole('button', { name: 'Stop' }).click();
  });
  await expect.poll(() => widget.evaluate((element) => /** @type {any} */ (element).machine.config.samples)).toBe(1_000_000);
  expect(await widget.evaluate((element) => /** @type {Element} */ (element).map)).toBe(null);
});

test('what the reader wants while a map is on its way is there when it has come', async ({ page }) => {
  const widget = await openSqueeze(page);
  await slowly(page, async () => {
    await giveStar(widget);
    await expect(progress(widget)).toBeVisible();
    await widget.getByRole('slider', { name: 'n, noise' }).press('End');
  });
  await expect.poll(() => widget.evaluate((element) => /** @type {Element} */ (element).map?.name), { timeout: 30_000 }).toBe('star');
  const { alphas } = await widget.evaluate((element) => /** @type {any} */ (element).machine.config);
  const end = await widget.getByRole('slider', { name: 'n, noise' }).evaluate((element) => Number(/** @type {HTMLInputElement} */ (element).max));
  expect(await widget.getByRole('slider', { name: 'n, noise' }).inputValue()).toBe(String(end));
  expect(Math.max(...Object.values(alphas).flat())).toBeGreaterThan(0.12);
});

for (const [what, change] of /** @type {const} */ ([['takes it back', { map: null }], ['names a preset', { preset: 'corridor' }]])) {
  test(`a map on its way is given up where the page ${what}`, async ({ page }) => {
    const widget = await openSqueeze(page);
    await slowly(page, async () => {
      await giveStar(widget);
      await expect(progress(widget)).toBeVisible();
      const given = await widget.evaluate((element, changes) => {
        const begun = performance.now();
        const { map } = Object.assign(/** @type {any} */ (element), changes);
        return { milliseconds: performance.now() - begun, map };
      }, change);
      expect(given.map).toBe(null);
      // Not to the end of what is given up, which takes seconds here.
      expect(given.milliseconds).toBeLessThan(1000);
    });
    await expect(progress(widget)).toBeHidden();
    await frames(page);
    expect(await widget.evaluate((element) => /** @type {Element} */ (element).map)).toBe(null);
  });
}

test('a grid of which a pixel has millions of cells is drawn', async ({ page }) => {
  const widget = await openSqueeze(page);
  await widget.evaluate((element) => {
    const map = { name: 'far', columns: 16, rows: 16, resolution: 0.001, origin: [0, 0, 0], occupied: btoa('\xff'.repeat(32)) };
    const squeeze = /** @type {any} */ (element);
    squeeze.setState({ ...squeeze.getState(), map, command: { v: 1e6, omega: 0, dt: 1 } });
  });
  await expect.poll(() => widget.evaluate((element) => /** @type {Element} */ (element).map?.name)).toBe('far');
  await frames(page);
  expect(await widget.evaluate((element) => element.shadowRoot?.querySelector('.failure')?.textContent)).toBe(undefined);
  await expect(widget.locator('canvas.plane')).toBeVisible();
});

test('a large cloud in a state comes in slices too', async ({ page }) => {
  await openSqueeze(page);
  await slowly(page, async () => {
    const frames = await page.evaluate(async () => {
      const element = /** @type {any} */ (document.createElement('banana-machine'));
      element.style = 'position: fixed; top: 0; left: 0; width: 600px';
      document.body.prepend(element);
      while (!element.machine) await new Promise(requestAnimationFrame);
      element.setState({ ...element.getState(), samples: 2_000_000, shown: 2_000_000 });
      for (let count = 0; ; count++) {
        await new Promise(requestAnimationFrame);
        if (element.machine.config.samples === 2_000_000) return count;
      }
    });
    expect(frames).toBeGreaterThan(5);
  });
});

/**
 * Slices that the hardest plans are made ready in at most: each is 50,000 steps, and they take twenty million
 * (tests/native/map/hard_plans.rs).
 */
const SLICES = 20_000_000 / 50_000;

test('a short link with as many walls as are allowed is opened, in no more slices than any plan takes', FRESH, async ({ page }) => {
  const widget = await openSqueeze(page);
  const link = await widget.evaluate(async (element) => {
    const squeeze = /** @type {Element} */ (element);
    const walls = Array.from({ length: 100_000 }, () => [0, 0, 10, 10]);
    squeeze.map = /** @type {any} */ ({ name: 'diagonals', bounds: [0, 0, 10, 10], walls });
    squeeze.sampler = 'whole-arc';
    return squeeze.shareLink();
  });
  expect(link.length).toBeLessThan(10_000);
  await page.goto('about:blank');
  await page.goto(link);
  const opened = page.locator('map-squeeze').first();
  await opened.scrollIntoViewIfNeeded();
  const nameOfMap = () => opened.evaluate((element) => /** @type {Element} */ (element).map?.name);
  await expect.poll(nameOfMap).toBe('diagonals');
  const slices = await opened.evaluate((element) => {
    const { machine, motion } = /** @type {MapSqueezeElement} */ (element);
    const fresh = motion.MapSqueeze.empty({});
    fresh.setPlan(machine.plan);
    fresh.beginToGrow(1);
    let count = 1;
    while (!fresh.advance(50_000)) count++;
    fresh.free();
    return count;
  });
  // As often the page can do something else.
  expect(slices).toBeGreaterThan(50);
  expect(slices).toBeLessThan(SLICES);
});

test('what is said of the work is in sight, moves nothing and is accessible', async ({ page }) => {
  const widget = await openSqueeze(page);
  const before = await boxOf(widget);
  await slowly(page, async () => {
    await giveStar(widget);
    await expect(progress(widget)).toHaveAccessibleName('Computing');
    await expect(widget.getByRole('button', { name: 'Stop' })).toBeInViewport();
    await expect(widget.getByRole('button', { name: 'Stop' })).toHaveAttribute('title', 'Everything stays as it was (Escape)');
    expect(await boxOf(widget)).toEqual(before);
    await expectAccessible(page);
  });
});

/**
 * Drops a plain image of 4096² pixels, made in the page, with what describes it, and lets it be.
 *
 * @param {Locator} widget
 * @param {string} last its last pixel
 */
function dropHall(widget, last) {
  return widget.evaluate((element, end) => {
    const side = 4096;
    const row = (/** @type {string} */ shade) => `${`${shade} `.repeat(side - 1)}0\n`;
    const image = ['P2\n4096 4096\n255\n', row('0'), ...Array(side - 2).fill(row('254')), row('0').replace(/0\n$/, `${end}\n`)];
    const dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File(image, 'hall.pgm'));
    dataTransfer.items.add(new File(['image: hall.pgm\nresolution: 0.01\norigin: [0, 0, 0]\n'], 'hall.yaml'));
    element.shadowRoot?.querySelector('.stage')?.dispatchEvent(new DragEvent('drop', { dataTransfer, bubbles: true, composed: true, cancelable: true }));
  }, last);
}

/**
 * How many frames there are until the reader is told of a map or of a refusal, and during how many the work is told of.
 *
 * @param {Locator} widget
 * @param {string} told the part of the fold that says it
 */
function framesUntil(widget, told) {
  return widget.evaluate(async (element, [selector]) => {
    const said = () => element.shadowRoot?.querySelector(selector)?.textContent ?? '';
    for (const before = said(), count = { all: 0, told: 0 }; ; count.all++) {
      if (said() !== before) return count;
      if (element.shadowRoot?.querySelector('progress')) count.told++;
      await new Promise(requestAnimationFrame);
    }
  }, [told]);
}

test('a plain image of the largest size is read in slices, and the page goes on', async ({ page }) => {
  const widget = await openSqueeze(page);
  const fold = await unfold(widget, 'A map of your own');
  // A frame has 25 ms for it, of which a fast machine needs few.
  await slowly(page, async () => {
    await dropHall(widget, '0');
    const { all, told } = await framesUntil(widget, '.own-map .present');
    expect(all).toBeGreaterThan(10);
    expect(told).toBeGreaterThan(5);
  });
  await expect(fold.locator('.present')).toContainText('hall.yaml: 41.0 m × 41.0 m');
  const { bounds, walls, startFree, stats, config } = await squeezed(widget);
  expect(bounds.map((bound) => Number(bound.toFixed(9)))).toEqual([0, 0, 40.96, 40.96]);
  expect([walls.length, startFree, stats.attempts]).toEqual([4 * 8, true, config.samples]);
});

test('one that is broken at its end is refused late, and the present map stays', async ({ page }) => {
  const widget = await openSqueeze(page);
  const fold = await unfold(widget, 'A map of your own');
  const before = await squeezed(widget);
  const picture = await pictureOf(widget.locator('canvas.plane'));
  await slowly(page, async () => {
    await dropHall(widget, 'five');
    expect((await framesUntil(widget, '.own-map .note')).all).toBeGreaterThan(5);
  });
  await expect(fold.locator('.note')).toHaveText('hall.pgm, line 4099: a pixel is "five"; allowed is a whole number from 0 to 255.');
  await expect(fold.locator('.note')).toBeInViewport();
  await expect(progress(widget)).toHaveCount(0);
  await expect(fold.locator('.present')).toContainText('The apartment');
  expect(await squeezed(widget)).toEqual(before);
  expect(await pictureOf(widget.locator('canvas.plane'))).toBe(picture);
  await widget.getByRole('button', { name: 'Open corridor' }).click();
  await expect.poll(async () => (await squeezed(widget)).config.start.y).toBe(4.4);
});

test('of maps that are dropped one after the other the last one is there, and nothing is left of the others', async ({ page }) => {
  const widget = await openSqueeze(page);
  const fold = await unfold(widget, 'A map of your own');
  const made = await widget.evaluateHandle((element) => {
    const { MapSqueeze } = /** @type {MapSqueezeElement} */ (element).motion;
    const { empty, prototype } = MapSqueeze;
    const { free } = prototype;
    const count = { made: 0, freed: 0, begun: 0 };
    MapSqueeze.empty = (...given) => (count.made++, empty.apply(MapSqueeze, given));
    prototype.free = function () {
      count.freed++;
      free.call(this);
    };
    const { beginGrid } = prototype;
    prototype.beginGrid = function (...given) {
      count.begun++;
      beginGrid.apply(this, given);
    };
    return count;
  });
  await dropHall(widget, 'five');
  await expect.poll(() => made.evaluate(({ begun }) => begun)).toBe(1);
  const room = [yaml('room.yaml', { image: 'room.pgm', resolution: 0.05, origin: '[0, 0, 0]' }), pgm('room.pgm', 60, 40, (column) => column === 0)];
  await widget.getByLabel('Map files').setInputFiles(room);
  await expect(fold.locator('.present')).toContainText('room.yaml');
  await expect(fold.locator('.note')).toBeHidden();
  // That of the apartment is freed too.
  expect(await made.jsonValue()).toEqual({ made: 2, freed: 2, begun: 2 });

  // Whoever goes has what they dropped when they return.
  await dropHall(widget, '0');
  await expect.poll(() => made.evaluate(({ begun }) => begun)).toBe(3);
  await widget.evaluate(async (element) => {
    const { parentElement } = element;
    element.remove();
    await new Promise(requestAnimationFrame);
    parentElement?.prepend(element);
  });
  await expect.poll(() => widget.evaluate((element) => /** @type {Element} */ (element).map?.name)).toBe('hall.yaml');
  expect(await made.jsonValue()).toMatchObject({ made: 3, freed: 4 });
});

/** The largest map that there may be, every second row of it unknown: more than five million letters. Made in the page. */
const largest = (/** @type {string} */ occupied) => {
  const bits = (/** @type {(row: number) => number} */ of) => {
    const bytes = new Uint8Array(2 ** 21).map((_, i) => of(i >> 9));
    let text = '';
    for (let at = 0; at < bytes.length; at += 4096) text += String.fromCharCode(...bytes.subarray(at, at + 4096));
    return btoa(text);
  };
  const rows = occupied === 'none' ? () => 0 : (/** @type {number} */ row) => (row % 2 ? 0 : 0xaa);
  return { name: 'largest', columns: 4096, rows: 4096, resolution: 0.01, origin: [0, 0, 0], occupied: bits(rows), unknown: bits((row) => (row % 2 ? 0xff : 0)) };
};

test('the largest grid comes in slices from a state and from its link', FRESH, async ({ page }) => {
  const widget = await openSqueeze(page);
  const came = await widget.evaluate(async (element, make) => {
    const squeeze = /** @type {any} */ (element);
    const map = eval(make)('none');
    squeeze.setState({ ...squeeze.getState(), map });
    // The picture is of what is there.
    squeeze.toSVG();
    let frames = 0;
    while (squeeze.state.own.map === null) {
      frames++;
      await new Promise(requestAnimationFrame);
    }
    const same = JSON.stringify(squeeze.map) === JSON.stringify(map);
    return { frames, same, link: await squeeze.shareLink() };
  }, `(${largest})`);
  // A frame has 25 ms for it.
  expect(came.frames).toBeGreaterThan(3);
  expect(came.same).toBe(true);
  await page.goto('about:blank');
  await page.goto(came.link);
  const opened = page.locator('map-squeeze').first();
  await opened.scrollIntoViewIfNeeded();
  await expect.poll(() => opened.evaluate((element) => /** @type {any} */ (element).map?.rows)).toBe(4096);
  expect((await squeezed(opened)).bounds).toEqual([0, 0, 40.96, 40.96]);
});

test('what is wrong with the fields of a large grid is thrown at once, however long the rest would take', async ({ page }) => {
  const widget = await openSqueeze(page);
  const before = await squeezed(widget);
  const thrown = await widget.evaluate((element, make) => {
    const squeeze = /** @type {any} */ (element);
    const map = eval(make)('none');
    const wrong = [undefined, { ...map, rows: -1 }, { ...map, unknown: 'AAAA' }, { ...map, resolution: 'fine' }, { ...map, origin: [0, 0] }];
    return wrong.map((each) => {
      try {
        squeeze.setState({ ...squeeze.getState(), map: each });
      } catch (error) {
        return /** @type {Error} */ (error).message.replace(/ is .*/s, '');
      }
    });
  }, `(${largest})`);
  expect(thrown).toEqual(['map', 'map.rows', 'map.unknown', 'map.resolution', 'map.origin has length 2; allowed']);
  expect(await squeezed(widget)).toEqual(before);
});

test('a grid in a state whose cells have too many sides is refused by an event, and nothing has changed', async ({ page }) => {
  const widget = await openSqueeze(page);
  const before = await squeezed(widget);
  const refused = await widget.evaluate(async (element, make) => {
    const squeeze = /** @type {any} */ (element);
    const state = squeeze.getState();
    const message = new Promise((resolve) => element.addEventListener('error', (event) => {
      event.preventDefault();
      resolve(/** @type {ErrorEvent} */ (event).message);
    }));
    squeeze.setState({ ...state, seed: state.seed + 1, map: eval(make)('dotted') });
    const told = await message;
    return { told, same: JSON.stringify(squeeze.getState()) === JSON.stringify(state) };
  }, `(${largest})`);
  expect(refused.told).toMatch(/^map\.occupied has cells in the way with 100\d{3} sides or more; allowed are at most 100000$/);
  expect(refused.same).toBe(true);
  await expect(progress(widget)).toHaveCount(0);
  expect(await squeezed(widget)).toEqual(before);
});

test('what takes as long as a frame is begun early in one', async ({ page }) => {
  const widget = await openSqueeze(page);
  const elapsed = await widget.evaluate(async (element) => {
    const squeeze = /** @type {any} */ (element);
    const { prototype } = squeeze.machine.constructor;
    const { settings } = squeeze;
    const { now } = performance;
    const { advance } = prototype;
    const { settle } = settings;
    const grid = /** @type {PropertyDescriptor} */ (Object.getOwnPropertyDescriptor(prototype, 'grid'));
    // A clock that goes on by ten milliseconds with each slice of work: of five, three are done at once, and two in a frame.
    let [added, began, calls] = [0, 0, 0];
    performance.now = () => now.call(performance) + added;
    prototype.advance = function (/** @type {number} */ work) {
      added += 10;
      return ++calls < 5 ? false : advance.call(this, 1000 * work);
    };
    settings.settle = function (/** @type {number[]} */ ...given) {
      began = added;
      return settle.apply(this, given);
    };
    const elapsed = /** @type {number[]} */ ([]);
    Object.defineProperty(prototype, 'grid', {
      configurable: true,
      get() {
        elapsed.push(added - began);
        return grid.get?.call(this);
      },
    });
    squeeze.map = { name: 'yard', columns: 4, rows: 4, resolution: 1, origin: [0, 0, 0], occupied: btoa('\x00\x01') };
    while (squeeze.map?.name !== 'yard') await new Promise(requestAnimationFrame);
    Object.assign(prototype, { advance });
    Object.defineProperty(prototype, 'grid', grid);
    Object.assign(performance, { now });
    settings.settle = settle;
    return elapsed;
  });
  expect(elapsed.length).toBeGreaterThan(0);
  // A quarter of what a frame has.
  expect(Math.max(...elapsed)).toBeLessThan(6.25);
});

/**
 * What is done of a grid of seventeen million cells in the order that it is: c for cells that are counted and drawn, w for walls.
 *
 * @param {Locator} widget
 * @param {'close' | 'whole'} view
 */
function drawnOf(widget, view) {
  return widget.evaluate(async (element, view) => {
    const squeeze = /** @type {any} */ (element);
    const { prototype } = OffscreenCanvasRenderingContext2D;
    const { putImageData, stroke } = prototype;
    let done = '';
    /** @type {any} */ (prototype).putImageData = function (/** @type {any[]} */ ...given) {
      done += 'c';
      return /** @type {any} */ (putImageData).apply(this, given);
    };
    /** @type {any} */ (prototype).stroke = function () {
      done += 'w';
      return /** @type {any} */ (stroke).call(this);
    };
    const rows = Uint8Array.from({ length: 2 ** 21 }, (_, i) => ((i >> 9) % 128 ? 0 : 1));
    let occupied = '';
    for (let at = 0; at < rows.length; at += 4096) occupied += String.fromCharCode(...rows.subarray(at, at + 4096));
    squeeze.view = view;
    squeeze.map = { name: 'dots', columns: 4096, rows: 4096, resolution: 0.01, origin: [0, 0, 0], occupied: btoa(occupied) };
    while (squeeze.map?.name !== 'dots' || !done.includes('w') || squeeze.pictures[0].unfinished) await new Promise(requestAnimationFrame);
    Object.assign(prototype, { putImageData, stroke });
    return done;
  }, view);
}

test('the walls of a large grid are not stroked while its cells are being drawn', async ({ page }) => {
  const done = await drawnOf(await openSqueeze(page), 'whole');
  // Cells are counted 100,000 or so at a time, of seventeen millions, for each view that is not on its way.
  const pictures = done.split(/w+/).filter(Boolean).map(({ length }) => length);
  expect(pictures.length).toBeGreaterThan(0);
  expect(Math.min(...pictures)).toBeGreaterThan(100);
  expect(done).toMatch(/w$/);
});

test('of a large grid what is near the robot is drawn at once, and all of it in the corner afterwards', async ({ page }) => {
  const widget = await openSqueeze(page);
  const [first, ...others] = (await drawnOf(widget, 'close')).split(/w+/).filter(Boolean).map(({ length }) => length);
  // A picture of a thousand pixels by four hundred shows some hundred thousand cells of this map, and more around it.
  expect(first).toBeLessThan(12);
  expect(Math.max(...others)).toBeGreaterThan(100);
  // And wherever the robot goes: where it came from, the picture is the one that it was.
  const plane = widget.locator('canvas.plane');
  const pictures = [];
  for (const x of [6.4, 30, 6.4]) {
    await widget.evaluate(async (element, x) => {
      const squeeze = /** @type {any} */ (element);
      Object.assign(squeeze, { x, y: x });
      do await new Promise(requestAnimationFrame);
      while (squeeze.pictures[0].unfinished || squeeze.settings.stale);
    }, x);
    await frames(page);
    pictures.push(await pictureOf(plane));
  }
  expect(pictures[1]).not.toBe(pictures[0]);
  expect(pictures[2]).toBe(pictures[0]);
});

test('what the page sets next takes the place of what is being computed, and Stop takes all of it back', async ({ page }) => {
  const widget = await openSqueeze(page);
  const before = await squeezed(widget);
  await slowly(page, async () => {
    const completed = await widget.evaluate((element) => {
      const squeeze = /** @type {Element} */ (element);
      const machine = /** @type {any} */ (squeeze).machine;
      const completed = /** @type {number[]} */ ([]);
      machine.advance = (/** @type {number} */ work) => {
        const done = Object.getPrototypeOf(machine).advance.call(machine, work);
        if (done) completed.push(machine.config.samples);
        return done;
      };
      squeeze.samples = 1_000_000;
      squeeze.v = 0.9;
      squeeze.samples = 900_000;
      squeeze.addEventListener('error', (event) => event.preventDefault(), { once: true });
      squeeze.v = NaN;
      delete machine.advance;
      return completed;
    });
    // Not one of them was waited for, nor is what was refused.
    expect(completed).toEqual([]);
    await expect(progress(widget)).toBeVisible();
    expect(await widget.getAttribute('v')).toBe('0.9');
    expect(await widget.getAttribute('samples')).toBe('900000');
    await widget.getByRole('button', { name: 'Stop' }).click();
  });
  await expect(progress(widget)).toHaveCount(0);
  expect(await squeezed(widget)).toEqual(before);
  expect(await widget.evaluate((element) => {
    const squeeze = /** @type {Element} */ (element);
    squeeze.samples = 1_000_000;
    squeeze.v = 0.9;
    squeeze.samples = 3000;
    return [squeeze.v, squeeze.samples, squeeze.stats?.attempts];
  })).toEqual([0.9, 3000, 3000]);
});

test('what the reader wants meanwhile is there when the page asks', async ({ page }) => {
  const widget = await openSqueeze(page);
  const slider = await widget.getByRole('slider', { name: /^v, / }).elementHandle();
  expect(await widget.evaluate((element, slider) => {
    const squeeze = /** @type {Element} */ (element);
    squeeze.samples = 200_000;
    const isUnderWay = /** @type {any} */ (squeeze).machine.stats.attempts < 200_000;
    Object.assign(/** @type {HTMLInputElement} */ (slider), { value: '0.7' }).dispatchEvent(new InputEvent('input', { bubbles: true, composed: true }));
    return [isUnderWay, squeeze.stats?.attempts, squeeze.v, squeeze.samples];
  }, slider)).toEqual([true, 200_000, 0.7, 200_000]);
});

test('what a setting is does not wait for what is computed with it', async ({ page }) => {
  const widget = await openSqueeze(page);
  const slider = await widget.getByRole('slider', { name: /^v, / }).elementHandle();
  expect(await widget.evaluate((element, slider) => {
    const squeeze = /** @type {Element} */ (element);
    const machine = /** @type {any} */ (squeeze).machine;
    squeeze.samples = 1_000_000;
    squeeze.v = 0.9;
    const said = [squeeze.v, squeeze.samples];
    Object.assign(/** @type {HTMLInputElement} */ (slider), { value: '0.7' }).dispatchEvent(new InputEvent('input', { bubbles: true, composed: true }));
    said.push(squeeze.v);
    const isUnderWay = machine.stats.attempts < 1_000_000;
    squeeze.samples = 2000;
    return [...said, isUnderWay, squeeze.stats?.attempts];
  }, slider)).toEqual([0.9, 1_000_000, 0.7, true, 2000]);
});

test('who chooses steps has as many fewer samples where there would be too many', async ({ page }) => {
  const widget = await openSqueeze(page);
  await widget.evaluate((element) => void Object.assign(element, { samples: 2000, steps: 1000 }));
  await widget.getByRole('radio', { name: 'sub-stepped' }).check();
  const { config } = await squeezed(widget);
  expect([config.sampler, config.samples]).toEqual(['sub-stepped', 1000]);
});
