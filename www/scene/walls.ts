/** Cached drawing of the walls of a map. There may be thousands of walls, and they change only with the map, the view or the colours. */

import { clamp } from '../ui/clamp.ts';
import { channels } from '../ui/theme.ts';
import { addLine, faded, hiddenContext, stroke, strokeLine, type Brush } from './canvas.ts';
import { Layer, advance, strokeMany, type Painter } from './layer.ts';
import type { View } from './view.ts';
import type { Grid, Plan } from '../types.d.ts';

/** Cells of a grid. `unknown` is missing if no cell is unknown. */
export type Cells = Omit<Grid, 'unknown'> & { unknown?: Uint8Array };

/** Width of a wall, CSS pixels. */
const WALL = 2.5;

/** Distance, width and opacity of the lines that hatch unknown cells; lengths in CSS pixels. */
const HATCH = { apart: 7, width: 1, opacity: 0.4 };

export class WallLayer {
  #plan;
  #grid;
  #layer = new Layer();

  /** Creates the drawing of a plan. If the map is a grid, its cells are drawn instead of the walls. */
  constructor(plan: Plan, grid: Cells | null) {
    this.#plan = plan;
    this.#grid = grid;
  }

  /** Draws the walls or cells; unknown cells are hatched if they are shown. */
  draw(brush: Brush, unknown: boolean) {
    if (!this.#grid && 'vector' in brush.context) advance(this.#paint(brush, unknown));
    else this.#layer.draw(brush, [unknown], (painter) => this.#paint(painter, unknown));
  }

  *#paint(painter: Painter, unknown: boolean): Generator<undefined, void> {
    const { context, view, palette } = painter;
    const grid = this.#grid;
    if (unknown && grid?.unknown) {
      // The unknown cells are filled, and then replaced by the hatching.
      fillCells(painter, grid, grid.unknown, palette.muted);
      context.globalCompositeOperation = 'source-in';
      hatch(context, view, palette.muted);
      context.globalCompositeOperation = 'source-over';
    }
    if (grid) fillCells(painter, grid, grid.occupied, palette.truth);
    const { bounds: [xMin, yMin, xMax, yMax] } = this.#plan;
    strokeLine(context, [[xMin, yMin], [xMax, yMin], [xMax, yMax], [xMin, yMax], [xMin, yMin]].map(([x, y]) => view.toPixel(x, y)), { colour: palette.rule, width: 1 });
    if (!grid) yield* strokeMany(context, this.#linesIn(view), { colour: palette.truth, width: WALL });
  }

  /** Returns the walls as lines, pixels. */
  *#linesIn(view: View) {
    const { walls } = this.#plan;
    for (let i = 0; i < walls.length; i += 4) yield [view.toPixel(walls[i], walls[i + 1]), view.toPixel(walls[i + 2], walls[i + 3])];
  }
}

/** Draws diagonal lines over the whole view. */
function hatch(context: Painter['context'], { width, height }: View, colour: string) {
  faded(context, HATCH.opacity, () => stroke(context, { colour, width: HATCH.width }, () => {
    for (let x = -height; x < width; x += HATCH.apart) addLine(context, [[x, height], [x + height, 0]]);
  }));
}

/** Returns the visible cells as first column and row, and the column and row after the last. They are multiples of `side`, or ends of the grid. */
function cellsIn({ extent: { xMin, xMax, yMin, yMax } }: View, { columns, rows, resolution, origin: [x, y, yaw] }: Cells, side: number): number[] {
  const [along, up] = [Math.cos(yaw) / resolution, Math.sin(yaw) / resolution];
  const corners = [xMin - x, xMax - x].flatMap((dx) => [yMin - y, yMax - y].map((dy) => [dx * along + dy * up, dy * along - dx * up]));
  const ends = [columns, rows].map((count, i) => {
    const all = corners.map((corner) => clamp(corner[i], 0, count));
    return [Math.floor(Math.min(...all) / side) * side, Math.min(count, Math.ceil(Math.max(...all) / side) * side)];
  });
  return [0, 1].flatMap((end) => ends.map((each) => each[end]));
}

/** Returns the position of the corner of a cell, m. */
export function cornerOf({ resolution, origin: [x, y, yaw] }: Cells, column: number, row: number): [x: number, y: number] {
  const [along, up] = [resolution * Math.cos(yaw), resolution * Math.sin(yaw)];
  return [x + column * along - row * up, y + column * up + row * along];
}

/**
 * Fills the cells whose value is 1. If cells are smaller than a pixel, squares of cells are drawn. A square is filled if one of its cells is,
 * so that thin walls stay visible.
 */
function fillCells({ context, view, ratio }: Painter, grid: Cells, cells: Uint8Array, colour: string) {
  const side = Math.max(1, Math.floor(1 / (grid.resolution * view.scaleX * ratio)));
  const [left, bottom, right, top] = cellsIn(view, grid, side);
  const [width, height] = [Math.ceil((right - left) / side), Math.ceil((top - bottom) / side)];
  if (width < 1 || height < 1) return;
  const image = new ImageData(width, height);
  const pixels = new Uint32Array(image.data.buffer);
  const [ink] = new Uint32Array(Uint8Array.of(...channels(colour), 255).buffer);
  for (let row = bottom; row < top; row++) {
    const end = row * grid.columns + right;
    let pixel = Math.floor((row - bottom) / side) * width;
    for (let i = row * grid.columns + left; i < end; pixel++) {
      for (const next = Math.min(i + side, end); i < next; i++) if (cells[i]) pixels[pixel] = ink;
    }
  }
  const canvas = new OffscreenCanvas(width, height);
  hiddenContext(canvas).putImageData(image, 0, 0);
  const corner = (column: number, row: number) => view.toPixel(...cornerOf(grid, column, row));
  // The first row of the image is the lowest one, as in the grid.
  const [[fromX, fromY], [rightX, rightY], [aboveX, aboveY]] = [corner(left, bottom), corner(left + side, bottom), corner(left, bottom + side)];
  context.save();
  context.transform(rightX - fromX, rightY - fromY, aboveX - fromX, aboveY - fromY, fromX, fromY);
  // Large cells have sharp edges.
  context.imageSmoothingEnabled = side > 1;
  context.drawImage(canvas, 0, 0);
  context.restore();
}
