/** Logs of the topics of a recording. */

import type { Channel, Container, Message } from './formats/container.ts';
import { Chain, FrameTree } from './frames.ts';
import { LogError, cut, listed, reasonOf, type Words } from './log-error.ts';
import { LOG_TIME, framesOption, framesText, type Choice, type Log, type Note, type OpenOptions, type Question, type Recording, type Series } from './log.ts';
import { edgesOf, isReadable, kindOf, poseReader, type Sample } from './messages.ts';
import { MAX_VALUE, Rows } from './rows.ts';

/** Maximum number of messages with transforms that are read to find the frames. */
const MAX_FRAME_MESSAGES = 2000;

/** Maximum number of times that a node publishes a topic again after another one. A restarted node counts as a new one, and does not alternate. */
const MAX_ALTERNATIONS = 2;

/** Checks for a topic of static transforms. */
const isStatic = ({ topic, type }: Pick<Channel, 'topic' | 'type'>) => kindOf(type) === 'transforms' && /(^|\/)tf_static$/.test(topic);

/** Returns the recording that a container holds. */
export async function recordingOf(name: string, container: Container, options: OpenOptions): Promise<Recording> {
  const { format, cutShort, damage, channels } = container;
  const [reason] = damage.values();
  if (channels.every(({ count }) => count === 0)) throw new LogError({ file: name }, (say) => (reason ? say.damaged(reason) : cutShort ? say.incomplete(format) : say.noMessages));
  const series = await seriesOf(container);
  return { name, format, series, read };

  /** Reads several logs in one pass. */
  async function read(choices: Choice[], onProgress?: (share: number) => void): Promise<Log[]> {
    const topics = choices.map((choice) => new TopicReader(name, container, choice, series));
    const byChannel = new Map(container.channels.map((channel) => [channel, topics.filter((topic) => topic.wants(channel))]));
    const take = (message: Message) => {
      for (const topic of byChannel.get(message.channel) ?? []) topic.take(message);
    };
    const wanted = new Set(container.channels.filter((channel) => byChannel.get(channel)?.length && !isStatic(channel)));
    // Static transforms are read first, because they also hold before the time of their recording.
    if (choices.some(({ frames }) => frames)) await container.read(isStatic, take);
    await container.read((channel) => wanted.has(channel), take, onProgress);
    return topics.map((topic) => topic.end(options));
  }
}

async function seriesOf(container: Container): Promise<Series[]> {
  const byTopic = new Map<string, Channel[]>();
  for (const channel of container.channels) byTopic.set(channel.topic, [...(byTopic.get(channel.topic) ?? []), channel]);
  const series: Series[] = [...byTopic].map(([topic, channels]) => {
    const readable = channels.filter((channel) => isReadable(channel) && kindOf(channel.type) !== null);
    const types = new Set((readable.length ? readable : channels).map(({ type }) => type));
    const count = (readable.length ? readable : channels).reduce((sum, channel) => sum + channel.count, 0);
    return { name: topic, type: [...types].join(', '), kind: readable.length && types.size === 1 ? kindOf([...types][0]) : null, count };
  });
  for (const each of series) {
    if (each.kind !== 'transforms' || isStatic({ topic: each.name, type: each.type })) continue;
    const tree = new FrameTree();
    let messages = 0;
    const take = (message: Message) => {
      messages += 1;
      try {
        for (const edge of edgesOf(message)) tree.take(edge, isStatic(message.channel));
      } catch {
        // A damaged message is counted when the log is read.
      }
    };
    await container.read(isStatic, take);
    await container.read(({ topic }) => topic === each.name, take, () => messages >= MAX_FRAME_MESSAGES);
    each.frames = tree.candidates();
  }
  return series.sort((one, other) => (one.name < other.name ? -1 : 1));
}

/** Reader of one topic. For a topic of transforms it also reads the static ones. */
class TopicReader {
  #file;
  #container;
  #choice;
  #rows;
  #kind: Series['kind'] = null;
  #chain: Chain | undefined;
  /** Number of messages so far. */
  #number = 0;
  /** Number of unreadable messages, and the reason for the first. */
  #damaged = 0;
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
    const candidates = series.find(({ name }) => name === choice.series)?.frames ?? [];
    if (!choice.frames) {
      const ask = { what: 'frames' as const, choices: candidates.map(framesOption) };
      this.#refuse((say) => say.frames(listed(candidates.map(framesText))), ask);
    }
    this.#chain = new Chain(choice.frames);
  }

  wants(channel: Channel): boolean {
    if (kindOf(channel.type) !== this.#kind) return false;
    return channel.topic === this.#choice.series || (this.#choice.frames !== undefined && isStatic(channel));
  }

  /** Checks that the topic has one type that can be read. */
  #checkTypes(): Series['kind'] {
    const { series, kind: wanted, frames } = this.#choice;
    const channels = this.#container.channels.filter(({ topic }) => topic === series);
    const isWanted = ({ type }: Channel) => {
      const kind = kindOf(type);
      return frames ? kind === 'transforms' : kind !== null && !(wanted === 'poses' && kind === 'commands');
    };
    const fitting = channels.filter(isWanted);
    const types = [...new Set((fitting.length ? fitting : channels).map(({ type }) => type))];
    if (fitting.length === 0) this.#refuse((say) => say.type(cut(types.join(', ')), frames ? 'transforms' : wanted === 'poses' ? wanted : 'either'));
    if (types.length > 1) this.#refuse((say) => say.types(listed(types)));
    if (kindOf(types[0]) === 'positions') this.#refuse((say) => say.positions(types[0]));
    if (!isReadable(fitting[0])) this.#refuse((say) => say.encoding(cut(fitting[0].encoding)));
    return kindOf(types[0]);
  }

  take(message: Message): void {
    const { channel } = message;
    let read = this.#readers.get(channel);
    if (!read) this.#readers.set(channel, (read = this.#readerOf(channel)));
    this.#number += 1;
    try {
      read(message);
    } catch (error) {
      if (error instanceof LogError) throw error;
      return this.#drop(this.#number, reasonOf(error));
    }
    if (channel.publisher === this.#publisher || this.#chain) return;
    this.#publisher = channel.publisher;
    if (this.#publishers.includes(channel.publisher)) this.#alternations += 1;
    else this.#publishers.push(channel.publisher);
  }

  #readerOf(channel: Channel): (message: Message) => void {
    const chain = this.#chain;
    if (!chain) {
      const pose = poseReader(channel);
      return (message) => this.#add(pose(message), message, this.#number);
    }
    const fixed = isStatic(channel);
    return (message) => {
      for (const edge of edgesOf(message)) chain.take(edge, fixed, message, this.#number);
    };
  }

  #add({ seconds, nanoseconds, a, b, c, isRotation }: Sample, recorded: Pick<Message, 'seconds' | 'nanoseconds'>, number: number): void {
    if (Math.max(Math.abs(a), Math.abs(b), Math.abs(c)) > MAX_VALUE) return this.#drop(number, 'a value is out of range');
    if (!isRotation) return this.#rows.drop('noRotation', number);
    this.#rows.add(seconds, nanoseconds / 1e9, a, b, c, number, recorded.seconds, recorded.nanoseconds / 1e9);
  }

  /** Drops a damaged message. */
  #drop(number: number, reason: string): void {
    this.#damaged += 1;
    this.#reason ||= reason;
    this.#rows.drop('damaged', number);
  }

  /** Returns the log; throws a LogError if the messages do not make one. */
  end(options: OpenOptions): Log {
    const { series, frames } = this.#choice;
    const { damage, cutShort, missing } = this.#container;
    const [reason] = damage.values();
    if (this.#number === 0) this.#refuse((say) => (reason ? say.damaged(reason) : say.noMessages));
    if (this.#alternations > MAX_ALTERNATIONS) this.#refuse((say) => say.publishers(listed(this.#publishers)));
    if (this.#chain) this.#addPoses(this.#chain);
    if (this.#damaged === this.#number) this.#refuse((say) => say.message(1, this.#reason));
    const kind = this.#kind === 'commands' ? 'commands' : 'poses';
    const notes: Note[] = [
      ...(missing.length ? [{ name: 'missing' as const, values: [listed(missing)] }] : []),
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
    if (this.#damaged === this.#number) return;
    if (!chain.isConnected) this.#refuse((say) => say.noChain(framesText(frames), listed(chain.tree.links.map(framesText))));
    const changes = chain.poses((pose, { message, number }) => this.#add(pose, message, number));
    if (!changes) this.#refuse((say) => say.constant(framesText(frames), listed(chain.tree.candidates().map(framesText))));
  }

  #refuse(reason: (say: Words['refused']) => string, ask?: Question): never {
    throw new LogError({ file: this.#file, topic: this.#choice.series }, reason, ask);
  }
}
