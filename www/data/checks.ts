/** Checks of values from the page. Error messages have the same form as those of the Rust core. */

export function createRefusalError(fieldName: string, checkedValue: unknown, allowedText: string, ErrorClass = RangeError): TypeError | RangeError {
  return new ErrorClass(`${fieldName} is ${describeValue(checkedValue)}; allowed is ${allowedText}`);
}

/** Returns the given error. If its message starts with `coreFieldPath`, which is the core's name of a field, `newName` replaces that name. */
export function renameErrorField(error: unknown, newName: string, coreFieldPath: string = newName) {
  if (error instanceof Error && error.message.startsWith(coreFieldPath)) error.message = newName + error.message.slice(coreFieldPath.length);
  return error;
}

function describeValue(checkedValue: unknown) {
  if (typeof checkedValue === 'string') return JSON.stringify(shortenText(checkedValue));
  if (typeof checkedValue === 'object' && checkedValue !== null) return Array.isArray(checkedValue) ? 'an array' : 'an object';
  return ['function', 'symbol', 'bigint'].includes(typeof checkedValue) ? `a ${typeof checkedValue}` : String(checkedValue);
}

/** Returns the first 40 characters of a text, without splitting a surrogate pair. */
const shortenText = (longText: string) => longText.replace(/^(.{40}).+$/su, '$1…');

export function checkObject(fieldName: string, checkedValue: unknown, allowedKeys: readonly string[]) {
  if (typeof checkedValue !== 'object' || checkedValue === null || Array.isArray(checkedValue)) {
    throw createRefusalError(fieldName, checkedValue, `an object with keys from ${allowedKeys.join(', ')}`, TypeError);
  }
  const unknownKey = Object.keys(checkedValue).find((objectKey) => !allowedKeys.includes(objectKey));
  if (unknownKey !== undefined) {
    throw new TypeError(`${fieldName}.${shortenText(unknownKey)} is an unknown key; allowed are ${allowedKeys.join(', ')}`);
  }
  return checkedValue as Record<string, unknown>;
}

export function checkWord<Word extends string>(fieldName: string, checkedValue: unknown, allowedWords: readonly Word[]) {
  const matchingWord = allowedWords.find((allowedWord) => allowedWord === checkedValue);
  if (matchingWord !== undefined) return matchingWord;
  const ErrorClass = typeof checkedValue === 'string' ? RangeError : TypeError;
  throw createRefusalError(fieldName, checkedValue, allowedWords.map((allowedWord) => JSON.stringify(allowedWord)).join(' or '), ErrorClass);
}

export function checkNumber(fieldName: string, checkedValue: unknown, minValue: number, maxValue: number, isWhole = false) {
  const allowedText = `${isWhole ? 'a whole number from ' : ''}${minValue} to ${maxValue}`;
  if (typeof checkedValue !== 'number') throw createRefusalError(fieldName, checkedValue, allowedText, TypeError);
  if (!(checkedValue >= minValue && checkedValue <= maxValue) || (isWhole && !Number.isInteger(checkedValue))) throw createRefusalError(fieldName, checkedValue, allowedText);
  return checkedValue;
}

/** Checks that an array contains only allowed names. Returns these names in the order of `allowedWords`. */
function checkSubset(fieldName: string, checkedValue: unknown, allowedWords: readonly string[]): string[] {
  if (!Array.isArray(checkedValue)) throw createRefusalError(fieldName, checkedValue, `an array of ${allowedWords.join(', ')}`, TypeError);
  const checkedNames = checkedValue.map((checkedWord, i) => checkWord(`${fieldName}[${i}]`, checkedWord, allowedWords));
  return allowedWords.filter((allowedWord) => checkedNames.includes(allowedWord));
}

/** Type and range of a field. `checkValue` accepts all values of a field without a type. */
export interface FieldRange {
  type?: 'number' | 'whole' | 'word' | 'words' | 'boolean';
  words?: readonly string[];
  min?: number;
  max?: number;
  nullable?: true;
}

/** Returns a value that has the type and range of a field; throws a TypeError or RangeError for any other value. */
export function checkValue(fieldName: string, checkedValue: unknown, { type: valueType, words: allowedWords = [], min: minValue = -Infinity, max: maxValue = Infinity, nullable }: FieldRange): unknown {
  if (valueType === undefined || (nullable && checkedValue === null)) return checkedValue;
  if (valueType === 'words') return checkSubset(fieldName, checkedValue, allowedWords);
  if (valueType === 'word') return checkWord(fieldName, checkedValue, allowedWords);
  if (valueType !== 'boolean') return checkNumber(fieldName, checkedValue, minValue, maxValue, valueType === 'whole');
  if (typeof checkedValue !== 'boolean') throw createRefusalError(fieldName, checkedValue, 'true or false', TypeError);
  return checkedValue;
}

/** Returns true if `wholeObject` has all fields of `requiredFields` with the same values. Objects are compared deeply. */
export function includesFields(wholeObject: any, requiredFields: any): boolean {
  if (Object.is(wholeObject, requiredFields)) return true;
  if (typeof wholeObject !== 'object' || typeof requiredFields !== 'object' || !wholeObject || !requiredFields || wholeObject.length !== requiredFields.length) return false;
  return Object.keys(requiredFields).every((objectKey) => Object.hasOwn(wholeObject, objectKey) && includesFields(wholeObject[objectKey], requiredFields[objectKey]));
}
