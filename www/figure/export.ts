/** Export of a figure: its picture as PNG or SVG, and its samples as CSV. */

import { html } from 'lit';
import { words } from '../messages/registry.ts';
import { inCss } from '../scene/canvas.ts';
import { SvgContext, escaped, short } from '../scene/svg.ts';
import { button } from '../ui/controls.ts';
import { nameOf } from './surface.ts';
import type { Figure } from './figure.ts';

/** Content for export besides the picture. */
export interface ExportData {
  description: string;
  /** Settings, which the tag of the element precedes. */
  settings: object;
  /** Names of the columns, with units. */
  columns: string[];
  row: (i: number) => number[];
  /** Number of samples. */
  count: number;
  /** Sentence about state that neither a link nor attributes can carry. */
  notInCopies?: string;
}

/** Pixels of a PNG image per CSS pixel, fine enough for print. */
const PNG_RATIO = 2;

/** Size in CSS pixels of a figure without layout, such as in a hidden tab panel. */
const SIZE = { width: 720, height: 432 };

/** Draws the picture in its size and font on the page, with `ratio` pixels per CSS pixel. Returns the size in pixels and the view. */
function draw({ scene, pictures: [first], exportPicture, canvases, colours }: Figure, ratio: number, contextOf: (size: { width: number, height: number }) => unknown) {
  const picture = exportPicture ?? first;
  const canvas = canvases.of(first);
  const box = canvas.clientWidth > 0 ? canvas.getBoundingClientRect() : SIZE;
  const [clientWidth, height] = exportPicture ? inCss(exportPicture.size, canvas) : [box.width, box.height];
  const size = { width: Math.round(ratio * clientWidth), height: Math.round(ratio * height) };
  const surface = { ...size, clientWidth, letters: getComputedStyle(canvas), context: contextOf(size) as CanvasRenderingContext2D };
  picture.draw(surface, scene, colours.palette, { still: true, atOnce: true, exported: true });
  return { view: picture.view, ...size };
}

/** Returns a PNG image with the background. */
export async function pngOf(element: Figure): Promise<Blob> {
  const image = document.createElement('canvas');
  const context = image.getContext('2d') as CanvasRenderingContext2D;
  draw(element, PNG_RATIO, (size) => Object.assign(image, size) && context);
  context.resetTransform();
  context.globalCompositeOperation = 'destination-over';
  context.fillStyle = element.colours.palette.paper;
  context.fillRect(0, 0, image.width, image.height);
  return new Promise((resolve, reject) => {
    image.toBlob((blob) => (blob ? resolve(blob) : reject(new Error('The browser makes no PNG image of it.'))));
  });
}

/** Returns a hash that makes ids unique on a page, and equal for equal figures. */
function hash(text: string) {
  let value = 7;
  for (let i = 0; i < text.length; i++) value = (Math.imul(value, 31) + text.charCodeAt(i)) >>> 0;
  return value.toString(36);
}

const settingsText = ({ localName }: Figure, settings: object) => JSON.stringify({ element: localName, ...settings });

export function svgOf(element: Figure) {
  const { settings, description } = element.exportData;
  const name = `figure-${hash(settingsText(element, settings))}`;
  const svg = new SvgContext(name);
  const { view, width, height } = draw(element, 1, () => svg);
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${short(view.width)} ${short(view.height)}" direction="ltr" role="img" aria-labelledby="${name}-title ${name}-text">
<title id="${name}-title">${escaped(nameOf(element))}</title>
<desc id="${name}-text">${escaped(description)}</desc>
<rect width="100%" height="100%" fill="${element.colours.palette.paper}"/>
${svg.markup}
</svg>
`;
}

/** Returns CSV: a comment with settings and seed, a header, and a line for each sample with all digits. */
export function csvOf(element: Figure) {
  const { settings, columns, row, count } = element.exportData;
  const lines = [`# ${settingsText(element, settings)}`, columns, ...Array.from({ length: count }, (_, i) => row(i))];
  return `${lines.join('\n')}\n`;
}

/** Downloads a file. */
export function save(name: string, blob: Blob) {
  const link = Object.assign(document.createElement('a'), { href: URL.createObjectURL(blob), download: name });
  link.click();
  // The address is released after a minute, when the download has started.
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}

/** Returns the buttons that save the figure; `mark` distinguishes file names of states. */
export function exportButtons(element: Figure, mark: string | number, csvTitle: string = words.exports.csvTitle) {
  const say = words.exports;
  const name = `${element.localName}-${mark}`;
  const text = (ending: string, type: string, content: string) => save(`${name}.${ending}`, new Blob([content], { type }));
  return html`<fieldset class="exports" part="exports">
    <legend>${say.label}</legend>
    <div class="buttons">
      ${button(say.png, () => element.toPNG().then((blob) => save(`${name}.png`, blob), (error) => element.runtime.report(error)), { title: say.pngTitle })}
      ${button(say.svg, () => text('svg', 'image/svg+xml', element.toSVG()), { title: say.svgTitle })}
      ${button(say.csv, () => text('csv', 'text/csv', element.toCSV()), { title: csvTitle })}
    </div>
  </fieldset>`;
}
