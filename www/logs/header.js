/** Columns of a table, by the names that people and recorders give them. */

import { LogError, cut, listed } from './log-error.js';

/**
 * @import { Place } from './log-error.js'
 *
 * @typedef {'seconds' | 'nanoseconds' | 't' | 'x' | 'y' | 'yaw' | 'qx' | 'qy' | 'qz' | 'qw' | 'v' | 'omega'} Field
 *
 * @typedef {object} Layout where the fields of a row are
 * @property {'poses' | 'commands'} kind
 * @property {boolean} hasBoth whether the table has those of the other kind too
 * @property {Field[]} fields that are read, the time first
 * @property {number[]} columns from 0, of each of them
 * @property {string[]} names of these columns, as the header has them
 * @property {'s' | 'ms' | 'us' | 'ns' | undefined} unit of the time, where its name tells it
 * @property {boolean} degrees whether the heading is in them
 */

/**
 * Patterns of the names of each field, the likeliest first. Names are in small letters, with dots between their parts: exported
 * recordings have paths such as pose.pose.position.x or field.header.stamp.
 *
 * @type {Record<Field, RegExp[]>}
 */
const NAMES = {
  seconds: [/^(header\.)?stamp\.(secs?|seconds)$/, /\.stamp\.(secs?|seconds)$/, /^(.+\.)?(secs?|seconds)$/],
  nanoseconds: [/^(header\.)?stamp\.(nano?secs?|nsecs?|nanoseconds)$/, /\.stamp\.(nano?secs?|nsecs?|nanoseconds)$/, /^(.+\.)?(nano?secs?|nsecs?|nanoseconds)$/],
  t: [/^(header\.)?stamp$/, /\.header\.stamp$/, /^timestamp$/, /^time$/, /^t$/, /^(.+\.)?(timestamp|stamp)$/, /^(.+\.)?time$/],
  x: [/^x$/, /^(.+\.)?(position|translation|pos|location)\.x$/, /^(.+\.)?pose\.x$/, /^(pos|p|t)x$/, /^p\.(.+\.)?x$/, /^(base|robot|odom|gt|truth)\.x$/],
  y: [/^y$/, /^(.+\.)?(position|translation|pos|location)\.y$/, /^(.+\.)?pose\.y$/, /^(pos|p|t)y$/, /^p\.(.+\.)?y$/, /^(base|robot|odom|gt|truth)\.y$/],
  yaw: [/^(yaw|theta|heading|phi|psi|θ)$/, /^(.+\.)?(yaw|theta|heading)$/],
  qx: [/^q\.?x$/, /^(.+\.)?(orientation|rotation|quaternion|quat|rot)\.x$/, /^q\.(.+\.)?x$/, /^(.+\.)?qx$/],
  qy: [/^q\.?y$/, /^(.+\.)?(orientation|rotation|quaternion|quat|rot)\.y$/, /^q\.(.+\.)?y$/, /^(.+\.)?qy$/],
  qz: [/^q\.?z$/, /^(.+\.)?(orientation|rotation|quaternion|quat|rot)\.z$/, /^q\.(.+\.)?z$/, /^(.+\.)?qz$/],
  qw: [/^q\.?w$/, /^(.+\.)?(orientation|rotation|quaternion|quat|rot)\.w$/, /^q\.(.+\.)?w$/, /^(.+\.)?qw$/],
  v: [/^v$/, /^(.+\.)?linear\.x$/, /^(linear(\.velocity)?|velocity|speed|vx|lin)$/, /^(.+\.)?(linear\.velocity\.x|vx)$/],
  omega: [/^(omega|w|ω)$/, /^(.+\.)?angular\.z$/, /^(angular(\.velocity)?|yaw\.?rate|turn\.?rate|wz|ang)$/, /^(.+\.)?(angular\.velocity\.z|wz)$/],
};

/** Units at the end of a name. */
const UNITS = /** @type {const} */ ([
  ['ns', /(^|[._ ([])(ns|nsecs?|nano?secs?|nanoseconds?)[)\]]?$/],
  ['us', /(^|[._ ([])(us|µs|μs|usecs?|microsecs?|microseconds?)[)\]]?$/],
  ['ms', /(^|[._ ([])(ms|msecs?|millisecs?|milliseconds?)[)\]]?$/],
  ['s', /(^|[._ ([])(s|secs?|seconds?)[)\]]?$/],
]);

const DEGREES = /(^|[._ ([])(deg|degrees?|°)[)\]]?$/;

/** Unit at the end of a name. */
const SUFFIX = /[._ ]*[([]?(?<=[._ ([])(ns|nsecs?|us|µs|μs|usecs?|ms|msecs?|s|secs?|nano?seconds?|microseconds?|milliseconds?|seconds?|m|rad|deg|degrees?|°|m\/s|rad\/s)?[)\]]?$/;

/**
 * @param {string} name
 * @param {boolean} whole whether a unit is a part of it, as in stamp.sec
 */
function plain(name, whole) {
  const small = name.trim().toLowerCase().replace(/^%/, '').replace(/^field\./, '');
  const path = (whole ? small : small.replace(SUFFIX, '')).replaceAll(/[_/:\s]+/g, '.');
  return path.replace(/^\.+|\.+$/g, '');
}

/**
 * @param {string[]} names of the columns
 * @param {Place} place of the header
 * @param {'poses' | 'commands' | undefined} wanted commands if they are there, poses alone, or where nothing is said poses if they are there
 * @returns {Layout}
 * @throws {LogError} where a field is missing, or two columns are it
 */
export function layoutOf(names, place, wanted) {
  const columns = listed(names);
  /** @type {Partial<Record<Field, number>>} */
  const found = {};
  for (const field of /** @type {Field[]} */ (Object.keys(NAMES))) {
    const at = columnOf(field, names, place);
    if (at !== undefined) found[field] = at;
  }
  const hasBoth = found.seconds !== undefined && found.nanoseconds !== undefined;
  // A stamp in two columns is that of the message; one in a single column may be when it was written down.
  const time = /** @type {Field[]} */ (hasBoth ? ['seconds', 'nanoseconds'] : ['t']);
  if (!hasBoth && found.t === undefined) throw new LogError(place, (say) => say.noTime(columns));
  const has = (/** @type {Field[]} */ ...fields) => fields.every((field) => found[field] !== undefined);
  const hasCommands = wanted !== 'poses' && has('v', 'omega');
  const isPose = has('x', 'y') && !(wanted === 'commands' && hasCommands);
  if (isPose && !has('yaw') && !has('qz', 'qw')) throw new LogError(place, (say) => say.noHeading(columns));
  if (!isPose && !hasCommands) throw new LogError(place, (say) => say.noColumns(wanted === 'poses' ? wanted : 'either', columns));
  /** @type {Field[]} */
  const rotation = has('yaw') ? ['yaw'] : has('qx', 'qy') ? ['qx', 'qy', 'qz', 'qw'] : ['qz', 'qw'];
  const fields = [...time, ...(isPose ? /** @type {Field[]} */ (['x', 'y', ...rotation]) : /** @type {Field[]} */ (['v', 'omega']))];
  const read = fields.map((field) => /** @type {number} */ (found[field]));
  const [first] = hasBoth ? [''] : [names[read[0]].trim().toLowerCase()];
  return {
    kind: isPose ? 'poses' : 'commands',
    hasBoth: hasCommands && has('x', 'y') && (has('yaw') || has('qz', 'qw')),
    fields,
    columns: read,
    names: read.map((at) => names[at].trim()),
    unit: hasBoth ? 's' : UNITS.find(([, pattern]) => pattern.test(first))?.[0],
    degrees: has('yaw') && DEGREES.test(names[found.yaw ?? 0].trim().toLowerCase()),
  };
}

/** @param {Field} field @param {string[]} names @param {Place} place @returns {number | undefined} */
function columnOf(field, names, place) {
  const whole = field === 'seconds' || field === 'nanoseconds';
  const paths = names.map((name) => plain(name, whole));
  for (const pattern of NAMES[field]) {
    const matches = paths.flatMap((path, at) => (pattern.test(path) ? [at] : []));
    if (matches.length === 1) return matches[0];
    if (matches.length > 1) {
      // A message's own field has a shorter path than that of a message inside of it. Two messages are ambiguous.
      const [own, ...others] = matches.toSorted((a, b) => paths[a].length - paths[b].length);
      const stranger = others.find((other) => !paths[other].endsWith(`.${paths[own]}`));
      if (stranger === undefined) return own;
      throw new LogError(place, (say) => say.twice(field, cut(names[own].trim()), cut(names[stranger].trim())));
    }
  }
  return undefined;
}

/** Checks for a header: some cell is no number. @param {string[]} cells */
export const isHeader = (cells) => cells.some((cell) => /[a-zθω]/i.test(cell) && !/^[+-]?(nan|inf(inity)?|[\d.]+e[+-]?\d+)$/i.test(cell.trim()));
