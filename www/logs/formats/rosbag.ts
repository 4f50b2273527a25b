/** Connections and messages of ROS 1 bags. http://wiki.ros.org/Bags/Format/2.0 */

import { LogError, readBytes, type Source } from '../log.ts';
import { MAX_BLOCK_BYTES, MessageFile, dataViewOf, readAhead, uint53, type Container, type IsWanted, type OnBlock, type OnMessage } from './container.ts';
import { unlz4 } from './decompression.ts';

/** Values of the field "op" of records. */
const [MESSAGE, BAG, CHUNK, CHUNK_INFO, CONNECTION] = [2, 3, 5, 6, 7];

const MAGIC_BYTES = 13;

/** Maximum size of a record's header in bytes. The largest headers have the name of a topic. */
const MAX_HEADER_BYTES = 4096;

/** Opens a bag by its index. Without an index it is read from its start up to its end, or to a damaged length. */
export async function openRosbag(source: Source): Promise<Container> {
  const bag = new Rosbag(source);
  if (!(await bag.readIndex())) await bag.read(() => true, ({ channel }) => (channel.count += 1));
  return bag;
}

/** Fields of a record's header, which is a range of a block. Each field is "name=value" after its length. */
class HeaderFields {
  #view;
  #from;
  #to;

  constructor(view: DataView, from = 0, to = view.byteLength) {
    this.#view = view;
    this.#from = from;
    this.#to = to;
  }

  get op(): number {
    return this.#view.getUint8(this.#find('op').from);
  }

  uint32(name: string, at = 0): number {
    return this.#view.getUint32(this.#find(name).from + at, true);
  }

  uint64(name: string): number {
    return uint53(this.#view, this.#find(name).from);
  }

  text(name: string): string {
    const { from, to } = this.#find(name);
    return new TextDecoder().decode(new Uint8Array(this.#view.buffer, this.#view.byteOffset + from, to - from));
  }

  /** Returns the range of a field's value; throws a RangeError if there is no such field. */
  #find(name: string): { from: number; to: number } {
    const start = `${name}=`;
    for (let at = this.#from; at < this.#to; ) {
      const to = at + 4 + this.#view.getUint32(at, true);
      let matchingBytes = 0;
      while (matchingBytes < start.length && this.#view.getUint8(at + 4 + matchingBytes) === start.charCodeAt(matchingBytes)) matchingBytes += 1;
      if (matchingBytes === start.length) return { from: at + 4 + matchingBytes, to };
      at = to;
    }
    throw new RangeError(`a record has no field ${name}`);
  }
}

interface BagRecord { fields: HeaderFields; from: number; to: number }

/** Returns the header of a record, and the range of its data. Throws a RangeError if the view ends in the header. */
function recordAt(view: DataView, at: number): BagRecord {
  const headerEnd = at + 4 + view.getUint32(at, true);
  if (headerEnd + 4 > view.byteLength) throw new RangeError('a header is damaged or cut short');
  const from = headerEnd + 4;
  return { fields: new HeaderFields(view, at + 4, headerEnd), from, to: from + view.getUint32(headerEnd, true) };
}

function* recordsIn(view: DataView): Generator<BagRecord> {
  for (let at = 0; at < view.byteLength; ) {
    const record = recordAt(view, at);
    if (record.to > view.byteLength) throw new RangeError('a record is cut short');
    yield record;
    at = record.to;
  }
}

class Rosbag extends MessageFile<number> {
  readonly format = 'rosbag';

  /** Reads the index at the end, and returns false if there is none or it is damaged. */
  async readIndex(): Promise<boolean> {
    const { size } = this.source;
    try {
      const { fields } = recordAt(dataViewOf(await readBytes(this.source, MAGIC_BYTES, MAGIC_BYTES + MAX_HEADER_BYTES)), 0);
      const [start, count] = [fields.uint64('index_pos'), fields.uint32('chunk_count')];
      if (fields.op !== BAG || start === 0 || start > size) return false;
      const bytes = await readBytes(this.source, start, size);
      const view = dataViewOf(bytes);
      const chunks = [];
      for (const { fields, from, to } of recordsIn(view)) {
        if (fields.op === CONNECTION) this.#addConnection(fields, bytes.subarray(from, to));
        if (fields.op !== CHUNK_INFO) continue;
        const idsWithCounts = Array.from({ length: fields.uint32('count') }, (_, i) => [0, 4].map((part) => view.getUint32(from + 8 * i + part, true)));
        for (const [id, messages] of idsWithCounts) {
          const channel = this.channelsById.get(id);
          if (channel) channel.count += messages;
        }
        chunks.push({ position: fields.uint64('chunk_pos'), ids: idsWithCounts.map(([id]) => id) });
      }
      if (chunks.length !== count) throw new RangeError('the index is incomplete');
      this.chunks = chunks;
      return true;
    } catch (error) {
      if (error instanceof LogError) throw error;
      this.channelsById.clear();
      return false;
    }
  }

  /** Adds the channel of a connection. The data of its record has fields, too. */
  #addConnection(fields: HeaderFields, data: Uint8Array): void {
    const id = fields.uint32('conn');
    if (this.channelsById.has(id)) return;
    this.channelsById.set(id, { topic: fields.text('topic'), type: new HeaderFields(dataViewOf(data)).text('type'), encoding: 'ros1', count: 0 });
  }

  async read(isWanted: IsWanted, onMessage: OnMessage, onBlock?: OnBlock): Promise<void> {
    const { size } = this.source;
    const readBytesAt = readAhead(this.source);
    const readBlock = async (at: number, setEnd: (end: number) => void) => {
      const { fields, from, to } = recordAt(dataViewOf(await readBytesAt(at, Math.min(at + MAX_HEADER_BYTES, size))), 0);
      if (at + to > size) throw new RangeError('a record is cut short');
      setEnd(at + to);
      const { op } = fields;
      if (this.chunks && op !== CHUNK) throw new RangeError('no chunk is there');
      if (op === CONNECTION) this.#addConnection(fields, await readBytesAt(at + from, at + to));
      if (op !== CHUNK) return;
      const uncompressedBytes = fields.uint32('size');
      if (Math.max(to, uncompressedBytes) > MAX_BLOCK_BYTES) throw new RangeError(`a chunk of ${uncompressedBytes} bytes`);
      this.#readRecords(await decompress(fields.text('compression'), await readBytesAt(at + from, at + to), uncompressedBytes), isWanted, onMessage);
    };
    await this.readBlocks(MAGIC_BYTES, isWanted, readBlock, onBlock);
  }

  #readRecords(bytes: Uint8Array, isWanted: IsWanted, onMessage: OnMessage): void {
    const block = dataViewOf(bytes);
    for (const { fields, from, to } of recordsIn(block)) {
      const { op } = fields;
      if (op === CONNECTION) this.#addConnection(fields, bytes.subarray(from, to));
      const channel = op === MESSAGE ? this.channelsById.get(fields.uint32('conn')) : undefined;
      if (channel && isWanted(channel)) onMessage({ channel, time: fields.uint32('time') + fields.uint32('time', 4) / 1e9, block, from, to });
    }
  }
}

async function decompress(compression: string, bytes: Uint8Array, size: number): Promise<Uint8Array> {
  if (compression === 'none') return bytes;
  if (compression === 'lz4') return unlz4(bytes, size);
  if (compression !== 'bz2') throw new RangeError(`compression by ${compression}, not by bz2 or lz4`);
  const { default: bzip } = await import('@openpgp/seek-bzip');
  return bzip.decode(bytes, new Uint8Array(size));
}
