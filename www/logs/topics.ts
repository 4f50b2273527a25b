/** Reader of logs from the topics of a recording. */

import type { Channel, Container, Message } from './formats/container.ts';
import { Chain, FrameTree } from './frames.ts';
import { LogError, truncate, listNames, reasonOf, type Words } from './log-error.ts';
import { LOG_TIME, framesOption, framesText, type LogChoice, type Log, type Note, type OpenOptions, type Question, type Recording, type Series } from './log.ts';
import { readTransforms, isReadable, logKindOfType, poseReader, type Sample } from './messages.ts';
import { Rows } from './rows.ts';

/** Maximum number of messages with transforms that are read to find the frames. */
const MAX_FRAME_MESSAGES = 2000;

/** Returns true for a topic of static transforms. */
const isStaticTopic = ({ topic, type }: Pick<Channel, 'topic' | 'type'>) => logKindOfType(type) === 'transforms' && /(^|\/)tf_static$/.test(topic);

/** Returns a recording whose logs are read from the messages of a container. */
export async function recordingOf(name: string, container: Container, options: OpenOptions): Promise<Recording> {
  const { format, cutReason, channels } = container;
  if (channels.every(({ count }) => count === 0)) throw new LogError({ file: name }, (say) => (cutReason ? say.damaged(cutReason, format) : say.noMessages));
  const series = await listSeries(container);
  return { name, format, series, read };

  /** Reads several logs in one pass. */
  async function read(choices: LogChoice[], onProgress?: (share: number) => void): Promise<Log[]> {
    const choiceReaders = choices.map((choice) => new TopicReader(name, container, choice, series));
    const readersByChannel = new Map(container.channels.map((channel) => [channel, choiceReaders.filter((reader) => reader.wants(channel))]));
    const passMessage = (message: Message) => {
      for (const reader of readersByChannel.get(message.channel) ?? []) reader.addMessage(message);
    };
    const wantedChannels = new Set(container.channels.filter((channel) => readersByChannel.get(channel)?.length && !isStaticTopic(channel)));
    // Static transforms are read first, because they also hold before the time of their recording.
    if (choices.some(({ frames }) => frames)) await container.read(isStaticTopic, passMessage);
    await container.read((channel) => wantedChannels.has(channel), passMessage, onProgress);
    return choiceReaders.map((reader) => reader.end(options));
  }
}

async function listSeries(container: Container): Promise<Series[]> {
  const channelsByTopic = new Map<string, Channel[]>();
  for (const channel of container.channels) channelsByTopic.set(channel.topic, [...(channelsByTopic.get(channel.topic) ?? []), channel]);
  const series: Series[] = [...channelsByTopic].map(([topic, channels]) => {
    const readableChannels = channels.filter((channel) => isReadable(channel) && logKindOfType(channel.type) !== null);
    const types = new Set((readableChannels.length ? readableChannels : channels).map((channel) => (isReadable(channel) ? channel.type : `${channel.type} as ${channel.encoding}`)));
    const count = (readableChannels.length ? readableChannels : channels).reduce((sum, channel) => sum + channel.count, 0);
    return { name: topic, type: [...types].join(', '), kind: readableChannels.length && types.size === 1 ? logKindOfType([...types][0]) : null, count };
  });
  for (const seriesEntry of series) {
    if (seriesEntry.kind !== 'transforms' || isStaticTopic({ topic: seriesEntry.name, type: seriesEntry.type })) continue;
    const frameTree = new FrameTree();
    let messageCount = 0;
    const addMessage = (message: Message) => {
      messageCount += 1;
      try {
        for (const transform of readTransforms(message)) frameTree.add(transform, isStaticTopic(message.channel));
      } catch {
        // A damaged message is counted when the log is read.
      }
    };
    await container.read(isStaticTopic, addMessage);
    await container.read(({ topic }) => topic === seriesEntry.name, addMessage, () => messageCount >= MAX_FRAME_MESSAGES);
    seriesEntry.frames = frameTree.findPoseFrames();
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
  #readers = new Map<Channel, (message: Message) => void>();

  constructor(file: string, container: Container, choice: LogChoice, series: Series[]) {
    this.#file = file;
    this.#container = container;
    this.#choice = choice;
    this.#rows = new Rows({ file, topic: choice.series });
    this.#kind = this.#checkTypes();
    if (this.#kind !== 'transforms') return;
    const frameCandidates = series.find(({ name }) => name === choice.series)?.frames ?? [];
    if (!choice.frames) {
      const ask = { what: 'frames' as const, choices: frameCandidates.map(framesOption) };
      this.#refuse((say) => say.frames(listNames(frameCandidates.map(framesText))), ask);
    }
    this.#chain = new Chain(choice.frames);
  }

  wants(channel: Channel): boolean {
    if (logKindOfType(channel.type) !== this.#kind) return false;
    return channel.topic === this.#choice.series || (this.#choice.frames !== undefined && isStaticTopic(channel));
  }

  /** Checks that the topic has one type that can be read. */
  #checkTypes(): Series['kind'] {
    const { series, kind: wantedKind, frames } = this.#choice;
    const channels = this.#container.channels.filter(({ topic }) => topic === series);
    const isWantedType = ({ type }: Channel) => {
      const kind = logKindOfType(type);
      return frames ? kind === 'transforms' : kind !== null && !(wantedKind === 'poses' && kind === 'commands');
    };
    const fittingChannels = channels.filter(isWantedType);
    const typeNames = [...new Set((fittingChannels.length ? fittingChannels : channels).map(({ type }) => type))];
    if (fittingChannels.length === 0) this.#refuse((say) => say.type(truncate(typeNames.join(', ')), frames ? 'transforms' : wantedKind === 'poses' ? wantedKind : 'either'));
    if (typeNames.length > 1) this.#refuse((say) => say.types(listNames(typeNames)));
    if (logKindOfType(typeNames[0]) === 'positions') this.#refuse((say) => say.positions(typeNames[0]));
    if (!isReadable(fittingChannels[0])) this.#refuse((say) => say.encoding(truncate(fittingChannels[0].encoding)));
    return logKindOfType(typeNames[0]);
  }

  addMessage(message: Message): void {
    const { channel } = message;
    let readMessage = this.#readers.get(channel);
    if (!readMessage) this.#readers.set(channel, (readMessage = this.#readerOf(channel)));
    this.#messageCount += 1;
    try {
      readMessage(message);
    } catch (error) {
      if (error instanceof LogError) throw error;
      const number = this.#messageCount;
      this.#refuse((say) => say.message(number, reasonOf(error)));
    }
  }

  #readerOf(channel: Channel): (message: Message) => void {
    const chain = this.#chain;
    if (!chain) {
      const readPose = poseReader(channel);
      return (message) => this.#add(readPose(message), message, this.#messageCount);
    }
    const isStaticChannel = isStaticTopic(channel);
    return (message) => {
      for (const transform of readTransforms(message)) chain.add(transform, isStaticChannel, message, this.#messageCount);
    };
  }

  #add({ seconds, nanoseconds, a, b, c, isRotation }: Sample, recorded: Pick<Message, 'seconds' | 'nanoseconds'>, number: number): void {
    if (!isRotation) return this.#rows.drop('noRotation', number);
    this.#rows.add(seconds, nanoseconds / 1e9, a, b, c, number, recorded.seconds, recorded.nanoseconds / 1e9);
  }

  /** Returns the log; throws a LogError if the messages do not form a log. */
  end(options: OpenOptions): Log {
    const { series, frames } = this.#choice;
    if (this.#messageCount === 0) this.#refuse((say) => say.noMessages);
    if (this.#chain) this.#addPoses(this.#chain);
    const kind = this.#kind === 'commands' ? 'commands' : 'poses';
    const notes: Note[] = this.#container.cutReason ? [{ name: 'cutShort', values: [] }] : [];
    return this.#rows.end(`${this.#file}, ${series}${frames ? ` (${framesText(frames)})` : ''}`, kind, {
      units: { time: { unit: 'ns', by: 'format' }, length: { unit: 'm', by: 'format' }, angle: { unit: kind === 'poses' ? 'quaternion' : 'none', by: 'format' } },
      clocks: ['header.stamp', LOG_TIME],
      ...(frames && { frames }),
      notes,
    }, options);
  }

  #addPoses(chain: Chain): void {
    const frames = this.#choice.frames as NonNullable<LogChoice['frames']>;
    if (!chain.isConnected) this.#refuse((say) => say.noChain(framesText(frames), listNames(chain.tree.links.map(framesText))));
    const hasChanged = chain.poses((pose, { message, number }) => this.#add(pose, message, number));
    if (!hasChanged) this.#refuse((say) => say.constant(framesText(frames), listNames(chain.tree.findPoseFrames().map(framesText))));
  }

  #refuse(reason: (say: Words['refused']) => string, ask?: Question): never {
    throw new LogError({ file: this.#file, topic: this.#choice.series }, reason, ask);
  }
}
