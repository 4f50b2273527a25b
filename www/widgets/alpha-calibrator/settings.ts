/** Settings of the Alpha Calibrator: their attributes, state fields and sliders. Also the data that the figure shows, derived from a fit. */

import { createDefinition } from '../../figure/definition.ts';
import type { MemoizedResult } from '../../scene/cache.ts';
import type { AlphaCalibrator as Simulation, AlphaCalibratorSettings, CalibrationLegs, CalibrationLog } from '../../types.d.ts';

/** Styles of lines and marks in the pictures: first the classes of legs in the order of `LEG_CLASSES`, then all other lines. */
export const LINE_STYLES = {
  likely: { colourRole: 'truth', width: 1.5, dash: [] },
  plausible: { colourRole: 'muted', width: 2, dash: [] },
  unlikely: { colourRole: 'prediction', width: 3.25, dash: [] },
  implausible: { colourRole: 'accent', width: 4.5, dash: [] },
  outlier: { colourRole: 'ink', width: 1.25, shape: 'ring' },
  odometry: { colourRole: 'prior', width: 1.25, dash: [2.5, 3.5] },
  predicted: { colourRole: 'prediction', width: 2, dash: [7, 4] },
  reference: { colourRole: 'ink', width: 2.25, dash: [] },
} satisfies Record<string, import('../../ui/theme.ts').LineStyle>;

export type LineName = keyof typeof LINE_STYLES;

/** Classes of legs by the p-values of their residuals, from the highest p-value to the lowest. */
export const LEG_CLASSES = ['likely', 'plausible', 'unlikely', 'implausible'] as const satisfies LineName[];

/** Motions against which squared residuals are plotted. */
export const REGRESSORS = ['turn', 'distance'] as const;

/** Maximum index of a leg in a shared link. It is larger than any number of legs, which is known only after the fit. */
const MAX_LEG_INDEX = 9_999_999;

export const documentation = {
  state: {
    leg: { type: 'number | null', sentence: 'The leg that is shown, from 0; null, or one that is not there, for the largest residual that is no outlier.' },
  },
};

/** Leg length for which the true α's of the simulated log hold. It is also the initial setting of the element. */
export const SIMULATED_LEG_LENGTHS = { distance: 0.25, angle: 0.2 };

/** Combination of a motion model and a noise rule. On screen it is one choice, in the settings two fields. */
export type ModelRule = keyof typeof import('./en.ts').en.modelRuleNames;

export const modelRuleOf = ({ model, rule }: AlphaCalibratorSettings): ModelRule => (model === 'velocity' ? 'velocity' : rule);

export function settingsOfModelRule(modelRule: ModelRule) {
  if (modelRule === 'velocity') return { model: 'velocity', rule: 'thrun' };
  return { model: modelRule === 'omni' ? 'omnidirectional' : 'odometry', rule: modelRule };
}

/** Noise components by model, in the order of the residuals. */
export const NOISE_COMPONENTS = {
  odometry: ['rot1', 'trans', 'rot2'],
  omnidirectional: ['rot2', 'trans', 'strafe'],
  velocity: ['v', 'omega', 'gamma'],
} as const;

export const definition = createDefinition('alpha-calibrator', {
  messageKey: 'calibrator',
  overlayStyles: LINE_STYLES,
  sliderSpecs: {
    distance: { symbol: '*d*', colourRole: 'prior', min: 0.05, max: 1, step: 0.01, decimals: 2 },
    angle: { symbol: '*φ*', colourRole: 'prior', min: 0.05, max: 1, step: 0.01, decimals: 2 },
    duration: { symbol: '*T*', colourRole: 'prior', min: 0, max: 5, step: 0.1, decimals: 2 },
    positionStd: { symbol: '*σ*_{xy}', colourRole: 'truth', min: 0, max: 0.05, step: 0.001, decimals: 3 },
    yawStd: { symbol: '*σ*_{θ}', colourRole: 'truth', min: 0, max: 0.05, step: 0.001, decimals: 3 },
    inflation: { symbol: '*f*', colourRole: 'prediction', min: 0.1, max: 5, step: 0.05, decimals: 2 },
  },
  elementFields: {
    leg: { type: 'whole', default: null, nullable: true, min: 0, max: MAX_LEG_INDEX },
  },
});

export type ViewModel = ReturnType<typeof viewModelOf>;

/** Returns the data that the figure shows: the latest complete fit of a simulation, and the requested settings. */
export function viewModelOf(simulation: Simulation, log: CalibrationLog | null, fitMemo: MemoizedResult<ReturnType<typeof readFit>>) {
  // `fits` is a counter that increases with each complete fit, and serves as the cache key.
  const { config, fittedConfig, fits, isPending } = simulation.read();
  return { ...fitMemo.getResult([simulation, fits], () => readFit(simulation, fittedConfig)), log, config, fittedConfig, isPending };
}

/** Returns the fit of a simulation, the true values if the log is simulated, and the legs that are selected by default. */
function readFit(simulation: Simulation, { distance }: Simulation['config']) {
  const { stats, legs, truth } = simulation;
  return {
    stats,
    legs,
    truth,
    /** Class of each leg, as an index of `LEG_CLASSES`. */
    legClasses: legClassesOf(legs),
    /** Legs with the largest residuals, the largest first. */
    worstLegs: worstLegsOf(legs),
    /** Leg that is shown if the user has selected none. */
    defaultLeg: defaultLegOf(legs, distance),
  };
}

/** Number of legs in the list of legs with the largest residuals. */
const LISTED_LEG_COUNT = 10;

/** Quantiles 0.5, 0.95 and 0.999 of χ² with 0 to 3 degrees of freedom. */
const CHI2_QUANTILES = [[0, 0, 0], [0.455, 3.841, 10.828], [1.386, 5.991, 13.816], [2.366, 7.815, 16.266]];

/** Returns the class of each leg: the index of the first quantile that its squared Mahalanobis distance does not exceed. */
export function legClassesOf({ count, squared, residuals }: Pick<CalibrationLegs, 'count' | 'squared' | 'residuals'>) {
  return Uint8Array.from({ length: count }, (_, leg) => {
    const quantiles = CHI2_QUANTILES[countObservedResiduals(residuals, leg)];
    const legClass = quantiles.findIndex((quantile) => squared[leg] <= quantile);
    return legClass < 0 ? quantiles.length : legClass;
  });
}

/** Returns the number of residuals that are defined for a leg. */
export const countObservedResiduals = (residuals: Float64Array, leg: number) => residuals.subarray(3 * leg, 3 * leg + 3).reduce((count, residual) => count + Number(!Number.isNaN(residual)), 0);

function worstLegsOf({ squared }: Pick<CalibrationLegs, 'squared'>) {
  const minListedSquare = squared.toSorted()[Math.max(0, squared.length - LISTED_LEG_COUNT)];
  const worstLegs = [...squared.keys()].filter((leg) => squared[leg] >= minListedSquare);
  return worstLegs.sort((legIndex, otherLegIndex) => squared[otherLegIndex] - squared[legIndex]).slice(0, LISTED_LEG_COUNT);
}

/**
 * Returns the leg with the largest residual, except outliers and legs shorter than `distance`. An outlier is no evidence against the model, and a turn on
 * the spot shows no cloud. Returns 0 if all legs are excluded, and −1 if there are none.
 */
function defaultLegOf({ squared, outliers, odometry }: CalibrationLegs, distance: number): number {
  const hasFullLength = (leg: number) => Math.hypot(odometry[6 * leg + 3] - odometry[6 * leg], odometry[6 * leg + 4] - odometry[6 * leg + 1]) >= distance;
  const worstLeg = squared.reduce((worstSoFar, squaredDistance, leg) => (outliers[leg] === 0 && hasFullLength(leg) && squaredDistance > (squared[worstSoFar] ?? -1) ? leg : worstSoFar), -1);
  return worstLeg < 0 && squared.length > 0 ? 0 : worstLeg;
}

/** Returns true if the fit has the noise rule and leg length for which the true α's hold. */
export const isTruthComparable = ({ truth, fittedConfig: { rule, model, distance, angle, duration } }: Pick<ViewModel, 'truth' | 'fittedConfig'>) =>
  truth !== null && model === 'odometry' && rule === 'thrun' && distance === SIMULATED_LEG_LENGTHS.distance && angle === SIMULATED_LEG_LENGTHS.angle && duration === 0;
