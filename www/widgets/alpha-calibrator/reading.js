/** View model of the Alpha Calibrator. */

import { SHARES, SQUARED } from './quantiles.js';
import { SIMULATED } from './settings.js';

/**
 * @import { AlphaCalibrator as Machine, CalibrationLegs, CalibrationLog } from '../../types.d.ts'
 * @import { Noise } from './quantiles.js'
 */

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
    classes: classesOf(legs, config.noise),
    opening: openingOf(legs, config.duration > 0 ? SHORTEST : config.distance),
  };
}

/** Least length of a leg with a direction, m. */
const SHORTEST = 0.01;

/**
 * Returns the class of each leg: the index of the first of `SHARES` that it is below.
 *
 * @param {CalibrationLegs} legs
 * @param {Noise} noise of the model
 */
export function classesOf({ count, squaredError, residuals }, noise) {
  return Uint8Array.from({ length: count }, (_, leg) => {
    const told = residuals.subarray(3 * leg, 3 * leg + 3).reduce((sum, residual) => sum + Number(!Number.isNaN(residual)), 0);
    const place = SQUARED[noise][told].findIndex((quantile) => squaredError[leg] <= quantile);
    return place < 0 ? SHARES.length : place;
  });
}

/**
 * Returns the worst leg that is driven and not bad: a bad leg is no evidence against the model, and a turn on the spot shows no cloud.
 *
 * @param {CalibrationLegs} legs
 * @param {number} distance that a leg is to be long
 * @returns {number} −1 where there is none
 */
function openingOf({ squaredError, bad, odometry }, distance) {
  const isDriven = (/** @type {number} */ leg) => Math.hypot(odometry[6 * leg + 3] - odometry[6 * leg], odometry[6 * leg + 4] - odometry[6 * leg + 1]) >= distance;
  const worst = squaredError.reduce((found, error, leg) => (bad[leg] < 0.5 && isDriven(leg) && error > (squaredError[found] ?? -1) ? leg : found), -1);
  return worst < 0 && squaredError.length > 0 ? 0 : worst;
}

/**
 * Returns the leg that is shown; −1 if there is none.
 *
 * @param {Reading} reading
 * @param {number | null} chosen
 */
export const legOf = ({ opening, legs }, chosen) => (chosen !== null && chosen < legs.count ? chosen : opening);

/** Checks whether the true α's are of the rule and the legs of the present fit. @param {Reading} reading */
export const truthHolds = ({ truth, config: { rule, model, distance, angle, duration } }) =>
  truth !== null && model === 'odometry' && rule === 'table' && distance === SIMULATED.distance && angle === SIMULATED.angle && duration === 0;
