/** Format of a table (separator, preamble and header) from its first lines, and parsers of the numbers and dates in its cells. */

import { groupColumnsByPrefix, isHeader, isOtherQuantity, isUnit, parseColumnName, addUnitInFile, type ColumnGroup } from './columns.ts';
import { LogError, truncate, type ErrorPlace, type UserQuestion } from './log.ts';
import { epochTimeUnitOf } from './units.ts';

export interface TableFormat {
  /** Separator of cells. A space stands for any number of spaces and tabs. */
  cellSeparator: string;
  hasDecimalCommas: boolean;
  firstRowNumber: number;
  columnNames: string[];
  columnGroups: ColumnGroup[];
  /** Question that proposes names for the columns. */
  columnQuestion: UserQuestion;
  /** True if rows may have empty cells, because each row holds a sample of only one of several topics. */
  isSparse: boolean;
}

/** Maximum number of lines that are sampled at the start of a text, at its end, and from its first row on. The format is detected from these lines. */
const SAMPLED_LINE_COUNT = 50;

/** Names of the columns in tables without a header. The number of columns in a table determines which of these lists applies. */
const TUM_COLUMNS = ['t', 'x', 'y', 'z', 'qx', 'qy', 'qz', 'qw'];
const POSE_COLUMNS = ['pose.position.x', 'pose.position.y', 'pose.position.z', 'pose.orientation.x', 'pose.orientation.y', 'pose.orientation.z', 'pose.orientation.w'];
const TWIST_COLUMNS = ['linear.x', 'linear.y', 'linear.z', 'angular.x', 'angular.y', 'angular.z'];
const STAMP_COLUMNS = ['header.stamp.sec', 'header.stamp.nanosec', 'header.frame_id'];
const COVARIANCE_COLUMNS = Array.from({ length: 36 }, () => '-');

/** Columns printed by `ros2 topic echo --csv` for PoseStamped, TwistStamped, a transform, Odometry, and PoseWithCovarianceStamped. */
const ROS2_LAYOUTS = [
  [...STAMP_COLUMNS, ...POSE_COLUMNS],
  [...STAMP_COLUMNS, ...TWIST_COLUMNS],
  [...STAMP_COLUMNS, 'child_frame_id', ...POSE_COLUMNS],
  // With the option --no-arr, `ros2 topic echo` prints one cell instead of the 36 numbers of a covariance.
  ...[COVARIANCE_COLUMNS, ['-']].flatMap((covariance) => [
    [...STAMP_COLUMNS, 'child_frame_id', ...POSE_COLUMNS, ...covariance, ...TWIST_COLUMNS, ...covariance],
    [...STAMP_COLUMNS, ...POSE_COLUMNS, ...covariance],
  ]),
];

/** Patterns of the first line of texts that are not tables, each with the name of the text's format. */
const NON_TABLE_PATTERNS: [RegExp, string][] = [[/^\s*(\{\s*("|$)|\[\s*([-\d"[{]|$))/, 'JSON'], [/^(---|header:|pose:|transforms:|- header:)\s*$/, 'YAML']];

/** Pattern of words that stand for a missing or infinite number. */
const NOT_FINITE_WORDS = /^(?:[+-]?(?:nan|inf(?:inity)?)|null|none|nat|na|n\/a|-)?$/i;

const ISO_DATE = /^\s*(\d{4})[-/](\d{1,2})[-/](\d{1,2})(?:[T\s]+(\d{1,2}):(\d{2})(?::(\d{2})(?:[.,](\d+))?)?\s*(Z|UTC|GMT|[+-]\d{2}(?::?\d{2})?)?)?\s*$/i;

/** Pattern of a duration as pandas ("0 days 00:00:01.5") or MATLAB ("00:00:01.5") prints it. */
const DURATION_TEXT = /^\s*(?:(\d+) days? )?\+?(\d+):(\d{2}):(\d{2})(?:[.,](\d+))?\s*$/;

/** Splits a line into cells, or at least into the first `neededCellCount` cells. A separator in quotes does not separate cells. */
export function splitCells(lineText: string, cellSeparator: string, neededCellCount?: number): string[] {
  if (cellSeparator === ' ') return lineText.trim().split(/[ \t]+/);
  if (!lineText.includes('"')) return lineText.split(cellSeparator, neededCellCount);
  const rowCells = [''];
  let isQuoted = false;
  for (const textCharacter of lineText) {
    if (textCharacter === '"') isQuoted = !isQuoted;
    else if (textCharacter === cellSeparator && !isQuoted) rowCells.push('');
    else rowCells[rowCells.length - 1] += textCharacter;
  }
  return rowCells;
}

const THOUSANDS_COMMA = /^\s*[+-]?[1-9]\d{0,2},\d{3}\s*$/;
const DECIMAL_COMMA = /^\s*[+-]?\d*,\d+(e[+-]?\d+)?\s*$/i;
const isNumber = (cell: string) => cell.trim() !== '' && (parseNumber(cell) !== undefined || DECIMAL_COMMA.test(cell) || parseDate(cell) !== undefined);

/** Returns true for a row of data: it has at least two cells, and at least half of the cells that are not empty are numbers or dates. */
function isDataRow(rowCells: string[]): boolean {
  const filledCells = rowCells.filter((cell) => cell.trim() !== '');
  const numberCount = filledCells.filter(isNumber).length;
  return numberCount >= 2 && 2 * numberCount >= filledCells.length;
}

/** Returns the separator that splits the lines into the most numbers or, if there are no numbers, into the most cells. */
function separatorOf(lineTexts: string[]): string {
  const declaredSeparator = lineTexts.map((lineText) => /^"?sep=(.)"?$/i.exec(lineText)?.[1]).find((separatorMatch) => separatorMatch !== undefined);
  if (declaredSeparator) return declaredSeparator;
  const scoreOf = (cellSeparator: string) => {
    const cellRows = lineTexts.map((lineText) => splitCells(lineText, cellSeparator));
    return cellRows.filter(isDataRow).flat().filter(isNumber).length || cellRows.flat().length / 1e6;
  };
  return [';', '\t', ',', '|', ' '].map((cellSeparator) => ({ cellSeparator, separatorScore: scoreOf(cellSeparator) })).reduce((bestSeparator, scoredSeparator) => (scoredSeparator.separatorScore > bestSeparator.separatorScore ? scoredSeparator : bestSeparator)).cellSeparator;
}

/** Detects the format of a table from its first lines, which include a row if the file has any. Throws a LogError if the columns are ambiguous. */
export function detectTableFormat(lineTexts: string[], fileName: string, givenColumnNames: string[] | undefined): TableFormat {
  const filledLines = lineTexts.map((lineText, i) => ({ lineText, lineNumber: i + 1 })).filter(({ lineText }) => lineText.trim() !== '');
  const isComment = ({ lineText }: { lineText: string }) => /^\s*(#|%|\/\/)/.test(lineText);
  const textLines = filledLines.filter((textLine) => !isComment(textLine));
  if (textLines.length === 0) throw new LogError({ fileName }, (errorReasons) => errorReasons.emptyFileReason);
  const [, notation] = NON_TABLE_PATTERNS.find(([notationPattern]) => notationPattern.test(textLines[0].lineText)) ?? [];
  if (notation !== undefined) throw new LogError({ fileName }, (errorReasons) => errorReasons.noTableReason(notation));

  const cellSeparator = separatorOf([...textLines.slice(0, SAMPLED_LINE_COUNT), ...textLines.slice(-SAMPLED_LINE_COUNT)].map(({ lineText }) => lineText.trim()));
  const cellsOfLine = (lineText: string) => splitCells(lineText, cellSeparator);
  const firstRowLine = textLines.find(({ lineText }, i) => isDataRow(cellsOfLine(lineText)) && (i + 1 === textLines.length || isDataRow(cellsOfLine(textLines[i + 1].lineText)))) ?? textLines.findLast(({ lineText }) => isDataRow(cellsOfLine(lineText)));
  const sampledRows = firstRowLine ? textLines.filter(({ lineNumber }) => lineNumber >= firstRowLine.lineNumber).slice(0, SAMPLED_LINE_COUNT).map(({ lineText }) => cellsOfLine(lineText)) : [];
  // If commas separate the cells, a comma within a quoted cell may be a thousands separator instead of a decimal comma.
  const hasDecimalComma = (cell: string) => DECIMAL_COMMA.test(cell) && (cellSeparator !== ',' || !THOUSANDS_COMMA.test(cell));
  const hasDecimalCommas = sampledRows.flat().some(hasDecimalComma);
  const rowWidth = Math.max(0, ...sampledRows.map((rowCells) => rowCells.length - (rowCells.at(-1)?.trim() === '' ? 1 : 0)));
  const commonFormat = { cellSeparator, hasDecimalCommas, firstRowNumber: firstRowLine?.lineNumber ?? (filledLines.at(-1)?.lineNumber ?? 0) + 1, isSparse: false };
  const errorPlace = { fileName, lineNumber: firstRowLine?.lineNumber ?? filledLines[0].lineNumber };
  const formatOf = (columnNames: string[], columnGroups = findColumnGroups(columnNames, sampledRows[0])) => ({ ...commonFormat, columnNames, columnGroups, columnQuestion: columnQuestionOf(columnNames, sampledRows) });
  const noLogError = () => new LogError({ fileName }, (errorReasons) => errorReasons.noLogReason);

  if (givenColumnNames) {
    if (firstRowLine && givenColumnNames.length !== rowWidth) throw new LogError(errorPlace, (errorReasons) => errorReasons.columnCountReason(rowWidth, givenColumnNames.length));
    const rowsAbove = textLines.filter(({ lineNumber }) => lineNumber < commonFormat.firstRowNumber).map(({ lineText }) => cellsOfLine(lineText)).filter((rowCells) => rowCells.length === rowWidth);
    const namesInFile = addUnits(rowsAbove.findLast((rowCells) => !hasUnits(rowCells)) ?? givenColumnNames, rowsAbove);
    const columnNames = givenColumnNames.map((columnName, i) => addUnitInFile(columnName, namesInFile[i]));
    return formatOf(columnNames);
  }
  // At least half of the lines must be rows: prose can also contain single rows of numbers.
  if (2 * sampledRows.filter(isDataRow).length < sampledRows.length) throw noLogError();
  const preambleLines = filledLines.filter(({ lineNumber }) => lineNumber < commonFormat.firstRowNumber);
  const motiveLayout = preambleLines.length > 0 && /^"?Format Version/.test(preambleLines[0].lineText) ? detectMotiveFormat(preambleLines.map(({ lineText }) => cellsOfLine(lineText)), errorPlace) : undefined;
  if (motiveLayout) return formatOf(motiveLayout.columnNames, motiveLayout.columnGroups);

  const tableHeader = headerOf(preambleLines, cellSeparator, rowWidth, sampledRows[0]);
  if (tableHeader) {
    const { lineNumber } = tableHeader;
    const columnNames = addUnits(tableHeader.columnNames, preambleLines.flatMap((preambleLine) => (preambleLine.lineNumber > lineNumber ? [cellsOfLine(preambleLine.lineText)] : [])));
    // A row has more cells than the header if commas serve both as separator and as decimal comma.
    if (rowWidth > columnNames.length) throw new LogError({ fileName, lineNumber: firstRowLine?.lineNumber }, (errorReasons) => errorReasons.wideRowReason(rowWidth, columnNames.length, lineNumber));
    const columnGroups = findColumnGroups(columnNames, sampledRows[0]);
    if (!firstRowLine && columnGroups.every(({ groupKind }) => groupKind === null)) throw noLogError();
    return { ...formatOf(columnNames, columnGroups), isSparse: columnGroups.length > 1 || columnNames.some((columnName) => columnName.trim() === '__time') };
  }
  if (!firstRowLine) throw noLogError();
  const columnNames = guessColumnsFromContent(sampledRows);
  if (columnNames) return formatOf(columnNames);
  throw new LogError(errorPlace, (errorReasons) => errorReasons.noHeaderReason(rowWidth, truncate(firstRowLine.lineText.trim().replaceAll('\t', ' '))), columnQuestionOf(sampledRows[0].slice(0, rowWidth), sampledRows));
}

/** Fields that the columns of a table probably have, by the number of columns, unless known names contradict them. */
const LIKELY_FIELDS: Record<number, string[]> = { 3: ['t', 'v', 'omega'], 7: ['t', 'odom_x', 'odom_y', 'odom_yaw', 'ref_x', 'ref_y', 'ref_yaw'] };

/** Maximum number of columns in a table from whose number alone their fields are guessed. Wider tables may hold quaternions, or roll and pitch. */
const MAX_GUESSED_COLUMNS = 5;

/** Returns the question for the columns of a table. Columns of known names keep them, and the missing fields are proposed for the other columns, in order. */
function columnQuestionOf(columnNames: string[], sampledRows: string[][]): UserQuestion {
  const meanings = columnNames.map((columnName) => parseColumnName(columnName));
  const knownFields = meanings.map((meaning) => meaning && `${meaning.groupPrefix} ${meaning.logField}`);
  const hasField = (...logFields: string[]) => meanings.some((meaning) => meaning && logFields.includes(meaning.logField));
  const neededFields = hasField('v', 'omega') && !hasField('x', 'y') ? ['t', 'v', 'omega'] : ['t', 'x', 'y', 'yaw'];
  const likelyFields = LIKELY_FIELDS[columnNames.length] ?? neededFields;
  const wantedFields = meanings.every((meaning) => !meaning || likelyFields.includes(meaning.logField)) ? likelyFields : neededFields;
  const missingFields = wantedFields.filter((logField) => !hasField(logField) && !(logField === 't' && hasField('seconds')) && !(logField === 'yaw' && hasField('qw')));
  const timesOf = (columnIndex: number) => sampledRows.map((rowCells) => parseDate(rowCells[columnIndex]) ?? Number(rowCells[columnIndex]?.replace(',', '.')));
  const isRising = (columnIndex: number) => timesOf(columnIndex).every((time, i, times) => i === 0 || time > times[i - 1]);
  const proposedNames = columnNames.map((columnName, i) => {
    if (knownFields[i]) return knownFields.indexOf(knownFields[i]) === i ? columnName.trim() : '-';
    return isOtherQuantity(columnName) || (missingFields[0] === 't' && !isRising(i)) ? '-' : (missingFields.shift() ?? '-');
  });
  const proposedFields = proposedNames.map((proposedName, i) => (proposedName === columnNames[i].trim() && meanings[i]?.logField) || proposedName);
  const isGuess = !knownFields.some(Boolean) && columnNames.length > MAX_GUESSED_COLUMNS && !(columnNames.length in LIKELY_FIELDS);
  return { optionName: 'columns', possibleAnswers: missingFields.length === 0 && !isGuess ? [proposedNames.join()] : [], columnNames, proposedFields };
}

const stripUnitBrackets = (cell: string) => cell.replaceAll(/[\s"[\](){}]/g, '');

const hasUnits = (rowCells: string[]) => rowCells.map(stripUnitBrackets).filter(isUnit).length >= 2;

function addUnits(columnNames: string[], rowsBelowHeader: string[][]): string[] {
  const unitTexts = rowsBelowHeader.find((rowCells) => rowCells.length === columnNames.length && hasUnits(rowCells))?.map(stripUnitBrackets);
  return columnNames.map((columnName, i) => (unitTexts && isUnit(unitTexts[i]) ? `${columnName} [${unitTexts[i]}]` : columnName));
}

/** Groups columns by prefix. A column without a name holds times if its first cell is a date, a fraction or a time since 1970, and row numbers otherwise. */
function findColumnGroups(columnNames: string[], firstRow: string[] | undefined): ColumnGroup[] {
  return groupColumnsByPrefix(columnNames, (columnIndex) => {
    const cell = firstRow?.[columnIndex]?.trim() ?? '';
    return parseDate(cell) !== undefined || /^\d+[.,]\d+$/.test(cell) || epochTimeUnitOf(Number(cell)) !== undefined;
  });
}

/** Returns the header: the last line above the rows that contains names of fields, or a comment with as many names as a row has cells. */
function headerOf(preambleLines: { lineText: string; lineNumber: number }[], cellSeparator: string, rowWidth: number, firstRow: string[] | undefined) {
  for (const { lineText, lineNumber } of preambleLines.toReversed()) {
    const textLine = lineText.trim().replace(/^\/\//, '');
    const isComment = /^#|^%(?!time)/.test(textLine) || textLine !== lineText.trim();
    const commentText = textLine.replace(/^[#%]+\s*(?=[^,;])/, isComment ? '' : '$&');
    // A header in a comment may have another separator than the rows. Spaces, commas and semicolons are therefore tried too.
    const possibleCells = [splitCells(commentText, cellSeparator), ...(isComment ? [commentText.split(/\s{2,}/), commentText.split(/[\s,;]+(?![[(])/)] : [])];
    const columnNames = possibleCells.find((rowCells) => rowCells.length === rowWidth) ?? possibleCells[0];
    if (!isHeader(columnNames)) continue;
    const fieldNames = findColumnGroups(columnNames, firstRow).flatMap(({ fieldColumns }) => Object.keys(fieldColumns));
    // In a row of units below the header, the unit V (volt) looks like the name of a speed. A line that consists mostly of units is therefore not the header.
    if (columnNames.filter((columnName) => isUnit(stripUnitBrackets(columnName))).length > fieldNames.length) continue;
    if (isComment && (fieldNames.length < 3 || (columnNames.length !== rowWidth && fieldNames.length < 4))) continue;
    if (isComment || fieldNames.length > 0 || !preambleLines.some((earlierLine) => earlierLine.lineNumber < lineNumber && !/^\s*["#%]?sep=/i.test(earlierLine.lineText) && findColumnGroups(splitCells(earlierLine.lineText, cellSeparator), firstRow).length > 0)) {
      return { columnNames: columnNames.map((columnName) => columnName.trim().replace(/^"(.*)"$/, '$1')), lineNumber };
    }
  }
  return undefined;
}

/** Returns the names of the columns of a table without a header, by their number and content. */
function guessColumnsFromContent(sampledRows: string[][]): string[] | undefined {
  const [rowCells] = sampledRows;
  const isQuaternion = (firstIndex: number) => Math.abs(Math.hypot(...rowCells.slice(firstIndex, firstIndex + 4).map((cell) => Number(cell.replace(',', '.')))) - 1) < 0.1;
  if (rowCells.length === TUM_COLUMNS.length && rowCells.every(isNumber)) return TUM_COLUMNS;
  return ROS2_LAYOUTS.find((columnNames) => {
    const orientationIndex = columnNames.indexOf('pose.orientation.x');
    return rowCells.length === columnNames.length && /^\d+$/.test(rowCells[0].trim()) && /^\d{1,9}$/.test(rowCells[1].trim()) && !isNumber(rowCells[2]) && (orientationIndex < 0 || isQuaternion(orientationIndex));
  });
}

/** Returns the format of a Motive export, with a group for each rigid body. Throws a LogError if the rotations are Euler angles instead of quaternions. */
function detectMotiveFormat(preambleRows: string[][], errorPlace: ErrorPlace): Pick<TableFormat, 'columnNames' | 'columnGroups'> | undefined {
  const findRowByName = (columnName: string) => preambleRows.find((rowCells) => rowCells.slice(0, 3).some((cell) => cell.trim() === columnName));
  const [axisRow, quantityRow] = preambleRows.toReversed();
  const bodyNames = findRowByName('Name');
  if (!bodyNames || !quantityRow) return undefined;
  const exportSettings = new Map(preambleRows[0].flatMap((cell, i) => (i % 2 === 0 ? [[cell.trim(), preambleRows[0][i + 1]?.trim() ?? '']] : [])));
  const rotationType = exportSettings.get('Rotation Type') ?? 'Quaternion';
  if (rotationType !== 'Quaternion') throw new LogError(errorPlace, (errorReasons) => errorReasons.eulerAnglesReason(truncate(rotationType)));
  const lengthUnitName = (exportSettings.get('Length Units') ?? exportSettings.get('Units') ?? 'Meters').toLowerCase();
  const typeCells = findRowByName('Type');
  const columnNames = axisRow.map((axisLetter, i) => {
    if (/^Time/.test(axisLetter.trim())) return 't [s]';
    const isRigidBody = typeCells === undefined || typeCells[i]?.trim() === 'Rigid Body';
    const bodyName = bodyNames[i]?.trim() ?? '';
    if (!isRigidBody || bodyName === '') return '-';
    const axisName = axisLetter.trim().toLowerCase();
    if (quantityRow[i]?.trim() === 'Rotation') return `${bodyName}/q${axisName}`;
    return quantityRow[i]?.trim() === 'Position' ? `${bodyName}/${axisName} [${lengthUnitName}]` : '-';
  });
  return { columnNames, columnGroups: groupColumnsByPrefix(columnNames) };
}

/** Parses a number. Returns NaN for an empty cell or a word such as "nan", and undefined for any other text. */
export function parseNumber(cell: string): number | undefined {
  const parsedValue = Number(cell);
  // `Number` accepts an empty cell (as 0) and hexadecimal digits. `parseFloat` gives other numbers for such cells, so that the comparison rejects them.
  if (parsedValue === parsedValue && (Math.trunc(parsedValue) !== parsedValue || parsedValue === parseFloat(cell))) return parsedValue;
  return NOT_FINITE_WORDS.test(cell.trim()) ? NaN : undefined;
}

/** Parses a time in units of 10^−unitExponent s, and returns it in seconds. For a cell that is not a number it returns the same as `parseNumber`. */
export function parseTime(cell: string, unitExponent: number): number | undefined {
  const parsedValue = parseNumber(cell);
  if (unitExponent === 0 || parsedValue === undefined || !Number.isFinite(parsedValue)) return parsedValue;
  // A double cannot represent nanoseconds since 1970 exactly. The exponent is therefore changed in the text, and the time is rounded only once.
  const [digits, exponent = '0'] = cell.trim().toLowerCase().split('e');
  return Number(`${digits}e${Number(exponent) - unitExponent}`);
}

/** Parses an ISO 8601 date or a duration, in seconds; undefined for any other text. A date without a time zone is in UTC. */
export function parseDate(cell: string): number | undefined {
  const dateMatch = ISO_DATE.exec(cell);
  if (dateMatch) {
    const [, yearText, monthText, dayText, hourText = '0', minuteText = '0', secondText = '0', fractionText = '', zoneText] = dateMatch;
    const [zoneSign, zoneHours, zoneMinutes] = /^([+-])(\d{2}):?(\d{2})?$/.exec(zoneText ?? '')?.slice(1) ?? ['+', '0', '0'];
    const zoneOffset = (zoneSign === '-' ? -60 : 60) * (60 * Number(zoneHours) + Number(zoneMinutes ?? 0));
    const seconds = Date.UTC(Number(yearText), Number(monthText) - 1, Number(dayText), Number(hourText), Number(minuteText), Number(secondText)) / 1000 - zoneOffset;
    return seconds + Number(`.${fractionText}0`);
  }
  const durationMatch = DURATION_TEXT.exec(cell);
  if (!durationMatch) return undefined;
  const [dayCount = '0', hourCount, minuteCount, seconds, fractionText = ''] = durationMatch.slice(1);
  return ((Number(dayCount) * 24 + Number(hourCount)) * 60 + Number(minuteCount)) * 60 + Number(seconds) + Number(`.${fractionText}0`);
}
