/** Logs in text: CSV with a header, and TUM's eight numbers a row. */

import { ROWS_A_LOOK, breathing } from '../../../figure/breath.js';
import { isHeader, layoutOf } from './header.js';
import { Lines } from './lines.js';
import { numberIn, textOf, time, timeIn } from './numbers.js';
import { LogError, cut } from './refusal.js';
import { Rows } from './rows.js';

/**
 * @import { Watching } from '../../../figure/breath.js'
 * @import { Layout } from './header.js'
 * @import { Place, Source } from './refusal.js'
 * @import { How, Log } from './rows.js'
 *
 * @typedef {object} Format
 * @property {'csv' | 'tum'} name
 * @property {number} separator its byte; a blank stands for any number of blanks and tabulators
 * @property {Layout} layout
 * @property {number} width cells of the header
 * @property {boolean} isHeader whether the line that told it is no row itself
 */

const [TAB, BLANK, QUOTE, COMMA, HASH, SEMICOLON] = ['\t', ' ', '"', ',', '#', ';'].map((each) => each.charCodeAt(0));

/** By their powers of ten in a second. */
const UNITS = /** @type {const} */ ({ s: 0, ms: 3, us: 6, ns: 9 });

/** From this on, a number is no time in seconds of these centuries but one of the unit: 1e11 s is the year 5138. */
const SIZES = /** @type {const} */ ([['ns', 1e17], ['us', 1e14], ['ms', 1e11]]);

/** The length of a quaternion that is a rotation, give or take. */
const UNLIKE_ONE = 0.1;

/** Lines whose cells are counted: of numbers with commas there are some among them. */
const LOOKED_AT = 100;

/** @type {Layout} */
const TUM = {
  kind: 'poses',
  hasBoth: false,
  fields: ['t', 'x', 'y', 'qx', 'qy', 'qz', 'qw'],
  columns: [0, 1, 2, 4, 5, 6, 7],
  names: ['t', 'x', 'y', 'qx', 'qy', 'qz', 'qw'],
  unit: undefined,
  degrees: false,
};

const utf8 = new TextDecoder();

/** A row's cells are found here: their bytes from and to, of each column that is read. One for all, as there are millions. */
const cells = { from: new Int32Array(16), to: new Int32Array(16), count: 0 };

/**
 * @param {Source} source
 * @param {'poses' | 'commands' | undefined} wanted
 * @param {Watching} watching
 * @returns {Promise<Log>} rejects with a LogError
 */
export async function readTable(source, wanted, watching) {
  const place = { file: source.name };
  const lines = new Lines(source);
  const breathe = breathing(watching);
  const rows = new Rows(place);
  /** @type {Format | undefined} */
  let format;
  /** @type {ReturnType<typeof rowReader> | undefined} */
  let read;
  let comment = '';
  while (lines.step() || (await lines.more())) {
    const [from, to] = trimmed(lines.bytes, lines.from, lines.to);
    if (from === to) continue;
    if (lines.bytes[from] === HASH) {
      comment = format ? '' : utf8.decode(lines.bytes.subarray(from + 1, to));
      continue;
    }
    if (!format) {
      const line = utf8.decode(lines.bytes.subarray(from, to));
      format = formatOf(line, comment, { ...place, line: lines.number }, wanted);
      read = rowReader(format, rows, place);
      if (format.isHeader) continue;
    }
    if (lines.number <= LOOKED_AT && format.separator === COMMA) checkWidth(utf8.decode(lines.bytes.subarray(from, to)), format.width, { ...place, line: lines.number });
    read?.(lines);
    if (lines.number % ROWS_A_LOOK === 0) await breathe(lines.share);
  }
  if (!format || !read) throw new LogError(place, (say) => say.empty);
  const { name, layout } = format;
  /** @type {How} */
  const how = {
    format: name,
    ...read.unit(),
    heading: layout.kind === 'commands' ? 'none' : layout.fields.includes('qw') ? 'quaternion' : layout.degrees ? 'degrees' : 'radians',
    columns: Object.fromEntries(layout.fields.map((field, i) => [field, layout.names[i]])),
    cutShort: read.cutShort(),
    hasBoth: layout.hasBoth,
  };
  return rows.end(source.name, layout.kind, how, breathe);
}

/**
 * @param {string} line the first that is no comment
 * @param {string} comment the last before it
 * @param {Place} place of the line
 * @param {'poses' | 'commands' | undefined} wanted
 * @returns {Format}
 */
function formatOf(line, comment, place, wanted) {
  const marks = [COMMA, SEMICOLON, TAB].filter((each) => countOf(line, each) > 0);
  const [separator = BLANK] = marks.toSorted((a, b) => countOf(line, b) - countOf(line, a));
  const [first, above] = [line, comment].map((each) => split(each, separator));
  if (isHeader(first)) return { name: 'csv', separator, layout: layoutOf(first, place, wanted), width: first.length, isHeader: true };
  if (separator === BLANK && first.length === 8) return { name: 'tum', separator, layout: TUM, width: 8, isHeader: false };
  if (above.length === first.length && isHeader(above)) {
    return { name: 'csv', separator, layout: layoutOf(above, place, wanted), width: above.length, isHeader: false };
  }
  throw new LogError(place, (say) => say.header(cut(line)));
}

/**
 * Where commas are both between cells and in numbers, a row has up to twice as many cells as its header.
 *
 * @param {string} line
 * @param {number} width of the header
 * @param {Place} place of the line
 */
function checkWidth(line, width, place) {
  const count = split(line.replaceAll(/"[^"]*"/g, '').replace(/[,\s]+$/, ''), COMMA).length;
  if (count > width && count <= 2 * width) throw new LogError(place, (say) => say.wide(count, width));
}

/** @param {string} line @param {number} separator */
const countOf = (line, separator) => line.split(String.fromCharCode(separator)).length - 1;

/** @param {string} line @param {number} separator */
function split(line, separator) {
  const all = separator === BLANK ? line.trim().split(/[ \t]+/) : line.split(String.fromCharCode(separator));
  return all.map((cell) => cell.trim().replace(/^"(.*)"$/, '$1').trim());
}

/** @param {Uint8Array} bytes @param {number} from @param {number} to @returns {[number, number]} without blanks on either side */
function trimmed(bytes, from, to) {
  while (from < to && (bytes[from] === BLANK || bytes[from] === TAB)) from += 1;
  while (to > from && (bytes[to - 1] === BLANK || bytes[to - 1] === TAB)) to -= 1;
  return [from, to];
}

/**
 * What reads a row, and then tells the unit of its times.
 *
 * @param {Format} format
 * @param {Rows} rows
 * @param {Place} place of the file
 */
function rowReader({ separator, layout }, rows, place) {
  const { fields, columns, names, kind, degrees } = layout;
  const slots = new Int32Array(Math.max(...columns) + 1).fill(-1);
  columns.forEach((column, slot) => (slots[column] = slot));
  const inTwo = fields[1] === 'nanoseconds';
  const first = inTwo ? 2 : 1;
  const last = fields.length - 1;
  const values = new Float64Array(fields.length);
  /** @type {How['unit'] | undefined} */
  let unit = layout.unit;
  /** @type {How['unitBy']} */
  const unitBy = inTwo || unit ? 'name' : 'size';
  let power = unit && UNITS[unit];
  let cutShort = false;

  /** @param {Lines} lines @param {number} slot @returns {never} */
  const refuse = (lines, slot) => {
    const value = cut(textOf(lines.bytes, cells.from[slot], cells.to[slot]));
    throw new LogError({ ...place, line: lines.number }, (say) => say.number(cut(names[slot]), value));
  };

  /** @param {Lines} lines */
  const read = (lines) => {
    const { bytes, number } = lines;
    if (!find(lines, slots, separator)) {
      if (!lines.isOpen) throw new LogError({ ...place, line: number }, (say) => say.cells(cells.count, slots.length));
      cutShort = true;
      return rows.leaveOut('short', number);
    }
    if (power === undefined) {
      const size = Math.abs(numberIn(bytes, cells.from[0], cells.to[0]));
      if (size >= 0) {
        unit = SIZES.find(([, least]) => size >= least)?.[0] ?? 's';
        power = UNITS[unit];
      }
    }
    if (!timeIn(bytes, cells.from[0], cells.to[0], power ?? 0)) refuse(lines, 0);
    for (let slot = 1; slot <= last; slot++) {
      const value = numberIn(bytes, cells.from[slot], cells.to[slot]);
      if (value === undefined) refuse(lines, slot);
      values[slot] = value;
    }
    const { seconds } = time;
    const rest = inTwo ? time.rest + values[1] / 1e9 : time.rest;
    if (kind === 'commands') return rows.add(seconds, rest, values[first], values[first + 1], 0, number);
    let heading = values[last];
    if (fields[last] === 'qw') {
      const [qz, qw] = [values[last - 1], values[last]];
      const [qx, qy] = last - first === 5 ? [values[last - 3], values[last - 2]] : [0, 0];
      if (!isRotation(qx, qy, qz, qw)) return rows.leaveOut('noRotation', number);
      heading = headingOf(qx, qy, qz, qw);
    } else if (degrees) heading *= Math.PI / 180;
    rows.add(seconds, rest, values[first], values[first + 1], heading, number);
  };
  return Object.assign(read, {
    unit: () => ({ unit: unit ?? 's', unitBy }),
    cutShort: () => cutShort,
  });
}

/**
 * The angle about the vertical axis, whatever the length.
 *
 * @param {number} qx
 * @param {number} qy
 * @param {number} qz
 * @param {number} qw
 */
export function headingOf(qx, qy, qz, qw) {
  return Math.atan2(2 * (qw * qz + qx * qy), qw * qw + qx * qx - qy * qy - qz * qz);
}

/**
 * Whether a quaternion is a rotation, or says that it is none.
 *
 * @param {number} qx
 * @param {number} qy
 * @param {number} qz
 * @param {number} qw
 */
export function isRotation(qx, qy, qz, qw) {
  return !(Math.abs(Math.hypot(qx, qy, qz, qw) - 1) > UNLIKE_ONE);
}

/**
 * Finds the cells of a row.
 *
 * @param {Lines} lines
 * @param {Int32Array} slots of the columns, −1 where they are not read
 * @param {number} separator
 * @returns {boolean} whether it has them all
 */
function find({ bytes, from, to }, slots, separator) {
  let at = from;
  const isBlank = separator === BLANK;
  for (let column = 0; column < slots.length; column++) {
    while (at < to && (bytes[at] === BLANK || (bytes[at] === TAB && separator !== TAB))) at += 1;
    if (isBlank && at >= to) {
      cells.count = column;
      return false;
    }
    let start = at;
    let end;
    if (bytes[at] === QUOTE) {
      start += 1;
      end = bytes.indexOf(QUOTE, start);
      if (end < 0 || end > to) end = to;
      at = end;
    }
    while (at < to && bytes[at] !== separator && !(isBlank && bytes[at] === TAB)) at += 1;
    end ??= at;
    while (end > start && (bytes[end - 1] === BLANK || bytes[end - 1] === TAB)) end -= 1;
    const slot = slots[column];
    if (slot >= 0) {
      cells.from[slot] = start;
      cells.to[slot] = end;
    }
    if (at < to) at += 1;
    else if (column < slots.length - 1) {
      cells.count = column + 1;
      return false;
    }
  }
  return true;
}
