/** Collector of the rows of a log. Unusable rows are dropped, and counted by cause. */

import { group, max, min, range, sum } from 'd3-array';
import { COLUMN_CHANGES } from './columns.ts';
import { LogError, type ErrorPlace, type DropCause, type Log, type LogKind, type LogNote, type OpenOptions, type ErrorReason, type LogSummary, type LogTexts } from './log.ts';
import { distanceOf, quantileOf, sampleEvenly, wrapAngle } from './path.ts';
import { epochTimeUnitOf, judgeUnits, type SampleColumns, type CreateColumnQuestion, type LogUnits } from './units.ts';

/** Sample of a log: a pose (x, y and heading) or a command (v, omega and 0). `sampleTime` is in s; 0 if unknown. The heading is undefined if the quaternion is not a rotation. */
export interface LogSample {
  sampleTime: number;
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
  assumedUnits: LogUnits;
  /** Name of the first clock, and name of the fallback clock if there is one. */
  clockNames: [string, string?];
  frames?: LogSummary['frames'];
  columns?: LogSummary['columns'];
  notes: LogNote[];
  createColumnQuestion?: CreateColumnQuestion;
}

/** Maximum number of rows in a log, about a day at 100 Hz. */
const MAX_ROWS = 10_000_000;

/** Maximum absolute value of a coordinate or speed that the core accepts. */
export const MAX_VALUE = 1e9;

/** Minimum duration of a gap, in median steps between rows. The core uses the same number. */
const MIN_GAP_STEPS = 5;

/** Number of rows over which the time between rows is averaged. A burst has fewer rows. */
const AVERAGED_ROWS = 20;

/** Maximum time between two rows that arrive together, as a multiple of the mean time, and minimum fraction of such rows in a log of bursts. */
const [MAX_BURST_STEP, MIN_BURST_FRACTION] = [0.3, 0.55];

/** Minimum speed of a jump, as a multiple of a moving robot's usual speed (90 % quantile). */
const JUMP_FACTOR = 8;

/** Minimum number of different poses from which to judge how often a log usually repeats a pose. */
const MIN_POSES = 20;

/** Minimum number of repetitions of a pose that shows a standing robot, as a multiple of the usual number. A localizer also repeats poses while the robot moves slowly. */
const STANDSTILL_FACTOR = 8;

/** Limits for overlaps of runs, which are sequences of rows with rising times: maximum time between overlapping rows, in median steps; maximum overlaps of a run; maximum fraction of all rows. */
const [MAX_OVERLAP_STEPS, MAX_RUN_OVERLAPS, MAX_OVERLAP_FRACTION] = [0.75, 2, 0.02];

/** Limits for rows that are late: maximum length of the path in order of time, relative to its length in order of the file, and minimum number of late rows. */
const [MAX_LATE_PATH_RATIO, MIN_LATE_ROWS] = [0.75, 20];

/** Limits for finding a log whose rows alternate between two paths: minimum distance (m) between the paths, and minimum number of steps from one to the other. A single path has shorter or fewer such steps. */
const [MIN_PATH_DISTANCE, MIN_LONG_STEPS] = [0.05, 20];

/**
 * Limits for two paths whose rows alternate: maximum number of rows, and of seconds, until the same path continues; maximum number of long steps
 * within a path, as a fraction of the long steps between successive rows.
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
  /** Columns of the rows that were added. */
  #rowColumns = { rowTimes: [] as number[], a: [] as number[], b: [] as number[], c: [] as number[], z: [] as number[], lineNumbers: [] as number[], otherTime: [] as number[] };
  #tiltCosines: number[] = [];
  /** Times of the clock in use, which is the first or the fallback clock. */
  #times = this.#rowColumns.rowTimes;
  #droppedRows: LogSummary['dropped'] = {};
  /** Number of damaged rows, and line and reason of the first damaged row. */
  #damagedRows: { damagedCount: number; firstLine: number; formatReason: ErrorReason } | undefined;

  /** Number of all rows, including dropped rows. */
  rowCount = 0;

  /** @param logPlace file and topic that error messages name */
  constructor(logPlace: ErrorPlace) {
    this.#logPlace = logPlace;
  }

  /** Drops a row. If too many rows are dropped with a reason, the log is refused with the reason given for the first such row. */
  dropRow(dropCause: DropCause, lineNumber: number, formatReason?: ErrorReason): void {
    this.rowCount += 1;
    this.#countDropped(dropCause, lineNumber);
    if (formatReason) this.#damagedRows = { firstLine: lineNumber, formatReason, ...this.#damagedRows, damagedCount: (this.#damagedRows?.damagedCount ?? 0) + 1 };
  }

  /** Adds a row, or drops it if it is unusable. `otherTime` is the time by the fallback clock, which is used if the first clock stands still. */
  addRow({ sampleTime: rowTime, a, b, c, z = 0, tiltCosine }: LogSample, lineNumber: number, otherTime = 0): void {
    if (c === undefined) return this.dropRow('noRotation', lineNumber);
    if (!(Number.isFinite(rowTime) && Math.max(Math.abs(a), Math.abs(b), Math.abs(c)) <= MAX_VALUE)) return this.dropRow('notFinite', lineNumber);
    this.rowCount += 1;
    if (this.rowCount > MAX_ROWS) throw new LogError(this.#logPlace, (errorReasons) => errorReasons.tooManyRowsReason(MAX_ROWS));
    const rowColumns = this.#rowColumns;
    rowColumns.rowTimes.push(rowTime);
    rowColumns.a.push(a);
    rowColumns.b.push(b);
    rowColumns.c.push(c);
    rowColumns.z.push(z);
    if (tiltCosine !== undefined) this.#tiltCosines.push(tiltCosine);
    rowColumns.lineNumbers.push(lineNumber);
    rowColumns.otherTime.push(otherTime);
  }

  /** Spread of the cosine of the tilt: the difference between its 95 % and 5 % quantiles. A small spread shows that Z is the vertical axis. */
  get tiltCosineSpread(): number {
    const [lowQuantile, highQuantile] = [0.05, 0.95].map((quantileFraction) => quantileOf(sampleEvenly(this.#tiltCosines.length, (i) => this.#tiltCosines[i]), quantileFraction));
    return highQuantile - lowQuantile || 0;
  }

  /** Returns the log of the rows that were added. Throws a LogError if the rows do not form a log, or if their units or axes are in doubt. */
  buildLog(logName: string, logKind: LogKind, { assumedUnits, clockNames, createColumnQuestion, ...logDecisions }: LogFacts, openOptions: OpenOptions = {}): Log {
    const { rowCount } = this;
    const damagedRows = this.#damagedRows;
    if (damagedRows && damagedRows.damagedCount > MAX_DAMAGED_FRACTION * rowCount) {
      const composeSentences = (errorReasons: LogTexts['refusalReasons']) => [damagedRows.formatReason(errorReasons), ...(damagedRows.damagedCount > 1 && damagedRows.damagedCount < rowCount ? [errorReasons.damagedRowsReason(damagedRows.damagedCount, rowCount, 100 * MAX_DAMAGED_FRACTION)] : [])];
      throw new LogError({ ...this.#logPlace, lineNumber: damagedRows.firstLine }, (errorReasons) => composeSentences(errorReasons).join(' '));
    }
    if (this.tiltCosineSpread > MAX_TILT_SPREAD) throw new LogError(this.#logPlace, (errorReasons) => errorReasons.tiltedPosesReason);
    const usesOtherClock = clockNames[1] !== undefined && this.#isClockStill();
    if (usesOtherClock) this.#times = this.#rowColumns.otherTime;
    const stampedRows = this.#dropUnsetTimes();
    const startTime = Math.floor(min(stampedRows, (rowIndex) => this.#times[rowIndex]) ?? 0);
    const { sortedRows, lateCount } = this.#sortByTime(stampedRows);
    const rowsOfDistinctTime = this.#dropEqualTimes(sortedRows);
    const rowIndices = this.#dropBursts(logKind === 'poses' ? this.#dropRepeatedPoses(rowsOfDistinctTime) : rowsOfDistinctTime);
    if (rowIndices.length < 2) {
      const [dropCause, firstDroppedRows] = (Object.entries(this.#droppedRows) as [DropCause, { first: number }][])[0] ?? [];
      throw new LogError({ ...this.#logPlace, lineNumber: firstDroppedRows?.first }, (errorReasons) => errorReasons.fewRowsReason(rowIndices.length, rowCount, dropCause));
    }
    const [rowTimes, a, b, c, z] = [this.#times, this.#rowColumns.a, this.#rowColumns.b, this.#rowColumns.c, this.#rowColumns.z].map((rowColumn) => new Float64Array(rowIndices.length).map((_, i) => rowColumn[rowIndices[i]]));
    const t = rowTimes.map((rowTime) => rowTime - startTime);
    const sampleColumns: SampleColumns = { startTime, t, a, b, c, z };
    const judgedUnits = judgeUnits(this.#logPlace, logKind, sampleColumns, assumedUnits, openOptions, createColumnQuestion);
    const pathDistance = logKind === 'poses' ? distanceOfPaths(t, a, b) : 0;
    if (pathDistance > 0) throw new LogError(this.#logPlace, (errorReasons) => errorReasons.alternatingPathsReason(pathDistance));
    const { jumpRows, ...eventSummary } = findEvents(logKind, [t, a, b, c]);
    const motionData = { t, ...(logKind === 'poses' ? { x: a, y: b, theta: c } : { v: a, omega: b }), breaks: Uint32Array.from(jumpRows) } as Log['motionData'];
    const logNotes: LogNote[] = [
      ...logDecisions.notes,
      ...(lateCount > 0 ? [{ name: 'sorted' as const, values: [lateCount] }] : []),
    ];
    const seconds = t[t.length - 1] - t[0];
    const clockName = clockNames[usesOtherClock ? 1 : 0] ?? '';
    const logSummary = {
      rows: rowCount, used: t.length, dropped: this.#droppedRows, seconds, distance: distanceOf(motionData, jumpRows), ...eventSummary,
      ...logDecisions, ...(logDecisions.columns && { columns: { ...logDecisions.columns, t: clockName } }), units: judgedUnits, clock: clockName, notes: logNotes,
    };
    return { logName, logKind, startTime: sampleColumns.startTime, motionData, logSummary, ...(createColumnQuestion && { mirroringQuestion: createColumnQuestion(COLUMN_CHANGES.mirrored) }) };
  }

  /** Returns true if most rows have the same time as the row before, because the stamps are 0 or never change. */
  #isClockStill(): boolean {
    const { rowTimes } = this.#rowColumns;
    return 2 * rowTimes.filter((rowTime, rowIndex) => rowTime === rowTimes[rowIndex - 1]).length > rowTimes.length;
  }

  #hasSameValues(rowIndex: number, otherRowIndex: number): boolean {
    const { a, b, c } = this.#rowColumns;
    return a[rowIndex] === a[otherRowIndex] && b[rowIndex] === b[otherRowIndex] && c[rowIndex] === c[otherRowIndex];
  }

  /** Drops the rows whose stamp was not set: their stamp is 0, although all others are times since 1970. Returns the remaining rows. */
  #dropUnsetTimes(): Uint32Array {
    const rowIndices = new Uint32Array(this.#times.length).map((_, rowIndex) => rowIndex);
    const isSince1970 = this.#times.every((rowTime) => rowTime === 0 || epochTimeUnitOf(rowTime) !== undefined);
    return isSince1970 ? this.#dropRows(rowIndices, 'noStamp', (rowIndex) => this.#times[rowIndex] === 0) : rowIndices;
  }

  /** Returns the rows sorted by time, and the number of late rows. Throws a LogError if the clock was set back. */
  #sortByTime(rowIndices: Uint32Array): { sortedRows: Uint32Array; lateCount: number } {
    const { a, b } = this.#rowColumns;
    const rowTimes = Array.from(rowIndices, (rowIndex) => this.#times[rowIndex]);
    // Runs are sequences of rows in the file with rising times.
    const runIndexOfRow = new Uint32Array(rowIndices.length);
    for (let i = 1; i < rowIndices.length; i++) runIndexOfRow[i] = runIndexOfRow[i - 1] + Number(rowTimes[i] < rowTimes[i - 1]);
    if (!runIndexOfRow.at(-1)) return { sortedRows: rowIndices, lateCount: 0 };
    const sortedOrder = rowIndices.map((_, i) => i).sort((sortPosition, otherPosition) => rowTimes[sortPosition] - rowTimes[otherPosition] || sortPosition - otherPosition);
    const medianStep = quantileOf(sampleEvenly(rowTimes.length - 1, (i) => rowTimes[sortedOrder[i + 1]] - rowTimes[sortedOrder[i]]).filter((timeStep) => timeStep > 0), 0.5);
    const distanceBetween = (sortPosition: number, otherPosition: number) => Math.hypot(a[rowIndices[sortPosition]] - a[rowIndices[otherPosition]], b[rowIndices[sortPosition]] - b[rowIndices[otherPosition]]);
    // Two runs overlap where a row of one has nearly the time of a row of the other. If the rows of a run were only written late, sorting by time shortens
    // the path. If the clock was set back, sorting lengthens the path, because it mixes two parts of the drive.
    const runOverlaps: { runIndex: number; sortedLength: number; fileLength: number }[] = [];
    for (let i = 1; i < sortedOrder.length; i++) {
      const [previousPosition, sortPosition] = [sortedOrder[i - 1], sortedOrder[i]];
      const isOverlap = runIndexOfRow[previousPosition] !== runIndexOfRow[sortPosition] && rowTimes[sortPosition] - rowTimes[previousPosition] < MAX_OVERLAP_STEPS * medianStep && !this.#hasSameValues(rowIndices[previousPosition], rowIndices[sortPosition]);
      const runIndex = Math.max(runIndexOfRow[previousPosition], runIndexOfRow[sortPosition]);
      if (isOverlap) runOverlaps.push({ runIndex, sortedLength: distanceBetween(previousPosition, sortPosition), fileLength: distanceBetween(sortPosition, Math.max(sortPosition, 1) - 1) });
    }
    const isClockSetBack = (overlapsOfRun: typeof runOverlaps, maxCount: number) => {
      const hasShorterPath = sum(overlapsOfRun, ({ sortedLength }) => sortedLength) < MAX_LATE_PATH_RATIO * sum(overlapsOfRun, ({ fileLength }) => fileLength);
      return overlapsOfRun.length > maxCount && !(hasShorterPath && overlapsOfRun.length >= MIN_LATE_ROWS);
    };
    const hasManyOverlaps = isClockSetBack(runOverlaps, Math.max(MAX_RUN_OVERLAPS, MAX_OVERLAP_FRACTION * rowIndices.length));
    const [setBackRun] = [...group(runOverlaps, ({ runIndex }) => runIndex)].find(([, overlapsOfRun]) => hasManyOverlaps || isClockSetBack(overlapsOfRun, MAX_RUN_OVERLAPS)) ?? [];
    if (setBackRun !== undefined) {
      const setBackRow = runIndexOfRow.indexOf(setBackRun);
      const lineNumber = this.#rowColumns.lineNumbers[rowIndices[setBackRow]];
      throw new LogError({ ...this.#logPlace, lineNumber }, (errorReasons) => errorReasons.clockSetBackReason(rowTimes[setBackRow - 1] - rowTimes[setBackRow]));
    }
    let newestTime = -Infinity;
    const isLate = (rowTime: number) => rowTime < (newestTime = Math.max(newestTime, rowTime));
    return { sortedRows: sortedOrder.map((i) => rowIndices[i]), lateCount: rowTimes.filter(isLate).length };
  }

  /** Returns the first row of each time. Throws a LogError if too many rows have the same time as another row, but other values. */
  #dropEqualTimes(rowIndices: Uint32Array): Uint32Array {
    let [lastTime, contradictionCount] = [-Infinity, 0];
    const distinctRows = this.#dropRows(rowIndices, 'duplicate', (rowIndex, i) => {
      const rowTime = this.#times[rowIndex];
      const isEqual = rowTime <= lastTime;
      if (isEqual && !this.#hasSameValues(rowIndices[i - 1], rowIndex)) contradictionCount += 1;
      lastTime = rowTime;
      return isEqual;
    });
    if (rowIndices.length > 3 && contradictionCount > MAX_CONTRADICTING_FRACTION * rowIndices.length) {
      const lineNumber = this.#droppedRows.duplicate?.first;
      throw new LogError({ ...this.#logPlace, lineNumber }, (errorReasons) => errorReasons.equalTimesReason(contradictionCount, rowIndices.length));
    }
    return distinctRows;
  }

  /**
   * Drops rows that repeat the previous pose, and returns the others. Localizers, and slow topics in a table with faster ones, repeat their last pose
   * until the next one. Of a standing robot, rows are kept at the rate of new poses of a moving robot.
   */
  #dropRepeatedPoses(rowIndices: Uint32Array): Uint32Array {
    const isRepeated = (i: number) => i > 0 && this.#hasSameValues(rowIndices[i - 1], rowIndices[i]);
    const rowsPerPose: number[] = [];
    for (let i = 0; i < rowIndices.length; i++) {
      if (isRepeated(i)) rowsPerPose[rowsPerPose.length - 1] += 1;
      else rowsPerPose.push(1);
    }
    const usualRowsPerPose = rowsPerPose.length < MIN_POSES ? 1 : quantileOf(sampleEvenly(rowsPerPose.length, (i) => rowsPerPose[i]), 0.5);
    if (usualRowsPerPose === 1) return rowIndices;
    let [poseIndex, repeatCount] = [-1, 0];
    return this.#dropRows(rowIndices, 'repeated', (_, i) => {
      [poseIndex, repeatCount] = isRepeated(i) ? [poseIndex, repeatCount + 1] : [poseIndex + 1, 0];
      const isStanding = rowsPerPose[poseIndex] >= STANDSTILL_FACTOR * usualRowsPerPose;
      return isStanding ? repeatCount % usualRowsPerPose !== 0 : repeatCount > 0;
    });
  }

  /** If most rows arrive together with the next one, only the last row of each burst is kept: the times of the others are those of their arrival. */
  #dropBursts(rowIndices: Uint32Array): Uint32Array {
    const timeBetween = (i: number, j: number) => this.#times[rowIndices[j]] - this.#times[rowIndices[i]];
    const meanStep = quantileOf(sampleEvenly(rowIndices.length - AVERAGED_ROWS, (i) => timeBetween(i, i + AVERAGED_ROWS)), 0.5) / AVERAGED_ROWS;
    const arrivesWithNext = (i: number) => timeBetween(i, i + 1) < MAX_BURST_STEP * meanStep;
    const hasBursts = rowIndices.filter((_, i) => arrivesWithNext(i)).length > MIN_BURST_FRACTION * rowIndices.length;
    return hasBursts ? this.#dropRows(rowIndices, 'burst', (_, i) => arrivesWithNext(i)) : rowIndices;
  }

  /** Returns the rows for which `isDropped` is false. */
  #dropRows(rowIndices: Uint32Array, dropCause: DropCause, isDropped: (rowIndex: number, i: number) => boolean): Uint32Array {
    const { lineNumbers } = this.#rowColumns;
    return rowIndices.filter((rowIndex, i) => {
      if (!isDropped(rowIndex, i)) return true;
      this.#countDropped(dropCause, lineNumbers[rowIndex]);
      return false;
    });
  }

  #countDropped(dropCause: DropCause, lineNumber: number): void {
    const droppedRows = (this.#droppedRows[dropCause] ??= { count: 0, first: lineNumber });
    droppedRows.count += 1;
  }
}

/** Returns the rate, the gaps and the jumps of a log. */
function findEvents(logKind: LogKind, [t, a, b, c]: Float64Array[]) {
  const medianStep = quantileOf(sampleEvenly(t.length - 1, (i) => t[i + 1] - t[i]), 0.5);
  const rowIndices = range(1, t.length);
  const gapRows = rowIndices.filter((i) => t[i] - t[i - 1] > MIN_GAP_STEPS * medianStep);
  const jumpRows = logKind === 'poses' ? rowIndices.filter(createJumpChecker(t, a, b, c)) : [];
  return {
    rate: 1 / medianStep, jumpRows,
    gaps: { count: gapRows.length, longest: max(gapRows, (i) => t[i] - t[i - 1]) ?? 0, first: t[gapRows[0] - 1] - t[0] },
    jumps: { count: jumpRows.length, first: t[jumpRows[0]] - t[0] },
  };
}

/** Returns the distance (m) between two paths whose poses alternate in a log; 0 for one path. With two paths, many poses are far from the next pose, but near a pose a few rows later. */
function distanceOfPaths(t: Float64Array, x: Float64Array, y: Float64Array): number {
  const distancesAfterRows = (rowCount: number) => sampleEvenly(x.length - rowCount, (i) => Math.sqrt((x[i + rowCount] - x[i]) ** 2 + (y[i + rowCount] - y[i]) ** 2));
  const longStep = quantileOf(distancesAfterRows(1), 0.9);
  const countLongDistances = (rowCount: number) => distancesAfterRows(rowCount).filter((rowDistance) => rowDistance > longStep / 2).length;
  const hasReturnedAfter = (rowCount: number) => countLongDistances(rowCount) < MAX_LONG_FRACTION * countLongDistances(1);
  const maxRows = Math.min(MAX_RETURN_ROWS, (MAX_RETURN_SECONDS * t.length) / (t[t.length - 1] - t[0]));
  return longStep > MIN_PATH_DISTANCE && countLongDistances(1) >= MIN_LONG_STEPS && range(2, maxRows + 1).some(hasReturnedAfter) ? longStep : 0;
}

/** Returns a function that checks for a jump from the previous row to a row. */
function createJumpChecker(t: Float64Array, x: Float64Array, y: Float64Array, theta: Float64Array): (i: number) => boolean {
  const distanceToPrevious = (i: number) => Math.sqrt((x[i] - x[i - 1]) ** 2 + (y[i] - y[i - 1]) ** 2);
  const turnFromPrevious = (i: number) => Math.abs(wrapAngle(theta[i] - theta[i - 1]));
  const jumpTests = ([[distanceToPrevious, MIN_JUMP], [turnFromPrevious, MIN_JUMP_TURN]] as const).map(([lengthOfStep, minLength]) => {
    const stepRates = sampleEvenly(t.length - 1, (i) => lengthOfStep(i + 1) / (t[i + 1] - t[i]));
    const jumpLimit = JUMP_FACTOR * quantileOf(stepRates.filter((stepRate) => stepRate > MIN_MOVING_SPEED), 0.9);
    // If the robot never moves, `jumpLimit` is NaN, and only the minimum length applies.
    return (i: number) => lengthOfStep(i) > Math.max(minLength, (jumpLimit || 0) * (t[i] - t[i - 1]));
  });
  return (i) => jumpTests.some((isJumpBy) => isJumpBy(i));
}
