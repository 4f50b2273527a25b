/**
 * Map Squeeze's picture: walls, the robot with its command, and what became of every draw.
 *
 * @module
 */

import { prepare } from '../../scene/canvas.js';
import { DASHES, clipped, drawAxes, drawDots, drawMark, drawOutline } from '../../scene/draw.js';
import { View, extentOf } from '../../scene/view.js';
import { WallLayer } from '../../scene/walls.js';
import { VERDICT } from './words.js';

/**
 * @typedef {import('../../types.d.ts').Palette} Palette
 * @typedef {import('../../types.d.ts').Plan} Plan
 * @typedef {import('../../types.d.ts').SqueezeSettings} Settings
 *
 * @typedef {object} Scene
 * @property {Settings} config
 * @property {Float64Array} commanded
 * @property {Sorted} sorted
 * @property {Float64Array[]} paths of those through a wall
 * @property {{ pose: Float64Array, path: Float64Array } | undefined} marked
 *
 * @typedef {ReturnType<typeof sort>} Sorted
 */

/** Half a cross, CSS pixels. */
const CROSS = 2.6;

/** Radius of a ring: in metres, but legible in a view of a large map and no blot in a close one. */
const RING = { metres: 0.085, least: 3.5, most: 6 };

/** A robot in a view of a large map is drawn no smaller than this, CSS pixels. */
const SMALLEST_ROBOT = 3;

/** Surroundings shown around the commanded way: this many times its length, and at least so many metres. */
const SURROUNDINGS = 0.7;
const LEAST_SURROUNDINGS = 0.8;

/**
 * Sorts draws by what became of them.
 *
 * @param {Float64Array} poses
 * @param {Uint8Array} verdicts
 */
export function sort(poses, verdicts) {
  /** @type {number[]} */
  const rejected = [];
  /** @type {number[]} */
  const accepted = [];
  /** @type {number[]} indices */
  const through = [];
  for (let i = 0; i < verdicts.length; i++) {
    const pose = [poses[3 * i], poses[3 * i + 1], poses[3 * i + 2]];
    if ((verdicts[i] & VERDICT.accepted) === 0) {
      rejected.push(...pose);
      continue;
    }
    accepted.push(...pose);
    if ((verdicts[i] & VERDICT.pathFree) === 0) through.push(i);
  }
  return { poses, rejected, accepted: Float64Array.from(accepted), through };
}

export class FloorPicture {
  /** Whether the view is of the robot's surroundings only. */
  close = false;
  #plan;
  #near = newView();
  #whole = newView();
  #walls;

  /**
   * @param {Plan} plan
   * @param {import('../../types.d.ts').Grid | null} grid
   */
  constructor(plan, grid) {
    this.#plan = plan;
    this.#walls = new WallLayer(plan, grid);
  }

  get view() {
    return this.close ? this.#near : this.#whole;
  }

  /** @param {Scene} scene */
  #fit({ commanded, config, sorted }) {
    if (!this.close) {
      this.#whole.fit(including(mapped(this.#plan, config.start), sorted.poses));
      return;
    }
    const length = Math.abs(config.command.v * config.command.dt);
    const room = Math.max(LEAST_SURROUNDINGS, SURROUNDINGS * length) + config.clearance;
    /** @type {[number, number][]} */
    const points = [];
    for (let i = 0; i < commanded.length; i += 2) {
      const [x, y] = [commanded[i], commanded[i + 1]];
      points.push([x - room, y - room], [x + room, y + room]);
    }
    this.#near.fit(extentOf(points, 0));
  }

  /**
   * @param {HTMLCanvasElement | import('../../scene/canvas.js').Surface} canvas
   * @param {Scene} scene
   * @param {Palette} palette
   * @param {number} elapsed milliseconds since the frame before
   * @param {{ still: boolean, atOnce: boolean }} motion whether the view stays where it is, and
   *   whether it goes without easing
   * @returns {boolean} whether the view is still moving
   */
  draw(canvas, scene, palette, elapsed, { still, atOnce }) {
    const { view } = this;
    const { context, ratio, font } = prepare(canvas, view);
    if (!still) this.#fit(scene);
    const moving = view.ease(elapsed, atOnce);
    drawAxes(context, view, palette, { x: 'x (m)', y: 'y (m)', font });
    clipped(context, view, () => {
      const { sorted, commanded, config, marked } = scene;
      // What passes through a wall must not hide it.
      drawPaths(context, view, palette, scene.paths);
      drawDots(context, view, palette, sorted.accepted, { x: 0, y: 1, heading: 2, ratio });
      drawRings(context, view, palette, sorted);
      this.#walls.draw(context, view, palette, ratio);
      drawCrosses(context, view, palette, sorted.rejected);
      drawOutline(context, view, palette, commanded, {
        colour: palette.prior,
        width: 2.5,
        dash: DASHES.command,
      });
      drawRobots(context, view, palette, config, commanded);
      if (marked) {
        const { pose, path } = marked;
        const ink = { ...palette, accent: palette.ink };
        drawOutline(context, view, palette, path, { colour: palette.ink, width: 1.5, dash: [2, 3] });
        drawMark(context, view, ink, { x: pose[0], y: pose[1], heading: pose[2] });
      }
    });
    return moving;
  }
}

function newView() {
  return new View({ equal: true, inset: { left: 42, right: 8, top: 24, bottom: 30 } });
}

/**
 * The part of a plan that has walls, as long as the robot is in it; otherwise all of it. Around what
 * a robot has mapped there is often as much again of which nothing is known.
 *
 * @param {Plan} plan
 * @param {{ x: number, y: number }} robot
 * @returns {import('../../types.d.ts').Extent}
 */
function mapped({ bounds, walls }, { x, y }) {
  const [xMin, yMin, xMax, yMax] = bounds;
  const box = { xMin: x, yMin: y, xMax: x, yMax: y };
  for (let i = 0; i < walls.length; i += 2) {
    box.xMin = Math.min(box.xMin, walls[i]);
    box.xMax = Math.max(box.xMax, walls[i]);
    box.yMin = Math.min(box.yMin, walls[i + 1]);
    box.yMax = Math.max(box.yMax, walls[i + 1]);
  }
  const inside = box.xMin < x && x < box.xMax && box.yMin < y && y < box.yMax;
  return inside ? box : { xMin, yMin, xMax, yMax };
}

/**
 * @param {import('../../types.d.ts').Extent} extent
 * @param {Float64Array} poses
 * @returns {import('../../types.d.ts').Extent} grown to where they are
 */
function including({ ...extent }, poses) {
  for (let i = 0; i < poses.length; i += 3) {
    extent.xMin = Math.min(extent.xMin, poses[i]);
    extent.xMax = Math.max(extent.xMax, poses[i]);
    extent.yMin = Math.min(extent.yMin, poses[i + 1]);
    extent.yMax = Math.max(extent.yMax, poses[i + 1]);
  }
  return extent;
}

/**
 * @param {CanvasRenderingContext2D} context
 * @param {View} view
 * @param {Palette} palette
 * @param {number[]} triples
 */
function drawCrosses(context, view, palette, triples) {
  context.beginPath();
  for (let i = 0; i < triples.length; i += 3) {
    const [x, y] = [view.toPixelX(triples[i]), view.toPixelY(triples[i + 1])];
    context.moveTo(x - CROSS, y - CROSS);
    context.lineTo(x + CROSS, y + CROSS);
    context.moveTo(x - CROSS, y + CROSS);
    context.lineTo(x + CROSS, y - CROSS);
  }
  context.strokeStyle = palette.muted;
  context.lineWidth = 1;
  context.globalAlpha = 0.5;
  context.stroke();
  context.globalAlpha = 1;
}

/**
 * @param {CanvasRenderingContext2D} context
 * @param {View} view
 * @param {Palette} palette
 * @param {Float64Array[]} paths
 */
function drawPaths(context, view, palette, paths) {
  context.strokeStyle = palette.accent;
  context.lineWidth = 1;
  context.globalAlpha = 0.3;
  for (const path of paths) {
    context.beginPath();
    context.moveTo(view.toPixelX(path[0]), view.toPixelY(path[1]));
    for (let i = 2; i < path.length; i += 2) {
      context.lineTo(view.toPixelX(path[i]), view.toPixelY(path[i + 1]));
    }
    context.stroke();
  }
  context.globalAlpha = 1;
}

/**
 * @param {CanvasRenderingContext2D} context
 * @param {View} view
 * @param {Palette} palette
 * @param {Sorted} sorted
 */
function drawRings(context, view, palette, { poses, through }) {
  const radius = Math.min(RING.most, Math.max(RING.least, RING.metres * view.scaleX));
  context.beginPath();
  for (const i of through) {
    const [x, y] = [view.toPixelX(poses[3 * i]), view.toPixelY(poses[3 * i + 1])];
    context.moveTo(x + radius, y);
    context.arc(x, y, radius, 0, 2 * Math.PI);
  }
  context.strokeStyle = palette.accent;
  context.lineWidth = 1;
  context.globalAlpha = 0.8;
  context.stroke();
  context.globalAlpha = 1;
}

/**
 * The robot where it starts, and its outline where the command would bring it.
 *
 * @param {CanvasRenderingContext2D} context
 * @param {View} view
 * @param {Palette} palette
 * @param {Settings} config
 * @param {Float64Array} commanded
 */
function drawRobots(context, view, palette, { start, clearance }, commanded) {
  const radius = Math.max(SMALLEST_ROBOT, clearance * view.scaleX);
  const [endX, endY] = commanded.slice(-2);
  context.strokeStyle = palette.prior;
  context.lineWidth = 1.5;
  context.setLineDash([3, 3]);
  context.beginPath();
  context.arc(view.toPixelX(endX), view.toPixelY(endY), radius, 0, 2 * Math.PI);
  context.stroke();
  context.setLineDash([]);

  const [x, y] = [view.toPixelX(start.x), view.toPixelY(start.y)];
  const ahead = view.direction(start.theta);
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
  context.fillStyle = palette.paper;
  context.fill();
  context.moveTo(x, y);
  const tick = turnDistance(view, clearance);
  context.lineTo(x + tick * ahead.x, y + tick * ahead.y);
  context.lineWidth = 2.25;
  context.stroke();
}

/**
 * How far ahead of the robot's centre the handle is that turns it.
 *
 * @param {View} view
 * @param {number} clearance metres
 * @returns {number} CSS pixels
 */
export function turnDistance(view, clearance) {
  return Math.max(34, clearance * view.scaleX + 22);
}
