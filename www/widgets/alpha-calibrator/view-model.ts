/** View model of the Alpha Calibrator. */

import { SIMULATED_LEGS } from './settings.ts';
import type { AlphaCalibrator as Simulation, CalibrationLegs, CalibrationLog } from '../../types.d.ts';

export type ViewModel = ReturnType<typeof fitOf> & {
  /** True values of the simulated log. */
  truth: Simulation['truth'];
  /** Log of the user or the page; null for the simulated one. */
  log: CalibrationLog | null;
  /** Requested settings. */
  config: Simulation['config'];
  /** Settings of the fit. */
  fitted: Simulation['config'];
  /** True while the settings need another fit. */
  isPending: boolean;
};

/** Returns the view model of a simulation. The fit and the true values are read again only if they have changed. */
export function viewModelOf(simulation: Simulation, log: CalibrationLog | null, previousViewModel: ViewModel | undefined): ViewModel {
  const { config, fittedConfig: fitted, fits, isPending } = simulation.read();
  const isSameSimulation = previousViewModel?.simulation === simulation;
  const fit = isSameSimulation && previousViewModel.fits === fits ? previousViewModel : fitOf(simulation, fits, fitted);
  const truth = isSameSimulation && previousViewModel.log === log ? previousViewModel.truth : simulation.truth;
  return { ...fit, truth, log, config, fitted, isPending };
}

/** Returns the fit of a simulation, and the legs to show. `fits` is the revision number of the fit. */
function fitOf(simulation: Simulation, fits: number, { duration, distance }: Simulation['config']) {
  const { stats, legs } = simulation;
  return {
    simulation,
    fits,
    stats,
    legs,
    /** Class of each leg, as an index of `LEG_CLASSES`. */
    classes: legClassesOf(legs),
    /** Legs with the largest residuals, the largest first. */
    worst: worstLegsOf(legs),
    /** Leg that is shown if none was chosen. */
    opening: defaultLegOf(legs, duration > 0 ? MIN_DIRECTED_LEG : distance),
  };
}

/** Minimum length of a leg with a direction, m. */
const MIN_DIRECTED_LEG = 0.01;

/** Number of legs in the list of the largest residuals. */
const LISTED_LEGS = 10;

/** Quantiles 0.5, 0.95 and 0.999 of χ² with 0 to 3 degrees of freedom. */
const CHI2_QUANTILES = [[0, 0, 0], [0.455, 3.841, 10.828], [1.386, 5.991, 13.816], [2.366, 7.815, 16.266]];

/** Returns the class of each leg: the index of the first quantile that its squared Mahalanobis distance does not exceed. */
export function legClassesOf({ count, squared, residuals }: Pick<CalibrationLegs, 'count' | 'squared' | 'residuals'>) {
  return Uint8Array.from({ length: count }, (_, leg) => {
    const quantiles = CHI2_QUANTILES[observedCount(residuals, leg)];
    const classIndex = quantiles.findIndex((quantile) => squared[leg] <= quantile);
    return classIndex < 0 ? quantiles.length : classIndex;
  });
}

/** Returns the number of residuals of a leg that are defined. */
export const observedCount = (residuals: Float64Array, leg: number) => residuals.subarray(3 * leg, 3 * leg + 3).reduce((count, residual) => count + Number(!Number.isNaN(residual)), 0);

function worstLegsOf({ squared }: Pick<CalibrationLegs, 'squared'>) {
  const minListedSquare = squared.toSorted()[Math.max(0, squared.length - LISTED_LEGS)];
  const worstLegs = [...squared.keys()].filter((leg) => squared[leg] >= minListedSquare);
  return worstLegs.sort((one, other) => squared[other] - squared[one]).slice(0, LISTED_LEGS);
}

/**
 * Returns the leg with the largest residual that is not an outlier and has at least the length `distance`. An outlier is no evidence against
 * the model, and a turn on the spot shows no cloud. Returns leg 0 if there is no such leg, and −1 if there are no legs.
 */
function defaultLegOf({ squared, outliers, odometry }: CalibrationLegs, distance: number): number {
  const isFullLeg = (leg: number) => Math.hypot(odometry[6 * leg + 3] - odometry[6 * leg], odometry[6 * leg + 4] - odometry[6 * leg + 1]) >= distance;
  const worstLeg = squared.reduce((worst, error, leg) => (outliers[leg] === 0 && isFullLeg(leg) && error > (squared[worst] ?? -1) ? leg : worst), -1);
  return worstLeg < 0 && squared.length > 0 ? 0 : worstLeg;
}

/** Returns true if the true α's belong to the rule and the leg length of the present fit. */
export const isTruthComparable = ({ truth, fitted: { rule, model, distance, angle, duration } }: Pick<ViewModel, 'truth' | 'fitted'>) =>
  truth !== null && model === 'odometry' && rule === 'thrun' && distance === SIMULATED_LEGS.distance && angle === SIMULATED_LEGS.angle && duration === 0;
