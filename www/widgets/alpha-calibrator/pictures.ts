/** Pictures of the Alpha Calibrator: the path of the robot, and one leg in the frame of its start. */

import { words } from '../../messages/registry.ts';
import { clipToPlot, drawAxes, lineLegendEntry } from '../../scene/axes.ts';
import { drawDots, drawMark, drawOutline, drawOutlines, drawRobot } from '../../scene/draw.ts';
import { Picture, SamplesPicture } from '../../scene/picture.ts';
import { View, extentAround, extentOf } from '../../scene/view.ts';
import { LEG_CLASSES, LINE_STYLES, type LineName } from './settings.ts';
import { PathLayer, drawRings, pathStyle } from './path-layer.ts';
import type { LegView } from '../../types.d.ts';
import type { ViewModel } from './view-model.ts';

/** View model of the pictures: the fit, and the leg that is shown. */
export type Scene = ViewModel & { chosen: number, leg: LegView | null, overlays: LineName[] };

/** Width of the lines of a single leg, CSS pixels. */
const LEG_LINE_WIDTH = 2.25;

/** Margin around the mark of a leg's end, as a fraction of the leg's length. */
const MARK_MARGIN = 0.08;

/**
 * Returns the corners of a box around both paths. If the odometry drifts far away, the box is cut so that the reference fills half of it.
 *
 * @param reference poses
 * @param odometry points
 */
export function viewCornersOf(reference: ArrayLike<number>, odometry: ArrayLike<number>): number[] {
  const referenceExtent = extentAround(reference, 3);
  const extentOfBothPaths = extentAround(odometry, 2, referenceExtent);
  const margin = Math.max(referenceExtent.xMax - referenceExtent.xMin, referenceExtent.yMax - referenceExtent.yMin) / 2;
  return [Math.max(extentOfBothPaths.xMin, referenceExtent.xMin - margin), Math.max(extentOfBothPaths.yMin, referenceExtent.yMin - margin), Math.min(extentOfBothPaths.xMax, referenceExtent.xMax + margin), Math.min(extentOfBothPaths.yMax, referenceExtent.yMax + margin)];
}

/** Picture of the path from above, in the frame of the reference. */
export class PathPicture extends SamplesPicture<Scene> {
  name = 'plane';
  view: View;
  #layer = new PathLayer();

  /** Creates the picture with a margin at the top, CSS pixels. */
  constructor(top?: number) {
    super();
    this.view = new View({ top });
  }

  fit({ legs, overlays }: Scene) {
    this.view.release();
    this.view.fit(extentOf(legs.count > 0 ? viewCornersOf(legs.reference, overlays.includes('odometry') ? this.#layer.odometryPathOf(legs) : []) : [0, 0], 1));
    // The view is not animated, because an animation would draw all legs in each frame.
    this.view.ease(0, true);
  }

  paint: Picture<Scene>['paint'] = (brush, { legs, classes, chosen, overlays }) => {
    const { palette } = brush;
    const legendNames = brush.exported ? ([...LEG_CLASSES.toReversed(), 'odometry', 'outlier'] as const).filter((name) => overlays.includes(name)) : [];
    const legendEntries = legendNames.map((name) => {
      const lineEntry = lineLegendEntry(brush, words.calibrator.overlays[name].replaceAll('*', ''), pathStyle(brush, name));
      return name === 'outlier' ? { ...lineEntry, draw: (x: number, y: number, length: number) => drawRings(brush, [[x + length / 2, y]]) } : lineEntry;
    });
    drawAxes(brush, { x: 'x (m)', y: 'y (m)' }, legendEntries);
    clipToPlot(brush, () => {
      this.#layer.draw(brush, legs, classes, overlays);
      if (chosen < 0) return;
      const [fromX, fromY, , x, y, heading] = legs.reference.subarray(6 * chosen);
      drawOutline(brush, Float64Array.of(fromX, fromY, x, y), { colour: palette.ink, width: 3.25, dash: [] });
      drawMark(brush, { x, y, heading }, palette.ink);
    });
  };
}

/** Picture of one leg in the frame of its start: the predicted ends, and the ends by odometry and reference. */
export class LegPicture extends Picture<Scene> {
  name = 'leg';
  view: View = new View({ left: 50 });

  fit({ leg }: Scene) {
    if (!leg) return;
    const { outline, read, ended } = leg;
    this.view.release();
    const markMargin = MARK_MARGIN * Math.hypot(ended[0], ended[1]);
    const markCorners = [read, ended].flatMap(([x, y]) => [x - markMargin, y - markMargin, x + markMargin, y + markMargin]);
    this.view.fit(extentOf([0, 0, ...outline, ...markCorners], 0.05));
  }

  paint: Picture<Scene>['paint'] = (brush, { leg, overlays }) => {
    const { palette } = brush;
    drawAxes(brush, { x: words.calibrator.axisAhead, y: words.calibrator.axisLeft }, []);
    if (!leg) return;
    const { outcomes, outline, read, ended } = leg;
    const showsLine = (name: LineName) => overlays.includes(name);
    const styledLine = (name: LineName, points: Float64Array) => {
      const lineStyle = pathStyle(brush, name);
      return showsLine(name) ? [{ points, ...lineStyle, width: (LEG_LINE_WIDTH / LINE_STYLES[name].width) * lineStyle.width }] : [];
    };
    clipToPlot(brush, () => {
      if (showsLine('predicted')) drawDots(brush, outcomes);
      drawOutlines(brush, [
        ...styledLine('predicted', outline),
        ...styledLine('odometry', Float64Array.of(0, 0, read[0], read[1])),
        ...styledLine('reference', Float64Array.of(0, 0, ended[0], ended[1])),
      ]);
      drawRobot(brush, { x: 0, y: 0, heading: 0, colour: palette.truth });
      if (showsLine('odometry')) drawMark(brush, { x: read[0], y: read[1], heading: read[2] }, palette.prior);
      if (showsLine('reference')) drawMark(brush, { x: ended[0], y: ended[1], heading: ended[2] }, palette.ink);
    });
  };
}
