/** Options of the command line. */

import { parseArgs } from 'node:util';
import { cut } from '../logs/log-error.js';

/** Error about the options; its message is a sentence. */
export class UsageError extends Error {}

export const HELP = `motion-widgets calibrate: the α's of a robot's motion model, from a log

  npx motion-widgets calibrate --odometry odom.csv --reference truth.csv --rule nav2
  npx motion-widgets calibrate --recording run.mcap --odometry-topic /odom --reference-topic /mocap/pose --rule nav2

Logs (times in s or ns, m, rad; numbers with a decimal point):
  --odometry FILE            CSV with a header, TUM, or an MCAP recording of ROS 2; also commands: t, v, omega
  --reference FILE           the same, in any fixed frame: motion capture, total station, scan matching
  --recording FILE           one MCAP recording with both
                             Several drives: give these options several times.
  --odometry-topic NAME      of a recording; not needed where only one topic is possible
  --reference-topic NAME     the same for the reference
  --odometry-frames P,C      parent and child frame, of a topic of transforms: odom,base_link
  --reference-frames P,C     the same for the reference: map,base_link

Fit:
  --model NAME               odometry (default), omnidirectional, velocity
  --rule NAME                of the odometry model: thrun (default, Table 5.6), nav2 (for Nav2's AMCL), beluga;
                             omni is that of the omnidirectional model
  --update-min-d M           a leg ends after so much, as in AMCL; default 0.25
  --update-min-a RAD         or after so much rotation; default 0.2
  --duration S               a leg ends after so long instead
  --outliers NAME            reject (default), keep
  --no-correct NAMES         systematic errors that are left in: all, or some of
                             clockOffset,mountYaw,leverArm,distanceScale,turnScale
  --correct NAMES            systematic errors that are corrected even if they are not constant
  --reference-position-std M known standard deviation of the reference's x and y; default: estimated from the log
  --reference-yaw-std RAD    known standard deviation of its yaw; default: estimated from the log

Output:
  --json                     everything, as JSON
  --help                     this text
`;

const text = /** @type {const} */ ({ type: 'string' });
const texts = /** @type {const} */ ({ type: 'string', multiple: true });
const flag = /** @type {const} */ ({ type: 'boolean' });

const OPTIONS = {
  odometry: texts, reference: texts, recording: texts, 'odometry-topic': text, 'reference-topic': text, 'odometry-frames': text,
  'reference-frames': text, model: text, rule: text, 'update-min-d': text, 'update-min-a': text, duration: text, outliers: text,
  'no-correct': text, correct: text, 'reference-position-std': text, 'reference-yaw-std': text, json: flag, help: flag,
};

/** Systematic errors that can be corrected before the α's are fitted. */
const SYSTEMATIC = ['clockOffset', 'mountYaw', 'leverArm', 'distanceScale', 'turnScale'];

/** Options by the fields of `calibrate`. @type {Record<string, string>} */
const BY_FIELD = {
  'legs.distance': 'update-min-d', 'legs.angle': 'update-min-a', 'legs.duration': 'duration',
  positionStd: 'reference-position-std', yawStd: 'reference-yaw-std', model: 'model', rule: 'rule', outliers: 'outliers',
};

/**
 * Names the option that an error of the core is about.
 *
 * @param {string} message begins with a field
 * @returns {string | undefined} nothing if the error is about the logs
 */
export function withOption(message) {
  const [field] = message.split(' ');
  return Object.hasOwn(BY_FIELD, field) ? `--${BY_FIELD[field]}${message.slice(field.length)}.` : undefined;
}

/**
 * @typedef {object} Options
 * @property {{ odometry: Input, reference: Input }[]} drives
 * @property {Record<string, any>} fit options of `calibrate`
 * @property {boolean} json
 *
 * @typedef {'update-min-d' | 'update-min-a' | 'duration' | 'reference-position-std' | 'reference-yaw-std'} Numeric option
 *
 * @typedef {object} Input
 * @property {string} path
 * @property {string | undefined} topic
 * @property {{ parent: string, child: string } | undefined} frames
 */

/**
 * Parses the arguments.
 *
 * @param {string[]} args
 * @returns {Options | undefined} nothing for help
 * @throws {UsageError}
 */
export function optionsOf(args) {
  const { values, positionals: [command, stray] } = parsed(args);
  if (values.help || args.length === 0) return undefined;
  if (command !== 'calibrate') throw new UsageError(`the command is “${cut(command ?? '')}”; expected is calibrate.`);
  if (stray !== undefined) throw new UsageError(`“${cut(stray)}” belongs to no option; expected are options such as --odometry.`);

  const number = (/** @type {Numeric} */ name) => {
    const value = values[name];
    if (value === undefined) return undefined;
    const parsed = value.trim() === '' ? NaN : Number(value);
    if (Number.isFinite(parsed)) return parsed;
    const point = /^-?\d*,\d+$/.test(value) ? ` with a decimal point, ${value.replace(',', '.')}` : '';
    throw new UsageError(`--${name} is “${cut(value)}”; expected is a number${point}.`);
  };
  const [distance, angle, duration] = [number('update-min-d'), number('update-min-a'), number('duration')];
  if (duration !== undefined && (distance ?? angle) !== undefined) {
    throw new UsageError(`--duration is ${duration} beside --update-min-d or --update-min-a; expected is either the one or the others.`);
  }
  const inputsOf = (/** @type {'odometry' | 'reference'} */ role) => {
    const paths = values[role] ?? values.recording ?? [''];
    if (paths.includes('')) throw new UsageError(`--${role} is missing; expected is a file, or --recording with both.`);
    const frames = framesOf(`${role}-frames`, values[`${role}-frames`]);
    return paths.map((path) => ({ path, topic: values[`${role}-topic`], frames }));
  };
  const [odometry, reference] = [inputsOf('odometry'), inputsOf('reference')];
  if (odometry.length !== reference.length) {
    throw new UsageError(`there are ${odometry.length} logs of odometry and ${reference.length} of the reference; expected is one of each for a drive.`);
  }
  return {
    drives: odometry.map((each, i) => ({ odometry: each, reference: reference[i] })),
    fit: defined({
      legs: duration === undefined ? { distance: distance ?? 0.25, angle: angle ?? 0.2 } : { duration },
      model: values.model ?? (values.rule === 'omni' ? 'omnidirectional' : undefined),
      rule: values.rule,
      outliers: values.outliers,
      correct: correctOf(values['no-correct'], values.correct),
      positionStd: number('reference-position-std'),
      yawStd: number('reference-yaw-std'),
    }),
    json: values.json ?? false,
  };
}

/** @template {object} T @param {T} all @returns {T} without keys that are undefined */
const defined = (all) => /** @type {T} */ (Object.fromEntries(Object.entries(all).filter(([, value]) => value !== undefined)));

/**
 * @param {string} [left] names of --no-correct
 * @param {string} [corrected] names of --correct
 * @returns {Record<string, boolean> | undefined}
 */
function correctOf(left, corrected) {
  const lists = [namesOf('no-correct', left), namesOf('correct', corrected)];
  // Single names override `all`.
  const [all, single] = [true, false].map((isAll) => lists.flatMap((names, i) => (names.includes('all') === isAll ? names : []).map((name) => [name, i === 1])));
  const entries = [...all.flatMap(([, is]) => SYSTEMATIC.map((name) => [name, is])), ...single];
  return entries.length ? Object.fromEntries(entries) : undefined;
}

/** @param {string} option @param {string} [value] @returns {string[]} */
function namesOf(option, value) {
  const names = value?.split(',').map((name) => name.trim()) ?? [];
  const unknown = names.find((name) => name !== 'all' && !SYSTEMATIC.includes(name));
  if (unknown === undefined) return names;
  throw new UsageError(`--${option} has “${cut(unknown)}”; expected is all, or names of ${SYSTEMATIC.join(', ')}.`);
}

/** @param {string[]} args */
function parsed(args) {
  try {
    return parseArgs({ args, options: OPTIONS, allowPositionals: true });
  } catch (error) {
    const { code, message } = /** @type {NodeJS.ErrnoException} */ (error);
    const [, name] = (code === 'ERR_PARSE_ARGS_UNKNOWN_OPTION' && /'--?([^']*)'/.exec(message)) || [];
    const [sentence] = message.split('\n');
    throw new UsageError(name === undefined ? sentence : `--${cut(name)} is no option; ${nearestTo(name)}--help lists all.`);
  }
}

/** Names the option that has the most pairs of letters in common with a name. @param {string} name */
function nearestTo(name) {
  const pairs = (/** @type {string} */ word) => Array.from(word, (letter, i) => letter + (word[i + 1] ?? ''));
  const own = pairs(name);
  const scores = Object.keys(OPTIONS).map((option) => {
    const other = pairs(option);
    return { option, score: own.filter((pair) => other.includes(pair)).length / Math.max(own.length, other.length) };
  });
  const { option, score } = scores.reduce((best, each) => (each.score > best.score ? each : best));
  return score > 0.4 ? `the nearest is --${option}, ` : '';
}

/** @param {string} name @param {string | undefined} value @returns {Input['frames']} */
function framesOf(name, value) {
  if (value === undefined) return undefined;
  const [parent, child, ...more] = value.split(',').map((each) => each.trim());
  if (parent && child && more.length === 0) return { parent, child };
  throw new UsageError(`--${name} is “${cut(value)}”; expected are a parent and a child, as in map,base_link.`);
}
