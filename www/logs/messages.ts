/** Readers of ROS 1 and ROS 2 messages with poses, commands or transforms. Fields at the end of a message, such as covariances, are ignored. */

import { dataViewOf, type Channel, type Message } from './formats/container.ts';
import { decompressZstdMessage } from './formats/decompression.ts';
import type { Series } from './log.ts';
import { rotationOf } from './path.ts';
import type { Sample } from './rows.ts';

export type Transform = [x: number, y: number, z: number, qx: number, qy: number, qz: number, qw: number];

export interface StampedTransform { time: number; parent: string; child: string; transform: Transform }

/** Number of bytes of the CDR header. The second byte of the header is 0 for big-endian and 1 for little-endian. Values are aligned relative to the end of the header. */
const CDR_HEADER_BYTES = 4;

type MessageBytes = Pick<Message, 'block' | 'start' | 'end'>;

/** Reader of the values in a message. ROS 1 packs values without padding; ROS 2 aligns each value to its size. */
class MessageReader {
  #view;
  #position;
  #end;
  /** Position in the message from which the alignment of values counts. */
  #start;
  #isLittle = true;
  #alignment = 1;

  constructor({ encoding }: Channel, { block, start, end }: MessageBytes) {
    this.#view = block;
    this.#position = this.#start = start;
    this.#end = end;
    if (encoding === 'ros1') return;
    this.#start += CDR_HEADER_BYTES;
    const encodingKind = this.#view.getUint8(this.#takeAlignedPosition(CDR_HEADER_BYTES) + 1);
    if (encodingKind > 1) throw new RangeError(`CDR of kind ${encodingKind}`);
    this.#isLittle = encodingKind === 1;
    this.#alignment = 8;
  }

  /** Reads the stamp of a header, s. In ROS 1 a sequence number comes first. */
  readStamp(): number {
    if (this.#alignment === 1) this.skip(4);
    return this.#view.getInt32(this.#takeAlignedPosition(4), this.#isLittle) + this.readUint32() / 1e9;
  }

  /** Skips bytes. Throws a RangeError if the message has fewer bytes left. */
  skip(bytes: number): void {
    this.#position += bytes;
    if (this.#position > this.#end) throw new RangeError('the message is too short');
  }

  readUint32(): number {
    return this.#view.getUint32(this.#takeAlignedPosition(4), this.#isLittle);
  }

  readFloat64(): number {
    return this.#view.getFloat64(this.#takeAlignedPosition(8), this.#isLittle);
  }

  readString(): string {
    const length = this.readUint32();
    this.skip(length);
    return new TextDecoder().decode(bytesOf(this.#view, this.#position - length, this.#position)).replace(/\0$/, '');
  }

  /** Returns the aligned position of the next value, and moves the reader past the value. */
  #takeAlignedPosition(size: number): number {
    const valueAlignment = Math.min(size, this.#alignment);
    const valuePosition = this.#position + ((this.#start - this.#position) & (valueAlignment - 1));
    this.skip(valuePosition + size - this.#position);
    return valuePosition;
  }
}

const bytesOf = (block: DataView, start: number, end: number) => new Uint8Array(block.buffer, block.byteOffset + start, end - start);

/** Returns the stamp of a message header, and skips its frame. Decoding the frame's name would take as long as reading the rest of the message. */
function readHeader(reader: MessageReader): number {
  const stamp = reader.readStamp();
  reader.skip(reader.readUint32());
  return stamp;
}

function readTransform(reader: MessageReader): Transform {
  return [reader.readFloat64(), reader.readFloat64(), reader.readFloat64(), reader.readFloat64(), reader.readFloat64(), reader.readFloat64(), reader.readFloat64()];
}

export function rowOfPose(time: number, [x, y, , qx, qy, qz, qw]: Transform): Sample {
  return { time, a: x, b: y, ...rotationOf(qx, qy, qz, qw) };
}

function readTwist(time: number, reader: MessageReader): Sample {
  const v = reader.readFloat64();
  // Skips the lateral and vertical speeds, and the turn rates about x and y.
  reader.skip(4 * 8);
  return { time, a: v, b: reader.readFloat64(), c: 0 };
}

/** Reads the stamp and the pose of a child frame relative to its parent. */
function readFrameTransform(reader: MessageReader): Sample {
  const stamp = readHeader(reader);
  reader.skip(reader.readUint32());
  return rowOfPose(stamp, readTransform(reader));
}

const readStampedPose = (reader: MessageReader) => rowOfPose(readHeader(reader), readTransform(reader));

/** Kind of log for each message type, by the type's ROS 1 name, with the reader of its poses or commands. */
const MESSAGE_TYPES = new Map<string, [kind: Series['kind'], readSample?: (reader: MessageReader) => Sample]>([
  ['nav_msgs/Odometry', ['poses', readFrameTransform]],
  ['geometry_msgs/TransformStamped', ['poses', readFrameTransform]],
  ['geometry_msgs/PoseStamped', ['poses', readStampedPose]],
  ['geometry_msgs/PoseWithCovarianceStamped', ['poses', readStampedPose]],
  ['geometry_msgs/Pose', ['poses', (reader) => rowOfPose(0, readTransform(reader))]],
  ['geometry_msgs/Pose2D', ['poses', (reader) => ({ time: 0, a: reader.readFloat64(), b: reader.readFloat64(), c: reader.readFloat64() })]],
  ['geometry_msgs/Twist', ['commands', (reader) => readTwist(0, reader)]],
  ['geometry_msgs/TwistStamped', ['commands', (reader) => readTwist(readHeader(reader), reader)]],
  ['geometry_msgs/TwistWithCovarianceStamped', ['commands', (reader) => readTwist(readHeader(reader), reader)]],
  ['tf2_msgs/TFMessage', ['transforms']],
  ['tf/tfMessage', ['transforms']],
  ['geometry_msgs/PointStamped', ['positions']],
  ['sensor_msgs/NavSatFix', ['positions']],
]);

const messageTypeOf = (type: string) => MESSAGE_TYPES.get(type.replace('/msg/', '/')) ?? [null];

/** Returns the kind of log that can be read from messages of a type. */
export const logKindOfType = (type: string): Series['kind'] => messageTypeOf(type)[0];

/** Returns true if messages have the serialization of ROS 1 or ROS 2. */
export const isReadable = ({ encoding }: Channel) => encoding === 'cdr' || encoding === 'ros1';

/** First four bytes of a message that rosbag2 compressed with Zstandard. An uncompressed ROS 2 message starts with 0. */
const ZSTD_MAGIC = 0x28b52ffd;

function readerOf(channel: Channel, message: MessageBytes): MessageReader {
  const { block, start, end } = message;
  if (channel.encoding === 'ros1' || block.getUint32(start) !== ZSTD_MAGIC) return new MessageReader(channel, message);
  const bytes = decompressZstdMessage(bytesOf(block, start, end));
  return new MessageReader(channel, { block: dataViewOf(bytes), start: 0, end: bytes.length });
}

/** Returns a reader of messages of a type; undefined if the type has no poses or commands. The reader throws an error if the bytes are of another type. */
export function sampleReaderOf(type: string): ((message: Message) => Sample) | undefined {
  const [, readSample] = messageTypeOf(type);
  return readSample && ((message) => readSample(readerOf(message.channel, message)));
}

/** Returns the name of a coordinate frame without the leading slash that ROS 1's old tf library wrote. */
export const withoutSlash = (name: string) => name.replace(/^\/+/, '');

/** Reads the transforms of a message. Throws an error if the bytes are of another message type. */
export function readTransforms(message: Message): StampedTransform[] {
  const reader = readerOf(message.channel, message);
  const transforms: StampedTransform[] = [];
  for (let remainingCount = reader.readUint32(); remainingCount > 0; remainingCount--) {
    const time = reader.readStamp();
    const [parent, child] = [withoutSlash(reader.readString()), withoutSlash(reader.readString())];
    transforms.push({ time, parent, child, transform: readTransform(reader) });
  }
  return transforms;
}
