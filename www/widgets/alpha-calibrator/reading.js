/** What the Alpha Calibrator shows of its machine. */

import { SHARES, SQUARED } from './quantiles.js';
import { SIMULATED } from './settings.js';

/**
 * @import { AlphaCalibrator as Machine, CalibrationLegs } from '../../types.d.ts'
 * @import { Noise } from './quantiles.js'
 */

/**
 * @typedef {object} Reading
 * @property {Machine['config']} config
 * @property {number} fits how often the figures had become others
 * @property {Machine['stats']} stats
 * @property {CalibrationLegs} legs
 * @property {Machine['truth']} truth
 * @property {Uint8Array} classes how unusual each leg is
 * @property {number} opening the leg that is looked at where none was chosen
 */

/**
 * Everything that the pictures and readouts need of the machine, asked once a change.
 *
 * @param {Machine} machine
 * @param {Reading | undefined} before what was read of the same machine: its copies serve as long as they are true
 * @returns {Reading}
 */
export function readingOf(machine, before) {
  const { config, fits } = machine;
  if (before?.fits === fits) return { ...before, config };
  const { stats, legs, truth } = machine;
  return { config, fits, stats, legs, truth, classes: classesOf(legs, config.noise), opening: openingOf(legs, config.duration > 0 ? SHORTEST : config.distance) };
}

/** A leg that is shorter tells no direction, m. */
const SHORTEST = 0.01;

/**
 * How unusual each leg is: the place among `SHARES` of the first that it is below.
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
 * The worst of the legs that are not bad and tell all: what is bad is no word against the model, and a turn on the spot has no
 * cloud to see.
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
 * The leg that is looked at: where none was chosen, the worst of those that are not bad; −1 where there is none.
 *
 * @param {Reading} reading
 * @param {number | null} chosen
 */
export const legOf = ({ opening, legs }, chosen) => (chosen !== null && chosen < legs.count ? chosen : opening);

/** Whether the true α's are those of the present fit: of its rule, and of its legs. @param {Reading} reading */
export const truthHolds = ({ truth, config: { rule, model, distance, angle, duration } }) =>
  truth !== null && model === 'odometry' && rule === 'table' && distance === SIMULATED.distance && angle === SIMULATED.angle && duration === 0;
