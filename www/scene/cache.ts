/** Caches of a single result, of drawings with thousands of lines, and of images that cover the plot area. Drawings are kept on hidden canvases. */

import { addLine, createHiddenContext, strokePath, type DrawContext, type LineStroke } from './canvas.ts';

/** Cache of one result, valid while its dependencies are the same. */
export class MemoizedResult<Result> {
  #lastDependencies: unknown[] = [];
  #lastResult: Result | undefined;

  /** Returns the cached result, or computes a new one. @param dependencies values on which the result depends, compared by identity */
  getResult(dependencies: unknown[], computeResult: () => Result): Result {
    if (dependencies.length !== this.#lastDependencies.length || dependencies.some((dependency, i) => dependency !== this.#lastDependencies[i])) {
      this.#lastResult = computeResult();
      this.#lastDependencies = dependencies;
    }
    return this.#lastResult as Result;
  }
}

export type LayerDrawContext = Pick<DrawContext, 'pictureView' | 'palette' | 'pixelRatio' | 'highlight'> & { canvasContext: CanvasRenderingContext2D | OffscreenCanvasRenderingContext2D };

/** Cached drawing of thousands of lines, which change only with the view, the colours, or the data. */
export class CachedLayer {
  #canvas = new OffscreenCanvas(1, 1);
  #drawingMemo: MemoizedResult<void> = new MemoizedResult();

  /**
   * Draws the layer.
   *
   * @param cacheKey values, besides the view and the colours, on which the drawing depends. When one changes, `paintLayer` is called again
   */
  drawLayer({ canvasContext, pictureView, palette, pixelRatio, highlight }: DrawContext, cacheKey: unknown[], paintLayer: (drawContext: LayerDrawContext) => void) {
    const { shownExtent, plotArea, width, height } = pictureView;
    this.#drawingMemo.getResult([...cacheKey, JSON.stringify([shownExtent, plotArea, width, height, palette, pixelRatio])], () => {
      // Setting the size clears the canvas.
      this.#canvas.width = Math.round(width * pixelRatio);
      this.#canvas.height = Math.round(height * pixelRatio);
      const layerContext = createHiddenContext(this.#canvas);
      layerContext.scale(pixelRatio, pixelRatio);
      paintLayer({ canvasContext: layerContext, pictureView, palette, pixelRatio, highlight });
    });
    canvasContext.drawImage(this.#canvas, 0, 0, width, height);
  }
}

/** Maximum number of lines in a path. Browsers take far longer to stroke one long path than several short ones. */
export const LINES_PER_STROKE = 500;

/** Strokes lines through points in pixels, `linesPerStroke` at a time. */
export function strokeInBatches(canvasContext: LayerDrawContext['canvasContext'], pixelLines: number[][][], lineStroke: LineStroke, linesPerStroke = LINES_PER_STROKE) {
  for (let i = 0; i < pixelLines.length; i += linesPerStroke) {
    strokePath(canvasContext, lineStroke, () => pixelLines.slice(i, i + linesPerStroke).forEach((linePoints) => addLine(canvasContext, linePoints)));
  }
}

/** Cached image of pixels, which covers the plot area. */
export class CachedImage {
  #canvas = new OffscreenCanvas(1, 1);
  #pixelsMemo: MemoizedResult<void> = new MemoizedResult();

  /**
   * Draws the image.
   *
   * @param cacheKey values on which the pixels depend; they are cached until one changes
   * @param computePixels returns the pixels, whose first row is at the top
   */
  drawImage({ canvasContext, pictureView }: DrawContext, cacheKey: unknown[], computePixels: () => { rgbaPixels: Uint8ClampedArray<ArrayBuffer>, columnCount: number }) {
    this.#pixelsMemo.getResult(cacheKey, () => {
      const { rgbaPixels, columnCount } = computePixels();
      const rowCount = rgbaPixels.length / (4 * columnCount);
      Object.assign(this.#canvas, { width: columnCount, height: rowCount });
      createHiddenContext(this.#canvas).putImageData(new ImageData(rgbaPixels, columnCount, rowCount), 0, 0);
    });
    const { leftEdge, rightEdge, topEdge, bottomEdge } = pictureView.plotArea;
    canvasContext.drawImage(this.#canvas, leftEdge, topEdge, rightEdge - leftEdge, bottomEdge - topEdge);
  }

  /**
   * Draws the density of a cloud.
   *
   * @param cellSide side in CSS pixels
   * @param cacheKey values, besides the view, on which the pixels depend
   * @param computePixels returns the pixels of the density in a part of the plane, whose bounds are xMin, yMin, xMax and yMax
   */
  drawDensity(drawContext: DrawContext, cellSide: number, cacheKey: unknown[], computePixels: (worldBounds: number[], columnCount: number, rowCount: number) => Uint8ClampedArray<ArrayBuffer>) {
    const { leftEdge, rightEdge, topEdge, bottomEdge } = drawContext.pictureView.plotArea;
    const { xMin, yMin, xMax, yMax } = drawContext.pictureView.shownExtent;
    const [columnCount, rowCount] = [rightEdge - leftEdge, bottomEdge - topEdge].map((sideLength) => Math.max(1, Math.round(sideLength / cellSide)));
    this.drawImage(drawContext, [...cacheKey, xMin, yMin, xMax, yMax, columnCount, rowCount], () => ({ rgbaPixels: computePixels([xMin, yMin, xMax, yMax], columnCount, rowCount), columnCount }));
  }
}
