// What core.js has for homework, each against another route: formulas by hand, matrices, sums over grids, samples.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { generator } from '../random.js';
import { freshModule } from './support.js';

/** @type {any} */
const motion = await (await freshModule()).load();
const { invertArc, decompose, propagate, se2, VelocityModel, OdometryModel } = motion;

const ORIGIN = { x: 0, y: 0, theta: 0 };
/** The chapter's worked example, with noise in the last turn too, so that poses have a density. */
const COMMAND = { v: 1, omega: 0.5, dt: 1 };
const ALPHAS = [0.02, 0.02, 0.02, 0.02, 0.01, 0.01];

/** @typedef {{ x: number, y: number, theta: number }} Pose */

/** @param {number} actual @param {number} expected @param {number} tolerance @param {string} [about] */
function close(actual, expected, tolerance, about = '') {
  assert.ok(Math.abs(actual - expected) <= tolerance, `${about} ${actual}, expected ${expected} ± ${tolerance}`);
}

/** @param {number[][]} actual @param {number[][]} expected @param {number} tolerance @param {string} [about] */
const closeMatrix = (actual, expected, tolerance, about) =>
  expected.forEach((row, i) => row.forEach((number, j) => close(actual[i][j], number, tolerance, `${about ?? ''} [${i}][${j}]`)));

const times = (/** @type {number[][]} */ a, /** @type {number[][]} */ b) => a.map((row) => b[0].map((_, j) => row.reduce((sum, each, k) => sum + each * b[k][j], 0)));
const transposed = (/** @type {number[][]} */ a) => a[0].map((_, j) => a.map((row) => row[j]));
const plus = (/** @type {number[][]} */ a, /** @type {number[][]} */ b) => a.map((row, i) => row.map((each, j) => each + b[i][j]));
const diagonal = (/** @type {number[]} */ ...numbers) => numbers.map((number, i) => numbers.map((_, j) => (i === j ? number : 0)));

/** A pose as a matrix of homogeneous coordinates. @param {Pose} pose */
const matrixOf = ({ x, y, theta }) => [[Math.cos(theta), -Math.sin(theta), x], [Math.sin(theta), Math.cos(theta), y], [0, 0, 1]];

/** exp of a twist's matrix by its series, of a small part of it, multiplied by itself. @param {number[]} twist */
function exponential([x, y, turn]) {
  const [small, halvings] = [1 / 1024, 10];
  const part = [[0, -turn * small, x * small], [turn * small, 0, y * small], [0, 0, 0]];
  let [sum, term] = [diagonal(1, 1, 1), diagonal(1, 1, 1)];
  for (let k = 1; k < 12; k++) {
    term = times(term, part).map((row) => row.map((each) => each / k));
    sum = plus(sum, term);
  }
  for (let i = 0; i < halvings; i++) sum = times(sum, sum);
  return sum;
}

const random = generator(5);
const uniform = (/** @type {number} */ most) => most * (2 * random() - 1);
const somePose = () => ({ x: uniform(5), y: uniform(5), theta: uniform(3.1) });
const someTwist = () => [uniform(3), uniform(3), uniform(3)];

test('SE(2) is what matrices of homogeneous coordinates are', () => {
  for (let i = 0; i < 200; i++) {
    const [a, b, twist] = [somePose(), somePose(), someTwist()];
    closeMatrix(matrixOf(se2.exp(twist)), exponential(twist), 1e-12, 'exp');
    closeMatrix(matrixOf(se2.compose(a, b)), times(matrixOf(a), matrixOf(b)), 1e-13, 'compose');
    closeMatrix(times(matrixOf(se2.inverse(a)), matrixOf(a)), diagonal(1, 1, 1), 1e-13, 'inverse');
    closeMatrix(exponential(se2.log(a)), matrixOf(a), 1e-12, 'log');
    closeMatrix(matrixOf(se2.boxplus(a, twist)), times(matrixOf(a), exponential(twist)), 1e-12, 'boxplus');
    closeMatrix(times(matrixOf(b), exponential(se2.boxminus(a, b))), matrixOf(a), 1e-11, 'boxminus');
    // T · exp(ξ) · T⁻¹ = exp(Ad ξ).
    const carried = times(se2.adjoint(a), twist.map((each) => [each])).flat();
    closeMatrix(times(times(matrixOf(a), exponential(twist)), matrixOf(se2.inverse(a))), exponential(carried), 1e-10, 'adjoint');
    // J_r by differences: their own error is the square of the step, and rounding over it.
    const step = 1e-5;
    const jacobian = transposed([0, 1, 2].map((k) => {
      const [more, less] = [step, -step].map((h) => se2.boxminus(se2.exp(twist.with(k, twist[k] + h)), se2.exp(twist)));
      return more.map((/** @type {number} */ each, /** @type {number} */ j) => (each - less[j]) / (2 * step));
    }));
    closeMatrix(se2.rightJacobian(twist), jacobian, 1e-8, 'rightJacobian');
  }
});

test('an arc is inverted with its sign, its centre at the same distance from both places', () => {
  for (const [v, omega] of [[1, 0.5], [1, -0.5], [-1, 0.5], [-1, -0.5]]) {
    const start = { x: 3, y: -2, theta: 0.7 };
    const radius = v / omega;
    const center = { x: start.x - radius * Math.sin(start.theta), y: start.y + radius * Math.cos(start.theta) };
    const heading = start.theta + omega * 2;
    const end = { x: center.x + radius * Math.sin(heading), y: center.y - radius * Math.cos(heading), theta: heading + 0.1 };
    const arc = invertArc(start, end, 2);
    for (const [key, number] of Object.entries({ vHat: v, omegaHat: omega, gammaHat: 0.05, radius, turn: 2 * omega })) close(arc[key], number, 1e-12, `${key} of ${v}, ${omega}:`);
    close(arc.center.x, center.x, 1e-12);
    close(arc.center.y, center.y, 1e-12);
  }
  const straight = invertArc(ORIGIN, { x: -2, y: 0, theta: 0.5 }, 0.5);
  assert.deepEqual(straight, { vHat: -4, omegaHat: 0, gammaHat: 1, center: null, radius: Infinity, turn: 0 });
});

test('two poses are decomposed by hand', () => {
  const { rot1, trans, rot2 } = decompose({ x: 1, y: 1, theta: 0.2 }, { x: 4, y: 5, theta: 1.5 });
  close(trans, 5, 1e-15);
  close(rot1, Math.atan2(4, 3) - 0.2, 1e-15);
  close(rot1 + rot2, 1.3, 1e-15);
  assert.deepEqual(decompose(ORIGIN, { x: 0, y: 0, theta: 1 }), { rot1: 0, trans: 0, rot2: 1 });
});

const normal = (/** @type {number} */ residual, /** @type {number} */ variance) => Math.exp((-0.5 * residual * residual) / variance) / Math.sqrt(2 * Math.PI * variance);
const triangle = (/** @type {number} */ residual, /** @type {number} */ variance) => Math.max(0, Math.sqrt(6 * variance) - Math.abs(residual)) / (6 * variance);

test('the tables score a pose by the noise that explains it', () => {
  const next = { x: 0.9, y: 0.3, theta: 0.6 };
  for (const [noise, density] of /** @type {const} */ ([['normal', normal], ['triangular', triangle]])) {
    const { vHat, omegaHat, gammaHat } = invertArc(ORIGIN, next, 1);
    const [a1, a2, a3, a4, a5, a6] = ALPHAS;
    const [v2, w2] = [1, 0.25];
    const byHand = density(1 - vHat, a1 * v2 + a2 * w2) * density(0.5 - omegaHat, a3 * v2 + a4 * w2) * density(gammaHat, a5 * v2 + a6 * w2);
    close(new VelocityModel({ alphas: ALPHAS, noise }).prob(next, COMMAND, ORIGIN), byHand, 1e-13 * byHand);
    const [control, hat] = [{ rot1: 0.2, trans: 1, rot2: 0.3 }, decompose(ORIGIN, next)];
    const [b1, b2, b3, b4] = [0.1, 0.05, 0.02, 0.03];
    const [r1, t, r2] = [hat.rot1 ** 2, hat.trans ** 2, hat.rot2 ** 2];
    const odometry = density(control.rot1 - hat.rot1, b1 * r1 + b2 * t) * density(control.trans - hat.trans, b3 * t + b4 * (r1 + r2)) * density(control.rot2 - hat.rot2, b1 * r2 + b2 * t);
    close(new OdometryModel({ alphas: [b1, b2, b3, b4], noise }).prob(next, control, ORIGIN), odometry, 1e-13 * odometry);
  }
});

test('a density of poses is that of the samples: as many in a box as it says, and none has one where a variance is 0', () => {
  const reading = { rot1: 0.2, trans: 1, rot2: 0.3 };
  const models = [
    [new VelocityModel({ alphas: ALPHAS }), COMMAND],
    [new OdometryModel({ alphas: [0.1, 0.05, 0.02, 0.03] }), reading],
    [new OdometryModel({ alphas: [0.1, 0.05, 0.02, 0.03], reverseAware: true }), { rot1: 3, trans: 1, rot2: -3 }],
  ];
  const count = 400_000;
  for (const [model, control] of models) {
    const poses = model.sample(control, ORIGIN, count, 3);
    const mean = [0, 1, 2].map((k) => poses[k]);
    // Boxes around three of the poses: the mean of the density over 12³ of their cells, for its curvature is 1/12² of the box.
    for (const at of [0, 1, 2].map((i) => poses.subarray(3 * i, 3 * i + 3))) {
      const [half, cells] = [[0.1, 0.1, 0.15], 12];
      let mass = 0;
      const place = (/** @type {number} */ k, /** @type {number} */ i) => at[k] + half[k] * ((2 * i + 1) / cells - 1);
      for (let i = 0; i < cells; i++) for (let j = 0; j < cells; j++) for (let k = 0; k < cells; k++) {
        mass += model.poseDensity({ x: place(0, i), y: place(1, j), theta: place(2, k) }, control, ORIGIN);
      }
      const share = mass * half.reduce((product, each) => (product * 2 * each) / cells, 1);
      let inside = 0;
      for (let i = 0; i < count; i++) {
        const off = [0, 1, 2].map((k) => poses[3 * i + k] - at[k]);
        off[2] -= 2 * Math.PI * Math.round(off[2] / (2 * Math.PI));
        inside += off.every((each, k) => Math.abs(each) <= half[k]) ? 1 : 0;
      }
      // Four and a half errors of a share of so many, and half a hundredth of it for the sum.
      close(inside / count, share, 4.5 * Math.sqrt((share * (1 - share)) / count) + 0.005 * share, `around ${mean}:`);
      assert.ok(share > 0.005, `${share}`);
    }
  }
  assert.equal(new VelocityModel({ alphas: [0.02, 0.02, 0.02, 0.02, 0, 0] }).poseDensity(ORIGIN, COMMAND, ORIGIN), null);
  assert.deepEqual(models[0][0].sample(COMMAND, ORIGIN, 3, 9), models[0][0].sample(COMMAND, ORIGIN, 3, 9));
});

test('a covariance is propagated by the chapter’s recursion, by the right Jacobian, and as rollouts spread', () => {
  const command = { v: 1, omega: 0.5, dt: 0.2 };
  const alphas = [0.02, 0.02, 0.02, 0.02, 0.005, 0.005];
  const variance = (/** @type {number} */ i) => 0.04 * (alphas[i] + 0.25 * alphas[i + 1]);
  const [inside, after] = [diagonal(variance(0), 0, variance(2)), diagonal(0, 0, variance(4))];
  const twist = [0.2, 0, 0.1];
  const carrier = se2.adjoint(se2.inverse(se2.exp(twist)));
  const jacobian = se2.rightJacobian(twist);
  const added = { chapter: plus(inside, after), 'first-order': plus(times(times(jacobian, inside), transposed(jacobian)), after) };
  for (const [compounding, noise] of Object.entries(added)) {
    let sigma = diagonal(0.01, 0.02, 0.03);
    for (let step = 0; step < 20; step++) sigma = plus(times(times(carrier, sigma), transposed(carrier)), noise);
    closeMatrix(propagate({ sigma: diagonal(0.01, 0.02, 0.03), command, alphas, compounding, steps: 20 }), sigma, 1e-14, compounding);
  }
  const [rollouts, steps] = [20_000, 20];
  const model = new VelocityModel({ alphas });
  const ends = Array.from({ length: rollouts }, (_, i) => {
    let pose = ORIGIN;
    for (let step = 0; step < steps; step++) {
      const [x, y, theta] = model.sample(command, pose, 1, i * steps + step);
      pose = { x, y, theta };
    }
    return pose;
  });
  const nominal = se2.exp(twist.map((each) => each * steps));
  const residuals = ends.map((end) => se2.boxminus(end, nominal));
  const measured = [0, 1, 2].map((k) => residuals.reduce((sum, each) => sum + each[k] ** 2, 0) / rollouts);
  const ratios = (/** @type {string} */ compounding) => {
    const sigma = propagate({ command, alphas, compounding, steps });
    return measured.map((each, k) => sigma[k][k] / each);
  };
  // Four and a half errors of a variance of so many, √(2/n), and three of a thousandth by which the fourth order itself is off.
  const error = 4.5 * Math.sqrt(2 / rollouts) + 0.003;
  for (const ratio of ratios('fourth-order')) close(ratio, 1, error);
  // The chapter's 6 % along the track, and 3 % across.
  const [along, across] = ratios('chapter');
  close(along, 0.939, error);
  close(across, 0.97, error);
  assert.deepEqual(propagate({ command, alphas }), propagate({ command, alphas, compounding: 'chapter', steps: 1, sigma: diagonal(0, 0, 0) }));
});

test('what is refused is named, with its value and what is allowed', () => {
  const model = new VelocityModel({ alphas: ALPHAS });
  /** @type {[() => unknown, string][]} */
  const refusals = [
    [() => new VelocityModel({ alphas: [1, 2] }), 'alphas has length 2; allowed is an array of 6 numbers'],
    [() => new OdometryModel({ alphas: [1, 2, 3, -4] }), 'alphas[3] is -4; allowed is a number from 0 to 1000000'],
    [() => new VelocityModel({ alphas: ALPHAS, noise: 'loud' }), 'noise is "loud"; allowed is "normal" or "triangular"'],
    [() => model.prob({ x: 1, y: 2 }, COMMAND, ORIGIN), 'next.theta is undefined; allowed is a number'],
    [() => model.sample(COMMAND, ORIGIN, -1, 0), 'count is -1; allowed is a whole number from 0 to 10000000'],
    [() => invertArc(ORIGIN, ORIGIN, 0), 'dt is 0; allowed is a number from 0.000001 to 1000000'],
    [() => propagate({ command: COMMAND, alphas: ALPHAS, compounding: 'third' }), 'compounding is "third"; allowed is "chapter" or "first-order" or "fourth-order"'],
    [() => propagate({ command: COMMAND, alphas: ALPHAS, sigma: [[1, 2, 0], [2, 1, 0], [0, 0, 1]] }), 'sigma is no covariance: some direction has a negative variance; allowed are three rows of three numbers, symmetric, of no negative variance'],
    [() => propagate({ command: COMMAND, alphas: ALPHAS, sigma: [[1, 2, 0], [0, 1, 0], [0, 0, 1]] }), 'sigma is no covariance: it differs from its transpose; allowed are three rows of three numbers, symmetric, of no negative variance'],
    [
      () => propagate({ command: { v: 1, omega: 3, dt: 0.7 }, alphas: Array(6).fill(1), compounding: 'fourth-order', steps: 7 }),
      'steps is 7; allowed are at most 2 here: the next leaves no covariance, for the noise is too large',
    ],
    [() => se2.exp([1, 2, NaN]), 'twist[2] is NaN; allowed is a number from -1000000 to 1000000'],
  ];
  for (const [act, message] of refusals) assert.throws(act, { message });
});
