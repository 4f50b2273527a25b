/** Collector of the rows of a log. Unusable rows are dropped, and counted by cause. */

import { group, max, min, range, sum } from 'd3-array';
import { COLUMN_CHANGES } from './columns.ts';
import { LogError, type ErrorPlace, type DropCause, type Log, type LogKind, type Note, type OpenOptions, type ErrorReason, type Summary, type Words } from './log.ts';
import { distanceOf, quantileOf, sampleEvenly, wrapAngle } from './path.ts';
import { epochTimeUnitOf, judgeUnits, type Columns, type CreateColumnQuestion, type Units } from './units.ts';

/** Sample of a log: a pose (x, y and heading) or a command (v, omega and 0). `time` is in s; 0 if unknown. The heading is undefined if the quaternion is not a rotation. */
export interface Sample {
  time: number;
  a: number;
  b: number;
  c: number | undefined;
  /** Height of a pose; only given if its heading is stored as an angle. */
  z?: number;
  /** Cosine of the tilt of Z; only given if the heading is stored as a quaternion. */
  tiltCosine?: number;
}

/** Facts about a log that come from the reader of its file format. */
interface LogFacts {
  /** Units that the names of columns or the file format state. */
  units: Units;
  /** Name of the first clock, and name of the fallback clock if there is one. */
  clocks: [string, string?];
  frames?: Summary['frames'];
  columns?: Summary['columns'];
  notes: Note[];
  createColumnQuestion?: CreateColumnQuestion;
}

/** Maximum number of rows in a log, about a day at 100 Hz. */
const MAX_ROWS = 10_000_000;

/** Maximum absolute value of a coordinate or speed that the core accepts. */
export const MAX_VALUE = 1e9;

/** Minimum duration of a gap, in median steps between rows. The core uses the same number. */
const MIN_GAP_STEPS = 5;

/** Minimum speed of a jump, as a multiple of a moving robot's usual speed (90 % quantile). */
const JUMP_FACTOR = 8;

/** Minimum number of different poses from which to judge how often a log usually repeats a pose. */
const MIN_POSES = 20;

/** Minimum number of repetitions of a pose that shows a standing robot, as a multiple of the usual number. A localizer also repeats poses while the robot moves slowly. */
const STANDSTILL_FACTOR = 8;

/** Limits for overlaps of runs. A run is a sequence of rows with rising times. Maximum time between overlapping rows, in median steps; maximum number of overlaps of a run; maximum fraction of all rows. */
const [MAX_OVERLAP_STEPS, MAX_RUN_OVERLAPS, MAX_OVERLAP_FRACTION] = [0.75, 2, 0.02];

/** Limits for rows that are late: maximum length of the path in order of time, relative to its length in order of the file, and minimum number of late rows. */
const [MAX_LATE_PATH_RATIO, MIN_LATE_ROWS] = [0.75, 20];

/** Limits for finding a log whose rows alternate between two paths: minimum distance (m) between the paths, and minimum number of steps from one to the other. A single path has shorter or fewer such steps. */
const [MIN_PATH_DISTANCE, MIN_LONG_STEPS] = [0.05, 20];

/**
 * Limits for two paths whose rows alternate: maximum rows and seconds until the same path continues; maximum number of long steps within a path, relative
 * to long steps between successive rows.
 */
const [MAX_RETURN_ROWS, MAX_RETURN_SECONDS, MAX_LONG_FRACTION] = [8, 1, 0.2];

/** Minimum size of a jump: a distance in metres or a turn in radians. The noise of a log with a high rate is smaller. */
const [MIN_JUMP, MIN_JUMP_TURN] = [0.1, 0.2];

/** Minimum speed of a moving robot, in m/s or rad/s. */
const MIN_MOVING_SPEED = 0.01;

/** Maximum fraction of rows that have the same time as another row, but other values. */
const MAX_CONTRADICTING_FRACTION = 0.4;

/** Maximum fraction of damaged rows. */
const MAX_DAMAGED_FRACTION = 0.1;

/** Maximum spread of the cosine of the tilt. If the spread is larger, the robot does not drive on a plane. */
const MAX_TILT_SPREAD = 0.5;

export class RowCollector {
  #logPlace: ErrorPlace;
  /** Columns of the rows that were added. `breakFlags` is 1 if the path before a row is unknown. */
  #columns = { time: [] as number[], a: [] as number[], b: [] as number[], c: [] as number[], z: [] as number[], line: [] as number[], otherTime: [] as number[], breakFlags: [] as number[] };
  #tiltCosines: number[] = [];
  /** Times of the clock in use, which is the first or the fallback clock. */
  #times = this.#columns.time;
  /** True if the path before the next row is unknown, because an unusable row was dropped. */
  #isPathBroken = false;
  #dropped: Summary['dropped'] = {};
  /** Number of damaged rows, and line and reason of the first damaged row. */
  #damage: { count: number; line: number; formatReason: ErrorReason } | undefined;

  /** Number of all rows, including dropped rows. */
  rowCount = 0;

  /** @param logPlace file and topic that error messages name */
  constructor(logPlace: ErrorPlace) {
    this.#logPlace = logPlace;
  }

  /** Drops a row. If too many rows are dropped with a reason, the log is refused with the reason given for the first such row. */
  dropRow(cause: DropCause, line: number, formatReason?: ErrorReason): void {
    this.rowCount += 1;
    this.#countDropped(cause, line);
    this.#isPathBroken = true;
    if (formatReason) this.#damage = { line, formatReason, ...this.#damage, count: (this.#damage?.count ?? 0) + 1 };
  }

  /** Adds a row, or drops it if it is unusable. `otherTime` is the time by the fallback clock, which is used if the first clock stands still. */
  addRow({ time, a, b, c, z = 0, tiltCosine }: Sample, line: number, otherTime = 0): void {
    if (c === undefined) return this.dropRow('noRotation', line);
    if (!(Number.isFinite(time) && Math.max(Math.abs(a), Math.abs(b), Math.abs(c)) <= MAX_VALUE)) return this.dropRow('notFinite', line);
    this.rowCount += 1;
    if (this.rowCount > MAX_ROWS) throw new LogError(this.#logPlace, (texts) => texts.tooManyRowsReason(MAX_ROWS));
    const columns = this.#columns;
    columns.time.push(time);
    columns.a.push(a);
    columns.b.push(b);
    columns.c.push(c);
    columns.z.push(z);
    if (tiltCosine !== undefined) this.#tiltCosines.push(tiltCosine);
    columns.line.push(line);
    columns.otherTime.push(otherTime);
    columns.breakFlags.push(Number(this.#isPathBroken));
    this.#isPathBroken = false;
  }

  /** Spread of the cosine of the tilt: the difference between its 95 % and 5 % quantiles. A small spread shows that Z is the vertical axis. */
  get tiltCosineSpread(): number {
    const [low, high] = [0.05, 0.95].map((fraction) => quantileOf(sampleEvenly(this.#tiltCosines.length, (i) => this.#tiltCosines[i]), fraction));
    return high - low || 0;
  }

  /** Returns the log of the rows that were added. Throws a LogError if the rows do not form a log, or if their units or axes are in doubt. */
  buildLog(name: string, kind: LogKind, { units: assumedUnits, clocks, createColumnQuestion, ...decisions }: LogFacts, options: OpenOptions = {}): Log {
    const { rowCount } = this;
    const damage = this.#damage;
    if (damage && damage.count > MAX_DAMAGED_FRACTION * rowCount) {
      const composeSentences = (texts: Words['refused']) => [damage.formatReason(texts), ...(damage.count > 1 && damage.count < rowCount ? [texts.damagedRowsReason(damage.count, rowCount, 100 * MAX_DAMAGED_FRACTION)] : [])];
      throw new LogError({ ...this.#logPlace, line: damage.line }, (texts) => composeSentences(texts).join(' '));
    }
    if (this.tiltCosineSpread > MAX_TILT_SPREAD) throw new LogError(this.#logPlace, (texts) => texts.tiltedPosesReason);
    const usesOtherClock = clocks[1] !== undefined && this.#isClockStill();
    if (usesOtherClock) this.#times = this.#columns.otherTime;
    const stampedRows = this.#dropUnsetTimes();
    const start = Math.floor(min(stampedRows, (row) => this.#times[row]) ?? 0);
    const { sortedRows, lateCount } = this.#sortByTime(stampedRows);
    const rowsOfDistinctTime = this.#dropEqualTimes(sortedRows);
    const rows = kind === 'poses' ? this.#dropRepeatedPoses(rowsOfDistinctTime) : rowsOfDistinctTime;
    if (rows.length < 2) {
      const [cause, firstDroppedRows] = (Object.entries(this.#dropped) as [DropCause, { first: number }][])[0] ?? [];
      throw new LogError({ ...this.#logPlace, line: firstDroppedRows?.first }, (texts) => texts.fewRowsReason(rows.length, rowCount, cause));
    }
    const [times, a, b, c, z] = [this.#times, this.#columns.a, this.#columns.b, this.#columns.c, this.#columns.z].map((column) => new Float64Array(rows.length).map((_, i) => column[rows[i]]));
    const t = times.map((time) => time - start);
    const columns: Columns = { start, t, a, b, c, z };
    const units = judgeUnits(this.#logPlace, kind, columns, assumedUnits, options, createColumnQuestion);
    const pathDistance = kind === 'poses' ? distanceOfPaths(t, a, b) : 0;
    if (pathDistance > 0) throw new LogError(this.#logPlace, (texts) => texts.alternatingPathsReason(pathDistance));
    const { breaks, jumpRows, ...foundGaps } = this.#findEvents(kind, [t, a, b, c], (i) => this.#columns.breakFlags[rows[i]] === 1);
    const data = { t, ...(kind === 'poses' ? { x: a, y: b, theta: c } : { v: a, omega: b }), breaks } as Log['data'];
    const notes: Note[] = [
      ...decisions.notes,
      ...(lateCount > 0 ? [{ name: 'sorted' as const, values: [lateCount] }] : []),
    ];
    const seconds = t[t.length - 1] - t[0];
    const clock = clocks[usesOtherClock ? 1 : 0] ?? '';
    const summary = {
      rows: rowCount, used: t.length, dropped: this.#dropped, seconds, distance: distanceOf(data, jumpRows), ...foundGaps,
      ...decisions, ...(decisions.columns && { columns: { ...decisions.columns, t: clock } }), units, clock, notes,
    };
    return { name, kind, start: columns.start, data, summary, ...(createColumnQuestion && { mirroring: createColumnQuestion(COLUMN_CHANGES.mirrored) }) };
  }

  /** Returns true if most rows have the same time as the row before, because the stamps are 0 or never change. */
  #isClockStill(): boolean {
    const { time } = this.#columns;
    return 2 * time.filter((rowTime, row) => rowTime === time[row - 1]).length > time.length;
  }

  #hasSameValues(rowIndex: number, otherRowIndex: number): boolean {
    const { a, b, c } = this.#columns;
    return a[rowIndex] === a[otherRowIndex] && b[rowIndex] === b[otherRowIndex] && c[rowIndex] === c[otherRowIndex];
  }

  /** Drops the rows whose stamp was not set: their stamp is 0, although all others are times since 1970. Returns the remaining rows. */
  #dropUnsetTimes(): Uint32Array {
    const rows = new Uint32Array(this.#times.length).map((_, row) => row);
    const isSince1970 = this.#times.every((time) => time === 0 || epochTimeUnitOf(time) !== undefined);
    return isSince1970 ? this.#dropRows(rows, 'noStamp', (row) => this.#times[row] === 0) : rows;
  }

  /** Returns the rows sorted by time, and the number of late rows. Throws a LogError if the clock was set back. */
  #sortByTime(rows: Uint32Array): { sortedRows: Uint32Array; lateCount: number } {
    const { a, b } = this.#columns;
    const times = Array.from(rows, (row) => this.#times[row]);
    // Runs are sequences of rows in the file with rising times.
    const runOfRow = new Uint32Array(rows.length);
    for (let i = 1; i < rows.length; i++) runOfRow[i] = runOfRow[i - 1] + Number(times[i] < times[i - 1]);
    if (!runOfRow.at(-1)) return { sortedRows: rows, lateCount: 0 };
    const sortedOrder = rows.map((_, i) => i).sort((position, otherPosition) => times[position] - times[otherPosition] || position - otherPosition);
    const medianStep = quantileOf(sampleEvenly(times.length - 1, (i) => times[sortedOrder[i + 1]] - times[sortedOrder[i]]).filter((step) => step > 0), 0.5);
    const distanceBetween = (position: number, otherPosition: number) => Math.hypot(a[rows[position]] - a[rows[otherPosition]], b[rows[position]] - b[rows[otherPosition]]);
    // Two rows from different runs overlap if their times are nearly equal. If the rows of a run were only written late, sorting by time shortens the path.
    // If the clock was set back, sorting lengthens the path, because it mixes two parts of the drive.
    const overlaps: { run: number; sortedLength: number; fileLength: number }[] = [];
    for (let i = 1; i < sortedOrder.length; i++) {
      const [previousPosition, position] = [sortedOrder[i - 1], sortedOrder[i]];
      const isOverlap = runOfRow[previousPosition] !== runOfRow[position] && times[position] - times[previousPosition] < MAX_OVERLAP_STEPS * medianStep && !this.#hasSameValues(rows[previousPosition], rows[position]);
      const run = Math.max(runOfRow[previousPosition], runOfRow[position]);
      if (isOverlap) overlaps.push({ run, sortedLength: distanceBetween(previousPosition, position), fileLength: distanceBetween(position, Math.max(position, 1) - 1) });
    }
    const isSetBack = (overlapsOfRun: typeof overlaps, maxCount: number) => {
      const hasShorterPath = sum(overlapsOfRun, ({ sortedLength }) => sortedLength) < MAX_LATE_PATH_RATIO * sum(overlapsOfRun, ({ fileLength }) => fileLength);
      return overlapsOfRun.length > maxCount && !(hasShorterPath && overlapsOfRun.length >= MIN_LATE_ROWS);
    };
    const hasManyOverlaps = isSetBack(overlaps, Math.max(MAX_RUN_OVERLAPS, MAX_OVERLAP_FRACTION * rows.length));
    const [setBackRun] = [...group(overlaps, ({ run }) => run)].find(([, overlapsOfRun]) => hasManyOverlaps || isSetBack(overlapsOfRun, MAX_RUN_OVERLAPS)) ?? [];
    if (setBackRun !== undefined) {
      const setBackRow = runOfRow.indexOf(setBackRun);
      const line = this.#columns.line[rows[setBackRow]];
      throw new LogError({ ...this.#logPlace, line }, (texts) => texts.clockSetBackReason(times[setBackRow - 1] - times[setBackRow]));
    }
    let newestTime = -Infinity;
    const isLate = (time: number) => time < (newestTime = Math.max(newestTime, time));
    return { sortedRows: sortedOrder.map((i) => rows[i]), lateCount: times.filter(isLate).length };
  }

  /** Returns the first row of each time. Throws a LogError if too many rows have the same time as another row, but other values. */
  #dropEqualTimes(rows: Uint32Array): Uint32Array {
    let [lastTime, contradictions] = [-Infinity, 0];
    const distinctRows = this.#dropRows(rows, 'duplicate', (row, i) => {
      const time = this.#times[row];
      const isEqual = time <= lastTime;
      if (isEqual && !this.#hasSameValues(rows[i - 1], row)) contradictions += 1;
      lastTime = time;
      return isEqual;
    });
    if (rows.length > 3 && contradictions > MAX_CONTRADICTING_FRACTION * rows.length) {
      const line = this.#dropped.duplicate?.first;
      throw new LogError({ ...this.#logPlace, line }, (texts) => texts.equalTimesReason(contradictions, rows.length));
    }
    return distinctRows;
  }

  /**
   * Drops repetitions of poses of a moving robot, and returns the remaining rows. Slow topics in a table with faster ones, and localizers, repeat their
   * last pose. While the robot stands, the usual fraction of rows is dropped.
   */
  #dropRepeatedPoses(rows: Uint32Array): Uint32Array {
    const isRepeated = (i: number) => i > 0 && this.#hasSameValues(rows[i - 1], rows[i]);
    const rowsPerPose: number[] = [];
    for (let i = 0; i < rows.length; i++) {
      if (isRepeated(i)) rowsPerPose[rowsPerPose.length - 1] += 1;
      else rowsPerPose.push(1);
    }
    const usualRowsPerPose = rowsPerPose.length < MIN_POSES ? 1 : quantileOf(sampleEvenly(rowsPerPose.length, (i) => rowsPerPose[i]), 0.5);
    if (usualRowsPerPose === 1) return rows;
    let [poseIndex, repeatCount] = [-1, 0];
    return this.#dropRows(rows, 'repeated', (_, i) => {
      [poseIndex, repeatCount] = isRepeated(i) ? [poseIndex, repeatCount + 1] : [poseIndex + 1, 0];
      const isStanding = rowsPerPose[poseIndex] >= STANDSTILL_FACTOR * usualRowsPerPose;
      return isStanding ? repeatCount % usualRowsPerPose !== 0 : repeatCount > 0;
    });
  }

  /** Returns the rows for which `isDropped` is false. If the path is unknown before a dropped row, it is also unknown before the next row that is kept. */
  #dropRows(rows: Uint32Array, cause: DropCause, isDropped: (row: number, i: number) => boolean): Uint32Array {
    const { line, breakFlags } = this.#columns;
    return rows.filter((row, i) => {
      if (!isDropped(row, i)) return true;
      this.#countDropped(cause, line[row]);
      if (i + 1 < rows.length) breakFlags[rows[i + 1]] ||= breakFlags[row];
      return false;
    });
  }

  /** Returns the rate, the gaps, the jumps, and the breaks of a log. A break is a row before which the path is unknown. */
  #findEvents(kind: LogKind, [t, a, b, c]: Float64Array[], hasBreakBefore: (i: number) => boolean) {
    const medianStep = quantileOf(sampleEvenly(t.length - 1, (i) => t[i + 1] - t[i]), 0.5);
    const [gapRows, jumpRows, breaks]: number[][] = [[], [], []];
    const isJump = kind === 'poses' ? createJumpChecker(t, a, b, c) : () => false;
    for (let i = 1; i < t.length; i++) {
      if (t[i] - t[i - 1] > MIN_GAP_STEPS * medianStep) gapRows.push(i);
      if (isJump(i)) jumpRows.push(i);
      if (jumpRows.at(-1) === i || hasBreakBefore(i)) breaks.push(i);
    }
    return {
      rate: 1 / medianStep, breaks: Uint32Array.from(breaks), jumpRows,
      gaps: { count: gapRows.length, longest: max(gapRows, (i) => t[i] - t[i - 1]) ?? 0, first: t[gapRows[0] - 1] - t[0] },
      jumps: { count: jumpRows.length, first: t[jumpRows[0]] - t[0] },
    };
  }

  #countDropped(cause: DropCause, line: number): void {
    const dropped = (this.#dropped[cause] ??= { count: 0, first: line });
    dropped.count += 1;
  }
}

/** Returns the distance (m) between two paths whose poses alternate in a log; 0 for one path. With two paths, many poses are far from the next pose, but near a pose a few rows later. */
function distanceOfPaths(t: Float64Array, x: Float64Array, y: Float64Array): number {
  const distancesAfterRows = (rows: number) => sampleEvenly(x.length - rows, (i) => Math.sqrt((x[i + rows] - x[i]) ** 2 + (y[i + rows] - y[i]) ** 2));
  const longStep = quantileOf(distancesAfterRows(1), 0.9);
  const countLongDistances = (rows: number) => distancesAfterRows(rows).filter((distance) => distance > longStep / 2).length;
  const hasReturnedAfter = (rows: number) => countLongDistances(rows) < MAX_LONG_FRACTION * countLongDistances(1);
  const maxRows = Math.min(MAX_RETURN_ROWS, (MAX_RETURN_SECONDS * t.length) / (t[t.length - 1] - t[0]));
  return longStep > MIN_PATH_DISTANCE && countLongDistances(1) >= MIN_LONG_STEPS && range(2, maxRows + 1).some(hasReturnedAfter) ? longStep : 0;
}

/** Returns a function that checks for a jump from the previous row to a row. */
function createJumpChecker(t: Float64Array, x: Float64Array, y: Float64Array, theta: Float64Array): (i: number) => boolean {
  const distanceToPrevious = (i: number) => Math.sqrt((x[i] - x[i - 1]) ** 2 + (y[i] - y[i - 1]) ** 2);
  const turnFromPrevious = (i: number) => Math.abs(wrapAngle(theta[i] - theta[i - 1]));
  const jumpTests = ([[distanceToPrevious, MIN_JUMP], [turnFromPrevious, MIN_JUMP_TURN]] as const).map(([lengthOfStep, minLength]) => {
    const stepRates = sampleEvenly(t.length - 1, (i) => lengthOfStep(i + 1) / (t[i + 1] - t[i]));
    const jumpLimit = JUMP_FACTOR * quantileOf(stepRates.filter((rate) => rate > MIN_MOVING_SPEED), 0.9);
    // If the robot never moves, `jumpLimit` is NaN, and only the minimum length applies.
    return (i: number) => lengthOfStep(i) > Math.max(minLength, (jumpLimit || 0) * (t[i] - t[i - 1]));
  });
  return (i) => jumpTests.some((isJumpBy) => isJumpBy(i));
}
