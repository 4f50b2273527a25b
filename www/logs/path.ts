/** Paths of logs in the plane. */

import type { Commands, Poses } from './log.ts';

export type Point = [x: number, y: number];

export interface Path { t: number[]; points: Point[]; headings: number[]; breaks: Set<number> }

/**
 * Returns the path of poses, or of commands that start at the origin.
 *
 * @param every number of rows per point; the last row also has a point
 */
export function pathOf(data: Poses | Commands, every = 1): Path {
  const { t, breaks } = data;
  const path: Path = { t: [], points: [], headings: [], breaks: new Set() };
  let [x, y, theta, next] = [0, 0, 0, 0];
  for (let i = 0; i < t.length; i++) {
    if ('v' in data && i > 0) {
      const dt = t[i] - t[i - 1];
      const turn = data.omega[i - 1] * dt;
      x += data.v[i - 1] * dt * Math.cos(theta + turn / 2);
      y += data.v[i - 1] * dt * Math.sin(theta + turn / 2);
      theta += turn;
    }
    if (i % every !== 0 && i < t.length - 1) continue;
    if ('x' in data) [x, y, theta] = [data.x[i], data.y[i], data.theta[i]];
    for (; next < breaks.length && breaks[next] <= i; next++) path.breaks.add(path.points.length);
    path.t.push(t[i]);
    path.points.push([x, y]);
    path.headings.push(theta);
  }
  return path;
}
