/** Order of rows in time. */

import { quantile, sampleEvenly } from './quantile.ts';

/** Maximum difference between the times of neighbouring rows, in median steps. */
const MAX_GAP_STEPS = 5;

/** Maximum difference of times that count as equal, in median steps. */
const SAME_TIME_STEPS = 0.75;

/** Minimum number of rows that repeat times of earlier rows, for a clock that was set back. Fewer such rows count as late. */
const MIN_OVERLAP = 3;

/** Maximum fraction of rows that are earlier than the row before. Above it, the whole log counts as out of order. */
const MAX_BACKWARD_FRACTION = 0.1;

/** Classes of rows: kept, kept although late, dropped because their time is far from all others, or because the clock was set back. */
export const [KEPT, LATE, STRAY, SET_BACK] = [0, 1, 2, 3];

interface RowOrder {
  /** Kept rows, sorted by time. Rows of equal time are in the order of the file. */
  order: Uint32Array;
  /** Class of each row. */
  rowClasses: Uint8Array;
  /** First row after the clock was set back; −1 if it never was. */
  firstSetBackRow: number;
  /** Number of rows in the largest part of the log between resets of the clock. */
  largestPartSize: number;
}

/**
 * Sorts rows by their times, and drops single rows whose times are far from all others. If the clock was set back, later rows repeat the
 * times of earlier ones. Such resets divide the rows into parts, of which only the largest is kept.
 *
 * @param t times of the rows, in the order of the file
 * @param isSame checks whether two rows have the same values
 */
export function sortRows(t: Float64Array, isSame: (one: number, other: number) => boolean): RowOrder {
  const rowClasses = new Uint8Array(t.length);
  const allRows = new Uint32Array(t.length);
  let backwardSteps = 0;
  for (let i = 0; i < t.length; i++) {
    allRows[i] = i;
    if (t[i] < t[i - 1]) backwardSteps += 1;
  }
  if (backwardSteps === 0) return { order: allRows, rowClasses, firstSetBackRow: -1, largestPartSize: t.length };

  const sortedRows = allRows.toSorted((one, other) => t[one] - t[other] || one - other);
  // Parts of the log may have the same times, so that sorting makes the steps shorter. A log that is out of order everywhere has no parts.
  const orderedRows = backwardSteps > MAX_BACKWARD_FRACTION * t.length ? sortedRows : allRows;
  const medianStep = quantile(sampleEvenly(t.length - 1, (i) => t[orderedRows[i + 1]] - t[orderedRows[i]]).filter((step) => step > 0), 0.5);
  const rankOfRow = new Uint32Array(t.length);
  for (let rank = 0; rank < t.length; rank++) rankOfRow[sortedRows[rank]] = rank;
  const isFarFromOthers = (i: number) => [t[sortedRows[rankOfRow[i] - 1]], t[sortedRows[rankOfRow[i] + 1]]].every((other) => !(Math.abs(other - t[i]) <= MAX_GAP_STEPS * medianStep));
  for (let i = 0; i < t.length; i++) {
    const neighbourGap = t[i + 1] - t[i - 1];
    const isBetweenNeighbours = t[i] >= t[i - 1] && t[i] <= t[i + 1];
    if (neighbourGap >= 0 && neighbourGap <= MAX_GAP_STEPS * medianStep && !isBetweenNeighbours && isFarFromOthers(i)) rowClasses[i] = STRAY;
  }

  // Runs are rows with rising times. A run that repeats times of earlier runs begins a new part.
  const runOfRow = new Uint32Array(t.length);
  for (let i = 1, last = 0; i < t.length; i++) {
    runOfRow[i] = runOfRow[i - 1];
    if (rowClasses[i - 1] !== STRAY) last = i - 1;
    if (rowClasses[i] !== STRAY && t[i] < t[last]) runOfRow[i] += 1;
  }
  const overlapCounts = new Uint32Array(runOfRow[t.length - 1] + 1);
  let previousRow = -1;
  for (const i of sortedRows) {
    if (rowClasses[i] === STRAY) continue;
    const isRepeated = previousRow >= 0 && runOfRow[previousRow] !== runOfRow[i] && t[i] - t[previousRow] < SAME_TIME_STEPS * medianStep;
    if (isRepeated && !isSame(previousRow, i)) overlapCounts[Math.max(runOfRow[previousRow], runOfRow[i])] += 1;
    previousRow = i;
  }
  const partOfRow = new Uint32Array(t.length);
  const partSizes = [0];
  let firstSetBackRow = -1;
  for (let i = 0; i < t.length; i++) {
    if (i > 0 && runOfRow[i] !== runOfRow[i - 1] && overlapCounts[runOfRow[i]] >= MIN_OVERLAP) {
      if (firstSetBackRow < 0) firstSetBackRow = i;
      partSizes.push(0);
    }
    partOfRow[i] = partSizes.length - 1;
    if (rowClasses[i] !== STRAY) partSizes[partOfRow[i]] += 1;
  }
  const largestPartSize = Math.max(...partSizes);
  const largestPart = partSizes.indexOf(largestPartSize);
  let newestTime = -Infinity;
  for (let i = 0; i < t.length; i++) {
    if (rowClasses[i] === STRAY) continue;
    if (partOfRow[i] !== largestPart) rowClasses[i] = SET_BACK;
    else if (t[i] < newestTime) rowClasses[i] = LATE;
    else newestTime = t[i];
  }
  return { order: sortedRows.filter((i) => rowClasses[i] < STRAY), rowClasses, firstSetBackRow, largestPartSize };
}

/** Repeated poses of a moving robot: maximum duration in s of a run of equal rows, and minimum number of such runs. */
const [MAX_HOLD_SECONDS, MIN_HOLD_RUNS] = [1, 20];

/** Minimum fraction of rows in such runs, for a recorder that repeats poses. */
const MIN_HELD_FRACTION = 0.8;

/**
 * Returns the number of rows for each pose of a moving robot, which is usually 1. A table with topics of different rates repeats the poses
 * of the slower topics.
 *
 * @param isRepeated checks whether a row has the pose of the row before
 */
export function rowsPerPose(t: Float64Array, isRepeated: (i: number) => boolean): number {
  const runLengths: number[] = [];
  let [singleRows, heldRows] = [0, 0];
  for (let from = 0, to; from < t.length; from = to) {
    for (to = from + 1; to < t.length && isRepeated(to); ) to += 1;
    if (to - from === 1) singleRows += 1;
    else if (t[to - 1] - t[from] <= MAX_HOLD_SECONDS) {
      heldRows += to - from;
      runLengths.push(to - from);
    }
  }
  if (runLengths.length < MIN_HOLD_RUNS || heldRows < MIN_HELD_FRACTION * (heldRows + singleRows)) return 1;
  return quantile(Float64Array.from(runLengths), 0.5);
}
