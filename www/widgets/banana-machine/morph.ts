/** Morph: continuous transformation of the floor (stage 0) to exponential coordinates (stage 1), and of the grid that it straightens; see doc/statistics.md. */

import { ticks } from 'd3-array';
import { addLine, paintWithOpacity, strokePath, type DrawContext } from '../../scene/canvas.ts';
import { PictureView, interpolateExtent, type WorldExtent } from '../../scene/view.ts';
import type { Motion } from '../../types.d.ts';
import type { ViewModel } from './settings.ts';

/** Outlines by name, in floor coordinates or transformed to a stage of the morph. */
export type Outlines = Omit<ViewModel['contours'], 'twistEllipse'>;

export const MORPH_DURATION_MS = 5000;

/** Returns the position of a twist (m, m, rad) in a picture at a stage of the morph: 0 is the floor, 1 is exponential coordinates. `geom::unbend` of the core has the same formula. */
export function morphPoint({ 0: along, 1: lateral, 2: heading }: ArrayLike<number>, morph: number): [number, number] {
  const halfHeading = ((1 - morph) * heading) / 2;
  const sinc = halfHeading === 0 ? 1 : Math.sin(halfHeading) / halfHeading;
  const [alongOffset, lateralOffset] = [sinc * along, sinc * (1 - morph) * lateral];
  const [cos, sin] = [Math.cos(halfHeading), Math.sin(halfHeading)];
  return [alongOffset * cos - lateralOffset * sin, alongOffset * sin + lateralOffset * cos + morph * heading];
}

/** Returns the outlines at a stage of the morph. Floor outlines are transformed point by point. The outline of the Gaussian in exponential coordinates is computed directly. */
export function morphOutlines(motion: Motion, viewModel: ViewModel, morph: number): Outlines {
  const { config: { command: { v, omega, dt } }, contours, stats } = viewModel;
  if (morph === 0) return contours;
  const morphOutline = (outline: Float64Array) => motion.unbendLine(outline, omega * dt, morph);
  const chordCount = contours.command.length / 2 - 1;
  const pointOfChord = (i: number) => morphPoint([(i / chordCount) * v * dt, 0, (i / chordCount) * omega * dt], morph);
  const { mean, cov } = stats.exponential;
  return {
    command: Float64Array.from(Array.from({ length: chordCount + 1 }, (_, i) => pointOfChord(i)).flat()),
    ellipse: morphOutline(contours.ellipse),
    linearized: morphOutline(contours.linearized),
    additive: morphOutline(contours.additive),
    exponential: contours.exponential.length > 0 ? motion.unbendGaussian(Float64Array.from([...mean, ...cov.flat()]), morph) : contours.exponential,
  };
}

/** View at a stage of the morph: it interpolates between a view of the floor and a view of exponential coordinates. Each of these two views has its own target extent. */
export class MorphView extends PictureView {
  /** Stage of the morph: 0 is the floor, 1 is exponential coordinates. */
  morph = 0;
  /** Views at the two ends of the morph: first the floor, then exponential coordinates. */
  endViews;

  constructor(margins: { leftMargin: number, rightMargin: number }) {
    super(margins);
    this.endViews = [new PictureView(margins), new PictureView({ ...margins, hasEqualScales: false })];
  }

  setSize(width: Parameters<PictureView['setSize']>[0], height: Parameters<PictureView['setSize']>[1]) {
    super.setSize(width, height);
    for (const endView of this.endViews) endView.setSize(width, height);
  }

  allowZoomIn(minFillFraction?: number) {
    for (const endView of this.endViews) endView.allowZoomIn(minFillFraction);
  }

  clearTarget() {
    for (const endView of this.endViews) endView.clearTarget();
  }

  get hasTarget() {
    return this.endViews[this.morph > 0 ? 1 : 0].hasTarget;
  }

  /** Sets the region that the view shows at one end of the morph: `endIndex` is 0 for the floor, 1 for exponential coordinates. */
  fitEnd(shownExtent: WorldExtent, endIndex: 0 | 1) {
    const pictureView = this.endViews[endIndex];
    pictureView.hasZoomedOut = false;
    pictureView.fitExtent(shownExtent);
    this.hasZoomedOut ||= pictureView.hasZoomedOut;
  }

  moveTowardsTarget(elapsedMs: Parameters<PictureView['moveTowardsTarget']>[0], isImmediate: Parameters<PictureView['moveTowardsTarget']>[1]) {
    const isMoving = this.endViews.map((endView) => endView.moveTowardsTarget(elapsedMs, isImmediate)).includes(true);
    this.shownExtent = interpolateExtent(this.endViews[0].shownExtent, this.endViews[1].shownExtent, this.morph);
    return isMoving;
  }
}

/** Approximate number of grid lines in each direction, and number of straight segments that approximate a curved grid line. */
const GRID_LINE_COUNT = 7;
const CHORDS_PER_LINE = 32;

/** Draws the grid of exponential coordinates at a stage of the morph. The second parameter is the view of exponential coordinates. */
export function drawMorphGrid({ canvasContext, pictureView, palette }: DrawContext, { shownExtent: { xMin, xMax, yMin, yMax } }: PictureView, morph: number) {
  const drawGridLine = (pointOfFraction: (fraction: number) => [along: number, heading: number]) => addLine(canvasContext, Array.from({ length: CHORDS_PER_LINE + 1 }, (_, i) => {
    const [along, heading] = pointOfFraction(i / CHORDS_PER_LINE);
    return pictureView.toPixel(...morphPoint([along, 0, heading], morph));
  }));
  // The grid fades in at the start of the morph. At the end it coincides with the straight grid of the axes.
  paintWithOpacity(canvasContext, 0.7 * Math.min(1, 5 * morph), () => strokePath(canvasContext, { colour: palette.rule, width: 1 }, () => {
    for (const along of ticks(xMin, xMax, GRID_LINE_COUNT)) drawGridLine((fraction) => [along, yMin + fraction * (yMax - yMin)]);
    for (const heading of ticks(yMin, yMax, GRID_LINE_COUNT)) drawGridLine((fraction) => [xMin + fraction * (xMax - xMin), heading]);
  }));
}
