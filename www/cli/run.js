/** The command: reads logs, has the core calibrate, and says what came out. */

import { log as words } from '../widgets/alpha-calibrator/log/en.js';
import { isRecording, logsOf, readLog, tell, together, topicsOf, unclear, usefulTopics, usualTopics } from '../widgets/alpha-calibrator/log/read.js';
import { LogError, cut } from '../widgets/alpha-calibrator/log/refusal.js';
import { onDisk } from './disk.js';
import { HELP, UsageError, optionsOf, refusalOf } from './options.js';
import { jsonOf, textOf } from './report.js';

/**
 * @import { Choice, Topic } from '../widgets/alpha-calibrator/log/read.js'
 * @import { Log } from '../widgets/alpha-calibrator/log/rows.js'
 * @import { Asked, Part } from './options.js'
 *
 * @typedef {object} Surroundings
 * @property {() => Promise<any>} load the core
 * @property {(text: string) => void} print
 * @property {(text: string) => void} complain
 * @property {Date} [now]
 */

/** By which options a topic of a recording is chosen, or the frames of its transforms. */
const [TOPIC_OPTIONS, FRAMES_OPTIONS] = [{ odometry: '--odom-topic', reference: '--reference-topic' }, { odometry: '--odom-frames', reference: '--frames' }];

/** What a shell is told: all is well, or what was asked for or given is not. */
const [WELL, BAD_INPUT] = [0, 2];

/**
 * @param {string[]} args
 * @param {Surroundings} surroundings
 * @returns {Promise<number>} the exit code; what is a mistake of the program is thrown
 */
export async function run(args, { load, print, complain, now = new Date() }) {
  try {
    const asked = optionsOf(args);
    if (!asked) {
      print(HELP);
      return WELL;
    }
    const logs = together(...(await read(asked)));
    const motion = await load();
    const calibration = calibrate(motion, asked, logs);
    const told = [logs.odometry, logs.reference].map((log) => ({ name: log.name, found: tell(log, words.found) }));
    const result = { calibration, fit: asked.fit, deviations: asked.deviations, logs: told, start: logs.start, date: now.toISOString().slice(0, 10) };
    print(asked.json ? jsonOf(result) : textOf(result));
    return WELL;
  } catch (error) {
    if (!(error instanceof LogError || error instanceof UsageError)) throw error;
    complain(`${error.message}\n`);
    return BAD_INPUT;
  }
}

/**
 * @param {any} motion
 * @param {Asked} asked
 * @param {{ odometry: Log, reference: Log }} logs
 */
function calibrate(motion, { fit, deviations }, { odometry, reference }) {
  try {
    return motion.calibrate({ ...fit, odometry: odometry.data, reference: { ...reference.data, ...deviations } });
  } catch (error) {
    // It names a field, the value, and what is allowed.
    if (!(error instanceof RangeError || error instanceof TypeError)) throw error;
    throw new UsageError(refusalOf(error.message) ?? `${odometry.name} and ${reference.name}: ${error.message}.`);
  }
}

/**
 * @typedef {'odometry' | 'reference'} Role
 *
 * @param {Asked} asked
 * @returns {Promise<[odometry: Log, reference: Log]>}
 */
async function read(asked) {
  const both = asked.odometry.path === asked.reference.path && (await readBoth(asked));
  return both || [await readOne(asked.odometry, 'odometry', asked), await readOne(asked.reference, 'reference', asked)];
}

/**
 * @param {Asked} asked of one file
 * @returns {Promise<[Log, Log] | undefined>} nothing where it is no recording
 */
function readBoth(asked) {
  return withSource(asked.odometry.path, async (source) => {
    if (source.size === 0 || !(await isRecording(source))) return undefined;
    const topics = once(() => topicsOf(source));
    const odometry = await choiceOf(asked.odometry, 'odometry', asked, source, topics);
    let reference;
    try {
      reference = await choiceOf(asked.reference, 'reference', asked, source, topics);
    } catch (error) {
      // What is wrong with the odometry is told first.
      await logsOf(source, [odometry]);
      throw error;
    }
    return /** @type {[Log, Log]} */ (await logsOf(source, [odometry, reference]));
  });
}

/**
 * @param {Part} part
 * @param {Role} role
 * @param {Asked} asked
 * @returns {Promise<Log>}
 */
function readOne(part, role, asked) {
  return withSource(part.path, async (source) => {
    if (source.size === 0 || !(await isRecording(source))) {
      if (part.topic !== undefined) throw new UsageError(`${source.name} is no recording and has no topic ${cut(part.topic)}; expected is an MCAP file.`);
      if (part.frames) throw new UsageError(`${source.name} is no recording and has no frames ${cut(part.frames.parent)} and ${cut(part.frames.child)}; expected is an MCAP file.`);
      if (asked.odometry.path === asked.reference.path) throw new UsageError(`${source.name} is no MCAP recording; expected is one for both odometry and reference, or two tables.`);
      return readLog(source, { kind: kindOf(role, asked) });
    }
    return readLog(source, await choiceOf(part, role, asked, source, () => topicsOf(source)));
  });
}

/**
 * @template Result
 * @param {string} path
 * @param {(source: Awaited<ReturnType<typeof onDisk>>) => Promise<Result>} work
 */
async function withSource(path, work) {
  const source = await onDisk(path);
  try {
    return await work(source);
  } finally {
    await source.close();
  }
}

/** @param {Role} role @param {Asked} asked */
const kindOf = (role, { fit }) => (role === 'reference' ? 'poses' : fit.model === 'velocity' ? 'commands' : undefined);

/**
 * What of a recording is to be read.
 *
 * @param {Part} part
 * @param {Role} role
 * @param {Asked} asked
 * @param {{ name: string }} source
 * @param {() => Promise<Topic[]>} topics
 * @returns {Promise<Choice>}
 */
async function choiceOf({ topic, frames }, role, asked, { name }, topics) {
  const kind = kindOf(role, asked);
  return { topic: topic ?? usualTopic(name, await topics(), role, kind, frames), frames, kind };
}

/**
 * @param {string} file
 * @param {Topic[]} topics
 * @param {Role} role
 * @param {'poses' | 'commands' | undefined} kind
 * @param {Choice['frames']} frames
 */
function usualTopic(file, topics, role, kind, frames) {
  const useful = usefulTopics(file, topics);
  // What never changes has a topic of its own, which is read with any.
  const [transforms, ...more] = frames ? useful.filter(({ name, kind }) => kind === 'transforms' && !/static/.test(name)) : [];
  if (transforms && more.length === 0) return transforms.name;
  const usual = usualTopics(topics, kind)[role];
  // Of transforms alone the frames tell all.
  const options = useful.every(({ kind }) => kind === 'transforms') ? FRAMES_OPTIONS : TOPIC_OPTIONS;
  if (usual === null) throw unclear(file, useful, role, options[role]);
  return usual;
}

/** @template Result @param {() => Result} work @returns {() => Result} that does it when first asked, and once */
function once(work) {
  /** @type {{ result: Result } | undefined} */
  let done;
  return () => (done ??= { result: work() }).result;
}
