/** Readers of ROS 1 and ROS 2 messages with poses, commands or transforms. Fields at the end of a message, such as covariances, are ignored. */

import { dataViewOf, type TopicChannel, type RecordedMessage } from './formats/container.ts';
import { decompressZstdMessage } from './formats/decompression.ts';
import type { Series } from './log.ts';
import { rotationOf } from './path.ts';
import type { LogSample } from './rows.ts';

export type FrameTransform = [x: number, y: number, z: number, qx: number, qy: number, qz: number, qw: number];

export interface StampedTransform { stampTime: number; parent: string; child: string; frameTransform: FrameTransform }

/** Number of bytes of the CDR header. The second byte of the header is 0 for big-endian and 1 for little-endian. Values are aligned relative to the end of the header. */
const CDR_HEADER_BYTES = 4;

type MessageBytes = Pick<RecordedMessage, 'blockView' | 'messageStart' | 'messageEnd'>;

/** Reader of the values in a message. ROS 1 packs values without padding; ROS 2 aligns each value to its size. */
class MessageReader {
  #blockView;
  #readPosition;
  #messageEnd;
  /** Position in the message from which the alignment of values counts. */
  #messageStart;
  #isLittleEndian = true;
  #maxAlignment = 1;

  constructor({ encoding }: TopicChannel, { blockView, messageStart, messageEnd }: MessageBytes) {
    this.#blockView = blockView;
    this.#readPosition = this.#messageStart = messageStart;
    this.#messageEnd = messageEnd;
    if (encoding === 'ros1') return;
    this.#messageStart += CDR_HEADER_BYTES;
    const encodingKind = this.#blockView.getUint8(this.#takeAlignedPosition(CDR_HEADER_BYTES) + 1);
    if (encodingKind > 1) throw new RangeError(`CDR of kind ${encodingKind}`);
    this.#isLittleEndian = encodingKind === 1;
    this.#maxAlignment = 8;
  }

  /** Reads the stamp of a header, s. In ROS 1 a sequence number comes first. */
  readStamp(): number {
    if (this.#maxAlignment === 1) this.skipBytes(4);
    return this.#blockView.getInt32(this.#takeAlignedPosition(4), this.#isLittleEndian) + this.readUint32() / 1e9;
  }

  /** Skips bytes. Throws a RangeError if the message has fewer bytes left. */
  skipBytes(byteCount: number): void {
    this.#readPosition += byteCount;
    if (this.#readPosition > this.#messageEnd) throw new RangeError('the message is too short');
  }

  readUint32(): number {
    return this.#blockView.getUint32(this.#takeAlignedPosition(4), this.#isLittleEndian);
  }

  readFloat64(): number {
    return this.#blockView.getFloat64(this.#takeAlignedPosition(8), this.#isLittleEndian);
  }

  readString(): string {
    const textLength = this.readUint32();
    this.skipBytes(textLength);
    return new TextDecoder().decode(bytesOf(this.#blockView, this.#readPosition - textLength, this.#readPosition)).replace(/\0$/, '');
  }

  /** Returns the aligned position of the next value, and moves the reader past the value. */
  #takeAlignedPosition(valueSize: number): number {
    const valueAlignment = Math.min(valueSize, this.#maxAlignment);
    const valuePosition = this.#readPosition + ((this.#messageStart - this.#readPosition) & (valueAlignment - 1));
    this.skipBytes(valuePosition + valueSize - this.#readPosition);
    return valuePosition;
  }
}

const bytesOf = (blockView: DataView, byteStart: number, byteEnd: number) => new Uint8Array(blockView.buffer, blockView.byteOffset + byteStart, byteEnd - byteStart);

/** Returns the stamp of a message header, and skips its frame. Decoding the frame's name would take as long as reading the rest of the message. */
function readHeader(messageReader: MessageReader): number {
  const stampTime = messageReader.readStamp();
  messageReader.skipBytes(messageReader.readUint32());
  return stampTime;
}

function readTransform(messageReader: MessageReader): FrameTransform {
  return [messageReader.readFloat64(), messageReader.readFloat64(), messageReader.readFloat64(), messageReader.readFloat64(), messageReader.readFloat64(), messageReader.readFloat64(), messageReader.readFloat64()];
}

export function rowOfPose(stampTime: number, [x, y, , qx, qy, qz, qw]: FrameTransform): LogSample {
  return { sampleTime: stampTime, a: x, b: y, ...rotationOf(qx, qy, qz, qw) };
}

function readTwist(stampTime: number, messageReader: MessageReader): LogSample {
  const v = messageReader.readFloat64();
  // Skips the lateral and vertical speeds, and the turn rates about x and y.
  messageReader.skipBytes(4 * 8);
  return { sampleTime: stampTime, a: v, b: messageReader.readFloat64(), c: 0 };
}

/** Reads the stamp and the pose of a child frame relative to its parent. */
function readFrameTransform(messageReader: MessageReader): LogSample {
  const stampTime = readHeader(messageReader);
  messageReader.skipBytes(messageReader.readUint32());
  return rowOfPose(stampTime, readTransform(messageReader));
}

const readStampedPose = (messageReader: MessageReader) => rowOfPose(readHeader(messageReader), readTransform(messageReader));

/** Kind of log for each message type, by the type's ROS 1 name, with the reader of its poses or commands. */
const MESSAGE_TYPES = new Map<string, [kind: Series['seriesKind'], readSample?: (messageReader: MessageReader) => LogSample]>([
  ['nav_msgs/Odometry', ['poses', readFrameTransform]],
  ['geometry_msgs/TransformStamped', ['poses', readFrameTransform]],
  ['geometry_msgs/PoseStamped', ['poses', readStampedPose]],
  ['geometry_msgs/PoseWithCovarianceStamped', ['poses', readStampedPose]],
  ['geometry_msgs/Pose', ['poses', (messageReader) => rowOfPose(0, readTransform(messageReader))]],
  ['geometry_msgs/Pose2D', ['poses', (messageReader) => ({ sampleTime: 0, a: messageReader.readFloat64(), b: messageReader.readFloat64(), c: messageReader.readFloat64() })]],
  ['geometry_msgs/Twist', ['commands', (messageReader) => readTwist(0, messageReader)]],
  ['geometry_msgs/TwistStamped', ['commands', (messageReader) => readTwist(readHeader(messageReader), messageReader)]],
  ['geometry_msgs/TwistWithCovarianceStamped', ['commands', (messageReader) => readTwist(readHeader(messageReader), messageReader)]],
  ['tf2_msgs/TFMessage', ['transforms']],
  ['tf/tfMessage', ['transforms']],
  ['geometry_msgs/PointStamped', ['positions']],
  ['sensor_msgs/NavSatFix', ['positions']],
]);

const messageTypeOf = (messageType: string) => MESSAGE_TYPES.get(messageType.replace('/msg/', '/')) ?? [null];

/** Returns the kind of log that can be read from messages of a type. */
export const logKindOfType = (messageType: string): Series['seriesKind'] => messageTypeOf(messageType)[0];

/** Returns true if messages have the serialization of ROS 1 or ROS 2. */
export const isReadable = ({ encoding }: TopicChannel) => encoding === 'cdr' || encoding === 'ros1';

/** First four bytes of a message that rosbag2 compressed with Zstandard. An uncompressed ROS 2 message starts with 0. */
const ZSTD_MAGIC = 0x28b52ffd;

function readerOf(topicChannel: TopicChannel, recordedMessage: MessageBytes): MessageReader {
  const { blockView, messageStart, messageEnd } = recordedMessage;
  if (topicChannel.encoding === 'ros1' || blockView.getUint32(messageStart) !== ZSTD_MAGIC) return new MessageReader(topicChannel, recordedMessage);
  const bytes = decompressZstdMessage(bytesOf(blockView, messageStart, messageEnd));
  return new MessageReader(topicChannel, { blockView: dataViewOf(bytes), messageStart: 0, messageEnd: bytes.length });
}

/** Returns a reader of messages of a type; undefined if the type has no poses or commands. The reader throws an error if the bytes are of another type. */
export function sampleReaderOf(messageType: string): ((recordedMessage: RecordedMessage) => LogSample) | undefined {
  const [, readSample] = messageTypeOf(messageType);
  return readSample && ((recordedMessage) => readSample(readerOf(recordedMessage.topicChannel, recordedMessage)));
}

/** Returns the name of a coordinate frame without the leading slash that ROS 1's old tf library wrote. */
export const removeLeadingSlash = (frameName: string) => frameName.replace(/^\/+/, '');

/** Reads the transforms of a message. Throws an error if the bytes are of another message type. */
export function readTransforms(recordedMessage: RecordedMessage): StampedTransform[] {
  const messageReader = readerOf(recordedMessage.topicChannel, recordedMessage);
  const stampedTransforms: StampedTransform[] = [];
  for (let remainingCount = messageReader.readUint32(); remainingCount > 0; remainingCount--) {
    const stampTime = messageReader.readStamp();
    const [parentFrame, childFrame] = [removeLeadingSlash(messageReader.readString()), removeLeadingSlash(messageReader.readString())];
    stampedTransforms.push({ stampTime, parent: parentFrame, child: childFrame, frameTransform: readTransform(messageReader) });
  }
  return stampedTransforms;
}
