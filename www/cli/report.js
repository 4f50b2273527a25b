/** Result as text and as JSON. */

import { en as shared } from '../messages/en.ts';
import { en } from '../widgets/alpha-calibrator/en.ts';
import { adviceOf, alphaOrBound, between, failedOf, fixed, isLocalizer, nav2Lines, percent, short } from '../widgets/alpha-calibrator/lines.ts';

/**
 * @typedef {[number, number] | null} Interval
 *
 * @typedef {object} Result
 * @property {any} calibration of the core
 * @property {Record<string, any>} options of `calibrate`
 * @property {{ name: string, found: string[] }[]} logs odometry and reference of each drive, with their summaries
 * @property {number} start whole seconds that were subtracted from all times
 * @property {string} date
 */

/** Systematic errors: key, name and unit. @type {[string, string, string][]} */
const SYSTEMATIC = [
  ['clockOffset', 'clock offset', 's'],
  ['mountYaw', 'mount yaw', 'rad'],
  ['leverArm', 'lever arm', 'm'],
  ['distanceScale', 'distance scale', ''],
  ['turnScale', 'turn scale', ''],
];

/** Causes of lost legs. @type {Record<string, string>} */
const LOST = {
  withoutReference: 'without reference', acrossBreaks: 'across jumps or missing rows', acrossPauses: 'across pauses', standing: 'of a standing robot',
};

/** Checks whose failure makes a log unusable. */
const DECISIVE = ['reference-matches', 'enough-legs', 'inflation-bounded'];

/** Number of outliers that are listed. */
const LISTED = 5;

/**
 * @param {Result} result
 * @returns {string}
 */
export function textOf({ calibration, options, logs, start, date }) {
  const { legs, lost, diagnostics: { checks, windows } } = calibration;
  const { model = 'odometry', rule = 'thrun' } = options;
  const failed = failedOf(checks);
  const causes = Object.entries(LOST).filter(([cause]) => lost[cause] > 0).map(([cause, name]) => `${lost[cause]} ${name}`);
  return [
    verdictOf(calibration),
    ...(logs.some(({ name }) => isLocalizer(name)) ? [en.nav2.localizer] : []),
    '',
    ...logs.flatMap(({ name, found }) => [`${name}: ${found[0]}`, ...found.slice(1).map((line) => `  ${line}`)]),
    `${legs.count} legs ${lengthOf(options.legs)}; model ${model}${model === 'odometry' ? `, rule ${rule}` : ''}`,
    '',
    ...alphasOf(calibration, model),
    '',
    ...aligned([['', 'value', '95 %', ''], ...noiseRows(calibration, options), ...SYSTEMATIC.map((each) => systematicRow(each, calibration)), persistenceRow(calibration)]),
    '',
    ...aligned([['check', 'value', 'expected', ''], ...checks.map(checkRow)]),
    ...failed.map(({ name, message }) => `${name}: ${message}`),
    '',
    ...(causes.length ? [`lost legs: ${causes.join(', ')}`] : []),
    ...outliersOf(legs, start),
    ...aligned([['held-out windows', 'number', 'covered', 'NEES'], ...windows.map(windowRow)]),
    '',
    ...nav2Of({ calibration, options, logs, start, date }),
    '',
  ].join('\n');
}

/** Says the verdict and what to do. @param {any} calibration */
function verdictOf({ diagnostics: { verdict, checks } }) {
  const failed = failedOf(checks);
  if (verdict === 'consistent') return 'Consistent: all checks passed. Use the recommended α’s with legs of this length.';
  if (verdict === 'questionable') {
    const count = failed.length === 1 ? 'one check' : `${failed.length} of ${checks.length} checks`;
    return `Questionable: ${count} failed. Read below what that means; if the log cannot be improved, use the recommended α’s.`;
  }
  const message = failed.find(({ name }) => DECISIVE.includes(name))?.message ?? 'It does not identify any α: see below what to drive.';
  return `Unusable: no α’s are recommended from this log. ${message}`;
}

/** @param {{ distance?: number, angle?: number, duration?: number }} legs */
function lengthOf({ distance, angle, duration }) {
  return duration === undefined ? en.nav2.moved(short(distance ?? null), short(angle ?? null)) : en.nav2.lasted(short(duration));
}

/**
 * Table of the α's, the reason for the inflation, and what to drive for those that are not identifiable.
 *
 * @param {any} calibration
 * @param {string} model
 * @returns {string[]}
 */
function alphasOf({ alphas, intervals, notIdentifiable, recommended, diagnostics }, model) {
  const rows = alphas.map((/** @type {number | null} */ alpha, /** @type {number} */ i) => [
    `alpha${i + 1}`,
    alpha === null ? 'not identifiable' : alphaOrBound(alpha, intervals[i]),
    between(intervals[i]),
    recommended && alpha !== null ? alphaOrBound(alpha, intervals[i], recommended.inflation) : '–',
    shared.alphas[model === 'velocity' ? 'velocity' : 'odometry'][i],
  ]);
  const { lacking } = en.alphas;
  // Driving differently does not help where the reference is another drive's, or has other units.
  const matches = diagnostics.checks.every((/** @type {any} */ { name, passed }) => passed || name !== 'reference-matches');
  const advice = !matches ? [] : /** @type {(keyof typeof lacking)[]} */ (Object.keys(lacking)).flatMap((reason) => {
    const names = notIdentifiable.flatMap((/** @type {string | null} */ each, /** @type {number} */ i) => (each === reason ? [`alpha${i + 1}`] : []));
    const { lack, drive } = adviceOf(lacking, model, reason);
    return names.length ? [`${new Intl.ListFormat('en').format(names)} not identifiable: ${lack}; ${drive}`] : [];
  });
  return [...aligned([['', 'fitted', '95 %', 'recommended', ''], ...rows]), ...advice, ...(recommended ? [recommended.reason] : [])];
}

/** @param {any} calibration @param {Result['options']} options @returns {string[][]} */
function noiseRows({ referenceNoise }, options) {
  const row = (/** @type {string} */ name, /** @type {'positionStd' | 'yawStd'} */ key, /** @type {string} */ unit) => {
    const { value, interval } = referenceNoise[key];
    const isStated = options[key] !== undefined;
    return [name, `${fixed(value, interval)} ${unit}`, isStated ? '' : between(interval), isStated ? 'as stated' : 'estimated'];
  };
  return [row('reference position σ', 'positionStd', 'm'), row('reference yaw σ', 'yawStd', 'rad')];
}

/** @param {[string, string, string]} about @param {any} calibration @returns {string[]} */
function systematicRow([key, name, unit], { systematicErrors }) {
  const { value, interval, constant, corrected } = systematicErrors[key];
  const [values, intervals] = Array.isArray(value) ? [value, interval] : [[value], [interval]];
  if (values.includes(null)) return [name, 'not identifiable'];
  const list = (/** @type {(one: any, its: Interval) => string} */ print) => values.map((/** @type {any} */ one, /** @type {number} */ i) => print(one, intervals[i])).join(', ');
  return [
    name,
    list((one, its) => fixed(one, its) + (unit && ` ${unit}`)),
    list((_, its) => between(its)),
    `${corrected ? 'corrected' : 'not corrected'}${constant ? '' : ', not a constant'}`,
  ];
}

/** @param {any} calibration @returns {string[]} */
function persistenceRow({ persistence: { correlation: { value, interval }, length } }) {
  return ['correlation of neighbouring legs', fixed(value, interval), between(interval), length > 0 ? `errors persist over ${short(length, 2)} m` : ''];
}

/** @param {any} check @returns {string[]} */
function checkRow({ name, value, expected: [low, high], passed }) {
  const range = low === -Infinity ? `≤ ${short(high)}` : high === Infinity ? `≥ ${short(low)}` : `${short(low)} to ${short(high)}`;
  return [name, value === Infinity ? '∞' : short(value), range, passed ? 'ok' : 'FAILED'];
}

/** @param {any} window @returns {string[]} */
function windowRow({ length, count, coverage, nees }) {
  return [`of ${short(length)} m`, String(count), percent(coverage), short(nees)];
}

/** Lists outliers by the times of the logs. @param {any} legs @param {number} start @returns {string[]} */
function outliersOf({ count, times, outliers }, start) {
  const found = Array.from({ length: count }, (_, leg) => leg).filter((leg) => outliers[leg] === 1);
  const list = found.slice(0, LISTED).map((leg) => `${(start + times[2 * leg]).toFixed(2)} s`).join(', ');
  return found.length ? [`outliers: ${found.length} of ${count} legs, at ${list}${found.length > LISTED ? ', …' : ''}`] : [];
}

/** @param {Result} result @returns {string[]} */
function nav2Of({ calibration, options: { model = 'odometry', rule = 'thrun', legs }, logs, date }) {
  if (calibration.recommended === null) return ['No lines for nav2_params.yaml: the log is unusable.'];
  const log = new Intl.ListFormat('en').format(new Set(logs.map(({ name }) => name)));
  const lines = nav2Lines({ calibration, count: calibration.legs.count, model, rule, legs, log, date }, en.nav2);
  return lines.length ? ['# nav2_params.yaml', ...lines] : ['No lines for nav2_params.yaml: Nav2 has no velocity model.'];
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
export function jsonOf({ calibration, options, logs, start, date }) {
  const plain = (/** @type {string} */ _, /** @type {unknown} */ value) => (ArrayBuffer.isView(value) ? [.../** @type {Float64Array} */ (value)] : value);
  return `${JSON.stringify({ date, options, logs, start, ...calibration }, plain, 1)}\n`;
}
