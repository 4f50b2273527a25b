/** Options of the command line, and commands that are proposed to the user. */

import { basename, dirname } from 'node:path';
import { parseArgs } from 'node:util';
import { sort } from 'd3-array';
import { truncate, LOG_ROLES, UNIT_NAMES, type FileQuestion, type FramePair, type LogError, type OpenOptions, type LogRole } from '../logs/log.ts';
import { SYSTEMATIC_ERRORS } from '../widgets/alpha-calibrator/result.ts';

/** Error about the options; its message is a sentence. */
export class UsageError extends Error {}

export const HELP_TEXT = `motion-widgets: the α's of a robot's motion model, from logs of its odometry and of a reference

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

const COMMAND_OPTIONS = {
  ...LOG_OPTIONS, model: textOption, rule: textOption, 'update-min-d': textOption, 'update-min-a': textOption, duration: textOption, outliers: textOption,
  'no-correct': textOption, correct: textOption, 'reference-position-std': textOption, 'reference-yaw-std': textOption, json: flagOption, yaml: flagOption, plot: textOption,
  help: { ...flagOption, short: 'h' }, version: flagOption,
} as const;

/** Options of the core's `calibrate`, each with the command-line option that sets it. */
const OPTION_BY_FIELD: Record<string, string> = {
  'legs.distance': 'update-min-d', 'legs.angle': 'update-min-a', 'legs.duration': 'duration',
  positionStd: 'reference-position-std', yawStd: 'reference-yaw-std', model: 'model', rule: 'rule', outliers: 'outliers',
};

/** Replaces the field name at the start of an error message of the core by the command-line option for this field. Returns undefined if the message starts with no such field. */
export function replaceFieldByOption(errorMessage: string): string | undefined {
  const [fieldName] = errorMessage.split(' ');
  return Object.hasOwn(OPTION_BY_FIELD, fieldName) ? `--${OPTION_BY_FIELD[fieldName]}${errorMessage.slice(fieldName.length)}.` : undefined;
}

/** File or folder, with the role that the user chose for it. */
export interface InputPath { inputPath: string; logRole?: LogRole }

export type CalibrateArguments = Extract<ReturnType<typeof parseOptions>, { command: 'calibrate' }>;

export function parseOptions(args: string[]) {
  const { values: optionValues, positionals: [commandName, ...givenPaths] } = parseArguments(args);
  // A path of a metadata.yaml stands for its folder. Other paths in that folder are left out, because a shell pattern may have expanded to all its files.
  const listedFolders = givenPaths.filter((inputPath) => basename(inputPath) === 'metadata.yaml').map(dirname);
  const positionalPaths = [...new Set(listedFolders), ...givenPaths.filter((inputPath) => !listedFolders.includes(dirname(inputPath)))];
  if (optionValues.version) return 'version';
  if (optionValues.help || args.length === 0) return 'help';
  const inputPathsOf = (inputPaths: string[] = [], logRole?: LogRole) => inputPaths.map((inputPath): InputPath => ({ inputPath, logRole }));
  const seriesChoiceOf = (logRole: LogRole) => dropUndefinedFields({ seriesName: optionValues[`${logRole}-topic`], framePair: parseFrames(`${logRole}-frames`, optionValues[`${logRole}-frames`]) });
  const logArguments = {
    inputPaths: [...inputPathsOf(positionalPaths), ...inputPathsOf(optionValues.recording), ...LOG_ROLES.flatMap((logRole) => inputPathsOf(optionValues[logRole], logRole))],
    optionsByFile: parseFileOptions(optionValues),
    userChoices: { odometry: seriesChoiceOf('odometry'), reference: seriesChoiceOf('reference'), ...(optionValues.model === 'velocity' && { logKind: 'commands' as const }) },
  };
  if (logArguments.inputPaths.length === 0 && (commandName === 'inspect' || commandName === 'calibrate')) throw new UsageError('no logs are given; give a recording, as in npx motion-widgets inspect run.bag, or two files, odometry and reference.');
  if (commandName === 'inspect') {
    const ignoredOption = Object.keys(optionValues).find((optionName) => !(optionName in LOG_OPTIONS) && optionName !== 'json');
    if (ignoredOption !== undefined) throw new UsageError(`--${ignoredOption} is an option of calibrate; inspect accepts only the options about logs, and --json.`);
    return { command: 'inspect' as const, ...logArguments, isJson: optionValues.json ?? false };
  }
  if (commandName !== 'calibrate') {
    const pathOrCommand = [commandName, ...positionalPaths].find(isPath) ?? 'run.bag';
    throw new UsageError(`the command must be calibrate or inspect (got “${truncate(commandName ?? '')}”), as in npx motion-widgets inspect ${quoteForShell(pathOrCommand)}; --help has examples.`);
  }
  const readNumberOption = (optionName: 'update-min-d' | 'update-min-a' | 'duration' | 'reference-position-std' | 'reference-yaw-std') => {
    const optionValue = optionValues[optionName];
    if (optionValue === undefined) return undefined;
    const parsedNumber = optionValue.trim() === '' ? NaN : Number(optionValue);
    if (Number.isFinite(parsedNumber)) return parsedNumber;
    const decimalHint = /^-?\d*,\d+$/.test(optionValue) ? ` with a decimal point, ${optionValue.replace(',', '.')}` : '';
    throw new UsageError(`--${optionName} must be a number${decimalHint} (got “${truncate(optionValue)}”).`);
  };
  const [legDistance, legAngle, legDuration] = [readNumberOption('update-min-d'), readNumberOption('update-min-a'), readNumberOption('duration')];
  if (legDuration !== undefined && (legDistance ?? legAngle) !== undefined) throw new UsageError('--duration excludes --update-min-d and --update-min-a: give one or the other.');
  if (optionValues.plot !== undefined && !/\.svg$/i.test(optionValues.plot)) throw new UsageError(`--plot writes SVG; the name must end in .svg (got “${truncate(optionValues.plot)}”).`);
  if (optionValues.json && optionValues.yaml) throw new UsageError('--json excludes --yaml: give one or the other.');
  return {
    command: 'calibrate' as const,
    ...logArguments,
    fitOptions: dropUndefinedFields({
      legs: legDuration === undefined ? { distance: legDistance ?? 0.25, angle: legAngle ?? 0.2 } : { duration: legDuration },
      model: optionValues.model ?? (optionValues.rule === 'omni' ? 'omnidirectional' : undefined),
      rule: optionValues.rule,
      outliers: optionValues.outliers,
      correct: parseCorrections(optionValues['no-correct'], optionValues.correct),
      positionStd: readNumberOption('reference-position-std'),
      yawStd: readNumberOption('reference-yaw-std'),
    }),
    outputFormat: optionValues.json ? 'json' : optionValues.yaml ? 'yaml' : 'text',
    plotPath: optionValues.plot,
  };
}

/** Names of fields of `OpenOptions`, by the command-line options that set them. */
const FILE_OPTIONS = { columns: 'columns', 'time-unit': 'timeUnit', 'length-unit': 'lengthUnit', 'angle-unit': 'angleUnit' } as const;

/** Returns the options for reading files, by file name: first those of all files, under the name "", then those of single files, as in `--length-unit odom.csv=ft`. */
function parseFileOptions(optionValues: { [name in keyof typeof FILE_OPTIONS]?: string[] }): [file: string, OpenOptions][] {
  const optionsByFile = (Object.entries(FILE_OPTIONS) as EntriesOf<typeof FILE_OPTIONS>).flatMap(([optionName, fieldName]) => (optionValues[optionName] ?? []).map((optionValue): [string, OpenOptions] => {
    const [, fileName = '', answerText = ''] = /^(?:(.*)=)?(.*)$/s.exec(optionValue) ?? [];
    if (fieldName === 'columns') return [fileName, { columnNames: answerText.split(',').map((columnName) => columnName.trim()) }];
    if (!(UNIT_NAMES[fieldName] as readonly string[]).includes(answerText)) throw new UsageError(`--${optionName} must be ${formatAlternatives(UNIT_NAMES[fieldName])}, or FILE=${UNIT_NAMES[fieldName][0]} for one file (got “${truncate(optionValue)}”).`);
    return [fileName, { [fieldName]: answerText }];
  }));
  return sort(optionsByFile, ([fileName]) => fileName !== '');
}

type EntriesOf<T> = { [key in keyof T]: [key, T[key]] }[keyof T][];

/** Returns command arguments in which the paths without roles have the options --odometry and --reference in turn; undefined for fewer than two such paths. */
function nameRoles(args: string[]): string[] | undefined {
  const { tokens } = parseArgs({ args, options: COMMAND_OPTIONS, allowPositionals: true, tokens: true });
  const pathIndices = tokens.filter(({ kind: tokenKind }) => tokenKind === 'positional').map(({ index }) => index).slice(1);
  if (pathIndices.length < 2) return undefined;
  return args.flatMap((argument, i) => (pathIndices.includes(i) ? [`--${LOG_ROLES[pathIndices.indexOf(i) % 2]}`, argument] : [argument]));
}

const dropUndefinedFields = <T extends object>(optionalFields: T): T => Object.fromEntries(Object.entries(optionalFields).filter(([, fieldValue]) => fieldValue !== undefined)) as T;

const formatAlternatives = (alternatives: readonly string[]) => new Intl.ListFormat('en', { type: 'disjunction' }).format(alternatives);

/** Returns a flag for each named systematic error: true to correct it, false otherwise. A named error takes precedence over `all`. */
function parseCorrections(uncorrectedNames?: string, correctedNames?: string): Record<string, boolean> | undefined {
  const correctionEntries = ([['no-correct', uncorrectedNames], ['correct', correctedNames]] as const).flatMap(([optionName, errorNames]) => (errorNames?.split(',') ?? []).map((errorName) => ({ option: optionName, errorName: errorName.trim() })));
  if (correctionEntries.length === 0) return undefined;
  return Object.fromEntries(sort(correctionEntries, ({ errorName }) => errorName !== 'all').flatMap(({ option: optionName, errorName }) => {
    if (!['all', ...SYSTEMATIC_ERRORS].includes(errorName)) throw new UsageError(`--${optionName} must be all, or names of ${SYSTEMATIC_ERRORS.join(', ')} (got “${truncate(errorName)}”).`);
    return (errorName === 'all' ? SYSTEMATIC_ERRORS : [errorName]).map((errorName) => [errorName, optionName === 'correct']);
  }));
}

function parseArguments(args: string[]) {
  try {
    return parseArgs({ args, options: COMMAND_OPTIONS, allowPositionals: true });
  } catch (error) {
    const parseReason = (error as Error).message.replace(/ To specify a positional.*/, '').replaceAll('\n', ' ').replace(/\.$/, '');
    throw new UsageError(`${parseReason}. --help lists all options.`);
  }
}

/** Quotes a text as one argument of a shell command, if necessary. */
const quoteForShell = (shellArgument: string): string => (/^[\w./,@%+=:-]+$/.test(shellArgument) ? shellArgument : `'${shellArgument.replaceAll("'", "'\\''")}'`);

/** Returns true if an argument has an extension or is in a folder. */
const isPath = (argument = '') => /\.\w+$|\//.test(argument);

function parseFrames(optionName: string, optionValue: string | undefined): FramePair | undefined {
  if (optionValue === undefined) return undefined;
  const [parentFrame, childFrame, ...excessNames] = optionValue.split(',').map((frameName) => frameName.trim());
  if (parentFrame && childFrame && excessNames.length === 0) return { parent: parentFrame, child: childFrame };
  throw new UsageError(`--${optionName} must be a parent and a child frame, as in map,base_link (got “${truncate(optionValue)}”).`);
}

export const formatCommand = (args: string[]): string => ['npx motion-widgets', ...args.map(quoteForShell)].join(' ');

/** Returns the message of an error. If the error asks the user a question, the typed command follows, with the option that answers it. */
export function explainWithCommand({ message: errorMessage, errorPlace: { fileName }, userQuestion }: LogError, typedArgs: string[]): string {
  const answeringArgs = userQuestion && answerQuestion({ ...userQuestion, fileName }, typedArgs);
  return answeringArgs ? `${errorMessage} For example:\n  ${formatCommand(answeringArgs)}` : errorMessage;
}

/** Returns the typed arguments together with the option that answers the question of a LogError; undefined if no option answers it. */
export function answerQuestion({ fileName, optionName, logRole, possibleAnswers, columnNames = [] }: FileQuestion, typedArgs: string[]): string[] | undefined {
  const [likeliestChoice] = possibleAnswers.filter(Boolean);
  const chosenRole = logRole ?? 'odometry';
  if (optionName === 'roles') return nameRoles(typedArgs);
  if (optionName === 'other') return [...typedArgs, ...(logRole ? [`--${logRole === 'odometry' ? 'reference' : 'odometry'}`] : []), 'FILE'];
  if (optionName === 'columns') return [...typedArgs, '--columns', `${fileName}=${likeliestChoice ?? columnNames.map((_, i) => `NAME${i + 1}`).join()}`];
  if (likeliestChoice === undefined) return undefined;
  if (optionName in UNIT_NAMES) return [...typedArgs, `--${optionName.replace('Unit', '-unit')}`, `${fileName}=${likeliestChoice}`];
  return [...typedArgs, `--${chosenRole}-${optionName === 'series' ? 'topic' : 'frames'}`, likeliestChoice];
}
