/** The JavaScript face of the core, as `load()` returns it. Metres, radians, seconds throughout. */

export type ModelName = 'velocity' | 'odometry';
export type NoiseName = 'normal' | 'triangular';
/** "plane" is (x, y); "twist" is (ξ along, ξ heading). */
export type ViewName = 'plane' | 'twist';

export interface Command {
  v: number;
  omega: number;
  dt: number;
}

export interface Settings {
  model: ModelName;
  noise: NoiseName;
  command: Command;
  /** The present model's: six for the velocity model, four for the odometry model. */
  alphas: number[];
  /** Index, from 1, of the only α that is in effect; null for all of them. */
  isolate: number | null;
  samples: number;
  seed: number;
}

export interface Preset extends Command {
  name: 'straight' | 'gentle' | 'hard' | 'pivot';
}

export interface Moments {
  mean: number[];
  cov: number[][];
}

/** All over the samples shown; NaN where undefined. */
export interface Stats {
  n: number;
  cartesian: Moments;
  exponential: Moments;
  crossTrackSkew: number;
  crossTrackSkewError: number;
  /** The skew that the fitted Gaussian in exponential coordinates predicts. */
  gaussianSkew: number;
  rhoCrossHeading: number;
  coverage: { ellipse: number; exponential: number };
}

/** Outlines as x, y pairs; empty where undefined. */
export interface Contours {
  command: Float64Array;
  ellipse: Float64Array;
  linearized: Float64Array;
  exponential: Float64Array;
  /** In (ξ along, ξ heading). */
  twistEllipse: Float64Array;
}

export interface TableColumn extends Moments {
  crossTrackSkew: number;
}

export interface Table {
  linearized: TableColumn;
  exact: TableColumn;
  measured: TableColumn;
}

/** One sample, and the arc that reaches its place. */
export interface Inspection {
  pose: ArrayLike<number>;
  twist: ArrayLike<number>;
  vHat: number;
  omegaHat: number;
  gammaHat: number;
  /** That arc as x, y pairs from the start. */
  path: Float64Array;
}

export interface BananaMachine extends Disposable {
  readonly config: Settings;
  readonly shown: number;
  readonly poses: Float64Array;
  readonly twists: Float64Array;
  readonly stats: Stats;
  readonly contours: Contours;
  readonly table: Table;
  configure(settings: Partial<Settings>): void;
  grow(count: number): number;
  restart(): void;
  skewCurve(omegaMin: number, omegaMax: number, points: number): Float64Array;
  inspect(index: number): Inspection;
  nearest(view: ViewName, x: number, y: number, radiusX: number, radiusY: number): number;
  density(
    view: ViewName,
    xMin: number,
    yMin: number,
    xMax: number,
    yMax: number,
    columns: number,
    rows: number,
  ): Uint32Array;
  free(): void;
}

export interface BananaMachineClass {
  readonly presets: Preset[];
  readonly maxSamples: number;
  new (options?: Partial<Settings>): BananaMachine;
}

export type SamplerName = 'endpoint' | 'whole-arc' | 'sub-stepped';

export interface Pose {
  x: number;
  y: number;
  theta: number;
}

export interface SqueezeSettings {
  start: Pose;
  command: Command;
  /** Six, of the velocity model. */
  alphas: number[];
  /** Radius of the robot. */
  clearance: number;
  /** Whether draws are judged at all; where not, all of them are accepted. */
  conditioned: boolean;
  sampler: SamplerName;
  /** Parts of the command, for the sub-stepped sampler. */
  steps: number;
  samples: number;
  seed: number;
}

/** All over the attempts shown; NaN where undefined. */
export interface SqueezeStats {
  attempts: number;
  /** Draws of the model; of its shorter motions, for the sub-stepped sampler. */
  drawn: number;
  accepted: number;
  acceptanceRate: number;
  throughWall: number;
  throughWallRate: number;
  /** 95 %. */
  throughWallInterval: [number, number];
  drawsPerAccepted: number;
  wallTestsPerAccepted: number;
  /** Whether the machine stopped short of its samples. */
  gaveUp: boolean;
}

/** As read: least x, least y, greatest x, greatest y; x0, y0, x1, y1 of one wall after the other. */
export interface Plan {
  bounds: Float64Array;
  walls: Float64Array;
}

/** Square cells, row by row from the bottom, 1 where occupied. */
export interface Grid {
  columns: number;
  rows: number;
  /** Side of a cell. */
  resolution: number;
  /** x, y and yaw of the lower left corner. */
  origin: Float64Array;
  occupied: Uint8Array;
}

export interface MapSqueeze extends Disposable {
  readonly config: SqueezeSettings;
  readonly plan: Plan;
  /** The cells that the walls of the plan outline; null for a plan of walls alone. */
  readonly grid: Grid | null;
  /** The way that the command drives without noise, as x, y pairs. */
  readonly commanded: Float64Array;
  /** Whether the robot fits where it starts. */
  readonly startFree: boolean;
  /** Where it fits, near the origin of the map; null where nowhere. */
  readonly freePoint: [number, number] | null;
  readonly shown: number;
  readonly poses: Float64Array;
  /** A byte an attempt: 1 where its end is free, 2 where its path is, 4 where it is accepted. */
  readonly verdicts: Uint8Array;
  readonly stats: SqueezeStats;
  configure(settings: Partial<SqueezeSettings>): void;
  /** { bounds, walls } as a JSON floor plan has them; undefined for the apartment. */
  setPlan(plan?: unknown): void;
  /** What the YAML file of map_server says, and the bytes of a PGM file or the pixels of another. */
  setGrid(description: unknown, image: Uint8Array | ImageData): void;
  grow(count: number): number;
  restart(): void;
  /** The path driven in an attempt, as x, y pairs. */
  path(index: number): Float64Array;
  nearest(x: number, y: number, radius: number): number;
  /** Draws `count` accepted samples and forgets them; throws where the robot is wedged. */
  trial(sampler: SamplerName, steps: number, count: number): { draws: number; wallTests: number };
  free(): void;
}

export interface MapSqueezeClass {
  readonly presets: { name: 'doorway' | 'wall' | 'corridor'; start: Pose }[];
  readonly maxSamples: number;
  new (options?: Partial<SqueezeSettings>): MapSqueeze;
  alphasOfNoise(n: number): Float64Array;
}

export interface Motion {
  BananaMachine: BananaMachineClass;
  MapSqueeze: MapSqueezeClass;
  /** A whole number, 0 to 2³² − 1. */
  randomSeed(): number;
  /** The arc from the origin, heading along x, that ends at (x, y) after `dt` seconds. */
  commandReaching(x: number, y: number, dt: number): { v: number; omega: number };
}

/** Axis-aligned part of a view's world. */
export interface Extent {
  xMin: number;
  yMin: number;
  xMax: number;
  yMax: number;
}

/** Resolved CSS colours, one a role. */
export interface Palette {
  paper: string;
  ink: string;
  muted: string;
  rule: string;
  prior: string;
  prediction: string;
  /** Prediction, where it is a mass of dots rather than a line or text. */
  cloud: string;
  truth: string;
  posterior: string;
  accent: string;
}
