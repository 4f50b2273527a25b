/** Connections and messages of ROS 1 bags. http://wiki.ros.org/Bags/Format/2.0 */

import { LogError, readBytes, type Source } from '../log.ts';
import { MAX_BLOCK_BYTES, MessageFile, dataViewOf, createAheadReader, readUint53, type Container, type IsWanted, type OnBlock, type OnMessage } from './container.ts';
import { decompressLz4 } from './decompression.ts';

/** Values of the field "op" of records. */
const [MESSAGE_OPCODE, BAG_OPCODE, CHUNK_OPCODE, CHUNK_INFO_OPCODE, CONNECTION_OPCODE] = [2, 3, 5, 6, 7];

const MAGIC_BYTES = 13;

/** Maximum size of a record's header in bytes. The largest headers contain the name of a topic. */
const MAX_HEADER_BYTES = 4096;

/** Opens a bag by its index. A bag without an index is read from its start up to its end, or to a damaged length. */
export async function openRosbag(source: Source): Promise<Container> {
  const bag = new Rosbag(source);
  if (!(await bag.readIndex())) await bag.readMessages(() => true, ({ channel }) => (channel.count += 1));
  return bag;
}

/** Returns the value of a field in a header. A field is the text "name=value", preceded by its length. Throws a RangeError if the field is missing. */
function fieldOf(header: DataView, name: string): DataView {
  const prefix = `${name}=`;
  for (let fieldStart = 0; fieldStart < header.byteLength; ) {
    const end = fieldStart + 4 + header.getUint32(fieldStart, true);
    let valueStart = fieldStart + 4;
    while (valueStart - fieldStart - 4 < prefix.length && header.getUint8(valueStart) === prefix.charCodeAt(valueStart - fieldStart - 4)) valueStart += 1;
    if (valueStart - fieldStart - 4 === prefix.length) return new DataView(header.buffer, header.byteOffset + valueStart, end - valueStart);
    fieldStart = end;
  }
  throw new RangeError(`a record has no field ${name}`);
}

const uint32Of = (header: DataView, name: string) => fieldOf(header, name).getUint32(0, true);
const textOf = (header: DataView, name: string) => new TextDecoder().decode(fieldOf(header, name));
const opcodeOf = (header: DataView) => fieldOf(header, 'op').getUint8(0);

interface BagRecord { header: DataView; dataStart: number; dataEnd: number }

/** Returns the header of a record, and the range of its data. Throws a RangeError if the view ends in the header. */
function recordAt(view: DataView, recordStart: number): BagRecord {
  const headerEnd = recordStart + 4 + view.getUint32(recordStart, true);
  if (headerEnd + 4 > view.byteLength) throw new RangeError('a header is damaged or cut short');
  const dataStart = headerEnd + 4;
  return { header: new DataView(view.buffer, view.byteOffset + recordStart + 4, headerEnd - recordStart - 4), dataStart, dataEnd: dataStart + view.getUint32(headerEnd, true) };
}

function* recordsIn(view: DataView): Generator<BagRecord> {
  for (let recordStart = 0; recordStart < view.byteLength; ) {
    const record = recordAt(view, recordStart);
    if (record.dataEnd > view.byteLength) throw new RangeError('a record is cut short');
    yield record;
    recordStart = record.dataEnd;
  }
}

class Rosbag extends MessageFile {
  readonly format = 'rosbag';

  /** Reads the index at the end of the bag. Returns false if the index is missing or damaged. */
  async readIndex(): Promise<boolean> {
    const { size } = this.source;
    try {
      const { header } = recordAt(dataViewOf(await readBytes(this.source, MAGIC_BYTES, MAGIC_BYTES + MAX_HEADER_BYTES)), 0);
      const [indexStart, chunkCount] = [readUint53(fieldOf(header, 'index_pos'), 0), uint32Of(header, 'chunk_count')];
      if (opcodeOf(header) !== BAG_OPCODE || indexStart === 0 || indexStart > size) return false;
      const bytes = await readBytes(this.source, indexStart, size);
      const view = dataViewOf(bytes);
      const chunks = [];
      for (const { header: recordHeader, dataStart, dataEnd } of recordsIn(view)) {
        const opcode = opcodeOf(recordHeader);
        if (opcode === CONNECTION_OPCODE) this.#addConnection(recordHeader, bytes.subarray(dataStart, dataEnd));
        if (opcode !== CHUNK_INFO_OPCODE) continue;
        const idsWithCounts = Array.from({ length: uint32Of(recordHeader, 'count') }, (_, i) => [0, 4].map((fieldOffset) => view.getUint32(dataStart + 8 * i + fieldOffset, true)));
        for (const [id, messageCount] of idsWithCounts) {
          const channel = this.channelsById.get(id);
          if (channel) channel.count += messageCount;
        }
        chunks.push({ position: readUint53(fieldOf(recordHeader, 'chunk_pos'), 0), ids: idsWithCounts.map(([id]) => id) });
      }
      if (chunks.length !== chunkCount) throw new RangeError('the index is incomplete');
      this.chunks = chunks;
      return true;
    } catch (error) {
      if (error instanceof LogError) throw error;
      this.channelsById.clear();
      return false;
    }
  }

  /** Adds the channel that a connection record describes. Both the header and the data of the record consist of fields. */
  #addConnection(header: DataView, connectionData: Uint8Array): void {
    const id = uint32Of(header, 'conn');
    if (this.channelsById.has(id)) return;
    this.channelsById.set(id, { topic: textOf(header, 'topic'), type: textOf(dataViewOf(connectionData), 'type'), encoding: 'ros1', count: 0 });
  }

  async readMessages(isWanted: IsWanted, onMessage: OnMessage, onBlock?: OnBlock): Promise<void> {
    const { size } = this.source;
    const readBytesAt = createAheadReader(this.source);
    const readBlock = async (recordStart: number, setEnd: (end: number) => void) => {
      const { header, dataStart, dataEnd } = recordAt(dataViewOf(await readBytesAt(recordStart, Math.min(recordStart + MAX_HEADER_BYTES, size))), 0);
      if (recordStart + dataEnd > size) throw new RangeError('a record is cut short');
      setEnd(recordStart + dataEnd);
      const opcode = opcodeOf(header);
      if (this.chunks && opcode !== CHUNK_OPCODE) throw new RangeError('no chunk is there');
      if (opcode === CONNECTION_OPCODE) this.#addConnection(header, await readBytesAt(recordStart + dataStart, recordStart + dataEnd));
      if (opcode !== CHUNK_OPCODE) return;
      const uncompressedBytes = uint32Of(header, 'size');
      if (Math.max(dataEnd, uncompressedBytes) > MAX_BLOCK_BYTES) throw new RangeError(`a chunk of ${uncompressedBytes} bytes`);
      this.#readRecords(await decompress(textOf(header, 'compression'), await readBytesAt(recordStart + dataStart, recordStart + dataEnd), uncompressedBytes), isWanted, onMessage);
    };
    await this.readBlocks(MAGIC_BYTES, isWanted, readBlock, onBlock);
  }

  #readRecords(bytes: Uint8Array, isWanted: IsWanted, onMessage: OnMessage): void {
    const block = dataViewOf(bytes);
    for (const { header, dataStart, dataEnd } of recordsIn(block)) {
      const opcode = opcodeOf(header);
      if (opcode === CONNECTION_OPCODE) this.#addConnection(header, bytes.subarray(dataStart, dataEnd));
      const channel = opcode === MESSAGE_OPCODE ? this.channelsById.get(uint32Of(header, 'conn')) : undefined;
      if (!channel || !isWanted(channel)) continue;
      const time = fieldOf(header, 'time');
      onMessage({ channel, time: time.getUint32(0, true) + time.getUint32(4, true) / 1e9, block, start: dataStart, end: dataEnd });
    }
  }
}

async function decompress(compression: string, bytes: Uint8Array, size: number): Promise<Uint8Array> {
  if (compression === 'none') return bytes;
  if (compression === 'lz4') return decompressLz4(bytes, size);
  if (compression !== 'bz2') throw new RangeError(`compression by ${compression}, not by bz2 or lz4`);
  const { default: bzip } = await import('@openpgp/seek-bzip');
  return bzip.decode(bytes, new Uint8Array(size));
}
