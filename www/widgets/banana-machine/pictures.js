/** The Banana Machine's two pictures of the same robots: the floor from above, and exponential coordinates. */

import { words } from '../../messages/registry.js';
import { clipped, drawAxes } from '../../scene/axes.js';
import {
  densityRamp,
  drawDensity,
  drawDots,
  drawGhosts,
  drawHandle,
  drawHeap,
  drawMark,
  drawOutline,
  drawOutlines,
  drawRobot,
  hasLength,
  lineStyles,
} from '../../scene/draw.js';
import { drawLabel } from '../../scene/labels.js';
import { Picture } from '../../scene/picture.js';
import { View, extentOf } from '../../scene/view.js';
import { counted } from '../../ui/format.js';
import { lineKey } from '../shared/line-key.js';
import { deviation } from './reading.js';
import { LINES } from './settings.js';

/**
 * @import { BananaMachine, Moments } from '../../types.d.ts'
 * @import { Brush } from '../../scene/canvas.js'
 *
 * @typedef {import('./reading.js').Reading & {
 *   machine: BananaMachine,
 *   overlays: Record<import('./settings.js').LineName, boolean>,
 *   marked: import('../../types.d.ts').Inspection | undefined,
 * }} Scene what both pictures are of
 */

/** A larger cloud is drawn as a density: dots would be one blot, and cost more than a frame. */
const MAX_DOTS = 1000;

/** Rays of a fan of headings: more look no different. */
const MAX_RAYS = 400;

/** A cloud whose standard deviation is below this many pixels is drawn as one place. */
const ONE_PLACE = 0.6;

/** Standard deviations around the mean that a view makes room for. */
const ROOM = 3.2;

/** Radius of the ring at the end of the arc, pixels. */
const RING = 7.5;

/** How near to a robot the pointer must be to mark it, CSS pixels. */
const REACH = 14;

/**
 * A picture of the robots: as dots, or as a density.
 *
 * @extends {Picture<Scene, import('../../types.d.ts').ViewName>}
 */
class CloudPicture extends Picture {
  #grid = new OffscreenCanvas(1, 1);

  /**
   * The robot nearest to the pointer; −1 for none.
   *
   * @param {BananaMachine} machine
   * @param {number} x CSS pixels of the canvas
   * @param {number} y
   */
  nearest(machine, x, y) {
    return machine.nearest(this.name, ...this.around(x, y, REACH));
  }

  /**
   * @param {Brush} brush
   * @param {BananaMachine} machine
   * @param {number} area that the robots cover, square pixels
   */
  paintCloud(brush, machine, area) {
    const { name } = this;
    const { palette } = brush;
    if (machine.shown <= MAX_DOTS) {
      if (name === 'plane') drawDots(brush, machine.poses, { x: 0, y: 1, heading: 2 });
      else drawDots(brush, machine.twists, { x: 0, y: 2, heading: null });
      return;
    }
    const ramp = densityRamp(palette);
    drawDensity(brush, this.#grid, cellSize(area, machine.shown), (...part) => machine.picture(name, ...part, ramp));
  }
}

/**
 * Cells of the density, CSS pixels: fine when there are robots enough to fill them.
 *
 * @param {number} area that the cloud covers, square pixels
 * @param {number} count
 */
function cellSize(area, count) {
  return Math.min(7, Math.max(2, Math.round(Math.sqrt((3 * area) / count))));
}

/** @typedef {import('./settings.js').LineName} OutlineName in the order that they are painted in, and that the key names them in */
const PAINTED = /** @type {const} @satisfies {OutlineName[]} */ (['additive', 'linearized', 'ellipse', 'exponential', 'command']);
const NAMED = /** @type {const} @satisfies {OutlineName[]} */ (['ellipse', 'exponential', 'linearized', 'additive', 'command']);

/** The floor from above. */
export class PlanePicture extends CloudPicture {
  constructor() {
    super('plane', new View());
  }

  /** @param {Scene} scene */
  fit({ contours, table, end, overlays }) {
    const { mean, cov } = table.exact;
    const [sx, sy] = [ROOM * deviation(cov[0][0]), ROOM * deviation(cov[1][1])];
    const points = [mean[0] - sx, mean[1] - sy, mean[0] + sx, mean[1] + sy, ...contours.command];
    // The only outline that may be much larger than the cloud.
    if (overlays.additive) points.push(...contours.additive);
    const box = extentOf(points, 0.4);
    // Around the end there is room for a fan of headings, which may be all there is to see.
    const fan = 0.2 * (box.xMax - box.xMin);
    const [x, y] = end;
    this.view.fit(extentOf([...points, x - fan, y - fan, x + fan, y + fan], 0.4));
  }

  /** @type {Picture<Scene>['paint']} */
  paint = (brush, scene) => {
    const { view, palette } = brush;
    const { machine, contours, overlays, table, marked, end } = scene;
    const styles = lineStyles(brush, LINES);
    const drawn = (/** @type {OutlineName} */ name) => overlays[name] && hasLength(contours[name]);
    const key = NAMED.filter(drawn).map((name) => lineKey(brush, words.banana.overlays[name], styles[name]));
    drawAxes(brush, { x: 'x (m)', y: 'y (m)' }, brush.exported ? key : []);
    clipped(brush, () => {
      const { cov } = table.exact;
      const heaped = deviation(cov[0][0] + cov[1][1]) * view.scaleX < ONE_PLACE;
      if (!heaped) {
        const determinant = Math.max(0, cov[0][0] * cov[1][1] - cov[0][1] * cov[1][0]);
        const area = 4 * Math.PI * Math.sqrt(determinant) * view.scaleX * view.scaleY;
        this.paintCloud(brush, machine, area);
      }
      drawRobot(brush, { x: 0, y: 0, heading: 0, colour: palette.truth });
      const outlines = (/** @type {Scene['contours']} */ of) => PAINTED.filter(drawn).map((name) => ({ points: of[name], ...styles[name] }));
      if (brush.former) drawGhosts(brush, outlines(brush.former.contours));
      drawOutlines(brush, outlines(contours));
      if (overlays.command && scene.reading) drawReading(brush, scene.reading, end);
      if (heaped && machine.shown > 0) drawHeap(brush, heapOf(machine));
      drawHandle(brush, { x: view.toPixelX(end[0]), y: view.toPixelY(end[1]), radius: RING, colour: palette.prior });
      if (marked) {
        const { pose, path } = marked;
        drawOutline(brush, path, { colour: palette.accent, width: 1.25, dash: [6, 2] });
        drawMark(brush, { x: pose[0], y: pose[1], heading: pose[2] });
      }
    });
  };
}

/** Radius of the arcs that show a turn, CSS pixels, and how far beyond the end the second one's line goes on. */
const TURN_RADIUS = 26;
const TURN_LINE = 38;

/**
 * What odometry reads of the command: turn, drive, turn.
 *
 * @param {Brush} brush
 * @param {import('../../types.d.ts').Legs} reading
 * @param {[number, number]} end metres
 */
function drawReading(brush, { rot1, trans, rot2 }, [x, y]) {
  const { context, view, palette } = brush;
  const [fromX, fromY, toX, toY] = [view.toPixelX(0), view.toPixelY(0), view.toPixelX(x), view.toPixelY(y)];
  const ahead = view.direction(rot1);
  context.lineWidth = 1.5;
  context.strokeStyle = palette.prior;
  context.beginPath();
  // Straight ahead from the start, the drive, and on from its end.
  context.moveTo(fromX + TURN_LINE, fromY);
  context.lineTo(fromX, fromY);
  context.lineTo(toX, toY);
  context.lineTo(toX + TURN_LINE * ahead.x, toY + TURN_LINE * ahead.y);
  context.moveTo(toX, toY);
  const last = view.direction(rot1 + rot2);
  context.lineTo(toX + TURN_LINE * last.x, toY + TURN_LINE * last.y);
  context.stroke();
  turn(context, fromX, fromY, 0, rot1);
  turn(context, toX, toY, rot1, rot2);
  const colour = palette.prior;
  const turned = (/** @type {string} */ sub, /** @type {number} */ atX, /** @type {number} */ atY, /** @type {number} */ heading) => {
    const out = view.direction(heading);
    drawLabel(brush, { x: atX + (TURN_LINE + 6) * out.x, y: atY + (TURN_LINE + 6) * out.y, towards: out.x < 0 ? -1 : 1, symbol: 'δ', sub, colour });
  };
  turned('rot1', fromX, fromY, rot1 / 2);
  turned('rot2', toX, toY, rot1 + rot2 / 2);
  if (trans > 0) {
    const [atX, atY] = [(fromX + toX) / 2 + 10 * ahead.y, (fromY + toY) / 2 - 10 * ahead.x + 6];
    drawLabel(brush, { x: atX, y: atY, towards: 1, symbol: 'δ', sub: 'trans', colour });
  }
}

/**
 * @param {Brush['context']} context
 * @param {number} x CSS pixels
 * @param {number} y
 * @param {number} from heading, rad
 * @param {number} by rad; positive to the left
 */
function turn(context, x, y, from, by) {
  context.beginPath();
  // On the screen y runs down.
  context.arc(x, y, TURN_RADIUS, -from, -from - by, by > 0);
  context.stroke();
}

/** Robots that are all in one place. @param {BananaMachine} machine */
function heapOf(machine) {
  const stride = Math.ceil(machine.shown / MAX_RAYS);
  const headings = [];
  for (let i = 0; i < machine.shown; i += stride) headings.push(machine.heading(i));
  const [x, y] = machine.inspect(0).pose;
  return { x, y, headings, label: words.banana.robotsHere(machine.shown, counted(machine.shown)) };
}

/**
 * What is known of the cloud in exponential coordinates: the model's own moments and the sample's;
 * where there are neither, the spread in the plane around the command.
 *
 * @param {Scene} scene
 * @returns {Moments[]} one at least
 */
function twistMoments({ config, stats, table }) {
  const known = [table.tangent, stats.exponential].filter((moments) => moments !== null);
  const finite = known.filter(({ cov }) => Number.isFinite(cov[0][0]));
  if (finite.length > 0) return finite;
  const { v, omega, dt } = config.command;
  const { cov } = table.exact;
  const along = cov[0][0] + cov[1][1];
  return [{ mean: [v * dt, 0, omega * dt], cov: [[along, 0, 0], [0, 0, 0], [0, 0, cov[2][2]]] }];
}

/** The same robots in exponential coordinates. */
export class TwistPicture extends CloudPicture {
  constructor() {
    super('twist', new View({ equal: false, left: 46, right: 10 }));
  }

  /** @param {Scene} scene */
  fit(scene) {
    const { v, omega, dt } = scene.config.command;
    const points = [v * dt, omega * dt];
    for (const { mean, cov } of twistMoments(scene)) {
      const [along, heading] = [ROOM * deviation(cov[0][0]), ROOM * deviation(cov[2][2])];
      points.push(mean[0] - along, mean[2] - heading, mean[0] + along, mean[2] + heading);
    }
    this.view.fit(extentOf(points, 0.1));
  }

  /** @type {Picture<Scene>['paint']} */
  paint = (brush, scene) => {
    const { context, view, palette } = brush;
    const { machine, config, contours, overlays, marked } = scene;
    const { exponential, command } = lineStyles(brush, LINES);
    const key = overlays.exponential && hasLength(contours.twistEllipse) ? [lineKey(brush, words.banana.overlays.exponential, exponential)] : [];
    drawAxes(brush, { x: words.banana.axisAlong, y: words.banana.axisHeading }, brush.exported ? key : []);
    clipped(brush, () => {
      const [{ cov }] = twistMoments(scene);
      const area = 4 * Math.PI * deviation(cov[0][0]) * deviation(cov[2][2]) * view.scaleX * view.scaleY;
      this.paintCloud(brush, machine, area);
      if (overlays.exponential) {
        if (brush.former) drawGhosts(brush, [{ points: brush.former.contours.twistEllipse, ...exponential }]);
        drawOutline(brush, contours.twistEllipse, exponential);
      }
      if (overlays.command) {
        const { v, omega, dt } = config.command;
        context.beginPath();
        context.arc(view.toPixelX(v * dt), view.toPixelY(omega * dt), 5, 0, 2 * Math.PI);
        context.fillStyle = palette.paper;
        context.fill();
        context.strokeStyle = command.colour;
        context.lineWidth = command.width;
        context.stroke();
      }
      if (marked) drawMark(brush, { x: marked.twist[0], y: marked.twist[2], heading: null });
    });
  };
}
