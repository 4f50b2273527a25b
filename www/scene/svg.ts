/** Canvas context that writes SVG. It has only the methods that scene/draw.ts and the pictures use. */

/** Characters that are not allowed in XML. */
const INVALID_XML_CHARACTERS = /[^\t\n\r\u0020-\ud7ff\ue000-\ufffd\u{10000}-\u{10ffff}]/gu;

export const escapeXml = (plainText: string) =>
  plainText.replace(INVALID_XML_CHARACTERS, '\ufffd').replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('>', '&gt;').replaceAll('"', '&quot;');

/** Prints a length in CSS pixels to a hundredth, which is finer than the resolution of printers. */
export const formatLength = (pixelLength: number) => String(Math.round(100 * pixelLength) / 100);

/** Offsets of the alphabetic baseline from the baselines of the canvas, in em. */
const BASELINE_SHIFTS = { top: '0.8em', middle: '0.33em' } as Record<string, string>;
const TEXT_ANCHORS = { center: 'middle', right: 'end' } as Record<string, string>;

export class SvgContext {
  /** True for a context that writes vector graphics. Callers that would draw pixels for speed then draw shapes. */
  isVector = true;
  strokeStyle = '';
  fillStyle = '';
  lineWidth = 1;
  lineJoin = 'miter';
  lineCap = 'butt';
  globalAlpha = 1;
  font = '';
  textAlign = 'left';
  textBaseline = 'alphabetic';
  #pathData = '';
  #dash: number[] = [];
  #elementTexts: string[] = [];
  #clipPathCount = 0;
  #idPrefix;
  #measuringContext: OffscreenCanvasRenderingContext2D | undefined;

  /** Creates the context. Ids of SVG elements begin with `idPrefix`, because several figures may be on one page. */
  constructor(idPrefix: string) {
    this.#idPrefix = idPrefix;
  }

  get svgMarkup() {
    return this.#elementTexts.join('\n');
  }

  // Transforms and clearing are not needed in SVG: the unit is the CSS pixel, and the drawing is empty at first.
  setTransform() {}
  clearRect() {}

  save() {
    this.#elementTexts.push('<g>');
  }

  restore() {
    this.#elementTexts.push('</g>');
  }

  beginPath() {
    this.#pathData = '';
  }

  moveTo: CanvasPath['moveTo'] = (x, y) => {
    this.#pathData += `M${formatLength(x)},${formatLength(y)}`;
  };

  lineTo: CanvasPath['lineTo'] = (x, y) => {
    // The first point of a path is a move, as on a canvas.
    this.#pathData += `${this.#pathData ? 'L' : 'M'}${formatLength(x)},${formatLength(y)}`;
  };

  arc: CanvasPath['arc'] = (x, y, radius, startAngle, endAngle, isCounterclockwise = false) => {
    const r = formatLength(radius);
    const sweepAngle = isCounterclockwise ? startAngle - endAngle : endAngle - startAngle;
    if (sweepAngle >= 2 * Math.PI) {
      const diameter = formatLength(2 * radius);
      this.#pathData += `M${formatLength(x - radius)},${formatLength(y)}a${r},${r} 0 1 0 ${diameter},0a${r},${r} 0 1 0 -${diameter},0Z`;
      return;
    }
    const pointAt = (angle: number) => `${formatLength(x + radius * Math.cos(angle))},${formatLength(y + radius * Math.sin(angle))}`;
    const [largeArcFlag, clockwiseFlag] = [sweepAngle > Math.PI, !isCounterclockwise].map(Number);
    this.#pathData += `${this.#pathData ? 'L' : 'M'}${pointAt(startAngle)}A${r},${r} 0 ${largeArcFlag} ${clockwiseFlag} ${pointAt(endAngle)}`;
  };

  rect: CanvasPath['rect'] = (x, y, width, height) => {
    this.#pathData += `M${formatLength(x)},${formatLength(y)}h${formatLength(width)}v${formatLength(height)}h${formatLength(-width)}Z`;
  };

  closePath() {
    this.#pathData += 'Z';
  }

  fillRect: CanvasRect['fillRect'] = (...rectangleBounds) => {
    this.#pathData = '';
    this.rect(...rectangleBounds);
    this.fill();
  };

  clip() {
    const clipId = `${this.#idPrefix}-clip${++this.#clipPathCount}`;
    // The latest element is the group that `save` has opened. A group that is clipped to the path replaces it.
    this.#elementTexts.splice(-1, 1, `<clipPath id="${clipId}"><path d="${this.#pathData}"/></clipPath><g clip-path="url(#${clipId})">`);
  }

  setLineDash(dash: number[]) {
    this.#dash = dash;
  }

  stroke() {
    this.#elementTexts.push(`<path d="${this.#pathData}" fill="none"${this.#strokeAttributes()}/>`);
  }

  fill() {
    this.#elementTexts.push(`<path d="${this.#pathData}" fill="${this.fillStyle}"${this.#formatOpacityAttribute()}/>`);
  }

  #formatOpacityAttribute() {
    return this.globalAlpha === 1 ? '' : ` opacity="${this.globalAlpha}"`;
  }

  #strokeAttributes() {
    const dashAttribute = this.#dash.length ? ` stroke-dasharray="${this.#dash}"` : '';
    const capAttribute = this.lineCap === 'butt' ? '' : ` stroke-linecap="${this.lineCap}"`;
    const lineJoinAttribute = this.lineJoin === 'miter' ? '' : ` stroke-linejoin="${this.lineJoin}"`;
    return ` stroke="${this.strokeStyle}" stroke-width="${this.lineWidth}"${dashAttribute}${capAttribute}${lineJoinAttribute}${this.#formatOpacityAttribute()}`;
  }

  measureText(labelText: string): { width: number } {
    // Node has no canvas to measure text. The width is estimated: letters of most fonts are about half as wide as high.
    if (typeof OffscreenCanvas === 'undefined') return { width: 0.55 * labelText.length * parseFloat(this.font.replace('italic ', '')) };
    this.#measuringContext ??= new OffscreenCanvas(1, 1).getContext('2d') as OffscreenCanvasRenderingContext2D;
    this.#measuringContext.font = this.font;
    return this.#measuringContext.measureText(labelText);
  }

  fillText: CanvasText['fillText'] = (labelText, x, y) => this.#addText(labelText, x, y, ` fill="${this.fillStyle}"${this.#formatOpacityAttribute()}`);

  #addText(labelText: string, x: number, y: number, paintAttributes: string) {
    const dy = BASELINE_SHIFTS[this.textBaseline] ?? '0';
    const textAnchor = TEXT_ANCHORS[this.textAlign] ?? 'start';
    const positionAttributes = `x="${formatLength(x)}" y="${formatLength(y)}" dy="${dy}" text-anchor="${textAnchor}"`;
    this.#elementTexts.push(`<text ${positionAttributes} style="font:${escapeXml(this.font)}"${paintAttributes}>${escapeXml(labelText)}</text>`);
  }

  drawImage(rasterImage: OffscreenCanvas, ...rectangleBounds: [x: number, y: number, width: number, height: number]) {
    const [x, y, width, height] = rectangleBounds.map(formatLength);
    const canvas = Object.assign(document.createElement('canvas'), { width: rasterImage.width, height: rasterImage.height });
    (canvas.getContext('2d') as CanvasRenderingContext2D).drawImage(rasterImage, 0, 0);
    const imageAttributes = `x="${x}" y="${y}" width="${width}" height="${height}"`;
    this.#elementTexts.push(`<image ${imageAttributes} preserveAspectRatio="none" href="${canvas.toDataURL()}"${this.#formatOpacityAttribute()}/>`);
  }
}
