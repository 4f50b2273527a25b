/** Chains of transforms between frames. */

import { bisector, sort } from 'd3-array';
import { formatFrames, type FramePair } from './log.ts';
import { rowOfPose, removeLeadingSlash, type StampedTransform, type FrameTransform } from './messages.ts';
import { multiplyQuaternions } from './path.ts';
import type { LogSample } from './rows.ts';

/** Minimum distance (m) that a frame moves if it counts as travelling. The frame of a joint only turns, and the frame of a suspension moves less. */
const MIN_TRAVEL_DISTANCE = 0.05;

/** Pattern of usual names of a robot's base frame. A base frame counts as travelling if it is fixed to a frame that travels. */
const BASE_FRAME = /base|body|chassis|robot/i;

/** Transform with the time of recording (s) and the number of its message. */
interface RecordedTransform extends StampedTransform { recordTime: number; messageNumber: number }

const recordTimeBisector = bisector(({ recordTime }: RecordedTransform) => recordTime);

/** Transforms between a frame and its parent. */
interface FrameLink extends FramePair {
  isStatic: boolean;
  /** First recorded transform between the two frames. */
  firstTransform: FrameTransform;
  hasChanged: boolean;
  /** Largest distance (m) of the child frame from its first position, in the frame of the parent. */
  maxDistance: number;
  /** Recorded transforms in the order of their messages. The list is filled only if poses are read. */
  recordedTransforms: RecordedTransform[];
}

/**
 * Graph of transforms between frames. A frame may have several parents, for example the map and the odometry frame. Given two end frames, the graph also
 * computes their relative poses, from the transforms on the chain between them.
 */
export class FrameTree {
  #linkByName = new Map<string, FrameLink>();
  readonly #chainEnds: FramePair | undefined;
  /** Links of the chain between the two end frames, in order; empty until transforms connect the end frames. */
  #chainLinks: FrameLink[] = [];

  constructor(chainEnds?: FramePair) {
    this.#chainEnds = chainEnds && { parent: removeLeadingSlash(chainEnds.parent), child: removeLeadingSlash(chainEnds.child) };
  }

  /** Adds a transform to the link between its frames. */
  addTransform(stampedTransform: StampedTransform, isStatic: boolean, recordTime: number, messageNumber: number): void {
    const { parent: parentFrame, child: childFrame, frameTransform } = stampedTransform;
    const linkName = formatFrames({ parent: parentFrame, child: childFrame });
    const frameLink = this.#linkByName.get(linkName) ?? { parent: parentFrame, child: childFrame, isStatic, firstTransform: frameTransform, hasChanged: false, maxDistance: 0, recordedTransforms: [] };
    this.#linkByName.set(linkName, frameLink);
    frameLink.maxDistance = Math.max(frameLink.maxDistance, Math.hypot(frameTransform[0] - frameLink.firstTransform[0], frameTransform[1] - frameLink.firstTransform[1]));
    frameLink.hasChanged ||= frameTransform.some((transformValue, i) => transformValue !== frameLink.firstTransform[i]);
    if (!this.#chainEnds) return;
    if (!this.isConnected || this.#chainLinks.includes(frameLink)) frameLink.recordedTransforms.push({ ...stampedTransform, recordTime, messageNumber });
    if (!this.isConnected) this.#chainLinks = this.#findChain(this.#chainEnds) ?? [];
  }

  get frameLinks(): FrameLink[] {
    return [...this.#linkByName.values()];
  }

  get isConnected(): boolean {
    return this.#chainLinks.length > 0;
  }

  #findLinksTo(childFrame: string): FrameLink[] {
    return this.frameLinks.filter((frameLink) => frameLink.child === childFrame);
  }

  /** Returns the links from one frame to another, or undefined if they are not connected. */
  #findChain({ parent: parentFrame, child: childFrame }: FramePair, visitedFrames = new Set<string>()): FrameLink[] | undefined {
    if (visitedFrames.has(childFrame)) return undefined;
    visitedFrames.add(childFrame);
    for (const frameLink of this.#findLinksTo(childFrame)) {
      const linkChain = frameLink.parent === parentFrame ? [] : this.#findChain({ parent: parentFrame, child: frameLink.parent }, visitedFrames);
      if (linkChain) return [...linkChain, frameLink];
    }
    return undefined;
  }

  /**
   * Returns the pairs of frames, parent and child, between which the transform may be the pose of a robot. The child is a frame that travels, or a base
   * frame that is fixed to such a frame. If no frame travels, all frames whose transform is not static count as travelling.
   */
  findPoseFrames(): FramePair[] {
    const { frameLinks } = this;
    const movingFrameLinks = frameLinks.filter(({ isStatic, maxDistance }) => !isStatic && maxDistance > MIN_TRAVEL_DISTANCE);
    const movingFrames = new Set((movingFrameLinks.length ? movingFrameLinks : frameLinks.filter(({ isStatic }) => !isStatic)).map(({ child: childFrame }) => childFrame));
    const childFrames = [...new Set(frameLinks.map(({ child: childFrame }) => childFrame))];
    return childFrames.flatMap((childFrame) => {
      const ancestorFrames = this.#ancestorsOf(childFrame);
      const isMoving = movingFrames.has(childFrame);
      const hasMovingDescendant = isMoving && childFrames.some((otherChild) => otherChild !== childFrame && movingFrames.has(otherChild) && this.#ancestorsOf(otherChild).includes(childFrame));
      // Example: the chain odom → base_footprint → base_link, in which only base_footprint moves. The pose of base_link is relative to odom: the moving
      // frame, and frames between it and the child, are skipped as parents.
      const skipCount = isMoving || !BASE_FRAME.test(childFrame) ? 0 : ancestorFrames.findIndex((frameName) => movingFrames.has(frameName)) + 1;
      return hasMovingDescendant || (!isMoving && skipCount === 0) ? [] : ancestorFrames.slice(skipCount).map((parentFrame) => ({ parent: parentFrame, child: childFrame }));
    });
  }

  /** Returns the ancestors of a frame: its parent, the parent of its parent, and so on. */
  #ancestorsOf(frameName: string): string[] {
    const ancestorFrames = new Set<string>([frameName]);
    for (const ancestorFrame of ancestorFrames) for (const { parent: parentFrame } of this.#findLinksTo(ancestorFrame)) ancestorFrames.add(parentFrame);
    return [...ancestorFrames].slice(1);
  }

  /**
   * Calls `onPose` for each message of one link: the changing link that is nearest to the child. The other links contribute their latest transforms. A
   * transform that never changes also holds before its first message. Returns false if all transforms are constant.
   */
  readPoses(onPose: (poseSample: LogSample, recordedTransform: RecordedTransform) => void): boolean {
    // A static transform that is published again with other values does not count as motion.
    const nearestMovingLink = this.#chainLinks.findLast(({ isStatic, hasChanged }) => !isStatic && hasChanged);
    const samplesByLink = new Map(this.#chainLinks.map((frameLink) => [frameLink, sort(frameLink.recordedTransforms, ({ recordTime }) => recordTime)]));
    const transformAt = (frameLink: FrameLink, recordTime: number) => {
      const recordedTransforms = samplesByLink.get(frameLink) ?? [];
      return recordedTransforms[Math.max(recordTimeBisector.right(recordedTransforms, recordTime) - 1, frameLink.isStatic || !frameLink.hasChanged ? 0 : -1)]?.frameTransform;
    };
    for (const recordedTransform of (nearestMovingLink && samplesByLink.get(nearestMovingLink)) ?? []) {
      const chainTransforms = this.#chainLinks.map((frameLink) => (frameLink === nearestMovingLink ? recordedTransform.frameTransform : transformAt(frameLink, recordedTransform.recordTime)));
      if (chainTransforms.every((transform) => transform !== undefined)) onPose(rowOfPose(recordedTransform.stampTime, chainTransforms.reduce(composeTransforms)), recordedTransform);
    }
    return nearestMovingLink !== undefined;
  }
}

/** Returns the composition of two transforms. The second transform is relative to the frame that the first one defines. */
function composeTransforms([x, y, z, ...rotationOfFirst]: FrameTransform, [x2, y2, z2, ...rotationOfSecond]: FrameTransform): FrameTransform {
  const [qx, qy, qz, qw] = rotationOfFirst;
  const [dx, dy, dz] = multiplyQuaternions(multiplyQuaternions(rotationOfFirst, [x2, y2, z2, 0]), [-qx, -qy, -qz, qw]);
  return [x + dx, y + dy, z + dz, ...multiplyQuaternions(rotationOfFirst, rotationOfSecond)];
}
