/** Connections and messages of ROS 1 bags. http://wiki.ros.org/Bags/Format/2.0 */

import { LogError, readBytes, type Source } from '../log.ts';
import { MAX_BLOCK_BYTES, MessageFile, readAhead, dataViewOf, uint53, type Container, type IsWanted, type OnBlock, type OnMessage } from './container.ts';
import { unlz4 } from './decompression.ts';

/** Values of the field "op" of records. */
const [MESSAGE, BAG, CHUNK, CHUNK_INFO, CONNECTION] = [2, 3, 5, 6, 7];

const MAGIC_BYTES = 13;

/** Number of bytes of a header that are read at first. Headers with a long topic are longer. */
const HEADER_BYTES = 4096;

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

  /** Returns a field; throws a RangeError if there is none, as the methods below do. */
  text(name: string): string {
    const [from, to] = this.#range(name);
    return new TextDecoder().decode(new Uint8Array(this.#view.buffer, this.#view.byteOffset + from, to - from));
  }

  byte(name: string): number {
    return this.#view.getUint8(this.#range(name)[0]);
  }

  uint32(name: string, at = 0): number {
    return this.#view.getUint32(this.#range(name)[0] + at, true);
  }

  uint64(name: string): number {
    return uint53(this.#view, this.#range(name)[0]);
  }

  /** Returns start and end of the value of a field. */
  #range(name: string): [number, number] {
    const view = this.#view;
    for (let at = this.#from, end; at < this.#to; at = end) {
      end = at + 4 + view.getUint32(at, true);
      const equalsSign = at + 4 + name.length;
      if (equalsSign >= end || view.getUint8(equalsSign) !== 0x3d) continue;
      let matchingBytes = 0;
      while (matchingBytes < name.length && view.getUint8(at + 4 + matchingBytes) === name.charCodeAt(matchingBytes)) matchingBytes += 1;
      if (matchingBytes === name.length) return [equalsSign + 1, end];
    }
    throw new RangeError(`a record has no field ${name}`);
  }
}

/** Returns the header of a record and the range of its data, which ends at the next record. Throws a RangeError if it is cut short. */
function recordAt(view: DataView, at: number): { fields: HeaderFields; from: number; next: number } {
  const headerEnd = at + 4 + view.getUint32(at, true);
  const nextRecord = headerEnd + 4 + view.getUint32(headerEnd, true);
  if (nextRecord > view.byteLength) throw new RangeError('a record is cut short');
  return { fields: new HeaderFields(view, at + 4, headerEnd), from: headerEnd + 4, next: nextRecord };
}

class Rosbag extends MessageFile<number> implements Container {
  readonly format = 'rosbag';
  /** Chunks of the index, each with the ids of its connections. */
  #chunks: { position: number; connections: number[] }[] | undefined;

  /** Reads the index at the end, and returns false if there is none or it is damaged. */
  async readIndex(): Promise<boolean> {
    const { size } = this.source;
    try {
      const { fields } = recordAt(dataViewOf(await readBytes(this.source, MAGIC_BYTES, MAGIC_BYTES + HEADER_BYTES)), 0);
      const [start, count] = [fields.uint64('index_pos'), fields.uint32('chunk_count')];
      if (fields.byte('op') !== BAG || start === 0 || start > size) return false;
      const bytes = await readBytes(this.source, start, size);
      const view = dataViewOf(bytes);
      const chunks = [];
      for (let at = 0; at < bytes.length; ) {
        const { fields, from, next } = recordAt(view, at);
        if (fields.byte('op') === CONNECTION) this.#addConnection(fields, bytes.subarray(from, next));
        if (fields.byte('op') === CHUNK_INFO) {
          const idsWithCounts = Array.from({ length: fields.uint32('count') }, (_, i) => [0, 4].map((part) => view.getUint32(from + 8 * i + part, true)));
          for (const [id, messages] of idsWithCounts) {
            const channel = this.channelsById.get(id);
            if (channel) channel.count += messages;
          }
          chunks.push({ position: fields.uint64('chunk_pos'), connections: idsWithCounts.map(([id]) => id) });
        }
        at = next;
      }
      if (chunks.length !== count) throw new RangeError('the index is incomplete');
      this.#chunks = chunks;
      return true;
    } catch (error) {
      if (error instanceof LogError) throw error;
      this.channelsById.clear();
      return false;
    }
  }

  #addConnection(fields: HeaderFields, data: Uint8Array): void {
    const id = fields.uint32('conn');
    if (this.channelsById.has(id)) return;
    this.channelsById.set(id, { topic: fields.text('topic'), type: new HeaderFields(dataViewOf(data)).text('type'), encoding: 'ros1', count: 0 });
  }

  async read(isWanted: IsWanted, onMessage: OnMessage, onProgress?: OnBlock): Promise<void> {
    const { size } = this.source;
    const readBytesAt = readAhead(this.source);
    const wantedIds = new Set([...this.channelsById].filter(([, channel]) => isWanted(channel)).map(([id]) => id));
    const wantedChunks = this.#chunks?.filter(({ connections }) => connections.some((id) => wantedIds.has(id)));
    const readBlock = async (at: number, setEnd: (end: number) => void) => {
      let recordHead = await readBytesAt(at, Math.min(at + HEADER_BYTES, size));
      const headerLength = dataViewOf(recordHead).getUint32(0, true);
      if (headerLength > MAX_BLOCK_BYTES || at + headerLength + 8 > size) throw new RangeError('a header is damaged or cut short');
      if (headerLength + 8 > recordHead.length) recordHead = await readBytesAt(at, Math.min(at + headerLength + 8, size));
      const from = at + 8 + headerLength;
      const end = from + dataViewOf(recordHead).getUint32(4 + headerLength, true);
      if (end > size) throw new RangeError('a record is cut short');
      setEnd(end);
      const fields = new HeaderFields(dataViewOf(recordHead), 4, 4 + headerLength);
      const op = fields.byte('op');
      if (op === CONNECTION) this.#addConnection(fields, await readBytesAt(from, end));
      if (op === CHUNK) {
        if (Math.max(end - from, fields.uint32('size')) > MAX_BLOCK_BYTES) throw new RangeError(`a chunk of ${fields.uint32('size')} bytes`);
        await this.#readChunk(fields, await readBytesAt(from, end), isWanted, onMessage);
      } else if (wantedChunks) throw new RangeError('no chunk is there');
    };
    await this.readBlocks(wantedChunks?.map(({ position }) => position), MAGIC_BYTES, readBlock, onProgress);
  }

  async #readChunk(chunk: HeaderFields, compressed: Uint8Array, isWanted: IsWanted, onMessage: OnMessage): Promise<void> {
    const bytes = await this.#decompress(chunk.text('compression'), compressed, chunk.uint32('size'));
    const view = dataViewOf(bytes);
    for (let at = 0; at < bytes.length; ) {
      const { fields, from, next } = recordAt(view, at);
      const op = fields.byte('op');
      if (op === CONNECTION) this.#addConnection(fields, bytes.subarray(from, next));
      if (op === MESSAGE) {
        const channel = this.channelsById.get(fields.uint32('conn'));
        if (channel && isWanted(channel)) onMessage({ channel, time: fields.uint32('time') + fields.uint32('time', 4) / 1e9, block: view, from, to: next });
      }
      at = next;
    }
  }

  async #decompress(compression: string, bytes: Uint8Array, size: number): Promise<Uint8Array> {
    if (compression === 'none') return bytes;
    if (compression === 'lz4') return unlz4(bytes, size);
    if (compression !== 'bz2') throw new RangeError(`compression by ${compression}, not by bz2 or lz4`);
    const { default: bzip } = await import('@openpgp/seek-bzip');
    return bzip.decode(bytes, new Uint8Array(size));
  }
}
