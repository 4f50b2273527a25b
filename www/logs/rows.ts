/** Rows of a log. Unusable rows are dropped, with the cause. */

import { max, min, range, sum } from 'd3-array';
import { LogError, type ErrorPlace } from './log-error.ts';
import type { DropCause, Log, LogKind, Note, OpenOptions, Summary } from './log.ts';
import { LATE, SET_BACK, STRAY, rowsPerPose, sortRows } from './order.ts';
import { wrapAngle } from './path.ts';
import { quantile, sampleEvenly } from './quantile.ts';
import { distanceOf } from './summary.ts';
import { type Units, judgeUnits } from './units.ts';

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

/** Number of rows of a motion. Two motions before a gap and two after it show whether the robot drove on steadily. */
const MOTION_ROWS = 4;

/** Periods (s) after which clocks wrap around: a day, a GPS week, and 2³² counts of 1 s, 1 ms or 1 µs. */
const CLOCK_PERIODS = [86_400, 604_800, 2 ** 32, 2 ** 32 / 1e3, 2 ** 32 / 1e6];

/** Minimum period of a clock that wraps around, in median steps of its times. A clock that was set back might match a shorter period by chance. */
const MIN_PERIOD_STEPS = 500;

/**
 * Limits for two paths whose poses alternate: minimum distance (m) of the paths, and minimum number of steps between them. Shorter steps may
 * be vibrations, and fewer may be jumps. Then maximum rows and seconds until a path continues, and maximum fraction of poses far from there.
 */
const [MIN_PATH_DISTANCE, MIN_LONG_STEPS, MAX_RETURN_ROWS, MAX_RETURN_SECONDS, MAX_LONG_FRACTION] = [0.05, 20, 8, 1, 0.2];

/** Minimum length of a jump in metres and radians, above the noise of a fast log. */
const [MIN_JUMP, MIN_JUMP_TURN] = [0.1, 0.2];

/** Minimum speed of a moving robot, in m/s or rad/s. */
const MIN_MOVING_SPEED = 0.01;

/** Minimum time (s) that counts as a time since 1970: in 1973. Smaller times are relative to the start of a program. */
const MIN_EPOCH_TIME = 1e8;

/** Minimum fraction of rows in the largest part of a log whose clock was set back, and of rows that do not contradict another row of their time. */
const MIN_KEPT_FRACTION = 0.6;

/** Offsets of the numbers of a row. A time is stored as its whole seconds and, at the next offset, the fraction. */
const [SECONDS, REST, A, B, C, LINE, OTHER_SECONDS, OTHER_REST, IS_BROKEN, ROW_WIDTH] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9];

export class Rows {
  #logPlace: ErrorPlace;
  /** Numbers of the rows that were added, row by row. */
  #numbers = new Float64Array(1024 * ROW_WIDTH);
  #addedCount = 0;
  /** Offset of the whole seconds of the clock that is used. */
  #clock = SECONDS;
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
   * @param seconds whole part of the time
   * @param rest of the time, in seconds
   * @param a x, or v
   * @param b y, or omega
   * @param c heading, or 0
   * @param line or number of the message
   * @param otherSeconds whole part of the time by the other clock, which is used if the first one is mostly 0, or never changes
   * @param otherRest of the time by the other clock
   */
  add(seconds: number, rest: number, a: number, b: number, c: number, line: number, otherSeconds = 0, otherRest = 0): void {
    // A sum is finite if all of its terms are.
    if (!Number.isFinite(seconds + rest + a + b + c)) return this.drop('notFinite', line);
    this.count += 1;
    if (this.count > MAX_ROWS) throw new LogError(this.#logPlace, (say) => say.rows(MAX_ROWS));
    if (Math.max(Math.abs(a), Math.abs(b), Math.abs(c)) > MAX_VALUE) {
      const tooLargeValue = [a, b, c].find((value) => Math.abs(value) > MAX_VALUE) ?? NaN;
      throw new LogError(this.#placeOf(line), (say) => say.far(tooLargeValue, MAX_VALUE, this.#messageNumber(line)));
    }
    const at = ROW_WIDTH * this.#addedCount++;
    if (at === this.#numbers.length) {
      const largerNumbers = new Float64Array(2 * at);
      largerNumbers.set(this.#numbers);
      this.#numbers = largerNumbers;
    }
    const numbers = this.#numbers;
    numbers[at + SECONDS] = seconds;
    numbers[at + REST] = rest;
    numbers[at + A] = a;
    numbers[at + B] = b;
    numbers[at + C] = c;
    numbers[at + LINE] = line;
    numbers[at + OTHER_SECONDS] = otherSeconds;
    numbers[at + OTHER_REST] = otherRest;
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
    if (clocks[1] !== undefined) this.#sortByOtherClock();
    const usesOtherClock = this.#chooseClock(clocks[1] !== undefined);
    const rolloverLine = this.#continueClock();
    const { rows, lateCount, causes, ...times } = this.#sortAndFilter(kind);
    const brokenRows = this.#brokenRows(causes);
    const [a, b, c] = [A, B, C].map((index) => this.#column(rows, (row) => this.#number(row, index)));
    const { count } = this;
    if (rows.length < 2) {
      const [cause, firstDrop] = (Object.entries(this.#dropped) as [DropCause, { first: number }][])[0] ?? [];
      throw new LogError(this.#placeOf(firstDrop?.first ?? 0), (say) => say.few(rows.length, count, cause));
    }
    const columns = { ...times, a, b, c };
    const units = judgeUnits(this.#logPlace, kind, columns, assumed, options);
    const { start, t } = columns;
    const pathDistance = kind === 'poses' ? distanceOfPaths(t, a, b) : 0;
    if (pathDistance > 0) throw new LogError(this.#logPlace, (say) => say.turns(pathDistance));
    const { breaks, jumpRows, clockSet, ...foundGaps } = this.#findEvents(kind, [t, a, b, c], (i) => brokenRows.has(rows[i]));
    const data = { t, ...(kind === 'poses' ? { x: a, y: b, theta: c } : { v: a, omega: b }), breaks } as Log['data'];
    const notes = [
      ...decisions.notes,
      ...(clockSet ? [{ name: 'clockSet' as const, values: clockSet }] : []),
      ...(rolloverLine > 0 ? [{ name: 'rollover' as const, values: [rolloverLine] }] : []),
      ...(lateCount > 0 ? [{ name: 'sorted' as const, values: [lateCount] }] : []),
    ];
    const seconds = t[t.length - 1] - t[0];
    const clock = clocks[usesOtherClock ? 1 : 0] ?? '';
    const summary = {
      rows: count, used: t.length, dropped: this.#dropped, seconds, distance: distanceOf(data, jumpRows), ...foundGaps,
      ...decisions, ...(decisions.columns && { columns: { ...decisions.columns, t: clock } }), units, clock, notes,
    };
    return { name, kind, start, data, summary };
  }

  /** Sorts the rows by the other clock, the time of recording. Blocks of a file may be out of order. */
  #sortByOtherClock(): void {
    const numbers = this.#numbers;
    const compareTimes = (one: number, other: number) =>
      this.#number(one, OTHER_SECONDS) - this.#number(other, OTHER_SECONDS) || this.#number(one, OTHER_REST) - this.#number(other, OTHER_REST);
    let row = 1;
    while (row < this.#addedCount && compareTimes(row - 1, row) <= 0) row += 1;
    if (row >= this.#addedCount) return;
    const order = this.#rows.sort(compareTimes);
    this.#numbers = new Float64Array(numbers.length);
    for (const [rank, from] of order.entries()) this.#numbers.set(numbers.subarray(ROW_WIDTH * from, ROW_WIDTH * (from + 1)), ROW_WIDTH * rank);
  }

  /** Switches to the other clock if the first one is mostly 0, or never changes. Returns true if it did. */
  #chooseClock(hasOther: boolean): boolean {
    const isFrozen = () => this.#rows.every((row) => this.#time(row, 0) === this.#time(0, 0));
    if (!hasOther || (2 * this.#rows.filter((row) => this.#isUnset(row)).length <= this.#addedCount && !isFrozen())) return false;
    this.#clock = OTHER_SECONDS;
    return true;
  }

  /**
   * Unwraps a clock that begins at 0 again after a period. Returns the line or message number of the first row after a wrap; 0 if there is
   * none.
   */
  #continueClock(): number {
    const numbers = this.#numbers;
    const timeSteps = new Float64Array(this.#addedCount).map((_, row) => (row > 0 ? this.#time(row, this.#number(row - 1, this.#clock)) - this.#number(row - 1, this.#clock + 1) : 0));
    const medianStep = quantile(sampleEvenly(timeSteps.length - 1, (i) => Math.abs(timeSteps[i + 1])), 0.5);
    const periods = CLOCK_PERIODS.filter((period) => period > MIN_PERIOD_STEPS * medianStep);
    let [passedTime, firstLine] = [0, 0];
    for (const [row, step] of timeSteps.entries()) {
      // A late row from before the wrap is a forward step, and subtracts the period again.
      const period = step < 0 || passedTime > 0 ? periods.find((clockPeriod) => Math.abs(Math.abs(step) - clockPeriod) <= MIN_GAP_STEPS * medianStep) : undefined;
      if (period) {
        passedTime -= Math.sign(step) * period;
        firstLine ||= this.#number(row, LINE);
      }
      numbers[ROW_WIDTH * row + this.#clock] += Math.floor(passedTime);
      numbers[ROW_WIDTH * row + this.#clock + 1] += passedTime - Math.floor(passedTime);
    }
    return firstLine;
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

  /** Returns the time of a row in seconds after a start. */
  #time(row: number, start: number): number {
    return this.#number(row, this.#clock) - start + this.#number(row, this.#clock + 1);
  }

  #isUnset(row: number): boolean {
    return this.#number(row, this.#clock) === 0 && this.#number(row, this.#clock + 1) === 0;
  }

  /** Checks whether two rows have the same values. */
  #isSame(one: number, other: number): boolean {
    return this.#number(one, A) === this.#number(other, A) && this.#number(one, B) === this.#number(other, B) && this.#number(one, C) === this.#number(other, C);
  }

  /** Returns the kept rows in the order of their times, the number of late rows, and the causes for dropping rows. */
  #sortAndFilter(kind: LogKind): { start: number; t: Float64Array; rows: Uint32Array; lateCount: number; causes: Map<number, DropCause> } {
    const causes = new Map<number, DropCause>();
    // If all other times are since 1970, a stamp of 0 was not set.
    const rowsWithStamp = this.#rows.filter((row) => !this.#isUnset(row));
    const isSince1970 = rowsWithStamp.every((row) => this.#number(row, this.#clock) > MIN_EPOCH_TIME);
    const usedRows = isSince1970 ? rowsWithStamp : this.#rows;
    const baseSecond = Math.floor(this.#number(usedRows[0], this.#clock));
    const times = this.#column(usedRows, (row) => this.#time(row, baseSecond));
    const { order, rowClasses, firstSetBackRow, largestPartSize } = sortRows(times, (one, other) => this.#isSame(usedRows[one], usedRows[other]));
    if (firstSetBackRow >= 0 && largestPartSize < MIN_KEPT_FRACTION * times.length) {
      const line = this.#number(usedRows[firstSetBackRow], LINE);
      throw new LogError(this.#placeOf(line), (say) => say.setBack(times[firstSetBackRow - 1] - times[firstSetBackRow], this.#messageNumber(line)));
    }

    // The start is computed from the first row in time. A difference to the first row in the file might be too large to be exact.
    const sortedRows = order.map((i) => usedRows[i]);
    const [seconds, fraction] = [this.#clock, this.#clock + 1].map((index) => this.#number(sortedRows[0], index));
    const start = Math.floor(seconds) + Math.floor(seconds - Math.floor(seconds) + fraction);
    let [last, differentRows] = [-Infinity, 0];
    let rows = sortedRows.filter((row, i) => {
      const time = this.#time(row, start);
      if (i === 0 || time > last) {
        last = time;
        return true;
      }
      causes.set(row, 'duplicate');
      if (!this.#isSame(sortedRows[i - 1], row)) differentRows += 1;
      return false;
    });
    if (sortedRows.length > 3 && differentRows > (1 - MIN_KEPT_FRACTION) * sortedRows.length) {
      const line = this.#number(min(causes.keys()) as number, LINE);
      throw new LogError(this.#placeOf(line), (say) => say.sameTimes(differentRows, sortedRows.length, this.#messageNumber(line)));
    }
    const timesOf = (chosen: Uint32Array) => this.#column(chosen, (row) => this.#time(row, start));
    const rowsOfDistinctTime = rows;
    const isRepeated = (i: number) => i > 0 && this.#isSame(rowsOfDistinctTime[i - 1], rowsOfDistinctTime[i]);
    const repeatsPerPose = kind === 'poses' ? rowsPerPose(timesOf(rowsOfDistinctTime), isRepeated) : 1;
    let repeatCount = 0;
    // Every `repeatsPerPose`-th of repeated poses is kept, so that the log has the same rate while the robot stands.
    if (repeatsPerPose > 1) {
      rows = rowsOfDistinctTime.filter((row, i) => {
        repeatCount = isRepeated(i) ? repeatCount + 1 : 0;
        if (repeatCount % repeatsPerPose !== 0) causes.set(row, 'repeated');
        return repeatCount % repeatsPerPose === 0;
      });
    }
    usedRows.forEach((row, i) => {
      if (rowClasses[i] === STRAY || rowClasses[i] === SET_BACK) causes.set(row, rowClasses[i] === STRAY ? 'stray' : 'setBack');
    });
    if (usedRows.length < this.#addedCount) for (const row of this.#rows) if (this.#isUnset(row)) causes.set(row, 'noStamp');
    return { start, t: timesOf(rows), rows, lateCount: rowClasses.reduce((count, rowClass) => count + Number(rowClass === LATE), 0), causes };
  }

  /** Returns the rows before which the path is unknown: after unusable rows, and where the clock was set back. Counts the dropped rows. */
  #brokenRows(causes: Map<number, DropCause>): Set<number> {
    const rowsAfterBreak = new Set<number>();
    let isAfterBreak = false;
    for (let row = 0; row < this.#addedCount; row++) {
      const cause = causes.get(row);
      isAfterBreak ||= this.#number(row, IS_BROKEN) === 1 || cause === 'setBack';
      if (cause) this.#countDropped(cause, this.#number(row, LINE));
      else if (isAfterBreak) {
        rowsAfterBreak.add(row);
        isAfterBreak = false;
      }
    }
    return rowsAfterBreak;
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
    // Several such gaps are not a clock: some localizers publish only while the robot moves.
    const [setRow, ...moreRows] = kind === 'poses' ? gapRows.filter((i) => isSetForward(t, a, b, i, medianStep)) : [];
    return {
      rate: 1 / medianStep, breaks: Uint32Array.from(breaks), jumpRows,
      gaps: { count: gapRows.length, longest: max(gapRows, (i) => t[i] - t[i - 1]) ?? 0, first: t[gapRows[0] - 1] - t[0] },
      jumps: { count: jumpRows.length, first: t[jumpRows[0]] - t[0] },
      clockSet: moreRows.length === 0 && setRow !== undefined && [t[setRow - 1] - t[0], t[setRow] - t[setRow - 1]],
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

/** Returns true if the clock was set forward in a gap: after it a robot drives on steadily from its last pose. */
function isSetForward(t: Float64Array, x: Float64Array, y: Float64Array, i: number, medianStep: number): boolean {
  const motion = (from: number, to: number) => [x[to] - x[from], y[to] - y[from]];
  const motions = [i - 1 - 2 * MOTION_ROWS, i - 1 - MOTION_ROWS, i, i + MOTION_ROWS].map((from) => motion(from, from + MOTION_ROWS));
  const motionLengths = motions.map(([dx, dy]) => Math.hypot(dx, dy));
  const minLength = Math.min(...motionLengths);
  const isStraight = Math.hypot(sum(motions, ([dx]) => dx), sum(motions, ([, dy]) => dy)) > 0.95 * sum(motionLengths);
  const isSteady = minLength > 0.7 * Math.max(...motionLengths);
  // After delayed messages, the next rows would follow in quick succession.
  return isStraight && isSteady && MOTION_ROWS * Math.hypot(...motion(i - 1, i)) < 2 * minLength && t[i + MOTION_ROWS] - t[i] > 0.5 * MOTION_ROWS * medianStep;
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
