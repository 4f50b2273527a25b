/** Units of a log, judged by two kinds of evidence. If they disagree, the log is refused with a question. */

import { LogError, type ErrorPlace } from './log-error.ts';
import { UNITS, type AngleUnit, type LogKind, type OpenOptions, type Question, type Summary, type TimeUnit } from './log.ts';
import { quantile, sampleEvenly } from './quantile.ts';

export type Units = Summary['units'];

/** Columns of a log, in the units of the file. */
export interface Columns {
  /** Seconds that were subtracted from all times. */
  start: number;
  t: Float64Array;
  /** x, or v. */
  a: Float64Array;
  /** y, or omega. */
  b: Float64Array;
  /** Heading, or 0. */
  c: Float64Array;
}

/** Decimal exponent of the number of units in a second, by unit of time. */
export const UNIT_EXPONENTS = { s: 0, ms: 3, us: 6, ns: 9 } as const;

/** Sizes of the units of length in m, and of the units of angle in rad. */
const METRES_PER_UNIT = { m: 1, cm: 0.01, mm: 0.001 } as const;
const RADIANS_PER_UNIT = { rad: 1, deg: Math.PI / 180 } as const;

/** Minimum value of times since 1970, by unit. 1e8 s is the year 1973, and 1e11 s the year 5138. */
const MIN_EPOCH_TIMES = [['ns', 1e17], ['us', 1e14], ['ms', 1e11], ['s', 1e8]] as const;

/** Minimum number of rows of a log whose units are judged. */
const MIN_ROWS = 10;

/** Allowed ranges of the rate of a log, Hz, with and without a stated unit of its times. */
const [STATED_RATES, USUAL_RATES] = [[0.05, 5000], [0.2, 2000]] as const;

/** Minimum and maximum speed of robots in m/s or rad/s, with a margin for rounded times. */
const [MIN_SPEED, MAX_SPEED] = [0.005, 20.5];

/** Speed (m/s) above which the acceleration is also judged, and maximum acceleration (m/s²): that of gravity, which tyres can transmit. */
const [MIN_JUDGED_SPEED, MAX_ACCELERATION] = [3, 9.8];

/** Duration (s) of the steps whose speed is judged. In shorter steps noise would look like a high speed. */
const STEP_DURATION = 0.5;

/** Minimum length (m) of a step with a direction. */
const MIN_STEP_LENGTH = 0.02;

/** Minimum number of steps with a direction. */
const MIN_STEPS = 20;

/** Range of the difference of successive headings in degrees where they wrap around. */
const WRAP_STEP_RANGE = [330, 390] as const;

const isInRange = (value: number, [low, high]: readonly [number, number]) => value >= low && value <= high;

/** Returns the unit of a time since 1970 by its size; undefined for smaller times. */
export const epochTimeUnitOf = (time: number): TimeUnit | undefined => MIN_EPOCH_TIMES.find(([, minTime]) => Math.abs(time) >= minTime)?.[0];

/**
 * Judges the units, and converts the columns to s, m and rad.
 *
 * @param assumed units of the columns by names, the size of the times, the format or usage
 * @param options units that the user stated, which are not judged
 * @throws {LogError} with a question, if the evidence is contradictory
 */
export function judgeUnits(place: ErrorPlace, kind: LogKind, columns: Columns, assumed: Units, options: OpenOptions): Units {
  const isJudged = columns.t.length >= MIN_ROWS;
  const askUnit = (what: 'timeUnit' | 'lengthUnit' | 'angleUnit', value: number, unit: string, choices: string[]): never => {
    throw new LogError(place, (say) => say[what](value, unit, choices), choices.length > 0 ? { what, choices, doubted: unit } satisfies Question : undefined);
  };
  const judgedTime = isJudged ? judgeTimeUnit(kind, columns, assumed, options, askUnit) : assumed.time;
  convertTimes(columns, 10 ** (UNIT_EXPONENTS[judgedTime.unit] - UNIT_EXPONENTS[assumed.time.unit]));

  let { length, angle } = assumed;
  if (options.lengthUnit) length = { unit: options.lengthUnit, by: 'option' };
  else if (isJudged) checkLength(kind, columns, length, askUnit);
  const metresPerUnit = METRES_PER_UNIT[length.unit];
  if (metresPerUnit !== 1) for (const column of kind === 'poses' ? [columns.a, columns.b] : [columns.a]) scaleColumn(column, metresPerUnit);

  if (angle.unit === 'quaternion' || angle.unit === 'none') return { time: judgedTime, length, angle };
  if (options.angleUnit) angle = { unit: options.angleUnit, by: 'option' };
  else if (isJudged) angle = judgeAngleUnit(kind, columns, angle, askUnit);
  if (angle.unit === 'deg') scaleColumn(kind === 'poses' ? columns.c : columns.b, RADIANS_PER_UNIT.deg);
  return { time: judgedTime, length, angle };
}

type Ask = (what: 'timeUnit' | 'lengthUnit' | 'angleUnit', value: number, unit: string, choices: string[]) => never;

/** Judges times by their size or name, and by the rate and the speed that they imply. */
function judgeTimeUnit(kind: LogKind, { t, a, b, c }: Columns, { time: assumed, length, angle }: Units, options: OpenOptions, ask: Ask): Units['time'] {
  if (['format', 'date', 'option'].includes(assumed.by)) return assumed;
  const medianStep = quantile(sampleEvenly(t.length - 1, (i) => t[i + 1] - t[i]), 0.5);
  const units = UNITS.timeUnit;
  const rateWithUnit = (unit: TimeUnit) => 10 ** (UNIT_EXPONENTS[unit] - UNIT_EXPONENTS[assumed.unit]) / medianStep;
  if (assumed.by !== 'usage') {
    if (isInRange(rateWithUnit(assumed.unit), STATED_RATES)) return assumed;
    // Times that look like seconds since 1970 may also be nanoseconds since the start of a simulation.
    if (assumed.by === 'name' || assumed.unit !== 's') return ask('timeUnit', rateWithUnit(assumed.unit), assumed.unit, units.filter((unit) => isInRange(rateWithUnit(unit), STATED_RATES)));
  }
  // Turn rates only count if the unit of the headings is stated.
  const radiansPerUnit = RADIANS_PER_UNIT[options.angleUnit ?? (angle.unit === 'deg' ? 'deg' : 'rad')];
  const countsTurns = options.angleUnit !== undefined || angle.by !== 'usage';
  const raw = kind === 'poses' ? speedOf(t, a, b, medianStep) : 0;
  const [speed, turnRate] = [raw * METRES_PER_UNIT[options.lengthUnit ?? length.unit], kind === 'poses' && countsTurns ? turnRateOf(t, c) * radiansPerUnit : 0];
  const isMoving = speed > 0 || turnRate > 0;
  /** Checks that the rate and the speed of the robot are plausible with a unit. */
  const isPlausibleUnit = (unit: TimeUnit) => {
    const speedsWithUnit = [speed, turnRate].map((rawSpeed) => rawSpeed * rateWithUnit(unit) * medianStep);
    return isInRange(rateWithUnit(unit), USUAL_RATES) && (!isMoving || (speedsWithUnit.every((speedWithUnit) => speedWithUnit <= MAX_SPEED) && [...speedsWithUnit, raw * rateWithUnit(unit) * medianStep].some((speedWithUnit) => speedWithUnit >= MIN_SPEED)));
  };
  if (isPlausibleUnit(assumed.unit)) return assumed;
  const [unit, ...otherUnits] = units.filter(isPlausibleUnit);
  if (unit && otherUnits.length === 0 && isMoving) return { unit, by: 'rate' };
  // A robot that is too fast may have its lengths or headings in another unit.
  if (isInRange(rateWithUnit(assumed.unit), USUAL_RATES) && Math.max(speed, turnRate) > MAX_SPEED) return assumed;
  return ask('timeUnit', rateWithUnit(assumed.unit), assumed.unit, units.filter((unit) => isInRange(rateWithUnit(unit), USUAL_RATES)));
}

/** Checks the unit of lengths by the speed and the acceleration of the robot, and by its turns: a fast robot does not turn on the spot. */
function checkLength(kind: LogKind, { t, a, b, c }: Columns, { unit, by }: Units['length'], ask: Ask): void {
  const step = quantile(sampleEvenly(t.length - 1, (i) => t[i + 1] - t[i]), 0.5);
  const speed = kind === 'poses' ? speedOf(t, a, b, step) : quantile(sampleEvenly(a.length, (i) => Math.abs(a[i])), 0.9);
  const speedInMetres = speed * METRES_PER_UNIT[unit];
  const movesImplausibly = speedInMetres > MIN_JUDGED_SPEED && (accelerationOf(kind, t, a, b, step) * METRES_PER_UNIT[unit] > MAX_ACCELERATION || (kind === 'poses' && by === 'usage' && turnsOnSpot(t, a, b, c, step, speed)));
  const plausibleUnits = UNITS.lengthUnit.filter((unit) => isInRange(speed * METRES_PER_UNIT[unit], [MIN_SPEED, MAX_SPEED]));
  // A unit in a name is doubted if the robot would be too slow with it, but would have a usual speed in metres.
  if (speedInMetres > MAX_SPEED || movesImplausibly || (by === 'name' && unit !== 'm' && speedInMetres < MIN_SPEED && speed > 0.1 && plausibleUnits.includes('m'))) {
    ask('lengthUnit', speedInMetres, unit, plausibleUnits.includes(unit) ? plausibleUnits : [...plausibleUnits, unit]);
  }
}

/** Judges headings and turn rates by their name and size, by the turn rate, and by the direction of the path. */
function judgeAngleUnit(kind: LogKind, { t, a, b, c }: Columns, assumed: Units['angle'], ask: Ask): Units['angle'] {
  const choices = [...UNITS.angleUnit];
  if (kind === 'commands') {
    const turnRate = quantile(sampleEvenly(b.length, (i) => Math.abs(b[i])), 0.9) * RADIANS_PER_UNIT[assumed.unit as AngleUnit];
    return turnRate > MAX_SPEED ? ask('angleUnit', turnRate, assumed.unit, choices) : assumed;
  }
  const unitByPath = unitOfPath(t, a, b, c);
  const turnRate = turnRateOf(t, c);
  if (assumed.by !== 'usage') {
    const isDoubted = unitByPath !== undefined && unitByPath !== assumed.unit && (assumed.unit === 'deg') !== turnRate > MAX_SPEED;
    return isDoubted ? ask('angleUnit', turnRate * RADIANS_PER_UNIT[assumed.unit as AngleUnit], assumed.unit, choices) : assumed;
  }
  let largestHeading = 0;
  let wrapCount = 0;
  for (let i = 0; i < c.length; i++) {
    if (Math.abs(c[i]) > largestHeading) largestHeading = Math.abs(c[i]);
    const step = Math.abs(c[i] - c[i - 1]);
    if (step >= WRAP_STEP_RANGE[0] && step <= WRAP_STEP_RANGE[1]) wrapCount += 1;
  }
  const degreeSigns = [unitByPath === 'deg', wrapCount > 0, turnRate > MAX_SPEED].filter(Boolean).length;
  // Headings beyond a full circle are no proof of degrees: those in radians may be unwrapped.
  const exceedsFullCircle = largestHeading > 2 * Math.PI + 0.1;
  if (unitByPath !== 'rad' && degreeSigns >= 2 && exceedsFullCircle) return { unit: 'deg', by: 'size' };
  if (unitByPath === 'rad' ? turnRate > MAX_SPEED && wrapCount > 0 : turnRate > MAX_SPEED || exceedsFullCircle) return ask('angleUnit', turnRate, assumed.unit, choices);
  return assumed;
}

/**
 * Returns the unit in which the heading differs by a constant angle from the direction of the path, or of its mirror image. Undefined if
 * both units fit (on a straight path), or neither (for a robot that drives sideways).
 */
function unitOfPath(t: Float64Array, x: Float64Array, y: Float64Array, heading: Float64Array): AngleUnit | undefined {
  const stride = Math.max(2, Math.ceil(STEP_DURATION / quantile(sampleEvenly(t.length - 1, (i) => t[i + 1] - t[i]), 0.5)));
  // If an axis is mirrored, the headings turn against the path.
  const candidates = UNITS.angleUnit.flatMap((unit) => [1, -1].map((sign) => ({ unit, factor: sign * RADIANS_PER_UNIT[unit], cosine: 0, sine: 0 })));
  let stepCount = 0;
  for (let i = 0; i + stride < t.length; i += stride) {
    const [dx, dy] = [x[i + stride] - x[i], y[i + stride] - y[i]];
    if (Math.hypot(dx, dy) < MIN_STEP_LENGTH) continue;
    stepCount += 1;
    for (const candidate of candidates) {
      const angle = 2 * (Math.atan2(dy, dx) - heading[i + (stride >> 1)] * candidate.factor);
      candidate.cosine += Math.cos(angle);
      candidate.sine += Math.sin(angle);
    }
  }
  if (stepCount < MIN_STEPS) return undefined;
  // The mean resultant length is 1 if all differences are equal, and near 0 if they are random.
  const [rad, deg] = UNITS.angleUnit.map((unit) => Math.max(...candidates.filter((candidate) => candidate.unit === unit).map(({ cosine, sine }) => Math.hypot(cosine, sine) / stepCount)));
  if (Math.max(rad, deg) < 0.8 || Math.abs(rad - deg) < 0.3) return undefined;
  return rad > deg ? 'rad' : 'deg';
}

/** Returns the 90 % quantile of the speeds of the steps. */
function speedOf(t: Float64Array, x: Float64Array, y: Float64Array, step: number): number {
  const stride = Math.min(Math.max(1, Math.round(STEP_DURATION / step)), t.length - 1);
  return quantile(sampleEvenly(t.length - stride, (i) => Math.hypot(x[i + stride] - x[i], y[i + stride] - y[i]) / (t[i + stride] - t[i])), 0.9);
}

/** Returns true if a robot makes at least a fifth of its large turns on the spot. `speed` is its usual speed in the units of the log. */
function turnsOnSpot(t: Float64Array, x: Float64Array, y: Float64Array, heading: Float64Array, step: number, speed: number): boolean {
  const stride = Math.min(Math.max(1, Math.round(STEP_DURATION / step)), t.length - 1);
  const turnOf = (i: number) => Math.abs(heading[i + stride] - heading[i]);
  const isOnSpot = (i: number) => Math.hypot(x[i + stride] - x[i], y[i + stride] - y[i]) < 0.1 * speed * (t[i + stride] - t[i]);
  const largeTurn = quantile(sampleEvenly(t.length - stride, turnOf), 0.95);
  // Smaller turns may be noise.
  const largeTurns = sampleEvenly(t.length - stride, (i) => i).filter((i) => turnOf(i) > 0.5 * largeTurn);
  return largeTurns.filter(isOnSpot).length > 0.2 * largeTurns.length;
}

/** Returns the 90 % quantile of the accelerations between successive steps. */
function accelerationOf(kind: LogKind, t: Float64Array, a: Float64Array, b: Float64Array, step: number): number {
  const stride = Math.min(Math.max(1, Math.round(STEP_DURATION / step)), Math.max(1, (t.length - 1) >> 1));
  if (kind === 'commands') return quantile(sampleEvenly(t.length - stride, (i) => Math.abs(a[i + stride] - a[i]) / (t[i + stride] - t[i])), 0.9);
  const speedAt = (p: Float64Array, i: number) => (p[i + stride] - p[i]) / (t[i + stride] - t[i]);
  const speedChange = (p: Float64Array, i: number) => speedAt(p, i + stride) - speedAt(p, i);
  return quantile(sampleEvenly(t.length - 2 * stride, (i) => Math.hypot(speedChange(a, i), speedChange(b, i)) / (t[i + stride] - t[i])), 0.9);
}

/** Returns the 90 % quantile of the turn rates of the steps. */
const turnRateOf = (t: Float64Array, heading: Float64Array) =>
  quantile(sampleEvenly(t.length - 1, (i) => Math.abs(heading[i + 1] - heading[i]) / (t[i + 1] - t[i])), 0.9);

function scaleColumn(column: Float64Array, factor: number): void {
  for (let i = 0; i < column.length; i++) column[i] *= factor;
}

/** Divides all times by a factor. Their start remains a whole second. */
function convertTimes(columns: Columns, factor: number): void {
  if (factor === 1) return;
  const { start, t } = columns;
  columns.start = Math.floor((start + t[0]) / factor);
  for (let i = 0; i < t.length; i++) t[i] = (start + t[i]) / factor - columns.start;
}
