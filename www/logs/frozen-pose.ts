/** Removal of frozen poses: a reference that has lost the robot may repeat the last pose while the robot drives. */

import { bisectRight } from 'd3-array';
import type { Commands, Log, Poses } from './log.ts';

/** Margin (s) at both ends of a run of equal poses that is ignored, because the clocks may differ by this much. */
const END_MARGIN_SECONDS = 1;

/** Minimum motion of the odometry during a frozen pose, in metres or radians. Encoders at rest may count a pulse or two. */
const MIN_ODOMETRY_MOTION = 0.05;

/** Removes rows of the reference that repeat a pose while the odometry moves on. Both logs must have the same start time. */
export function withoutFrozenPoses(reference: Log, odometry: Log): Log {
  const { t, x, y, theta, breaks: knownBreaks } = reference.data as Poses;
  const odometryLengthAt = pathLengthAt(odometry.data);
  const isKept = new Uint8Array(t.length).fill(1);
  const breaks = new Set(knownBreaks);
  for (let from = 0, to; from < t.length; from = to) {
    for (to = from + 1; to < t.length && x[to] === x[from] && y[to] === y[from] && theta[to] === theta[from]; ) to += 1;
    const [start, end] = [t[from] + END_MARGIN_SECONDS, t[to - 1] - END_MARGIN_SECONDS];
    if (!(end > start && odometryLengthAt(end) - odometryLengthAt(start) > MIN_ODOMETRY_MOTION)) continue;
    isKept.fill(0, from + 1, to);
    breaks.add(to);
  }
  if (!isKept.includes(0)) return reference;
  const isKeptRow = (_: unknown, i: number) => isKept[i] === 1;
  // Index of each row after the removal of rows.
  const newIndices = new Uint32Array(t.length + 1);
  for (let i = 0; i < t.length; i++) newIndices[i + 1] = newIndices[i] + isKept[i];
  const keptCount = newIndices[t.length];
  const newBreaks = new Set([...breaks].map((row) => newIndices[row]));
  return {
    ...reference,
    data: {
      t: t.filter(isKeptRow),
      x: x.filter(isKeptRow),
      y: y.filter(isKeptRow),
      theta: theta.filter(isKeptRow),
      breaks: Uint32Array.from(newBreaks).filter((row) => row < keptCount).sort(),
    },
    summary: { ...reference.summary, used: keptCount, dropped: { ...reference.summary.dropped, held: { count: t.length - keptCount, first: 0 } } },
  };
}

/** Returns a function of time: the path length of the robot up to then, with metres and radians added up. */
function pathLengthAt(data: Poses | Commands): (time: number) => number {
  const { t } = data;
  const lengths = new Float64Array(t.length);
  const stepLength = (i: number) => {
    if ('v' in data) return (Math.abs(data.v[i - 1]) + Math.abs(data.omega[i - 1])) * (t[i] - t[i - 1]);
    const { x, y, theta } = data;
    return Math.hypot(x[i] - x[i - 1], y[i] - y[i - 1]) + 2 * Math.abs(Math.sin((theta[i] - theta[i - 1]) / 2));
  };
  for (let i = 1; i < t.length; i++) lengths[i] = lengths[i - 1] + stepLength(i);
  return (time) => lengths[Math.max(bisectRight(t, time) - 1, 0)];
}
