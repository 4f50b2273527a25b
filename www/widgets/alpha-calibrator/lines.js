/** Lines for nav2_params.yaml, with numbers in the format of files in every language. */

/**
 * @typedef {[number, number] | null} Interval
 *
 * @typedef {object} Fitted
 * @property {any} calibration of the core
 * @property {number} count of legs
 * @property {string} model
 * @property {string} rule
 * @property {{ distance?: number, angle?: number, duration?: number }} legs
 * @property {string} log names of odometry and reference
 * @property {string} date
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

/** Names of topics and files that a localizer publishes its own estimate by. */
const LOCALIZER = /amcl|locali[sz]|odometry[/_]filtered/i;

/** Checks whether a log is by its name the estimate of a localizer. @param {string} log */
export const isLocalizer = (log) => LOCALIZER.test(log);

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

/** Prints a fraction in percent. @param {number | null} fraction */
export const percent = (fraction) => (fraction !== null && Number.isFinite(fraction) ? `${short(100 * fraction)} %` : NONE);

/** Upper end of an interval. @param {Interval | undefined} interval */
const mostOf = (interval) => short(interval?.[1] ?? null, OF_WIDTH);

/** Multiplies an interval. @param {Interval} interval @param {number} factor @returns {Interval} */
const scaled = (interval, factor) => interval && [factor * interval[0], factor * interval[1]];

/** Prints an α times a factor, or its upper bound if it is not significantly different from 0. @param {number | null} alpha @param {Interval} interval */
export const alphaOrBound = (alpha, interval, factor = 1) => (isZero(alpha, interval) ? `≤ ${mostOf(scaled(interval, factor))}` : fixed(alpha && factor * alpha, scaled(interval, factor)));

/**
 * Returns why an α is not identifiable, and the drive that would identify it.
 *
 * @param {typeof import('./en.js').en.alphas.lacking} lacking
 * @param {string} model
 * @param {keyof typeof lacking} reason
 */
export function adviceOf(lacking, model, reason) {
  const { lack, drive, byCommands } = lacking[reason];
  return { lack, drive: model === 'velocity' ? byCommands : drive };
}

/**
 * Returns the reason whose advice would distinguish an α from 0.
 *
 * @param {string} model
 * @param {number} index of the α, from 0
 * @returns {'insufficient-rotation' | 'insufficient-translation'}
 */
export function neededFor(model, index) {
  const isOfRotation = model === 'velocity' ? index % 2 === 1 : index === 0 || index === 3;
  return isOfRotation ? 'insufficient-rotation' : 'insufficient-translation';
}

/**
 * Lines with the recommended α's; the fitted ones stand in comments.
 *
 * @param {Fitted} fitted
 * @param {Words} say
 * @returns {string[]} none if Nav2 has no such model, or no α's are recommended
 */
export function nav2Lines({ calibration, count, model, rule, legs, log, date }, say) {
  const { alphas, intervals, recommended, systematicErrors, diagnostics: { checks, windows: [window] } } = calibration;
  if (!Object.hasOwn(NAV2, model) || recommended === null) return [];
  const { inflation } = recommended;
  const { distance, angle, duration } = legs;
  const failed = failedOf(checks).map(({ name }) => name).join(', ');
  const notes = [
    say.of(String(count), duration === undefined ? say.moved(short(distance ?? null), short(angle ?? null)) : say.lasted(short(duration)), log, date),
    say.recommended(short(inflation), percent(window.coverage), String(window.count)),
    ...(model !== 'odometry' || ITS_RULES.includes(rule) ? [] : [say.otherRule]),
    ...correctionOf(systematicErrors).map((errors) => say.corrected(errors)),
    ...(failed ? [say.failed(failed)] : []),
    ...(isLocalizer(log) ? [say.localizer] : []),
  ];
  const lines = alphas.map((/** @type {number | null} */ alpha, /** @type {number} */ i) => {
    const interval = intervals[i];
    if (alpha === null) return `# alpha${i + 1}: ${say.notIdentifiable}`;
    if (isZero(alpha, interval)) return `# alpha${i + 1}: ${say.zero(mostOf(scaled(interval, inflation)))}`;
    const value = fixed(inflation * alpha, scaled(interval, inflation));
    if (inflation * alpha > MOST) return `# alpha${i + 1}: ${value}, ${say.tooLarge}`;
    return `alpha${i + 1}: ${double(value)}  # ${say.fitted(fixed(alpha, interval), between(interval))}`;
  });
  // A line break in a file's name would end the comment.
  const comments = notes.map((note) => `# ${note.replaceAll(/\s+/g, ' ')}`);
  const fifth = alphas.length < 5 ? [`# ${say.fifth}`] : [];
  const triggers = duration === undefined ? [`update_min_d: ${double(short(distance ?? null))}`, `update_min_a: ${double(short(angle ?? null))}`] : [];
  const all = [...comments, `robot_model_type: "${NAV2[model]}"`, ...lines, ...fifth, ...triggers];
  return ['amcl:', '  ros__parameters:', ...all.map((line) => `    ${line}`)];
}

/** Checks that failed. @param {{ name: string, passed: boolean, message: string }[]} checks */
export const failedOf = (checks) => checks.filter(({ passed }) => !passed);

/**
 * Lists the systematic errors that were corrected: the odometry of the robot still has them.
 *
 * @param {any} systematicErrors
 * @returns {string[]} one, or none
 */
function correctionOf(systematicErrors) {
  const corrected = Object.entries(systematicErrors).filter(([, each]) => each.corrected);
  const list = corrected.map(([name, { value, interval }]) => `${name} ${[value].flat().map((one, i) => fixed(one, Array.isArray(value) ? interval[i] : interval)).join(', ')}`);
  return list.length ? [list.join('; ')] : [];
}
