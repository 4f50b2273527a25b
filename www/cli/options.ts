/** Options of the command line, and commands that are proposed to the user. */

import { basename, dirname } from 'node:path';
import { parseArgs } from 'node:util';
import { sort } from 'd3-array';
import { truncate, ROLES, UNITS, type FileQuestion, type FramePair, type LogError, type OpenOptions, type Role } from '../logs/log.ts';
import { SYSTEMATIC_ERRORS } from '../widgets/alpha-calibrator/result.ts';

/** Error about the options; its message is a sentence. */
export class UsageError extends Error {}

export const HELP = `motion-widgets: the α's of a robot's motion model, from logs of its odometry and of a reference

  npx motion-widgets inspect run.bag
      lists what is in a recording or table, what could be odometry or reference, and the command to go on with
  npx motion-widgets calibrate run.bag --rule nav2
      calibrates from a bag, folder or MCAP file that has both, for Nav2's AMCL
  npx motion-widgets calibrate odom.csv mocap.csv --rule nav2 --yaml > alphas.yaml
      calibrates from two files, and writes the lines for Nav2

Logs: ROS 1 bags, rosbag2 (MCAP, SQLite, folders), CSV and other tables, TUM.
  PATH, --recording PATH     file or folder with odometry and reference, or with one of them, which is paired by
                             names, contents and times
  --odometry PATH            file or folder with the odometry: poses, or commands v and omega
  --reference PATH           file or folder with the reference: motion capture, total station, scan matching
                             Several drives: give these several times.
  --odometry-topic NAME      topic, or prefix of a table's columns (odom_); default: guessed from types and names
  --reference-topic NAME     the same for the reference
  --odometry-frames P,C      parent and child frame, of a topic of transforms: odom,base_link
  --reference-frames P,C     the same for the reference: map,base_link
  --columns NAMES            names of the columns of a table without a header: t,x,y,yaw or t,v,omega; - for a
                             column that is not read, and -y for one whose sign is wrong
  --time-unit UNIT           s, ms, us or ns; default: judged
  --length-unit UNIT         m, cm, mm, ft or in; likewise
  --angle-unit UNIT          rad or deg; likewise
                             These four apply to all files, or to one: --length-unit odom.csv=ft

Fit:
  --model NAME               odometry (default), omnidirectional, velocity (from commands)
  --rule NAME                of the odometry model: thrun (default, Table 5.6), nav2 (for Nav2's AMCL), beluga;
                             omni is that of the omnidirectional model
  --update-min-d M           a leg ends after so much, as in AMCL; default 0.25
  --update-min-a RAD         or after so much rotation; default 0.2
  --duration S               a leg ends after so long instead
  --reference-position-std M known standard deviation of the reference's x and y; default: estimated from the log
  --reference-yaw-std RAD    known standard deviation of its yaw; default: estimated from the log
  --outliers NAME            reject (default), keep
  --no-correct NAMES         systematic errors that are not corrected: all, or some of
                             clockOffset,mountYaw,leverArm,distanceScale,turnScale
  --correct NAMES            systematic errors that are corrected even if they are not constant

Output:
  --json                     everything, as JSON; of inspect too
  --yaml                     only the lines for nav2_params.yaml, to merge into its amcl:
  --plot FILE.svg            a picture of both paths, the legs and the outliers
  --help, --version

Exit codes: 0 result, 2 bad input or options, 3 the log is unusable (see the failed checks), 1 a defect of the program.
`;

const textOption = { type: 'string' } as const;
const repeatedTextOption = { type: 'string', multiple: true } as const;
const flagOption = { type: 'boolean' } as const;

/** Options about logs, for the commands `calibrate` and `inspect`. */
const LOG_OPTIONS = {
  odometry: repeatedTextOption, reference: repeatedTextOption, recording: repeatedTextOption, 'odometry-topic': textOption, 'reference-topic': textOption, 'odometry-frames': textOption,
  'reference-frames': textOption, columns: repeatedTextOption, 'time-unit': repeatedTextOption, 'length-unit': repeatedTextOption, 'angle-unit': repeatedTextOption,
} as const;

const OPTIONS = {
  ...LOG_OPTIONS, model: textOption, rule: textOption, 'update-min-d': textOption, 'update-min-a': textOption, duration: textOption, outliers: textOption,
  'no-correct': textOption, correct: textOption, 'reference-position-std': textOption, 'reference-yaw-std': textOption, json: flagOption, yaml: flagOption, plot: textOption,
  help: { ...flagOption, short: 'h' }, version: flagOption,
} as const;

/** Names of command-line options, by the option of `calibrate` in the core that they set. */
const OPTION_BY_FIELD: Record<string, string> = {
  'legs.distance': 'update-min-d', 'legs.angle': 'update-min-a', 'legs.duration': 'duration',
  positionStd: 'reference-position-std', yawStd: 'reference-yaw-std', model: 'model', rule: 'rule', outliers: 'outliers',
};

/** Replaces the field name at the start of an error message of the core by the command-line option for this field. Returns undefined if the message starts with no such field. */
export function replaceFieldByOption(message: string): string | undefined {
  const [field] = message.split(' ');
  return Object.hasOwn(OPTION_BY_FIELD, field) ? `--${OPTION_BY_FIELD[field]}${message.slice(field.length)}.` : undefined;
}

/** File or folder, with the role that the user chose for it. */
export interface InputPath { path: string; role?: Role }

export type CalibrateArguments = Extract<ReturnType<typeof parseOptions>, { command: 'calibrate' }>;

export function parseOptions(args: string[]) {
  const { values: optionValues, positionals: [command, ...givenPaths] } = parseArguments(args);
  // A path of a metadata.yaml stands for its folder. Other paths in that folder are left out, because a shell pattern may have expanded to all its files.
  const listedFolders = givenPaths.filter((path) => basename(path) === 'metadata.yaml').map(dirname);
  const positionalPaths = [...new Set(listedFolders), ...givenPaths.filter((path) => !listedFolders.includes(dirname(path)))];
  if (optionValues.version) return 'version';
  if (optionValues.help || args.length === 0) return 'help';
  const inputPathsOf = (paths: string[] = [], role?: Role) => paths.map((path): InputPath => ({ path, role }));
  const seriesChoiceOf = (role: Role) => withoutUndefined({ series: optionValues[`${role}-topic`], frames: parseFrames(`${role}-frames`, optionValues[`${role}-frames`]) });
  const logs = {
    inputs: [...inputPathsOf(positionalPaths), ...inputPathsOf(optionValues.recording), ...ROLES.flatMap((role) => inputPathsOf(optionValues[role], role))],
    optionsByFile: parseFileOptions(optionValues),
    userChoices: { odometry: seriesChoiceOf('odometry'), reference: seriesChoiceOf('reference'), ...(optionValues.model === 'velocity' && { kind: 'commands' as const }) },
  };
  if (logs.inputs.length === 0 && (command === 'inspect' || command === 'calibrate')) throw new UsageError('no logs are given; give a recording, as in npx motion-widgets inspect run.bag, or two files, odometry and reference.');
  if (command === 'inspect') {
    const ignoredOption = Object.keys(optionValues).find((name) => !(name in LOG_OPTIONS) && name !== 'json');
    if (ignoredOption !== undefined) throw new UsageError(`--${ignoredOption} is an option of calibrate; inspect accepts only the options about logs, and --json.`);
    return { command: 'inspect' as const, ...logs, isJson: optionValues.json ?? false };
  }
  if (command !== 'calibrate') {
    const path = [command, ...positionalPaths].find(isPath) ?? 'run.bag';
    throw new UsageError(`the command must be calibrate or inspect (got “${truncate(command ?? '')}”), as in npx motion-widgets inspect ${quoteForShell(path)}; --help has examples.`);
  }
  const readNumberOption = (name: 'update-min-d' | 'update-min-a' | 'duration' | 'reference-position-std' | 'reference-yaw-std') => {
    const value = optionValues[name];
    if (value === undefined) return undefined;
    const parsedNumber = value.trim() === '' ? NaN : Number(value);
    if (Number.isFinite(parsedNumber)) return parsedNumber;
    const decimalHint = /^-?\d*,\d+$/.test(value) ? ` with a decimal point, ${value.replace(',', '.')}` : '';
    throw new UsageError(`--${name} must be a number${decimalHint} (got “${truncate(value)}”).`);
  };
  const [distance, angle, duration] = [readNumberOption('update-min-d'), readNumberOption('update-min-a'), readNumberOption('duration')];
  if (duration !== undefined && (distance ?? angle) !== undefined) throw new UsageError('--duration excludes --update-min-d and --update-min-a: give one or the other.');
  if (optionValues.plot !== undefined && !/\.svg$/i.test(optionValues.plot)) throw new UsageError(`--plot writes SVG; the name must end in .svg (got “${truncate(optionValues.plot)}”).`);
  if (optionValues.json && optionValues.yaml) throw new UsageError('--json excludes --yaml: give one or the other.');
  return {
    command: 'calibrate' as const,
    ...logs,
    fit: withoutUndefined({
      legs: duration === undefined ? { distance: distance ?? 0.25, angle: angle ?? 0.2 } : { duration },
      model: optionValues.model ?? (optionValues.rule === 'omni' ? 'omnidirectional' : undefined),
      rule: optionValues.rule,
      outliers: optionValues.outliers,
      correct: parseCorrections(optionValues['no-correct'], optionValues.correct),
      positionStd: readNumberOption('reference-position-std'),
      yawStd: readNumberOption('reference-yaw-std'),
    }),
    output: optionValues.json ? 'json' : optionValues.yaml ? 'yaml' : 'text',
    plot: optionValues.plot,
  };
}

/** Names of fields of `OpenOptions`, by the command-line options that set them. */
const FILE_OPTIONS = { columns: 'columns', 'time-unit': 'timeUnit', 'length-unit': 'lengthUnit', 'angle-unit': 'angleUnit' } as const;

/** Returns the options for reading files, by file name: first those of all files, under the name "", then those of single files, as in `--length-unit odom.csv=ft`. */
function parseFileOptions(optionValues: { [name in keyof typeof FILE_OPTIONS]?: string[] }): [file: string, OpenOptions][] {
  const optionsByFile = (Object.entries(FILE_OPTIONS) as Entries<typeof FILE_OPTIONS>).flatMap(([name, field]) => (optionValues[name] ?? []).map((optionValue): [string, OpenOptions] => {
    const [, file = '', answer = ''] = /^(?:(.*)=)?(.*)$/s.exec(optionValue) ?? [];
    if (field === 'columns') return [file, { columns: answer.split(',').map((column) => column.trim()) }];
    if (!(UNITS[field] as readonly string[]).includes(answer)) throw new UsageError(`--${name} must be ${formatAlternatives(UNITS[field])}, or FILE=${UNITS[field][0]} for one file (got “${truncate(optionValue)}”).`);
    return [file, { [field]: answer }];
  }));
  return sort(optionsByFile, ([file]) => file !== '');
}

type Entries<T> = { [key in keyof T]: [key, T[key]] }[keyof T][];

/** Returns command arguments in which the paths without roles have the options --odometry and --reference in turn; undefined for fewer than two such paths. */
function nameRoles(args: string[]): string[] | undefined {
  const { tokens } = parseArgs({ args, options: OPTIONS, allowPositionals: true, tokens: true });
  const pathIndices = tokens.filter(({ kind }) => kind === 'positional').map(({ index }) => index).slice(1);
  if (pathIndices.length < 2) return undefined;
  return args.flatMap((arg, i) => (pathIndices.includes(i) ? [`--${ROLES[pathIndices.indexOf(i) % 2]}`, arg] : [arg]));
}

const withoutUndefined = <T extends object>(object: T): T => Object.fromEntries(Object.entries(object).filter(([, value]) => value !== undefined)) as T;

const formatAlternatives = (names: readonly string[]) => new Intl.ListFormat('en', { type: 'disjunction' }).format(names);

/** Returns a flag for each named systematic error: true to correct it, false otherwise. A named error takes precedence over `all`. */
function parseCorrections(uncorrectedNames?: string, correctedNames?: string): Record<string, boolean> | undefined {
  const entries = ([['no-correct', uncorrectedNames], ['correct', correctedNames]] as const).flatMap(([option, names]) => (names?.split(',') ?? []).map((name) => ({ option, name: name.trim() })));
  if (entries.length === 0) return undefined;
  return Object.fromEntries(sort(entries, ({ name }) => name !== 'all').flatMap(({ option, name }) => {
    if (!['all', ...SYSTEMATIC_ERRORS].includes(name)) throw new UsageError(`--${option} must be all, or names of ${SYSTEMATIC_ERRORS.join(', ')} (got “${truncate(name)}”).`);
    return (name === 'all' ? SYSTEMATIC_ERRORS : [name]).map((errorName) => [errorName, option === 'correct']);
  }));
}

function parseArguments(args: string[]) {
  try {
    return parseArgs({ args, options: OPTIONS, allowPositionals: true });
  } catch (error) {
    const reason = (error as Error).message.replace(/ To specify a positional.*/, '').replaceAll('\n', ' ').replace(/\.$/, '');
    throw new UsageError(`${reason}. --help lists all options.`);
  }
}

/** Quotes a text as one argument of a shell command, if necessary. */
const quoteForShell = (text: string): string => (/^[\w./,@%+=:-]+$/.test(text) ? text : `'${text.replaceAll("'", "'\\''")}'`);

/** Returns true if an argument has an extension or is in a folder. */
const isPath = (argument = '') => /\.\w+$|\//.test(argument);

function parseFrames(name: string, value: string | undefined): FramePair | undefined {
  if (value === undefined) return undefined;
  const [parent, child, ...excessNames] = value.split(',').map((name) => name.trim());
  if (parent && child && excessNames.length === 0) return { parent, child };
  throw new UsageError(`--${name} must be a parent and a child frame, as in map,base_link (got “${truncate(value)}”).`);
}

export const formatCommand = (args: string[]): string => ['npx motion-widgets', ...args.map(quoteForShell)].join(' ');

/** Returns the message of an error. If the error has a question, the typed command follows, with the option that answers the question. */
export function explainWithCommand({ message, place: { file }, question }: LogError, typedArgs: string[]): string {
  const answeringArgs = question && answerQuestion({ ...question, file }, typedArgs);
  return answeringArgs ? `${message} For example:\n  ${formatCommand(answeringArgs)}` : message;
}

/** Returns the arguments of a command together with the option that answers a question; undefined if no option answers it. */
export function answerQuestion({ file, option, role, choices }: FileQuestion, typedArgs: string[]): string[] | undefined {
  const [likeliestChoice] = choices.filter(Boolean);
  const logRole = role ?? 'odometry';
  if (option === 'roles') return nameRoles(typedArgs);
  if (option === 'other') return [...typedArgs, ...(role ? [`--${role === 'odometry' ? 'reference' : 'odometry'}`] : []), 'FILE'];
  if (likeliestChoice === undefined) return undefined;
  if (option === 'columns') return [...typedArgs, '--columns', `${file}=${likeliestChoice}`];
  if (option in UNITS) return [...typedArgs, `--${option.replace('Unit', '-unit')}`, `${file}=${likeliestChoice}`];
  return [...typedArgs, `--${logRole}-${option === 'series' ? 'topic' : 'frames'}`, likeliestChoice];
}
