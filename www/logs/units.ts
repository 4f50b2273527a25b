/** Units of a log, judged by names, the size of numbers, and the motion of the robot. If a unit is in doubt, the log is refused with a question to the user. */

import { sort } from 'd3-array';
import { COLUMN_CHANGES, type ColumnChange } from './columns.ts';
import { LogError, UNIT_NAMES, type ErrorPlace, type AngleUnit, type Commands, type LogKind, type OpenOptions, type Poses, type FileQuestion, type LogSummary, type TimeUnit } from './log.ts';
import { quantileOf, sampleEvenly } from './path.ts';

export type LogUnits = LogSummary['units'];

/** Columns of a log in the units of its file: x, y, heading and height for poses; v, omega, 0 and 0 for commands. `startTime` (s) was subtracted from all times. */
export interface SampleColumns { startTime: number; t: Float64Array; a: Float64Array; b: Float64Array; c: Float64Array; z: Float64Array }

/** Function that returns a question to the user, which proposes a change of a table's columns. */
export type CreateColumnQuestion = (columnChange: ColumnChange) => FileQuestion;

/** Decimal exponent of each unit of time: a second has 10 to this power of units. */
export const UNIT_EXPONENTS = { s: 0, ms: 3, us: 6, ns: 9 } as const;

/** Sizes of the units of length in m, and of the units of angle in rad. */
export const METRES_PER_UNIT = { m: 1, cm: 0.01, mm: 0.001, ft: 0.3048, in: 0.0254 } as const;
const RADIANS_PER_UNIT = { rad: 1, deg: Math.PI / 180 } as const;

/** Minimum value of times since 1970, by unit. 1e8 s is the year 1973, and 1e11 s the year 5138. */
const MIN_EPOCH_TIMES = [['ns', 1e17], ['us', 1e14], ['ms', 1e11], ['s', 1e8]] as const;

/** Maximum absolute value (rad) of headings that are wrapped to a full circle, with a margin for rounding. Larger headings may be degrees. */
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

const isInRange = (checkedNumber: number, [lowLimit, highLimit]: readonly [number, number]) => checkedNumber >= lowLimit && checkedNumber <= highLimit;

/** Returns the unit of a time since 1970 by its size; undefined for smaller times. */
export const epochTimeUnitOf = (epochTime: number): TimeUnit | undefined => MIN_EPOCH_TIMES.find(([, minTime]) => Math.abs(epochTime) >= minTime)?.[0];

/** Judges the units that no name or option states, and converts the columns to s, m and rad. Throws a LogError if a unit is in doubt. */
export function judgeUnits(errorPlace: ErrorPlace, logKind: LogKind, sampleColumns: SampleColumns, assumedUnits: LogUnits, openOptions: OpenOptions, createColumnQuestion?: CreateColumnQuestion): LogUnits {
  const { t, a, b, c, z } = sampleColumns;
  const isJudged = t.length >= MIN_ROWS;
  const lengthUnit = openOptions.lengthUnit ? { unit: openOptions.lengthUnit, by: 'option' as const } : assumedUnits.length;
  const metresPerUnit = METRES_PER_UNIT[lengthUnit.unit];
  if (metresPerUnit !== 1) for (const sampleColumn of logKind === 'poses' ? [a, b, z] : [a]) scaleColumn(sampleColumn, metresPerUnit);
  const timeUnit = isJudged ? judgeTimeUnit(errorPlace, logKind, sampleColumns, assumedUnits.time) : assumedUnits.time;
  convertTimes(sampleColumns, 10 ** (UNIT_EXPONENTS[timeUnit.unit] - UNIT_EXPONENTS[assumedUnits.time.unit]));
  const pathSpeed = logKind === 'poses' ? pathSpeedOf(t, a, b) : commandSpeedOf(a);
  const isDoubtful = pathSpeed > MAX_VEHICLE_SPEED || (pathSpeed > DOUBTFUL_SPEED && accelerationOf(logKind, sampleColumns) > MAX_ACCELERATION);
  // Feet and inches are proposed last, because robots rarely use them.
  const likelyUnits = sort(UNIT_NAMES.lengthUnit, (unitName) => Number(unitName === 'ft' || unitName === 'in'), (unitName) => Math.abs(Math.log((pathSpeed * METRES_PER_UNIT[unitName]) / USUAL_SPEED)));
  if (isJudged && lengthUnit.by === 'usage' && isDoubtful) {
    const unitChoices = likelyUnits.map((unitName) => `${unitName} (${Number((pathSpeed * METRES_PER_UNIT[unitName]).toPrecision(2))} m/s)`);
    throw createUnitError(errorPlace, 'lengthUnit', pathSpeed, lengthUnit.unit, likelyUnits, unitChoices);
  }

  const { unit: unitName, by: unitBasis } = openOptions.angleUnit ? { unit: openOptions.angleUnit, by: 'option' as const } : assumedUnits.angle;
  const pathAlignment = isJudged && logKind === 'poses' ? alignmentWithPath(t, a, b, c) : undefined;
  if (pathAlignment?.headingSign === -1) {
    // `cosine`, that of twice the angle between headings and path, is negative if x and y are swapped: the angle is then a right angle. Otherwise y has the wrong sign.
    throw new LogError(errorPlace, (errorReasons) => errorReasons.mirroredPathReason, createColumnQuestion?.(COLUMN_CHANGES[pathAlignment.cosine < 0 ? 'swappedXAndY' : 'negatedY']));
  }
  const alignmentWithYUp = isJudged && logKind === 'poses' && createColumnQuestion && !pathAlignment ? alignmentWithPath(t, a, z, c) : undefined;
  if (createColumnQuestion && alignmentWithYUp) throw new LogError(errorPlace, (errorReasons) => errorReasons.yUpReason, createColumnQuestion(COLUMN_CHANGES[alignmentWithYUp.headingSign > 0 ? 'leftHandedWithYUp' : 'yUp']));
  const turnRateAt = logKind === 'poses' ? (i: number) => (c[i + 1] - c[i]) / (t[i + 1] - t[i]) : (i: number) => b[i];
  const turnRate = quantileOf(sampleEvenly(t.length - 1, (i) => Math.abs(turnRateAt(i))), 0.9);
  const mayBeDegrees = logKind === 'poses' ? c.some((heading) => Math.abs(heading) > MAX_WRAPPED_HEADING) : turnRate > MAX_SPEED;
  const isContradicted = pathAlignment !== undefined && unitName !== 'quaternion' && pathAlignment.unit !== unitName;
  const isUnclear = unitBasis === 'usage' ? mayBeDegrees && !pathAlignment : isContradicted;
  if (isJudged && isUnclear) throw createUnitError(errorPlace, 'angleUnit', turnRate * RADIANS_PER_UNIT[unitName as AngleUnit], unitName, [...UNIT_NAMES.angleUnit]);
  const angle: LogUnits['angle'] = isContradicted ? { unit: pathAlignment.unit, by: 'size' } : { unit: unitName, by: unitBasis };
  if (angle.unit === 'deg') scaleColumn(logKind === 'poses' ? c : b, RADIANS_PER_UNIT.deg);
  return { time: timeUnit, length: lengthUnit, angle };
}

/** Returns an error with a question for the unit. If no unit is possible, the error has no question. `unitChoices` are the units as the message lists them. */
const createUnitError = (errorPlace: ErrorPlace, unitOption: keyof typeof UNIT_NAMES, doubtfulRate: number, assumedUnit: string, possibleUnits: string[], unitChoices = possibleUnits) =>
  new LogError(errorPlace, (errorReasons) => errorReasons[unitOption](doubtfulRate, assumedUnit, unitChoices), possibleUnits.length > 0 ? { optionName: unitOption, possibleAnswers: sort(possibleUnits, (unitName) => Number(unitName === assumedUnit)) } : undefined);

/** Judges a unit of time that is not stated, from the rate of the rows and the speed of the robot. */
function judgeTimeUnit(errorPlace: ErrorPlace, logKind: LogKind, { t, a, b }: SampleColumns, assumedUnit: LogUnits['time']): LogUnits['time'] {
  if (assumedUnit.by !== 'usage' && assumedUnit.by !== 'size') return assumedUnit;
  const rowRate = 1 / medianStepOf(t);
  const pathSpeed = logKind === 'poses' ? pathSpeedOf(t, a, b) : 0;
  const unitsPerSecondOf = (unitName: TimeUnit) => 10 ** (UNIT_EXPONENTS[unitName] - UNIT_EXPONENTS[assumedUnit.unit]);
  const hasUsualRate = (unitName: TimeUnit) => isInRange(rowRate * unitsPerSecondOf(unitName), assumedUnit.by === 'size' ? POSSIBLE_RATES : USUAL_RATES);
  const hasUsualSpeed = (unitName: TimeUnit) => pathSpeed === 0 || isInRange(pathSpeed * unitsPerSecondOf(unitName), [MIN_SPEED, MAX_SPEED]);
  if (hasUsualRate(assumedUnit.unit) && (assumedUnit.by === 'size' || hasUsualSpeed(assumedUnit.unit))) return assumedUnit;
  const possibleUnits = UNIT_NAMES.timeUnit.filter(hasUsualRate);
  const [timeUnit, ...otherUnits] = possibleUnits.filter(hasUsualSpeed);
  if (timeUnit && otherUnits.length === 0 && pathSpeed > 0) return { unit: timeUnit, by: 'rate' };
  // The assumed unit of time is kept if it gives a usual rate. An unusual speed may be due to the unit of length.
  if (hasUsualRate(assumedUnit.unit)) return assumedUnit;
  throw createUnitError(errorPlace, 'timeUnit', rowRate, assumedUnit.unit, possibleUnits);
}

/**
 * Returns the unit and sign with which headings and direction of the path differ by a constant angle. The sign is −1 if headings turn the other way.
 * `cosine` is proportional to the cosine of twice that angle. Undefined for a short path, or if no combination fits (a robot that drives sideways) or
 * several do (a straight path).
 */
function alignmentWithPath(t: Float64Array, x: Float64Array, y: Float64Array, heading: Float64Array): { unit: AngleUnit; headingSign: number; cosine: number } | undefined {
  const rowStride = Math.max(2, Math.ceil(STEP_DURATION / medianStepOf(t)));
  const headingAlignments = UNIT_NAMES.angleUnit.flatMap((unitName) => [1, -1].map((headingSign) => ({ unit: unitName, headingSign, cosine: 0, sine: 0 })));
  let stepCount = 0;
  for (let i = 0; i + rowStride < t.length; i += rowStride) {
    const [dx, dy] = [x[i + rowStride] - x[i], y[i + rowStride] - y[i]];
    if (Math.hypot(dx, dy) < MIN_STEP_LENGTH) continue;
    stepCount += 1;
    for (const headingAlignment of headingAlignments) {
      // The doubled angle between heading and path is the same for forward and reverse driving, which differ by half a turn.
      const angle = 2 * (Math.atan2(dy, dx) - headingAlignment.headingSign * RADIANS_PER_UNIT[headingAlignment.unit] * heading[i + (rowStride >> 1)]);
      headingAlignment.cosine += Math.cos(angle);
      headingAlignment.sine += Math.sin(angle);
    }
  }
  // The mean resultant length of the angles is 1 if all angles are equal, and near 0 if they are random.
  const sortedAlignments = headingAlignments.map((headingAlignment) => ({ ...headingAlignment, meanCosine: Math.hypot(headingAlignment.cosine, headingAlignment.sine) / stepCount }));
  const [bestAlignment, secondBestAlignment] = sortedAlignments.sort((pathAlignment, otherAlignment) => otherAlignment.meanCosine - pathAlignment.meanCosine);
  return stepCount >= MIN_STEPS && bestAlignment.meanCosine > MIN_ALIGNMENT && bestAlignment.meanCosine - secondBestAlignment.meanCosine > MIN_ALIGNMENT_LEAD ? bestAlignment : undefined;
}

const medianStepOf = (t: Float64Array) => quantileOf(sampleEvenly(t.length - 1, (i) => t[i + 1] - t[i]), 0.5);

/** Returns the 90 % quantile of the speeds of steps along a path, given times in seconds. */
function pathSpeedOf(t: Float64Array, x: Float64Array, y: Float64Array): number {
  const rowStride = Math.min(Math.max(1, Math.round(STEP_DURATION / medianStepOf(t))), t.length - 1);
  return quantileOf(sampleEvenly(t.length - rowStride, (i) => Math.hypot(x[i + rowStride] - x[i], y[i + rowStride] - y[i]) / (t[i + rowStride] - t[i])), 0.9);
}

const commandSpeedOf = (v: Float64Array): number => quantileOf(sampleEvenly(v.length, (i) => Math.abs(v[i])), 0.9);

/** Returns the 90 % quantile of the speeds of a log (m/s). */
export const logSpeedOf = (motionData: Poses | Commands): number => ('x' in motionData ? pathSpeedOf(motionData.t, motionData.x, motionData.y) : commandSpeedOf(motionData.v));

/** Returns the 99 % quantile of the accelerations between steps; for commands, that of the accelerations of v. */
function accelerationOf(logKind: LogKind, { t, a, b }: SampleColumns): number {
  const rowStride = Math.max(1, Math.round(STEP_DURATION / medianStepOf(t)));
  const velocityAt = (i: number, sampleColumn: Float64Array) => (sampleColumn[i + rowStride] - sampleColumn[i]) / (t[i + rowStride] - t[i]);
  const velocityChangeAt = (i: number, sampleColumn: Float64Array) => velocityAt(i + rowStride, sampleColumn) - velocityAt(i, sampleColumn);
  const accelerationAt = (i: number) => (logKind === 'poses' ? (2 * Math.hypot(velocityChangeAt(i, a), velocityChangeAt(i, b))) / (t[i + 2 * rowStride] - t[i]) : Math.abs(velocityAt(i, a)));
  return quantileOf(sampleEvenly(t.length - 2 * rowStride, accelerationAt), 0.99);
}

function scaleColumn(sampleColumn: Float64Array, scaleFactor: number): void {
  for (let i = 0; i < sampleColumn.length; i++) sampleColumn[i] *= scaleFactor;
}

/** Divides all times by a factor. The start of the log remains a whole second. */
function convertTimes(sampleColumns: SampleColumns, scaleFactor: number): void {
  if (scaleFactor === 1) return;
  const { startTime, t } = sampleColumns;
  sampleColumns.startTime = Math.floor((startTime + t[0]) / scaleFactor);
  for (let i = 0; i < t.length; i++) t[i] = (startTime + t[i]) / scaleFactor - sampleColumns.startTime;
}
