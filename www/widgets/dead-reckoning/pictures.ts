/** Dead Reckoning's two pictures: the floor with the path, and the selected step in exponential coordinates. */

import { words } from '../../messages/registry.ts';
import { clipToPlot, drawAxes } from '../../scene/axes.ts';
import { drawCallouts, type Callout } from '../../scene/labels.ts';
import { drawDots, drawEarlierOutlines, drawCrosshair, drawOutlines, drawRobot, createLineLegend, createLineStyles, strokeLines } from '../../scene/draw.ts';
import { Picture, SamplesPicture } from '../../scene/picture.ts';
import { View, cornersAround, extentAround, extentOf } from '../../scene/view.ts';
import { formatSignificant } from '../../ui/format.ts';
import { OUTLINE_STYLES } from './settings.ts';
import { drawDisc, paintWithOpacity, type DrawContext } from '../../scene/canvas.ts';

/** View model of the path and step pictures, with the poses of the selected robot after each step. */
export type Scene = import('./settings.ts').ViewModel & { marked: Float64Array | undefined, overlays: string[] };

/** Number of standard deviations around a cloud's mean that a view shows. */
const VIEWED_DEVIATIONS = 3.2;

/** Dots of the clouds at milestones: maximum number, radius in CSS pixels, and opacity. */
const MILESTONE_DOTS = { max: 200, radius: 1.3, alpha: 0.4 };

/** Minimum width (m) of the view of a step, and minimum height relative to the width. */
const MIN_STEP_WIDTH = 1e-6;
const MIN_STEP_ASPECT = 1e-3;

/** Radius of the mark at the commanded end, CSS pixels. */
const END_MARK_RADIUS = 4;

/** Picture of the floor from above, with the path. */
export class PathPicture extends SamplesPicture<Scene> {
  name = 'plane';
  view: View = new View();

  fitView({ commanded, outlines, milestones, poses }: Scene) {
    const outlineCoordinates = [outlines, ...milestones.map((milestone) => milestone.outlines)].flatMap(({ ellipse, exponential }) => [...ellipse, ...exponential]);
    const points = [...commanded, ...outlineCoordinates];
    // Without a prediction the view shows the robots.
    if (outlineCoordinates.length === 0) points.push(...poses.filter((_, i) => i % 3 < 2));
    this.view.fit(extentOf(points, 0.4));
  }

  paint: Picture<Scene>['paint'] = (drawContext, { commanded, outlines, milestones, poses, pose, marked, overlays, config: { step } }) => {
    const { palette } = drawContext;
    const styles = createLineStyles(drawContext, OUTLINE_STYLES);
    const shownNamesOf = (names: (keyof typeof OUTLINE_STYLES)[]) => names.filter((name) => overlays.includes(name));
    const shownNames = shownNamesOf(['ellipse', 'exponential']) as ('ellipse' | 'exponential')[];
    drawAxes(drawContext, { x: 'x (m)', y: 'y (m)' }, createLineLegend(drawContext, OUTLINE_STYLES, shownNamesOf(['ellipse', 'exponential', 'command']), words.reckoning.overlays));
    const linesOf = (stepOutlines: Scene['outlines']) => shownNames.map((name) => ({ points: stepOutlines[name], ...styles[name] }));
    const callouts: Callout[] = [];
    clipToPlot(drawContext, () => {
      for (const milestone of milestones) drawMilestone(drawContext, milestone.poses);
      drawDots(drawContext, poses);
      drawOutlines(drawContext, [
        ...shownNamesOf(['command']).map((name) => ({ points: commanded, ...styles[name] })),
        ...shownNames.flatMap((name) => milestones.map(({ outlines: passedMilestone }) => ({ points: passedMilestone[name], ...styles[name], width: 1 }))),
      ]);
      if (drawContext.previousViewModel) callouts.push(...drawEarlierOutlines(drawContext, linesOf(drawContext.previousViewModel.outlines), [pose, [0, 0]], words.before));
      drawOutlines(drawContext, linesOf(outlines));
      drawRobot(drawContext, { x: 0, y: 0, heading: 0, colour: palette.truth });
      // The mark of the commanded position is small, so that the cloud around it is visible.
      drawDisc(drawContext.context, drawContext.view.toPixel(pose[0], pose[1]), END_MARK_RADIUS, palette.prior, { colour: palette.paper, width: 1.5 });
      if (!marked) return;
      strokeLines(drawContext, [{ points: Float64Array.from([0, 0, ...marked.filter((_, i) => i % 3 < 2)]), colour: palette.accent, width: 1.25, dash: [6, 2] }]);
      const [x, y, heading] = marked.subarray(3 * (step - 1));
      drawCrosshair(drawContext, { x, y, heading });
    });
    drawCallouts(drawContext, callouts, { shapeCentre: [pose[0], pose[1]], lines: [commanded, outlines.ellipse, outlines.exponential] });
  };
}

function drawMilestone({ context, view, palette }: DrawContext, poses: Float64Array) {
  context.fillStyle = palette.cloud;
  const { radius, max, alpha } = MILESTONE_DOTS;
  paintWithOpacity(context, alpha, () => {
    for (let i = 0; i < Math.min(3 * max, poses.length); i += 3) context.fillRect(view.toPixelX(poses[i]) - radius, view.toPixelY(poses[i + 1]) - radius, 2 * radius, 2 * radius);
  });
}

/** Picture of ξ along and ξ lateral about the commanded pose. Each axis has its own scale, because the lateral spread is small at first. */
export class StepPicture extends Picture<Scene> {
  name = 'twist';
  view: View = new View({ hasEqualScales: false, left: 52, right: 10 });

  fitView({ outlines: { predicted }, stats: { measured: { mean, cov } } }: Scene) {
    const points = [0, 0, ...predicted];
    const [along, lateral] = [0, 1].map((axis) => VIEWED_DEVIATIONS * Math.sqrt(cov[axis][axis]));
    if (along + lateral > 0) points.push(...cornersAround(mean[0], mean[1], along, lateral));
    const { xMin, xMax } = extentAround(points, 2);
    // The minimum width and height keep both scales finite.
    this.view.fit(extentOf(points, MIN_STEP_WIDTH, Math.max(MIN_STEP_WIDTH, MIN_STEP_ASPECT * (xMax - xMin))));
  }

  paint: Picture<Scene>['paint'] = (drawContext, { outlines: { predicted, measured }, overlays, twists }) => {
    const styles = createLineStyles(drawContext, OUTLINE_STYLES);
    const shownNames = (['exponential', 'measured'] as ('exponential' | 'measured')[]).filter((name) => overlays.includes(name));
    drawAxes(drawContext, axisNamesOf(this.view));
    const points = { exponential: predicted, measured };
    const callouts: Callout[] = [];
    clipToPlot(drawContext, () => {
      drawDots(drawContext, twists);
      if (drawContext.previousViewModel && overlays.includes('exponential')) callouts.push(...drawEarlierOutlines(drawContext, [{ points: drawContext.previousViewModel.outlines.predicted, ...styles.exponential }], [[0, 0]], words.before));
      drawOutlines(drawContext, shownNames.map((name) => ({ points: points[name], ...styles[name] })));
    });
    drawCallouts(drawContext, callouts, { shapeCentre: [0, 0], lines: [predicted, measured] });
  };
}

/** Ratio of the scales of x and y above which their difference is visible. */
const MIN_VISIBLE_RATIO = 1.05;

/** Returns texts of the ratios scale x : scale y and scale y : scale x. The text of a ratio that is not visible is empty. */
export function formatScaleRatios({ scaleX, scaleY }: Pick<View, 'scaleX' | 'scaleY'>) {
  return [scaleX / scaleY, scaleY / scaleX].map((scaleRatio) => (scaleRatio > MIN_VISIBLE_RATIO ? formatSignificant(scaleRatio, scaleRatio < 10 ? 2 : 1) : ''));
}

/** Returns the names of the axes. The upper name also has the ratio of the scales, because near the lower name it would hide ticks. */
function axisNamesOf(view: View) {
  const { axisAlong: x, axisLateral, stretched } = words.reckoning;
  const [along, lateral] = formatScaleRatios(view);
  const ratioText = along ? stretched.along(along) : lateral && stretched.lateral(lateral);
  return { x, y: ratioText ? `${axisLateral}, ${ratioText}` : axisLateral };
}
