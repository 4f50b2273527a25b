/** Logs of robots, the recordings that they are read from, their summaries, and their errors. */

import { english } from './en.ts';
import type { CalibrationCheck } from '../types.d.ts';

/** File, or other bytes with a name. `path` is the path of a file in a dropped folder. */
export type SourceFile = Pick<File, 'name' | 'size' | 'slice'> & { path?: string };

/** Contents of a log: poses of the robot, or velocity commands. */
export type LogKind = 'poses' | 'commands';

export const LOG_ROLES = ['odometry', 'reference'] as const;

export type LogRole = (typeof LOG_ROLES)[number];

/** Part of a recording from which one log can be read: a topic, or a group of columns with a common prefix. */
export interface Series {
  /** Topic, or prefix of the columns ("gt", "odom.pose"); empty where a table has one group only. */
  seriesName: string;
  /** Message type of a topic, or the names of the columns of a table. */
  messageType: string;
  /** Kind of log that can be read from the series; null if none. `positions` have no heading. */
  seriesKind: LogKind | 'positions' | 'transforms' | null;
  /** True if a table has columns of poses and of commands. The commands are read if the user prefers commands. */
  hasCommands?: boolean;
  /** Number of messages; 0 for a table, whose rows are counted when it is read. */
  messageCount: number;
  /** Pairs of frames between which the transform may be the pose of the robot; undefined for static transforms. */
  framePairs?: FramePair[];
}

export interface FramePair { parent: string; child: string }

export const formatFrames = ({ parent: parentFrame, child: childFrame }: FramePair) => `${parentFrame} → ${childFrame}`;

export const formatFramesOption = ({ parent: parentFrame, child: childFrame }: FramePair) => `${parentFrame},${childFrame}`;

export interface LogChoice {
  seriesName: string;
  /** Kind of log: `commands` prefers commands to poses, and `poses` excludes commands. By default poses come first. */
  logKind?: LogKind;
  framePair?: FramePair;
}

/** Returns the label of a choice of a log: the name of its series, and the two frames if the series has transforms. */
export const choiceLabelOf = ({ seriesName, framePair }: LogChoice) => (framePair ? `${seriesName}: ${formatFrames(framePair)}` : seriesName);

/** File, or folder of files, from which logs are read. */
export interface Recording {
  recordingName: string;
  /** Format of the messages, or `csv` for any table, whose series are groups of columns. */
  recordingFormat: 'mcap' | 'rosbag' | 'sqlite' | 'csv';
  /** Series in the order of their names, or of their columns. */
  seriesList: Series[];
  /** Role that the user chose for the log. */
  logRole?: LogRole;
  /** Reads one log for each of `choices`, all in one pass over the file; rejects with a LogError if a log cannot be read. */
  readLogs(choices: LogChoice[], onProgress?: (progressFraction: number) => void): Promise<Log[]>;
}

/** Returns the series that can be read. A topic needs at least two messages. */
export const readableSeriesOf = ({ seriesList, recordingFormat }: Pick<Recording, 'seriesList' | 'recordingFormat'>): Series[] => seriesList.filter(({ seriesKind, messageCount }) => seriesKind !== null && (recordingFormat === 'csv' || messageCount > 1));

/** Units that logs may have, by the name of the option for the unit. */
export const UNIT_NAMES = { timeUnit: ['s', 'ms', 'us', 'ns'], lengthUnit: ['m', 'cm', 'mm', 'ft', 'in'], angleUnit: ['rad', 'deg'] } as const;

export type TimeUnit = (typeof UNIT_NAMES.timeUnit)[number];
export type LengthUnit = (typeof UNIT_NAMES.lengthUnit)[number];
export type AngleUnit = (typeof UNIT_NAMES.angleUnit)[number];

export interface OpenOptions {
  /** Names of the columns of a table. They replace its header, if it has one. */
  columnNames?: string[];
  timeUnit?: TimeUnit;
  lengthUnit?: LengthUnit;
  angleUnit?: AngleUnit;
  /** Role of the logs that the user chose. By default it is guessed. */
  logRole?: LogRole;
}

/** Function that returns the options for reading the file or log with the given name. */
export type FindOptions = (name: string) => OpenOptions | undefined;

/** Question of a LogError to the user: the option that answers it, and the possible answers. */
export interface UserQuestion {
  optionName: keyof typeof UNIT_NAMES | 'series' | 'columns' | 'frames' | 'roles' | 'other';
  /** Role of the log that the user has to choose. If the option is `other`, one log of a pair is missing, and this is the role of the log that was found. */
  logRole?: LogRole;
  /** Possible answers, the likeliest first. */
  possibleAnswers: string[];
  /** Columns of the table: their names, or the cells of its first row. */
  columnNames?: string[];
  /** Proposed field of each column, after a minus sign if the column's numbers are to be negated. If `proposedFields` is missing, the names in `possibleAnswers` are the proposed fields. */
  proposedFields?: string[];
}

/** Question to the user about the file of the given name. */
export type FileQuestion = UserQuestion & { fileName: string };

/** Poses in s, m and rad. `breaks` has the rising indices of rows before which the path is unknown, because the pose jumps. */
export interface Poses { t: Float64Array; x: Float64Array; y: Float64Array; theta: Float64Array; breaks: Uint32Array }

/** Commands in s, m/s and rad/s. */
export interface Commands { t: Float64Array; v: Float64Array; omega: Float64Array; breaks: Uint32Array }

/** Log of one robot, as plain data that a worker can post. */
export interface Log {
  /** Name of the file, with the series and the frames if it has several logs. */
  logName: string;
  logKind: LogKind;
  /** Whole seconds that were subtracted from all times of the log. */
  startTime: number;
  /** Rows in the form that the core takes: times rise strictly, and count in seconds from `startTime`. */
  motionData: Poses | Commands;
  logSummary: LogSummary;
  /** Question that proposes to mirror the log by negating y and the headings; undefined for a topic, because the axes of a topic cannot be changed. */
  mirroringQuestion?: FileQuestion;
}

/** Returns questions that propose to mirror one log of each drive whose odometry or reference is mirrored, as a check shows. Mirroring either log gives the same α's. */
export const mirroringQuestionsOf = (drives: Record<LogRole, Log>[], checks: CalibrationCheck[]): FileQuestion[] =>
  checks.filter(({ cause }) => cause === 'mirrored').flatMap((check) => check.drives.flatMap((drive) => drives[drive].reference.mirroringQuestion ?? drives[drive].odometry.mirroringQuestion ?? []));

export type DropCause = 'damaged' | 'notFinite' | 'noRotation' | 'noStamp' | 'short' | 'text' | 'duplicate' | 'repeated' | 'burst' | 'held';

/** Basis on which a unit was determined: a name, the size of the numbers, the rate of the rows, the format, dates, an option, or only that the unit is usual (`usage`). */
export type UnitBasis = 'name' | 'size' | 'rate' | 'format' | 'date' | 'option' | 'usage';

/** Notes that make the α's doubtful even if all checks pass. */
export type LogWarning = Extract<LogNote['name'], 'localizer' | 'swappedRoles'>;

/** Note about a log: key of its sentence in `logSummaryTexts.notes`, and the values in that sentence. */
export interface LogNote {
  name: 'cutShort' | 'damaged' | 'sorted' | 'yUp' | 'wFirst' | 'swappedRoles' | 'apart' | 'localizer';
  values: (string | number)[];
}

/** Summary of a log: statistics, and the decisions with which the log was read. */
export interface LogSummary {
  rows: number;
  used: number;
  /** Number of dropped rows by cause. `first` is the line or the message number of the first dropped row; 0 if unknown. */
  dropped: Partial<Record<DropCause, { count: number; first: number }>>;
  seconds: number;
  /** Rate in Hz, from the median time between rows. */
  rate: number;
  /** Length of the path in m. */
  distance: number;
  /** Gaps: times between rows of more than five times the median. `longest` is a duration in s, and `first` a time in s after the first row. */
  gaps: { count: number; longest: number; first: number };
  /** Jumps: steps that are much faster than the others. `first` is a time in s after the first row. */
  jumps: { count: number; first: number };
  units: {
    time: { unit: TimeUnit; by: UnitBasis };
    length: { unit: LengthUnit; by: UnitBasis };
    angle: { unit: AngleUnit | 'quaternion' | 'none'; by: UnitBasis };
  };
  /** Source of the times: "header.stamp", "log time", or the name of a column. */
  clock: string;
  frames?: FramePair;
  columns?: Record<string, string>;
  notes: LogNote[];
}

/** Name of the clock of messages without stamps: the time of recording. */
export const RECORDING_CLOCK = 'log time';

type SummaryLabel = keyof LogTexts['logSummaryTexts']['rowLabels'];

/** Returns the lines of a log's summary by their labels. */
export function summaryLinesOf({ logSummary }: Log, summaryTexts: LogTexts['logSummaryTexts']): Partial<Record<SummaryLabel, string[]>> {
  const { rows, used, dropped, seconds, rate, distance, units, clock, columns, frames: framePair, gaps, jumps, notes } = logSummary;
  return {
    rows: [summaryTexts.rowsSummary(used, rows, seconds, rate, distance)],
    ...(columns && { columns: [Object.values(columns).join(', ')], units: [summaryTexts.unitsSummary(units)] }),
    ...(framePair && { frames: [formatFrames(framePair)] }),
    ...(clock === RECORDING_CLOCK && { clock: [summaryTexts.recordedTimesNote] }),
    dropped: (Object.entries(dropped) as [DropCause, { count: number; first: number }][]).map(([cause, { count, first }]) => summaryTexts.droppedRowsSummary(cause, count, columns ? first : 0)),
    gaps: [gaps.count ? summaryTexts.gapsSummary(gaps.count, gaps.first, gaps.longest) : summaryTexts.noGapsSummary],
    ...(jumps.count && { jumps: [summaryTexts.jumpsSummary(jumps.count, jumps.first)] }),
    notes: notes.map(({ name, values }) => {
      const noteText: string | ((...values: any[]) => string) = summaryTexts.notes[name];
      return typeof noteText === 'string' ? noteText : noteText(...values);
    }),
  };
}

/** Returns the summary of a log as sentences. The first sentence is about the rows. */
export function summarySentencesOf(log: Log, summaryTexts: LogTexts['logSummaryTexts']): string[] {
  const { rows = [], ...otherLines } = summaryLinesOf(log, summaryTexts);
  return [...rows, ...Object.entries(otherLines).flatMap(([label, lines]) => lines.map((line) => `${summaryTexts.rowLabels[label as SummaryLabel]}: ${line}`))];
}

export type LogTexts = typeof english;

export interface ErrorPlace {
  fileName: string;
  /** Number of a line in a file, or of a message in a topic, counted from 1. */
  lineNumber?: number;
  topicName?: string;
}

/** Function that returns the reason in an error message, from the texts of a language. In the message, the reason follows the place of the error. */
export type ErrorReason = (errorReasons: LogTexts['refusalReasons']) => string;

/** Maximum number of characters of a quoted name or value, and of a quoted error message of a library. */
const [MAX_QUOTED_LENGTH, MAX_REASON_LENGTH] = [40, 100];

/** Error of a log. Its message is one sentence that names the file, the line or topic, the value, and what is expected. */
export class LogError extends Error {
  errorPlace: ErrorPlace;
  /** Question whose answer resolves the error. */
  userQuestion?: UserQuestion;
  /** Returns the message in the language of the given words. */
  composeMessage: (errorReasons: LogTexts) => string;

  constructor(place: ErrorPlace, formatReason: ErrorReason, userQuestion?: UserQuestion) {
    const composeMessage = (summaryTexts: LogTexts) => `${summaryTexts.errorPlaceText(truncate(place.fileName), place.lineNumber ?? 0, truncate(place.topicName ?? ''))}: ${formatReason(summaryTexts.refusalReasons)}`;
    super(composeMessage(english));
    this.name = 'LogError';
    this.errorPlace = place;
    this.userQuestion = userQuestion;
    this.composeMessage = composeMessage;
  }
}

/** Shortens a text to one line for quotation in a sentence. */
export function truncate(text: string, maxLength = MAX_QUOTED_LENGTH): string {
  // oxlint-disable-next-line no-control-regex
  const shortLine = text.slice(0, maxLength + 1).replaceAll(/[\0-\x1f\x7f-\x9f\u2028\u2029]/g, '\ufffd');
  return shortLine.length > maxLength ? `${shortLine.slice(0, maxLength)}…` : shortLine;
}

/** Returns the shortened message of a library's error, for use in a sentence. */
export function reasonOf(error: unknown): string {
  const message = error instanceof Error ? error.message : String(error);
  return truncate(message.replace(/ \[(library=[^\]]*|no header)\]$/, ''), MAX_REASON_LENGTH);
}

/** Returns the first eight names of a list, separated by commas, for use in a sentence. */
export function listNames(names: string[]): string {
  const maxNameCount = 8;
  return [...names.slice(0, maxNameCount).map((name) => truncate(name)), ...(names.length > maxNameCount ? ['…'] : [])].join(', ');
}

/** Reads bytes of a source; rejects with a LogError if the file has been moved or changed since it was chosen. */
export async function readBytes(sourceFile: SourceFile, start: number, end: number): Promise<Uint8Array<ArrayBuffer>> {
  try {
    return new Uint8Array(await sourceFile.slice(start, end).arrayBuffer());
  } catch (error) {
    const reason = error instanceof Error ? error.name : String(error);
    throw new LogError({ fileName: sourceFile.name }, (summaryTexts) => summaryTexts.unreadableFileReason(reason));
  }
}
