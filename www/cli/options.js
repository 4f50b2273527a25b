/** What the command line asks for. */

import { parseArgs } from 'node:util';
import { cut } from '../widgets/alpha-calibrator/log/refusal.js';

/** Something that cannot be asked for; its message is a sentence. */
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

/** What can be removed before the α's are fitted. */
const SYSTEMATIC = ['clockOffset', 'mountYaw', 'leverArm', 'distanceScale', 'turnScale'];

/** What the core calls the options, where that is another name. @type {Record<string, string>} */
const FIELDS = {
  'legs.distance': 'distance', 'legs.angle': 'angle', 'legs.duration': 'duration', 'robust.outliers': 'robust',
  'reference.positionDeviation': 'position-deviation', 'reference.headingDeviation': 'heading-deviation',
};

/**
 * What the core refuses of the options, by their names.
 *
 * @param {string} message of its error, which begins with a field
 * @returns {string | undefined} nothing where it is of the logs
 */
export function refusalOf(message) {
  const [field] = message.split(' ');
  const name = FIELDS[field] ?? field;
  return Object.hasOwn(OPTIONS, name) && !(name in LOGS) ? `--${name}${message.slice(field.length)}.` : undefined;
}

/** Fields of the core that are logs and no options' values. */
const LOGS = { odometry: true, reference: true };

/**
 * @typedef {object} Asked
 * @property {Part} odometry
 * @property {Part} reference
 * @property {Record<string, any>} fit options of `calibrate`
 * @property {{ positionDeviation?: number, headingDeviation?: number }} deviations of the reference
 * @property {boolean} json
 *
 * @typedef {object} Part of what is read
 * @property {string} path
 * @property {string | undefined} topic
 * @property {{ parent: string, child: string } | undefined} frames
 */

/**
 * @param {string[]} args
 * @returns {Asked | undefined} nothing where help is asked for
 * @throws {UsageError}
 */
export function optionsOf(args) {
  const { values, positionals } = parsed(args);
  const [command, ...more] = positionals;
  if (values.help || (command === undefined && args.length === 0)) return undefined;
  if (command !== 'calibrate') throw new UsageError(`the command is “${cut(command ?? '')}”; expected is calibrate.`);
  if (more.length) throw new UsageError(`“${cut(more[0])}” belongs to no option; expected are options such as --odometry.`);

  const number = (/** @type {keyof typeof OPTIONS} */ name) => {
    const value = values[name];
    if (value === undefined) return undefined;
    const is = typeof value === 'string' && value.trim() !== '' ? Number(value) : NaN;
    if (!Number.isFinite(is)) throw new UsageError(`--${name} is “${cut(String(value))}”; expected is ${numberLike(String(value))}.`);
    return is;
  };
  const { distance, angle, duration } = { distance: number('distance'), angle: number('angle'), duration: number('duration') };
  if (duration !== undefined && (distance ?? angle) !== undefined) {
    throw new UsageError(`--duration is ${duration} beside --distance or --angle; expected is either the one or the others.`);
  }
  const legs = duration === undefined ? { distance: distance ?? 0.25, angle: angle ?? 0.2 } : { duration };
  const without = values.without?.split(',').map((name) => name.trim()) ?? [];
  const stranger = without.find((name) => !SYSTEMATIC.includes(name));
  if (stranger !== undefined) throw new UsageError(`--without has “${cut(stranger)}”; expected are names of ${SYSTEMATIC.join(', ')}.`);
  const share = values.robust === '' ? undefined : number('robust');
  const given = {
    model: values.model ?? (values.rule === 'omni' ? 'omnidirectional' : undefined),
    rule: values.rule,
    noise: values.noise,
    robust: values.robust === undefined ? undefined : share === undefined ? true : { outliers: share },
    systematic: without.length ? Object.fromEntries(SYSTEMATIC.map((name) => [name, !without.includes(name)])) : undefined,
    seed: number('seed'),
  };
  return {
    odometry: partOf('odometry', values.odometry ?? values.recording, values['odom-topic'], framesOf('odom-frames', values['odom-frames'])),
    reference: partOf('reference', values.reference ?? values.recording, values['reference-topic'], framesOf('frames', values.frames)),
    fit: { legs, byLength: true, ...defined(given) },
    deviations: defined({ positionDeviation: number('position-deviation'), headingDeviation: number('heading-deviation') }),
    json: values.json ?? false,
  };
}

/** What is expected in the place of a text. @param {string} text */
function numberLike(text) {
  const pointed = text.replace(',', '.');
  return text.includes(',') && Number.isFinite(Number(pointed)) ? `a number with a decimal point, ${pointed}` : 'a number';
}

/** @template {object} T @param {T} all @returns {T} those that are something */
const defined = (all) => /** @type {T} */ (Object.fromEntries(Object.entries(all).filter(([, value]) => value !== undefined)));

/** @param {string[]} args */
function parsed(args) {
  // Node takes a negative number for an option, and knows none whose value may be left out: --robust alone asks for an estimate.
  const isNumberOf = (/** @type {number} */ i) => isNumber(args[i]) && TAKES_VALUE.test(args[i - 1] ?? '');
  const whole = args.flatMap((arg, i) => {
    if (isNumberOf(i)) return [];
    if (isNumberOf(i + 1)) return [`${arg}=${args[i + 1]}`];
    return [arg === '--robust' ? '--robust=' : arg];
  });
  try {
    const { tokens, ...all } = parseArgs({ args: whole, options: OPTIONS, allowPositionals: true, tokens: true });
    const names = tokens.flatMap((token) => (token.kind === 'option' ? [token.name] : []));
    const twice = names.find((name, i) => names.indexOf(name) < i);
    if (twice !== undefined) throw new UsageError(`--${twice} is given more than once; expected is one of it.`);
    return all;
  } catch (error) {
    if (error instanceof UsageError) throw error;
    const reason = error instanceof Error ? error.message : String(error);
    const unknown = /Unknown option '(.*?)'/.exec(reason);
    if (unknown) throw new UsageError(`${cut(unknown[1])} is no option; expected are those of --help.`);
    const alone = /^Option '(--[\w-]+).*' argument (missing|is ambiguous)/.exec(reason);
    if (alone) throw new UsageError(`${alone[1]} has no value; expected is one after it, or after = where it begins with -.`);
    // What follows is advice, in lines of its own.
    const [first] = reason.split('\n');
    throw new UsageError(`${cut(first.replace(/\.$/, ''), 200)}; expected is what --help shows.`);
  }
}

/** An option that stands apart from its value. */
const TAKES_VALUE = new RegExp(`^--(${Object.entries(OPTIONS).flatMap(([name, { type }]) => (type === 'string' ? [name] : [])).join('|')})$`);

/** @param {string | undefined} arg */
const isNumber = (arg) => arg !== undefined && /^[+-]?\.?\d/.test(arg);

/**
 * @param {'odometry' | 'reference'} role
 * @param {string | undefined} path
 * @param {string | undefined} topic
 * @param {Part['frames']} frames
 * @returns {Part}
 */
function partOf(role, path, topic, frames) {
  if (!path) throw new UsageError(`--${role} is missing; expected is a file, or --recording with both.`);
  return { path, topic, frames };
}

/** @param {string} name @param {string | undefined} value @returns {Part['frames']} */
function framesOf(name, value) {
  if (value === undefined) return undefined;
  const [parent, child, ...more] = value.split(',').map((each) => each.trim());
  if (!parent || !child || more.length) throw new UsageError(`--${name} is “${cut(value)}”; expected are a parent and a child, as in map,base_link.`);
  return { parent, child };
}
