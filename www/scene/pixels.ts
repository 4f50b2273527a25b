/** Images that cover the plot area. */

import { hiddenContext } from './canvas.ts';
import { Memo } from './memo.ts';
import type { Brush } from './canvas.ts';

/**
 * Image of pixels. Only the part that is not transparent is drawn, because most of a density is empty: scaling the whole image would take
 * longer than drawing the rest of a picture.
 */
export class Pixels {
  #canvas = new OffscreenCanvas(1, 1);
  #visibleBox: ReturnType<typeof opaqueBox>;

  /**
   * Replaces the pixels.
   *
   * @param pixels row 0 at the top
   */
  setPixels(pixels: Uint8ClampedArray<ArrayBuffer>, columns: number) {
    const rows = pixels.length / (4 * columns);
    if (this.#canvas.width !== columns) this.#canvas.width = columns;
    if (this.#canvas.height !== rows) this.#canvas.height = rows;
    this.#visibleBox = opaqueBox(pixels, columns, rows);
    // All pixels are copied, because scaling blends the edges of the visible part with their neighbours.
    if (this.#visibleBox) hiddenContext(this.#canvas).putImageData(new ImageData(pixels, columns, rows), 0, 0);
  }

  draw({ context, view }: Brush) {
    if (!this.#visibleBox) return;
    const [x, y, width, height] = this.#visibleBox;
    const { left, right, top, bottom } = view.frame;
    const [scaleX, scaleY] = [(right - left) / this.#canvas.width, (bottom - top) / this.#canvas.height];
    context.imageSmoothingEnabled = true;
    context.drawImage(this.#canvas, x, y, width, height, left + scaleX * x, top + scaleY * y, scaleX * width, scaleY * height);
  }
}

/** Density of a cloud. */
export class Density {
  #pixels = new Pixels();
  #memo: Memo<void> = new Memo();

  /**
   * @param cellSide side in CSS pixels
   * @param cacheKey values, besides the view, that the pixels depend on; the pixels are cached until one changes
   * @param pixelsOf returns the simulation's picture of a part of the plane
   */
  draw(brush: Brush, cellSide: number, cacheKey: unknown[], pixelsOf: (...view: [xMin: number, yMin: number, xMax: number, yMax: number, columns: number, rows: number]) => Uint8ClampedArray<ArrayBuffer>) {
    const { left, right, top, bottom } = brush.view.frame;
    const { xMin, yMin, xMax, yMax } = brush.view.extent;
    const [columns, rows] = [right - left, bottom - top].map((length) => Math.max(1, Math.round(length / cellSide)));
    this.#memo.get([...cacheKey, xMin, yMin, xMax, yMax, columns, rows], () => this.#pixels.setPixels(pixelsOf(xMin, yMin, xMax, yMax, columns, rows), columns));
    this.#pixels.draw(brush);
  }
}

/** Returns the bounding box of the pixels that are not transparent, with a border of one pixel, into which scaling blends the edge. */
function opaqueBox(pixels: Uint8ClampedArray<ArrayBuffer>, columns: number, rows: number): [x: number, y: number, width: number, height: number] | undefined {
  const pixelValues = new Uint32Array(pixels.buffer, pixels.byteOffset, columns * rows);
  let [left, right, firstVisibleIndex, lastVisibleIndex] = [columns, 0, -1, -1];
  for (let i = 0; i < pixelValues.length; i++) {
    if (pixelValues[i] === 0) continue;
    if (firstVisibleIndex < 0) firstVisibleIndex = i;
    lastVisibleIndex = i;
    left = Math.min(left, i % columns);
    right = Math.max(right, i % columns);
  }
  if (firstVisibleIndex < 0) return undefined;
  const [x, y] = [Math.max(0, left - 1), Math.max(0, Math.floor(firstVisibleIndex / columns) - 1)];
  return [x, y, Math.min(columns, right + 2) - x, Math.min(rows, Math.floor(lastVisibleIndex / columns) + 2) - y];
}
