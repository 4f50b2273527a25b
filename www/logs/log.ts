/** Logs of robots, the recordings that they are read from, and their summaries. */

/** File, or other bytes with a name. A file of a dropped folder has its path in the folder. */
export type Source = Pick<File, 'name' | 'size' | 'slice'> & { path?: string };

/** Contents of a log: poses of the robot, or velocity commands. */
export type LogKind = 'poses' | 'commands';

/** Roles of the two logs of a drive. */
export const ROLES = ['odometry', 'reference'] as const;

export type Role = (typeof ROLES)[number];

/** Part of a recording that one log can be read from: a topic, or a group of columns with a common prefix. */
export interface Series {
  /** Topic, or prefix of the columns ("gt_", "/odom"); empty where a table has one group only. */
  name: string;
  /** Message type, or the columns as a sentence names them. */
  type: string;
  /** Null where the series cannot be read. */
  kind: LogKind | 'positions' | 'transforms' | null;
  /** True where a series of poses has speeds too, which a choice of commands reads. */
  hasCommands?: boolean;
  /** Messages; 0 for a table, whose rows are not counted yet. */
  count: number;
  /** Pairs of frames whose chain of transforms may be a pose of the robot; undefined for static transforms. */
  frames?: Frames[];
}

export interface Frames {
  parent: string;
  child: string;
}

/** Prints frames for a reader. */
export const framesText = ({ parent, child }: Frames) => `${parent} → ${child}`;

/** Returns frames in the form of an option. */
export const framesOption = ({ parent, child }: Frames) => `${parent},${child}`;

export interface Choice {
  /** Name of the series. */
  series: string;
  /** Kind of log: `commands` prefers commands to poses, and `poses` excludes commands. By default poses come first. */
  kind?: LogKind;
  /** Ends of a chain of transforms. */
  frames?: Frames;
}

/** Container: a file, or a folder that belongs together. */
export interface Recording {
  name: string;
  format: 'mcap' | 'rosbag' | 'sqlite' | 'csv' | 'tum';
  /** Series in the order of their names, or of their columns. */
  series: Series[];
  /** Reads the logs of all choices in one pass; rejects with a LogError. */
  read(choices: Choice[], onProgress?: (share: number) => void): Promise<Log[]>;
}

/** Units that logs may have, by the option that states them. */
export const UNITS = { timeUnit: ['s', 'ms', 'us', 'ns'], lengthUnit: ['m', 'cm', 'mm'], angleUnit: ['rad', 'deg'] } as const;

export type TimeUnit = (typeof UNITS.timeUnit)[number];
export type LengthUnit = (typeof UNITS.lengthUnit)[number];
export type AngleUnit = (typeof UNITS.angleUnit)[number];

/** Answers to questions about a file that its contents leave open. */
export interface OpenOptions {
  /** Names of a table's columns, for one without a header or in the place of its header. */
  columns?: string[];
  timeUnit?: TimeUnit;
  lengthUnit?: LengthUnit;
  angleUnit?: AngleUnit;
}

/** Question of an error: the option that answers it, and the answers. */
export interface Question {
  what: keyof typeof UNITS | 'series' | 'columns' | 'frames' | 'roles' | 'other';
  /** Log that a choice of series or frames is for, or that is there. */
  role?: Role;
  choices: string[];
  /** Columns of the table: their names, or the cells of its first row. */
  columns?: string[];
}

interface Breaks {
  /** Rising indices of rows before which the path is unknown: after unusable rows, and at jumps. The core finds gaps by itself. */
  breaks: Uint32Array;
}

/** Poses in s, m and rad. */
export interface Poses extends Breaks { t: Float64Array; x: Float64Array; y: Float64Array; theta: Float64Array }

/** Commands in s, m/s and rad/s. */
export interface Commands extends Breaks { t: Float64Array; v: Float64Array; omega: Float64Array }

/** Log, plain data that a worker can post. */
export interface Log {
  /** File, with the series and the frames of a recording. */
  name: string;
  kind: LogKind;
  /** Whole seconds that were subtracted from all times. */
  start: number;
  /** Rows for the core: times rise strictly, in seconds after the start. */
  data: Poses | Commands;
  summary: Summary;
}

/** Cause for dropping a row. */
export type Cause = 'damaged' | 'notFinite' | 'noRotation' | 'noStamp' | 'short' | 'text' | 'duplicate' | 'repeated' | 'stray' | 'setBack' | 'held';

/** Basis of a decision about a unit: a name, the size of the numbers, rate and speed, the format's definition, dates, an option, or usage without another sign. */
export type Basis = 'name' | 'size' | 'rate' | 'format' | 'date' | 'option' | 'usage';

/** Notes that leave α's doubtful even if all checks pass. */
export type Warning = Extract<Note['name'], 'localizer' | 'swapped'>;

/** Sentence about a log: name of a word in `found.notes`, and the values in it. */
export interface Note {
  name: 'cutShort' | 'damaged' | 'missing' | 'sorted' | 'noZone' | 'upAxis' | 'swapped' | 'apart' | 'localizer';
  values: (string | number)[];
}

/** Numbers and decisions about a log. */
export interface Summary {
  /** Rows or messages. */
  rows: number;
  used: number;
  /** Causes in the order of their sentences; `first` is a line or the number of a message, 0 if there is none. */
  dropped: Partial<Record<Cause, { count: number; first: number }>>;
  /** Duration. */
  seconds: number;
  /** Rows in a second, by the median step. */
  rate: number;
  /** Length of the path in m. */
  distance: number;
  /** Gaps of more than five usual steps, in s; `first` is after the first row. */
  gaps: { count: number; longest: number; first: number };
  /** Steps that are much faster than the others; `first` is in s after the first row. */
  jumps: { count: number; first: number };
  units: {
    time: { unit: TimeUnit; by: Basis };
    length: { unit: LengthUnit; by: Basis };
    angle: { unit: AngleUnit | 'quaternion' | 'none'; by: Basis };
  };
  /** Source of the times: "header.stamp", "log time", or the column. */
  clock: string;
  frames?: Frames;
  /** Columns by field. */
  columns?: Record<string, string>;
  notes: Note[];
}

/** Clock of messages without stamps. */
export const LOG_TIME = 'log time';
