/** Dead Reckoning's two pictures: the floor with the path, and the selected step in exponential coordinates. */

import { words } from '../../messages/registry.ts';
import { clipToPlot, drawAxes } from '../../scene/axes.ts';
import { drawCallouts, type Callout } from '../../scene/labels.ts';
import { drawDots, drawEarlierOutlines, drawOutlines, drawRobot, createLineLegend, createLineStyles, styleOutlines } from '../../scene/draw.ts';
import { FigurePicture } from '../../scene/picture.ts';
import { PictureView, VIEWED_DEVIATIONS, cornersAround, extentAround, extentOf } from '../../scene/view.ts';
import { formatSignificant } from '../../ui/format.ts';
import { OUTLINE_STYLES } from './settings.ts';
import { drawDisc, paintWithOpacity } from '../../scene/canvas.ts';

/** Data that the two pictures show: results of the simulation, and the names of the visible lines. */
export type Scene = import('./settings.ts').ViewModel & { overlays: string[] };

/** Dots of the clouds at some steps (milestones) along the path: maximum number per cloud, and opacity. */
const MILESTONE_DOTS = { maxCount: 200, opacity: 0.4 };

/** Minimum width (m) of the view of a step, and minimum ratio of its height to its width. */
const MIN_STEP_VIEW_WIDTH = 1e-6;
const MIN_STEP_VIEW_ASPECT = 1e-3;

/** Radius of the mark at the end of the commanded path, CSS pixels. */
const END_MARK_RADIUS = 4;

/** Picture of the floor from above, with the path. */
export class PathPicture extends FigurePicture<Scene> {
  pictureName = 'plane';
  pictureView: PictureView = new PictureView();

  fitView({ commanded, outlines, milestones, poses }: Scene) {
    const outlineCoordinates = [outlines, ...milestones.map((milestone) => milestone.outlines)].flatMap(({ ellipse, exponential }) => [...ellipse, ...exponential]);
    const shownCoordinates = [...commanded, ...outlineCoordinates];
    // If no outline is defined, the view includes the robots instead.
    if (outlineCoordinates.length === 0) shownCoordinates.push(...poses.filter((_, i) => i % 3 < 2));
    this.pictureView.fitExtent(extentOf(shownCoordinates, 0.4));
  }

  paintPicture: FigurePicture<Scene>['paintPicture'] = (drawContext, { commanded, outlines, milestones, poses, commandedPose, overlays }) => {
    const { palette } = drawContext;
    const lineStyles = createLineStyles(drawContext, OUTLINE_STYLES, overlays);
    drawAxes(drawContext, { x: 'x (m)', y: 'y (m)' }, createLineLegend(drawContext, lineStyles, ['ellipse', 'exponential', 'command'], words.reckoning.overlays));
    const outlinesOfStep = ({ ellipse, exponential }: Scene['outlines']) => styleOutlines(lineStyles, { ellipse, exponential });
    const callouts: Callout[] = [];
    clipToPlot(drawContext, () => {
      paintWithOpacity(drawContext.canvasContext, MILESTONE_DOTS.opacity, () => milestones.forEach((milestone) => drawDots(drawContext, milestone.poses.subarray(0, 3 * MILESTONE_DOTS.maxCount))));
      drawDots(drawContext, poses);
      const milestoneOutlines = milestones.flatMap((milestone) => outlinesOfStep(milestone.outlines)).map((outline) => ({ ...outline, width: 1 }));
      drawOutlines(drawContext, [...styleOutlines(lineStyles, { command: commanded }), ...milestoneOutlines]);
      if (drawContext.previousViewModel) callouts.push(...drawEarlierOutlines(drawContext, outlinesOfStep(drawContext.previousViewModel.outlines), [commandedPose, [0, 0]], words.earlierOutlinesLabel));
      drawOutlines(drawContext, outlinesOfStep(outlines));
      drawRobot(drawContext, { x: 0, y: 0, heading: 0, colour: palette.truth });
      // The mark at the commanded position is small, so that it does not hide the cloud.
      drawDisc(drawContext.canvasContext, drawContext.pictureView.toPixel(commandedPose[0], commandedPose[1]), END_MARK_RADIUS, palette.prior, { colour: palette.paper, width: 1.5 });
    });
    drawCallouts(drawContext, callouts, { shapeCentre: [commandedPose[0], commandedPose[1]], avoidedLines: [commanded, outlines.ellipse, outlines.exponential] });
  };
}

/** Picture of the selected step in the coordinates ξ along and ξ lateral about the commanded pose. The axes have different scales, because the lateral spread is small at first. */
export class StepPicture extends FigurePicture<Scene> {
  pictureName = 'twist';
  pictureView: PictureView = new PictureView({ hasEqualScales: false, leftMargin: 52, rightMargin: 10 });

  fitView({ outlines: { predicted }, stats: { measured: { mean, cov } } }: Scene) {
    const shownCoordinates = [0, 0, ...predicted];
    const [alongExtent, lateralExtent] = [0, 1].map((componentIndex) => VIEWED_DEVIATIONS * Math.sqrt(cov[componentIndex][componentIndex]));
    if (alongExtent + lateralExtent > 0) shownCoordinates.push(...cornersAround(mean[0], mean[1], alongExtent, lateralExtent));
    const { xMin, xMax } = extentAround(shownCoordinates, 2);
    // The minimum width and height of the view keep the scales of both axes finite if all robots are at nearly the same position.
    this.pictureView.fitExtent(extentOf(shownCoordinates, MIN_STEP_VIEW_WIDTH, Math.max(MIN_STEP_VIEW_WIDTH, MIN_STEP_VIEW_ASPECT * (xMax - xMin))));
  }

  paintPicture: FigurePicture<Scene>['paintPicture'] = (drawContext, { outlines: { predicted, measured }, overlays, twists }) => {
    const lineStyles = createLineStyles(drawContext, OUTLINE_STYLES, overlays);
    drawAxes(drawContext, axisNamesOf(this.pictureView));
    const callouts: Callout[] = [];
    clipToPlot(drawContext, () => {
      drawDots(drawContext, twists);
      if (drawContext.previousViewModel) callouts.push(...drawEarlierOutlines(drawContext, styleOutlines(lineStyles, { exponential: drawContext.previousViewModel.outlines.predicted }), [[0, 0]], words.earlierOutlinesLabel));
      drawOutlines(drawContext, styleOutlines(lineStyles, { exponential: predicted, measured }));
    });
    drawCallouts(drawContext, callouts, { shapeCentre: [0, 0], avoidedLines: [predicted, measured] });
  };
}

/** Ratio of the scales of x and y above which a reader sees that they differ. */
const MIN_VISIBLE_SCALE_RATIO = 1.05;

/** Returns two texts: the ratio of the x scale to the y scale, and the inverse ratio. The text of a ratio is empty unless it is clearly above 1. */
export function formatScaleRatios({ scaleX, scaleY }: Pick<PictureView, 'scaleX' | 'scaleY'>) {
  return [scaleX / scaleY, scaleY / scaleX].map((scaleRatio) => (scaleRatio > MIN_VISIBLE_SCALE_RATIO ? formatSignificant(scaleRatio, scaleRatio < 10 ? 2 : 1) : ''));
}

/** Returns the labels of the axes. The label of the lateral axis includes the ratio of the scales. In the other label, the ratio would hide ticks. */
function axisNamesOf(pictureView: PictureView) {
  const { alongAxisLabel, lateralAxisLabel, enlargementNotes } = words.reckoning;
  const [alongRatio, lateralRatio] = formatScaleRatios(pictureView);
  const ratioText = alongRatio ? enlargementNotes.along(alongRatio) : lateralRatio && enlargementNotes.lateral(lateralRatio);
  return { x: alongAxisLabel, y: ratioText ? `${lateralAxisLabel}, ${ratioText}` : lateralAxisLabel };
}
