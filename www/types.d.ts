/** Types that the code imports. scripts/types.mjs generates those of settings, simulations and elements from their declarations. */

import type { CalibrationOptions, MapSqueezeSettings, Start } from '../build/simulations.d.ts';

export type * from '../build/simulations.d.ts';
export type * from '../build/elements.d.ts';

/** JavaScript interface of the core, as `load()` returns it. Units are metres, radians and seconds. */
export type Motion = typeof import('../build/simulations.d.ts');

/** Returns the core, see core.ts. */
export declare function load(source?: BufferSource | URL | string | WebAssembly.Module): Promise<Motion>;
/** Returns a new core with its own memory. */
export declare function instantiate(source?: BufferSource | URL | string | WebAssembly.Module): Promise<Motion>;

/** Declaration of a setting, or of a number in a group or list. */
export interface Declaration {
  /** Name of the setting as attribute, as property and in states. */
  key: string;
  /** Key of the group or list that contains the setting. */
  in?: string;
  /** Key of a list setting whose last numbers are multiples of this setting. Changing this setting changes those numbers. */
  of?: string;
  /** Factors of the last numbers of the list setting `of`: each of these numbers is its factor times this setting. */
  weights?: number[];
  /** Key in the group, if it differs from `key` because a field of another group has the same name. */
  field?: string;
  /** Index in the list, from 0. */
  index?: number;
  type: 'word' | 'number' | 'whole' | 'boolean' | 'numbers' | 'group';
  /** Allowed words. */
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
  /** Initial value. */
  default: string | number | boolean | number[] | Record<string, number> | null;
  /** Description. */
  sentence: string;
}

/** Fields of every state, also of a partial one. */
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

/** Odometry of a robot and a reference of its true poses: of one drive, or of several in arrays. */
export interface CalibrationLog extends Pick<CalibrationOptions, 'odometry' | 'reference'> {
  name?: string;
}

// Short names of generated types.
export type Pose = Start;
export type SamplerName = MapSqueezeSettings['sampler'];
