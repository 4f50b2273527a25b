/**
 * Before anything is timed: the baselines compute what the core computes.
 *
 * @module
 */

import * as obvious from './obvious.js';
import { drawNoise } from './random.js';
import { ALPHAS, RAMP, VIEW, command, figures, picture } from './scene.js';
import { TypedMachine } from './typed.js';

/**
 * @typedef {import('../www/types.d.ts').Motion} Motion
 * @typedef {import('../www/types.d.ts').BananaMachine} BananaMachine
 * @typedef {import('./contours.js').Figures} Figures
 */

/** What two sums in different orders may differ by, and 1e-9 of a metre or radian is. */
const EXACT = 1e-9;
/** Standard errors that two clouds may differ by: once in two million comparisons they do by chance. */
const SIGMAS = 5;

/**
 * With the core's own draws the typed baseline has the core's numbers, and its picture.
 *
 * @param {Motion} motion
 * @param {number} samples
 * @returns {string[]} what is wrong
 */
export function checkDraws(motion, samples) {
  const machine = new motion.BananaMachine({ alphas: ALPHAS, samples, seed: 11, command: command(0) });
  const typed = new TypedMachine(ALPHAS, noiseOf(machine));
  /** @type {string[]} */
  const wrong = [];
  for (const event of [0, 30]) {
    const { stats, contours } = figures(machine, event);
    const ours = typed.refresh(command(event), VIEW, RAMP);
    const theirs = flat(stats);
    for (const [name, value] of flat(ours.stats)) {
      compare(wrong, name, value, /** @type {number} */ (theirs.get(name)), EXACT);
    }
    for (const name of /** @type {const} */ (['ellipse', 'exponential'])) {
      compare(wrong, `${name}.length`, ours.contours[name].length, contours[name].length, 0);
      const off = ours.contours[name].map((value, i) => Math.abs(value - contours[name][i]));
      compare(wrong, `${name} outline`, Math.max(...off), 0, EXACT);
    }
    const pixels = picture(machine);
    compare(wrong, 'pixels', ours.pixels.filter((value, i) => value !== pixels[i]).length, 0, 0);
  }
  machine.free();
  return wrong;
}

/**
 * With draws of their own both baselines have the core's numbers as nearly as chance allows.
 *
 * @param {Motion} motion
 * @param {number} samples
 * @returns {string[]} what is wrong
 */
export function checkClouds(motion, samples) {
  const machine = new motion.BananaMachine({ alphas: ALPHAS, samples, seed: 11 });
  const { stats } = figures(machine, 0);
  machine.free();
  const plain = obvious.refresh({ command: command(0), alphas: ALPHAS, samples, seed: 3 }, VIEW, RAMP);
  const typed = new TypedMachine(ALPHAS, drawNoise(samples, 5)).refresh(command(0), VIEW, RAMP);
  const errors = standardErrors(plain);
  const theirs = flat(stats);
  /** @type {string[]} */
  const wrong = [];
  for (const [contender, ours] of /** @type {const} */ ([['obvious', plain], ['typed', typed]])) {
    for (const [name, value] of flat(ours.stats)) {
      const error = /** @type {number} */ (errors.get(name));
      compare(wrong, `${contender}: ${name}`, value, /** @type {number} */ (theirs.get(name)), SIGMAS * Math.SQRT2 * error);
    }
  }
  return wrong;
}

/**
 * The unit noise of a machine's samples: what they executed, less the command, over the deviations of the model.
 *
 * @param {BananaMachine} machine
 */
function noiseOf(machine) {
  const { v, omega } = machine.config.command;
  const [a1, a2, a3, a4, a5, a6] = machine.config.alphas;
  const noise = new Float64Array(3 * machine.shown);
  for (let i = 0; i < machine.shown; i++) {
    const { vHat, omegaHat, gammaHat } = machine.inspect(i);
    noise[3 * i] = (vHat - v) / Math.sqrt(a1 * v * v + a2 * omega * omega);
    noise[3 * i + 1] = (omegaHat - omega) / Math.sqrt(a3 * v * v + a4 * omega * omega);
    noise[3 * i + 2] = gammaHat / Math.sqrt(a5 * v * v + a6 * omega * omega);
  }
  return noise;
}

/**
 * @param {Figures} stats
 * @returns {Map<string, number>} every number by its name
 */
function flat({ n, cartesian, exponential, crossTrackSkew, crossTrackSkewError, coverage }) {
  const numbers = new Map([['n', n]]);
  for (const [name, { mean, cov }] of Object.entries({ cartesian, exponential })) {
    mean.forEach((value, i) => numbers.set(`${name}.mean[${i}]`, value));
    cov.forEach((row, i) => row.forEach((value, j) => numbers.set(`${name}.cov[${i}][${j}]`, value)));
  }
  numbers.set('crossTrackSkew', crossTrackSkew);
  numbers.set('crossTrackSkewError', crossTrackSkewError);
  numbers.set('coverage.ellipse', coverage.ellipse);
  numbers.set('coverage.exponential', coverage.exponential);
  return numbers;
}

/**
 * The standard errors of a cloud's figures, from the cloud itself: of a mean σ/√n, of a covariance the deviation of the
 * products over √n, of a share √(p(1 − p)/n). That of a skew is among the figures; its own is half that of a mean square,
 * of influences that for a Gaussian are Hermite polynomials of degree 3, with a kurtosis of 93.
 *
 * @param {ReturnType<typeof obvious.refresh>} refreshed
 * @returns {Map<string, number>} by the names of `flat`
 */
function standardErrors({ poses, stats }) {
  const { n, coverage, crossTrackSkewError } = stats;
  const errors = new Map([['n', 0]]);
  for (const [name, moments] of Object.entries({ cartesian: stats.cartesian, exponential: stats.exponential })) {
    const of = name === 'cartesian' ? poses : poses.map(obvious.log);
    const residuals = of.map(({ x, y, theta }) => [x, y, theta].map((value, i) => value - moments.mean[i]));
    for (let i = 0; i < 3; i++) {
      errors.set(`${name}.mean[${i}]`, Math.sqrt(moments.cov[i][i] / n));
      for (let j = 0; j < 3; j++) {
        const square = residuals.reduce((sum, r) => sum + (r[i] * r[j] - moments.cov[i][j]) ** 2, 0) / n;
        errors.set(`${name}.cov[${i}][${j}]`, Math.sqrt(square / n));
      }
    }
  }
  errors.set('crossTrackSkew', crossTrackSkewError);
  errors.set('crossTrackSkewError', 0.5 * crossTrackSkewError * Math.sqrt((93 - 1) / n));
  for (const [name, share] of Object.entries(coverage)) {
    errors.set(`coverage.${name}`, Math.sqrt((share * (1 - share)) / n));
  }
  return errors;
}

/**
 * @param {string[]} wrong is added to
 * @param {string} name
 * @param {number} value
 * @param {number} expected
 * @param {number} tolerance
 */
function compare(wrong, name, value, expected, tolerance) {
  // Written so that NaN is wrong.
  if (!(Math.abs(value - expected) <= tolerance)) wrong.push(`${name}: ${value} is not ${expected} ± ${tolerance}`);
}
