/**
 * Transform between a view's world (metres, radians; y up) and its canvas (CSS pixels; y down), and choice of the part that a view shows.
 * The only place where y flips.
 */

import { clamp } from '../ui/clamp.ts';

/** Axis-aligned part of a view's world. */
export type Extent = { xMin: number, yMin: number, xMax: number, yMax: number };

/** Fraction of a released view that its content has to fill; otherwise the view zooms in. */
const LOOSEST_FIT = 0.45;

/** Margin around the content of a view, relative to its size. */
const MARGIN = 0.06;

/** Time constant of the eased change from one extent to the next, in milliseconds. */
const EASING = 90;

/** Widths that a view may have, times powers of ten. */
const LADDER = [1, 1.12, 1.25, 1.4, 1.6, 1.8, 2, 2.25, 2.5, 2.8, 3.2, 3.6, 4, 4.5, 5, 5.6, 6.4, 7.2, 8, 9];

/** Visible part of the world in a picture, with the transform to pixels. */
export class View {
  /** Extent that is shown now, possibly on its way to `#target`. */
  extent: Extent = { xMin: -1, yMin: -1, xMax: 1, yMax: 1 };
  #target: Extent | undefined;
  /** Part of the world that the view covers in whatever size it has. */
  #room: Extent | undefined;
  /** True where the next fit may also close in and recenter. */
  #released = false;
  /** True once the view has zoomed out; set back from outside. */
  widened = false;
  /** Limits that the extent is moved into, or around where it is larger. */
  within: Extent | undefined;
  /** True if a metre is as long in y as in x. */
  #equal;
  /** True for an extent of what is needed alone, without a margin. What is needed may depend on the size: a fit in a new size chooses anew. */
  #snug;
  /** Canvas size at the last fit, CSS pixels. */
  #fitted = { width: 1, height: 1 };
  /** Canvas size, CSS pixels. */
  width = 1;
  height = 1;
  /** The part of the canvas inside the axes, CSS pixels. */
  frame = { left: 0, top: 0, right: 1, bottom: 1 };
  #inset;

  constructor({ equal = true, snug = false, left = 42, right = 8, top = 24, bottom = 30 }: { equal?: boolean, snug?: boolean, left?: number, right?: number, top?: number, bottom?: number } = {}) {
    this.#equal = equal;
    this.#snug = snug;
    this.#inset = { left, right, top, bottom };
  }

  /** Sets the size in CSS pixels. */
  resize(width: number, height: number) {
    if (width === this.width && height === this.height) return;
    this.width = width;
    this.height = height;
    const { left, right, top, bottom } = this.#inset;
    this.frame = { left, top, right: Math.max(left + 1, width - right), bottom: Math.max(top + 1, height - bottom) };
    if (this.#room) this.extent = this.#target = this.#cover(this.#room);
  }

  /** True once the view knows what to show. */
  get aimed() {
    return this.#target !== undefined;
  }

  /** Lets the next fit close in and recenter. */
  release() {
    this.#released = true;
  }

  /** Forgets what is shown: the next fit takes effect without easing. */
  forget() {
    this.#target = this.#room = undefined;
  }

  /** Pixels a unit of x; with equal aspect also of y. */
  get scaleX() {
    return (this.frame.right - this.frame.left) / (this.extent.xMax - this.extent.xMin);
  }

  get scaleY() {
    return (this.frame.bottom - this.frame.top) / (this.extent.yMax - this.extent.yMin);
  }

  /** Returns the pixels a metre at which a part of the world fits. */
  scaleFor({ xMin, yMin, xMax, yMax }: Extent) {
    const { left, right, top, bottom } = this.frame;
    return Math.min((right - left) / (xMax - xMin), (bottom - top) / (yMax - yMin));
  }

  toPixelX(x: number) {
    return this.frame.left + (x - this.extent.xMin) * this.scaleX;
  }

  toPixelY(y: number) {
    return this.frame.bottom - (y - this.extent.yMin) * this.scaleY;
  }

  toWorldX(pixel: number) {
    return this.extent.xMin + (pixel - this.frame.left) / this.scaleX;
  }

  toWorldY(pixel: number) {
    return this.extent.yMin + (this.frame.bottom - pixel) / this.scaleY;
  }

  /** Returns a step of one pixel in the direction of a heading (rad), in a view of equal aspect. */
  direction(heading: number): { x: number, y: number } {
    return { x: Math.cos(heading), y: -Math.sin(heading) };
  }

  /** Aims the view at an extent. The view stays while that is inside, and only zooms out otherwise; a released view may also close in. */
  fit(needed: Extent) {
    const { width, height } = this;
    const isResized = this.#snug && (width !== this.#fitted.width || height !== this.#fitted.height);
    const [kept, released] = [isResized ? undefined : this.#target, this.#released];
    this.#fitted = { width, height };
    this.#released = false;
    if (kept && (released ? this.#suits(kept, needed) : isInside(needed, kept))) return;
    this.widened = kept !== undefined && !released;
    const room = this.#snug ? needed : withMargin(needed);
    this.#room = kept && this.widened ? extentAround([room.xMin, room.yMin, room.xMax, room.yMax], 2, kept) : room;
    this.#target = this.#cover(this.#room);
    if (!kept) this.extent = this.#target;
  }

  /** Moves the extent towards its aim by the milliseconds since the last call, or at once. Returns true if it has not arrived. */
  ease(elapsed: number, atOnce: boolean): boolean {
    const target = this.#target;
    if (!target || target === this.extent) return false;
    const share = atOnce ? 1 : 1 - Math.exp(-elapsed / EASING);
    const next = { ...this.extent };
    for (const key of (Object.keys(next) as (keyof Extent)[])) {
      next[key] += share * (target[key] - next[key]);
    }
    const pixels = Math.abs(next.xMin - target.xMin) + Math.abs(next.xMax - target.xMax);
    const arrived = pixels * this.scaleX < 0.5;
    this.extent = arrived || atOnce ? target : next;
    return this.extent !== target;
  }

  #suits(shown: Extent, needed: Extent) {
    const fillX = (needed.xMax - needed.xMin) / (shown.xMax - shown.xMin);
    const fillY = (needed.yMax - needed.yMin) / (shown.yMax - shown.yMin);
    const fill = this.#equal ? Math.max(fillX, fillY) : Math.min(fillX, fillY);
    return isInside(needed, shown) && fill >= LOOSEST_FIT;
  }

  /** Returns an extent around another one, moved into the limits: of rounded size unless snug, and in the aspect ratio of an equal view. */
  #cover(room: Extent) {
    const { left, right, top, bottom } = this.frame;
    const size = this.#snug ? (needed: number) => needed : niceSize;
    let [width, height] = [room.xMax - room.xMin, room.yMax - room.yMin];
    if (this.#equal) {
      const aspect = (bottom - top) / (right - left);
      width = size(Math.max(width, height / aspect));
      height = width * aspect;
    } else {
      width = size(width);
      height = size(height);
    }
    const limits = this.within ?? { xMin: -Infinity, xMax: Infinity, yMin: -Infinity, yMax: Infinity };
    const x = movedInto((room.xMin + room.xMax) / 2, width, limits.xMin, limits.xMax);
    const y = movedInto((room.yMin + room.yMax) / 2, height, limits.yMin, limits.yMax);
    return extentAround([x - width / 2, y - height / 2, x + width / 2, y + height / 2], 2);
  }
}

/** Returns the middle of a span that is moved between limits; between closer ones it is in their middle. */
function movedInto(middle: number, length: number, from: number, to: number) {
  return to - from > length ? clamp(middle, from + length / 2, to - length / 2) : (from + to) / 2;
}

const isInside = (inner: Extent, outer: Extent) =>
  inner.xMin >= outer.xMin && inner.xMax <= outer.xMax && inner.yMin >= outer.yMin && inner.yMax <= outer.yMax;

function withMargin({ xMin, xMax, yMin, yMax }: Extent): Extent {
  const [x, y] = [MARGIN * (xMax - xMin), MARGIN * (yMax - yMin)];
  return { xMin: xMin - x, xMax: xMax + x, yMin: yMin - y, yMax: yMax + y };
}

/** Returns the next size of the ladder. */
function niceSize(size: number): number {
  const decade = 10 ** Math.floor(Math.log10(size));
  const step = LADDER.find((candidate) => candidate * decade >= size * (1 - 1e-9)) ?? 10;
  return step * decade;
}

/** The extent of nothing, which any point widens. */
const NOWHERE: Readonly<Extent> = { xMin: Infinity, yMin: Infinity, xMax: -Infinity, yMax: -Infinity };

/** Returns the smallest extent around another and points, whose x and y are the first two of each `stride` numbers. */
export function extentAround(numbers: ArrayLike<number>, stride: number, around: Extent = NOWHERE) {
  const box = { ...around };
  for (let i = 0; i < numbers.length; i += stride) {
    box.xMin = Math.min(box.xMin, numbers[i]);
    box.xMax = Math.max(box.xMax, numbers[i]);
    box.yMin = Math.min(box.yMin, numbers[i + 1]);
    box.yMax = Math.max(box.yMax, numbers[i + 1]);
  }
  return box;
}

/** Returns the smallest extent around points, x, y pairs, with a least width and height. */
export function extentOf(points: number[], smallest: number) {
  const box = extentAround(points, 2);
  const growX = Math.max(0, smallest - (box.xMax - box.xMin)) / 2;
  const growY = Math.max(0, smallest - (box.yMax - box.yMin)) / 2;
  return extentAround([box.xMin - growX, box.yMin - growY, box.xMax + growX, box.yMax + growY], 2);
}
