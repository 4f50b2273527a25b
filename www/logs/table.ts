/** Reader of logs in text tables of robots, recorders and spreadsheets. */

import { COLUMN_CHANGES, changeColumns, findLogLayout, type Clock, type ColumnGroup, type Field } from './columns.ts';
import { splitCells, detectTableFormat, parseDate, parseNumber, parseTime, type TableFormat } from './format.ts';
import { LogError, readBytes, truncate, listNames, type ErrorPlace, type Log, type Note, type OpenOptions, type OptionsByName, type Recording, type Series, type Source, type Summary, type TimeUnit } from './log.ts';
import { rotationOf, type Quaternion } from './path.ts';
import { RowCollector } from './rows.ts';
import { UNIT_EXPONENTS, epochTimeUnitOf } from './units.ts';

const BLOCK_BYTES = 2 ** 22;

/** Number of bytes at the start of a file from which the format is detected. They contain the preamble and some rows. */
const HEAD_BYTES = 2 ** 18;

/** Number of characters at the start of a text that are checked for NUL characters. */
const CHECKED_CHARACTERS = 4096;

/** Maximum number of characters in a line. A row of a thousand columns is shorter. */
const MAX_LINE_LENGTH = 2 ** 16;

/** Changes of a table's columns that make Z the vertical axis: for a file with Y up, or with quaternions that start with w. */
type TiltChange = 'yUp' | 'wFirst';

/** Limits for reading columns in another order: minimum spread of the cosine of Z's tilt (noise has less), and maximum spread in the new order, relative to that in the old order. */
const [MIN_TILT_SPREAD, MAX_TILT_RATIO] = [0.001, 0.1];

/** Minimum number of rows with equally many decimals in the last column. If the last row after them has fewer decimals, the file is cut off. */
const MIN_UNIFORM_ROWS = 20;

export async function openTable(source: Source, optionsOf: OptionsByName): Promise<Recording> {
  const headBytes = await readBytes(source, 0, Math.min(HEAD_BYTES, source.size));
  const encoding = detectEncoding(headBytes);
  const headText = new TextDecoder(encoding).decode(headBytes, { stream: true });
  if (headText.slice(0, CHECKED_CHARACTERS).includes('\0')) throw new LogError({ file: source.name }, (texts) => texts.unknownFormatReason);
  const headLines = headText.split('\n');
  // The last line of the sampled text may be incomplete. It is dropped unless it is the only line.
  if (source.size > HEAD_BYTES && headLines.length > 1) headLines.pop();
  const format = detectTableFormat(headLines, source.name, optionsOf(source.name)?.columns);
  const readableGroups = format.columnGroups.filter(({ kind }) => kind !== null);
  const headerPlace = { file: source.name, line: Math.max(1, format.firstRowNumber - 1) };
  // This call throws a LogError: it gives the reason why the group with most columns cannot be read.
  if (readableGroups.length === 0) findLogLayout(format.columnGroups.toSorted((a, b) => Object.keys(b.columns).length - Object.keys(a.columns).length)[0], format.columnNames, headerPlace, undefined);
  const seriesOfGroup = (group: ColumnGroup): Series => ({
    name: readableGroups.length === 1 && group.kind !== null ? '' : group.name || listNames(columnNamesOf(group)),
    type: listNames(columnNamesOf(group)),
    kind: group.kind,
    hasCommands: group.hasCommands,
    count: 0,
  });
  const allSeries = format.columnGroups.map(seriesOfGroup);
  return {
    name: source.name,
    format: 'csv',
    series: allSeries,
    async read(choices, onProgress) {
      /** Reads the chosen logs. With a change of columns, it reads only logs that have all columns of the change. */
      const readWith = async (changeName?: TiltChange) => {
        const readers = choices.map(({ series: seriesName, kind }) => {
          const chosenGroup = format.columnGroups[allSeries.findIndex(({ name }) => name === seriesName)];
          const name = readableGroups.length === 1 ? source.name : `${source.name}, ${seriesOfGroup(chosenGroup).name}`;
          if (changeName && !(Object.keys(COLUMN_CHANGES[changeName][0]) as Field[]).every((field) => chosenGroup.columns[field])) return undefined;
          const group = changeName ? { ...chosenGroup, columns: changeColumns(chosenGroup.columns, COLUMN_CHANGES[changeName]) } : chosenGroup;
          return createLogReader(name, { file: source.name }, format, group, findLogLayout(group, format.columnNames, headerPlace, kind), optionsOf(name), chosenGroup.columns, changeName);
        });
        await readLines(source, encoding, format.firstRowNumber, onProgress, (line, number, isUnterminated) => {
          for (const reader of readers) reader?.addLine(line, number, isUnterminated);
        });
        return readers;
      };
      let readers = (await readWith()) as LogReader[];
      // A robot turns about its vertical axis, so that the tilt of this axis hardly varies. Columns are read in another order if the tilt of Z then varies far less.
      for (const changeName of ['yUp', 'wFirst'] as const) {
        if (!readers.some(({ rows }) => rows.tiltCosineSpread > MIN_TILT_SPREAD)) break;
        const changedReaders = await readWith(changeName);
        readers = readers.map((reader, i) => {
          const changedReader = changedReaders[i];
          return changedReader && changedReader.rows.tiltCosineSpread < MAX_TILT_RATIO * reader.rows.tiltCosineSpread ? changedReader : reader;
        });
      }
      return readers.map((reader) => reader.buildLog());
    },
  };
}

const columnNamesOf = ({ columns }: ColumnGroup) => Object.values(columns).toSorted((a, b) => a.index - b.index).map(({ name }) => name);

/** Detects the encoding of a text from a byte order mark, the zero bytes of UTF-16, or bytes that are invalid in UTF-8. */
function detectEncoding(bytes: Uint8Array): string {
  const [byte0, byte1, byte2, byte3] = bytes;
  if ((byte0 === 0xff && byte1 === 0xfe) || (byte0 !== 0 && byte1 === 0 && byte2 !== 0 && byte3 === 0)) return 'utf-16le';
  if (byte0 === 0xfe && byte1 === 0xff) return 'utf-16be';
  try {
    new TextDecoder('utf-8', { fatal: true }).decode(bytes, { stream: true });
    return 'utf-8';
  } catch {
    return 'windows-1252';
  }
}

/** Calls `addLine` for each line from `firstLineNumber` on. `isUnterminated` is true for a last line without a line feed, because the file may be cut off there. */
async function readLines(source: Source, encoding: string, firstLineNumber: number, onProgress: ((fraction: number) => void) | undefined, addLine: (line: string, number: number, isUnterminated: boolean) => void) {
  const decoder = new TextDecoder(encoding);
  let [incompleteLine, number] = ['', 0];
  const passLine = (line: string, isUnterminated: boolean) => {
    number += 1;
    if (number >= firstLineNumber) addLine(line, number, isUnterminated);
  };
  for (let position = 0; position < source.size; position += BLOCK_BYTES) {
    onProgress?.(position / source.size);
    const text = incompleteLine + decoder.decode(await readBytes(source, position, Math.min(position + BLOCK_BYTES, source.size)), { stream: true });
    const lines = text.split('\n');
    incompleteLine = lines.pop() ?? '';
    for (const line of lines) passLine(line, false);
    if (incompleteLine.length > MAX_LINE_LENGTH) throw new LogError({ file: source.name, line: number + 1 }, (texts) => texts.longLineReason(MAX_LINE_LENGTH));
  }
  passLine(incompleteLine + decoder.decode(), true);
}

/** Returns a reader of the times of a table. If the unit is not stated, the reader judges it by the size of the first time that is not 0. */
function createClockReader({ columns: [{ index }, subseconds], unit: namedUnit }: Clock, statedUnit: TimeUnit | undefined, normalizeCell: (cell: string) => string) {
  const unitBasis = statedUnit ? 'option' : namedUnit ? 'name' : 'usage';
  const judgedUnit: { unit?: TimeUnit; by: Summary['units']['time']['by'] } = { unit: statedUnit ?? namedUnit, by: unitBasis };
  let isDate: boolean | undefined;
  /** Returns the time of a row in seconds; undefined if the row's cell contains neither a number nor a date. */
  const readTime = (cells: string[]): number | undefined => {
    const text = normalizeCell(cells[index]);
    if (subseconds) {
      const [seconds, subsecondTicks] = [parseNumber(text), parseNumber(cells[subseconds.index])];
      return seconds !== undefined && subsecondTicks !== undefined ? seconds + subsecondTicks / 10 ** UNIT_EXPONENTS[subseconds.unit as TimeUnit] : undefined;
    }
    if (text.trim() === '') return NaN;
    if (isDate === undefined) {
      isDate = parseDate(cells[index]) !== undefined;
      if (isDate) Object.assign(judgedUnit, { unit: 's', by: 'date' });
    }
    if (isDate) return parseDate(cells[index]);
    if (judgedUnit.unit === undefined) {
      const timeNumber = parseNumber(text);
      const epochUnit = timeNumber && epochTimeUnitOf(timeNumber);
      if (epochUnit) Object.assign(judgedUnit, { unit: epochUnit, by: 'size' });
      else if (timeNumber) judgedUnit.unit = 's';
    }
    return parseTime(text, UNIT_EXPONENTS[judgedUnit.unit ?? 's']);
  };
  return { judgedUnit, readTime };
}

type LogReader = ReturnType<typeof createLogReader>;

/** Returns a reader of the log of one series, line by line. `namedColumns` are the original columns; the columns in `group` may have been changed. */
function createLogReader(name: string, errorPlace: ErrorPlace, format: TableFormat, group: ColumnGroup, layout: ReturnType<typeof findLogLayout>, options: OpenOptions = {}, namedColumns: ColumnGroup['columns'], changeName?: TiltChange) {
  const { separator, hasDecimalCommas, isSparse, columnNames } = format;
  const { clocks, columns, fields, kind, lengthUnit, angleUnit } = layout;
  const rows = new RowCollector(errorPlace);
  const notes: Note[] = changeName ? [{ name: changeName, values: [] }] : [];
  const normalizeCell = hasDecimalCommas ? withDecimalPoint : (cell: string) => cell;
  const clockReaders = clocks.map((clock, i) => createClockReader(clock, i === 0 ? options.timeUnit : undefined, normalizeCell));
  // Columns with the frames, the topic or the robot of a row.
  const nameColumns = [group.columns.source, group.columns.frame, group.columns.child].filter((column) => column !== undefined);
  const { z } = group.columns;
  const hasHeight = fields.at(-1) === 'yaw' && z !== undefined;
  const neededCellCount = Math.max(...[...columns, ...(hasHeight ? [z] : []), ...clocks.flatMap((clock) => clock.columns), ...nameColumns].map(({ index }) => index)) + 1;
  const rowNames = new Set<string>();
  /** Numbers of decimals that occur in the last column. */
  const decimalCounts = new Set<number>();

  const dropTextRow = (line: number, columnName: string, cell: string) => rows.dropRow('text', line, (texts) => texts.notNumericReason(truncate(columnName), truncate(cell.trim())));

  const addCellsAsRow = (cells: string[], line: number) => {
    const times: number[] = [];
    for (let i = 0; i < clocks.length; i++) {
      const time = clockReaders[i].readTime(cells);
      if (time === undefined) return dropTextRow(line, clocks[i].name, cells[clocks[i].columns[0].index]);
      times.push(time);
    }
    const values: number[] = [];
    for (const { index, name: columnName, sign } of columns) {
      const value = parseNumber(normalizeCell(cells[index]));
      if (value === undefined) return dropTextRow(line, columnName, cells[index]);
      values.push(sign * value);
    }
    if (nameColumns.length > 0) rowNames.add(nameColumns.map(({ index }) => cells[index].trim()).join(' to '));
    const [[time, otherTime], [a, b, c = 0, ...quaternion]] = [times, values];
    const rotation = fields.at(-1) === 'qw' ? rotationOf(...(fields.length === 6 ? [c, ...quaternion] : [0, 0, c, ...quaternion]) as Quaternion) : { c, tiltCosine: undefined };
    rows.addRow({ time, a, b, c: rotation.c, tiltCosine: rotation.tiltCosine, z: hasHeight ? parseNumber(normalizeCell(cells[z.index])) : undefined }, line, otherTime);
  };

  return {
    rows,

    addLine(line: string, number: number, isUnterminated: boolean): void {
      if (/^\s*(?:[#%]|$)/.test(line)) return;
      const cells = splitCells(line, separator, neededCellCount);
      const lastCell = cells[neededCellCount - 1]?.trim() ?? '';
      const decimalCount = /\.(\d*)/.exec(lastCell)?.[1].length ?? 0;
      const isCutNumber = isUnterminated && rows.rowCount >= MIN_UNIFORM_ROWS && decimalCounts.size === 1 && decimalCount < Math.min(...decimalCounts) && line.trimEnd().endsWith(lastCell);
      decimalCounts.add(decimalCount);
      if (cells.length < neededCellCount || isCutNumber) {
        if (!isUnterminated) return rows.dropRow('short', number, (texts) => texts.shortRowReason(cells.length, neededCellCount));
        notes.push({ name: 'cutShort', values: [] });
        return rows.dropRow('short', number);
      }
      // In a table with several topics, a row of another topic has empty cells in the columns of this topic, and is skipped.
      if (!(isSparse && columns.every(({ index }) => Number.isNaN(parseNumber(cells[index]))))) addCellsAsRow(cells, number);
    },

    buildLog(): Log {
      if (rowNames.size > 1) throw new LogError(errorPlace, (texts) => texts.mixedSourcesReason(listNames([...rowNames])));
      const { unit = 's', by } = clockReaders[0].judgedUnit;
      if (!(unit in UNIT_EXPONENTS)) throw new LogError(errorPlace, (texts) => texts.unknownUnitReason(truncate(unit)));
      return rows.buildLog(name, kind, {
        units: {
          time: { unit, by },
          length: { unit: lengthUnit ?? 'm', by: lengthUnit ? 'name' : 'usage' },
          angle: fields.at(-1) === 'qw' ? { unit: 'quaternion', by: 'format' } : { unit: angleUnit ?? 'rad', by: angleUnit ? 'name' : 'usage' },
        },
        clocks: [clocks[0].name, clocks[1]?.name],
        columns: Object.fromEntries([['t', ''], ...fields.map((field, i) => [field, columns[i].name])]),
        createColumnQuestion(change) {
          const changedColumns = changeColumns(group.columns, change);
          const newColumns = columnNames.map((oldName, i) => {
            const field = (Object.keys(changedColumns) as Field[]).find((changedField) => changedColumns[changedField]?.index === i);
            const sign = field && (changedColumns[field]?.sign ?? 1) < 0 ? '-' : '';
            const name = ((field && namedColumns[field]?.name) ?? oldName.trim()).replace(/^-/, '');
            return { name: `${sign}${name}`, field: field ? `${sign}${field}` : '-' };
          });
          return { file: errorPlace.file, option: 'columns', choices: [newColumns.map(({ name }) => name).join()], columns: columnNames, fields: newColumns.map(({ field }) => field) };
        },
        notes,
      }, options);
    },
  };
}

/** Replaces a decimal comma by a point. If the cell also has a point, it is ambiguous: a question mark is appended, so that it is refused as a number. */
const withDecimalPoint = (cell: string) => (cell.includes('.') && !cell.includes(':') && /^\s*[+-]?[\d.]+,?\d*\s*$/.test(cell) ? `${cell}?` : cell.replace(',', '.'));
