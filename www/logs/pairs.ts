/** Reads the odometry and reference of each drive, and checks that the two logs of a drive belong together. */

import { min, zip } from 'd3-array';
import type { CalibrationLog } from '../types.d.ts';
import { isLocalizer, roleByName, type PlannedRecording } from './drives.ts';
import { LogError, ROLES, UNITS, formatFrames, type Log, type LogChoice, type Note, type Poses, type Role, type Warning } from './log.ts';
import { pathOf, poseAt, wrapAngle } from './path.ts';
import { METRES_PER_UNIT, logSpeedOf } from './units.ts';

/** Two logs of one drive. The times of both logs count from the same start. */
export interface Drive { odometry: Log; reference: Log }

/** Minimum overlap in time of odometry and reference, as a fraction of the shorter log's duration. */
const MIN_OVERLAP = 0.5;

/** Duration (s) at both ends of a frozen pose (equal poses in succession) in which the odometry may move. The two clocks may differ by this much. */
const END_MARGIN_SECONDS = 1;

/** Minimum motion of the odometry, in metres plus radians, that shows that a constant reference pose is frozen. Encoders of a robot at rest may still count a pulse or two. */
const MIN_ODOMETRY_MOTION = 0.05;

/** Minimum speed (m/s) at which the speeds of two logs are compared: the 90 % quantile of a log. In a log of a robot that mostly stands, this quantile measures only noise. */
const MIN_COMPARED_SPEED = 0.02;

/** Maximum factor between a ratio of two speeds and a ratio of two units. It allows for wheels of another size than the odometry assumes. */
const MAX_UNIT_ERROR = 1.2;

const timeSpanOf = ({ start, data: { t } }: Log): [number, number] => [start + t[0], start + t[t.length - 1]];

const formatTimeSpan = (log: Log) => timeSpanOf(log).map((time) => `${time.toFixed(2)} s`).join(' to ');

/** Returns the duration of the overlap of two logs; negative if there is a gap between them. */
function overlapSecondsOf(log: Log, otherLog: Log): number {
  const [[a, b], [c, d]] = [timeSpanOf(log), timeSpanOf(otherLog)];
  return Math.min(b, d) - Math.max(a, c);
}

/** Pairs odometry and reference logs of several drives. If each odometry overlaps exactly one reference in time, these two are a pair. Otherwise logs are paired in their order. */
function matchLogs(odometry: Log[], reference: Log[]): Log[][] {
  const partnersOfEach = odometry.map((odometryLog) => reference.filter((referenceLog) =>
    overlapSecondsOf(odometryLog, referenceLog) > MIN_OVERLAP * Math.min(odometryLog.summary.seconds, referenceLog.summary.seconds)));
  const hasUniquePartners = partnersOfEach.every(({ length }) => length === 1) && new Set(partnersOfEach.flat()).size === reference.length;
  return odometry.map((odometryLog, i) => [odometryLog, hasUniquePartners ? partnersOfEach[i][0] : reference[i]]);
}

/** Pairs the odometry and reference of one drive, whose times count from the same start. Throws a LogError if the logs do not fit together, or one may have another unit of length. */
export function pairLogs(odometry: Log, reference: Log): Drive {
  const referencePlace = { file: reference.name };
  if (reference.kind === 'commands') throw new LogError(referencePlace, (texts) => texts.missingColumnsReason('poses', 't, v, omega'));
  const { frames } = reference.summary;
  if (frames?.parent === 'odom') throw new LogError(referencePlace, (texts) => texts.sameLogReason(formatFrames(frames)));
  const brokenReference = breakFrozenPoses(reference, odometry);
  if (brokenReference.summary.used < 2) throw new LogError(referencePlace, (texts) => texts.frozenReferenceReason);
  const logs = { odometry, reference: brokenReference };
  checkLengthUnits(logs);
  const notes: Note[] = [
    ...brokenReference.summary.notes,
    ...(roleByName(odometry.name) !== 'odometry' && roleByName(reference.name) === 'odometry' ? [{ name: 'swappedRoles' as const, values: [odometry.name] }] : []),
    ...(isLocalizer(reference.name, frames) ? [{ name: 'localizer' as const, values: [] }] : []),
    ...(overlapSecondsOf(odometry, reference) < 0 ? [{ name: 'apart' as const, values: [odometry.name, formatTimeSpan(reference), formatTimeSpan(odometry)] }] : []),
  ];
  return { ...logs, reference: { ...brokenReference, summary: { ...brokenReference.summary, notes } } };
}

/** Returns the reference with a break at each pose that is repeated although the odometry moves: motion capture has probably lost the robot. */
function breakFrozenPoses(reference: Log, odometry: Log): Log {
  const { data, summary } = reference;
  const { t, x, y, theta } = data as Poses;
  const odometryPath = pathOf(odometry.data);
  const breakRows = new Set(data.breaks);
  let frozenCount = 0;
  for (let runStart = 0, runEnd; runStart < t.length; runStart = runEnd) {
    for (runEnd = runStart + 1; runEnd < t.length && x[runEnd] === x[runStart] && y[runEnd] === y[runStart] && theta[runEnd] === theta[runStart]; ) runEnd += 1;
    const [start, end] = [t[runStart] + END_MARGIN_SECONDS, t[runEnd - 1] - END_MARGIN_SECONDS];
    if (!(end > start)) continue;
    const [[startX, startY, startHeading], [endX, endY, endHeading]] = [poseAt(odometryPath, start), poseAt(odometryPath, end)];
    if (Math.hypot(endX - startX, endY - startY) + Math.abs(wrapAngle(endHeading - startHeading)) <= MIN_ODOMETRY_MOTION) continue;
    frozenCount += runEnd - runStart - 1;
    for (let row = runStart + 1; row <= Math.min(runEnd, t.length - 1); row++) breakRows.add(row);
  }
  if (frozenCount === 0) return reference;
  const dropped = { ...summary.dropped, held: { count: frozenCount, first: 0 } };
  return { ...reference, data: { ...data, breaks: Uint32Array.from(breakRows).sort() }, summary: { ...summary, used: summary.used - frozenCount, dropped } };
}

export const warningsOf = (logs: Pick<Log, 'summary'>[]): Warning[] =>
  (['localizer', 'swappedRoles'] as const).filter((warning) => logs.some(({ summary }) => summary.notes.some(({ name }) => name === warning)));

/** Returns the logs of drives in the form that the core takes: one log of each role, or an array for several drives. */
export function calibrationLogOf(drives: Drive[]): Pick<CalibrationLog, Role> {
  const odometry = drives.map((drive) => drive.odometry.data);
  const reference = drives.map((drive) => drive.reference.data as Poses);
  return drives.length === 1 ? { odometry: odometry[0], reference: reference[0] } : { odometry, reference };
}

/** Reads the logs of planned recordings, and pairs them. All times count from the same start. Rejects with a LogError. */
export async function readDrives(plan: PlannedRecording[], onProgress?: (fraction: number) => void): Promise<Drive[]> {
  const logs: { log: Log; role: Role; isPaired: boolean }[] = [];
  for (const [i, { recording, choices }] of plan.entries()) {
    const roles = ROLES.filter((role) => choices[role]);
    const logsOfRecording = await recording.read(roles.map((role) => choices[role] as LogChoice), (fraction) => onProgress?.((i + fraction) / plan.length));
    logs.push(...logsOfRecording.map((log, k) => ({ log, role: roles[k], isPaired: roles.length === 2 })));
  }
  const start = min(logs, ({ log }) => log.start) ?? 0;
  const logsOf = (isWantedPaired: boolean) => ROLES.map((wantedRole) => logs.filter(({ role, isPaired }) => role === wantedRole && isPaired === isWantedPaired).map(({ log }): Log =>
    ({ ...log, start, data: { ...log.data, t: log.data.t.map((time) => time + (log.start - start)) } })));
  const [[odometry, reference], [unpairedOdometry, unpairedReference]] = [logsOf(true), logsOf(false)];
  const logPairs = [...zip(odometry, reference), ...matchLogs(unpairedOdometry, unpairedReference)];
  return logPairs.map(([odometryLog, referenceLog]) => pairLogs(odometryLog, referenceLog));
}

/** Throws a LogError with a question if the ratio of two logs' speeds is that of two units of length, such as metres and feet. */
function checkLengthUnits(logs: Record<Role, Log>): void {
  const [odometrySpeed, referenceSpeed] = ROLES.map((role) => logSpeedOf(logs[role].data));
  if (Math.min(odometrySpeed, referenceSpeed) < MIN_COMPARED_SPEED) return;
  for (const [role, otherRole, speedRatio] of [['reference', 'odometry', referenceSpeed / odometrySpeed], ['odometry', 'reference', odometrySpeed / referenceSpeed]] as const) {
    const { unit: assumedUnit, by } = logs[role].summary.units.length;
    const likelyUnit = UNITS.lengthUnit.find((unit) => {
      const unitRatio = METRES_PER_UNIT[assumedUnit] / METRES_PER_UNIT[unit];
      return unitRatio > 1 && Math.max(speedRatio / unitRatio, unitRatio / speedRatio) < MAX_UNIT_ERROR;
    });
    if (!likelyUnit || by !== 'usage') continue;
    throw new LogError({ file: logs[role].name }, (texts) => texts.otherUnitReason(speedRatio, logs[otherRole].name, likelyUnit), { option: 'lengthUnit', choices: [likelyUnit, assumedUnit] });
  }
}
