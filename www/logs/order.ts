/** Order of rows in time. */

import { quantile, sample } from './quantile.ts';

/** Maximum difference of neighbouring times, in median steps. */
const MAX_GAP_STEPS = 5;

/** Maximum difference of times that count as equal, in median steps. */
const SAME_TIME_STEPS = 0.75;

/** Minimum number of rows with times of earlier rows, by which a clock was set back. Fewer such rows are late. */
const MIN_OVERLAP = 3;

/** Maximum fraction of steps back in time of a log in parts. Above it, the log is out of order everywhere. */
const MAX_STEPS_BACK = 0.1;

/** Classes of rows: kept, kept although late, dropped as far from all others, or dropped because the clock was set back. */
export const [KEPT, LATE, STRAY, SET_BACK] = [0, 1, 2, 3];

interface Order {
  /** Kept rows, sorted by time. Rows of equal time are in the order of the file. */
  order: Uint32Array;
  /** Class of each row. */
  classes: Uint8Array;
  /** First row after the clock was set back; −1 if it never was. */
  setBack: number;
  /** Number of rows in the largest part of the log between resets of the clock. */
  largest: number;
}

/**
 * Sorts rows by their times, and drops single rows whose times are far from all others. If the clock was set back, later rows repeat the
 * times of earlier ones. Such resets divide the rows into parts, of which only the largest is kept.
 *
 * @param t in the order of the file
 * @param isSame checks whether two rows have the same values
 */
export function sortRows(t: Float64Array, isSame: (one: number, other: number) => boolean): Order {
  const classes = new Uint8Array(t.length);
  const all = new Uint32Array(t.length);
  let stepsBack = 0;
  for (let i = 0; i < t.length; i++) {
    all[i] = i;
    if (t[i] < t[i - 1]) stepsBack += 1;
  }
  if (stepsBack === 0) return { order: all, classes, setBack: -1, largest: t.length };

  const sorted = all.toSorted((one, other) => t[one] - t[other] || one - other);
  // Parts of the log may have the same times, so that sorting makes the steps shorter. A log that is out of order everywhere has no parts.
  const ordered = stepsBack > MAX_STEPS_BACK * t.length ? sorted : all;
  const step = quantile(sample(t.length - 1, (i) => t[ordered[i + 1]] - t[ordered[i]]).filter((each) => each > 0), 0.5);
  const places = new Uint32Array(t.length);
  for (let place = 0; place < t.length; place++) places[sorted[place]] = place;
  const isAlone = (i: number) => [t[sorted[places[i] - 1]], t[sorted[places[i] + 1]]].every((other) => !(Math.abs(other - t[i]) <= MAX_GAP_STEPS * step));
  for (let i = 0; i < t.length; i++) {
    const around = t[i + 1] - t[i - 1];
    const isBetween = t[i] >= t[i - 1] && t[i] <= t[i + 1];
    if (around >= 0 && around <= MAX_GAP_STEPS * step && !isBetween && isAlone(i)) classes[i] = STRAY;
  }

  // Runs are rows with rising times. A run that repeats times of earlier runs begins a new part.
  const runs = new Uint32Array(t.length);
  for (let i = 1, last = 0; i < t.length; i++) {
    runs[i] = runs[i - 1];
    if (classes[i - 1] !== STRAY) last = i - 1;
    if (classes[i] !== STRAY && t[i] < t[last]) runs[i] += 1;
  }
  const overlaps = new Uint32Array(runs[t.length - 1] + 1);
  let previous = -1;
  for (const i of sorted) {
    if (classes[i] === STRAY) continue;
    const isRepeated = previous >= 0 && runs[previous] !== runs[i] && t[i] - t[previous] < SAME_TIME_STEPS * step;
    if (isRepeated && !isSame(previous, i)) overlaps[Math.max(runs[previous], runs[i])] += 1;
    previous = i;
  }
  const parts = new Uint32Array(t.length);
  const sizes = [0];
  let setBack = -1;
  for (let i = 0; i < t.length; i++) {
    if (i > 0 && runs[i] !== runs[i - 1] && overlaps[runs[i]] >= MIN_OVERLAP) {
      if (setBack < 0) setBack = i;
      sizes.push(0);
    }
    parts[i] = sizes.length - 1;
    if (classes[i] !== STRAY) sizes[parts[i]] += 1;
  }
  const largest = Math.max(...sizes);
  const keptPart = sizes.indexOf(largest);
  let newest = -Infinity;
  for (let i = 0; i < t.length; i++) {
    if (classes[i] === STRAY) continue;
    if (parts[i] !== keptPart) classes[i] = SET_BACK;
    else if (t[i] < newest) classes[i] = LATE;
    else newest = t[i];
  }
  return { order: sorted.filter((i) => classes[i] < STRAY), classes, setBack, largest };
}

/** Repeated poses of a moving robot: maximum duration in s of a run of equal rows, and minimum number of such runs. */
const [MAX_HOLD, MIN_HOLDS] = [1, 20];

/** Minimum fraction of rows in such runs, for a recorder that repeats poses. */
const MIN_HELD_FRACTION = 0.8;

/**
 * Returns the number of rows for each pose of a moving robot; usually 1. A table with topics of different rates repeats the poses of the
 * slower ones.
 *
 * @param isRepeated checks whether a row has the pose of the row before
 */
export function repeatFactor(t: Float64Array, isRepeated: (i: number) => boolean): number {
  const lengths: number[] = [];
  let [single, held] = [0, 0];
  for (let from = 0, to; from < t.length; from = to) {
    for (to = from + 1; to < t.length && isRepeated(to); ) to += 1;
    if (to - from === 1) single += 1;
    else if (t[to - 1] - t[from] <= MAX_HOLD) {
      held += to - from;
      lengths.push(to - from);
    }
  }
  if (lengths.length < MIN_HOLDS || held < MIN_HELD_FRACTION * (held + single)) return 1;
  return quantile(Float64Array.from(lengths), 0.5);
}
