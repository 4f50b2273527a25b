/** The JavaScript face of the core, as `load()` returns it. Metres, radians, seconds throughout. */

export type ModelName = 'velocity' | 'odometry';
export type NoiseName = 'normal' | 'triangular';
/** "plane" is (x, y); "twist" is (ξ along, ξ heading). */
export type ViewName = 'plane' | 'twist';

/** One command: an arc driven at constant speeds. */
export interface Command {
  /** Speed along the heading, m/s; negative in reverse. −1e6 to 1e6. */
  v: number;
  /** Turn rate, rad/s; positive to the left. −1e6 to 1e6. */
  omega: number;
  /** Duration, s. 1e-6 to 1e6. */
  dt: number;
}

export interface Settings {
  /** Whose noise it is; each model keeps its own alphas. */
  model: ModelName;
  /** Distribution of the noise. Both have the variances that the alphas say. */
  noise: NoiseName;
  /** The same for every robot. */
  command: Command;
  /** Noise parameters, each 0 to 1e6: the present model's six (velocity) or four (odometry). */
  alphas: number[];
  /** Index, from 1, of the only α that is in effect; null for all of them. */
  isolate: number | null;
  /** Robots in the whole cloud. A whole number, 1 to 10 000 000. */
  samples: number;
  /** The same seed is the same robots. A whole number, 0 to 2⁵³ − 1. */
  seed: number;
}

/** A command worth starting from. */
export interface Preset extends Command {
  name: 'straight' | 'gentle' | 'hard' | 'pivot';
}

/** Of (x, y, θ) in m, m, rad; in exponential coordinates of ξ along, lateral (m) and heading (rad). */
export interface Moments {
  /** Three numbers; θ is a circular mean. */
  mean: number[];
  /** Three rows of three. */
  cov: number[][];
}

/** All over the samples shown; NaN where undefined. */
export interface Stats {
  /** Samples shown. */
  n: number;
  /** Of the poses. */
  cartesian: Moments;
  /** Of the poses in exponential coordinates about the start. NaN where the chart does not hold. */
  exponential: Moments;
  /** Third standardized moment across the mean heading; positive with the longer tail at its left. */
  crossTrackSkew: number;
  /** Its standard error. */
  crossTrackSkewError: number;
  /** The skew that the fitted Gaussian in exponential coordinates predicts. */
  gaussianSkew: number;
  /** Correlation of cross-track position and heading, −1 to 1. */
  rhoCrossHeading: number;
  /** Shares, 0 to 1, inside the 2σ outlines in (x, y) and in (ξ along, ξ heading). */
  coverage: { ellipse: number; exponential: number };
}

/** Outlines on the floor as x, y pairs in m, the first point repeated at the end; empty where undefined. */
export interface Contours {
  /** The arc driven without noise, from the start to its end; open. */
  command: Float64Array;
  /** 2σ, of the Gaussian fitted in (x, y). */
  ellipse: Float64Array;
  /** 2σ, of the linearization at the command that an extended Kalman filter uses. */
  linearized: Float64Array;
  /** 2σ, of the Gaussian fitted in exponential coordinates. */
  exponential: Float64Array;
  /** The same in (ξ along, ξ heading), m and rad. */
  twistEllipse: Float64Array;
}

export interface TableColumn extends Moments {
  crossTrackSkew: number;
}

/** Moments of the pose three ways, and of its exponential coordinates. */
export interface Table {
  /** Noise-free end, and covariance to first order in the noise. */
  linearized: TableColumn;
  /** By quadrature. */
  exact: TableColumn;
  /** On the samples shown. */
  measured: TableColumn;
  /** The commanded twist and its noise; null for the odometry model, whose noise has no such form. */
  tangent: Moments | null;
}

/** One sample, and the arc that reaches its place. */
export interface Inspection {
  /** x, y in m, θ in rad, in (−π, π]. */
  pose: Float64Array;
  /** ξ along and lateral in m, heading in rad. */
  twist: Float64Array;
  /** Speed of the arc, m/s. */
  vHat: number;
  /** Turn rate of the arc, rad/s. */
  omegaHat: number;
  /** Turn rate after it, rad/s over the same duration. */
  gammaHat: number;
  /** The arc as x, y pairs in m from the start. */
  path: Float64Array;
}

/**
 * One command sent to many identical robots from (0, 0), heading along x. Whatever is out of range
 * throws a TypeError or RangeError that names the field, and changes nothing.
 */
export interface BananaMachine extends Disposable {
  /** A copy; changing it changes nothing. */
  readonly config: Settings;
  /** How many samples there are now, 0 to `config.samples`. */
  readonly shown: number;
  /** Whether exponential coordinates reach as far as the robots turn: to short of a full circle. */
  readonly chartHolds: boolean;
  /** x, y (m), θ (rad) of each sample shown; a copy. */
  readonly poses: Float64Array;
  /** ξ along, lateral (m), heading (rad) of each sample shown; a copy. */
  readonly twists: Float64Array;
  readonly stats: Stats;
  readonly contours: Contours;
  readonly table: Table;
  /** Changes the settings that are named. A complete cloud stays complete. */
  configure(settings: Partial<Settings>): void;
  /**
   * As `configure`, in slices: `advance` is to be called until it says true. Until then the figures are the former ones, and
   * the samples partly so.
   */
  begin(settings: Partial<Settings>): void;
  /** Works on what was begun, for about as many poses of twice as many as are shown; whether all is done. */
  advance(poses: number): boolean;
  /** Shows up to `count` samples more, 0 to 10 000 000. Returns how many are shown then. */
  grow(count: number): number;
  /** As `grow`, in slices like `begin`. */
  beginToGrow(count: number): void;
  /** Shows none; the same samples come again. */
  restart(): void;
  /** Exact cross-track skew at 2 to 10 000 evenly spaced turn rates, rad/s; NaN where undefined. */
  skewCurve(omegaMin: number, omegaMax: number, points: number): Float64Array;
  /** A sample shown, counted from 0. */
  inspect(index: number): Inspection;
  /** The nearest sample inside an ellipse of these radii around a point of the view; −1 for none. */
  nearest(view: ViewName, x: number, y: number, radiusX: number, radiusY: number): number;
  /** Samples a cell of a grid over a part of the view, row by row from yMax down; 2²⁴ cells at most. */
  density(
    view: ViewName,
    xMin: number,
    yMin: number,
    xMax: number,
    yMax: number,
    columns: number,
    rows: number,
  ): Uint32Array;
  /**
   * The same as RGBA pixels, each count c in the colour ramp[255·√(c/most)] of 256, transparent where there is nobody. A
   * view of the core's memory: to be used before the machine is asked for anything else.
   */
  picture(
    view: ViewName,
    xMin: number,
    yMin: number,
    xMax: number,
    yMax: number,
    columns: number,
    rows: number,
    ramp: Uint8Array,
  ): Uint8ClampedArray<ArrayBuffer>;
  /** The heading of a sample shown, counted from 0, rad. */
  heading(index: number): number;
  /** Gives the memory back. A second call does nothing. */
  free(): void;
}

export interface BananaMachineClass {
  readonly presets: Preset[];
  /** Largest `samples`. */
  readonly maxSamples: number;
  /** What is left out is as the widget opens: the gentle arc, velocity model, normal noise. */
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
  /** Walls whose distance was computed; most verdicts need none. */
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

/**
 * A map as plain data. A floor plan of walls from one point to another, or square cells row by row from the
 * bottom: base64 of a bit each, the first of eight highest, 1 where occupied. Lengths in m, yaw in rad.
 */
export type MapData =
  | { name?: string; bounds: number[]; walls: number[][] }
  | { name?: string; columns: number; rows: number; resolution: number; origin: number[]; occupied: string };

/** What both elements have. */
export interface WidgetElement<State, Figures> extends HTMLElement {
  v: number;
  omega: number;
  dt: number;
  command: Command;
  alphas: number[];
  samples: number;
  seed: number;
  theme: 'auto' | 'light' | 'dark';
  /** Whether the fragment of the page's address carries the state. */
  share: boolean;
  /** The sample that is marked, counted from 0. */
  marked: number | null;
  /** Null before there are any. */
  readonly stats: Figures | null;
  /** x, y (m), θ (rad) of each sample shown; a copy. */
  readonly poses: Float64Array | null;
  /** Plain data; null before the figure has come near the reader for the first time. */
  getState(): State | null;
  /**
   * Puts the element into a state; what is left out stays as it is. Throws a TypeError or RangeError that
   * names the field, the value and what is allowed, and changes nothing then.
   */
  setState(state: Partial<State> & { widget: string; version: 1 }): void;
  /** The picture with twice the pixels of the screen, image/png. As the next two, throws before `load`. */
  toPNG(): Promise<Blob>;
  /** The picture as vector graphics, with a title and a description. */
  toSVG(): string;
  /** Every sample shown, after a line with the settings and the seed. */
  toCSV(): string;
  /** This page's address with the present state; rejects where `share` is not set. */
  shareLink(): Promise<string>;
  /** HTML for another page. What no attribute says, a map of one's own among it, is not in it. */
  embedCode(): string;
}

/** What every state has. */
export interface WidgetState {
  version: 1;
  command: Command;
  samples: number;
  seed: number;
  /** Samples asked for so far, 0 to `samples`. */
  shown: number;
  playing: boolean;
  /** The sample that is marked, counted from 0. */
  marked: number | null;
}

export type OverlayName = 'command' | 'ellipse' | 'linearized' | 'exponential';

export interface BananaState extends WidgetState {
  widget: 'banana-machine';
  model: ModelName;
  noise: NoiseName;
  /** Six and four, of either model. */
  alphas: { velocity: number[]; odometry: number[] };
  isolate: number | null;
  /** What Isolate leaves when it is turned on, from 1. */
  isolateChoice: number;
  overlays: OverlayName[];
}

export interface SqueezeState extends WidgetState {
  widget: 'map-squeeze';
  start: Pose;
  alphas: number[];
  clearance: number;
  conditioned: boolean;
  sampler: SamplerName;
  steps: number;
  view: 'whole' | 'close';
  /** A map of the reader's own; null for the apartment. */
  map: MapData | null;
}

/** `<banana-machine>`. Its attributes have the properties' names. */
export interface BananaMachineElement extends WidgetElement<BananaState, Stats> {
  preset: Preset['name'] | null;
  model: ModelName;
  noise: NoiseName;
  alpha1: number;
  alpha2: number;
  alpha3: number;
  alpha4: number;
  /** Null for the odometry model, as alpha6 is. */
  alpha5: number | null;
  alpha6: number | null;
  isolate: number | null;
  overlays: OverlayName[];
  /** ξ along, lateral (m), heading (rad) of each robot shown; a copy. */
  readonly twists: Float64Array | null;
}

/** `<map-squeeze>`. Its attributes have the properties' names. */
export interface MapSqueezeElement extends WidgetElement<SqueezeState, SqueezeStats> {
  preset: 'doorway' | 'wall' | 'corridor' | null;
  start: Pose;
  x: number;
  y: number;
  theta: number;
  /** Level n; null where the noise parameters are not those of a level. */
  noise: number | null;
  clearance: number;
  conditioned: boolean;
  sampler: SamplerName;
  steps: number;
  view: 'whole' | 'close';
  map: MapData | null;
  /** A byte an attempt: 1 where its end is free, 2 where its path is, 4 where it is accepted. */
  readonly verdicts: Uint8Array | null;
}

declare global {
  interface HTMLElementTagNameMap {
    'banana-machine': BananaMachineElement;
    'map-squeeze': MapSqueezeElement;
  }
}

export interface Motion {
  BananaMachine: BananaMachineClass;
  MapSqueeze: MapSqueezeClass;
  /** A whole number, 0 to 2³² − 1. */
  randomSeed(): number;
  /**
   * The arc from the origin, heading along x, that ends at (x, y), in m, −1e6 to 1e6, in the time of
   * a command; of the many, the one whose turn is nearest to that command's.
   */
  commandReaching(x: number, y: number, command: Command): { v: number; omega: number };
}

/** What core.js exports: see there. */
export declare function load(source?: BufferSource | URL | string | WebAssembly.Module): Promise<Motion>;
/** As `load`, with a memory of its own each time. */
export declare function instantiate(source?: BufferSource | URL | string | WebAssembly.Module): Promise<Motion>;
