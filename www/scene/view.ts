/**
 * View: the part of the world (metres, radians; y up) that a picture shows, and the transform to its canvas (CSS pixels; y down). No other
 * file flips y.
 */

import { clamp } from '../ui/format.ts';

/** Axis-aligned rectangle in the world of a view. */
export type Extent = { xMin: number, yMin: number, xMax: number, yMax: number };

/** Minimum fraction of a view that its content fills after a change by the page. If it fills less, the view zooms in. */
const MIN_FILL = 0.45;

/** Time constant of the animation from one extent to the next, ms. */
const EASING_MS = 90;

/** Visible part of the world in a picture, with the transform to pixels. */
export class View {
  /** Visible extent. An animation moves it to `#targetExtent`. */
  extent: Extent = { xMin: -1, yMin: -1, xMax: 1, yMax: 1 };
  #targetExtent: Extent | undefined;
  /** Part of the world that the view has to show, also after a change of the canvas size. */
  #requiredExtent: Extent | undefined;
  /** Minimum fraction of the view that its content fills after the next fit. With 0 the view only zooms out. */
  #minFill = 0;
  /** True after the view has zoomed out. The picture resets this flag. */
  hasZoomedOut = false;
  /** Limits of the extent, such as the bounds of a map. An extent larger than the limits is centred on them. */
  extentLimits: Extent | undefined;
  /** True if one unit has the same length in pixels along x and y. */
  #hasEqualScales;
  #relativeMargin;
  /** Canvas size, CSS pixels. */
  width = 1;
  height = 1;
  /** Part of the canvas inside the axes, CSS pixels. */
  plotArea = { left: 0, top: 0, right: 1, bottom: 1 };
  #margins;

  /** @param relativeMargin margin around the content, relative to its size. The other margins are those of the plot area in CSS pixels */
  constructor({ hasEqualScales = true, relativeMargin = 0.06, left = 42, right = 8, top = 24, bottom = 30 } = {}) {
    this.#hasEqualScales = hasEqualScales;
    this.#relativeMargin = relativeMargin;
    this.#margins = { left, right, top, bottom };
  }

  resize(width: number, height: number) {
    if (width === this.width && height === this.height) return;
    this.width = width;
    this.height = height;
    const { left, right, top, bottom } = this.#margins;
    this.plotArea = { left, top, right: Math.max(left + 1, width - right), bottom: Math.max(top + 1, height - bottom) };
    if (this.#requiredExtent) this.extent = this.#targetExtent = this.#findCoveringExtent(this.#requiredExtent);
    // Marks have a fixed size in pixels, so that on a small canvas they need a view with more metres. A canvas is small before the layout is finished. The view may zoom in again when the canvas grows.
    this.allowZoomIn();
  }

  get hasTarget() {
    return this.#targetExtent !== undefined;
  }

  /** Lets the next fit zoom in and recenter if the content fills less than `minFill` of the view. With 1 it always does. */
  allowZoomIn(minFill = MIN_FILL) {
    this.#minFill = Math.max(this.#minFill, minFill);
  }

  /** Resets the view, so that the next fit takes effect without an animation. */
  clearTarget() {
    this.#targetExtent = this.#requiredExtent = undefined;
  }

  /** Pixels per unit of x. With equal scales, `scaleY` has the same value. */
  get scaleX() {
    return (this.plotArea.right - this.plotArea.left) / (this.extent.xMax - this.extent.xMin);
  }

  get scaleY() {
    return (this.plotArea.bottom - this.plotArea.top) / (this.extent.yMax - this.extent.yMin);
  }

  /** Returns the scale (pixels per metre) at which a part of the world fits into the view with a margin in pixels. */
  fittingScaleOf({ xMin, yMin, xMax, yMax }: Extent, pixelMargin = 0) {
    const { left, right, top, bottom } = this.plotArea;
    return Math.min((right - left - 2 * pixelMargin) / (xMax - xMin), (bottom - top - 2 * pixelMargin) / (yMax - yMin));
  }

  /** Returns the length (m) of a mark that is `pixelLength` long, if the view fits the extent and the mark. A mark takes at most a quarter of the view. */
  markLengthOf(extent: Extent, pixelLength: number) {
    const { left, right, top, bottom } = this.plotArea;
    const margin = Math.min(pixelLength, (right - left) / 4, (bottom - top) / 4);
    return margin / this.fittingScaleOf(extent, margin);
  }

  toPixelX(x: number) {
    return this.plotArea.left + (x - this.extent.xMin) * this.scaleX;
  }

  toPixelY(y: number) {
    return this.plotArea.bottom - (y - this.extent.yMin) * this.scaleY;
  }

  toWorld(x: number, y: number): [x: number, y: number] {
    return [this.extent.xMin + (x - this.plotArea.left) / this.scaleX, this.extent.yMin + (this.plotArea.bottom - y) / this.scaleY];
  }

  /** Returns a step of one pixel in the direction of a heading (rad), for equal scales of x and y. */
  pixelDirectionOf(heading: number): { x: number, y: number } {
    return { x: Math.cos(heading), y: -Math.sin(heading) };
  }

  toPixel(x: number, y: number): [x: number, y: number] {
    return [this.toPixelX(x), this.toPixelY(y)];
  }

  /** Converts x, y pairs to points in pixels. */
  toPixels(xyPairs: ArrayLike<number>) {
    return Array.from({ length: xyPairs.length / 2 }, (_, i) => this.toPixel(xyPairs[2 * i], xyPairs[2 * i + 1]));
  }

  /** Returns both ends, in pixels, of a line from a pose in its heading, with a length in pixels. */
  headingLineFrom({ x, y, theta }: { x: number, y: number, theta: number }, length: number): [start: [x: number, y: number], end: [x: number, y: number]] {
    const [startX, startY] = this.toPixel(x, y);
    const headingStep = this.pixelDirectionOf(theta);
    return [[startX, startY], [startX + length * headingStep.x, startY + length * headingStep.y]];
  }

  /** Sets the target of the view, which stays if it contains `neededExtent`. Otherwise the view zooms out. After `allowZoomIn` it may also zoom in. */
  fit(neededExtent: Extent) {
    const [keptTarget, minFill] = [this.#targetExtent, this.#minFill];
    this.#minFill = 0;
    if (keptTarget && isInside(neededExtent, keptTarget) && this.#fillOf(keptTarget, neededExtent) >= minFill) return;
    this.hasZoomedOut = keptTarget !== undefined && minFill === 0;
    const { xMin, xMax, yMin, yMax } = neededExtent;
    const paddedExtent = widenExtent(neededExtent, this.#relativeMargin * (xMax - xMin), this.#relativeMargin * (yMax - yMin));
    this.#requiredExtent = keptTarget && this.hasZoomedOut ? extentAround([paddedExtent.xMin, paddedExtent.yMin, paddedExtent.xMax, paddedExtent.yMax], 2, keptTarget) : paddedExtent;
    this.#targetExtent = this.#findCoveringExtent(this.#requiredExtent);
    if (!keptTarget) this.extent = this.#targetExtent;
  }

  /** Moves the extent towards its target for the elapsed time, or at once if `isImmediate`. Returns true if the target is not reached yet. */
  moveTowardsTarget(elapsedMs: number, isImmediate: boolean): boolean {
    const targetExtent = this.#targetExtent;
    if (!targetExtent || targetExtent === this.extent) return false;
    const progressFraction = isImmediate ? 1 : 1 - Math.exp(-elapsedMs / EASING_MS);
    const nextExtent = interpolateExtent(this.extent, targetExtent, progressFraction);
    const remainingDistanceOf = (minKey: keyof Extent, maxKey: keyof Extent) => Math.abs(nextExtent[minKey] - targetExtent[minKey]) + Math.abs(nextExtent[maxKey] - targetExtent[maxKey]);
    const hasArrived = remainingDistanceOf('xMin', 'xMax') * this.scaleX + remainingDistanceOf('yMin', 'yMax') * this.scaleY < 0.5;
    this.extent = hasArrived || isImmediate ? targetExtent : nextExtent;
    return this.extent !== targetExtent;
  }

  #fillOf(currentExtent: Extent, neededExtent: Extent) {
    const filledFractions = [(neededExtent.xMax - neededExtent.xMin) / (currentExtent.xMax - currentExtent.xMin), (neededExtent.yMax - neededExtent.yMin) / (currentExtent.yMax - currentExtent.yMin)];
    return Math[this.#hasEqualScales ? 'max' : 'min'](...filledFractions);
  }

  /** Returns an extent that contains `requiredExtent`, moved into the limits. With equal scales it has the aspect ratio of the plot area. */
  #findCoveringExtent(requiredExtent: Extent) {
    const { left, right, top, bottom } = this.plotArea;
    const aspectRatio = (bottom - top) / (right - left);
    const [requiredWidth, requiredHeight] = [requiredExtent.xMax - requiredExtent.xMin, requiredExtent.yMax - requiredExtent.yMin];
    const width = this.#hasEqualScales ? Math.max(requiredWidth, requiredHeight / aspectRatio) : requiredWidth;
    const height = this.#hasEqualScales ? width * aspectRatio : requiredHeight;
    const extentLimits = this.extentLimits ?? { xMin: -Infinity, xMax: Infinity, yMin: -Infinity, yMax: Infinity };
    const x = clampMiddle((requiredExtent.xMin + requiredExtent.xMax) / 2, width, extentLimits.xMin, extentLimits.xMax);
    const y = clampMiddle((requiredExtent.yMin + requiredExtent.yMax) / 2, height, extentLimits.yMin, extentLimits.yMax);
    return { xMin: x - width / 2, xMax: x + width / 2, yMin: y - height / 2, yMax: y + height / 2 };
  }
}

/** Returns the middle of an interval after moving it between limits. An interval that is longer than their distance is centred on them. */
function clampMiddle(intervalMiddle: number, intervalLength: number, lowerLimit: number, upperLimit: number) {
  return upperLimit - lowerLimit > intervalLength ? clamp(intervalMiddle, lowerLimit + intervalLength / 2, upperLimit - intervalLength / 2) : (lowerLimit + upperLimit) / 2;
}

const isInside = (innerExtent: Extent, outerExtent: Extent) =>
  innerExtent.xMin >= outerExtent.xMin && innerExtent.xMax <= outerExtent.xMax && innerExtent.yMin >= outerExtent.yMin && innerExtent.yMax <= outerExtent.yMax;

/** Returns the linear interpolation between two extents; `fraction` is 0 at `startExtent` and 1 at `endExtent`. */
export function interpolateExtent(startExtent: Extent, endExtent: Extent, fraction: number): Extent {
  const interpolateBound = (key: keyof Extent) => startExtent[key] + fraction * (endExtent[key] - startExtent[key]);
  return { xMin: interpolateBound('xMin'), yMin: interpolateBound('yMin'), xMax: interpolateBound('xMax'), yMax: interpolateBound('yMax') };
}

/** Returns an extent widened by a margin on all sides; negative margins make it smaller. */
export const widenExtent = ({ xMin, xMax, yMin, yMax }: Extent, marginX: number, marginY: number = marginX): Extent =>
  ({ xMin: xMin - marginX, xMax: xMax + marginX, yMin: yMin - marginY, yMax: yMax + marginY });

/** Returns two opposite corners of a box around a point, as x, y pairs. */
export const cornersAround = (x: number, y: number, halfWidth: number, halfHeight: number = halfWidth): number[] =>
  [x - halfWidth, y - halfHeight, x + halfWidth, y + halfHeight];

/** Returns the smallest extent that contains points and `initialExtent`. x and y are the first two of each `stride` numbers. */
export function extentAround(coordinates: ArrayLike<number>, stride: number, initialExtent: Extent = { xMin: Infinity, yMin: Infinity, xMax: -Infinity, yMax: -Infinity }) {
  const pointBounds = { ...initialExtent };
  for (let i = 0; i < coordinates.length; i += stride) {
    pointBounds.xMin = Math.min(pointBounds.xMin, coordinates[i]);
    pointBounds.xMax = Math.max(pointBounds.xMax, coordinates[i]);
    pointBounds.yMin = Math.min(pointBounds.yMin, coordinates[i + 1]);
    pointBounds.yMax = Math.max(pointBounds.yMax, coordinates[i + 1]);
  }
  return pointBounds;
}

/** Returns the smallest extent that contains points (x, y pairs), with a minimum width and height. */
export function extentOf(points: number[], minWidth: number, minHeight: number = minWidth) {
  const extent = extentAround(points, 2);
  const missingSizeOf = (min: number, max: number, minSize: number) => Math.max(0, minSize - (max - min));
  return widenExtent(extent, missingSizeOf(extent.xMin, extent.xMax, minWidth) / 2, missingSizeOf(extent.yMin, extent.yMax, minHeight) / 2);
}
