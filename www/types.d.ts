/** Types that the code imports. scripts/types.mjs generates those of settings, simulations and elements from their declarations. */

import type { AlphaCalibratorSettings, BananaMachineSettings, CalibrationLegs, CalibrationStats, CartesianMoments, Command, DeadReckoningSettings, ExponentialMoments, MapSqueezeSettings, Start, SystematicErrors } from '../build/simulations.d.ts';

export type * from '../build/simulations.d.ts';
export type * from '../build/elements.d.ts';

/** JavaScript interface of the core, as `load()` returns it. Units are metres, radians and seconds. */
export type Motion = typeof import('../build/simulations.d.ts');

/** Returns the core, see core.ts. */
export declare function load(source?: BufferSource | URL | string | WebAssembly.Module): Promise<Motion>;
/** Returns a new core with its own memory. */
export declare function instantiate(source?: BufferSource | URL | string | WebAssembly.Module): Promise<Motion>;

/** Declaration of a setting, or of one number that belongs to a group or list of numbers. */
export interface Declaration {
  /** Name of the setting as attribute, as property and in states. */
  key: string;
  /** Key of the group or list that contains the setting. */
  in?: string;
  /** Key of the list setting whose last numbers follow from this setting. They are this setting times the factors in `weights`. */
  of?: string;
  /** Factors by which this setting is multiplied to give the last numbers of the list setting `of`. */
  weights?: number[];
  /** Key within the group; only given if it differs from `key`, because another group has a field of the same name. */
  field?: string;
  /** Index of the number in the list, from 0. */
  index?: number;
  type: 'word' | 'number' | 'whole' | 'boolean' | 'numbers' | 'group';
  /** Words that the setting allows. */
  words?: string[];
  /** Keys of the fields of a group. */
  fields?: string[];
  unit?: string;
  /** True if the value may be null. */
  nullable?: boolean;
  /** Minimum of the number, or of each number of a list. */
  min?: number;
  /** Maximum of the number, or of each number of a list. */
  max?: number;
  /** Initial value of the setting. */
  default: string | number | boolean | number[] | Record<string, number> | null;
  /** Sentence that describes the setting. */
  sentence: string;
}

/** Fields that the state of every figure has, even a partial state. */
export interface FigureState {
  /** Tag of the element. */
  widget: string;
  version: 1;
}

/**
 * Map as plain data: a floor plan, whose walls are x, y pairs of both ends, or square cells, row by row from the bottom. Cells
 * are packed as bits, most significant bit first, in base64: `occupied` and `unknown` have a bit for each cell. Lengths are in m,
 * yaw is in rad. The map of an element is frozen; a change replaces it.
 */
export type MapData =
  | Readonly<{ name?: string; bounds: readonly number[]; walls: readonly (readonly number[])[] }>
  | Readonly<{ name?: string; columns: number; rows: number; resolution: number; origin: readonly number[]; occupied: string; unknown?: string }>;

/** Options of a velocity model; the default of `noise` is "normal". */
export interface VelocityModelOptions extends Partial<Pick<BananaMachineSettings, 'noise'>> {
  /** Variance coefficients: α₁…α₆ of the velocity model, α₁…α₄ of the odometry model. */
  alphas: ArrayLike<number>;
}

/** Options of an odometry model; the default of `reverseAware` is false. */
export interface OdometryModelOptions extends VelocityModelOptions, Partial<Pick<BananaMachineSettings, 'reverseAware'>> {}

/**
 * Three numbers. A twist has the speeds along the body's x and y (m/s), and the turn rate (rad/s). Exponential coordinates describe a motion by its
 * components along (m), lateral (m) and heading (rad).
 */
export type Twist = ArrayLike<number>;

/** Options of `propagate`; the defaults are the recursion "chapter" and one step. */
export interface Propagation extends Partial<Pick<DeadReckoningSettings, 'compounding' | 'steps'>> {
  /** Covariance of the start pose in exponential coordinates about its mean, three rows of three; default 0. */
  sigma?: ArrayLike<ArrayLike<number>>;
  command: Command;
  /** Noise parameters α₁…α₆ of the velocity model. */
  alphas: ArrayLike<number>;
}

/** Poses, in arrays of the same length: increasing times in s, x and y in m, headings in rad. */
export interface LoggedPoses {
  t: ArrayLike<number>;
  x: ArrayLike<number>;
  y: ArrayLike<number>;
  theta: ArrayLike<number>;
  /** Indices before which the path is unknown, in addition to those after a pause: where rows are missing, or the path jumps. */
  breaks?: ArrayLike<number>;
}

/** Commands, each held until the next: increasing times in s, speeds in m/s, turn rates in rad/s. */
export interface LoggedCommands extends Pick<LoggedPoses, 't' | 'breaks'> {
  v: ArrayLike<number>;
  omega: ArrayLike<number>;
}

/** Options of `calibrate`; the defaults are the model "odometry", the rule "thrun" (Table 5.6 as printed), and "reject". */
export interface CalibrationOptions extends Partial<Pick<AlphaCalibratorSettings, 'model' | 'rule' | 'outliers'>> {
  /** Odometry of one drive, or of several. */
  odometry: LoggedPoses | LoggedCommands | (LoggedPoses | LoggedCommands)[];
  /** Poses by the reference, one log for each drive. */
  reference: LoggedPoses | LoggedPoses[];
  /** Length of a leg: thresholds of translation (m, default 0.25) and rotation (rad, default 0.2), as AMCL's `update_min_d` and `update_min_a`, or a duration (s). */
  legs?: { distance?: number; angle?: number } | { duration: number };
  /**
   * Systematic errors that are corrected. The default is all errors that the log identifies, except scales that are not constant. True also corrects such
   * scales; false corrects no errors.
   */
  correct?: boolean | { [Name in keyof SystematicErrors]?: boolean };
  /** Standard deviation of each coordinate of the reference, m; estimated if it is not given. */
  positionStd?: number;
  /** Standard deviation of the reference's heading, rad; estimated if it is not given. */
  yawStd?: number;
}

/** Result of a calibration. */
export interface Calibration extends CalibrationStats {
  legs: CalibrationLegs;
}

/** Odometry of a robot and a reference of its true poses: of one drive, or of several in arrays. */
export interface CalibrationLog extends Pick<CalibrationOptions, 'odometry' | 'reference'> {
  name?: string;
}

// Short names of generated types.
export type Pose = Start;
export type SamplerName = MapSqueezeSettings['sampler'];
export type Moments = CartesianMoments | ExponentialMoments;
