/** Seeded mutations of valid inputs. */

import { Buffer } from 'node:buffer';

/** Tokens with a meaning in one of the formats. */
const INSERTED_TOKENS = [
  ...['\0', '\n', '\r\n', '\t', ' ', '"', "'", '#', ',', ':', ': ', '- ', '? ', '|\n', '>', '[', ']', '{', '}', '&a ', '*a', '<<: ', '---\n', '...', '%', '\\', '/'],
  ...['-', '0', '-0', '1e999', '-1', '0x10', '.nan', '.inf', 'NaN', 'null', 'true', '16777216', '65536', '4294967295', '99999999999999999999'],
  ...['__proto__', 'constructor', 'toString', 'image', 'resolution', 'origin', 'negate', 'mode', 'bounds', 'walls', 'map', '!!js/function ', '!!binary '],
  ...['<script>alert(1)</script>', '"><img src=x onerror=alert(1)>', ']]>', '&lt;', '\u202e', '\ufeff', '\u2028', '\u{1f916}', 'é'],
  ...['yaw', 't_ns', 'stamp', 'qw', 'v', ';', '1e17', '1700000000.123456789', 'zstd', 'lz4', '/tf', 'cdr'],
].map((token) => Buffer.from(token));

/** Small bytes, and bytes at the limits of ranges. */
const SPECIAL_BYTES = [0, 1, 2, 3, 4, 8, 16, 32, 127, 128, 255];

/** Largest size of a mutation in bytes. */
const MAX_MUTANT_BYTES = 4096;

/** Returns a valid input of the corpus, changed in one to four places. @param {Uint8Array[]} corpus @param {() => number} random from 0 to 1 */
export function createMutant(corpus, random) {
  const randomBelow = (/** @type {number} */ count) => Math.floor(count * random());
  const randomItem = (/** @type {ArrayLike<any>} */ items) => items[randomBelow(items.length)];
  /** @type {Buffer<ArrayBuffer>} */
  let mutantBytes = Buffer.from(randomItem(corpus));
  /** Replaces the bytes between two positions. @param {Uint8Array} middle */
  const replaceBytes = (middle, from = randomBelow(mutantBytes.length + 1), to = from) => {
    mutantBytes = Buffer.concat([mutantBytes.subarray(0, from), middle, mutantBytes.subarray(to)]).subarray(0, MAX_MUTANT_BYTES);
  };
  for (let changesLeft = 1 + randomBelow(4); changesLeft > 0; changesLeft--) {
    const [start, end] = [randomBelow(mutantBytes.length + 1), randomBelow(mutantBytes.length + 1)].sort((a, b) => a - b);
    const mutations = [
      () => replaceBytes(Buffer.of(randomBelow(256)), start, start + 1),
      () => replaceBytes(Buffer.of(randomItem(SPECIAL_BYTES)), start, start + 1),
      () => replaceBytes(Buffer.of((mutantBytes[start] ?? 0) ^ (1 << randomBelow(8))), start, start + 1),
      () => replaceBytes(randomItem(INSERTED_TOKENS)),
      () => replaceBytes(randomItem(INSERTED_TOKENS), start, Math.min(end, start + 8)),
      () => replaceBytes(Buffer.alloc(0), start, Math.min(end, start + 16)),
      () => replaceBytes(mutantBytes.subarray(start, end)),
      () => replaceBytes(Buffer.concat(Array(1 + randomBelow(40)).fill(mutantBytes.subarray(start, Math.min(end, start + 8))))),
      () => replaceBytes(randomItem(corpus).subarray(start, end)),
      () => (mutantBytes = mutantBytes.subarray(0, end)),
    ];
    randomItem(mutations)();
  }
  return mutantBytes;
}
