/** Picture of Map Squeeze: walls, the robot with its command, and the outcome of each sample. */

import { range } from 'd3-array';
import { words } from '../../messages/registry.ts';
import { clipToPlot, drawAxes } from '../../scene/axes.ts';
import { createDensityRamp, createLineLegend, drawCrosshair, drawOutline, createLineStyles } from '../../scene/draw.ts';
import { CachedImage, CachedLayer, MemoizedResult, strokeInBatches } from '../../scene/cache.ts';
import { drawCallouts } from '../../scene/labels.ts';
import { SamplesPicture } from '../../scene/picture.ts';
import { PictureView, cornersAround, extentAround, widenExtent } from '../../scene/view.ts';
import { cellCornerOf, drawWalls, type CellGrid } from '../../scene/walls.ts';
import { limits } from '../../../build/settings.js';
import { clampNumber } from '../../ui/format.ts';
import { drawDraggableRobot, drawRobotOutline } from '../shared/robot.ts';
import { LINE_STYLES, type ViewModel } from './settings.ts';
import type { MapSqueeze, Plan } from '../../types.d.ts';
import { addCross, drawDisc, paintWithOpacity, strokePath, type DrawContext } from '../../scene/canvas.ts';

export interface Scene extends ViewModel {
  simulation: MapSqueeze;
  overlays: string[];
  view: string;
  markedSample: { pose: Float64Array, path: Float64Array, contact: ArrayLike<number> | undefined } | undefined;
}

/** Dot of a sample: minimum and maximum radius (CSS pixels), ratio of the picture's width to the dot's radius, and opacity. */
const SAMPLE_DOT = { minRadius: 2, maxRadius: 3, widthPerRadius: 240, opacity: 0.4 };

/** A close view shows a square around the end of the command. Half of its side is the command's length times this factor, but at least this minimum (m). */
const END_HALF_SIZE_FACTOR = 0.9;
const MIN_END_HALF_SIZE = 0.9;

/** Margin around the commanded path, metres. */
const PATH_MARGIN = 0.55;

/** Margin around the map, relative to its longer side. */
const MAP_MARGIN = 0.025;

/** Cells of the density: minimum and maximum side (CSS pixels), and number of samples at which the side is half the maximum. */
const DENSITY_CELL = { minSize: 2, maxSize: 5, samplesAtHalfSize: 40_000 };

/** Maximum number of paths that are drawn over a density. More paths would hide the density. */
const MAX_PATHS_ON_DENSITY = 25;

/** Number of paths that are drawn in one stroke. A larger number is faster, but crossing paths of the same stroke do not darken each other. */
const PATHS_PER_STROKE = 10;

/** Transparent colours for samples of a kind that the user has hidden. */
const TRANSPARENT_RAMP = new Uint8Array(4 * limits.ramp);

export class FloorPicture extends SamplesPicture<Scene> {
  pictureName = 'plane';
  pictureView: PictureView = new PictureView({ relativeMargin: 0 });
  plan: Plan = { bounds: new Float64Array(4), walls: new Float64Array() };
  /** Cells of the map; null for a floor plan. The walls of a grid outline its cells, and cannot be moved. */
  grid: CellGrid | null = null;
  /** Cached drawing of the map, which may have thousands of walls or cells. It changes only with the map, the view or the colours. */
  #wallLayer = new CachedLayer();
  /** Corners of cells around the known part of the map. This part may be much smaller than the map. */
  #knownCorners: ArrayLike<number> = [];
  #densityImage = new CachedImage();
  #wallPathMemo: MemoizedResult<string> = new MemoizedResult();

  /** Sets the map. If the new map has the same bounds as the previous one, the view does not change. */
  setMap(plan: Plan, grid: CellGrid | null) {
    if (plan.bounds.some((bound, i) => bound !== this.plan.bounds[i])) this.pictureView.clearTarget();
    this.plan = plan;
    this.grid = grid;
    this.#knownCorners = grid?.unknown ? knownCornersOf(grid, grid.unknown) : plan.walls;
  }

  /** Walls as an SVG path (attribute `d`), in metres. */
  get wallPathData() {
    const { walls } = this.plan;
    return this.#wallPathMemo.getResult([walls], () => range(0, walls.length, 4).map((i) => `M${walls[i]} ${walls[i + 1]}L${walls[i + 2]} ${walls[i + 3]}`).join(''));
  }

  fitView({ commanded, config, view }: Scene) {
    const mappedExtent = this.knownExtentOf(config.start);
    this.pictureView.extentLimits = mappedExtent;
    if (view === 'whole') {
      this.pictureView.fitExtent(mappedExtent);
      return;
    }
    const driveLength = Math.abs(config.command.v * config.command.dt);
    const halfSize = Math.max(MIN_END_HALF_SIZE, END_HALF_SIZE_FACTOR * driveLength) + config.clearance;
    const [x, y] = commanded.slice(-2);
    const neededExtent = extentAround(cornersAround(x, y, halfSize), 2, widenExtent(extentAround(commanded, 2), PATH_MARGIN));
    this.pictureView.fitExtent({
      xMin: Math.max(neededExtent.xMin, mappedExtent.xMin),
      yMin: Math.max(neededExtent.yMin, mappedExtent.yMin),
      xMax: Math.min(neededExtent.xMax, mappedExtent.xMax),
      yMax: Math.min(neededExtent.yMax, mappedExtent.yMax),
    });
  }

  /** Returns the extent of the known part of the map if the robot is in it, and of the whole map otherwise. */
  knownExtentOf({ x, y }: { x: number, y: number }) {
    const [xMin, yMin, xMax, yMax] = this.plan.bounds;
    const knownExtent = extentAround(this.#knownCorners, 2, { xMin: x, yMin: y, xMax: x, yMax: y });
    const isInside = knownExtent.xMin < x && x < knownExtent.xMax && knownExtent.yMin < y && y < knownExtent.yMax;
    const extent = isInside ? knownExtent : { xMin, yMin, xMax, yMax };
    return widenExtent(extent, MAP_MARGIN * Math.max(extent.xMax - extent.xMin, extent.yMax - extent.yMin));
  }

  paintPicture: SamplesPicture<Scene>['paintPicture'] = (drawContext, scene) => {
    const { posesByOutcome, paths, commanded, config, markedSample, overlays } = scene;
    const { palette } = drawContext;
    const { accepted, through, rejected, commanded: commandStyle, unknown } = createLineStyles(drawContext, LINE_STYLES, overlays);
    drawAxes(drawContext, { x: 'x (m)', y: 'y (m)' }, createLineLegend(drawContext, { accepted, through, rejected }, ['accepted', 'through', 'rejected'], words.squeeze.overlays));
    clipToPlot(drawContext, () => {
      // The walls are drawn after the paths, so that a path through a wall does not cover the wall.
      if (posesByOutcome) {
        if (through) drawPaths(drawContext, paths, through.colour);
        if (accepted) drawSamples(drawContext, posesByOutcome.accepted, accepted.colour);
        if (through) drawSamples(drawContext, posesByOutcome.through, through.colour);
        drawWalls(drawContext, this.#wallLayer, this.plan, this.grid, unknown !== undefined);
        if (rejected) drawCrosses(drawContext, posesByOutcome.rejected, rejected.colour);
      } else {
        this.#drawDensity(drawContext, scene);
        drawWalls(drawContext, this.#wallLayer, this.plan, this.grid, unknown !== undefined);
        if (through) drawPaths(drawContext, paths.slice(0, MAX_PATHS_ON_DENSITY), through.colour);
      }
      const { start, clearance } = config;
      if (commandStyle) {
        drawOutline(drawContext, commanded, commandStyle);
        const [endX, endY] = commanded.slice(-2);
        drawRobotOutline(drawContext, endX, endY, clearance, commandStyle.colour);
      }
      drawDraggableRobot(drawContext, start, clearance, palette.prior);
      if (markedSample) {
        const { pose, path, contact } = markedSample;
        drawOutline(drawContext, path, { colour: palette.ink, width: 1.5, dash: [2, 3] });
        drawCrosshair(drawContext, { x: pose[0], y: pose[1], heading: pose[2] }, palette.ink);
        if (contact) drawCallouts(drawContext, [{ text: words.squeeze.contactLabel, point: [contact[0], contact[1]] }], { shapeCentre: [start.x, start.y], avoidedLines: [path] });
      }
    });
  };

  #drawDensity(drawContext: DrawContext, { simulation, stats, overlays }: Scene) {
    const { palette } = drawContext;
    const outcomeColours = [['rejected', palette.truth], ['accepted', palette.cloud], ['through', palette.accent]] as const;
    const outcomeRamps = outcomeColours.flatMap(([name, cloud]) => [...(overlays.includes(name) ? createDensityRamp({ ...palette, cloud }) : TRANSPARENT_RAMP)]);
    const cellSize = clampNumber(DENSITY_CELL.maxSize * Math.sqrt(DENSITY_CELL.samplesAtHalfSize / stats.attempts) / 2, DENSITY_CELL.minSize, DENSITY_CELL.maxSize);
    this.#densityImage.drawDensity(drawContext, cellSize, [stats, palette, overlays], (...viewPart) => simulation.picture(...viewPart, Uint8Array.from(outcomeRamps)));
  }
}

/** Returns the outer corners of the first and last known cells in each row of a grid, as x, y pairs. */
function knownCornersOf(grid: CellGrid, unknownFlags: Uint8Array) {
  const { columns } = grid;
  return Array.from({ length: unknownFlags.length / columns }, (_, rowIndex) => {
    const rowCells = unknownFlags.subarray(rowIndex * columns, (rowIndex + 1) * columns);
    const outerColumns = rowCells.includes(0) ? [rowCells.indexOf(0), rowCells.lastIndexOf(0) + 1] : [];
    return outerColumns.flatMap((columnIndex) => [rowIndex, rowIndex + 1].flatMap((cornerRow) => cellCornerOf(grid, columnIndex, cornerRow)));
  }).flat();
}

function drawCrosses({ canvasContext, pictureView }: DrawContext, poses: Float64Array, lineColour: string) {
  paintWithOpacity(canvasContext, 0.5, () => strokePath(canvasContext, { colour: lineColour, width: 1 }, () => {
    for (let i = 0; i < poses.length; i += 3) addCross(canvasContext, ...pictureView.toPixel(poses[i], poses[i + 1]));
  }));
}

function drawPaths({ canvasContext, pictureView }: DrawContext, paths: Float64Array[], lineColour: string) {
  paintWithOpacity(canvasContext, 0.3, () => strokeInBatches(canvasContext, paths.map((path) => pictureView.toPixels(path)), { colour: lineColour, width: 1 }, PATHS_PER_STROKE));
}

/** Draws samples as transparent dots, which look darker where they overlap. */
function drawSamples({ canvasContext, pictureView }: DrawContext, poses: Float64Array, dotColour: string) {
  const dotRadius = clampNumber(pictureView.width / SAMPLE_DOT.widthPerRadius, SAMPLE_DOT.minRadius, SAMPLE_DOT.maxRadius);
  paintWithOpacity(canvasContext, SAMPLE_DOT.opacity, () => {
    for (let i = 0; i < poses.length; i += 3) drawDisc(canvasContext, pictureView.toPixel(poses[i], poses[i + 1]), dotRadius, dotColour);
  });
}
