/** The Banana Machine's two pictures of the same robots: the floor from above, and exponential coordinates. */

import { quantile } from 'd3-array';
import { words } from '../../messages/registry.ts';
import { clipToPlot, drawAxes } from '../../scene/axes.ts';
import { drawCallouts, type Callout } from '../../scene/labels.ts';
import { addTurnArc, createDensityRamp, drawDots, drawEarlierOutlines, drawHandle, drawCrosshair, drawOutline, drawOutlines, drawRobot, hasLength, createLineLegend, createLineStyles, styleOutlines } from '../../scene/draw.ts';
import { MemoizedResult, CachedImage } from '../../scene/cache.ts';
import { FigurePicture, SELECTION_RADIUS } from '../../scene/picture.ts';
import { VIEWED_DEVIATIONS, cornersAround, extentOf } from '../../scene/view.ts';
import { formatInteger } from '../../ui/format.ts';
import { drawMorphGrid, MorphView, morphPoint, type Outlines } from './morph.ts';
import { stdOfVariance, type ViewModel, LINE_STYLES, type LineName } from './settings.ts';
import type { BananaMachine, Moments } from '../../types.d.ts';
import { addLine, drawDisc, paintWithOpacity, strokeLine, strokePath, type DrawContext } from '../../scene/canvas.ts';

/** Data that the two pictures show: results of the simulation and display settings. */
export type Scene = import('./banana-machine.ts').BananaMachineElement['scene'];

/** Maximum number of robots drawn as dots. A larger cloud is drawn as a density, because dots would overlap, and take longer than a frame. */
const MAX_DOT_COUNT = 1000;

/** Maximum number of rays in a fan of headings. More rays would look the same. */
const MAX_HEADING_RAYS = 400;

/** Standard deviation (pixels) below which a cloud is drawn as one point. */
const MIN_CLOUD_DEVIATION = 0.6;

/** Radius of the ring at the end of the arc, pixels. */
const HANDLE_RADIUS = 7.5;

/** Order in which outlines are painted, and order in which the legend lists them. */
const PAINT_ORDER = ['additive', 'linearized', 'ellipse', 'exponential', 'command'] as const satisfies LineName[];
const LEGEND_ORDER = ['ellipse', 'exponential', 'linearized', 'additive', 'command'] as const satisfies LineName[];

/** Picture of the robots at a stage of the morph, from the floor (0) to exponential coordinates (1). */
class MorphPicture extends FigurePicture<Scene, 'plane' | 'twist'> {
  pictureView: MorphView = new MorphView({ leftMargin: 46, rightMargin: 10 });
  /** Names of the outlines that the picture may draw. */
  outlineNames: readonly LineName[] = PAINT_ORDER;
  #densityImage = new CachedImage();
  #dotPositionsMemo: MemoizedResult<Float64Array> = new MemoizedResult();

  /** Returns the index of the robot nearest to a point (CSS pixels); −1 if no robot is near enough. */
  findNearestSample(simulation: BananaMachine, x: number, y: number) {
    const { pictureView } = this;
    return simulation.nearest(pictureView.morph, ...pictureView.toWorld(x, y), SELECTION_RADIUS / pictureView.scaleX, SELECTION_RADIUS / pictureView.scaleY);
  }

  /** Returns the outlines at the stage of the morph that the picture shows. */
  outlinesOf(viewModel: ViewModel, scene: Scene): Outlines {
    return scene.outlinesOf(viewModel, this.pictureView.morph);
  }

  /** Returns the poses of the robots that are drawn as dots. Towards exponential coordinates, the morph scales their headings down to 0. */
  #dotPositionsOf({ simulation, stats }: Scene): Float64Array {
    const { morph } = this.pictureView;
    return this.#dotPositionsMemo.getResult([stats, morph], () => (morph === 0 ? simulation.firstPoses(MAX_DOT_COUNT) : morphPoses(simulation.firstTwists(MAX_DOT_COUNT), morph)));
  }

  paintPicture: FigurePicture<Scene>['paintPicture'] = (drawContext, scene) => {
    const { canvasContext, pictureView, palette } = drawContext;
    const { simulation, overlays, markedMotion, pinned } = scene;
    const { morph, endViews: [floorView, twistView] } = this.pictureView;
    const isFloorPicture = this.pictureName === 'plane';
    const outlines = this.outlinesOf(scene, scene);
    const lineStyles = createLineStyles(drawContext, LINE_STYLES, overlays);
    const legendNames = LEGEND_ORDER.filter((name) => this.outlineNames.includes(name) && hasLength(outlines[name]));
    const legendEntries = createLineLegend(drawContext, lineStyles, legendNames, words.banana.overlays);
    // The axes of the floor fade out before the axes of exponential coordinates fade in.
    const axesOfEndViews = [
      { view: floorView, opacity: 1 - 2 * morph, axisLabels: { x: 'x (m)', y: 'y (m)' } },
      { view: twistView, opacity: 2 * morph - 1, axisLabels: { x: words.banana.alongAxisLabel, y: words.banana.headingAxisLabel } },
    ];
    for (const { view: axesView, opacity, axisLabels } of axesOfEndViews) {
      // Before the last stage of the morph, the grid of exponential coordinates is curved, and `drawMorphGrid` draws it.
      const gridOpacity = axesView === twistView && morph < 1 ? 0 : undefined;
      if (opacity > 0) paintWithOpacity(canvasContext, Math.min(1, opacity), () => drawAxes({ ...drawContext, pictureView: axesView }, axisLabels, legendEntries, gridOpacity));
    }
    const cloudMean = morphPoint(twistMomentsOf(scene)[0].mean, morph);
    const styledOutlinesOf = (outlinePoints: Outlines) => styleOutlines(lineStyles, Object.fromEntries(this.outlineNames.map((name) => [name, outlinePoints[name]])));
    // For comparison, the picture also has the outlines of the pinned settings, or of the settings before the current drag.
    const earlierViewModel: ViewModel | undefined = pinned ?? drawContext.previousViewModel;
    const earlierOutlines = earlierViewModel ? styledOutlinesOf(this.outlinesOf(earlierViewModel, scene)) : [];
    const callouts = isFloorPicture ? [...scene.callouts] : [];
    clipToPlot(drawContext, () => {
      if (morph > 0 && morph < 1) drawMorphGrid(drawContext, twistView, morph);
      if (scene.drivingProgress) {
        if (isFloorPicture) drawDrivingRobots(drawContext, simulation, scene.drivingProgress);
        return;
      }
      const isSinglePoint = this.#isSinglePoint(scene);
      if (!isSinglePoint) this.#paintCloud(drawContext, scene);
      if (isFloorPicture) drawRobot(drawContext, { x: 0, y: 0, heading: 0, colour: palette.truth });
      callouts.push(...drawEarlierOutlines(drawContext, earlierOutlines, isFloorPicture ? [cloudMean, [0, 0]] : [cloudMean], pinned ? words.banana.pinnedLabel : words.earlierOutlinesLabel));
      drawOutlines(drawContext, styledOutlinesOf(outlines));
      const [endX, endY] = outlines.command.slice(-2);
      if (isFloorPicture) {
        if (lineStyles.command && scene.odometryReading && morph === 0) callouts.push(...drawOdometryReading(drawContext, scene.odometryReading, scene.arcEnd));
        if (isSinglePoint && scene.shown > 0) callouts.push(drawCoincidentRobots(drawContext, this.#dotPositionsOf(scene), scene.shown));
        drawHandle(drawContext, { x: pictureView.toPixelX(endX), y: pictureView.toPixelY(endY), radius: HANDLE_RADIUS, colour: palette.prior });
      } else if (lineStyles.command) {
        drawDisc(canvasContext, pictureView.toPixel(endX, endY), 5, palette.paper, { ...lineStyles.command, dash: [] });
      }
      if (markedMotion) {
        if (morph === 0) drawOutline(drawContext, markedMotion.path, { colour: palette.accent, width: 1.25, dash: [6, 2] });
        const [x, y] = morphPoint(markedMotion.twist, morph);
        drawCrosshair(drawContext, { x, y, heading: morph < 1 ? (1 - morph) * markedMotion.pose[2] : null });
      }
    });
    const calloutLines = isFloorPicture ? [outlines.command, outlines.ellipse, outlines.exponential] : [outlines.exponential];
    drawCallouts(drawContext, callouts, { shapeCentre: cloudMean, avoidedLines: [...calloutLines, ...earlierOutlines.map(({ points }) => points)] });
  };

  /** Returns true if all robots are so close together on the floor that they are drawn as one point. */
  #isSinglePoint({ table: { exact: { cov } } }: Scene) {
    return this.pictureView.morph === 0 && stdOfVariance(cov[0][0] + cov[1][1]) * this.pictureView.scaleX < MIN_CLOUD_DEVIATION;
  }

  /** Draws the robots as dots or, if there are many, as a density. */
  #paintCloud(drawContext: DrawContext, scene: Scene) {
    const { pictureView: { morph, scaleX, scaleY } } = this;
    const { simulation, shown, stats, table: { exact: { cov } } } = scene;
    if (shown <= MAX_DOT_COUNT) {
      // The lines that show the robots' headings shrink during the morph, because exponential coordinates show the turn as an axis.
      drawDots(drawContext, this.#dotPositionsOf(scene), 1 - morph);
      return;
    }
    // Products of the cloud's two standard deviations, on the floor and in exponential coordinates. They are proportional to the cloud's area.
    const floorStdProduct = Math.sqrt(Math.max(0, cov[0][0] * cov[1][1] - cov[0][1] * cov[1][0]));
    const [{ cov: twistCov }] = twistMomentsOf(scene);
    const twistStdProduct = stdOfVariance(twistCov[0][0]) * stdOfVariance(twistCov[2][2]);
    const cloudArea = 4 * Math.PI * ((1 - morph) * floorStdProduct + morph * twistStdProduct) * scaleX * scaleY;
    // The cell size of the density (CSS pixels) is small if there are many robots per area.
    const cellSize = Math.min(7, Math.max(2, Math.round(Math.sqrt((3 * cloudArea) / shown))));
    this.#densityImage.drawDensity(drawContext, cellSize, [stats, morph, drawContext.palette], (...viewPart) => simulation.picture(morph, ...viewPart, createDensityRamp(drawContext.palette)));
  }
}

/** Returns x, y and heading of each robot at a stage of the morph. The heading shrinks to 0 towards exponential coordinates. */
function morphPoses(twists: Float64Array, morph: number) {
  const poses = new Float64Array(twists.length);
  for (let i = 0; i < twists.length; i += 3) {
    poses.set([...morphPoint(twists.subarray(i, i + 3), morph), (1 - morph) * twists[i + 2]], i);
  }
  return poses;
}

/** Picture of the floor from above, which the user morphs to exponential coordinates. */
export class PlanePicture extends MorphPicture {
  pictureName = 'plane' as const;

  drawPicture(...[surface, scene, ...drawOptions]: Parameters<FigurePicture<Scene>['drawPicture']>) {
    this.pictureView.morph = scene.morph;
    return super.drawPicture(surface, scene, ...drawOptions);
  }

  fitView(scene: Scene) {
    const { contours, table, arcEnd: [x, y], overlays, pinnedPointsAt } = scene;
    const { mean, cov } = table.exact;
    const [xExtent, yExtent] = [VIEWED_DEVIATIONS * stdOfVariance(cov[0][0]), VIEWED_DEVIATIONS * stdOfVariance(cov[1][1])];
    const shownCoordinates = [...cornersAround(mean[0], mean[1], xExtent, yExtent), ...contours.command, ...pinnedPointsAt(0)];
    // The view includes the additive outline only if it is shown, because it may be much larger than the cloud.
    if (overlays.includes('additive')) shownCoordinates.push(...contours.additive);
    const floorExtent = extentOf(shownCoordinates, 0.4);
    // Adds space around the end of the arc for a fan of headings. If all robots stop at the same point, only this fan is visible.
    const fanMargin = 0.2 * (floorExtent.xMax - floorExtent.xMin);
    this.pictureView.fitEnd(extentOf([...shownCoordinates, ...cornersAround(x, y, fanMargin)], 0.4), 0);
    if (scene.morph === 0) return;
    this.pictureView.fitEnd(extentOf([...twistCoordinatesToShowOf(scene), ...(overlays.includes('ellipse') ? scene.outlinesOf(scene, 1).ellipse : []), ...pinnedPointsAt(1)], 0.1), 1);
  }
}

/** Picture of the same robots in exponential coordinates, with the outline of the Gaussian in these coordinates. */
export class TwistPicture extends MorphPicture {
  pictureName = 'twist' as const;
  outlineNames = ['exponential'] as const;

  constructor() {
    super();
    this.pictureView.morph = 1;
  }

  /** Returns the outline of the Gaussian in exponential coordinates, and the command as a point. This picture has no floor outlines that would have to be transformed. */
  outlinesOf({ contours, config: { command: { v, omega, dt } } }: ViewModel): Outlines {
    return { ...contours, command: Float64Array.of(v * dt, omega * dt), exponential: contours.twistEllipse };
  }

  fitView(scene: Scene) {
    this.pictureView.fitEnd(extentOf([...twistCoordinatesToShowOf(scene), ...(scene.pinned?.contours.twistEllipse ?? [])], 0.1), 1);
  }
}

function drawDrivingRobots(drawContext: DrawContext, simulation: BananaMachine, { robotCount, pathFraction }: { robotCount: number, pathFraction: number }) {
  const { palette } = drawContext;
  for (let i = 0; i < robotCount; i++) {
    const { path, pose } = simulation.inspect(i);
    // If several robots drive, the first robot has already arrived, and is drawn at its end.
    const chordCount = path.length / 2 - 1;
    const chordPosition = (i === 0 && robotCount > 1 ? 1 : pathFraction) * chordCount;
    const chordIndex = Math.min(Math.floor(chordPosition), chordCount - 1);
    const [x, y, nextX, nextY] = path.subarray(2 * chordIndex, 2 * chordIndex + 4);
    const [endX, endY] = [x + (chordPosition - chordIndex) * (nextX - x), y + (chordPosition - chordIndex) * (nextY - y)];
    drawOutline(drawContext, Float64Array.of(...path.subarray(0, 2 * chordIndex + 2), endX, endY), { colour: palette.cloud, width: 1.5, dash: [] });
    const heading = chordPosition === chordCount ? pose[2] : Math.atan2(nextY - y, nextX - x);
    drawRobot(drawContext, { x: endX, y: endY, heading, colour: palette.cloud });
  }
}

/** Radius of the arcs that show rotations, and length of the lines from which these rotations start, CSS pixels. */
const TURN_RADIUS = 26;
const TURN_LINE_LENGTH = 38;

/** Draws the odometry reading of the command: rotation, drive and rotation. The drive ends at x, y (m). Returns callouts that name the three motions. */
function drawOdometryReading(drawContext: DrawContext, { rot1, trans, rot2 }: import('../../types.d.ts').OdomDelta, [x, y]: [number, number]): Callout[] {
  const { canvasContext, pictureView, palette } = drawContext;
  const [startPose, drivenPose] = [{ x: 0, y: 0, theta: 0 }, { x, y, theta: rot1 }];
  const [startPixel, startHeadingEnd] = pictureView.headingLineFrom(startPose, TURN_LINE_LENGTH);
  const [endPixel, continuationEnd] = pictureView.headingLineFrom(drivenPose, TURN_LINE_LENGTH);
  const lineColour = palette.prior;
  const lineStroke = { colour: lineColour, width: 1.5 };
  strokePath(canvasContext, lineStroke, () => {
    // Three lines: the heading at the start, the drive, and the continuation of the drive, from which the second rotation starts.
    addLine(canvasContext, [startHeadingEnd, startPixel, endPixel, continuationEnd]);
    addLine(canvasContext, pictureView.headingLineFrom({ x, y, theta: rot1 + rot2 }, TURN_LINE_LENGTH));
  });
  const legTurns = [['rot1', startPose, rot1], ['rot2', drivenPose, rot2]] as const;
  for (const [, pose, turn] of legTurns) strokePath(canvasContext, lineStroke, () => addTurnArc(canvasContext, pictureView.toPixel(pose.x, pose.y), TURN_RADIUS, pose.theta, turn));
  const turnCallouts = legTurns.map(([legName, pose, turn]): Callout => {
    const [, arcMiddle] = pictureView.headingLineFrom({ ...pose, theta: pose.theta + turn / 2 }, TURN_RADIUS);
    return { symbol: 'δ', subscript: legName, point: pictureView.toWorld(...arcMiddle), colour: lineColour };
  });
  return [...turnCallouts, ...(trans > 0 ? [{ symbol: 'δ', subscript: 'trans', point: [x / 2, y / 2] as [number, number], colour: lineColour }] : [])];
}

/** Draws robots at the same position as one disc. Rays show the headings of the first robots. Returns a callout with the number of robots. */
function drawCoincidentRobots(drawContext: DrawContext, poses: Float64Array, shown: number): Callout {
  const { canvasContext, pictureView, palette: { prediction: robotColour } } = drawContext;
  const headings = [...poses.subarray(0, 3 * MAX_HEADING_RAYS)].filter((_, i) => i % 3 === 2);
  const [x, y] = poses;
  paintWithOpacity(canvasContext, Math.min(1, 30 / headings.length), () => {
    for (const theta of headings) strokeLine(canvasContext, pictureView.headingLineFrom({ x, y, theta }, 64), { colour: robotColour, width: 1 });
  });
  // The disc is larger than the handle at the end of the arc, which often hides its middle.
  const [pixelX, pixelY] = pictureView.toPixel(x, y);
  drawDisc(canvasContext, [pixelX, pixelY], 14, robotColour);
  return { text: words.banana.robotCountLabel(formatInteger(shown)), point: pictureView.toWorld(pixelX, pixelY - 14), colour: robotColour };
}

/**
 * Returns moments in exponential coordinates: those of the model and of the samples, as far as they are defined. If neither is defined, returns the
 * commanded twist as the mean, with the total variance of the position as the variance along the track.
 */
function twistMomentsOf({ config, stats, table }: Scene): Moments[] {
  const definedMoments = [table.tangent, stats.exponential].filter((moments) => moments !== null);
  const finiteMoments = definedMoments.filter(({ cov }) => Number.isFinite(cov[0][0]));
  if (finiteMoments.length > 0) return finiteMoments;
  const { v, omega, dt } = config.command;
  const { cov } = table.exact;
  const alongVariance = cov[0][0] + cov[1][1];
  return [{ mean: [v * dt, 0, omega * dt], cov: [[alongVariance, 0, 0], [0, 0, 0], [0, 0, cov[2][2]]] }];
}

/** Quantiles of the samples that limit the view if their moments are undefined. The tails of such samples may be kilometres long. */
const VIEW_QUANTILES = [0.025, 0.975];

/** Returns points around everything that a view of exponential coordinates has to show. */
function twistCoordinatesToShowOf(scene: Scene) {
  const { v, omega, dt } = scene.config.command;
  const shownCoordinates = [v * dt, omega * dt];
  if (!scene.chartHolds && scene.shown > 0) {
    const twists = scene.simulation.firstTwists(MAX_DOT_COUNT);
    const [along, heading] = [0, 2].map((componentIndex) => twists.filter((_, i) => i % 3 === componentIndex));
    for (const quantileFraction of VIEW_QUANTILES) shownCoordinates.push(quantile(along, quantileFraction)!, quantile(heading, quantileFraction)!);
  }
  for (const { mean, cov } of twistMomentsOf(scene)) {
    shownCoordinates.push(...cornersAround(mean[0], mean[2], VIEWED_DEVIATIONS * stdOfVariance(cov[0][0]), VIEWED_DEVIATIONS * stdOfVariance(cov[2][2])));
  }
  return shownCoordinates;
}
