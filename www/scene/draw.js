/**
 * What pictures are made of: robots, densities, outlines and marks. Every function takes the
 * brush, which knows the view's transform and the colours, and none keeps anything.
 */

import { limits } from '../settings.js';
import { channels } from '../ui/theme.js';
import { hiddenContext } from './canvas.js';
import { drawLabel } from './labels.js';

/**
 * @import { Brush } from './canvas.js'
 * @import { Palette } from '../ui/theme.js'
 *
 * @typedef {CanvasRenderingContext2D} Context
 */

/**
 * Heading ticks that are stroked at once. More is faster; but those of one stroke do not darken
 * where they cross, so many more would flatten the crowd.
 */
const TICKS_A_STROKE = 25;

/**
 * Samples as dots. Overlapping dots darken, so that a crowd looks like one.
 *
 * @param {Brush} brush
 * @param {Float64Array} triples
 * @param {{ x: number, y: number, heading: number | null, ahead?: number }} layout which of the three numbers are drawn, and the length of
 *   the heading's line as a share of the usual one
 */
export function drawDots(brush, triples, layout) {
  const { context, view, palette } = brush;
  const count = triples.length / 3;
  const few = count < 400;
  // Smaller in a small picture, where as many robots share less room.
  const size = Math.min(1, Math.max(0.7, view.width / 720));
  const radius = size * (few ? 2.4 : 1.8);
  const x = (/** @type {number} */ i) => view.toPixelX(triples[3 * i + layout.x]);
  const y = (/** @type {number} */ i) => view.toPixelY(triples[3 * i + layout.y]);
  const { heading, ahead = 1 } = layout;
  if (heading !== null) {
    const length = ahead * size * (few ? 13 : 9);
    context.strokeStyle = palette.cloud;
    context.lineWidth = 1;
    context.globalAlpha = few ? 0.6 : 0.32;
    for (let i = 0; i < count; i++) {
      if (i % TICKS_A_STROKE === 0) context.beginPath();
      headingTick(brush, x(i), y(i), triples[3 * i + heading], length);
      if (i % TICKS_A_STROKE === TICKS_A_STROKE - 1 || i === count - 1) context.stroke();
    }
  }
  context.globalAlpha = few ? 0.9 : 0.5;
  context.fillStyle = palette.cloud;
  for (let i = 0; i < count; i++) {
    context.beginPath();
    context.arc(x(i), y(i), radius, 0, 2 * Math.PI);
    context.fill();
  }
  context.globalAlpha = 1;
}

/**
 * Adds a line from a point in a direction of the world to the path.
 *
 * @param {Brush} brush
 * @param {number} x CSS pixels
 * @param {number} y
 * @param {number} heading radians
 * @param {number} length CSS pixels
 */
function headingTick({ context, view }, x, y, heading, length) {
  const ahead = view.direction(heading);
  context.moveTo(x, y);
  context.lineTo(x + length * ahead.x, y + length * ahead.y);
}

/**
 * Many robots at one place: a single marker, and every heading as a ray of a fan.
 *
 * @param {Brush} brush
 * @param {{ x: number, y: number, headings: number[], label: string }} heap
 */
export function drawHeap(brush, { x, y, headings, label }) {
  const { context, view, palette } = brush;
  const px = view.toPixelX(x);
  const py = view.toPixelY(y);
  context.strokeStyle = palette.prediction;
  context.lineWidth = 1;
  context.globalAlpha = Math.min(1, 30 / headings.length);
  for (const heading of headings) {
    context.beginPath();
    headingTick(brush, px, py, heading, 64);
    context.stroke();
  }
  context.globalAlpha = 1;
  context.fillStyle = palette.prediction;
  context.beginPath();
  // Large enough to show around the handle, which is often in the same place.
  context.arc(px, py, 14, 0, 2 * Math.PI);
  context.fill();
  drawLabel(brush, { x: px + 14, y: py + 27, towards: 1, text: label, colour: palette.prediction });
}

/**
 * The colours of a density by the share of its fullest cell: ink of the role's colour, thinner where there is less.
 *
 * @param {Palette} palette
 * @returns {Uint8Array} red, green, blue and alpha of each
 */
export function densityRamp(palette) {
  const cloud = channels(palette.cloud);
  const ink = channels(palette.ink);
  const ramp = new Uint8Array(4 * limits.ramp);
  for (let i = 0; i < limits.ramp; i++) {
    const shade = i / (limits.ramp - 1);
    const darkening = 0.6 * Math.max(0, shade - 0.5);
    for (let k = 0; k < 3; k++) ramp[4 * i + k] = cloud[k] + darkening * (ink[k] - cloud[k]);
    ramp[4 * i + 3] = 255 * (0.15 + 0.85 * shade);
  }
  return ramp;
}

/**
 * An image that covers the inside of the axes. Only the part with ink is drawn: of a density most is empty, and to stretch it
 * costs more than all the rest of a picture.
 *
 * @param {Brush} brush
 * @param {OffscreenCanvas} grid what the pixels go through to be stretched
 * @param {Uint8ClampedArray<ArrayBuffer>} pixels row 0 at the top
 * @param {number} columns
 */
export function drawPixels({ context, view }, grid, pixels, columns) {
  const rows = pixels.length / (4 * columns);
  if (grid.width !== columns) grid.width = columns;
  if (grid.height !== rows) grid.height = rows;
  const inked = inkedPart(pixels, columns, rows);
  if (!inked) return;
  const [x, y, width, height] = inked;
  // All of them: where they are stretched, those around the part shine through its edges.
  hiddenContext(grid).putImageData(new ImageData(pixels, columns, rows), 0, 0);
  const { left, right, top, bottom } = view.frame;
  const [across, down] = [(right - left) / columns, (bottom - top) / rows];
  context.imageSmoothingEnabled = true;
  context.drawImage(grid, x, y, width, height, left + across * x, top + down * y, across * width, down * height);
}

/**
 * Draws a density over the inside of the axes.
 *
 * @param {Brush} brush
 * @param {OffscreenCanvas} grid as for `drawPixels`
 * @param {number} cell CSS pixels
 * @param {(...view: [xMin: number, yMin: number, xMax: number, yMax: number, columns: number, rows: number]) => Uint8ClampedArray<ArrayBuffer>} pixelsOf
 */
export function drawDensity(brush, grid, cell, pixelsOf) {
  const { left, right, top, bottom } = brush.view.frame;
  const { xMin, yMin, xMax, yMax } = brush.view.extent;
  const [columns, rows] = [right - left, bottom - top].map((length) => Math.max(1, Math.round(length / cell)));
  drawPixels(brush, grid, pixelsOf(xMin, yMin, xMax, yMax, columns, rows), columns);
}

/**
 * The box of the pixels with ink and a pixel around it, into which they fade where they are stretched.
 *
 * @param {Uint8ClampedArray<ArrayBuffer>} pixels
 * @param {number} columns
 * @param {number} rows
 * @returns {[x: number, y: number, width: number, height: number] | undefined}
 */
function inkedPart(pixels, columns, rows) {
  const cells = new Uint32Array(pixels.buffer, pixels.byteOffset, columns * rows);
  let [left, right, first, last] = [columns, 0, -1, -1];
  for (let i = 0; i < cells.length; i++) {
    if (cells[i] === 0) continue;
    if (first < 0) first = i;
    last = i;
    left = Math.min(left, i % columns);
    right = Math.max(right, i % columns);
  }
  if (first < 0) return undefined;
  const [x, y] = [Math.max(0, left - 1), Math.max(0, Math.floor(first / columns) - 1)];
  return [x, y, Math.min(columns, right + 2) - x, Math.min(rows, Math.floor(last / columns) + 2) - y];
}

/**
 * Adds a polyline through x, y pairs to the path.
 *
 * @param {Brush} brush
 * @param {Float64Array} points
 */
export function trace({ context, view }, points) {
  context.moveTo(view.toPixelX(points[0]), view.toPixelY(points[1]));
  for (let i = 2; i < points.length; i += 2) {
    context.lineTo(view.toPixelX(points[i]), view.toPixelY(points[i + 1]));
  }
}

/**
 * @typedef {object} Outline
 * @property {Float64Array} points x, y pairs
 * @property {string} colour
 * @property {number} width CSS pixels
 * @property {number[]} dash
 */

/** Width of a highlighted line, times its own. */
const THICK = 1.9;

/** Ink of the lines that are not highlighted. */
const FAINT = 0.3;

/**
 * Returns how lines are drawn by name: in the colours of their roles, the highlighted one thicker and all others faint.
 *
 * @template {string} Name
 * @param {Pick<Brush, 'palette' | 'highlight'>} brush
 * @param {Record<Name, import('../figure/overlays.js').LineStyle>} lines
 */
export function lineStyles({ palette, highlight }, lines) {
  const isLit = Object.keys(lines).some((name) => name === highlight);
  const styles = Object.entries(/** @type {Record<string, import('../figure/overlays.js').LineStyle>} */ (lines)).map(([name, { role, width = 2.25, dash = [] }]) => {
    const colour = isLit && name !== highlight ? `rgb(${channels(palette[role]).join(' ')} / ${FAINT})` : palette[role];
    return [name, { colour, width: name === highlight ? THICK * width : width, dash }];
  });
  return /** @type {Record<Name, { colour: string, width: number, dash: number[] }>} */ (Object.fromEntries(styles));
}

/** Whether an outline has any length: that of robots at one place has none but of rounding. @param {Float64Array} points */
export const hasLength = (points) => points.some((value, i) => Math.abs(value - points[i % 2]) > 1e-9);

/**
 * Polylines with halos of paper, so that they read on top of the cloud. The halos are below all of them: where two nearly
 * coincide, both are seen.
 *
 * @param {Brush} brush
 * @param {Outline[]} outlines the last one on top
 */
export function drawOutlines(brush, outlines) {
  const { context, palette } = brush;
  const drawn = outlines.filter(({ points }) => hasLength(points));
  context.lineJoin = 'round';
  context.globalAlpha = 0.7;
  context.strokeStyle = palette.paper;
  for (const { points, width } of drawn) {
    context.beginPath();
    trace(brush, points);
    context.lineWidth = width + 2.5;
    context.stroke();
  }
  context.globalAlpha = 1;
  strokeLines(brush, drawn);
}

/** Draws lines in their own styles. @param {Brush} brush @param {Outline[]} lines */
function strokeLines(brush, lines) {
  const { context } = brush;
  for (const { points, colour, width, dash } of lines) {
    context.beginPath();
    trace(brush, points);
    context.strokeStyle = colour;
    context.lineWidth = width;
    context.setLineDash(dash);
    context.stroke();
  }
  context.setLineDash([]);
}

/** Opacity of outlines as they were. */
const GHOST = 0.35;

/**
 * Draws outlines as they were before what is seen now.
 *
 * @param {Brush} brush
 * @param {Outline[]} outlines
 */
export function drawGhosts(brush, outlines) {
  brush.context.globalAlpha = GHOST;
  strokeLines(brush, outlines.filter(({ points }) => hasLength(points)));
  brush.context.globalAlpha = 1;
}

/**
 * A single one of them.
 *
 * @param {Brush} brush
 * @param {Float64Array} points
 * @param {Omit<Outline, 'points'>} style
 */
export function drawOutline(brush, points, style) {
  drawOutlines(brush, [{ points, ...style }]);
}

/**
 * A robot seen from above: a disc with a line to the front.
 *
 * @param {Brush} brush
 * @param {{ x: number, y: number, heading: number, colour: string }} robot
 */
export function drawRobot(brush, { x, y, heading, colour }) {
  const { context, view, palette } = brush;
  const px = view.toPixelX(x);
  const py = view.toPixelY(y);
  context.beginPath();
  context.arc(px, py, 8, 0, 2 * Math.PI);
  context.fillStyle = palette.paper;
  context.fill();
  headingTick(brush, px, py, heading, 14);
  context.strokeStyle = colour;
  context.lineWidth = 2;
  context.stroke();
}

/**
 * Paints a handle where no element stands for it: in files and on paper.
 *
 * @param {Brush} brush
 * @param {{ x: number, y: number, radius: number, colour: string }} handle pixels
 */
export function drawHandle({ context, palette, handles }, { x, y, radius, colour }) {
  if (!handles) return;
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
  context.fillStyle = palette.paper;
  context.fill();
  context.strokeStyle = colour;
  context.lineWidth = 3;
  context.stroke();
}

/**
 * The ring and cross hairs of the marked sample.
 *
 * @param {Brush} brush
 * @param {{ x: number, y: number, heading: number | null }} sample
 * @param {string} [accent] its colour
 */
export function drawMark(brush, { x, y, heading }, accent = brush.palette.accent) {
  const { context, view, palette } = brush;
  const px = view.toPixelX(x);
  const py = view.toPixelY(y);
  for (const [colour, width] of /** @type {const} */ ([
    [palette.paper, 5],
    [accent, 2],
  ])) {
    context.strokeStyle = colour;
    context.lineWidth = width;
    context.beginPath();
    context.arc(px, py, 7, 0, 2 * Math.PI);
    for (const [dx, dy] of [[1, 0], [0, 1], [-1, 0], [0, -1]]) {
      context.moveTo(px + 7 * dx, py + 7 * dy);
      context.lineTo(px + 12 * dx, py + 12 * dy);
    }
    if (heading !== null) headingTick(brush, px, py, heading, 24);
    context.stroke();
  }
}
