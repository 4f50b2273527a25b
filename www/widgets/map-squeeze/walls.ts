/** Geometry of walls: contacts of a path with walls, and moving of walls. Lengths are in metres. */

import { extentAround } from '../../scene/view.ts';
import type { Plan } from '../../types.d.ts';

/** Distance below which two walls touch. */
const TOUCH_DISTANCE = 1e-6;

/** Minimum gap between the end of a wall and the next wall, and minimum length of a wall, m. */
const MIN_GAP = 0.05;

/** Minimum distance (m) at which a path counts as touching a wall, and number of tested points of a path in such a distance. */
const MIN_TOUCH_RADIUS = 0.02;
const POINTS_PER_RADIUS = 4;

/** Returns the point of a wall that is nearest to another point, with the distance. `k` is the index of the wall's first number. */
function nearestPointOfWall(walls: ArrayLike<number>, k: number, x: number, y: number) {
  const [x0, y0] = [walls[k], walls[k + 1]];
  const [dx, dy] = [walls[k + 2] - x0, walls[k + 3] - y0];
  const projection = ((x - x0) * dx + (y - y0) * dy) / (dx * dx + dy * dy || 1);
  const fraction = Math.min(1, Math.max(0, projection));
  const point = [x0 + fraction * dx, y0 + fraction * dy];
  return { point, distance: Math.hypot(x - point[0], y - point[1]) };
}

/** Returns the first point of a wall that a robot with this radius touches on a path of x, y pairs; undefined for none. */
export function findWallContact(path: ArrayLike<number>, walls: Float64Array, radius: number) {
  const touchRadius = Math.max(radius, MIN_TOUCH_RADIUS);
  const pathExtent = extentAround(path, 2);
  const nearWalls = [];
  for (let k = 0; k < walls.length; k += 4) {
    const wall = extentAround(walls.subarray(k, k + 4), 2);
    const extentDistance = Math.max(wall.xMin - pathExtent.xMax, pathExtent.xMin - wall.xMax, wall.yMin - pathExtent.yMax, pathExtent.yMin - wall.yMax);
    if (extentDistance < touchRadius) nearWalls.push(k);
  }
  for (let i = 0; i + 3 < path.length; i += 2) {
    const [dx, dy] = [path[i + 2] - path[i], path[i + 3] - path[i + 1]];
    const pointCount = Math.ceil((POINTS_PER_RADIUS * Math.hypot(dx, dy)) / touchRadius) || 1;
    for (let pointIndex = 0; pointIndex <= pointCount; pointIndex++) {
      const [x, y] = [path[i] + (pointIndex / pointCount) * dx, path[i + 1] + (pointIndex / pointCount) * dy];
      const [nearestPoint] = nearWalls.map((k) => nearestPointOfWall(walls, k, x, y)).sort((one, other) => one.distance - other.distance);
      if (nearestPoint?.distance < touchRadius) return nearestPoint.point;
    }
  }
}

/** Part of a wall that can be moved along an axis. */
export interface Grip {
  /** Index of the wall's first coordinate in the list of all walls. */
  wall: number;
  /** An end of the wall, or the whole wall, which moves across its direction. */
  part: 'from' | 'to' | 'side';
  /** Unit vector. */
  axis: number[];
  /** Smallest and largest movement along the axis, metres. */
  range: number[];
}

/**
 * Returns three grips of each wall, in the order of the walls: two ends, which can be moved where they touch no other wall, and the side.
 * The outer walls of the map have none.
 */
export function gripsOf({ bounds, walls }: Plan): (Grip | undefined)[] {
  const grips = [];
  for (let wall = 0; wall < walls.length; wall += 4) {
    const [x0, y0, x1, y1] = walls.subarray(wall, wall + 4);
    const wallLength = Math.hypot(x1 - x0, y1 - y0);
    const wallDirection = [(x1 - x0) / wallLength, (y1 - y0) / wallLength];
    const wallNormal = [-wallDirection[1], wallDirection[0]];
    const isOuterWall = [0, 1].some((i) => [bounds[i], bounds[i + 2]].some((bound) => walls[wall + i] === bound && walls[wall + i + 2] === bound));
    const endGrips: [part: 'from' | 'to', end: number[], axis: number[]][] = [['from', [x0, y0], wallDirection.map((component) => -component)], ['to', [x1, y1], wallDirection]];
    for (const [endName, end, axis] of endGrips) {
      const maxMove = Math.min(moveRangeOf(bounds, [end], axis)[1], freeDistanceAlongAxis(walls, wall, end, axis));
      const range = [Math.min(0, MIN_GAP - wallLength), Math.max(0, maxMove)];
      grips.push(isOuterWall || wallLength < MIN_GAP || !isUnattachedEnd(walls, wall, end) ? undefined : { wall, part: endName, axis, range });
    }
    const range = moveRangeOf(bounds, [[x0, y0], [x1, y1]], wallNormal);
    grips.push(isOuterWall || wallLength < MIN_GAP ? undefined : { wall, part: 'side' as const, axis: wallNormal, range });
  }
  return grips;
}

/** Returns true if an end of a wall touches no other wall. */
function isUnattachedEnd(walls: Float64Array, wall: number, [x, y]: readonly number[]) {
  for (let k = 0; k < walls.length; k += 4) if (k !== wall && nearestPointOfWall(walls, k, x, y).distance < TOUCH_DISTANCE) return false;
  return true;
}

/** Returns the range by which points may move along an axis within bounds. */
function moveRangeOf(bounds: ArrayLike<number>, points: readonly (readonly number[])[], axis: readonly number[]): [number, number] {
  let [minMove, maxMove] = [-Infinity, Infinity];
  for (const point of points) {
    for (const i of [0, 1].filter((k) => Math.abs(axis[k]) > TOUCH_DISTANCE)) {
      const moveLimits = [bounds[i] + MIN_GAP, bounds[i + 2] - MIN_GAP].map((bound) => (bound - point[i]) / axis[i]).sort((a, b) => a - b);
      [minMove, maxMove] = [Math.max(minMove, moveLimits[0]), Math.min(maxMove, moveLimits[1])];
    }
  }
  return [Math.min(0, minMove), Math.max(0, maxMove)];
}

/** Returns the distance by which the end of a wall may move along an axis before it is near another wall. */
function freeDistanceAlongAxis(walls: Float64Array, wall: number, [x, y]: readonly number[], [ux, uy]: readonly number[]) {
  let minFreeDistance = Infinity;
  for (let k = 0; k < walls.length; k += 4) {
    if (k === wall) continue;
    const wallEnds = [k, k + 2].map((i) => [(walls[i] - x) * ux + (walls[i + 1] - y) * uy, (walls[i + 1] - y) * ux - (walls[i] - x) * uy]);
    const [[ahead, left], [further, right]] = wallEnds;
    if (Math.min(left, right) > TOUCH_DISTANCE || Math.max(left, right) < -TOUCH_DISTANCE) continue;
    const distance = Math.abs(right - left) < TOUCH_DISTANCE ? Math.min(ahead, further) : ahead - (left * (further - ahead)) / (right - left);
    if (distance > 0) minFreeDistance = Math.min(minFreeDistance, distance - MIN_GAP);
  }
  return minFreeDistance;
}

/** Returns the walls after one has moved. Walls that end on a wall that moves sideways follow it, if they only get longer or shorter. */
export function moveWall(walls: Float64Array, { wall, part, axis: [ux, uy] }: Grip, distance: number) {
  const movedWalls = walls.slice();
  const moveEnd = (index: number) => {
    movedWalls[index] = walls[index] + distance * ux;
    movedWalls[index + 1] = walls[index + 1] + distance * uy;
  };
  if (part !== 'to') moveEnd(wall);
  if (part !== 'from') moveEnd(wall + 2);
  for (let k = 0; k < walls.length && part === 'side'; k += 4) {
    const [dx, dy] = [walls[k + 2] - walls[k], walls[k + 3] - walls[k + 1]];
    if (k === wall || Math.abs(dx * uy - dy * ux) > TOUCH_DISTANCE) continue;
    for (const end of [k, k + 2]) if (nearestPointOfWall(walls, wall, walls[end], walls[end + 1]).distance < TOUCH_DISTANCE) moveEnd(end);
  }
  return movedWalls;
}
