/** Summaries of logs: numbers, and sentences. */

import type { Words } from './log-error.ts';
import { LOG_TIME, type Cause, type Commands, type Log, type Poses } from './log.ts';

/** Minimum distance in m between two points of the path, so that the noise of poses at rest does not add up. */
const STEP = 0.05;

/** Returns the distance driven, in m, without the jumps before some rows. */
export function distanceOf(data: Poses | Commands, jumps: number[]): number {
  const { t } = data;
  let distance = 0;
  if ('v' in data) {
    for (let i = 1; i < t.length; i++) distance += Math.abs(data.v[i - 1]) * (t[i] - t[i - 1]);
    return distance;
  }
  const { x, y } = data;
  for (let i = 1, last = 0, next = 0; i < t.length; i++) {
    const step = Math.hypot(x[i] - x[last], y[i] - y[last]);
    const isJump = jumps[next] === i;
    if (isJump) next += 1;
    else if (step < STEP) continue;
    else distance += step;
    last = i;
  }
  return distance;
}

/** Returns a sentence for each decision, each cause for dropping rows, gaps and jumps. */
export function summarize(log: Log, say: Words['found']): string[] {
  const { rows, used, dropped, seconds, rate, distance, units, clock, columns, gaps, jumps } = log.summary;
  return [
    say.rows(used, rows, seconds, rate, distance),
    ...(columns ? [`${say.columns(Object.values(columns).join(', '))}; ${say.units(units)}`] : []),
    ...(clock === LOG_TIME ? [say.logTimes] : []),
    ...(Object.entries(dropped) as [Cause, { count: number; first: number }][]).map(([cause, { count, first }]) => say.leftOut(cause, count, columns ? first : 0)),
    ...(gaps.count ? [say.gaps(gaps.count, gaps.first, gaps.longest)] : []),
    ...(jumps.count ? [say.jumps(jumps.count, jumps.first)] : []),
    ...notesOf(log, say),
  ];
}

/** Returns a sentence for each note. */
export const notesOf = ({ summary: { notes } }: Log, say: Words['found']): string[] => notes.map(({ name, values }) => {
  const note: string | ((...values: any[]) => string) = say.notes[name];
  return typeof note === 'string' ? note : note(...values);
});
