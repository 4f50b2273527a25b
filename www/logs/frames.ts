/** Chains of transforms between frames. */

import type { Message } from './formats/container.ts';
import { framesText, type Frames } from './log.ts';
import { sampleOfPose, withoutSlash, type Edge, type Sample, type Transform } from './messages.ts';
import { hamiltonProduct, rotateVector } from './quaternion.ts';

/** Maximum number of links between frames: a robot has some dozens. */
const MAX_LINKS = 10_000;

/** Minimum motion (m) of a frame that counts as travelling. Joints only turn, and suspensions move less. */
const MIN_TRAVEL = 0.05;

/** Usual names of a robot's own frame, which may be fixed to a frame that travels. */
const BASE_FRAME = /base|body|chassis|robot/i;

interface FrameLink extends Frames {
  isStatic: boolean;
  origin: Transform;
  /** Largest distance from the origin. */
  travelled: number;
}

/** Links between frames. A frame may have several parents, for example the map and the odometry frame. */
export class FrameTree {
  #links = new Map<string, FrameLink>();
  #linksByChild = new Map<string, FrameLink[]>();

  take({ parent, child, transform }: Edge, isStatic: boolean): void {
    const link = this.#links.get(framesText({ parent, child }));
    if (link) {
      link.travelled = Math.max(link.travelled, Math.hypot(transform[0] - link.origin[0], transform[1] - link.origin[1]));
    } else if (this.#links.size < MAX_LINKS) {
      const newLink = { parent, child, isStatic, origin: transform, travelled: 0 };
      this.#links.set(framesText(newLink), newLink);
      this.#linksByChild.set(child, [...(this.#linksByChild.get(child) ?? []), newLink]);
    }
  }

  get links(): Frames[] {
    return [...this.#links.values()].map(({ parent, child }) => ({ parent, child }));
  }

  /** Returns the links from one frame to another, or undefined if they are not connected. */
  chain({ parent, child }: Frames, seen = new Set<string>()): Frames[] | undefined {
    if (seen.has(child)) return undefined;
    seen.add(child);
    for (const link of this.#linksByChild.get(child) ?? []) {
      const chain = link.parent === parent ? [] : this.chain({ parent, child: link.parent }, seen);
      if (chain) return [...chain, link];
    }
    return undefined;
  }

  /**
   * Returns the ends of chains that may be poses of a robot: they end at a frame that travels, or at a base that is fixed to it. If
   * none travels, all frames that are published again and again count as travelling.
   */
  candidates(): Frames[] {
    const links = [...this.#links.values()];
    const movedLinks = links.filter(({ isStatic, travelled }) => !isStatic && travelled > MIN_TRAVEL);
    const movers = new Set((movedLinks.length ? movedLinks : links.filter(({ isStatic }) => !isStatic)).map(({ child }) => child));
    const children = [...new Set(links.map(({ child }) => child))];
    return children.flatMap((child) => {
      const ancestors = this.#ancestors(child);
      const isMoving = movers.has(child);
      const isInner = isMoving && children.some((other) => other !== child && movers.has(other) && this.#ancestors(other).includes(child));
      // Number of ancestors of a base up to and with the nearest moving one: they move with the base, and so are no parents of its poses.
      const skipCount = isMoving || !BASE_FRAME.test(child) ? 0 : ancestors.findIndex((frame) => movers.has(frame)) + 1;
      return isInner || (!isMoving && skipCount === 0) ? [] : ancestors.slice(skipCount).map((parent) => ({ parent, child }));
    });
  }

  /** Returns the frames above a frame, the nearest first. */
  #ancestors(frame: string): string[] {
    const ancestorFrames = new Set<string>([frame]);
    for (const frame of ancestorFrames) for (const { parent } of this.#linksByChild.get(frame) ?? []) ancestorFrames.add(parent);
    return [...ancestorFrames].slice(1);
  }
}

/** Transform of one link of a chain, with its message. */
interface TimedEdge {
  link: string;
  isStatic: boolean;
  edge: Edge;
  message: Pick<Message, 'channel' | 'seconds' | 'nanoseconds'>;
  number: number;
}

/** Poses of a frame in another, from the transforms between them. */
export class Chain {
  readonly tree = new FrameTree();
  readonly #endFrames: Frames;
  /** Names of the links, from the first to the last. */
  #links: string[] = [];
  /** Transforms in the order of their messages. They are of all links until the links of the chain are known. */
  #samples: TimedEdge[] = [];

  constructor({ parent, child }: Frames) {
    this.#endFrames = { parent: withoutSlash(parent), child: withoutSlash(child) };
  }

  /** Adds a transform. Static ones have to come first, because they hold at all times. */
  take(edge: Edge, isStatic: boolean, { channel, seconds, nanoseconds }: Message, number: number): void {
    this.tree.take(edge, isStatic);
    const sample = { link: framesText(edge), isStatic, edge, message: { channel, seconds, nanoseconds }, number };
    if (!this.isConnected || this.#links.includes(sample.link)) this.#samples.push(sample);
    if (this.isConnected) return;
    this.#links = (this.tree.chain(this.#endFrames) ?? []).map(framesText);
    if (this.isConnected) this.#samples = this.#samples.filter(({ link }) => this.#links.includes(link));
  }

  get isConnected(): boolean {
    return this.#links.length > 0;
  }

  /**
   * Passes on the poses at the times of the moving transform that is nearest to the child, with the latest transforms of all other links. A
   * transform that never changes also holds before its first message.
   *
   * @returns false if no transform ever changes
   */
  poses(onPose: (reading: Sample, sample: TimedEdge) => void): boolean {
    const transforms = new Map<string, Transform>();
    const movers = new Set<string>();
    const unknownLinks = new Set<string>();
    for (const { link, isStatic, edge: { transform } } of this.#samples) {
      const firstTransform = transforms.get(link);
      if (!firstTransform) transforms.set(link, transform);
      else if (transform.some((value, i) => value !== firstTransform[i])) {
        movers.add(link);
        if (!isStatic) unknownLinks.add(link);
      }
    }
    // A static transform may be published again with other values. That is no motion, unless no other transform changes.
    const nearestMovingLink = this.#links.findLast((link) => unknownLinks.has(link)) ?? this.#links.findLast((link) => movers.has(link));
    if (nearestMovingLink === undefined) return false;
    const timeOf = ({ message: { seconds, nanoseconds } }: TimedEdge) => seconds + nanoseconds / 1e9;
    let lastEdge: TimedEdge | undefined;
    for (const sample of this.#samples.toSorted((one, other) => timeOf(one) - timeOf(other))) {
      transforms.set(sample.link, sample.edge.transform);
      unknownLinks.delete(sample.link);
      if (sample.link === nearestMovingLink) lastEdge = sample;
      if (!lastEdge || unknownLinks.size > 0) continue;
      onPose(sampleOfPose(lastEdge.edge, this.#links.map((link) => transforms.get(link) as Transform).reduce(composeTransforms)), lastEdge);
      lastEdge = undefined;
    }
    return true;
  }
}

/** Returns the composition of two transforms, of which the second is given in the frame of the first. */
function composeTransforms([x, y, z, qx, qy, qz, qw]: Transform, [x2, y2, z2, qx2, qy2, qz2, qw2]: Transform): Transform {
  const rotation = { x: qx, y: qy, z: qz, w: qw };
  const offset = rotateVector(rotation, { x: x2, y: y2, z: z2 });
  const rotationProduct = hamiltonProduct(rotation, { x: qx2, y: qy2, z: qz2, w: qw2 });
  return [x + offset.x, y + offset.y, z + offset.z, rotationProduct.x, rotationProduct.y, rotationProduct.z, rotationProduct.w];
}
