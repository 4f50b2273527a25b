/** Zstandard: blocks of recordings, single messages, and whole files. */

import { ZSTDDecoder } from 'zstddec/stream';
import { LogError, bytesOf } from '../log-error.ts';
import type { Source } from '../log.ts';

const decoder = new ZSTDDecoder();

/** Most bytes of a file that is decompressed in memory. */
const MAX_FILE = 2 ** 30;

/** Bytes that are decompressed at once. */
const PIECE = 2 ** 20;

/** Loads the decoder; the other functions need it. */
export const loadZstd = () => decoder.init();

/** Decompresses a block of known size; throws a RangeError if it has another. */
export function unzstd(bytes: Uint8Array, size: number): Uint8Array {
  // The decoder would take a size of 0 for an unknown one.
  const out = size === 0 ? new Uint8Array() : decoder.decode(bytes, size);
  if (out.length !== size) throw new RangeError('a compressed block is not what was written');
  return out;
}

/** Decompresses a message or file of unknown size, up to a limit. What comes before damage is kept. */
export function unzstdPart(bytes: Uint8Array, limit: number): Uint8Array<ArrayBuffer>[] {
  const parts: Uint8Array<ArrayBuffer>[] = [];
  let size = 0;
  try {
    for (const part of decoder.decodeStreaming(piecesOf(bytes))) {
      parts.push(part.slice());
      if ((size += part.length) > limit) break;
    }
  } catch (error) {
    if (size === 0) throw error;
  }
  return parts;
}

export function concatenated(parts: Uint8Array[]): Uint8Array {
  const bytes = new Uint8Array(parts.reduce((size, { length }) => size + length, 0));
  let at = 0;
  for (const part of parts) {
    bytes.set(part, at);
    at += part.length;
  }
  return bytes;
}

function* piecesOf(bytes: Uint8Array) {
  for (let at = 0; at < bytes.length; at += PIECE) yield bytes.subarray(at, at + PIECE);
}

/** Decompresses a file, which keeps its name. */
export async function unzstdFile(source: Source): Promise<Source> {
  await loadZstd();
  const parts = source.size > MAX_FILE ? [] : unzstdPart(await bytesOf(source, 0, source.size), MAX_FILE);
  const file = new Blob(parts);
  if (source.size > MAX_FILE || file.size > MAX_FILE) throw new LogError({ file: source.name }, (say) => say.largeFile('zstd -d', MAX_FILE));
  return { name: source.name, path: source.path, size: file.size, slice: (from, to) => file.slice(from, to) };
}
