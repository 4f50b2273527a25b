/** Chains of transforms between frames. */

import type { Message } from './formats/container.ts';
import { framesText, type FramePair } from './log.ts';
import { sampleOfPose, withoutSlash, type StampedTransform, type Transform } from './messages.ts';
import { hamiltonProduct } from './path.ts';
import type { Sample } from './rows.ts';

/** Minimum motion (m) of a frame that counts as travelling. Frames of joints only turn, and those of suspensions move less. */
const MIN_TRAVEL = 0.05;

/** Usual names of a robot's base frame, which may be fixed to a frame that travels. */
const BASE_FRAME = /base|body|chassis|robot/i;

/** Transform between a frame and its parent. */
interface FrameLink extends FramePair {
  isStatic: boolean;
  /** First transform. */
  origin: Transform;
  /** Largest distance (m) from the first position. */
  maxDistance: number;
}

/** Graph of transforms between frames. A frame may have several parents, for example the map and the odometry frame. */
export class FrameTree {
  #links = new Map<string, FrameLink>();

  add({ parent, child, transform }: StampedTransform, isStatic: boolean): void {
    const link = this.#links.get(framesText({ parent, child }));
    if (link) link.maxDistance = Math.max(link.maxDistance, Math.hypot(transform[0] - link.origin[0], transform[1] - link.origin[1]));
    else this.#links.set(framesText({ parent, child }), { parent, child, isStatic, origin: transform, maxDistance: 0 });
  }

  get links(): FrameLink[] {
    return [...this.#links.values()];
  }

  #linksTo(child: string): FrameLink[] {
    return this.links.filter((link) => link.child === child);
  }

  /** Returns the links from one frame to another, or undefined if they are not connected. */
  findChain({ parent, child }: FramePair, seen = new Set<string>()): FramePair[] | undefined {
    if (seen.has(child)) return undefined;
    seen.add(child);
    for (const link of this.#linksTo(child)) {
      const chain = link.parent === parent ? [] : this.findChain({ parent, child: link.parent }, seen);
      if (chain) return [...chain, link];
    }
    return undefined;
  }

  /**
   * Returns the pairs of frames between which the transform may be the pose of a robot. The child travels, or is a base fixed to a frame that
   * travels. If no frame travels, all frames whose transform is not static count as travelling.
   */
  findPoseFrames(): FramePair[] {
    const { links } = this;
    const travellingLinks = links.filter(({ isStatic, maxDistance }) => !isStatic && maxDistance > MIN_TRAVEL);
    const movingFrames = new Set((travellingLinks.length ? travellingLinks : links.filter(({ isStatic }) => !isStatic)).map(({ child }) => child));
    const children = [...new Set(links.map(({ child }) => child))];
    return children.flatMap((child) => {
      const ancestors = this.#ancestors(child);
      const isMoving = movingFrames.has(child);
      const hasMovingDescendant = isMoving && children.some((other) => other !== child && movingFrames.has(other) && this.#ancestors(other).includes(child));
      // In odom → base_footprint → base_link only base_footprint may move. Its pose in odom is then that of base_link: frames up to the moving one
      // are no parents.
      const skipCount = isMoving || !BASE_FRAME.test(child) ? 0 : ancestors.findIndex((frame) => movingFrames.has(frame)) + 1;
      return hasMovingDescendant || (!isMoving && skipCount === 0) ? [] : ancestors.slice(skipCount).map((parent) => ({ parent, child }));
    });
  }

  /** Returns the parent of a frame, the parent of that frame and so on. */
  #ancestors(frame: string): string[] {
    const ancestorFrames = new Set<string>([frame]);
    for (const ancestor of ancestorFrames) for (const { parent } of this.#linksTo(ancestor)) ancestorFrames.add(parent);
    return [...ancestorFrames].slice(1);
  }
}

/** Transform of one link of a chain, with the time of recording (s) and the number of its message. */
interface RecordedTransform { link: string; isStatic: boolean; stampedTransform: StampedTransform; recordTime: number; number: number }

/** Graph that also composes the poses of one frame relative to another one, by the transforms on the chain between them. */
export class Chain extends FrameTree {
  readonly #endFrames: FramePair;
  /** Names of the links of the chain, from the first to the last. */
  #chainLinks: string[] = [];
  /** Transforms in the order of their messages. They are of all links until the links of the chain are known. */
  #samples: RecordedTransform[] = [];

  constructor({ parent, child }: FramePair) {
    super();
    this.#endFrames = { parent: withoutSlash(parent), child: withoutSlash(child) };
  }

  /** Adds a transform. Static transforms must come first, because they hold at all times. */
  addSample(stampedTransform: StampedTransform, isStatic: boolean, { time: recordTime }: Message, number: number): void {
    this.add(stampedTransform, isStatic);
    const recordedTransform = { link: framesText(stampedTransform), isStatic, stampedTransform, recordTime, number };
    if (!this.isConnected || this.#chainLinks.includes(recordedTransform.link)) this.#samples.push(recordedTransform);
    if (this.isConnected) return;
    this.#chainLinks = (this.findChain(this.#endFrames) ?? []).map(framesText);
    if (this.isConnected) this.#samples = this.#samples.filter(({ link }) => this.#chainLinks.includes(link));
  }

  get isConnected(): boolean {
    return this.#chainLinks.length > 0;
  }

  /**
   * Passes on a pose for each message of the changing transform that is nearest to the child. All other links have their latest transforms. A
   * transform that never changes also holds before its first message. Returns false if no transform ever changes.
   */
  poses(onPose: (reading: Sample, recordedTransform: RecordedTransform) => void): boolean {
    const transforms = new Map<string, Transform>();
    const unseenLinks = new Set<string>();
    for (const { link, isStatic, stampedTransform: { transform } } of this.#samples) {
      const firstTransform = transforms.get(link);
      if (!firstTransform) transforms.set(link, transform);
      // A static transform may be published again with other values, which is no motion.
      else if (!isStatic && transform.some((value, i) => value !== firstTransform[i])) unseenLinks.add(link);
    }
    const nearestMovingLink = this.#chainLinks.findLast((link) => unseenLinks.has(link));
    if (nearestMovingLink === undefined) return false;
    let pendingTransform: RecordedTransform | undefined;
    for (const recordedTransform of this.#samples.toSorted((a, b) => a.recordTime - b.recordTime)) {
      transforms.set(recordedTransform.link, recordedTransform.stampedTransform.transform);
      unseenLinks.delete(recordedTransform.link);
      if (recordedTransform.link === nearestMovingLink) pendingTransform = recordedTransform;
      if (!pendingTransform || unseenLinks.size > 0) continue;
      onPose(sampleOfPose(pendingTransform.stampedTransform.time, this.#chainLinks.map((link) => transforms.get(link) as Transform).reduce(composeTransforms)), pendingTransform);
      pendingTransform = undefined;
    }
    return true;
  }
}

/** Returns the composition of two transforms: the second one is relative to the frame of the first. */
function composeTransforms([x, y, z, ...rotation]: Transform, [x2, y2, z2, ...rotation2]: Transform): Transform {
  const [qx, qy, qz, qw] = rotation;
  const [dx, dy, dz] = hamiltonProduct(hamiltonProduct(rotation, [x2, y2, z2, 0]), [-qx, -qy, -qz, qw]);
  return [x + dx, y + dy, z + dz, ...hamiltonProduct(rotation, rotation2)];
}
