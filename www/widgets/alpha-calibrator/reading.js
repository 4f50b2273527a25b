/** View model of the Alpha Calibrator. */

import { SIMULATED } from './settings.js';

/** @import { AlphaCalibrator as Machine, CalibrationLegs, CalibrationLog } from '../../types.d.ts' */

/**
 * @typedef {object} Reading
 * @property {Machine} machine
 * @property {CalibrationLog | null} log null for the simulated one
 * @property {Machine['config']} config
 * @property {number} fits number of the fit
 * @property {Machine['stats']} stats
 * @property {CalibrationLegs} legs
 * @property {Machine['truth']} truth
 * @property {Uint8Array} classes of the legs, the most usual first
 * @property {number[]} worst legs with the largest residuals, the largest first
 * @property {number} opening leg that is shown if none was chosen
 */

/**
 * Reads the machine for pictures and readouts, once a change.
 *
 * @param {Machine} machine
 * @param {CalibrationLog | null} log
 * @param {Reading | undefined} before latest reading, whose copies are used again if they are of the same fit
 * @returns {Reading}
 */
export function readingOf(machine, log, before) {
  const { config, fits } = machine;
  if (before?.machine === machine && before.fits === fits) return { ...before, log, config };
  const { stats, legs, truth } = machine;
  return {
    machine,
    log,
    config,
    fits,
    stats,
    legs,
    truth,
    classes: classesOf(legs),
    worst: worstOf(legs),
    opening: openingOf(legs, config.duration > 0 ? SHORTEST : config.distance),
  };
}

/** Least length of a leg with a direction, m. */
const SHORTEST = 0.01;

/** Number of the largest residuals that are listed. */
const LISTED = 10;

/** Quantiles 0.5, 0.95 and 0.999 of χ² with 0 to 3 degrees of freedom. */
const CHI2 = [[0, 0, 0], [0.455, 3.841, 10.828], [1.386, 5.991, 13.816], [2.366, 7.815, 16.266]];

/**
 * Returns the class of each leg: the index of the first quantile that its squared Mahalanobis distance does not exceed.
 *
 * @param {Pick<CalibrationLegs, 'count' | 'squared' | 'residuals'>} legs
 */
export function classesOf({ count, squared, residuals }) {
  return Uint8Array.from({ length: count }, (_, leg) => {
    const quantiles = CHI2[observedOf(residuals, leg)];
    const place = quantiles.findIndex((quantile) => squared[leg] <= quantile);
    return place < 0 ? quantiles.length : place;
  });
}

/** Returns the number of noise components that a leg shows. @param {Float64Array} residuals @param {number} leg */
export const observedOf = (residuals, leg) => residuals.subarray(3 * leg, 3 * leg + 3).reduce((count, residual) => count + Number(!Number.isNaN(residual)), 0);

/** Returns the legs with the largest residuals, the largest first. @param {Pick<CalibrationLegs, 'squared'>} legs */
function worstOf({ squared }) {
  const least = squared.toSorted()[Math.max(0, squared.length - LISTED)];
  const candidates = [...squared.keys()].filter((leg) => squared[leg] >= least);
  return candidates.sort((one, other) => squared[other] - squared[one]).slice(0, LISTED);
}

/**
 * Returns the driven leg with the largest residual that is no outlier. An outlier is no evidence against the model, and a turn on the
 * spot shows no cloud.
 *
 * @param {CalibrationLegs} legs
 * @param {number} distance least length of the leg
 * @returns {number} −1 where there is none
 */
function openingOf({ squared, outliers, odometry }, distance) {
  const isDriven = (/** @type {number} */ leg) => Math.hypot(odometry[6 * leg + 3] - odometry[6 * leg], odometry[6 * leg + 4] - odometry[6 * leg + 1]) >= distance;
  const worst = squared.reduce((found, error, leg) => (outliers[leg] === 0 && isDriven(leg) && error > (squared[found] ?? -1) ? leg : found), -1);
  return worst < 0 && squared.length > 0 ? 0 : worst;
}

/**
 * Returns the leg that is shown; −1 if there is none.
 *
 * @param {Reading} reading
 * @param {number | null} chosen
 */
export const legOf = ({ opening, legs }, chosen) => (chosen !== null && chosen < legs.count ? chosen : opening);

/** Checks whether the true α's are of the rule and the legs of the present fit. @param {Pick<Reading, 'truth' | 'config'>} reading */
export const truthHolds = ({ truth, config: { rule, model, distance, angle, duration } }) =>
  truth !== null && model === 'odometry' && rule === 'thrun' && distance === SIMULATED.distance && angle === SIMULATED.angle && duration === 0;
