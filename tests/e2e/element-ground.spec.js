import { expect } from '@playwright/test';
import { ALL, ready, show } from './element-support.js';
import { STILL, frames, pixelsOf, test } from './support.js';

/** @typedef {import('@playwright/test').Locator} Locator */

test.use(STILL);

/** Grounds and text of themes that books and sites have: what they compute to in a browser. */
const THEMES = {
  'mdBook, light': ['#ffffff', '#000000'],
  'mdBook, rust': ['#e1e1db', '#262625'],
  'mdBook, coal': ['#131516', '#98a3ad'],
  'mdBook, navy': ['#161923', '#bcbdd0'],
  'mdBook, ayu': ['#0f1419', '#c5c5c5'],
  'Furo, light': ['#ffffff', '#000000'],
  'Furo, dark': ['#131416', '#cfd0d0'],
  'pydata, light': ['#ffffff', '#222832'],
  'pydata, dark': ['#14181e', '#ced6dd'],
  'VitePress, light': ['#ffffff', '#3c3c43'],
  'VitePress, dark': ['#1b1b1f', '#dfdfd6'],
  'Docusaurus, light': ['#ffffff', '#1c1e21'],
  'Docusaurus, dark': ['#1b1b1d', '#e3e3e3'],
  'Starlight, light': ['#ffffff', '#353841'],
  'Starlight, dark': ['#17181c', '#c0c2c7'],
  'Vite, light': ['#ffffff', '#6b6375'],
  'Vite, dark': ['#16171d', '#9ca3af'],
  sepia: ['#f4ecd8', '#5b4636'],
};

/** Least contrast with the ground: of text, and of lines and dots. */
const CONTRAST = { ink: 4.5, muted: 4.5, prior: 4.5, prediction: 4.5, posterior: 4.5, accent: 4.5, cloud: 3, truth: 3 };

/**
 * What a figure's roles are on its surface.
 *
 * @param {Locator} widget
 * @param {string[]} roles
 * @returns {Promise<number[][]>} red, green, blue, 0 to 255
 */
async function coloursOf(widget, roles) {
  await frames(widget.page());
  return widget.evaluate((element, names) => {
    const context = /** @type {OffscreenCanvasRenderingContext2D} */ (new OffscreenCanvas(1, 1).getContext('2d', { willReadFrequently: true }));
    return names.map((name) => {
      const swatch = document.createElement('span');
      swatch.style.color = `var(--${name})`;
      element.shadowRoot?.querySelector('.surface')?.append(swatch);
      context.fillStyle = getComputedStyle(swatch).color;
      swatch.remove();
      context.fillRect(0, 0, 1, 1);
      return [...context.getImageData(0, 0, 1, 1).data.slice(0, 3)];
    });
  }, roles);
}

/** @param {Locator} widget @returns {Promise<string>} */
const paperOf = async (widget) => hex((await coloursOf(widget, ['paper']))[0]);

/** @param {number[]} channels */
const hex = (channels) => `#${channels.map((each) => each.toString(16).padStart(2, '0')).join('')}`;

/** WCAG's. @param {number[]} one @param {number[]} other */
function contrast(one, other) {
  const linear = (/** @type {number} */ c) => (c / 255 <= 0.04045 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4);
  const luminance = ([r, g, b] = one) => 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
  const [low, high] = [luminance(one), luminance(other)].sort((a, b) => a - b);
  return (high + 0.05) / (low + 0.05);
}

/** @param {Locator} widget */
const surfaceOf = (widget) =>
  widget.locator('.surface').evaluate((element) => {
    const { backgroundColor, color, fontFamily, fontSize, colorScheme } = getComputedStyle(element);
    return { backgroundColor, color, fontFamily, fontSize, colorScheme };
  });

for (const [theme, [ground, text]] of Object.entries(THEMES)) {
  test(`stands on the ground of ${theme}, in its ink and letters, and everything is legible`, async ({ page }) => {
    await show(page, '<banana-machine></banana-machine>', {
      head: `<style>body { background: ${ground}; color: ${text}; font: 17px 'DejaVu Sans', sans-serif }</style>`,
    });
    const widget = page.locator('banana-machine');
    await ready(widget);
    const { backgroundColor, fontFamily, fontSize } = await surfaceOf(widget);
    expect({ backgroundColor, fontFamily, fontSize }).toEqual({ backgroundColor: 'rgba(0, 0, 0, 0)', fontFamily: '"DejaVu Sans", sans-serif', fontSize: '17px' });
    const [paper, ink, ...others] = await coloursOf(widget, ['paper', ...Object.keys(CONTRAST)]);
    expect([paper, ink].map(hex)).toEqual([ground, text]);
    const reached = Object.fromEntries([ink, ...others].map((colour, i) => [Object.keys(CONTRAST)[i], contrast(colour, paper)]));
    for (const [role, least] of Object.entries(CONTRAST)) expect(reached[role], role).toBeGreaterThanOrEqual(least);
    expect(await pixelsOf(widget.locator('canvas.plane'), 'prior')).toBeGreaterThan(50);
    // Taken along, it has the ground with it.
    const svg = await widget.evaluate((element) => /** @type {any} */ (element).toSVG());
    expect(svg).toContain(`<rect width="100%" height="100%" fill="rgb(${paper.join(', ')})"/>`);
  });
}

test('what is muted has as much of the text as it takes to be legible, and hues as much black as the ground takes of the light', async ({ page }) => {
  await show(page, '<banana-machine></banana-machine>');
  const widget = page.locator('banana-machine');
  await ready(widget);
  const shares = [75, 80, 85, 90, 95];
  const seen = new Set();
  for (const [ground, text] of [[255, 0], [255, 60], [255, 80], [255, 89], [255, 98], [255, 106], [255, 130], [238, 1], [246, 2], [249, 3], [0, 255], [0, 150], [0, 128], [0, 157], [30, 145], [0, 9], [9, 255]]) {
    await page.evaluate(([ground, text]) => void (document.body.style.cssText = `background: rgb(${ground} ${ground} ${ground}); color: rgb(${text} ${text} ${text})`), [ground, text]);
    await frames(page);
    const [strength, shade] = await widget.locator('.surface').evaluate(({ style }) => ['--strength', '--shade'].map((name) => style.getPropertyValue(name)));
    const grey = (/** @type {number} */ channel) => [channel, channel, channel];
    // 4.5 by WCAG 2, and a little more for screens that round.
    const least = shares.find((share) => contrast(grey(ground + (share / 100) * (text - ground)), grey(ground)) >= 4.55) ?? 100;
    expect(strength, `${text} on ${ground}`).toBe(`${least}%`);
    seen.add(least);
    const light = ground / 255;
    const black = text < ground && light < 0.97 ? 100 * (1 - light ** 2.2) : 0;
    expect(Number.parseFloat(shade || '0'), `${text} on ${ground}`).toBeCloseTo(black, 6);
  }
  expect([...seen].sort()).toEqual([100, ...shares]);
});

test('the ground is the nearest, through shadow roots and what is half transparent', async ({ page }) => {
  await show(page, '<div id="card" style="background: rgb(0 0 0 / 50%)"></div>', {
    head: '<style>body { background: rgb(200 100 50); color: white }</style>',
  });
  await page.locator('#card').evaluate((card) => {
    card.attachShadow({ mode: 'open' }).innerHTML = '<section><slot></slot></section>';
    card.innerHTML = '<banana-machine></banana-machine>';
  });
  const widget = page.locator('banana-machine');
  await ready(widget);
  expect(await paperOf(widget)).toBe('#643219');
  await page.locator('#card').evaluate((card) => {
    card.shadowRoot?.querySelector('section')?.setAttribute('style', 'background: #eee; color: #111');
  });
  await expect.poll(() => paperOf(widget)).toBe('#eeeeee');
});

test('a ground that fades arrives where the page does, also where the text has come before', async ({ page }) => {
  await show(page, '<banana-machine></banana-machine>', {
    head: '<style>body { background: white; color: #222; transition: background-color 0.4s } .night body { background: #101418; color: #ddd }</style>',
  });
  const widget = page.locator('banana-machine');
  await ready(widget);
  for (const [night, ground] of /** @type {const} */ ([[true, '#101418'], [false, '#ffffff']])) {
    await page.evaluate((on) => document.documentElement.classList.toggle('night', on), night);
    await expect.poll(() => paperOf(widget)).toBe(ground);
  }
});

test('what fades elsewhere has nothing drawn', async ({ page }) => {
  await show(page, '<button>Elsewhere</button><banana-machine></banana-machine>', { head: '<style>button { transition: background-color 50ms }</style>' });
  await ready(page.locator('banana-machine'));
  await frames(page);
  const asked = await page.evaluate(async () => {
    const request = window.requestAnimationFrame;
    let count = 0;
    window.requestAnimationFrame = (callback) => {
      count++;
      return request(callback);
    };
    const button = /** @type {HTMLElement} */ (document.querySelector('button'));
    // The window hears of it last.
    const faded = new Promise((resolve) => addEventListener('transitionend', resolve, { once: true }));
    button.style.backgroundColor = 'rgb(1, 2, 3)';
    await faded;
    window.requestAnimationFrame = request;
    return count;
  });
  expect(asked).toBe(0);
});

test('a theme that its surroundings have not gives a figure paper and ink of its own', async ({ page }) => {
  const style = 'body { background: #fff; color: #333; --color-foreground-muted: #112233; --color-background-border: #445566 }';
  await show(page, '<banana-machine theme="dark"></banana-machine>', { head: `<style>${style}</style><link rel="stylesheet" href="/motion-widgets.css">` });
  const widget = page.locator('banana-machine');
  await ready(widget);
  expect(await surfaceOf(widget)).toMatchObject({ backgroundColor: 'rgb(22, 24, 27)', color: 'rgb(235, 233, 227)', colorScheme: 'dark' });
  // Neither do the page's other colours fit that paper.
  const ofPage = ['#112233', '#445566'];
  for (const colour of (await coloursOf(widget, ['muted', 'rule'])).map(hex)) expect(ofPage).not.toContain(colour);
  await widget.evaluate((element) => element.setAttribute('theme', 'light'));
  await expect.poll(() => surfaceOf(widget)).toMatchObject({ backgroundColor: 'rgba(0, 0, 0, 0)', color: 'rgb(51, 51, 51)', colorScheme: 'light' });
  expect((await coloursOf(widget, ['muted', 'rule'])).map(hex)).toEqual(ofPage);
});

/** What the stylesheet takes over, by the names that each theme has for it: what is muted, hairlines, and the header's height. */
const NAMES_OF_THEMES = {
  Docusaurus: ['--ifm-color-emphasis-700', '--ifm-color-emphasis-300', '--ifm-navbar-height'],
  VitePress: ['--vp-c-text-2', '--vp-c-border', '--vp-nav-height'],
  Starlight: ['--sl-color-gray-3', '--sl-color-hairline-light', '--sl-nav-height'],
  pydata: ['--pst-color-text-muted', '--pst-color-border', '--pst-header-height'],
  Furo: ['--color-foreground-muted', '--color-background-border', '--header-height'],
};

for (const [theme, [muted, rule, height]] of Object.entries(NAMES_OF_THEMES)) {
  test(`the stylesheet takes what is muted, hairlines and the header's height from ${theme}`, async ({ page }) => {
    await show(page, '<banana-machine></banana-machine>', {
      head: `<style>:root { ${muted}: #112233; ${rule}: #445566; ${height}: 60px }</style><link rel="stylesheet" href="/motion-widgets.css">`,
    });
    const widget = page.locator('banana-machine');
    await ready(widget);
    expect((await coloursOf(widget, ['muted', 'rule'])).map(hex)).toEqual(['#112233', '#445566']);
    const top = await widget.locator('.surface').evaluate((element) => {
      const probe = Object.assign(document.createElement('span'), { style: 'position: absolute; height: var(--top)' });
      element.append(probe);
      return probe.getBoundingClientRect().height;
    });
    expect(top).toBe(60);
  });
}

test('what a page says by --motion- counts, on :root and on the element, also beside the stylesheet', async ({ page }) => {
  const said = '--motion-muted: #010203; --motion-rule: #040506; --motion-sticky-top: 7px';
  for (const where of [':root', 'banana-machine']) {
    await show(page, '<banana-machine></banana-machine>', {
      head: `<style>${where} { ${said} } :root { --ifm-navbar-height: 60px } body { --color-foreground-muted: #0000ff; --color-background-border: #00ff00 }</style><link rel="stylesheet" href="/motion-widgets.css">`,
    });
    const widget = page.locator('banana-machine');
    await ready(widget);
    const look = async () => [...(await coloursOf(widget, ['muted', 'rule'])).map(hex), await widget.locator('.surface').evaluate((element) => getComputedStyle(element).getPropertyValue('--top'))];
    expect(await look()).toEqual(['#010203', '#040506', '7px']);
    await page.evaluate(() => document.querySelector('style')?.sheet?.deleteRule(0));
    expect(await look()).toEqual(['#0000ff', '#00ff00', '60px']);
  }
});

for (const name of ALL) {
  test(`${name} has a ground that covers where it has to, on paper that is --motion-paper`, async ({ page }) => {
    await show(page, `<${name} style="--motion-paper: #102030; --motion-ink: #f0f0f0"></${name}>`, { head: '<style>body { background: #fff; color: #000 }</style>' });
    const widget = page.locator(name);
    await ready(widget);
    // Light letters on dark paper: hues of the dark.
    expect(await surfaceOf(widget)).toMatchObject({ backgroundColor: 'rgb(16, 32, 48)', color: 'rgb(240, 240, 240)', colorScheme: 'dark' });
    expect(await widget.locator('.slider .effect').first().evaluate((element) => getComputedStyle(element).backgroundColor)).toBe('rgb(16, 32, 48)');
  });
}
