/** Search for the error in a log whose motion disagrees with that of the other log. It tries each correction on each log. */

import { cross, greatest } from 'd3-array';
import { ROLES, UNITS, type AngleUnit, type LengthUnit, type Log, type Question, type Role } from './log.ts';
import { pathOf, poseAt, wrapAngle, type Pose } from './path.ts';
import { METRES_PER_UNIT } from './units.ts';

/** Motion of the robot in one step, in the frame of the robot, in m and rad. */
type Motion = [forward: number, left: number, turn: number];

const DEGREE = Math.PI / 180;

const POSE_CORRECTIONS: (Pick<Correction, 'name' | 'unit'> & { correct: (pose: Pose) => Pose })[] = [
  { name: 'leftHanded', correct: ([x, y, heading]) => [x, -y, -heading] },
  { name: 'angles', unit: 'deg', correct: ([x, y, heading]) => [x, y, heading * DEGREE] },
  { name: 'angles', unit: 'rad', correct: ([x, y, heading]) => [x, y, heading / DEGREE] },
];

/** Correction that makes two logs of a drive agree. */
export interface Correction {
  name: 'leftHanded' | 'angles' | 'lengths';
  at: Role;
  /** Correlation of the motions of both logs after the correction. */
  score: number;
  factor: number;
  /** Unit that the log has after a correction of lengths or angles; undefined if no unit has this size. */
  unit?: LengthUnit | AngleUnit;
}

/** Maximum ratio of a measured size of a unit to its real size, and its inverse. The odometry's wheels may have another size than assumed. */
const MAX_UNIT_ERROR = 1.2;

/** Maximum number of steps of a drive, minimum duration of a step (s), and minimum number of steps for a comparison. */
const [MAX_STEPS, MIN_STEP_SECONDS, MIN_STEPS] = [4000, 0.25, 40];

/** Maximum offset of the clocks (s) that is tried, as in the first scan of the core. */
const MAX_CLOCK_OFFSET = 10;

/** Scores are correlations: minimum of logs that agree, minimum after a correction, and maximum ratio of 1 − score after and before it. */
const [MIN_AGREEMENT_SCORE, MIN_CORRECTED_SCORE, MAX_REMAINING_FRACTION] = [0.9, 0.8, 0.3];

/** Returns true for a scale that an error of the wheels' size can explain. The core has the same limits. */
const isPlausibleScale = (scale: number) => scale >= 0.5 && scale <= 2;

/** Mean motion of a step, m or rad, below which the robot counts as standing. */
const MAX_STANDSTILL_MOTION = 1e-4;

/** Agreement of two logs: correlation of their motions (−1 to 1), and best scales of the reference's lengths and angles. */
interface Agreement { score: number; length: number; angle: number }

/** Returns the correction that makes two logs of a drive agree; undefined if they agree already, or if no correction helps. */
export function correctionOf(odometry: Log, reference: Log): Correction | undefined {
  const logs = { odometry, reference };
  const timesByRole = ROLES.map((role) => logs[role].data.t);
  const [from, to] = [Math.max(...timesByRole.map((t) => t[0])), Math.min(...timesByRole.map((t) => t[t.length - 1]))];
  const step = Math.max(MIN_STEP_SECONDS, (to - from) / MAX_STEPS, ...ROLES.map((role) => 2 / logs[role].summary.rate));
  const stepCount = Math.floor((to - from) / step);
  if (!(stepCount >= MIN_STEPS)) return undefined;
  const uncorrectedMotions = { odometry: motionsOf(odometry, from, step, stepCount), reference: motionsOf(reference, from, step, stepCount) };
  const { score, length: factor, angle } = bestAgreementOf(uncorrectedMotions, step);
  const triedCorrections = score >= MIN_AGREEMENT_SCORE ? [] : cross(POSE_CORRECTIONS, ['reference', 'odometry'] as const, ({ name, unit, correct }, at) => {
    const correctedMotions = { ...uncorrectedMotions, [at]: motionsOf(logs[at], from, step, stepCount, correct) };
    return { name, at, unit, factor, ...bestAgreementOf(correctedMotions, step) };
  });
  const minScore = Math.max(MIN_CORRECTED_SCORE, 1 - MAX_REMAINING_FRACTION * (1 - score));
  const best = greatest(triedCorrections.filter((candidate) => candidate.score >= minScore && isPlausibleScale(candidate.length) && isPlausibleScale(candidate.angle)), ({ score: correctedScore }) => correctedScore);
  if (best || score < MIN_CORRECTED_SCORE) return best;
  if (!isPlausibleScale(factor)) return lengthCorrection(logs, score, factor);
  return isPlausibleScale(angle) ? undefined : { name: 'angles', at: angle < 1 ? 'reference' : 'odometry', score, factor, unit: 'deg' };
}

/** Returns the correction of lengths. The log whose lengths then have a known unit needs it. `factor` is that for the reference. */
function lengthCorrection(logs: Record<Role, Log>, score: number, factor: number): Correction {
  const corrections = ([['reference', factor], ['odometry', 1 / factor]] as const).map(([at, factorOfLog]): Correction => {
    const size = METRES_PER_UNIT[logs[at].summary.units.length.unit] * factorOfLog;
    const unit = UNITS.lengthUnit.find((name) => Math.max(size / METRES_PER_UNIT[name], METRES_PER_UNIT[name] / size) < MAX_UNIT_ERROR);
    return { name: 'lengths', at, score, factor: factorOfLog, unit };
  });
  return corrections.find(({ unit }) => unit !== undefined) ?? corrections[0];
}

/** Returns the question for the unit of a corrected log; undefined if no unit is wrong. */
export function questionOf({ name, at, unit }: Correction, logs: Record<Role, Log>): Question | undefined {
  if (name === 'leftHanded') return undefined;
  const [what, quantity] = name === 'lengths' ? (['lengthUnit', 'length'] as const) : (['angleUnit', 'angle'] as const);
  const allUnits: readonly string[] = UNITS[what];
  const unitOf = (role: Role) => (role === at ? unit : logs[role].summary.units[quantity].unit) ?? '';
  return { what, choices: [], ...(unit && { pair: ROLES.map((role) => (allUnits.includes(unitOf(role)) ? unitOf(role) : allUnits[0])).join() }) };
}

/** Returns the motions of a log in equal steps, from a start time on. Steps with a jump or another break have no motion. */
function motionsOf({ data }: Log, from: number, step: number, count: number, correct = (pose: Pose) => pose): Motion[] {
  const path = pathOf(data, Math.max(1, Math.floor(data.t.length / (4 * MAX_STEPS))));
  const correctedPath = { ...path, poses: path.poses.map(correct) };
  const stepPoses = Array.from({ length: count + 1 }, (_, i) => poseAt(correctedPath, from + i * step));
  const brokenSteps = new Set(Array.from(data.breaks, (row) => [row - 1, row].map((end) => Math.floor((data.t[end] - from) / step))).flat());
  return stepPoses.slice(1).map(([x, y, heading], i) => {
    if (brokenSteps.has(i)) return [0, 0, 0];
    const [dx, dy, turn] = [x - stepPoses[i][0], y - stepPoses[i][1], wrapAngle(heading - stepPoses[i][2])];
    const middleHeading = stepPoses[i][2] + turn / 2;
    return [dx * Math.cos(middleHeading) + dy * Math.sin(middleHeading), dy * Math.cos(middleHeading) - dx * Math.sin(middleHeading), turn];
  });
}

/** Returns the agreement of two logs at the smallest clock offset at which they agree, or at the best offset if they do not agree. */
function bestAgreementOf({ odometry, reference }: Record<Role, Motion[]>, step: number): Agreement {
  const maxLag = Math.round(MAX_CLOCK_OFFSET / step);
  let best: Agreement = { score: -1, length: 1, angle: 1 };
  for (let i = 0; i <= 2 * maxLag && best.score < MIN_AGREEMENT_SCORE; i++) {
    const agreement = agreementAt(odometry, reference, i % 2 === 0 ? i / 2 : -(i + 1) / 2, odometry.length - maxLag);
    if (agreement.score > best.score) best = agreement;
  }
  return best;
}

/** Returns the agreement at a clock offset of `lag` steps, for any angle between the headings. Its score is −1 if fewer than half of `count` steps overlap. */
function agreementAt(odometry: Motion[], reference: Motion[], lag: number, count: number): Agreement {
  // Sums of squares and products of the motions. `across` is the cross product of the displacements, and `driveProducts` their dot product.
  let [odoDriveSquares, driveProducts, across, refDriveSquares, odoTurnSquares, turnProducts, refTurnSquares] = [0, 0, 0, 0, 0, 0, 0];
  const [first, end] = [Math.max(0, -lag), Math.min(odometry.length, reference.length - lag)];
  for (let i = first; i < end; i++) {
    const [odo, ref] = [odometry[i], reference[i + lag]];
    odoDriveSquares += odo[0] * odo[0] + odo[1] * odo[1];
    driveProducts += odo[0] * ref[0] + odo[1] * ref[1];
    across += odo[0] * ref[1] - odo[1] * ref[0];
    refDriveSquares += ref[0] * ref[0] + ref[1] * ref[1];
    odoTurnSquares += odo[2] * odo[2];
    turnProducts += odo[2] * ref[2];
    refTurnSquares += ref[2] * ref[2];
  }
  if (2 * (end - first) < count) return { score: -1, length: 1, angle: 1 };
  // For a robot that only drives straight or only turns on the spot, one of the two correlations is undefined.
  const [drive, turn] = [[odoDriveSquares, Math.hypot(driveProducts, across), refDriveSquares], [odoTurnSquares, turnProducts, refTurnSquares]].map(([odo, both, ref]) =>
    (Math.sqrt(Math.max(odo, ref) / (end - first)) < MAX_STANDSTILL_MOTION ? { correlation: 1, scale: 1 } : { correlation: both / Math.sqrt(odo * ref || 1), scale: odo / both }));
  return { score: Math.min(drive.correlation, turn.correlation), length: drive.scale, angle: turn.scale };
}
