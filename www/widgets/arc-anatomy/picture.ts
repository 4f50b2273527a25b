/** Arc Anatomy's picture: the commanded arc, the arc that leads to the robot, and their construction. */

import { words } from '../../messages/registry.ts';
import { clipToPlot, drawAxes } from '../../scene/axes.ts';
import { addLine, drawDisc, fillPath, paintWithOpacity, strokePath, strokeLine, type DrawContext, type LineStroke } from '../../scene/canvas.ts';
import { addTurnArc, drawOutlines, drawRobot, createLineLegend, createLineStyles, strokeLines, styleOutlines, createDensityRamp } from '../../scene/draw.ts';
import { drawCallouts, type Callout } from '../../scene/labels.ts';
import { MemoizedResult, CachedImage } from '../../scene/cache.ts';
import { FigurePicture } from '../../scene/picture.ts';
import { PictureView, extentAround, widenExtent } from '../../scene/view.ts';
import { clampNumber, formatFixed } from '../../ui/format.ts';
import { drawDraggableRobot, drawRobotOutline } from '../shared/robot.ts';
import { CONTOUR_STYLES, LINE_STYLES, UNDERWAY_AT_END, type LineName, type ViewModel } from './settings.ts';
import type { ArcAnatomy, ArcWithCircle, Pose, AnatomySurface } from '../../types.d.ts';

type ArcScene = ViewModel & { simulation: ArcAnatomy, overlays: LineName[], line: number, underway: number };

/** Radius of the robots, m. */
export const ROBOT_RADIUS = 0.06;

/** Maximum radius of an arc whose centre the view has to include: a multiple of the path length, or if larger, a length in metres. */
const MAX_CENTRE_RADIUS = { pathLengths: 3, metres: 1.5 };

/** Margin around the paths, m. */
const MARGIN_METRES = 0.15;

/** Maximum radius (CSS pixels) of the arc that marks an angle. */
const MAX_ANGLE_MARK_RADIUS = 40;

/** Radius of the wedge that shows the last turn, CSS pixels. */
const WEDGE_RADIUS = 64;

/** Half the size of the cross at the centre of an arc, CSS pixels. */
const CROSS_HALF_SIZE = 4;

/** Length of the line that shows the heading at the end of the command, CSS pixels. */
const HEADING_LINE_LENGTH = 24;

/** Constructions in the picture (bisector, centre, radius, angle) that the selected line of Table 5.1 highlights. */
const CONSTRUCTIONS_BY_LINE: Record<number, string[]> = {
  1: ['bisector'],
  2: ['bisector', 'centre'],
  3: ['bisector', 'centre'],
  4: ['centre', 'radius'],
  5: ['angle', 'radius'],
  6: ['arc'],
  7: ['angle'],
  8: ['wedge'],
};

export class ArcPicture extends FigurePicture<ArcScene> {
  pictureName = 'plane';
  pictureView: PictureView = new PictureView();
  #heatMapImage = new CachedImage();
  #surfaceMemo: MemoizedResult<AnatomySurface | null> = new MemoizedResult();

  fitView({ config: { start, next }, stats: { commanded, inverted, lastTurn }, paths, overlays }: ArcScene) {
    const shownCoordinates = [start.x, start.y, next.x, next.y, ...paths.commanded, ...paths.inverted, ...paths.driven];
    const { xMin, yMin, xMax, yMax } = extentAround(shownCoordinates, 2);
    const maxRadius = Math.max(MAX_CENTRE_RADIUS.metres, MAX_CENTRE_RADIUS.pathLengths * Math.hypot(xMax - xMin, yMax - yMin));
    for (const { center, radius } of [commanded, inverted]) if (center && Math.abs(radius) < maxRadius) shownCoordinates.push(...center);
    const extentWithMargin = widenExtent(extentAround(shownCoordinates, 2), MARGIN_METRES);
    const wedgeRadius = this.pictureView.markLengthOf(extentWithMargin, WEDGE_RADIUS);
    const wedgeHeadings = overlays.includes('wedge') ? [next.theta, next.theta - lastTurn] : [];
    this.pictureView.fitExtent(extentAround(wedgeHeadings.flatMap((theta) => [next.x + wedgeRadius * Math.cos(theta), next.y + wedgeRadius * Math.sin(theta)]), 2, extentWithMargin));
  }

  paintPicture: FigurePicture<ArcScene>['paintPicture'] = (drawContext, scene) => {
    const { config: { start, next, printed, map }, stats, paths, overlays } = scene;
    const { palette } = drawContext;
    const lineStyles = createLineStyles(drawContext, LINE_STYLES, overlays);
    const contourStyles = createLineStyles(drawContext, CONTOUR_STYLES, map === 'none' ? [] : Object.keys(CONTOUR_STYLES));
    drawAxes(drawContext, { x: 'x (m)', y: 'y (m)' }, [
      // The last turn is labelled in the picture, and therefore not listed in the legend.
      ...createLineLegend(drawContext, lineStyles, ['inverted', 'commanded', 'chord', 'twist'], words.anatomy.overlays),
      ...createLineLegend(drawContext, contourStyles, ['prob', 'density'], words.anatomy.mapNames),
    ]);
    const callouts: Callout[] = [];
    clipToPlot(drawContext, () => {
      this.#drawHeatMap(drawContext, scene);
      const { commanded, inverted, driven, lastTurn } = stats;
      if (lineStyles.commanded) {
        drawArcConstruction(drawContext, start, commanded, { ...lineStyles.commanded, shiftSide: -1 });
        callouts.push(...arcCalloutsOf(drawContext, start, commanded, lineStyles.commanded.colour, `ωΔt = ${formatFixed(commanded.turn, 2)}`));
      }
      if (lineStyles.inverted) {
        drawArcConstruction(drawContext, start, inverted, { ...lineStyles.inverted, shiftSide: 1 });
        // The radius is positive if the centre is to the left. The radius has no sign in Table 5.1 as printed in the book.
        const radiusLabel = `r* = ${inverted.radius > 0 && !printed ? '+' : ''}${formatFixed(printed ? Math.abs(inverted.radius) : inverted.radius, 2)} m`;
        callouts.push(...arcCalloutsOf(drawContext, start, inverted, lineStyles.inverted.colour, `ω̂Δt = ${formatFixed(inverted.turn, 2)}`, radiusLabel));
      }
      if (lineStyles.chord) strokeLines(drawContext, [{ points: Float64Array.of(start.x, start.y, next.x, next.y), ...lineStyles.chord }]);
      if (lineStyles.wedge) drawWedge(drawContext, next, lastTurn, lineStyles.wedge.colour);
      // Short lines across the path of the constant twist show its displacements in the lateral direction.
      if (lineStyles.twist) strokePath(drawContext.canvasContext, { colour: lineStyles.twist.colour, width: 1.25 }, () => {
        for (let i = 0; i < paths.ticks.length; i += 4) addLine(drawContext.canvasContext, drawContext.pictureView.toPixels(paths.ticks.subarray(i, i + 4)));
      });
      const drivenPaths = { commanded: paths.commanded, twist: paths.lie, inverted: paths.driven };
      drawOutlines(drawContext, styleOutlines(lineStyles, drivenPaths));
      if (lineStyles.inverted && driven.arcLength !== inverted.arcLength) {
        drawOutlines(drawContext, [{ points: paths.inverted, colour: lineStyles.inverted.colour, width: 1, dash: [2, 3] }]);
      }
      drawTableLineConstruction(drawContext, scene);
      if (lineStyles.commanded) {
        const [endX, endY, endTheta] = commanded.end;
        drawRobotOutline(drawContext, endX, endY, ROBOT_RADIUS, lineStyles.commanded.colour);
        strokeLine(drawContext.canvasContext, drawContext.pictureView.headingLineFrom({ x: endX, y: endY, theta: endTheta }, HEADING_LINE_LENGTH), { colour: lineStyles.commanded.colour, width: 1.5 });
      }
      drawMovingRobots(drawContext, scene);
      drawDraggableRobot(drawContext, start, ROBOT_RADIUS, palette.truth);
      drawDraggableRobot(drawContext, next, ROBOT_RADIUS, palette.prediction);
      if (lineStyles.wedge) callouts.push(wedgeCalloutOf(drawContext, next, lastTurn, lineStyles.wedge.colour));
    });
    const radiusLines = [stats.commanded, stats.inverted].flatMap(({ center, end }) => (center ? [Float64Array.of(start.x, start.y, ...center, end[0], end[1])] : []));
    drawCallouts(drawContext, callouts, { shapeCentre: [(start.x + next.x) / 2, (start.y + next.y) / 2], avoidedLines: [paths.commanded, paths.driven, ...radiusLines] });
  };

  /** Draws the chosen heat map of the likelihood with its contours, if any. */
  #drawHeatMap(drawContext: DrawContext, { simulation, config }: ArcScene) {
    const { canvasContext, palette, pictureView } = drawContext;
    const { xMin, yMin, xMax, yMax } = pictureView.shownExtent;
    // `config` is a new object after every change of settings. The cached heat map is used until `config` or the view changes.
    const likelihoodSurface = this.#surfaceMemo.getResult([config, xMin, yMin, xMax, yMax], () => simulation.surface([xMin, yMin, xMax, yMax]));
    if (!likelihoodSurface) return;
    this.#heatMapImage.drawImage(drawContext, [likelihoodSurface, palette], () => {
      const rampColours = new Uint32Array(createDensityRamp(palette).buffer);
      // The lowest colour of the heat map is transparent, so that the axes remain visible.
      rampColours[0] = 0;
      return { rgbaPixels: new Uint8ClampedArray(Uint32Array.from(likelihoodSurface.shades, (shade) => rampColours[shade]).buffer), columnCount: likelihoodSurface.columns };
    });
    for (const name of ['prob', 'density'] as const) {
      const { colourRole, ...style } = CONTOUR_STYLES[name];
      paintWithOpacity(canvasContext, 0.7, () => strokePath(canvasContext, { ...style, colour: palette[colourRole] }, () => likelihoodSurface[name].forEach((contourLine) => addLine(canvasContext, pictureView.toPixels(contourLine)))));
    }
  }
}

/**
 * Draws the centre of an arc, the radii to both of its ends, and the turn between the radii. The first radius is shifted slightly in the direction
 * `shiftSide` (±1), so that it does not hide another radius.
 */
function drawArcConstruction(drawContext: DrawContext, start: Pose, { center, end, turn }: ArcWithCircle, { colour: lineColour, dash, shiftSide }: LineStroke & { shiftSide: number }) {
  if (!center) return;
  const { canvasContext, pictureView } = drawContext;
  const [x, y] = pictureView.toPixel(center[0], center[1]);
  const [startX, startY] = pictureView.toPixel(start.x, start.y);
  const startDirection = pictureView.pixelDirectionOf(start.theta);
  const [shiftX, shiftY] = [1.5 * shiftSide * startDirection.x, 1.5 * shiftSide * startDirection.y];
  strokePath(canvasContext, { colour: lineColour, width: 1.25, dash }, () => {
    addLine(canvasContext, [[startX + shiftX, startY + shiftY], [x + shiftX, y + shiftY]]);
    addLine(canvasContext, [[x, y], pictureView.toPixel(end[0], end[1])]);
  });
  strokePath(canvasContext, { colour: lineColour, width: 2 }, () => {
    addLine(canvasContext, [[x - CROSS_HALF_SIZE, y], [x + CROSS_HALF_SIZE, y]]);
    addLine(canvasContext, [[x, y - CROSS_HALF_SIZE], [x, y + CROSS_HALF_SIZE]]);
  });
  strokeAngleArc(canvasContext, [x, y], [startX, startY], turn, { colour: lineColour, width: 1.5 });
}

/** Returns callouts for the turn, at the centre of an arc, and for its radius. If the centre is outside the picture, both callouts are at the visible part of the radius. */
function arcCalloutsOf({ pictureView }: DrawContext, start: Pose, { center }: ArcWithCircle, lineColour: string, angleLabel: string, radiusLabel?: string): Callout[] {
  if (!center) return [];
  const visibleFraction = visibleFractionOf(pictureView.plotArea, pictureView.toPixel(start.x, start.y), pictureView.toPixel(center[0], center[1]));
  const radiusPointAt = (radiusFraction: number): [number, number] => [start.x + radiusFraction * (center[0] - start.x), start.y + radiusFraction * (center[1] - start.y)];
  return [{ text: angleLabel, point: radiusPointAt(visibleFraction), colour: lineColour }, ...(radiusLabel ? [{ text: radiusLabel, point: radiusPointAt(visibleFraction / 2), colour: lineColour }] : [])];
}

/** Returns the visible fraction of a line. The first point of the line is visible. */
function visibleFractionOf({ leftEdge, rightEdge, topEdge, bottomEdge }: import('../../scene/view.ts').PictureView['plotArea'], [startX, startY]: [x: number, y: number], [x, y]: [x: number, y: number]) {
  const visibleFractionOfRange = (start: number, end: number, min: number, max: number) =>
    end >= min && end <= max ? 1 : (clampNumber(end, min, max) - start) / (end - start);
  return Math.min(visibleFractionOfRange(startX, x, leftEdge, rightEdge), visibleFractionOfRange(startY, y, topEdge, bottomEdge));
}

/** Draws a wedge for the last turn (rad), by which the final heading differs from the heading at the end of the arc. */
function drawWedge({ canvasContext, pictureView }: DrawContext, finalPose: Pose, lastTurn: number, wedgeColour: string) {
  const [x, y] = pictureView.toPixel(finalPose.x, finalPose.y);
  paintWithOpacity(canvasContext, 0.32, () => fillPath(canvasContext, wedgeColour, () => {
    canvasContext.moveTo(x, y);
    addTurnArc(canvasContext, [x, y], WEDGE_RADIUS, finalPose.theta - lastTurn, lastTurn);
  }));
  // This edge of the wedge shows the heading at the end of the arc, before the last turn.
  strokeLine(canvasContext, pictureView.headingLineFrom({ ...finalPose, theta: finalPose.theta - lastTurn }, WEDGE_RADIUS), { colour: wedgeColour, width: 1.25 });
}

function wedgeCalloutOf({ pictureView }: DrawContext, finalPose: Pose, lastTurn: number, lineColour: string): Callout {
  const [, wedgeEdgeMiddle] = pictureView.headingLineFrom({ ...finalPose, theta: finalPose.theta - lastTurn / 2 }, WEDGE_RADIUS);
  return { text: `γ̂Δt = ${formatFixed(lastTurn, 2)}`, point: pictureView.toWorld(...wedgeEdgeMiddle), colour: lineColour };
}

/** Draws a robot on each visible path. All robots have driven for the same time. */
function drawMovingRobots(drawContext: DrawContext, { simulation, underway, overlays }: ArcScene) {
  if (underway === UNDERWAY_AT_END) return;
  const robotPoses = simulation.underway(underway / UNDERWAY_AT_END);
  for (const [i, name] of (['commanded', 'inverted', 'twist'] as const).entries()) {
    if (!overlays.includes(name)) continue;
    const [x, y, theta] = robotPoses.subarray(3 * i);
    drawRobot(drawContext, { x, y, heading: theta, colour: drawContext.palette[LINE_STYLES[name].colourRole] });
  }
}

/** Draws the construction of the highlighted line of Table 5.1. */
function drawTableLineConstruction(drawContext: DrawContext, { config: { start, next }, stats: { inverted, lastTurn }, table: { middle }, paths, line }: ArcScene) {
  const highlightedConstructions = CONSTRUCTIONS_BY_LINE[line] ?? [];
  const { canvasContext, pictureView, palette: { accent } } = drawContext;
  const toPixel = ([x, y]: number[]) => pictureView.toPixel(x, y);
  const drawAccentLine = (width: number, ...points: number[][]) => strokeLine(canvasContext, points, { colour: accent, width });
  const startPixel = toPixel([start.x, start.y]);
  const endPixel = toPixel([next.x, next.y]);
  if (highlightedConstructions.includes('arc')) drawOutlines(drawContext, [{ points: paths.driven, colour: accent, width: 5, dash: [] }]);
  if (highlightedConstructions.includes('wedge')) drawWedge(drawContext, next, lastTurn, accent);
  if (!inverted.center) return;
  const centrePixel = toPixel(inverted.center);
  if (highlightedConstructions.includes('bisector')) {
    strokeLine(canvasContext, [toPixel(middle), centrePixel], { colour: accent, width: 2.5, dash: [6, 4] });
    drawAccentLine(2.5, startPixel, centrePixel);
    drawAccentLine(2.5, startPixel, endPixel);
  }
  if (highlightedConstructions.includes('radius')) drawAccentLine(3, startPixel, centrePixel, endPixel);
  if (highlightedConstructions.includes('centre')) drawDisc(canvasContext, centrePixel, 8, undefined, { colour: accent, width: 3 });
  if (highlightedConstructions.includes('angle')) strokeAngleArc(canvasContext, centrePixel, startPixel, inverted.turn, { colour: accent, width: 4 });
}

/** Strokes an arc that marks an angle. The arc starts in the direction from its centre to another point, and spans `turn` radians. Points are in pixels. */
function strokeAngleArc(canvasContext: DrawContext['canvasContext'], [x, y]: number[], [startX, startY]: number[], turn: number, style: LineStroke) {
  const radius = Math.min(MAX_ANGLE_MARK_RADIUS, 0.4 * Math.hypot(startX - x, startY - y));
  strokePath(canvasContext, style, () => addTurnArc(canvasContext, [x, y], radius, Math.atan2(y - startY, startX - x), turn));
}
