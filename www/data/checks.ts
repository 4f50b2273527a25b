/** Checks of values from the page. Error messages have the same form as those of the Rust core. */

export function createRefusalError(field: string, value: unknown, allowed: string, ErrorClass = RangeError): TypeError | RangeError {
  return new ErrorClass(`${field} is ${describeValue(value)}; allowed is ${allowed}`);
}

/** Returns the error. If its message starts with `corePath`, the core's name of a field, the message gets `newName` instead. */
export function withFieldRenamed(error: unknown, newName: string, corePath: string = newName) {
  if (error instanceof Error && error.message.startsWith(corePath)) error.message = newName + error.message.slice(corePath.length);
  return error;
}

function describeValue(value: unknown) {
  if (typeof value === 'string') return JSON.stringify(shortenText(value));
  if (typeof value === 'object' && value !== null) return Array.isArray(value) ? 'an array' : 'an object';
  return ['function', 'symbol', 'bigint'].includes(typeof value) ? `a ${typeof value}` : String(value);
}

/** Returns the first 40 characters of a text, without splitting a surrogate pair. */
const shortenText = (text: string) => text.replace(/^(.{40}).+$/su, '$1…');

export function checkObject(field: string, value: unknown, keys: readonly string[]) {
  if (typeof value !== 'object' || value === null || Array.isArray(value)) {
    throw createRefusalError(field, value, `an object with keys from ${keys.join(', ')}`, TypeError);
  }
  const unknownKey = Object.keys(value).find((key) => !keys.includes(key));
  if (unknownKey !== undefined) {
    throw new TypeError(`${field}.${shortenText(unknownKey)} is an unknown key; allowed are ${keys.join(', ')}`);
  }
  return value as Record<string, unknown>;
}

export function checkWord<Word extends string>(field: string, value: unknown, allowed: readonly Word[]) {
  const matchingWord = allowed.find((word) => word === value);
  if (matchingWord !== undefined) return matchingWord;
  const ErrorClass = typeof value === 'string' ? RangeError : TypeError;
  throw createRefusalError(field, value, allowed.map((word) => JSON.stringify(word)).join(' or '), ErrorClass);
}

export function checkNumber(field: string, value: unknown, min: number, max: number, isWhole = false) {
  const allowed = `${isWhole ? 'a whole number from ' : ''}${min} to ${max}`;
  if (typeof value !== 'number') throw createRefusalError(field, value, allowed, TypeError);
  if (!(value >= min && value <= max) || (isWhole && !Number.isInteger(value))) throw createRefusalError(field, value, allowed);
  return value;
}

/** Checks that an array contains only allowed names. Returns these names in the order of `allowed`. */
function checkSubset(field: string, value: unknown, allowed: readonly string[]): string[] {
  if (!Array.isArray(value)) throw createRefusalError(field, value, `an array of ${allowed.join(', ')}`, TypeError);
  const checkedNames = value.map((name, i) => checkWord(`${field}[${i}]`, name, allowed));
  return allowed.filter((name) => checkedNames.includes(name));
}

/** Type and range of a field. `checkValue` accepts all values of a field without a type. */
export interface FieldRange {
  type?: 'number' | 'whole' | 'word' | 'words' | 'boolean';
  words?: readonly string[];
  min?: number;
  max?: number;
  nullable?: true;
}

/** Returns a value after a check; throws a TypeError or RangeError if it is out of range. */
export function checkValue(field: string, value: unknown, { type, words = [], min = -Infinity, max = Infinity, nullable }: FieldRange): unknown {
  if (type === undefined || (nullable && value === null)) return value;
  if (type === 'words') return checkSubset(field, value, words);
  if (type === 'word') return checkWord(field, value, words);
  if (type !== 'boolean') return checkNumber(field, value, min, max, type === 'whole');
  if (typeof value !== 'boolean') throw createRefusalError(field, value, 'true or false', TypeError);
  return value;
}

/** Returns true if `object` has all fields of `subset` with the same values. Objects are compared deeply. */
export function includesFields(object: any, subset: any): boolean {
  if (Object.is(object, subset)) return true;
  if (typeof object !== 'object' || typeof subset !== 'object' || !object || !subset || object.length !== subset.length) return false;
  return Object.keys(subset).every((key) => Object.hasOwn(object, key) && includesFields(object[key], subset[key]));
}
