/**
 * Map Squeeze: conditioned samples in the apartment, and in buildings of ever more walls. Target 4.
 *
 * @module
 */

import { race, spread } from './timing.js';

/**
 * @typedef {import('../www/types.d.ts').Motion} Motion
 * @typedef {import('./timing.js').Spread} Spread
 * @typedef {{ bounds: number[], walls: number[][] }} Plan
 */

const START = { x: 2.05, y: 2.6, theta: Math.PI / 2 };
export const SETTINGS = { start: START, conditioned: true, sampler: /** @type {const} */ ('endpoint'), seed: 1 };

/**
 * The robot is dragged: every event it starts a little elsewhere.
 *
 * @param {number} event
 */
function start(event) {
  return { ...START, x: START.x + 0.001 * Math.abs(50 - (event % 100)) };
}

/**
 * @param {Motion} motion
 * @param {{ samples: number, seconds: number }} options
 * @returns {Promise<{ samples: number, squeeze: Spread }>}
 */
export async function timeSqueeze(motion, { samples, seconds }) {
  const machine = new motion.MapSqueeze({ ...SETTINGS, samples });
  const { squeeze } = await race({ squeeze: (event) => drag(machine, event) }, { seconds });
  machine.free();
  return { samples, squeeze: spread(squeeze) };
}

/**
 * The same robot in buildings of ever more walls. As long as they surround it the same, only the search for the walls
 * near it can cost more.
 *
 * - `growing`: rooms of one size without end, of which the building has those walls that are nearest to the robot.
 * - `divided`: the apartment, its walls built of ever shorter pieces.
 *
 * @param {Motion} motion
 * @param {{ samples: number, seconds: number, counts: number[] }} options
 * @returns {Promise<{ samples: number, growing: Walls[], divided: Walls[] }>}
 *
 * @typedef {{ walls: number, time: Spread, drawsPerAccepted: number, wallTestsPerAccepted: number }} Walls ms for all
 */
export async function timeWalls(motion, { samples, seconds, counts }) {
  const apartment = apartmentOf(motion);
  const growing = counts.map((count) => growingPlan(apartment, count));
  const divided = counts.map((count) => dividedPlan(apartment, count));
  const machines = [...growing, ...divided].map((plan) => {
    const machine = new motion.MapSqueeze({ ...SETTINGS, samples });
    machine.setPlan(plan);
    return { machine, walls: plan.walls.length };
  });
  const contenders = machines.map(({ machine }, i) => [i, (/** @type {number} */ event) => drag(machine, event)]);
  const turns = await race(Object.fromEntries(contenders), { seconds });
  const rows = machines.map(({ machine, walls }, i) => {
    const { drawsPerAccepted, wallTestsPerAccepted } = machine.stats;
    machine.free();
    return { walls, time: spread(turns[i]), drawsPerAccepted, wallTestsPerAccepted };
  });
  return { samples, growing: rows.slice(0, counts.length), divided: rows.slice(counts.length) };
}

/**
 * @param {import('../www/types.d.ts').MapSqueeze} machine
 * @param {number} event
 */
export function drag(machine, event) {
  machine.configure({ start: start(event) });
  return machine.stats;
}

/**
 * @param {Motion} motion
 * @returns {Plan}
 */
function apartmentOf(motion) {
  const machine = new motion.MapSqueeze({ samples: 1 });
  const { bounds, walls } = machine.plan;
  machine.free();
  const wall = (/** @type {number} */ i) => [...walls.slice(4 * i, 4 * i + 4)];
  return { bounds: [...bounds], walls: Array.from({ length: walls.length / 4 }, (_, i) => wall(i)) };
}

/**
 * @param {Plan} apartment
 * @param {number} count
 * @returns {Plan}
 */
export function growingPlan({ bounds, walls }, count) {
  const [width, height] = [bounds[2] - bounds[0], bounds[3] - bounds[1]];
  // Apartments as far as a square of this half side, which has more than enough walls.
  const reach = Math.ceil(Math.sqrt(count / walls.length));
  /** @type {number[][]} */
  const all = [];
  for (let column = -reach; column <= reach; column++) {
    for (let row = -reach; row <= reach; row++) {
      all.push(...walls.map(([x0, y0, x1, y1]) => [
        x0 + column * width, y0 + row * height, x1 + column * width, y1 + row * height,
      ]));
    }
  }
  const kept = all.sort((a, b) => distance(a) - distance(b)).slice(0, count);
  const [xs, ys] = [0, 1].map((k) => kept.flatMap((wall) => [wall[k], wall[k + 2]]));
  const extent = [Math.min(...xs, bounds[0]), Math.min(...ys, bounds[1]), Math.max(...xs, bounds[2]), Math.max(...ys, bounds[3])];
  return { bounds: extent, walls: kept };
}

/**
 * From the robot to the nearest point of a wall.
 *
 * @param {number[]} wall
 */
function distance([x0, y0, x1, y1]) {
  const [dx, dy] = [x1 - x0, y1 - y0];
  const share = ((START.x - x0) * dx + (START.y - y0) * dy) / (dx * dx + dy * dy);
  const along = Math.min(1, Math.max(0, share));
  return Math.hypot(x0 + along * dx - START.x, y0 + along * dy - START.y);
}

/**
 * @param {Plan} apartment
 * @param {number} count from the number of its walls on; below it has fewer, the nearest
 * @returns {Plan}
 */
export function dividedPlan({ bounds, walls }, count) {
  const nearest = [...walls].sort((a, b) => distance(a) - distance(b)).slice(0, count);
  const pieces = nearest.flatMap(([x0, y0, x1, y1], i) => {
    const parts = Math.floor((count + i) / nearest.length);
    const at = (/** @type {number} */ k) => [x0 + ((x1 - x0) * k) / parts, y0 + ((y1 - y0) * k) / parts];
    return Array.from({ length: parts }, (_, k) => [...at(k), ...at(k + 1)]);
  });
  return { bounds, walls: pieces };
}
