import { expect } from '@playwright/test';
import axe from 'axe-core';
import { REDUCED_MOTION, readColours, mountFigure, countPixelsOfRole, showPage, test, openDisclosures, waitUntilReady } from './support.js';

/** @typedef {import('@playwright/test').Locator} Locator */

test.use(REDUCED_MOTION);

/** Computed colours of the background and the text, of themes for books and sites. Of eighteen themes, these have the highest and the lowest contrasts. */
const THEME_COLORS = {
  'mdBook, light': ['#ffffff', '#000000'],
  'mdBook, rust': ['#e1e1db', '#262625'],
  'mdBook, coal': ['#131516', '#98a3ad'],
  'mdBook, ayu': ['#0f1419', '#c5c5c5'],
  'VitePress, light': ['#ffffff', '#3c3c43'],
  'Docusaurus, dark': ['#1b1b1d', '#e3e3e3'],
  'Vite, light': ['#ffffff', '#6b6375'],
  'Vite, dark': ['#16171d', '#9ca3af'],
  sepia: ['#f4ecd8', '#5b4636'],
};

/** Minimum contrast of text, lines and dots with the background. */
const MIN_CONTRAST = { ink: 4.5, muted: 4.5, prior: 4.5, prediction: 4.5, posterior: 4.5, accent: 4.5, cloud: 3, truth: 3 };

/** Returns the background colour of a figure as hexadecimal digits. @param {Locator} widget @returns {Promise<string>} */
const readPaperColor = async (widget) => toHexColor((await readColours(widget, ['paper']))[0]);

/** @param {number[]} colorChannels */
const toHexColor = (colorChannels) => `#${colorChannels.map((colorChannel) => colorChannel.toString(16).padStart(2, '0')).join('')}`;

const { Color, getContrast } = /** @type {any} */ (axe).commons.color;
/** Returns the contrast of two colours by WCAG. @param {number[]} firstChannels @param {number[]} secondChannels @returns {number} */
const contrastOf = (firstChannels, secondChannels) => getContrast(new Color(...firstChannels), new Color(...secondChannels));

/** Returns computed styles of the surface of a figure. @param {Locator} widget */
const readSurfaceStyle = (widget) =>
  widget.locator('.surface').evaluate((element) => {
    const { backgroundColor, color, fontFamily, fontSize, colorScheme } = getComputedStyle(element);
    return { backgroundColor, color, fontFamily, fontSize, colorScheme };
  });

/** Returns the colour scheme of a figure, judged by the lightness of its background. @param {Locator} widget */
const readColorScheme = async (widget) => ((await readColours(widget, ['paper']))[0][0] > 128 ? 'light' : 'dark');

/** Sources of a figure's colour scheme. Each has a name, the head of the page, and a script that sets a scheme. */
const SCHEME_SOURCES = /** @type {[string, string, (scheme: 'light' | 'dark') => string][]} */ ([
  ['the inherited color-scheme', '<style>body { color: #333 }</style>', (schemeName) => `document.body.style.colorScheme = '${schemeName}'`],
  [
    'colours that a page switches',
    '<style>body { background: white; color: #222 } .night body { background: #111; color: oklch(0.9 0 0) }</style>',
    (schemeName) => `document.documentElement.classList.toggle('night', ${schemeName === 'dark'})`,
  ],
  ['its theme attribute', '<style>:root { color-scheme: light }</style>', (schemeName) => `document.querySelector('#it').theme = '${schemeName}'`],
]);

for (const [sourceName, headHtml, schemeScriptOf] of SCHEME_SOURCES) {
  test(`a figure follows ${sourceName}`, async ({ page, figureName }) => {
    const widget = await mountFigure(page, figureName, { attributes: 'id="it"', headHtml });
    expect(await readColorScheme(widget)).toBe('light');
    for (const scheme of /** @type {const} */ (['dark', 'light'])) {
      await page.evaluate(schemeScriptOf(scheme));
      await expect.poll(() => readColorScheme(widget)).toBe(scheme);
      // The canvas has the colours of the current theme.
      await expect.poll(() => countPixelsOfRole(widget.locator('canvas.plane'), 'prior')).toBeGreaterThan(50);
    }
  });
}

test('a figure follows the system’s colour scheme if the page does', async ({ page, figureName }) => {
  await page.emulateMedia({ colorScheme: 'dark' });
  const widget = await mountFigure(page, figureName, { headHtml: '<style>:root { color-scheme: light dark }</style>' });
  expect(await readColorScheme(widget)).toBe('dark');
  await page.emulateMedia({ colorScheme: 'light' });
  await expect.poll(() => readColorScheme(widget)).toBe('light');
});

test('on the background of any theme, a figure has the page’s text colour and font, and enough contrast', async ({ page }) => {
  const widget = await mountFigure(page, 'banana-machine', { headHtml: "<style>body { font: 17px 'DejaVu Sans', sans-serif }</style>" });
  const { backgroundColor, fontFamily, fontSize } = await readSurfaceStyle(widget);
  expect({ backgroundColor, fontFamily, fontSize }).toEqual({ backgroundColor: 'rgba(0, 0, 0, 0)', fontFamily: '"DejaVu Sans", sans-serif', fontSize: '17px' });
  for (const [themeName, [backgroundColor, textColor]] of Object.entries(THEME_COLORS)) {
    await page.evaluate(([pageBackground, pageColor]) => Object.assign(document.body.style, { background: pageBackground, color: pageColor }), [backgroundColor, textColor]);
    await expect.poll(async () => (await readColours(widget, ['paper', 'ink'])).map(toHexColor), themeName).toEqual([backgroundColor, textColor]);
    const [paperColour, ...roleColours] = await readColours(widget, ['paper', ...Object.keys(MIN_CONTRAST)]);
    for (const [i, [colorRole, minContrast]] of Object.entries(MIN_CONTRAST).entries()) {
      expect.soft(contrastOf(roleColours[i], paperColour), `${colorRole} on ${themeName}`).toBeGreaterThanOrEqual(minContrast);
    }
  }
  expect(await countPixelsOfRole(widget.locator('canvas.plane'), 'prior')).toBeGreaterThan(50);
  // An exported picture has the background of the page.
  const svgText = await widget.evaluate((element) => /** @type {any} */ (element).toSVG());
  expect(svgText).toContain('<rect width="100%" height="100%" fill="rgb(244, 236, 216)"/>');
});

test('a figure uses the nearest opaque background, through shadow roots and translucent elements @nightly', async ({ page }) => {
  await showPage(page, '<div id="card" style="background: rgb(0 0 0 / 50%)"></div>', {
    headHtml: '<style>body { background: rgb(200 100 50); color: white }</style>',
  });
  await page.locator('#card').evaluate((cardElement) => {
    cardElement.attachShadow({ mode: 'open' }).innerHTML = '<section><slot></slot></section>';
    cardElement.innerHTML = '<banana-machine></banana-machine>';
  });
  const widget = page.locator('banana-machine');
  await waitUntilReady(widget);
  expect(await readPaperColor(widget)).toBe('#643219');
  await page.locator('#card').evaluate((cardElement) => {
    cardElement.shadowRoot?.querySelector('section')?.setAttribute('style', 'background: #eee; color: #111');
  });
  await expect.poll(() => readPaperColor(widget)).toBe('#eeeeee');
});

test('after a transition of the page’s background, a figure has the final colours, even if the text colour changed earlier @nightly', async ({ page }) => {
  await showPage(page, '<banana-machine></banana-machine>', {
    headHtml: '<style>body { background: white; color: #222; transition: background-color 0.4s } .night body { background: #101418; color: #ddd }</style>',
  });
  const widget = page.locator('banana-machine');
  await waitUntilReady(widget);
  for (const [isNightThemeOn, expectedPaper] of /** @type {const} */ ([[true, '#101418'], [false, '#ffffff']])) {
    await page.evaluate((isNightClassOn) => document.documentElement.classList.toggle('night', isNightClassOn), isNightThemeOn);
    await expect.poll(() => readPaperColor(widget)).toBe(expectedPaper);
  }
});

test('a figure within light text on a background image gets a dark background @nightly', async ({ page }) => {
  const widget = await mountFigure(page, 'banana-machine', { headHtml: '<style>body { background: linear-gradient(#222, #333); color: #eee }</style>' });
  expect((await readColours(widget, ['paper']))[0]).toEqual([18, 18, 18]);
});

/** Pages with black text on a dark background. The colours come from forced colours of the system, or from the page's own scheme. */
const DARK_PAGES_WITH_BLACK_TEXT = /** @type {[string, Parameters<import('@playwright/test').Page['emulateMedia']>[0], string][]} */ ([
  ['black text in forced dark colours', { forcedColors: 'active', colorScheme: 'dark' }, 'body { background: white; color: black }'],
  ['black text in a dark scheme', { colorScheme: 'dark' }, ':root { color-scheme: light dark } body { color: #000 }'],
]);

for (const [situationName, emulatedMedia, pageStyle] of DARK_PAGES_WITH_BLACK_TEXT) {
  test(`a figure on a page with ${situationName} is legible`, async ({ page, figureName }) => {
    await page.emulateMedia(emulatedMedia);
    const widget = await mountFigure(page, figureName, { attributes: 'theme="auto"', headHtml: `<style>${pageStyle}</style>` });
    const setTheme = (/** @type {string} */ themeName) => widget.evaluate((element, newTheme) => element.setAttribute('theme', newTheme), themeName);
    for (const themeName of emulatedMedia?.forcedColors ? ['auto', 'light', 'dark'] : ['auto']) {
      await setTheme(themeName);
      const [paperColour, ...roleColours] = await readColours(widget, ['paper', ...Object.keys(MIN_CONTRAST)]);
      for (const [i, [colorRole, minContrast]] of Object.entries(MIN_CONTRAST).entries()) {
        expect.soft(contrastOf(roleColours[i], paperColour), `${colorRole} in ${themeName}`).toBeGreaterThanOrEqual(minContrast);
      }
    }
    expect(await countPixelsOfRole(widget.locator('canvas.plane'), 'prior')).toBeGreaterThan(50);
  });
}

test('a figure whose theme differs from the page’s has its own background and text colours @nightly', async ({ page }) => {
  const pageStyle = 'body { background: #fff; color: #333; --color-foreground-muted: #112233; --color-background-border: #445566 }';
  const widget = await mountFigure(page, 'banana-machine', { attributes: 'theme="dark"', headHtml: `<style>${pageStyle}</style><link rel="stylesheet" href="/motion-widgets.css">` });
  expect(await readSurfaceStyle(widget)).toMatchObject({ backgroundColor: 'rgb(22, 24, 27)', color: 'rgb(235, 233, 227)', colorScheme: 'dark' });
  // The page's colours for muted text and rules do not suit the dark background of the figure. The figure must not use them.
  const pageColors = ['#112233', '#445566'];
  for (const figureColour of (await readColours(widget, ['muted', 'rule'])).map(toHexColor)) expect(pageColors).not.toContain(figureColour);
  await widget.evaluate((element) => element.setAttribute('theme', 'light'));
  await expect.poll(() => readSurfaceStyle(widget)).toMatchObject({ backgroundColor: 'rgba(0, 0, 0, 0)', color: 'rgb(51, 51, 51)', colorScheme: 'light' });
  expect((await readColours(widget, ['muted', 'rule'])).map(toHexColor)).toEqual(pageColors);
});

/** Custom properties of themes for muted text, hairlines and the height of the header. The stylesheet of the figures uses them. */
const THEME_PROPERTIES = {
  Docusaurus: ['--ifm-color-emphasis-700', '--ifm-color-emphasis-300', '--ifm-navbar-height'],
  VitePress: ['--vp-c-text-2', '--vp-c-border', '--vp-nav-height'],
  Starlight: ['--sl-color-gray-3', '--sl-color-hairline-light', '--sl-nav-height'],
  pydata: ['--pst-color-text-muted', '--pst-color-border', '--pst-header-height'],
  Furo: ['--color-foreground-muted', '--color-background-border', '--header-height'],
};

test('the stylesheet adopts a theme’s colours of muted text and hairlines and its header height, and --motion- properties override them', async ({ page }) => {
  const widget = await mountFigure(page, 'banana-machine', { headHtml: '<link rel="stylesheet" href="/motion-widgets.css">' });
  const readStyleFromTheme = async () => [
    ...(await readColours(widget, ['muted', 'rule'])).map(toHexColor),
    await widget.locator('.surface').evaluate((element) => {
      const heightProbe = Object.assign(document.createElement('span'), { style: 'position: absolute; height: var(--top)' });
      element.append(heightProbe);
      const { height } = heightProbe.getBoundingClientRect();
      heightProbe.remove();
      return height;
    }),
  ];
  const setStyle = (/** @type {string} */ styleText) => page.evaluate((cssText) => void (document.documentElement.style.cssText = cssText), styleText);
  for (const [themeName, [mutedProperty, ruleProperty, heightProperty]] of Object.entries(THEME_PROPERTIES)) {
    await setStyle(`${mutedProperty}: #112233; ${ruleProperty}: #445566; ${heightProperty}: 60px`);
    expect.soft(await readStyleFromTheme(), themeName).toEqual(['#112233', '#445566', 60]);
  }
  await setStyle('--ifm-navbar-height: 60px; --motion-muted: #010203; --motion-rule: #040506; --motion-sticky-top: 7px');
  expect(await readStyleFromTheme()).toEqual(['#010203', '#040506', 7]);
});

test('--motion-paper and --motion-ink set the background and text colours of a figure', async ({ page, figureName }) => {
  const widget = await mountFigure(page, figureName, { attributes: 'style="--motion-paper: #102030; --motion-ink: #f0f0f0"', headHtml: '<style>body { background: #fff; color: #000 }</style>' });
  // A page with light text on a dark background gets the dark palette.
  expect(await readSurfaceStyle(widget)).toMatchObject({ backgroundColor: 'rgb(16, 32, 48)', color: 'rgb(240, 240, 240)', colorScheme: 'dark' });
  expect(await widget.locator('.slider .effect').first().evaluate((element) => getComputedStyle(element).backgroundColor)).toBe('rgb(16, 32, 48)');
});

test('custom properties colour controls and canvases, also when they change', async ({ page }) => {
  const widget = await mountFigure(page, 'banana-machine');
  const planeCanvas = widget.locator('canvas.plane');
  await page.addStyleTag({ content: 'banana-machine { --motion-posterior: rgb(200, 20, 90); --motion-font: monospace }' });
  await expect.poll(() => countPixelsOfRole(planeCanvas, 'posterior')).toBeGreaterThan(100);
  expect(await widget.evaluate((element) => getComputedStyle(element).fontFamily)).toBe('monospace');
});

test('no control has inline custom properties, because browser extensions for dark mode would keep their old values', async ({ page, figureName }) => {
  const widget = await mountFigure(page, figureName);
  await openDisclosures(widget);
  expect(await widget.locator('.simulation [style*="--"]').count()).toBe(0);
  const sliderColours = await widget.locator('.slider input[type=range]').evaluateAll((sliderElements) => sliderElements.map((sliderElement) => getComputedStyle(sliderElement).accentColor));
  expect(sliderColours.length).toBeGreaterThan(3);
  expect(sliderColours).not.toContain('auto');
});
