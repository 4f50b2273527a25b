/**
 * The way of the robot, leg by leg, as a layer of its own: there may be a hundred thousand legs, and they change only with the
 * log, the view or the colours.
 */

import { A_LINE, STROKED, hiddenContext } from '../../scene/canvas.js';
import { channels } from '../../ui/theme.js';

/**
 * @import { CalibrationLegs } from '../../types.d.ts'
 * @import { Bare } from '../../scene/walls.js'
 * @import { Brush } from '../../scene/canvas.js'
 * @import { Palette } from '../../ui/theme.js'
 *
 * @typedef {{ colour: string, width: number, dash: number[] }} Style
 *
 * @typedef {[left: number, top: number, right: number, bottom: number]} Corners m
 *
 * @typedef {Generator<number, void>} Strokes one at a time; the pixels of each, as `STROKED` counts them
 */

/** Legs that are stroked at once: browsers take far longer for one path of many. */
const LEGS_A_STROKE = 500;

/** So few are stroked with every picture: a layer comes after a frame or two, and takes memory. */
const FEW_LEGS = 2000;

/** Of steps that are shorter one is drawn in each square of this side, CSS pixels: nobody sees the others, and they may be a hundred thousand. */
const FINE = 1;

/** Side of the squares in which it is counted how often legs lie upon each other, CSS pixels. */
const COARSE = 8;

/** A number for each square of a side. @param {number} x CSS pixels @param {number} y @param {number} side */
const squareOf = (x, y, side = FINE) => Math.round(x / side) + 2 ** 26 * Math.round(y / side);

/** Dash of what the odometry says, CSS pixels. */
export const READ_DASH = [2.5, 3.5];

/** Width of the most usual legs, CSS pixels, and the least that a line has. */
const [USUAL, HAIR] = [1.5, 1];

/** How legs look, the most usual first: the wider, the more unusual. @param {Palette} palette */
export const stylesOf = ({ truth, cloud, prediction, accent }) => [
  { colour: truth, width: USUAL, dash: [] },
  { colour: between(truth, cloud), width: 2, dash: [] },
  { colour: prediction, width: 3.25, dash: [] },
  { colour: accent, width: 4.5, dash: [] },
];

/** How the way looks that the odometry tells. @param {Palette} palette */
export const readStyleOf = ({ prior }) => ({ colour: prior, width: 1.25, dash: READ_DASH });

/** Halfway from one colour to another. @param {string} one @param {string} other */
function between(one, other) {
  const [from, to] = [channels(one), channels(other)];
  return `rgb(${from.map((value, i) => Math.round((value + to[i]) / 2))})`;
}

export class WayLayer {
  #layer = new OffscreenCanvas(1, 1);
  /** The view and the colours of the layer. */
  #wanted = '';
  /** The legs that it shows. @type {CalibrationLegs | undefined} */
  #legs;
  /** What of them it does not show yet. @type {Strokes | undefined} */
  #left;
  /** Where its corners are on the floor. @type {Corners} */
  #corners = [0, 0, 0, 0];
  /** The last one that is whole and of the same legs, which is seen until this one is. @type {{ layer: OffscreenCanvas, corners: Corners } | undefined} */
  #former;

  /**
   * @param {Brush} brush
   * @param {CalibrationLegs} legs
   * @param {Uint8Array} classes how unusual each of them is
   * @returns {boolean} whether legs are left to the next frames
   */
  draw(brush, legs, classes) {
    const { context, view, palette, ratio, piecemeal } = brush;
    if ('vector' in context || legs.count <= FEW_LEGS) {
      [...strokesOf(brush, legs, classes)];
      return false;
    }
    const { extent, frame, width, height } = view;
    const wanted = JSON.stringify([extent, frame, width, height, stylesOf(palette), palette.prior, ratio]);
    if (wanted !== this.#wanted || legs !== this.#legs) {
      if (legs !== this.#legs) this.#former = undefined;
      else if (!this.#left) this.#former = { layer: this.#layer, corners: this.#corners };
      this.#wanted = wanted;
      this.#legs = legs;
      this.#layer = new OffscreenCanvas(Math.round(width * ratio), Math.round(height * ratio));
      this.#corners = [view.toWorldX(0), view.toWorldY(0), view.toWorldX(width), view.toWorldY(height)];
      const layer = hiddenContext(this.#layer);
      layer.scale(ratio, ratio);
      this.#left = strokesOf({ context: layer, view, palette }, legs, classes);
    }
    for (let left = piecemeal ? STROKED : Infinity; this.#left && left > 0; ) {
      const { done, value } = this.#left.next();
      if (done) this.#left = undefined;
      else left -= value;
    }
    if (!this.#left) this.#former = undefined;
    if (this.#former) {
      const { layer, corners } = this.#former;
      const [left, top] = [view.toPixelX(corners[0]), view.toPixelY(corners[1])];
      context.drawImage(layer, left, top, view.toPixelX(corners[2]) - left, view.toPixelY(corners[3]) - top);
    } else {
      context.drawImage(this.#layer, 0, 0, width, height);
    }
    return this.#left !== undefined;
  }
}

/**
 * @param {Bare} brush
 * @param {CalibrationLegs} legs
 * @param {Uint8Array} classes
 * @returns {Strokes}
 */
function* strokesOf(brush, legs, classes) {
  yield* strokesOfReading(brush, legs);
  // From one layer to two they get thinner, so that nothing jumps where a plot is resized.
  const extra = Math.max(0, Math.min(1, 2 - layersOf(brush.view, legs.reference)));
  for (const [place, style] of stylesOf(brush.palette).entries()) {
    const width = HAIR + extra * (style.width - HAIR);
    yield* strokesOfLegs(brush, legs.reference, (leg) => classes[leg] === place, { ...style, width });
  }
}

/**
 * How often legs cover where they are, as wide as the most usual: where that is more than once, the widest would hide the others,
 * and as hairs each class covers what its share of the legs is.
 *
 * @param {Bare['view']} view
 * @param {Float64Array} reference both ends of each leg
 */
function layersOf(view, reference) {
  /** @type {Set<number>} */
  const squares = new Set();
  let length = 0;
  for (let at = 0; at < reference.length; at += 6) {
    const [x, y] = [view.toPixelX(reference[at + 3]), view.toPixelY(reference[at + 4])];
    squares.add(squareOf(x, y, COARSE));
    // Of a longer one, no more is in the square in which it ends.
    length += Math.min(COARSE, Math.hypot(x - view.toPixelX(reference[at]), y - view.toPixelY(reference[at + 1])));
  }
  return (length * USUAL) / (squares.size * COARSE ** 2);
}

/**
 * Where the odometry has the robot, from where that began: it drifts away, and each leg is compared by itself.
 *
 * @param {Bare} brush
 * @param {CalibrationLegs} legs
 * @returns {Strokes}
 */
function* strokesOfReading({ context, view, palette }, { count, odometry, reference }) {
  if (count === 0) return;
  const turn = reference[2] - odometry[2];
  const [cos, sin] = [Math.cos(turn), Math.sin(turn)];
  let [lastX, lastY, last] = [NaN, NaN, NaN];
  let [points, pixels] = [0, 0];
  context.beginPath();
  for (let leg = 0; leg < count; leg++) {
    const [dx, dy] = [odometry[6 * leg + 3] - odometry[0], odometry[6 * leg + 4] - odometry[1]];
    const x = view.toPixelX(reference[0] + cos * dx - sin * dy);
    const y = view.toPixelY(reference[1] + sin * dx + cos * dy);
    const square = squareOf(x, y);
    if (square === last) continue;
    last = square;
    context.lineTo(x, y);
    if (++points > 1) pixels += A_LINE + Math.hypot(x - lastX, y - lastY);
    [lastX, lastY] = [x, y];
    if (points <= LEGS_A_STROKE) continue;
    stroke(context, readStyleOf(palette));
    yield pixels;
    [points, pixels] = [1, 0];
    context.beginPath();
    context.moveTo(x, y);
  }
  stroke(context, readStyleOf(palette));
  yield pixels;
}

/**
 * @param {Bare} brush
 * @param {Float64Array} reference both ends of each leg
 * @param {(leg: number) => boolean} are which of them
 * @param {Style} style
 * @returns {Strokes}
 */
function* strokesOfLegs({ context, view }, reference, are, style) {
  /** @type {Set<number>} */
  const drawn = new Set();
  let [begun, pixels] = [0, 0];
  for (let leg = 0; leg < reference.length / 6; leg++) {
    if (!are(leg)) continue;
    const at = 6 * leg;
    const [x, y] = [view.toPixelX(reference[at]), view.toPixelY(reference[at + 1])];
    const [toX, toY] = [view.toPixelX(reference[at + 3]), view.toPixelY(reference[at + 4])];
    const length = Math.hypot(toX - x, toY - y);
    if (length < FINE) {
      const square = squareOf(toX, toY);
      if (drawn.has(square)) continue;
      drawn.add(square);
    }
    if (begun === 0) context.beginPath();
    context.moveTo(x, y);
    context.lineTo(toX, toY);
    pixels += A_LINE + length;
    begun = (begun + 1) % LEGS_A_STROKE;
    if (begun > 0) continue;
    stroke(context, style);
    yield pixels;
    pixels = 0;
  }
  if (begun === 0) return;
  stroke(context, style);
  yield pixels;
}

/**
 * Strokes what has been begun. What has no dashes has round ends.
 *
 * @param {Bare['context']} context
 * @param {Style} style
 */
function stroke(context, { colour, width, dash }) {
  context.strokeStyle = colour;
  context.lineWidth = width;
  context.lineCap = dash.length > 0 ? 'butt' : 'round';
  context.setLineDash(dash);
  context.stroke();
  context.lineCap = 'butt';
  context.setLineDash([]);
}
