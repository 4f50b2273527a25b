/** Command `calibrate`: reads logs, calibrates, and prints the result. */

import { openAsBlob } from 'node:fs';
import { stat } from 'node:fs/promises';
import { basename } from 'node:path';
import { after, ambiguousSeries, guessSeries, pairLogs, usefulSeries } from '../logs/drives.ts';
import { log as words } from '../logs/en.js';
import { LogError, cut } from '../logs/log-error.js';
import { openRecordings } from '../logs/open.ts';
import { summarize } from '../logs/summary.ts';
import { HELP, UsageError, optionsOf, withOption } from './options.js';
import { jsonOf, textOf } from './report.js';

/**
 * @import { Role } from '../logs/drives.ts'
 * @import { Choice, Log, Recording } from '../logs/log.ts'
 * @import { Input, Options } from './options.js'
 *
 * @typedef {{ odometry: Log, reference: Log, start: number }} Pair logs of one drive
 *
 * @typedef {object} Environment
 * @property {() => Promise<any>} load the core
 * @property {(text: string) => void} print
 * @property {(text: string) => void} complain
 * @property {Date} [now]
 */

/** Options that choose a topic of a recording. */
const TOPIC_OPTIONS = { odometry: '--odometry-topic', reference: '--reference-topic' };

/** Options that choose the frames of a topic of transforms. */
const FRAMES_OPTIONS = { odometry: '--odometry-frames', reference: '--reference-frames' };

/** Exit codes of a shell. */
const [SUCCESS, BAD_INPUT] = [0, 2];

/**
 * Runs the command.
 *
 * @param {string[]} args
 * @param {Environment} environment
 * @returns {Promise<number>} exit code; rejects on a defect of the program
 */
export async function run(args, { load, print, complain, now = new Date() }) {
  try {
    const options = optionsOf(args);
    if (!options) {
      print(HELP);
      return SUCCESS;
    }
    const { drives, fit, json } = options;
    /** @type {Pair[]} */
    const pairs = [];
    for (const drive of drives) pairs.push(await read(drive, fit));
    const calibration = calibrate(await load(), fit, pairs);
    const logs = pairs.flatMap(({ odometry, reference }) => [odometry, reference]).map((log) => ({ name: log.name, found: summarize(log, words.found) }));
    const result = { calibration, options: fit, logs, start: pairs[0].start, date: now.toISOString().slice(0, 10) };
    print(json ? jsonOf(result) : textOf(result));
    return SUCCESS;
  } catch (error) {
    if (!(error instanceof LogError || error instanceof UsageError)) throw error;
    complain(`${error.message}\n`);
    return BAD_INPUT;
  }
}

/**
 * @param {any} motion
 * @param {Options['fit']} fit
 * @param {Pair[]} pairs
 */
function calibrate(motion, fit, pairs) {
  const [{ start }] = pairs;
  const dataOf = (/** @type {Role} */ role) => pairs.map(({ [role]: log }) => after(start, log).data);
  try {
    return motion.calibrate({ ...fit, odometry: dataOf('odometry'), reference: dataOf('reference') });
  } catch (error) {
    if (!(error instanceof RangeError || error instanceof TypeError)) throw error;
    const names = pairs.flatMap(({ odometry, reference }) => [odometry.name, reference.name]);
    throw new UsageError(withOption(error.message) ?? `${new Intl.ListFormat('en').format(names)}: ${error.message}.`);
  }
}

/**
 * Reads the logs of a drive.
 *
 * @param {Options['drives'][number]} drive
 * @param {Options['fit']} fit
 * @returns {Promise<Pair>}
 */
async function read(drive, fit) {
  const [odometry, reference] = await logsOf(drive, fit);
  return pairLogs(odometry, reference);
}

/** @param {Options['drives'][number]} drive @param {Options['fit']} fit @returns {Promise<Log[]>} odometry and reference */
async function logsOf({ odometry, reference }, fit) {
  const kind = fit.model === 'velocity' ? 'commands' : undefined;
  if (odometry.path !== reference.path) return [await readOne(odometry, 'odometry', kind), await readOne(reference, 'reference', 'poses')];
  const recording = await open(odometry.path);
  if (isTable(recording)) {
    throw new UsageError(`${recording.name} is no MCAP recording; expected is one for both odometry and reference, or two tables.`);
  }
  return recording.read([choiceOf(recording, odometry, 'odometry', kind), choiceOf(recording, reference, 'reference', 'poses')]);
}

/** @param {Input} input @param {Role} role @param {Choice['kind']} kind */
async function readOne(input, role, kind) {
  const recording = await open(input.path);
  const { topic, frames } = input;
  const wanted = topic !== undefined ? `topic ${cut(topic)}` : frames && `frames ${cut(frames.parent)} and ${cut(frames.child)}`;
  if (isTable(recording) && wanted) throw new UsageError(`${recording.name} is no recording and has no ${wanted}; expected is an MCAP file.`);
  const [log] = await recording.read([isTable(recording) ? { series: '', kind } : choiceOf(recording, input, role, kind)]);
  return log;
}

/** @param {Recording} recording */
const isTable = ({ format }) => format === 'csv' || format === 'tum';

/** @param {string} path @returns {Promise<Recording>} */
async function open(path) {
  const [recording] = await openRecordings([await fileOf(path)]);
  return recording;
}

/** @param {string} path @returns {Promise<File>} rejects with a LogError if there is no such file */
async function fileOf(path) {
  const name = basename(path);
  try {
    if (!(await stat(path)).isFile()) throw Object.assign(new Error(), { code: 'no file' });
    return new File([await openAsBlob(path)], name);
  } catch (error) {
    const { code } = /** @type {NodeJS.ErrnoException} */ (error);
    throw new LogError({ file: name }, (say) => say.gone(String(code)));
  }
}

/**
 * Chooses a log of a recording.
 *
 * @param {Recording} recording
 * @param {Input} input
 * @param {Role} role
 * @param {Choice['kind']} kind
 * @returns {Choice}
 */
function choiceOf({ name, series }, { topic, frames }, role, kind) {
  return { series: topic ?? guess(name, series, role, kind, frames), frames, kind };
}

/**
 * @param {string} file
 * @param {Recording['series']} series
 * @param {Role} role
 * @param {Choice['kind']} kind
 * @param {Choice['frames']} frames
 */
function guess(file, series, role, kind, frames) {
  const useful = usefulSeries(file, series);
  // Static transforms have a topic of their own, which is read with any other.
  const [transforms, ...more] = frames ? useful.filter(({ name, kind }) => kind === 'transforms' && !/static/.test(name)) : [];
  if (transforms && more.length === 0) return transforms.name;
  // In a recording of transforms alone the frames identify the topic.
  const options = useful.every(({ kind }) => kind === 'transforms') ? FRAMES_OPTIONS : TOPIC_OPTIONS;
  const guessed = guessSeries(series, kind)[role];
  if (guessed === null) throw ambiguousSeries(file, useful, role, options[role]);
  return guessed;
}
