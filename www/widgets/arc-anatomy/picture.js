/** Arc Anatomy's picture: the commanded arc, the arc that leads to the robot, and what they are constructed of. */

import { words } from '../../messages/registry.js';
import { clipped, drawAxes } from '../../scene/axes.js';
import { drawOutlines, drawRobot, lineStyles } from '../../scene/draw.js';
import { drawLabel } from '../../scene/labels.js';
import { Picture } from '../../scene/picture.js';
import { View, extentAround } from '../../scene/view.js';
import { clamp } from '../../ui/clamp.js';
import { fixed, significant } from '../../ui/format.js';
import { lineKey } from '../shared/line-key.js';
import { drawHeldRobot, drawRobotOutline } from '../shared/robot.js';
import { LINES } from './settings.js';
import { CONTOURS, SurfaceLayer } from './surface.js';

/**
 * @import { ArcAnatomy, Bend, Pose } from '../../types.d.ts'
 * @import { Brush } from '../../scene/canvas.js'
 * @import { LineName } from './settings.js'
 * @import { Reading } from './reading.js'
 *
 * @typedef {Reading & { machine: ArcAnatomy, overlays: LineName[], line: number, underway: Float64Array | undefined }} Scene
 */

/** Of the robots, m. */
export const RADIUS = 0.06;

/** A centre is shown that is no further away than so many times the way, and so many metres. */
const CENTRE = { ways: 3, metres: 1.5 };

/** Room around everything, m. */
const AROUND = 0.15;

/** Radius of the arcs that mark angles, CSS pixels at most. */
const ANGLE = 40;

/** Radius of the wedge, CSS pixels. */
const WEDGE = 64;

/** Half of the cross at a centre, CSS pixels. */
const CROSS = 4;

/** Length of the arrow towards a centre that is out of sight, CSS pixels. */
const ARROW = 9;

/** From one line of letters to the next, CSS pixels. */
const LINE = 17;

/** What each line of Table 5.1 constructs. @type {Record<number, string[]>} */
const LIT = {
  1: ['bisector'],
  2: ['bisector', 'centre'],
  3: ['bisector', 'centre'],
  4: ['centre', 'radius'],
  5: ['angle', 'radius'],
  6: ['arc'],
  7: ['angle'],
  8: ['wedge'],
};

/** @extends {Picture<Scene>} */
export class ArcPicture extends Picture {
  #surface = new SurfaceLayer();

  constructor() {
    super('plane', new View());
  }

  /** @param {Scene} scene */
  fit({ config: { start, next }, stats: { commanded, inverted }, paths }) {
    let box = extentAround([start.x, start.y, next.x, next.y], 2);
    for (const path of [paths.commanded, paths.inverted, paths.driven]) box = extentAround(path, 2, box);
    const way = Math.hypot(box.xMax - box.xMin, box.yMax - box.yMin);
    for (const { center, radius } of [commanded, inverted]) {
      if (center && Math.abs(radius) < Math.max(CENTRE.metres, CENTRE.ways * way)) box = extentAround(center, 2, box);
    }
    const { xMin, yMin, xMax, yMax } = box;
    this.view.fit({ xMin: xMin - AROUND, yMin: yMin - AROUND, xMax: xMax + AROUND, yMax: yMax + AROUND });
  }

  /** @type {Picture<Scene>['paint']} */
  paint = (brush, scene) => {
    const { config: { start, next, printed }, stats, paths, overlays } = scene;
    const { palette } = brush;
    const shows = (/** @type {LineName} */ name) => overlays.includes(name);
    const styles = lineStyles(brush, LINES);
    drawAxes(brush, { x: 'x (m)', y: 'y (m)' }, brush.exported ? keyOf(brush, scene) : []);
    clipped(brush, () => {
      this.#surface.draw(brush, scene.machine, scene.config);
      const { commanded, inverted, driven, lastTurn } = stats;
      if (shows('commanded')) {
        drawCircle(brush, start, commanded, { ...styles.commanded, side: -1, angle: `ωΔt = ${fixed(commanded.turn, 2)}`, radius: '' });
      }
      if (shows('inverted')) {
        drawCircle(brush, start, inverted, {
          ...styles.inverted,
          side: 1,
          angle: `ω̂Δt = ${fixed(inverted.turn, 2)}`,
          radius: `r* = ${printed ? fixed(Math.abs(inverted.radius), 2) : signedText(inverted.radius)} m`,
        });
      }
      if (shows('chord')) drawChord(brush, start, next, styles.chord);
      if (shows('wedge')) drawWedge(brush, next, lastTurn, styles.wedge.colour);
      if (shows('twist')) drawTwist(brush, paths.ticks, styles.twist.colour);
      drawOutlines(brush, [
        ...(shows('commanded') ? [{ points: paths.commanded, ...styles.commanded }] : []),
        ...(shows('twist') ? [{ points: paths.lie, ...styles.twist }] : []),
        ...(shows('inverted') ? [{ points: paths.driven, ...styles.inverted }] : []),
      ]);
      if (shows('inverted') && driven.arcLength !== inverted.arcLength) {
        drawOutlines(brush, [{ points: paths.inverted, colour: styles.inverted.colour, width: 1, dash: [2, 3] }]);
      }
      drawLit(brush, scene);
      if (shows('commanded')) {
        const [endX, endY, endTheta] = commanded.end;
        drawRobotOutline(brush, endX, endY, RADIUS, styles.commanded.colour);
        drawHeading(brush, { x: endX, y: endY, theta: endTheta }, styles.commanded.colour);
      }
      drawUnderway(brush, scene);
      drawHeldRobot(brush, start, RADIUS, palette.truth);
      drawHeldRobot(brush, next, RADIUS, palette.prediction);
      if (shows('wedge')) drawLabel(brush, { ...besideWedge(brush, next, lastTurn), text: `γ̂Δt = ${fixed(lastTurn, 2)}`, colour: styles.wedge.colour });
    });
  };
}

/**
 * Returns the key of an exported picture. The last turn has its label in the picture.
 *
 * @param {Brush} brush
 * @param {Scene} scene
 */
function keyOf(brush, { overlays, config: { map } }) {
  const { palette } = brush;
  const { overlays: names, maps } = words.anatomy;
  const contour = (/** @type {'prob' | 'density'} */ of) => lineKey(brush, maps[of], { colour: palette.ink, width: 1, dash: CONTOURS[of] });
  return [
    ...(/** @type {const} */ (['inverted', 'commanded', 'chord', 'twist']))
      .filter((name) => overlays.includes(name))
      .map((name) => lineKey(brush, names[name].replaceAll('*', ''), lineStyles(brush, LINES)[name])),
    ...(map === 'none' ? [] : [contour('prob'), contour('density')]),
  ];
}

/**
 * @param {Brush['context']} context
 * @param {string} colour
 * @param {number} width CSS pixels
 * @param {number[]} dash
 * @param {() => void} path
 */
function stroke(context, colour, width, dash, path) {
  context.strokeStyle = colour;
  context.lineWidth = width;
  context.setLineDash(dash);
  context.beginPath();
  path();
  context.stroke();
  context.setLineDash([]);
}

/**
 * The centre of an arc, both radii and the turn between them.
 *
 * @param {Brush} brush
 * @param {Pose} start
 * @param {Bend} bend
 * @param {{ colour: string, dash: number[], side: number, angle: string, radius: string }} style with the side to which the first
 *   radius makes room for another on the same line, and its labels
 */
function drawCircle(brush, start, { center, end, turn, arcLength }, { colour, dash, side, angle, radius: signed }) {
  if (!center) return;
  const { context, view } = brush;
  const [x, y] = [view.toPixelX(center[0]), view.toPixelY(center[1])];
  const [fromX, fromY] = [view.toPixelX(start.x), view.toPixelY(start.y)];
  const [toX, toY] = [view.toPixelX(end[0]), view.toPixelY(end[1])];
  const ahead = view.direction(start.theta);
  const [offX, offY] = [1.5 * side * ahead.x, 1.5 * side * ahead.y];
  const seen = shareSeen(view.frame, [fromX, fromY], [x, y]);
  stroke(context, colour, 1.25, dash, () => {
    context.moveTo(fromX + offX, fromY + offY);
    context.lineTo(x + offX, y + offY);
    context.moveTo(x, y);
    context.lineTo(toX, toY);
  });
  stroke(context, colour, 2, [], () => {
    context.moveTo(x - CROSS, y);
    context.lineTo(x + CROSS, y);
    context.moveTo(x, y - CROSS);
    context.lineTo(x, y + CROSS);
  });
  const first = Math.atan2(fromY - y, fromX - x);
  const radius = Math.min(ANGLE, 0.4 * Math.hypot(fromX - x, fromY - y));
  // Pixels count downwards: to the left is backwards.
  stroke(context, colour, 1.5, [], () => context.arc(x, y, radius, first, first - turn, turn > 0));
  // Behind the robot, where nothing of the arc is; along it where it is so flat that a picture ends behind the robot.
  const beside = Math.sign(arcLength) * (seen === 1 ? -1 : 1);
  const tell = (/** @type {string} */ text, /** @type {number} */ share, below = 0) => {
    const at = [fromX + share * (x - fromX) + 10 * beside * ahead.x, fromY + share * (y - fromY) + 10 * beside * ahead.y];
    const towards = beside * ahead.x;
    drawLabel(brush, { x: at[0], y: at[1] + below, towards: Math.abs(towards) < 0.3 ? 0 : Math.sign(towards), text, colour });
  };
  tell(signed, seen / 2);
  if (seen === 1) {
    tell(angle, 1);
    return;
  }
  drawArrow(context, colour, [fromX + seen * (x - fromX), fromY + seen * (y - fromY)], Math.atan2(y - fromY, x - fromX));
  const distance = significant(Math.hypot(center[0] - start.x, center[1] - start.y), 2);
  // Inside of the border, and of two in one place each in a line of its own.
  tell(`${words.anatomy.centreAt(distance)}, ${angle}`, seen, Math.sign(fromY - y) * LINE * (side < 0 ? 0.6 : 1.6));
}

/**
 * @param {Brush['context']} context
 * @param {string} colour
 * @param {number[]} tip
 * @param {number} way that it points, rad, downwards from the right
 */
function drawArrow(context, colour, [x, y], way) {
  stroke(context, colour, 2.25, [], () => {
    for (const wing of [2.6, -2.6]) {
      context.moveTo(x + ARROW * Math.cos(way + wing), y + ARROW * Math.sin(way + wing));
      context.lineTo(x, y);
    }
  });
}

/**
 * How much of the way to a place is in sight, as a share.
 *
 * @param {import('../../scene/view.js').View['frame']} frame
 * @param {[x: number, y: number]} from in sight
 * @param {[x: number, y: number]} to
 */
function shareSeen({ left, right, top, bottom }, [fromX, fromY], [x, y]) {
  const along = (/** @type {number} */ start, /** @type {number} */ end, /** @type {number} */ least, /** @type {number} */ most) =>
    end >= least && end <= most ? 1 : (clamp(end, least, most) - start) / (end - start);
  return Math.min(along(fromX, x, left, right), along(fromY, y, top, bottom));
}

/**
 * @param {Brush} brush
 * @param {Pose} start
 * @param {Pose} next
 * @param {{ colour: string, width: number, dash: number[] }} style
 */
function drawChord({ context, view }, start, next, { colour, width, dash }) {
  stroke(context, colour, width, dash, () => {
    context.moveTo(view.toPixelX(start.x), view.toPixelY(start.y));
    context.lineTo(view.toPixelX(next.x), view.toPixelY(next.y));
  });
}

/**
 * What the arc leaves of the final heading.
 *
 * @param {Brush} brush
 * @param {Pose} next
 * @param {number} turn rad, the last of it
 * @param {string} colour
 */
function drawWedge({ context, view }, next, turn, colour) {
  const [x, y] = [view.toPixelX(next.x), view.toPixelY(next.y)];
  context.beginPath();
  context.moveTo(x, y);
  context.arc(x, y, WEDGE, turn - next.theta, -next.theta, turn > 0);
  context.lineTo(x, y);
  context.fillStyle = colour;
  context.globalAlpha = 0.32;
  context.fill();
  context.globalAlpha = 1;
  // The heading at the end of the arc.
  const before = view.direction(next.theta - turn);
  stroke(context, colour, 1.25, [], () => {
    context.moveTo(x, y);
    context.lineTo(x + WEDGE * before.x, y + WEDGE * before.y);
  });
}

/**
 * Where the wedge has its label.
 *
 * @param {Brush} brush
 * @param {Pose} next
 * @param {number} turn rad
 * @returns {{ x: number, y: number, towards: number }} CSS pixels
 */
function besideWedge({ view }, next, turn) {
  const ahead = view.direction(next.theta - turn / 2);
  return { x: view.toPixelX(next.x) + (WEDGE + 8) * ahead.x, y: view.toPixelY(next.y) + (WEDGE + 10) * ahead.y, towards: 0 };
}

/**
 * @param {Brush} brush
 * @param {Pose} pose
 * @param {string} colour
 */
function drawHeading({ context, view }, { x, y, theta }, colour) {
  const ahead = view.direction(theta);
  stroke(context, colour, 1.5, [], () => {
    context.moveTo(view.toPixelX(x), view.toPixelY(y));
    context.lineTo(view.toPixelX(x) + 24 * ahead.x, view.toPixelY(y) + 24 * ahead.y);
  });
}

/**
 * Draws the robot at one time on each path that is shown.
 *
 * @param {Brush} brush
 * @param {Scene} scene
 */
function drawUnderway(brush, { underway, overlays }) {
  if (!underway) return;
  for (const [i, name] of (/** @type {const} */ (['commanded', 'inverted', 'twist'])).entries()) {
    if (!overlays.includes(name)) continue;
    const [x, y, theta] = underway.subarray(3 * i);
    drawRobot(brush, { x, y, heading: theta, colour: brush.palette[LINES[name].role] });
  }
}

/**
 * The way sideways of the constant twist.
 *
 * @param {Brush} brush
 * @param {Float64Array} ticks
 * @param {string} colour
 */
function drawTwist({ context, view }, ticks, colour) {
  stroke(context, colour, 1.25, [], () => {
    for (let i = 0; i < ticks.length; i += 4) {
      context.moveTo(view.toPixelX(ticks[i]), view.toPixelY(ticks[i + 1]));
      context.lineTo(view.toPixelX(ticks[i + 2]), view.toPixelY(ticks[i + 3]));
    }
  });
}

/**
 * What the lit line of the table constructs.
 *
 * @param {Brush} brush
 * @param {Scene} scene
 */
function drawLit(brush, { config: { start, next }, stats: { inverted, lastTurn }, table: { middle }, paths, line }) {
  const lit = LIT[line] ?? [];
  const { context, view, palette: { accent } } = brush;
  const at = (/** @type {number[]} */ [x, y]) => /** @type {[number, number]} */ ([view.toPixelX(x), view.toPixelY(y)]);
  const from = at([start.x, start.y]);
  const to = at([next.x, next.y]);
  const lineTo = (/** @type {[number, number]} */ one, /** @type {[number, number]} */ other) => {
    context.moveTo(...one);
    context.lineTo(...other);
  };
  if (lit.includes('arc')) drawOutlines(brush, [{ points: paths.driven, colour: accent, width: 5, dash: [] }]);
  if (lit.includes('wedge')) drawWedge(brush, next, lastTurn, accent);
  if (!inverted.center) return;
  const centre = at(inverted.center);
  if (lit.includes('bisector')) {
    stroke(context, accent, 2.5, [6, 4], () => lineTo(at(middle), centre));
    stroke(context, accent, 2.5, [], () => lineTo(from, centre));
    stroke(context, accent, 2.5, [], () => lineTo(from, to));
  }
  if (lit.includes('radius')) stroke(context, accent, 3, [], () => (lineTo(from, centre), lineTo(centre, to)));
  if (lit.includes('centre')) {
    stroke(context, accent, 3, [], () => {
      context.moveTo(centre[0] + 8, centre[1]);
      context.arc(...centre, 8, 0, 2 * Math.PI);
    });
  }
  if (lit.includes('angle')) {
    const first = Math.atan2(from[1] - centre[1], from[0] - centre[0]);
    const radius = Math.min(ANGLE, 0.4 * Math.hypot(from[0] - centre[0], from[1] - centre[1]));
    stroke(context, accent, 4, [], () => context.arc(...centre, radius, first, first - inverted.turn, inverted.turn > 0));
  }
}

/** With its sign, which is that of the side. @param {number} radius */
const signedText = (radius) => (radius > 0 ? `+${fixed(radius, 2)}` : fixed(radius, 2));
