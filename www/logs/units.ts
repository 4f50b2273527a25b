/** Units of a log, judged by names, the size of numbers, and the motion of the robot. If a unit is in doubt, the log is refused with a question to the user. */

import { sort } from 'd3-array';
import { COLUMN_CHANGES, type ColumnChange } from './columns.ts';
import { LogError, UNITS, type ErrorPlace, type AngleUnit, type Commands, type LogKind, type OpenOptions, type Poses, type FileQuestion, type Summary, type TimeUnit } from './log.ts';
import { quantileOf, sampleEvenly } from './path.ts';

export type Units = Summary['units'];

/** Columns of a log in the units of its file: x, y, heading and height for poses; v, omega, 0 and 0 for commands. `start` (s) was subtracted from all times. */
export interface Columns { start: number; t: Float64Array; a: Float64Array; b: Float64Array; c: Float64Array; z: Float64Array }

/** Function that returns a question to the user, which proposes a change of a table's columns. */
export type CreateColumnQuestion = (change: ColumnChange) => FileQuestion;

/** Decimal exponent of each unit of time: a second has 10 to this power of units. */
export const UNIT_EXPONENTS = { s: 0, ms: 3, us: 6, ns: 9 } as const;

/** Sizes of the units of length in m, and of the units of angle in rad. */
export const METRES_PER_UNIT = { m: 1, cm: 0.01, mm: 0.001, ft: 0.3048, in: 0.0254 } as const;
const RADIANS_PER_UNIT = { rad: 1, deg: Math.PI / 180 } as const;

/** Minimum value of times since 1970, by unit. 1e8 s is the year 1973, and 1e11 s the year 5138. */
const MIN_EPOCH_TIMES = [['ns', 1e17], ['us', 1e14], ['ms', 1e11], ['s', 1e8]] as const;

/** Maximum heading (rad) of an angle that is wrapped at a full circle, with a margin for rounding. */
const MAX_WRAPPED_HEADING = 2 * Math.PI + 0.1;

const MIN_ROWS = 10;

/** Usual range of the rate of a log (Hz), and wider range that is accepted for times since 1970. */
const [USUAL_RATES, POSSIBLE_RATES] = [[0.2, 2000], [0.05, 5000]] as const;

/** Minimum and maximum plausible speed of a robot, m/s or rad/s. */
const [MIN_SPEED, MAX_SPEED] = [0.005, 20.5];

/** Limits above which the unit of length is doubtful: a speed (m/s) together with an acceleration (m/s²) beyond that of tyres, and a speed (m/s) alone. */
const [DOUBTFUL_SPEED, MAX_ACCELERATION, MAX_VEHICLE_SPEED] = [5, 10, 50];

/** Typical speed of a robot, m/s. */
const USUAL_SPEED = 0.5;

/** Duration (s) of the steps from which speeds are computed. In shorter steps, noise would look like a high speed. */
const STEP_DURATION = 0.5;

/** Minimum length (m) of a step whose direction is compared with the heading, and minimum number of such steps. */
const [MIN_STEP_LENGTH, MIN_STEPS] = [0.02, 20];

/** Limits for accepting a unit and sign of headings: minimum mean resultant length of the angles between headings and path, and minimum lead over all other combinations. */
const [MIN_ALIGNMENT, MIN_ALIGNMENT_LEAD] = [0.8, 0.3];

const isInRange = (value: number, [low, high]: readonly [number, number]) => value >= low && value <= high;

/** Returns the unit of a time since 1970 by its size; undefined for smaller times. */
export const epochTimeUnitOf = (epochTime: number): TimeUnit | undefined => MIN_EPOCH_TIMES.find(([, minTime]) => Math.abs(epochTime) >= minTime)?.[0];

/** Judges the units that no name or option states, and converts the columns to s, m and rad. Throws a LogError if a unit is in doubt. */
export function judgeUnits(errorPlace: ErrorPlace, kind: LogKind, columns: Columns, assumedUnits: Units, options: OpenOptions, createColumnQuestion?: CreateColumnQuestion): Units {
  const { t, a, b, c, z } = columns;
  const isJudged = t.length >= MIN_ROWS;
  const length = options.lengthUnit ? { unit: options.lengthUnit, by: 'option' as const } : assumedUnits.length;
  const metresPerUnit = METRES_PER_UNIT[length.unit];
  if (metresPerUnit !== 1) for (const column of kind === 'poses' ? [a, b, z] : [a]) scaleColumn(column, metresPerUnit);
  const time = isJudged ? judgeTimeUnit(errorPlace, kind, columns, assumedUnits.time) : assumedUnits.time;
  convertTimes(columns, 10 ** (UNIT_EXPONENTS[time.unit] - UNIT_EXPONENTS[assumedUnits.time.unit]));
  const speed = kind === 'poses' ? pathSpeedOf(t, a, b) : commandSpeedOf(a);
  const isDoubtful = speed > MAX_VEHICLE_SPEED || (speed > DOUBTFUL_SPEED && accelerationOf(kind, columns) > MAX_ACCELERATION);
  // Feet and inches are proposed last, because robots rarely use them.
  const likelyUnits = sort(UNITS.lengthUnit, (unit) => Number(unit === 'ft' || unit === 'in'), (unit) => Math.abs(Math.log((speed * METRES_PER_UNIT[unit]) / USUAL_SPEED)));
  if (isJudged && length.by === 'usage' && isDoubtful) throw createUnitError(errorPlace, 'lengthUnit', speed, length.unit, likelyUnits);

  const { unit, by } = options.angleUnit ? { unit: options.angleUnit, by: 'option' as const } : assumedUnits.angle;
  const alignment = isJudged && kind === 'poses' ? alignmentWithPath(t, a, b, c) : undefined;
  if (alignment?.sign === -1) {
    // The cosine is negative if x and y are swapped, because headings and path then differ by a right angle. Otherwise y has the wrong sign.
    throw new LogError(errorPlace, (texts) => texts.mirroredPathReason, createColumnQuestion?.(COLUMN_CHANGES[alignment.cosine < 0 ? 'swappedXAndY' : 'negatedY']));
  }
  const alignmentWithYUp = isJudged && kind === 'poses' && createColumnQuestion && !alignment ? alignmentWithPath(t, a, z, c) : undefined;
  if (createColumnQuestion && alignmentWithYUp) throw new LogError(errorPlace, (texts) => texts.yUpReason, createColumnQuestion(COLUMN_CHANGES[alignmentWithYUp.sign > 0 ? 'leftHandedWithYUp' : 'yUp']));
  const turnRateAt = kind === 'poses' ? (i: number) => (c[i + 1] - c[i]) / (t[i + 1] - t[i]) : (i: number) => b[i];
  const turnRate = quantileOf(sampleEvenly(t.length - 1, (i) => Math.abs(turnRateAt(i))), 0.9);
  const mayBeDegrees = kind === 'poses' ? c.some((heading) => Math.abs(heading) > MAX_WRAPPED_HEADING) : turnRate > MAX_SPEED;
  const isContradicted = alignment !== undefined && unit !== 'quaternion' && alignment.unit !== unit;
  const isUnclear = by === 'usage' ? mayBeDegrees && !alignment : isContradicted;
  if (isJudged && isUnclear) throw createUnitError(errorPlace, 'angleUnit', turnRate * RADIANS_PER_UNIT[unit as AngleUnit], unit, [...UNITS.angleUnit]);
  const angle: Units['angle'] = isContradicted ? { unit: alignment.unit, by: 'size' } : { unit, by };
  if (angle.unit === 'deg') scaleColumn(kind === 'poses' ? c : b, RADIANS_PER_UNIT.deg);
  return { time, length, angle };
}

/** Returns an error with a question for the unit. If no unit is possible, the error has no question. */
const createUnitError = (errorPlace: ErrorPlace, option: keyof typeof UNITS, value: number, assumedUnit: string, choices: string[]) =>
  new LogError(errorPlace, (texts) => texts[option](value, assumedUnit, choices), choices.length > 0 ? { option, choices: sort(choices, (unit) => Number(unit === assumedUnit)) } : undefined);

/** Judges a unit of time that is not stated, from the rate of the rows and the speed of the robot. */
function judgeTimeUnit(errorPlace: ErrorPlace, kind: LogKind, { t, a, b }: Columns, assumedUnit: Units['time']): Units['time'] {
  if (assumedUnit.by !== 'usage' && assumedUnit.by !== 'size') return assumedUnit;
  const rate = 1 / medianStepOf(t);
  const speed = kind === 'poses' ? pathSpeedOf(t, a, b) : 0;
  const unitsPerSecondOf = (unit: TimeUnit) => 10 ** (UNIT_EXPONENTS[unit] - UNIT_EXPONENTS[assumedUnit.unit]);
  const hasUsualRate = (unit: TimeUnit) => isInRange(rate * unitsPerSecondOf(unit), assumedUnit.by === 'size' ? POSSIBLE_RATES : USUAL_RATES);
  const hasUsualSpeed = (unit: TimeUnit) => speed === 0 || isInRange(speed * unitsPerSecondOf(unit), [MIN_SPEED, MAX_SPEED]);
  if (hasUsualRate(assumedUnit.unit) && (assumedUnit.by === 'size' || hasUsualSpeed(assumedUnit.unit))) return assumedUnit;
  const possibleUnits = UNITS.timeUnit.filter(hasUsualRate);
  const [unit, ...otherUnits] = possibleUnits.filter(hasUsualSpeed);
  if (unit && otherUnits.length === 0 && speed > 0) return { unit, by: 'rate' };
  // The assumed unit of time is kept if it gives a usual rate. An unusual speed may be due to the unit of length.
  if (hasUsualRate(assumedUnit.unit)) return assumedUnit;
  throw createUnitError(errorPlace, 'timeUnit', rate, assumedUnit.unit, possibleUnits);
}

/**
 * Returns the unit and sign with which headings and direction of the path differ by a constant angle. The sign is −1 if headings turn the other way.
 * `cosine` is proportional to the cosine of twice that angle. Undefined for a short path, or if no combination fits (a robot that drives sideways) or
 * several do (a straight path).
 */
function alignmentWithPath(t: Float64Array, x: Float64Array, y: Float64Array, heading: Float64Array): { unit: AngleUnit; sign: number; cosine: number } | undefined {
  const stride = Math.max(2, Math.ceil(STEP_DURATION / medianStepOf(t)));
  const candidates = UNITS.angleUnit.flatMap((unit) => [1, -1].map((sign) => ({ unit, sign, cosine: 0, sine: 0 })));
  let stepCount = 0;
  for (let i = 0; i + stride < t.length; i += stride) {
    const [dx, dy] = [x[i + stride] - x[i], y[i + stride] - y[i]];
    if (Math.hypot(dx, dy) < MIN_STEP_LENGTH) continue;
    stepCount += 1;
    for (const candidate of candidates) {
      // The doubled angle between heading and path is the same for forward and reverse driving, which differ by half a turn.
      const angle = 2 * (Math.atan2(dy, dx) - candidate.sign * RADIANS_PER_UNIT[candidate.unit] * heading[i + (stride >> 1)]);
      candidate.cosine += Math.cos(angle);
      candidate.sine += Math.sin(angle);
    }
  }
  // The mean resultant length of the angles is 1 if all angles are equal, and near 0 if they are random.
  const alignments = candidates.map((candidate) => ({ ...candidate, alignment: Math.hypot(candidate.cosine, candidate.sine) / stepCount }));
  const [bestAlignment, secondBestAlignment] = alignments.sort((alignment, otherAlignment) => otherAlignment.alignment - alignment.alignment);
  return stepCount >= MIN_STEPS && bestAlignment.alignment > MIN_ALIGNMENT && bestAlignment.alignment - secondBestAlignment.alignment > MIN_ALIGNMENT_LEAD ? bestAlignment : undefined;
}

const medianStepOf = (t: Float64Array) => quantileOf(sampleEvenly(t.length - 1, (i) => t[i + 1] - t[i]), 0.5);

/** Returns the 90 % quantile of the speeds of steps along a path, given times in seconds. */
function pathSpeedOf(t: Float64Array, x: Float64Array, y: Float64Array): number {
  const stride = Math.min(Math.max(1, Math.round(STEP_DURATION / medianStepOf(t))), t.length - 1);
  return quantileOf(sampleEvenly(t.length - stride, (i) => Math.hypot(x[i + stride] - x[i], y[i + stride] - y[i]) / (t[i + stride] - t[i])), 0.9);
}

const commandSpeedOf = (v: Float64Array): number => quantileOf(sampleEvenly(v.length, (i) => Math.abs(v[i])), 0.9);

/** Returns the 90 % quantile of the speeds of a log (m/s). */
export const logSpeedOf = (data: Poses | Commands): number => ('x' in data ? pathSpeedOf(data.t, data.x, data.y) : commandSpeedOf(data.v));

/** Returns the 99 % quantile of the accelerations between steps; for commands, that of the accelerations of v. */
function accelerationOf(kind: LogKind, { t, a, b }: Columns): number {
  const stride = Math.max(1, Math.round(STEP_DURATION / medianStepOf(t)));
  const velocityAt = (i: number, column: Float64Array) => (column[i + stride] - column[i]) / (t[i + stride] - t[i]);
  const velocityChangeAt = (i: number, column: Float64Array) => velocityAt(i + stride, column) - velocityAt(i, column);
  const accelerationAt = (i: number) => (kind === 'poses' ? (2 * Math.hypot(velocityChangeAt(i, a), velocityChangeAt(i, b))) / (t[i + 2 * stride] - t[i]) : Math.abs(velocityAt(i, a)));
  return quantileOf(sampleEvenly(t.length - 2 * stride, accelerationAt), 0.99);
}

function scaleColumn(column: Float64Array, factor: number): void {
  for (let i = 0; i < column.length; i++) column[i] *= factor;
}

/** Divides all times by a factor. The start of the log remains a whole second. */
function convertTimes(columns: Columns, factor: number): void {
  if (factor === 1) return;
  const { start, t } = columns;
  columns.start = Math.floor((start + t[0]) / factor);
  for (let i = 0; i < t.length; i++) t[i] = (start + t[i]) / factor - columns.start;
}
