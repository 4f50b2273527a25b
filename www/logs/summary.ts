/** Summaries of logs: numbers, and sentences. */

import type { Words } from './log-error.js';
import { LOG_TIME, type Cause, type Commands, type Log, type Poses } from './log.ts';

/** Path between two points in m that counts as driven: the noise of poses at rest adds up to nothing. */
const STEP = 0.05;

/** Returns the distance driven, in m. */
export function distanceOf(data: Poses | Commands): number {
  const { t } = data;
  let distance = 0;
  if ('v' in data) {
    for (let i = 1; i < t.length; i++) distance += Math.abs(data.v[i - 1]) * (t[i] - t[i - 1]);
    return distance;
  }
  const { x, y } = data;
  for (let i = 1, last = 0; i < t.length; i++) {
    const step = Math.hypot(x[i] - x[last], y[i] - y[last]);
    if (step < STEP) continue;
    distance += step;
    last = i;
  }
  return distance;
}

/** Returns a sentence for each decision and each cause for dropping rows. */
export function summarize({ summary, kind }: Log, say: Words['found']): string[] {
  const { rows, used, dropped, seconds, rate, units: { time, angle }, clock, columns, gaps, jumps, notes } = summary;
  return [
    say.rows(used, rows, seconds, rate),
    ...((time.by === 'size' || time.by === 'rate') && time.unit !== 's' ? [say.unit(time.unit, time.by)] : []),
    ...(clock === LOG_TIME ? [say.logTimes] : []),
    ...(kind === 'poses' && angle.unit === 'deg' ? [say.degrees] : []),
    ...(Object.entries(dropped) as [Cause, { count: number; first: number }][]).map(([cause, { count, first }]) => say.leftOut(cause, count, columns ? first : 0)),
    ...(gaps.count ? [say.gaps(gaps.count, gaps.first, gaps.longest)] : []),
    ...(jumps.count ? [say.jumps(jumps.count, jumps.first)] : []),
    ...notes.map(({ name, values }) => (say.notes[name] as (...values: (string | number)[]) => string)(...values)),
  ];
}
