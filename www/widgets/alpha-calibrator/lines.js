/** What came out as the lines of nav2_params.yaml that it is for, and its numbers as files have them, whatever the reader's language. */

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

/** An error as large as the motion that drives it, or of a radian a metre: no robot's, whatever made the log say so. */
const MOST = 1;

/** What stands for a figure that a log is too short for. */
const NONE = '–';

/** What Nav2 calls its models. @type {Record<string, string>} */
const NAV2 = { odometry: 'nav2_amcl::DifferentialMotionModel', omnidirectional: 'nav2_amcl::OmniMotionModel' };

/** Of a reference that is taken for worse than it is, no drive would tell more. */
export const OVERSTATED = 'overstated';

/** Of these nothing is to be taken along. */
const USELESS = ['few-legs', 'unrelated', OVERSTATED];

/** The rules under which Nav2's models are. */
const ITS_RULES = ['nav2', 'omni'];

/** @param {number | null} value */
export const short = (value, digits = DIGITS) => (value !== null && Number.isFinite(value) ? pointed(String(Number(value.toPrecision(digits)))) : NONE);

/** To readers of YAML 1.1 a number with an exponent is a text unless it has a point. @param {string} number */
const pointed = (number) => number.replace(/^(-?\d)e/, '$1.0e');

/** As Nav2 takes it: its parameters are doubles, and it refuses whole numbers. @param {string} number */
const double = (number) => (number.includes('.') ? number : `${number}.0`);

/** As many decimals as an interval has a meaning in. @param {number | null} value @param {Interval | undefined} interval */
export function fixed(value, interval) {
  const width = interval ? interval[1] - interval[0] : 0;
  if (value === null || !(Math.abs(value) < LONG) || !(width > 0 && width < Infinity)) return short(value);
  const decimals = OF_WIDTH - 1 - Math.floor(Math.log10(width));
  if (width >= TINY || Math.abs(value) >= TINY) return value.toFixed(Math.max(0, Math.min(MOST_DECIMALS, decimals)));
  const digits = decimals + Math.floor(Math.log10(Math.abs(value)));
  return digits < 0 ? '0' : pointed(value.toExponential(Math.min(MOST_DECIMALS, digits)));
}

/** Nothing where an end is nowhere. @param {Interval | undefined} interval */
export const between = (interval) => (interval?.every(Number.isFinite) ? interval.map((end) => fixed(end, interval)).join(' to ') : '');

/**
 * Whether an α is nothing beside what is known of it: a zero would look like a result.
 *
 * @param {number | null} alpha
 * @param {Interval | undefined} interval
 */
export const isZero = (alpha, interval) => alpha !== null && Number(fixed(alpha, interval)) === 0;

/** The most that an α may be. @param {Interval | undefined} interval */
export const mostOf = (interval) => short(interval?.[1] ?? null, OF_WIDTH);

/**
 * What the variance that an α belongs to is driven by.
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
 * What a log lacks for an α, and what to drive.
 *
 * @param {typeof import('./en.js').en.alphas.lacking} lacking
 * @param {string} model
 * @param {keyof typeof lacking} reason
 */
export function adviceOf(lacking, model, reason) {
  const { lack, drive, byCommands } = lacking[reason];
  return { lack, drive: model === 'velocity' ? byCommands : drive };
}

/** What would tell an α from 0: more of what drives it. @param {string} model @param {number} index @returns {'turns-too-little' | 'drives-too-little'} */
export const neededFor = (model, index) => (driverOf(model, index) === 'turn' ? 'turns-too-little' : 'drives-too-little');

/**
 * @param {Fitted} fitted
 * @param {Words} say
 * @returns {string[]} none where Nav2 has no such model
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
  // A name may have lines of its own, which would end the comment.
  const comments = notes.map((note) => `# ${note.replaceAll(/\s+/g, ' ')}`);
  const fifth = alphas.length < 5 ? [`# ${say.fifth}`] : [];
  const triggers = duration === undefined ? [`update_min_d: ${double(short(distance ?? null))}`, `update_min_a: ${double(short(angle ?? null))}`] : [];
  const all = [...comments, `robot_model_type: "${NAV2[model]}"`, ...lines, ...fifth, ...triggers];
  return ['amcl:', '  ros__parameters:', ...all.map((line) => `    ${line}`)];
}

/**
 * What was removed is still in the odometry of the robot, in the names that it has in the answer.
 *
 * @param {any} systematic
 * @returns {string[]} one, or none
 */
function correctionOf(systematic) {
  const removed = Object.entries(systematic).filter(([, each]) => each.removed);
  const told = removed.map(([name, { value, interval }]) => `${name} ${[value].flat().map((one, i) => fixed(one, Array.isArray(value) ? interval?.[i] : interval)).join(', ')}`);
  return told.length ? [told.join('; ')] : [];
}
