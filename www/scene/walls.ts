/** Drawing of the walls or cells of a map. */

import { clampNumber } from '../ui/format.ts';
import { colourChannelsOf } from '../ui/theme.ts';
import { addLine, paintWithOpacity, createHiddenContext, strokePath, strokeLine, type DrawContext } from './canvas.ts';
import { strokeInBatches, type CachedLayer, type LayerDrawContext } from './cache.ts';
import type { PictureView } from './view.ts';
import type { Grid, Plan } from '../types.d.ts';

/** Cells of a grid. `unknown` is missing if no cell is unknown. */
export type CellGrid = Omit<Grid, 'unknown'> & { unknown?: Uint8Array };

const WALL_WIDTH = 2.5;

/** Spacing and width (CSS pixels) and opacity of the lines that hatch unknown cells. */
const HATCHING_STYLE = { lineSpacing: 7, width: 1, opacity: 0.4 };

/** Draws the bounds of a map, and its walls or, if it is a grid, its cells. Unknown cells are hatched if they are shown. `wallLayer` caches the drawing. */
export function drawWalls(drawContext: DrawContext, wallLayer: CachedLayer, floorPlan: Plan, cellGrid: CellGrid | null, showsUnknown: boolean) {
  const paintMap = (layerContext: LayerDrawContext) => paintWalls(layerContext, floorPlan, cellGrid, showsUnknown);
  if (!cellGrid && 'isVector' in drawContext.canvasContext) paintMap(drawContext);
  else wallLayer.drawLayer(drawContext, [floorPlan, cellGrid, showsUnknown], paintMap);
}

function paintWalls(drawContext: LayerDrawContext, { bounds: [xMin, yMin, xMax, yMax], walls }: Plan, cellGrid: CellGrid | null, showsUnknown: boolean) {
  const { canvasContext, pictureView, palette } = drawContext;
  if (showsUnknown && cellGrid?.unknown) {
    // Unknown cells are first filled. Compositing then replaces the filled pixels by hatching.
    fillCells(drawContext, cellGrid, cellGrid.unknown, palette.muted);
    canvasContext.globalCompositeOperation = 'source-in';
    hatchVisibleArea(canvasContext, pictureView, palette.muted);
    canvasContext.globalCompositeOperation = 'source-over';
  }
  if (cellGrid) fillCells(drawContext, cellGrid, cellGrid.occupied, palette.truth);
  strokeLine(canvasContext, [[xMin, yMin], [xMax, yMin], [xMax, yMax], [xMin, yMax], [xMin, yMin]].map(([x, y]) => pictureView.toPixel(x, y)), { colour: palette.rule, width: 1 });
  if (cellGrid) return;
  const wallLines = Array.from({ length: walls.length / 4 }, (_, i) => pictureView.toPixels(walls.slice(4 * i, 4 * i + 4)));
  strokeInBatches(canvasContext, wallLines, { colour: palette.truth, width: WALL_WIDTH, lineCap: 'round' });
}

function hatchVisibleArea(canvasContext: LayerDrawContext['canvasContext'], { width, height }: PictureView, lineColour: string) {
  paintWithOpacity(canvasContext, HATCHING_STYLE.opacity, () => strokePath(canvasContext, { colour: lineColour, width: HATCHING_STYLE.width }, () => {
    for (let x = -height; x < width; x += HATCHING_STYLE.lineSpacing) addLine(canvasContext, [[x, height], [x + height, 0]]);
  }));
}

/** Returns the range of visible cells: first column and row, and the column and row after the last. Each is a multiple of `cellsPerSquare`, or the end of the grid. */
function findVisibleCellRange({ shownExtent: { xMin, xMax, yMin, yMax } }: PictureView, { columns: columnCount, rows: rowCount, resolution: cellSide, origin: [x, y, yaw] }: CellGrid, cellsPerSquare: number): number[] {
  const [xStep, yStep] = [Math.cos(yaw) / cellSide, Math.sin(yaw) / cellSide];
  const viewCorners = [xMin - x, xMax - x].flatMap((dx) => [yMin - y, yMax - y].map((dy) => [dx * xStep + dy * yStep, dy * xStep - dx * yStep]));
  const cellRanges = [columnCount, rowCount].map((cellCount, i) => {
    const cornerCells = viewCorners.map((viewCorner) => clampNumber(viewCorner[i], 0, cellCount));
    return [Math.floor(Math.min(...cornerCells) / cellsPerSquare) * cellsPerSquare, Math.min(cellCount, Math.ceil(Math.max(...cornerCells) / cellsPerSquare) * cellsPerSquare)];
  });
  return [0, 1].flatMap((rangeEnd) => cellRanges.map((cellRange) => cellRange[rangeEnd]));
}

/** Returns the position (m) of the lower left corner of a cell in the grid's own axes. */
export function cellCornerOf({ resolution: cellSide, origin: [x, y, yaw] }: CellGrid, cellColumn: number, cellRow: number): [x: number, y: number] {
  const [xStep, yStep] = [cellSide * Math.cos(yaw), cellSide * Math.sin(yaw)];
  return [x + cellColumn * xStep - cellRow * yStep, y + cellColumn * yStep + cellRow * xStep];
}

/**
 * Fills the cells whose value is 1. If cells are smaller than a pixel, squares of several cells are drawn. A square is filled if one of its
 * cells is filled, so that thin walls stay visible.
 */
function fillCells({ canvasContext, pictureView, pixelRatio }: LayerDrawContext, cellGrid: CellGrid, cellValues: Uint8Array, cellColour: string) {
  const cellsPerSquare = Math.max(1, Math.floor(1 / (cellGrid.resolution * pictureView.scaleX * pixelRatio)));
  const [firstColumn, firstRow, endColumn, endRow] = findVisibleCellRange(pictureView, cellGrid, cellsPerSquare);
  const [width, height] = [Math.ceil((endColumn - firstColumn) / cellsPerSquare), Math.ceil((endRow - firstRow) / cellsPerSquare)];
  if (width < 1 || height < 1) return;
  const squaresImage = new ImageData(width, height);
  const squarePixels = new Uint32Array(squaresImage.data.buffer);
  const [pixelColour] = new Uint32Array(Uint8Array.of(...colourChannelsOf(cellColour), 255).buffer);
  for (let cellRow = firstRow; cellRow < endRow; cellRow++) {
    const rowEnd = cellRow * cellGrid.columns + endColumn;
    let pixelIndex = Math.floor((cellRow - firstRow) / cellsPerSquare) * width;
    for (let i = cellRow * cellGrid.columns + firstColumn; i < rowEnd; pixelIndex++) {
      for (const squareEnd = Math.min(i + cellsPerSquare, rowEnd); i < squareEnd; i++) if (cellValues[i]) squarePixels[pixelIndex] = pixelColour;
    }
  }
  const squaresCanvas = new OffscreenCanvas(width, height);
  createHiddenContext(squaresCanvas).putImageData(squaresImage, 0, 0);
  const cornerPixelOf = (cellColumn: number, cellRow: number) => pictureView.toPixel(...cellCornerOf(cellGrid, cellColumn, cellRow));
  // The first row of the image is the lowest one, as in the grid.
  const [[originX, originY], [rightX, rightY], [aboveX, aboveY]] = [cornerPixelOf(firstColumn, firstRow), cornerPixelOf(firstColumn + cellsPerSquare, firstRow), cornerPixelOf(firstColumn, firstRow + cellsPerSquare)];
  canvasContext.save();
  canvasContext.transform(rightX - originX, rightY - originY, aboveX - originX, aboveY - originY, originX, originY);
  // Cells that are not smaller than a pixel have sharp edges.
  canvasContext.imageSmoothingEnabled = cellsPerSquare > 1;
  canvasContext.drawImage(squaresCanvas, 0, 0);
  canvasContext.restore();
}
