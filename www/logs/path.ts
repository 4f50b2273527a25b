/** Arithmetic of logs: paths in the plane, quaternions, and quantiles of long columns. */

import { bisectLeft, mean } from 'd3-array';
import type { Commands, Poses } from './log.ts';

export type PlanarPose = [x: number, y: number, heading: number];

/** Poses by time. `breakIndices` has the indices of poses before which the path is unknown. */
export interface TimedPath { t: number[]; poses: PlanarPose[]; breakIndices: Set<number> }

/** Returns an angle between −π and π. */
export const wrapAngle = (angle: number) => angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));

/** Returns the path of a log: through its poses, or from the origin by its commands. The path has a pose for each `rowsPerPose` rows, and one for the last row. */
export function pathOf(motionData: Poses | Commands, rowsPerPose = 1): TimedPath {
  const { t, breaks: breakIndices } = motionData;
  const timedPath: TimedPath = { t: [], poses: [], breakIndices: new Set() };
  let [x, y, theta, nextBreak] = [0, 0, 0, 0];
  for (let i = 0; i < t.length; i++) {
    if ('v' in motionData && i > 0) {
      const stepSeconds = t[i] - t[i - 1];
      const turnAngle = motionData.omega[i - 1] * stepSeconds;
      x += motionData.v[i - 1] * stepSeconds * Math.cos(theta + turnAngle / 2);
      y += motionData.v[i - 1] * stepSeconds * Math.sin(theta + turnAngle / 2);
      theta += turnAngle;
    }
    if (i % rowsPerPose !== 0 && i < t.length - 1) continue;
    if ('x' in motionData) [x, y, theta] = [motionData.x[i], motionData.y[i], motionData.theta[i]];
    for (; nextBreak < breakIndices.length && breakIndices[nextBreak] <= i; nextBreak++) timedPath.breakIndices.add(timedPath.poses.length);
    timedPath.t.push(t[i]);
    timedPath.poses.push([x, y, theta]);
  }
  return timedPath;
}

/** Returns the interpolated pose of a path at a time. Before the first time of the path it returns the first pose, and after the last time the last pose. */
export function poseAt({ t, poses }: TimedPath, sampleTime: number): PlanarPose {
  const nextIndex = Math.min(Math.max(bisectLeft(t, sampleTime), 1), t.length - 1);
  const blendFraction = Math.min(Math.max((sampleTime - t[nextIndex - 1]) / (t[nextIndex] - t[nextIndex - 1]), 0), 1);
  const [a, b] = [poses[nextIndex - 1], poses[nextIndex]];
  return [a[0] + blendFraction * (b[0] - a[0]), a[1] + blendFraction * (b[1] - a[1]), a[2] + blendFraction * wrapAngle(b[2] - a[2])];
}

export const svgPathDataOf = ({ poses, breakIndices }: TimedPath, toPixel: (pose: PlanarPose) => number[]) =>
  poses.map((pose, i) => `${i === 0 || breakIndices.has(i) ? 'M' : 'L'}${toPixel(pose).map((coordinate) => coordinate.toFixed(1)).join(' ')}`).join('');

/**
 * Rotates and moves a path to minimize its squared distance to a target path. Times of the target are later by `timeOffset`. A path that has no time in common
 * with the target stays as it is.
 */
export function alignPath(timedPath: TimedPath, targetPath: TimedPath, timeOffset = 0): TimedPath {
  const posePairs = timedPath.poses.flatMap((pose, i): [PlanarPose, PlanarPose][] => {
    const sampleTime = timedPath.t[i] + timeOffset;
    return sampleTime >= targetPath.t[0] && sampleTime <= targetPath.t[targetPath.t.length - 1] ? [[pose, poseAt(targetPath, sampleTime)]] : [];
  });
  if (posePairs.length === 0) return timedPath;
  const [ownCentre, targetCentre] = [0, 1].map((pairSide) => [0, 1].map((coordinateIndex) => mean(posePairs, (posePair) => posePair[pairSide][coordinateIndex]) as number));
  let [cos, sin] = [0, 0];
  for (const [[x, y], [u, v]] of posePairs) {
    cos += (x - ownCentre[0]) * (u - targetCentre[0]) + (y - ownCentre[1]) * (v - targetCentre[1]);
    sin += (x - ownCentre[0]) * (v - targetCentre[1]) - (y - ownCentre[1]) * (u - targetCentre[0]);
  }
  const angle = Math.atan2(sin, cos);
  const transformPose = ([x, y, heading]: PlanarPose): PlanarPose => [
    targetCentre[0] + Math.cos(angle) * (x - ownCentre[0]) - Math.sin(angle) * (y - ownCentre[1]),
    targetCentre[1] + Math.sin(angle) * (x - ownCentre[0]) + Math.cos(angle) * (y - ownCentre[1]),
    heading + angle,
  ];
  return { ...timedPath, poses: timedPath.poses.map(transformPose) };
}

/** Minimum distance (m) between points whose distances add up to a path length. Shorter distances are mostly noise of a robot at rest. */
const MIN_STEP_METRES = 0.05;

/** Returns the distance driven (m). The step that leads to each row in `jumpRows` is a jump, and does not count. */
export function distanceOf(motionData: Poses | Commands, jumpRows: number[]): number {
  const { t } = motionData;
  let pathLength = 0;
  if ('v' in motionData) {
    for (let i = 1; i < t.length; i++) pathLength += Math.abs(motionData.v[i - 1]) * (t[i] - t[i - 1]);
    return pathLength;
  }
  const { x, y } = motionData;
  for (let i = 1, lastRow = 0, nextJumpIndex = 0; i < t.length; i++) {
    const stepLength = Math.hypot(x[i] - x[lastRow], y[i] - y[lastRow]);
    const isJump = jumpRows[nextJumpIndex] === i;
    if (isJump) nextJumpIndex += 1;
    else if (stepLength < MIN_STEP_METRES) continue;
    else pathLength += stepLength;
    lastRow = i;
  }
  return pathLength;
}

export type UnitQuaternion = [x: number, y: number, z: number, w: number];

/** Maximum deviation of a quaternion's length from 1. Rounding explains smaller deviations. */
const QUATERNION_LENGTH_TOLERANCE = 0.1;

/** Number of steps per radian to which headings are rounded, so that results are equal in all JavaScript engines. */
const HEADING_STEPS_PER_RADIAN = 1e12;

/** Returns the heading `c` (rotation about Z), and the cosine of the tilt of Z. The heading is undefined if the quaternion is not a rotation, and NaN if the quaternion contains NaN. */
export function rotationOf(qx: number, qy: number, qz: number, qw: number): { c: number | undefined; tiltCosine: number } {
  const tiltCosine = 1 - 2 * (qx * qx + qy * qy);
  if (Math.abs(Math.sqrt(qx * qx + qy * qy + qz * qz + qw * qw) - 1) > QUATERNION_LENGTH_TOLERANCE) return { c: undefined, tiltCosine };
  // The last bits of the arc tangent differ between JavaScript engines. Rounding makes the heading equal in all of them.
  const heading = Math.round(Math.atan2(2 * (qw * qz + qx * qy), qw * qw + qx * qx - qy * qy - qz * qz) * HEADING_STEPS_PER_RADIAN) / HEADING_STEPS_PER_RADIAN;
  return { c: heading, tiltCosine };
}

export const multiplyQuaternions = ([ax, ay, az, aw]: UnitQuaternion, [bx, by, bz, bw]: UnitQuaternion): UnitQuaternion => [
  aw * bx + ax * bw + ay * bz - az * by,
  aw * by - ax * bz + ay * bw + az * bx,
  aw * bz + ax * by - ay * bx + az * bw,
  aw * bw - ax * bx - ay * by - az * bz,
];

/** Maximum size of the sample from which a quantile is computed. */
const MAX_SAMPLED_VALUES = 10_000;

/** Returns a sample of `valueAt` at evenly spaced indices from 0 to `valueCount`. The sample has at most `MAX_SAMPLED_VALUES` values. */
export function sampleEvenly(valueCount: number, valueAt: (i: number) => number): Float64Array {
  const sampleStride = Math.max(1, Math.ceil(valueCount / MAX_SAMPLED_VALUES));
  const sampledValues = new Float64Array(Math.max(0, Math.ceil(valueCount / sampleStride)));
  for (let i = 0; i < sampledValues.length; i++) sampledValues[i] = valueAt(i * sampleStride);
  return sampledValues;
}

/** Returns a quantile of an array, which it sorts in place; NaN for an empty array. */
export const quantileOf = (sampledValues: Float64Array, quantileFraction: number) => sampledValues.sort()[Math.floor(quantileFraction * (sampledValues.length - 1))] ?? NaN;
