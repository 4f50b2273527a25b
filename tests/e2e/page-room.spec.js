import { fileURLToPath } from 'node:url';
import { expect } from '@playwright/test';
import { ready, show } from './element-support.js';
import { FRESH, STILL, boxOf, frames, test } from './support.js';

test.use(STILL);

/** Those that keep as much room as they take, and no more. */
const RESERVED = ['banana-machine', 'map-squeeze', 'odometry-decomposer', 'dead-reckoning', 'alpha-calibrator'];

/** Columns of books, phones and screens. */
const WIDTHS = [320, 360, 375, 414, 480, 560, 600, 640, 700, 760, 820, 900, 1024, 1150, 1280, 1600, 1920];

/** Five lines of text, em: what is kept need not know how sentences break, in letters as narrow as Tinos’s. */
const TOLERANCE = 5 * 1.4;

const MODULES = new URL('../../node_modules/', import.meta.url);

/** Those that a page brings, whatever fonts a machine has: Tinos is as wide as Times, Arimo as Arial, DejaVu Sans as Verdana. */
const FACES = `
  @import '/fonts/@fontsource/tinos/400.css';
  @import '/fonts/@fontsource/tinos/700.css';
  @import '/fonts/@fontsource/arimo/400.css';
  @import '/fonts/@fontsource/arimo/700.css';
  @import '/fonts/dejavu-fonts-ttf/dejavu.css';
`;
const DEJAVU = [['', 400], ['-Bold', 700]].map(([bold, weight]) =>
  `@font-face { font-family: 'DejaVu Sans'; font-weight: ${weight}; src: url('ttf/DejaVuSans${bold}.ttf') }`);

/** @param {import('@playwright/test').Page} page */
async function bringFonts(page) {
  await page.route('**/fonts/**', (route) => {
    const path = new URL(route.request().url()).pathname.replace('/fonts/', '');
    return path.endsWith('/dejavu.css')
      ? route.fulfill({ contentType: 'text/css', body: DEJAVU.join('\n') })
      : route.fulfill({ path: fileURLToPath(new URL(path, MODULES)) });
  });
}

/** Families that pages have, the width from which on they are to fit, and the size of their letters. @type {[string, number, number][]} */
const FONTS = [
  ['Tinos', 0, 16],
  ['Arimo', 0, 16],
  ['Arimo', 0, 18],
  ['DejaVu Sans', 30, 17],
];

for (const name of RESERVED) for (const [font, from, size] of FONTS) {
  test(`the room that is kept for ${name} is that which it takes, at any width, in ${size} px ${font}`, FRESH, async ({ page }) => {
    test.slow();
    await bringFonts(page);
    await show(page, `<${name} id="here"></${name}><div style="height: 9000px"></div><${name} id="later"></${name}>`, {
      head: `<style>${FACES} body { margin: 0; font: ${size}px '${font}' }</style>`,
    });
    await ready(page.locator('#here'));
    const last = page.locator('#here .folds');
    await expect(last).toBeVisible();
    await page.evaluate(() => document.fonts.ready.then(() => true));
    expect(await page.evaluate((family) => [...document.fonts].some((face) => face.family.includes(family) && face.status === 'loaded'), font)).toBe(true);
    /** @type {string[]} */
    const wrong = [];
    for (const width of WIDTHS.filter((each) => each >= from * size)) {
      // The second is a phone with a low screen, on which its pictures are lower.
      for (const height of [1200, 667]) {
        await page.setViewportSize({ width, height });
        await frames(page);
        // Letters that were not asked for before may be on their way.
        await page.evaluate(() => document.fonts.ready.then(() => true));
        const [here, kept, folds] = await Promise.all([page.locator('#here'), page.locator('#later'), last].map(boxOf));
        const taken = (folds.y + folds.height - here.y) / size;
        const [high, room] = [here.height / size, kept.height / size];
        if (high !== room || room - taken > TOLERANCE) {
          wrong.push(`${width} px (${width / size} em), ${height} px high: ${taken.toFixed(1)} em taken, ${high.toFixed(1)} em high, ${room.toFixed(1)} em kept`);
        }
      }
    }
    expect(wrong).toEqual([]);
  });
}

/** What pages take away from all elements, or give to those that follow others. */
const RESET = '* { margin: 0; padding: 0; box-sizing: border-box } * + * { margin-top: 0.5em }';

for (const [width, more = ''] of /** @type {[number, string?][]} */ ([[375], [480], [640], [700], [760], [1024], [1280], [1920], [1280, RESET]])) {
  test(`nothing moves on a page with motion-widgets.css, ${width} px wide${more && ', and rules for all elements'}, from before the script until all is there`, FRESH, async ({ page }) => {
    // As high as needed for all of the page to be in sight: what moves out of sight does not count.
    await page.setViewportSize({ width, height: 6000 });
    await page.addInitScript(() => {
      const shifts = /** @type {number[]} */ ([]);
      Object.assign(window, { shifts });
      new PerformanceObserver((list) => {
        for (const entry of list.getEntries()) shifts.push(Reflect.get(entry, 'value'));
      }).observe({ type: 'layout-shift', buffered: true });
    });
    /** @type {() => void} */
    let arrive = () => {};
    const arrival = new Promise((resolve) => (arrive = () => resolve(undefined)));
    await page.route('**/motion-widgets.js', async (route) => {
      await arrival;
      await route.continue();
    });
    const loaded = show(page, RESERVED.map((name) => `<p>Before</p><${name}></${name}><p>After</p>`).join(''), {
      head: `<link rel="stylesheet" href="/motion-widgets.css"><style>body { font-family: ${FONTS[0][0]} } ${more}</style>`,
    });
    await page.waitForFunction((count) => document.querySelectorAll('body > p').length === count, 2 * RESERVED.length);
    await frames(page);
    const tops = () => page.locator('body > p').evaluateAll((all) => all.map((each) => each.getBoundingClientRect().top));
    const before = await tops();
    expect(await page.evaluate(() => document.querySelectorAll(':not(:defined)').length)).toBe(RESERVED.length);
    arrive();
    await loaded;
    for (const name of RESERVED) {
      await ready(page.locator(name));
      await expect(page.locator(name).locator('.folds')).toBeVisible();
    }
    await frames(page);
    expect(await tops()).toEqual(before);
    expect(await page.evaluate(() => Reflect.get(window, 'shifts'))).toEqual([]);
  });
}

/** What makes sentences and rows longer, by widget. @type {Record<string, Record<string, unknown>[]>} */
const STATES = {
  'banana-machine': ['velocity', 'odometry'].flatMap((model) =>
    ['straight', 'gentle', 'hard', 'pivot', 'banana', 'worked'].map((preset) => ({ preset, model })),
  ),
  'map-squeeze': [null, { name: 'a_map_with_quite_a_long_name', bounds: [0, 0, 6, 4], walls: [[3, 0, 3, 1.5]] }].flatMap((map) =>
    ['endpoint', 'whole-arc', 'sub-stepped'].flatMap((sampler) => [true, false].map((conditioned) => ({ map, sampler, conditioned }))),
  ),
  'dead-reckoning': ['chapter', 'fine', 'straight'].flatMap((preset) =>
    ['chapter', 'fourth-order'].flatMap((compounding) => [500, 50_000].map((samples) => ({ preset, compounding, samples }))),
  ),
  'odometry-decomposer': ['all', 'reverse', 'spin', 'rest'].flatMap((preset) =>
    ['table', 'nav2', 'omni'].map((rule) => ({ preset, rule })),
  ),
  'alpha-calibrator': ['table', 'omni', 'velocity'].flatMap((kind) =>
    [true, false].map((robust) => ({ ...(kind === 'velocity' ? { model: kind } : { rule: kind }), robust })),
  ),
};

for (const name of Object.keys(STATES)) {
  for (const lang of ['en', 'de']) {
    test(`${name} is at most 720 px high in the column of a book and on a screen, whatever it shows, in ${lang}`, async ({ page }) => {
      await page.setViewportSize({ width: 640, height: 720 });
      await show(page, `<${name} lang="${lang}"></${name}>`, {
        head: '<style>body { margin: 0 }</style>',
        script: '<script type="module" src="/motion-widgets.js"></script><script type="module" src="/de.js"></script>',
      });
      const widget = page.locator(name);
      await ready(widget);
      await expect(widget.locator('.folds')).toBeVisible();
      for (const state of STATES[name]) {
        await widget.evaluate((element, values) => void Object.assign(element, values), state);
        for (const width of [640, 700, 760, 1280]) {
          await page.setViewportSize({ width, height: 720 });
          await frames(page);
          const { height } = await boxOf(widget);
          expect(height, `${width} px, ${JSON.stringify(state)}`).toBeLessThanOrEqual(720);
          expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(width);
        }
      }
    });
  }
}

for (const name of RESERVED) {
  test(`as much room is kept for ${name} before its script has come`, FRESH, async ({ page }) => {
    await show(page, '', {
      head: '<style>body { margin: 0; font: 16px serif }</style>',
      script: '<script type="module" src="/external.js"></script>',
    });
    let come = () => {};
    const coming = new Promise((resolve) => (come = () => resolve(undefined)));
    await page.route('**/chunks/**', async (route) => {
      await coming;
      await route.continue();
    });
    await page.evaluate((tag) => {
      const element = document.createElement(tag);
      element.innerHTML = '<p style="height: 2000px">Meanwhile</p>';
      document.body.append(element);
    }, name);
    const widget = page.locator(name);
    const heights = async () => {
      const all = [];
      for (const width of [320, 700, 1280]) {
        await page.setViewportSize({ width, height: 900 });
        await frames(page);
        all.push((await boxOf(widget)).height);
      }
      return all;
    };
    const before = await heights();
    expect(await widget.evaluate((element) => element.matches(':defined'))).toBe(false);
    expect(Math.min(...before)).toBeGreaterThan(300);
    expect((await boxOf(widget.locator('p'))).y).toBe((await boxOf(widget)).y);
    expect(await widget.evaluate((element) => [getComputedStyle(element).display, getComputedStyle(element).position])).toEqual(['block', 'relative']);
    come();
    await ready(widget);
    expect(await heights()).toEqual(before);
  });
}
