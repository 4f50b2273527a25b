/** Caches of a single result, of drawings with thousands of lines, and of images that cover the plot area. Drawings are kept on hidden canvases. */

import { addLine, createHiddenContext, strokePath, type DrawContext, type LineStroke } from './canvas.ts';

/** Cache of one result, valid while its dependencies are the same. */
export class Memo<Result> {
  #lastDependencies: unknown[] = [];
  #lastResult: Result | undefined;

  /** Returns the cached result, or computes a new one. @param dependencies values on which the result depends, compared by identity */
  get(dependencies: unknown[], computeResult: () => Result): Result {
    if (dependencies.length !== this.#lastDependencies.length || dependencies.some((dependency, i) => dependency !== this.#lastDependencies[i])) {
      this.#lastResult = computeResult();
      this.#lastDependencies = dependencies;
    }
    return this.#lastResult as Result;
  }
}

export type LayerDrawContext = Pick<DrawContext, 'view' | 'palette' | 'pixelRatio' | 'highlight'> & { context: CanvasRenderingContext2D | OffscreenCanvasRenderingContext2D };

/** Cached drawing of thousands of lines, which change only with the view, the colours, or the data. */
export class CachedLayer {
  #canvas = new OffscreenCanvas(1, 1);
  #drawingMemo: Memo<void> = new Memo();

  /**
   * Draws the layer.
   *
   * @param cacheKey values, besides the view and the colours, on which the drawing depends. When one changes, `paint` is called again
   */
  draw({ context, view, palette, pixelRatio, highlight }: DrawContext, cacheKey: unknown[], paint: (drawContext: LayerDrawContext) => void) {
    const { extent, plotArea, width, height } = view;
    this.#drawingMemo.get([...cacheKey, JSON.stringify([extent, plotArea, width, height, palette, pixelRatio])], () => {
      // Setting the size clears the canvas.
      this.#canvas.width = Math.round(width * pixelRatio);
      this.#canvas.height = Math.round(height * pixelRatio);
      const layerContext = createHiddenContext(this.#canvas);
      layerContext.scale(pixelRatio, pixelRatio);
      paint({ context: layerContext, view, palette, pixelRatio, highlight });
    });
    context.drawImage(this.#canvas, 0, 0, width, height);
  }
}

/** Maximum number of lines in a path. Browsers take far longer to stroke one long path than several short ones. */
export const LINES_PER_STROKE = 500;

/** Strokes lines through points in pixels, `linesPerStroke` at a time. */
export function strokeInBatches(context: LayerDrawContext['context'], pixelLines: number[][][], style: LineStroke, linesPerStroke = LINES_PER_STROKE) {
  for (let i = 0; i < pixelLines.length; i += linesPerStroke) {
    strokePath(context, style, () => pixelLines.slice(i, i + linesPerStroke).forEach((points) => addLine(context, points)));
  }
}

/** Cached image of pixels, which covers the plot area. */
export class CachedImage {
  #canvas = new OffscreenCanvas(1, 1);
  #pixelsMemo: Memo<void> = new Memo();

  /**
   * Draws the image.
   *
   * @param cacheKey values on which the pixels depend; they are cached until one changes
   * @param computePixels returns the pixels, whose first row is at the top
   */
  draw({ context, view }: DrawContext, cacheKey: unknown[], computePixels: () => { pixels: Uint8ClampedArray<ArrayBuffer>, columns: number }) {
    this.#pixelsMemo.get(cacheKey, () => {
      const { pixels, columns } = computePixels();
      const rows = pixels.length / (4 * columns);
      Object.assign(this.#canvas, { width: columns, height: rows });
      createHiddenContext(this.#canvas).putImageData(new ImageData(pixels, columns, rows), 0, 0);
    });
    const { left, right, top, bottom } = view.plotArea;
    context.drawImage(this.#canvas, left, top, right - left, bottom - top);
  }

  /**
   * Draws the density of a cloud.
   *
   * @param cellSide side in CSS pixels
   * @param cacheKey values, besides the view, on which the pixels depend
   * @param computePixels returns the pixels of the density in a part of the plane, whose bounds are xMin, yMin, xMax and yMax
   */
  drawDensity(drawContext: DrawContext, cellSide: number, cacheKey: unknown[], computePixels: (bounds: number[], columns: number, rows: number) => Uint8ClampedArray<ArrayBuffer>) {
    const { left, right, top, bottom } = drawContext.view.plotArea;
    const { xMin, yMin, xMax, yMax } = drawContext.view.extent;
    const [columns, rows] = [right - left, bottom - top].map((length) => Math.max(1, Math.round(length / cellSide)));
    this.draw(drawContext, [...cacheKey, xMin, yMin, xMax, yMax, columns, rows], () => ({ pixels: computePixels([xMin, yMin, xMax, yMax], columns, rows), columns }));
  }
}
