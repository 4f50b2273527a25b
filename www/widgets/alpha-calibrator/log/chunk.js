/** A chunk of an MCAP file, and the messages in it. https://mcap.dev/spec */

import { crc32 } from '@foxglove/crc';

/**
 * @import { McapTypes } from '@mcap/core'
 *
 * @typedef {{ channelId: number, logTime: bigint, data: Uint8Array }} Sent a message: its data is a part of the chunk
 */

/** What records begin with. */
const [SCHEMA, CHANNEL, MESSAGE, CHUNK] = [3, 4, 5, 6];

/** Of the numbers of those that MCAP has; greater ones are anybody's. */
const LAST = 0x0f;

/** Bytes: what a record is and how long; what a message has before its data, and a chunk before the name of its compression. */
const [PREFIX, BEFORE_DATA, BEFORE_NAME] = [9, 22, 28];

/** @param {Uint8Array} bytes */
const viewOf = ({ buffer, byteOffset, byteLength }) => new DataView(buffer, byteOffset, byteLength);

/** A length, as far as numbers go. @param {DataView} view @param {number} at */
const lengthAt = (view, at) => Number(view.getBigUint64(at, true));

/**
 * The records of a chunk, decompressed.
 *
 * @param {Uint8Array} bytes of it
 * @param {McapTypes.DecompressHandlers} decompressHandlers
 * @returns {Uint8Array}
 * @throws {Error} where it is none, or damaged
 */
export function recordsOf(bytes, decompressHandlers) {
  const view = viewOf(bytes);
  if (view.getUint8(0) !== CHUNK || PREFIX + lengthAt(view, 1) !== bytes.length) throw new RangeError('there is no chunk where the index has one');
  const [size, checksum] = [view.getBigUint64(PREFIX + 16, true), view.getUint32(PREFIX + 24, true)];
  const named = PREFIX + BEFORE_NAME + 4;
  const counted = named + view.getUint32(named - 4, true);
  const compression = new TextDecoder().decode(bytes.subarray(named, counted));
  const from = counted + 8;
  const packed = bytes.subarray(from, from + lengthAt(view, counted));
  const decompress = decompressHandlers[compression];
  if (compression !== '' && !decompress) throw new Error(`Unsupported compression ${compression}`);
  const records = compression === '' || packed.length === 0 ? packed : decompress(packed, size);
  if (checksum !== 0 && crc32(records) !== checksum) throw new Error(`Incorrect chunk CRC, expected ${checksum}`);
  return records;
}

/**
 * The messages of channels in the records of a chunk.
 *
 * @param {Uint8Array} records
 * @param {ReadonlySet<number>} wanted channels
 * @returns {Sent[]}
 * @throws {RangeError} where one ends after the chunk, or has no place in one
 */
export function messagesOf(records, wanted) {
  const view = viewOf(records);
  const messages = [];
  for (let at = 0; at < records.length;) {
    const kind = view.getUint8(at);
    const from = at + PREFIX;
    at = from + lengthAt(view, at + 1);
    if (at > records.length) throw new RangeError('a record ends after its chunk');
    if (kind === MESSAGE) {
      const channelId = view.getUint16(from, true);
      if (at < from + BEFORE_DATA) throw new RangeError('a message ends before its data');
      if (wanted.has(channelId)) messages.push({ channelId, logTime: view.getBigUint64(from + 6, true), data: records.subarray(from + BEFORE_DATA, at) });
    } else if (kind <= LAST && kind !== SCHEMA && kind !== CHANNEL) throw new RangeError(`a record of kind ${kind} is in a chunk`);
  }
  return messages;
}
