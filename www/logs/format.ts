/** Format of a table (separator, preamble and header) from its first lines, and parsers of the numbers and dates in its cells. */

import { columnQuestionOf, groupColumnsByPrefix, isHeader, isUnit, withUnitInFile, type ColumnGroup } from './columns.ts';
import { LogError, truncate, type ErrorPlace } from './log.ts';
import { epochTimeUnitOf } from './units.ts';

export interface TableFormat {
  /** Separator of cells. A space stands for any number of spaces and tabs. */
  separator: string;
  hasDecimalCommas: boolean;
  firstRowNumber: number;
  columnNames: string[];
  columnGroups: ColumnGroup[];
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
export function splitCells(line: string, separator: string, neededCellCount?: number): string[] {
  if (separator === ' ') return line.trim().split(/[ \t]+/);
  if (!line.includes('"')) return line.split(separator, neededCellCount);
  const cells = [''];
  let isQuoted = false;
  for (const character of line) {
    if (character === '"') isQuoted = !isQuoted;
    else if (character === separator && !isQuoted) cells.push('');
    else cells[cells.length - 1] += character;
  }
  return cells;
}

const THOUSANDS_COMMA = /^\s*[+-]?[1-9]\d{0,2},\d{3}\s*$/;
const DECIMAL_COMMA = /^\s*[+-]?\d*,\d+(e[+-]?\d+)?\s*$/i;
const isNumber = (cell: string) => cell.trim() !== '' && (parseNumber(cell) !== undefined || DECIMAL_COMMA.test(cell) || parseDate(cell) !== undefined);

/** Returns true for a row of data: it has at least two cells, and at least half of the cells that are not empty are numbers or dates. */
function isDataRow(cells: string[]): boolean {
  const filledCells = cells.filter((cell) => cell.trim() !== '');
  const numberCount = filledCells.filter(isNumber).length;
  return numberCount >= 2 && 2 * numberCount >= filledCells.length;
}

/** Returns the separator with which the lines have most numbers or, if they have no numbers, most cells. */
function separatorOf(lines: string[]): string {
  const declaredSeparator = lines.map((line) => /^"?sep=(.)"?$/i.exec(line)?.[1]).find((separatorMatch) => separatorMatch !== undefined);
  if (declaredSeparator) return declaredSeparator;
  const scoreOf = (separator: string) => {
    const cellRows = lines.map((line) => splitCells(line, separator));
    return cellRows.filter(isDataRow).flat().filter(isNumber).length || cellRows.flat().length / 1e6;
  };
  return [';', '\t', ',', '|', ' '].map((separator) => ({ separator, score: scoreOf(separator) })).reduce((best, candidate) => (candidate.score > best.score ? candidate : best)).separator;
}

/** Detects the format of a table from its first lines, which include a row if the file has any. Throws a LogError if the columns are ambiguous. */
export function detectTableFormat(lines: string[], file: string, givenColumnNames: string[] | undefined): TableFormat {
  const filledLines = lines.map((line, i) => ({ line, number: i + 1 })).filter(({ line }) => line.trim() !== '');
  const isComment = ({ line }: { line: string }) => /^\s*(#|%|\/\/)/.test(line);
  const textLines = filledLines.filter((textLine) => !isComment(textLine));
  if (textLines.length === 0) throw new LogError({ file }, (texts) => texts.emptyFileReason);
  const [, notation] = NON_TABLE_PATTERNS.find(([pattern]) => pattern.test(textLines[0].line)) ?? [];
  if (notation !== undefined) throw new LogError({ file }, (texts) => texts.noTableReason(notation));

  const separator = separatorOf([...textLines.slice(0, SAMPLED_LINE_COUNT), ...textLines.slice(-SAMPLED_LINE_COUNT)].map(({ line }) => line.trim()));
  const cellsOfLine = (line: string) => splitCells(line, separator);
  const firstRowLine = textLines.find(({ line }, i) => isDataRow(cellsOfLine(line)) && (i + 1 === textLines.length || isDataRow(cellsOfLine(textLines[i + 1].line)))) ?? textLines.findLast(({ line }) => isDataRow(cellsOfLine(line)));
  const rows = firstRowLine ? textLines.filter(({ number }) => number >= firstRowLine.number).slice(0, SAMPLED_LINE_COUNT).map(({ line }) => cellsOfLine(line)) : [];
  // If commas separate the cells, a comma within a quoted cell may be a thousands separator instead of a decimal comma.
  const hasDecimalComma = (cell: string) => DECIMAL_COMMA.test(cell) && (separator !== ',' || !THOUSANDS_COMMA.test(cell));
  const hasDecimalCommas = rows.flat().some(hasDecimalComma);
  const rowWidth = Math.max(0, ...rows.map((row) => row.length - (row.at(-1)?.trim() === '' ? 1 : 0)));
  const commonFormat = { separator, hasDecimalCommas, firstRowNumber: firstRowLine?.number ?? (filledLines.at(-1)?.number ?? 0) + 1, isSparse: false };
  const errorPlace = { file, line: firstRowLine?.number ?? filledLines[0].number };
  const noLogError = () => new LogError({ file }, (texts) => texts.noLogReason);

  if (givenColumnNames) {
    if (firstRowLine && givenColumnNames.length !== rowWidth) throw new LogError(errorPlace, (texts) => texts.columnCountReason(rowWidth, givenColumnNames.length));
    const namesInFile = textLines.filter(({ number }) => number < commonFormat.firstRowNumber).map(({ line }) => cellsOfLine(line)).findLast((cells) => cells.length === rowWidth);
    const columnNames = givenColumnNames.map((name, i) => withUnitInFile(name, namesInFile?.[i] ?? ''));
    return { ...commonFormat, columnNames, columnGroups: findColumnGroups(columnNames, rows[0]) };
  }
  // At least half of the lines must be rows: prose can also contain single rows of numbers.
  if (2 * rows.filter(isDataRow).length < rows.length) throw noLogError();
  const preambleLines = filledLines.filter(({ number }) => number < commonFormat.firstRowNumber);
  const motiveLayout = preambleLines.length > 0 && /^"?Format Version/.test(preambleLines[0].line) ? detectMotiveFormat(preambleLines.map(({ line }) => cellsOfLine(line)), errorPlace) : undefined;
  if (motiveLayout) return { ...commonFormat, ...motiveLayout };

  const header = headerOf(preambleLines, separator, rowWidth, rows[0]);
  if (header) {
    const { number } = header;
    const columnNames = addUnits(header.names, preambleLines.flatMap((preambleLine) => (preambleLine.number > number ? [cellsOfLine(preambleLine.line)] : [])));
    // A row has more cells than the header if commas serve both as separator and as decimal comma.
    if (rowWidth > columnNames.length) throw new LogError({ file, line: firstRowLine?.number }, (texts) => texts.wideRowReason(rowWidth, columnNames.length, number));
    const columnGroups = findColumnGroups(columnNames, rows[0]);
    if (!firstRowLine && columnGroups.every(({ kind }) => kind === null)) throw noLogError();
    return { ...commonFormat, columnNames, columnGroups, isSparse: columnGroups.length > 1 || columnNames.some((name) => name.trim() === '__time') };
  }
  if (!firstRowLine) throw noLogError();
  const names = columnsByContent(rows);
  if (names) return { ...commonFormat, columnNames: names, columnGroups: findColumnGroups(names, rows[0]) };
  throw new LogError(errorPlace, (texts) => texts.noHeaderReason(rowWidth, truncate(firstRowLine.line.trim().replaceAll('\t', ' '))), columnQuestionOf(rows[0].slice(0, rowWidth)));
}

const stripUnitBrackets = (cell: string) => cell.replaceAll(/[\s"[\](){}]/g, '');

function addUnits(names: string[], rowsBelowHeader: string[][]): string[] {
  const unitTexts = rowsBelowHeader.map((row) => row.map(stripUnitBrackets)).find((row) => row.length === names.length && row.filter(isUnit).length >= 2);
  return names.map((name, i) => (unitTexts && isUnit(unitTexts[i]) ? `${name} [${unitTexts[i]}]` : name));
}

/** Groups columns by prefix. A column without a name holds times if its first cell is a date, a fraction or a time since 1970, and row numbers otherwise. */
function findColumnGroups(names: string[], firstRow: string[] | undefined): ColumnGroup[] {
  return groupColumnsByPrefix(names, (columnIndex) => {
    const cell = firstRow?.[columnIndex]?.trim() ?? '';
    return parseDate(cell) !== undefined || /^\d+[.,]\d+$/.test(cell) || epochTimeUnitOf(Number(cell)) !== undefined;
  });
}

/** Returns the header: the last line above the rows that contains names of fields, or a comment with as many names as a row has cells. */
function headerOf(preambleLines: { line: string; number: number }[], separator: string, rowWidth: number, firstRow: string[] | undefined) {
  for (const { line, number } of preambleLines.toReversed()) {
    const textLine = line.trim().replace(/^\/\//, '');
    const isComment = /^#|^%(?!time)/.test(textLine) || textLine !== line.trim();
    const commentText = textLine.replace(/^[#%]+\s*(?=[^,;])/, isComment ? '' : '$&');
    // A header in a comment may have another separator than the rows. Spaces, commas and semicolons are therefore tried too.
    const possibleCells = [splitCells(commentText, separator), ...(isComment ? [commentText.split(/\s{2,}/), commentText.split(/[\s,;]+(?![[(])/)] : [])];
    const names = possibleCells.find((cells) => cells.length === rowWidth) ?? possibleCells[0];
    if (!isHeader(names)) continue;
    const fieldNames = findColumnGroups(names, firstRow).flatMap(({ columns }) => Object.keys(columns));
    // In a row of units below the header, the unit V (volt) looks like the name of a speed. A line that consists mostly of units is therefore not the header.
    if (names.filter((name) => isUnit(stripUnitBrackets(name))).length > fieldNames.length) continue;
    if (isComment && (fieldNames.length < 3 || (names.length !== rowWidth && fieldNames.length < 4))) continue;
    if (isComment || fieldNames.length > 0 || !preambleLines.some((earlierLine) => earlierLine.number < number && !/^\s*["#%]?sep=/i.test(earlierLine.line) && findColumnGroups(splitCells(earlierLine.line, separator), firstRow).length > 0)) {
      return { names: names.map((name) => name.trim().replace(/^"(.*)"$/, '$1')), number };
    }
  }
  return undefined;
}

/** Returns the names of the columns of a table without a header, by their number and content. */
function columnsByContent(rows: string[][]): string[] | undefined {
  const [row] = rows;
  const isQuaternion = (firstIndex: number) => Math.abs(Math.hypot(...row.slice(firstIndex, firstIndex + 4).map((cell) => Number(cell.replace(',', '.')))) - 1) < 0.1;
  if (row.length === TUM_COLUMNS.length && row.every(isNumber)) return TUM_COLUMNS;
  return ROS2_LAYOUTS.find((names) => {
    const orientationIndex = names.indexOf('pose.orientation.x');
    return row.length === names.length && /^\d+$/.test(row[0].trim()) && /^\d{1,9}$/.test(row[1].trim()) && !isNumber(row[2]) && (orientationIndex < 0 || isQuaternion(orientationIndex));
  });
}

/** Returns the format of a Motive export, with a group for each rigid body. Throws a LogError if the rotations are Euler angles instead of quaternions. */
function detectMotiveFormat(preambleRows: string[][], errorPlace: ErrorPlace): Pick<TableFormat, 'columnNames' | 'columnGroups'> | undefined {
  const findRowByName = (name: string) => preambleRows.find((row) => row.slice(0, 3).some((cell) => cell.trim() === name));
  const [axisRow, quantityRow] = preambleRows.toReversed();
  const bodyNames = findRowByName('Name');
  if (!bodyNames || !quantityRow) return undefined;
  const exportSettings = new Map(preambleRows[0].flatMap((cell, i) => (i % 2 === 0 ? [[cell.trim(), preambleRows[0][i + 1]?.trim() ?? '']] : [])));
  const rotationType = exportSettings.get('Rotation Type') ?? 'Quaternion';
  if (rotationType !== 'Quaternion') throw new LogError(errorPlace, (texts) => texts.eulerAnglesReason(truncate(rotationType)));
  const unit = (exportSettings.get('Length Units') ?? exportSettings.get('Units') ?? 'Meters').toLowerCase();
  const bodyTypes = findRowByName('Type');
  const names = axisRow.map((axis, i) => {
    if (/^Time/.test(axis.trim())) return 't [s]';
    const isRigidBody = bodyTypes === undefined || bodyTypes[i]?.trim() === 'Rigid Body';
    const bodyName = bodyNames[i]?.trim() ?? '';
    if (!isRigidBody || bodyName === '') return '-';
    const axisName = axis.trim().toLowerCase();
    if (quantityRow[i]?.trim() === 'Rotation') return `${bodyName}/q${axisName}`;
    return quantityRow[i]?.trim() === 'Position' ? `${bodyName}/${axisName} [${unit}]` : '-';
  });
  return { columnNames: names, columnGroups: groupColumnsByPrefix(names) };
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
    const [, year, month, day, hour = '0', minute = '0', second = '0', fraction = '', zone] = dateMatch;
    const [sign, hours, minutes] = /^([+-])(\d{2}):?(\d{2})?$/.exec(zone ?? '')?.slice(1) ?? ['+', '0', '0'];
    const zoneOffset = (sign === '-' ? -60 : 60) * (60 * Number(hours) + Number(minutes ?? 0));
    const seconds = Date.UTC(Number(year), Number(month) - 1, Number(day), Number(hour), Number(minute), Number(second)) / 1000 - zoneOffset;
    return seconds + Number(`.${fraction}0`);
  }
  const durationMatch = DURATION_TEXT.exec(cell);
  if (!durationMatch) return undefined;
  const [days = '0', hours, minutes, seconds, fraction = ''] = durationMatch.slice(1);
  return ((Number(days) * 24 + Number(hours)) * 60 + Number(minutes)) * 60 + Number(seconds) + Number(`.${fraction}0`);
}
