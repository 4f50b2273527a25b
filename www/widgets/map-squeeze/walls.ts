/** Moving of walls. Lengths are in metres. */

import { clampNumber } from '../../ui/format.ts';
import type { Plan } from '../../types.d.ts';

/** Maximum distance between two walls that touch, m. */
const TOUCH_DISTANCE = 1e-6;

/** Minimum gap between the end of a moved wall and another wall, and minimum length of a wall, m. */
const MIN_WALL_GAP = 0.05;

/** Returns the distance from a point to a wall. `k` is the index of the first of the wall's numbers. */
function distanceToWall(walls: ArrayLike<number>, k: number, x: number, y: number) {
  const [x0, y0] = [walls[k], walls[k + 1]];
  const [dx, dy] = [walls[k + 2] - x0, walls[k + 3] - y0];
  const fraction = clampNumber(((x - x0) * dx + (y - y0) * dy) / (dx * dx + dy * dy || 1), 0, 1);
  return Math.hypot(x - x0 - fraction * dx, y - y0 - fraction * dy);
}

/** Returns the indices at which walls start in an array with four numbers for each wall. */
const wallOffsetsOf = (walls: Float64Array) => Array.from({ length: walls.length / 4 }, (_, i) => 4 * i);

/** Grip: an end of a wall, or the whole wall, that can be moved along an axis. */
export interface Grip {
  /** Index of the first of the wall's numbers in the array of all walls. */
  wallOffset: number;
  /** Moved part: an end of the wall, or the whole wall (`side`), which moves sideways. */
  grippedPart: 'from' | 'to' | 'side';
  /** Direction in which the grip moves, as a unit vector. */
  axis: number[];
}

/** Returns the grips (movable parts) of inner walls: one for each end that touches no other wall, and one for the whole wall. */
export function gripsOf({ bounds, walls }: Plan): Grip[] {
  return wallOffsetsOf(walls).flatMap((wallOffset): Grip[] => {
    const [x0, y0, x1, y1] = walls.subarray(wallOffset, wallOffset + 4);
    const wallLength = Math.hypot(x1 - x0, y1 - y0);
    const isOuterWall = [0, 1].some((i) => [bounds[i], bounds[i + 2]].some((bound) => walls[wallOffset + i] === bound && walls[wallOffset + i + 2] === bound));
    if (isOuterWall || wallLength < MIN_WALL_GAP) return [];
    const [ux, uy] = [(x1 - x0) / wallLength, (y1 - y0) / wallLength];
    const grips: Grip[] = [{ wallOffset, grippedPart: 'from', axis: [-ux, -uy] }, { wallOffset, grippedPart: 'to', axis: [ux, uy] }, { wallOffset, grippedPart: 'side', axis: [-uy, ux] }];
    return grips.filter(({ grippedPart }) => grippedPart === 'side' || distanceToOtherWallsOf(walls, wallOffset, grippedPart === 'from' ? [x0, y0] : [x1, y1]) > TOUCH_DISTANCE);
  });
}

const distanceToOtherWallsOf = (walls: Float64Array, wallOffset: number, [x, y]: number[]) =>
  Math.min(...wallOffsetsOf(walls).filter((k) => k !== wallOffset).map((k) => distanceToWall(walls, k, x, y)));

/**
 * Returns the walls after a grip has been moved along its axis, within the bounds of the plan. A moved end stops near the next wall. If a whole wall moves,
 * walls that end at it become longer or shorter, unless this would turn them.
 */
export function moveWall({ bounds, walls }: Plan, { wallOffset, grippedPart, axis: [ux, uy] }: Grip, distance: number) {
  const movedWalls = walls.slice();
  const [x0, y0, x1, y1] = walls.subarray(wallOffset, wallOffset + 4);
  const movedPoints = { from: [[x0, y0]], to: [[x1, y1]], side: [[x0, y0], [x1, y1]] }[grippedPart];
  const moveEnd = (coordinateIndex: number, endDistance: number) => {
    movedWalls[coordinateIndex] = walls[coordinateIndex] + endDistance * ux;
    movedWalls[coordinateIndex + 1] = walls[coordinateIndex + 1] + endDistance * uy;
  };
  const distanceInBounds = limitToBounds(distance, bounds, movedPoints, [ux, uy]);
  if (grippedPart !== 'side') {
    const freeDistance = Math.min(distanceInBounds, freeDistanceOf(walls, wallOffset, movedPoints[0], [ux, uy], distanceInBounds));
    moveEnd(grippedPart === 'from' ? wallOffset : wallOffset + 2, Math.max(freeDistance, MIN_WALL_GAP - Math.hypot(x1 - x0, y1 - y0)));
    return movedWalls;
  }
  for (const k of wallOffsetsOf(walls)) {
    const isParallelToAxis = Math.abs((walls[k + 2] - walls[k]) * uy - (walls[k + 3] - walls[k + 1]) * ux) < TOUCH_DISTANCE;
    const isMoved = (coordinateIndex: number) => k === wallOffset || (isParallelToAxis && distanceToWall(walls, wallOffset, walls[coordinateIndex], walls[coordinateIndex + 1]) < TOUCH_DISTANCE);
    for (const coordinateIndex of [k, k + 2]) if (isMoved(coordinateIndex)) moveEnd(coordinateIndex, distanceInBounds);
  }
  return movedWalls;
}

/** Returns the distance that points can move along an axis without leaving the bounds of a plan; at most the requested distance. */
function limitToBounds(distance: number, bounds: ArrayLike<number>, points: number[][], axis: number[]) {
  const distanceLimits = points.flatMap((point) => [0, 1].filter((i) => Math.abs(axis[i]) > TOUCH_DISTANCE).map((i) => [bounds[i] + MIN_WALL_GAP, bounds[i + 2] - MIN_WALL_GAP].map((bound) => (bound - point[i]) / axis[i])));
  return distanceLimits.reduce((limitedDistance, [distanceToBound, distanceToOtherBound]) =>
    clampNumber(limitedDistance, Math.min(0, distanceToBound, distanceToOtherBound), Math.max(0, distanceToBound, distanceToOtherBound)), distance);
}

/** Returns the distance that the end of a wall can move along an axis before it comes too close to another wall; at most the requested distance. */
function freeDistanceOf(walls: Float64Array, wallOffset: number, [x, y]: number[], [ux, uy]: number[], distance: number) {
  let freeDistance = 0;
  let freeGap = Infinity;
  // The end moves in steps. Each step is as long as the distance to the nearest wall allows.
  while (freeDistance < distance && freeGap > TOUCH_DISTANCE) {
    freeGap = distanceToOtherWallsOf(walls, wallOffset, [x + freeDistance * ux, y + freeDistance * uy]) - MIN_WALL_GAP;
    freeDistance += Math.max(0, freeGap);
  }
  return freeDistance;
}
