/** Parsers of numbers and dates in text. */

/** Pattern of texts for a missing or infinite number. */
const NOT_FINITE_WORDS = /^(?:[+-]?(?:nan|inf(?:inity)?)|null|none|nat|na|n\/a|-)?$/i;

const ISO_DATE = /^\s*(\d{4})[-/](\d{1,2})[-/](\d{1,2})(?:[T\s]+(\d{1,2}):(\d{2})(?::(\d{2})(?:[.,](\d+))?)?\s*(Z|UTC|GMT|[+-]\d{2}(?::?\d{2})?)?)?\s*$/i;

/** Duration as printed by pandas ("0 days 00:00:01.5") and MATLAB ("00:00:01.5"). */
const DURATION_TEXT = /^\s*(?:(\d+) days? )?\+?(\d+):(\d{2}):(\d{2})(?:[.,](\d+))?\s*$/;

/** Parses a number. Returns NaN for an empty cell or a word such as "nan", and undefined for any other text. */
export function parseNumber(cell: string): number | undefined {
  const parsedValue = Number(cell);
  // `Number` parses an empty cell as 0, and hexadecimal digits. `parseFloat` returns other numbers for both.
  if (parsedValue === parsedValue && (Math.trunc(parsedValue) !== parsedValue || parsedValue === parseFloat(cell))) return parsedValue;
  return NOT_FINITE_WORDS.test(cell.trim()) ? NaN : undefined;
}

/** Parses a time in units of 10^−power s. Returns seconds, or NaN or undefined as `parseNumber`. */
export function parseTime(cell: string, power: number): number | undefined {
  const parsedValue = parseNumber(cell);
  if (power === 0 || parsedValue === undefined || !Number.isFinite(parsedValue)) return parsedValue;
  // Nanoseconds since 1970 are no double. With the exponent in the text, they are rounded only once.
  const [digits, exponent = '0'] = cell.trim().toLowerCase().split('e');
  return Number(`${digits}e${Number(exponent) - power}`);
}

/** Parses an ISO 8601 date or a duration, in seconds; undefined for any other text. A date without a time zone is in UTC. */
export function parseDate(cell: string): number | undefined {
  const dateMatch = ISO_DATE.exec(cell);
  if (dateMatch) {
    const [, year, month, day, hour = '0', minute = '0', second = '0', fraction = '', zone] = dateMatch;
    const [sign, hours, minutes] = /^([+-])(\d{2}):?(\d{2})?$/.exec(zone ?? '')?.slice(1) ?? ['+', '0', '0'];
    const zoneOffset = (sign === '-' ? -60 : 60) * (60 * Number(hours) + Number(minutes ?? 0));
    const seconds = Date.UTC(Number(year), Number(month) - 1, Number(day), Number(hour), Number(minute), Number(second)) / 1000 - zoneOffset;
    return seconds + Number(`.${fraction}0`);
  }
  const durationMatch = DURATION_TEXT.exec(cell);
  if (!durationMatch) return undefined;
  const [days = '0', hours, minutes, seconds, fraction = ''] = durationMatch.slice(1);
  return ((Number(days) * 24 + Number(hours)) * 60 + Number(minutes)) * 60 + Number(seconds) + Number(`.${fraction}0`);
}
