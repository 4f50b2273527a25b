/** Channels and messages of MCAP files. https://mcap.dev/spec */

import { McapIndexedReader, McapStreamReader } from '@mcap/core';
import { ZSTDDecoder } from 'zstddec';
import { LogError, bytesOf, cut, reasonOf } from './log-error.js';
import { unlz4 } from './lz4.js';

/**
 * @import { McapTypes } from '@mcap/core'
 * @import { Place } from './log-error.js'
 * @import { Source } from './log.ts'
 *
 * @typedef {{ topic: string, type: string, encoding: string }} Channel
 *
 * @typedef {Pick<McapTypes.TypedMcapRecords['Message'], 'channelId' | 'logTime' | 'data'>} Message
 *
 * @typedef {object} Recording
 * @property {Map<number, Channel>} channels by number; without an index, those that were read so far
 * @property {Map<number, number> | undefined} counts of messages by channel, from the index
 * @property {(isWanted: (topic: string) => boolean, each: (message: Message) => void, onProgress?: (share: number) => void) => Promise<void>} read
 *   passes on the messages of topics; rejects with a LogError
 * @property {boolean} cutShort whether the file breaks off, as far as it was read
 */

/** Most bytes of a chunk or record: recorders write chunks of one to four million. */
export const MAX_CHUNK = 2 ** 26;

/** Bytes that are read at once without an index. */
const PIECE = 2 ** 21;

/** Messages between two reports of progress. */
const MESSAGES = 2 ** 14;

/**
 * Opens a recording: by its index, or without one from its start as far as it goes.
 *
 * @param {Source} source
 * @returns {Promise<Recording>}
 */
export async function openRecording(source) {
  const decompressHandlers = await decompressors({ file: source.name });
  const size = BigInt(source.size);
  const readable = {
    size: async () => size,
    read: async (/** @type {bigint} */ offset, /** @type {bigint} */ length) => {
      if (offset + length > size) throw new RangeError('it ends before what it refers to');
      return bytesOf(source, Number(offset), Number(offset + length));
    },
  };
  const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers }).catch(() => undefined);
  return reader && isComplete(reader) ? byIndex(source, reader) : fromStart(source, new McapStreamReader({ decompressHandlers }));
}

/** Checks that an index has all chunks and messages. @param {McapIndexedReader} reader */
const isComplete = ({ chunkIndexes, statistics }) =>
  statistics?.chunkCount === chunkIndexes.length &&
  (chunkIndexes.length > 0 || statistics.messageCount === 0n) &&
  chunkIndexes.every(({ messageIndexOffsets, messageEndTime }) => messageIndexOffsets.size > 0 || messageEndTime === 0n);

/**
 * @param {Source} source
 * @param {McapIndexedReader} reader
 * @returns {Recording}
 */
function byIndex(source, reader) {
  const { channelsById, schemasById, statistics } = reader;
  const counts = new Map([...(statistics?.channelMessageCounts ?? [])].map(([id, count]) => [id, Number(count)]));
  return {
    channels: new Map([...channelsById].map(([id, channel]) => [id, channelOf(channel, schemasById)])),
    counts,
    cutShort: false,
    async read(isWanted, each, onProgress) {
      const wanted = [...channelsById.values()].filter(({ topic }) => isWanted(topic));
      const expected = wanted.reduce((sum, { id }) => sum + (counts.get(id) ?? 0), 0);
      let done = 0;
      await inSentences({ file: source.name }, async () => {
        for await (const message of reader.readMessages({ topics: wanted.map(({ topic }) => topic) })) {
          each(message);
          done += 1;
          if (done % MESSAGES > 0) continue;
          onProgress?.(Math.min(done / expected, 1));
        }
      });
    },
  };
}

/**
 * @param {Source} source
 * @param {McapStreamReader} reader
 * @returns {Recording} that can be read once
 */
function fromStart(source, reader) {
  const place = { file: source.name };
  /** @type {Map<number, McapTypes.TypedMcapRecords['Schema']>} */
  const schemas = new Map();
  /** @type {Recording} */
  const recording = {
    channels: new Map(),
    counts: undefined,
    cutShort: true,
    async read(isWanted, each, onProgress) {
      await inSentences(place, async () => {
        for (let at = 0; at < source.size; at += PIECE) {
          reader.append(await bytesOf(source, at, Math.min(at + PIECE, source.size)));
          onProgress?.(at / source.size);
          for (let record = reader.nextRecord(); record; record = reader.nextRecord()) {
            if (record.type === 'DataEnd') {
              recording.cutShort = false;
              return;
            }
            if (record.type === 'Schema') schemas.set(record.id, record);
            if (record.type === 'Channel') recording.channels.set(record.id, channelOf(record, schemas));
            if (record.type === 'Message' && isWanted(recording.channels.get(record.channelId)?.topic ?? '')) each(record);
          }
          const waiting = reader.bytesRemaining();
          if (waiting > MAX_CHUNK) throw new LogError(place, (say) => say.large('a record', `more than ${waiting}`, MAX_CHUNK));
        }
      });
    },
  };
  return recording;
}

/**
 * @param {McapTypes.Channel} channel
 * @param {ReadonlyMap<number, McapTypes.TypedMcapRecords['Schema']>} schemas
 * @returns {Channel}
 */
function channelOf({ topic, schemaId, messageEncoding }, schemas) {
  return { topic, type: schemas.get(schemaId)?.name ?? '', encoding: messageEncoding };
}

/** Turns errors of the library into a LogError. @param {Place} place @param {() => Promise<void>} work */
async function inSentences(place, work) {
  try {
    await work();
  } catch (error) {
    if (error instanceof LogError || (error instanceof DOMException && error.name === 'AbortError')) throw error;
    const reason = reasonOf(error);
    const compression = /^Unsupported compression (.*)$/s.exec(reason);
    throw new LogError(place, (say) => (compression ? say.compression(cut(compression[1])) : say.damaged(reason)));
  }
}

/**
 * @param {Place} place for errors
 * @returns {Promise<McapTypes.DecompressHandlers>}
 */
async function decompressors(place) {
  const zstd = new ZSTDDecoder();
  await zstd.init();
  /** @param {(bytes: Uint8Array, size: number) => Uint8Array} decompress */
  const bounded = (decompress) => (/** @type {Uint8Array} */ bytes, /** @type {bigint} */ announced) => {
    const size = Number(announced);
    if (size > MAX_CHUNK) throw new LogError(place, (say) => say.large('a chunk', `${announced}`, MAX_CHUNK));
    // For an announced size of 0 the decoder allocates what the frame says.
    const out = size === 0 ? new Uint8Array() : decompress(bytes, size);
    if (out.length !== size) throw new RangeError('a compressed chunk is not what was written');
    return out;
  };
  return { lz4: bounded(unlz4), zstd: bounded((bytes, size) => zstd.decode(bytes, size)) };
}
