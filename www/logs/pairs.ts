/** Pairs of logs of one drive, and checks of one log against the other. */

import { bisectLeft } from 'd3-array';
import type { CalibrationLog } from '../types.d.ts';
import { isLocalizer, roleByName } from './candidates.ts';
import { correctionOf, type Correction } from './corrections.ts';
import { withoutFrozenPoses } from './frozen-pose.ts';
import { LogError } from './log-error.ts';
import { framesText, type Log, type Note, type Poses, type Role, type Warning } from './log.ts';

/** Two logs of one drive, with times after the same start. */
export interface Drive { odometry: Log; reference: Log }

/** Minimum overlap in time of two logs of one drive, as a fraction of the shorter log's duration. */
const MIN_OVERLAP = 0.5;

/** Number of rows that are compared to detect copies of one path, and minimum number of equal rows of a copy. */
const [COMPARED_ROWS, MIN_EQUAL_ROWS] = [500, 10];

/** Maximum difference (m and rad) between copies of one path, due to rounding to six digits. */
const COPY_TOLERANCE = 1e-5;

/** Steps (m) to which positions may be rounded, and minimum path length in steps. Independent paths that long differ by more than a step. */
const [ROUNDING_STEPS, MIN_ROUNDED_LENGTH] = [[1e-2, 1e-3, 1e-4], 2000];

/** Minimum motion (m or rad) of paths that are compared. */
const MIN_MOTION = 0.1;

/**
 * Fractions of rows that repeat the previous pose: minimum for wheel odometry, because a robot rests at times, and maximum for an external
 * measurement, because it has noise.
 */
const [MIN_WHEEL_REPEATS, MAX_MEASURED_REPEATS] = [0.02, 0.001];

/** Options for the unit of a log that was read with a wrong unit, by the name of the correction. */
const UNIT_OPTIONS: { [Name in Correction['name']]?: 'angleUnit' | 'lengthUnit' } = { degrees: 'angleUnit', radians: 'angleUnit', lengths: 'lengthUnit' };

/** Returns the absolute times of the first and the last row. */
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

/**
 * Pairs two logs of one drive: with times after the same start, and without rows in which the reference had lost the robot. Throws a
 * LogError if the reference has no poses, does not follow the robot, or is the odometry itself.
 */
export function pairLogs(odometry: Log, reference: Log): Drive {
  const referencePlace = { file: reference.name };
  if (reference.kind === 'commands') throw new LogError(referencePlace, (say) => say.noColumns('poses', 't, v, omega'));
  const { frames } = reference.summary;
  if (frames?.parent === 'odom') throw new LogError(referencePlace, (say) => say.ownReference(framesText(frames)));
  const commonStart = Math.min(odometry.start, reference.start);
  const [commonOdometry, commonReference] = [withStart(odometry, commonStart), withStart(reference, commonStart)];
  if (isSamePath(commonOdometry, commonReference)) throw new LogError(referencePlace, (say) => (reference.name === odometry.name ? say.givenTwice : say.same(odometry.name)));
  const reliableReference = withoutFrozenPoses(commonReference, commonOdometry);
  if (reliableReference.data.t.length < 2) throw new LogError(referencePlace, (say) => say.held);
  const correction = correctionOf(commonOdometry, reliableReference);
  if (correction) {
    const unitOption = UNIT_OPTIONS[correction.name];
    const [log, otherLog] = correction.at === 'odometry' ? [odometry, reference] : [reference, odometry];
    throw new LogError({ file: log.name }, (say) => say.correction(correction.name, otherLog.name, correction.score, correction.factor), unitOption && { what: unitOption, choices: [] });
  }
  const swapSign = signOfSwap(commonOdometry, commonReference);
  const notes: Note[] = [
    ...reliableReference.summary.notes,
    ...(swapSign ? [{ name: 'swapped' as const, values: [odometry.name, swapSign] }] : []),
    ...(isLocalizer(reference.name, reference.summary.frames) ? [{ name: 'localizer' as const, values: [] }] : []),
    ...(overlapSeconds(odometry, reference) < 0 ? [{ name: 'apart' as const, values: [odometry.name, timeSpanText(reference), timeSpanText(odometry)] }] : []),
  ];
  return { odometry: commonOdometry, reference: { ...reliableReference, summary: { ...reliableReference.summary, notes } } };
}

/** Returns the evidence that the logs are swapped: `name` for their names, `rest` if only the reference repeats poses at rest, as wheel odometry does. */
function signOfSwap(odometry: Log, reference: Log): 'name' | 'rest' | undefined {
  const rolesByName = [odometry, reference].map(({ name }) => roleByName(name));
  if (rolesByName[0] !== 'odometry' && rolesByName[1] === 'odometry') return 'name';
  const repeatFraction = ({ data }: Log) => ('x' in data ? data.x.reduce((count, x, i) => count + Number(x === data.x[i - 1] && data.y[i] === data.y[i - 1] && data.theta[i] === data.theta[i - 1]), 0) / data.x.length : 1);
  return rolesByName.every((role) => role === undefined) && repeatFraction(reference) > MIN_WHEEL_REPEATS && repeatFraction(odometry) < MAX_MEASURED_REPEATS ? 'rest' : undefined;
}

const WARNING_NAMES: Warning[] = ['localizer', 'swapped', 'clockSet'];

/**
 * Returns the warnings of logs, in which the odometry of each drive precedes its reference. A clock that was set in both logs of a drive gives
 * no warning: a simulator may have paused.
 */
export function warningsOf(logs: Pick<Log, 'summary'>[]): Warning[] {
  const hasNote = (i: number, warning: Warning) => logs[i].summary.notes.some(({ name }) => name === warning);
  return WARNING_NAMES.filter((warning) => logs.some((_, i) => hasNote(i, warning) && !(warning === 'clockSet' && hasNote(i ^ 1, warning))));
}

/** Returns a log with its times in seconds after another start. */
export function withStart(log: Log, start: number): Log {
  const startDifference = log.start - start;
  return startDifference === 0 ? log : { ...log, start, data: { ...log.data, t: log.data.t.map((time) => time + startDifference) } };
}

/** Returns the logs of drives in the form that the core takes: arrays if there are several drives. */
export function calibrationLogOf(drives: Drive[]): Pick<CalibrationLog, Role> {
  const odometry = drives.map((drive) => drive.odometry.data);
  const reference = drives.map((drive) => drive.reference.data as Poses);
  return drives.length === 1 ? { odometry: odometry[0], reference: reference[0] } : { odometry, reference };
}

/**
 * Returns true if two logs are copies of one path. Rows at equal times then have the same motion since the first such row, in any frames,
 * or the positions of one log are those of the other, rounded.
 */
export function isSamePath(one: Log, two: Log): boolean {
  const [poses, other] = [one.data, two.data];
  const { t } = poses;
  // A log of commands has no poses to compare. Two logs from the same rows of a table have all times in common.
  if ('v' in poses || 'v' in other) {
    return (one.kind === two.kind || one.name === two.name) && t.length === other.t.length && t.every((time, i) => time === other.t[i]);
  }
  const rowStride = Math.ceil(t.length / COMPARED_ROWS);
  const motionBetween = ({ x, y, theta }: Poses, from: number, to: number) => {
    const [dx, dy, cos, sin] = [x[to] - x[from], y[to] - y[from], Math.cos(theta[from]), Math.sin(theta[from])];
    return [cos * dx + sin * dy, cos * dy - sin * dx, theta[to] - theta[from]];
  };
  const isRoundedTo = (step: number) => [poses, other].some(({ x, y }) => [x, y].every((coordinates) => coordinates.every((value) => Math.abs(value / step - Math.round(value / step)) < 1e-6)));
  const roundingStep = ROUNDING_STEPS.find((candidate) => one.summary.distance > MIN_ROUNDED_LENGTH * candidate && isRoundedTo(candidate)) ?? 0;
  let [hasSameMotion, hasSameRoundedPositions] = [true, roundingStep > 0];
  let firstRows: [number, number] | undefined;
  let [comparedRows, motion] = [0, 0];
  for (let i = 0; i < t.length; i += rowStride) {
    const j = bisectLeft(other.t, t[i] - 1e-6);
    if (!(Math.abs(other.t[j] - t[i]) <= 1e-6)) continue;
    firstRows ??= [i, j];
    const [motionOfOne, motionOfTwo] = [motionBetween(poses, firstRows[0], i), motionBetween(other, firstRows[1], j)];
    const distance = Math.hypot(motionOfOne[0], motionOfOne[1]);
    const turn = Math.abs(Math.sin((motionOfOne[2] - motionOfTwo[2]) / 2));
    hasSameMotion &&= Math.hypot(motionOfOne[0] - motionOfTwo[0], motionOfOne[1] - motionOfTwo[1]) <= COPY_TOLERANCE * (1 + distance) && turn <= COPY_TOLERANCE;
    hasSameRoundedPositions &&= Math.max(Math.abs(poses.x[i] - other.x[j]), Math.abs(poses.y[i] - other.y[j])) < 0.5 * roundingStep + COPY_TOLERANCE;
    if (!hasSameMotion && !hasSameRoundedPositions) return false;
    comparedRows += 1;
    motion = Math.max(motion, distance, Math.abs(Math.sin(motionOfOne[2] / 2)));
  }
  return comparedRows >= MIN_EQUAL_ROWS && motion > MIN_MOTION;
}
