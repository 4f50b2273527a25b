/** The way from one frame to another, through transforms as they come. */

import { bare, planar } from './messages.js';

/** @import { Edge, Quaternion, Reading, Transform, Vector } from './messages.js' */

/** Frames of a way at most: what is longer runs in a circle. */
const LONGEST = 64;

/** Different frames at most: a robot has some dozens. */
const MOST = 10_000;

/** A transform, and whether it never changes. @typedef {Edge & { isStatic: boolean }} Link */

export class Frames {
  /** By their children: each frame has one parent. @type {Map<string, Link>} */
  #links = new Map();
  #parent;
  #child;

  /** @param {{ parent: string, child: string }} ends */
  constructor({ parent, child }) {
    this.#parent = bare(parent);
    this.#child = bare(child);
  }

  /** @returns {string[]} the transforms that came, as "odom to base_link" */
  get known() {
    return [...this.#links.values()].map(({ parent, child }) => `${parent} to ${child}`);
  }

  /**
   * Takes a transform.
   *
   * @param {Edge} edge
   * @param {boolean} isStatic
   * @returns {Reading | undefined} where the child is, if it is the moving transform next to the child that came: others on
   *   the way are as they were told last
   */
  take(edge, isStatic) {
    const before = this.#links.get(edge.child);
    if (!before && this.#links.size >= MOST) return undefined;
    this.#links.set(edge.child, { ...edge, isStatic });
    if (isStatic) return undefined;
    const way = this.#way();
    const moving = way?.findLast((link) => !link.isStatic);
    if (!way || moving?.child !== edge.child) return undefined;
    const { translation, rotation } = way.map(({ transform }) => transform).reduce(after);
    return { stamp: edge.stamp, ...planar(translation, rotation) };
  }

  /** From the parent to the child. @returns {Link[] | undefined} */
  #way() {
    const way = [];
    for (let at = this.#child; at !== this.#parent; ) {
      /** @type {Link | undefined} */
      const link = this.#links.get(at);
      if (!link || way.length === LONGEST) return undefined;
      way.push(link);
      at = link.parent;
    }
    return way.reverse();
  }
}

/** @param {Transform} first @param {Transform} second in its frame @returns {Transform} */
function after(first, second) {
  const { x, y, z } = turned(first.rotation, second.translation);
  const { translation } = first;
  return {
    translation: { x: translation.x + x, y: translation.y + y, z: translation.z + z },
    rotation: product(first.rotation, second.rotation),
  };
}

/** @param {Quaternion} a @param {Quaternion} b @returns {Quaternion} */
function product(a, b) {
  return {
    x: a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
    y: a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
    z: a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w,
    w: a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
  };
}

/** @param {Quaternion} q of length 1 @param {Vector} v @returns {Vector} */
function turned(q, v) {
  return product(product(q, { ...v, w: 0 }), { x: -q.x, y: -q.y, z: -q.z, w: q.w });
}
