/** Images that cover the plot area. */

import { hiddenContext } from './canvas.ts';
import { Memo } from './memo.ts';
import type { Brush } from './canvas.ts';

/** Image of pixels that covers the plot area. */
export class Pixels {
  #canvas = new OffscreenCanvas(1, 1);

  /** Replaces the pixels, whose first row is at the top. */
  setPixels(pixels: Uint8ClampedArray<ArrayBuffer>, columns: number) {
    const rows = pixels.length / (4 * columns);
    Object.assign(this.#canvas, { width: columns, height: rows });
    hiddenContext(this.#canvas).putImageData(new ImageData(pixels, columns, rows), 0, 0);
  }

  draw({ context, view }: Brush) {
    const { left, right, top, bottom } = view.frame;
    context.drawImage(this.#canvas, left, top, right - left, bottom - top);
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
