/** MCAP files, read piece by piece: which channels they have, and the messages on them. https://mcap.dev/spec */

import { McapIndexedReader, McapStreamReader } from '@mcap/core';
import { Ahead, PIECE } from './ahead.js';
import { breathing } from '../../../figure/breath.js';
import { messagesOf, recordsOf } from './chunk.js';
import { MAX_CHUNK, decompressors } from './decompress.js';
import { LogError, cut, reasonOf } from './refusal.js';

/**
 * @import { McapTypes } from '@mcap/core'
 * @import { Part } from './ahead.js'
 * @import { Watching } from '../../../figure/breath.js'
 * @import { Place, Source } from './refusal.js'
 *
 * @typedef {{ topic: string, type: string, encoding: string }} Channel
 *
 * @typedef {import('./chunk.js').Sent} Message
 *
 * @typedef {object} Recording
 * @property {Map<number, Channel>} channels by number: of a recording without an index, those that came so far
 * @property {Map<number, number> | undefined} counts of messages by channel, where they are told
 * @property {(isWanted: (topic: string) => boolean, each: (message: Message) => void, watching: Watching) => Promise<void>} read
 *   goes through the messages of topics
 * @property {boolean} cutShort whether it ended before its end, as far as it was read
 */

/** Bytes of what a recording says of itself at its end, at most. */
const MAX_SUMMARY = 2 ** 24;

/** Bytes of chunks that overlap in time, which the reader of an index holds all at once. */
const MAX_OVERLAP = 4 * MAX_CHUNK;

/** Messages between two looks at the clock. */
const MESSAGES_A_LOOK = 64;

/** Channels at most. */
const MAX_CHANNELS = 2 ** 16;

/**
 * Gives what a library throws a sentence.
 *
 * @param {Place} place
 * @param {unknown} error
 * @returns {unknown}
 */
function sentenceOf(place, error) {
  if (error instanceof LogError || (error instanceof DOMException && error.name === 'AbortError')) return error;
  const reason = reasonOf(error);
  const compression = /^Unsupported compression (.*)$/s.exec(reason);
  if (compression) return new LogError(place, (say) => say.compression(cut(compression[1])));
  return new LogError(place, (say) => say.damaged(reason));
}

/**
 * @param {Source} source
 * @returns {Promise<Recording>}
 */
export async function openRecording(source) {
  const place = { file: source.name };
  const handlers = await decompressors(place);
  return (await byIndex(source, handlers)) ?? fromStart(source, handlers);
}

/**
 * A recording by its index.
 *
 * @param {Source} source
 * @param {McapTypes.DecompressHandlers} decompressHandlers
 * @returns {Promise<Recording | undefined>} nothing where there is no index to be trusted
 */
async function byIndex(source, decompressHandlers) {
  const place = { file: source.name };
  const total = BigInt(source.size);
  let most = MAX_SUMMARY;
  const ahead = new Ahead(source);
  const readable = {
    size: async () => total,
    read: async (/** @type {bigint} */ offset, /** @type {bigint} */ length) => {
      if (length > BigInt(most)) throw new LogError(place, (say) => say.large('a record', `${length}`, most));
      if (offset < 0n || length < 0n || offset + length > total) throw new RangeError('it ends before what it refers to');
      return ahead.read(Number(offset), Number(offset + length));
    },
  };
  /** @type {McapIndexedReader} */
  let reader;
  try {
    reader = await McapIndexedReader.Initialize({ readable, decompressHandlers });
  } catch {
    // It may have lost its end, and be good up to there.
    return undefined;
  }
  if (!isSound(reader, total)) return undefined;
  most = MAX_CHUNK;
  const channels = new Map([...reader.channelsById.values()].map((channel) => [channel.id, channelOf(channel, reader.schemasById)]));
  const counts = reader.statistics && new Map([...reader.statistics.channelMessageCounts].map(([id, count]) => [id, Number(count)]));
  return {
    channels,
    counts,
    cutShort: false,
    async read(isWanted, each, watching) {
      const breathe = breathing(watching);
      const wanted = [...channels].filter(([, { topic }]) => isWanted(topic));
      const numbers = new Set(wanted.map(([id]) => id));
      const expected = wanted.reduce((sum, [id]) => sum + (counts?.get(id) ?? 0), 0) || 1;
      const chunks = chunksOf(reader, numbers);
      ahead.expect(partsOf(chunks, source.size));
      const topics = wanted.map(([, { topic }]) => topic);
      const messages = overlap(chunks) ? reader.readMessages({ topics }) : oneByOne(chunks, numbers, readable, decompressHandlers);
      let done = 0;
      try {
        for await (const some of messages) {
          for (const message of Array.isArray(some) ? some : [some]) {
            each(message);
            done += 1;
            if (done % MESSAGES_A_LOOK === 0) await breathe(Math.min(done / expected, 1));
          }
        }
      } catch (error) {
        throw sentenceOf(place, error);
      }
    },
  };
}

/**
 * The chunks in which there are messages of channels, by their times.
 *
 * @param {McapIndexedReader} reader
 * @param {ReadonlySet<number>} wanted channels
 */
function chunksOf({ chunkIndexes }, wanted) {
  const chunks = chunkIndexes.filter(({ messageIndexOffsets }) => [...messageIndexOffsets.keys()].some((id) => wanted.has(id)));
  return chunks.sort((one, other) => Number(one.messageStartTime - other.messageStartTime));
}

/**
 * Where chunks lie, each with the index behind it: the library's reader asks for that first.
 *
 * @param {McapTypes.ChunkIndex[]} chunks
 * @param {number} total bytes of the file
 * @returns {Part[]} of no more bytes each than may be held
 */
function partsOf(chunks, total) {
  const parts = chunks.map(({ chunkStartOffset, chunkLength, messageIndexLength }) => {
    const from = Number(chunkStartOffset);
    return /** @type {Part} */ ([from, from + Number(chunkLength + messageIndexLength)]);
  });
  return parts.filter(([from, to]) => to <= total && to - from <= MAX_CHUNK).sort(([one], [other]) => one - other);
}

/** Whether chunks overlap in time. @param {McapTypes.ChunkIndex[]} chunks by their times */
const overlap = (chunks) => chunks.some(({ messageStartTime }, i) => i > 0 && messageStartTime < chunks[i - 1].messageEndTime);

/**
 * The messages of channels, by their times, one chunk after the other. The library's reader of an index, which can put chunks together that
 * overlap, has each message copied and waited for: it takes twice as long.
 *
 * @param {McapTypes.ChunkIndex[]} chunks by their times
 * @param {ReadonlySet<number>} wanted channels
 * @param {McapTypes.IReadable} readable
 * @param {McapTypes.DecompressHandlers} decompressHandlers
 * @returns {AsyncGenerator<Message[], void>}
 */
async function* oneByOne(chunks, wanted, readable, decompressHandlers) {
  for (const { chunkStartOffset, chunkLength } of chunks) {
    const records = recordsOf(await readable.read(chunkStartOffset, chunkLength), decompressHandlers);
    const messages = messagesOf(records, wanted);
    yield messages.sort((one, other) => Number(one.logTime - other.logTime));
  }
}

/**
 * Whether an index can be gone by: all messages are in it, and it has no one read more than the file has, or hold much at once.
 *
 * @param {McapIndexedReader} reader
 * @param {bigint} total bytes of the file
 */
function isSound({ chunkIndexes, statistics }, total) {
  if (!statistics || chunkIndexes.length !== statistics.chunkCount) return false;
  // Messages outside of chunks are in no index.
  if (chunkIndexes.length === 0 && statistics.messageCount > 0n) return false;
  if (chunkIndexes.some((chunk) => chunk.messageIndexOffsets.size === 0 && chunk.messageEndTime > 0n)) return false;
  if (chunkIndexes.reduce((sum, { chunkLength }) => sum + chunkLength, 0n) > total) return false;
  const events = chunkIndexes.flatMap(({ messageStartTime, messageEndTime, uncompressedSize }) => [
    { time: messageStartTime, bytes: uncompressedSize },
    { time: messageEndTime + 1n, bytes: -uncompressedSize },
  ]);
  events.sort((a, b) => (a.time < b.time ? -1 : a.time > b.time ? 1 : 0));
  let [held, largest] = [0n, 0n];
  for (const { bytes } of events) {
    held += bytes;
    if (held > largest) largest = held;
  }
  return largest <= BigInt(MAX_OVERLAP);
}

/**
 * A recording from its start to its end, or as far as it goes.
 *
 * @param {Source} source
 * @param {McapTypes.DecompressHandlers} decompressHandlers
 * @returns {Recording}
 */
function fromStart(source, decompressHandlers) {
  const place = { file: source.name };
  /** @type {Recording} */
  const recording = {
    channels: new Map(),
    counts: undefined,
    cutShort: false,
    async read(isWanted, each, watching) {
      const breathe = breathing(watching);
      let seen = 0;
      // What comes then is the index.
      let isComplete = false;
      const reader = new McapStreamReader({ decompressHandlers });
      const ahead = new Ahead(source);
      const ends = (/** @type {number} */ from) => Math.min(from + PIECE, source.size);
      ahead.expect(Array.from({ length: Math.ceil(source.size / PIECE) }, (_, i) => [i * PIECE, ends(i * PIECE)]));
      /** @type {Map<number, McapTypes.TypedMcapRecords['Schema']>} */
      const schemas = new Map();
      try {
        for (let at = 0; at < source.size && !isComplete; at += PIECE) {
          const piece = await ahead.read(at, ends(at));
          if (piece.length === 0) break;
          reader.append(piece);
          for (let record = reader.nextRecord(); record; record = reader.nextRecord()) {
            isComplete = record.type === 'DataEnd';
            if (isComplete) break;
            if (record.type === 'Schema') schemas.set(record.id, record);
            if (record.type === 'Channel' && recording.channels.size < MAX_CHANNELS) recording.channels.set(record.id, channelOf(record, schemas));
            if (record.type !== 'Message') continue;
            const channel = recording.channels.get(record.channelId);
            if (channel && isWanted(channel.topic)) each(record);
            seen += 1;
            if (seen % MESSAGES_A_LOOK === 0) await breathe(at / source.size);
          }
          const waiting = reader.bytesRemaining();
          if (waiting > MAX_CHUNK) throw new LogError(place, (say) => say.large('a record', `more than ${waiting}`, MAX_CHUNK));
          await breathe(at / source.size);
        }
      } catch (error) {
        throw sentenceOf(place, error);
      }
      recording.cutShort = !isComplete;
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
