/** Numbers in the current language: a true minus sign, thin spaces between thousands, and a dash for NaN. */

import { language } from '../messages/registry.ts';

const MINUS = '\u2212';
const THIN_SPACE = '\u202f';
export const NOTHING = '\u2014';

/** Cache of formatters by language and options: creating one takes longer than a frame. */
const formats: Map<string, Intl.NumberFormat> = new Map();

function print(value: number, options: Intl.NumberFormatOptions) {
  if (Number.isNaN(value)) return NOTHING;
  const key = language + Object.entries(options);
  let format = formats.get(key);
  if (!format) formats.set(key, (format = new Intl.NumberFormat(language, { signDisplay: 'negative', ...options })));
  return format
    .formatToParts(value)
    .map((part) => (part.type === 'minusSign' ? MINUS : part.type === 'group' ? THIN_SPACE : part.value))
    .join('');
}

/** Prints a number with decimals: "−0.301"; "0.000" rather than "−0.000"; "—" for NaN. */
export function fixed(value: number, decimals: number): string {
  // Rounds the binary number. The formatter would round the shortest decimals, and find ties that are none.
  const digits = value.toFixed(decimals);
  const rounded = Number(digits);
  // English needs no formatter, which would take longer to create than the rest of the first frame.
  if (language === 'en' && Math.abs(rounded) < 1e21) return rounded < 0 ? MINUS + digits.slice(1) : digits.replace('-', '');
  return print(rounded, { minimumFractionDigits: decimals, maximumFractionDigits: decimals, useGrouping: false });
}

/** Maximum number of additional decimals of a short number. */
const FEW_MORE = 2;

/**
 * Prints a value as it was typed: with up to two more decimals than usual, if it has no further ones. With 3 decimals 0.0525 is "0.0525",
 * and 0.05210987 is "0.052".
 */
export function typed(value: number, decimals: number): string {
  const all = String(value).split('.')[1]?.length ?? 0;
  return fixed(value, all > decimals && all <= decimals + FEW_MORE ? all : decimals);
}

/**
 * Parses a number in the present language, or with a decimal point: "−0,301", "1.5 m/s", "2 000", "2,000"; NaN where it is none. In English
 * a comma may separate groups of three; elsewhere a point may, if a whole number is meant.
 */
export function numberIn(text: string, unit: string = '', whole: boolean = false): number {
  const plain = text.replace(/\s/g, '').replace(MINUS, '-');
  const bare = unit && plain.endsWith(unit) ? plain.slice(0, -unit.length) : plain;
  const [, decimal] = fixed(0.5, 1);
  // In English, commas separate complete groups of three digits. Where the comma is the decimal separator, points may.
  const groups = decimal === '.' ? /^-?[1-9]\d{0,2}(,\d{3})+$/ : whole && /^-?[1-9]\d{0,2}(\.\d{3})+$/;
  const ungrouped = groups && groups.test(bare) ? bare.replace(/[,.]/g, '') : bare;
  return bare === '' ? NaN : Number(ungrouped.replace(decimal, '.'));
}

/** Prints a limit: "1 000 000"; "1·10⁻⁶". */
export function limit(value: number): string {
  return Number.isInteger(value) ? counted(value) : significant(value, 1);
}

/** Magnitude below which a number counts as 0 that is rounded. */
const NOTHING_BELOW = 1e-13;

/** Maximum number of decimals of a standard error: ten million robots have one of 0.0008. */
const MAX_DECIMALS = 5;

const SUPERSCRIPTS = '⁰¹²³⁴⁵⁶⁷⁸⁹';

/** Prints a number with significant digits: "0.0070020"; from 0.0001 downwards "1.2500·10⁻⁵". */
export function significant(value: number, digits: number): string {
  const size = Math.abs(value);
  if (size < NOTHING_BELOW) return '0';
  const options = { minimumSignificantDigits: digits, maximumSignificantDigits: digits, useGrouping: false };
  if (!Number.isFinite(size) || (size >= 1e-4 && size < 1e5)) return print(value, options);
  const [mantissa, exponent] = value.toExponential(digits - 1).split('e');
  return `${print(Number(mantissa), options)}·${powerOfTen(Number(exponent))}`;
}

/** Prints a power of ten: "10⁻⁵". */
export function powerOfTen(exponent: number): string {
  return `10${String(exponent).replace('-', '⁻').replace(/\d/g, (digit) => SUPERSCRIPTS[Number(digit)])}`;
}

/** Prints a positive number rounded to significant digits: "0.47", "12", "1 200". */
export function rounded(value: number, digits: number): string {
  const near = Number(value.toPrecision(digits));
  const decimals = digits - 1 - Math.floor(Math.log10(near));
  return decimals > 0 ? fixed(near, decimals) : counted(near);
}

/** Prints a count: "100 000". */
export function counted(count: number): string {
  if (language === 'en' && Math.abs(count) < 1e21) return fixed(count, 0).replace(/\B(?=(\d{3})+$)/g, THIN_SPACE);
  return print(count, { maximumFractionDigits: 0, useGrouping: true });
}

/** Prints a share from 0 to 1 in percent: "86.5 %". */
export function percent(share: number): string {
  return Number.isNaN(share) ? NOTHING : `${fixed(100 * share, 1)}${THIN_SPACE}%`;
}

/** Prints a value with its standard error: "−0.412 ± 0.031"; "∞" and "—" have none. A small error has as many decimals as show its first digit. */
export function withError(value: number, error: number, decimals: number): string {
  if (!Number.isFinite(value)) return fixed(value, 0);
  const needed = error > 0 ? Math.max(decimals, Math.min(MAX_DECIMALS, -Math.floor(Math.log10(error)))) : decimals;
  return `${fixed(value, needed)} ± ${fixed(error, needed)}`;
}

/** Prints the label of an axis tick, with as many decimals as the step between ticks needs. */
export function tick(value: number, step: number) {
  return fixed(value, Math.max(0, -Math.floor(Math.log10(step) + 1e-9)));
}
