/** What came out, as text and as JSON. */

/**
 * @typedef {[number, number] | null} Interval
 * @typedef {{ distance?: number, angle?: number, duration?: number }} Legs
 *
 * @typedef {object} Result
 * @property {any} calibration of the core
 * @property {Record<string, any>} fit what was asked of it
 * @property {{ name: string, found: string[] }[]} logs odometry and reference, and what was found in them
 * @property {number} start whole seconds that were taken from all times
 * @property {string} date
 */

/** Significant digits of an interval's width, and of what has no interval. */
const [OF_WIDTH, DIGITS] = [2, 3];

/** What Nav2 calls its models. @type {Record<string, string>} */
const NAV2 = { odometry: 'nav2_amcl::DifferentialMotionModel', omnidirectional: 'nav2_amcl::OmniMotionModel' };

/** The rules under which Nav2's models are. */
const ITS_RULES = ['nav2', 'omni'];

/** What the noises of the models grow with, in the order of the α's. @type {Record<string, string[]>} */
const GROW = {
  odometry: ['turning, with the turn', 'turning, with the way', 'way, with the way', 'way, with the turn'],
  omnidirectional: ['turning, with the turn', 'turning, with the way', 'way, with the way', 'way, with the turn', 'sideways, with the way'],
  velocity: ['v, with v', 'v, with ω', 'ω, with v', 'ω, with ω', 'γ, with v', 'γ, with ω'],
};

/** @type {Record<string, string>} */
const VERDICTS = {
  fits: 'The model fits this log.',
  overconfident: 'Overconfident: fewer held-out legs end inside than should. Inflate the α\'s, or a filter gets lost.',
  lazy: 'Lazy: more held-out legs end inside than should. A filter would believe its sensors more than it could.',
  'heavy-tails': 'The tails are heavier than the noise\'s: a few legs are far out. Try --robust, and look at the worst legs.',
  correlated: 'The error of one leg tells that of the next: something systematic is left that the model does not know.',
  'few-legs': 'Too few legs to tell. Drive on, or take shorter legs.',
};

/**
 * Of each reason why an α is not determined: what the log lacks, and what to drive. Fifty legs tell an α of
 * its own to a fifth. Under the velocity model turns on the spot tell no executed turn.
 *
 * @type {Record<string, { lack: string, drive: string, byCommands: string }>}
 */
const LACKING = {
  'turns-too-little': {
    lack: 'This log turns too little',
    drive: 'Turn on the spot, some fifty times.',
    byCommands: 'Drive tight bends, some fifty legs.',
  },
  'drives-too-little': {
    lack: 'This log hardly goes anywhere',
    drive: 'Drive straight on, some fifty legs.',
    byCommands: 'Drive straight on and in bends, some fifty legs of each.',
  },
  'one-ratio': {
    lack: 'This log turns and drives in one ratio',
    drive: 'Drive straight on and turn on the spot, some fifty legs of each.',
    byCommands: 'Drive straight on and in tighter bends, some fifty legs of each.',
  },
};

/** What is systematic: its name, its unit, and how many numbers it has. @type {[string, string, string][]} */
const SYSTEMATIC = [
  ['clockOffset', 'clock offset', 's'],
  ['mountYaw', 'mount yaw', 'rad'],
  ['leverArm', 'lever arm', 'm'],
  ['distanceScale', 'scale of distance', ''],
  ['turnScale', 'scale of turning', ''],
];

/** What stands for a figure that a log is too short for. */
const NONE = '–';

/** @param {number | null} value */
const short = (value, digits = DIGITS) => (value !== null && Number.isFinite(value) ? String(Number(value.toPrecision(digits))) : NONE);

/** As many decimals as an interval has a meaning in. @param {number | null} value @param {Interval | undefined} interval */
function fixed(value, interval) {
  const width = interval ? interval[1] - interval[0] : 0;
  if (value === null || !Number.isFinite(value) || !(width > 0 && width < Infinity)) return short(value);
  return value.toFixed(Math.max(0, Math.min(12, OF_WIDTH - 1 - Math.floor(Math.log10(width)))));
}

/** @param {Interval | undefined} interval */
const between = (interval) => (interval ? interval.map((end) => fixed(end, interval)).join(' to ') : '');

/**
 * @param {Result} result
 * @returns {string}
 */
export function textOf({ calibration, fit, logs, start, date }) {
  const { alphas, intervals, bootstrap, systematic, legs, doubts, outliers, logLikelihood, gaps } = calibration;
  const model = fit.model ?? 'odometry';
  const rule = model === 'odometry' ? `, rule ${fit.rule ?? 'table'}` : '';
  const rows = alphas.map((/** @type {number | null} */ alpha, /** @type {number} */ i) => [
    `alpha${i + 1}`,
    alpha === null ? 'not determined by this log' : fixed(alpha, intervals[i]),
    between(intervals[i]),
    between(bootstrap[i]),
    GROW[model][i],
  ]);
  return [
    ...logs.flatMap(({ name, found }) => [`${name}: ${found[0]}`, ...found.slice(1).map((line) => `  ${line}`)]),
    '',
    `${legs.count} legs ${lengthOf(fit.legs)}; model ${model}${rule}, ${fit.noise ?? 'normal'} noise`,
    ...(gaps.odometry + gaps.reference > 0 ? [`no leg leads across ${gaps.odometry} gaps of the odometry and ${gaps.reference} of the reference`] : []),
    '',
    ...aligned([['', 'value', '95 %', '95 % by bootstrap', 'noise of'], ...rows]),
    ...undeterminedOf(calibration, model),
    '',
    ...byLengthOf(calibration, fit.legs),
    ...aligned([['systematic', 'value', '95 %', ''], ...SYSTEMATIC.map((each) => systematicRow(each, systematic))]),
    '',
    ...aligned([['doubts', 'measured', 'if the model is true'], ...doubtRows(doubts), ['log-likelihood', `${short(logLikelihood, 6)} nats`, '']]),
    ...(outliers === null || outliers === undefined ? [] : [`bad legs: ${short(100 * outliers)} %`]),
    ...worstOf(doubts, legs, start),
    '',
    VERDICTS[doubts.verdict] ?? doubts.verdict,
    '',
    ...nav2Lines({ calibration, fit, logs, date }),
    '',
  ].join('\n');
}

/** @param {Legs} legs */
function lengthOf({ distance, angle, duration }) {
  return duration === undefined ? `of ${distance} m or ${angle} rad` : `of ${duration} s`;
}

/**
 * What the log lacks, and what to drive.
 *
 * @param {any} calibration
 * @param {string} model
 * @returns {string[]}
 */
function undeterminedOf({ undetermined }, model) {
  return Object.entries(LACKING).flatMap(([reason, { lack, drive, byCommands }]) => {
    const names = undetermined.flatMap((/** @type {string | null} */ its, /** @type {number} */ i) => (its === reason ? [`alpha${i + 1}`] : []));
    if (!names.length) return [];
    const are = names.length > 1 ? 'are' : 'is';
    return [`${lack}: ${new Intl.ListFormat('en').format(names)} ${are} not determined. ${model === 'velocity' ? byCommands : drive}`];
  });
}

/**
 * A table of the α's by the length of legs, of each its value and its interval.
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
    [`alpha${i + 1}`, ...byLength.map((/** @type {any} */ at) => fixed(at.alphas[i], at.intervals[i]))],
    ['', ...byLength.map((/** @type {any} */ at) => between(at.intervals[i]))],
  ]);
  return [...aligned([['by length', ...lengths], ['', ...counts], ...rows]), ''];
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
  const percent = (/** @type {number | null} */ share) => (share === null || Number.isNaN(share) ? NONE : `${short(100 * share)} %`);
  return [
    ['held-out residuals inside of 95 %', percent(heldOut.coverage), heldOut.interval ? heldOut.interval.map(percent).join(' to ') : ''],
    ['squared error by degree of freedom', fixed(squaredError.mean, squaredError.interval), between(squaredError.interval)],
    ...kinds.flatMap((/** @type {any} */ { name, kurtosis, autocorrelation, autocorrelationLimit }) => [
      [`kurtosis, ${name}`, short(kurtosis), ''],
      [`autocorrelation, ${name}`, short(autocorrelation), autocorrelationLimit ? `within ±${short(autocorrelationLimit)}` : ''],
    ]),
  ];
}

/** By the times of the logs. @param {any} doubts @param {any} legs @param {number} start @returns {string[]} */
function worstOf({ worst }, legs, start) {
  if (!worst.length) return [];
  const times = worst.slice(0, 5).map((/** @type {number} */ leg) => `${(start + legs.times[2 * leg]).toFixed(2)} s`);
  return [`worst legs at ${times.join(', ')}`];
}

/**
 * Lines of nav2_params.yaml.
 *
 * @param {Pick<Result, 'calibration' | 'fit' | 'logs' | 'date'>} result
 * @returns {string[]}
 */
export function nav2Lines({ calibration, fit, logs, date }) {
  const { alphas, intervals, legs, doubts } = calibration;
  const { model = 'odometry', rule = 'table' } = fit;
  if (!Object.hasOwn(NAV2, model)) return ['nav2_params.yaml has no lines for the velocity model.'];
  const names = [...new Set(logs.map(({ name }) => name))].join(' and ');
  const comments = [
    // A name may have lines of its own, which would end the comment.
    `${legs.count} legs ${lengthOf(fit.legs)} of ${names}, ${date}; 95 % intervals`.replaceAll(/\s+/g, ' '),
    ...(model !== 'odometry' || ITS_RULES.includes(rule) ? [] : ['fitted under another rule than Nav2\'s: see --rule nav2']),
    ...(doubts.verdict === 'fits' ? [] : [VERDICTS[doubts.verdict]]),
  ];
  const lines = alphas.map((/** @type {number | null} */ alpha, /** @type {number} */ i) => {
    if (alpha === null) return `# alpha${i + 1}: not determined by this log`;
    return `alpha${i + 1}: ${fixed(alpha, intervals[i])}  # ${between(intervals[i])}`;
  });
  const triggers = fit.legs.duration === undefined ? [`update_min_d: ${fit.legs.distance}`, `update_min_a: ${fit.legs.angle}`] : [];
  const fifth = alphas.length < 5 ? ['# alpha5 is of the omnidirectional model alone'] : [];
  const all = [...comments.map((line) => `# ${line}`), `robot_model_type: "${NAV2[model]}"`, ...lines, ...fifth, ...triggers];
  return ['# nav2_params.yaml', 'amcl:', '  ros__parameters:', ...all.map((line) => `    ${line}`)];
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
export function jsonOf({ calibration, fit, logs, start, date }) {
  const plain = (/** @type {string} */ _, /** @type {unknown} */ value) => (ArrayBuffer.isView(value) ? [.../** @type {Float64Array} */ (value)] : value);
  return `${JSON.stringify({ date, fit, logs, start, ...calibration }, plain, 1)}\n`;
}
