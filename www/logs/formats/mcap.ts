/** Channels and messages of MCAP files. https://mcap.dev/spec */

import { crc32 } from '@foxglove/crc';
import { McapIndexedReader, McapStreamReader, type Channel } from '@mcap/core';
import { readBytes, type SourceFile } from '../log.ts';
import { MAX_BLOCK_BYTES, MessageFile, createAheadReader, readUint53, dataViewOf, type MessageContainer, type IsWanted, type OnBlock, type OnMessage } from './container.ts';
import { decompressLz4, loadZstd, decompressZstd } from './decompression.ts';

/** Opcodes of records, and the number of bytes of opcode and length before the content of a record. */
const [SCHEMA_OPCODE, CHANNEL_OPCODE, MESSAGE_OPCODE, CHUNK_OPCODE, DATA_END_OPCODE] = [3, 4, 5, 6, 15];
const RECORD_HEAD_BYTES = 9;

const MAGIC_BYTES = 8;

/** Opens a recording by its index. A recording without an index is read from start to end. */
export async function openMcap(sourceFile: SourceFile): Promise<MessageContainer> {
  await loadZstd();
  const fileSize = BigInt(sourceFile.size);
  const readableFile = {
    size: async () => fileSize,
    read: async (byteOffset: bigint, byteCount: bigint) => {
      if (byteOffset + byteCount > fileSize) throw new RangeError('it ends before what it refers to');
      return readBytes(sourceFile, Number(byteOffset), Number(byteOffset + byteCount));
    },
  };
  const indexReader = await McapIndexedReader.Initialize({ readable: readableFile }).catch(() => undefined);
  const mcap = new McapFile(sourceFile);
  if (indexReader && isCompleteIndex(indexReader)) mcap.applyIndex(indexReader);
  else await mcap.readMessages(() => true, ({ topicChannel }) => (topicChannel.messageCount += 1));
  return mcap;
}

/** Returns true if an index lists all chunks, and the channels of each chunk that has messages. */
const isCompleteIndex = ({ chunkIndexes, statistics: fileStatistics }: McapIndexedReader) =>
  fileStatistics?.chunkCount === chunkIndexes.length &&
  (chunkIndexes.length > 0 || fileStatistics.messageCount === 0n) &&
  chunkIndexes.every(({ messageIndexOffsets, messageEndTime }) => messageIndexOffsets.size > 0 || messageEndTime === 0n);

class McapFile extends MessageFile {
  readonly recordingFormat = 'mcap';
  #typesBySchemaId = new Map<number, string>();

  applyIndex({ chunkIndexes, schemasById, channelsById, statistics: fileStatistics }: McapIndexedReader): void {
    this.indexedChunks = chunkIndexes.map(({ chunkStartOffset, messageIndexOffsets }) => ({ chunkStart: Number(chunkStartOffset), channelIds: [...messageIndexOffsets.keys()] }));
    for (const { id, name: schemaName } of schemasById.values()) this.#typesBySchemaId.set(id, schemaName);
    for (const topicChannel of channelsById.values()) this.#addChannel(topicChannel, Number(fileStatistics?.channelMessageCounts.get(topicChannel.id) ?? 0));
  }

  #addChannel({ id, topic: topicName, schemaId, messageEncoding }: Channel, messageCount = 0): void {
    if (!this.channelsById.has(id)) this.channelsById.set(id, { topicName, messageType: this.#typesBySchemaId.get(schemaId) ?? '', encoding: messageEncoding, messageCount });
  }

  async readMessages(isWanted: IsWanted, onMessage: OnMessage, onBlock?: OnBlock): Promise<void> {
    const { size: fileSize } = this.sourceFile;
    const readBytesAt = createAheadReader(this.sourceFile);
    let isFileComplete = this.indexedChunks !== undefined;
    const readBlock = async (recordStart: number, setEnd: (blockEnd: number) => void) => {
      const recordHead = await readBytesAt(recordStart, recordStart + RECORD_HEAD_BYTES);
      const [opcode, recordLength] = [recordHead[0], readUint53(dataViewOf(recordHead), 1)];
      const recordEnd = recordStart + RECORD_HEAD_BYTES + recordLength;
      if (recordEnd > fileSize) throw new RangeError('a record is cut short');
      isFileComplete ||= opcode === DATA_END_OPCODE;
      setEnd(isFileComplete ? fileSize : recordEnd);
      if (this.indexedChunks && opcode !== CHUNK_OPCODE) throw new RangeError('no chunk is there');
      if (![SCHEMA_OPCODE, CHANNEL_OPCODE, MESSAGE_OPCODE, CHUNK_OPCODE].includes(opcode)) return;
      if (recordLength > MAX_BLOCK_BYTES) throw new RangeError(`a record of ${recordLength} bytes`);
      const recordBytes = await readBytesAt(recordStart, recordEnd);
      this.#readRecords(opcode === CHUNK_OPCODE ? await recordsOf(recordBytes.subarray(RECORD_HEAD_BYTES)) : recordBytes, isWanted, onMessage);
    };
    await this.readBlocks(MAGIC_BYTES, isWanted, readBlock, onBlock);
    if (!isFileComplete) this.truncationReason ??= 'it ends without an index';
  }

  #readRecords(bytes: Uint8Array, isWanted: IsWanted, onMessage: OnMessage): void {
    const dataView = dataViewOf(bytes);
    for (let recordStart = 0; recordStart < bytes.length; ) {
      const recordEnd = recordStart + RECORD_HEAD_BYTES + readUint53(dataView, recordStart + 1);
      if (recordEnd > bytes.length) throw new RangeError('a record is cut short');
      if (bytes[recordStart] === MESSAGE_OPCODE) {
        const topicChannel = this.channelsById.get(dataView.getUint16(recordStart + RECORD_HEAD_BYTES, true));
        if (topicChannel && isWanted(topicChannel)) {
          onMessage({ topicChannel, recordTime: readUint53(dataView, recordStart + RECORD_HEAD_BYTES + 6) / 1e9, blockView: dataView, messageStart: recordStart + RECORD_HEAD_BYTES + 22, messageEnd: recordEnd });
        }
      } else {
        const streamReader = new McapStreamReader({ noMagicPrefix: true });
        streamReader.append(bytes.subarray(recordStart, recordEnd));
        const mcapRecord = streamReader.nextRecord();
        if (mcapRecord?.type === 'Schema') this.#typesBySchemaId.set(mcapRecord.id, mcapRecord.name);
        if (mcapRecord?.type === 'Channel') this.#addChannel(mcapRecord);
      }
      recordStart = recordEnd;
    }
  }
}

/** Returns the records of a chunk; rejects if it is damaged, or its compression is unknown. */
async function recordsOf(chunkBytes: Uint8Array): Promise<Uint8Array> {
  const dataView = dataViewOf(chunkBytes);
  const [decompressedSize, crc, compressionLength] = [readUint53(dataView, 16), dataView.getUint32(24, true), dataView.getUint32(28, true)];
  if (decompressedSize > MAX_BLOCK_BYTES) throw new RangeError(`a chunk of ${decompressedSize} bytes`);
  const compression = new TextDecoder().decode(chunkBytes.subarray(32, 32 + compressionLength));
  const bytes = chunkBytes.subarray(40 + compressionLength);
  const decompressChunk = { '': () => bytes, zstd: () => decompressZstd(bytes, decompressedSize), lz4: () => decompressLz4(bytes, decompressedSize) }[compression];
  if (!decompressChunk) throw new RangeError(`compression by ${compression}, not by zstd or lz4`);
  const chunkContents = await decompressChunk();
  if (crc !== 0 && crc32(chunkContents) !== crc) throw new RangeError('the checksum of a chunk is wrong');
  return chunkContents;
}
