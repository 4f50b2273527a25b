/** Reader of logs from the topics of a recording. */

import { group, sort, sum } from 'd3-array';
import type { TopicChannel, MessageContainer, RecordedMessage } from './formats/container.ts';
import { FrameTree } from './frames.ts';
import { LogError, truncate, listNames, reasonOf, RECORDING_CLOCK, formatFrames, type ErrorReason, type LogChoice, type Log, type LogNote, type FindOptions, type Recording, type Series } from './log.ts';
import { isReadable, logKindOfType, sampleReaderOf, readTransforms } from './messages.ts';
import { RowCollector } from './rows.ts';

/** Maximum number of messages that are read to find the pairs of frames of a topic. */
const MAX_FRAME_MESSAGES = 2000;

/** Maximum number of characters of a topic's message types in a sentence. */
const MAX_TYPE_LENGTH = 100;

/** Returns true for a topic of static transforms. */
const isStaticTopic = ({ topicName, messageType }: Pick<TopicChannel, 'topicName' | 'messageType'>) => logKindOfType(messageType) === 'transforms' && /(^|\/)tf_static$/.test(topicName);

export async function createRecording(recordingName: string, messageContainer: MessageContainer, optionsOf: FindOptions): Promise<Recording> {
  const { recordingFormat, topicChannels } = messageContainer;
  if (topicChannels.every(({ messageCount }) => messageCount === 0)) {
    const damageReason = damageReasonOf(messageContainer);
    throw new LogError({ fileName: recordingName }, (errorReasons) => (damageReason ? errorReasons.damagedFileReason(damageReason, recordingFormat) : errorReasons.fewRowsReason(0, 0)));
  }
  const seriesList = await listSeries(messageContainer);
  return { recordingName, recordingFormat, seriesList, readLogs };

  async function readLogs(logChoices: LogChoice[], onProgress?: (progressFraction: number) => void): Promise<Log[]> {
    const choiceReaders = logChoices.map((logChoice) => createTopicReader(recordingName, messageContainer, logChoice, seriesList.find((seriesEntry) => seriesEntry.seriesName === logChoice.seriesName)));
    const readersByChannel = new Map(messageContainer.topicChannels.map((topicChannel) => [topicChannel, choiceReaders.filter((topicReader) => topicReader.isWanted(topicChannel))]));
    const passMessage = (recordedMessage: RecordedMessage) => {
      for (const topicReader of readersByChannel.get(recordedMessage.topicChannel) ?? []) topicReader.addMessage(recordedMessage);
    };
    const wantedChannels = new Set(messageContainer.topicChannels.filter((topicChannel) => readersByChannel.get(topicChannel)?.length && !isStaticTopic(topicChannel)));
    // Static transforms are read before the other messages, because they also apply to times before their recording.
    if (logChoices.some(({ framePair }) => framePair)) await messageContainer.readMessages(isStaticTopic, passMessage);
    await messageContainer.readMessages((topicChannel) => wantedChannels.has(topicChannel), passMessage, onProgress);
    return choiceReaders.map((topicReader) => topicReader.buildLog(optionsOf));
  }
}

/** Returns the first reason why a part of a recording cannot be read; undefined for an undamaged recording. */
const damageReasonOf = ({ damageReasons, truncationReason }: MessageContainer): string | undefined => [...damageReasons, truncationReason][0];

async function listSeries(messageContainer: MessageContainer): Promise<Series[]> {
  const seriesList: Series[] = Array.from(group(messageContainer.topicChannels, ({ topicName }) => topicName), ([topicName, allChannels]) => {
    const readableChannels = allChannels.filter((topicChannel) => isReadable(topicChannel) && logKindOfType(topicChannel.messageType) !== null);
    const topicChannels = readableChannels.length > 0 ? readableChannels : allChannels;
    const messageTypes = [...new Set(topicChannels.map((topicChannel) => (isReadable(topicChannel) ? topicChannel.messageType : `${topicChannel.messageType} as ${topicChannel.encoding}`)))];
    const readableKind = readableChannels.length > 0 && messageTypes.length === 1 ? logKindOfType(messageTypes[0]) : null;
    return { seriesName: topicName, messageType: messageTypes.join(', '), seriesKind: readableKind, messageCount: sum(topicChannels, ({ messageCount }) => messageCount) };
  });
  for (const seriesEntry of seriesList) {
    if (seriesEntry.seriesKind !== 'transforms' || isStaticTopic({ topicName: seriesEntry.seriesName, messageType: seriesEntry.messageType })) continue;
    const frameTree = new FrameTree();
    let messageCount = 0;
    const addMessage = (recordedMessage: RecordedMessage) => {
      messageCount += 1;
      try {
        for (const stampedTransform of readTransforms(recordedMessage)) frameTree.addTransform(stampedTransform, isStaticTopic(recordedMessage.topicChannel), recordedMessage.recordTime, messageCount);
      } catch {
        // A damaged message is ignored here. It is counted when the log is read.
      }
    };
    await messageContainer.readMessages(isStaticTopic, addMessage);
    await messageContainer.readMessages(({ topicName }) => topicName === seriesEntry.seriesName, addMessage, () => messageCount >= MAX_FRAME_MESSAGES);
    seriesEntry.framePairs = frameTree.findPoseFrames();
  }
  return sort(seriesList, ({ seriesName }) => seriesName);
}

/** Returns a reader of the log in one topic. For a topic of transforms, the reader also takes static transforms. Throws a LogError if the topic has no such log. */
function createTopicReader(recordingName: string, messageContainer: MessageContainer, { seriesName: topicName, logKind: wantedKind, framePair }: LogChoice, { messageType, seriesKind }: Pick<Series, 'messageType' | 'seriesKind'> = { messageType: '', seriesKind: null }) {
  const throwLogError = (formatReason: ErrorReason): never => {
    throw new LogError({ fileName: recordingName, topicName }, formatReason);
  };
  if (seriesKind === 'positions') throwLogError((errorReasons) => errorReasons.noHeadingReason(messageType));
  const hasWantedKind = framePair ? seriesKind === 'transforms' : seriesKind !== null && !(wantedKind === 'poses' && seriesKind === 'commands');
  if (!hasWantedKind) throwLogError((errorReasons) => errorReasons.wrongTypeReason(truncate(messageType, MAX_TYPE_LENGTH), framePair ? 'transforms' : wantedKind === 'poses' ? wantedKind : 'either'));
  const rowCollector = new RowCollector({ fileName: recordingName, topicName });
  const frameTree = framePair && new FrameTree(framePair);
  const readSample = sampleReaderOf(messageType);
  let messageCount = 0;

  return {
    isWanted: (topicChannel: TopicChannel) => (topicChannel.topicName === topicName && topicChannel.messageType === messageType && isReadable(topicChannel)) || (framePair !== undefined && isStaticTopic(topicChannel)),

    addMessage(recordedMessage: RecordedMessage): void {
      messageCount += 1;
      try {
        if (readSample) return rowCollector.addRow(readSample(recordedMessage), messageCount, recordedMessage.recordTime);
        for (const stampedTransform of readTransforms(recordedMessage)) frameTree?.addTransform(stampedTransform, isStaticTopic(recordedMessage.topicChannel), recordedMessage.recordTime, messageCount);
      } catch (error) {
        if (error instanceof LogError) throw error;
        rowCollector.dropRow('damaged', messageCount, (errorReasons) => errorReasons.unreadableMessageReason(reasonOf(error)));
      }
    },

    /** Returns the log; throws a LogError if the messages do not form a log. */
    buildLog(optionsOf: FindOptions): Log {
      const { recordingFormat, damageReasons, truncationReason } = messageContainer;
      const lossReason = damageReasonOf(messageContainer);
      if (messageCount === 0 && lossReason) throwLogError((errorReasons) => errorReasons.damagedFileReason(lossReason, recordingFormat));
      if (frameTree && !frameTree.isConnected) throwLogError((errorReasons) => errorReasons.unconnectedFramesReason(formatFrames(framePair), listNames(frameTree.frameLinks.map(formatFrames))));
      if (frameTree && !frameTree.readPoses((pose, { recordTime, messageNumber }) => rowCollector.addRow(pose, messageNumber, recordTime))) {
        const otherFrames = frameTree.findPoseFrames().map(formatFrames).filter((otherText) => otherText !== formatFrames(framePair));
        throwLogError((errorReasons) => errorReasons.constantTransformReason(formatFrames(framePair), listNames(otherFrames)));
      }
      const logKind = seriesKind === 'commands' ? 'commands' : 'poses';
      const logNotes: LogNote[] = [
        ...(damageReasons.length > 0 ? [{ name: 'damaged' as const, values: [damageReasons.length, damageReasons[0]] }] : []),
        ...(truncationReason ? [{ name: 'cutShort' as const, values: [] }] : []),
      ];
      const logName = `${recordingName}, ${topicName}${framePair ? ` (${formatFrames(framePair)})` : ''}`;
      return rowCollector.buildLog(logName, logKind, {
        assumedUnits: { time: { unit: 'ns', by: 'format' }, length: { unit: 'm', by: 'format' }, angle: { unit: logKind === 'poses' ? 'quaternion' : 'none', by: 'format' } },
        clockNames: ['header.stamp', RECORDING_CLOCK],
        ...(framePair && { frames: framePair }),
        notes: logNotes,
      }, optionsOf(logName));
    },
  };
}
