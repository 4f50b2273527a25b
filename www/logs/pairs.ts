/** Reading of the odometry and reference of each drive, and checks that both logs belong together. */

import { min } from 'd3-array';
import type { CalibrationLog } from '../types.d.ts';
import { isLocalizer, roleByName, type LogPlan } from './drives.ts';
import { LogError, ROLES, UNITS, formatFrames, type AngleUnit, type LengthUnit, type Log, type Note, type Poses, type Question, type Role, type Warning } from './log.ts';
import { pathOf, poseAt, wrapAngle } from './path.ts';
import { METRES_PER_UNIT } from './units.ts';

/** Two logs of one drive, with times after the same start. */
export interface Drive { odometry: Log; reference: Log }

/** Minimum overlap in time of two logs of one drive, as a fraction of the shorter log's duration. */
const MIN_OVERLAP = 0.5;

/** Margin (s) at both ends of a run of equal poses that is ignored, because the clocks may differ by this much. */
const END_MARGIN_SECONDS = 1;

/** Minimum motion of the odometry during a frozen pose, metres and radians added up. Encoders at rest may count a pulse or two. */
const MIN_ODOMETRY_MOTION = 0.05;

/** Motion of the robot in one step, in the frame of the robot, in m and rad. */
type Motion = [forward: number, left: number, turn: number];

/** Scale or unit correction of one log that makes both logs of a drive agree. */
export interface Correction {
  name: 'leftHanded' | 'angles' | 'lengths';
  at: Role;
  /** Correlation of the motions of both logs after the correction. */
  score: number;
  factor: number;
  /** Unit that the log has after a correction of lengths or angles; undefined if no unit has this size. */
  unit?: LengthUnit | AngleUnit;
}

/** Maximum ratio of a measured size of a unit to its real size, and its inverse. The odometry's wheels may have another size than assumed. */
const MAX_UNIT_ERROR = 1.2;

/** Maximum number of steps of a drive, minimum duration of a step (s), and minimum number of steps for a comparison. */
const [MAX_STEPS, MIN_STEP_SECONDS, MIN_STEPS] = [4000, 0.25, 40];

/** Maximum offset of the clocks (s) that is tried, as in the first scan of the core. */
const MAX_CLOCK_OFFSET = 10;

/** Scores are correlations: minimum of logs that agree, minimum after a correction, and maximum ratio of 1 − score after and before it. */
const [MIN_AGREEMENT_SCORE, MIN_CORRECTED_SCORE, MAX_REMAINING_FRACTION] = [0.9, 0.8, 0.3];

/** Mean motion of a step, m or rad, below which the robot counts as standing. */
const MAX_STANDSTILL_MOTION = 1e-4;

/** Agreement of two logs: correlation of their motions (−1 to 1), and best scales of the reference's lengths and angles. */
interface Agreement { score: number; length: number; angle: number }

const timeSpanOf = ({ start, data: { t } }: Log): [number, number] => [start + t[0], start + t[t.length - 1]];

const formatTimeSpan = (log: Log) => timeSpanOf(log).map((time) => `${time.toFixed(2)} s`).join(' to ');

/** Returns the duration of the overlap of two logs; negative if there is a gap between them. */
function overlapSecondsOf(log: Log, otherLog: Log): number {
  const [[a, b], [c, d]] = [timeSpanOf(log), timeSpanOf(otherLog)];
  return Math.min(b, d) - Math.max(a, c);
}

/** Returns the part of a file's name that both files of a drive share: without its extension and words for a role. */
const fileStemOf = (name: string) => name.toLowerCase().replace(/\.\w+$/, '').replace(/odom(etry)?|wheels?|encoders?|cmd(_vel)?|(ground)?[_-]?truth|gt|reference|ref|mocap|vicon|optitrack|poses?/g, '').replace(/[^a-z0-9]+/g, '');

/** Pairs logs of several drives: by their times, by the names of their files, or in their order. */
function matchLogs(odometry: Log[], reference: Log[]): [Log, Log][] {
  const overlapsMostly = (odometryLog: Log, referenceLog: Log) => overlapSecondsOf(odometryLog, referenceLog) > MIN_OVERLAP * Math.min(odometryLog.summary.seconds, referenceLog.summary.seconds);
  const hasSameStem = (odometryLog: Log, referenceLog: Log) => fileStemOf(odometryLog.name) === fileStemOf(referenceLog.name);
  for (const isMatch of [overlapsMostly, hasSameStem]) {
    const partnersOfEach = odometry.map((odometryLog) => reference.filter((referenceLog) => isMatch(odometryLog, referenceLog)));
    if (partnersOfEach.every(({ length }) => length === 1) && new Set(partnersOfEach.flat()).size === reference.length) return odometry.map((odometryLog, i) => [odometryLog, partnersOfEach[i][0]]);
  }
  return odometry.map((odometryLog, i) => [odometryLog, reference[i]]);
}

/** Pairs two logs of one drive, whose times are after one start. Throws a LogError if they do not fit, or if one needs a correction. */
export function pairLogs(odometry: Log, reference: Log): Drive {
  const referencePlace = { file: reference.name };
  if (reference.kind === 'commands') throw new LogError(referencePlace, (texts) => texts.noColumns('poses', 't, v, omega'));
  const { frames } = reference.summary;
  if (frames?.parent === 'odom') throw new LogError(referencePlace, (texts) => texts.ownReference(formatFrames(frames)));
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
    ...(overlapSecondsOf(odometry, reference) < 0 ? [{ name: 'apart' as const, values: [odometry.name, formatTimeSpan(reference), formatTimeSpan(odometry)] }] : []),
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

/** Reads the logs of a plan and pairs them. Their times are relative to one start. Rejects with a LogError. */
export async function readDrives({ drives, unpaired }: Pick<LogPlan, 'drives' | 'unpaired'>, onProgress?: (share: number) => void): Promise<Drive[]> {
  const readGroups = [...drives.map((drive) => [drive.odometry, drive.reference]), ...[...unpaired.odometry, ...unpaired.reference].map((recordingChoice) => [recordingChoice])];
  const logs: Log[] = [];
  for (const [i, recordingChoices] of readGroups.entries()) {
    const [{ recording }] = recordingChoices;
    logs.push(...(await recording.read(recordingChoices.map(({ choice }) => choice), (share) => onProgress?.((i + share) / readGroups.length))));
  }
  const start = min(logs, (log) => log.start) ?? 0;
  const logsFromStart = logs.map((log): Log => ({ ...log, start, data: { ...log.data, t: log.data.t.map((time) => time + (log.start - start)) } }));
  const unpairedLogs = logsFromStart.splice(2 * drives.length);
  const logPairs: [Log, Log][] = [
    ...drives.map((_, i): [Log, Log] => [logsFromStart[2 * i], logsFromStart[2 * i + 1]]),
    ...matchLogs(unpairedLogs.slice(0, unpaired.odometry.length), unpairedLogs.slice(unpaired.odometry.length)),
  ];
  return logPairs.map(([odometry, reference]) => pairLogs(odometry, reference));
}

/** Returns true for a scale that an error of the wheels' size can explain. The core has the same limits. */
const isPlausibleScale = (scale: number) => scale >= 0.5 && scale <= 2;

/** Returns the correction that makes two logs of a drive agree; undefined if they agree already, or if no correction helps. */
function correctionOf(odometry: Log, reference: Log): Correction | undefined {
  const logs = { odometry, reference };
  const timesByRole = ROLES.map((role) => logs[role].data.t);
  const [from, to] = [Math.max(...timesByRole.map((t) => t[0])), Math.min(...timesByRole.map((t) => t[t.length - 1]))];
  const step = Math.max(MIN_STEP_SECONDS, (to - from) / MAX_STEPS, ...ROLES.map((role) => 2 / logs[role].summary.rate));
  const stepCount = Math.floor((to - from) / step);
  if (!(stepCount >= MIN_STEPS)) return undefined;
  const [odometryMotions, referenceMotions] = ROLES.map((role) => motionsOf(logs[role], from, step, stepCount));
  const { score, length: lengthFactor, angle } = bestAgreementOf(odometryMotions, referenceMotions, step);
  if (score < MIN_AGREEMENT_SCORE) {
    const mirrored = bestAgreementOf(odometryMotions, referenceMotions.map(([forward, left, turn]) => [forward, -left, -turn]), step);
    const minScore = Math.max(MIN_CORRECTED_SCORE, 1 - MAX_REMAINING_FRACTION * (1 - score));
    if (mirrored.score >= minScore && [mirrored.length, mirrored.angle].every(isPlausibleScale)) return { name: 'leftHanded', at: 'reference', score: mirrored.score, factor: lengthFactor };
    if (score < MIN_CORRECTED_SCORE) return undefined;
  }
  if (!isPlausibleScale(lengthFactor)) return computeLengthCorrection(logs, score, lengthFactor);
  return isPlausibleScale(angle) ? undefined : { name: 'angles', at: angle < 1 ? 'reference' : 'odometry', score, factor: lengthFactor, unit: 'deg' };
}

/** Returns the correction of lengths, for the log whose corrected lengths have a known unit. `factor` is the scale of the reference's lengths. */
function computeLengthCorrection(logs: Record<Role, Log>, score: number, lengthFactor: number): Correction {
  const corrections = ([['reference', lengthFactor], ['odometry', 1 / lengthFactor]] as const).map(([at, factorOfLog]): Correction => {
    const size = METRES_PER_UNIT[logs[at].summary.units.length.unit] * factorOfLog;
    const unit = UNITS.lengthUnit.find((name) => Math.max(size / METRES_PER_UNIT[name], METRES_PER_UNIT[name] / size) < MAX_UNIT_ERROR);
    return { name: 'lengths', at, score, factor: factorOfLog, unit };
  });
  return corrections.find(({ unit }) => unit !== undefined) ?? corrections[0];
}

/** Returns the question for the unit of a corrected log; undefined if no unit is the correction. */
function questionOf({ name, at, unit }: Correction, logs: Record<Role, Log>): Question | undefined {
  if (unit === undefined) return undefined;
  const [what, quantity] = name === 'lengths' ? (['lengthUnit', 'length'] as const) : (['angleUnit', 'angle'] as const);
  const allUnits: readonly string[] = UNITS[what];
  const unitOf = (role: Role) => (role === at ? unit : logs[role].summary.units[quantity].unit);
  return { what, choices: [], pair: ROLES.map((role) => (allUnits.includes(unitOf(role)) ? unitOf(role) : allUnits[0])).join() };
}

/** Returns the motions of a log in equal steps, from a start time on. Steps with a jump or another break have no motion. */
function motionsOf({ data }: Log, from: number, step: number, count: number): Motion[] {
  const path = pathOf(data, Math.max(1, Math.floor(data.t.length / (4 * MAX_STEPS))));
  const stepPoses = Array.from({ length: count + 1 }, (_, i) => poseAt(path, from + i * step));
  const brokenSteps = new Set(Array.from(data.breaks, (row) => [row - 1, row].map((end) => Math.floor((data.t[end] - from) / step))).flat());
  return stepPoses.slice(1).map(([x, y, heading], i) => {
    if (brokenSteps.has(i)) return [0, 0, 0];
    const [dx, dy, turn] = [x - stepPoses[i][0], y - stepPoses[i][1], wrapAngle(heading - stepPoses[i][2])];
    const middleHeading = stepPoses[i][2] + turn / 2;
    return [dx * Math.cos(middleHeading) + dy * Math.sin(middleHeading), dy * Math.cos(middleHeading) - dx * Math.sin(middleHeading), turn];
  });
}

/** Returns the agreement of two logs at the smallest clock offset at which they agree, or at the best offset if they do not agree. */
function bestAgreementOf(odometry: Motion[], reference: Motion[], step: number): Agreement {
  const maxLag = Math.round(MAX_CLOCK_OFFSET / step);
  let best: Agreement = { score: -1, length: 1, angle: 1 };
  for (let i = 0; i <= 2 * maxLag && best.score < MIN_AGREEMENT_SCORE; i++) {
    const agreement = agreementAt(odometry, reference, i % 2 === 0 ? i / 2 : -(i + 1) / 2, odometry.length - maxLag);
    if (agreement.score > best.score) best = agreement;
  }
  return best;
}

/** Returns the agreement at a clock offset of `lag` steps, for any angle between the headings. Its score is −1 if fewer than half of `count` steps overlap. */
function agreementAt(odometry: Motion[], reference: Motion[], lag: number, count: number): Agreement {
  // Sums of squares and products of the motions. `across` is the cross product of the displacements, and `driveProducts` their dot product.
  let [odoDriveSquares, driveProducts, across, refDriveSquares, odoTurnSquares, turnProducts, refTurnSquares] = [0, 0, 0, 0, 0, 0, 0];
  const [first, end] = [Math.max(0, -lag), Math.min(odometry.length, reference.length - lag)];
  for (let i = first; i < end; i++) {
    const [odometryMotion, referenceMotion] = [odometry[i], reference[i + lag]];
    odoDriveSquares += odometryMotion[0] * odometryMotion[0] + odometryMotion[1] * odometryMotion[1];
    driveProducts += odometryMotion[0] * referenceMotion[0] + odometryMotion[1] * referenceMotion[1];
    across += odometryMotion[0] * referenceMotion[1] - odometryMotion[1] * referenceMotion[0];
    refDriveSquares += referenceMotion[0] * referenceMotion[0] + referenceMotion[1] * referenceMotion[1];
    odoTurnSquares += odometryMotion[2] * odometryMotion[2];
    turnProducts += odometryMotion[2] * referenceMotion[2];
    refTurnSquares += referenceMotion[2] * referenceMotion[2];
  }
  if (2 * (end - first) < count) return { score: -1, length: 1, angle: 1 };
  // For a robot that only drives straight or only turns on the spot, one of the two correlations is undefined.
  const [drive, turn] = [[odoDriveSquares, Math.hypot(driveProducts, across), refDriveSquares], [odoTurnSquares, turnProducts, refTurnSquares]].map(([odo, both, ref]) =>
    (Math.sqrt(Math.max(odo, ref) / (end - first)) < MAX_STANDSTILL_MOTION ? { correlation: 1, scale: 1 } : { correlation: both / Math.sqrt(odo * ref || 1), scale: odo / both }));
  return { score: Math.min(drive.correlation, turn.correlation), length: drive.scale, angle: turn.scale };
}
