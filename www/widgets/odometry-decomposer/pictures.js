/** The Odometry Decomposer's two pictures: the three legs in the frame of the odometry, and the same in the world. */

import { words } from '../../messages/registry.js';
import { clipped, drawAxes } from '../../scene/axes.js';
import { drawDots, drawMark } from '../../scene/draw.js';
import { drawLabel } from '../../scene/labels.js';
import { SamplesPicture } from '../../scene/picture.js';
import { View, extentOf } from '../../scene/view.js';
import { fixed } from '../../ui/format.js';
import { lineKey } from '../shared/line-key.js';
import { drawHeldRobot, drawRobotOutline, turnDistance } from '../shared/robot.js';
import { drawBar, drawFan, drawTurn } from './marks.js';
import { poseIn } from './reading.js';

/**
 * @import { Pose } from '../../types.d.ts'
 * @import { Brush } from '../../scene/canvas.js'
 *
 * @typedef {import('./reading.js').Reading & { marked: Float64Array | undefined }} Scene what both pictures are of
 */

/** Radius of the robot, m. */
export const RADIUS = 0.11;

/** Room around the robots, and around a standard deviation of the outcomes. */
const ROOM = { metres: 0.3, deviations: 2.2 };

/** With more outcomes their headings would be one blot. */
const MAX_TICKS = 1000;

/** Between the handle that turns a robot and the arc of a turn about it, and between the two arcs, CSS pixels. */
const GAP = { handle: 16, arcs: 22 };

/** A shorter drive is not seen as one, CSS pixels: there is no label for it. */
const SEEN = 40;

/** A smaller turn, rad, has no arc. */
const NO_TURN = 0.005;

const AXES = { x: 'x (m)', y: 'y (m)' };

/** How long the axes of the odometry's frame are drawn, m. */
const AXIS = 0.35;

/** Dash of what is told in the frame of the odometry, CSS pixels. */
const ODOMETRY_DASH = [6, 4];

/**
 * Corners of where the outcomes are, as far as a picture makes room for them.
 *
 * @param {Scene} scene
 * @returns {number[]} x, y pairs
 */
function surroundings({ linkage, legs, deviations, stats }) {
  const [{ x, y }, driven] = [poseIn(linkage, 0), poseIn(linkage, 2)];
  const along = Math.min(ROOM.deviations * deviations.trans, legs.trans + 2);
  // No hinge turns a drive farther than to all sides.
  const across = ROOM.deviations * stats.exactCrossTrack;
  const [dx, dy] = [Math.abs(Math.cos(driven.theta)), Math.abs(Math.sin(driven.theta))];
  const room = [ROOM.metres + along * dx + across * dy, ROOM.metres + along * dy + across * dx];
  return [
    ...[x - ROOM.metres, y - ROOM.metres, x + ROOM.metres, y + ROOM.metres],
    ...[driven.x - room[0], driven.y - room[1], driven.x + room[0], driven.y + room[1]],
  ];
}

/**
 * @param {Brush} brush
 * @param {Scene} scene
 */
function drawOutcomes(brush, { poses }) {
  drawDots(brush, poses, { x: 0, y: 1, heading: poses.length <= 3 * MAX_TICKS ? 2 : null });
}

/** @extends {SamplesPicture<Scene>} */
class OutcomesPicture extends SamplesPicture {
  /**
   * @param {Brush} brush
   * @param {Scene} scene
   */
  paintMark(brush, { marked }) {
    if (marked) drawMark(brush, { x: marked[0], y: marked[1], heading: marked[2] });
  }
}

/** The frame of the odometry: the legs as a linkage, and what noise makes of it. */
export class LegsPicture extends OutcomesPicture {
  constructor() {
    super('plane', new View());
  }

  /** @param {Scene} scene */
  fit(scene) {
    this.view.fit(extentOf(surroundings(scene), 1.2));
  }

  /** @type {SamplesPicture<Scene>['paint']} */
  paint = (brush, scene) => {
    const { palette } = brush;
    const { linkage, legs, deviations, config } = scene;
    const [start, turned, driven] = [0, 1, 2].map((index) => poseIn(linkage, index));
    drawAxes(brush, AXES, keyOf(brush));
    const outer = turnDistance(this.view, RADIUS) + GAP.handle;
    clipped(brush, () => {
      drawFan(brush, turned, deviations.rot1, Math.max(legs.trans * this.view.scaleX, outer + GAP.arcs), palette.prediction);
      this.#paintGhosts(brush, scene);
      drawOutcomes(brush, scene);
      this.#paintDrive(brush, start, driven);
      drawHeldRobot(brush, start, RADIUS, palette.prior);
      drawHeldRobot(brush, config.to, RADIUS, palette.prior);
      drawBar(brush, driven, deviations.trans, palette.prediction);
      drawBar(brush, { ...driven, theta: driven.theta + Math.PI / 2 }, deviations.strafe, palette.prediction);
      if (config.phase < 3) this.#paintRobot(brush, scene.robot);
      this.#paintTurns(brush, scene, outer);
      this.paintMark(brush, scene);
    });
  };

  /** The linkages of some outcomes. @param {Brush} brush @param {Scene} scene */
  #paintGhosts({ context, view, palette }, { ghosts }) {
    context.strokeStyle = palette.prediction;
    context.lineWidth = 1;
    context.globalAlpha = 0.5;
    context.beginPath();
    for (let i = 0; i < ghosts.length / 3; i++) {
      const { x, y } = poseIn(ghosts, i);
      if (i % 4 === 0) context.moveTo(view.toPixelX(x), view.toPixelY(y));
      else context.lineTo(view.toPixelX(x), view.toPixelY(y));
    }
    context.stroke();
    context.globalAlpha = 1;
  }

  /** @param {Brush} brush @param {Pose} start @param {Pose} driven */
  #paintDrive({ context, view, palette }, start, driven) {
    context.strokeStyle = palette.prior;
    context.lineWidth = 3;
    context.beginPath();
    context.moveTo(view.toPixelX(start.x), view.toPixelY(start.y));
    context.lineTo(view.toPixelX(driven.x), view.toPixelY(driven.y));
    context.stroke();
  }

  /** On its way. @param {Brush} brush @param {Pose} robot */
  #paintRobot(brush, { x, y, theta }) {
    const { context, view, palette } = brush;
    const ahead = view.direction(theta);
    const [px, py, size] = [view.toPixelX(x), view.toPixelY(y), Math.max(7, 0.7 * RADIUS * view.scaleX)];
    context.fillStyle = palette.accent;
    context.strokeStyle = palette.paper;
    context.lineWidth = 2;
    context.beginPath();
    context.arc(px, py, size, 0, 2 * Math.PI);
    context.fill();
    context.stroke();
    context.beginPath();
    context.moveTo(px, py);
    context.lineTo(px + size * ahead.x, py + size * ahead.y);
    context.stroke();
  }

  /**
   * The turns about either end, and what all three legs are.
   *
   * @param {Brush} brush
   * @param {Scene} scene
   * @param {number} radius of the first turn, pixels
   */
  #paintTurns(brush, { linkage, legs, deviations }, radius) {
    const { view, palette } = brush;
    const [start, turned, driven] = [0, 1, 2].map((index) => poseIn(linkage, index));
    const said = (/** @type {number} */ value, /** @type {number} */ deviation, /** @type {string} */ unit) =>
      `${fixed(value, 2)}${deviation > 0 ? ` ± ${fixed(deviation, 2)}` : ''} ${unit}`;
    const second = radius + GAP.arcs;
    const labels = /** @type {Parameters<typeof drawLabel>[1][]} */ ([]);
    const turn = (/** @type {Pose} */ from, /** @type {number} */ by, /** @type {number} */ reach, /** @type {string} */ sub, /** @type {number} */ deviation) => {
      if (Math.abs(by) < NO_TURN) return;
      drawTurn(brush, from, by, reach, palette.prior);
      const out = view.direction(from.theta + by / 2);
      labels.push({
        x: view.toPixelX(from.x) + (reach + 9) * out.x,
        y: view.toPixelY(from.y) + (reach + 12) * out.y,
        towards: Math.sign(out.x),
        symbol: 'δ',
        sub,
        text: said(by, deviation, 'rad'),
        colour: palette.prior,
      });
    };
    drawFan(brush, { ...driven, theta: driven.theta + legs.rot2 }, deviations.rot2, second, palette.prediction);
    turn(start, legs.rot1, radius, 'rot1', deviations.rot1);
    turn(driven, legs.rot2, second, 'rot2', deviations.rot2);
    // After both arcs: neither is to strike through a label.
    for (const label of labels) drawLabel(brush, label);
    if (legs.trans * view.scaleX < SEEN) return;
    // The arc of a turn to the left is to the right of the drive, and the label beyond its other side.
    const side = view.direction(turned.theta + (Math.sign(legs.rot1 || 1) * Math.PI) / 2);
    const middle = [view.toPixelX((start.x + driven.x) / 2), view.toPixelY((start.y + driven.y) / 2)];
    drawLabel(brush, {
      x: middle[0] + 16 * side.x,
      y: middle[1] + 22 * side.y,
      towards: Math.abs(side.x) < 0.3 ? 0 : Math.sign(side.x),
      symbol: 'δ',
      sub: 'trans',
      text: said(legs.trans, deviations.trans, 'm'),
      colour: palette.prior,
    });
  }
}

/** The world, in which the frame of the odometry drifts. */
export class WorldPicture extends OutcomesPicture {
  constructor() {
    super('world', new View());
  }

  /** @param {Scene} scene */
  fit(scene) {
    const { poses } = scene.drifted;
    const around = [0, 1, 2].flatMap((index) => {
      const { x, y } = poseIn(poses, index);
      return [x - ROOM.metres, y - ROOM.metres, x + ROOM.metres, y + ROOM.metres];
    });
    this.view.fit(extentOf([...surroundings(scene), ...around], 1.2));
  }

  /** @type {SamplesPicture<Scene>['paint']} */
  paint = (brush, scene) => {
    const { palette } = brush;
    const [frame, from, to] = [0, 1, 2].map((index) => poseIn(scene.drifted.poses, index));
    const [start, end] = [poseIn(scene.linkage, 0), poseIn(scene.linkage, 3)];
    drawAxes(brush, AXES, []);
    clipped(brush, () => {
      this.#paintFrame(brush, frame);
      this.#paintLine(brush, from, to, palette.prior, ODOMETRY_DASH, 1.75);
      for (const pose of [from, to]) this.#paintOdometry(brush, pose);
      drawOutcomes(brush, scene);
      this.#paintLine(brush, start, end, palette.prediction, [], 1.75);
      this.#paintLine(brush, to, end, palette.accent, [2, 4], 1.5);
      drawHeldRobot({ ...brush, handles: false }, start, RADIUS, palette.truth);
      this.#label(brush, { poses: [start, end], side: -1, symbol: 'x', colours: [palette.ink, palette.prediction] });
      this.#label(brush, { poses: [from, to], side: 1, symbol: 'x̄', colours: [palette.prior, palette.prior] });
      this.paintMark(brush, scene);
    });
  };

  /** The axes of the frame that the odometry is told in. @param {Brush} brush @param {Pose} frame */
  #paintFrame({ context, view, palette }, { x, y, theta }) {
    const [px, py, reach] = [view.toPixelX(x), view.toPixelY(y), AXIS * view.scaleX];
    context.strokeStyle = palette.prior;
    context.lineWidth = 1.25;
    context.beginPath();
    for (const turn of [0, Math.PI / 2]) {
      const ahead = view.direction(theta + turn);
      context.moveTo(px, py);
      context.lineTo(px + reach * ahead.x, py + reach * ahead.y);
    }
    context.stroke();
  }

  /** @param {Brush} brush @param {Pose} pose */
  #paintOdometry(brush, { x, y, theta }) {
    const { context, view, palette } = brush;
    drawRobotOutline(brush, x, y, RADIUS, palette.prior);
    const ahead = view.direction(theta);
    const [px, py, reach] = [view.toPixelX(x), view.toPixelY(y), RADIUS * view.scaleX + 8];
    context.beginPath();
    context.moveTo(px, py);
    context.lineTo(px + reach * ahead.x, py + reach * ahead.y);
    context.stroke();
  }

  /**
   * @param {Brush} brush
   * @param {Pose} from
   * @param {Pose} to
   * @param {string} colour
   * @param {number[]} dash
   * @param {number} width
   */
  #paintLine({ context, view }, from, to, colour, dash, width) {
    context.strokeStyle = colour;
    context.lineWidth = width;
    context.setLineDash(dash);
    context.beginPath();
    context.moveTo(view.toPixelX(from.x), view.toPixelY(from.y));
    context.lineTo(view.toPixelX(to.x), view.toPixelY(to.y));
    context.stroke();
    context.setLineDash([]);
  }

  /**
   * Labels the poses before and the poses after; the former where these are two places.
   *
   * @param {Brush} brush
   * @param {{ poses: Pose[], side: number, symbol: string, colours: string[] }} pair with the side of a pose that its label
   *   stands on: −1 for above and to the left, 1 for below and to the right
   */
  #label(brush, { poses, side, symbol, colours }) {
    const { view } = brush;
    const out = side * (Math.max(8, RADIUS * view.scaleX) + 7);
    const [before, after] = poses.map(({ x, y }) => [view.toPixelX(x), view.toPixelY(y)]);
    const apart = Math.hypot(before[0] - after[0], before[1] - after[1]) > SEEN;
    [before, after].forEach(([x, y], i) => {
      if (i === 1 || apart) drawLabel(brush, { x: x + out, y: y + out, towards: side, symbol, sub: ['t−1', 't'][i], colour: colours[i] });
    });
  }
}

/**
 * What the marks of the legs are, above their picture.
 *
 * @param {Brush} brush
 */
function keyOf(brush) {
  const { prior, prediction } = brush.palette;
  const say = words.decomposer.key;
  return [
    lineKey(brush, say.legs, { colour: prior, width: 3, dash: [] }),
    lineKey(brush, say.deviation, { colour: prediction, width: 1, dash: [5, 3] }),
    lineKey(brush, say.ghosts, { colour: prediction, width: 1, dash: [] }),
  ];
}
