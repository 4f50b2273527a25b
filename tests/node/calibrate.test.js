// `motion.calibrate`: defaults, results and refusals.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { load } from '../../dist/core.js';
import { ROOT } from '../../scripts/process.mjs';
import { MAX_VALUE } from '../../www/widgets/alpha-calibrator/log/rows.js';

const motion = await load();

/** @param {string} name of a file of the example */
function columns(name) {
  const [, ...rows] = readFileSync(join(ROOT, 'examples/calibration', `${name}.csv`), 'utf8').trim().split('\n');
  const numbers = rows.map((row) => row.split(',').map(Number));
  const [t, x, y, theta] = [0, 1, 2, 3].map((i) => Float64Array.from(numbers, (row) => row[i]));
  return { t, x, y, theta };
}

const [odometry, reference] = ['odometry', 'reference'].map(columns);

test('what is left out is as it opens, and arrays may be of any kind', () => {
  const plain = (/** @type {Record<string, Float64Array>} */ log) => Object.fromEntries(Object.entries(log).map(([key, column]) => [key, [...column]]));
  const all = {
    model: 'odometry', rule: 'table', legs: { distance: 0.25, angle: 0.2 }, noise: 'normal', robust: false, systematic: true, seed: 0,
  };
  const opening = motion.calibrate({ odometry, reference });
  assert.deepEqual(motion.calibrate(/** @type {any} */ ({ odometry: plain(odometry), reference: plain(reference), ...all })), opening);
  assert.deepEqual(motion.calibrate({ odometry, reference, model: 'omnidirectional' }), motion.calibrate({ odometry, reference, rule: 'omni' }));
});

test('what was injected into the example is in its intervals', () => {
  const { alphas, intervals, systematic, legs, doubts } = motion.calibrate({ odometry, reference });
  const within = (/** @type {number} */ real, /** @type {[number, number] | null} */ interval) => {
    assert.ok(interval && interval[0] < real && real < interval[1], `${real}: ${interval}`);
  };
  [0.03, 0.008, 0.002, 0.002].forEach((real, k) => within(real, intervals[k]));
  within(0.12, systematic.clockOffset.interval);
  within(0.03, systematic.mountYaw.interval);
  within(1.01, systematic.distanceScale.interval);
  within(1, systematic.turnScale.interval);
  assert.equal(alphas.length, 4);
  assert.equal(legs.count, legs.squaredError.length);
  assert.equal(legs.times.length, 2 * legs.count);
  assert.equal(doubts.verdict, 'fits');
});

test('commands are fitted by the velocity model', () => {
  const t = Float64Array.from({ length: 4000 }, (_, i) => 0.1 * i);
  const v = t.map((time) => 0.3 + 0.2 * Math.sin(0.3 * time));
  const omega = t.map((time) => 0.6 * Math.sin(0.17 * time));
  // Further by a hundredth, and a little aside at each step, by turns.
  let pose = { x: 0, y: 0, theta: 0 };
  const seen = Array.from(t, (_, i) => {
    const before = pose;
    const turn = 0.02 * Math.sin(i * i);
    pose = motion.se2.boxplus(pose, [0.101 * v[i], 0, 0.1 * (omega[i] + turn)]);
    return before;
  });
  const [x, y, theta] = /** @type {const} */ (['x', 'y', 'theta']).map((key) => seen.map((each) => each[key]));
  const { alphas, systematic } = motion.calibrate({ odometry: { t, v, omega }, reference: { t, x, y, theta }, model: 'velocity', legs: { duration: 0.5 } });
  assert.equal(alphas.length, 6);
  assert.ok(Math.abs(Number(systematic.distanceScale.value) - 1.01) < 0.001);
});

test('an α that the log does not determine is null', () => {
  const straight = (/** @type {number} */ shake) => {
    const t = Float64Array.from({ length: 1000 }, (_, i) => 0.1 * i);
    return { t, x: t.map((time, i) => 0.5 * time + shake * (i % 7)), y: t.map(() => 0), theta: t.map(() => 0) };
  };
  const { alphas, intervals, undetermined, systematic } = motion.calibrate({ odometry: straight(0), reference: straight(1e-3) });
  assert.deepEqual(undetermined, ['turns-too-little', null, null, 'turns-too-little']);
  assert.deepEqual([alphas[0], alphas[3], intervals[0], intervals[3]], [null, null, null, null]);
  assert.equal(systematic.turnScale.value, null);
  assert.ok(Number(alphas[2]) > 0);
});

test('by the length of legs: the α’s of all others beside those of the legs asked for', () => {
  const { alphas, intervals, bootstrap, legs, byLength, ...rest } = motion.calibrate({ odometry, reference, byLength: true });
  assert.deepEqual(byLength.map(({ factor }) => factor), [0.25, 0.5, 1, 2, 4]);
  assert.deepEqual(byLength[2], { factor: 1, legs: legs.count, alphas, intervals, bootstrap });
  // Longer legs are fewer, and tell less.
  for (const [i, at] of byLength.slice(2).entries()) {
    if (i > 0) assert.ok(at.legs < byLength[i + 1].legs && at.alphas.every((alpha, k) => alpha === null || at.intervals[k]));
  }
  assert.deepEqual({ ...motion.calibrate({ odometry, reference }), byLength: [] }, { alphas, intervals, bootstrap, legs, byLength: [], ...rest });
  assert.deepEqual(motion.calibrate({ odometry, reference, byLength: false }).byLength, []);
  // The log has 0.05 m from row to row at most: of legs a quarter as long most are shorter than four.
  const [shortest] = motion.calibrate({ odometry, reference, legs: { distance: 0.1, angle: 0.1 }, byLength: true }).byLength;
  assert.deepEqual([shortest.alphas, shortest.intervals], [[null, null, null, null], [null, null, null, null]]);
});

test('no leg spans a break of either log, and the others are as they were', () => {
  const whole = motion.calibrate({ odometry, reference });
  const places = [500, 501, 2000];
  for (const [broken, row] of /** @type {const} */ ([[{ odometry: { ...odometry, breaks: places }, reference }, odometry.t[500]], [{ odometry, reference: { ...reference, breaks: Uint16Array.from(places) } }, reference.t[500] - 0.12]])) {
    const { legs, gaps } = motion.calibrate(broken);
    assert.deepEqual(gaps, { odometry: 0, reference: 0, [broken.reference === reference ? 'odometry' : 'reference']: 3 });
    assert.ok(legs.count < whole.legs.count && legs.count >= whole.legs.count - 6, `${legs.count} of ${whole.legs.count}`);
    for (let i = 0; i < legs.count; i++) assert.ok(legs.times[2 * i + 1] < row + 0.01 || legs.times[2 * i] > row - 0.05);
  }
  const { odometry: own, reference: other } = motion.calibrate({ odometry: { ...odometry, breaks: [] }, reference: { ...reference, breaks: undefined } }).gaps;
  assert.deepEqual([own, other], [0, 0]);
});

test('refusals name what is wrong and what is allowed', () => {
  const few = { t: [0, 1], x: [0, 1], y: [0, 0], theta: [0, 0] };
  /** @type {[any, RegExp][]} */
  const refused = [
    [{}, /^odometry is undefined; allowed is an object with keys from t, x, y, theta, breaks or from t, v, omega, breaks$/],
    [{ odometry }, /^reference is undefined; allowed is an object with keys from t, x, y, theta, breaks, positionDeviation, headingDeviation$/],
    [{ odometry, reference: { ...reference, x: [1] } }, /^reference\.x has length 1; allowed is \d+, as of reference\.t$/],
    [{ odometry: { ...odometry, t: [] }, reference }, /^odometry\.t has length 0; allowed is 2 to 10000000$/],
    [{ odometry: { ...few, x: [0, 'a'] }, reference }, /^odometry\.x\[1\] is "a"; allowed is a number$/],
    [{ odometry: { ...few, theta: [0, NaN] }, reference }, /^odometry\.theta\[1\] is NaN; allowed /],
    // What readers of files take is taken.
    [{ odometry: { ...few, x: [0, MAX_VALUE] }, reference: few }, /^the log has \d legs/],
    [{ odometry: { ...few, x: [0, 2 * MAX_VALUE] }, reference }, /^odometry\.x\[1\] is 2000000000; allowed /],
    [{ odometry: { ...few, t: [1, 1] }, reference }, /^odometry: sample 1 is not later than the one before, at 1 s; allowed are times that rise$/],
    [{ odometry: { ...few, breaks: [0] }, reference }, /^odometry\.breaks\[0\] is 0; allowed is a whole number from 1 to 1$/],
    [{ odometry: { ...few, breaks: [2] }, reference }, /^odometry\.breaks\[0\] is 2; allowed is a whole number from 1 to 1$/],
    [{ odometry: { ...few, breaks: ['1'] }, reference }, /^odometry\.breaks\[0\] is "1"; allowed is a number$/],
    [{ odometry, reference: { ...reference, breaks: [7, 9.5] } }, /^reference\.breaks\[1\] is 9\.5; allowed is a whole number from 1 to \d+$/],
    [{ odometry, reference: { ...reference, breaks: [7, NaN] } }, /^reference\.breaks\[1\] is NaN; allowed /],
    [{ odometry, reference: { ...reference, breaks: Uint32Array.of(7, 9, 9) } }, /^reference\.breaks\[2\] is 9; allowed is more than 9, the one before it$/],
    [{ odometry, reference: { ...reference, breaks: 7 } }, /^reference\.breaks is 7; allowed is an array of numbers$/],
    [{ odometry: { t: [0, 1], v: [0, 0], omega: [0, 0], breaks: [-1] }, reference }, /^odometry\.breaks\[0\] is -1; allowed /],
    [{ odometry: few, reference: few }, /^the log has \d legs for which both trajectories are known; allowed are 8 at least/],
    [{ odometry, reference, model: 'banana' }, /^model is "banana"; allowed is "odometry" or /],
    [{ odometry, reference, model: 'velocity', rule: 'nav2' }, /^rule does not go with the model; allowed is /],
    [{ odometry, reference, model: 'odometry', rule: 'omni' }, /^rule does not go with the model; allowed is /],
    [{ odometry, reference, legs: { duration: 1, angle: 1 } }, /^legs\.duration is given beside .*; allowed is one of the two$/],
    [{ odometry, reference, legs: { distance: 0 } }, /^legs\.distance is 0; allowed /],
    [{ odometry, reference, robust: { outliers: 1 } }, /^robust\.outliers is 1; allowed /],
    [{ odometry, reference, robust: 'yes' }, /^robust is "yes"; allowed is true, false or an object/],
    [{ odometry, reference, systematic: { yaw: true } }, /^systematic\.yaw is an unknown key; allowed are clockOffset, /],
    [{ odometry, reference, byLength: 2 }, /^byLength is 2; allowed is true or false$/],
    [{ odometry, reference, seed: -1 }, /^seed is -1; allowed /],
  ];
  for (const [options, sentence] of refused) assert.throws(() => motion.calibrate(options), { message: sentence });
});
