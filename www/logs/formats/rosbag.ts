/** Connections and messages of ROS 1 bags. http://wiki.ros.org/Bags/Format/2.0 */

import { LogError, readBytes, type SourceFile } from '../log.ts';
import { MAX_BLOCK_BYTES, MessageFile, dataViewOf, createAheadReader, readUint53, type MessageContainer, type IsWanted, type OnBlock, type OnMessage } from './container.ts';
import { decompressLz4 } from './decompression.ts';

/** Values of the field "op" of records. */
const [MESSAGE_OPCODE, BAG_OPCODE, CHUNK_OPCODE, CHUNK_INFO_OPCODE, CONNECTION_OPCODE] = [2, 3, 5, 6, 7];

const MAGIC_BYTES = 13;

/** Maximum size of a record's header in bytes. The largest headers contain the name of a topic. */
const MAX_HEADER_BYTES = 4096;

/** Opens a bag by its index. A bag without an index is read from its start up to its end, or to a damaged length. */
export async function openRosbag(sourceFile: SourceFile): Promise<MessageContainer> {
  const bagFile = new RosbagFile(sourceFile);
  if (!(await bagFile.readIndex())) await bagFile.readMessages(() => true, ({ topicChannel }) => (topicChannel.messageCount += 1));
  return bagFile;
}

/** Returns the value of a field in a header. A field is the text "name=value", preceded by its length. Throws a RangeError if the field is missing. */
function fieldOf(recordHeader: DataView, fieldName: string): DataView {
  const fieldPrefix = `${fieldName}=`;
  for (let fieldStart = 0; fieldStart < recordHeader.byteLength; ) {
    const fieldEnd = fieldStart + 4 + recordHeader.getUint32(fieldStart, true);
    let valueStart = fieldStart + 4;
    while (valueStart - fieldStart - 4 < fieldPrefix.length && recordHeader.getUint8(valueStart) === fieldPrefix.charCodeAt(valueStart - fieldStart - 4)) valueStart += 1;
    if (valueStart - fieldStart - 4 === fieldPrefix.length) return new DataView(recordHeader.buffer, recordHeader.byteOffset + valueStart, fieldEnd - valueStart);
    fieldStart = fieldEnd;
  }
  throw new RangeError(`a record has no field ${fieldName}`);
}

const uint32Of = (recordHeader: DataView, fieldName: string) => fieldOf(recordHeader, fieldName).getUint32(0, true);
const textOfField = (recordHeader: DataView, fieldName: string) => new TextDecoder().decode(fieldOf(recordHeader, fieldName));
const opcodeOf = (recordHeader: DataView) => fieldOf(recordHeader, 'op').getUint8(0);

interface BagRecord { recordHeader: DataView; dataStart: number; dataEnd: number }

/** Returns the header of a record, and the range of its data. Throws a RangeError if the view ends in the header. */
function readRecordAt(blockView: DataView, recordStart: number): BagRecord {
  const headerEnd = recordStart + 4 + blockView.getUint32(recordStart, true);
  if (headerEnd + 4 > blockView.byteLength) throw new RangeError('a header is damaged or cut short');
  const dataStart = headerEnd + 4;
  return { recordHeader: new DataView(blockView.buffer, blockView.byteOffset + recordStart + 4, headerEnd - recordStart - 4), dataStart, dataEnd: dataStart + blockView.getUint32(headerEnd, true) };
}

function* readRecordsIn(blockView: DataView): Generator<BagRecord> {
  for (let recordStart = 0; recordStart < blockView.byteLength; ) {
    const bagRecord = readRecordAt(blockView, recordStart);
    if (bagRecord.dataEnd > blockView.byteLength) throw new RangeError('a record is cut short');
    yield bagRecord;
    recordStart = bagRecord.dataEnd;
  }
}

class RosbagFile extends MessageFile {
  readonly recordingFormat = 'rosbag';

  /** Reads the index at the end of the bag. Returns false if the index is missing or damaged. */
  async readIndex(): Promise<boolean> {
    const { size: fileSize } = this.sourceFile;
    try {
      const { recordHeader } = readRecordAt(dataViewOf(await readBytes(this.sourceFile, MAGIC_BYTES, MAGIC_BYTES + MAX_HEADER_BYTES)), 0);
      const [indexStart, chunkCount] = [readUint53(fieldOf(recordHeader, 'index_pos'), 0), uint32Of(recordHeader, 'chunk_count')];
      if (opcodeOf(recordHeader) !== BAG_OPCODE || indexStart === 0 || indexStart > fileSize) return false;
      const bytes = await readBytes(this.sourceFile, indexStart, fileSize);
      const blockView = dataViewOf(bytes);
      const indexedChunks = [];
      for (const { recordHeader, dataStart, dataEnd } of readRecordsIn(blockView)) {
        const opcode = opcodeOf(recordHeader);
        if (opcode === CONNECTION_OPCODE) this.#addConnection(recordHeader, bytes.subarray(dataStart, dataEnd));
        if (opcode !== CHUNK_INFO_OPCODE) continue;
        const idsWithCounts = Array.from({ length: uint32Of(recordHeader, 'count') }, (_, i) => [0, 4].map((fieldOffset) => blockView.getUint32(dataStart + 8 * i + fieldOffset, true)));
        for (const [id, messageCount] of idsWithCounts) {
          const topicChannel = this.channelsById.get(id);
          if (topicChannel) topicChannel.messageCount += messageCount;
        }
        indexedChunks.push({ chunkStart: readUint53(fieldOf(recordHeader, 'chunk_pos'), 0), channelIds: idsWithCounts.map(([id]) => id) });
      }
      if (indexedChunks.length !== chunkCount) throw new RangeError('the index is incomplete');
      this.indexedChunks = indexedChunks;
      return true;
    } catch (error) {
      if (error instanceof LogError) throw error;
      this.channelsById.clear();
      return false;
    }
  }

  /** Adds the channel that a connection record describes. Both the header and the data of the record consist of fields. */
  #addConnection(recordHeader: DataView, connectionData: Uint8Array): void {
    const id = uint32Of(recordHeader, 'conn');
    if (this.channelsById.has(id)) return;
    this.channelsById.set(id, { topicName: textOfField(recordHeader, 'topic'), messageType: textOfField(dataViewOf(connectionData), 'type'), encoding: 'ros1', messageCount: 0 });
  }

  async readMessages(isWanted: IsWanted, onMessage: OnMessage, onBlock?: OnBlock): Promise<void> {
    const { size: fileSize } = this.sourceFile;
    const readBytesAt = createAheadReader(this.sourceFile);
    const readBlock = async (recordStart: number, setEnd: (blockEnd: number) => void) => {
      const { recordHeader, dataStart, dataEnd } = readRecordAt(dataViewOf(await readBytesAt(recordStart, Math.min(recordStart + MAX_HEADER_BYTES, fileSize))), 0);
      if (recordStart + dataEnd > fileSize) throw new RangeError('a record is cut short');
      setEnd(recordStart + dataEnd);
      const opcode = opcodeOf(recordHeader);
      if (this.indexedChunks && opcode !== CHUNK_OPCODE) throw new RangeError('no chunk is there');
      if (opcode === CONNECTION_OPCODE) this.#addConnection(recordHeader, await readBytesAt(recordStart + dataStart, recordStart + dataEnd));
      if (opcode !== CHUNK_OPCODE) return;
      const uncompressedBytes = uint32Of(recordHeader, 'size');
      if (Math.max(dataEnd, uncompressedBytes) > MAX_BLOCK_BYTES) throw new RangeError(`a chunk of ${uncompressedBytes} bytes`);
      this.#readRecords(await decompressChunk(textOfField(recordHeader, 'compression'), await readBytesAt(recordStart + dataStart, recordStart + dataEnd), uncompressedBytes), isWanted, onMessage);
    };
    await this.readBlocks(MAGIC_BYTES, isWanted, readBlock, onBlock);
  }

  #readRecords(bytes: Uint8Array, isWanted: IsWanted, onMessage: OnMessage): void {
    const blockView = dataViewOf(bytes);
    for (const { recordHeader, dataStart, dataEnd } of readRecordsIn(blockView)) {
      const opcode = opcodeOf(recordHeader);
      if (opcode === CONNECTION_OPCODE) this.#addConnection(recordHeader, bytes.subarray(dataStart, dataEnd));
      const topicChannel = opcode === MESSAGE_OPCODE ? this.channelsById.get(uint32Of(recordHeader, 'conn')) : undefined;
      if (!topicChannel || !isWanted(topicChannel)) continue;
      const timeField = fieldOf(recordHeader, 'time');
      onMessage({ topicChannel, recordTime: timeField.getUint32(0, true) + timeField.getUint32(4, true) / 1e9, blockView, messageStart: dataStart, messageEnd: dataEnd });
    }
  }
}

async function decompressChunk(compression: string, bytes: Uint8Array, decompressedSize: number): Promise<Uint8Array> {
  if (compression === 'none') return bytes;
  if (compression === 'lz4') return decompressLz4(bytes, decompressedSize);
  if (compression !== 'bz2') throw new RangeError(`compression by ${compression}, not by bz2 or lz4`);
  const { default: bzip } = await import('@openpgp/seek-bzip');
  return bzip.decode(bytes, new Uint8Array(decompressedSize));
}
