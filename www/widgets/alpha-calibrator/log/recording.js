/** Logs of MCAP recordings of ROS 2. Loaded when the first one is opened. */

import { breathing } from '../../../figure/breath.js';
import { Frames } from './frames.js';
import { openRecording } from './mcap.js';
import { KINDS, edgeReader, poseReader } from './messages.js';
import { LogError, cut, listed, reasonOf } from './refusal.js';
import { LOG_TIME, Rows } from './rows.js';

/**
 * @import { Watching } from '../../../figure/breath.js'
 * @import { Channel, Message, Recording } from './mcap.js'
 * @import { Reading } from './messages.js'
 * @import { Choice, Topic } from './read.js'
 * @import { Place, Source } from './refusal.js'
 * @import { How, Log } from './rows.js'
 */

/** Messages of transforms that are looked at to tell which frames there are. */
const MESSAGES_OF_FRAMES = 1000;

/** A recorder puts what never changes into a topic of this name. */
const STATIC = /(^|\/)tf_static$/;

/** @param {string} type */
const kindOf = (type) => (Object.hasOwn(KINDS, type) ? KINDS[type].kind : null);

/**
 * @param {Source} source
 * @param {Watching} watching
 * @returns {Promise<Topic[]>}
 */
export async function listTopics(source, watching) {
  const recording = await openRecording(source);
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
 * @param {Choice[]} choices
 * @param {Watching} watching
 * @returns {Promise<Log[]>} one a choice; rejects with a LogError
 */
export async function readRecording(source, choices, watching) {
  try {
    return await readAtOnce(source, choices, watching);
  } catch (error) {
    if (choices.length === 1 || !(error instanceof LogError)) throw error;
  }
  // Of what is wrong with several, that of the first is told.
  const logs = [];
  for (const choice of choices) logs.push(...(await readAtOnce(source, [choice], watching)));
  return logs;
}

/** @type {typeof readRecording} */
async function readAtOnce(source, choices, watching) {
  const recording = await openRecording(source);
  const topics = choices.map((choice) => new TopicReader(source.name, recording, choice));
  if (recording.channels.size) for (const topic of topics) topic.check();
  /** Who takes the messages of a channel. @type {Map<number, TopicReader[]>} */
  const takers = new Map();
  await recording.read(
    (name) => topics.some((topic) => topic.wants(name)),
    (message) => {
      const { channelId } = message;
      let those = takers.get(channelId);
      if (!those) {
        const { topic: name } = /** @type {Channel} */ (recording.channels.get(channelId));
        takers.set(channelId, (those = topics.filter((topic) => topic.wants(name))));
      }
      for (const taker of those) taker.take(message);
    },
    watching,
  );
  const logs = [];
  for (const topic of topics) logs.push(await topic.end(watching));
  return logs;
}

/** What is made of the messages of a topic. */
class TopicReader {
  #recording;
  #choice;
  /** @type {Place} */
  #place;
  #rows;
  /** How many messages came. */
  #number = 0;
  /** Whether the headers have stamps: the first may be that of a clock which begins at 0, and two such are none. @type {boolean | undefined} */
  #isStamped;
  /** The first message, as long as that is not known. @type {{ reading: Reading, logTime: bigint, number: number } | undefined} */
  #first;
  #type = '';
  /** @type {Frames | undefined} */
  #tree;
  /** By channel. @type {Map<number, (message: Message) => void>} */
  #readers = new Map();

  /** @param {string} file @param {Recording} recording @param {Choice} choice */
  constructor(file, recording, choice) {
    this.#recording = recording;
    this.#choice = choice;
    this.#place = { file, topic: choice.topic ?? '' };
    this.#rows = new Rows(this.#place);
  }

  /** @param {string} topic */
  wants(topic) {
    return topic === this.#place.topic || (this.#choice.frames !== undefined && STATIC.test(topic));
  }

  /** @throws {LogError} where there is no such topic, as far as is known */
  check() {
    const topics = [...this.#recording.channels.values()].map(({ topic }) => topic);
    if (!topics.includes(/** @type {string} */ (this.#place.topic))) this.#refuse((say) => say.noTopic(listed([...new Set(topics)])));
  }

  /** @param {Message} message @throws {LogError} */
  take(message) {
    const { channelId } = message;
    let read = this.#readers.get(channelId);
    if (!read) this.#readers.set(channelId, (read = this.#prepare(channelId)));
    this.#number += 1;
    try {
      read(message);
    } catch (error) {
      if (error instanceof LogError) throw error;
      this.#refuse((say) => say.message(this.#number, reasonOf(error)));
    }
  }

  /** @param {number} id @returns {(message: Message) => void} */
  #prepare(id) {
    const { topic, type, encoding } = /** @type {Channel} */ (this.#recording.channels.get(id));
    const { kind: wanted, frames } = this.#choice;
    const kind = kindOf(type);
    const isWanted = kind !== null && !(wanted === 'poses' && kind === 'commands');
    if (frames && kind !== 'transforms') this.#refuse((say) => say.type(cut(type), 'transforms'));
    if (!isWanted) this.#refuse((say) => say.type(cut(type), wanted === 'poses' ? wanted : 'either'));
    if (encoding !== 'cdr') this.#refuse((say) => say.encoding(cut(encoding)));
    if (kind !== 'transforms') {
      const read = poseReader(type);
      this.#type = type;
      return ({ data, logTime }) => this.#add(read(data), logTime);
    }
    if (topic === this.#place.topic) this.#type = type;
    this.#tree ??= new Frames(frames ?? { parent: '', child: '' });
    const [links, read, isStatic] = [this.#tree, edgeReader(), STATIC.test(topic)];
    return ({ data, logTime }) => {
      for (const edge of read(data)) {
        const reading = links.take(edge, isStatic);
        if (reading && frames) this.#add(reading, logTime);
      }
      // By then, those that come at all have come.
      if (!frames && this.#number >= MESSAGES_OF_FRAMES) this.#refuseUnchosen();
    };
  }

  /** @param {Reading} reading @param {bigint} logTime in nanoseconds */
  #add(reading, logTime) {
    const { stamp } = reading;
    if (this.#isStamped === undefined) {
      const hasStamp = stamp !== undefined && (stamp.sec !== 0 || stamp.nanosec !== 0);
      if (stamp && !hasStamp && !this.#first) {
        this.#first = { reading, logTime, number: this.#number };
        return;
      }
      this.#isStamped = hasStamp;
      this.#addFirst();
    }
    this.#put(reading, logTime, this.#number);
  }

  #addFirst() {
    const first = this.#first;
    this.#first = undefined;
    if (first) this.#put(first.reading, first.logTime, first.number);
  }

  /** @param {Reading} reading @param {bigint} logTime @param {number} number of the message */
  #put({ stamp, a, b, c, isRotation }, logTime, number) {
    if (!isRotation) this.#rows.leaveOut('noRotation', number);
    else if (this.#isStamped && stamp) this.#rows.add(stamp.sec, stamp.nanosec / 1e9, a, b, c, number);
    else this.#rows.add(Number(logTime / 1_000_000_000n), Number(logTime % 1_000_000_000n) / 1e9, a, b, c, number);
  }

  /**
   * @param {Watching} watching
   * @returns {Promise<Log>} rejects with a LogError where it is none
   */
  async end(watching) {
    this.check();
    if (this.#number === 0) this.#refuse((say) => say.noMessages);
    this.#addFirst();
    const { frames } = this.#choice;
    if (this.#tree && !frames) this.#refuseUnchosen();
    if (this.#tree && frames && this.#rows.count === 0) {
      const { parent, child } = frames;
      this.#refuse((say) => say.noChain(`${cut(parent)},${cut(child)}`, listed(this.#tree?.known ?? [])));
    }
    const kind = kindOf(this.#type) === 'commands' ? 'commands' : 'poses';
    /** @type {How} */
    const how = {
      format: 'mcap',
      unit: 'ns',
      unitBy: 'format',
      heading: kind === 'poses' ? 'quaternion' : 'none',
      columns: { type: this.#type, clock: this.#isStamped ? 'header.stamp' : LOG_TIME },
      cutShort: this.#recording.cutShort,
      hasBoth: false,
    };
    const { file, topic } = this.#place;
    return this.#rows.end(`${file}, ${topic}`, kind, how, breathing(watching));
  }

  #refuseUnchosen() {
    this.#refuse((say) => say.frames(listed(this.#tree?.known ?? [])));
  }

  /** @type {(reason: ConstructorParameters<typeof LogError>[1]) => never} */
  #refuse(reason) {
    throw new LogError(this.#place, reason);
  }
}
