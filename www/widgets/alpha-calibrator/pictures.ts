/** Pictures of the Alpha Calibrator: the path of the robot, and one leg in the frame of its start. */

import { words } from '../../messages/registry.ts';
import { clipToPlot, drawAxes, lineKey } from '../../scene/axes.ts';
import { drawDots, drawSelectedSample, drawOutline, drawOutlines, drawRobot } from '../../scene/draw.ts';
import { Picture, SamplesPicture } from '../../scene/picture.ts';
import { View, extentAround, extentOf } from '../../scene/view.ts';
import { CLASSES, LINES, type LineName } from './settings.ts';
import { PathLayer, drawRings, styleOf } from './path-layer.ts';
import type { LegView } from '../../types.d.ts';
import type { Reading } from './reading.ts';

/** Scene with the leg that is shown. */
export type Scene = Reading & { chosen: number, leg: LegView | null, overlays: LineName[] };

/** Width of the lines of a single leg, CSS pixels. */
const WIDTH = 2.25;

/** Space around the mark of an end, as a share of the leg. */
const MARK_ROOM = 0.08;

/** The floor from above, in the frame of the reference. */
export class PathPicture extends SamplesPicture<Scene> {
  name = 'plane';
  view: View;
  #layer = new PathLayer();

  /** Creates the picture with a margin at the top, CSS pixels. */
  constructor(top?: number) {
    super();
    this.view = new View({ top });
  }

  fit({ legs: { reference } }: Scene) {
    const box = extentAround(reference, 3);
    this.view.release();
    this.view.fit(extentOf(reference.length > 0 ? [box.xMin, box.yMin, box.xMax, box.yMax] : [0, 0], 1));
    // No animation, which would draw all legs in each frame.
    this.view.ease(0, true);
  }

  paint: Picture<Scene>['paint'] = (brush, { legs, classes, chosen, overlays }) => {
    const { palette } = brush;
    const keyed = brush.exported ? ([...CLASSES.toReversed(), 'odometry', 'outlier'] as const).filter((name) => overlays.includes(name)) : [];
    const key = keyed.map((name) => {
      const entry = lineKey(brush, words.calibrator.overlays[name].replaceAll('*', ''), styleOf(brush, name));
      return name === 'outlier' ? { ...entry, draw: (x: number, y: number, length: number) => drawRings(brush, [[x + length / 2, y]]) } : entry;
    });
    drawAxes(brush, { x: 'x (m)', y: 'y (m)' }, key);
    let isUnfinished = false;
    clipToPlot(brush, () => {
      isUnfinished = this.#layer.draw(brush, legs, classes, overlays);
      if (chosen < 0) return;
      const [fromX, fromY, , x, y, heading] = legs.reference.subarray(6 * chosen);
      drawOutline(brush, Float64Array.of(fromX, fromY, x, y), { colour: palette.ink, width: 3.25, dash: [] });
      drawSelectedSample(brush, { x, y, heading }, palette.ink);
    });
    return isUnfinished;
  };
}

/** One leg in the frame of the robot at its start: predicted ends, and the ends by odometry and reference. */
export class LegPicture extends Picture<Scene> {
  name = 'leg';
  view: View = new View({ left: 50 });

  fit({ leg }: Scene) {
    if (!leg) return;
    const { outline, read, ended } = leg;
    this.view.release();
    const room = MARK_ROOM * Math.hypot(ended[0], ended[1]);
    const marks = [read, ended].flatMap(([x, y]) => [x - room, y - room, x + room, y + room]);
    this.view.fit(extentOf([0, 0, ...outline, ...marks], 0.05));
  }

  paint: Picture<Scene>['paint'] = (brush, { leg, overlays }) => {
    const { palette } = brush;
    drawAxes(brush, { x: words.calibrator.axisAhead, y: words.calibrator.axisLeft }, []);
    if (!leg) return;
    const { outcomes, outline, read, ended } = leg;
    const shows = (name: LineName) => overlays.includes(name);
    const line = (name: LineName, points: Float64Array) => {
      const style = styleOf(brush, name);
      return shows(name) ? [{ points, ...style, width: (WIDTH / LINES[name].width) * style.width }] : [];
    };
    clipToPlot(brush, () => {
      if (shows('predicted')) drawDots(brush, outcomes, { x: 0, y: 1, heading: null });
      drawOutlines(brush, [
        ...line('predicted', outline),
        ...line('odometry', Float64Array.of(0, 0, read[0], read[1])),
        ...line('reference', Float64Array.of(0, 0, ended[0], ended[1])),
      ]);
      drawRobot(brush, { x: 0, y: 0, heading: 0, colour: palette.truth });
      if (shows('odometry')) drawSelectedSample(brush, { x: read[0], y: read[1], heading: read[2] }, palette.prior);
      if (shows('reference')) drawSelectedSample(brush, { x: ended[0], y: ended[1], heading: ended[2] }, palette.ink);
    });
  };
}
