/** Chains of transforms between frames. */

import { bisector, sort } from 'd3-array';
import { formatFrames, type FramePair } from './log.ts';
import { rowOfPose, withoutSlash, type StampedTransform, type Transform } from './messages.ts';
import { multiplyQuaternions } from './path.ts';
import type { Sample } from './rows.ts';

/** Minimum distance (m) that a frame moves if it counts as travelling. The frame of a joint only turns, and the frame of a suspension moves less. */
const MIN_TRAVEL = 0.05;

/** Pattern of usual names of a robot's base frame. A base frame counts as travelling if it is fixed to a frame that travels. */
const BASE_FRAME = /base|body|chassis|robot/i;

/** Transform with the time of recording (s) and the number of its message. */
interface RecordedTransform extends StampedTransform { recordTime: number; messageNumber: number }

const byRecordTime = bisector(({ recordTime }: RecordedTransform) => recordTime);

/** Transforms between a frame and its parent. */
interface FrameLink extends FramePair {
  isStatic: boolean;
  /** First recorded transform between the two frames. */
  firstTransform: Transform;
  hasChanged: boolean;
  /** Largest distance (m) of the child frame from its first position, in the frame of the parent. */
  maxDistance: number;
  /** Recorded transforms in the order of their messages. The list is filled only if poses are read. */
  samples: RecordedTransform[];
}

/**
 * Graph of transforms between frames. A frame may have several parents, for example the map and the odometry frame. Given two end frames, the graph also
 * computes their relative poses, from the transforms on the chain between them.
 */
export class FrameTree {
  #links = new Map<string, FrameLink>();
  readonly #chainEnds: FramePair | undefined;
  /** Links of the chain between the two end frames, in order; empty until transforms connect the end frames. */
  #chainLinks: FrameLink[] = [];

  constructor(chainEnds?: FramePair) {
    this.#chainEnds = chainEnds && { parent: withoutSlash(chainEnds.parent), child: withoutSlash(chainEnds.child) };
  }

  /** Adds a transform to the link between its frames. */
  addTransform(stampedTransform: StampedTransform, isStatic: boolean, recordTime: number, messageNumber: number): void {
    const { parent, child, transform } = stampedTransform;
    const name = formatFrames({ parent, child });
    const link = this.#links.get(name) ?? { parent, child, isStatic, firstTransform: transform, hasChanged: false, maxDistance: 0, samples: [] };
    this.#links.set(name, link);
    link.maxDistance = Math.max(link.maxDistance, Math.hypot(transform[0] - link.firstTransform[0], transform[1] - link.firstTransform[1]));
    link.hasChanged ||= transform.some((transformValue, i) => transformValue !== link.firstTransform[i]);
    if (!this.#chainEnds) return;
    if (!this.isConnected || this.#chainLinks.includes(link)) link.samples.push({ ...stampedTransform, recordTime, messageNumber });
    if (!this.isConnected) this.#chainLinks = this.#findChain(this.#chainEnds) ?? [];
  }

  get links(): FrameLink[] {
    return [...this.#links.values()];
  }

  get isConnected(): boolean {
    return this.#chainLinks.length > 0;
  }

  #linksTo(child: string): FrameLink[] {
    return this.links.filter((link) => link.child === child);
  }

  /** Returns the links from one frame to another, or undefined if they are not connected. */
  #findChain({ parent, child }: FramePair, visitedFrames = new Set<string>()): FrameLink[] | undefined {
    if (visitedFrames.has(child)) return undefined;
    visitedFrames.add(child);
    for (const link of this.#linksTo(child)) {
      const chain = link.parent === parent ? [] : this.#findChain({ parent, child: link.parent }, visitedFrames);
      if (chain) return [...chain, link];
    }
    return undefined;
  }

  /**
   * Returns the pairs of frames, parent and child, between which the transform may be the pose of a robot. The child is a frame that travels, or a base
   * frame that is fixed to such a frame. If no frame travels, all frames whose transform is not static count as travelling.
   */
  findPoseFrames(): FramePair[] {
    const { links } = this;
    const travellingLinks = links.filter(({ isStatic, maxDistance }) => !isStatic && maxDistance > MIN_TRAVEL);
    const movingFrames = new Set((travellingLinks.length ? travellingLinks : links.filter(({ isStatic }) => !isStatic)).map(({ child }) => child));
    const children = [...new Set(links.map(({ child }) => child))];
    return children.flatMap((child) => {
      const ancestors = this.#ancestorsOf(child);
      const isMoving = movingFrames.has(child);
      const hasMovingDescendant = isMoving && children.some((otherChild) => otherChild !== child && movingFrames.has(otherChild) && this.#ancestorsOf(otherChild).includes(child));
      // Example: the chain odom → base_footprint → base_link, in which only base_footprint moves. The pose of base_link is relative to odom: the moving
      // frame, and frames between it and the child, are skipped as parents.
      const skipCount = isMoving || !BASE_FRAME.test(child) ? 0 : ancestors.findIndex((frame) => movingFrames.has(frame)) + 1;
      return hasMovingDescendant || (!isMoving && skipCount === 0) ? [] : ancestors.slice(skipCount).map((parent) => ({ parent, child }));
    });
  }

  /** Returns the ancestors of a frame: its parent, the parent of its parent, and so on. */
  #ancestorsOf(frame: string): string[] {
    const ancestorFrames = new Set<string>([frame]);
    for (const ancestor of ancestorFrames) for (const { parent } of this.#linksTo(ancestor)) ancestorFrames.add(parent);
    return [...ancestorFrames].slice(1);
  }

  /**
   * Calls `onPose` for each message of one link: the changing link that is nearest to the child. The other links contribute their latest transforms. A
   * transform that never changes also holds before its first message. Returns false if all transforms are constant.
   */
  readPoses(onPose: (poseSample: Sample, recordedTransform: RecordedTransform) => void): boolean {
    // A static transform that is published again with other values does not count as motion.
    const nearestMovingLink = this.#chainLinks.findLast(({ isStatic, hasChanged }) => !isStatic && hasChanged);
    const samplesByLink = new Map(this.#chainLinks.map((link) => [link, sort(link.samples, ({ recordTime }) => recordTime)]));
    const transformAt = (link: FrameLink, time: number) => {
      const samples = samplesByLink.get(link) ?? [];
      return samples[Math.max(byRecordTime.right(samples, time) - 1, link.isStatic || !link.hasChanged ? 0 : -1)]?.transform;
    };
    for (const sample of (nearestMovingLink && samplesByLink.get(nearestMovingLink)) ?? []) {
      const transforms = this.#chainLinks.map((link) => (link === nearestMovingLink ? sample.transform : transformAt(link, sample.recordTime)));
      if (transforms.every((transform) => transform !== undefined)) onPose(rowOfPose(sample.time, transforms.reduce(composeTransforms)), sample);
    }
    return nearestMovingLink !== undefined;
  }
}

/** Returns the composition of two transforms. The second transform is relative to the frame that the first one defines. */
function composeTransforms([x, y, z, ...rotation]: Transform, [x2, y2, z2, ...rotation2]: Transform): Transform {
  const [qx, qy, qz, qw] = rotation;
  const [dx, dy, dz] = multiplyQuaternions(multiplyQuaternions(rotation, [x2, y2, z2, 0]), [-qx, -qy, -qz, qw]);
  return [x + dx, y + dy, z + dz, ...multiplyQuaternions(rotation, rotation2)];
}
