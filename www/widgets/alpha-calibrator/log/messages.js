/** The messages of ROS 2 that hold poses or commands: what is at their beginning, as far as it is read. */

import { MessageReader } from '@foxglove/rosmsg2-serialization';
import { headingOf, isRotation } from './table.js';

/**
 * @typedef {{ sec: number, nanosec: number }} Stamp
 * @typedef {{ x: number, y: number, z: number }} Vector
 * @typedef {Vector & { w: number }} Quaternion
 * @typedef {{ translation: Vector, rotation: Quaternion }} Transform
 *
 * @typedef {object} Reading
 * @property {Stamp} [stamp] when it was true; where there is none, when it was recorded
 * @property {number} a x, or v
 * @property {number} b y, or omega
 * @property {number} c heading, or 0
 * @property {boolean} isRotation whether the heading is one
 *
 * @typedef {object} Kind of message
 * @property {'poses' | 'commands' | 'transforms'} kind
 * @property {string} root what of it is read
 */

/** By their types. @type {Record<string, Kind>} */
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

/** A text that nobody reads: its bytes come after their number, as those of an array, and to decode it takes as long as all the rest. */
const unread = (/** @type {string} */ name) => ({ type: 'uint8', name, isArray: true });

/** The numbers of a pose, and those of a twist. */
const [POSE, TWIST] = [numbers('x', 'y', 'z', 'qx', 'qy', 'qz', 'qw'), numbers('vx', 'vy', 'vz', 'wx', 'wy', 'wz')];

/**
 * Their fields, in order. A recording says them too, and anything else it likes; they have been the same in all of ROS 2.
 * What comes after these, covariances and the like, is not read. Parts that are always there are written out: in the bytes nothing is
 * between them.
 */
const DEFINITIONS = Object.entries({
  Odometry: [stamp, unread('frame'), unread('child'), ...POSE],
  PoseStamped: [stamp, unread('frame'), ...POSE],
  Twist: TWIST,
  TwistStamped: [stamp, unread('frame'), ...TWIST],
  Vector: numbers('x', 'y', 'z'),
  Quaternion: numbers('x', 'y', 'z', 'w'),
  Transform: [part('Vector', 'translation'), part('Quaternion', 'rotation')],
  TransformStamped: [stamp, text('frame'), text('child'), part('Transform', 'transform')],
  TFMessage: [{ ...part('TransformStamped', 'transforms'), isArray: true }],
}).map(([name, definitions]) => ({ name, definitions }));

/** @param {string} type one of KINDS @returns {MessageReader<any>} */
function readerOf(type) {
  const { root } = KINDS[type];
  const first = DEFINITIONS.filter(({ name }) => name === root);
  return new MessageReader([...first, ...DEFINITIONS]);
}

/**
 * @param {string} type of poses or commands
 * @returns {(data: Uint8Array) => Reading} throws where bytes are no such message
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

/** @param {Vector} position @param {Quaternion} turned */
export function planar(position, { x, y, z, w }) {
  return { a: position.x, b: position.y, c: headingOf(x, y, z, w), isRotation: isRotation(x, y, z, w) };
}

/** The name of a frame: those of the first tf began with a slash. @param {string} name */
export const bare = (name) => name.replace(/^\/+/, '');

/**
 * @typedef {object} Edge
 * @property {string} parent
 * @property {string} child
 * @property {Stamp} stamp
 * @property {Transform} transform of the child's frame in the parent's
 *
 * @returns {(data: Uint8Array) => Edge[]} throws where bytes are no message of transforms
 */
export function edgeReader() {
  const reader = readerOf('tf2_msgs/msg/TFMessage');
  return (data) =>
    reader.readMessage(data).transforms.map((/** @type {any} */ { stamp, frame, child, transform }) => ({
      parent: bare(frame),
      child: bare(child),
      stamp,
      transform,
    }));
}
