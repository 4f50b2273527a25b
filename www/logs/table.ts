/** Logs in text: tables as robots, recorders and spreadsheets write them. */

import { type Clock, type Group, type Layout, layoutOf } from './columns.ts';
import { type Format, carmenCells, cellsOf, formatOf } from './format.ts';
import { LogError, bytesOf, cut, listed, type Place } from './log-error.ts';
import type { Basis, Log, Note, OpenOptions, Recording, Series, Source, TimeUnit } from './log.ts';
import { type Time, dateOf, decimalAt, numberOf, timeOf } from './numbers.ts';
import { quantile, sample } from './quantile.ts';
import { headingOf, isRotation } from './quaternion.ts';
import { Rows } from './rows.ts';
import { POWERS, unitOfSize } from './units.ts';

/** Number of bytes that are read and parsed at a time. */
const PIECE = 2 ** 22;

/** Number of bytes from which the format is detected: a preamble and some rows. */
const HEAD = 2 ** 18;

/** Maximum number of characters of a line: a row of a thousand columns. */
const LONGEST = 2 ** 16;

/** Maximum fraction of damaged rows. Above it, the table has another format than assumed, or comes from a broken disk. */
const MAX_BAD = 0.1;

type Reason = ConstructorParameters<typeof LogError>[1];

/** Maximum number of frames that a sentence lists. */
const MOST_FRAMES = 4;

/** Maximum difference of the 95 % and the 5 % quantile of the cosine of the tilt. Above it, the robot does not drive on a plane. */
const TILTS = 0.5;

/** Opens a table; rejects with a LogError. */
export async function openTable(source: Source, options: OpenOptions = {}): Promise<Recording> {
  const encoding = await encodingOf(source);
  const decoded = new TextDecoder(encoding).decode(await bytesOf(source, 0, Math.min(HEAD, source.size)), { stream: true });
  if (decoded.includes('\0')) throw new LogError({ file: source.name }, (say) => say.binary);
  const end = endOf(decoded);
  const lines = decoded.split(end);
  // The last line may be incomplete. It is dropped unless it is the only one.
  if (source.size > HEAD && lines.length > 1) lines.pop();
  const long = lines.findIndex((line) => line.length > LONGEST);
  if (long >= 0) throw new LogError({ file: source.name, line: long + 1 }, (say) => say.longLine(LONGEST));
  const format = formatOf(lines, source.name, options.columns);
  const readable = format.groups.filter(({ kind }) => kind !== null);
  const place = { file: source.name, line: Math.max(1, format.firstLine - 1) };
  // If no group can be read, `layoutOf` throws the reason for the group with most columns.
  if (readable.length === 0) layoutOf(format.groups.toSorted((a, b) => Object.keys(b.columns).length - Object.keys(a.columns).length)[0], format.names, place, undefined);
  const seriesOf = (group: Group): Series => ({
    name: readable.length === 1 && group.kind !== null ? '' : group.name || listed(columnNames(group)),
    type: listed(columnNames(group)),
    kind: group.kind,
    hasCommands: group.hasCommands,
    count: 0,
  });
  const series = format.groups.map(seriesOf);
  return {
    name: source.name,
    format: format.name,
    series,
    async read(choices, onProgress) {
      const readers = choices.map((choice) => {
        const chosen = readable.length === 1 && choice.series === '' ? readable[0] : format.groups[series.findIndex(({ name }) => name === choice.series)];
        const layout = layoutOf(chosen, format.names, place, choice.kind);
        return new LogReader(readable.length === 1 ? source.name : `${source.name}, ${seriesOf(chosen).name}`, { file: source.name }, format, chosen, layout, options);
      });
      await readLines(source, encoding, end, format.firstLine, onProgress, (line, number, isOpen) => {
        for (const reader of readers) reader.take(line, number, isOpen);
      });
      return readers.map((reader) => reader.end());
    },
  };
}

const columnNames = ({ columns }: Group) => Object.values(columns).toSorted((a, b) => a.at - b.at).map(({ name }) => name);

/** Returns the encoding of a text. Signs are a byte order mark, the zeros of UTF-16, and bytes that UTF-8 does not have. */
async function encodingOf(source: Source): Promise<string> {
  const bytes = await bytesOf(source, 0, Math.min(HEAD, source.size));
  const [first, second, third, fourth] = bytes;
  if ((first === 0xff && second === 0xfe) || (first !== 0 && second === 0 && third !== 0 && fourth === 0)) return 'utf-16le';
  if (first === 0xfe && second === 0xff) return 'utf-16be';
  try {
    new TextDecoder('utf-8', { fatal: true }).decode(bytes, { stream: true });
    return 'utf-8';
  } catch {
    return 'windows-1252';
  }
}

/** Returns the character that ends lines: a line feed, or in files of old spreadsheets a carriage return. */
const endOf = (text: string) => (text.includes('\n') || !text.includes('\r') ? '\n' : '\r');

/** Calls `take` for each line from the number `from` on. `isOpen` is true for the text after the last line feed: the file may be cut off there. */
async function readLines(source: Source, encoding: string, end: string, from: number, onProgress: ((share: number) => void) | undefined, take: (line: string, number: number, isOpen: boolean) => void) {
  // Pieces of whole lines are decoded separately. Node would decode a stream into strings of twice the size.
  const decoder = new TextDecoder(encoding);
  const width = encoding.startsWith('utf-16') ? 2 : 1;
  let rest = new Uint8Array();
  let number = 0;
  for (let at = 0; at < source.size; at += PIECE) {
    const piece = await bytesOf(source, at, Math.min(at + PIECE, source.size));
    onProgress?.(at / source.size);
    const bytes = new Uint8Array(rest.length + piece.length);
    bytes.set(rest);
    bytes.set(piece, rest.length);
    const wholeLines = afterLast(bytes, end.charCodeAt(0), width);
    const text = decoder.decode(bytes.subarray(0, wholeLines));
    rest = bytes.slice(wholeLines);
    if (text.includes('\0')) throw new LogError({ file: source.name }, (say) => say.binary);
    const lines = text.split(end);
    lines.pop();
    for (const line of lines) {
      number += 1;
      if (number >= from) take(line, number, false);
    }
    if (rest.length > LONGEST * width) throw new LogError({ file: source.name, line: number + 1 }, (say) => say.longLine(LONGEST));
  }
  const last = decoder.decode(rest);
  if (last.includes('\0')) throw new LogError({ file: source.name }, (say) => say.binary);
  if (number + 1 >= from) take(last, number + 1, true);
}

/** Returns the index of the byte after the last end of a line; 0 if there is none. Characters have one or two bytes. */
function afterLast(bytes: Uint8Array, end: number, width: number): number {
  let at = bytes.lastIndexOf(end);
  // In UTF-16 the other byte of the character is 0.
  while (width === 2 && at >= 0 && bytes[at ^ 1] !== 0) at = at === 0 ? -1 : bytes.lastIndexOf(end, at - 1);
  return at < 0 ? 0 : at - (at % width) + width;
}

/** Reader of the rows of one series. */
class LogReader {
  #name: string;
  #place: Place;
  #format: Format;
  #group: Group;
  #layout: Layout;
  #options: OpenOptions;
  #rows: Rows;
  /** Rows under the assumption that the Y axis is vertical; undefined if it cannot be. */
  #upright: Rows | undefined;
  /** Number of leading cells of a row that are needed. */
  #needed: number;
  #at: number[];
  #values: Float64Array;
  #readTimes: ((cells: string[]) => Time | undefined)[] = [];
  #units: TimeUnit[] = [];
  /** Use of each column in `#takePlain`: index i of a value, −1 − i for a clock, or undefined for other columns. */
  #plain: (number | undefined)[] = [];
  /** Decimal exponents of the units of the clocks in a second; undefined while unknown, and for dates. */
  #powers: (number | undefined)[] = [];
  /** Whole seconds and fraction of a second of each clock, for `#takePlain`. */
  #times = new Float64Array(4);
  /** Basis of the unit of times, if neither a name nor an option states it. */
  #basis: Basis = 'usage';
  #notes: Note[] = [];
  /** Number of damaged rows, and the line and the reason of the first. */
  #bad = 0;
  #firstBad: [number, Reason] | undefined;
  #frames = new Set<string>();
  /** Cosines of the robot's tilt if the vertical axis is Z, and if it is Y. They are near 1 for the actual axis. */
  #tilts: [number[], number[]] = [[], []];
  /** Heights if the vertical axis is Z, and if it is Y. They are nearly constant for the actual axis. */
  #heights: [number[], number[]] = [[], []];

  constructor(name: string, place: Place, format: Format, group: Group, layout: Layout, options: OpenOptions) {
    this.#name = name;
    this.#place = place;
    this.#format = format;
    this.#group = group;
    this.#layout = layout;
    this.#options = options;
    this.#rows = new Rows(place);
    if (format.hasUnknownAxis) this.#upright = new Rows(place);
    const { z } = group.columns;
    const read = this.#upright && z ? [...layout.columns, z] : layout.columns;
    this.#at = read.map(({ at }) => at);
    this.#values = new Float64Array(read.length);
    const { frame, child } = group.columns;
    const all = [...this.#at, ...layout.clocks.flatMap(({ columns }) => columns.map(({ at }) => at)), ...[frame, child].map((column) => column?.at ?? 0)];
    this.#needed = Math.max(...all) + 1;
    const { separator, hasCommas, isSparse } = format;
    if (separator === ' ' || hasCommas || isSparse || frame || child) return;
    for (const [i, at] of this.#at.entries()) this.#plain[at] = i;
    for (const [i, { columns: [{ at }] }] of layout.clocks.entries()) this.#plain[at] = -1 - i;
  }

  take(line: string, number: number, isOpen: boolean): void {
    if (line.length > LONGEST) this.#refuse(number, (say) => say.longLine(LONGEST));
    if (this.#takePlain(line, number)) return;
    const { separator, isSparse } = this.#format;
    const { tag } = this.#group;
    if (tag !== undefined && !line.startsWith(`${tag} `)) return;
    const start = line.trimStart();
    if (start === '' || start[0] === '#' || start[0] === '%') return;
    if (line === this.#format.header) return this.#leaveOut('notFinite', number);
    const cells = tag === undefined ? cellsOf(line, separator, this.#needed) : carmenCells(line);
    if (cells.length < this.#needed) {
      if (!isOpen) return this.#leaveOutBad('short', number, (say) => say.cells(cells.length, this.#needed));
      this.#notes.push({ name: 'cutShort', values: [] });
      return this.#leaveOut('short', number);
    }
    // In a row of another topic the cells of this one are empty.
    if (isSparse && this.#at.every((at) => cells[at].trim() === '')) return;
    this.#add(cells, number);
  }

  #add(cells: string[], line: number): void {
    if (this.#readTimes.length === 0 && !this.#startClocks(cells)) return this.#leaveOut('notFinite', line);
    const times: Time[] = [];
    for (const [i, read] of this.#readTimes.entries()) {
      const time = read(cells);
      if (!time) return this.#leaveOutText(line, this.#layout.clocks[i].name, cells[this.#layout.clocks[i].columns[0].at]);
      times.push(time);
    }
    const values = this.#values;
    const { hasCommas } = this.#format;
    for (let i = 0; i < values.length; i++) {
      const cell = cells[this.#at[i]];
      const value = numberOf(hasCommas ? withPoint(cell) : cell);
      if (value === undefined) return this.#leaveOutText(line, this.#layout.columns[i]?.name ?? 'z', cell);
      values[i] = value;
    }
    const { columns } = this.#group;
    if (this.#frames.size <= MOST_FRAMES && (columns.child || columns.frame)) this.#frames.add([columns.frame, columns.child].flatMap((column) => (column ? [cells[column.at].trim()] : [])).join(' to '));
    this.#addRow(times[0][0], times[0][1], times[1]?.[0] ?? 0, times[1]?.[1] ?? 0, line);
  }

  /** Adds a row of plain numbers in one pass, for speed; returns false for any other row. */
  #takePlain(line: string, number: number): boolean {
    if (this.#plain.length === 0 || this.#powers.length === 0 || line.includes('"')) return false;
    const { separator } = this.#format;
    const end = line.endsWith('\r') ? line.length - 1 : line.length;
    this.#times.fill(0);
    for (let column = 0, at = 0, to = 0; column < this.#needed; column++, at = to + 1) {
      to = line.indexOf(separator, at);
      if (to < 0) to = end;
      if (at > to) return false;
      const place = this.#plain[column];
      if (place === undefined) continue;
      if (place >= 0) {
        const value = decimalAt(line, at, to);
        this.#values[place] = value === value ? value : numberOf(line.slice(at, to)) ?? NaN;
        if (!Number.isFinite(this.#values[place])) return false;
        continue;
      }
      const clock = -1 - place;
      const power = this.#powers[clock];
      if (power === undefined) return false;
      const point = line.indexOf('.', at);
      const hasPoint = point >= 0 && point < to;
      // Whole seconds end at the point. Without a point, they end `power` digits before the end of the cell.
      const split = power === 0 ? (hasPoint ? point : to) : hasPoint ? -1 : to - power;
      if (split <= at) return false;
      const [seconds, rest] = [decimalAt(line, at, split), split === to ? 0 : power === 0 ? decimalAt(line, split, to) : decimalAt(line, split, to) / 10 ** power];
      if (!(seconds >= 0 && rest >= 0)) return false;
      this.#times[2 * clock] = seconds;
      this.#times[2 * clock + 1] = rest;
    }
    this.#addRow(this.#times[0], this.#times[1], this.#times[2], this.#times[3], number);
    return true;
  }

  #addRow(seconds: number, rest: number, otherSeconds: number, otherRest: number, line: number): void {
    const values = this.#values;
    const [x, y] = values;
    const { fields } = this.#layout;
    if (fields.at(-1) !== 'qw') return this.#rows.add(seconds, rest, x, y, values.length > 2 ? values[2] : 0, line, otherSeconds, otherRest);
    const [qx, qy, qz, qw] = fields.length === 6 ? values.subarray(2, 6) : [0, 0, values[2], values[3]];
    if (!isRotation(qx, qy, qz, qw)) return this.#leaveOut('noRotation', line);
    this.#tilts[0].push(1 - 2 * (qx * qx + qy * qy));
    this.#rows.add(seconds, rest, x, y, headingOf(qx, qy, qz, qw), line, otherSeconds, otherRest);
    if (!this.#upright) return;
    const z = values[6];
    this.#tilts[1].push(1 - 2 * (qx * qx + qz * qz));
    this.#heights[0].push(z);
    this.#heights[1].push(y);
    this.#upright.add(seconds, rest, z, x, headingOf(qz, qx, qy, qw), line, otherSeconds, otherRest);
  }

  #leaveOut(cause: 'short' | 'text' | 'noRotation' | 'notFinite', line: number): void {
    this.#rows.leaveOut(cause, line);
    this.#upright?.leaveOut(cause, line);
  }

  /** Drops a damaged row. If there are many, the log is refused with the reason of the first. */
  #leaveOutBad(cause: 'short' | 'text', line: number, reason: Reason): void {
    this.#bad += 1;
    this.#firstBad ??= [line, reason];
    this.#leaveOut(cause, line);
  }

  #leaveOutText(line: number, name: string, cell: string): void {
    this.#leaveOutBad('text', line, (say) => say.number(cut(name), cut(cell.trim())));
  }

  /** Chooses the unit of times by the first row that has one. @returns false if the cell is empty */
  #startClocks(cells: string[]): boolean {
    const { clocks } = this.#layout;
    if (cells[clocks[0].columns[0].at].trim() === '') return false;
    this.#readTimes = clocks.map((clock, i) => this.#timeReader(clock, cells[clock.columns[0].at], i === 0));
    return true;
  }

  #timeReader({ columns: [{ at }, nanoseconds], unit }: Clock, cell: string, isFirst: boolean): (cells: string[]) => Time | undefined {
    const { hasCommas } = this.#format;
    const text = hasCommas ? (cells: string[]) => withPoint(cells[at]) : (cells: string[]) => cells[at];
    if (nanoseconds) {
      this.#units.push('s');
      return (cells) => {
        const [seconds, rest] = [timeOf(text(cells), 0), numberOf(cells[nanoseconds.at])];
        return seconds && rest !== undefined ? [seconds[0], seconds[1] + rest / 1e9] : undefined;
      };
    }
    const date = dateOf(cell);
    if (date) {
      this.#units.push('s');
      if (isFirst) this.#basis = 'date';
      if (isFirst && !date.hasZone) this.#notes.push({ name: 'noZone', values: [] });
      return (cells) => dateOf(cells[at])?.time;
    }
    const knownUnit = (isFirst ? this.#options.timeUnit : undefined) ?? unit;
    const index = this.#units.push(knownUnit ?? 's') - 1;
    const powers = this.#powers;
    powers[index] = knownUnit === undefined ? undefined : POWERS[knownUnit];
    return (cells) => {
      const trimmed = text(cells);
      if (powers[index] === undefined) {
        const size = numberOf(trimmed);
        // A stamp of 0 is no sign of a unit.
        if (size !== undefined && size !== 0 && Number.isFinite(size)) {
          this.#units[index] = unitOfSize(size) ?? 's';
          if (isFirst && unitOfSize(size) !== undefined) this.#basis = 'size';
          powers[index] = POWERS[this.#units[index]];
        }
      }
      return timeOf(trimmed, powers[index] ?? 0);
    };
  }

  end(): Log {
    const { clocks, columns, fields, kind, length, angle } = this.#layout;
    if (kind === 'positions') throw new LogError(this.#place, (say) => say.positions(listed(columns.map(({ name }) => name))));
    if (this.#firstBad && this.#bad > MAX_BAD * this.#rows.count) {
      const [line, reason] = this.#firstBad;
      this.#refuse(line, (say) => [reason(say), ...(this.#bad > 1 && this.#bad < this.#rows.count ? [say.manyBad(this.#bad, this.#rows.count, 100 * MAX_BAD)] : [])].join(' '));
    }
    if (this.#frames.size > 1) throw new LogError(this.#place, (say) => say.mixed(listed([...this.#frames])));
    const upright = this.#upright && this.#hasYUp() ? this.#upright : undefined;
    if (this.#upright) this.#notes.push({ name: 'upAxis', values: [upright ? 'Y' : 'Z'] });
    else if (isTilted(this.#tilts[0])) throw new LogError(this.#place, (say) => say.tilted, { what: 'columns', choices: [], columns: this.#format.names });
    const isQuaternion = fields.at(-1) === 'qw';
    const { timeUnit } = this.#options;
    return (upright ?? this.#rows).end(this.#name, kind, {
      units: {
        time: { unit: this.#units[0] ?? 's', by: this.#basis === 'date' ? 'date' : timeUnit ? 'option' : clocks[0].unit ? 'name' : this.#basis },
        length: { unit: length ?? 'm', by: length ? 'name' : 'usage' },
        angle: isQuaternion ? { unit: 'quaternion', by: 'format' } : { unit: angle ?? 'rad', by: angle ? 'name' : 'usage' },
      },
      clocks: [clocks[0].name, clocks[1]?.name],
      columns: Object.fromEntries([['t', clocks[0].name], ...fields.map((field, i) => [field, columns[i].name])]),
      notes: this.#notes,
    }, this.#options);
  }

  /** Returns true if the Y axis of Motive is vertical. The robot turns about the vertical axis, and hardly moves along it. */
  #hasYUp(): boolean {
    const [z, y] = this.#heights.map(spread);
    const isTurning = this.#tilts.map(isTilted);
    if (isTurning[0] && isTurning[1]) throw new LogError(this.#place, (say) => say.tilted, { what: 'columns', choices: [], columns: this.#format.names });
    return isTurning[0] || (!isTurning[1] && y <= z);
  }

  #refuse(line: number, reason: Reason): never {
    throw new LogError({ ...this.#place, line }, reason);
  }
}

/** Returns a number with a decimal comma as one with a point. A cell that also has a point is ambiguous: a question mark makes it invalid. */
const withPoint = (cell: string) => (cell.includes('.') && !cell.includes(':') && /^\s*[+-]?[\d.]+,?\d*\s*$/.test(cell) ? `${cell}?` : cell.replace(',', '.'));

const spread = (values: number[]) => {
  const some = sample(values.length, (i) => values[i]).filter(Number.isFinite);
  return quantile(some, 0.95) - quantile(some, 0.05);
};

const isTilted = (tilts: number[]) => spread(tilts) > TILTS;
