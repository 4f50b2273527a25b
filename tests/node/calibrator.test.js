// Texts of the Alpha Calibrator, made without a DOM: numbers, sentences, and parameter lines for Nav2.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { en, yamlWords } from '../../www/widgets/alpha-calibrator/en.ts';
import { formatAlphaOrBound, adviseCorrection, formatInterval as ends, formatEstimate, judgementOf, localizeNumber, formatNav2Yaml, formatNumber } from '../../www/widgets/alpha-calibrator/result.ts';
import { SIMULATED_LEG_LENGTHS, legClassesOf, isTruthComparable } from '../../www/widgets/alpha-calibrator/settings.ts';
import { settings } from '../../build/settings.js';

test('the class of a leg follows from its p-value, with as many degrees of freedom as observed residuals', () => {
  const legResiduals = Float64Array.of(0, 0, 0, 0, 0, NaN, 0, NaN, NaN);
  const classesOf = (/** @type {number[]} */ ...squaredResiduals) => [...legClassesOf({ count: 3, squared: Float64Array.from(squaredResiduals), residuals: legResiduals })];
  // The squared residuals are just below, or in the last line just above, quantiles of χ² with 3, 2 and 1 degrees of freedom.
  assert.deepEqual(classesOf(2.36, 1.38, 0.45), [0, 0, 0]);
  assert.deepEqual(classesOf(7.81, 5.99, 3.84), [1, 1, 1]);
  assert.deepEqual(classesOf(16.2, 13.8, 10.8), [2, 2, 2]);
  assert.deepEqual(classesOf(16.3, 13.9, 10.9), [3, 3, 3]);
});

test('numbers in the format of files are formatted for the screen', () => {
  assert.deepEqual(['-0.050', '1.0e-7', '≤ 2.3e-13'].map(localizeNumber), ['−0.050', '1.0·10⁻⁷', '≤ 2.3·10⁻¹³']);
});

test('numbers in files have the significant digits of their interval, and tiny numbers have an exponent', () => {
  for (const [estimateValue, estimateInterval, estimateText, rangeText] of /** @type {[number, [number, number], string, string][]} */ ([
    [0.0123, [0.01, 0.015], '0.0123', '0.0100 to 0.0150'],
    [2.34e-13, [1.8e-13, 2.9e-13], '2.3e-13', '1.8e-13 to 2.9e-13'],
    [3e-8, [0, 1.6e-7], '3.0e-8', '0 to 1.6e-7'],
    [1e-7, [0, 0.0016], '0.0000', '0.0000 to 0.0016'],
    [-0.0024, [-0.0048, -1e-5], '-0.0024', '-0.0048 to 0.0000'],
    [0.5, [0.5 - 1e-9, 0.5 + 1e-9], '0.5000000000', '0.4999999990 to 0.5000000010'],
  ])) {
    assert.deepEqual([formatEstimate(estimateValue, estimateInterval), ends(estimateInterval)], [estimateText, rangeText]);
  }
  assert.deepEqual([formatNumber(1e-7), formatNumber(-2.5e-9), formatNumber(0.25)], ['1.0e-7', '-2.5e-9', '0.25']);
  assert.deepEqual([ends([0, Infinity]), ends([-Infinity, Infinity]), ends(null)], ['', '', '']);
});

test('an α that rounds to 0 is shown as an upper bound instead of 0', () => {
  assert.deepEqual([formatAlphaOrBound(1e-7, [0, 0.0016]), formatAlphaOrBound(1e-7, [0, 0.0016], 2), formatAlphaOrBound(0.03, [0.024, 0.036], 2)], ['≤ 0.0016', '≤ 0.0032', '0.060']);
});

/** Returns the result of a calibration of two α's. @param {object} [changedFields] fields with other values than the default @returns {any} */
const createCalibration = (changedFields) => ({
  alphas: [0.03, 0.008],
  intervals: [[0.024, 0.036], [0.007, 0.0091]],
  recommended: { inflation: 2, reason: 'As measured.' },
  systematicErrors: {
    mountYaw: { value: 0.05, interval: [0.04, 0.06], corrected: true },
    distanceScale: { value: 0.99, interval: [0.98, 0.999], corrected: true }, turnScale: { value: 1.01, interval: [1.005, 1.015], corrected: false },
  },
  diagnostics: { checks: [{ name: 'enough-legs', passed: true, message: '' }, { name: 'window-1m-covered', passed: true, message: '' }], windows: [{ length: 1, count: 78, coverage: 0.923 }] },
  ...changedFields,
});

/** Returns the lines for Nav2 without indentation. @param {object} [changedFields] changed fields of the calibration @param {object} [otherOptions] changed options */
const nav2LinesOf = (changedFields, otherOptions) =>
  formatNav2Yaml({ stats: createCalibration(changedFields), legCount: 9, model: 'odometry', rule: 'nav2', legLength: { distance: 0.25, angle: 0.2 }, corrections: {}, logName: 'a.csv and b.csv', warnings: [], ...otherOptions }, '2026-01-02')
    .trimEnd().split('\n').map((nav2Line) => nav2Line.trim());

test('lines for Nav2 contain the recommended α’s, and the fitted α’s in comments', () => {
  assert.deepEqual(nav2LinesOf(), [
    'amcl:', 'ros__parameters:',
    '# 9 legs of 0.25 m or 0.2 rad of a.csv and b.csv, 2026-01-02',
    '# Inflation 2.00. As measured.',
    '# with these systematic errors corrected: mountYaw 0.050; distanceScale 0.990',
    '# First multiply the odometry’s distances by 0.990: the α’s are those of the corrected robot.',
    'robot_model_type: "nav2_amcl::DifferentialMotionModel"',
    'alpha1: 0.060  # fitted 0.030, 95 % 0.024 to 0.036', 'alpha2: 0.0160  # fitted 0.0080, 95 % 0.0070 to 0.0091',
    `# ${yamlWords.fifthAlphaNote}`, 'update_min_d: 0.25', 'update_min_a: 0.2',
  ]);
});

test('lines for Nav2 omit α’s that are not identifiable, and all α’s if none is recommended', () => {
  assert.deepEqual([nav2LinesOf({ recommended: null }), adviseCorrection(createCalibration({ recommended: null }), en.nav2)], [[''], []]);
  assert.deepEqual(nav2LinesOf({}, { model: 'velocity' }), ['']);
  const exampleAlphas = [null, 1e-7, 103, 1e-8];
  const exampleIntervals = [null, [0, 0.0016], [50, 200], null];
  assert.deepEqual(nav2LinesOf({ alphas: exampleAlphas, intervals: exampleIntervals }).filter((nav2Line) => /alpha[1-4]/.test(nav2Line)), [
    `# alpha1: ${yamlWords.notIdentifiable}`, `alpha2: 0.0032  # ${yamlWords.notSignificantNote('0.0016')}`, `# alpha3: 206, ${yamlWords.tooLargeNote}`, 'alpha4: 2.0e-8  # fitted 1.0e-8',
  ]);
});

test('lines for Nav2 warn of failed checks, and of another rule', () => {
  const { diagnostics: fitDiagnostics } = createCalibration();
  const failedChecks = ['tails-normal', 'outliers-few'].map((checkName) => ({ name: checkName, passed: false, message: 'Drive on.' }));
  assert.ok(nav2LinesOf({ diagnostics: { ...fitDiagnostics, checks: failedChecks } }).includes('# Caution, these checks failed: tails-normal, outliers-few'));
  assert.deepEqual([{ rule: 'thrun' }, {}].map((changedOptions) => nav2LinesOf({}, changedOptions).includes(`# ${yamlWords.otherRuleNote}`)), [true, false]);
});

test('a large clock offset is mentioned, and changes no verdict', () => {
  const unknownEstimate = { value: null, interval: null };
  const judgementOfClockOffset = (/** @type {number} */ clockOffset) => judgementOf({
    stats: /** @type {any} */ ({
      ...createCalibration(), notIdentifiable: [], diagnostics: { verdict: 'consistent', checks: [] },
      systematicErrors: { clockOffset: { value: clockOffset, interval: null }, mountYaw: unknownEstimate, leverArm: unknownEstimate, distanceScale: unknownEstimate, turnScale: unknownEstimate },
    }),
    legCount: 500, model: 'odometry', rule: 'nav2', legLength: {}, corrections: {}, logName: '', warnings: [],
  }, en, '');
  const { advice: [firstSentence], rating: logRating } = judgementOfClockOffset(86_400.06);
  assert.deepEqual([firstSentence, logRating], ['The reference’s clock is 86\u202f400 s ahead of the odometry’s. The turns of the robot aligned both: check that they are of one drive.', 'consistent']);
  assert.match(judgementOfClockOffset(-3600).advice[0], /is 3\u202f600 s behind the/);
  assert.deepEqual(judgementOfClockOffset(-9.5).advice, [en.useRecommendedSentence]);
});

test('the leg settings of the simulated log equal the default settings', () => {
  const defaultConfig = Object.fromEntries(settings['alpha-calibrator'].map((settingDeclaration) => [settingDeclaration.key, settingDeclaration.default]));
  assert.deepEqual(SIMULATED_LEG_LENGTHS, { distance: defaultConfig.distance, angle: defaultConfig.angle });
  const hasTruth = (/** @type {object} */ changedFields) => isTruthComparable(/** @type {any} */ ({ truth: {}, fittedConfig: { ...defaultConfig, ...changedFields } }));
  assert.deepEqual([hasTruth({}), hasTruth({ distance: 0.3 }), hasTruth({ angle: 0.3 }), hasTruth({ duration: 1 }), hasTruth({ rule: 'nav2' })], [true, false, false, false, false]);
});
