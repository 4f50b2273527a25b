/** Map Squeeze's picture: walls, the robot with its command, and what became of every draw. */

import { words } from '../../messages/registry.js';
import { clipped, drawAxes } from '../../scene/axes.js';
import { densityRamp, drawDensity, drawDots, drawMark, drawOutline, trace } from '../../scene/draw.js';
import { SamplesPicture } from '../../scene/picture.js';
import { View, extentAround } from '../../scene/view.js';
import { WallLayer, cornerOf } from '../../scene/walls.js';
import { clamp } from '../../ui/clamp.js';
import { COMMAND_DASH } from '../shared/command.js';
import { drawHeldRobot, drawRobotOutline } from '../shared/robot.js';
import { keptWords } from './words.js';

/**
 * @import { MapSqueeze, Plan, SqueezeSettings } from '../../types.d.ts'
 * @import { Brush } from '../../scene/canvas.js'
 * @import { Extent } from '../../scene/view.js'
 * @import { Cells } from '../../scene/walls.js'
 *
 * @typedef {ReturnType<typeof import('./reading.js').readingOf> & {
 *   machine: MapSqueeze,
 *   marked: { pose: Float64Array, path: Float64Array } | undefined,
 * }} Scene
 */

/** Half a cross, CSS pixels. */
const CROSS = 2.6;

/** Radius of a ring: in metres, but legible in a view of a large map and no blot in a close one. */
const RING = { metres: 0.085, least: 3.5, most: 6 };

/** Surroundings shown around the end of the command: this many times its length, and at least so many metres. */
const SURROUNDINGS = 0.8;
const MIN_SURROUNDINGS = 0.8;

/** Room shown around the commanded way, metres. */
const WAYSIDE = 0.45;

/** Cells of the density, CSS pixels, of many samples and of few, which need larger ones to be a density. */
const CELL = { least: 2, most: 5, samples: 40_000 };

/** Paths that a density is drawn with: more would hide it. */
const PATHS_ON_DENSITY = 25;

/** The overview in a corner of a close-up: its sides at most, as shares of the picture's, and what is around it. */
const OVERVIEW = { width: 0.34, height: 0.4, margin: 8, padding: 0.05, wall: 1.25 };

/** @extends {SamplesPicture<Scene>} */
export class FloorPicture extends SamplesPicture {
  plan;
  /** Whether there are cells of which the map says nothing. */
  hasUnknown;
  #near = new View();
  #whole = this.view;
  #walls;
  #overview;
  /** Corners of what the map knows: what is around it may be much more. @type {ArrayLike<number>} */
  #known;
  #pixels = new OffscreenCanvas(1, 1);

  /**
   * @param {Plan} plan
   * @param {Cells | null} grid
   * @param {FloorPicture} [former] the picture whose place it takes: where the map is as large, the views stay where they are
   */
  constructor(plan, grid, former) {
    super('plane', new View());
    this.plan = plan;
    this.hasUnknown = grid?.unknown !== undefined;
    this.#walls = new WallLayer(plan, grid);
    this.#overview = new WallLayer(plan, grid, OVERVIEW.wall);
    this.#known = grid?.unknown ? knownCorners(grid, grid.unknown) : plan.walls;
    if (former?.plan.bounds.every((bound, i) => bound === plan.bounds[i])) {
      this.#near = former.#near;
      this.#whole = former.#whole;
      this.view = former.view;
    }
  }

  /** Whether the view is of the robot's surroundings only. */
  get close() {
    return this.view === this.#near;
  }

  set close(close) {
    if (close === this.close) return;
    this.view = close ? this.#near : this.#whole;
    this.view.forget();
  }

  /** @param {Scene} scene */
  fit({ commanded, config, poses }) {
    if (!this.close) {
      this.#whole.fit(extentAround(poses, 3, this.#mapped(config.start)));
      return;
    }
    const length = Math.abs(config.command.v * config.command.dt);
    const room = Math.max(MIN_SURROUNDINGS, SURROUNDINGS * length) + config.clearance;
    const [x, y] = commanded.slice(-2);
    const way = extentAround(commanded, 2);
    const wayside = [way.xMin - WAYSIDE, way.yMin - WAYSIDE, way.xMax + WAYSIDE, way.yMax + WAYSIDE];
    this.#near.fit(extentAround([...wayside, x - room, y - room, x + room, y + room], 2));
  }

  /**
   * The part of the plan of which something is known, as long as the robot is in it; otherwise all of it.
   *
   * @param {{ x: number, y: number }} robot
   */
  #mapped({ x, y }) {
    const [xMin, yMin, xMax, yMax] = this.plan.bounds;
    const box = extentAround(this.#known, 2, { xMin: x, yMin: y, xMax: x, yMax: y });
    const inside = box.xMin < x && x < box.xMax && box.yMin < y && y < box.yMax;
    return inside ? box : { xMin, yMin, xMax, yMax };
  }

  /** @type {SamplesPicture<Scene>['paint']} */
  paint = (brush, scene) => {
    const { sorted, paths, commanded, config, marked } = scene;
    const { palette } = brush;
    drawAxes(brush, { x: 'x (m)', y: 'y (m)' }, keyOf(brush, scene));
    clipped(brush, () => {
      // What passes through a wall must not hide it.
      if (sorted) {
        drawPaths(brush, paths);
        const layout = { x: 0, y: 1, heading: 2 };
        drawDots(brush, sorted.free, layout);
        drawDots({ ...brush, palette: { ...palette, cloud: palette.accent } }, sorted.through, layout);
        drawRings(brush, sorted.through);
        this.#walls.draw(brush);
        drawCrosses(brush, sorted.rejected);
      } else {
        this.#drawDensity(brush, scene);
        this.#walls.draw(brush);
        drawPaths(brush, paths.slice(0, PATHS_ON_DENSITY));
      }
      drawOutline(brush, commanded, { colour: palette.prior, width: 2.5, dash: COMMAND_DASH });
      const { start, clearance } = config;
      const [endX, endY] = commanded.slice(-2);
      drawRobotOutline(brush, endX, endY, clearance, palette.prior);
      drawHeldRobot(brush, start, clearance, palette.prior);
      if (marked) {
        const { pose, path } = marked;
        drawOutline(brush, path, { colour: palette.ink, width: 1.5, dash: [2, 3] });
        drawMark(brush, { x: pose[0], y: pose[1], heading: pose[2] }, palette.ink);
      }
    });
    if (this.close) this.#drawOverview(brush, scene);
  };

  /**
   * @param {Brush} brush
   * @param {Scene} scene
   */
  #drawDensity(brush, { machine, stats }) {
    const { palette } = brush;
    const ramps = [palette.truth, palette.cloud, palette.accent].flatMap((cloud) => [...densityRamp({ ...palette, cloud })]);
    const cell = clamp(CELL.most * Math.sqrt(CELL.samples / stats.attempts) / 2, CELL.least, CELL.most);
    drawDensity(brush, this.#pixels, cell, (...part) => machine.picture(...part, Uint8Array.from(ramps)));
  }

  /**
   * The whole map in a corner, with the part that the picture shows.
   *
   * @param {Brush} brush
   * @param {Scene} scene
   */
  #drawOverview(brush, { config: { start }, commanded }) {
    const { context, palette, view } = brush;
    const { left, right, top, bottom } = view.frame;
    const { xMin, yMin, xMax, yMax } = this.#mapped(start);
    const [spanX, spanY] = [xMax - xMin, yMax - yMin].map((span) => (1 + 2 * OVERVIEW.padding) * span);
    const scale = Math.min((OVERVIEW.width * (right - left)) / spanX, (OVERVIEW.height * (bottom - top)) / spanY);
    const [width, height] = [scale * spanX, scale * spanY];
    // At the bottom, on the side that the commanded way does not end on.
    const endsRight = 2 * view.toPixelX(commanded[commanded.length - 2]) > left + right;
    const [x, y] = [endsRight ? left + OVERVIEW.margin : right - OVERVIEW.margin - width, bottom - OVERVIEW.margin - height];
    const small = new View({ left: x, right: view.width - x - width, top: y, bottom: view.height - y - height });
    small.resize(view.width, view.height);
    const [padX, padY] = [OVERVIEW.padding * (xMax - xMin), OVERVIEW.padding * (yMax - yMin)];
    small.extent = { xMin: xMin - padX, yMin: yMin - padY, xMax: xMax + padX, yMax: yMax + padY };
    const overview = { ...brush, view: small };
    context.beginPath();
    context.rect(x, y, width, height);
    context.fillStyle = palette.paper;
    context.fill();
    clipped(overview, () => {
      // The walls themselves come first.
      this.#overview.draw(overview);
      drawOutline(overview, commanded, { colour: palette.prior, width: 1.5, dash: [] });
      const [fromX, toX] = [view.extent.xMin, view.extent.xMax].map((at) => small.toPixelX(at));
      const [fromY, toY] = [view.extent.yMax, view.extent.yMin].map((at) => small.toPixelY(at));
      context.strokeStyle = palette.ink;
      context.lineWidth = 1.25;
      context.strokeRect(fromX, fromY, toX - fromX, toY - fromY);
    });
    context.strokeStyle = palette.muted;
    context.lineWidth = 1;
    context.strokeRect(x, y, width, height);
  }
}

/**
 * The corners of the box of cells of which a grid says something, as x, y pairs.
 *
 * @param {Cells} grid
 * @param {Uint8Array} unknown
 */
function knownCorners(grid, unknown) {
  const { columns } = grid;
  const box = { left: Infinity, bottom: Infinity, right: -Infinity, top: -Infinity };
  for (let row = 0; row * columns < unknown.length; row++) {
    const cells = unknown.subarray(row * columns, (row + 1) * columns);
    const first = cells.indexOf(0);
    if (first < 0) continue;
    box.left = Math.min(box.left, first);
    box.right = Math.max(box.right, cells.lastIndexOf(0) + 1);
    box.bottom = Math.min(box.bottom, row);
    box.top = row + 1;
  }
  if (box.left > box.right) return [];
  const { left, bottom, right, top } = box;
  return [left, right].flatMap((column) => [bottom, top].flatMap((row) => cornerOf(grid, column, row)));
}

/**
 * What the marks are, or the colours of a density.
 *
 * @param {Brush} brush
 * @param {Scene} scene
 * @returns {import('../../scene/axes.js').KeyEntry[]}
 */
function keyOf({ context, palette }, { config, sorted }) {
  /** @typedef {(x: number, y: number) => void} Shape */
  const circle = (/** @type {number} */ x, /** @type {number} */ y, /** @type {number} */ radius) => {
    context.moveTo(x + radius, y);
    context.arc(x, y, radius, 0, 2 * Math.PI);
  };
  /** @type {Shape} */
  const dot = (x, y) => {
    circle(x, y, 2);
    context.fill();
  };
  /** @type {Shape} */
  const ringed = (x, y) => {
    dot(x, y);
    circle(x, y, 5);
  };
  /** @type {Shape} */
  const patch = (x, y) => {
    context.rect(x - 5, y - 5, 10, 10);
    context.fill();
  };
  const entry = (/** @type {string} */ name, /** @type {string} */ colour, /** @type {Shape} */ shape) => ({
    name,
    draw: (/** @type {number} */ x, /** @type {number} */ y, /** @type {number} */ width) => {
      context.strokeStyle = context.fillStyle = colour;
      context.lineWidth = 1;
      context.beginPath();
      (sorted ? shape : patch)(x + width / 2, y);
      context.stroke();
    },
  });
  const { kept, ofThem } = keptWords(config);
  const entries = [entry(kept, palette.cloud, dot), entry(ofThem, palette.accent, ringed)];
  return config.conditioned ? [...entries, entry(words.squeeze.rejected, palette.muted, (x, y) => cross(context, x, y))] : entries;
}

/**
 * @param {Brush['context']} context
 * @param {number} x CSS pixels
 * @param {number} y
 */
function cross(context, x, y) {
  context.moveTo(x - CROSS, y - CROSS);
  context.lineTo(x + CROSS, y + CROSS);
  context.moveTo(x - CROSS, y + CROSS);
  context.lineTo(x + CROSS, y - CROSS);
}

/**
 * @param {Brush} brush
 * @param {Float64Array} triples
 */
function drawCrosses({ context, view, palette }, triples) {
  context.beginPath();
  for (let i = 0; i < triples.length; i += 3) cross(context, view.toPixelX(triples[i]), view.toPixelY(triples[i + 1]));
  context.strokeStyle = palette.muted;
  context.lineWidth = 1;
  context.globalAlpha = 0.5;
  context.stroke();
  context.globalAlpha = 1;
}

/**
 * @param {Brush} brush
 * @param {Float64Array[]} paths
 */
function drawPaths(brush, paths) {
  const { context, palette } = brush;
  context.strokeStyle = palette.accent;
  context.lineWidth = 1;
  context.globalAlpha = 0.3;
  for (const path of paths) {
    context.beginPath();
    trace(brush, path);
    context.stroke();
  }
  context.globalAlpha = 1;
}

/**
 * @param {Brush} brush
 * @param {Float64Array} triples
 */
function drawRings({ context, view, palette }, triples) {
  const radius = clamp(RING.metres * view.scaleX, RING.least, RING.most);
  context.beginPath();
  for (let i = 0; i < triples.length; i += 3) {
    const [x, y] = [view.toPixelX(triples[i]), view.toPixelY(triples[i + 1])];
    context.moveTo(x + radius, y);
    context.arc(x, y, radius, 0, 2 * Math.PI);
  }
  context.strokeStyle = palette.accent;
  context.lineWidth = 1;
  context.globalAlpha = 0.8;
  context.stroke();
  context.globalAlpha = 1;
}
