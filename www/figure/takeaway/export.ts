/** A figure to take along: its picture as PNG or SVG, and its samples as CSV. */

import { html } from 'lit';
import { words } from '../../messages/registry.ts';
import { inCss } from '../../scene/canvas.ts';
import { SvgContext, escaped, short } from '../../scene/svg.ts';
import { button } from '../../ui/controls.ts';
import type { Figure } from '../figure.ts';

/** Content for export besides the picture. */
export interface Takeaway {
  title: string;
  /** Description of the picture. */
  description: string;
  settings: object;
  /** Columns of the samples, with their units in their names. */
  columns: string[];
  /** Row of a sample. */
  row: (i: number) => number[];
  /** Count of the samples. */
  count: number;
  /** Sentence about the state that attributes cannot carry. */
  notInCode?: string;
}

/** Pixels of a PNG image a CSS pixel: as fine as a page in print wants a figure. */
const PNG_RATIO = 2;

/** CSS pixels of a figure that has no size, as in a closed tab. */
const SIZE = { width: 720, height: 432 };

/**
 * Draws the picture once more, as large as it is on the page and in its font.
 *
 * @param ratio pixels a CSS pixel
 */
function drawOn({ scene, pictures: [first], plate, stage }: Figure, ratio: number, makeContext: (size: { width: number, height: number }) => unknown) {
  const picture = plate ?? first;
  const canvas = stage.canvasOf(first);
  const box = canvas.clientWidth > 0 ? canvas.getBoundingClientRect() : SIZE;
  const [clientWidth, height] = plate ? inCss(plate.size, canvas) : [box.width, box.height];
  const size = { width: Math.round(ratio * clientWidth), height: Math.round(ratio * height) };
  const context = makeContext(size) as CanvasRenderingContext2D;
  const surface = { ...size, clientWidth, letters: getComputedStyle(canvas), getContext: () => context };
  picture.draw(surface, scene, stage.palette, { still: true, atOnce: true, exported: true });
  return { context, view: picture.view, ...size };
}

/** @returns with the paper that it is on */
export async function pngOf(element: Figure): Promise<Blob> {
  const image = document.createElement('canvas');
  const { context, width, height } = drawOn(element, PNG_RATIO, (size) => Object.assign(image, size).getContext('2d'));
  context.resetTransform();
  context.globalCompositeOperation = 'destination-over';
  context.fillStyle = element.stage.palette.paper;
  context.fillRect(0, 0, width, height);
  return new Promise((resolve, reject) => {
    image.toBlob((blob) => (blob ? resolve(blob) : reject(new Error('The browser makes no PNG image of it.'))));
  });
}

/** Tells figures apart whose ids would clash on one page, and is the same for the same figure. */
function hash(text: string) {
  let value = 7;
  for (let i = 0; i < text.length; i++) value = (Math.imul(value, 31) + text.charCodeAt(i)) >>> 0;
  return value.toString(36);
}

export function svgOf(element: Figure) {
  const { settings, title, description } = element.takeaway;
  const name = `figure-${hash(JSON.stringify(settings))}`;
  const svg = new SvgContext(name);
  const { view, width, height } = drawOn(element, 1, () => svg);
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${short(view.width)} ${short(view.height)}" direction="ltr" role="img" aria-labelledby="${name}-title ${name}-text">
<title id="${name}-title">${escaped(title)}</title>
<desc id="${name}-text">${escaped(description)}</desc>
<rect width="100%" height="100%" fill="${element.stage.palette.paper}"/>
${svg.markup}
</svg>
`;
}

/**
 * A line of settings behind a #, with the seed among them; a line of names; and a line a sample, with
 * as many digits as bring the same numbers back. Arrays print themselves with commas.
 */
export function csvOf({ takeaway: { settings, columns, row, count } }: Figure) {
  const lines = [`# ${JSON.stringify(settings)}`, columns, ...Array.from({ length: count }, (_, i) => row(i))];
  return `${lines.join('\n')}\n`;
}

/** Hands the reader a file. */
export function save(name: string, blob: Blob) {
  const link = Object.assign(document.createElement('a'), { href: URL.createObjectURL(blob), download: name });
  link.click();
  // The browser has taken it by then.
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}

/**
 * Returns the buttons that save the figure.
 *
 * @param mark that tells its files from those of another state
 * @param csvTitle what is in a CSV file, where that is no samples
 */
export function exportButtons(element: Figure, mark: string | number, csvTitle: string = words.exports.csvTitle) {
  const say = words.exports;
  const name = `${element.localName}-${mark}`;
  const text = (ending: string, type: string, content: string) =>
    save(`${name}.${ending}`, new Blob([content], { type }));
  return html`<fieldset class="exports" part="exports">
    <legend>${say.label}</legend>
    <div class="buttons">
      ${button(say.png, () => element.toPNG().then((blob) => save(`${name}.png`, blob), (error) => element.runtime.report(error)), { title: say.pngTitle })}
      ${button(say.svg, () => text('svg', 'image/svg+xml', element.toSVG()), { title: say.svgTitle })}
      ${button(say.csv, () => text('csv', 'text/csv', element.toCSV()), { title: csvTitle })}
    </div>
  </fieldset>`;
}
