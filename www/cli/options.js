/** Options of the command line. */

import { parseArgs } from 'node:util';
import { cut } from '../widgets/alpha-calibrator/log/log-error.js';

/** Error about the options; its message is a sentence. */
export class UsageError extends Error {}

export const HELP = `motion-widgets calibrate: the α's of a robot's motion model, from a log

  npx motion-widgets calibrate --odometry odom.csv --reference truth.csv
  npx motion-widgets calibrate --recording run.mcap --odom-topic /odom --reference-topic /mocap/pose

What goes in (times in s or ns, m, rad; numbers with a decimal point):
  --odometry FILE          CSV with a header, TUM, or an MCAP recording of ROS 2; also commands: t, v, omega
  --reference FILE         likewise, in any fixed frame: motion capture, total station, scan matching
  --recording FILE         one MCAP recording with both
  --odom-topic NAME        of a recording; not needed where only one topic can be meant
  --reference-topic NAME   likewise
  --odom-frames P,C        of a topic of transforms: parent and child, as in odom,base_link
  --frames P,C             likewise of the reference: map,base_link
  --position-deviation M   of the reference's own error; 0 unless said
  --heading-deviation RAD  likewise

What is fitted:
  --model NAME             odometry (unless said), omnidirectional, velocity
  --rule NAME              of the odometry model: table (unless said), nav2 (for Nav2's AMCL), beluga;
                           omni is that of the omnidirectional model
  --distance M --angle RAD a leg ends after so much, as AMCL's update_min_d and update_min_a; 0.25 and 0.2 unless said
  --duration S             or after so long
  --noise NAME             normal (unless said), triangular
  --robust [SHARE]         some legs may be bad: a share that is estimated, or so many
  --without NAMES          what is not removed, of clockOffset,mountYaw,leverArm,distanceScale,turnScale
  --seed N                 of the bootstrap

What comes out:
  --json                   everything, as JSON
  --help                   this
`;

const text = /** @type {const} */ ({ type: 'string' });
const flag = /** @type {const} */ ({ type: 'boolean' });

const OPTIONS = {
  odometry: text, reference: text, recording: text, 'odom-topic': text, 'reference-topic': text, 'odom-frames': text, frames: text,
  'position-deviation': text, 'heading-deviation': text, model: text, rule: text, distance: text, angle: text, duration: text,
  noise: text, robust: text, without: text, seed: text, json: flag, help: flag,
};

/** Systematic errors that can be removed before the α's are fitted. */
const SYSTEMATIC = ['clockOffset', 'mountYaw', 'leverArm', 'distanceScale', 'turnScale'];

/** Options by the fields of `calibrate`. @type {Record<string, string>} */
const BY_FIELD = {
  'legs.distance': 'distance', 'legs.angle': 'angle', 'legs.duration': 'duration', 'robust.outliers': 'robust',
  'reference.positionDeviation': 'position-deviation', 'reference.headingDeviation': 'heading-deviation',
  model: 'model', rule: 'rule', noise: 'noise', seed: 'seed',
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
 * @property {Input} odometry
 * @property {Input} reference
 * @property {Record<string, any>} fit options of `calibrate`
 * @property {{ positionDeviation?: number, headingDeviation?: number }} deviations of the reference
 * @property {boolean} json
 *
 * @typedef {'distance' | 'angle' | 'duration' | 'robust' | 'seed' | 'position-deviation' | 'heading-deviation'} Numeric option
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
  const [distance, angle, duration] = [number('distance'), number('angle'), number('duration')];
  if (duration !== undefined && (distance ?? angle) !== undefined) {
    throw new UsageError(`--duration is ${duration} beside --distance or --angle; expected is either the one or the others.`);
  }
  const without = values.without?.split(',').map((name) => name.trim()) ?? [];
  const unknown = without.find((name) => !SYSTEMATIC.includes(name));
  if (unknown !== undefined) throw new UsageError(`--without has “${cut(unknown)}”; expected are names of ${SYSTEMATIC.join(', ')}.`);
  const pathOf = (/** @type {'odometry' | 'reference'} */ role) => {
    const path = values[role] ?? values.recording;
    if (!path) throw new UsageError(`--${role} is missing; expected is a file, or --recording with both.`);
    return path;
  };
  return {
    odometry: { path: pathOf('odometry'), topic: values['odom-topic'], frames: framesOf('odom-frames', values['odom-frames']) },
    reference: { path: pathOf('reference'), topic: values['reference-topic'], frames: framesOf('frames', values.frames) },
    fit: defined({
      legs: duration === undefined ? { distance: distance ?? 0.25, angle: angle ?? 0.2 } : { duration },
      byLength: true,
      model: values.model ?? (values.rule === 'omni' ? 'omnidirectional' : undefined),
      rule: values.rule,
      noise: values.noise,
      robust: values.robust === '' ? true : values.robust && { outliers: number('robust') },
      systematic: values.without && Object.fromEntries(SYSTEMATIC.map((name) => [name, !without.includes(name)])),
      seed: number('seed'),
    }),
    deviations: defined({ positionDeviation: number('position-deviation'), headingDeviation: number('heading-deviation') }),
    json: values.json ?? false,
  };
}

/** @template {object} T @param {T} all @returns {T} without keys that are undefined */
const defined = (all) => /** @type {T} */ (Object.fromEntries(Object.entries(all).filter(([, value]) => value !== undefined)));

/** @param {string[]} args */
function parsed(args) {
  // The value of --robust is optional, which parseArgs does not know.
  const explicit = args.map((arg, i) => (arg === '--robust' && (args[i + 1] ?? '--').startsWith('--') ? '--robust=' : arg));
  try {
    return parseArgs({ args: explicit, options: OPTIONS, allowPositionals: true });
  } catch (error) {
    throw new UsageError(/** @type {Error} */ (error).message);
  }
}

/** @param {string} name @param {string | undefined} value @returns {Input['frames']} */
function framesOf(name, value) {
  if (value === undefined) return undefined;
  const [parent, child, ...more] = value.split(',').map((each) => each.trim());
  if (parent && child && more.length === 0) return { parent, child };
  throw new UsageError(`--${name} is “${cut(value)}”; expected are a parent and a child, as in map,base_link.`);
}
