/** Logs in text: CSV with a header, and TUM with eight numbers a row. */

import { isHeader, layoutOf } from './header.js';
import { LogError, bytesOf, cut } from './log-error.js';
import { numberOf, timeOf } from './numbers.ts';
import { headingOf, isRotation } from './quaternion.ts';
import { Rows } from './rows.ts';

/**
 * @import { Layout } from './header.js'
 * @import { Place, Words } from './log-error.js'
 * @import { Log, Source, TimeUnit } from './log.ts'
 *
 * @typedef {object} Format
 * @property {'csv' | 'tum'} name
 * @property {string} separator of cells; a blank stands for any number of blanks and tabs
 * @property {Layout} layout
 * @property {number} width cells of the header
 * @property {number} needed cells of a row
 * @property {boolean} isHeader whether the line that defined the format is a header and no row
 */

/** Bytes that are read and parsed before the page can paint: about 50 ms. */
const PIECE = 2 ** 22;

/** Most characters of a line: a row of a thousand columns. */
const LONGEST = 2 ** 16;

/** Units of time by the powers of ten that a second has of them. */
const UNITS = /** @type {const} */ ({ s: 0, ms: 3, us: 6, ns: 9 });

/** Least size of a time in each unit: 1e11 s is the year 5138. */
const SIZES = /** @type {const} */ ([['ns', 1e17], ['us', 1e14], ['ms', 1e11]]);

/** Lines in which cells are counted to detect decimal commas. */
const COUNTED = 100;

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

/**
 * Reads a table.
 *
 * @param {Source} source
 * @param {'poses' | 'commands' | undefined} wanted
 * @param {(share: number) => void} [onProgress]
 * @returns {Promise<Log>} rejects with a LogError
 */
export async function readTable(source, wanted, onProgress) {
  const table = new Table(source.name, wanted);
  const decoder = new TextDecoder();
  let rest = '';
  for (let at = 0; at < source.size; at += PIECE) {
    const bytes = await bytesOf(source, at, Math.min(at + PIECE, source.size));
    onProgress?.(at / source.size);
    const text = decoder.decode(bytes, { stream: true });
    if (text.includes('\0')) throw new LogError({ file: source.name }, (say) => say.binary);
    const lines = (rest + text).split('\n');
    rest = lines.pop() ?? '';
    for (const line of lines) table.take(line, false);
    if (rest.length > LONGEST) table.take(rest, false);
  }
  table.take(rest, true);
  return table.end();
}

/**
 * Detects the format and the columns of a table.
 *
 * @param {Source} source
 * @returns {Promise<Format>} rejects with a LogError
 */
export async function headerOf(source) {
  const bytes = await bytesOf(source, 0, Math.min(4 * LONGEST, source.size));
  const place = { file: source.name };
  const text = new TextDecoder().decode(bytes);
  if (text.includes('\0')) throw new LogError(place, (say) => say.binary);
  let comment = '';
  for (const [i, line] of text.split('\n').entries()) {
    const trimmed = line.trim();
    if (trimmed.startsWith('#')) comment = trimmed.slice(1);
    else if (trimmed !== '') {
      if (line.length > LONGEST) throw new LogError({ ...place, line: i + 1 }, (say) => say.longLine(LONGEST));
      return formatOf(trimmed, comment, { ...place, line: i + 1 }, undefined);
    }
  }
  throw new LogError(place, (say) => say.empty);
}

/** Table that is read line by line. */
class Table {
  #file;
  #wanted;
  #rows;
  #line = 0;
  /** Last comment, which may be the header. */
  #comment = '';
  /** @type {Format | undefined} */
  #format;
  /** @type {TimeUnit | undefined} */
  #unit;
  #cutShort = false;
  /** Numbers of the present row. */
  #values = new Float64Array(8);

  /** @param {string} file its name @param {'poses' | 'commands' | undefined} wanted */
  constructor(file, wanted) {
    this.#file = file;
    this.#wanted = wanted;
    this.#rows = new Rows({ file });
  }

  /** @param {string} line @param {boolean} isOpen whether no line feed ends it: the file may have been cut off there */
  take(line, isOpen) {
    this.#line += 1;
    if (line.length > LONGEST) this.#refuse((say) => say.longLine(LONGEST));
    const trimmed = line.trim();
    if (trimmed === '') return;
    if (trimmed.startsWith('#')) {
      this.#comment = trimmed.slice(1);
      return;
    }
    if (!this.#format) {
      this.#format = formatOf(trimmed, this.#comment, { file: this.#file, line: this.#line }, this.#wanted);
      this.#unit = this.#format.layout.unit;
      if (this.#format.isHeader) return;
    }
    const { separator, layout, width, needed } = this.#format;
    const cells = cellsOf(line, separator);
    if (separator === ',' && this.#line <= COUNTED) {
      // A decimal comma in each number nearly doubles the cells.
      const count = cellsOf(line.replace(/[,\s]+$/, ''), ',').length;
      if (count > width && count <= 2 * width) this.#refuse((say) => say.wide(count, width));
    }
    if (cells.length >= needed) return this.#add(cells, layout);
    if (!isOpen) this.#refuse((say) => say.cells(cells.length, needed));
    this.#cutShort = true;
    this.#rows.leaveOut('short', this.#line);
  }

  /** @param {string[]} cells @param {Layout} layout */
  #add(cells, { fields, columns, names, kind }) {
    const time = cells[columns[0]];
    if (this.#unit === undefined) {
      const size = Math.abs(numberOf(time) ?? NaN);
      if (size >= 0) this.#unit = SIZES.find(([, least]) => size >= least)?.[0] ?? 's';
    }
    const at = timeOf(time, UNITS[this.#unit ?? 's']);
    if (at === undefined) return this.#refuseNumber(names[0], time);
    const values = this.#values;
    for (let i = 1; i < columns.length; i++) {
      const value = numberOf(cells[columns[i]]);
      if (value === undefined) return this.#refuseNumber(names[i], cells[columns[i]]);
      values[i] = value;
    }
    const inTwo = fields[1] === 'nanoseconds';
    const [seconds, rest] = inTwo ? [at[0], at[1] + values[1] / 1e9] : at;
    const [first, last] = [inTwo ? 2 : 1, columns.length - 1];
    const [x, y] = [values[first], values[first + 1]];
    let heading = 0;
    if (fields[last] === 'qw') {
      const [qz, qw] = [values[last - 1], values[last]];
      const [qx, qy] = last - first === 5 ? [values[last - 3], values[last - 2]] : [0, 0];
      if (!isRotation(qx, qy, qz, qw)) return this.#rows.leaveOut('noRotation', this.#line);
      heading = headingOf(qx, qy, qz, qw);
    } else if (kind === 'poses') heading = values[last];
    this.#rows.add(seconds, rest, x, y, heading, this.#line);
  }

  /** @param {string} name @param {string} cell @returns {never} */
  #refuseNumber(name, cell) {
    this.#refuse((say) => say.number(cut(name), cut(cell.trim())));
  }

  /** @returns {Log} @throws {LogError} if the rows are no log */
  end() {
    if (!this.#format) throw new LogError({ file: this.#file }, (say) => say.empty);
    const { kind, fields, names, unit, degrees } = this.#format.layout;
    const isQuaternion = fields.includes('qw');
    return this.#rows.end(this.#file, kind, {
      units: {
        time: { unit: this.#unit ?? 's', by: unit ? 'name' : 'size' },
        length: { unit: 'm', by: 'usage' },
        angle: { unit: isQuaternion ? 'quaternion' : degrees ? 'deg' : 'rad', by: isQuaternion ? 'format' : degrees ? 'name' : 'usage' },
      },
      clocks: [names[0]],
      columns: Object.fromEntries(fields.map((field, i) => [field, names[i]])),
      notes: this.#cutShort ? [{ name: 'cutShort', values: [] }] : [],
    });
  }

  /** @param {(say: Words['refused']) => string} reason @returns {never} */
  #refuse(reason) {
    throw new LogError({ file: this.#file, line: this.#line }, reason);
  }
}

/**
 * Detects the separator and the columns.
 *
 * @param {string} line first one that is no comment
 * @param {string} comment last one before it
 * @param {Place} place of the line
 * @param {'poses' | 'commands' | undefined} wanted
 * @returns {Format}
 */
function formatOf(line, comment, place, wanted) {
  const count = (/** @type {string} */ separator) => line.split(separator).length;
  const [separator = ' '] = [',', ';', '\t'].filter((each) => count(each) > 1).toSorted((a, b) => count(b) - count(a));
  const [first, above] = [line, comment].map((text) => cellsOf(text, separator).map((cell) => cell.trim()));
  const csv = (/** @type {string[]} */ header) => {
    const layout = layoutOf(header, place, wanted);
    return { name: /** @type {const} */ ('csv'), separator, layout, width: header.length, needed: Math.max(...layout.columns) + 1 };
  };
  if (isHeader(first)) return { ...csv(first), isHeader: true };
  if (separator === ' ' && first.length === 8) return { name: 'tum', separator, layout: TUM, width: 8, needed: 8, isHeader: false };
  if (above.length === first.length && isHeader(above)) return { ...csv(above), isHeader: false };
  throw new LogError(place, (say) => say.header(cut(line)));
}

/** @param {string} line @param {string} separator; those in quotes separate nothing */
function cellsOf(line, separator) {
  const plain = line.includes('"') ? line.replaceAll(/"([^"]*)"/g, (_, quoted) => quoted.replaceAll(separator, '_')) : line;
  return separator === ' ' ? plain.trim().split(/[ \t]+/) : plain.split(separator);
}
