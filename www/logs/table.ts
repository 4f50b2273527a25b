/** Reader of logs in text tables of robots, recorders and spreadsheets. */

import { COLUMN_CHANGES, changeColumns, findLogLayout, type RowClock, type ColumnGroup, type LogField } from './columns.ts';
import { splitCells, detectTableFormat, parseDate, parseNumber, parseTime, type TableFormat } from './format.ts';
import { LogError, readBytes, truncate, listNames, type ErrorPlace, type Log, type LogNote, type OpenOptions, type FindOptions, type Recording, type Series, type SourceFile, type LogSummary, type TimeUnit } from './log.ts';
import { rotationOf, type UnitQuaternion } from './path.ts';
import { RowCollector } from './rows.ts';
import { UNIT_EXPONENTS, epochTimeUnitOf } from './units.ts';

const BLOCK_BYTES = 2 ** 22;

/** Number of bytes at the start of a file from which the format is detected. They contain the preamble and some rows. */
const HEAD_BYTES = 2 ** 18;

/** Number of characters at the start of a text that are checked for NUL characters. */
const MAX_CHECKED_CHARACTERS = 4096;

/** Maximum number of characters in a line. A row of a thousand columns is shorter. */
const MAX_LINE_LENGTH = 2 ** 16;

/** Changes of a table's columns that make Z the vertical axis: for a file with Y up, or with quaternions that start with w. */
type TiltChange = 'yUp' | 'wFirst';

/** Limits for reading columns in another order: minimum spread of the cosine of Z's tilt (noise has less), and maximum spread in the new order, relative to that in the old order. */
const [MIN_TILT_SPREAD, MAX_TILT_RATIO] = [0.001, 0.1];

/** Minimum number of rows with equally many decimals in the last column. If the last row after them has fewer decimals, the file is cut off. */
const MIN_UNIFORM_ROWS = 20;

export async function openTable(sourceFile: SourceFile, optionsOf: FindOptions): Promise<Recording> {
  const headBytes = await readBytes(sourceFile, 0, Math.min(HEAD_BYTES, sourceFile.size));
  const encoding = detectEncoding(headBytes);
  const headText = new TextDecoder(encoding).decode(headBytes, { stream: true });
  if (headText.slice(0, MAX_CHECKED_CHARACTERS).includes('\0')) throw new LogError({ fileName: sourceFile.name }, (errorReasons) => errorReasons.unknownFormatReason);
  const headLines = headText.split('\n');
  // The last line of the sampled text may be incomplete. It is dropped unless it is the only line.
  if (sourceFile.size > HEAD_BYTES && headLines.length > 1) headLines.pop();
  const tableFormat = detectTableFormat(headLines, sourceFile.name, optionsOf(sourceFile.name)?.columnNames);
  const readableGroups = tableFormat.columnGroups.filter(({ groupKind: logKind }) => logKind !== null);
  const headerPlace = { fileName: sourceFile.name, lineNumber: Math.max(1, tableFormat.firstRowNumber - 1) };
  // No group of columns is a log. This call throws the LogError with the reason for the group with most columns.
  if (readableGroups.length === 0) findLogLayout(tableFormat.columnGroups.toSorted((a, b) => Object.keys(b.fieldColumns).length - Object.keys(a.fieldColumns).length)[0], tableFormat, headerPlace, undefined);
  const seriesOfGroup = (columnGroup: ColumnGroup): Series => ({
    seriesName: readableGroups.length === 1 && columnGroup.groupKind !== null ? '' : columnGroup.groupName || listNames(columnNamesOf(columnGroup)),
    messageType: listNames(columnNamesOf(columnGroup)),
    seriesKind: columnGroup.groupKind,
    hasCommands: columnGroup.hasCommands,
    messageCount: 0,
  });
  const allSeries = tableFormat.columnGroups.map(seriesOfGroup);
  return {
    recordingName: sourceFile.name,
    recordingFormat: 'csv',
    seriesList: allSeries,
    async readLogs(logChoices, onProgress) {
      /** Reads the chosen logs. With a change of columns, it reads only logs that have all columns of the change. */
      const readWithChange = async (changeName?: TiltChange) => {
        const logReaders = logChoices.map(({ seriesName, logKind }) => {
          const chosenGroup = tableFormat.columnGroups[allSeries.findIndex(({ seriesName: candidateName }) => candidateName === seriesName)];
          const logName = readableGroups.length === 1 ? sourceFile.name : `${sourceFile.name}, ${seriesOfGroup(chosenGroup).seriesName}`;
          if (changeName && !(Object.keys(COLUMN_CHANGES[changeName][0]) as LogField[]).every((logField) => chosenGroup.fieldColumns[logField])) return undefined;
          const columnGroup = changeName ? { ...chosenGroup, fieldColumns: changeColumns(chosenGroup.fieldColumns, COLUMN_CHANGES[changeName]) } : chosenGroup;
          return createLogReader(logName, { fileName: sourceFile.name }, tableFormat, columnGroup, findLogLayout(columnGroup, tableFormat, headerPlace, logKind), optionsOf(logName), chosenGroup.fieldColumns, changeName);
        });
        await readLines(sourceFile, encoding, tableFormat.firstRowNumber, onProgress, (lineText, lineNumber, isUnterminated) => {
          for (const logReader of logReaders) logReader?.addLine(lineText, lineNumber, isUnterminated);
        });
        return logReaders;
      };
      let logReaders = (await readWithChange()) as LogReader[];
      // A robot turns about its vertical axis, so that the tilt of this axis hardly varies. If the tilt of Z varies far less with Y up, or with quaternions that start with w, the columns are read so.
      for (const changeName of ['yUp', 'wFirst'] as const) {
        if (!logReaders.some(({ rows: rowCollector }) => rowCollector.tiltCosineSpread > MIN_TILT_SPREAD)) break;
        const changedReaders = await readWithChange(changeName);
        logReaders = logReaders.map((logReader, i) => {
          const changedReader = changedReaders[i];
          return changedReader && changedReader.rows.tiltCosineSpread < MAX_TILT_RATIO * logReader.rows.tiltCosineSpread ? changedReader : logReader;
        });
      }
      return logReaders.map((logReader) => logReader.buildLog());
    },
  };
}

const columnNamesOf = ({ fieldColumns }: ColumnGroup) => Object.values(fieldColumns).toSorted((a, b) => a.index - b.index).map(({ columnName }) => columnName);

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
async function readLines(sourceFile: SourceFile, encoding: string, firstLineNumber: number, onProgress: ((progressFraction: number) => void) | undefined, addLine: (lineText: string, lineNumber: number, isUnterminated: boolean) => void) {
  const textDecoder = new TextDecoder(encoding);
  let [incompleteLine, lineNumber] = ['', 0];
  const handleLine = (lineText: string, isUnterminated: boolean) => {
    lineNumber += 1;
    if (lineNumber >= firstLineNumber) addLine(lineText, lineNumber, isUnterminated);
  };
  for (let byteOffset = 0; byteOffset < sourceFile.size; byteOffset += BLOCK_BYTES) {
    onProgress?.(byteOffset / sourceFile.size);
    const blockText = incompleteLine + textDecoder.decode(await readBytes(sourceFile, byteOffset, Math.min(byteOffset + BLOCK_BYTES, sourceFile.size)), { stream: true });
    const lineTexts = blockText.split('\n');
    incompleteLine = lineTexts.pop() ?? '';
    for (const lineText of lineTexts) handleLine(lineText, false);
    if (incompleteLine.length > MAX_LINE_LENGTH) throw new LogError({ fileName: sourceFile.name, lineNumber: lineNumber + 1 }, (errorReasons) => errorReasons.longLineReason(MAX_LINE_LENGTH));
  }
  handleLine(incompleteLine + textDecoder.decode(), true);
}

/** Returns a reader of the times of a table. If the unit is not stated, the reader judges it by the size of the first time that is not 0. */
function createClockReader({ clockColumns: [{ index }, subsecondColumn], timeUnit: namedUnit }: RowClock, statedUnit: TimeUnit | undefined, normalizeCell: (cell: string) => string) {
  const unitBasis = statedUnit ? 'option' : namedUnit ? 'name' : 'usage';
  const judgedUnit: { timeUnit?: TimeUnit; unitBasis: LogSummary['units']['time']['by'] } = { timeUnit: statedUnit ?? namedUnit, unitBasis };
  let isDate: boolean | undefined;
  /** Returns the time of a row in seconds; undefined if the row's cell contains neither a number nor a date. */
  const readTime = (rowCells: string[]): number | undefined => {
    const cellText = normalizeCell(rowCells[index]);
    if (subsecondColumn) {
      const [seconds, subsecondTicks] = [parseNumber(cellText), parseNumber(rowCells[subsecondColumn.index])];
      return seconds !== undefined && subsecondTicks !== undefined ? seconds + subsecondTicks / 10 ** UNIT_EXPONENTS[subsecondColumn.unitName as TimeUnit] : undefined;
    }
    if (cellText.trim() === '') return NaN;
    if (isDate === undefined) {
      isDate = parseDate(rowCells[index]) !== undefined;
      if (isDate) Object.assign(judgedUnit, { timeUnit: 's', unitBasis: 'date' });
    }
    if (isDate) return parseDate(rowCells[index]);
    if (judgedUnit.timeUnit === undefined) {
      const timeNumber = parseNumber(cellText);
      const epochUnit = timeNumber && epochTimeUnitOf(timeNumber);
      if (epochUnit) Object.assign(judgedUnit, { timeUnit: epochUnit, unitBasis: 'size' });
      else if (timeNumber) judgedUnit.timeUnit = 's';
    }
    return parseTime(cellText, UNIT_EXPONENTS[judgedUnit.timeUnit ?? 's']);
  };
  return { judgedUnit, readTime };
}

type LogReader = ReturnType<typeof createLogReader>;

/** Returns a reader of the log of one series, line by line. `namedColumns` are the original columns; the columns in `columnGroup` may have been changed. */
function createLogReader(logName: string, errorPlace: ErrorPlace, tableFormat: TableFormat, columnGroup: ColumnGroup, logLayout: ReturnType<typeof findLogLayout>, openOptions: OpenOptions = {}, namedColumns: ColumnGroup['fieldColumns'], changeName?: TiltChange) {
  const { cellSeparator, hasDecimalCommas, isSparse, columnNames } = tableFormat;
  const { clocks: rowClocks, usedColumns, fields: usedFields, kind: logKind, lengthUnit, angleUnit } = logLayout;
  const rowCollector = new RowCollector(errorPlace);
  const logNotes: LogNote[] = changeName ? [{ name: changeName, values: [] }] : [];
  const normalizeCell = hasDecimalCommas ? replaceDecimalComma : (cell: string) => cell;
  const clockReaders = rowClocks.map((rowClock, i) => createClockReader(rowClock, i === 0 ? openOptions.timeUnit : undefined, normalizeCell));
  // Columns with the frames, the topic or the robot of a row.
  const nameColumns = [columnGroup.fieldColumns.source, columnGroup.fieldColumns.frame, columnGroup.fieldColumns.child].filter((tableColumn) => tableColumn !== undefined);
  const { z } = columnGroup.fieldColumns;
  const hasHeight = usedFields.at(-1) === 'yaw' && z !== undefined;
  const neededCellCount = Math.max(...[...usedColumns, ...(hasHeight ? [z] : []), ...rowClocks.flatMap((rowClock) => rowClock.clockColumns), ...nameColumns].map(({ index }) => index)) + 1;
  const rowNames = new Set<string>();
  /** Numbers of decimals that occur in the last column. */
  const decimalCounts = new Set<number>();

  const dropTextRow = (lineNumber: number, columnName: string, cell: string) => rowCollector.dropRow('text', lineNumber, (errorReasons) => errorReasons.notNumericReason(truncate(columnName), truncate(cell.trim())));

  const addCellsAsRow = (rowCells: string[], lineNumber: number) => {
    const rowTimes: number[] = [];
    for (let i = 0; i < rowClocks.length; i++) {
      const rowTime = clockReaders[i].readTime(rowCells);
      if (rowTime === undefined) return dropTextRow(lineNumber, rowClocks[i].clockName, rowCells[rowClocks[i].clockColumns[0].index]);
      rowTimes.push(rowTime);
    }
    const rowValues: number[] = [];
    for (const { index, columnName, columnSign } of usedColumns) {
      const cellValue = parseNumber(normalizeCell(rowCells[index]));
      if (cellValue === undefined) return dropTextRow(lineNumber, columnName, rowCells[index]);
      rowValues.push(columnSign * cellValue);
    }
    if (nameColumns.length > 0) rowNames.add(nameColumns.map(({ index }) => rowCells[index].trim()).join(' to '));
    const [[rowTime, otherTime], [a, b, c = 0, ...quaternion]] = [rowTimes, rowValues];
    const headingWithTilt = usedFields.at(-1) === 'qw' ? rotationOf(...(usedFields.length === 6 ? [c, ...quaternion] : [0, 0, c, ...quaternion]) as UnitQuaternion) : { c, tiltCosine: undefined };
    rowCollector.addRow({ sampleTime: rowTime, a, b, c: headingWithTilt.c, tiltCosine: headingWithTilt.tiltCosine, z: hasHeight ? parseNumber(normalizeCell(rowCells[z.index])) : undefined }, lineNumber, otherTime);
  };

  return {
    rows: rowCollector,

    addLine(lineText: string, lineNumber: number, isUnterminated: boolean): void {
      if (/^\s*(?:[#%]|$)/.test(lineText)) return;
      const rowCells = splitCells(lineText, cellSeparator, neededCellCount);
      const lastCell = rowCells[neededCellCount - 1]?.trim() ?? '';
      const decimalCount = /\.(\d*)/.exec(lastCell)?.[1].length ?? 0;
      const isCutNumber = isUnterminated && rowCollector.rowCount >= MIN_UNIFORM_ROWS && decimalCounts.size === 1 && decimalCount < Math.min(...decimalCounts) && lineText.trimEnd().endsWith(lastCell);
      decimalCounts.add(decimalCount);
      if (rowCells.length < neededCellCount || isCutNumber) {
        if (!isUnterminated) return rowCollector.dropRow('short', lineNumber, (errorReasons) => errorReasons.shortRowReason(rowCells.length, neededCellCount));
        logNotes.push({ name: 'cutShort', values: [] });
        return rowCollector.dropRow('short', lineNumber);
      }
      // In a table with several topics, a row of another topic has empty cells in the columns of this topic, and is skipped.
      if (!(isSparse && usedColumns.every(({ index }) => Number.isNaN(parseNumber(rowCells[index]))))) addCellsAsRow(rowCells, lineNumber);
    },

    buildLog(): Log {
      if (rowNames.size > 1) throw new LogError(errorPlace, (errorReasons) => errorReasons.mixedSourcesReason(listNames([...rowNames])));
      const { timeUnit = 's', unitBasis } = clockReaders[0].judgedUnit;
      if (!(timeUnit in UNIT_EXPONENTS)) throw new LogError(errorPlace, (errorReasons) => errorReasons.unknownUnitReason(truncate(timeUnit)));
      return rowCollector.buildLog(logName, logKind, {
        assumedUnits: {
          time: { unit: timeUnit, by: unitBasis },
          length: { unit: lengthUnit ?? 'm', by: lengthUnit ? 'name' : 'usage' },
          angle: usedFields.at(-1) === 'qw' ? { unit: 'quaternion', by: 'format' } : { unit: angleUnit ?? 'rad', by: angleUnit ? 'name' : 'usage' },
        },
        clockNames: [rowClocks[0].clockName, rowClocks[1]?.clockName],
        columns: Object.fromEntries([['t', ''], ...usedFields.map((logField, i) => [logField, usedColumns[i].columnName])]),
        createColumnQuestion(columnChange) {
          const changedColumns = changeColumns(columnGroup.fieldColumns, columnChange);
          const newColumns = columnNames.map((oldName, i) => {
            const logField = (Object.keys(changedColumns) as LogField[]).find((changedField) => changedColumns[changedField]?.index === i);
            const columnSign = logField && (changedColumns[logField]?.columnSign ?? 1) < 0 ? '-' : '';
            const columnName = ((logField && namedColumns[logField]?.columnName) ?? oldName.trim()).replace(/^-/, '');
            return { signedName: `${columnSign}${columnName}`, signedField: logField ? `${columnSign}${logField}` : '-' };
          });
          return { fileName: errorPlace.fileName, optionName: 'columns', possibleAnswers: [newColumns.map(({ signedName }) => signedName).join()], columnNames, proposedFields: newColumns.map(({ signedField }) => signedField) };
        },
        notes: logNotes,
      }, openOptions);
    },
  };
}

/** Replaces a decimal comma by a point. If the cell also has a point, it is ambiguous: a question mark is appended, so that it is refused as a number. */
const replaceDecimalComma = (cell: string) => (cell.includes('.') && !cell.includes(':') && /^\s*[+-]?[\d.]+,?\d*\s*$/.test(cell) ? `${cell}?` : cell.replace(',', '.'));
