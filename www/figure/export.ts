/** Export of a figure: its picture as PNG or SVG, its samples as CSV, and texts to copy, such as a link or its HTML. */

import { html } from 'lit';
import { address, isClassic } from '../address.ts';
import { words } from '../messages/registry.ts';
import { SvgContext, escapeXml, formatLength } from '../scene/svg.ts';
import { button, group } from '../ui/controls.ts';
import { nameOf } from './surface.ts';
import type { Figure } from './figure.ts';

export interface ExportData {
  description: string;
  /** Settings that are exported, after the tag of the element. */
  settings: object;
  /** Numbers of the table, row after row, by the names of their columns in one text, such as 'x_m y_m theta_rad'. */
  columns: Record<string, ArrayLike<number>>;
  /** Sentences about a copied link and about copied attributes, such as on state that they lack. */
  linkNote?: string;
  codeNote?: string;
}

/** Pixels of a PNG image per CSS pixel, fine enough for print. */
const PNG_RATIO = 2;

/** Size in CSS pixels of a figure without layout, such as in a hidden tab panel. */
const DEFAULT_SIZE = { width: 720, height: 432 };

/** Draws the picture in its size and font on the page, with `ratio` pixels per CSS pixel. Returns the size in pixels and the view. */
function drawScene({ scene, pictures: [picture], canvases, colours }: Figure, ratio: number, contextOf: (size: { width: number, height: number }) => unknown) {
  const pageCanvas = canvases.canvasOf(picture);
  const { width: clientWidth, height } = pageCanvas.clientWidth > 0 ? pageCanvas.getBoundingClientRect() : DEFAULT_SIZE;
  const canvasSize = { width: Math.round(ratio * clientWidth), height: Math.round(ratio * height) };
  const surface = { ...canvasSize, clientWidth, fontStyle: getComputedStyle(pageCanvas), context: contextOf(canvasSize) as CanvasRenderingContext2D };
  picture.draw(surface, scene, colours.palette, { still: true, atOnce: true, exported: true });
  return { view: picture.view, ...canvasSize };
}

export async function pngOf(element: Figure): Promise<Blob> {
  const image = new OffscreenCanvas(1, 1);
  const context = image.getContext('2d') as OffscreenCanvasRenderingContext2D;
  drawScene(element, PNG_RATIO, (size) => Object.assign(image, size) && context);
  context.resetTransform();
  context.globalCompositeOperation = 'destination-over';
  context.fillStyle = element.colours.palette.paper;
  context.fillRect(0, 0, image.width, image.height);
  return image.convertToBlob();
}

/** Returns a hash that makes ids unique on a page, and equal for equal figures. */
function hashOf(text: string) {
  let hashValue = 7;
  for (let i = 0; i < text.length; i++) hashValue = (Math.imul(hashValue, 31) + text.charCodeAt(i)) >>> 0;
  return hashValue.toString(36);
}

const settingsText = ({ localName }: Figure, settings: object) => JSON.stringify({ element: localName, ...settings });

export function svgOf(element: Figure) {
  const { settings, description } = element.exportData;
  const baseName = `figure-${hashOf(settingsText(element, settings))}`;
  const svg = new SvgContext(baseName);
  const { view, width, height } = drawScene(element, 1, () => svg);
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${formatLength(view.width)} ${formatLength(view.height)}" direction="ltr" role="img" aria-labelledby="${baseName}-title ${baseName}-text">
<title id="${baseName}-title">${escapeXml(nameOf(element))}</title>
<desc id="${baseName}-text">${escapeXml(description)}</desc>
<rect width="100%" height="100%" fill="${element.colours.palette.paper}"/>
${svg.markup}
</svg>
`;
}

/** Returns CSV: a comment with settings and seed, a header, and a line for each sample with all digits. */
export function csvOf(element: Figure) {
  const { settings, columns } = element.exportData;
  const columnGroups = Object.entries(columns).map(([names, numbers]) => ({ names: names.split(' '), numbers }));
  const rowAt = (i: number) => columnGroups.flatMap(({ names, numbers }) => names.map((_, column) => numbers[names.length * i + column]));
  const rows = Array.from({ length: columnGroups[0].numbers.length / columnGroups[0].names.length }, (_, i) => rowAt(i));
  const csvLines = [`# ${settingsText(element, settings)}`, columnGroups.flatMap(({ names }) => names), ...rows];
  return `${csvLines.join('\n')}\n`;
}

export function downloadFile(name: string, blob: Blob) {
  const downloadLink = Object.assign(document.createElement('a'), { href: URL.createObjectURL(blob), download: name });
  downloadLink.click();
  // The address is released after a minute, when the download has started.
  setTimeout(() => URL.revokeObjectURL(downloadLink.href), 60_000);
}

/** Returns the buttons that save the figure. `fileNameMark` is part of the file names, so that files of different states differ in name. */
export function exportButtons(element: Figure, fileNameMark: string | number, csvTitle: string = words.exports.csvTitle) {
  const exportWords = words.exports;
  const baseName = `${element.localName}-${fileNameMark}`;
  const saveText = (ending: string, type: string, content: string) => downloadFile(`${baseName}.${ending}`, new Blob([content], { type }));
  return group(exportWords.label, html`<div class="buttons">
    ${button(exportWords.png, () => element.toPNG().then((blob) => downloadFile(`${baseName}.png`, blob), (error) => element.runtime.report(error)), { title: exportWords.pngTitle })}
    ${button(exportWords.svg, () => saveText('svg', 'image/svg+xml', element.toSVG()), { title: exportWords.svgTitle })}
    ${button(exportWords.csv, () => saveText('csv', 'text/csv', element.toCSV()), { title: csvTitle })}
  </div>`, 'exports', 'exports');
}

/** Returns a button that copies a text. A notice says so, with a note such as on the parts of the state that the text lacks. */
export function copyButton(figure: Figure, label: string, textOf: () => string | Promise<string>, options: { title?: string, disabled?: boolean }, noteOf: () => string | undefined = () => '') {
  const copyText = async () => {
    const text = await textOf();
    // Frames without permission may not use the clipboard. Pages without HTTPS do not have it.
    const isCopied = await Promise.resolve(navigator.clipboard?.writeText(text).then(() => true)).catch(() => false);
    const note = noteOf() ?? '';
    figure.notice.show(() => (isCopied
      ? `${words.copies.done} ${note}`
      : html`${words.copies.byHand} ${note} <textarea readonly rows="3" aria-label=${words.copies.byHand} .value=${text}></textarea>`));
  };
  return button(label, copyText, options);
}

export const linkButton = (figure: Figure) =>
  copyButton(figure, words.copies.link, () => figure.shareLink(), { title: words.copies.linkTitle }, () => figure.exportData.linkNote);

export function embeddingControls(figure: Figure) {
  const { label, code, codeTitle } = words.copies;
  const codeButton = copyButton(figure, code, () => figure.embedCode(), { title: codeTitle }, () => figure.exportData.codeNote);
  return group(label, html`<div class="buttons">${codeButton}</div>`, 'copies', 'copies');
}

/** Address of the published script, used if the address of this script is unknown. */
const PUBLISHED_SCRIPT = 'https://cdn.jsdelivr.net/npm/motion-widgets@0.1/dist/external.js';

/** Returns HTML for any page: the script, and the tag with the attributes that differ from the defaults. */
export function embeddingHtml(figure: Figure) {
  const pageAttributes = ['theme', 'lang', 'dir'].map((name) => [name, figure.getAttribute(name) ?? ''] as [string, string]);
  const stateAttributes = figure.simulation ? figure.reflection.neededAttributes() : [];
  // Addresses of local files and inline scripts do not work on other pages.
  const isWebAddress = /^https?:/.test(address);
  const scriptType = (isWebAddress && isClassic ? ['defer', ''] : ['type', 'module']) as [string, string];
  const scriptTag = tagHtml('script', [scriptType, ['src', isWebAddress ? address : PUBLISHED_SCRIPT]]);
  return `${scriptTag}\n${tagHtml(figure.localName, [...pageAttributes.filter(([, text]) => text !== ''), ...stateAttributes])}\n`;
}

function tagHtml(name: string, attributes: [string, string][]) {
  return `<${name}${attributes.map(([key, text]) => (text === '' ? ` ${key}` : ` ${key}="${escapeXml(text)}"`)).join('')}></${name}>`;
}
