/** What is in a compressed chunk of a recording. */

import { ZSTDDecoder } from 'zstddec';
import { unlz4 } from './lz4.js';
import { LogError } from './refusal.js';

/** @import { Place } from './refusal.js' */

/** Bytes of a chunk at most, before or after: recorders make chunks of one to four million. */
export const MAX_CHUNK = 2 ** 26;

/**
 * @param {Place} place that refusals name
 * @returns {Promise<import('@mcap/core').McapTypes.DecompressHandlers>}
 */
export async function decompressors(place) {
  const zstd = new ZSTDDecoder();
  await zstd.init();
  /** @param {(bytes: Uint8Array, size: number) => Uint8Array} decompress */
  const bounded = (decompress) => (/** @type {Uint8Array} */ bytes, /** @type {bigint} */ announced) => {
    const size = Number(announced);
    if (size > MAX_CHUNK) throw new LogError(place, (say) => say.large('a chunk', `${announced}`, MAX_CHUNK));
    // Of a chunk of nothing, the decoder would believe what the frame says.
    const out = size === 0 ? new Uint8Array() : decompress(bytes, size);
    if (out.length !== size) throw new RangeError('a compressed chunk is not what was written');
    return out;
  };
  return { lz4: bounded(unlz4), zstd: bounded((bytes, size) => zstd.decode(bytes, size)) };
}
