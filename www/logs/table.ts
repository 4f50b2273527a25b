/** Reader of logs in text tables of robots, recorders and spreadsheets. */

import { least } from 'd3-array';
import { type Clock, type Group, type Layout, logLayoutOf } from './columns.ts';
import { type Format, splitCells, detectTableFormat } from './format.ts';
import { LogError, readBytes, truncate, listNames, type ErrorPlace } from './log-error.ts';
import type { Log, Note, OpenOptions, Recording, Series, Source, Summary, TimeUnit } from './log.ts';
import { type SplitTime, parseDate, parseNumber, parseTime } from './numbers.ts';
import { quantile, sampleEvenly } from './quantile.ts';
import { headingOf, isRotation } from './quaternion.ts';
import { Rows } from './rows.ts';
import { UNIT_EXPONENTS, epochTimeUnitOf } from './units.ts';

/** Number of bytes that are read and parsed at a time. */
const BLOCK_BYTES = 2 ** 22;

/** Number of first bytes, with a preamble and some rows, from which the format is detected. */
const HEAD_BYTES = 2 ** 18;

/** Number of first characters that must not contain a NUL. */
const CHECKED_CHARACTERS = 4096;

/** Maximum number of characters of a line. A row of a thousand columns is shorter. */
const MAX_LINE_LENGTH = 2 ** 16;

/** Maximum fraction of damaged rows. Above it, the log is refused. */
const MAX_DAMAGED_FRACTION = 0.1;

type ErrorReason = ConstructorParameters<typeof LogError>[1];

/** Maximum number of names of frames, topics or robots that a sentence lists. */
const MAX_LISTED_NAMES = 4;

/** Maximum spread of the cosine of the tilt. Above it, the robot does not drive on a plane. */
const MAX_TILT_SPREAD = 0.5;

/** Opens a table; rejects with a LogError. */
export async function openTable(source: Source, options: OpenOptions = {}): Promise<Recording> {
  const encoding = await detectEncoding(source);
  const headText = new TextDecoder(encoding).decode(await readBytes(source, 0, Math.min(HEAD_BYTES, source.size)), { stream: true });
  if (headText.slice(0, CHECKED_CHARACTERS).includes('\0')) throw new LogError({ file: source.name }, (say) => say.binary);
  const headLines = headText.split('\n');
  // The last line may be incomplete. It is dropped unless it is the only one.
  if (source.size > HEAD_BYTES && headLines.length > 1) headLines.pop();
  const format = detectTableFormat(headLines, source.name, options.columns);
  const readableGroups = format.groups.filter(({ kind }) => kind !== null);
  const headerPlace = { file: source.name, line: Math.max(1, format.firstLine - 1) };
  // If no group can be read, `logLayoutOf` throws the reason for the group with most columns.
  if (readableGroups.length === 0) logLayoutOf(format.groups.toSorted((a, b) => Object.keys(b.columns).length - Object.keys(a.columns).length)[0], format.names, headerPlace, undefined);
  const seriesOfGroup = (group: Group): Series => ({
    name: readableGroups.length === 1 && group.kind !== null ? '' : group.name || listNames(columnNames(group)),
    type: listNames(columnNames(group)),
    kind: group.kind,
    hasCommands: group.hasCommands,
    count: 0,
  });
  const allSeries = format.groups.map(seriesOfGroup);
  return {
    name: source.name,
    format: format.name,
    series: allSeries,
    async read(choices, onProgress) {
      const readersOfChoices = choices.map(({ series: seriesName, kind }) => {
        const chosenGroup = readableGroups.length === 1 && seriesName === '' ? readableGroups[0] : format.groups[allSeries.findIndex(({ name }) => name === seriesName)];
        const layout = logLayoutOf(chosenGroup, format.names, headerPlace, kind);
        const name = readableGroups.length === 1 ? source.name : `${source.name}, ${seriesOfGroup(chosenGroup).name}`;
        const readerOf = (group: Group, upAxis?: 'Y' | 'Z') => new LogReader(name, source.name, format, group, upAxis ? logLayoutOf(group, format.names, headerPlace, kind) : layout, options, upAxis);
        return format.hasUnknownAxis ? [readerOf(withYAxisUp(chosenGroup), 'Y'), readerOf(chosenGroup, 'Z')] : [readerOf(chosenGroup)];
      });
      const allReaders = readersOfChoices.flat();
      await readLines(source, encoding, format.firstLine, onProgress, (line, number, isUnterminated) => {
        for (const reader of allReaders) reader.addLine(line, number, isUnterminated);
      });
      // The vertical axis is the one about which the robot turns.
      return readersOfChoices.map((readers) => (least(readers, ({ tiltSpread }) => tiltSpread) as LogReader).end());
    },
  };
}

const columnNames = ({ columns }: Group) => Object.values(columns).toSorted((a, b) => a.at - b.at).map(({ name }) => name);

/** Returns the encoding of a text. Signs are a byte order mark, the zeros of UTF-16, and bytes that UTF-8 does not have. */
async function detectEncoding(source: Source): Promise<string> {
  const bytes = await readBytes(source, 0, Math.min(HEAD_BYTES, source.size));
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

/** Calls `addLine` for each line from number `from` on. `isUnterminated` is true for text after the last line feed: the file may be cut off there. */
async function readLines(source: Source, encoding: string, from: number, onProgress: ((share: number) => void) | undefined, addLine: (line: string, number: number, isUnterminated: boolean) => void) {
  const decoder = new TextDecoder(encoding);
  let [incompleteLine, number] = ['', 0];
  const passLine = (line: string, isUnterminated: boolean) => {
    number += 1;
    if (number >= from) addLine(line, number, isUnterminated);
  };
  for (let at = 0; at < source.size; at += BLOCK_BYTES) {
    onProgress?.(at / source.size);
    const text = incompleteLine + decoder.decode(await readBytes(source, at, Math.min(at + BLOCK_BYTES, source.size)), { stream: true });
    const lines = text.split('\n');
    incompleteLine = lines.pop() ?? '';
    for (const line of lines) passLine(line, false);
    if (incompleteLine.length > MAX_LINE_LENGTH) throw new LogError({ file: source.name, line: number + 1 }, (say) => say.longLine(MAX_LINE_LENGTH));
  }
  passLine(incompleteLine + decoder.decode(), true);
}

/** Returns a group for a file whose vertical axis is Y: its columns z and x are x and y of the robot's plane. */
function withYAxisUp(group: Group): Group {
  const { x, y, z, qx, qy, qz } = group.columns;
  return { ...group, columns: { ...group.columns, x: z, y: x, z: y, qx: qz, qy: qx, qz: qy } };
}

/** Reader of the times of a table. If no unit is stated, the first time that is not 0 determines it. */
class ClockReader {
  #clock: Clock;
  #textOf: (cell: string) => string;
  #isDate: boolean | undefined;
  unit: TimeUnit | undefined;
  by: Summary['units']['time']['by'];
  /** False for dates without a time zone. */
  hasZone = true;

  /** @param textOf returns the text of a cell with a decimal point */
  constructor(clock: Clock, stated: TimeUnit | undefined, textOf: (cell: string) => string) {
    this.#clock = clock;
    this.#textOf = textOf;
    this.unit = stated ?? clock.unit;
    this.by = stated ? 'option' : clock.unit ? 'name' : 'usage';
  }

  /** Returns the time of a row; undefined if its cell is neither a number nor a date. */
  read(cells: string[]): SplitTime | undefined {
    const [{ at }, subseconds] = this.#clock.columns;
    const text = this.#textOf(cells[at]);
    if (subseconds) {
      const [seconds, rest] = [parseTime(text, 0), parseNumber(cells[subseconds.at])];
      return seconds && rest !== undefined ? [seconds[0], seconds[1] + rest / 10 ** UNIT_EXPONENTS[subseconds.unit as TimeUnit]] : undefined;
    }
    if (text.trim() === '') return [NaN, NaN];
    if (this.#isDate === undefined) {
      const dateTime = parseDate(cells[at]);
      this.#isDate = dateTime !== undefined;
      if (dateTime) [this.unit, this.by, this.hasZone] = ['s', 'date', dateTime.hasZone];
    }
    if (this.#isDate) return parseDate(cells[at])?.time;
    if (this.unit === undefined) {
      const timeNumber = parseNumber(text);
      if (timeNumber && Number.isFinite(timeNumber)) {
        this.unit = epochTimeUnitOf(timeNumber) ?? 's';
        if (epochTimeUnitOf(timeNumber)) this.by = 'size';
      }
    }
    return parseTime(text, UNIT_EXPONENTS[this.unit ?? 's']);
  }
}

/** Reader of the log of one series, line by line. */
class LogReader {
  #name: string;
  #place: ErrorPlace;
  #format: Format;
  #layout: Layout;
  #options: OpenOptions;
  /** Vertical axis, if the format does not define it. */
  #upAxis: 'Y' | 'Z' | undefined;
  #rows: Rows;
  #clocks: ClockReader[];
  #textOf: (cell: string) => string;
  /** Number of leading cells of a row that are needed. */
  #neededCells: number;
  #notes: Note[] = [];
  /** Number of damaged rows, and the line and the reason of the first. */
  #damagedRows = 0;
  #firstDamaged: [number, ErrorReason] | undefined;
  /** Columns that name the frames, topic or robot of a row, and names in them. */
  #nameColumns: { at: number }[];
  #rowNames = new Set<string>();
  /** Cosines of the robot's tilt against the assumed vertical axis. */
  #tiltCosines: number[] = [];

  constructor(name: string, file: string, format: Format, group: Group, layout: Layout, options: OpenOptions, upAxis?: 'Y' | 'Z') {
    this.#name = name;
    this.#place = { file };
    this.#format = format;
    this.#layout = layout;
    this.#options = options;
    this.#upAxis = upAxis;
    this.#rows = new Rows(this.#place);
    this.#textOf = format.hasDecimalCommas ? withDecimalPoint : (cell) => cell;
    this.#clocks = layout.clocks.map((clock, i) => new ClockReader(clock, i === 0 ? options.timeUnit : undefined, this.#textOf));
    const { frame, child, source } = group.columns;
    this.#nameColumns = [source, frame, child].filter((column) => column !== undefined);
    const neededColumns = [...layout.columns, ...layout.clocks.flatMap((clock) => clock.columns), ...this.#nameColumns];
    this.#neededCells = Math.max(...neededColumns.map(({ at }) => at)) + 1;
  }

  addLine(line: string, number: number, isUnterminated: boolean): void {
    const { separator, isSparse, header } = this.#format;
    if (/^\s*(?:[#%]|$)/.test(line)) return;
    if (line === header) return this.#rows.drop('text', number);
    const cells = splitCells(line, separator, this.#neededCells);
    if (cells.length < this.#neededCells) {
      if (!isUnterminated) return this.#dropDamaged('short', number, (say) => say.cells(cells.length, this.#neededCells));
      this.#notes.push({ name: 'cutShort', values: [] });
      return this.#rows.drop('short', number);
    }
    // A row of another topic has empty cells in the columns of this one.
    if (isSparse && this.#layout.columns.every(({ at }) => Number.isNaN(parseNumber(cells[at])))) return;
    this.#add(cells, number);
  }

  #add(cells: string[], line: number): void {
    const { clocks, columns, fields } = this.#layout;
    const times: SplitTime[] = [];
    for (let i = 0; i < clocks.length; i++) {
      const time = this.#clocks[i].read(cells);
      if (!time) return this.#dropText(line, clocks[i].name, cells[clocks[i].columns[0].at]);
      times.push(time);
    }
    const values: number[] = [];
    for (const { at, name } of columns) {
      const value = parseNumber(this.#textOf(cells[at]));
      if (value === undefined) return this.#dropText(line, name, cells[at]);
      values.push(value);
    }
    if (this.#nameColumns.length > 0 && this.#rowNames.size <= MAX_LISTED_NAMES) this.#rowNames.add(this.#nameColumns.map(({ at }) => cells[at].trim()).join(' to '));
    const [x, y] = values;
    let heading = values[2] ?? 0;
    if (fields.at(-1) === 'qw') {
      const [qx, qy, qz, qw] = fields.length === 6 ? values.slice(2) : [0, 0, ...values.slice(2)];
      if (!isRotation(qx, qy, qz, qw)) return this.#rows.drop('noRotation', line);
      this.#tiltCosines.push(1 - 2 * (qx * qx + qy * qy));
      heading = headingOf(qx, qy, qz, qw);
    }
    const [[seconds, fraction], [otherSeconds, otherFraction] = [0, 0]] = times;
    this.#rows.add(seconds, fraction, x, y, heading, line, otherSeconds, otherFraction);
  }

  /** Drops a damaged row. If there are many, the log is refused with the reason of the first. */
  #dropDamaged(cause: 'short' | 'text', line: number, reason: ErrorReason): void {
    this.#damagedRows += 1;
    this.#firstDamaged ??= [line, reason];
    this.#rows.drop(cause, line);
  }

  #dropText(line: number, name: string, cell: string): void {
    this.#dropDamaged('text', line, (say) => say.number(truncate(name), truncate(cell.trim())));
  }

  /** Difference of the 95 % and the 5 % quantile of the cosine of the tilt. It is small if the assumed vertical axis is right. */
  get tiltSpread(): number {
    const [low, high] = [0.05, 0.95].map((fraction) => quantile(sampleEvenly(this.#tiltCosines.length, (i) => this.#tiltCosines[i]), fraction));
    return high - low || 0;
  }

  end(): Log {
    const { clocks, columns, fields, kind, length, angle } = this.#layout;
    if (kind === 'positions') throw new LogError(this.#place, (say) => say.positions(listNames(columns.map(({ name }) => name))));
    if (this.#firstDamaged && this.#damagedRows > MAX_DAMAGED_FRACTION * this.#rows.count) {
      const [line, reason] = this.#firstDamaged;
      this.#refuse(line, (say) => [reason(say), ...(this.#damagedRows > 1 && this.#damagedRows < this.#rows.count ? [say.manyBad(this.#damagedRows, this.#rows.count, 100 * MAX_DAMAGED_FRACTION)] : [])].join(' '));
    }
    if (this.#rowNames.size > 1) throw new LogError(this.#place, (say) => say.mixed(listNames([...this.#rowNames])));
    if (this.tiltSpread > MAX_TILT_SPREAD) throw new LogError(this.#place, (say) => say.tilted, { what: 'columns', choices: [], columns: this.#format.names });
    if (this.#upAxis) this.#notes.push({ name: 'upAxis', values: [this.#upAxis] });
    const [{ unit = 's', by, hasZone }] = this.#clocks;
    if (!(unit in UNIT_EXPONENTS)) throw new LogError(this.#place, (say) => say.unknownUnit(truncate(unit)));
    if (!hasZone) this.#notes.push({ name: 'noZone', values: [] });
    const isQuaternion = fields.at(-1) === 'qw';
    return this.#rows.end(this.#name, kind, {
      units: {
        time: { unit, by },
        length: { unit: length ?? 'm', by: length ? 'name' : 'usage' },
        angle: isQuaternion ? { unit: 'quaternion', by: 'format' } : { unit: angle ?? 'rad', by: angle ? 'name' : 'usage' },
      },
      clocks: [clocks[0].name, clocks[1]?.name],
      columns: Object.fromEntries([['t', ''], ...fields.map((field, i) => [field, columns[i].name])]),
      notes: this.#notes,
    }, this.#options);
  }

  #refuse(line: number, reason: ErrorReason): never {
    throw new LogError({ ...this.#place, line }, reason);
  }
}

/** Replaces a decimal comma by a point. A cell that also has a point is ambiguous, and is made invalid by a question mark. */
const withDecimalPoint = (cell: string) => (cell.includes('.') && !cell.includes(':') && /^\s*[+-]?[\d.]+,?\d*\s*$/.test(cell) ? `${cell}?` : cell.replace(',', '.'));
