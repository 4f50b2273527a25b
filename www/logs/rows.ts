/** Rows of a log. Unusable rows are dropped, with the cause. */

import { min } from 'd3-array';
import { LogError, type Place } from './log-error.ts';
import type { Cause, Log, LogKind, Note, OpenOptions, Summary } from './log.ts';
import { LATE, SET_BACK, STRAY, repeatFactor, sortRows } from './order.ts';
import { quantile, sample } from './quantile.ts';
import { distanceOf } from './summary.ts';
import { type Units, judgeUnits } from './units.ts';

/** Facts about a log that the reader of its format knows. */
interface Decisions {
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

/** Minimum length of a jump in metres and radians, above the noise of a fast log. */
const [MIN_JUMP, MIN_JUMP_TURN] = [0.1, 0.2];

/** Minimum speed of a moving robot, in m/s or rad/s. */
const MIN_MOVING_SPEED = 0.01;

/** Minimum of times since 1970, s: the year 1973. Smaller times count from the start of a program. */
const MIN_EPOCH_TIME = 1e8;

/** Minimum fraction of rows that remain if the clock was set back, and minimum fraction of rows with different times. */
const MIN_FRACTION = 0.6;

/** Indices of the numbers of a row. The whole seconds of a time have one index, and the rest has the next. */
const [SECONDS, REST, A, B, C, LINE, OTHER_SECONDS, OTHER_REST, IS_BROKEN, WIDTH] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9];

export class Rows {
  #place: Place;
  /** Numbers of the rows that were added, row by row. */
  #numbers = new Float64Array(1024 * WIDTH);
  #added = 0;
  /** Index of the seconds of the clock that is used. */
  #clock = SECONDS;
  /** True if the path before the next row is unknown, because an unusable row was dropped. */
  #isBroken = false;
  #dropped: Summary['dropped'] = {};

  /** Number of all rows, including dropped ones. */
  count = 0;

  /** @param place for errors */
  constructor(place: Place) {
    this.#place = place;
  }

  /** Drops an unusable row. */
  drop(cause: Cause, line: number): void {
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
   * @param otherSeconds whole part of the time by the other clock, which is used if the first one stands at 0
   * @param otherRest of the time by the other clock
   */
  add(seconds: number, rest: number, a: number, b: number, c: number, line: number, otherSeconds = 0, otherRest = 0): void {
    // A sum is finite if all of its terms are.
    if (!Number.isFinite(seconds + rest + a + b + c)) return this.drop('notFinite', line);
    this.count += 1;
    if (this.count > MAX_ROWS) throw new LogError(this.#place, (say) => say.rows(MAX_ROWS));
    if (Math.max(Math.abs(a), Math.abs(b), Math.abs(c)) > MAX_VALUE) {
      const far = [a, b, c].find((value) => Math.abs(value) > MAX_VALUE) ?? NaN;
      throw new LogError(this.#placeOf(line), (say) => say.far(far, MAX_VALUE, this.#messageNumber(line)));
    }
    const at = WIDTH * this.#added++;
    if (at === this.#numbers.length) {
      const grown = new Float64Array(2 * at);
      grown.set(this.#numbers);
      this.#numbers = grown;
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
  end(name: string, kind: LogKind, { units: assumed, clocks, ...decisions }: Decisions, options: OpenOptions = {}): Log {
    if (clocks[1] !== undefined) this.#sortByOtherClock();
    const usesOther = this.#chooseClock(clocks[1] !== undefined);
    const { rows, late, causes, ...times } = this.#inOrder(kind);
    const broken = this.#brokenRows(causes);
    const [a, b, c] = [A, B, C].map((index) => this.#column(rows, (row) => this.#number(row, index)));
    const { count } = this;
    if (rows.length < 2) {
      const [cause, dropped] = (Object.entries(this.#dropped) as [Cause, { first: number }][])[0] ?? [];
      throw new LogError(this.#placeOf(dropped?.first ?? 0), (say) => say.few(rows.length, count, cause));
    }
    const columns = { ...times, a, b, c };
    const units = judgeUnits(this.#place, kind, columns, assumed, options);
    const { start, t } = columns;
    const { breaks, jumped, ...found } = this.#events(kind, [t, a, b, c], (i) => broken.has(rows[i]));
    const data = { t, ...(kind === 'poses' ? { x: a, y: b, theta: c } : { v: a, omega: b }), breaks } as Log['data'];
    const notes = late > 0 ? [...decisions.notes, { name: 'sorted' as const, values: [late] }] : decisions.notes;
    const seconds = t[t.length - 1] - t[0];
    const summary = {
      rows: count, used: t.length, dropped: this.#dropped, seconds, distance: distanceOf(data, jumped), ...found,
      ...decisions, units, clock: clocks[usesOther ? 1 : 0] ?? '', notes,
    };
    return { name, kind, start, data, summary };
  }

  /** Sorts the rows by the other clock, that of recording. Blocks of a file may be out of order. */
  #sortByOtherClock(): void {
    const numbers = this.#numbers;
    const compare = (one: number, other: number) =>
      this.#number(one, OTHER_SECONDS) - this.#number(other, OTHER_SECONDS) || this.#number(one, OTHER_REST) - this.#number(other, OTHER_REST);
    let row = 1;
    while (row < this.#added && compare(row - 1, row) <= 0) row += 1;
    if (row >= this.#added) return;
    const order = this.#rows.sort(compare);
    this.#numbers = new Float64Array(numbers.length);
    for (const [rank, from] of order.entries()) this.#numbers.set(numbers.subarray(WIDTH * from, WIDTH * (from + 1)), WIDTH * rank);
  }

  /** Switches to the other clock if the first one is mostly 0. @returns whether it did */
  #chooseClock(hasOther: boolean): boolean {
    if (!hasOther || 2 * this.#rows.filter((row) => this.#isUnset(row)).length <= this.#added) return false;
    this.#clock = OTHER_SECONDS;
    return true;
  }

  /** Returns the indices of all rows that were added. */
  get #rows(): Uint32Array<ArrayBuffer> {
    return new Uint32Array(this.#added).map((_, row) => row);
  }

  #number(row: number, index: number): number {
    return this.#numbers[WIDTH * row + index];
  }

  /** Returns the values of a function of rows. The `from` of typed arrays would take ten times as long. */
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

  /** Returns the kept rows in the order of their times, which are all different, the number of late rows, and causes for dropping others. */
  #inOrder(kind: LogKind): { start: number; t: Float64Array; rows: Uint32Array; late: number; causes: Map<number, Cause> } {
    const causes = new Map<number, Cause>();
    // If other times are since 1970, a stamp of 0 means that it was not set.
    const withStamp = this.#rows.filter((row) => !this.#isUnset(row));
    const isSince1970 = withStamp.every((row) => this.#number(row, this.#clock) > MIN_EPOCH_TIME);
    const stamped = isSince1970 ? withStamp : this.#rows;
    const base = Math.floor(this.#number(stamped[0], this.#clock));
    const times = this.#column(stamped, (row) => this.#time(row, base));
    const { order, classes, setBack, largest } = sortRows(times, (one, other) => this.#isSame(stamped[one], stamped[other]));
    if (setBack >= 0 && largest < MIN_FRACTION * times.length) {
      const line = this.#number(stamped[setBack], LINE);
      throw new LogError(this.#placeOf(line), (say) => say.setBack(times[setBack - 1] - times[setBack], this.#messageNumber(line)));
    }

    // The start is computed from the first row in time. A difference to the first row in the file might be too large to be exact.
    const sorted = order.map((i) => stamped[i]);
    const [seconds, rest] = [this.#clock, this.#clock + 1].map((index) => this.#number(sorted[0], index));
    const start = Math.floor(seconds) + Math.floor(seconds - Math.floor(seconds) + rest);
    let [last, different] = [-Infinity, 0];
    let rows = sorted.filter((row, i) => {
      const time = this.#time(row, start);
      if (i === 0 || time > last) {
        last = time;
        return true;
      }
      causes.set(row, 'duplicate');
      if (!this.#isSame(sorted[i - 1], row)) different += 1;
      return false;
    });
    if (sorted.length > 3 && different > (1 - MIN_FRACTION) * sorted.length) {
      const line = this.#number(min(causes.keys()) as number, LINE);
      throw new LogError(this.#placeOf(line), (say) => say.sameTimes(different, sorted.length, this.#messageNumber(line)));
    }
    const timesOf = (chosen: Uint32Array) => this.#column(chosen, (row) => this.#time(row, start));
    const distinct = rows;
    const isRepeated = (i: number) => i > 0 && this.#isSame(distinct[i - 1], distinct[i]);
    const factor = kind === 'poses' ? repeatFactor(timesOf(distinct), isRepeated) : 1;
    let repeats = 0;
    // Every `factor`-th of repeated poses is kept, so that the log has the same rate while the robot stands.
    if (factor > 1) {
      rows = distinct.filter((row, i) => {
        repeats = isRepeated(i) ? repeats + 1 : 0;
        if (repeats % factor !== 0) causes.set(row, 'repeated');
        return repeats % factor === 0;
      });
    }
    stamped.forEach((row, i) => {
      if (classes[i] === STRAY || classes[i] === SET_BACK) causes.set(row, classes[i] === STRAY ? 'stray' : 'setBack');
    });
    if (stamped.length < this.#added) for (const row of this.#rows) if (this.#isUnset(row)) causes.set(row, 'noStamp');
    return { start, t: timesOf(rows), rows, late: classes.reduce((count, each) => count + Number(each === LATE), 0), causes };
  }

  /** Returns the rows before which the path is unknown: after unusable rows, and where the clock was set back. Counts the dropped rows. */
  #brokenRows(causes: Map<number, Cause>): Set<number> {
    const broken = new Set<number>();
    let isBroken = false;
    for (let row = 0; row < this.#added; row++) {
      const cause = causes.get(row);
      isBroken ||= this.#number(row, IS_BROKEN) === 1 || cause === 'setBack';
      if (cause) this.#countDropped(cause, this.#number(row, LINE));
      else if (isBroken) {
        broken.add(row);
        isBroken = false;
      }
    }
    return broken;
  }

  /** Returns the rate, the gaps, the jumps, and the rows before which the path is unknown. */
  #events(kind: LogKind, [t, a, b, c]: Float64Array[], isBroken: (i: number) => boolean) {
    const step = quantile(sample(t.length - 1, (i) => t[i + 1] - t[i]), 0.5);
    const gaps = { count: 0, longest: 0, first: NaN };
    const jumps = { count: 0, first: NaN };
    const [breaks, jumped]: number[][] = [[], []];
    const isJump = kind === 'poses' ? jumpTest(t, a, b, c) : () => false;
    for (let i = 1; i < t.length; i++) {
      const pause = t[i] - t[i - 1];
      if (pause > MIN_GAP_STEPS * step) {
        if (gaps.count === 0) gaps.first = t[i - 1] - t[0];
        gaps.count += 1;
        gaps.longest = Math.max(gaps.longest, pause);
      }
      if (isJump(i)) {
        if (jumps.count === 0) jumps.first = t[i] - t[0];
        jumps.count += 1;
        jumped.push(i);
        breaks.push(i);
      } else if (isBroken(i)) breaks.push(i);
    }
    return { rate: 1 / step, gaps, jumps, jumped, breaks: Uint32Array.from(breaks) };
  }

  #placeOf(line: number): Place {
    return line && !this.#messageNumber(line) ? { ...this.#place, line } : this.#place;
  }

  /** Returns the number of a message of a recording; 0 in a table. */
  #messageNumber(line: number): number {
    return this.#place.topic === undefined ? 0 : line;
  }

  #countDropped(cause: Cause, line: number): void {
    const dropped = (this.#dropped[cause] ??= { count: 0, first: line });
    dropped.count += 1;
  }
}

/** Returns a function that checks for a jump between a row and the one before it. */
function jumpTest(t: Float64Array, x: Float64Array, y: Float64Array, theta: Float64Array): (i: number) => boolean {
  const distance = (i: number) => Math.sqrt((x[i] - x[i - 1]) ** 2 + (y[i] - y[i - 1]) ** 2);
  const turn = (i: number) => {
    const difference = theta[i] - theta[i - 1];
    return Math.abs(difference - 2 * Math.PI * Math.round(difference / (2 * Math.PI)));
  };
  const tests = ([[distance, MIN_JUMP], [turn, MIN_JUMP_TURN]] as const).map(([length, least]) => {
    const rates = sample(t.length - 1, (i) => length(i + 1) / (t[i + 1] - t[i]));
    const limit = JUMP_FACTOR * quantile(rates.filter((rate) => rate > MIN_MOVING_SPEED), 0.9);
    // For a robot that never moves the limit is NaN.
    return (i: number) => length(i) > Math.max(least, (limit || 0) * (t[i] - t[i - 1]));
  });
  return (i) => tests.some((test) => test(i));
}
