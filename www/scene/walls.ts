/** Cached drawing of the walls or cells of a map. A map may have thousands of them, and they change only with the map, the view or the colours. */

import { clamp } from '../ui/format.ts';
import { colourChannelsOf } from '../ui/theme.ts';
import { addLine, paintWithOpacity, createHiddenContext, strokePath, strokeLine, type DrawContext } from './canvas.ts';
import { CachedLayer, strokeInBatches, type LayerDrawContext } from './cache.ts';
import type { View } from './view.ts';
import type { Grid, Plan } from '../types.d.ts';

/** Cells of a grid. `unknown` is missing if no cell is unknown. */
export type CellGrid = Omit<Grid, 'unknown'> & { unknown?: Uint8Array };

const WALL_WIDTH = 2.5;

/** Spacing and width (CSS pixels) and opacity of the lines that hatch unknown cells. */
const HATCHING = { spacing: 7, width: 1, opacity: 0.4 };

export class WallLayer {
  #plan;
  #grid;
  #layer = new CachedLayer();

  /** Creates the drawing of a plan. If the map is a grid, its cells are drawn instead of the walls. */
  constructor(plan: Plan, grid: CellGrid | null) {
    this.#plan = plan;
    this.#grid = grid;
  }

  /** Draws the walls or cells; unknown cells are hatched if they are shown. */
  draw(drawContext: DrawContext, showsUnknown: boolean) {
    if (!this.#grid && 'isVector' in drawContext.context) this.#paint(drawContext, showsUnknown);
    else this.#layer.draw(drawContext, [showsUnknown], (drawContext) => this.#paint(drawContext, showsUnknown));
  }

  #paint(drawContext: LayerDrawContext, showsUnknown: boolean) {
    const { context, view, palette } = drawContext;
    const grid = this.#grid;
    if (showsUnknown && grid?.unknown) {
      // Unknown cells are first filled. Compositing then replaces the filled pixels by hatching.
      fillCells(drawContext, grid, grid.unknown, palette.muted);
      context.globalCompositeOperation = 'source-in';
      hatchVisibleArea(context, view, palette.muted);
      context.globalCompositeOperation = 'source-over';
    }
    if (grid) fillCells(drawContext, grid, grid.occupied, palette.truth);
    const { bounds: [xMin, yMin, xMax, yMax] } = this.#plan;
    strokeLine(context, [[xMin, yMin], [xMax, yMin], [xMax, yMax], [xMin, yMax], [xMin, yMin]].map(([x, y]) => view.toPixel(x, y)), { colour: palette.rule, width: 1 });
    if (grid) return;
    const { walls } = this.#plan;
    const wallLines = Array.from({ length: walls.length / 4 }, (_, i) => view.toPixels(walls.slice(4 * i, 4 * i + 4)));
    strokeInBatches(context, wallLines, { colour: palette.truth, width: WALL_WIDTH, lineCap: 'round' });
  }
}

function hatchVisibleArea(context: LayerDrawContext['context'], { width, height }: View, colour: string) {
  paintWithOpacity(context, HATCHING.opacity, () => strokePath(context, { colour, width: HATCHING.width }, () => {
    for (let x = -height; x < width; x += HATCHING.spacing) addLine(context, [[x, height], [x + height, 0]]);
  }));
}

/** Returns the range of visible cells: first column and row, and the column and row after the last. Each is a multiple of `cellsPerSquare`, or the end of the grid. */
function findVisibleCellRange({ extent: { xMin, xMax, yMin, yMax } }: View, { columns, rows, resolution, origin: [x, y, yaw] }: CellGrid, cellsPerSquare: number): number[] {
  const [xStep, yStep] = [Math.cos(yaw) / resolution, Math.sin(yaw) / resolution];
  const viewCorners = [xMin - x, xMax - x].flatMap((dx) => [yMin - y, yMax - y].map((dy) => [dx * xStep + dy * yStep, dy * xStep - dx * yStep]));
  const cellRanges = [columns, rows].map((cellCount, i) => {
    const cornerCells = viewCorners.map((viewCorner) => clamp(viewCorner[i], 0, cellCount));
    return [Math.floor(Math.min(...cornerCells) / cellsPerSquare) * cellsPerSquare, Math.min(cellCount, Math.ceil(Math.max(...cornerCells) / cellsPerSquare) * cellsPerSquare)];
  });
  return [0, 1].flatMap((rangeEnd) => cellRanges.map((cellRange) => cellRange[rangeEnd]));
}

/** Returns the position (m) of the lower left corner of a cell in the grid's own axes. */
export function cellCornerOf({ resolution, origin: [x, y, yaw] }: CellGrid, column: number, row: number): [x: number, y: number] {
  const [xStep, yStep] = [resolution * Math.cos(yaw), resolution * Math.sin(yaw)];
  return [x + column * xStep - row * yStep, y + column * yStep + row * xStep];
}

/**
 * Fills the cells whose value is 1. If cells are smaller than a pixel, squares of several cells are drawn. A square is filled if one of its
 * cells is filled, so that thin walls stay visible.
 */
function fillCells({ context, view, pixelRatio }: LayerDrawContext, grid: CellGrid, cellValues: Uint8Array, colour: string) {
  const cellsPerSquare = Math.max(1, Math.floor(1 / (grid.resolution * view.scaleX * pixelRatio)));
  const [left, bottom, right, top] = findVisibleCellRange(view, grid, cellsPerSquare);
  const [width, height] = [Math.ceil((right - left) / cellsPerSquare), Math.ceil((top - bottom) / cellsPerSquare)];
  if (width < 1 || height < 1) return;
  const squaresImage = new ImageData(width, height);
  const squarePixels = new Uint32Array(squaresImage.data.buffer);
  const [pixelColour] = new Uint32Array(Uint8Array.of(...colourChannelsOf(colour), 255).buffer);
  for (let row = bottom; row < top; row++) {
    const rowEnd = row * grid.columns + right;
    let pixelIndex = Math.floor((row - bottom) / cellsPerSquare) * width;
    for (let i = row * grid.columns + left; i < rowEnd; pixelIndex++) {
      for (const squareEnd = Math.min(i + cellsPerSquare, rowEnd); i < squareEnd; i++) if (cellValues[i]) squarePixels[pixelIndex] = pixelColour;
    }
  }
  const squaresCanvas = new OffscreenCanvas(width, height);
  createHiddenContext(squaresCanvas).putImageData(squaresImage, 0, 0);
  const cornerPixelOf = (column: number, row: number) => view.toPixel(...cellCornerOf(grid, column, row));
  // The first row of the image is the lowest one, as in the grid.
  const [[originX, originY], [rightX, rightY], [aboveX, aboveY]] = [cornerPixelOf(left, bottom), cornerPixelOf(left + cellsPerSquare, bottom), cornerPixelOf(left, bottom + cellsPerSquare)];
  context.save();
  context.transform(rightX - originX, rightY - originY, aboveX - originX, aboveY - originY, originX, originY);
  // Large cells have sharp edges.
  context.imageSmoothingEnabled = cellsPerSquare > 1;
  context.drawImage(squaresCanvas, 0, 0);
  context.restore();
}
