/**
 * A figure to take along: its picture as PNG or SVG, and its samples as CSV.
 *
 * @module
 */

import { html } from 'lit';
import { words } from '../../messages/registry.js';
import { button } from '../../ui/controls.js';
import { SvgContext, escaped } from '../../scene/svg.js';

/**
 * @typedef {import('../../ui/theme.js').Palette} Palette
 * @typedef {import('../../scene/canvas.js').Surface} Surface
 *
 * @typedef {object} Figure what there is to take along
 * @property {HTMLCanvasElement} canvas where it is shown
 * @property {Palette} palette
 * @property {(surface: Surface) => void} paint draws the same once more
 * @property {object} settings
 * @property {string} title
 * @property {string[]} columns of the samples, with their units in their names
 * @property {(i: number) => number[]} row of a sample
 * @property {number} count of the samples
 */

/** Pixels of a PNG image a CSS pixel: as fine as a page in print wants a figure. */
const PNG_RATIO = 2;

/** CSS pixels of a figure that has no size, as in a closed tab. */
const SIZE = { width: 720, height: 432 };

/**
 * @param {Figure} figure
 * @param {number} ratio pixels a CSS pixel
 * @param {() => unknown} getContext
 * @returns {Surface} one that is as large as the canvas, and has its font
 */
function surfaceLike({ canvas }, ratio, getContext) {
  const { width, height } = canvas.clientWidth > 0 ? canvas.getBoundingClientRect() : SIZE;
  const { fontFamily, fontSize } = getComputedStyle(canvas);
  const context = /** @type {() => CanvasRenderingContext2D} */ (getContext);
  const font = `${fontSize} ${fontFamily}`;
  return { width: Math.round(ratio * width), height: Math.round(ratio * height), clientWidth: width, font, getContext: context };
}

/**
 * @param {Figure} figure
 * @returns {Promise<Blob>} with the paper that it is on
 */
export async function pngOf(figure) {
  const canvas = document.createElement('canvas');
  const context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d'));
  const surface = surfaceLike(figure, PNG_RATIO, () => context);
  Object.assign(canvas, { width: surface.width, height: surface.height });
  figure.paint(surface);
  context.resetTransform();
  context.globalCompositeOperation = 'destination-over';
  context.fillStyle = figure.palette.paper;
  context.fillRect(0, 0, canvas.width, canvas.height);
  return new Promise((resolve, reject) => {
    canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error('The browser makes no PNG image of it.'))));
  });
}

/**
 * Tells figures apart whose ids would clash on one page, and is the same for the same figure.
 *
 * @param {string} text
 */
function hash(text) {
  let value = 7;
  for (let i = 0; i < text.length; i++) value = (Math.imul(value, 31) + text.charCodeAt(i)) >>> 0;
  return value.toString(36);
}

/** @param {Figure} figure */
export function svgOf(figure) {
  const name = `figure-${hash(JSON.stringify(figure.settings))}`;
  const context = new SvgContext(name);
  const surface = surfaceLike(figure, 1, () => context);
  figure.paint(surface);
  const { width, height } = surface;
  const description = figure.canvas.getAttribute('aria-label') ?? '';
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}" role="img" aria-labelledby="${name}-title ${name}-text">
<title id="${name}-title">${escaped(figure.title)}</title>
<desc id="${name}-text">${escaped(description)}</desc>
<rect width="100%" height="100%" fill="${figure.palette.paper}"/>
${context.markup}
</svg>
`;
}

/**
 * A line of settings behind a #, with the seed among them; a line of names; and a line a sample, with
 * as many digits as bring the same numbers back. Arrays print themselves with commas.
 *
 * @param {Figure} figure
 */
export function csvOf({ settings, columns, row, count }) {
  const lines = [`# ${JSON.stringify(settings)}`, columns, ...Array.from({ length: count }, (_, i) => row(i))];
  return `${lines.join('\n')}\n`;
}

/**
 * Hands the reader a file.
 *
 * @param {string} name
 * @param {Blob} blob
 */
function save(name, blob) {
  const link = Object.assign(document.createElement('a'), { href: URL.createObjectURL(blob), download: name });
  link.click();
  // The browser has taken it by then.
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}

/**
 * The menu from which a reader saves the figure.
 *
 * @param {{ localName: string, toPNG: () => Promise<Blob>, toSVG: () => string, toCSV: () => string }} element
 * @param {number} seed
 */
export function exportMenu(element, seed) {
  const say = words.exports;
  const name = `${element.localName}-${seed}`;
  const text = (/** @type {string} */ ending, /** @type {string} */ type, /** @type {string} */ content) =>
    save(`${name}.${ending}`, new Blob([content], { type }));
  return html`<details class="exports" part="exports">
    <summary>${say.label}</summary>
    <div class="buttons">
      ${button(say.png, async () => save(`${name}.png`, await element.toPNG()), { title: say.pngTitle })}
      ${button(say.svg, () => text('svg', 'image/svg+xml', element.toSVG()), { title: say.svgTitle })}
      ${button(say.csv, () => text('csv', 'text/csv', element.toCSV()), { title: say.csvTitle })}
    </div>
  </details>`;
}
