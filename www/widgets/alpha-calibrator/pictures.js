/** Pictures of the Alpha Calibrator: the path of the robot, and one leg in the frame of its start. */

import { words } from '../../messages/registry.js';
import { clipped, drawAxes } from '../../scene/axes.js';
import { drawDots, drawMark, drawOutline, drawOutlines } from '../../scene/draw.js';
import { Picture, SamplesPicture } from '../../scene/picture.js';
import { View, extentAround, extentOf } from '../../scene/view.js';
import { lineKey } from '../shared/line-key.js';
import { READ_DASH, WayLayer, readStyleOf, stylesOf } from './way.js';

/**
 * @import { AlphaCalibrator as Machine, LegView } from '../../types.d.ts'
 * @import { Reading } from './reading.js'
 *
 * @typedef {Reading & { chosen: number, leg: LegView | null }} Scene with the leg that is shown
 */

/** Room for a key in two lines, CSS pixels. */
const TWO_LINES = 42;

/** Radius of the rings around the worst legs, CSS pixels. */
const RING = 6;

/**
 * The floor from above, in the frame of the reference.
 *
 * @extends {SamplesPicture<Scene>}
 */
export class WayPicture extends SamplesPicture {
  #layer = new WayLayer();

  constructor() {
    super('plane', new View({ top: TWO_LINES }));
  }

  /** @param {Scene} scene */
  fit({ legs: { reference } }) {
    const box = extentAround(reference, 3);
    this.view.release();
    this.view.fit(extentOf(reference.length > 0 ? [box.xMin, box.yMin, box.xMax, box.yMax] : [0, 0], 1));
  }

  /** @type {Picture<Scene>['paint']} */
  paint = (brush, { legs, classes, stats: { doubts }, chosen }) => {
    const { context, palette, view } = brush;
    const styles = stylesOf(palette);
    const { key } = words.calibrator;
    const entries = styles.map((style, i) => lineKey(brush, key.classes[i], style)).reverse();
    drawAxes(brush, { x: 'x (m)', y: 'y (m)' }, [...entries, lineKey(brush, key.read, readStyleOf(palette))]);
    clipped(brush, () => {
      this.#layer.draw(brush, legs, classes);
      context.strokeStyle = palette.ink;
      context.lineWidth = 1;
      for (const leg of doubts.worst) {
        context.beginPath();
        context.arc(view.toPixelX(legs.reference[6 * leg + 3]), view.toPixelY(legs.reference[6 * leg + 4]), RING, 0, 2 * Math.PI);
        context.stroke();
      }
      if (chosen < 0) return;
      const [fromX, fromY, , x, y, heading] = legs.reference.subarray(6 * chosen);
      drawOutline(brush, Float64Array.of(fromX, fromY, x, y), { colour: palette.ink, width: 3.25, dash: [] });
      drawMark(brush, { x, y, heading }, palette.ink);
    });
  };
}

/**
 * One leg in the frame of the robot at its start: predicted ends, and the ends by odometry and reference.
 *
 * @extends {Picture<Scene>}
 */
export class LegPicture extends Picture {
  constructor() {
    super('leg', new View({ left: 50, top: TWO_LINES }));
  }

  /** @param {Scene} scene */
  fit({ leg }) {
    if (!leg) return;
    const { outline, read, ended } = leg;
    this.view.release();
    this.view.fit(extentOf([...outline, read[0], read[1], ended[0], ended[1]], 0.05));
  }

  /** @type {Picture<Scene>['paint']} */
  paint = (brush, { leg }) => {
    const { palette } = brush;
    const { key, axisAhead, axisLeft } = words.calibrator;
    const styles = {
      predicted: { colour: palette.prediction, width: 2, dash: [] },
      read: { colour: palette.prior, width: 2.25, dash: READ_DASH },
      ended: { colour: palette.ink, width: 2.25, dash: [] },
    };
    const names = /** @type {const} */ (['predicted', 'read', 'ended']);
    drawAxes(brush, { x: axisAhead, y: axisLeft }, names.map((name) => lineKey(brush, key[name], styles[name])));
    if (!leg) return;
    const { outcomes, outline, read, ended } = leg;
    clipped(brush, () => {
      drawDots(brush, outcomes, { x: 0, y: 1, heading: null });
      drawOutlines(brush, [
        { points: outline, ...styles.predicted },
        { points: Float64Array.of(0, 0, read[0], read[1]), ...styles.read },
        { points: Float64Array.of(0, 0, ended[0], ended[1]), ...styles.ended },
      ]);
      drawMark(brush, { x: read[0], y: read[1], heading: read[2] }, palette.prior);
      drawMark(brush, { x: ended[0], y: ended[1], heading: ended[2] }, palette.ink);
    });
  };
}
