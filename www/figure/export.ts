/** Export of a figure: its picture as PNG or SVG, its samples as CSV, and texts to copy, such as a link or its HTML. */

import { html } from 'lit';
import { address, isClassic } from '../address.ts';
import { words } from '../messages/registry.ts';
import { SvgContext, escapeXml, formatLength } from '../scene/svg.ts';
import { buttonHtml, fieldsetHtml } from '../ui/controls.ts';
import { accessibleNameOf } from './surface.ts';
import type { Figure } from './figure.ts';

export interface ExportData {
  /** Settings that exported files contain as JSON; by default, the settings of the simulation. */
  settings?: object;
  /** Numbers of the table. A key is the names of some columns, such as 'x_m y_m theta_rad'; its value has their numbers, row by row. */
  columns: Record<string, ArrayLike<number>>;
  /** Sentences that name the state that a copied link or copied HTML does not contain. */
  linkNote?: string;
  codeNote?: string;
}

/** Pixels of a PNG image per CSS pixel, fine enough for print. */
const PNG_PIXEL_RATIO = 2;

/** Size (CSS pixels) of an exported picture if the figure has no layout, for example in a hidden tab panel. */
const FALLBACK_SIZE = { width: 720, height: 432 };

/** Draws the first picture for a file, in its size and font on the page. `ratio` is the number of pixels per CSS pixel. Returns the size in pixels and the view. */
function drawForExport({ scene: viewModel, pictures: [firstPicture], canvases, colours }: Figure, ratio: number, contextOf: (canvasSize: { width: number, height: number }) => unknown) {
  const pageCanvas = canvases.canvasOf(firstPicture);
  const { width: clientWidth, height } = pageCanvas.clientWidth > 0 ? pageCanvas.getBoundingClientRect() : FALLBACK_SIZE;
  const exportSize = { width: Math.round(ratio * clientWidth), height: Math.round(ratio * height) };
  const exportSurface = { ...exportSize, clientWidth, fontStyle: getComputedStyle(pageCanvas), canvasContext: contextOf(exportSize) as CanvasRenderingContext2D };
  firstPicture.drawPicture(exportSurface, viewModel, colours.palette, { keepsScale: true, isImmediate: true, isExported: true });
  return { view: firstPicture.pictureView, ...exportSize };
}

export async function pngOf(figure: Figure): Promise<Blob> {
  const exportCanvas = new OffscreenCanvas(1, 1);
  const canvasContext = exportCanvas.getContext('2d') as OffscreenCanvasRenderingContext2D;
  drawForExport(figure, PNG_PIXEL_RATIO, (canvasSize) => Object.assign(exportCanvas, canvasSize) && canvasContext);
  canvasContext.resetTransform();
  canvasContext.globalCompositeOperation = 'destination-over';
  canvasContext.fillStyle = figure.colours.palette.paper;
  canvasContext.fillRect(0, 0, exportCanvas.width, exportCanvas.height);
  return exportCanvas.convertToBlob();
}

/** Returns a hash for ids of SVG elements: different for different figures on a page, and equal for equal figures. */
function hashOf(exportText: string) {
  let hashValue = 7;
  for (let i = 0; i < exportText.length; i++) hashValue = (Math.imul(hashValue, 31) + exportText.charCodeAt(i)) >>> 0;
  return hashValue.toString(36);
}

const createSettingsJson = ({ localName }: Figure, exportedSettings: object) => JSON.stringify({ element: localName, ...exportedSettings });

export function svgOf(figure: Figure) {
  const { settings: exportedSettings = figure.viewModel.config } = figure.exportData;
  const idPrefix = `figure-${hashOf(createSettingsJson(figure, exportedSettings))}`;
  const svg = new SvgContext(idPrefix);
  const { view: pictureView, width, height } = drawForExport(figure, 1, () => svg);
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${formatLength(pictureView.width)} ${formatLength(pictureView.height)}" direction="ltr" role="img" aria-labelledby="${idPrefix}-title ${idPrefix}-text">
<title id="${idPrefix}-title">${escapeXml(accessibleNameOf(figure))}</title>
<desc id="${idPrefix}-text">${escapeXml(figure.description)}</desc>
<rect width="100%" height="100%" fill="${figure.colours.palette.paper}"/>
${svg.svgMarkup}
</svg>
`;
}

/** Returns CSV: a comment with settings and seed, a header, and a line for each sample with all digits. */
export function csvOf(figure: Figure) {
  const { settings: exportedSettings = figure.viewModel.config, columns: exportedColumns } = figure.exportData;
  const columnGroups = Object.entries(exportedColumns).map(([columnNames, columnNumbers]) => ({ columnNames: columnNames.split(' '), numbers: columnNumbers }));
  const rowOf = (i: number) => columnGroups.flatMap(({ columnNames, numbers: columnNumbers }) => columnNames.map((_, columnIndex) => columnNumbers[columnNames.length * i + columnIndex]));
  const csvRows = Array.from({ length: columnGroups[0].numbers.length / columnGroups[0].columnNames.length }, (_, i) => rowOf(i));
  const csvLines = [`# ${createSettingsJson(figure, exportedSettings)}`, columnGroups.flatMap(({ columnNames }) => columnNames), ...csvRows];
  return `${csvLines.join('\n')}\n`;
}

export function downloadFile(fileName: string, fileBlob: Blob) {
  const downloadLink = Object.assign(document.createElement('a'), { href: URL.createObjectURL(fileBlob), download: fileName });
  downloadLink.click();
  // The file's object URL is released after a minute. By then the download has started.
  setTimeout(() => URL.revokeObjectURL(downloadLink.href), 60_000);
}

/** Returns the buttons that save the figure. Names of files contain the seed, if there is one. */
export function exportButtonsHtml(figure: Figure, csvTitle: string = words.exports.csvTitle) {
  const exportWords = words.exports;
  const baseName = `${figure.localName}-${figure.viewModel.config.seed ?? 'figure'}`;
  const saveText = (fileExtension: string, mimeType: string, fileContent: string) => downloadFile(`${baseName}.${fileExtension}`, new Blob([fileContent], { type: mimeType }));
  return fieldsetHtml(exportWords.label, html`<div class="buttons">
    ${buttonHtml(exportWords.png, () => figure.toPNG().then((fileBlob) => downloadFile(`${baseName}.png`, fileBlob), (error) => figure.runtime.reportError(error)), { title: exportWords.pngTitle })}
    ${buttonHtml(exportWords.svg, () => saveText('svg', 'image/svg+xml', figure.toSVG()), { title: exportWords.svgTitle })}
    ${buttonHtml(exportWords.csv, () => saveText('csv', 'text/csv', figure.toCSV()), { title: csvTitle })}
  </div>`, 'exports', 'exports');
}

/** Returns a button that copies a text. A notice then confirms the copy, with a note on state that the text does not contain. */
export function copyButtonHtml(figure: Figure, buttonLabel: string, createText: () => string | Promise<string>, buttonOptions: { title?: string, disabled?: boolean }, createNote: () => string | undefined = () => '') {
  const copyText = async () => {
    const exportText = await createText();
    // Iframes without permission may not use the clipboard. Pages without HTTPS do not have it.
    const isCopied = await Promise.resolve(navigator.clipboard?.writeText(exportText).then(() => true)).catch(() => false);
    const copyNote = createNote() ?? '';
    figure.notice.showNotice(() => (isCopied
      ? `${words.copies.copiedNotice} ${copyNote}`
      : html`${words.copies.manualCopyLabel} ${copyNote} <textarea readonly rows="3" aria-label=${words.copies.manualCopyLabel} .value=${exportText}></textarea>`));
  };
  return buttonHtml(buttonLabel, copyText, buttonOptions);
}

export const linkButtonHtml = (figure: Figure) =>
  copyButtonHtml(figure, words.copies.linkLabel, () => figure.shareLink(), { title: words.copies.linkTitle }, () => figure.exportData.linkNote);

export function embeddingControlsHtml(figure: Figure) {
  const { label: buttonLabel, codeLabel, codeTitle } = words.copies;
  const codeButtonHtml = copyButtonHtml(figure, codeLabel, () => figure.embedCode(), { title: codeTitle }, () => figure.exportData.codeNote);
  return fieldsetHtml(buttonLabel, html`<div class="buttons">${codeButtonHtml}</div>`, 'copies', 'copies');
}

/** Address of the published script, used if the address of this script is unknown. */
const PUBLISHED_SCRIPT_URL = 'https://cdn.jsdelivr.net/npm/motion-widgets@0.1/dist/external.js';

/** Returns HTML for any page: the script, and the tag with the attributes that differ from the defaults. */
export function embedCodeOf(figure: Figure) {
  const pageAttributes = Object.entries({ theme: figure.theme === 'auto' ? '' : figure.theme, lang: figure.lang, dir: figure.dir });
  const stateAttributes = figure.simulation ? figure.reflection.findNeededAttributes() : [];
  // Addresses of local files and inline scripts do not work on other pages.
  const isWebAddress = /^https?:/.test(address);
  const typeAttribute = (isWebAddress && isClassic ? ['defer', ''] : ['type', 'module']) as [string, string];
  const scriptTag = tagHtml('script', [typeAttribute, ['src', isWebAddress ? address : PUBLISHED_SCRIPT_URL]]);
  return `${scriptTag}\n${tagHtml(figure.localName, [...pageAttributes.filter(([, attributeText]) => attributeText !== ''), ...stateAttributes])}\n`;
}

function tagHtml(tagName: string, attributes: [string, string][]) {
  return `<${tagName}${attributes.map(([attributeName, attributeText]) => (attributeText === '' ? ` ${attributeName}` : ` ${attributeName}="${escapeXml(attributeText)}"`)).join('')}></${tagName}>`;
}
