/** Drawing of robots, densities, outlines and rings. All functions are stateless. */

import { greatest } from 'd3-array';
import { limits } from '../../build/settings.js';
import { colourChannelsOf, type LineStyle, type ColourPalette } from '../ui/theme.ts';
import type { LegendEntry } from './axes.ts';
import { addLine, drawDisc, paintWithOpacity, strokeLine, strokePath, type DrawContext, type LineStroke } from './canvas.ts';
import { strokeInBatches } from './cache.ts';
import type { Callout } from './labels.ts';

/**
 * Number of heading ticks drawn in one stroke. Where ticks of the same stroke cross, they are not darker. With more ticks in a stroke, dense regions
 * would therefore not be visible.
 */
const TICKS_PER_STROKE = 25;

/**
 * Draws samples (triples of x, y and heading) as translucent dots, so that dense regions are darker. `tickScale` is the relative length of the
 * heading ticks.
 */
export function drawDots(drawContext: DrawContext, poses: Float64Array, tickScale: number = 0) {
  const { canvasContext, pictureView, palette } = drawContext;
  const dotPositions = Array.from({ length: poses.length / 3 }, (_, i) => pictureView.toPixel(poses[3 * i], poses[3 * i + 1]));
  const isSparse = dotPositions.length < 400;
  // Dots are smaller in a small picture, where the robots have less space.
  const dotScale = Math.min(1, Math.max(0.7, pictureView.width / 720));
  const radius = dotScale * (isSparse ? 2.4 : 1.8);
  if (tickScale > 0) {
    const tickLength = tickScale * dotScale * (isSparse ? 13 : 9);
    const headingTicks = dotPositions.map((_, i) => pictureView.headingLineFrom({ x: poses[3 * i], y: poses[3 * i + 1], theta: poses[3 * i + 2] }, tickLength));
    paintWithOpacity(canvasContext, isSparse ? 0.6 : 0.32, () => strokeInBatches(canvasContext, headingTicks, { colour: palette.cloud, width: 1 }, TICKS_PER_STROKE));
  }
  // Squares with the area of the discs are drawn six times as fast. If they are many and small, they look like discs.
  const sideLength = Math.sqrt(Math.PI) * radius;
  canvasContext.fillStyle = palette.cloud;
  paintWithOpacity(canvasContext, isSparse ? 0.9 : 0.5, () => {
    for (const [x, y] of dotPositions) {
      if (isSparse || drawContext.isExported) drawDisc(canvasContext, [x, y], radius, palette.cloud);
      else canvasContext.fillRect(x - sideLength / 2, y - sideLength / 2, sideLength, sideLength);
    }
  });
}

/**
 * Returns the colour ramp of a density as RGBA bytes, from an empty cell to the fullest one: the colour of clouds with increasing opacity.
 */
export function createDensityRamp(palette: ColourPalette): Uint8Array {
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

interface StyledOutline extends LineStroke {
  /** Points as x, y pairs, in metres or in the units of the view. */
  points: Float64Array;
}

const HIGHLIGHT_WIDTH_FACTOR = 1.9;

const DIMMED_OPACITY = 0.3;

type ShownLine = Omit<LegendEntry, 'name'>;

/** Styles of the lines and marks that are shown, by name. */
type ShownLines<Name extends string> = { [Key in Name]?: ShownLine };

/** Returns the styles of the shown lines and marks, in the colours of their roles. The highlighted line is thicker, and all others are faint. */
export function createLineStyles<Name extends string>({ palette, highlight }: Pick<DrawContext, 'palette' | 'highlight'>, lineStyles: Record<Name, LineStyle>, shownNames: readonly string[]) {
  const hasHighlight = Object.keys(lineStyles).some((lineName) => lineName === highlight);
  const shownStyles = Object.entries(lineStyles as Record<string, LineStyle>).filter(([lineName]) => shownNames.includes(lineName));
  const styleEntries = shownStyles.map(([lineName, { colourRole, width = 2.25, dash = [], shape: swatchShape }]) => {
    const lineColour = hasHighlight && lineName !== highlight ? `rgb(${colourChannelsOf(palette[colourRole]).join(' ')} / ${DIMMED_OPACITY})` : palette[colourRole];
    return [lineName, { colour: lineColour, width: lineName === highlight ? HIGHLIGHT_WIDTH_FACTOR * width : width, dash, shape: swatchShape }];
  });
  return Object.fromEntries(styleEntries) as ShownLines<Name>;
}

/** Returns the shown lines as outlines with their points, in the order of `pointsByName`. */
export const styleOutlines = <Name extends string>(shownLines: ShownLines<Name>, pointsByName: { [Key in Name]?: Float64Array }): StyledOutline[] =>
  (Object.keys(pointsByName) as Name[]).flatMap((lineName) => {
    const lineStyle = shownLines[lineName];
    return lineStyle ? [{ points: pointsByName[lineName] as Float64Array, ...lineStyle }] : [];
  });

/** Returns the legend of an exported picture: those of the named lines and marks that are shown. On the page the legend is HTML beside the picture. */
export function createLineLegend<Name extends string>(drawContext: DrawContext, shownLines: ShownLines<Name>, lineNames: readonly Name[], labelsByName: Record<Name, string>): LegendEntry[] {
  return drawContext.isExported ? lineNames.filter((lineName) => shownLines[lineName]).map((lineName) => ({ ...shownLines[lineName] as ShownLine, name: labelsByName[lineName].replaceAll('*', '') })) : [];
}

/** Returns true if an outline is longer than rounding errors. The outline of robots that all stop at one point has no length. */
export const hasLength = (pathPoints: Float64Array) => pathPoints.some((coordinate, i) => Math.abs(coordinate - pathPoints[i % 2]) > 1e-9);

/**
 * Draws polylines with halos in the background colour, so that they are visible on top of the cloud. The last line is on top. All halos are
 * below all lines, so that two lines that nearly coincide are both visible.
 */
export function drawOutlines(drawContext: DrawContext, styledOutlines: StyledOutline[]) {
  const { canvasContext, palette } = drawContext;
  const visibleOutlines = styledOutlines.filter(({ points: outlinePoints }) => hasLength(outlinePoints));
  canvasContext.lineJoin = 'round';
  paintWithOpacity(canvasContext, 0.7, () => strokeLines(drawContext, visibleOutlines.map(({ points: outlinePoints, width }) => ({ points: outlinePoints, colour: palette.paper, width: width + 2.5 }))));
  strokeLines(drawContext, visibleOutlines);
}

export function strokeLines({ canvasContext, pictureView }: DrawContext, styledOutlines: StyledOutline[]) {
  for (const { points: outlinePoints, ...lineStyle } of styledOutlines) strokeLine(canvasContext, pictureView.toPixels(outlinePoints), lineStyle);
}

const EARLIER_OUTLINE_OPACITY = 0.35;

/**
 * Draws the outlines from before a gesture. Returns a callout that names them, or none if they are out of the view. The callout points to
 * the visible point that is furthest from the present outlines.
 */
export function drawEarlierOutlines(drawContext: DrawContext, styledOutlines: StyledOutline[], currentPoints: ArrayLike<number>[], calloutText: string): Callout[] {
  const { canvasContext, pictureView, palette } = drawContext;
  const visibleOutlines = styledOutlines.filter(({ points: outlinePoints }) => hasLength(outlinePoints));
  paintWithOpacity(canvasContext, EARLIER_OUTLINE_OPACITY, () => strokeLines(drawContext, visibleOutlines));
  const { xMin, xMax, yMin, yMax } = pictureView.shownExtent;
  const visiblePoints = visibleOutlines.flatMap(({ points: outlinePoints }) => Array.from({ length: outlinePoints.length / 2 }, (_, i): [number, number] => [outlinePoints[2 * i], outlinePoints[2 * i + 1]]))
    .filter(([x, y]) => x > xMin && x < xMax && y > yMin && y < yMax);
  const calloutPoint = greatest(visiblePoints, ([x, y]) => Math.min(...currentPoints.map((currentPoint) => Math.hypot(pictureView.scaleX * (x - currentPoint[0]), pictureView.scaleY * (y - currentPoint[1])))));
  return calloutPoint ? [{ text: calloutText, point: calloutPoint, colour: palette.muted }] : [];
}

export function drawOutline(drawContext: DrawContext, outlinePoints: Float64Array, lineStyle: LineStroke) {
  drawOutlines(drawContext, [{ points: outlinePoints, ...lineStyle }]);
}

/** Draws a robot seen from above: a disc with a line to the front. */
export function drawRobot(drawContext: DrawContext, { x, y, heading, colour: robotColour }: { x: number, y: number, heading: number, colour: string }) {
  const { canvasContext, pictureView, palette } = drawContext;
  drawDisc(canvasContext, pictureView.toPixel(x, y), 8, palette.paper, { colour: robotColour, width: 2 });
  strokeLine(canvasContext, pictureView.headingLineFrom({ x, y, theta: heading }, 14), { colour: robotColour, width: 2 });
}

/** Adds the arc of a turn (rad) from a heading, about a point and with a radius in pixels, to the path. On the screen y points down. */
export const addTurnArc = (canvasContext: CanvasRenderingContext2D, [x, y]: number[], radius: number, heading: number, turnAngle: number) =>
  canvasContext.arc(x, y, radius, -heading, -heading - turnAngle, turnAngle > 0);

/** Draws a handle as a disc in printed pictures and files, which contain no handle elements. Lengths are in pixels. */
export function drawHandle({ canvasContext, palette, drawsHandles }: DrawContext, { x, y, radius, colour: handleColour }: { x: number, y: number, radius: number, colour: string }) {
  if (drawsHandles) drawDisc(canvasContext, [x, y], radius, palette.paper, { colour: handleColour, width: 3 });
}

/** Draws a ring with cross hairs around a point, by default in the colour of the selected sample. */
export function drawCrosshair(drawContext: DrawContext, { x, y, heading }: { x: number, y: number, heading: number | null }, lineColour: string = drawContext.palette.accent) {
  const { canvasContext, pictureView, palette } = drawContext;
  const [centreX, centreY] = pictureView.toPixel(x, y);
  for (const lineStyle of [{ colour: palette.paper, width: 5 }, { colour: lineColour, width: 2 }]) {
    strokePath(canvasContext, lineStyle, () => {
      canvasContext.arc(centreX, centreY, 7, 0, 2 * Math.PI);
      for (const [dx, dy] of [[1, 0], [0, 1], [-1, 0], [0, -1]]) addLine(canvasContext, [[centreX + 7 * dx, centreY + 7 * dy], [centreX + 12 * dx, centreY + 12 * dy]]);
      if (heading !== null) addLine(canvasContext, pictureView.headingLineFrom({ x, y, theta: heading }, 24));
    });
  }
}
