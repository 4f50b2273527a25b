/** Result as text and as JSON. */

import { en as shared } from '../messages/en.js';
import { en } from '../widgets/alpha-calibrator/en.js';
import { OVERSTATED, adviceOf, between, fixed, isZero, mostOf, nav2Lines, neededFor, short } from '../widgets/alpha-calibrator/lines.js';

/**
 * @typedef {[number, number] | null} Interval
 * @typedef {{ distance?: number, angle?: number, duration?: number }} Legs
 *
 * @typedef {object} Result
 * @property {any} calibration of the core
 * @property {Record<string, any>} fit options of `calibrate`
 * @property {{ positionDeviation?: number, headingDeviation?: number }} deviations of the reference, as stated
 * @property {{ name: string, found: string[] }[]} logs odometry and reference with their summaries
 * @property {number} start whole seconds that were subtracted from all times
 * @property {string} date
 */

/** Systematic errors: key, name and unit. @type {[string, string, string][]} */
const SYSTEMATIC = [
  ['clockOffset', 'clock offset', 's'],
  ['mountYaw', 'mount yaw', 'rad'],
  ['leverArm', 'lever arm', 'm'],
  ['distanceScale', 'scale of distance', ''],
  ['turnScale', 'scale of turning', ''],
];

/**
 * @param {Result} result
 * @returns {string}
 */
export function textOf({ calibration, fit, deviations, logs, start, date }) {
  const { alphas, intervals, bootstrap, systematic, legs, doubts, outliers, logLikelihood, gaps } = calibration;
  const model = fit.model ?? 'odometry';
  const rule = model === 'odometry' ? `, rule ${fit.rule ?? 'table'}` : '';
  const rows = alphas.map((/** @type {number | null} */ alpha, /** @type {number} */ i) => [
    `alpha${i + 1}`,
    alpha === null ? en.nav2.undetermined : toldOf(alpha, intervals[i]),
    between(intervals[i]),
    between(bootstrap[i]),
    shared.alphas[model === 'velocity' ? 'velocity' : 'odometry'][i],
  ]);
  return [
    ...logs.flatMap(({ name, found }) => [`${name}: ${found[0]}`, ...found.slice(1).map((line) => `  ${line}`)]),
    '',
    `${legs.count} legs ${lengthOf(fit.legs)}; model ${model}${rule}, ${fit.noise ?? 'normal'} noise`,
    exactnessOf(deviations),
    ...(gaps.odometry + gaps.reference > 0 ? [`no leg leads across ${gaps.odometry} ${gaps.odometry === 1 ? 'gap' : 'gaps'} of the odometry and ${gaps.reference} of the reference`] : []),
    '',
    ...aligned([['', 'value', '95 %', '95 % by bootstrap', 'noise of'], ...rows]),
    ...undeterminedOf(calibration, model),
    '',
    ...byLengthOf(calibration, fit.legs),
    ...aligned([['systematic', 'value', '95 %', ''], ...SYSTEMATIC.map((each) => systematicRow(each, systematic))]),
    '',
    ...aligned([['doubts', 'measured', 'if the model is true'], ...doubtRows(doubts), ['log-likelihood', `${short(logLikelihood, 6)} nats`, '']]),
    ...(outliers === null || outliers === undefined ? [] : [`bad legs: ${(100 * outliers).toFixed(1)} %`]),
    ...worstOf(doubts, legs, start),
    '',
    verdictOf(calibration),
    '',
    ...nav2Of({ calibration, fit, deviations, logs, start, date }),
    '',
  ].join('\n');
}

/** Says which errors of the reference were stated. @param {Result['deviations']} stated */
function exactnessOf({ positionDeviation = 0, headingDeviation = 0 }) {
  const errors = [...(positionDeviation ? [`${positionDeviation} m`] : []), ...(headingDeviation ? [`${headingDeviation} rad`] : [])];
  const stated = errors.length ? `the reference errs by ${errors.join(' and ')}, as stated` : '';
  if (errors.length === 2) return stated;
  const exact = positionDeviation ? '; its heading is' : headingDeviation ? '; its position is' : 'the reference is';
  const options = [...(positionDeviation ? [] : ['--position-deviation']), ...(headingDeviation ? [] : ['--heading-deviation'])];
  return `${stated}${exact} taken to be exact; what it errs by passes for noise, of short legs most of all: state it by ${options.join(' and ')}`;
}

/** @param {Legs} legs */
function lengthOf({ distance, angle, duration }) {
  return duration === undefined ? `of ${distance} m or ${angle} rad` : `of ${duration} s`;
}

/**
 * Says which α's the log does not determine, and what to drive.
 *
 * @param {any} calibration
 * @param {string} model
 * @returns {string[]}
 */
function undeterminedOf({ alphas, intervals, undetermined, doubts: { verdict } }, model) {
  const { lacking } = en.alphas;
  return /** @type {(keyof typeof lacking)[]} */ (Object.keys(lacking)).flatMap((reason) => {
    const { lack, drive } = adviceOf(lacking, model, reason);
    const those = (/** @type {(i: number) => boolean} */ are) => new Intl.ListFormat('en').format(alphas.flatMap((/** @type {unknown} */ _, /** @type {number} */ i) => (are(i) ? [`alpha${i + 1}`] : [])));
    const unknown = those((i) => undetermined[i] === reason);
    const zero = those((i) => undetermined[i] === null && verdict !== OVERSTATED && isZero(alphas[i], intervals[i]) && neededFor(model, i) === reason);
    return [...(unknown ? [`${unknown} not determined: ${lack}; ${drive}`] : []), ...(zero ? [`${zero} not told from 0: to tell it, ${drive}`] : [])];
  });
}

/** Prints an α, or its upper bound if it is not told from 0. @param {number | null} alpha @param {Interval | undefined} interval */
const toldOf = (alpha, interval) => (isZero(alpha, interval) ? `≤ ${mostOf(interval)}` : fixed(alpha, interval));

/**
 * Table of the α's by the length of legs, each with its interval by the bootstrap, which is wide if few legs decide.
 *
 * @param {any} calibration
 * @param {Legs} legs
 * @returns {string[]}
 */
function byLengthOf({ alphas, byLength }, legs) {
  if (!byLength.length) return [];
  const lengths = byLength.map((/** @type {any} */ { factor }) => {
    const [distance, angle, duration] = [legs.distance, legs.angle, legs.duration].map((of) => short((of ?? 0) * factor));
    return legs.duration === undefined ? `${distance} m, ${angle} rad` : `${duration} s`;
  });
  const counts = byLength.map((/** @type {any} */ at) => `${at.legs} legs`);
  const rows = alphas.flatMap((/** @type {unknown} */ _, /** @type {number} */ i) => [
    [`alpha${i + 1}`, ...byLength.map((/** @type {any} */ at) => toldOf(at.alphas[i], at.bootstrap[i]))],
    ['', ...byLength.map((/** @type {any} */ at) => between(at.bootstrap[i]))],
  ]);
  const untold = byLength.some((/** @type {any} */ at) => at.alphas.every((/** @type {unknown} */ alpha) => alpha === null));
  const why = untold ? ['–: too few legs, most of them shorter than four rows of a log, or turns of more than half a circle'] : [];
  return [...aligned([['by length', ...lengths], ['95 % by bootstrap', ...counts], ...rows]), ...why, ''];
}

/** @param {[string, string, string]} about @param {any} systematic @returns {string[]} */
function systematicRow([key, name, unit], systematic) {
  const { value, interval, removed } = systematic[key];
  const said = (/** @type {any} */ one, /** @type {any} */ its) => [`${fixed(one, its)}${unit && ` ${unit}`}`, between(its)];
  const isThere = (/** @type {number | null} */ one) => one !== null && Number.isFinite(one);
  if (![value].flat().every(isThere)) return [name, 'not determined', '', ''];
  const [told, ends] = Array.isArray(value) ? value.map((one, i) => said(one, interval?.[i])).reduce(([a, b], [c, d]) => [`${a}, ${c}`, `${b}, ${d}`]) : said(value, interval);
  return [name, told, ends, removed ? 'removed' : 'left in'];
}

/** @param {any} doubts @returns {string[][]} */
function doubtRows({ kinds, heldOut, squaredError }) {
  const percent = (/** @type {number | null} */ share) => (share === null || Number.isNaN(share) ? '–' : `${short(100 * share)} %`);
  return [
    ['held-out residuals inside of 95 %', percent(heldOut.coverage), heldOut.interval?.every(Number.isFinite) ? heldOut.interval.map(percent).join(' to ') : ''],
    ['squared error by degree of freedom', fixed(squaredError.mean, squaredError.interval), between(squaredError.interval)],
    ...kinds.flatMap((/** @type {any} */ { name, kurtosis, kurtosisExpected, autocorrelation, autocorrelationLimit }) => [
      [`kurtosis, ${name}`, short(kurtosis), short(kurtosisExpected)],
      [`autocorrelation, ${name}`, short(autocorrelation), Number.isFinite(autocorrelationLimit) ? `within ±${short(autocorrelationLimit)}` : ''],
    ]),
  ];
}

/** Lists the worst legs by the times of the logs. @param {any} doubts @param {any} legs @param {number} start @returns {string[]} */
function worstOf({ worst }, legs, start) {
  if (!worst.length) return [];
  const times = worst.slice(0, 5).map((/** @type {number} */ leg) => `${(start + legs.times[2 * leg]).toFixed(2)} s`);
  return [`worst legs at ${times.join(', ')}`];
}

/**
 * Returns the verdict on the model and the next step.
 *
 * @param {Result['calibration']} calibration
 */
function verdictOf({ doubts: { verdict, heldOut } }) {
  const name = /** @type {keyof typeof en.verdicts} */ (verdict);
  return `${en.verdicts[name](`${short(100 * heldOut.coverage)} %`)} ${en.nextSteps[name]}`;
}

/** @param {Result} result @returns {string[]} */
function nav2Of({ calibration, fit, logs, date }) {
  const { alphas, intervals, bootstrap, legs: { count }, doubts: { verdict }, systematic } = calibration;
  const { model = 'odometry', rule = 'table', legs } = fit;
  const log = [...new Set(logs.map(({ name }) => name))].join(' and ');
  const doubt = verdict === 'fits' ? undefined : verdictOf(calibration);
  const lines = nav2Lines({ alphas, intervals, bootstrap, count, model, rule, legs, log, date, verdict, doubt, systematic }, en.nav2);
  return lines.length ? ['# nav2_params.yaml', ...lines] : ['nav2_params.yaml has no lines for the velocity model.'];
}

/** @param {string[][]} rows of a table @returns {string[]} */
function aligned(rows) {
  const widths = rows[0].map((_, column) => Math.max(...rows.map((row) => (row[column] ?? '').length)));
  return rows.map((row) => row.map((cell, column) => cell.padEnd(widths[column])).join('  ').trimEnd());
}

/**
 * @param {Result} result
 * @returns {string} with typed arrays as plain ones
 */
export function jsonOf({ calibration, fit, deviations, logs, start, date }) {
  const plain = (/** @type {string} */ _, /** @type {unknown} */ value) => (ArrayBuffer.isView(value) ? [.../** @type {Float64Array} */ (value)] : value);
  return `${JSON.stringify({ date, fit, deviations, logs, start, ...calibration }, plain, 1)}\n`;
}
