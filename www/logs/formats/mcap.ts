/** Channels and messages of MCAP files. https://mcap.dev/spec */

import { crc32 } from '@foxglove/crc';
import { McapIndexedReader, McapStreamReader, type Channel } from '@mcap/core';
import { readBytes, type Source } from '../log.ts';
import { MAX_BLOCK_BYTES, MessageFile, createAheadReader, readUint53, dataViewOf, type Container, type IsWanted, type OnBlock, type OnMessage } from './container.ts';
import { decompressLz4, loadZstd, decompressZstd } from './decompression.ts';

/** Opcodes of records, and the number of bytes of opcode and length before the content of a record. */
const [SCHEMA_OPCODE, CHANNEL_OPCODE, MESSAGE_OPCODE, CHUNK_OPCODE, DATA_END_OPCODE] = [3, 4, 5, 6, 15];
const RECORD_HEAD_BYTES = 9;

const MAGIC_BYTES = 8;

/** Opens a recording by its index. A recording without an index is read from start to end. */
export async function openMcap(source: Source): Promise<Container> {
  await loadZstd();
  const size = BigInt(source.size);
  const readable = {
    size: async () => size,
    read: async (offset: bigint, length: bigint) => {
      if (offset + length > size) throw new RangeError('it ends before what it refers to');
      return readBytes(source, Number(offset), Number(offset + length));
    },
  };
  const indexReader = await McapIndexedReader.Initialize({ readable }).catch(() => undefined);
  const mcap = new Mcap(source);
  if (indexReader && isCompleteIndex(indexReader)) mcap.useIndex(indexReader);
  else await mcap.readMessages(() => true, ({ channel }) => (channel.count += 1));
  return mcap;
}

/** Returns true if an index lists all chunks, and the channels of each chunk that has messages. */
const isCompleteIndex = ({ chunkIndexes, statistics }: McapIndexedReader) =>
  statistics?.chunkCount === chunkIndexes.length &&
  (chunkIndexes.length > 0 || statistics.messageCount === 0n) &&
  chunkIndexes.every(({ messageIndexOffsets, messageEndTime }) => messageIndexOffsets.size > 0 || messageEndTime === 0n);

class Mcap extends MessageFile {
  readonly format = 'mcap';
  #typesBySchemaId = new Map<number, string>();

  useIndex({ chunkIndexes, schemasById, channelsById, statistics }: McapIndexedReader): void {
    this.chunks = chunkIndexes.map(({ chunkStartOffset, messageIndexOffsets }) => ({ position: Number(chunkStartOffset), ids: [...messageIndexOffsets.keys()] }));
    for (const { id, name } of schemasById.values()) this.#typesBySchemaId.set(id, name);
    for (const channel of channelsById.values()) this.#addChannel(channel, Number(statistics?.channelMessageCounts.get(channel.id) ?? 0));
  }

  #addChannel({ id, topic, schemaId, messageEncoding }: Channel, count = 0): void {
    if (!this.channelsById.has(id)) this.channelsById.set(id, { topic, type: this.#typesBySchemaId.get(schemaId) ?? '', encoding: messageEncoding, count });
  }

  async readMessages(isWanted: IsWanted, onMessage: OnMessage, onBlock?: OnBlock): Promise<void> {
    const { size } = this.source;
    const readBytesAt = createAheadReader(this.source);
    let isFileComplete = this.chunks !== undefined;
    const readBlock = async (recordStart: number, setEnd: (end: number) => void) => {
      const recordHead = await readBytesAt(recordStart, recordStart + RECORD_HEAD_BYTES);
      const [opcode, length] = [recordHead[0], readUint53(dataViewOf(recordHead), 1)];
      const end = recordStart + RECORD_HEAD_BYTES + length;
      if (end > size) throw new RangeError('a record is cut short');
      isFileComplete ||= opcode === DATA_END_OPCODE;
      setEnd(isFileComplete ? size : end);
      if (this.chunks && opcode !== CHUNK_OPCODE) throw new RangeError('no chunk is there');
      if (![SCHEMA_OPCODE, CHANNEL_OPCODE, MESSAGE_OPCODE, CHUNK_OPCODE].includes(opcode)) return;
      if (length > MAX_BLOCK_BYTES) throw new RangeError(`a record of ${length} bytes`);
      const record = await readBytesAt(recordStart, end);
      this.#readRecords(opcode === CHUNK_OPCODE ? await recordsOf(record.subarray(RECORD_HEAD_BYTES)) : record, isWanted, onMessage);
    };
    await this.readBlocks(MAGIC_BYTES, isWanted, readBlock, onBlock);
    if (!isFileComplete) this.truncationReason ??= 'it ends without an index';
  }

  #readRecords(bytes: Uint8Array, isWanted: IsWanted, onMessage: OnMessage): void {
    const view = dataViewOf(bytes);
    for (let recordStart = 0; recordStart < bytes.length; ) {
      const recordEnd = recordStart + RECORD_HEAD_BYTES + readUint53(view, recordStart + 1);
      if (recordEnd > bytes.length) throw new RangeError('a record is cut short');
      if (bytes[recordStart] === MESSAGE_OPCODE) {
        const channel = this.channelsById.get(view.getUint16(recordStart + RECORD_HEAD_BYTES, true));
        if (channel && isWanted(channel)) {
          onMessage({ channel, time: readUint53(view, recordStart + RECORD_HEAD_BYTES + 6) / 1e9, block: view, start: recordStart + RECORD_HEAD_BYTES + 22, end: recordEnd });
        }
      } else {
        const reader = new McapStreamReader({ noMagicPrefix: true });
        reader.append(bytes.subarray(recordStart, recordEnd));
        const record = reader.nextRecord();
        if (record?.type === 'Schema') this.#typesBySchemaId.set(record.id, record.name);
        if (record?.type === 'Channel') this.#addChannel(record);
      }
      recordStart = recordEnd;
    }
  }
}

/** Returns the records of a chunk; rejects if it is damaged, or its compression is unknown. */
async function recordsOf(chunk: Uint8Array): Promise<Uint8Array> {
  const view = dataViewOf(chunk);
  const [size, crc, length] = [readUint53(view, 16), view.getUint32(24, true), view.getUint32(28, true)];
  if (size > MAX_BLOCK_BYTES) throw new RangeError(`a chunk of ${size} bytes`);
  const compression = new TextDecoder().decode(chunk.subarray(32, 32 + length));
  const bytes = chunk.subarray(40 + length);
  const decompressChunk = { '': () => bytes, zstd: () => decompressZstd(bytes, size), lz4: () => decompressLz4(bytes, size) }[compression];
  if (!decompressChunk) throw new RangeError(`compression by ${compression}, not by zstd or lz4`);
  const chunkContents = await decompressChunk();
  if (crc !== 0 && crc32(chunkContents) !== crc) throw new RangeError('the checksum of a chunk is wrong');
  return chunkContents;
}
