/** Logs of robots: poses or commands with times, of CSV, TUM and MCAP files. */

import { turn } from '../../../figure/breath.js';
import { LOG_TIME } from './rows.js';
import { withoutHeld } from './held.js';
import { LogError, bytesOf, listed } from './refusal.js';
import { readTable } from './table.js';

/**
 * @import { Watching } from '../../../figure/breath.js'
 * @import { Source, Words } from './refusal.js'
 * @import { Log, Reason } from './rows.js'
 *
 * @typedef {object} Topic of a recording
 * @property {string} name
 * @property {string} type
 * @property {number} count of its messages
 * @property {'poses' | 'commands' | 'transforms' | null} kind what it holds; null where it is of no use here
 *
 * @typedef {object} Choice what is to be read
 * @property {'poses' | 'commands'} [kind] poses, or commands where there are some; of a table that has both, poses where nothing is said
 * @property {string} [topic] of a recording
 * @property {{ parent: string, child: string }} [frames] of a topic of transforms
 */

export { LogError, turn };

/** The first bytes of every recording. */
const MAGIC = [0x89, 0x4d, 0x43, 0x41, 0x50, 0x30, 0x0d, 0x0a];

/** Whether a file is a recording, with topics to choose of. @param {Source} source @returns {Promise<boolean>} */
export async function isRecording(source) {
  const start = await bytesOf(source, 0, MAGIC.length);
  return MAGIC.every((byte, i) => byte === start[i]);
}

/**
 * @param {Source} source a recording
 * @param {Watching} [watching]
 * @returns {Promise<Topic[]>} by their names; rejects with a LogError
 */
export async function topicsOf(source, watching = {}) {
  const { listTopics } = await import('./recording.js');
  return listTopics(source, watching);
}

/**
 * @param {Source} source
 * @param {Choice & Watching} [choice]
 * @returns {Promise<Log>} rejects with a LogError that names file, line or topic, and what is expected
 */
export async function readLog(source, { kind, topic, frames, ...watching } = {}) {
  if (source.size === 0) throw new LogError({ file: source.name }, (say) => say.empty);
  if (!(await isRecording(source))) return readTable(source, kind, watching);
  const [log] = await logsOf(source, [{ kind, topic, frames }], watching);
  return log;
}

/**
 * Several logs of a recording, which is gone through once.
 *
 * @param {Source} source a recording
 * @param {Choice[]} choices
 * @param {Watching} [watching]
 * @returns {Promise<Log[]>} one a choice; rejects as `readLog` of the first that is refused
 */
export async function logsOf(source, choices, watching = {}) {
  const { readRecording } = await import('./recording.js');
  return readRecording(source, choices, watching);
}

/** Topics with their types, as a sentence names them. @param {Topic[]} topics */
export const described = (topics) => listed(topics.map(({ name, type }) => `${name} (${type.replace(/^.*\//, '')})`));

/**
 * Those that hold something for which there is a use.
 *
 * @param {string} file
 * @param {Topic[]} topics
 * @throws {LogError} where there are none
 */
export function usefulTopics(file, topics) {
  const useful = topics.filter(({ kind, count }) => kind !== null && count > 1);
  if (useful.length === 0) throw new LogError({ file }, (say) => say.noTopics(described(topics)));
  return useful;
}

/**
 * @param {string} file
 * @param {Topic[]} topics that are of use
 * @param {{ odometry: string | null, reference: string | null }} usual
 * @throws {LogError} where it is not clear which is which
 */
export function checkClear(file, topics, usual) {
  const role = usual.odometry === null ? 'odometry' : 'reference';
  if (usual[role] === null) throw unclear(file, topics, role);
}

/**
 * @param {string} file
 * @param {Topic[]} topics that are of use
 * @param {'odometry' | 'reference'} role
 * @param {string} [option] by which one is chosen
 */
export function unclear(file, topics, role, option) {
  // Transforms may have both, of other frames.
  const isAlone = topics.length === 1 && topics[0].kind !== 'transforms';
  return new LogError({ file }, (say) => (isAlone ? say.alone(described(topics)) : say.choose(role, described(topics), option)));
}

/** Whether two tables are called as if the second were the odometry, and not the first. @param {string} first @param {string} second */
export const areSwapped = (first, second) => CALLED_ODOMETRY.test(second) && !CALLED_ODOMETRY.test(first);

/** What is in the names of files of odometry. */
const CALLED_ODOMETRY = /odom|wheel|cmd/i;

/** Names that recorders give to odometry, to commands, and to what is better. */
const [ODOMETRY, COMMANDS, REFERENCE] = [/(^|\/)odom(etry)?$/i, /(^|\/)cmd_vel$/i, /truth|gt|mocap|vicon|optitrack|qualisys|vrpn|reference|station|slam|amcl/i];

/**
 * Which topics are meant, where that is clear.
 *
 * @param {Topic[]} topics
 * @param {'poses' | 'commands'} [kind] of the odometry, as of a choice
 * @returns {{ odometry: string | null, reference: string | null }}
 */
export function usualTopics(topics, kind) {
  const poses = topics.filter(({ kind, count }) => kind === 'poses' && count > 1);
  const only = (/** @type {Topic[]} */ some) => (some.length === 1 ? some[0].name : null);
  const ofOdometry = poses.filter(({ type, name }) => type === 'nav_msgs/msg/Odometry' && !REFERENCE.test(name));
  const odometry = only(ofOdometry.filter(({ name }) => ODOMETRY.test(name))) ?? only(ofOdometry);
  const others = poses.filter(({ name }) => name !== odometry);
  const driven = topics.filter(({ kind, count }) => kind === 'commands' && count > 1);
  const commands = only(driven.filter(({ name }) => COMMANDS.test(name))) ?? only(driven);
  return { odometry: kind === 'commands' ? (commands ?? odometry) : odometry, reference: only(others.filter(({ name }) => REFERENCE.test(name))) ?? only(others) };
}

/**
 * Two logs of one drive: the times of both are those after the same start, and the reference is without rows in which it had lost
 * the robot, as far as their clocks tell. Where they have no time in common, that is said.
 *
 * @param {Log} odometry
 * @param {Log} reference of poses
 * @returns {{ odometry: Log, reference: Log, start: number }}
 * @throws {LogError} where the reference has no poses, or none that follow the robot
 */
export function together(odometry, reference) {
  if (reference.how.format === 'mcap' && odometry.name === reference.name && isSame(odometry.data, reference.data)) throw new LogError({ file: reference.name }, (say) => say.same);
  if (reference.kind === 'commands') throw new LogError({ file: reference.name }, (say) => say.noColumns('poses', 't, v, omega'));
  const start = Math.min(odometry.start, reference.start);
  const [first, second] = [odometry, reference].map((log) => after(start, log));
  const [one, other] = [first.data.t, second.data.t];
  const isApart = one[0] > other[other.length - 1] || other[0] > one[one.length - 1];
  const reliable = withoutHeld(second, first);
  if (reliable.data.t.length < 2) throw new LogError({ file: reference.name }, (say) => say.held);
  const isSwapped = reliable.how.format !== 'mcap' && areSwapped(odometry.name, reference.name);
  /** @type {Log['how']} */
  const how = { ...reliable.how, ...(isSwapped && { swapped: odometry.name }), ...(isApart ? { apart: [odometry.name, span(reference), span(odometry)] } : {}) };
  return { odometry: first, reference: { ...reliable, how }, start };
}

/** Whether two logs have the same rows. @param {Log['data']} one @param {Log['data']} other */
const isSame = (one, other) =>
  Object.entries(one).every(([key, numbers]) => {
    const others = /** @type {Record<string, ArrayLike<number>>} */ (other)[key];
    return others?.length === numbers.length && numbers.every((/** @type {number} */ each, /** @type {number} */ i) => each === others[i]);
  });

/** @param {number} start @param {Log} log @returns {Log} */
function after(start, log) {
  const later = log.start - start;
  const { found } = log;
  if (later === 0) return log;
  const moved = (/** @type {any} */ trouble) => ({ ...trouble, t: trouble.t + later });
  return {
    ...log,
    start,
    data: { ...log.data, t: log.data.t.map((each) => each + later) },
    found: {
      ...found,
      gaps: moved(found.gaps),
      jumps: moved(found.jumps),
      leftOut: /** @type {any} */ (Object.fromEntries(Object.entries(found.leftOut).map(([key, each]) => [key, moved(each)]))),
    },
  };
}

/** @param {Log} log */
function span({ start, data: { t } }) {
  const [from, to] = [t[0], t[t.length - 1]].map((each) => (start + each).toFixed(2));
  return `${from} s to ${to} s`;
}

/**
 * What was found in a log, a sentence each: all that was decided or left out.
 *
 * @param {Log} log
 * @param {Words['found']} say
 * @returns {string[]}
 */
export function tell({ data: { t }, start, how, found }, say) {
  const { rows, leftOut, gaps, jumps, step } = found;
  const out = /** @type {[Reason, import('./rows.js').Trouble][]} */ (Object.entries(leftOut)).filter(([, { count }]) => count > 0);
  return [
    say.rows(t.length, rows, t[t.length - 1] - t[0], 1 / step),
    ...(how.unitBy === 'size' && how.unit !== 's' ? [say.unit(how.unit)] : []),
    ...(how.columns.clock === LOG_TIME ? [say.logTimes] : []),
    ...(how.heading === 'degrees' ? [say.degrees] : []),
    ...out.map(([reason, { count, line }]) => say.leftOut(say.reasons[reason], count, how.format === 'mcap' ? 0 : line)),
    ...(gaps.count ? [say.gaps(gaps.count, start + gaps.t, gaps.longest)] : []),
    ...(jumps.count ? [say.jumps(jumps.count, start + jumps.t)] : []),
    ...(how.cutShort ? [say.cutShort] : []),
    ...(how.swapped ? [say.swapped(how.swapped)] : []),
    ...(how.apart ? [say.apart(...how.apart)] : []),
  ];
}
