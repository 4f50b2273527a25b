/**
 * The Banana Machine's two pictures of the same robots: the floor from above, and exponential
 * coordinates.
 *
 * @module
 */

import { words } from '../../messages/registry.js';
import { prepare } from '../../scene/canvas.js';
import {
  DASHES,
  clipped,
  densityRamp,
  drawAxes,
  drawDots,
  drawHeap,
  drawMark,
  drawOutline,
  drawPixels,
  drawRobot,
} from '../../scene/draw.js';
import { whole } from '../../ui/format.js';
import { View, extentOf } from '../../scene/view.js';

/**
 * @typedef {import('../../types.d.ts').BananaMachine} BananaMachine
 * @typedef {import('../../types.d.ts').Contours} Contours
 * @typedef {import('../../types.d.ts').Inspection} Inspection
 * @typedef {import('../../types.d.ts').Palette} Palette
 * @typedef {import('../../types.d.ts').Moments} Moments
 * @typedef {import('../../types.d.ts').Settings} Settings
 * @typedef {import('../../types.d.ts').Stats} Stats
 * @typedef {import('../../types.d.ts').Table} Table
 * @typedef {import('../../types.d.ts').ViewName} ViewName
 * @typedef {import('../../scene/canvas.js').Surface} Surface
 *
 * @typedef {object} Scene what both pictures are of
 * @property {BananaMachine} machine
 * @property {Settings} config
 * @property {Stats} stats
 * @property {Contours} contours
 * @property {Table} table
 * @property {Record<keyof typeof DASHES, boolean>} overlays
 * @property {Inspection | undefined} marked
 */

/** From here on the cloud is drawn as a density: dots would be one blot, and cost more than a frame. */
const DOTS_AT_MOST = 2500;

/** Rays of a fan of headings: more look no different. */
const RAYS_AT_MOST = 400;

/** A cloud whose standard deviation is below this many pixels is drawn as one place. */
const ONE_PLACE = 0.6;

/** Standard deviations around the mean that a view makes room for. */
const ROOM = 3.2;

/** A picture: a canvas and its view. */
class Picture {
  /** Device pixels a CSS pixel. */
  ratio = 1;
  font = '';
  #grid = new OffscreenCanvas(1, 1);
  /** Colours of its density. @type {Uint8Array} */
  #ramp = new Uint8Array();
  /** What the ramp was made of. @type {Palette | undefined} */
  #palette;

  /**
   * @param {ViewName} name
   * @param {View} view
   */
  constructor(name, view) {
    this.name = name;
    this.view = view;
  }

  /**
   * Prepares a canvas for drawing in CSS pixels.
   *
   * @param {HTMLCanvasElement | Surface} canvas
   */
  prepare(canvas) {
    const { context, ratio, font } = prepare(canvas, this.view);
    Object.assign(this, { ratio, font });
    return context;
  }

  /**
   * The sample nearest to the pointer.
   *
   * @param {BananaMachine} machine
   * @param {number} x CSS pixels in the canvas
   * @param {number} y
   * @param {number} reach CSS pixels
   */
  nearest(machine, x, y, reach) {
    const { view } = this;
    const [worldX, worldY] = [view.toWorldX(x), view.toWorldY(y)];
    return machine.nearest(this.name, worldX, worldY, reach / view.scaleX, reach / view.scaleY);
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Scene} scene
   * @param {Palette} palette
   * @param {number} cell CSS pixels
   */
  drawCloud(context, { machine }, palette, cell) {
    const { view, name } = this;
    if (machine.shown > DOTS_AT_MOST) {
      const { left, right, top, bottom } = view.frame;
      const { xMin, yMin, xMax, yMax } = view.extent;
      const columns = Math.max(1, Math.round((right - left) / cell));
      const rows = Math.max(1, Math.round((bottom - top) / cell));
      if (this.#palette !== palette) {
        this.#palette = palette;
        this.#ramp = densityRamp(palette);
      }
      const pixels = machine.picture(name, xMin, yMin, xMax, yMax, columns, rows, this.#ramp);
      drawPixels(context, view, this.#grid, pixels, columns);
    } else if (name === 'plane') {
      drawDots(context, view, palette, machine.poses, { x: 0, y: 1, heading: 2, ratio: this.ratio });
    } else {
      drawDots(context, view, palette, machine.twists, { x: 0, y: 2, heading: null, ratio: this.ratio });
    }
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

/** @param {number} variance whose quadrature may round to less than 0 */
function deviation(variance) {
  return Math.sqrt(Math.max(0, variance));
}

/** The floor from above. */
export class PlanePicture extends Picture {
  constructor() {
    super('plane', new View({ equal: true, inset: { left: 42, right: 8, top: 24, bottom: 30 } }));
  }

  /** @param {Scene} scene */
  fit({ contours, table }) {
    const { mean, cov } = table.exact;
    const [sx, sy] = [ROOM * deviation(cov[0][0]), ROOM * deviation(cov[1][1])];
    /** @type {[number, number][]} */
    const points = [[mean[0] - sx, mean[1] - sy], [mean[0] + sx, mean[1] + sy]];
    const { command } = contours;
    for (let i = 0; i < command.length; i += 2) points.push([command[i], command[i + 1]]);
    const box = extentOf(points, 0.4);
    // Around the end there is room for a fan of headings, which may be all there is to see.
    const fan = 0.2 * (box.xMax - box.xMin);
    const [x, y] = command.slice(-2);
    points.push([x - fan, y - fan], [x + fan, y + fan]);
    this.view.fit(extentOf(points, 0.4));
  }

  /**
   * @param {HTMLCanvasElement | Surface} canvas
   * @param {Scene} scene
   * @param {Palette} palette
   */
  draw(canvas, scene, palette) {
    const context = this.prepare(canvas);
    const { view } = this;
    const { contours, overlays, table, marked } = scene;
    drawAxes(context, view, palette, { x: 'x (m)', y: 'y (m)', font: this.font });
    clipped(context, view, () => {
      const { cov } = table.exact;
      const heaped = deviation(cov[0][0] + cov[1][1]) * view.scaleX < ONE_PLACE;
      if (!heaped) {
        const determinant = Math.max(0, cov[0][0] * cov[1][1] - cov[0][1] * cov[1][0]);
        const area = 4 * Math.PI * Math.sqrt(determinant) * view.scaleX * view.scaleY;
        this.drawCloud(context, scene, palette, cellSize(area, scene.machine.shown));
      }
      drawRobot(context, view, palette, { x: 0, y: 0, heading: 0, colour: palette.truth });
      const styles = /** @type {const} */ ([
        ['linearized', palette.prediction, 1.75],
        ['ellipse', palette.prediction, 2],
        ['exponential', palette.posterior, 2.25],
        ['command', palette.prior, 2.5],
      ]);
      for (const [name, colour, width] of styles) {
        if (!overlays[name]) continue;
        drawOutline(context, view, palette, contours[name], { colour, width, dash: DASHES[name] });
      }
      if (heaped && scene.machine.shown > 0) this.#drawHeap(context, scene, palette);
      if (marked) {
        const { pose, path } = marked;
        drawOutline(context, view, palette, path, { colour: palette.accent, width: 1.25, dash: [6, 2] });
        drawMark(context, view, palette, { x: pose[0], y: pose[1], heading: pose[2] });
      }
    });
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Scene} scene
   * @param {Palette} palette
   */
  #drawHeap(context, { machine }, palette) {
    const stride = Math.ceil(machine.shown / RAYS_AT_MOST);
    const headings = [];
    for (let i = 0; i < machine.shown; i += stride) headings.push(machine.heading(i));
    const label = words.banana.robotsHere(machine.shown, whole(machine.shown));
    const [x, y] = machine.inspect(0).pose;
    drawHeap(context, this.view, palette, { x, y, headings, label, font: this.font });
  }
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
export class TwistPicture extends Picture {
  constructor() {
    super('twist', new View({ equal: false, inset: { left: 46, right: 10, top: 24, bottom: 30 } }));
  }

  /** @param {Scene} scene */
  fit(scene) {
    const { v, omega, dt } = scene.config.command;
    /** @type {[number, number][]} */
    const points = [[v * dt, omega * dt]];
    for (const { mean, cov } of twistMoments(scene)) {
      const [along, heading] = [ROOM * deviation(cov[0][0]), ROOM * deviation(cov[2][2])];
      points.push([mean[0] - along, mean[2] - heading], [mean[0] + along, mean[2] + heading]);
    }
    this.view.fit(extentOf(points, 0.1));
  }

  /**
   * @param {HTMLCanvasElement | Surface} canvas
   * @param {Scene} scene
   * @param {Palette} palette
   */
  draw(canvas, scene, palette) {
    const context = this.prepare(canvas);
    const { view } = this;
    const { machine, config, contours, overlays, marked } = scene;
    drawAxes(context, view, palette, { x: words.banana.axisAlong, y: words.banana.axisHeading, font: this.font });
    clipped(context, view, () => {
      const [{ cov }] = twistMoments(scene);
      const area = 4 * Math.PI * deviation(cov[0][0]) * deviation(cov[2][2]) * view.scaleX * view.scaleY;
      this.drawCloud(context, scene, palette, cellSize(area, machine.shown));
      if (overlays.exponential) {
        const style = { colour: palette.posterior, width: 2.25, dash: DASHES.exponential };
        drawOutline(context, view, palette, contours.twistEllipse, style);
      }
      if (overlays.command) {
        const { v, omega, dt } = config.command;
        context.beginPath();
        context.arc(view.toPixelX(v * dt), view.toPixelY(omega * dt), 5, 0, 2 * Math.PI);
        context.fillStyle = palette.paper;
        context.fill();
        context.strokeStyle = palette.prior;
        context.lineWidth = 2.5;
        context.stroke();
      }
      if (marked) drawMark(context, view, palette, { x: marked.twist[0], y: marked.twist[2], heading: null });
    });
  }
}
