/** Logs of robots: poses or commands with times, from CSV, TUM and MCAP files. */

import { withoutFrozenPoses } from './frozen-pose.js';
import { LogError, bytesOf, listed } from './log-error.js';
import { LOG_TIME, reasonsOf } from './rows.js';
import { readTable } from './table.js';

/**
 * @import { Source, Watching, Words } from './log-error.js'
 * @import { Log } from './rows.js'
 *
 * @typedef {object} Topic of a recording
 * @property {string} name
 * @property {string} type
 * @property {number} count of its messages
 * @property {'poses' | 'commands' | 'transforms' | null} kind null for other types
 *
 * @typedef {object} Choice of a log
 * @property {'poses' | 'commands'} [kind] poses, or commands if there are any; by default poses of a table that has both
 * @property {string} [topic] of a recording
 * @property {{ parent: string, child: string }} [frames] of a topic of transforms
 */

export { LogError };

/** First bytes of a recording. */
const MAGIC = [0x89, 0x4d, 0x43, 0x41, 0x50, 0x30, 0x0d, 0x0a];

/** Checks whether a file is a recording. @param {Source} source @returns {Promise<boolean>} */
export async function isRecording(source) {
  const start = await bytesOf(source, 0, MAGIC.length);
  return MAGIC.every((byte, i) => byte === start[i]);
}

/**
 * Lists the topics of a recording.
 *
 * @param {Source} source
 * @param {Watching} [watching]
 * @returns {Promise<Topic[]>} by name; rejects with a LogError
 */
export async function topicsOf(source, watching = {}) {
  const { listTopics } = await import('./recording.js');
  return listTopics(source, watching);
}

/**
 * Reads one log.
 *
 * @param {Source} source
 * @param {Choice & Watching} [choice]
 * @returns {Promise<Log>} rejects with a LogError that names file, line or topic, and what is expected
 */
export async function readLog(source, { kind, topic, frames, ...watching } = {}) {
  if (!(await isRecording(source))) return readTable(source, kind, watching);
  const [log] = await logsOf(source, [{ kind, topic, frames }], watching);
  return log;
}

/**
 * Reads several logs of a recording in one pass.
 *
 * @param {Source} source
 * @param {Choice[]} choices
 * @param {Watching} [watching]
 * @returns {Promise<Log[]>} one for each choice; rejects as `readLog`
 */
export async function logsOf(source, choices, watching = {}) {
  const { readRecording } = await import('./recording.js');
  return readRecording(source, choices, watching);
}

/** Topics with their types, for a sentence. @param {Topic[]} topics */
const described = (topics) => listed(topics.map(({ name, type }) => `${name} (${type.replace(/^.*\//, '')})`));

/**
 * Returns the topics with messages that can be read.
 *
 * @param {string} file
 * @param {Topic[]} topics
 * @throws {LogError} if there are none
 */
export function usefulTopics(file, topics) {
  const useful = topics.filter(({ kind, count }) => kind !== null && count > 1);
  if (useful.length === 0) throw new LogError({ file }, (say) => say.noTopics(described(topics)));
  return useful;
}

/**
 * Error about a topic that has to be chosen.
 *
 * @param {string} file
 * @param {Topic[]} topics that can be read
 * @param {'odometry' | 'reference'} role
 * @param {string} [option] of the command line
 */
export function ambiguousTopic(file, topics, role, option) {
  // Transforms may have both, of other frames.
  const isAlone = topics.length === 1 && topics[0].kind !== 'transforms';
  return new LogError({ file }, (say) => (isAlone ? say.alone(described(topics)) : say.choose(role, described(topics), option)));
}

const NAME_OF_ODOMETRY = /odom|wheel|cmd/i;

/**
 * Checks whether the second of two tables is named like an odometry, and the first is not.
 *
 * @param {string} first
 * @param {string} second
 */
export const areSwapped = (first, second) => NAME_OF_ODOMETRY.test(second) && !NAME_OF_ODOMETRY.test(first);

/** Usual names of topics of odometry, commands and references. */
const ODOMETRY = /(^|\/)odom(etry)?$/i;
const COMMANDS = /(^|\/)cmd_vel$/i;
const REFERENCE = /truth|gt|mocap|vicon|optitrack|qualisys|vrpn|reference|station|slam|amcl/i;

/**
 * Guesses the topics by their types and names.
 *
 * @param {Topic[]} topics
 * @param {'poses' | 'commands'} [kind] of the odometry, as of a choice
 * @returns {{ odometry: string | null, reference: string | null }} null for an ambiguous one
 */
export function guessTopics(topics, kind) {
  const of = (/** @type {Topic['kind']} */ wanted) => topics.filter(({ kind, count }) => kind === wanted && count > 1);
  /** Name of the only topic that matches, or of the only one. @param {Topic[]} some @param {RegExp} name */
  const guess = (some, name) => {
    const named = some.filter((topic) => name.test(topic.name));
    const [only] = named.length === 1 ? named : some.length === 1 ? some : [];
    return only?.name ?? null;
  };
  const poses = of('poses');
  const odometry = guess(poses.filter(({ type, name }) => type === 'nav_msgs/msg/Odometry' && !REFERENCE.test(name)), ODOMETRY);
  const commands = kind === 'commands' ? guess(of('commands'), COMMANDS) : null;
  return { odometry: commands ?? odometry, reference: guess(poses.filter(({ name }) => name !== odometry), REFERENCE) };
}

/**
 * Pairs two logs of one drive: with times after the same start, and without rows in which the reference had lost the robot. Logs
 * without a common time are reported.
 *
 * @param {Log} odometry
 * @param {Log} reference with poses
 * @returns {{ odometry: Log, reference: Log, start: number }}
 * @throws {LogError} if the reference has no poses, or does not follow the robot
 */
export function pairLogs(odometry, reference) {
  const place = { file: reference.name };
  if (reference.how.format === 'mcap' && odometry.name === reference.name) throw new LogError(place, (say) => say.same);
  if (reference.kind === 'commands') throw new LogError(place, (say) => say.noColumns('poses', 't, v, omega'));
  const start = Math.min(odometry.start, reference.start);
  const [first, second] = [odometry, reference].map((log) => after(start, log));
  const [one, other] = [first.data.t, second.data.t];
  const isApart = one[0] > other[other.length - 1] || other[0] > one[one.length - 1];
  const reliable = withoutFrozenPoses(second, first);
  if (reliable.data.t.length < 2) throw new LogError(place, (say) => say.held);
  const isSwapped = reliable.how.format !== 'mcap' && areSwapped(odometry.name, reference.name);
  /** @type {Log['how']} */
  const how = {
    ...reliable.how,
    ...(isSwapped && { swapped: odometry.name }),
    ...(isApart && { apart: [odometry.name, span(reference), span(odometry)] }),
  };
  return { odometry: first, reference: { ...reliable, how }, start };
}

/** Moves times to another start. @param {number} start @param {Log} log @returns {Log} */
export function after(start, log) {
  const later = log.start - start;
  return later === 0 ? log : { ...log, start, data: { ...log.data, t: log.data.t.map((each) => each + later) } };
}

/** @param {Log} log */
function span({ start, data: { t } }) {
  const [from, to] = [t[0], t[t.length - 1]].map((each) => (start + each).toFixed(2));
  return `${from} s to ${to} s`;
}

/**
 * Summarizes a log, with a sentence for each decision and each reason for leaving rows out.
 *
 * @param {Log} log
 * @param {Words['found']} say
 * @returns {string[]}
 */
export function summarize({ data: { t }, how, found }, say) {
  const { rows, leftOut, gaps, jumps, step } = found;
  return [
    say.rows(t.length, rows, t[t.length - 1] - t[0], 1 / step),
    ...(how.unitBy === 'size' && how.unit !== 's' ? [say.unit(how.unit)] : []),
    ...(how.columns.clock === LOG_TIME ? [say.logTimes] : []),
    ...(how.heading === 'degrees' ? [say.degrees] : []),
    ...reasonsOf(leftOut).map(([reason, { count, line }]) => say.leftOut(reason, count, how.format === 'mcap' ? 0 : line)),
    ...(gaps.count ? [say.gaps(gaps.count, gaps.time, gaps.longest)] : []),
    ...(jumps.count ? [say.jumps(jumps.count, jumps.time)] : []),
    ...(how.cutShort ? [say.cutShort] : []),
    ...(how.swapped ? [say.swapped(how.swapped)] : []),
    ...(how.apart ? [say.apart(...how.apart)] : []),
  ];
}
