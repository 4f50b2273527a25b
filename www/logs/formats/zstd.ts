/** Zstandard decompression of blocks, single messages, and whole files. */

import { ZSTDDecoder } from 'zstddec/stream';
import { LogError, readBytes, reasonOf } from '../log-error.ts';
import type { Source } from '../log.ts';
import { MAX_BLOCK_BYTES, dataViewOf } from './container.ts';

const zstdDecoder = new ZSTDDecoder();

const MAX_FILE_BYTES = 2 ** 30;

const INPUT_PIECE_BYTES = 2 ** 20;

/** Maximum number of successive empty parts of the output. The end of each piece of input or frame gives one. */
const MAX_EMPTY_PARTS = 100;

export const loadZstd = () => zstdDecoder.init();

/** Decompresses a block of known size; throws a RangeError if it has another size. */
export function unzstd(bytes: Uint8Array, size: number): Uint8Array {
  // The decoder treats size 0 as unknown.
  const output = size === 0 ? new Uint8Array() : zstdDecoder.decode(bytes, size);
  if (output.length !== size) throw new RangeError('a compressed block is not what was written');
  return output;
}

export function unzstdMessage(bytes: Uint8Array): Uint8Array {
  const size = contentSize(bytes);
  if (size > MAX_BLOCK_BYTES) throw new RangeError(`a message of ${size} bytes`);
  return unzstd(bytes, size);
}

/** Returns the size of the content from the header of a frame; Infinity if the header has none. https://www.rfc-editor.org/rfc/rfc8878 */
function contentSize(frame: Uint8Array): number {
  const view = dataViewOf(frame);
  const frameDescriptor = view.getUint8(4);
  const isSingleSegment = (frameDescriptor >> 5) & 1;
  const at = 6 - isSingleSegment + [0, 1, 2, 4][frameDescriptor & 3];
  switch (frameDescriptor >> 6) {
    case 0: return isSingleSegment ? view.getUint8(at) : Infinity;
    case 1: return view.getUint16(at, true) + 256;
    case 2: return view.getUint32(at, true);
    default: return Number(view.getBigUint64(at, true));
  }
}

export async function unzstdFile(source: Source): Promise<Source> {
  await loadZstd();
  const tooLargeError = () => new LogError({ file: source.name }, (texts) => texts.largeFile('zstd -d', MAX_FILE_BYTES));
  if (source.size > MAX_FILE_BYTES) throw tooLargeError();
  const bytes = await readBytes(source, 0, source.size);
  const outputParts: Uint8Array<ArrayBuffer>[] = [];
  let [size, emptyParts] = [0, 0];
  try {
    for (const outputPart of zstdDecoder.decodeStreaming(piecesOf(bytes))) {
      // The decoder does not stop at damage, but returns empty parts.
      emptyParts = outputPart.length === 0 ? emptyParts + 1 : 0;
      if (emptyParts > MAX_EMPTY_PARTS) throw new RangeError('its compression is damaged');
      outputParts.push(outputPart.slice());
      size += outputPart.length;
      if (size > MAX_FILE_BYTES) throw tooLargeError();
    }
  } catch (error) {
    if (error instanceof LogError) throw error;
    throw new LogError({ file: source.name }, (texts) => texts.damaged(reasonOf(error)));
  }
  const decompressedFile = new Blob(outputParts);
  return { name: source.name, path: source.path, size: decompressedFile.size, slice: (from, to) => decompressedFile.slice(from, to) };
}

function* piecesOf(bytes: Uint8Array) {
  for (let at = 0; at < bytes.length; at += INPUT_PIECE_BYTES) yield bytes.subarray(at, at + INPUT_PIECE_BYTES);
}
