/** Types that the code imports. scripts/types.mjs generates those of settings, simulations and elements from their declarations. */

import type { CalibrationOptions, MapSqueezeSettings, Start } from '../build/simulations.d.ts';

export type * from '../build/simulations.d.ts';
export type * from '../build/elements.d.ts';

/** JavaScript interface of the core, as `load()` returns it. Units are metres, radians and seconds. */
export type Motion = typeof import('../build/simulations.d.ts');

/** Returns the core, see core.ts. */
export declare function load(source?: BufferSource | URL | string | WebAssembly.Module): Promise<Motion>;
/** Returns the core, with its own memory in each call. */
export declare function instantiate(source?: BufferSource | URL | string | WebAssembly.Module): Promise<Motion>;

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
