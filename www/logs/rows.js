/** Rows of a log: which are kept, and which are left out and why. */

import { LogError } from './log-error.js';
import { distanceOf } from './summary.ts';

/**
 * @import { Cause, Log } from './log.ts'
 * @import { Place } from './log-error.js'
 *
 * @typedef {Pick<import('./log.ts').Summary, 'units' | 'clock' | 'frames' | 'columns' | 'notes'>} Decisions
 */

/** Most rows: a day at 100 Hz. */
const MAX_ROWS = 10_000_000;

/** Largest coordinate or speed that the core accepts. */
export const MAX_VALUE = 1e9;

/** Usual steps in a pause, as in the core. */
const STEPS_OF_A_GAP = 5;

/** Speed of a jump in units of the 90 % quantile of the moving steps. */
const TIMES_FASTER = 8;

/** Least length of a jump in metres and radians: the noise of a fast log is none. */
const [FAR, TURNED] = [0.1, 0.2];

/** Speed in metres or radians a second below which a robot stands. */
const STANDS = 0.01;

/** Most steps that the quantiles are taken from. */
const SAMPLED = 10_000;

/** Longest usual step in seconds. */
const SLOWEST = 1000;

export class Rows {
  #place;
  #start = NaN;
  /** Times of the rows that are kept. @type {number[]} */
  #t = [];
  /** @type {number[]} */
  #a = [];
  /** @type {number[]} */
  #b = [];
  /** @type {number[]} */
  #c = [];
  /** @type {Log['summary']['dropped']} */
  #dropped = {};
  /** True if the path since the last row that was kept is unknown. */
  #broken = false;
  /** Rows in succession that went back in time. */
  #late = 0;
  /** @type {number[]} */
  #breaks = [];
  #lastLine = 0;

  /** All rows, with those that are left out. */
  count = 0;

  /** @param {Place} place for errors */
  constructor(place) {
    this.#place = place;
  }

  /** @param {Cause} reason @param {number} line */
  leaveOut(reason, line) {
    this.count += 1;
    this.#note(reason, line);
  }

  /**
   * Adds a row, or leaves it out.
   *
   * @param {number} seconds whole part of the time
   * @param {number} rest of the time, in seconds
   * @param {number} a x, or v
   * @param {number} b y, or omega
   * @param {number} c heading, or 0
   * @param {number} line or number of the message
   */
  add(seconds, rest, a, b, c, line) {
    this.count += 1;
    if (this.count > MAX_ROWS) throw new LogError(this.#place, (say) => say.rows(MAX_ROWS));
    const t = this.#t;
    // A sum is finite if all of its terms are.
    if (!Number.isFinite(seconds + rest)) return this.#note('notFinite', line);
    if (t.length === 0) this.#start = Math.floor(seconds) - (rest < 0 ? 1 : 0);
    const at = seconds - this.#start + rest;
    if (!Number.isFinite(a + b + c)) return this.#note('notFinite', line);
    if (Math.max(Math.abs(a), Math.abs(b), Math.abs(c)) > MAX_VALUE) {
      const far = [a, b, c].find((value) => Math.abs(value) > MAX_VALUE) ?? NaN;
      throw new LogError(this.#at(line), (say) => say.far(far, MAX_VALUE, this.#message(line)));
    }
    const last = t.length - 1;
    if (at === t[last]) return this.#note('duplicate', line);
    if (at < t[last]) {
      // One time that is far ahead must not make all later ones late: then that one is left out.
      if (last === 0 || at <= t[last - 1]) return this.#note('falling', line);
      this.#note('falling', this.#lastLine);
      for (const column of [t, this.#a, this.#b, this.#c]) column.pop();
      if (this.#breaks.at(-1) === last) {
        this.#breaks.pop();
        this.#broken = true;
      }
    }
    if (this.#broken && t.length > 0) this.#breaks.push(t.length);
    this.#broken = false;
    this.#late = 0;
    t.push(at);
    this.#a.push(a);
    this.#b.push(b);
    this.#c.push(c);
    this.#lastLine = line;
  }

  /**
   * Finishes the log.
   *
   * @param {string} name
   * @param {'poses' | 'commands'} kind
   * @param {Decisions} decisions
   * @returns {Log}
   * @throws {LogError} if the rows that are left are no log
   */
  end(name, kind, decisions) {
    const [t, x, y, theta] = [this.#t, this.#a, this.#b, this.#c].map((column) => new Float64Array(column));
    const { count } = this;
    const { falling } = this.#dropped;
    if (falling && 2 * falling.count > count) {
      throw new LogError(this.#at(falling.first), (say) => say.falling(falling.count, count, this.#message(falling.first)));
    }
    if (t.length < 2) {
      const cause = /** @type {Cause[]} */ (['notFinite', 'noRotation', 'short', 'duplicate', 'falling']).find((each) => this.#dropped[each]);
      throw new LogError(this.#at(cause ? (this.#dropped[cause]?.first ?? 0) : 0), (say) => say.few(t.length, count, cause));
    }
    const step = quantile(sample(t.length - 1, (i) => t[i + 1] - t[i]), 0.5);
    // A log with one row in a quarter of an hour has times in another unit.
    if (step > SLOWEST) throw new LogError(this.#place, (say) => say.unit(step, decisions.units.time.unit));
    const gaps = { count: 0, longest: 0, first: NaN };
    const jumps = { count: 0, first: NaN };
    const breaks = new Set(this.#breaks);
    const isJump = kind === 'poses' ? jumpTest(t, x, y, theta) : () => false;
    for (let i = 1; i < t.length; i++) {
      const pause = t[i] - t[i - 1];
      if (pause > STEPS_OF_A_GAP * step) {
        if (gaps.count === 0) gaps.first = this.#start + t[i - 1];
        gaps.count += 1;
        gaps.longest = Math.max(gaps.longest, pause);
      }
      if (!isJump(i)) continue;
      if (jumps.count === 0) jumps.first = this.#start + t[i];
      jumps.count += 1;
      breaks.add(i);
    }
    const all = { breaks: Uint32Array.from(breaks).sort() };
    const data = kind === 'poses' ? { t, x, y, theta, ...all } : { t, v: x, omega: y, ...all };
    const summary = {
      rows: count, used: t.length, dropped: this.#dropped, seconds: t[t.length - 1] - t[0], rate: 1 / step, distance: distanceOf(data), gaps, jumps, ...decisions,
    };
    return { name, kind, start: this.#start, data, summary };
  }

  /** @param {number} line @returns {Place} */
  #at(line) {
    return line && !this.#message(line) ? { ...this.#place, line } : this.#place;
  }

  /** Number of a message of a recording; 0 in a table. @param {number} line */
  #message(line) {
    return this.#place.topic === undefined ? 0 : line;
  }

  /** @param {Cause} reason @param {number} line */
  #note(reason, line) {
    const dropped = (this.#dropped[reason] ??= { count: 0, first: line });
    dropped.count += 1;
    if (reason === 'falling') this.#late += 1;
    // A repeated time or one late row leaves no hole, as the rows beside it are known. Two late rows mean that the clock was set.
    if (!(reason === 'duplicate' || (reason === 'falling' && this.#late < 2))) this.#broken = true;
  }
}

/** Evaluates many evenly spread items. @param {number} count @param {(i: number) => number} value */
function sample(count, value) {
  const every = Math.ceil(count / SAMPLED);
  return Float64Array.from({ length: Math.ceil(count / every) }, (_, i) => value(i * every));
}

/** Quantile of values, which are sorted; 0 of none. @param {Float64Array} values @param {number} share */
const quantile = (values, share) => values.sort()[Math.floor(share * (values.length - 1))] ?? 0;

/**
 * Returns a test for a jump just before a row.
 *
 * @param {Float64Array} t
 * @param {Float64Array} x
 * @param {Float64Array} y
 * @param {Float64Array} theta
 * @returns {(i: number) => boolean}
 */
function jumpTest(t, x, y, theta) {
  const distance = (/** @type {number} */ i) => Math.hypot(x[i] - x[i - 1], y[i] - y[i - 1]);
  const turn = (/** @type {number} */ i) => {
    const difference = theta[i] - theta[i - 1];
    return Math.abs(difference - 2 * Math.PI * Math.round(difference / (2 * Math.PI)));
  };
  const tests = /** @type {[typeof turn, number][]} */ ([[distance, FAR], [turn, TURNED]]).map(([length, least]) => {
    const rates = sample(t.length - 1, (i) => length(i + 1) / (t[i + 1] - t[i]));
    const limit = TIMES_FASTER * quantile(rates.filter((rate) => rate > STANDS), 0.9);
    return (/** @type {number} */ i) => length(i) > Math.max(least, limit * (t[i] - t[i - 1]));
  });
  return (i) => tests.some((test) => test(i));
}
