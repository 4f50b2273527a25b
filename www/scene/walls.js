/**
 * A floor plan's walls as a layer of their own: a map may have tens of thousands, and they change
 * only with the map, the view or the colours.
 */

import { LONGEST_SIDE } from './canvas.js';

/**
 * @import { View } from './view.js'
 * @import { Brush } from './canvas.js'
 * @import { Grid, Plan } from '../types.d.ts'
 */

/** Width of a wall that has none, CSS pixels. */
const WALL = 2.5;

/** Width of the outline of cells: enough to keep a cell visible in a view of a whole building. */
const OUTLINE = 0.75;

/** Walls that are stroked at once: browsers take far longer for one path of many. */
const WALLS_A_STROKE = 500;

export class WallLayer {
  #plan;
  /** @type {{ canvas: OffscreenCanvas, grid: Grid } | undefined} */
  #cells;
  #layer = new OffscreenCanvas(1, 1);
  /** What the layer shows. */
  #shown = '';

  /**
   * @param {Plan} plan
   * @param {Grid | null} grid the cells that the walls outline, if they do
   */
  constructor(plan, grid) {
    this.#plan = plan;
    // Cells of a longer grid are outlined only.
    if (grid && Math.max(grid.columns, grid.rows) <= LONGEST_SIDE) {
      this.#cells = { canvas: maskOf(grid), grid };
    }
    this.solid = grid !== null;
  }

  /** @param {Brush} brush */
  draw(brush) {
    const { context, view, palette, ratio } = brush;
    const { extent, width, height } = view;
    if ('vector' in context && !this.#cells) {
      this.#outline(brush);
      return;
    }
    const wanted = JSON.stringify([extent, width, height, palette.truth, palette.rule, ratio]);
    if (wanted !== this.#shown) {
      this.#shown = wanted;
      this.#paint(brush);
    }
    context.drawImage(this.#layer, 0, 0, width, height);
  }

  /** @param {Brush} brush */
  #paint({ view, palette, ratio }) {
    // A new size clears it.
    this.#layer.width = Math.round(view.width * ratio);
    this.#layer.height = Math.round(view.height * ratio);
    const context = /** @type {OffscreenCanvasRenderingContext2D} */ (this.#layer.getContext('2d'));
    context.scale(ratio, ratio);
    if (this.#cells) {
      context.save();
      fillCells(context, view, this.#cells);
      context.restore();
      // The mask says where, the colour is the palette's.
      context.globalCompositeOperation = 'source-in';
      context.fillStyle = palette.truth;
      context.fillRect(0, 0, view.width, view.height);
      context.globalCompositeOperation = 'source-over';
    }
    this.#outline({ context, view, palette });
  }

  /** @param {Pick<Brush, 'view' | 'palette'> & { context: CanvasRenderingContext2D | OffscreenCanvasRenderingContext2D }} brush */
  #outline({ context, view, palette }) {
    const { bounds, walls } = this.#plan;
    const [left, top] = [view.toPixelX(bounds[0]), view.toPixelY(bounds[3])];
    context.strokeStyle = palette.rule;
    context.strokeRect(left, top, view.toPixelX(bounds[2]) - left, view.toPixelY(bounds[1]) - top);

    context.strokeStyle = palette.truth;
    context.lineWidth = this.solid ? OUTLINE : WALL;
    context.lineCap = this.solid ? 'butt' : 'round';
    for (let first = 0; first < walls.length; first += 4 * WALLS_A_STROKE) {
      const last = Math.min(walls.length, first + 4 * WALLS_A_STROKE);
      context.beginPath();
      for (let i = first; i < last; i += 4) {
        context.moveTo(view.toPixelX(walls[i]), view.toPixelY(walls[i + 1]));
        context.lineTo(view.toPixelX(walls[i + 2]), view.toPixelY(walls[i + 3]));
      }
      context.stroke();
    }
    context.lineCap = 'butt';
  }
}

/** A pixel a cell, the lowest row first, opaque where it is occupied. @param {Grid} grid */
function maskOf({ columns, rows, occupied }) {
  const image = new ImageData(columns, rows);
  for (let i = 0; i < occupied.length; i++) image.data[4 * i + 3] = 255 * occupied[i];
  const canvas = new OffscreenCanvas(columns, rows);
  /** @type {OffscreenCanvasRenderingContext2D} */ (canvas.getContext('2d')).putImageData(image, 0, 0);
  return canvas;
}

/**
 * @param {OffscreenCanvasRenderingContext2D} context
 * @param {View} view
 * @param {{ canvas: OffscreenCanvas, grid: Grid }} cells
 */
function fillCells(context, view, { canvas, grid }) {
  const [x, y, yaw] = grid.origin;
  const [along, up] = [grid.resolution * Math.cos(yaw), grid.resolution * Math.sin(yaw)];
  /** Where a corner of a cell is drawn. */
  const corner = (/** @type {number} */ column, /** @type {number} */ row) => [
    view.toPixelX(x + column * along - row * up),
    view.toPixelY(y + column * up + row * along),
  ];
  const [from, right, above] = [corner(0, 0), corner(1, 0), corner(0, 1)];
  context.transform(
    right[0] - from[0],
    right[1] - from[1],
    above[0] - from[0],
    above[1] - from[1],
    from[0],
    from[1],
  );
  // Cells that are large on the screen have edges.
  context.imageSmoothingEnabled = Math.hypot(right[0] - from[0], right[1] - from[1]) < 2;
  context.drawImage(canvas, 0, 0);
}
