/**
 * View: the part of the world (metres, radians; y up) that a picture shows, and the transform to its canvas (CSS pixels; y down). No other
 * file flips y.
 */

import { clampNumber } from '../ui/format.ts';

/** Axis-aligned rectangle in the world of a view. */
export type WorldExtent = { xMin: number, yMin: number, xMax: number, yMax: number };

/** Minimum fraction of a view that its content fills after a change by the page. If it fills less, the view zooms in. */
const MIN_FILL = 0.45;

/** Time constant of the animation from one extent to the next, ms. */
const EASING_MS = 90;

/** Distance from the mean of a cloud, in standard deviations, up to which a view shows the cloud. */
export const VIEWED_DEVIATIONS = 3.2;

/** Visible part of the world in a picture, with the transform to pixels. */
export class PictureView {
  /** Visible extent. An animation moves it to `#targetExtent`. */
  shownExtent: WorldExtent = { xMin: -1, yMin: -1, xMax: 1, yMax: 1 };
  #targetExtent: WorldExtent | undefined;
  /** Part of the world that the view has to show, also after a change of the canvas size. */
  #requiredExtent: WorldExtent | undefined;
  /** Minimum fraction of the view that its content fills after the next fit. With 0 the view only zooms out. */
  #minFillFraction = 0;
  /** True after the view has zoomed out. The picture resets this flag. */
  hasZoomedOut = false;
  /** Limits of the extent, such as the bounds of a map. An extent larger than the limits is centred on them. */
  extentLimits: WorldExtent | undefined;
  /** True if one unit has the same length in pixels along x and y. */
  #hasEqualScales;
  #relativeMargin;
  /** Canvas size, CSS pixels. */
  width = 1;
  height = 1;
  /** Part of the canvas inside the axes, CSS pixels. */
  plotArea = { leftEdge: 0, topEdge: 0, rightEdge: 1, bottomEdge: 1 };
  #plotMargins;

  /** @param relativeMargin margin around the content, relative to its size. The other margins are those of the plot area in CSS pixels */
  constructor({ hasEqualScales = true, relativeMargin = 0.06, leftMargin = 42, rightMargin = 8, topMargin = 24, bottomMargin = 30 } = {}) {
    this.#hasEqualScales = hasEqualScales;
    this.#relativeMargin = relativeMargin;
    this.#plotMargins = { leftMargin, rightMargin, topMargin, bottomMargin };
  }

  setSize(width: number, height: number) {
    if (width === this.width && height === this.height) return;
    this.width = width;
    this.height = height;
    const { leftMargin, rightMargin, topMargin, bottomMargin } = this.#plotMargins;
    this.plotArea = { leftEdge: leftMargin, topEdge: topMargin, rightEdge: Math.max(leftMargin + 1, width - rightMargin), bottomEdge: Math.max(topMargin + 1, height - bottomMargin) };
    if (this.#requiredExtent) this.shownExtent = this.#targetExtent = this.#findCoveringExtent(this.#requiredExtent);
    // Marks have a fixed size in pixels, so that on a small canvas they need a view with more metres. A canvas is small before the layout is finished. The view may zoom in again when the canvas grows.
    this.allowZoomIn();
  }

  get hasTarget() {
    return this.#targetExtent !== undefined;
  }

  /** Lets the next fit zoom in and recenter if the content fills less than `minFill` of the view. With 1 it always does. */
  allowZoomIn(minFillFraction = MIN_FILL) {
    this.#minFillFraction = Math.max(this.#minFillFraction, minFillFraction);
  }

  /** Resets the view, so that the next fit takes effect without an animation. */
  clearTarget() {
    this.#targetExtent = this.#requiredExtent = undefined;
  }

  /** Pixels per unit of x. With equal scales, `scaleY` has the same value. */
  get scaleX() {
    return (this.plotArea.rightEdge - this.plotArea.leftEdge) / (this.shownExtent.xMax - this.shownExtent.xMin);
  }

  get scaleY() {
    return (this.plotArea.bottomEdge - this.plotArea.topEdge) / (this.shownExtent.yMax - this.shownExtent.yMin);
  }

  /** Returns the scale (pixels per metre) at which a part of the world fits into the view with a margin in pixels. */
  fittingScaleOf({ xMin, yMin, xMax, yMax }: WorldExtent, pixelMargin = 0) {
    const { leftEdge, rightEdge, topEdge, bottomEdge } = this.plotArea;
    return Math.min((rightEdge - leftEdge - 2 * pixelMargin) / (xMax - xMin), (bottomEdge - topEdge - 2 * pixelMargin) / (yMax - yMin));
  }

  /** Returns the length (m) of a mark that is `pixelLength` long, if the view fits the extent and the mark. A mark takes at most a quarter of the view. */
  markLengthOf(worldExtent: WorldExtent, pixelLength: number) {
    const { leftEdge, rightEdge, topEdge, bottomEdge } = this.plotArea;
    const pixelMargin = Math.min(pixelLength, (rightEdge - leftEdge) / 4, (bottomEdge - topEdge) / 4);
    return pixelMargin / this.fittingScaleOf(worldExtent, pixelMargin);
  }

  toPixelX(x: number) {
    return this.plotArea.leftEdge + (x - this.shownExtent.xMin) * this.scaleX;
  }

  toPixelY(y: number) {
    return this.plotArea.bottomEdge - (y - this.shownExtent.yMin) * this.scaleY;
  }

  toWorld(x: number, y: number): [x: number, y: number] {
    return [this.shownExtent.xMin + (x - this.plotArea.leftEdge) / this.scaleX, this.shownExtent.yMin + (this.plotArea.bottomEdge - y) / this.scaleY];
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
  headingLineFrom({ x, y, theta }: { x: number, y: number, theta: number }, lineLength: number): [start: [x: number, y: number], end: [x: number, y: number]] {
    const [startX, startY] = this.toPixel(x, y);
    const headingStep = this.pixelDirectionOf(theta);
    return [[startX, startY], [startX + lineLength * headingStep.x, startY + lineLength * headingStep.y]];
  }

  /** Sets the target of the view, which stays if it contains `neededExtent`. Otherwise the view zooms out. After `allowZoomIn` it may also zoom in. */
  fitExtent(neededExtent: WorldExtent) {
    const [savedTarget, minFillFraction] = [this.#targetExtent, this.#minFillFraction];
    this.#minFillFraction = 0;
    if (savedTarget && isInside(neededExtent, savedTarget) && this.#fillFractionOf(savedTarget, neededExtent) >= minFillFraction) return;
    this.hasZoomedOut = savedTarget !== undefined && minFillFraction === 0;
    const { xMin, xMax, yMin, yMax } = neededExtent;
    const paddedExtent = widenExtent(neededExtent, this.#relativeMargin * (xMax - xMin), this.#relativeMargin * (yMax - yMin));
    this.#requiredExtent = savedTarget && this.hasZoomedOut ? extentAround([paddedExtent.xMin, paddedExtent.yMin, paddedExtent.xMax, paddedExtent.yMax], 2, savedTarget) : paddedExtent;
    this.#targetExtent = this.#findCoveringExtent(this.#requiredExtent);
    if (!savedTarget) this.shownExtent = this.#targetExtent;
  }

  /** Moves the extent towards its target for the elapsed time, or at once if `isImmediate`. Returns true if the target is not reached yet. */
  moveTowardsTarget(elapsedMs: number, isImmediate: boolean): boolean {
    const targetExtent = this.#targetExtent;
    if (!targetExtent || targetExtent === this.shownExtent) return false;
    const progressFraction = isImmediate ? 1 : 1 - Math.exp(-elapsedMs / EASING_MS);
    const nextExtent = interpolateExtent(this.shownExtent, targetExtent, progressFraction);
    const remainingDistanceOf = (minKey: keyof WorldExtent, maxKey: keyof WorldExtent) => Math.abs(nextExtent[minKey] - targetExtent[minKey]) + Math.abs(nextExtent[maxKey] - targetExtent[maxKey]);
    const hasReachedTarget = remainingDistanceOf('xMin', 'xMax') * this.scaleX + remainingDistanceOf('yMin', 'yMax') * this.scaleY < 0.5;
    this.shownExtent = hasReachedTarget || isImmediate ? targetExtent : nextExtent;
    return this.shownExtent !== targetExtent;
  }

  #fillFractionOf(currentExtent: WorldExtent, neededExtent: WorldExtent) {
    const filledFractions = [(neededExtent.xMax - neededExtent.xMin) / (currentExtent.xMax - currentExtent.xMin), (neededExtent.yMax - neededExtent.yMin) / (currentExtent.yMax - currentExtent.yMin)];
    return Math[this.#hasEqualScales ? 'max' : 'min'](...filledFractions);
  }

  /** Returns an extent that contains `requiredExtent`, moved into the limits. With equal scales it has the aspect ratio of the plot area. */
  #findCoveringExtent(requiredExtent: WorldExtent) {
    const { leftEdge, rightEdge, topEdge, bottomEdge } = this.plotArea;
    const aspectRatio = (bottomEdge - topEdge) / (rightEdge - leftEdge);
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
  return upperLimit - lowerLimit > intervalLength ? clampNumber(intervalMiddle, lowerLimit + intervalLength / 2, upperLimit - intervalLength / 2) : (lowerLimit + upperLimit) / 2;
}

const isInside = (innerExtent: WorldExtent, outerExtent: WorldExtent) =>
  innerExtent.xMin >= outerExtent.xMin && innerExtent.xMax <= outerExtent.xMax && innerExtent.yMin >= outerExtent.yMin && innerExtent.yMax <= outerExtent.yMax;

/** Returns the linear interpolation between two extents; `blendFraction` is 0 at `startExtent` and 1 at `endExtent`. */
export function interpolateExtent(startExtent: WorldExtent, endExtent: WorldExtent, blendFraction: number): WorldExtent {
  const interpolateBound = (boundName: keyof WorldExtent) => startExtent[boundName] + blendFraction * (endExtent[boundName] - startExtent[boundName]);
  return { xMin: interpolateBound('xMin'), yMin: interpolateBound('yMin'), xMax: interpolateBound('xMax'), yMax: interpolateBound('yMax') };
}

/** Returns an extent widened by a margin on all sides; negative margins make it smaller. */
export const widenExtent = ({ xMin, xMax, yMin, yMax }: WorldExtent, marginX: number, marginY: number = marginX): WorldExtent =>
  ({ xMin: xMin - marginX, xMax: xMax + marginX, yMin: yMin - marginY, yMax: yMax + marginY });

/** Returns two opposite corners of a box around a point, as x, y pairs. */
export const cornersAround = (x: number, y: number, halfWidth: number, halfHeight: number = halfWidth): number[] =>
  [x - halfWidth, y - halfHeight, x + halfWidth, y + halfHeight];

/** Returns the smallest extent that contains points and `initialExtent`. x and y are the first two of each `coordinateStride` numbers. */
export function extentAround(pointCoordinates: ArrayLike<number>, coordinateStride: number, initialExtent: WorldExtent = { xMin: Infinity, yMin: Infinity, xMax: -Infinity, yMax: -Infinity }) {
  const pointBounds = { ...initialExtent };
  for (let i = 0; i < pointCoordinates.length; i += coordinateStride) {
    pointBounds.xMin = Math.min(pointBounds.xMin, pointCoordinates[i]);
    pointBounds.xMax = Math.max(pointBounds.xMax, pointCoordinates[i]);
    pointBounds.yMin = Math.min(pointBounds.yMin, pointCoordinates[i + 1]);
    pointBounds.yMax = Math.max(pointBounds.yMax, pointCoordinates[i + 1]);
  }
  return pointBounds;
}

/** Returns the smallest extent that contains points (x, y pairs), with a minimum width and height. */
export function extentOf(pointCoordinates: number[], minWidth: number, minHeight: number = minWidth) {
  const worldExtent = extentAround(pointCoordinates, 2);
  const missingSizeOf = (minBound: number, maxBound: number, minSize: number) => Math.max(0, minSize - (maxBound - minBound));
  return widenExtent(worldExtent, missingSizeOf(worldExtent.xMin, worldExtent.xMax, minWidth) / 2, missingSizeOf(worldExtent.yMin, worldExtent.yMax, minHeight) / 2);
}
