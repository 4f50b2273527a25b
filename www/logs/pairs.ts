/** Pairs of logs of one drive. */

import type { CalibrationLog } from '../types.d.ts';
import { isLocalizer, roleByName } from './candidates.ts';
import { correctionOf, questionOf } from './corrections.ts';
import { LogError } from './log-error.ts';
import { framesText, type Log, type Note, type Poses, type Role, type Warning } from './log.ts';
import { pathOf, poseAt, wrapAngle } from './path.ts';

/** Two logs of one drive, with times after the same start. */
export interface Drive { odometry: Log; reference: Log }

/** Minimum overlap in time of two logs of one drive, as a fraction of the shorter log's duration. */
const MIN_OVERLAP = 0.5;

/** Margin (s) at both ends of a run of equal poses that is ignored, because the clocks may differ by this much. */
const END_MARGIN_SECONDS = 1;

/** Minimum motion of the odometry during a frozen pose, metres and radians added up. Encoders at rest may count a pulse or two. */
const MIN_ODOMETRY_MOTION = 0.05;

const timeSpanOf = ({ start, data: { t } }: Log): [number, number] => [start + t[0], start + t[t.length - 1]];

const timeSpanText = (log: Log) => timeSpanOf(log).map((time) => `${time.toFixed(2)} s`).join(' to ');

/** Returns the duration of the overlap of two logs; negative if there is a gap between them. */
function overlapSeconds(one: Log, other: Log): number {
  const [[a, b], [c, d]] = [timeSpanOf(one), timeSpanOf(other)];
  return Math.min(b, d) - Math.max(a, c);
}

/** Returns the part of a file's name that both files of a drive share: without its extension and words for a role. */
const fileStem = (name: string) => name.toLowerCase().replace(/\.\w+$/, '').replace(/odom(etry)?|wheels?|encoders?|cmd(_vel)?|(ground)?[_-]?truth|gt|reference|ref|mocap|vicon|optitrack|poses?/g, '').replace(/[^a-z0-9]+/g, '');

/** Pairs logs of several drives: by their times, by the names of their files, or in their order. */
export function matchLogs(odometry: Log[], reference: Log[]): [Log, Log][] {
  const overlapsMostly = (one: Log, other: Log) => overlapSeconds(one, other) > MIN_OVERLAP * Math.min(one.summary.seconds, other.summary.seconds);
  const hasSameStem = (one: Log, other: Log) => fileStem(one.name) === fileStem(other.name);
  for (const isMatch of [overlapsMostly, hasSameStem]) {
    const partnersOfEach = odometry.map((one) => reference.filter((other) => isMatch(one, other)));
    if (partnersOfEach.every(({ length }) => length === 1) && new Set(partnersOfEach.flat()).size === reference.length) return odometry.map((one, i) => [one, partnersOfEach[i][0]]);
  }
  return odometry.map((one, i) => [one, reference[i]]);
}

/** Pairs two logs of one drive, whose times are after one start. Throws a LogError if they do not fit, or if one needs a correction. */
export function pairLogs(odometry: Log, reference: Log): Drive {
  const referencePlace = { file: reference.name };
  if (reference.kind === 'commands') throw new LogError(referencePlace, (texts) => texts.noColumns('poses', 't, v, omega'));
  const { frames } = reference.summary;
  if (frames?.parent === 'odom') throw new LogError(referencePlace, (texts) => texts.ownReference(framesText(frames)));
  const brokenReference = breakFrozenPoses(reference, odometry);
  if (brokenReference.summary.used < 2) throw new LogError(referencePlace, (texts) => texts.held);
  const logs = { odometry, reference: brokenReference };
  const correction = correctionOf(odometry, brokenReference);
  if (correction) {
    const [log, otherLog] = correction.at === 'odometry' ? [odometry, reference] : [reference, odometry];
    throw new LogError({ file: log.name }, (texts) => texts.correction(correction, otherLog.name), questionOf(correction, logs));
  }
  const notes: Note[] = [
    ...brokenReference.summary.notes,
    ...(roleByName(odometry.name) !== 'odometry' && roleByName(reference.name) === 'odometry' ? [{ name: 'swapped' as const, values: [odometry.name] }] : []),
    ...(isLocalizer(reference.name, frames) ? [{ name: 'localizer' as const, values: [] }] : []),
    ...(overlapSeconds(odometry, reference) < 0 ? [{ name: 'apart' as const, values: [odometry.name, timeSpanText(reference), timeSpanText(odometry)] }] : []),
  ];
  return { ...logs, reference: { ...brokenReference, summary: { ...brokenReference.summary, notes } } };
}

/** Returns the reference with breaks where it repeats a pose while the odometry moves on: motion capture may have lost the robot. */
function breakFrozenPoses(reference: Log, odometry: Log): Log {
  const { t, x, y, theta, breaks } = reference.data as Poses;
  const odometryPath = pathOf(odometry.data);
  const frozenRows: number[] = [];
  const rowsAfterFrozen: number[] = [];
  for (let from = 0, to; from < t.length; from = to) {
    for (to = from + 1; to < t.length && x[to] === x[from] && y[to] === y[from] && theta[to] === theta[from]; ) to += 1;
    const [start, end] = [t[from] + END_MARGIN_SECONDS, t[to - 1] - END_MARGIN_SECONDS];
    if (!(end > start)) continue;
    const [[startX, startY, startHeading], [endX, endY, endHeading]] = [poseAt(odometryPath, start), poseAt(odometryPath, end)];
    if (Math.hypot(endX - startX, endY - startY) + Math.abs(wrapAngle(endHeading - startHeading)) <= MIN_ODOMETRY_MOTION) continue;
    for (let row = from + 1; row < to; row++) frozenRows.push(row);
    if (to < t.length) rowsAfterFrozen.push(to);
  }
  if (frozenRows.length === 0) return reference;
  const { summary } = reference;
  return {
    ...reference,
    data: { ...reference.data, breaks: Uint32Array.from(new Set([...breaks, ...frozenRows, ...rowsAfterFrozen])).sort() },
    summary: { ...summary, used: summary.used - frozenRows.length, dropped: { ...summary.dropped, held: { count: frozenRows.length, first: 0 } } },
  };
}

export const warningsOf = (logs: Pick<Log, 'summary'>[]): Warning[] =>
  (['localizer', 'swapped'] as const).filter((warning) => logs.some(({ summary }) => summary.notes.some(({ name }) => name === warning)));

/** Returns the logs of drives in the form that the core takes: arrays if there are several drives. */
export function calibrationLogOf(drives: Drive[]): Pick<CalibrationLog, Role> {
  const odometry = drives.map((drive) => drive.odometry.data);
  const reference = drives.map((drive) => drive.reference.data as Poses);
  return drives.length === 1 ? { odometry: odometry[0], reference: reference[0] } : { odometry, reference };
}
