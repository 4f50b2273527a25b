/** Format of a table: encoding, separator, preamble and header, from its first lines. */

import { type Group, groupsOf, isHeader, isUnit } from './columns.ts';
import { LogError, cut, type Place } from './log-error.ts';
import { dateOf, numberOf } from './numbers.ts';
import { unitOfSize } from './units.ts';

export interface Format {
  name: 'csv' | 'tum';
  /** Separator of cells. A blank means any number of blanks and tabs. */
  separator: string;
  /** True if numbers have decimal commas. */
  hasCommas: boolean;
  /** Number of the first row's line, from 1. */
  firstLine: number;
  names: string[];
  /** Line of the header, which is repeated in a file that was concatenated from several. */
  header?: string;
  groups: Group[];
  /** True if empty cells belong to samples of other topics. */
  isSparse: boolean;
  /** True if either Y or Z may be the vertical axis, as in exports of Motive. */
  hasUnknownAxis?: boolean;
}

/** Number of rows, and of lines at the beginning and at the end, from which the format is detected. */
const SAMPLED_LINES = 50;

/** Names of the columns in tables without a header. The number of cells in a row identifies the table. */
const TUM_COLUMNS = ['t', 'x', 'y', 'z', 'qx', 'qy', 'qz', 'qw'];
const POSE_COLUMNS = ['pose.position.x', 'pose.position.y', 'pose.position.z', 'pose.orientation.x', 'pose.orientation.y', 'pose.orientation.z', 'pose.orientation.w'];
const TWIST_COLUMNS = ['linear.x', 'linear.y', 'linear.z', 'angular.x', 'angular.y', 'angular.z'];
const STAMP_COLUMNS = ['header.stamp.sec', 'header.stamp.nanosec', 'header.frame_id'];
const COVARIANCE_COLUMNS = Array.from({ length: 36 }, () => '-');

/** Columns of `ros2 topic echo --csv`: PoseStamped, TwistStamped, one transform, and with covariances Odometry and PoseStamped. */
const ROS2_LAYOUTS = [
  [...STAMP_COLUMNS, ...POSE_COLUMNS],
  [...STAMP_COLUMNS, ...TWIST_COLUMNS],
  [...STAMP_COLUMNS, 'child_frame_id', ...POSE_COLUMNS],
  // With --no-arr one cell replaces a covariance.
  ...[COVARIANCE_COLUMNS, ['-']].flatMap((covariance) => [
    [...STAMP_COLUMNS, 'child_frame_id', ...POSE_COLUMNS, ...covariance, ...TWIST_COLUMNS, ...covariance],
    [...STAMP_COLUMNS, ...POSE_COLUMNS, ...covariance],
  ]),
];

/** Records of CARMEN's logs. The columns of FLASER follow the readings of the laser. */
const CARMEN_RECORDS: [tag: string, series: string, names: string[]][] = [
  ['ODOM', 'ODOM', ['-', 'x', 'y', 'theta', 'v', 'omega', '-', 't']],
  ['TRUEPOS', 'TRUEPOS', ['-', 'x', 'y', 'theta', '-', '-', '-', 't']],
  ['FLASER', 'FLASER', ['-', 'x', 'y', 'theta', '-', '-', '-', 't']],
];

/** Number of columns of rows without times: poses of KITTI, and geometry_msgs/Twist. */
const [KITTI_WIDTH, TWIST_WIDTH] = [12, 6];

/** Patterns of the first line of texts that are not tables, with the name of their notation. */
const OTHER_NOTATIONS: [RegExp, string][] = [[/^\s*(\{\s*("|$)|\[\s*([-\d"[{]|$))/, 'JSON'], [/^(---|header:|pose:|transforms:|- header:)\s*$/, 'YAML']];

/** Splits a line into cells. May return only the first `needed` cells. A separator in quotes does not count. */
export function cellsOf(line: string, separator: string, needed = Infinity): string[] {
  if (separator === ' ') {
    const words = line.trim().split(/[ \t]+/);
    // In CARMEN's records of a laser, its readings come before the columns.
    return words[0] === 'FLASER' ? [words[0], ...words.slice(2 + Number(words[1]))] : words;
  }
  if (!line.includes('"')) {
    // A loop takes half as long as `split`.
    const plainCells: string[] = [];
    for (let from = 0, to = 0; to >= 0 && plainCells.length < needed; from = to + 1) {
      to = line.indexOf(separator, from);
      plainCells.push(to < 0 ? line.slice(from) : line.slice(from, to));
    }
    return plainCells;
  }
  const cells = [''];
  let isQuoted = false;
  for (const char of line) {
    if (char === '"') isQuoted = !isQuoted;
    else if (char === separator && !isQuoted) cells.push('');
    else cells[cells.length - 1] += char;
  }
  return cells;
}

const THOUSANDS = /^\s*[+-]?[1-9]\d{0,2},\d{3}\s*$/;
const DECIMAL_COMMA = /^\s*[+-]?\d*,\d+(e[+-]?\d+)?\s*$/i;
const isNumber = (cell: string) => cell.trim() !== '' && (numberOf(cell) !== undefined || DECIMAL_COMMA.test(cell) || dateOf(cell) !== undefined);

/** Returns true for a row of data: at least two cells, and at least half of the cells that are not empty, are numbers or dates. */
function isDataRow(cells: string[]): boolean {
  const filledCells = cells.filter((cell) => cell.trim() !== '');
  const numberCount = filledCells.filter(isNumber).length;
  return numberCount >= 2 && 2 * numberCount >= filledCells.length;
}

/** Returns the separator that splits lines into most numbers, or, if there are no numbers, into most cells. */
function separatorOf(lines: string[]): string {
  const declaredSeparator = lines.map((line) => /^"?sep=(.)"?$/i.exec(line)?.[1]).find((found) => found !== undefined);
  if (declaredSeparator) return declaredSeparator;
  const scoreOf = (separator: string) => {
    const cellRows = lines.map((line) => cellsOf(line, separator));
    return cellRows.filter(isDataRow).flat().filter(isNumber).length || cellRows.flat().length / 1e6;
  };
  return [';', '\t', ',', '|', ' '].map((separator) => ({ separator, score: scoreOf(separator) })).reduce((best, candidate) => (candidate.score > best.score ? candidate : best)).separator;
}

/**
 * Detects the format.
 *
 * @param lines of the beginning, with at least one row if the file has any
 * @param columns names of the columns, if they are given
 * @throws {LogError} where the columns are not clear
 */
export function formatOf(lines: string[], file: string, columns: string[] | undefined): Format {
  const filledLines = lines.map((line, i) => ({ line, number: i + 1 })).filter(({ line }) => line.trim() !== '');
  const isComment = ({ line }: { line: string }) => /^\s*(#|%|\/\/)/.test(line);
  const textLines = filledLines.filter((textLine) => !isComment(textLine));
  if (textLines.length === 0) throw new LogError({ file }, (say) => say.empty);
  const [, notation] = OTHER_NOTATIONS.find(([pattern]) => pattern.test(textLines[0].line)) ?? [];
  if (notation !== undefined) throw new LogError({ file }, (say) => say.noTable(notation));
  const records = CARMEN_RECORDS.filter(([tag]) => textLines.some(({ line }) => line.startsWith(`${tag} `)));
  if (records.length > 0 && textLines.every(({ line }) => /^[A-Z_0-9]+ /.test(line))) return carmenFormat(records, filledLines[0].number);

  const separator = separatorOf([...textLines.slice(0, SAMPLED_LINES), ...textLines.slice(-SAMPLED_LINES)].map(({ line }) => line.trim()));
  const cells = (line: string) => cellsOf(line, separator);
  const first = textLines.find(({ line }, i) => isDataRow(cells(line)) && (i + 1 === textLines.length || isDataRow(cells(textLines[i + 1].line)))) ?? textLines.findLast(({ line }) => isDataRow(cells(line)));
  const rows = first ? textLines.filter(({ number }) => number >= first.number).slice(0, SAMPLED_LINES).map(({ line }) => cells(line)) : [];
  // Between commas, a comma in quotes may also separate thousands.
  const isDecimal = (cell: string) => DECIMAL_COMMA.test(cell) && (separator !== ',' || !THOUSANDS.test(cell));
  const hasCommas = rows.flat().some(isDecimal);
  const rowWidth = Math.max(0, ...rows.map((row) => row.length - (row.at(-1)?.trim() === '' ? 1 : 0)));
  const commonFormat = { name: 'csv' as const, separator, hasCommas, firstLine: first?.number ?? (filledLines.at(-1)?.number ?? 0) + 1, isSparse: false };
  const errorPlace = { file, line: first?.number ?? filledLines[0].number };
  const noLogError = () => new LogError({ file }, (say) => say.noLog);

  if (columns) {
    if (first && columns.length !== rowWidth) throw new LogError(errorPlace, (say) => say.given(rowWidth, columns.length));
    return { ...commonFormat, names: columns, groups: columnGroups(columns, rows[0]) };
  }
  // At least half of the lines must be rows: prose can also contain single rows of numbers.
  if (2 * rows.filter(isDataRow).length < rows.length) throw noLogError();
  const linesAbove = filledLines.filter(({ number }) => number < commonFormat.firstLine);
  const motiveInfo = linesAbove.length > 0 && /^"?Format Version/.test(linesAbove[0].line) ? motiveFormat(linesAbove.map(({ line }) => cells(line)), errorPlace) : undefined;
  if (motiveInfo) return { ...commonFormat, ...motiveInfo };

  const header = headerOf(linesAbove, separator, rowWidth, rows[0]);
  if (header) {
    const { number } = header;
    const names = withUnits(header.names, linesAbove.flatMap((text) => (text.number > number ? [cells(text.line)] : [])));
    // Rows with decimal commas between commas have more cells than the header.
    if (rowWidth > names.length) throw new LogError({ file, line: first?.number }, (say) => say.wide(rowWidth, names.length, number));
    const groups = columnGroups(names, rows[0]).flatMap((group) => groupsBySource(group, rows));
    if (!first && groups.every(({ kind }) => kind === null)) throw noLogError();
    return { ...commonFormat, names, header: lines[number - 1], groups, isSparse: groups.length > 1 || names.some((name) => name.trim() === '__time') };
  }
  if (!first) throw noLogError();
  const names = columnsByContent(rows);
  if (names) return { ...commonFormat, name: names === TUM_COLUMNS ? 'tum' : 'csv', names, groups: columnGroups(names, rows[0]) };
  if (rowWidth === KITTI_WIDTH) throw new LogError(errorPlace, (say) => say.kitti);
  if (rowWidth === TWIST_WIDTH && rows.every((row) => row.slice(1, 5).every((cell) => Number(cell) === 0))) throw new LogError(errorPlace, (say) => say.twists);
  const defaultNames = ({ 3: 't,v,omega', 4: 't,x,y,yaw' } as Record<number, string>)[rowWidth] ?? `t,x,y,yaw${',-'.repeat(Math.max(0, rowWidth - 4))}`;
  throw new LogError(errorPlace, (say) => say.noHeader(rowWidth, cut(first.line.trim().replaceAll('\t', ' '))), { what: 'columns', choices: [defaultNames], columns: rows[0].slice(0, rowWidth) });
}

/** Splits a group whose rows are of several topics or robots. */
function groupsBySource(group: Group, rows: string[][]): Group[] {
  const { source: { at } = { at: -1 }, x, v } = group.columns;
  // In a row of another topic the cells of this one are empty.
  const ownRows = rows.filter((row) => row[(x ?? v)?.at ?? at]?.trim());
  const sources = [...new Set(ownRows.map((row) => row[at]?.trim() ?? ''))].filter(Boolean);
  return sources.length > 1 ? sources.map((name) => ({ ...group, name: group.name ? `${name}/${group.name}` : name, source: { at, name } })) : [group];
}

const bareUnit = (cell: string) => cell.replaceAll(/[\s"[\](){}]/g, '');

/** Adds the units of a row below the header to the names. */
function withUnits(names: string[], below: string[][]): string[] {
  const units = below.map((row) => row.map(bareUnit)).find((row) => row.length === names.length && row.filter(isUnit).length >= 2);
  return names.map((name, i) => (units && isUnit(units[i]) ? `${name} [${units[i]}]` : name));
}

/** Groups columns. A column without a name has times if its first cell is a date or a fraction. A whole number there is a row number. */
function columnGroups(names: string[], row: string[] | undefined): Group[] {
  return groupsOf(names, (index) => {
    const cell = row?.[index]?.trim() ?? '';
    return dateOf(cell) !== undefined || /^\d+[.,]\d+$/.test(cell) || unitOfSize(Number(cell)) !== undefined;
  });
}

/** Returns the header: the last line above the rows with names of fields, or a comment with as many names as a row has cells. */
function headerOf(above: { line: string; number: number }[], separator: string, width: number, row: string[] | undefined) {
  for (const { line, number } of above.toReversed()) {
    const textLine = line.trim().replace(/^\/\//, '');
    const isComment = /^#|^%(?!time)/.test(textLine) || textLine !== line.trim();
    const commentText = textLine.replace(/^[#%]+\s*(?=[^,;])/, isComment ? '' : '$&');
    // A commented header may have another separator than the rows.
    const possibleCells = [cellsOf(commentText, separator), ...(isComment ? [commentText.split(/\s{2,}/), commentText.split(/[\s,;]+(?![[(])/)] : [])];
    const names = possibleCells.find((cells) => cells.length === width) ?? possibleCells[0];
    if (!isHeader(names)) continue;
    const fieldNames = columnGroups(names, row).flatMap(({ columns }) => Object.keys(columns));
    // In a row of units below the header, V for volts looks like the name of a speed.
    if (names.filter((name) => isUnit(bareUnit(name))).length > fieldNames.length) continue;
    if (isComment && (fieldNames.length < 3 || (names.length !== width && fieldNames.length < 4))) continue;
    if (isComment || fieldNames.length > 0 || !above.some((earlier) => earlier.number < number && !/^\s*["#%]?sep=/i.test(earlier.line) && columnGroups(cellsOf(earlier.line, separator), row).length > 0)) {
      return { names: names.map((name) => name.trim().replace(/^"(.*)"$/, '$1')), number };
    }
  }
  return undefined;
}

/** Returns the columns of a table without a header, by their number and content. */
function columnsByContent(rows: string[][]): string[] | undefined {
  const [row] = rows;
  const isQuaternion = (from: number) => Math.abs(Math.hypot(...row.slice(from, from + 4).map((cell) => Number(cell.replace(',', '.')))) - 1) < 0.1;
  if (row.length === TUM_COLUMNS.length && row.every(isNumber)) return TUM_COLUMNS;
  return ROS2_LAYOUTS.find((names) => {
    const index = names.indexOf('pose.orientation.x');
    return row.length === names.length && /^\d+$/.test(row[0].trim()) && /^\d{1,9}$/.test(row[1].trim()) && !isNumber(row[2]) && (index < 0 || isQuaternion(index));
  });
}

/** Returns the format of CARMEN: a group for each kind of record. */
function carmenFormat(tags: typeof CARMEN_RECORDS, firstLine: number): Format {
  const groups = tags.flatMap(([tag, name, names]) => groupsOf(names).map((group) => ({ ...group, source: { at: 0, name: tag }, name })));
  return { name: 'csv', separator: ' ', hasCommas: false, firstLine, names: tags.map(([tag]) => tag), groups, isSparse: false };
}

/** Returns the format of Motive: a group for each rigid body, with its position and quaternion. Throws a LogError for Euler angles. */
function motiveFormat(above: string[][], place: Place): Pick<Format, 'names' | 'groups' | 'hasUnknownAxis'> | undefined {
  const rowNamed = (name: string) => above.find((row) => row.slice(0, 3).some((cell) => cell.trim() === name));
  const [last, quantities] = above.toReversed();
  const bodyNames = rowNamed('Name');
  if (!bodyNames || !quantities) return undefined;
  const exportSettings = new Map(above[0].flatMap((cell, i) => (i % 2 === 0 ? [[cell.trim(), above[0][i + 1]?.trim() ?? '']] : [])));
  const rotationType = exportSettings.get('Rotation Type') ?? 'Quaternion';
  if (rotationType !== 'Quaternion') throw new LogError(place, (say) => say.euler(cut(rotationType)));
  const unit = (exportSettings.get('Length Units') ?? exportSettings.get('Units') ?? 'Meters').toLowerCase();
  const bodyTypes = rowNamed('Type');
  const names = last.map((axis, i) => {
    if (/^Time/.test(axis.trim())) return 't [s]';
    const isBody = bodyTypes === undefined || bodyTypes[i]?.trim() === 'Rigid Body';
    const bodyName = bodyNames[i]?.trim() ?? '';
    if (!isBody || bodyName === '') return '-';
    const axisName = axis.trim().toLowerCase();
    if (quantities[i]?.trim() === 'Rotation') return `${bodyName}/q${axisName}`;
    return quantities[i]?.trim() === 'Position' ? `${bodyName}/${axisName} [${unit}]` : '-';
  });
  return { names, groups: groupsOf(names), hasUnknownAxis: true };
}
