/** Sentences that summarize logs. */

import type { Words } from './log-error.ts';
import { LOG_TIME, framesText, type DropCause, type Commands, type Log, type Poses } from './log.ts';

/** Minimum distance (m) between points whose distances are added up, so that the noise of poses at rest is left out. */
const MIN_STEP = 0.05;

/** Returns the distance driven (m), without the jumps before the rows `jumps`. */
export function distanceOf(data: Poses | Commands, jumps: number[]): number {
  const { t } = data;
  let distance = 0;
  if ('v' in data) {
    for (let i = 1; i < t.length; i++) distance += Math.abs(data.v[i - 1]) * (t[i] - t[i - 1]);
    return distance;
  }
  const { x, y } = data;
  for (let i = 1, last = 0, next = 0; i < t.length; i++) {
    const stepLength = Math.hypot(x[i] - x[last], y[i] - y[last]);
    const isJump = jumps[next] === i;
    if (isJump) next += 1;
    else if (stepLength < MIN_STEP) continue;
    else distance += stepLength;
    last = i;
  }
  return distance;
}

type Label = keyof Words['found']['labels'];

/** Returns the lines of a log's summary by their labels. */
export function summaryLines({ summary }: Log, texts: Words['found']): Partial<Record<Label, string[]>> {
  const { rows, used, dropped, seconds, rate, distance, units, clock, columns, frames, gaps, jumps, notes } = summary;
  return {
    rows: [texts.rows(used, rows, seconds, rate, distance)],
    ...(columns && { columns: [Object.values(columns).join(', ')], units: [texts.units(units)] }),
    ...(frames && { frames: [framesText(frames)] }),
    ...(clock === LOG_TIME && { clock: [texts.recorded] }),
    dropped: (Object.entries(dropped) as [DropCause, { count: number; first: number }][]).map(([cause, { count, first }]) => texts.dropped(cause, count, columns ? first : 0)),
    gaps: [gaps.count ? texts.gaps(gaps.count, gaps.first, gaps.longest) : texts.noGaps],
    ...(jumps.count && { jumps: [texts.jumps(jumps.count, jumps.first)] }),
    notes: notes.map(({ name, values }) => {
      const noteText: string | ((...values: any[]) => string) = texts.notes[name];
      return typeof noteText === 'string' ? noteText : noteText(...values);
    }),
  };
}

/** Returns the summary of a log as sentences, the one about its rows first. */
export function summarySentences(log: Log, texts: Words['found']): string[] {
  const { rows = [], ...otherLines } = summaryLines(log, texts);
  return [...rows, ...Object.entries(otherLines).flatMap(([label, lines]) => lines.map((line) => `${texts.labels[label as Label]}: ${line}`))];
}
