// Logs of examples/calibration, a drive that is simulated with known α's. `scripts/build.mjs` writes the logs.

import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { REPOSITORY_ROOT } from './process.mjs';

/** @import { Pose } from '../www/types.d.ts' */

/** @typedef {Awaited<ReturnType<typeof import('../www/core.ts').load>>} Motion */

/** Paths of the logs. @type {Record<string, string>} */
export const EXAMPLE_LOG_PATHS = { odometry: 'examples/calibration/odometry.csv', reference: 'examples/calibration/reference.csv' };

/** True parameters of the simulation. */
export const TRUE_PARAMETERS = { alphas: [0.03, 0.008, 0.002, 0.002], mountYaw: 0.03, clockOffset: 0.12, distanceScale: 1.01 };

/** Motion after which AMCL updates, and a leg ends: metres along either axis, and radians. */
export const AMCL_LEG_LENGTH = { distance: 0.25, angle: 0.2 };

/** Start and duration of the drive, its integration step, and the time between two rows of a log, s. */
const [START_TIME, DRIVE_DURATION, TIME_STEP, ROW_INTERVAL] = [10, 225, 0.005, 0.05];

/** Integration steps between two rows. */
const STEPS_PER_ROW = Math.round(ROW_INTERVAL / TIME_STEP);

/**
 * Time in s by which the reference begins earlier and ends later than the odometry. Apart from the offset of the clocks, the two logs have
 * rows at the same times. With other times, interpolation would cause errors of a few per cent, because a turn takes only five rows.
 */
const EXTRA_REFERENCE_TIME = 1;

/** Seed of the noise of the first leg. Each further leg has the next seed. */
const NOISE_SEED = 1;

/** Maximum accelerations of the robot, m/s² and rad/s². */
const MAX_ACCELERATIONS = { v: 0.8, omega: 2 };

/** Speed of straight drives, m/s, and rate of turns on the spot, rad/s. */
const DRIVE_SPEEDS = { v: 0.8, turn: 0.9 };

/** Command with its duration in seconds. @typedef {{ seconds: number, v: number, omega: number }} Command */

/** Generates commands without end: straight drives, arcs, turns on the spot and pauses. @returns {Generator<Command>} */
function* generateCommands() {
  // Returns item `i` of a sequence that is spread evenly over a range. The golden ratio ensures that items never repeat.
  const spreadEvenly = (/** @type {number} */ i, /** @type {number} */ lowerLimit, /** @type {number} */ upperLimit) => lowerLimit + (upperLimit - lowerLimit) * ((i * 0.6180339887) % 1);
  for (let i = 1; ; i++) {
    const turnSign = i % 3 === 0 ? -1 : 1;
    yield { seconds: spreadEvenly(i, 1.5, 4), v: DRIVE_SPEEDS.v, omega: 0 };
    if (i % 2 === 0) yield { seconds: spreadEvenly(3 * i, 1.5, 3.5), v: 0.75 * DRIVE_SPEEDS.v, omega: turnSign * spreadEvenly(5 * i, 0.3, 0.9) };
    if (i % 5 === 0) yield { seconds: 1, v: 0, omega: 0 };
    yield { seconds: 0.4, v: 0, omega: 0 };
    yield { seconds: spreadEvenly(7 * i, 1.4, 3), v: 0, omega: turnSign * DRIVE_SPEEDS.turn };
    yield { seconds: 0.4, v: 0, omega: 0 };
  }
}

/** Returns the poses of the odometry, one for each row. @param {Motion} motionCore @returns {Pose[]} */
function simulateOdometry(motionCore) {
  const approachValue = (/** @type {number} */ currentValue, /** @type {number} */ targetValue, /** @type {number} */ maxChange) => currentValue + Math.max(-maxChange, Math.min(maxChange, targetValue - currentValue));
  let odometryPose = { x: 0, y: 0, theta: 0 };
  const odometryPoses = [odometryPose];
  let [v, omega, stepCount] = [0, 0, 0];
  for (const driveCommand of generateCommands()) {
    for (let remainingSteps = Math.round(driveCommand.seconds / TIME_STEP); remainingSteps > 0; remainingSteps--) {
      if (stepCount >= DRIVE_DURATION / TIME_STEP) return odometryPoses;
      v = approachValue(v, driveCommand.v, MAX_ACCELERATIONS.v * TIME_STEP);
      omega = approachValue(omega, driveCommand.omega, MAX_ACCELERATIONS.omega * TIME_STEP);
      if (v !== 0 || omega !== 0) odometryPose = motionCore.se2.boxplus(odometryPose, [v * TIME_STEP, 0, omega * TIME_STEP]);
      stepCount += 1;
      if (stepCount % STEPS_PER_ROW === 0) odometryPoses.push(odometryPose);
    }
  }
  return odometryPoses;
}

/** Returns a pose rounded to the digits of a log. @param {Pose} pose @returns {[number, number, number]} */
const roundPose = ({ x, y, theta }) => [Number(x.toFixed(4)), Number(y.toFixed(4)), Number(theta.toFixed(5))];

/**
 * Returns the rows at which AMCL would update. Each is the first row whose distance or turn from the previous update exceeds a limit.
 *
 * @param {[number, number, number][]} poseRows
 */
function findLegEnds(poseRows) {
  const legEnds = [0];
  for (const [i, [x, y, theta]] of poseRows.entries()) {
    const [legStartX, legStartY, legStartTheta] = poseRows[legEnds[legEnds.length - 1]];
    const turnAngle = Math.atan2(Math.sin(theta - legStartTheta), Math.cos(theta - legStartTheta));
    if (Math.abs(x - legStartX) > AMCL_LEG_LENGTH.distance || Math.abs(y - legStartY) > AMCL_LEG_LENGTH.distance || Math.abs(turnAngle) > AMCL_LEG_LENGTH.angle) legEnds.push(i);
  }
  return legEnds;
}

/**
 * Returns the true poses of the robot. The odometry model moves it leg by leg, and within a leg the error grows smoothly.
 *
 * @param {Motion} motionCore
 * @param {Pose[]} measuredPoses poses of the odometry, one for each row
 * @returns {Pose[]} one for each row, up to the end of the last complete leg
 */
function simulateTruth(motionCore, measuredPoses) {
  const { se2 } = motionCore;
  const roundedPoses = measuredPoses.map(roundPose);
  const scalePosition = (/** @type {Pose} */ { x, y, theta }) => ({ x: TRUE_PARAMETERS.distanceScale * x, y: TRUE_PARAMETERS.distanceScale * y, theta });
  const toPose = (/** @type {[number, number, number]} */ [x, y, theta]) => ({ x, y, theta });
  const odometryModel = new motionCore.OdometryModel({ alphas: TRUE_PARAMETERS.alphas });
  const truePoses = [scalePosition(measuredPoses[0])];
  const legEnds = findLegEnds(roundedPoses);
  for (const [legIndex, legEndRow] of legEnds.entries()) {
    if (legIndex === 0) continue;
    const legStartRow = legEnds[legIndex - 1];
    const [legStart, legEnd] = [legStartRow, legEndRow].map((rowIndex) => scalePosition(toPose(roundedPoses[rowIndex])));
    const trueLegStart = truePoses[legStartRow];
    const [x, y, theta] = odometryModel.sample(motionCore.decompose(legStart, legEnd), trueLegStart, 1, NOISE_SEED + legIndex);
    const computeMotionFromStart = (/** @type {Pose} */ measuredPose) => se2.compose(se2.inverse(legStart), measuredPose);
    const legError = se2.boxminus(se2.compose(se2.inverse(trueLegStart), { x, y, theta }), computeMotionFromStart(legEnd));
    for (let i = legStartRow + 1; i <= legEndRow; i++) {
      const legFraction = (i - legStartRow) / (legEndRow - legStartRow);
      const smoothShare = legFraction * legFraction * (3 - 2 * legFraction);
      truePoses.push(se2.boxplus(se2.compose(trueLegStart, computeMotionFromStart(scalePosition(measuredPoses[i]))), legError.map((errorComponent) => smoothShare * errorComponent)));
    }
  }
  odometryModel.free();
  return truePoses;
}

/** Writes the two logs. dist/core.js must be built. */
export async function writeExampleLog() {
  const { load: loadCore } = await import('../dist/core.js');
  const motionCore = await loadCore();
  const measuredPoses = simulateOdometry(motionCore);
  const truePoses = simulateTruth(motionCore, measuredPoses);
  const extraRowCount = Math.round(EXTRA_REFERENCE_TIME / ROW_INTERVAL);
  const csvLineOf = (/** @type {number} */ t, /** @type {Pose} */ pose) => `${[t.toFixed(3), ...roundPose(pose)].join(',')}\n`;
  const csvTableOf = (/** @type {string[]} */ csvLines) => `t,x,y,yaw\n${csvLines.join('')}`;
  const mountPose = { x: 0, y: 0, theta: TRUE_PARAMETERS.mountYaw };
  const lastRow = truePoses.length - 1;
  const odometryLines = truePoses.map((_, i) => csvLineOf(START_TIME + i * ROW_INTERVAL, measuredPoses[i]));
  const referenceLines = Array.from({ length: truePoses.length + 2 * extraRowCount }, (_, rowIndex) => {
    const i = rowIndex - extraRowCount;
    const pose = truePoses[Math.max(0, Math.min(i, lastRow))];
    return csvLineOf(START_TIME + i * ROW_INTERVAL + TRUE_PARAMETERS.clockOffset, motionCore.se2.compose(pose, mountPose));
  });
  writeFileSync(join(REPOSITORY_ROOT, EXAMPLE_LOG_PATHS.odometry), csvTableOf(odometryLines));
  writeFileSync(join(REPOSITORY_ROOT, EXAMPLE_LOG_PATHS.reference), csvTableOf(referenceLines));
}
