// Walls of a floor plan that a user moves.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { gripsOf, moveWall } from '../../www/widgets/map-squeeze/walls.ts';

/** Room of 6 m × 4 m. A wall at x = 3 has a doorway. Another wall ends at the lower part of the wall with the doorway. */
const ROOM_BOUNDS = Float64Array.of(0, 0, 6, 4);
const OUTER_WALLS = [0, 0, 6, 0, 6, 0, 6, 4, 6, 4, 0, 4, 0, 4, 0, 0];
const ROOM_WALLS = Float64Array.of(...OUTER_WALLS, 3, 0, 3, 1.5, 3, 2.5, 3, 4, 0, 1, 3, 1);
const FLOOR_PLAN = { bounds: ROOM_BOUNDS, walls: ROOM_WALLS };
/** Index in WALLS of the wall's part below the doorway. */
const LOWER_WALL_OFFSET = OUTER_WALLS.length;

/** Returns the drag handle (grip) of a part of a wall. @param {string} gripPart @param {number} [wallOffset] index of the wall in WALLS */
const gripOf = (gripPart, wallOffset = LOWER_WALL_OFFSET) => gripsOf(FLOOR_PLAN).find((grip) => grip.grippedPart === gripPart && grip.wallOffset === wallOffset);

test('free wall ends and inner walls have drag handles; outer walls and ends at other walls have none', () => {
  const gripNames = gripsOf(FLOOR_PLAN).map(({ grippedPart, wallOffset }) => `${grippedPart} ${(wallOffset - LOWER_WALL_OFFSET) / 4}`);
  assert.deepEqual(gripNames, ['to 0', 'side 0', 'from 1', 'side 1', 'side 2']);
});

test('the end of a wall at a doorway moves along the wall, as far as the other end of the doorway and down to a stub', () => {
  const grip = gripOf('to');
  assert.ok(grip);
  assert.deepEqual(grip.axis, [0, 1]);
  const moveJambBy = (/** @type {number} */ distance) => Number(moveWall(FLOOR_PLAN, grip, distance)[LOWER_WALL_OFFSET + 3].toFixed(9));
  assert.deepEqual([0.5, 9, -9].map(moveJambBy), [2, 2.45, 0.05]);
});

test('a dragged wall moves sideways, and a wall that ends at it follows', () => {
  const grip = gripOf('side');
  assert.ok(grip);
  const wallsAfter = moveWall(FLOOR_PLAN, grip, grip.axis[0] * 0.5);
  assert.deepEqual([...wallsAfter.subarray(LOWER_WALL_OFFSET)], [3.5, 0, 3.5, 1.5, 3, 2.5, 3, 4, 0, 1, 3.5, 1]);
  assert.deepEqual([...wallsAfter.subarray(0, LOWER_WALL_OFFSET)], OUTER_WALLS);
});

test('a wall that is not parallel to an axis keeps its direction and length where it meets the bounds', () => {
  const plan = { bounds: ROOM_BOUNDS, walls: Float64Array.of(...OUTER_WALLS, 1, 1, 3, 2) };
  const wallSideGrip = gripsOf(plan).find(({ grippedPart }) => grippedPart === 'side');
  assert.ok(wallSideGrip);
  for (const distance of [9, -9, Infinity]) {
    const [x0, y0, x1, y1] = moveWall(plan, wallSideGrip, distance).subarray(OUTER_WALLS.length);
    assert.deepEqual([x1 - x0, y1 - y0].map((difference) => Number(difference.toFixed(9))), [2, 1]);
  }
});
