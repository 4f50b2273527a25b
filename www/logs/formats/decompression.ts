/** Decompression of files, blocks and messages by Zstandard, and of blocks by LZ4: https://github.com/lz4/lz4/blob/dev/doc/lz4_Frame_format.md. */

import { ZSTDDecoder } from 'zstddec/stream';
import { LogError, readBytes, reasonOf, type Source } from '../log.ts';

const zstdDecoder = new ZSTDDecoder();

const MAX_FILE_BYTES = 2 ** 30;

/** Maximum decompressed size (bytes) of a single compressed message, because the decoder returns a message as a whole. A transform has about a hundred bytes. */
const MAX_LOG_MESSAGE_BYTES = 2 ** 17;

const INPUT_PIECE_BYTES = 2 ** 20;

/** Maximum number of successive empty outputs of the decoder. Valid data gives one empty output at the end of each piece of input, and of each frame. */
const MAX_EMPTY_OUTPUTS = 100;

export const loadZstd = () => zstdDecoder.init();

/** Decompresses a block of known size; throws a RangeError if it has another size. */
export function decompressZstd(bytes: Uint8Array, size: number): Uint8Array {
  // The decoder would take size 0 for an unknown size. A block of size 0 is therefore not decoded.
  const output = size === 0 ? new Uint8Array() : zstdDecoder.decode(bytes, size);
  if (output.length !== size) throw new RangeError('a compressed block is not what was written');
  return output;
}

/** Decompresses the pieces of a file or message. Returns undefined if the content has more than `maxBytes`; throws an error if the pieces are damaged. */
function decompressZstdPieces(pieces: Iterable<Uint8Array>, maxBytes: number): Uint8Array<ArrayBuffer>[] | undefined {
  const outputParts: Uint8Array<ArrayBuffer>[] = [];
  let [size, emptyOutputCount] = [0, 0];
  for (const outputPart of zstdDecoder.decodeStreaming(pieces)) {
    // The decoder does not report damaged data, but returns empty outputs without end.
    emptyOutputCount = outputPart.length === 0 ? emptyOutputCount + 1 : 0;
    if (emptyOutputCount > MAX_EMPTY_OUTPUTS) throw new RangeError('its compression is damaged');
    outputParts.push(outputPart as Uint8Array<ArrayBuffer>);
    size += outputPart.length;
    if (size > maxBytes) return undefined;
  }
  return outputParts;
}

export function decompressZstdMessage(bytes: Uint8Array): Uint8Array {
  const [message, ...otherParts] = decompressZstdPieces([bytes], MAX_LOG_MESSAGE_BYTES)?.filter(({ length }) => length > 0) ?? [];
  if (!message || otherParts.length > 0) throw new RangeError('a message that is empty, or longer than any with poses');
  return message;
}

export async function decompressZstdFile(source: Source): Promise<Source> {
  await loadZstd();
  let outputParts: Uint8Array<ArrayBuffer>[] | undefined;
  try {
    outputParts = source.size > MAX_FILE_BYTES ? undefined : decompressZstdPieces(piecesOf(await readBytes(source, 0, source.size)), MAX_FILE_BYTES);
  } catch (error) {
    if (error instanceof LogError) throw error;
    throw new LogError({ file: source.name }, (texts) => texts.damagedFileReason(reasonOf(error)));
  }
  if (!outputParts) throw new LogError({ file: source.name }, (texts) => texts.largeFileReason('zstd -d', MAX_FILE_BYTES));
  const decompressedFile = new Blob(outputParts);
  return { name: source.name, path: source.path, size: decompressedFile.size, slice: (start, end) => decompressedFile.slice(start, end) };
}

function* piecesOf(bytes: Uint8Array) {
  for (let position = 0; position < bytes.length; position += INPUT_PIECE_BYTES) yield bytes.subarray(position, position + INPUT_PIECE_BYTES);
}

const LZ4_MAGIC = 0x184d2204;

/** Flags in the header of an LZ4 frame. */
const [VERSION_MASK, VERSION_1, BLOCK_CHECKSUMS, CONTENT_SIZE, CONTENT_CHECKSUM, DICTIONARY] = [0xc0, 0x40, 0x10, 0x08, 0x04, 0x01];

/** Flag in the length of an LZ4 block, which marks an uncompressed block. */
const UNCOMPRESSED_BIT = 0x80000000;

/** Minimum length of a match. An LZ4 block stores the length of a match minus this minimum. */
const MIN_MATCH = 4;

function assertValid(condition: boolean): void {
  if (!condition) throw new RangeError('a damaged LZ4 frame');
}

/** Hash function xxHash32, loaded with the first frame that has a checksum. */
let xxhash32: ((bytes: Uint8Array) => number) | undefined;

/** Decompresses an LZ4 frame; rejects with a RangeError if it is damaged, its content has another size than `size`, or a checksum is wrong. */
export async function decompressLz4(bytes: Uint8Array, size: number): Promise<Uint8Array<ArrayBuffer>> {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const flags = view.getUint8(4);
  assertValid(view.getUint32(0, true) === LZ4_MAGIC && (flags & VERSION_MASK) === VERSION_1 && !(flags & DICTIONARY));
  if (flags & (BLOCK_CHECKSUMS | CONTENT_CHECKSUM)) xxhash32 ??= (await (await import('xxhash-wasm')).default()).h32Raw;
  const verifyChecksum = (checkedBytes: Uint8Array, position: number) => assertValid(xxhash32?.(checkedBytes) === view.getUint32(position, true));
  const output = new Uint8Array(size);
  let filledBytes = 0;
  // The header of an LZ4 frame has a magic number, two bytes of flags, an optional content size, and a checksum.
  for (let position = 7 + (flags & CONTENT_SIZE ? 8 : 0); ; ) {
    const blockWord = view.getUint32(position, true);
    if (blockWord === 0) {
      if (flags & CONTENT_CHECKSUM) verifyChecksum(output, position + 4);
      break;
    }
    const blockStart = position + 4;
    const blockEnd = blockStart + (blockWord & ~UNCOMPRESSED_BIT);
    assertValid(blockEnd <= bytes.length);
    if (blockWord & UNCOMPRESSED_BIT) {
      output.set(bytes.subarray(blockStart, blockEnd), filledBytes);
      filledBytes += blockEnd - blockStart;
    } else {
      filledBytes = decompressBlock(bytes.subarray(blockStart, blockEnd), output, filledBytes);
    }
    if (flags & BLOCK_CHECKSUMS) verifyChecksum(bytes.subarray(blockStart, blockEnd), blockEnd);
    position = blockEnd + (flags & BLOCK_CHECKSUMS ? 4 : 0);
  }
  assertValid(filledBytes === size);
  return output;
}

/** Appends a decompressed block to `output`, whose first `filledBytes` bytes are already filled. Returns the new number of filled bytes. */
function decompressBlock(block: Uint8Array, output: Uint8Array, filledBytes: number): number {
  let position = 0;
  /** Returns the length that starts with the given four bits. If these bits are 15, the following bytes are added, up to the first byte below 255. */
  const readLength = (length: number) => {
    if (length < 15) return length;
    for (let byte = 255; byte === 255; length += byte) {
      assertValid(position < block.length);
      byte = block[position++];
    }
    return length;
  };
  while (position < block.length) {
    const lengthsToken = block[position++];
    const literalLength = readLength(lengthsToken >> 4);
    assertValid(literalLength <= block.length - position && literalLength <= output.length - filledBytes);
    output.set(block.subarray(position, position + literalLength), filledBytes);
    position += literalLength;
    filledBytes += literalLength;
    // The last sequence of a block has only literals and no match.
    if (position === block.length) break;
    const matchDistance = block[position] | (block[position + 1] << 8);
    position += 2;
    const end = filledBytes + readLength(lengthsToken & 15) + MIN_MATCH;
    assertValid(matchDistance > 0 && matchDistance <= filledBytes && end <= output.length);
    // If a match is longer than its distance, the copy overlaps itself and repeats bytes that it has just written.
    for (const matchStart = filledBytes - matchDistance; filledBytes < end; ) {
      const copyLength = Math.min(end - filledBytes, filledBytes - matchStart);
      output.copyWithin(filledBytes, matchStart, matchStart + copyLength);
      filledBytes += copyLength;
    }
  }
  return filledBytes;
}
