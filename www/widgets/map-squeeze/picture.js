/** Map Squeeze's picture: walls, the robot with its command, and what became of every draw. */

import { clipped, drawAxes, drawDots, drawMark, drawOutline, trace } from '../../scene/draw.js';
import { Picture } from '../../scene/picture.js';
import { View, extentAround } from '../../scene/view.js';
import { WallLayer } from '../../scene/walls.js';
import { clamp } from '../../ui/clamp.js';
import { COMMAND_DASH } from '../shared/command.js';

/**
 * @import { MapSqueeze, Plan, SqueezeSettings } from '../../types.d.ts'
 * @import { Brush } from '../../scene/canvas.js'
 * @import { Extent } from '../../scene/view.js'
 *
 * @typedef {ReturnType<typeof import('./reading.js').readingOf> & {
 *   marked: { pose: Float64Array, path: Float64Array } | undefined,
 * }} Scene
 */

/** Half a cross, CSS pixels. */
const CROSS = 2.6;

/** Radius of a ring: in metres, but legible in a view of a large map and no blot in a close one. */
const RING = { metres: 0.085, least: 3.5, most: 6 };

/** A robot in a view of a large map is drawn no smaller than this, CSS pixels. */
const SMALLEST_ROBOT = 3;

/** Surroundings shown around the commanded way: this many times its length, and at least so many metres. */
const SURROUNDINGS = 0.7;
const MIN_SURROUNDINGS = 0.8;

/** How near to a sample the pointer must be to mark it, CSS pixels. */
const REACH = 12;

/** @extends {Picture<Scene>} */
export class FloorPicture extends Picture {
  plan;
  #near = new View();
  #whole = this.view;
  #walls;

  /**
   * @param {Plan} plan
   * @param {import('../../types.d.ts').Grid | null} grid
   */
  constructor(plan, grid) {
    super('plane', new View());
    this.plan = plan;
    this.#walls = new WallLayer(plan, grid);
  }

  /** Whether the view is of the robot's surroundings only. */
  get close() {
    return this.view === this.#near;
  }

  set close(close) {
    this.view = close ? this.#near : this.#whole;
  }

  /** @param {Scene} scene */
  fit({ commanded, config, poses }) {
    if (!this.close) {
      this.#whole.fit(extentAround(poses, 3, mapped(this.plan, config.start)));
      return;
    }
    const length = Math.abs(config.command.v * config.command.dt);
    const room = Math.max(MIN_SURROUNDINGS, SURROUNDINGS * length) + config.clearance;
    const { xMin, yMin, xMax, yMax } = extentAround(commanded, 2);
    this.#near.fit({ xMin: xMin - room, yMin: yMin - room, xMax: xMax + room, yMax: yMax + room });
  }

  /**
   * The sample nearest to the pointer; −1 for none.
   *
   * @param {MapSqueeze} machine
   * @param {number} x CSS pixels of the canvas
   * @param {number} y
   */
  nearest(machine, x, y) {
    const [worldX, worldY, radius] = this.around(x, y, REACH);
    return machine.nearest(worldX, worldY, radius);
  }

  /** @type {Picture<Scene>['paint']} */
  paint = (brush, { sorted, poses, paths, commanded, config, marked }) => {
    const { palette } = brush;
    drawAxes(brush, { x: 'x (m)', y: 'y (m)' });
    clipped(brush, () => {
      // What passes through a wall must not hide it.
      drawPaths(brush, paths);
      drawDots(brush, sorted.accepted, { x: 0, y: 1, heading: 2 });
      drawRings(brush, poses, sorted.through);
      this.#walls.draw(brush);
      drawCrosses(brush, sorted.rejected);
      drawOutline(brush, commanded, { colour: palette.prior, width: 2.5, dash: COMMAND_DASH });
      drawRobots(brush, config, commanded);
      if (marked) {
        const { pose, path } = marked;
        drawOutline(brush, path, { colour: palette.ink, width: 1.5, dash: [2, 3] });
        drawMark(brush, { x: pose[0], y: pose[1], heading: pose[2] }, palette.ink);
      }
    });
  };
}

/**
 * The part of a plan that has walls, as long as the robot is in it; otherwise all of it. Around what
 * a robot has mapped there is often as much again of which nothing is known.
 *
 * @param {Plan} plan
 * @param {{ x: number, y: number }} robot
 */
function mapped({ bounds, walls }, { x, y }) {
  const [xMin, yMin, xMax, yMax] = bounds;
  const box = extentAround(walls, 2, { xMin: x, yMin: y, xMax: x, yMax: y });
  const inside = box.xMin < x && x < box.xMax && box.yMin < y && y < box.yMax;
  return inside ? box : { xMin, yMin, xMax, yMax };
}

/**
 * @param {Brush} brush
 * @param {Float64Array} triples
 */
function drawCrosses({ context, view, palette }, triples) {
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
 * @param {Brush} brush
 * @param {Float64Array[]} paths
 */
function drawPaths(brush, paths) {
  const { context, palette } = brush;
  context.strokeStyle = palette.accent;
  context.lineWidth = 1;
  context.globalAlpha = 0.3;
  for (const path of paths) {
    trace(brush, path);
    context.stroke();
  }
  context.globalAlpha = 1;
}

/**
 * @param {Brush} brush
 * @param {Float64Array} poses
 * @param {number[]} through indices of those to ring
 */
function drawRings({ context, view, palette }, poses, through) {
  const radius = clamp(RING.metres * view.scaleX, RING.least, RING.most);
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
 * @param {Brush} brush
 * @param {SqueezeSettings} config
 * @param {Float64Array} commanded
 */
function drawRobots({ context, view, palette }, { start, clearance }, commanded) {
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
