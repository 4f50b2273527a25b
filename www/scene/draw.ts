/** Drawing of robots, densities, outlines and rings. All functions are stateless. */

import { greatest } from 'd3-array';
import { limits } from '../../build/settings.js';
import { colourChannelsOf, type LineStyle, type Palette } from '../ui/theme.ts';
import type { LegendEntry } from './axes.ts';
import { addLine, drawDisc, fillPath, paintWithOpacity, strokeLine, strokePath, type DrawContext, type LineStroke } from './canvas.ts';
import { strokeInBatches } from './cache.ts';
import type { Callout } from './labels.ts';

/**
 * Number of heading ticks in one stroke. Ticks of the same stroke do not darken each other where they cross. A larger number would hide the
 * density.
 */
const TICKS_PER_STROKE = 25;

/**
 * Draws samples (triples of x, y and heading) as translucent dots, so that dense regions are darker. `tickScale` is the relative length of the
 * heading ticks.
 */
export function drawDots(drawContext: DrawContext, poses: Float64Array, tickScale: number = 0) {
  const { context, view, palette } = drawContext;
  const dotPixels = Array.from({ length: poses.length / 3 }, (_, i) => view.toPixel(poses[3 * i], poses[3 * i + 1]));
  const isSparse = dotPixels.length < 400;
  // Dots are smaller in a small picture, where the robots have less space.
  const dotScale = Math.min(1, Math.max(0.7, view.width / 720));
  const radius = dotScale * (isSparse ? 2.4 : 1.8);
  if (tickScale > 0) {
    const tickLength = tickScale * dotScale * (isSparse ? 13 : 9);
    const headingTicks = dotPixels.map((_, i) => view.headingLineFrom({ x: poses[3 * i], y: poses[3 * i + 1], theta: poses[3 * i + 2] }, tickLength));
    paintWithOpacity(context, isSparse ? 0.6 : 0.32, () => strokeInBatches(context, headingTicks, { colour: palette.cloud, width: 1 }, TICKS_PER_STROKE));
  }
  // Squares with the area of the discs are drawn six times as fast. If they are many and small, they look like discs.
  const sideLength = Math.sqrt(Math.PI) * radius;
  context.fillStyle = palette.cloud;
  paintWithOpacity(context, isSparse ? 0.9 : 0.5, () => {
    for (const [x, y] of dotPixels) {
      if (isSparse || drawContext.isExported) drawDisc(context, [x, y], radius, palette.cloud);
      else context.fillRect(x - sideLength / 2, y - sideLength / 2, sideLength, sideLength);
    }
  });
}

/**
 * Returns the colour ramp of a density as RGBA bytes, from an empty cell to the fullest one: the colour of clouds with increasing opacity.
 */
export function createDensityRamp(palette: Palette): Uint8Array {
  const cloudColour = colourChannelsOf(palette.cloud);
  const inkColour = colourChannelsOf(palette.ink);
  const colourRamp = new Uint8Array(4 * limits.ramp);
  for (let i = 0; i < limits.ramp; i++) {
    const relativeCount = i / (limits.ramp - 1);
    const inkShare = 0.6 * Math.max(0, relativeCount - 0.5);
    for (let k = 0; k < 3; k++) colourRamp[4 * i + k] = cloudColour[k] + inkShare * (inkColour[k] - cloudColour[k]);
    colourRamp[4 * i + 3] = 255 * (0.15 + 0.85 * relativeCount);
  }
  return colourRamp;
}

interface Outline extends LineStroke {
  /** Points as x, y pairs, in metres or in the units of the view. */
  points: Float64Array;
}

const HIGHLIGHT_WIDTH_FACTOR = 1.9;

const DIMMED_OPACITY = 0.3;

type ShownLine = Required<Omit<LineStroke, 'lineCap'>> & Pick<LineStyle, 'shape'>;

/** Styles of the lines and marks that are shown, by name. */
type ShownLines<Name extends string> = { [Key in Name]?: ShownLine };

/** Returns the styles of the shown lines and marks, in the colours of their roles. The highlighted line is thicker, and all others are faint. */
export function createLineStyles<Name extends string>({ palette, highlight }: Pick<DrawContext, 'palette' | 'highlight'>, lineStyles: Record<Name, LineStyle>, shownNames: readonly string[]) {
  const hasHighlight = Object.keys(lineStyles).some((name) => name === highlight);
  const shownStyles = Object.entries(lineStyles as Record<string, LineStyle>).filter(([name]) => shownNames.includes(name));
  const styleEntries = shownStyles.map(([name, { role, width = 2.25, dash = [], shape }]) => {
    const colour = hasHighlight && name !== highlight ? `rgb(${colourChannelsOf(palette[role]).join(' ')} / ${DIMMED_OPACITY})` : palette[role];
    return [name, { colour, width: name === highlight ? HIGHLIGHT_WIDTH_FACTOR * width : width, dash, shape }];
  });
  return Object.fromEntries(styleEntries) as ShownLines<Name>;
}

/** Returns the shown lines as outlines with their points, in the order of `pointsByName`. */
export const styleOutlines = <Name extends string>(lines: ShownLines<Name>, pointsByName: { [Key in Name]?: Float64Array }): Outline[] =>
  (Object.keys(pointsByName) as Name[]).flatMap((name) => {
    const style = lines[name];
    return style ? [{ points: pointsByName[name] as Float64Array, ...style }] : [];
  });

/** Returns the legend of an exported picture: those of the named lines and marks that are shown. On the page the legend is HTML beside the picture. */
export function createLineLegend<Name extends string>(drawContext: DrawContext, lines: ShownLines<Name>, lineNames: readonly Name[], labelsByName: Record<Name, string>): LegendEntry[] {
  return drawContext.isExported ? lineNames.filter((name) => lines[name]).map((name) => ({
    name: labelsByName[name].replaceAll('*', ''),
    drawSample: (x, y, width) => drawSwatch(drawContext, lines[name] as ShownLine, [x, y], width),
  })) : [];
}

/** Half the size of a cross, CSS pixels. */
const CROSS_HALF_SIZE = 2.6;

/** Adds a cross at a point in CSS pixels to the path. */
export function addCross(context: DrawContext['context'], x: number, y: number) {
  addLine(context, [[x - CROSS_HALF_SIZE, y - CROSS_HALF_SIZE], [x + CROSS_HALF_SIZE, y + CROSS_HALF_SIZE]]);
  addLine(context, [[x - CROSS_HALF_SIZE, y + CROSS_HALF_SIZE], [x + CROSS_HALF_SIZE, y - CROSS_HALF_SIZE]]);
}

/** Draws the symbol of a legend entry, as `swatchHtml` does on the page. The point is its left end, in pixels. */
function drawSwatch({ context }: DrawContext, { shape, ...style }: ShownLine, [x, y]: [x: number, y: number], width: number) {
  const [middleX, { colour }] = [x + width / 2, style];
  if (shape === 'area') fillPath(context, colour, () => context.rect(middleX - 5.5, y - 5.5, 11, 11));
  else if (shape === 'cross') strokePath(context, { colour, width: 1 }, () => addCross(context, middleX, y));
  else if (shape === 'dot' || shape === 'ring') drawDisc(context, [middleX, y], 3, shape === 'dot' ? colour : undefined, { colour, width: 1 });
  else strokeLine(context, [[x, y], [x + width, y]], style);
}

/** Returns true if an outline is longer than rounding errors. The outline of robots that all stop at one point has no length. */
export const hasLength = (points: Float64Array) => points.some((coordinate, i) => Math.abs(coordinate - points[i % 2]) > 1e-9);

/**
 * Draws polylines with halos in the background colour, so that they are visible on top of the cloud. The last line is on top. All halos are
 * below all lines, so that two lines that nearly coincide are both visible.
 */
export function drawOutlines(drawContext: DrawContext, outlines: Outline[]) {
  const { context, palette } = drawContext;
  const visibleOutlines = outlines.filter(({ points }) => hasLength(points));
  context.lineJoin = 'round';
  paintWithOpacity(context, 0.7, () => strokeLines(drawContext, visibleOutlines.map(({ points, width }) => ({ points, colour: palette.paper, width: width + 2.5 }))));
  strokeLines(drawContext, visibleOutlines);
}

export function strokeLines({ context, view }: DrawContext, lines: Outline[]) {
  for (const { points, ...style } of lines) strokeLine(context, view.toPixels(points), style);
}

const EARLIER_OUTLINE_OPACITY = 0.35;

/**
 * Draws the outlines from before a gesture. Returns a callout that names them, or none if they are out of the view. The callout points to
 * the visible point that is furthest from the present outlines.
 */
export function drawEarlierOutlines(drawContext: DrawContext, outlines: Outline[], currentPoints: ArrayLike<number>[], calloutText: string): Callout[] {
  const { context, view, palette } = drawContext;
  const visibleOutlines = outlines.filter(({ points }) => hasLength(points));
  paintWithOpacity(context, EARLIER_OUTLINE_OPACITY, () => strokeLines(drawContext, visibleOutlines));
  const { xMin, xMax, yMin, yMax } = view.extent;
  const visiblePoints = visibleOutlines.flatMap(({ points }) => Array.from({ length: points.length / 2 }, (_, i): [number, number] => [points[2 * i], points[2 * i + 1]]))
    .filter(([x, y]) => x > xMin && x < xMax && y > yMin && y < yMax);
  const calloutPoint = greatest(visiblePoints, ([x, y]) => Math.min(...currentPoints.map((currentPoint) => Math.hypot(view.scaleX * (x - currentPoint[0]), view.scaleY * (y - currentPoint[1])))));
  return calloutPoint ? [{ text: calloutText, point: calloutPoint, colour: palette.muted }] : [];
}

export function drawOutline(drawContext: DrawContext, points: Float64Array, style: LineStroke) {
  drawOutlines(drawContext, [{ points, ...style }]);
}

/** Draws a robot seen from above: a disc with a line to the front. */
export function drawRobot(drawContext: DrawContext, { x, y, heading, colour }: { x: number, y: number, heading: number, colour: string }) {
  const { context, view, palette } = drawContext;
  drawDisc(context, view.toPixel(x, y), 8, palette.paper, { colour, width: 2 });
  strokeLine(context, view.headingLineFrom({ x, y, theta: heading }, 14), { colour, width: 2 });
}

/** Adds the arc of a turn (rad) from a heading, about a point and with a radius in pixels, to the path. On the screen y points down. */
export const addTurnArc = (context: CanvasRenderingContext2D, [x, y]: number[], radius: number, heading: number, turn: number) =>
  context.arc(x, y, radius, -heading, -heading - turn, turn > 0);

/** Draws a handle as a disc in printed pictures and files, which contain no handle elements. Lengths are in pixels. */
export function drawHandle({ context, palette, drawsHandles }: DrawContext, { x, y, radius, colour }: { x: number, y: number, radius: number, colour: string }) {
  if (drawsHandles) drawDisc(context, [x, y], radius, palette.paper, { colour, width: 3 });
}

/** Draws a ring with cross hairs around a point, by default in the colour of the selected sample. */
export function drawCrosshair(drawContext: DrawContext, { x, y, heading }: { x: number, y: number, heading: number | null }, colour: string = drawContext.palette.accent) {
  const { context, view, palette } = drawContext;
  const [centreX, centreY] = view.toPixel(x, y);
  for (const style of [{ colour: palette.paper, width: 5 }, { colour, width: 2 }]) {
    strokePath(context, style, () => {
      context.arc(centreX, centreY, 7, 0, 2 * Math.PI);
      for (const [dx, dy] of [[1, 0], [0, 1], [-1, 0], [0, -1]]) addLine(context, [[centreX + 7 * dx, centreY + 7 * dy], [centreX + 12 * dx, centreY + 12 * dy]]);
      if (heading !== null) addLine(context, view.headingLineFrom({ x, y, theta: heading }, 24));
    });
  }
}
