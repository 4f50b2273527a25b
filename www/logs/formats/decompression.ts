/** Decompression of files, blocks and messages by Zstandard, and of blocks by LZ4: https://github.com/lz4/lz4/blob/dev/doc/lz4_Frame_format.md. */

import { ZSTDDecoder } from 'zstddec/stream';
import { LogError, readBytes, reasonOf, type SourceFile } from '../log.ts';

const zstdDecoder = new ZSTDDecoder();

const MAX_FILE_BYTES = 2 ** 30;

/** Maximum decompressed size (bytes) of a single compressed message, because the decoder returns a message as a whole. A transform has about a hundred bytes. */
const MAX_LOG_MESSAGE_BYTES = 2 ** 17;

const INPUT_PIECE_BYTES = 2 ** 20;

/** Maximum number of successive empty outputs of the decoder. Valid data gives one empty output at the end of each piece of input, and of each frame. */
const MAX_EMPTY_OUTPUTS = 100;

export const loadZstd = () => zstdDecoder.init();

/** Decompresses a block of known size; throws a RangeError if it has another size. */
export function decompressZstd(bytes: Uint8Array, decompressedSize: number): Uint8Array {
  // The decoder would take size 0 for an unknown size. A block of size 0 is therefore not decoded.
  const decompressedBytes = decompressedSize === 0 ? new Uint8Array() : zstdDecoder.decode(bytes, decompressedSize);
  if (decompressedBytes.length !== decompressedSize) throw new RangeError('a compressed block is not what was written');
  return decompressedBytes;
}

/** Decompresses the pieces of a file or message. Returns undefined if the content has more than `maxBytes`; throws an error if the pieces are damaged. */
function decompressZstdPieces(compressedPieces: Iterable<Uint8Array>, maxBytes: number): Uint8Array<ArrayBuffer>[] | undefined {
  const decompressedPieces: Uint8Array<ArrayBuffer>[] = [];
  let [decompressedSize, emptyOutputCount] = [0, 0];
  for (const decompressedPiece of zstdDecoder.decodeStreaming(compressedPieces)) {
    // The decoder does not report damaged data, but returns empty outputs without end.
    emptyOutputCount = decompressedPiece.length === 0 ? emptyOutputCount + 1 : 0;
    if (emptyOutputCount > MAX_EMPTY_OUTPUTS) throw new RangeError('its compression is damaged');
    decompressedPieces.push(decompressedPiece as Uint8Array<ArrayBuffer>);
    decompressedSize += decompressedPiece.length;
    if (decompressedSize > maxBytes) return undefined;
  }
  return decompressedPieces;
}

export function decompressZstdMessage(bytes: Uint8Array): Uint8Array {
  const [messageBytes, ...otherPieces] = decompressZstdPieces([bytes], MAX_LOG_MESSAGE_BYTES)?.filter(({ length }) => length > 0) ?? [];
  if (!messageBytes || otherPieces.length > 0) throw new RangeError('a message that is empty, or longer than any with poses');
  return messageBytes;
}

export async function decompressZstdFile(sourceFile: SourceFile): Promise<SourceFile> {
  await loadZstd();
  let decompressedPieces: Uint8Array<ArrayBuffer>[] | undefined;
  try {
    decompressedPieces = sourceFile.size > MAX_FILE_BYTES ? undefined : decompressZstdPieces(piecesOf(await readBytes(sourceFile, 0, sourceFile.size)), MAX_FILE_BYTES);
  } catch (error) {
    if (error instanceof LogError) throw error;
    throw new LogError({ fileName: sourceFile.name }, (errorReasons) => errorReasons.damagedFileReason(reasonOf(error)));
  }
  if (!decompressedPieces) throw new LogError({ fileName: sourceFile.name }, (errorReasons) => errorReasons.largeFileReason('zstd -d', MAX_FILE_BYTES));
  const decompressedFile = new Blob(decompressedPieces);
  return { name: sourceFile.name, path: sourceFile.path, size: decompressedFile.size, slice: (byteStart, byteEnd) => decompressedFile.slice(byteStart, byteEnd) };
}

function* piecesOf(bytes: Uint8Array) {
  for (let byteOffset = 0; byteOffset < bytes.length; byteOffset += INPUT_PIECE_BYTES) yield bytes.subarray(byteOffset, byteOffset + INPUT_PIECE_BYTES);
}

const LZ4_MAGIC = 0x184d2204;

/** Flags in the header of an LZ4 frame. */
const [VERSION_MASK, VERSION_1, BLOCK_CHECKSUM_FLAG, CONTENT_SIZE_FLAG, CONTENT_CHECKSUM_FLAG, DICTIONARY_FLAG] = [0xc0, 0x40, 0x10, 0x08, 0x04, 0x01];

/** Flag in the length of an LZ4 block, which marks an uncompressed block. */
const UNCOMPRESSED_BIT = 0x80000000;

/** Minimum length of a match. An LZ4 block stores the length of a match minus this minimum. */
const MIN_MATCH = 4;

function assertValidFrame(isValid: boolean): void {
  if (!isValid) throw new RangeError('a damaged LZ4 frame');
}

/** Hash function xxHash32, loaded with the first frame that has a checksum. */
let xxhash32: ((bytes: Uint8Array) => number) | undefined;

/** Decompresses an LZ4 frame; rejects with a RangeError if it is damaged, its content has another size than `decompressedSize`, or a checksum is wrong. */
export async function decompressLz4(bytes: Uint8Array, decompressedSize: number): Promise<Uint8Array<ArrayBuffer>> {
  const dataView = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const frameFlags = dataView.getUint8(4);
  assertValidFrame(dataView.getUint32(0, true) === LZ4_MAGIC && (frameFlags & VERSION_MASK) === VERSION_1 && !(frameFlags & DICTIONARY_FLAG));
  if (frameFlags & (BLOCK_CHECKSUM_FLAG | CONTENT_CHECKSUM_FLAG)) xxhash32 ??= (await (await import('xxhash-wasm')).default()).h32Raw;
  const verifyChecksum = (checkedBytes: Uint8Array, byteOffset: number) => assertValidFrame(xxhash32?.(checkedBytes) === dataView.getUint32(byteOffset, true));
  const decompressedBytes = new Uint8Array(decompressedSize);
  let filledBytes = 0;
  // The header of an LZ4 frame has a magic number, two bytes of flags, an optional content size, and a checksum.
  for (let byteOffset = 7 + (frameFlags & CONTENT_SIZE_FLAG ? 8 : 0); ; ) {
    const blockWord = dataView.getUint32(byteOffset, true);
    if (blockWord === 0) {
      if (frameFlags & CONTENT_CHECKSUM_FLAG) verifyChecksum(decompressedBytes, byteOffset + 4);
      break;
    }
    const blockStart = byteOffset + 4;
    const blockEnd = blockStart + (blockWord & ~UNCOMPRESSED_BIT);
    assertValidFrame(blockEnd <= bytes.length);
    if (blockWord & UNCOMPRESSED_BIT) {
      decompressedBytes.set(bytes.subarray(blockStart, blockEnd), filledBytes);
      filledBytes += blockEnd - blockStart;
    } else {
      filledBytes = decompressBlock(bytes.subarray(blockStart, blockEnd), decompressedBytes, filledBytes);
    }
    if (frameFlags & BLOCK_CHECKSUM_FLAG) verifyChecksum(bytes.subarray(blockStart, blockEnd), blockEnd);
    byteOffset = blockEnd + (frameFlags & BLOCK_CHECKSUM_FLAG ? 4 : 0);
  }
  assertValidFrame(filledBytes === decompressedSize);
  return decompressedBytes;
}

/** Appends a decompressed block to `decompressedBytes`, whose first `filledBytes` bytes are already filled. Returns the new number of filled bytes. */
function decompressBlock(compressedBlock: Uint8Array, decompressedBytes: Uint8Array, filledBytes: number): number {
  let byteOffset = 0;
  /** Returns the length that starts with the given four bits. If these bits are 15, the following bytes are added, up to the first byte below 255. */
  const readLength = (lengthSoFar: number) => {
    if (lengthSoFar < 15) return lengthSoFar;
    for (let byte = 255; byte === 255; lengthSoFar += byte) {
      assertValidFrame(byteOffset < compressedBlock.length);
      byte = compressedBlock[byteOffset++];
    }
    return lengthSoFar;
  };
  while (byteOffset < compressedBlock.length) {
    const lengthsToken = compressedBlock[byteOffset++];
    const literalLength = readLength(lengthsToken >> 4);
    assertValidFrame(literalLength <= compressedBlock.length - byteOffset && literalLength <= decompressedBytes.length - filledBytes);
    decompressedBytes.set(compressedBlock.subarray(byteOffset, byteOffset + literalLength), filledBytes);
    byteOffset += literalLength;
    filledBytes += literalLength;
    // The last sequence of a block has only literals and no match.
    if (byteOffset === compressedBlock.length) break;
    const matchDistance = compressedBlock[byteOffset] | (compressedBlock[byteOffset + 1] << 8);
    byteOffset += 2;
    const matchEnd = filledBytes + readLength(lengthsToken & 15) + MIN_MATCH;
    assertValidFrame(matchDistance > 0 && matchDistance <= filledBytes && matchEnd <= decompressedBytes.length);
    // If a match is longer than its distance, the copy overlaps itself and repeats bytes that it has just written.
    for (const matchStart = filledBytes - matchDistance; filledBytes < matchEnd; ) {
      const copyLength = Math.min(matchEnd - filledBytes, filledBytes - matchStart);
      decompressedBytes.copyWithin(filledBytes, matchStart, matchStart + copyLength);
      filledBytes += copyLength;
    }
  }
  return filledBytes;
}
