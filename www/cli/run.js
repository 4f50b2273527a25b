/** The command: reads logs, has the core calibrate, and says what came out. */

import { log as words } from '../widgets/alpha-calibrator/log/en.js';
import { isRecording, readLog, tell, together, topicsOf, usualTopics } from '../widgets/alpha-calibrator/log/read.js';
import { LogError, cut, listed } from '../widgets/alpha-calibrator/log/refusal.js';
import { onDisk } from './disk.js';
import { HELP, UsageError, optionsOf, refusalOf } from './options.js';
import { jsonOf, textOf } from './report.js';

/**
 * @import { Log } from '../widgets/alpha-calibrator/log/rows.js'
 * @import { Asked, Part } from './options.js'
 *
 * @typedef {object} Surroundings
 * @property {() => Promise<any>} load the core
 * @property {(text: string) => void} print
 * @property {(text: string) => void} complain
 * @property {Date} [now]
 */

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
    const logs = together(await read(asked.odometry, 'odometry', asked), await read(asked.reference, 'reference', asked));
    const motion = await load();
    const calibration = calibrate(motion, asked, logs);
    const told = [logs.odometry, logs.reference].map((log) => ({ name: log.name, found: tell(log, words.found) }));
    const result = { calibration, fit: asked.fit, logs: told, start: logs.start, date: now.toISOString().slice(0, 10) };
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
    throw new UsageError(refusalOf(error.message) ?? `${odometry.name} and ${reference.name}: ${error.message}`);
  }
}

/**
 * @param {Part} part
 * @param {'odometry' | 'reference'} role
 * @param {Asked} asked
 * @returns {Promise<Log>}
 */
async function read({ path, topic, frames }, role, { fit, odometry, reference }) {
  const source = await onDisk(path);
  try {
    const kind = role === 'reference' ? 'poses' : fit.model === 'velocity' ? 'commands' : undefined;
    if (source.size === 0 || !(await isRecording(source))) {
      if (topic !== undefined) throw new UsageError(`${source.name} is no recording and has no topic ${cut(topic)}; expected is an MCAP file.`);
      if (odometry.path === reference.path) throw new UsageError(`${source.name} is both odometry and reference; expected are two tables, or an MCAP file.`);
      return await readLog(source, { kind });
    }
    return await readLog(source, { topic: topic ?? (await usualTopic(source, role, kind)), frames, kind });
  } finally {
    await source.close();
  }
}

/**
 * @param {import('../widgets/alpha-calibrator/log/refusal.js').Source} source
 * @param {'odometry' | 'reference'} role
 * @param {'poses' | 'commands' | undefined} kind
 */
async function usualTopic(source, role, kind) {
  const topics = await topicsOf(source);
  const useful = topics.filter(({ kind, count }) => kind !== null && count > 1);
  const described = (/** @type {typeof topics} */ some) => listed(some.map(({ name, type }) => `${name} (${type.replace(/^.*\//, '')})`));
  if (useful.length === 0) throw new LogError({ file: source.name }, (say) => say.noTopics(described(topics)));
  const usual = usualTopics(topics)[kind === 'commands' ? 'commands' : role];
  if (usual === null) throw new LogError({ file: source.name }, (say) => say.choose(role, described(useful)));
  return usual;
}
