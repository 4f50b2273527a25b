/** Seeded mutations of valid inputs. */

import { Buffer } from 'node:buffer';

/** Tokens with a meaning in one of the parsed formats. */
const INSERTED_TOKENS = [
  ...['\0', '\n', '\r\n', '\t', ' ', '"', "'", '#', ',', ':', ': ', '- ', '? ', '|\n', '>', '[', ']', '{', '}', '&a ', '*a', '<<: ', '---\n', '...', '%', '\\', '/'],
  ...['-', '0', '-0', '1e999', '-1', '0x10', '.nan', '.inf', 'NaN', 'null', 'true', '16777216', '65536', '4294967295', '99999999999999999999'],
  ...['__proto__', 'constructor', 'toString', 'image', 'resolution', 'origin', 'negate', 'mode', 'bounds', 'walls', 'map', '!!js/function ', '!!binary '],
  ...['<script>alert(1)</script>', '"><img src=x onerror=alert(1)>', ']]>', '&lt;', '\u202e', '\ufeff', '\u2028', '\u{1f916}', 'é'],
  ...['yaw', 't_ns', 'stamp', 'qw', 'v', ';', '1e17', '1700000000.123456789', 'zstd', 'lz4', '/tf', 'cdr'],
].map((tokenText) => Buffer.from(tokenText));

/** Bytes that mutations insert: small numbers, and numbers at the ends of integer ranges. */
const SPECIAL_BYTES = [0, 1, 2, 3, 4, 8, 16, 32, 127, 128, 255];

/** Maximum size of a mutated input in bytes. */
const MAX_MUTANT_BYTES = 4096;

/** Returns a valid input of the corpus, changed in one to four places. @param {Uint8Array[]} corpusInputs @param {() => number} nextRandom from 0 to 1 */
export function createMutant(corpusInputs, nextRandom) {
  const sampleIntegerBelow = (/** @type {number} */ exclusiveEnd) => Math.floor(exclusiveEnd * nextRandom());
  const drawItem = (/** @type {ArrayLike<any>} */ listItems) => listItems[sampleIntegerBelow(listItems.length)];
  /** @type {Buffer<ArrayBuffer>} */
  let mutantBytes = Buffer.from(drawItem(corpusInputs));
  /** Replaces the bytes between two positions by other bytes. @param {Uint8Array} insertedBytes */
  const replaceBytes = (insertedBytes, startPosition = sampleIntegerBelow(mutantBytes.length + 1), endPosition = startPosition) => {
    mutantBytes = Buffer.concat([mutantBytes.subarray(0, startPosition), insertedBytes, mutantBytes.subarray(endPosition)]).subarray(0, MAX_MUTANT_BYTES);
  };
  for (let remainingChanges = 1 + sampleIntegerBelow(4); remainingChanges > 0; remainingChanges--) {
    const [rangeStart, rangeEnd] = [sampleIntegerBelow(mutantBytes.length + 1), sampleIntegerBelow(mutantBytes.length + 1)].sort((a, b) => a - b);
    const mutationFunctions = [
      () => replaceBytes(Buffer.of(sampleIntegerBelow(256)), rangeStart, rangeStart + 1),
      () => replaceBytes(Buffer.of(drawItem(SPECIAL_BYTES)), rangeStart, rangeStart + 1),
      () => replaceBytes(Buffer.of((mutantBytes[rangeStart] ?? 0) ^ (1 << sampleIntegerBelow(8))), rangeStart, rangeStart + 1),
      () => replaceBytes(drawItem(INSERTED_TOKENS)),
      () => replaceBytes(drawItem(INSERTED_TOKENS), rangeStart, Math.min(rangeEnd, rangeStart + 8)),
      () => replaceBytes(Buffer.alloc(0), rangeStart, Math.min(rangeEnd, rangeStart + 16)),
      () => replaceBytes(mutantBytes.subarray(rangeStart, rangeEnd)),
      () => replaceBytes(Buffer.concat(Array(1 + sampleIntegerBelow(40)).fill(mutantBytes.subarray(rangeStart, Math.min(rangeEnd, rangeStart + 8))))),
      () => replaceBytes(drawItem(corpusInputs).subarray(rangeStart, rangeEnd)),
      () => (mutantBytes = mutantBytes.subarray(0, rangeEnd)),
    ];
    drawItem(mutationFunctions)();
  }
  return mutantBytes;
}
