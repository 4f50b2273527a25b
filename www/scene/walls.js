/**
 * A floor plan's walls as a layer of their own: a map may have tens of thousands, and they change
 * only with the map, the view or the colours.
 */

import { clamp } from '../ui/clamp.js';
import { channels } from '../ui/theme.js';
import { A_LINE, LONGEST_SIDE, STROKED, hiddenContext } from './canvas.js';

/**
 * @import { View } from './view.js'
 * @import { Brush } from './canvas.js'
 * @import { Grid, Plan } from '../types.d.ts'
 */

/** Width of a wall that has none, CSS pixels. */
const WALL = 2.5;

/** Distance and width of the lines that hatch what is unknown, CSS pixels. */
const HATCH = { apart: 7, width: 1, opacity: 0.4 };

/** Width of the outline of cells: enough to keep a cell visible in a view of a whole building. */
const OUTLINE = 0.75;

/** Walls that are stroked at once: browsers take far longer for one path of many. */
const WALLS_A_STROKE = 500;

/** How long cells of a picture are counted and drawn in a frame, milliseconds: there may be two of them. */
const COUNTING = 8;

/** Cells between two looks at the clock. */
const COUNTED = 100_000;

/** Walls whose ends are nearer to each other than this look the same, pixels of the view. */
const ALIKE = 0.25;

/** So few are stroked with every picture: to copy a layer takes longer. */
const FEW_WALLS = 50;

/** Cells of a picture beyond what its view shows, as a share of that: for a view that moves. */
const BEYOND = 0.25;

/**
 * @typedef {Omit<Grid, 'unknown'> & { unknown?: Uint8Array }} Cells of a grid; without the unknown ones where there are none
 *
 * @typedef {number[]} Block of cells: the first column and row, and those after the last
 */

/** @typedef {Pick<Brush, 'view' | 'palette'> & { context: CanvasRenderingContext2D | OffscreenCanvasRenderingContext2D }} Bare */

export class WallLayer {
  #plan;
  /** The grid, if its cells are drawn. @type {Cells | undefined} */
  #grid;
  #width;
  /** By kinds of cells: the one that is drawn, and the one that is to be. @type {Record<string, { complete?: Mask, coming?: Mask }>} */
  #masks = {};
  #layer = new OffscreenCanvas(1, 1);
  /** What the layer shows. */
  #shown = '';
  /** The first coordinate of the first wall that the layer does not show yet. */
  #next = 0;

  /**
   * @param {Plan} plan
   * @param {Cells | null} grid the cells that the walls outline, if they do
   * @param {number} [width] of a wall that has none, CSS pixels
   */
  constructor(plan, grid, width = WALL) {
    this.#plan = plan;
    // Cells of a longer grid are outlined only.
    if (grid && Math.max(grid.columns, grid.rows) <= LONGEST_SIDE) this.#grid = grid;
    this.#width = grid ? OUTLINE : width;
    this.solid = grid !== null;
  }

  /**
   * @param {Brush} brush
   * @returns {boolean} whether walls are left to the next frames
   */
  draw(brush) {
    const { context, view, palette, ratio, piecemeal } = brush;
    const { extent, frame, width, height } = view;
    const { walls } = this.#plan;
    if (!this.#grid && ('vector' in context || walls.length <= 4 * FEW_WALLS)) {
      this.#border(brush);
      this.#stroke(brush, 0, Infinity);
      return false;
    }
    const wanted = JSON.stringify([extent, frame, width, height, palette.truth, palette.rule, palette.muted, ratio]);
    let coming = false;
    if (wanted !== this.#shown) {
      const unknown = this.#grid?.unknown && this.#mask('unknown', palette.muted, brush);
      const occupied = this.#grid && this.#mask('occupied', palette.truth, brush);
      coming = Object.values(this.#masks).some((mask) => mask.coming);
      this.#shown = coming ? '' : wanted;
      this.#paint(brush, unknown, occupied);
    }
    // With another mask the layer begins anew.
    if (!coming && this.#next < walls.length) {
      const layer = hiddenContext(this.#layer);
      this.#next = this.#stroke({ context: layer, view, palette }, this.#next, piecemeal ? STROKED : Infinity);
    }
    context.drawImage(this.#layer, 0, 0, width, height);
    return coming || this.#next < walls.length;
  }

  /**
   * All but the walls.
   *
   * @param {Brush} brush
   * @param {Mask} [unknown]
   * @param {Mask} [occupied]
   */
  #paint({ view, palette, ratio }, unknown, occupied) {
    // A new size clears it.
    this.#layer.width = Math.round(view.width * ratio);
    this.#layer.height = Math.round(view.height * ratio);
    this.#next = 0;
    const context = hiddenContext(this.#layer);
    context.scale(ratio, ratio);
    if (this.#grid && unknown) {
      // The mask says where, the hatching goes there.
      fillCells(context, view, this.#grid, unknown);
      context.globalCompositeOperation = 'source-in';
      hatch(context, view, palette.muted);
      context.globalCompositeOperation = 'source-over';
    }
    if (this.#grid && occupied) fillCells(context, view, this.#grid, occupied);
    this.#border({ context, view, palette });
  }

  /**
   * The picture of cells of a kind. If the right one is not there yet, as much of it is made as a frame has time for, and the
   * former one is drawn until then.
   *
   * @param {'occupied' | 'unknown'} kind
   * @param {string} colour
   * @param {Brush} brush
   */
  #mask(kind, colour, { view, ratio, piecemeal }) {
    const grid = /** @type {Cells} */ (this.#grid);
    // What is smaller than a pixel is not drawn apart: of a map of millions of cells a view shows thousands.
    // By powers of two, or every step of a view on its way would want another one.
    const cells = Math.min(1 / (grid.resolution * view.scaleX * ratio), LONGEST_SIDE);
    const side = 2 ** Math.max(0, Math.floor(Math.log2(cells)));
    const seen = cellsIn(view, grid, 1, 0);
    const isRight = (/** @type {Mask | undefined} */ mask) => mask?.colour === colour && mask.side === side && mask.covers(seen);
    let { complete, coming } = this.#masks[kind] ?? {};
    if (isRight(complete)) coming = undefined;
    else {
      if (!isRight(coming)) coming = new Mask(grid, /** @type {Uint8Array} */ (grid[kind]), colour, side, cellsIn(view, grid, side, BEYOND));
      // One after the other.
      if (kind === 'unknown' || !this.#masks.unknown?.coming) coming?.grow(piecemeal ? COUNTING : Infinity);
      if (coming?.complete) [complete, coming] = [coming, undefined];
    }
    this.#masks[kind] = { complete, coming };
    return complete;
  }

  /** @param {Bare} brush */
  #border({ context, view, palette }) {
    const { bounds } = this.#plan;
    const [left, top] = [view.toPixelX(bounds[0]), view.toPixelY(bounds[3])];
    context.strokeStyle = palette.rule;
    context.lineWidth = 1;
    context.strokeRect(left, top, view.toPixelX(bounds[2]) - left, view.toPixelY(bounds[1]) - top);
  }

  /**
   * Strokes walls; not those that look as the one before, and none out of view.
   *
   * @param {Bare} brush
   * @param {number} next where the coordinates of the first one are
   * @param {number} most to stroke, in pixels
   * @returns {number} where those of the next one are that is to be stroked
   */
  #stroke({ context, view, palette }, next, most) {
    const { walls } = this.#plan;
    const { width, height } = view;
    const margin = this.#width;
    context.strokeStyle = palette.truth;
    context.lineWidth = this.#width;
    context.lineCap = this.solid ? 'butt' : 'round';
    let [fromX, fromY, toX, toY] = [NaN, NaN, NaN, NaN];
    let stroked = 0;
    while (next < walls.length && stroked < most) {
      const end = Math.min(walls.length, next + 4 * WALLS_A_STROKE);
      context.beginPath();
      for (; next < end && stroked < most; next += 4) {
        const [x0, y0] = [view.toPixelX(walls[next]), view.toPixelY(walls[next + 1])];
        const [x1, y1] = [view.toPixelX(walls[next + 2]), view.toPixelY(walls[next + 3])];
        stroked++;
        if (Math.max(Math.abs(x0 - fromX), Math.abs(y0 - fromY), Math.abs(x1 - toX), Math.abs(y1 - toY)) < ALIKE) continue;
        if (Math.max(x0, x1) < -margin || Math.min(x0, x1) > width + margin) continue;
        if (Math.max(y0, y1) < -margin || Math.min(y0, y1) > height + margin) continue;
        [fromX, fromY, toX, toY] = [x0, y0, x1, y1];
        context.moveTo(x0, y0);
        context.lineTo(x1, y1);
        stroked += A_LINE + Math.min(Math.hypot(x1 - x0, y1 - y0), width + height);
      }
      context.stroke();
    }
    context.lineCap = 'butt';
    return next;
  }
}

/** A picture of some cells: a pixel for a square of them, the lowest row first, as opaque as many of them are. */
class Mask {
  canvas;
  colour;
  side;
  block;
  #cells;
  #columns;
  /** The first row of pixels that is not drawn yet. */
  #row = 0;

  /**
   * @param {Cells} grid
   * @param {Uint8Array} cells 1 where they are
   * @param {string} colour
   * @param {number} side of the square, in cells
   * @param {Block} block of them that are in it, from a multiple of that on
   */
  constructor({ columns }, cells, colour, side, block) {
    this.colour = colour;
    this.side = side;
    this.block = block;
    this.#cells = cells;
    this.#columns = columns;
    this.canvas = new OffscreenCanvas(Math.ceil((block[2] - block[0]) / side), Math.ceil((block[3] - block[1]) / side));
  }

  /** Whether all these cells are in it. @param {Block} cells */
  covers(cells) {
    return this.block.every((end, i) => (i < 2 ? end <= cells[i] : end >= cells[i]));
  }

  /** Whether all of it is drawn. */
  get complete() {
    return this.#row === this.canvas.height;
  }

  /** Counts cells and draws them. @param {number} limit milliseconds that it may take */
  grow(limit) {
    const end = performance.now() + limit;
    do this.#some();
    while (!this.complete && performance.now() < end);
  }

  /** Some rows of pixels. */
  #some() {
    const [cells, columns, side] = [this.#cells, this.#columns, this.side];
    const [left, bottom, right, top] = this.block;
    const { width, height } = this.canvas;
    const rows = Math.min(height - this.#row, Math.ceil(COUNTED / ((right - left) * side)));
    const image = new ImageData(width, rows);
    const pixels = new Uint32Array(image.data.buffer);
    const [colour] = new Uint32Array(Uint8Array.of(...channels(this.colour), 0).buffer);
    const opacity = 255 / side ** 2;
    const counts = new Uint32Array(width);
    for (let row = 0; row < rows; row++) {
      counts.fill(0);
      const first = bottom + (this.#row + row) * side;
      const last = Math.min(first + side, top);
      for (let at = first; at < last; at++) {
        const end = at * columns + right;
        for (let i = at * columns + left, pixel = 0; i < end; pixel++) {
          let count = 0;
          for (const next = Math.min(i + side, end); i < next; i++) count += cells[i];
          counts[pixel] += count;
        }
      }
      // The highest byte, as every machine has them that runs WebAssembly.
      for (let i = 0; i < width; i++) pixels[row * width + i] = colour | (Math.round(opacity * counts[i]) << 24);
    }
    hiddenContext(this.canvas).putImageData(image, 0, this.#row);
    this.#row += rows;
  }
}

/**
 * Diagonals over the whole of a view; nothing is left between them.
 *
 * @param {OffscreenCanvasRenderingContext2D} context
 * @param {View} view
 * @param {string} colour
 */
function hatch(context, { width, height }, colour) {
  context.beginPath();
  for (let x = -height; x < width; x += HATCH.apart) {
    context.moveTo(x, height);
    context.lineTo(x + height, 0);
  }
  context.strokeStyle = colour;
  context.lineWidth = HATCH.width;
  context.globalAlpha = HATCH.opacity;
  context.stroke();
  context.globalAlpha = 1;
}

/**
 * The cells that a view shows, in whole squares, of which there is always one.
 *
 * @param {View} view
 * @param {Cells} grid
 * @param {number} side of a square, in cells
 * @param {number} beyond as a share of what it shows: so much more, on each side
 * @returns {Block}
 */
function cellsIn({ extent: { xMin, xMax, yMin, yMax } }, { columns, rows, resolution, origin: [x, y, yaw] }, side, beyond) {
  const [along, up] = [Math.cos(yaw) / resolution, Math.sin(yaw) / resolution];
  const corners = [xMin - x, xMax - x].flatMap((dx) => [yMin - y, yMax - y].map((dy) => [dx * along + dy * up, dy * along - dx * up]));
  const ends = [columns, rows].map((count, i) => {
    const all = corners.map((corner) => clamp(corner[i], 0, count));
    const [from, to] = [Math.min(...all), Math.max(...all)];
    const more = beyond * (to - from);
    return [Math.max(0, Math.ceil((from - more) / side) - 1) * side, Math.min(count, Math.floor((to + more) / side + 1) * side)];
  });
  return [0, 1].flatMap((end) => ends.map((each) => each[end]));
}

/** Where the corner of a cell is, m. @param {Cells} grid @param {number} column @param {number} row */
export function cornerOf({ resolution, origin: [x, y, yaw] }, column, row) {
  const [along, up] = [resolution * Math.cos(yaw), resolution * Math.sin(yaw)];
  return [x + column * along - row * up, y + column * up + row * along];
}

/**
 * @param {OffscreenCanvasRenderingContext2D} context
 * @param {View} view
 * @param {Cells} grid
 * @param {Mask} mask
 */
function fillCells(context, view, grid, { canvas, side, block }) {
  /** Where a corner of a cell is drawn. */
  const corner = (/** @type {number} */ column, /** @type {number} */ row) => {
    const [x, y] = cornerOf(grid, column, row);
    return [view.toPixelX(x), view.toPixelY(y)];
  };
  const [left, bottom] = block;
  const [from, right, above] = [corner(left, bottom), corner(left + 1, bottom), corner(left, bottom + 1)];
  context.save();
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
  context.drawImage(canvas, 0, 0, side * canvas.width, side * canvas.height);
  context.restore();
}
