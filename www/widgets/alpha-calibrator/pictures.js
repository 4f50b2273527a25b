/** The Alpha Calibrator's two pictures: the way of the robot, and one leg of it from where that began. */

import { words } from '../../messages/registry.js';
import { clipped, drawAxes } from '../../scene/axes.js';
import { drawDots, drawMark, drawOutlines } from '../../scene/draw.js';
import { Picture } from '../../scene/picture.js';
import { View, extentAround, extentOf } from '../../scene/view.js';
import { channels } from '../../ui/theme.js';
import { lineKey } from '../shared/line-key.js';

/**
 * @import { AlphaCalibrator as Machine, CalibrationLegs, LegView } from '../../types.d.ts'
 * @import { Brush } from '../../scene/canvas.js'
 * @import { Palette } from '../../ui/theme.js'
 * @import { Reading } from './reading.js'
 *
 * @typedef {Reading & { chosen: number, leg: LegView | null }} Scene what both pictures are of: with the leg that is looked at
 */

/** How near to a leg the pointer must be to choose it, CSS pixels. */
const REACH = 16;

/** Legs that are stroked at once: browsers take far longer for one path of many. */
const LEGS_A_STROKE = 500;

/** Of steps that are shorter one is drawn in each square of this side, CSS pixels: nobody sees the others, and they may be a hundred thousand. */
const FINE = 1;

/** A number for each square of that side. @param {number} x CSS pixels @param {number} y */
const squareOf = (x, y) => Math.round(x / FINE) + 2 ** 26 * Math.round(y / FINE);

/** Room for a key in two lines, CSS pixels. */
const TWO_LINES = 42;

/** Radius of the rings around the worst legs, CSS pixels. */
const RING = 6;

/** Dash of what the odometry says, CSS pixels. */
const READ_DASH = [2.5, 3.5];

/** How legs look, the most usual first: the wider, the more unusual. @param {Palette} palette */
const stylesOf = ({ truth, cloud, prediction, accent }) => [
  { colour: truth, width: 1.5, dash: [] },
  { colour: between(truth, cloud), width: 2, dash: [] },
  { colour: prediction, width: 3.25, dash: [] },
  { colour: accent, width: 4.5, dash: [] },
];

/** Halfway from one colour to another. @param {string} one @param {string} other */
function between(one, other) {
  const [from, to] = [channels(one), channels(other)];
  return `rgb(${from.map((value, i) => Math.round((value + to[i]) / 2))})`;
}

/**
 * The floor from above, in the frame of the reference.
 *
 * @extends {Picture<Scene>}
 */
export class WayPicture extends Picture {
  constructor() {
    super('plane', new View({ top: TWO_LINES }));
  }

  /**
   * @param {Machine} machine
   * @param {number} x CSS pixels of the canvas
   * @param {number} y
   */
  nearest(machine, x, y) {
    const [atX, atY, radius] = this.around(x, y, REACH);
    return machine.nearest(atX, atY, radius);
  }

  /** @param {Scene} scene */
  fit({ legs: { reference } }) {
    const box = extentAround(reference, 3);
    this.view.fit(extentOf(reference.length > 0 ? [box.xMin, box.yMin, box.xMax, box.yMax] : [0, 0], 1));
  }

  /** @type {Picture<Scene>['paint']} */
  paint = (brush, { legs, classes, stats: { doubts }, chosen }) => {
    const { context, palette, view } = brush;
    const styles = stylesOf(palette);
    const { key } = words.calibrator;
    const entries = styles.map((style, i) => lineKey(brush, key.classes[i], style)).reverse();
    drawAxes(brush, { x: 'x (m)', y: 'y (m)' }, [...entries, lineKey(brush, key.read, { colour: palette.prior, width: 1.25, dash: READ_DASH })]);
    clipped(brush, () => {
      drawReckoned(brush, legs);
      context.lineCap = 'round';
      styles.forEach((style, place) => drawLegs(brush, legs.reference, (leg) => classes[leg] === place, style));
      context.strokeStyle = palette.ink;
      context.lineWidth = 1;
      for (const leg of doubts.worst) {
        context.beginPath();
        context.arc(view.toPixelX(legs.reference[6 * leg + 3]), view.toPixelY(legs.reference[6 * leg + 4]), RING, 0, 2 * Math.PI);
        context.stroke();
      }
      if (chosen < 0) return;
      drawLegs(brush, legs.reference, (leg) => leg === chosen, { colour: palette.ink, width: 3.25 });
      const [x, y, heading] = legs.reference.subarray(6 * chosen + 3);
      drawMark(brush, { x, y, heading }, palette.ink);
      context.lineCap = 'butt';
    });
  };
}

/**
 * Where the odometry has the robot, from where that began: it drifts away, and each leg is compared by itself.
 *
 * @param {Brush} brush
 * @param {CalibrationLegs} legs
 */
function drawReckoned({ context, view, palette }, { count, odometry, reference }) {
  if (count === 0) return;
  const turn = reference[2] - odometry[2];
  const [cos, sin] = [Math.cos(turn), Math.sin(turn)];
  context.beginPath();
  let last = NaN;
  for (let leg = 0; leg < count; leg++) {
    const [dx, dy] = [odometry[6 * leg + 3] - odometry[0], odometry[6 * leg + 4] - odometry[1]];
    const x = view.toPixelX(reference[0] + cos * dx - sin * dy);
    const y = view.toPixelY(reference[1] + sin * dx + cos * dy);
    const square = squareOf(x, y);
    if (square === last) continue;
    last = square;
    context.lineTo(x, y);
  }
  context.strokeStyle = palette.prior;
  context.lineWidth = 1.25;
  context.setLineDash(READ_DASH);
  context.stroke();
  context.setLineDash([]);
}

/**
 * @param {Brush} brush
 * @param {Float64Array} reference both ends of each leg
 * @param {(leg: number) => boolean} are which of them
 * @param {{ colour: string, width: number }} style
 */
function drawLegs({ context, view }, reference, are, { colour, width }) {
  context.strokeStyle = colour;
  context.lineWidth = width;
  /** @type {Set<number>} */
  const drawn = new Set();
  let begun = 0;
  for (let leg = 0; leg < reference.length / 6; leg++) {
    if (!are(leg)) continue;
    const at = 6 * leg;
    const [x, y] = [view.toPixelX(reference[at]), view.toPixelY(reference[at + 1])];
    const [toX, toY] = [view.toPixelX(reference[at + 3]), view.toPixelY(reference[at + 4])];
    if (Math.hypot(toX - x, toY - y) < FINE) {
      const square = squareOf(toX, toY);
      if (drawn.has(square)) continue;
      drawn.add(square);
    }
    if (begun === 0) context.beginPath();
    context.moveTo(x, y);
    context.lineTo(toX, toY);
    begun = (begun + 1) % LEGS_A_STROKE;
    if (begun === 0) context.stroke();
  }
  if (begun > 0) context.stroke();
}

/**
 * One leg in the frame of the robot at its beginning: where it may have ended, and where it did.
 *
 * @extends {Picture<Scene>}
 */
export class LegPicture extends Picture {
  constructor() {
    super('leg', new View({ left: 50, top: TWO_LINES }));
  }

  /** @param {Scene} scene */
  fit({ leg }) {
    if (!leg) return;
    const { outline, read, ended } = leg;
    this.view.fit(extentOf([...outline, read[0], read[1], ended[0], ended[1]], 0.05));
  }

  /** @type {Picture<Scene>['paint']} */
  paint = (brush, { leg }) => {
    const { palette } = brush;
    const { key, axisAhead, axisLeft } = words.calibrator;
    const styles = {
      predicted: { colour: palette.prediction, width: 2, dash: [] },
      read: { colour: palette.prior, width: 2.25, dash: READ_DASH },
      ended: { colour: palette.ink, width: 2.25, dash: [] },
    };
    const names = /** @type {const} */ (['predicted', 'read', 'ended']);
    drawAxes(brush, { x: axisAhead, y: axisLeft }, names.map((name) => lineKey(brush, key[name], styles[name])));
    if (!leg) return;
    const { outcomes, outline, read, ended } = leg;
    clipped(brush, () => {
      drawDots(brush, outcomes, { x: 0, y: 1, heading: null });
      drawOutlines(brush, [
        { points: outline, ...styles.predicted },
        { points: Float64Array.of(0, 0, read[0], read[1]), ...styles.read },
        { points: Float64Array.of(0, 0, ended[0], ended[1]), ...styles.ended },
      ]);
      drawMark(brush, { x: read[0], y: read[1], heading: read[2] }, palette.prior);
      drawMark(brush, { x: ended[0], y: ended[1], heading: ended[2] }, palette.ink);
    });
  };
}
