/** Two pictures of the Odometry Decomposer: the three legs (rotation, drive, rotation) in the odometry frame, and the two odometry poses in the world. */

import { greatest, leastIndex } from 'd3-array';
import { words } from '../../messages/registry.ts';
import { clipToPlot, drawAxes } from '../../scene/axes.ts';
import { drawCallouts, type Callout } from '../../scene/labels.ts';
import { addLine, fillPath, paintWithOpacity, strokePath, strokeLine, type DrawContext, type LineStroke } from '../../scene/canvas.ts';
import { addTurnArc, drawDots, drawOutlines, drawRobot, hasLength, createLineLegend, createLineStyles, strokeLines } from '../../scene/draw.ts';
import { FigurePicture } from '../../scene/picture.ts';
import { PictureView, cornersAround, extentOf } from '../../scene/view.ts';
import { formatFixed } from '../../ui/format.ts';
import { drawDraggableRobot, drawRobotOutline, turnHandleDistanceOf } from '../shared/robot.ts';
import { poseAt, LINE_STYLES } from './settings.ts';
import type { Pose, RuleNoise } from '../../types.d.ts';

/** Half width and length of an arrow head, pixels. */
const ARROW_HEAD_SIZE = { halfWidth: 4, length: 9 };

/** Angle (radians) between successive points of an arc, which is drawn as a polygon. */
const CHORD_ANGLE = 0.1;

/** Number of points of the polygon that approximates an ellipse. */
const ELLIPSE_POINT_COUNT = 64;

/** Returns the points of an ellipse about a pose with semi-axes along and across its heading. Lengths are in metres. */
function ellipsePointsOf({ x, y, theta }: Pose, alongRadius: number, acrossRadius: number) {
  const [headingCos, headingSin] = [Math.cos(theta), Math.sin(theta)];
  return Array.from({ length: ELLIPSE_POINT_COUNT + 1 }, (_, i): [number, number] => {
    const ellipseAngle = (2 * Math.PI * i) / ELLIPSE_POINT_COUNT;
    const [alongOffset, leftOffset] = [alongRadius * Math.cos(ellipseAngle), acrossRadius * Math.sin(ellipseAngle)];
    return [x + alongOffset * headingCos - leftOffset * headingSin, y + alongOffset * headingSin + leftOffset * headingCos];
  });
}

/** Draws a turn (rad) as an arc with an arrow head. The arc starts at the heading of a pose, and its radius is in pixels. */
function drawTurn({ canvasContext, pictureView }: DrawContext, startPose: Pose, turn: number, arcRadius: number, turnColour: string) {
  strokePath(canvasContext, { colour: turnColour, width: 1.75 }, () => addTurnArc(canvasContext, pictureView.toPixel(startPose.x, startPose.y), arcRadius, startPose.theta, turn));
  // The arrow head is smaller on a short arc.
  const arrowHeadLength = Math.min(ARROW_HEAD_SIZE.length, arcRadius * Math.abs(turn));
  const arrowTip = pictureView.headingLineFrom({ ...startPose, theta: startPose.theta + turn }, arcRadius)[1];
  const arrowBasePose = { ...startPose, theta: startPose.theta + turn - (Math.sign(turn) * arrowHeadLength) / arcRadius };
  const arrowHeadScale = arrowHeadLength / ARROW_HEAD_SIZE.length;
  const arrowCornerOf = (arrowSide: number) => pictureView.headingLineFrom(arrowBasePose, arcRadius + arrowSide * arrowHeadScale * ARROW_HEAD_SIZE.halfWidth)[1];
  fillPath(canvasContext, turnColour, () => addLine(canvasContext, [arrowTip, arrowCornerOf(1), arrowCornerOf(-1)]));
}

/** Draws a standard deviation (rad) as a fan to both sides of a heading. The radius of the fan is in pixels. */
function drawDeviationFan({ canvasContext, pictureView }: DrawContext, { x, y, theta }: Pose, deviation: number, fanRadius: number, fanColour: string) {
  const halfAngle = Math.min(deviation, Math.PI);
  if (halfAngle === 0) return;
  const fanCentre = pictureView.toPixel(x, y);
  const addFan = () => {
    canvasContext.moveTo(...fanCentre);
    addTurnArc(canvasContext, fanCentre, fanRadius, theta + halfAngle, -2 * halfAngle);
    canvasContext.closePath();
  };
  paintWithOpacity(canvasContext, 0.14, () => fillPath(canvasContext, fanColour, addFan));
  paintWithOpacity(canvasContext, 0.75, () => strokePath(canvasContext, { colour: fanColour, width: 1, dash: [5, 3] }, addFan));
}

/** Data that the two pictures show: results of the simulation, and the names of the visible lines. */
export type Scene = import('./settings.ts').ViewModel & { overlays: string[] };

/** Radius of the robot, m. */
export const ROBOT_RADIUS = 0.11;

/** Margins of the view: around the robots (m), and around the outcomes (in standard deviations). */
const VIEW_MARGINS = { aroundRobot: 0.3, deviationsAroundOutcomes: 2.4 };

/** Maximum number of outcomes that are drawn with headings. More headings would overlap. */
const MAX_HEADING_TICKS = 1000;

/** Gap between the turning handle of a robot and the arc around it that shows a turn, and gap between two such arcs, CSS pixels. */
const ARC_GAPS = { afterHandle: 14, betweenArcs: 16 };

/** Minimum length (CSS pixels) on the screen of a drive that gets a label. */
const MIN_LABELLED_LENGTH = 24;

/** Minimum angle (rad) of a turn that is drawn as an arc. */
const MIN_DRAWN_TURN = 0.005;

const AXIS_NAMES = { x: 'x (m)', y: 'y (m)' };

/** Length (m) at which the axes of the odometry frame are drawn. It is less than the margin of the view, so that no axis is cut off. */
const FRAME_AXIS_LENGTH = 0.28;

/** Returns points around the start pose and the outcomes that a picture has to show, as x, y pairs. */
function coordinatesToShowOf({ linkage, legs, rules }: Scene): number[] {
  const [{ x, y }, drivenPose] = [poseAt(linkage, 0), poseAt(linkage, 2)];
  // The margin covers the outcomes of all noise models. The scale then stays the same, and the user can compare their spreads.
  const alongMargin = Math.min(VIEW_MARGINS.deviationsAroundOutcomes * Math.max(...rules.map(({ deviations }) => deviations[1])), legs.trans + 2);
  // Unlike the margin along the path, this margin has no upper limit: a rotation moves the end sideways by at most the length of the drive.
  const acrossMargin = VIEW_MARGINS.deviationsAroundOutcomes * Math.max(...rules.map(({ crossTrack }) => crossTrack));
  const [absCos, absSin] = [Math.abs(Math.cos(drivenPose.theta)), Math.abs(Math.sin(drivenPose.theta))];
  return [
    ...cornersAround(x, y, VIEW_MARGINS.aroundRobot),
    ...cornersAround(drivenPose.x, drivenPose.y, VIEW_MARGINS.aroundRobot + alongMargin * absCos + acrossMargin * absSin, VIEW_MARGINS.aroundRobot + alongMargin * absSin + acrossMargin * absCos),
  ];
}

function drawOutcomes(drawContext: DrawContext, { poses, overlays }: Scene) {
  if (!overlays.includes('outcomes')) return;
  drawDots(drawContext, poses, poses.length <= 3 * MAX_HEADING_TICKS ? 1 : 0);
}

/** Returns the 2σ ellipse of the current noise model, and for comparison the ellipse of another noise model if it differs. Each ellipse has a callout. */
function spreadEllipsesOf({ palette }: DrawContext, { linkage, rules, config }: Scene) {
  const currentNoise = rules.find(({ rule }) => rule === config.rule) as RuleNoise;
  const comparedNoise = rules[config.rule === 'thrun' ? 1 : 0];
  const hasOtherDeviations = comparedNoise.deviations.some((deviation, i) => Math.abs(deviation - currentNoise.deviations[i]) > 1e-9);
  return [currentNoise, ...(hasOtherDeviations ? [comparedNoise] : [])].map(({ rule, deviations, crossTrack }) => {
    const ellipsePoints = ellipsePointsOf(poseAt(linkage, 2), 2 * deviations[1], 2 * crossTrack);
    const lineColour = rule === config.rule ? palette.prediction : palette.ink;
    // The callouts are placed apart: at the front of the ellipse of Table 5.6, and at the top of the smaller ellipse of another noise model.
    const calloutPoint = rule === 'thrun' ? ellipsePoints[0] : greatest(ellipsePoints, ([, y]) => y) as [number, number];
    const callout: Callout = { text: words.decomposer.spreadLabel(words.decomposer.ruleNames[rule]), point: calloutPoint, colour: lineColour };
    return { points: Float64Array.from(ellipsePoints.flat()), colour: lineColour, width: 2, callout };
  }).filter(({ points: ellipsePoints }) => hasLength(ellipsePoints));
}

/** Arc that shows a turn: the pose at whose heading the turn starts, the turn (rad), and the radius of the arc (pixels). */
type TurnArc = [Pose, turn: number, radius: number];

/** Returns the radii (pixels) of the arcs that show the two turns. */
const turnRadiiOf = (pictureView: Pick<PictureView, 'scaleX'>) => [0, 1].map((arcIndex) => turnHandleDistanceOf(pictureView, ROBOT_RADIUS) + ARC_GAPS.afterHandle + arcIndex * ARC_GAPS.betweenArcs);

/** Returns points of an arc about a pose as x, y pairs. The arc starts at the heading of the pose. Its turn is in radians, and its radius in metres. */
function turnArcPoints({ x, y, theta }: Pose, turn: number, arcRadius: number) {
  const chordCount = Math.max(1, Math.ceil(Math.abs(turn) / CHORD_ANGLE));
  return Array.from({ length: chordCount + 1 }, (_, i) => theta + (turn * i) / chordCount)
    .flatMap((direction) => [x + arcRadius * Math.cos(direction), y + arcRadius * Math.sin(direction)]);
}

/** Picture in the odometry frame: the three legs (rotation, drive, rotation) as a linkage, and the effect of noise on them. */
export class LegsPicture extends FigurePicture<Scene> {
  pictureName = 'plane';
  pictureView: PictureView = new PictureView({ relativeMargin: 0 });

  fitView(scene: Scene) {
    const { linkage, legs, overlays } = scene;
    const coordinatesToShow = coordinatesToShowOf(scene);
    const shownExtent = extentOf(coordinatesToShow, 1.2);
    const arcRadii = turnRadiiOf({ scaleX: this.pictureView.fittingScaleOf(shownExtent) });
    const shownTurns = overlays.includes('legs') ? [legs.rot1, legs.rot2] : [];
    const arcPoints = shownTurns.flatMap((turn, i) => turnArcPoints(poseAt(linkage, 2 * i), turn, this.pictureView.markLengthOf(shownExtent, arcRadii[i])));
    this.pictureView.fitExtent(extentOf([...coordinatesToShow, ...arcPoints], 1.2));
  }

  paintPicture: FigurePicture<Scene>['paintPicture'] = (drawContext, scene) => {
    const { palette } = drawContext;
    const { linkage, legs, deviations, config, overlays } = scene;
    const [startPose, turnedPose, drivenPose] = [0, 1, 2].map((poseIndex) => poseAt(linkage, poseIndex));
    const lineStyles = createLineStyles(drawContext, LINE_STYLES, overlays);
    drawAxes(drawContext, AXIS_NAMES, createLineLegend(drawContext, lineStyles, ['legs', 'deviation', 'outcomes'], words.decomposer.overlays));
    const [firstTurnRadius, secondTurnRadius] = turnRadiiOf(this.pictureView);
    const turnArcs: TurnArc[] = [[startPose, legs.rot1, firstTurnRadius], [drivenPose, legs.rot2, secondTurnRadius]];
    const spreadEllipses = lineStyles.deviation ? spreadEllipsesOf(drawContext, scene) : [];
    clipToPlot(drawContext, () => {
      if (lineStyles.deviation) drawDeviationFan(drawContext, turnedPose, deviations.rot1, Math.max(legs.trans * this.pictureView.scaleX, secondTurnRadius), lineStyles.deviation.colour);
      if (lineStyles.outcomes) this.#paintGhosts(drawContext, scene);
      drawOutcomes(drawContext, scene);
      drawOutlines(drawContext, spreadEllipses);
      if (lineStyles.legs) drawSegment(drawContext, startPose, drivenPose, lineStyles.legs);
      drawDraggableRobot(drawContext, startPose, ROBOT_RADIUS, palette.prior);
      drawDraggableRobot(drawContext, config.to, ROBOT_RADIUS, palette.prior);
      if (lineStyles.deviation) drawDeviationFan(drawContext, { ...drivenPose, theta: drivenPose.theta + legs.rot2 }, deviations.rot2, secondTurnRadius, lineStyles.deviation.colour);
      if (config.phase < 3) drawRobot(drawContext, { ...scene.robot, heading: scene.robot.theta, colour: palette.accent });
      if (lineStyles.legs) {
        for (const [turnPose, turn, turnRadius] of turnArcs) if (Math.abs(turn) >= MIN_DRAWN_TURN) drawTurn(drawContext, turnPose, turn, turnRadius, lineStyles.legs.colour);
      }
    });
    const turnArcOutlines = turnArcs.map(([turnPose, turn, turnRadius]) => Float64Array.from(turnArcPoints(turnPose, turn, turnRadius / this.pictureView.scaleX)));
    const legCallouts = lineStyles.legs ? this.#createLegCallouts(drawContext, scene, turnArcs) : [];
    drawCallouts(drawContext, [...legCallouts, ...spreadEllipses.map(({ callout }) => callout)], {
      shapeCentre: [drivenPose.x, drivenPose.y], avoidedLines: [...spreadEllipses.map(({ points }) => points), ...turnArcOutlines, segmentCoordinatesOf(startPose, drivenPose)],
    });
  };

  /** Returns callouts with the value and standard deviation of each leg that is long enough to see. */
  #createLegCallouts({ pictureView, palette: { prior: lineColour } }: DrawContext, { legs, deviations }: Scene, turnArcs: TurnArc[]): Callout[] {
    const [startPose, drivenPose] = turnArcs.map(([turnPose]) => turnPose);
    const middleOf = ([{ x, y, theta }, turn, arcRadius]: TurnArc): [number, number] => pictureView.toWorld(...pictureView.headingLineFrom({ x, y, theta: theta + turn / 2 }, arcRadius)[1]);
    const legCallouts = [
      { subscript: 'rot1', unit: 'rad', isShown: Math.abs(legs.rot1) >= MIN_DRAWN_TURN, point: middleOf(turnArcs[0]) },
      { subscript: 'trans', unit: 'm', isShown: legs.trans * pictureView.scaleX >= MIN_LABELLED_LENGTH, point: [(startPose.x + drivenPose.x) / 2, (startPose.y + drivenPose.y) / 2] as [number, number] },
      { subscript: 'rot2', unit: 'rad', isShown: Math.abs(legs.rot2) >= MIN_DRAWN_TURN, point: middleOf(turnArcs[1]) },
    ] as const;
    return legCallouts.filter(({ isShown }) => isShown).map(({ subscript, unit, point }) => {
      const deviationText = deviations[subscript] > 0 ? ` ± ${formatFixed(deviations[subscript], 2)}` : '';
      return { point, symbol: 'δ', subscript, text: `${formatFixed(legs[subscript], 2)}${deviationText} ${unit}`, colour: lineColour };
    });
  }

  #paintGhosts({ canvasContext, pictureView, palette }: DrawContext, { ghosts }: Scene) {
    const ghostPixelOf = (pointIndex: number) => pictureView.toPixel(ghosts[3 * pointIndex], ghosts[3 * pointIndex + 1]);
    paintWithOpacity(canvasContext, 0.5, () => strokePath(canvasContext, { colour: palette.cloud, width: 1 }, () => {
      for (let i = 0; i < ghosts.length / 3; i += 4) addLine(canvasContext, [0, 1, 2, 3].map((k) => ghostPixelOf(i + k)));
    }));
  }
}

/** Picture of the world frame, in which the odometry frame has drifted. */
export class WorldPicture extends FigurePicture<Scene> {
  pictureName = 'world';
  pictureView: PictureView = new PictureView({ relativeMargin: 0 });

  fitView(scene: Scene) {
    const { poses } = scene.drifted;
    const robotBoxCorners = [0, 1, 2].flatMap((poseIndex) => {
      const { x, y } = poseAt(poses, poseIndex);
      return cornersAround(x, y, VIEW_MARGINS.aroundRobot);
    });
    this.pictureView.fitExtent(extentOf([...coordinatesToShowOf(scene), ...robotBoxCorners], 1.2));
  }

  paintPicture: FigurePicture<Scene>['paintPicture'] = (drawContext, scene) => {
    const { palette, canvasContext, pictureView } = drawContext;
    const lineStyles = createLineStyles(drawContext, LINE_STYLES, scene.overlays);
    const [framePose, odometryStart, odometryEnd] = [0, 1, 2].map((poseIndex) => poseAt(scene.drifted.poses, poseIndex));
    const [startPose, predictedPose] = [poseAt(scene.linkage, 0), poseAt(scene.linkage, 3)];
    drawAxes(drawContext, AXIS_NAMES);
    clipToPlot(drawContext, () => {
      if (lineStyles.odometry) {
        const axisLength = FRAME_AXIS_LENGTH * pictureView.scaleX;
        const [, yAxisEnd] = pictureView.headingLineFrom({ ...framePose, theta: framePose.theta + Math.PI / 2 }, axisLength);
        strokeLine(canvasContext, [yAxisEnd, ...pictureView.headingLineFrom(framePose, axisLength)], { colour: palette.prior, width: 1.25 });
        drawSegment(drawContext, odometryStart, odometryEnd, lineStyles.odometry);
        for (const pose of [odometryStart, odometryEnd]) {
          drawRobotOutline(drawContext, pose.x, pose.y, ROBOT_RADIUS, palette.prior);
          strokeLine(canvasContext, pictureView.headingLineFrom(pose, ROBOT_RADIUS * pictureView.scaleX + 8), { colour: palette.prior, width: 1.5 });
        }
      }
      drawOutcomes(drawContext, scene);
      if (lineStyles.prediction) drawSegment(drawContext, startPose, predictedPose, lineStyles.prediction);
      if (lineStyles.difference) drawSegment(drawContext, odometryEnd, predictedPose, lineStyles.difference);
      drawDraggableRobot(drawContext, startPose, ROBOT_RADIUS, palette.truth);
    });
    const { outcomesLabel, ruleNames } = words.decomposer;
    const lowestOutcome = leastIndex(scene.poses.filter((_, i) => i % 3 === 1)) ?? -1;
    const callouts = [
      ...(lineStyles.prediction ? createPoseCallouts(drawContext, [startPose, predictedPose], 'x', [palette.ink, palette.prediction]) : []),
      ...(lineStyles.odometry ? createPoseCallouts(drawContext, [odometryStart, odometryEnd], 'x̄', [palette.prior, palette.prior]) : []),
      ...(lineStyles.outcomes && lowestOutcome >= 0 ? [{ text: outcomesLabel(ruleNames[scene.config.rule]), point: [scene.poses[3 * lowestOutcome], scene.poses[3 * lowestOutcome + 1]] as [number, number], colour: palette.prediction }] : []),
    ];
    drawCallouts(drawContext, callouts, {
      shapeCentre: [(startPose.x + predictedPose.x) / 2, (startPose.y + predictedPose.y) / 2], avoidedLines: [segmentCoordinatesOf(startPose, predictedPose), segmentCoordinatesOf(odometryStart, odometryEnd)],
    });
  };
}

/** Returns the end points of a segment between two poses as x, y pairs. */
const segmentCoordinatesOf = (startPose: Pose, endPose: Pose) => Float64Array.of(startPose.x, startPose.y, endPose.x, endPose.y);

/** Returns callouts for the poses before and after a motion. If the two poses are at the same place on the screen, returns only the second callout. */
function createPoseCallouts({ pictureView }: DrawContext, poses: Pose[], symbol: string, poseColours: string[]): Callout[] {
  const [firstCallout, secondCallout] = poses.map(({ x, y }, i): Callout => ({ point: [x, y], symbol, subscript: ['t−1', 't'][i], colour: poseColours[i] }));
  const pixelDistance = Math.hypot(poses[0].x - poses[1].x, poses[0].y - poses[1].y) * pictureView.scaleX;
  return pixelDistance > MIN_LABELLED_LENGTH ? [firstCallout, secondCallout] : [secondCallout];
}

const drawSegment = (drawContext: DrawContext, startPose: Pose, endPose: Pose, lineStroke: LineStroke) => strokeLines(drawContext, [{ points: segmentCoordinatesOf(startPose, endPose), ...lineStroke }]);
