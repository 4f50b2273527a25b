/** Writes MCAP recordings like those of ROS 2. */

import { Buffer } from 'node:buffer';
import zstd from '@foxglove/wasm-zstd';
import { MessageWriter } from '@foxglove/rosmsg2-serialization';
import { McapWriter } from '@mcap/core';

await zstd.isLoaded;

/** @typedef {{ sec: number, nanosec: number }} Stamp */

/** Returns a time of ROS 2. @param {number} t seconds */
export const stampOf = (t) => ({ sec: Math.floor(t), nanosec: Math.round((t - Math.floor(t)) * 1e9) });

const fieldsOf = (/** @type {string} */ messageType, /** @type {string[]} */ ...fieldNames) => fieldNames.map((name) => ({ type: messageType, name, isComplex: /[A-Z]/.test(messageType) }));
const covarianceFieldDefinition = { type: 'float64', name: 'covariance', isArray: true, arrayLength: 36 };

/** Definitions of the messages, with all their fields. @type {Record<string, any[]>} */
const MESSAGE_DEFINITIONS = {
  Header: [{ type: 'time', name: 'stamp' }, ...fieldsOf('string', 'frame_id')],
  Vector3: fieldsOf('float64', 'x', 'y', 'z'),
  Quaternion: fieldsOf('float64', 'x', 'y', 'z', 'w'),
  Pose: [...fieldsOf('Vector3', 'position'), ...fieldsOf('Quaternion', 'orientation')],
  'geometry_msgs/msg/Pose': [...fieldsOf('Vector3', 'position'), ...fieldsOf('Quaternion', 'orientation')],
  PoseWithCovariance: [...fieldsOf('Pose', 'pose'), covarianceFieldDefinition],
  Twist: fieldsOf('Vector3', 'linear', 'angular'),
  TwistWithCovariance: [...fieldsOf('Twist', 'twist'), covarianceFieldDefinition],
  'nav_msgs/msg/Odometry': [...fieldsOf('Header', 'header'), ...fieldsOf('string', 'child_frame_id'), ...fieldsOf('PoseWithCovariance', 'pose'), ...fieldsOf('TwistWithCovariance', 'twist')],
  'geometry_msgs/msg/PoseStamped': [...fieldsOf('Header', 'header'), ...fieldsOf('Pose', 'pose')],
  'geometry_msgs/msg/Twist': fieldsOf('Vector3', 'linear', 'angular'),
  'geometry_msgs/msg/TwistStamped': [...fieldsOf('Header', 'header'), ...fieldsOf('Twist', 'twist')],
  Transform: [...fieldsOf('Vector3', 'translation'), ...fieldsOf('Quaternion', 'rotation')],
  TransformStamped: [...fieldsOf('Header', 'header'), ...fieldsOf('string', 'child_frame_id'), ...fieldsOf('Transform', 'transform')],
  'tf2_msgs/msg/TFMessage': [{ ...fieldsOf('TransformStamped', 'transforms')[0], isArray: true }],
  'std_msgs/msg/String': fieldsOf('string', 'data'),
};

/** Returns the message of a pose. @param {number} x @param {number} y @param {number} theta @param {number} [quaternionNorm] norm of the quaternion */
export const poseOf = (x, y, theta, quaternionNorm = 1) => ({
  position: { x, y, z: 0.1 },
  orientation: { x: 0, y: 0, z: quaternionNorm * Math.sin(theta / 2), w: quaternionNorm * Math.cos(theta / 2) },
});

/** Returns a message of odometry. @param {number} t @param {number} x @param {number} y @param {number} theta @param {number} [scale] */
export const odometryMessageOf = (t, x, y, theta, scale) => ({
  header: { stamp: stampOf(t), frame_id: 'odom' },
  child_frame_id: 'base_link',
  pose: { pose: poseOf(x, y, theta, scale), covariance: new Float64Array(36) },
  twist: { twist: twistOf(0, 0), covariance: new Float64Array(36) },
});

/** Returns the message of a command. @param {number} v @param {number} omega */
export const twistOf = (v, omega) => ({ linear: { x: v, y: 0, z: 0 }, angular: { x: 0, y: 0, z: omega } });

/** Returns the message of a transform. @param {number} t @param {string} parentFrame @param {string} childFrame @param {number} x @param {number} y @param {number} theta */
export const transformMessageOf = (t, parentFrame, childFrame, x, y, theta) => {
  const { position, orientation } = poseOf(x, y, theta);
  return { header: { stamp: stampOf(t), frame_id: parentFrame }, child_frame_id: childFrame, transform: { translation: position, rotation: orientation } };
};

/** Returns an LZ4 frame with one block that is not compressed. @param {Uint8Array} bytes */
const lz4FrameOf = (bytes) => {
  const blockSize = Buffer.alloc(4);
  blockSize.writeUInt32LE(0x80000000 + bytes.length);
  return Buffer.concat([Buffer.from('04224d184070df', 'hex'), blockSize, bytes, Buffer.alloc(4)]);
};

/** @type {Record<string, ((bytes: Uint8Array) => { compression: string, compressedData: Uint8Array }) | undefined>} */
const COMPRESSORS = {
  none: undefined,
  zstd: (bytes) => ({ compression: 'zstd', compressedData: new Uint8Array(zstd.compress(Buffer.from(bytes))) }),
  lz4: (bytes) => ({ compression: 'lz4', compressedData: lz4FrameOf(bytes) }),
  odd: (bytes) => ({ compression: 'snappy', compressedData: bytes }),
};

/**
 * @typedef {object} Message
 * @property {string} topic
 * @property {string} type
 * @property {string} [schema] name of a wrong type that the recording states
 * @property {any} message
 * @property {number} t time at which it was recorded, s
 *
 * @param {Iterable<Message>} messages
 * @param {object} [options]
 * @param {'none' | 'zstd' | 'lz4' | 'odd'} [options.compression]
 * @param {boolean} [options.hasIndex] true if the recording has an index
 * @param {boolean} [options.hasChunks] default: hasIndex
 * @param {number} [options.chunkSize] bytes
 * @param {string} [options.encoding] of messages
 * @returns {Promise<Buffer<ArrayBuffer>>}
 */
export async function recordingOf(messages, { compression = 'none', hasIndex = true, hasChunks = hasIndex, chunkSize = 4096, encoding = 'cdr' } = {}) {
  /** @type {Uint8Array[]} */
  const writtenParts = [];
  let writtenBytes = 0n;
  const byteSink = {
    position: () => writtenBytes,
    write: async (/** @type {Uint8Array} */ bytes) => {
      writtenParts.push(bytes.slice());
      writtenBytes += BigInt(bytes.length);
    },
  };
  const mcapWriter = new McapWriter({
    writable: byteSink, useChunks: hasChunks, useChunkIndex: hasIndex, useMessageIndex: hasIndex, useStatistics: hasIndex, useSummaryOffsets: hasIndex,
    repeatChannels: hasIndex, repeatSchemas: hasIndex, chunkSize, compressChunk: COMPRESSORS[compression],
  });
  await mcapWriter.start({ profile: 'ros2', library: 'test' });
  /** @type {Map<string, { id: number, writer: MessageWriter }>} */
  const channelsByTopic = new Map();
  let sequenceNumber = 0;
  for (const { topic, type, schema = type, message, t } of messages) {
    const channelKey = [topic, type, schema].join(' ');
    let topicChannel = channelsByTopic.get(channelKey);
    if (!topicChannel) {
      const schemaId = await mcapWriter.registerSchema({ name: schema, encoding: 'ros2msg', data: Buffer.from(`# ${schema}`) });
      const channelId = await mcapWriter.registerChannel({ topic, schemaId, messageEncoding: encoding, metadata: new Map() });
      const typeDefinitions = Object.entries(MESSAGE_DEFINITIONS).map(([name, definitions]) => ({ name, definitions }));
      const messageDefinition = typeDefinitions.find(({ name }) => name === type);
      topicChannel = { id: channelId, writer: new MessageWriter(messageDefinition ? [messageDefinition, ...typeDefinitions] : typeDefinitions) };
      channelsByTopic.set(channelKey, topicChannel);
    }
    const logTime = BigInt(Math.round(t * 1e3)) * 1_000_000n;
    await mcapWriter.addMessage({ channelId: topicChannel.id, sequence: sequenceNumber++, logTime, publishTime: logTime, data: topicChannel.writer.writeMessage(message) });
  }
  await mcapWriter.end();
  return Buffer.concat(writtenParts);
}
