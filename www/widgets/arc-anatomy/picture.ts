/** Arc Anatomy's picture: the commanded arc, the arc that leads to the robot, and their construction. */

import { words } from '../../messages/registry.ts';
import { clipToPlot, drawAxes } from '../../scene/axes.ts';
import { addLine, drawDisc, fillPath, paintWithOpacity, strokePath, strokeLine, type DrawContext, type LineStroke } from '../../scene/canvas.ts';
import { addTurnArc, drawOutlines, drawRobot, createLineLegend, createLineStyles, strokeLines, createDensityRamp } from '../../scene/draw.ts';
import { drawLabel } from '../../scene/labels.ts';
import { Memo, CachedImage } from '../../scene/cache.ts';
import { Picture } from '../../scene/picture.ts';
import { View, extentAround, widenExtent } from '../../scene/view.ts';
import { clamp, formatFixed } from '../../ui/format.ts';
import { drawDraggableRobot, drawRobotOutline } from '../shared/robot.ts';
import { CONTOUR_STYLES, LINE_STYLES, type LineName, type ViewModel } from './settings.ts';
import type { ArcAnatomy, ArcWithCircle, Pose, AnatomySurface } from '../../types.d.ts';

export type Scene = ViewModel & { simulation: ArcAnatomy, overlays: LineName[], line: number, underway: Float64Array | undefined };

/** Radius of the robots, m. */
export const ROBOT_RADIUS = 0.06;

/** Limits of an arc's radius, as a multiple of the path length and in metres. Up to the larger limit, the view includes the arc's centre. */
const MAX_RADIUS = { pathLengths: 3, metres: 1.5 };

/** Margin around the paths, m. */
const MARGIN_METRES = 0.15;

/** Maximum radius of the arcs that mark angles, CSS pixels. */
const MAX_ANGLE_MARK_RADIUS = 40;

/** Radius of the wedge that shows the last turn, CSS pixels. */
const WEDGE_RADIUS = 64;

/** Half the size of the cross at the centre of an arc, CSS pixels. */
const CROSS_HALF_SIZE = 4;

/** Length of the heading line at the commanded end, CSS pixels. */
const HEADING_LENGTH = 24;

/** Constructions in the picture that are highlighted with a line of Table 5.1. */
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

export class ArcPicture extends Picture<Scene> {
  name = 'plane';
  view: View = new View();
  #heatMapImage = new CachedImage();
  #surfaceMemo: Memo<AnatomySurface | null> = new Memo();

  fitView({ config: { start, next }, stats: { commanded, inverted, lastTurn }, paths, overlays }: Scene) {
    const points = [start.x, start.y, next.x, next.y, ...paths.commanded, ...paths.inverted, ...paths.driven];
    const { xMin, yMin, xMax, yMax } = extentAround(points, 2);
    const maxRadius = Math.max(MAX_RADIUS.metres, MAX_RADIUS.pathLengths * Math.hypot(xMax - xMin, yMax - yMin));
    for (const { center, radius } of [commanded, inverted]) if (center && Math.abs(radius) < maxRadius) points.push(...center);
    const extentWithMargin = widenExtent(extentAround(points, 2), MARGIN_METRES);
    // The view's own margin makes up for the scale that the wedge itself reduces.
    const wedgeRadius = WEDGE_RADIUS / this.view.fittingScaleOf(extentWithMargin);
    const wedgeHeadings = overlays.includes('wedge') ? [next.theta, next.theta - lastTurn] : [];
    this.view.fit(extentAround(wedgeHeadings.flatMap((theta) => [next.x + wedgeRadius * Math.cos(theta), next.y + wedgeRadius * Math.sin(theta)]), 2, extentWithMargin));
  }

  paint: Picture<Scene>['paint'] = (drawContext, scene) => {
    const { config: { start, next, printed }, stats, paths, overlays } = scene;
    const { palette } = drawContext;
    const isOverlayShown = (name: LineName) => overlays.includes(name);
    const styles = createLineStyles(drawContext, LINE_STYLES);
    drawAxes(drawContext, { x: 'x (m)', y: 'y (m)' }, legendEntriesOf(drawContext, scene));
    clipToPlot(drawContext, () => {
      this.#drawHeatMap(drawContext, scene);
      const { commanded, inverted, driven, lastTurn } = stats;
      if (isOverlayShown('commanded')) {
        drawArcConstruction(drawContext, start, commanded, { ...styles.commanded, side: -1, angle: `ωΔt = ${formatFixed(commanded.turn, 2)}`, radius: '' });
      }
      if (isOverlayShown('inverted')) {
        drawArcConstruction(drawContext, start, inverted, {
          ...styles.inverted,
          side: 1,
          angle: `ω̂Δt = ${formatFixed(inverted.turn, 2)}`,
          // The radius is positive if the centre is to the left. The radius has no sign in Table 5.1 as printed in the book.
          radius: `r* = ${inverted.radius > 0 && !printed ? '+' : ''}${formatFixed(printed ? Math.abs(inverted.radius) : inverted.radius, 2)} m`,
        });
      }
      if (isOverlayShown('chord')) strokeLines(drawContext, [{ points: Float64Array.of(start.x, start.y, next.x, next.y), ...styles.chord }]);
      if (isOverlayShown('wedge')) drawWedge(drawContext, next, lastTurn, styles.wedge.colour);
      // Displacements by the lateral velocity of the constant twist, as short lines across its path.
      if (isOverlayShown('twist')) strokePath(drawContext.context, { colour: styles.twist.colour, width: 1.25 }, () => {
        for (let i = 0; i < paths.ticks.length; i += 4) addLine(drawContext.context, drawContext.view.toPixels(paths.ticks.subarray(i, i + 4)));
      });
      const drivenPaths = { commanded: paths.commanded, twist: paths.lie, inverted: paths.driven };
      drawOutlines(drawContext, (['commanded', 'twist', 'inverted'] as const).filter(isOverlayShown).map((name) => ({ points: drivenPaths[name], ...styles[name] })));
      if (isOverlayShown('inverted') && driven.arcLength !== inverted.arcLength) {
        drawOutlines(drawContext, [{ points: paths.inverted, colour: styles.inverted.colour, width: 1, dash: [2, 3] }]);
      }
      drawTableLineConstruction(drawContext, scene);
      if (isOverlayShown('commanded')) {
        const [endX, endY, endTheta] = commanded.end;
        drawRobotOutline(drawContext, endX, endY, ROBOT_RADIUS, styles.commanded.colour);
        strokeLine(drawContext.context, drawContext.view.headingLineFrom({ x: endX, y: endY, theta: endTheta }, HEADING_LENGTH), { colour: styles.commanded.colour, width: 1.5 });
      }
      drawMovingRobots(drawContext, scene);
      drawDraggableRobot(drawContext, start, ROBOT_RADIUS, palette.truth);
      drawDraggableRobot(drawContext, next, ROBOT_RADIUS, palette.prediction);
      if (isOverlayShown('wedge')) drawWedgeLabel(drawContext, next, lastTurn, styles.wedge.colour);
    });
  };

  /** Draws the chosen heat map of the likelihood with its contours, if any. */
  #drawHeatMap(drawContext: DrawContext, { simulation, config }: Scene) {
    const { context, palette, view } = drawContext;
    const { xMin, yMin, xMax, yMax } = view.extent;
    // The configuration is a new object after every change.
    const surface = this.#surfaceMemo.get([config, xMin, yMin, xMax, yMax], () => simulation.surface(xMin, yMin, xMax, yMax));
    if (!surface) return;
    this.#heatMapImage.draw(drawContext, [surface, palette], () => {
      const rampColours = new Uint32Array(createDensityRamp(palette).buffer);
      // The lowest shade is transparent.
      rampColours[0] = 0;
      return { pixels: new Uint8ClampedArray(Uint32Array.from(surface.shades, (shade) => rampColours[shade]).buffer), columns: surface.columns };
    });
    for (const name of ['prob', 'density'] as const) {
      const { role, ...style } = CONTOUR_STYLES[name];
      paintWithOpacity(context, 0.7, () => strokePath(context, { ...style, colour: palette[role] }, () => surface[name].forEach((tableLine) => addLine(context, view.toPixels(tableLine)))));
    }
  }
}

/** Returns the legend of an exported picture. The last turn has a label in the picture, and so no entry in the legend. */
function legendEntriesOf(drawContext: DrawContext, { overlays, config: { map } }: Scene) {
  const drawnNames = (['inverted', 'commanded', 'chord', 'twist'] as LineName[]).filter((name) => overlays.includes(name));
  return [
    ...createLineLegend(drawContext, LINE_STYLES, drawnNames, words.anatomy.overlays),
    ...createLineLegend(drawContext, CONTOUR_STYLES, map === 'none' ? [] : ['prob', 'density'], words.anatomy.maps),
  ];
}

/**
 * Draws the centre of an arc, both radii and the turn between them. `side` (±1) is the direction in which the first radius is shifted, so
 * that another radius on the same line stays visible.
 */
function drawArcConstruction(drawContext: DrawContext, start: Pose, { center, end, turn, arcLength }: ArcWithCircle, { colour, dash, side, angle, radius: signed }: { colour: string, dash: number[], side: number, angle: string, radius: string }) {
  if (!center) return;
  const { context, view } = drawContext;
  const [x, y] = view.toPixel(center[0], center[1]);
  const [fromX, fromY] = view.toPixel(start.x, start.y);
  const ahead = view.pixelDirectionOf(start.theta);
  const [offX, offY] = [1.5 * side * ahead.x, 1.5 * side * ahead.y];
  const visibleFractionOfRadius = visibleFractionOf(view.plotArea, [fromX, fromY], [x, y]);
  strokePath(context, { colour, width: 1.25, dash }, () => {
    addLine(context, [[fromX + offX, fromY + offY], [x + offX, y + offY]]);
    addLine(context, [[x, y], view.toPixel(end[0], end[1])]);
  });
  strokePath(context, { colour, width: 2 }, () => {
    addLine(context, [[x - CROSS_HALF_SIZE, y], [x + CROSS_HALF_SIZE, y]]);
    addLine(context, [[x, y - CROSS_HALF_SIZE], [x, y + CROSS_HALF_SIZE]]);
  });
  strokeAngleArc(context, [x, y], [fromX, fromY], turn, { colour, width: 1.5 });
  // Labels are behind the robot, away from the arc. If the arc's centre is outside the picture, labels are ahead of the robot, because the
  // picture may end behind it.
  const labelSide = Math.sign(arcLength) * (visibleFractionOfRadius === 1 ? -1 : 1);
  const drawArcLabel = (text: string, share: number) => {
    const labelPoint = [fromX + share * (x - fromX) + 10 * labelSide * ahead.x, fromY + share * (y - fromY) + 10 * labelSide * ahead.y];
    const towards = labelSide * ahead.x;
    drawLabel(drawContext, { x: labelPoint[0], y: labelPoint[1], freeSide: Math.abs(towards) < 0.3 ? 0 : Math.sign(towards), text, colour });
  };
  drawArcLabel(signed, visibleFractionOfRadius / 2);
  drawArcLabel(angle, visibleFractionOfRadius);
}

/** Returns the visible fraction of the line from a visible point to another point. */
function visibleFractionOf({ left, right, top, bottom }: import('../../scene/view.ts').View['plotArea'], [fromX, fromY]: [x: number, y: number], [x, y]: [x: number, y: number]) {
  const fractionAlongRange = (start: number, end: number, min: number, max: number) =>
    end >= min && end <= max ? 1 : (clamp(end, min, max) - start) / (end - start);
  return Math.min(fractionAlongRange(fromX, x, left, right), fractionAlongRange(fromY, y, top, bottom));
}

/** Draws a wedge for the last turn (rad), by which the final heading differs from the heading at the end of the arc. */
function drawWedge({ context, view }: DrawContext, next: Pose, turn: number, colour: string) {
  const [x, y] = view.toPixel(next.x, next.y);
  paintWithOpacity(context, 0.32, () => fillPath(context, colour, () => {
    context.moveTo(x, y);
    addTurnArc(context, [x, y], WEDGE_RADIUS, next.theta - turn, turn);
  }));
  // Edge of the wedge along the heading at the end of the arc.
  strokeLine(context, view.headingLineFrom({ ...next, theta: next.theta - turn }, WEDGE_RADIUS), { colour, width: 1.25 });
}

/** Draws the label of the wedge where it does not cover the wedge. */
function drawWedgeLabel(drawContext: DrawContext, next: Pose, turn: number, colour: string) {
  const [x, y] = drawContext.view.toPixel(next.x, next.y);
  const ahead = drawContext.view.pixelDirectionOf(next.theta - turn / 2);
  drawLabel(drawContext, { x: x + (WEDGE_RADIUS + 8) * ahead.x, y: y + (WEDGE_RADIUS + 20) * ahead.y, freeSide: ahead.x, text: `γ̂Δt = ${formatFixed(turn, 2)}`, colour });
}

/** Draws the robot at one time on each path that is shown. */
function drawMovingRobots(drawContext: DrawContext, { underway, overlays }: Scene) {
  if (!underway) return;
  for (const [i, name] of (['commanded', 'inverted', 'twist'] as const).entries()) {
    if (!overlays.includes(name)) continue;
    const [x, y, theta] = underway.subarray(3 * i);
    drawRobot(drawContext, { x, y, heading: theta, colour: drawContext.palette[LINE_STYLES[name].role] });
  }
}

/** Draws the construction of the highlighted line of Table 5.1. */
function drawTableLineConstruction(drawContext: DrawContext, { config: { start, next }, stats: { inverted, lastTurn }, table: { middle }, paths, line: lineNumber }: Scene) {
  const highlightedConstructions = CONSTRUCTIONS_BY_LINE[lineNumber] ?? [];
  const { context, view, palette: { accent } } = drawContext;
  const toPixel = ([x, y]: number[]) => view.toPixel(x, y);
  const drawAccentLine = (width: number, ...points: number[][]) => strokeLine(context, points, { colour: accent, width });
  const startPixel = toPixel([start.x, start.y]);
  const endPixel = toPixel([next.x, next.y]);
  if (highlightedConstructions.includes('arc')) drawOutlines(drawContext, [{ points: paths.driven, colour: accent, width: 5, dash: [] }]);
  if (highlightedConstructions.includes('wedge')) drawWedge(drawContext, next, lastTurn, accent);
  if (!inverted.center) return;
  const centrePixel = toPixel(inverted.center);
  if (highlightedConstructions.includes('bisector')) {
    strokeLine(context, [toPixel(middle), centrePixel], { colour: accent, width: 2.5, dash: [6, 4] });
    drawAccentLine(2.5, startPixel, centrePixel);
    drawAccentLine(2.5, startPixel, endPixel);
  }
  if (highlightedConstructions.includes('radius')) drawAccentLine(3, startPixel, centrePixel, endPixel);
  if (highlightedConstructions.includes('centre')) drawDisc(context, centrePixel, 8, undefined, { colour: accent, width: 3 });
  if (highlightedConstructions.includes('angle')) strokeAngleArc(context, centrePixel, startPixel, inverted.turn, { colour: accent, width: 4 });
}

/** Strokes an arc about a centre that marks a turn in radians from the direction of a point; both in pixels. */
function strokeAngleArc(context: DrawContext['context'], [x, y]: number[], [fromX, fromY]: number[], turn: number, style: LineStroke) {
  const radius = Math.min(MAX_ANGLE_MARK_RADIUS, 0.4 * Math.hypot(fromX - x, fromY - y));
  strokePath(context, style, () => addTurnArc(context, [x, y], radius, Math.atan2(y - fromY, fromX - x), turn));
}
