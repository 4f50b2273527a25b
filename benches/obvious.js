/**
 * The Banana Machine as a page author writes it from the chapter: an array of { x, y, theta }, Box–Muller, and one pass
 * after the other. Every event of the slider samples anew.
 *
 * @module
 */

import { Ellipse, exponentialOutline } from './contours.js';
import { uniform } from './random.js';

/**
 * @typedef {{ x: number, y: number, theta: number }} Pose
 * @typedef {import('./scene.js').Command} Command
 */

/**
 * One event of the slider.
 *
 * @param {{ command: Command, alphas: number[], samples: number, seed: number }} settings
 * @param {import('./scene.js').Picture} view
 * @param {Uint8Array} ramp
 */
export function refresh({ command, alphas, samples, seed }, view, ramp) {
  const random = uniform(seed);
  const poses = Array.from({ length: samples }, () => sampleVelocityModel(command, alphas, random));

  const cartesian = cartesianMoments(poses);
  const twists = poses.map(log);
  const exponential = moments(twists);
  const { skew, error } = crossTrackSkew(poses, cartesian.mean);

  const ellipse = ellipseOf(cartesian, 0, 1);
  const tilted = ellipseOf(exponential, 0, 2);
  const coverage = {
    ellipse: poses.filter(({ x, y }) => ellipse.contains(x, y)).length / samples,
    exponential: twists.filter(({ x, theta }) => tilted.contains(x, theta)).length / samples,
  };
  return {
    poses,
    stats: { n: samples, cartesian, exponential, crossTrackSkew: skew, crossTrackSkewError: error, coverage },
    contours: { ellipse: ellipse.outline(), exponential: exponentialOutline(exponential.mean, exponential.cov) },
    pixels: densityImage(poses, view, ramp),
  };
}

/**
 * Table 5.3, from the origin.
 *
 * @param {Command} command
 * @param {number[]} alphas
 * @param {() => number} random
 * @returns {Pose}
 */
function sampleVelocityModel({ v, omega, dt }, [a1, a2, a3, a4, a5, a6], random) {
  const vHat = v + normal(a1 * v * v + a2 * omega * omega, random);
  const omegaHat = omega + normal(a3 * v * v + a4 * omega * omega, random);
  const gammaHat = normal(a5 * v * v + a6 * omega * omega, random);
  const theta = wrap((omegaHat + gammaHat) * dt);
  if (Math.abs(omegaHat) < 1e-9) return { x: vHat * dt, y: 0, theta };
  const radius = vHat / omegaHat;
  return { x: radius * Math.sin(omegaHat * dt), y: radius * (1 - Math.cos(omegaHat * dt)), theta };
}

/**
 * Box and Muller.
 *
 * @param {number} variance
 * @param {() => number} random
 */
function normal(variance, random) {
  return Math.sqrt(variance) * Math.sqrt(-2 * Math.log(random())) * Math.cos(2 * Math.PI * random());
}

/** @param {number} angle */
function wrap(angle) {
  return angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));
}

/**
 * Along, lateral and heading, called as those of a pose.
 *
 * @param {Pose} pose
 * @returns {Pose}
 */
export function log({ x, y, theta }) {
  const half = theta / 2;
  const diagonal = Math.abs(theta) < 1e-9 ? 1 : half / Math.tan(half);
  return { x: diagonal * x + half * y, y: diagonal * y - half * x, theta };
}

/** @param {Pose[]} poses */
function cartesianMoments(poses) {
  const sin = poses.reduce((sum, { theta }) => sum + Math.sin(theta), 0);
  const cos = poses.reduce((sum, { theta }) => sum + Math.cos(theta), 0);
  const heading = Math.atan2(sin, cos);
  const { mean, cov } = moments(poses.map(({ x, y, theta }) => ({ x, y, theta: wrap(theta - heading) })));
  return { mean: [mean[0], mean[1], heading], cov };
}

/**
 * Mean and covariance over n − 1.
 *
 * @param {Pose[]} items
 */
function moments(items) {
  const x = items.reduce((sum, item) => sum + item.x, 0) / items.length;
  const y = items.reduce((sum, item) => sum + item.y, 0) / items.length;
  const theta = items.reduce((sum, item) => sum + item.theta, 0) / items.length;
  let [xx, xy, xt, yy, yt, tt] = [0, 0, 0, 0, 0, 0];
  for (const item of items) {
    const [dx, dy, dt] = [item.x - x, item.y - y, item.theta - theta];
    xx += dx * dx;
    xy += dx * dy;
    xt += dx * dt;
    yy += dy * dy;
    yt += dy * dt;
    tt += dt * dt;
  }
  const cov = [[xx, xy, xt], [xy, yy, yt], [xt, yt, tt]].map((row) => row.map((sum) => sum / (items.length - 1)));
  return { mean: [x, y, theta], cov };
}

/**
 * The skew across the mean heading, and its standard error by the delta method.
 *
 * @param {Pose[]} poses
 * @param {number[]} mean
 */
function crossTrackSkew(poses, [meanX, meanY, heading]) {
  const sin = Math.sin(heading);
  const cos = Math.cos(heading);
  const residuals = poses.map(({ x, y, theta }) => ({
    along: (x - meanX) * cos + (y - meanY) * sin,
    across: (y - meanY) * cos - (x - meanX) * sin,
    turn: wrap(theta - heading),
  }));
  const average = (/** @type {(residual: { along: number, across: number, turn: number }) => number} */ value) =>
    residuals.reduce((sum, residual) => sum + value(residual), 0) / residuals.length;
  const variance = average(({ across }) => across * across);
  const sd = Math.sqrt(variance);
  const skew = average(({ across }) => across * across * across) / (variance * sd);
  const mixed = average(({ along, across }) => along * across);
  const third = average(({ along, across }) => along * across * across);
  const resultant = average(({ turn }) => Math.cos(turn));
  const byHeading = 3 * ((skew * mixed) / variance - third / (variance * sd));
  const square = average(({ across, turn }) => {
    const z = across / sd;
    const influence = z * z * z - skew - 3 * z - 1.5 * skew * (z * z - 1) + (byHeading * Math.sin(turn)) / resultant;
    return influence * influence;
  });
  return { skew, error: Math.sqrt(square / poses.length) };
}

/**
 * @param {{ mean: number[], cov: number[][] }} moments
 * @param {number} i
 * @param {number} j
 */
function ellipseOf({ mean, cov }, i, j) {
  return new Ellipse(mean[i], mean[j], cov[i][i], cov[i][j], cov[j][j]);
}

/**
 * @param {Pose[]} poses
 * @param {import('./scene.js').Picture} view
 * @param {Uint8Array} ramp
 */
function densityImage(poses, { xMin, yMin, xMax, yMax, columns, rows }, ramp) {
  const counts = new Uint32Array(columns * rows);
  for (const { x, y } of poses) {
    const column = Math.floor(((x - xMin) / (xMax - xMin)) * columns);
    const row = Math.floor(((yMax - y) / (yMax - yMin)) * rows);
    if (column >= 0 && column < columns && row >= 0 && row < rows) counts[row * columns + column]++;
  }
  const most = counts.reduce((a, b) => Math.max(a, b), 0);
  const pixels = new Uint8ClampedArray(4 * columns * rows);
  counts.forEach((count, i) => {
    if (count === 0) return;
    const shade = Math.round(255 * Math.sqrt(count / most));
    for (let k = 0; k < 4; k++) pixels[4 * i + k] = ramp[4 * shade + k];
  });
  return pixels;
}
