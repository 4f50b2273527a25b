/** Logs of the topics of a recording. */

import type { Channel, Container, Message } from './formats/container.ts';
import { Chain, FrameTree } from './frames.ts';
import { LogError, cut, listing, reasonOf, type Words } from './log-error.ts';
import { LOG_TIME, framesOption, framesText, type Choice, type Log, type Note, type OpenOptions, type Question, type Recording, type Series } from './log.ts';
import { edgesOf, isReadable, kindOf, poseReader, type Sample } from './messages.ts';
import { MAX_VALUE, Rows } from './rows.ts';

/** Maximum number of messages with transforms that are read to find the frames. */
const MAX_FRAME_MESSAGES = 2000;

/**
 * Maximum number of times that a publisher of a topic comes back after another node published it. More times mean that two nodes publish at
 * the same time. A restarted node counts as a new publisher.
 */
const MAX_ALTERNATIONS = 2;

/** Returns true for a topic of static transforms. */
const isStaticTopic = ({ topic, type }: Pick<Channel, 'topic' | 'type'>) => kindOf(type) === 'transforms' && /(^|\/)tf_static$/.test(topic);

/** Returns the recording that a container holds. */
export async function recordingOf(name: string, container: Container, options: OpenOptions): Promise<Recording> {
  const { format, cutShort, damage, channels } = container;
  const [reason] = damage.values();
  if (channels.every(({ count }) => count === 0)) throw new LogError({ file: name }, (say) => (reason ? say.damaged(reason) : cutShort ? say.incomplete(format) : say.noMessages));
  const series = await listSeries(container);
  return { name, format, series, read };

  /** Reads several logs in one pass. */
  async function read(choices: Choice[], onProgress?: (share: number) => void): Promise<Log[]> {
    const topicReaders = choices.map((choice) => new TopicReader(name, container, choice, series));
    const readers = new Map(container.channels.map((channel) => [channel, topicReaders.filter((topic) => topic.wants(channel))]));
    const takeMessage = (message: Message) => {
      for (const topic of readers.get(message.channel) ?? []) topic.take(message);
    };
    const wantedChannels = new Set(container.channels.filter((channel) => readers.get(channel)?.length && !isStaticTopic(channel)));
    // Static transforms are read first, because they also hold before the time of their recording.
    if (choices.some(({ frames }) => frames)) await container.read(isStaticTopic, takeMessage);
    await container.read((channel) => wantedChannels.has(channel), takeMessage, onProgress);
    return topicReaders.map((topic) => topic.end(options));
  }
}

async function listSeries(container: Container): Promise<Series[]> {
  const channelsByTopic = new Map<string, Channel[]>();
  for (const channel of container.channels) channelsByTopic.set(channel.topic, [...(channelsByTopic.get(channel.topic) ?? []), channel]);
  const series: Series[] = [...channelsByTopic].map(([topic, channels]) => {
    const readable = channels.filter((channel) => isReadable(channel) && kindOf(channel.type) !== null);
    const types = new Set((readable.length ? readable : channels).map((channel) => (isReadable(channel) ? channel.type : `${channel.type} as ${channel.encoding}`)));
    const count = (readable.length ? readable : channels).reduce((sum, channel) => sum + channel.count, 0);
    return { name: topic, type: [...types].join(', '), kind: readable.length && types.size === 1 ? kindOf([...types][0]) : null, count };
  });
  for (const entry of series) {
    if (entry.kind !== 'transforms' || isStaticTopic({ topic: entry.name, type: entry.type })) continue;
    const frameTree = new FrameTree();
    let messageCount = 0;
    const take = (message: Message) => {
      messageCount += 1;
      try {
        for (const edge of edgesOf(message)) frameTree.take(edge, isStaticTopic(message.channel));
      } catch {
        // A damaged message is counted when the log is read.
      }
    };
    await container.read(isStaticTopic, take);
    await container.read(({ topic }) => topic === entry.name, take, () => messageCount >= MAX_FRAME_MESSAGES);
    entry.frames = frameTree.candidates();
  }
  return series.sort((one, other) => (one.name < other.name ? -1 : 1));
}

/** Reader of one topic. For a topic of transforms it also reads the static transforms. */
class TopicReader {
  #file;
  #container;
  #choice;
  #rows;
  #kind: Series['kind'] = null;
  #chain: Chain | undefined;
  /** Number of messages so far. */
  #messageCount = 0;
  /** Number of unreadable messages, and the reason why the first one is unreadable. */
  #damagedCount = 0;
  #reason = '';
  #readers = new Map<Channel, (message: Message) => void>();
  /** Nodes in the order of their first messages. */
  #publishers: string[] = [];
  /** Node of the latest message. */
  #publisher = '';
  /** Number of times that a node published again after another one. */
  #alternations = 0;

  constructor(file: string, container: Container, choice: Choice, series: Series[]) {
    this.#file = file;
    this.#container = container;
    this.#choice = choice;
    this.#rows = new Rows({ file, topic: choice.series });
    this.#kind = this.#checkTypes();
    if (this.#kind !== 'transforms') return;
    const frameCandidates = series.find(({ name }) => name === choice.series)?.frames ?? [];
    if (!choice.frames) {
      const ask = { what: 'frames' as const, choices: frameCandidates.map(framesOption) };
      this.#refuse((say) => say.frames(listing(frameCandidates.map(framesText))), ask);
    }
    this.#chain = new Chain(choice.frames);
  }

  wants(channel: Channel): boolean {
    if (kindOf(channel.type) !== this.#kind) return false;
    return channel.topic === this.#choice.series || (this.#choice.frames !== undefined && isStaticTopic(channel));
  }

  /** Checks that the topic has one type that can be read. */
  #checkTypes(): Series['kind'] {
    const { series, kind: wantedKind, frames } = this.#choice;
    const channels = this.#container.channels.filter(({ topic }) => topic === series);
    const isWantedType = ({ type }: Channel) => {
      const kind = kindOf(type);
      return frames ? kind === 'transforms' : kind !== null && !(wantedKind === 'poses' && kind === 'commands');
    };
    const fittingChannels = channels.filter(isWantedType);
    const typeNames = [...new Set((fittingChannels.length ? fittingChannels : channels).map(({ type }) => type))];
    if (fittingChannels.length === 0) this.#refuse((say) => say.type(cut(typeNames.join(', ')), frames ? 'transforms' : wantedKind === 'poses' ? wantedKind : 'either'));
    if (typeNames.length > 1) this.#refuse((say) => say.types(listing(typeNames)));
    if (kindOf(typeNames[0]) === 'positions') this.#refuse((say) => say.positions(typeNames[0]));
    if (!isReadable(fittingChannels[0])) this.#refuse((say) => say.encoding(cut(fittingChannels[0].encoding)));
    return kindOf(typeNames[0]);
  }

  take(message: Message): void {
    const { channel } = message;
    let readMessage = this.#readers.get(channel);
    if (!readMessage) this.#readers.set(channel, (readMessage = this.#readerOf(channel)));
    this.#messageCount += 1;
    try {
      readMessage(message);
    } catch (error) {
      if (error instanceof LogError) throw error;
      return this.#drop(this.#messageCount, reasonOf(error));
    }
    if (channel.publisher === this.#publisher || this.#chain) return;
    this.#publisher = channel.publisher;
    if (this.#publishers.includes(channel.publisher)) this.#alternations += 1;
    else this.#publishers.push(channel.publisher);
  }

  #readerOf(channel: Channel): (message: Message) => void {
    const chain = this.#chain;
    if (!chain) {
      const readPose = poseReader(channel);
      return (message) => this.#add(readPose(message), message, this.#messageCount);
    }
    const isStaticChannel = isStaticTopic(channel);
    return (message) => {
      for (const edge of edgesOf(message)) chain.take(edge, isStaticChannel, message, this.#messageCount);
    };
  }

  #add({ seconds, nanoseconds, a, b, c, isRotation }: Sample, recorded: Pick<Message, 'seconds' | 'nanoseconds'>, number: number): void {
    if (Math.max(Math.abs(a), Math.abs(b), Math.abs(c)) > MAX_VALUE) return this.#drop(number, 'a value is out of range');
    if (!isRotation) return this.#rows.drop('noRotation', number);
    this.#rows.add(seconds, nanoseconds / 1e9, a, b, c, number, recorded.seconds, recorded.nanoseconds / 1e9);
  }

  /** Drops a damaged message. */
  #drop(number: number, reason: string): void {
    this.#damagedCount += 1;
    this.#reason ||= reason;
    this.#rows.drop('damaged', number);
  }

  /** Returns the log; throws a LogError if the messages do not form a log. */
  end(options: OpenOptions): Log {
    const { series, frames } = this.#choice;
    const { damage, cutShort, missing } = this.#container;
    const [reason] = damage.values();
    if (this.#messageCount === 0) this.#refuse((say) => (reason ? say.damaged(reason) : say.noMessages));
    if (this.#alternations > MAX_ALTERNATIONS) this.#refuse((say) => say.publishers(listing(this.#publishers)));
    if (this.#chain) this.#addPoses(this.#chain);
    if (this.#damagedCount === this.#messageCount) this.#refuse((say) => say.message(1, this.#reason));
    const kind = this.#kind === 'commands' ? 'commands' : 'poses';
    const notes: Note[] = [
      ...(missing.length ? [{ name: 'missing' as const, values: [listing(missing)] }] : []),
      ...(damage.size ? [{ name: 'damaged' as const, values: [damage.size, reason] }] : []),
      ...(cutShort ? [{ name: 'cutShort' as const, values: [] }] : []),
    ];
    return this.#rows.end(`${this.#file}, ${series}${frames ? ` (${framesText(frames)})` : ''}`, kind, {
      units: { time: { unit: 'ns', by: 'format' }, length: { unit: 'm', by: 'format' }, angle: { unit: kind === 'poses' ? 'quaternion' : 'none', by: 'format' } },
      clocks: ['header.stamp', LOG_TIME],
      ...(frames && { frames }),
      notes,
    }, options);
  }

  #addPoses(chain: Chain): void {
    const frames = this.#choice.frames as NonNullable<Choice['frames']>;
    if (this.#damagedCount === this.#messageCount) return;
    if (!chain.isConnected) this.#refuse((say) => say.noChain(framesText(frames), listing(chain.tree.links.map(framesText))));
    const hasChanged = chain.poses((pose, { message, number }) => this.#add(pose, message, number));
    if (!hasChanged) this.#refuse((say) => say.constant(framesText(frames), listing(chain.tree.candidates().map(framesText))));
  }

  #refuse(reason: (say: Words['refused']) => string, ask?: Question): never {
    throw new LogError({ file: this.#file, topic: this.#choice.series }, reason, ask);
  }
}
