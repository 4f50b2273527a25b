/** Cached drawing on a hidden canvas, for thousands of lines that change only with the view, the colours, or the data. */

import { addLine, hiddenContext, strokePath, type Brush, type LineStroke } from './canvas.ts';
import { Memo } from './memo.ts';

export type Painter = Pick<Brush, 'view' | 'palette' | 'ratio' | 'highlight'> & { context: CanvasRenderingContext2D | OffscreenCanvasRenderingContext2D };

export class Layer {
  #canvas = new OffscreenCanvas(1, 1);
  #drawingMemo: Memo<void> = new Memo();

  /**
   * Draws the layer.
   *
   * @param cacheKey values, besides the view and the colours, on which the drawing depends. When one changes, `paint` is called again
   */
  draw({ context, view, palette, ratio, highlight }: Brush, cacheKey: unknown[], paint: (painter: Painter) => void) {
    const { extent, frame, width, height } = view;
    this.#drawingMemo.get([...cacheKey, JSON.stringify([extent, frame, width, height, palette, ratio])], () => {
      // Setting the size clears the canvas.
      this.#canvas.width = Math.round(width * ratio);
      this.#canvas.height = Math.round(height * ratio);
      const layerContext = hiddenContext(this.#canvas);
      layerContext.scale(ratio, ratio);
      paint({ context: layerContext, view, palette, ratio, highlight });
    });
    context.drawImage(this.#canvas, 0, 0, width, height);
  }
}

/** Number of lines in one stroke. Browsers take far longer for one path with many lines. */
export const LINES_PER_STROKE = 500;

/** Strokes lines through points in pixels, `linesPerStroke` at a time. */
export function strokeInBatches(context: Painter['context'], lines: number[][][], style: LineStroke, linesPerStroke = LINES_PER_STROKE) {
  for (let i = 0; i < lines.length; i += linesPerStroke) {
    strokePath(context, style, () => lines.slice(i, i + linesPerStroke).forEach((points) => addLine(context, points)));
  }
}
