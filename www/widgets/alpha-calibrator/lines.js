/** Lines for nav2_params.yaml, with numbers in the format of files in every language. */

/**
 * @typedef {[number, number] | null} Interval
 *
 * @typedef {object} Fitted
 * @property {(number | null)[]} alphas
 * @property {Interval[]} intervals by the likelihood, as the values are told by
 * @property {Interval[]} bootstrap those that are told with them, which are right too where legs have something in common
 * @property {number} count of legs
 * @property {string} model
 * @property {string} rule
 * @property {{ distance?: number, angle?: number, duration?: number }} legs
 * @property {string} log its name, or theirs
 * @property {string} date
 * @property {string} verdict
 * @property {string} [doubt] a sentence, where there is something to doubt
 * @property {any} systematic as the core tells it
 * @property {number} [inflation]
 *
 * @typedef {typeof import('./en.js').en.nav2} Words
 */

/** Significant digits of an interval's width, and of what has no interval. */
const [OF_WIDTH, DIGITS] = [2, 3];

/** Below it values have an exponent. */
const TINY = 1e-6;

const MOST_DECIMALS = 12;

/** From it on whole numbers have an exponent: times since 1970 have none. */
const LONG = 1e15;

/** Largest plausible α: an error as large as the motion, or of a radian a metre. */
const MOST = 1;

/** Placeholder for a missing number. */
const NONE = '–';

/** Plugins of Nav2 by model. @type {Record<string, string>} */
const NAV2 = { odometry: 'nav2_amcl::DifferentialMotionModel', omnidirectional: 'nav2_amcl::OmniMotionModel' };

/** Verdict on a reference whose stated error is too large: no drive would tell more. */
export const OVERSTATED = 'overstated';

/** Verdicts under which no α is exported. */
const USELESS = ['few-legs', 'unrelated', OVERSTATED];

/** Rules of Nav2's models. */
const ITS_RULES = ['nav2', 'omni'];

/** @param {number | null} value */
export const short = (value, digits = DIGITS) => (value !== null && Number.isFinite(value) ? pointed(String(Number(value.toPrecision(digits)))) : NONE);

/** Adds a point to an exponent, without which YAML 1.1 reads a text. @param {string} number */
const pointed = (number) => number.replace(/^(-?\d)e/, '$1.0e');

/** Adds decimals to a whole number, which Nav2 refuses for its doubles. @param {string} number */
const double = (number) => (number.includes('.') ? number : `${number}.0`);

/** Prints the decimals that an interval leaves meaning to. @param {number | null} value @param {Interval | undefined} interval */
export function fixed(value, interval) {
  const width = interval ? interval[1] - interval[0] : 0;
  if (value === null || !(Math.abs(value) < LONG) || !(width > 0 && width < Infinity)) return short(value);
  const decimals = OF_WIDTH - 1 - Math.floor(Math.log10(width));
  if (width >= TINY || Math.abs(value) >= TINY) return value.toFixed(Math.max(0, Math.min(MOST_DECIMALS, decimals)));
  const digits = decimals + Math.floor(Math.log10(Math.abs(value)));
  return digits < 0 ? '0' : pointed(value.toExponential(Math.min(MOST_DECIMALS, digits)));
}

/** Prints an interval; empty if an end is not finite. @param {Interval | undefined} interval */
export const between = (interval) => (interval?.every(Number.isFinite) ? interval.map((end) => fixed(end, interval)).join(' to ') : '');

/**
 * Checks whether an α is 0 in the digits of its interval. A printed zero would look like a result.
 *
 * @param {number | null} alpha
 * @param {Interval | undefined} interval
 */
export const isZero = (alpha, interval) => alpha !== null && Number(fixed(alpha, interval)) === 0;

/** Upper end of an interval. @param {Interval | undefined} interval */
export const mostOf = (interval) => short(interval?.[1] ?? null, OF_WIDTH);

/**
 * Returns the motion that an α multiplies.
 *
 * @param {string} model
 * @param {number} index of the α, from 0
 * @returns {'turn' | 'way'}
 */
export function driverOf(model, index) {
  if (model === 'velocity') return index % 2 ? 'turn' : 'way';
  return index === 0 || index === 3 ? 'turn' : 'way';
}

/**
 * Says why an α is not determined, and the drive that would determine it.
 *
 * @param {typeof import('./en.js').en.alphas.lacking} lacking
 * @param {string} model
 * @param {keyof typeof lacking} reason
 */
export function adviceOf(lacking, model, reason) {
  const { lack, drive, byCommands } = lacking[reason];
  return { lack, drive: model === 'velocity' ? byCommands : drive };
}

/** Reason whose advice would tell an α from 0. @param {string} model @param {number} index @returns {'turns-too-little' | 'drives-too-little'} */
export const neededFor = (model, index) => (driverOf(model, index) === 'turn' ? 'turns-too-little' : 'drives-too-little');

/**
 * @param {Fitted} fitted
 * @param {Words} say
 * @returns {string[]} none if Nav2 has no such model
 */
export function nav2Lines({ alphas, intervals, bootstrap, count, model, rule, legs, log, date, verdict, doubt, systematic, inflation = 1 }, say) {
  if (!Object.hasOwn(NAV2, model)) return [];
  const { distance, angle, duration } = legs;
  const notes = [
    say.of(String(count), duration === undefined ? say.moved(short(distance ?? null), short(angle ?? null)) : say.lasted(short(duration)), log, date),
    ...(model !== 'odometry' || ITS_RULES.includes(rule) ? [] : [say.otherRule]),
    ...(inflation === 1 ? [] : [say.inflated(short(inflation))]),
    ...correctionOf(systematic).map((errors) => say.corrected(errors)),
    ...(doubt ? [doubt] : []),
  ];
  const lines = alphas.map((alpha, i) => {
    const [interval, ends] = [intervals, bootstrap].map((all) => /** @type {Interval} */ (all[i]?.map((end) => inflation * end) ?? null));
    if (USELESS.includes(verdict)) return `# alpha${i + 1}: ${say.useless}`;
    if (alpha === null) return `# alpha${i + 1}: ${say.undetermined}`;
    if (isZero(inflation * alpha, interval)) return `# alpha${i + 1}: ${say.zero(mostOf(ends))}`;
    const value = fixed(inflation * alpha, interval);
    return alpha > MOST ? `# alpha${i + 1}: ${value}, ${say.tooLarge}` : `alpha${i + 1}: ${double(value)}${ends ? `  # ${between(ends)}` : ''}`;
  });
  // A line break in a file's name would end the comment.
  const comments = notes.map((note) => `# ${note.replaceAll(/\s+/g, ' ')}`);
  const fifth = alphas.length < 5 ? [`# ${say.fifth}`] : [];
  const triggers = duration === undefined ? [`update_min_d: ${double(short(distance ?? null))}`, `update_min_a: ${double(short(angle ?? null))}`] : [];
  const all = [...comments, `robot_model_type: "${NAV2[model]}"`, ...lines, ...fifth, ...triggers];
  return ['amcl:', '  ros__parameters:', ...all.map((line) => `    ${line}`)];
}

/**
 * Lists the systematic errors that were removed: the odometry of the robot still has them.
 *
 * @param {any} systematic
 * @returns {string[]} one, or none
 */
function correctionOf(systematic) {
  const removed = Object.entries(systematic).filter(([, each]) => each.removed);
  const told = removed.map(([name, { value, interval }]) => `${name} ${[value].flat().map((one, i) => fixed(one, Array.isArray(value) ? interval?.[i] : interval)).join(', ')}`);
  return told.length ? [told.join('; ')] : [];
}
