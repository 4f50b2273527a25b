/** Messages of ROS 2 with poses, commands or transforms. */

import { MessageReader } from '@foxglove/rosmsg2-serialization';
import { headingOf, isRotation } from './quaternion.ts';

/**
 * @import { Quaternion, Vector } from './quaternion.ts'
 *
 * @typedef {{ sec: number, nanosec: number }} Stamp
 * @typedef {{ translation: Vector, rotation: Quaternion }} Transform
 *
 * @typedef {object} Reading
 * @property {Stamp} [stamp] of the header, if the type has one
 * @property {number} a x, or v
 * @property {number} b y, or omega
 * @property {number} c heading, or 0
 * @property {boolean} isRotation whether the quaternion has length 1
 *
 * @typedef {object} Edge
 * @property {string} parent
 * @property {string} child
 * @property {Stamp} stamp
 * @property {Transform} transform of the child's frame in the parent's
 *
 * @typedef {object} Kind of message
 * @property {'poses' | 'commands' | 'transforms'} kind
 * @property {string} root name of its definition
 */

/** Kinds by message type. @type {Record<string, Kind>} */
export const KINDS = {
  'nav_msgs/msg/Odometry': { kind: 'poses', root: 'Odometry' },
  'geometry_msgs/msg/PoseStamped': { kind: 'poses', root: 'PoseStamped' },
  'geometry_msgs/msg/PoseWithCovarianceStamped': { kind: 'poses', root: 'PoseStamped' },
  'tf2_msgs/msg/TFMessage': { kind: 'transforms', root: 'TFMessage' },
  'geometry_msgs/msg/Twist': { kind: 'commands', root: 'Twist' },
  'geometry_msgs/msg/TwistStamped': { kind: 'commands', root: 'TwistStamped' },
};

const part = (/** @type {string} */ type, /** @type {string} */ name) => ({ type, name, isComplex: true });
const numbers = (/** @type {string[]} */ ...names) => names.map((name) => ({ type: 'float64', name }));
const text = (/** @type {string} */ name) => ({ type: 'string', name });
const stamp = { type: 'time', name: 'stamp' };

/** Text that is skipped: its bytes follow their count, as in an array, and decoding it takes as long as all the rest. */
const skipped = (/** @type {string} */ name) => ({ type: 'uint8', name, isArray: true });

const [POSE, TWIST] = [numbers('x', 'y', 'z', 'qx', 'qy', 'qz', 'qw'), numbers('vx', 'vy', 'vz', 'wx', 'wy', 'wz')];

/**
 * Leading fields of the messages, which are the same in all of ROS 2; covariances and the like follow and are not read. Nested parts of a
 * pose or twist are written out, as nothing is between them in the bytes.
 */
const DEFINITIONS = Object.entries({
  Odometry: [stamp, skipped('frame'), skipped('child'), ...POSE],
  PoseStamped: [stamp, skipped('frame'), ...POSE],
  Twist: TWIST,
  TwistStamped: [stamp, skipped('frame'), ...TWIST],
  Vector: numbers('x', 'y', 'z'),
  Quaternion: numbers('x', 'y', 'z', 'w'),
  Transform: [part('Vector', 'translation'), part('Quaternion', 'rotation')],
  TransformStamped: [stamp, text('frame'), text('child'), part('Transform', 'transform')],
  TFMessage: [{ ...part('TransformStamped', 'transforms'), isArray: true }],
}).map(([name, definitions]) => ({ name, definitions }));

/** @param {string} type one of KINDS @returns {MessageReader<any>} */
function readerOf(type) {
  const { root } = KINDS[type];
  return new MessageReader([...DEFINITIONS.filter(({ name }) => name === root), ...DEFINITIONS]);
}

/**
 * Returns a reader of poses or commands.
 *
 * @param {string} type
 * @returns {(data: Uint8Array) => Reading} throws if the bytes are no such message
 */
export function poseReader(type) {
  const reader = readerOf(type);
  if (KINDS[type].kind === 'commands') {
    return (data) => {
      const { stamp, vx, wz } = reader.readMessage(data);
      return { stamp, a: vx, b: wz, c: 0, isRotation: true };
    };
  }
  return (data) => {
    const { stamp, x, y, qx, qy, qz, qw } = reader.readMessage(data);
    return { stamp, a: x, b: y, c: headingOf(qx, qy, qz, qw), isRotation: isRotation(qx, qy, qz, qw) };
  };
}

/** Name of a frame without the leading slash of the first tf. @param {string} name */
export const withoutSlash = (name) => name.replace(/^\/+/, '');

/** Returns a reader of transforms. @returns {(data: Uint8Array) => Edge[]} throws if the bytes are no such message */
export function edgeReader() {
  const reader = readerOf('tf2_msgs/msg/TFMessage');
  return (data) =>
    reader.readMessage(data).transforms.map((/** @type {any} */ { stamp, frame, child, transform }) => ({
      parent: withoutSlash(frame),
      child: withoutSlash(child),
      stamp,
      transform,
    }));
}
