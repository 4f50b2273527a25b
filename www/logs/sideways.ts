/** Odometry that moves sideways, as the wheels of a differential drive cannot. */

import type { Log } from './log.ts';

/** Motion in m along x or y, and in rad, that ends a leg, as in AMCL. */
const LEG = [0.25, 0.2];

/** Least length of a leg in m whose direction counts: rounded positions and pulses of encoders move less. */
const LENGTH = 0.002;

/** Least sine of the angle between the chord of a leg and the chord of an arc with its turn. */
const SIDEWAYS = 0.5;

/**
 * Returns the fraction of legs that move sideways. An arc's chord has half its turn. The odometry model takes another direction for a large
 * first rotation, and its fit makes the noise of rotations too small.
 */
export function sidewaysShare({ data }: Pick<Log, 'data'>): number {
  if ('v' in data) return 0;
  const { t, x, y, theta, breaks } = data;
  const isBreak = new Set(breaks);
  let [from, legs, sideways] = [0, 0, 0];
  for (let i = 1; i < t.length; i++) {
    if (isBreak.has(i)) from = i;
    const [dx, dy, turn] = [x[i] - x[from], y[i] - y[from], Math.atan2(Math.sin(theta[i] - theta[from]), Math.cos(theta[i] - theta[from]))];
    if (Math.max(Math.abs(dx), Math.abs(dy)) <= LEG[0] && Math.abs(turn) <= LEG[1]) continue;
    legs += 1;
    const length = Math.hypot(dx, dy);
    const across = Math.abs(dy * Math.cos(theta[from] + turn / 2) - dx * Math.sin(theta[from] + turn / 2));
    if (length > LENGTH && across > SIDEWAYS * length) sideways += 1;
    from = i;
  }
  return legs ? sideways / legs : 0;
}
