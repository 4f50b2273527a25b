/** A reference that has lost the robot, and tells the last pose on and on while the robot drives. */

/**
 * @import { Commands, Log, Poses } from './rows.js'
 */

/** Seconds at either end of a time in which the reference stands: the clocks may differ by as much. */
const MARGIN = 1;

/** What the odometry moves at least meanwhile, in metres or radians: standing still it may count a pulse or two. */
const MOVES = 0.05;

/**
 * @param {Log} reference
 * @param {Log} odometry of the same start
 * @returns {Log} the reference without rows that repeat a pose while the odometry moves on
 */
export function withoutHeld(reference, odometry) {
  const { t, x, y, theta, breaks: known } = /** @type {Poses} */ (reference.data);
  const movedAt = moving(odometry.data);
  /** @type {[number, number][]} rows from and to, of which the first is good */
  const held = [];
  for (let from = 0, to; from < t.length; from = to) {
    for (to = from + 1; to < t.length && x[to] === x[from] && y[to] === y[from] && theta[to] === theta[from]; ) to += 1;
    const [start, end] = [t[from] + MARGIN, t[to - 1] - MARGIN];
    if (end > start && movedAt(end) - movedAt(start) > MOVES) held.push([from + 1, to]);
  }
  if (held.length === 0) return reference;
  const kept = new Uint8Array(t.length).fill(1);
  for (const [from, to] of held) kept.fill(0, from, to);
  const isKept = (/** @type {number} */ _, /** @type {number} */ i) => kept[i] === 1;
  // Where each row is then.
  const places = new Uint32Array(t.length + 1);
  for (let i = 0; i < t.length; i++) places[i + 1] = places[i] + kept[i];
  const count = t.length - places[t.length];
  const rows = new Set([...known, ...held.map(([, to]) => to)].map((row) => places[row]));
  const breaks = Uint32Array.from(rows).filter((row) => row < places[t.length]).sort();
  return {
    ...reference,
    data: { t: t.filter(isKept), x: x.filter(isKept), y: y.filter(isKept), theta: theta.filter(isKept), breaks },
    found: { ...reference.found, leftOut: { ...reference.found.leftOut, held: { count, line: 0, t: t[held[0][0]] } } },
  };
}

/**
 * @param {Poses | Commands} data
 * @returns {(time: number) => number} how far a robot has moved by a time, its metres and radians together
 */
function moving(data) {
  const { t } = data;
  const moved = new Float64Array(t.length);
  for (let i = 1; i < t.length; i++) {
    const step =
      'v' in data
        ? (Math.abs(data.v[i - 1]) + Math.abs(data.omega[i - 1])) * (t[i] - t[i - 1])
        : Math.hypot(data.x[i] - data.x[i - 1], data.y[i] - data.y[i - 1]) + Math.abs(Math.sin((data.theta[i] - data.theta[i - 1]) / 2)) * 2;
    moved[i] = moved[i - 1] + step;
  }
  return (time) => {
    let [from, to] = [0, t.length];
    while (from < to) {
      const middle = (from + to) >> 1;
      if (t[middle] <= time) from = middle + 1;
      else to = middle;
    }
    return moved[Math.max(from - 1, 0)];
  };
}
