// `node scripts/example-log.mjs` writes the logs of examples/calibration anew: a drive that is simulated with known α's.

import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { ROOT, runAsScript } from './process.mjs';

/** @import { Pose } from '../www/types.d.ts' */

/** @typedef {Awaited<ReturnType<typeof import('../www/core.js').load>>} Motion */

/** What the logs were made with. */
export const TRUTH = { alphas: [0.03, 0.008, 0.002, 0.002], mountYaw: 0.03, clockOffset: 0.12, distanceScale: 1.01 };

/** How AMCL cuts legs, in metres along either axis and in radians. */
export const LEGS = { distance: 0.25, angle: 0.2 };

/** Seconds at which the drive begins, that it takes, between two steps of it, and between two rows of a log. */
const [START, DURATION, STEP, ROW] = [10, 225, 0.005, 0.05];

/**
 * The reference goes on for so long before and after. But for the clocks it has its rows when the odometry does: a turn of a
 * leg takes five rows, and what lies between two of them would be known to some hundredths of its error.
 */
const AROUND = 1;

/** Of the noise of the log that comes with the package. */
const SEED = 1;

/** m/s² and rad/s²: what the robot's speeds change by at most. */
const CHANGES = { v: 0.8, omega: 2 };

/** m/s, rad/s. */
const SPEEDS = { v: 0.8, turn: 0.9 };

/** Seconds, and what is commanded in them. @typedef {{ seconds: number, v: number, omega: number }} Command */

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

/** @param {Motion} motion @returns {Pose[]} where the odometry takes the robot to be, every STEP seconds */
function driven(motion) {
  const towards = (/** @type {number} */ is, /** @type {number} */ goal, /** @type {number} */ most) => is + Math.max(-most, Math.min(most, goal - is));
  /** @type {Pose[]} */
  const poses = [{ x: 0, y: 0, theta: 0 }];
  let [v, omega] = [0, 0];
  for (const command of commands()) {
    for (let rest = Math.round(command.seconds / STEP); rest > 0; rest--) {
      if (poses.length > DURATION / STEP) return poses;
      v = towards(v, command.v, CHANGES.v * STEP);
      omega = towards(omega, command.omega, CHANGES.omega * STEP);
      const pose = poses[poses.length - 1];
      poses.push(v === 0 && omega === 0 ? pose : motion.se2.boxplus(pose, [v * STEP, 0, omega * STEP]));
    }
  }
  return poses;
}

/** A pose as a log has it. @param {Pose} pose @returns {[number, number, number]} */
const rounded = ({ x, y, theta }) => [Number(x.toFixed(4)), Number(y.toFixed(4)), Number(theta.toFixed(5))];

/**
 * The ends of the legs that AMCL makes of an odometry: the first row that is further from the last of them than it waits for.
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
 * Where the robot really is: leg by leg, the odometry model moves it from what the odometry tells, and within a leg the
 * error grows smoothly.
 *
 * @param {Motion} motion
 * @param {Pose[]} told every STEP seconds
 * @param {number} seed of the first leg's noise; each leg has the next one
 * @returns {Pose[]} every STEP seconds
 */
function real(motion, told, seed) {
  const { se2 } = motion;
  const every = Math.round(ROW / STEP);
  const rows = told.filter((_, i) => i % every === 0).map(rounded);
  const scaled = (/** @type {Pose} */ { x, y, theta }) => ({ x: TRUTH.distanceScale * x, y: TRUTH.distanceScale * y, theta });
  const posed = (/** @type {[number, number, number]} */ [x, y, theta]) => ({ x, y, theta });
  const model = new motion.OdometryModel({ alphas: TRUTH.alphas });
  const truth = [scaled(told[0])];
  const ends = endsOf(rows);
  for (const [leg, end] of ends.entries()) {
    if (leg === 0) continue;
    const [from, to] = [ends[leg - 1] * every, end * every];
    const [start, goal] = [ends[leg - 1], end].map((row) => scaled(posed(rows[row])));
    const began = truth[from];
    const [x, y, theta] = model.sample(motion.decompose(start, goal), began, 1, seed + leg);
    const motionTo = (/** @type {Pose} */ pose) => se2.compose(se2.inverse(start), pose);
    const error = se2.boxminus(se2.compose(se2.inverse(began), { x, y, theta }), motionTo(goal));
    for (let i = from + 1; i <= to; i++) {
      const share = (i - from) / (to - from);
      const smooth = share * share * (3 - 2 * share);
      truth.push(se2.boxplus(se2.compose(began, motionTo(scaled(told[i]))), error.map((each) => smooth * each)));
    }
  }
  model.free();
  return truth;
}

/**
 * @param {Motion} motion
 * @param {number} [seed]
 * @returns {{ odometry: string, reference: string }} CSV
 */
export function exampleLog(motion, seed = SEED) {
  const told = driven(motion);
  const truth = real(motion, told, seed);
  const after = (/** @type {number} */ seconds) => Math.round(seconds / STEP);
  const line = (/** @type {number} */ t, /** @type {Pose} */ pose) => `${[t.toFixed(3), ...rounded(pose)].join(',')}\n`;
  const table = (/** @type {string[]} */ lines) => `t,x,y,yaw\n${lines.join('')}`;
  const [odometry, reference] = [/** @type {string[]} */ ([]), /** @type {string[]} */ ([])];
  const mount = { x: 0, y: 0, theta: TRUTH.mountYaw };
  // The last leg is not complete: nobody knows what the model makes of it.
  const last = truth.length - 1;
  for (let i = 0; i <= last; i += after(ROW)) odometry.push(line(START + i * STEP, told[i]));
  for (let i = -after(AROUND); i <= last + after(AROUND); i += after(ROW)) {
    const pose = truth[Math.max(0, Math.min(i, last))];
    reference.push(line(START + i * STEP + TRUTH.clockOffset, motion.se2.compose(pose, mount)));
  }
  return { odometry: table(odometry), reference: table(reference) };
}

await runAsScript(import.meta.url, async () => {
  const { load } = await import('../dist/core.js');
  const logs = exampleLog(await load());
  const folder = join(ROOT, 'examples/calibration');
  mkdirSync(folder, { recursive: true });
  for (const [name, text] of Object.entries(logs)) writeFileSync(join(folder, `${name}.csv`), text);
});
