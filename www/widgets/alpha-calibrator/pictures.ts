/** Pictures of the Alpha Calibrator: the path of the robot, and one leg in the frame of its start. */

import { range } from 'd3-array';
import { words } from '../../messages/registry.ts';
import { clipToPlot, drawAxes } from '../../scene/axes.ts';
import { LINES_PER_STROKE, CachedLayer, MemoizedResult, strokeInBatches, type LayerDrawContext } from '../../scene/cache.ts';
import { strokePath } from '../../scene/canvas.ts';
import { drawDots, drawCrosshair, drawOutline, drawOutlines, drawRobot, createLineLegend, createLineStyles, styleOutlines } from '../../scene/draw.ts';
import { FigurePicture, SamplesPicture } from '../../scene/picture.ts';
import { PictureView, extentAround, extentOf, widenExtent } from '../../scene/view.ts';
import { LEG_CLASSES, LINE_STYLES, type LineName, type ViewModel } from './settings.ts';
import type { CalibrationLegs, LegView } from '../../types.d.ts';

/** Data that the pictures show: the fit, the selected leg, and the names of the visible lines. */
export type Scene = ViewModel & { chosenLegIndex: number, leg: LegView | null, overlays: LineName[] };

/** Number of legs above which the path is drawn as hairlines into a cached layer. Wide lines would hide each other. */
const MAX_WIDE_LINES = 2000;

/** Radius of the rings around outliers, CSS pixels. */
const OUTLIER_RING_RADIUS = 6;

/** Width of the lines of a path with too many legs for wide lines, CSS pixels. */
const HAIRLINE_WIDTH = 1;

/** Margin around the reference's path as a fraction of its size. It leaves space for odometry that drifts away. */
const DRIFT_MARGIN = 0.15;

/** Picture of the path from above, in the frame of the reference. */
export class PathPicture extends SamplesPicture<Scene> {
  pictureName = 'plane';
  pictureView: PictureView = new PictureView();
  /** Cached drawing of the path, which may have a hundred thousand legs. It changes only with the log, the view or the colours. */
  #pathLayer = new CachedLayer();
  #odometryPathMemo: MemoizedResult<Float64Array> = new MemoizedResult();

  /** Returns the end points of the legs by odometry, as x, y pairs. The path starts at the first pose of the reference. */
  #odometryPathOf(legs: CalibrationLegs): Float64Array {
    return this.#odometryPathMemo.getResult([legs], () => {
      const { count, odometry, reference } = legs;
      const frameRotation = reference[2] - odometry[2];
      const [cos, sin] = [Math.cos(frameRotation), Math.sin(frameRotation)];
      const legEndPoints = new Float64Array(2 * count);
      for (let leg = 0; leg < count; leg++) {
        const [dx, dy] = [odometry[6 * leg + 3] - odometry[0], odometry[6 * leg + 4] - odometry[1]];
        legEndPoints[2 * leg] = reference[0] + cos * dx - sin * dy;
        legEndPoints[2 * leg + 1] = reference[1] + sin * dx + cos * dy;
      }
      return legEndPoints;
    });
  }

  fitView({ legs }: Scene) {
    this.pictureView.allowZoomIn();
    const extent = legs.count > 0 ? extentAround(legs.reference, 3) : extentOf([0, 0], 1);
    this.pictureView.fitExtent(widenExtent(extent, DRIFT_MARGIN * Math.max(1, extent.xMax - extent.xMin, extent.yMax - extent.yMin)));
    // The view changes without animation, because an animation would draw all legs in each frame.
    this.pictureView.moveTowardsTarget(0, true);
  }

  paintPicture: FigurePicture<Scene>['paintPicture'] = (drawContext, { legs, legClasses, chosenLegIndex, overlays }) => {
    const { palette } = drawContext;
    const lineStyles = createLineStyles(drawContext, LINE_STYLES, overlays);
    drawAxes(drawContext, { x: 'x (m)', y: 'y (m)' }, createLineLegend(drawContext, lineStyles, [...LEG_CLASSES.toReversed(), 'odometry'], words.calibrator.overlays));
    clipToPlot(drawContext, () => {
      const paintLegs = (layerContext: LayerDrawContext) => drawPath(layerContext, legs, this.#odometryPathOf(legs), legClasses, overlays);
      if ('isVector' in drawContext.canvasContext || legs.count <= MAX_WIDE_LINES) paintLegs(drawContext);
      else this.#pathLayer.drawLayer(drawContext, [legs, overlays, drawContext.highlight], paintLegs);
      if (chosenLegIndex < 0) return;
      const [startX, startY, , x, y, heading] = legs.reference.subarray(6 * chosenLegIndex);
      drawOutline(drawContext, Float64Array.of(startX, startY, x, y), { colour: palette.ink, width: 3.25, dash: [] });
      drawCrosshair(drawContext, { x, y, heading }, palette.ink);
    });
  };
}

function drawPath(drawContext: LayerDrawContext, legs: CalibrationLegs, odometryPath: Float64Array, legClasses: Uint8Array, overlays: LineName[]) {
  const { canvasContext, pictureView } = drawContext;
  const { count, reference, outliers } = legs;
  const lineStyles = createLineStyles(drawContext, LINE_STYLES, overlays);
  if (lineStyles.odometry) {
    const odometryPixels = pictureView.toPixels(odometryPath);
    const pathPieces = range(0, odometryPixels.length, LINES_PER_STROKE).map((pieceStart) => odometryPixels.slice(pieceStart, pieceStart + LINES_PER_STROKE + 1));
    strokeInBatches(canvasContext, pathPieces, lineStyles.odometry, 1);
  }
  for (const [legClass, legClassName] of LEG_CLASSES.entries()) {
    const lineStyle = lineStyles[legClassName];
    if (!lineStyle) continue;
    const legsOfClass = [...legClasses.keys()].filter((leg) => legClasses[leg] === legClass);
    const legLines = legsOfClass.map((leg) => [0, 3].map((poseOffset) => pictureView.toPixel(reference[6 * leg + poseOffset], reference[6 * leg + poseOffset + 1])));
    const legStyle = { ...lineStyle, lineCap: 'round' } as const;
    strokeInBatches(canvasContext, legLines, count > MAX_WIDE_LINES ? { ...legStyle, width: HAIRLINE_WIDTH } : legStyle);
  }
  if (lineStyles.outlier) strokePath(canvasContext, lineStyles.outlier, () => {
    for (const leg of [...outliers.keys()].filter((leg) => outliers[leg] > 0)) {
      const [x, y] = pictureView.toPixel(reference[6 * leg + 3], reference[6 * leg + 4]);
      canvasContext.moveTo(x + OUTLIER_RING_RADIUS, y);
      canvasContext.arc(x, y, OUTLIER_RING_RADIUS, 0, 2 * Math.PI);
    }
  });
}

/** Margin of the view around a mark at the end of a leg, as a fraction of the leg's length. */
const RELATIVE_MARK_MARGIN = 0.08;

/** Picture of one leg in the frame of its start pose: the predicted end poses, and the end poses by odometry and by reference. */
export class LegPicture extends FigurePicture<Scene> {
  pictureName = 'leg';
  pictureView: PictureView = new PictureView({ leftMargin: 50 });

  fitView({ leg }: Scene) {
    if (!leg) return;
    const { outline, read, ended } = leg;
    this.pictureView.allowZoomIn();
    const markMargin = RELATIVE_MARK_MARGIN * Math.hypot(ended[0], ended[1]);
    const markCorners = [read, ended].flatMap(([x, y]) => [x - markMargin, y - markMargin, x + markMargin, y + markMargin]);
    this.pictureView.fitExtent(extentOf([0, 0, ...outline, ...markCorners], 0.05));
  }

  paintPicture: FigurePicture<Scene>['paintPicture'] = (drawContext, { leg, overlays }) => {
    const { palette } = drawContext;
    drawAxes(drawContext, { x: words.calibrator.aheadAxisLabel, y: words.calibrator.leftAxisLabel }, []);
    if (!leg) return;
    const { outcomes, outline, read, ended } = leg;
    const lineStyles = createLineStyles(drawContext, LINE_STYLES, overlays);
    clipToPlot(drawContext, () => {
      if (lineStyles.predicted) drawDots(drawContext, outcomes);
      drawOutlines(drawContext, styleOutlines(lineStyles, { predicted: outline, odometry: Float64Array.of(0, 0, read[0], read[1]), reference: Float64Array.of(0, 0, ended[0], ended[1]) }));
      drawRobot(drawContext, { x: 0, y: 0, heading: 0, colour: palette.truth });
      if (lineStyles.odometry) drawCrosshair(drawContext, { x: read[0], y: read[1], heading: read[2] }, palette.prior);
      if (lineStyles.reference) drawCrosshair(drawContext, { x: ended[0], y: ended[1], heading: ended[2] }, palette.ink);
    });
  };
}
