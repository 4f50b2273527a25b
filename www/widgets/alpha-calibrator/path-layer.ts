/**
 * Layer with the path of the robot, leg by leg. It is cached, because there may be a hundred thousand legs, which change only with the log, the
 * view or the colours.
 */

import { strokePath, type Brush } from '../../scene/canvas.ts';
import { lineStyles } from '../../scene/draw.ts';
import { LINES_PER_STROKE, Layer, strokeInBatches, type Painter, Memo } from '../../scene/cache.ts';
import { colourChannels } from '../../ui/theme.ts';
import { LEG_CLASSES, LINE_STYLES, type LineName } from './settings.ts';
import type { CalibrationLegs } from '../../types.d.ts';

export type PathStyle = { colour: string, width: number, dash: number[] };

/** Number of legs above which the path is cached, on another canvas, and drawn as hairlines, because wide lines would hide each other. */
const MAX_WIDE_LEGS = 2000;

/** Radius of the rings around outliers, CSS pixels. */
const RING_RADIUS = 6;

/** Width of the thinnest lines, CSS pixels. */
const HAIRLINE_WIDTH = 1;

export function pathStyle({ palette, highlight }: Pick<Brush, 'palette' | 'highlight'>, name: LineName): PathStyle {
  const legColour = name === 'plausible' ? mixColours(palette.truth, palette.cloud) : palette.truth;
  return lineStyles({ palette: { ...palette, truth: legColour }, highlight }, LINE_STYLES)[name];
}

function mixColours(one: string, other: string) {
  const [firstChannels, secondChannels] = [colourChannels(one), colourChannels(other)];
  return `rgb(${firstChannels.map((value, i) => Math.round((value + secondChannels[i]) / 2))})`;
}

export class PathLayer {
  #layer = new Layer();
  #odometryPathMemo: Memo<Float64Array> = new Memo();

  /** Returns the ends of the legs by odometry (x, y pairs). The path starts at the first pose of the reference, and drifts away from it. */
  odometryPathOf(legs: CalibrationLegs): Float64Array {
    return this.#odometryPathMemo.get([legs], () => {
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
    const paintLegs = (painter: Painter) => drawPath(painter, legs, this.odometryPathOf(legs), classes, overlays);
    if ('vector' in brush.context || legs.count <= MAX_WIDE_LEGS) paintLegs(brush);
    else this.#layer.draw(brush, [legs, overlays, brush.highlight], paintLegs);
  }
}

function drawPath(brush: Painter, legs: CalibrationLegs, odometry: Float64Array, classes: Uint8Array, overlays: LineName[]) {
  const { context, view } = brush;
  const { count, reference, outliers } = legs;
  if (overlays.includes('odometry')) for (const line of odometryLines(view, odometry)) strokeInBatches(context, [line], pathStyle(brush, 'odometry'));
  for (const [index, name] of LEG_CLASSES.entries()) {
    if (!overlays.includes(name)) continue;
    const legsOfClass = [...classes.keys()].filter((leg) => classes[leg] === index);
    const lines = legsOfClass.map((leg) => [0, 3].map((end) => view.toPixel(reference[6 * leg + end], reference[6 * leg + end + 1])));
    const legStyle = { ...pathStyle(brush, name), cap: 'round' } as const;
    strokeInBatches(context, lines, count > MAX_WIDE_LEGS ? { ...legStyle, width: HAIRLINE_WIDTH } : legStyle);
  }
  const outlierLegs = overlays.includes('outlier') ? [...outliers.keys()].filter((leg) => outliers[leg] > 0) : [];
  drawRings(brush, outlierLegs.map((leg) => view.toPixel(reference[6 * leg + 3], reference[6 * leg + 4])));
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

/** Returns the path of the odometry as lines of many legs each. */
function* odometryLines(view: Painter['view'], ends: Float64Array) {
  for (let start = 0; start < ends.length; start += 2 * LINES_PER_STROKE) {
    yield view.toPixels(ends.subarray(start, start + 2 * LINES_PER_STROKE + 2));
  }
}
