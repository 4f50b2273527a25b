/** Numbers, and their texts in the current language: a true minus sign, thin spaces between thousands, and a dash for NaN. */

import { ticks } from 'd3-array';
import { language } from '../messages/registry.ts';

export const MINUS_SIGN = '\u2212';
const THIN_SPACE = '\u202f';
export const NO_VALUE = '\u2014';

const decimalSeparators: Map<string, string> = new Map([['en', '.']]);

/** Returns the decimal separator of the current language. It is cached, and fixed for English, because the first use of `Intl` delays a figure's first picture. */
function getDecimalSeparator(): string {
  // The decimal separator is the second character of "0.5" or "0,5".
  if (!decimalSeparators.has(language)) decimalSeparators.set(language, (0.5).toLocaleString(language, { numberingSystem: 'latn' })[1]);
  return decimalSeparators.get(language) as string;
}

/** Prints a number with decimals: "−0.301"; "0.000" rather than "−0.000"; "∞"; "—" for NaN. */
export function formatFixed(number: number, decimals: number): string {
  if (Number.isNaN(number)) return NO_VALUE;
  // `toFixed` rounds the exact binary number. `Intl` rounds the number's shortest decimal form, and may therefore round up a number that is below a tie.
  const digits = Math.abs(number).toFixed(decimals);
  const sign = number < 0 && Number(digits) !== 0 ? MINUS_SIGN : '';
  return sign + (Number.isFinite(number) ? digits.replace('.', getDecimalSeparator()) : '∞');
}

/** Maximum number of decimals of an editable value beyond the usual number. */
const MAX_EXTRA_DECIMALS = 2;

/**
 * Prints a value as it was typed: with up to two more decimals than usual, if they print it exactly. With 3 decimals 0.0525 is "0.0525",
 * but 0.05210987 is "0.052".
 */
export function formatEditable(number: number, decimals: number): string {
  const typedDecimalCount = String(number).split('.')[1]?.length ?? 0;
  return formatFixed(number, typedDecimalCount > decimals && typedDecimalCount <= decimals + MAX_EXTRA_DECIMALS ? typedDecimalCount : decimals);
}

/** Magnitude below which a number counts as a rounded 0. */
const MAX_ROUNDED_ZERO = 1e-13;

/** Maximum number of decimals of a standard error. The smallest one, 0.0008 with ten million robots, needs four. */
const MAX_ERROR_DECIMALS = 5;

const SUPERSCRIPT_DIGITS = '⁰¹²³⁴⁵⁶⁷⁸⁹';

/** Prints a number with significant digits: "0.0070020"; below 0.0001 and from 100,000 on "1.2500·10⁻⁵". */
export function formatSignificant(number: number, significantDigits: number): string {
  if (Math.abs(number) < MAX_ROUNDED_ZERO) return '0';
  if (!Number.isFinite(number)) return formatFixed(number, 0);
  const [mantissa, exponent] = number.toExponential(significantDigits - 1).split('e').map(Number);
  if (exponent < -4 || exponent >= 5) return `${formatFixed(mantissa, significantDigits - 1)}·${formatPowerOfTen(exponent)}`;
  return formatFixed(Number(number.toPrecision(significantDigits)), Math.max(0, significantDigits - 1 - exponent));
}

/** Prints a power of ten: "10⁻⁵". */
export function formatPowerOfTen(exponent: number): string {
  return `10${String(exponent).replace('-', '⁻').replace(/\d/g, (decimalDigit) => SUPERSCRIPT_DIGITS[Number(decimalDigit)])}`;
}

/** Prints a number from 0 on, rounded to significant digits: "0.47", "12", "1 200". */
export function formatRounded(number: number, significantDigits: number): string {
  if (number < MAX_ROUNDED_ZERO) return '0';
  const roundedValue = Number(number.toPrecision(significantDigits));
  const decimals = significantDigits - 1 - Math.floor(Math.log10(roundedValue));
  return decimals > 0 ? formatFixed(roundedValue, decimals) : formatInteger(roundedValue);
}

/** Prints a count: "100 000". */
export const formatInteger = (count: number): string => formatFixed(count, 0).replace(/\B(?=(\d{3})+$)/g, THIN_SPACE);

/** Prints a fraction from 0 to 1 in percent: "86.5 %". */
export function formatPercent(proportion: number, decimals: number = 1): string {
  return Number.isNaN(proportion) ? NO_VALUE : `${formatFixed(100 * proportion, decimals)}${THIN_SPACE}%`;
}

/** Prints a value with its standard error: "−0.412 ± 0.031". Infinity and NaN are printed without an error. Decimals are added until the error shows its first digit. */
export function formatWithError(number: number, standardError: number, decimals: number): string {
  if (!Number.isFinite(number)) return formatFixed(number, 0);
  const neededDecimals = standardError > 0 ? Math.max(decimals, Math.min(MAX_ERROR_DECIMALS, -Math.floor(Math.log10(standardError)))) : decimals;
  return `${formatFixed(number, neededDecimals)} ± ${formatFixed(standardError, neededDecimals)}`;
}

/** Tick step below which the labels of an axis are multiples of a power of ten. Labels with more zeros would not fit next to the axis. */
const MIN_PLAIN_STEP = 9e-4;

/** Returns the ticks of an axis: about `wantedTickCount` values, at least two if possible. If the labels are multiples of a power of ten, the name of the axis contains this factor. */
export function ticksOfAxis(axisName: string, minValue: number, maxValue: number, wantedTickCount: number) {
  const tickCount = Math.max(2, Math.floor(wantedTickCount));
  const candidateTicks = ticks(minValue, maxValue, tickCount);
  const tickValues = candidateTicks.length > 1 ? candidateTicks : ticks(minValue, maxValue, 2 * tickCount);
  const tickStep = tickValues.length > 1 ? tickValues[1] - tickValues[0] : 1;
  const stepExponent = Math.floor(Math.log10(tickStep) + 1e-9);
  const exponent = tickStep < MIN_PLAIN_STEP ? stepExponent : 0;
  return {
    tickValues,
    axisName: exponent < 0 ? axisName.replace(/\(|$/, (bracket) => (bracket ? `(${formatPowerOfTen(exponent)} ` : ` (${formatPowerOfTen(exponent)})`)) : axisName,
    formatLabel: (tickValue: number) => formatFixed(tickValue / 10 ** exponent, Math.max(0, exponent - stepExponent)),
  };
}

/** Returns the value, or the nearer limit if the value is not between `min` and `max`. */
export function clampNumber(number: number, lowerLimit: number, upperLimit: number) {
  return Math.min(upperLimit, Math.max(lowerLimit, number));
}
