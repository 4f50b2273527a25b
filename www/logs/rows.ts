/** Rows of a log. Unusable rows are dropped, with the cause. */

import { LogError, type Place } from './log-error.ts';
import type { Cause, Log, LogKind, Note, OpenOptions, Summary } from './log.ts';
import { KEPT, LATE, STRAY, repeatFactor, sortRows } from './order.ts';
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
const [SECONDS, REST, A, B, C, LINE, OTHER_SECONDS, OTHER_REST, WIDTH] = [0, 1, 2, 3, 4, 5, 6, 7, 8];

export class Rows {
  #place: Place;
  /** Numbers of the rows that were added, row by row. */
  #numbers = new Float64Array(1024 * WIDTH);
  #added = 0;
  /** Index of the seconds of the clock that is used. */
  #clock = SECONDS;
  /** Rows before which the path is unknown, because unusable rows were dropped. */
  #broken = new Set<number>();
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
    this.#broken.add(this.#added);
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
    const { rows, late, ...times } = this.#inOrder(kind);
    const [a, b, c] = [A, B, C].map((column) => {
      const values = new Float64Array(rows.length);
      for (let i = 0; i < rows.length; i++) values[i] = this.#numbers[WIDTH * rows[i] + column];
      return values;
    });
    const { count } = this;
    if (rows.length < 2) {
      const [cause, dropped] = (Object.entries(this.#dropped) as [Cause, { first: number }][])[0] ?? [];
      throw new LogError(this.#placeOf(dropped?.first ?? 0), (say) => say.few(rows.length, count, cause));
    }
    const columns = { ...times, a, b, c };
    const units = judgeUnits(this.#place, kind, columns, assumed, options);
    const { start, t } = columns;
    const { breaks, jumped, ...found } = this.#events(kind, [t, a, b, c], rows);
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
      numbers[WIDTH * one + OTHER_SECONDS] - numbers[WIDTH * other + OTHER_SECONDS] || numbers[WIDTH * one + OTHER_REST] - numbers[WIDTH * other + OTHER_REST];
    let row = 1;
    while (row < this.#added && compare(row - 1, row) <= 0) row += 1;
    if (row >= this.#added) return;
    const order = Uint32Array.from({ length: this.#added }, (_, each) => each).sort(compare);
    this.#numbers = new Float64Array(numbers.length);
    for (const [rank, from] of order.entries()) this.#numbers.set(numbers.subarray(WIDTH * from, WIDTH * (from + 1)), WIDTH * rank);
    const broken = this.#broken;
    this.#broken = new Set([...order.keys()].filter((rank) => broken.has(order[rank])));
  }

  /** Switches to the other clock if the first one is mostly 0. @returns whether it did */
  #chooseClock(hasOther: boolean): boolean {
    let unset = 0;
    for (let row = 0; row < this.#added; row++) if (this.#isUnset(row)) unset += 1;
    if (!hasOther || 2 * unset <= this.#added) return false;
    this.#clock = OTHER_SECONDS;
    return true;
  }

  #seconds(row: number): number {
    return this.#numbers[WIDTH * row + this.#clock];
  }

  #rest(row: number): number {
    return this.#numbers[WIDTH * row + this.#clock + 1];
  }

  #line(row: number): number {
    return this.#numbers[WIDTH * row + LINE];
  }

  #isUnset(row: number): boolean {
    return this.#seconds(row) === 0 && this.#rest(row) === 0;
  }

  /** Checks whether two rows have the same values. */
  #isSame(one: number, other: number): boolean {
    const numbers = this.#numbers;
    const [i, j] = [WIDTH * one, WIDTH * other];
    return numbers[i + A] === numbers[j + A] && numbers[i + B] === numbers[j + B] && numbers[i + C] === numbers[j + C];
  }

  /** Returns the kept rows in the order of their times, which are all different, and the number of late rows. */
  #inOrder(kind: LogKind): { start: number; t: Float64Array; rows: Uint32Array; late: number } {
    // If other times are since 1970, a stamp of 0 means that it was not set.
    let first = Infinity;
    for (let row = 0; row < this.#added; row++) if (!this.#isUnset(row)) first = Math.min(first, this.#seconds(row));
    const isSince1970 = first > MIN_EPOCH_TIME && first < Infinity;
    let stamped = new Uint32Array(this.#added);
    let count = 0;
    for (let row = 0; row < this.#added; row++) if (!(isSince1970 && this.#isUnset(row))) stamped[count++] = row;
    stamped = stamped.subarray(0, count);
    const base = Math.floor(this.#seconds(stamped[0]));
    const times = new Float64Array(count);
    for (let i = 0; i < count; i++) times[i] = this.#seconds(stamped[i]) - base + this.#rest(stamped[i]);
    const { order, classes, setBack, largest } = sortRows(times, (one, other) => this.#isSame(stamped[one], stamped[other]));
    if (setBack >= 0 && largest < MIN_FRACTION * times.length) {
      const line = this.#line(stamped[setBack]);
      throw new LogError(this.#placeOf(line), (say) => say.setBack(times[setBack - 1] - times[setBack], this.#messageNumber(line)));
    }

    // The start is computed from the first row in time. A difference to the first row in the file might be too large to be exact.
    const [seconds, rest] = [this.#seconds(stamped[order[0]]), this.#rest(stamped[order[0]])];
    const start = Math.floor(seconds) + Math.floor(seconds - Math.floor(seconds) + rest);
    const t = new Float64Array(order.length);
    const rows = new Uint32Array(order.length);
    const isDropped = new Map<number, Cause>();
    let [used, different] = [0, 0];
    for (let i = 0; i < order.length; i++) {
      const row = stamped[order[i]];
      const time = this.#seconds(row) - start + this.#rest(row);
      if (used > 0 && time <= t[used - 1]) {
        isDropped.set(row, 'duplicate');
        if (!this.#isSame(stamped[order[i - 1]], row)) different += 1;
        continue;
      }
      rows[used] = row;
      t[used] = time;
      used += 1;
    }
    if (order.length > 3 && different > (1 - MIN_FRACTION) * order.length) {
      const line = this.#line([...isDropped.keys()].reduce((first, row) => Math.min(first, row)));
      throw new LogError(this.#placeOf(line), (say) => say.sameTimes(different, order.length, this.#messageNumber(line)));
    }
    const isRepeated = (i: number) => this.#isSame(rows[i - 1], rows[i]);
    const factor = kind === 'poses' ? repeatFactor(t.subarray(0, used), isRepeated) : 1;
    if (factor > 1) {
      const repeats = Array.from({ length: used }, (_, i) => i > 0 && isRepeated(i));
      let kept = 0;
      for (let i = 0, run = 0; i < used; i++) {
        run = repeats[i] ? run + 1 : 0;
        // Every `factor`-th of repeated poses is kept, so that the log has the same rate while the robot stands.
        if (run % factor !== 0) {
          isDropped.set(rows[i], 'repeated');
          continue;
        }
        rows[kept] = rows[i];
        t[kept] = t[i];
        kept += 1;
      }
      used = kept;
    }
    let late = 0;
    for (let i = 0; i < classes.length; i++) {
      if (classes[i] === LATE) late += 1;
      else if (classes[i] !== KEPT) isDropped.set(stamped[i], classes[i] === STRAY ? 'stray' : 'setBack');
    }
    for (let row = 0; row < this.#added && count < this.#added; row++) {
      if (isSince1970 && this.#isUnset(row)) isDropped.set(row, 'noStamp');
    }
    this.#dropAdded(isDropped);
    return { start, t: t.slice(0, used), rows: rows.slice(0, used), late };
  }

  /** Drops rows that were added. The path is continuous across them, unless the clock was set back. */
  #dropAdded(rows: Map<number, Cause>): void {
    for (const row of [...rows.keys()].sort((one, other) => one - other)) {
      const cause = rows.get(row) as Cause;
      this.#countDropped(cause, this.#line(row));
      if (cause === 'setBack' || this.#broken.delete(row)) this.#broken.add(row + 1);
    }
  }

  /** Returns the rate, the gaps, the jumps, and the rows before which the path is unknown. */
  #events(kind: LogKind, [t, a, b, c]: Float64Array[], rows: Uint32Array) {
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
      } else if (this.#broken.has(rows[i])) breaks.push(i);
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
