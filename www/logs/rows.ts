/** Rows of a log. Unusable rows are dropped, with the cause. */

import { group, max, min, range, sum } from 'd3-array';
import { LogError, type ErrorPlace } from './log-error.ts';
import type { DropCause, Log, LogKind, Note, OpenOptions, Summary } from './log.ts';
import { wrapAngle } from './path.ts';
import { quantile, sampleEvenly } from './quantile.ts';
import { distanceOf } from './summary.ts';
import { type Columns, type Units, epochTimeUnitOf, judgeUnits } from './units.ts';

/** Facts about a log that the reader of its format provides. */
interface LogFacts {
  /** Units that a name or the format states. */
  units: Units;
  /** Name of the clock of the rows, and of the other clock if there is one. */
  clocks: [string, string?];
  frames?: Summary['frames'];
  columns?: Summary['columns'];
  notes: Note[];
}

/** Maximum number of rows: a day at 100 Hz. */
const MAX_ROWS = 10_000_000;

/** Maximum coordinate or speed that the core accepts. */
export const MAX_VALUE = 1e9;

/** Minimum duration of a gap in median steps, as in the core. */
const MIN_GAP_STEPS = 5;

/** Minimum speed of a jump, as a multiple of the 90 % quantile of the speeds of a moving robot. */
const JUMP_FACTOR = 8;

/** Minimum number of rows of a log in which a single wrong stamp is looked for. */
const MIN_ROWS = 10;

/** Minimum number of different poses from which the usual number of rows of a pose is found. */
const MIN_POSES = 20;

/** Ratio of a pose's rows to the usual number, from which the robot stands. Below it, a localizer repeats the pose of a robot that has moved little. */
const STANDSTILL_FACTOR = 8;

/** Limits for overlapping rows: time between two of them, in median steps, and their number in a run of rising times and fraction of all rows. */
const [MAX_OVERLAP_STEPS, MAX_RUN_OVERLAPS, MAX_OVERLAP_FRACTION] = [0.75, 2, 0.02];

/** Maximum ratio of the path's lengths in the order of times and of the file, if rows are late, and minimum number of rows for this ratio. */
const [MAX_LATE_PATH_RATIO, MIN_LATE_ROWS] = [0.75, 20];

/**
 * Limits for two paths whose poses alternate: minimum distance (m) of the paths, and minimum number of steps between them. Shorter steps may
 * be vibrations, and fewer may be jumps. Then maximum rows and seconds until a path continues, and maximum fraction of poses far from there.
 */
const [MIN_PATH_DISTANCE, MIN_LONG_STEPS, MAX_RETURN_ROWS, MAX_RETURN_SECONDS, MAX_LONG_FRACTION] = [0.05, 20, 8, 1, 0.2];

/** Minimum length of a jump in metres and radians, above the noise of a fast log. */
const [MIN_JUMP, MIN_JUMP_TURN] = [0.1, 0.2];

/** Minimum speed of a moving robot, in m/s or rad/s. */
const MIN_MOVING_SPEED = 0.01;

/** Maximum fraction of rows that have the time of another row and other values. */
const MAX_CONTRADICTING_FRACTION = 0.4;

/** Offsets of the numbers of a row. IS_BROKEN is 1 if the path before the row is unknown. */
const [TIME, A, B, C, LINE, OTHER_TIME, IS_BROKEN, ROW_WIDTH] = [0, 1, 2, 3, 4, 5, 6, 7];

export class Rows {
  #logPlace: ErrorPlace;
  /** Numbers of the rows that were added, row by row. */
  #numbers = new Float64Array(1024 * ROW_WIDTH);
  #addedCount = 0;
  /** Offset of the times of the clock that is used. */
  #clock = TIME;
  /** True if the path before the next row is unknown, because an unusable row was dropped. */
  #isBroken = false;
  #dropped: Summary['dropped'] = {};

  /** Number of all rows, including dropped rows. */
  count = 0;

  /** @param place for errors */
  constructor(place: ErrorPlace) {
    this.#logPlace = place;
  }

  /** Drops an unusable row. */
  drop(cause: DropCause, line: number): void {
    this.count += 1;
    this.#countDropped(cause, line);
    this.#isBroken = true;
  }

  /**
   * Adds a row, or drops it.
   *
   * @param time in seconds
   * @param a x, or v
   * @param b y, or omega
   * @param c heading, or 0
   * @param line or number of the message
   * @param otherTime time by the other clock, which is used if the first one stands still
   */
  add(time: number, a: number, b: number, c: number, line: number, otherTime = 0): void {
    if (!(Number.isFinite(time) && Math.max(Math.abs(a), Math.abs(b), Math.abs(c)) <= MAX_VALUE)) return this.drop('notFinite', line);
    this.count += 1;
    if (this.count > MAX_ROWS) throw new LogError(this.#logPlace, (texts) => texts.rows(MAX_ROWS));
    const at = ROW_WIDTH * this.#addedCount++;
    if (at === this.#numbers.length) {
      const largerNumbers = new Float64Array(2 * at);
      largerNumbers.set(this.#numbers);
      this.#numbers = largerNumbers;
    }
    const numbers = this.#numbers;
    numbers[at + TIME] = time;
    numbers[at + A] = a;
    numbers[at + B] = b;
    numbers[at + C] = c;
    numbers[at + LINE] = line;
    numbers[at + OTHER_TIME] = otherTime;
    numbers[at + IS_BROKEN] = Number(this.#isBroken);
    this.#isBroken = false;
  }

  /**
   * Returns the log with the rows that were added.
   *
   * @param options answers to questions about units
   * @throws {LogError} if the remaining rows are no log, or their units are in doubt
   */
  end(name: string, kind: LogKind, { units: assumed, clocks, ...decisions }: LogFacts, options: OpenOptions = {}): Log {
    const usesOtherClock = clocks[1] !== undefined && this.#isClockStill();
    if (usesOtherClock) this.#clock = OTHER_TIME;
    const stampedRows = this.#withoutStrayTime(this.#withoutUnsetTimes());
    const start = Math.floor(min(stampedRows, (row) => this.#time(row)) ?? 0);
    const { sortedRows, lateCount } = this.#sort(stampedRows);
    const rowsOfDistinctTime = this.#withoutEqualTimes(sortedRows);
    const rows = kind === 'poses' ? this.#withoutRepeatedPoses(rowsOfDistinctTime) : rowsOfDistinctTime;
    const { count } = this;
    if (rows.length < 2) {
      const [cause, firstDrop] = (Object.entries(this.#dropped) as [DropCause, { first: number }][])[0] ?? [];
      throw new LogError(this.#placeOf(firstDrop?.first ?? 0), (texts) => texts.few(rows.length, count, cause));
    }
    const [a, b, c] = [A, B, C].map((index) => this.#column(rows, (row) => this.#number(row, index)));
    const columns: Columns = { start, t: this.#column(rows, (row) => this.#time(row) - start), a, b, c };
    const units = judgeUnits(this.#logPlace, kind, columns, assumed, options);
    const { t } = columns;
    const pathDistance = kind === 'poses' ? distanceOfPaths(t, a, b) : 0;
    if (pathDistance > 0) throw new LogError(this.#logPlace, (texts) => texts.turns(pathDistance));
    const { breaks, jumpRows, ...foundGaps } = this.#findEvents(kind, [t, a, b, c], (i) => this.#number(rows[i], IS_BROKEN) === 1);
    const data = { t, ...(kind === 'poses' ? { x: a, y: b, theta: c } : { v: a, omega: b }), breaks } as Log['data'];
    const notes: Note[] = [
      ...decisions.notes,
      ...(lateCount > 0 ? [{ name: 'sorted' as const, values: [lateCount] }] : []),
    ];
    const seconds = t[t.length - 1] - t[0];
    const clock = clocks[usesOtherClock ? 1 : 0] ?? '';
    const summary = {
      rows: count, used: t.length, dropped: this.#dropped, seconds, distance: distanceOf(data, jumpRows), ...foundGaps,
      ...decisions, ...(decisions.columns && { columns: { ...decisions.columns, t: clock } }), units, clock, notes,
    };
    return { name, kind, start: columns.start, data, summary };
  }

  /** Returns the indices of all rows that were added. */
  get #rows(): Uint32Array<ArrayBuffer> {
    return new Uint32Array(this.#addedCount).map((_, row) => row);
  }

  #number(row: number, index: number): number {
    return this.#numbers[ROW_WIDTH * row + index];
  }

  /** Returns the values of a function of rows. `Float64Array.from` would take ten times as long. */
  #column(rows: Uint32Array, numberOf: (row: number) => number): Float64Array {
    return new Float64Array(rows.length).map((_, i) => numberOf(rows[i]));
  }

  #time(row: number): number {
    return this.#number(row, this.#clock);
  }

  /** Returns true if most rows have the time of the row before: stamps may be 0, or always that of the start. */
  #isClockStill(): boolean {
    const rows = this.#rows;
    return 2 * rows.filter((row) => row > 0 && this.#time(row) === this.#time(row - 1)).length > rows.length;
  }

  /** Checks whether two rows have the same values. */
  #isSame(one: number, other: number): boolean {
    return this.#number(one, A) === this.#number(other, A) && this.#number(one, B) === this.#number(other, B) && this.#number(one, C) === this.#number(other, C);
  }

  /** Returns all rows, but those whose stamp was not set: it is 0, and all other times are since 1970. */
  #withoutUnsetTimes(): Uint32Array {
    const isUnset = (row: number) => this.#time(row) === 0;
    const isSince1970 = this.#rows.every((row) => isUnset(row) || epochTimeUnitOf(this.#time(row)) !== undefined);
    return isSince1970 ? this.#without(this.#rows, 'noStamp', isUnset) : this.#rows;
  }

  /** Returns the rows without the first or the last in time, if all others are nearer to each other than to it: its stamp is wrong. */
  #withoutStrayTime(rows: Uint32Array): Uint32Array {
    if (rows.length < MIN_ROWS) return rows;
    const times = this.#column(rows, (row) => this.#time(row)).sort();
    const [first, second, secondLast, last] = [0, 1, -2, -1].map((i) => times.at(i) as number);
    const strayTime = second - first > last - second ? first : last - secondLast > secondLast - first ? last : undefined;
    return strayTime === undefined ? rows : this.#without(rows, 'stray', (row) => this.#time(row) === strayTime);
  }

  /** Returns the rows in the order of their times, and the number of late rows. Throws a LogError if the clock was set back. */
  #sort(rows: Uint32Array): { sortedRows: Uint32Array; lateCount: number } {
    const times = this.#column(rows, (row) => this.#time(row));
    // Runs are rows with rising times.
    const runOfRow = new Uint32Array(rows.length);
    for (let i = 1; i < rows.length; i++) runOfRow[i] = runOfRow[i - 1] + Number(times[i] < times[i - 1]);
    if (!runOfRow.at(-1)) return { sortedRows: rows, lateCount: 0 };
    const order = rows.map((_, i) => i).sort((one, other) => times[one] - times[other] || one - other);
    const medianStep = quantile(sampleEvenly(times.length - 1, (i) => times[order[i + 1]] - times[order[i]]).filter((step) => step > 0), 0.5);
    const distance = (one: number, other: number) =>
      Math.hypot(this.#number(rows[one], A) - this.#number(rows[other], A), this.#number(rows[one], B) - this.#number(rows[other], B));
    // Rows overlap if they are close in time but not in the file. Rows that were only late make the path shorter when they are sorted.
    const overlaps: { run: number; sortedLength: number; fileLength: number }[] = [];
    for (let i = 1; i < order.length; i++) {
      const [one, other] = [order[i - 1], order[i]];
      const isOverlap = runOfRow[one] !== runOfRow[other] && times[other] - times[one] < MAX_OVERLAP_STEPS * medianStep && !this.#isSame(rows[one], rows[other]);
      const run = Math.max(runOfRow[one], runOfRow[other]);
      if (isOverlap) overlaps.push({ run, sortedLength: distance(one, other), fileLength: distance(other, Math.max(other, 1) - 1) });
    }
    const isSetBack = (found: typeof overlaps, maxCount: number) => {
      const hasShorterPath = sum(found, ({ sortedLength }) => sortedLength) < MAX_LATE_PATH_RATIO * sum(found, ({ fileLength }) => fileLength);
      return found.length > maxCount && !(hasShorterPath && found.length >= MIN_LATE_ROWS);
    };
    const hasManyOverlaps = isSetBack(overlaps, Math.max(MAX_RUN_OVERLAPS, MAX_OVERLAP_FRACTION * rows.length));
    const [setBackRun] = [...group(overlaps, ({ run }) => run)].find(([, found]) => hasManyOverlaps || isSetBack(found, MAX_RUN_OVERLAPS)) ?? [];
    if (setBackRun !== undefined) {
      const setBackRow = runOfRow.indexOf(setBackRun);
      const line = this.#number(rows[setBackRow], LINE);
      throw new LogError(this.#placeOf(line), (texts) => texts.setBack(times[setBackRow - 1] - times[setBackRow], this.#messageNumber(line)));
    }
    let newestTime = -Infinity;
    const isLate = (time: number) => time < (newestTime = Math.max(newestTime, time));
    return { sortedRows: order.map((i) => rows[i]), lateCount: times.filter(isLate).length };
  }

  /** Returns the rows, of which only the first one of each time is kept. Throws a LogError if many rows contradict another one of their time. */
  #withoutEqualTimes(rows: Uint32Array): Uint32Array {
    let [lastTime, contradictions] = [-Infinity, 0];
    const distinctRows = this.#without(rows, 'duplicate', (row, i) => {
      const time = this.#time(row);
      const isEqual = time <= lastTime;
      if (isEqual && !this.#isSame(rows[i - 1], row)) contradictions += 1;
      lastTime = time;
      return isEqual;
    });
    if (rows.length > 3 && contradictions > MAX_CONTRADICTING_FRACTION * rows.length) {
      const line = this.#dropped.duplicate?.first ?? 0;
      throw new LogError(this.#placeOf(line), (texts) => texts.sameTimes(contradictions, rows.length, this.#messageNumber(line)));
    }
    return distinctRows;
  }

  /**
   * Returns the rows with each pose of a moving robot kept once. A table with topics of different rates repeats the poses of the slower ones,
   * and a localizer may publish its last pose again. While the robot stands, the same fraction of rows is dropped.
   */
  #withoutRepeatedPoses(rows: Uint32Array): Uint32Array {
    const isRepeated = (i: number) => i > 0 && this.#isSame(rows[i - 1], rows[i]);
    const rowsPerPose: number[] = [];
    for (let i = 0; i < rows.length; i++) {
      if (isRepeated(i)) rowsPerPose[rowsPerPose.length - 1] += 1;
      else rowsPerPose.push(1);
    }
    const usualRowsPerPose = rowsPerPose.length < MIN_POSES ? 1 : quantile(sampleEvenly(rowsPerPose.length, (i) => rowsPerPose[i]), 0.5);
    if (usualRowsPerPose === 1) return rows;
    let [pose, repeatCount] = [-1, 0];
    return this.#without(rows, 'repeated', (_, i) => {
      [pose, repeatCount] = isRepeated(i) ? [pose, repeatCount + 1] : [pose + 1, 0];
      const isStanding = rowsPerPose[pose] >= STANDSTILL_FACTOR * usualRowsPerPose;
      return isStanding ? repeatCount % usualRowsPerPose !== 0 : repeatCount > 0;
    });
  }

  /** Returns the rows that are not dropped. A break before a dropped row is moved to the next row. */
  #without(rows: Uint32Array, cause: DropCause, isDropped: (row: number, i: number) => boolean): Uint32Array {
    return rows.filter((row, i) => {
      if (!isDropped(row, i)) return true;
      this.#countDropped(cause, this.#number(row, LINE));
      if (this.#number(row, IS_BROKEN) === 1 && i + 1 < rows.length) this.#numbers[ROW_WIDTH * rows[i + 1] + IS_BROKEN] = 1;
      return false;
    });
  }

  /** Returns the rate, the gaps, the jumps, and the breaks: rows before which the path is unknown. */
  #findEvents(kind: LogKind, [t, a, b, c]: Float64Array[], isBroken: (i: number) => boolean) {
    const medianStep = quantile(sampleEvenly(t.length - 1, (i) => t[i + 1] - t[i]), 0.5);
    const [gapRows, jumpRows, breaks]: number[][] = [[], [], []];
    const isJump = kind === 'poses' ? jumpChecker(t, a, b, c) : () => false;
    for (let i = 1; i < t.length; i++) {
      if (t[i] - t[i - 1] > MIN_GAP_STEPS * medianStep) gapRows.push(i);
      if (isJump(i)) jumpRows.push(i);
      if (jumpRows.at(-1) === i || isBroken(i)) breaks.push(i);
    }
    return {
      rate: 1 / medianStep, breaks: Uint32Array.from(breaks), jumpRows,
      gaps: { count: gapRows.length, longest: max(gapRows, (i) => t[i] - t[i - 1]) ?? 0, first: t[gapRows[0] - 1] - t[0] },
      jumps: { count: jumpRows.length, first: t[jumpRows[0]] - t[0] },
    };
  }

  #placeOf(line: number): ErrorPlace {
    return line && !this.#messageNumber(line) ? { ...this.#logPlace, line } : this.#logPlace;
  }

  /** Returns the number of a message of a recording; 0 in a table. */
  #messageNumber(line: number): number {
    return this.#logPlace.topic === undefined ? 0 : line;
  }

  #countDropped(cause: DropCause, line: number): void {
    const dropped = (this.#dropped[cause] ??= { count: 0, first: line });
    dropped.count += 1;
  }
}

/**
 * Returns the distance (m) of two paths whose poses alternate, as of two robots in one log; 0 for a single path. Of alternating paths many poses
 * are far from the next one, and near one a few rows later.
 */
function distanceOfPaths(t: Float64Array, x: Float64Array, y: Float64Array): number {
  const distancesOver = (rows: number) => sampleEvenly(x.length - rows, (i) => Math.sqrt((x[i + rows] - x[i]) ** 2 + (y[i + rows] - y[i]) ** 2));
  const longStep = quantile(distancesOver(1), 0.9);
  const countLongSteps = (rows: number) => distancesOver(rows).filter((distance) => distance > longStep / 2).length;
  const hasReturnedAfter = (rows: number) => countLongSteps(rows) < MAX_LONG_FRACTION * countLongSteps(1);
  const maxRows = Math.min(MAX_RETURN_ROWS, (MAX_RETURN_SECONDS * t.length) / (t[t.length - 1] - t[0]));
  return longStep > MIN_PATH_DISTANCE && countLongSteps(1) >= MIN_LONG_STEPS && range(2, maxRows + 1).some(hasReturnedAfter) ? longStep : 0;
}

/** Returns a function that checks for a jump between a row and the one before it. */
function jumpChecker(t: Float64Array, x: Float64Array, y: Float64Array, theta: Float64Array): (i: number) => boolean {
  const distance = (i: number) => Math.sqrt((x[i] - x[i - 1]) ** 2 + (y[i] - y[i - 1]) ** 2);
  const turn = (i: number) => Math.abs(wrapAngle(theta[i] - theta[i - 1]));
  const motionTests = ([[distance, MIN_JUMP], [turn, MIN_JUMP_TURN]] as const).map(([length, minLength]) => {
    const stepRates = sampleEvenly(t.length - 1, (i) => length(i + 1) / (t[i + 1] - t[i]));
    const jumpLimit = JUMP_FACTOR * quantile(stepRates.filter((rate) => rate > MIN_MOVING_SPEED), 0.9);
    // For a robot that never moves the limit is NaN.
    return (i: number) => length(i) > Math.max(minLength, (jumpLimit || 0) * (t[i] - t[i - 1]));
  });
  return (i) => motionTests.some((test) => test(i));
}
