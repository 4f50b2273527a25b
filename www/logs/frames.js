/** Chain of transforms between two frames, from transforms as they are recorded. */

import { withoutSlash } from './messages.js';
import { headingOf, isRotation, product, rotated } from './quaternion.ts';

/** @import { Edge, Reading, Transform } from './messages.js' */

/** Most frames of a chain: a longer one is a circle. */
const LONGEST = 64;

/** Most different frames: a robot has some dozens. */
const MOST = 10_000;

/** Transform, and whether it never changes. @typedef {Edge & { isStatic: boolean }} Link */

export class Frames {
  /** Latest transforms by their child frames, each of which has one parent. @type {Map<string, Link>} */
  #links = new Map();
  #parent;
  #child;

  /** @param {{ parent: string, child: string }} ends */
  constructor({ parent, child }) {
    this.#parent = withoutSlash(parent);
    this.#child = withoutSlash(child);
  }

  /** @returns {string[]} all transforms so far, as "odom to base_link" */
  get known() {
    return [...this.#links.values()].map(({ parent, child }) => `${parent} to ${child}`);
  }

  /**
   * Takes a transform.
   *
   * @param {Edge} edge
   * @param {boolean} isStatic
   * @returns {Reading | undefined} pose of the child frame, if this is the moving transform of the chain that is nearest to it
   */
  take(edge, isStatic) {
    if (!this.#links.has(edge.child) && this.#links.size >= MOST) return undefined;
    this.#links.set(edge.child, { ...edge, isStatic });
    if (isStatic) return undefined;
    const chain = this.#chain();
    const moving = chain?.findLast((link) => !link.isStatic);
    if (!chain || moving?.child !== edge.child) return undefined;
    const { translation: { x, y }, rotation: q } = chain.map(({ transform }) => transform).reduce(composed);
    return { stamp: edge.stamp, a: x, b: y, c: headingOf(q.x, q.y, q.z, q.w), isRotation: isRotation(q.x, q.y, q.z, q.w) };
  }

  /** @returns {Link[] | undefined} links from the parent to the child */
  #chain() {
    const chain = [];
    for (let at = this.#child; at !== this.#parent; ) {
      /** @type {Link | undefined} */
      const link = this.#links.get(at);
      if (!link || chain.length === LONGEST) return undefined;
      chain.push(link);
      at = link.parent;
    }
    return chain.reverse();
  }
}

/** @param {Transform} first @param {Transform} second in its frame @returns {Transform} */
function composed({ translation, rotation }, second) {
  const { x, y, z } = rotated(rotation, second.translation);
  return {
    translation: { x: translation.x + x, y: translation.y + y, z: translation.z + z },
    rotation: product(rotation, second.rotation),
  };
}
