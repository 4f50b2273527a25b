// What the Alpha Calibrator says that needs no page: classes and quantiles by the model's noise, curves, numbers, sentences.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { axisOf, axisOfSquares, between } from '../../www/widgets/alpha-calibrator/curve.js';
import { de } from '../../www/widgets/alpha-calibrator/de.js';
import { en } from '../../www/widgets/alpha-calibrator/en.js';
import { between as ends, fixed, nav2Lines, short } from '../../www/widgets/alpha-calibrator/lines.js';
import { QUANTILES, SHARES, SQUARED } from '../../www/widgets/alpha-calibrator/quantiles.js';
import { classesOf, truthHolds } from '../../www/widgets/alpha-calibrator/reading.js';
import { SIMULATED } from '../../www/widgets/alpha-calibrator/settings.js';
import { significantly } from '../../www/widgets/alpha-calibrator/words.js';
import { settings } from '../../www/settings.js';

/** Where a triangle of variance 1 ends. */
const END = Math.sqrt(6);

const NOISES = /** @type {const} */ (['normal', 'triangular']);

/**
 * The probability that the squares of so many triangular variables are together below a value: by the distribution of one less,
 * over the density of one of them.
 *
 * @param {number} count
 * @param {number} value
 * @returns {number}
 */
function below(count, value) {
  if (value <= 0) return 0;
  const most = Math.min(END, Math.sqrt(value));
  if (count === 1) return 1 - (1 - most / END) ** 2;
  const parts = 1000;
  const step = Math.PI / 2 / parts;
  let sum = 0;
  for (let i = 0; i < parts; i++) {
    // With x = most·sin u, what is left of the value has no root at the end.
    const [x, slope] = [most * Math.sin((i + 0.5) * step), most * Math.cos((i + 0.5) * step)];
    sum += (2 / END) * (1 - x / END) * below(count - 1, value - x * x) * slope * step;
  }
  return sum;
}

test('the classes of legs have their shares under triangular noise, by convolution', () => {
  for (const count of [1, 2, 3]) {
    for (const [place, share] of SHARES.entries()) {
      const quantile = SQUARED.triangular[count][place];
      const [low, high] = [quantile - 0.001, quantile + 0.001].map((value) => below(count, value));
      assert.ok(low < share && share < high, `${count} at ${share}: ${quantile} has ${low} to ${high}`);
    }
  }
});

for (const noise of NOISES) {
  test(`the classes of legs have their shares under ${noise} noise, by chance`, () => {
    const count = 100_000;
    const { draw } = drawing();
    for (const told of [1, 2, 3]) {
      const residuals = Float64Array.from({ length: 3 * count }, (_, i) => (i % 3 < told ? draw(noise) : NaN));
      const squaredError = Float64Array.from({ length: count }, (_, leg) => residuals.subarray(3 * leg, 3 * leg + told).reduce((sum, each) => sum + each * each, 0));
      const classes = classesOf(/** @type {any} */ ({ count, squaredError, residuals }), noise);
      for (const [place, share] of SHARES.entries()) {
        const counted = classes.reduce((sum, each) => sum + Number(each <= place), 0) / count;
        const deviation = Math.sqrt((share * (1 - share)) / count);
        assert.ok(Math.abs(counted - share) < 4 * deviation, `${told} at ${share}: ${counted}`);
      }
    }
  });

  test(`quantiles of ${noise} noise have its shares below them`, () => {
    const density = (/** @type {number} */ x) => (noise === 'normal' ? Math.exp((-x * x) / 2) / Math.sqrt(2 * Math.PI) : (1 - Math.abs(x) / END) / END);
    for (const [i, quantile] of QUANTILES[noise].entries()) {
      const step = quantile / 1000;
      let share = 0.5;
      for (let k = 0; k < 1000; k++) share += density((k + 0.5) * step) * step;
      assert.ok(Math.abs(share - (i + 1) / 100) < 1e-4, `${(i + 1) / 100}: ${quantile}`);
    }
  });
}

/** Draws of variance 1, the same each time. */
function drawing() {
  let state = 1;
  const uniform = () => {
    state = (state + 0x6d2b79f5) | 0;
    let mixed = Math.imul(state ^ (state >>> 15), state | 1);
    mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
    return (((mixed ^ (mixed >>> 14)) >>> 0) + 0.5) / 2 ** 32;
  };
  const draw = (/** @type {(typeof NOISES)[number]} */ noise) =>
    noise === 'triangular' ? END * (uniform() - uniform()) : Math.sqrt(-2 * Math.log(uniform())) * Math.cos(2 * Math.PI * uniform());
  return { draw };
}

test('a curve is told at its points whatever stands beside them, and neither beyond its ends nor beside −∞', () => {
  const [at, values] = [[0.1, 0.5, 1, 2], [-Infinity, -Infinity, 1.45, 1.25]];
  assert.deepEqual([1, 2, 0.1].map((where) => between(at, values, where)), [1.45, 1.25, -Infinity]);
  assert.ok(Math.abs(between(at, values, Math.SQRT2) - 1.35) < 1e-12);
  for (const where of [0.02, 0.3, 0.7, 3]) assert.ok(Number.isNaN(between(at, values, where)), `${where}`);
  assert.ok(Number.isNaN(between([], [], 1)));
});

test('an axis has two ends whatever is of a curve', () => {
  for (const [values, from, to] of /** @type {[number[], number, number][]} */ ([
    [[-Infinity, -20, 1, 2], -4, 2.5],
    [[-Infinity, 1, 2], 1, 2.5],
    // A flat one is in the middle.
    [[7, 7, 7], 6.5, 7.5],
    [[-Infinity, -Infinity], -0.5, 0.5],
    [[NaN], -0.5, 0.5],
    // A half more is no more there.
    [[-1.1e38, -1.2e38], -0.5, 0.5],
  ])) assert.deepEqual(axisOf(values, 6), { from, to });
});

test('bins and their line have room whatever a bar is as long as', () => {
  // The bars of all but one are short: its own leaves the picture, of which the line has two thirds.
  assert.deepEqual(axisOfSquares([1, 2, 3], [0.5, 1, 90], 2.5), { from: -1.5, to: 4.5 });
  assert.deepEqual(axisOfSquares([1, 2, 3], [0.5, 1, 1], 2.5), { from: 0, to: 4 });
  assert.deepEqual(axisOfSquares([1, 2], [0.5, 0.5], 7), { from: 0, to: 7 });
  assert.deepEqual(axisOfSquares([], [], 0), { from: 0, to: 0 });
  // What a reference is stated to err by is taken off, and may be more than there is.
  assert.deepEqual(axisOfSquares([-2, -3], [0.5, 9], 0), { from: -4.5, to: 1.5 });
});

test('an α is printed in digits that are its own, however small it is', () => {
  for (const [alpha, text] of /** @type {[number, string][]} */ ([
    [0, '0'],
    [0.123456, '0.123'],
    [0.0001, '0.000100'],
    [0.0000234, '2.3·10⁻⁵'],
    [1e-10, '1.0·10⁻¹⁰'],
    [Infinity, '∞'],
  ])) assert.equal(significantly(alpha), text);
});

test('numbers of files: as many digits as the interval has a meaning in, with an exponent where they are tiny', () => {
  for (const [value, interval, text, range] of /** @type {[number, [number, number], string, string][]} */ ([
    [0.0123, [0.01, 0.015], '0.0123', '0.0100 to 0.0150'],
    [2.34e-13, [1.8e-13, 2.9e-13], '2.3e-13', '1.8e-13 to 2.9e-13'],
    [3e-8, [0, 1.6e-7], '3.0e-8', '0 to 1.6e-7'],
    [1e-7, [0, 0.0016], '0.0000', '0.0000 to 0.0016'],
    [0.5, [0.5 - 1e-9, 0.5 + 1e-9], '0.5000000000', '0.4999999990 to 0.5000000010'],
  ])) {
    assert.deepEqual([fixed(value, interval), ends(interval)], [text, range]);
  }
  assert.deepEqual([short(1e-7), short(-2.5e-9), short(0.25)], ['1.0e-7', '-2.5e-9', '0.25']);
  assert.deepEqual([ends([0, Infinity]), ends([-Infinity, Infinity]), ends(null)], ['', '', '']);
});

test('lines for Nav2: an α without an interval has no empty comment', () => {
  const fitted = { count: 9, model: 'odometry', rule: 'nav2', legs: { duration: 1 }, log: 'a.csv', date: '2026-01-02', verdict: 'fits', systematic: {} };
  const lines = nav2Lines({ ...fitted, alphas: [1e-8, 0.1, null, 0.2], intervals: [null, [0.05, 0.16], null, null], bootstrap: [null, [0.04, 0.17], null, null] }, en.nav2);
  assert.deepEqual(lines.filter((line) => /alpha[1-4]/.test(line)).map((line) => line.trim()), [
    'alpha1: 1.0e-8', 'alpha2: 0.10  # 0.04 to 0.17', `# alpha3: ${en.nav2.undetermined}`, 'alpha4: 0.2',
  ]);
  // Of a log that tells nothing there is nothing to paste.
  for (const verdict of ['few-legs', 'unrelated']) {
    const none = nav2Lines({ ...fitted, verdict, alphas: [0.1, 0.1, 0.1, 0.1], intervals: [null, null, null, null], bootstrap: [null, null, null, null] }, en.nav2);
    assert.deepEqual(none.filter((line) => /^ *alpha/.test(line)), []);
    assert.deepEqual(none.filter((line) => /alpha1/.test(line)), [`    # alpha1: ${en.nav2.useless}`]);
  }
  // Nor is 0 a result, however it is written; inflated, the most of it is too.
  // Of a robot whose error is larger than its motion nobody would want the lines; that the reader inflates them is the reader's.
  const large = nav2Lines({ ...fitted, inflation: 2, alphas: [103, 0.8, 1.2, 0.1], intervals: [[50, 200], [0.5, 1.5], null, [0.05, 0.2]], bootstrap: [[40, 300], [0.5, 1.5], null, [0.05, 0.2]] }, en.nav2)
    .filter((line) => line.includes('alpha')).slice(0, 4);
  assert.deepEqual(large.map((line) => line.trim().startsWith('#')), [true, false, true, false]);
  assert.equal(large[0].trim(), `# alpha1: 206, ${en.nav2.tooLarge}`);
  const zeros = nav2Lines({ ...fitted, inflation: 2, alphas: [0, 1e-7, 0, 0.1], intervals: [[0, 0.00123], [0, 0.0016], null, [0.05, 0.16]], bootstrap: [[0, 0.0013], [0, 0.0018], null, [0.05, 0.16]] }, en.nav2);
  assert.deepEqual(zeros.filter((line) => /alpha[1-4]/.test(line)).map((line) => line.trim()), [
    '# alpha1: not significantly different from 0, at most 0.0026', '# alpha2: not significantly different from 0, at most 0.0036',
    '# alpha3: not significantly different from 0, at most –', 'alpha4: 0.20  # 0.10 to 0.32',
  ]);
  const corrected = nav2Lines({ ...fitted, alphas: [0.1], intervals: [null], bootstrap: [null], systematic: {
    mountYaw: { value: 0.05, interval: [0.04, 0.06], removed: true }, turnScale: { value: 1.01, interval: [1, 1.02], removed: false },
  } }, en.nav2);
  assert.ok(corrected.includes('    # with these systematic errors corrected: mountYaw 0.050'));
});

test('legs of the simulated log are those that the settings open with', () => {
  const config = Object.fromEntries(settings['alpha-calibrator'].map((each) => [each.key, each.default]));
  assert.deepEqual(SIMULATED, { distance: config.distance, angle: config.angle });
  const holds = (/** @type {object} */ change) => truthHolds(/** @type {any} */ ({ truth: {}, config: { ...config, ...change } }));
  assert.deepEqual([holds({}), holds({ distance: 0.3 }), holds({ angle: 0.3 }), holds({ duration: 1 }), holds({ rule: 'nav2' })], [true, false, false, false, false]);
  for (const { lengths } of [en, de]) assert.match(lengths.simulated('D', 'A'), /^\D* D m \D* A rad: \D*$/);
});

test('what is said where there is no leg has no number of one', () => {
  for (const text of [en.noWay, en.noLeg, de.noWay, de.noLeg]) assert.doesNotMatch(text, /\d|NaN|—/);
});

test('doc/calibration.md says what the element opens with', () => {
  const text = readFileSync(new URL('../../doc/calibration.md', import.meta.url), 'utf8').replaceAll('\n', ' ');
  const opening = (/** @type {string} */ name) => settings['alpha-calibrator'].find(({ key }) => key === name)?.default;
  const [, robust, seed] = text.match(/The element opens with: `robust: (\w+)`.*? `seed: (\d+)`/) ?? [];
  assert.deepEqual([robust, seed], [String(opening('robust')), String(opening('seed'))]);
});
