/** The rows of a log as they are found: what is kept, and what is left out and why. */

import { ROWS_A_LOOK } from '../../../figure/breath.js';
import { LogError } from './refusal.js';

/**
 * @import { Place } from './refusal.js'
 *
 * @typedef {object} Trouble how often, and where first
 * @property {number} count
 * @property {number} line of the file, or number of the message, from 1; 0 where there was none
 * @property {number} t seconds after the log's start; NaN where it has no time
 *
 * @typedef {'notFinite' | 'noRotation' | 'short' | 'duplicate' | 'falling' | 'held'} Reason why a row is left out
 *
 * @typedef {object} How what was made of the source
 * @property {'csv' | 'tum' | 'mcap'} format
 * @property {'s' | 'ms' | 'us' | 'ns'} unit of the times
 * @property {'name' | 'size' | 'format'} unitBy what told it: the column's name, the size of the numbers, or the format
 * @property {'radians' | 'degrees' | 'quaternion' | 'none'} heading
 * @property {Record<string, string>} columns what was found in which column, or in which topic
 * @property {boolean} hasBoth whether there are both poses and commands, of which these are one
 * @property {boolean} cutShort whether the file ends in the middle of a row or record
 * @property {[string, string, string]} [apart] of a reference that has no time in common with the odometry: the name of that, and the
 *   times of both
 * @property {string} [swapped] of a reference that is called as odometry is: the name of what is taken for that
 *
 * @typedef {object} Found
 * @property {number} rows
 * @property {Record<Reason, Trouble>} leftOut
 * @property {Trouble & { longest: number }} gaps pauses of more than five usual steps, the longest in seconds
 * @property {Trouble} jumps steps that are much faster than the others
 * @property {number} step the usual one, in seconds
 *
 * @typedef {object} Breaks
 * @property {Uint32Array} breaks the rows, rising, before which nothing is known of the way: where rows were of no use, or the log
 *   jumps; pauses, which the core finds itself, are not among them
 *
 * @typedef {{ t: Float64Array, x: Float64Array, y: Float64Array, theta: Float64Array } & Breaks} Poses s, m, rad
 *
 * @typedef {{ t: Float64Array, v: Float64Array, omega: Float64Array } & Breaks} Commands s, m/s, rad/s
 *
 * @typedef {object} Log
 * @property {string} name of the file, with the topic if there is one
 * @property {'poses' | 'commands'} kind
 * @property {number} start whole seconds that were taken from all times
 * @property {Poses | Commands} data as the core takes it: times rise strictly, in seconds after the start
 * @property {How} how
 * @property {Found} found
 */

/** The clock of messages without stamps. */
export const LOG_TIME = 'log time';

/** Rows at most: a day at 100 Hz. */
export const MAX_ROWS = 10_000_000;

/** What the core takes at most of coordinates and the like: those of any map of a country. */
export const MAX_VALUE = 1e9;

/** A pause is longer than this many usual steps, as the core has it. */
const STEPS_OF_A_GAP = 5;

/** A jump is this much faster than nine in ten of the steps that move at all. */
const TIMES_FASTER = 8;

/** A jump leads at least this far, in metres or radians: the noise of a fast log is none. */
const [FAR, TURNED] = [0.1, 0.2];

/** Slower than this, in metres or radians a second, a robot stands. */
const STANDS = 0.01;

/** Steps that are looked at to know the usual one. */
const SAMPLED = 10_000;

/** Seconds between two rows at most. */
const SLOWEST = 1000;

/** Rows for which there is room at first. */
const ROOM = 4096;

/** @returns {Trouble} */
const none = () => ({ count: 0, line: 0, t: NaN });

export class Rows {
  #place;
  #count = 0;
  #kept = 0;
  #start = NaN;
  #columns = [0, 1, 2, 3].map(() => new Float64Array(ROOM));
  /** @type {Record<Reason, Trouble>} */
  #leftOut = { notFinite: none(), noRotation: none(), short: none(), duplicate: none(), falling: none(), held: none() };
  /** Whether, since the last row that was kept, there was a time of which nothing is known. */
  #broken = false;
  /** How many rows in a row went back in time. */
  #late = 0;
  /** @type {number[]} */
  #breaks = [];
  #lastLine = 0;

  /** @param {Place} place that refusals name */
  constructor(place) {
    this.#place = place;
  }

  /** @param {Reason} reason @param {number} line @param {number} [t] */
  leaveOut(reason, line, t = NaN) {
    this.#count += 1;
    this.#note(reason, line, t);
  }

  /**
   * @param {number} seconds whole ones of the time
   * @param {number} rest of the time
   * @param {number} a
   * @param {number} b
   * @param {number} c
   * @param {number} line or number of the message
   */
  add(seconds, rest, a, b, c, line) {
    this.#count += 1;
    if (this.#count > MAX_ROWS) throw new LogError(this.#place, (say) => say.rows(MAX_ROWS));
    // The sum is finite where all are.
    if (!Number.isFinite(seconds + rest)) return this.#note('notFinite', line, NaN);
    if (this.#kept === 0) this.#start = Math.floor(seconds) - (rest < 0 ? 1 : 0);
    const at = seconds - this.#start + rest;
    if (!Number.isFinite(a + b + c)) return this.#note('notFinite', line, at);
    const far = [a, b, c].find((value) => Math.abs(value) > MAX_VALUE);
    if (far !== undefined) throw new LogError(this.#at(line), (say) => say.far(far, MAX_VALUE, this.#message(line)));
    const t = this.#columns[0];
    const last = this.#kept - 1;
    if (last >= 0 && at === t[last]) return this.#note('duplicate', line, at);
    if (last >= 0 && at < t[last]) {
      // One time that is far ahead must not make all that follow late: it is then the one that is left out.
      if (last === 0 || at <= t[last - 1]) return this.#note('falling', line, at);
      this.#note('falling', this.#lastLine, t[last]);
      this.#kept -= 1;
      if (this.#breaks.at(-1) === this.#kept) {
        this.#breaks.pop();
        this.#broken = true;
      }
    }
    if (this.#kept === t.length) this.#columns = this.#columns.map(grown);
    if (this.#broken && this.#kept > 0) this.#breaks.push(this.#kept);
    this.#broken = false;
    this.#late = 0;
    const [times, first, second, third] = this.#columns;
    times[this.#kept] = at;
    first[this.#kept] = a;
    second[this.#kept] = b;
    third[this.#kept] = c;
    this.#kept += 1;
    this.#lastLine = line;
  }

  get count() {
    return this.#count;
  }

  /**
   * @param {string} name
   * @param {'poses' | 'commands'} kind
   * @param {How} how
   * @param {(share: number) => Promise<void>} breathe
   * @returns {Promise<Log>} rejects with a LogError where what is left is no log
   */
  async end(name, kind, how, breathe) {
    const [t, x, y, theta] = this.#columns.map((column) => column.slice(0, this.#kept));
    const { falling } = this.#leftOut;
    const count = this.#count;
    if (2 * falling.count > count) throw new LogError(this.#at(falling.line), (say) => say.falling(falling.count, count, this.#message(falling.line)));
    if (this.#kept < 2) {
      const [reason, first] = Object.entries(this.#leftOut).find(([, { count }]) => count > 0) ?? ['few', none()];
      throw new LogError(this.#at(first.line), (say) => say.few(this.#kept, count, say.reasons[/** @type {Reason} */ (reason)] ?? ''));
    }
    const step = quantile(sample(t.length - 1, (i) => t[i + 1] - t[i]), 0.5);
    // A robot of which there is a row in a quarter of an hour is not logged: the unit is another one.
    if (step > SLOWEST) throw new LogError(this.#place, (say) => say.unit(step, how.unit));
    const gaps = { ...none(), longest: 0 };
    const jumps = { ...none(), rows: /** @type {number[]} */ ([]) };
    const jumped = kind === 'poses' ? jumping(t, x, y, theta) : () => false;
    for (let i = 1; i < t.length; i++) {
      if (i % ROWS_A_LOOK === 0) await breathe(1);
      const pause = t[i] - t[i - 1];
      if (pause > STEPS_OF_A_GAP * step) {
        if (gaps.count === 0) gaps.t = t[i - 1];
        gaps.count += 1;
        gaps.longest = Math.max(gaps.longest, pause);
      }
      if (!jumped(i)) continue;
      if (jumps.count === 0) jumps.t = t[i];
      jumps.count += 1;
      jumps.rows.push(i);
    }
    const { rows, ...counted } = jumps;
    const breaks = Uint32Array.from(new Set([...this.#breaks, ...rows])).sort();
    return {
      name,
      kind,
      start: this.#start,
      data: kind === 'poses' ? { t, x, y, theta, breaks } : { t, v: x, omega: y, breaks },
      how,
      found: { rows: count, leftOut: this.#leftOut, gaps, jumps: counted, step },
    };
  }

  /** @param {number} line @returns {Place} */
  #at(line) {
    return line && !this.#message(line) ? { ...this.#place, line } : this.#place;
  }

  /** The number of a message, which a recording has for lines; 0 of a table. @param {number} line */
  #message(line) {
    return this.#place.topic === undefined ? 0 : line;
  }

  /** @param {Reason} reason @param {number} line @param {number} t */
  #note(reason, line, t) {
    const trouble = this.#leftOut[reason];
    if (trouble.count === 0) Object.assign(trouble, { line, t });
    trouble.count += 1;
    if (reason === 'falling') this.#late += 1;
    // No hole is where a time is told twice, nor one row late: those beside it are known. Two that go back are of a clock that was set.
    if (!(reason === 'duplicate' || (reason === 'falling' && this.#late < 2))) this.#broken = true;
  }
}

/** @param {Float64Array<ArrayBuffer>} column */
function grown(column) {
  const larger = new Float64Array(2 * column.length);
  larger.set(column);
  return larger;
}

/**
 * @param {number} count
 * @param {(i: number) => number} value
 * @returns {Float64Array} of all of them, or of many that are evenly spread
 */
function sample(count, value) {
  const every = Math.ceil(count / SAMPLED);
  return Float64Array.from({ length: Math.ceil(count / every) }, (_, i) => value(i * every));
}

/** @param {Float64Array} values @param {number} share */
function quantile(values, share) {
  return values.length ? values.sort()[Math.floor(share * (values.length - 1))] : 0;
}

/**
 * @param {Float64Array} t
 * @param {Float64Array} x
 * @param {Float64Array} y
 * @param {Float64Array} theta
 * @returns {(i: number) => boolean} whether the log jumps before a row
 */
function jumping(t, x, y, theta) {
  const way = (/** @type {number} */ i) => Math.hypot(x[i] - x[i - 1], y[i] - y[i - 1]);
  const turn = (/** @type {number} */ i) => {
    const turned = theta[i] - theta[i - 1];
    return Math.abs(turned - 2 * Math.PI * Math.round(turned / (2 * Math.PI)));
  };
  const far = /** @type {[typeof way, number][]} */ ([[way, FAR], [turn, TURNED]]).map(([length, least]) => {
    const rates = sample(t.length - 1, (i) => length(i + 1) / (t[i + 1] - t[i]));
    const limit = TIMES_FASTER * quantile(rates.filter((rate) => rate > STANDS), 0.9);
    return (/** @type {number} */ i) => {
      const each = length(i);
      return each > least && each > limit * (t[i] - t[i - 1]);
    };
  });
  return (i) => far[0](i) || far[1](i);
}
