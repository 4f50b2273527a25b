/**
 * Layer with the path of the robot, leg by leg. It is cached, because there may be a hundred thousand legs, which change only with the log, the
 * view or the colours.
 */

import { strokePath, type Brush } from '../../scene/canvas.ts';
import { lineStyles } from '../../scene/draw.ts';
import { LINES_PER_STROKE, Layer, strokeMany, type Painter } from '../../scene/layer.ts';
import { Memo } from '../../scene/memo.ts';
import { colourChannels } from '../../ui/theme.ts';
import { LEG_CLASSES, LINE_STYLES, type LineName } from './settings.ts';
import type { CalibrationLegs } from '../../types.d.ts';

export type PathStyle = { colour: string, width: number, dash: number[] };

/** Maximum number of legs that are drawn without a cache. The cache is another canvas, which takes memory. */
const MAX_UNCACHED_LEGS = 2000;

/** Side of the squares of a grid, CSS pixels. Of the short lines that end in one square only one is drawn, because all look equal. */
const FINE_SQUARE = 1;

/** Side of the squares by which the coverage of the picture is measured, CSS pixels. */
const COARSE_SQUARE = 8;

/** Returns the key of the grid square that contains a point in CSS pixels. */
const gridSquareOf = (x: number, y: number, side: number = FINE_SQUARE) => Math.round(x / side) + 2 ** 26 * Math.round(y / side);

/** Radius of the rings around outliers, CSS pixels. */
const RING_RADIUS = 6;

/** Width of the thinnest lines, CSS pixels. */
const HAIRLINE_WIDTH = 1;

export function pathStyle({ palette, highlight }: Pick<Brush, 'palette' | 'highlight'>, name: LineName): PathStyle {
  const legColour = name === 'plausible' ? mixedColour(palette.truth, palette.cloud) : palette.truth;
  return lineStyles({ palette: { ...palette, truth: legColour }, highlight }, LINE_STYLES)[name];
}

function mixedColour(one: string, other: string) {
  const [from, to] = [colourChannels(one), colourChannels(other)];
  return `rgb(${from.map((value, i) => Math.round((value + to[i]) / 2))})`;
}

export class PathLayer {
  #layer = new Layer();
  #odometry: Memo<Float64Array> = new Memo();

  /** Returns the ends of the legs by odometry (x, y pairs). The path starts at the first pose of the reference, and drifts away from it. */
  odometryOf(legs: CalibrationLegs): Float64Array {
    return this.#odometry.get([legs], () => {
      const { count, odometry, reference } = legs;
      const frameRotation = reference[2] - odometry[2];
      const [cos, sin] = [Math.cos(frameRotation), Math.sin(frameRotation)];
      const legEnds = new Float64Array(2 * count);
      for (let leg = 0; leg < count; leg++) {
        const [dx, dy] = [odometry[6 * leg + 3] - odometry[0], odometry[6 * leg + 4] - odometry[1]];
        legEnds[2 * leg] = reference[0] + cos * dx - sin * dy;
        legEnds[2 * leg + 1] = reference[1] + sin * dx + cos * dy;
      }
      return legEnds;
    });
  }

  /** Draws the legs, the most usual classes first. */
  draw(brush: Brush, legs: CalibrationLegs, classes: Uint8Array, overlays: LineName[]) {
    const paint = (painter: Painter) => drawPath(painter, legs, this.odometryOf(legs), classes, overlays);
    if ('vector' in brush.context || legs.count <= MAX_UNCACHED_LEGS) paint(brush);
    else this.#layer.draw(brush, [legs, overlays, brush.highlight], paint);
  }
}

function drawPath(brush: Painter, legs: CalibrationLegs, odometry: Float64Array, classes: Uint8Array, overlays: LineName[]) {
  if (overlays.includes('odometry')) strokeMany(brush.context, odometryLines(brush.view, odometry), pathStyle(brush, 'odometry'));
  // Lines get thinner gradually while the coverage grows from 1 to 2, so that nothing jumps when the picture is resized.
  const thickness = Math.max(0, Math.min(1, 2 - pathCoverage(brush.view, legs.reference)));
  for (const [index, name] of LEG_CLASSES.entries()) {
    if (!overlays.includes(name)) continue;
    const legStyle = pathStyle(brush, name);
    const legLines = visibleLegs(brush.view, legs.reference, (leg) => classes[leg] === index);
    strokeMany(brush.context, legLines, { ...legStyle, width: HAIRLINE_WIDTH + thickness * (legStyle.width - HAIRLINE_WIDTH) });
  }
  if (overlays.includes('outlier')) drawRings(brush, outlierEnds(brush, legs));
}

/** Returns the ends of the outliers, CSS pixels. */
function outlierEnds({ view }: Painter, { outliers, reference }: CalibrationLegs): [number, number][] {
  const outlierLegs = [...outliers.keys()].filter((leg) => outliers[leg] > 0);
  return outlierLegs.map((leg) => view.toPixel(reference[6 * leg + 3], reference[6 * leg + 4]));
}

export function drawRings(brush: Painter, points: [number, number][]) {
  const { context } = brush;
  strokePath(context, pathStyle(brush, 'outlier'), () => {
    for (const [x, y] of points) {
      context.moveTo(x + RING_RADIUS, y);
      context.arc(x, y, RING_RADIUS, 0, 2 * Math.PI);
    }
  });
}

/**
 * Returns the coverage: the area of the legs at the usual line width, divided by the area of the squares in which they end. Above 1, wide
 * lines would hide each other; as hairlines, each class covers an area in proportion to its number of legs.
 */
function pathCoverage(view: Painter['view'], reference: Float64Array) {
  const occupiedSquares: Set<number> = new Set();
  let coveredLength = 0;
  for (let at = 0; at < reference.length; at += 6) {
    const [x, y] = [view.toPixelX(reference[at + 3]), view.toPixelY(reference[at + 4])];
    occupiedSquares.add(gridSquareOf(x, y, COARSE_SQUARE));
    // A leg counts only for the square in which it ends, with at most the side of the square.
    coveredLength += Math.min(COARSE_SQUARE, Math.hypot(x - view.toPixelX(reference[at]), y - view.toPixelY(reference[at + 1])));
  }
  return (coveredLength * LINE_STYLES.likely.width) / (occupiedSquares.size * COARSE_SQUARE ** 2);
}

/** Returns the path of the odometry as lines between the ends of its legs. */
function* odometryLines(view: Painter['view'], ends: Float64Array) {
  let [previousSquare, line] = [NaN, [] as number[][]];
  for (let at = 0; at < ends.length; at += 2) {
    const legEnd = view.toPixel(ends[at], ends[at + 1]);
    const square = gridSquareOf(...legEnd);
    if (square === previousSquare) continue;
    previousSquare = square;
    line.push(legEnd);
    if (line.length <= LINES_PER_STROKE) continue;
    yield line;
    line = [legEnd];
  }
  yield line;
}

/** Returns the legs that are drawn as lines between their ends. */
function* visibleLegs(view: Painter['view'], reference: Float64Array, isDrawn: (leg: number) => boolean) {
  const drawnSquares: Set<number> = new Set();
  for (let leg = 0; leg < reference.length / 6; leg++) {
    if (!isDrawn(leg)) continue;
    const at = 6 * leg;
    const [from, to] = [view.toPixel(reference[at], reference[at + 1]), view.toPixel(reference[at + 3], reference[at + 4])];
    if (Math.hypot(to[0] - from[0], to[1] - from[1]) < FINE_SQUARE) {
      const square = gridSquareOf(...to);
      if (drawnSquares.has(square)) continue;
      drawnSquares.add(square);
    }
    yield [from, to];
  }
}
