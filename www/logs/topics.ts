/** Reader of logs from the topics of a recording. */

import { group, sort, sum } from 'd3-array';
import type { Channel, Container, Message } from './formats/container.ts';
import { FrameTree } from './frames.ts';
import { LogError, truncate, listNames, reasonOf, RECORDING_CLOCK, formatFrames, type ErrorReason, type LogChoice, type Log, type Note, type OptionsByName, type Recording, type Series } from './log.ts';
import { isReadable, logKindOfType, sampleReaderOf, readTransforms } from './messages.ts';
import { RowCollector } from './rows.ts';

/** Maximum number of messages that are read to find the pairs of frames of a topic. */
const MAX_FRAME_MESSAGES = 2000;

/** Maximum number of characters of a topic's message types in a sentence. */
const MAX_TYPE_LENGTH = 100;

/** Returns true for a topic of static transforms. */
const isStaticTopic = ({ topic, type }: Pick<Channel, 'topic' | 'type'>) => logKindOfType(type) === 'transforms' && /(^|\/)tf_static$/.test(topic);

export async function createRecording(name: string, container: Container, optionsOf: OptionsByName): Promise<Recording> {
  const { format, channels } = container;
  if (channels.every(({ count }) => count === 0)) {
    const damageReason = damageReasonOf(container);
    throw new LogError({ file: name }, (texts) => (damageReason ? texts.damagedFileReason(damageReason, format) : texts.fewRowsReason(0, 0)));
  }
  const series = await listSeries(container);
  return { name, format, series, read };

  async function read(choices: LogChoice[], onProgress?: (fraction: number) => void): Promise<Log[]> {
    const choiceReaders = choices.map((choice) => createTopicReader(name, container, choice, series.find((seriesEntry) => seriesEntry.name === choice.series)));
    const readersByChannel = new Map(container.channels.map((channel) => [channel, choiceReaders.filter((reader) => reader.isWanted(channel))]));
    const passMessage = (message: Message) => {
      for (const reader of readersByChannel.get(message.channel) ?? []) reader.addMessage(message);
    };
    const wantedChannels = new Set(container.channels.filter((channel) => readersByChannel.get(channel)?.length && !isStaticTopic(channel)));
    // Static transforms are read before the other messages, because they also apply to times before their recording.
    if (choices.some(({ frames }) => frames)) await container.readMessages(isStaticTopic, passMessage);
    await container.readMessages((channel) => wantedChannels.has(channel), passMessage, onProgress);
    return choiceReaders.map((reader) => reader.buildLog(optionsOf));
  }
}

/** Returns the first reason why a part of a recording cannot be read; undefined for an undamaged recording. */
const damageReasonOf = ({ damageReasons, truncationReason }: Container): string | undefined => [...damageReasons, truncationReason][0];

async function listSeries(container: Container): Promise<Series[]> {
  const series: Series[] = Array.from(group(container.channels, ({ topic }) => topic), ([topic, allChannels]) => {
    const readableChannels = allChannels.filter((channel) => isReadable(channel) && logKindOfType(channel.type) !== null);
    const channels = readableChannels.length > 0 ? readableChannels : allChannels;
    const types = [...new Set(channels.map((channel) => (isReadable(channel) ? channel.type : `${channel.type} as ${channel.encoding}`)))];
    const readableKind = readableChannels.length > 0 && types.length === 1 ? logKindOfType(types[0]) : null;
    return { name: topic, type: types.join(', '), kind: readableKind, count: sum(channels, ({ count }) => count) };
  });
  for (const seriesEntry of series) {
    if (seriesEntry.kind !== 'transforms' || isStaticTopic({ topic: seriesEntry.name, type: seriesEntry.type })) continue;
    const frameTree = new FrameTree();
    let messageCount = 0;
    const addMessage = (message: Message) => {
      messageCount += 1;
      try {
        for (const transform of readTransforms(message)) frameTree.addTransform(transform, isStaticTopic(message.channel), message.time, messageCount);
      } catch {
        // A damaged message is ignored here. It is counted when the log is read.
      }
    };
    await container.readMessages(isStaticTopic, addMessage);
    await container.readMessages(({ topic }) => topic === seriesEntry.name, addMessage, () => messageCount >= MAX_FRAME_MESSAGES);
    seriesEntry.frames = frameTree.findPoseFrames();
  }
  return sort(series, ({ name }) => name);
}

/** Returns a reader of the log in one topic. For a topic of transforms, the reader also takes static transforms. Throws a LogError if the topic has no such log. */
function createTopicReader(file: string, container: Container, { series: topic, kind: wantedKind, frames }: LogChoice, { type, kind }: Pick<Series, 'type' | 'kind'> = { type: '', kind: null }) {
  const refuse = (formatReason: ErrorReason): never => {
    throw new LogError({ file, topic }, formatReason);
  };
  if (kind === 'positions') refuse((texts) => texts.noHeadingReason(type));
  const hasWantedKind = frames ? kind === 'transforms' : kind !== null && !(wantedKind === 'poses' && kind === 'commands');
  if (!hasWantedKind) refuse((texts) => texts.wrongTypeReason(truncate(type, MAX_TYPE_LENGTH), frames ? 'transforms' : wantedKind === 'poses' ? wantedKind : 'either'));
  const rows = new RowCollector({ file, topic });
  const chain = frames && new FrameTree(frames);
  const readSample = sampleReaderOf(type);
  let messageCount = 0;

  return {
    isWanted: (channel: Channel) => (channel.topic === topic && channel.type === type && isReadable(channel)) || (frames !== undefined && isStaticTopic(channel)),

    addMessage(message: Message): void {
      messageCount += 1;
      try {
        if (readSample) return rows.addRow(readSample(message), messageCount, message.time);
        for (const transform of readTransforms(message)) chain?.addTransform(transform, isStaticTopic(message.channel), message.time, messageCount);
      } catch (error) {
        if (error instanceof LogError) throw error;
        rows.dropRow('damaged', messageCount, (texts) => texts.unreadableMessageReason(reasonOf(error)));
      }
    },

    /** Returns the log; throws a LogError if the messages do not form a log. */
    buildLog(optionsOf: OptionsByName): Log {
      const { format, damageReasons, truncationReason } = container;
      const lossReason = damageReasonOf(container);
      if (messageCount === 0 && lossReason) refuse((texts) => texts.damagedFileReason(lossReason, format));
      if (chain && !chain.isConnected) refuse((texts) => texts.unconnectedFramesReason(formatFrames(frames), listNames(chain.links.map(formatFrames))));
      if (chain && !chain.readPoses((pose, { recordTime, messageNumber }) => rows.addRow(pose, messageNumber, recordTime))) {
        const otherFrames = chain.findPoseFrames().map(formatFrames).filter((otherText) => otherText !== formatFrames(frames));
        refuse((texts) => texts.constantTransformReason(formatFrames(frames), listNames(otherFrames)));
      }
      const logKind = kind === 'commands' ? 'commands' : 'poses';
      const notes: Note[] = [
        ...(damageReasons.length > 0 ? [{ name: 'damaged' as const, values: [damageReasons.length, damageReasons[0]] }] : []),
        ...(truncationReason ? [{ name: 'cutShort' as const, values: [] }] : []),
      ];
      const name = `${file}, ${topic}${frames ? ` (${formatFrames(frames)})` : ''}`;
      return rows.buildLog(name, logKind, {
        units: { time: { unit: 'ns', by: 'format' }, length: { unit: 'm', by: 'format' }, angle: { unit: logKind === 'poses' ? 'quaternion' : 'none', by: 'format' } },
        clocks: ['header.stamp', RECORDING_CLOCK],
        ...(frames && { frames }),
        notes,
      }, optionsOf(name));
    },
  };
}
