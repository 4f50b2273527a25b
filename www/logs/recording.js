/** Logs of MCAP recordings of ROS 2. Loaded when the first one is opened. */

import { Frames } from './frames.js';
import { LogError, cut, listed, reasonOf } from './log-error.js';
import { openRecording } from './mcap.js';
import { KINDS, edgeReader, poseReader } from './messages.js';
import { LOG_TIME } from './log.ts';
import { Rows } from './rows.ts';

/**
 * @import { Choice, Log, Series, Source } from './log.ts'
 * @import { Words } from './log-error.js'
 * @import { Channel, Message, Recording } from './mcap.js'
 * @import { Reading } from './messages.js'
 */

/** Messages of transforms after which all frames are taken to be known. */
const MESSAGES_OF_FRAMES = 1000;

/** Name of a recorder's topic of transforms that never change. */
const STATIC = /(^|\/)tf_static$/;

/** @param {string} type */
const kindOf = (type) => (Object.hasOwn(KINDS, type) ? KINDS[type].kind : null);

/**
 * Lists the topics.
 *
 * @param {Source} source
 * @returns {Promise<Series[]>}
 */
export async function listTopics(source) {
  const recording = await openRecording(source);
  /** @type {Map<number, number>} */
  const counts = recording.counts ?? new Map();
  const count = (/** @type {Message} */ { channelId }) => counts.set(channelId, (counts.get(channelId) ?? 0) + 1);
  if (!recording.counts) await recording.read(() => true, count);
  /** @type {Map<string, Series>} */
  const topics = new Map();
  for (const [id, { topic, type }] of recording.channels) {
    const count = (topics.get(topic)?.count ?? 0) + (counts.get(id) ?? 0);
    topics.set(topic, { name: topic, type, count, kind: kindOf(type) });
  }
  return [...topics.values()].sort((a, b) => (a.name < b.name ? -1 : 1));
}

/**
 * Reads several logs in one pass.
 *
 * @param {Source} source
 * @param {Choice[]} choices
 * @param {(share: number) => void} [onProgress]
 * @returns {Promise<Log[]>} one for each choice; rejects with a LogError
 */
export async function readRecording(source, choices, onProgress) {
  const recording = await openRecording(source);
  const topics = choices.map((choice) => new TopicReader(source.name, recording, choice));
  if (recording.counts) for (const topic of topics) topic.checkPresence();
  await recording.read(
    (name) => topics.some((topic) => topic.wants(name)),
    (message) => {
      const channel = /** @type {Channel} */ (recording.channels.get(message.channelId));
      for (const topic of topics) if (topic.wants(channel.topic)) topic.take(message, channel);
    },
    onProgress,
  );
  return topics.map((topic) => topic.end());
}

/** Reader of one topic; of a topic of transforms, also of the static ones. */
class TopicReader {
  #file;
  #topic;
  #recording;
  #choice;
  /** Rows by the stamps of the headers, and by the times of recording. */
  #rows;
  /** Messages so far. */
  #number = 0;
  #type = '';
  /** @type {Frames | undefined} */
  #frames;
  /** Readers by channel. @type {Map<number, (message: Message) => void>} */
  #readers = new Map();

  /** @param {string} file @param {Recording} recording @param {Choice} choice */
  constructor(file, recording, choice) {
    this.#file = file;
    this.#topic = choice.series;
    this.#recording = recording;
    this.#choice = choice;
    this.#rows = new Rows({ file, topic: this.#topic });
  }

  /** @param {string} topic */
  wants(topic) {
    return topic === this.#topic || (this.#choice.frames !== undefined && STATIC.test(topic));
  }

  /** @throws {LogError} if the recording has no such topic */
  checkPresence() {
    const topics = new Set([...this.#recording.channels.values()].map(({ topic }) => topic));
    if (!topics.has(this.#topic)) this.#refuse((say) => say.noTopic(listed([...topics])));
  }

  /** @param {Message} message @param {Channel} channel @throws {LogError} */
  take(message, channel) {
    let read = this.#readers.get(message.channelId);
    if (!read) this.#readers.set(message.channelId, (read = this.#readerOf(channel)));
    this.#number += 1;
    try {
      read(message);
    } catch (error) {
      if (error instanceof LogError) throw error;
      this.#refuse((say) => say.message(this.#number, reasonOf(error)));
    }
  }

  /** @param {Channel} channel @returns {(message: Message) => void} */
  #readerOf({ topic, type, encoding }) {
    const { kind: wanted, frames } = this.#choice;
    const kind = kindOf(type);
    if (frames && kind !== 'transforms') this.#refuse((say) => say.type(cut(type), 'transforms'));
    if (kind === null || (wanted === 'poses' && kind === 'commands')) {
      this.#refuse((say) => say.type(cut(type), wanted === 'poses' ? wanted : 'either'));
    }
    if (encoding !== 'cdr') this.#refuse((say) => say.encoding(cut(encoding)));
    if (topic === this.#topic) this.#type = type;
    if (kind !== 'transforms') {
      const read = poseReader(type);
      return ({ data, logTime }) => this.#add(read(data), logTime);
    }
    this.#frames ??= new Frames(frames ?? { parent: '', child: '' });
    const [tree, read, isStatic] = [this.#frames, edgeReader(), STATIC.test(topic)];
    return ({ data, logTime }) => {
      for (const edge of read(data)) {
        const reading = tree.take(edge, isStatic);
        if (reading && frames) this.#add(reading, logTime);
      }
      if (!frames && this.#number >= MESSAGES_OF_FRAMES) this.#refuseWithoutFrames(tree);
    };
  }

  /** @param {Reading} reading @param {bigint} logTime in nanoseconds */
  #add({ stamp, a, b, c, isRotation }, logTime) {
    const { sec, nanosec } = stamp ?? { sec: 0, nanosec: 0 };
    const number = this.#number;
    if (!isRotation) return this.#rows.leaveOut('noRotation', number);
    this.#rows.add(sec, nanosec / 1e9, a, b, c, number, Number(logTime / 1_000_000_000n), Number(logTime % 1_000_000_000n) / 1e9);
  }

  /** @returns {Log} @throws {LogError} if the messages are no log */
  end() {
    this.checkPresence();
    if (this.#number === 0) this.#refuse((say) => say.noMessages);
    const { frames } = this.#choice;
    const tree = this.#frames;
    if (tree && !frames) this.#refuseWithoutFrames(tree);
    if (tree && frames && this.#rows.count === 0) {
      this.#refuse((say) => say.noChain(`${cut(frames.parent)},${cut(frames.child)}`, listed(tree.known)));
    }
    const kind = kindOf(this.#type) === 'commands' ? 'commands' : 'poses';
    const chain = frames ? ` (${frames.parent} to ${frames.child})` : '';
    return this.#rows.end(`${this.#file}, ${this.#topic}${chain}`, kind, {
      units: { time: { unit: 'ns', by: 'format' }, length: { unit: 'm', by: 'format' }, angle: { unit: kind === 'poses' ? 'quaternion' : 'none', by: 'format' } },
      clocks: ['header.stamp', LOG_TIME],
      ...(frames && { frames }),
      notes: this.#recording.cutShort ? [{ name: 'cutShort', values: [] }] : [],
    });
  }

  /** @param {Frames} tree @returns {never} */
  #refuseWithoutFrames({ known }) {
    this.#refuse((say) => say.frames(listed(known)));
  }

  /** @param {(say: Words['refused']) => string} reason @returns {never} */
  #refuse(reason) {
    throw new LogError({ file: this.#file, topic: this.#topic }, reason);
  }
}
