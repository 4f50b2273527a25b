/** MCAP recordings of ROS 2, read piece by piece: https://mcap.dev/spec. Loaded when the first one is opened. */

import { McapIndexedReader, McapStreamReader } from '@mcap/core';
import { breathing } from './breath.js';
import { MAX_CHUNK, decompressors } from './decompress.js';
import { Frames } from './frames.js';
import { KINDS, edgeReader, poseReader } from './messages.js';
import { LogError, bytesOf, cut, listed, reasonOf } from './refusal.js';
import { Rows } from './rows.js';

/**
 * @import { McapTypes } from '@mcap/core'
 * @import { Watching } from './breath.js'
 * @import { Reading } from './messages.js'
 * @import { Topic } from './read.js'
 * @import { Place, Source } from './refusal.js'
 * @import { How, Log } from './rows.js'
 *
 * @typedef {{ topic: string, type: string, encoding: string }} Channel
 *
 * @typedef {object} Recording
 * @property {Map<number, Channel>} channels by number: of a recording without an index, those that came so far
 * @property {Map<number, number> | undefined} counts of messages by channel, where they are told
 * @property {(isWanted: (topic: string) => boolean, each: (message: McapTypes.TypedMcapRecords['Message']) => void, watching: Watching) => Promise<void>} read
 *   goes through the messages of topics
 * @property {boolean} cutShort whether it ended before its end, as far as it was read
 */

/** Bytes of what a recording says of itself at its end, at most. */
const MAX_SUMMARY = 2 ** 24;

/** Bytes of chunks that overlap in time, which the reader of an index holds all at once. */
const MAX_OVERLAP = 4 * MAX_CHUNK;

/** Bytes that are read at once. */
const PIECE = 2 ** 20;

/** Messages between two looks at the clock. */
const MESSAGES_A_LOOK = 64;

/** Messages of transforms that are looked at to tell which frames there are. */
const MESSAGES_OF_FRAMES = 1000;

/** Channels at most. */
const MAX_CHANNELS = 2 ** 16;

/** A recorder puts what never changes into a topic of this name. */
const STATIC = /(^|\/)tf_static$/;

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
async function open(source) {
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
  const ahead = readingAhead(source);
  const readable = {
    size: async () => total,
    read: async (/** @type {bigint} */ offset, /** @type {bigint} */ length) => {
      if (length > BigInt(most)) throw new LogError(place, (say) => say.large('a record', `${length}`, most));
      if (offset < 0n || length < 0n || offset + length > total) throw new RangeError('it ends before what it refers to');
      return ahead(Number(offset), Number(offset + length));
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
      const topics = [...channels.values()].map(({ topic }) => topic).filter(isWanted);
      const expected = Number(reader.statistics?.messageCount ?? 0) || 1;
      let done = 0;
      try {
        for await (const message of reader.readMessages({ topics })) {
          each(message);
          done += 1;
          if (done % MESSAGES_A_LOOK === 0) await breathe(Math.min(done / expected, 1));
        }
      } catch (error) {
        throw sentenceOf(place, error);
      }
    },
  };
}

/**
 * Chunks lie one behind the other, and to ask for a few bytes takes a browser as long as for a million.
 *
 * @param {Source} source
 * @returns {(from: number, to: number) => Promise<Uint8Array<ArrayBuffer>>}
 */
function readingAhead(source) {
  let [start, bytes] = [0, new Uint8Array()];
  return async (from, to) => {
    if (from < start || to > start + bytes.length) {
      [start, bytes] = [from, await bytesOf(source, from, Math.min(Math.max(to, from + PIECE), source.size))];
    }
    return bytes.subarray(from - start, to - start);
  };
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
      /** @type {Map<number, McapTypes.TypedMcapRecords['Schema']>} */
      const schemas = new Map();
      try {
        for (let at = 0; at < source.size && !isComplete; at += PIECE) {
          const piece = await bytesOf(source, at, Math.min(at + PIECE, source.size));
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

/** @param {string} type */
const kindOf = (type) => (Object.hasOwn(KINDS, type) ? KINDS[type].kind : null);

/**
 * @param {Source} source
 * @param {Watching} watching
 * @returns {Promise<Topic[]>}
 */
export async function listTopics(source, watching) {
  const recording = await open(source);
  let { counts } = recording;
  if (!counts) {
    const counted = new Map();
    await recording.read(() => true, ({ channelId }) => counted.set(channelId, (counted.get(channelId) ?? 0) + 1), watching);
    counts = counted;
  }
  /** @type {Map<string, Topic>} */
  const topics = new Map();
  for (const [id, { topic, type }] of recording.channels) {
    const known = topics.get(topic);
    const count = (known?.count ?? 0) + (counts.get(id) ?? 0);
    topics.set(topic, { name: topic, type, count, kind: kindOf(type) });
  }
  return [...topics.values()].sort((a, b) => (a.name < b.name ? -1 : 1));
}

/**
 * @param {Source} source
 * @param {{ kind?: 'poses' | 'commands', topic: string, frames?: { parent: string, child: string } }} choice
 * @param {Watching} watching
 * @returns {Promise<Log>} rejects with a LogError
 */
export async function readRecording(source, { kind: wanted, topic, frames }, watching) {
  const place = { file: source.name, topic };
  const recording = await open(source);
  const rows = new Rows(place);
  let [number, isStamped] = [0, false];
  let type = '';
  /** @type {Frames | undefined} */
  let tree;
  /** @type {Map<number, (data: Uint8Array, add: (reading: Reading) => void) => void>} */
  const readers = new Map();

  /** @param {number} id @returns {(data: Uint8Array, add: (reading: Reading) => void) => void} */
  const prepare = (id) => {
    const channel = /** @type {Channel} */ (recording.channels.get(id));
    const kind = kindOf(channel.type);
    const isWanted = kind !== null && (!wanted || (kind === 'commands') === (wanted === 'commands'));
    if (!isWanted) throw new LogError(place, (say) => say.type(cut(channel.type), wanted ?? 'either'));
    if (channel.encoding !== 'cdr') throw new LogError(place, (say) => say.encoding(cut(channel.encoding)));
    if (kind !== 'transforms') {
      const read = poseReader(channel.type);
      type = channel.type;
      return (data, add) => add(read(data));
    }
    if (channel.topic === topic) type = channel.type;
    tree ??= new Frames(frames ?? { parent: '', child: '' });
    const [links, read, isStatic] = [tree, edgeReader(), STATIC.test(channel.topic)];
    return (data, add) => {
      for (const edge of read(data)) {
        const reading = links.take(edge, isStatic);
        if (reading && frames) add(reading);
      }
      // By then, those that come at all have come.
      if (!frames && number >= MESSAGES_OF_FRAMES) throw unchosen();
    };
  };

  const unchosen = () => new LogError(place, (say) => say.frames(listed(tree?.known ?? [])));

  const isThere = () => [...recording.channels.values()].some((each) => each.topic === topic);
  if (recording.channels.size && !isThere()) throw noTopic(place, recording);
  await recording.read(
    (each) => each === topic || (frames !== undefined && STATIC.test(each)),
    ({ channelId, data, logTime }) => {
      let read = readers.get(channelId);
      if (!read) readers.set(channelId, (read = prepare(channelId)));
      number += 1;
      try {
        read(data, ({ stamp, a, b, c, isRotation }) => {
          const hasStamp = stamp !== undefined && (stamp.sec !== 0 || stamp.nanosec !== 0);
          isStamped ||= hasStamp;
          const [seconds, rest] = hasStamp ? [stamp.sec, stamp.nanosec / 1e9] : [Number(logTime / 1_000_000_000n), Number(logTime % 1_000_000_000n) / 1e9];
          if (isRotation) rows.add(seconds, rest, a, b, c, number);
          else rows.leaveOut('noRotation', number);
        });
      } catch (error) {
        if (error instanceof LogError) throw error;
        throw new LogError(place, (say) => say.message(number, reasonOf(error)));
      }
    },
    watching,
  );
  if (!isThere()) throw noTopic(place, recording);
  if (number === 0) throw new LogError(place, (say) => say.noMessages);
  if (tree && !frames) throw unchosen();
  if (tree && frames && rows.count === 0) {
    const { parent, child } = frames;
    throw new LogError(place, (say) => say.noChain(`${cut(parent)},${cut(child)}`, listed(tree?.known ?? [])));
  }
  const kind = kindOf(type) === 'commands' ? 'commands' : 'poses';
  /** @type {How} */
  const how = {
    format: 'mcap',
    unit: 'ns',
    unitBy: 'format',
    heading: kind === 'poses' ? 'quaternion' : 'none',
    columns: { type, clock: isStamped ? 'header.stamp' : 'log time' },
    cutShort: recording.cutShort,
  };
  return rows.end(`${source.name}, ${topic}`, kind, how, breathing(watching));
}

/** @param {Place} place @param {Recording} recording */
function noTopic(place, { channels }) {
  return new LogError(place, (say) => say.noTopic(listed([...new Set([...channels.values()].map(({ topic }) => topic))])));
}
