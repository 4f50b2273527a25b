// Logs of examples/calibration: a drive that is simulated with known α's. `scripts/build.mjs` writes them.

import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { ROOT } from './process.mjs';

/** @import { Pose } from '../www/types.d.ts' */

/** @typedef {Awaited<ReturnType<typeof import('../www/core.ts').load>>} Motion */

/** Paths of the logs. @type {Record<string, string>} */
export const EXAMPLE_LOGS = { odometry: 'examples/calibration/odometry.csv', reference: 'examples/calibration/reference.csv' };

/** True parameters of the simulation. */
export const TRUTH = { alphas: [0.03, 0.008, 0.002, 0.002], mountYaw: 0.03, clockOffset: 0.12, distanceScale: 1.01 };

/** Length of a leg in AMCL: metres along either axis, and radians. */
export const LEGS = { distance: 0.25, angle: 0.2 };

/** Start and duration of the drive, its integration step, and the time between two rows of a log, s. */
const [START, DURATION, STEP, ROW] = [10, 225, 0.005, 0.05];

/** Integration steps between two rows. */
const STEPS = Math.round(ROW / STEP);

/**
 * Time in s by which the reference begins earlier and ends later than the odometry. Both have their rows at the same times but for the
 * offset of the clocks: a turn takes five rows only, so that interpolation would err by a few per cent.
 */
const AROUND = 1;

/** Seed of the noise. */
const SEED = 1;

/** Maximum accelerations of the robot, m/s² and rad/s². */
const CHANGES = { v: 0.8, omega: 2 };

/** Speed of straight drives, m/s, and rate of turns on the spot, rad/s. */
const SPEEDS = { v: 0.8, turn: 0.9 };

/** Command and its duration in seconds. @typedef {{ seconds: number, v: number, omega: number }} Command */

/** @returns {Generator<Command>} straight drives, arcs, turns on the spot and pauses, without end */
function* commands() {
  // Numbers that are spread evenly, and never the same.
  const spread = (/** @type {number} */ i, /** @type {number} */ from, /** @type {number} */ to) => from + (to - from) * ((i * 0.6180339887) % 1);
  for (let i = 1; ; i++) {
    const side = i % 3 === 0 ? -1 : 1;
    yield { seconds: spread(i, 1.5, 4), v: SPEEDS.v, omega: 0 };
    if (i % 2 === 0) yield { seconds: spread(3 * i, 1.5, 3.5), v: 0.75 * SPEEDS.v, omega: side * spread(5 * i, 0.3, 0.9) };
    if (i % 5 === 0) yield { seconds: 1, v: 0, omega: 0 };
    yield { seconds: 0.4, v: 0, omega: 0 };
    yield { seconds: spread(7 * i, 1.4, 3), v: 0, omega: side * SPEEDS.turn };
    yield { seconds: 0.4, v: 0, omega: 0 };
  }
}

/** Poses of the odometry, one a row. @param {Motion} motion @returns {Pose[]} */
function driven(motion) {
  const towards = (/** @type {number} */ is, /** @type {number} */ goal, /** @type {number} */ most) => is + Math.max(-most, Math.min(most, goal - is));
  let pose = { x: 0, y: 0, theta: 0 };
  const poses = [pose];
  let [v, omega, steps] = [0, 0, 0];
  for (const command of commands()) {
    for (let rest = Math.round(command.seconds / STEP); rest > 0; rest--) {
      if (steps >= DURATION / STEP) return poses;
      v = towards(v, command.v, CHANGES.v * STEP);
      omega = towards(omega, command.omega, CHANGES.omega * STEP);
      if (v !== 0 || omega !== 0) pose = motion.se2.boxplus(pose, [v * STEP, 0, omega * STEP]);
      steps += 1;
      if (steps % STEPS === 0) poses.push(pose);
    }
  }
  return poses;
}

/** Returns a pose with the digits of a log. @param {Pose} pose @returns {[number, number, number]} */
const rounded = ({ x, y, theta }) => [Number(x.toFixed(4)), Number(y.toFixed(4)), Number(theta.toFixed(5))];

/**
 * Returns the rows at which AMCL would update. Each is the first one whose distance or turn from the previous update exceeds a limit.
 *
 * @param {[number, number, number][]} rows
 */
function endsOf(rows) {
  const ends = [0];
  for (const [i, [x, y, theta]] of rows.entries()) {
    const [x0, y0, theta0] = rows[ends[ends.length - 1]];
    const turn = Math.atan2(Math.sin(theta - theta0), Math.cos(theta - theta0));
    if (Math.abs(x - x0) > LEGS.distance || Math.abs(y - y0) > LEGS.distance || Math.abs(turn) > LEGS.angle) ends.push(i);
  }
  return ends;
}

/**
 * Returns the true poses of the robot. The odometry model moves it leg by leg, and within a leg the error grows smoothly.
 *
 * @param {Motion} motion
 * @param {Pose[]} read poses of the odometry, one a row
 * @param {number} seed of the first leg's noise; each leg has the next one
 * @returns {Pose[]} one a row, up to the end of the last complete leg
 */
function truePoses(motion, read, seed) {
  const { se2 } = motion;
  const rows = read.map(rounded);
  const scaled = (/** @type {Pose} */ { x, y, theta }) => ({ x: TRUTH.distanceScale * x, y: TRUTH.distanceScale * y, theta });
  const posed = (/** @type {[number, number, number]} */ [x, y, theta]) => ({ x, y, theta });
  const model = new motion.OdometryModel({ alphas: TRUTH.alphas });
  const truth = [scaled(read[0])];
  const ends = endsOf(rows);
  for (const [leg, end] of ends.entries()) {
    if (leg === 0) continue;
    const from = ends[leg - 1];
    const [start, goal] = [from, end].map((row) => scaled(posed(rows[row])));
    const began = truth[from];
    const [x, y, theta] = model.sample(motion.decompose(start, goal), began, 1, seed + leg);
    const motionTo = (/** @type {Pose} */ pose) => se2.compose(se2.inverse(start), pose);
    const error = se2.boxminus(se2.compose(se2.inverse(began), { x, y, theta }), motionTo(goal));
    for (let i = from + 1; i <= end; i++) {
      const share = (i - from) / (end - from);
      const smooth = share * share * (3 - 2 * share);
      truth.push(se2.boxplus(se2.compose(began, motionTo(scaled(read[i]))), error.map((each) => smooth * each)));
    }
  }
  model.free();
  return truth;
}

/** Returns the tables of the example log, as CSV. @param {Motion} motion @param {number} [seed] */
export function exampleLog(motion, seed = SEED) {
  const read = driven(motion);
  const truth = truePoses(motion, read, seed);
  const around = Math.round(AROUND / ROW);
  const line = (/** @type {number} */ t, /** @type {Pose} */ pose) => `${[t.toFixed(3), ...rounded(pose)].join(',')}\n`;
  const table = (/** @type {string[]} */ lines) => `t,x,y,yaw\n${lines.join('')}`;
  const [odometry, reference] = [/** @type {string[]} */ ([]), /** @type {string[]} */ ([])];
  const mount = { x: 0, y: 0, theta: TRUTH.mountYaw };
  const last = truth.length - 1;
  for (let i = 0; i <= last; i++) odometry.push(line(START + i * ROW, read[i]));
  for (let i = -around; i <= last + around; i++) {
    const pose = truth[Math.max(0, Math.min(i, last))];
    reference.push(line(START + i * ROW + TRUTH.clockOffset, motion.se2.compose(pose, mount)));
  }
  return { odometry: table(odometry), reference: table(reference) };
}

/** Writes both logs. dist/core.js must be built. */
export async function writeExampleLog() {
  const { load } = await import('../dist/core.js');
  for (const [name, text] of Object.entries(exampleLog(await load()))) writeFileSync(join(ROOT, EXAMPLE_LOGS[name]), text);
}
