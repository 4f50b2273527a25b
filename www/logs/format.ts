/** Format of a table: encoding, separator, preamble and header, from its first lines. */

import { type Group, groupsOf, isHeader } from './columns.ts';
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

/** Number of lines that the format is detected from. */
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

/** Patterns of the first line of texts that are no tables, with the name of their notation. */
const OTHER_TEXTS: [RegExp, string][] = [[/^\s*(\{\s*("|$)|\[\s*([-\d"[{]|$))/, 'JSON'], [/^(---|header:|pose:|transforms:|- header:)\s*$/, 'YAML']];

/** Splits a line into cells, of which only `needed` may be returned. A separator in quotes does not count. */
export function cellsOf(line: string, separator: string, needed = Infinity): string[] {
  if (separator === ' ') return line.trim().split(/[ \t]+/);
  if (!line.includes('"')) {
    // A loop takes half as long as `split`.
    const plain: string[] = [];
    for (let from = 0, to = 0; to >= 0 && plain.length < needed; from = to + 1) {
      to = line.indexOf(separator, from);
      plain.push(to < 0 ? line.slice(from) : line.slice(from, to));
    }
    return plain;
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

/** Returns the cells of a record of CARMEN without the readings of the laser. */
export function carmenCells(line: string): string[] {
  const cells = line.trim().split(/\s+/);
  return cells[0] === 'FLASER' ? [cells[0], ...cells.slice(2 + Number(cells[1]))] : cells;
}

const DECIMAL_COMMA = /^\s*[+-]?\d*,\d+(e[+-]?\d+)?\s*$/i;
const isNumber = (cell: string) => cell.trim() !== '' && (numberOf(cell) !== undefined || DECIMAL_COMMA.test(cell) || dateOf(cell) !== undefined);

/** Checks for a row of data: at least two cells, and half of those that are not empty, are numbers or dates. */
function isRow(cells: string[]): boolean {
  const filled = cells.filter((cell) => cell.trim() !== '');
  const numbers = filled.filter(isNumber).length;
  return numbers >= 2 && 2 * numbers >= filled.length;
}

/** Returns the separator with which lines have most numbers, or if they have none, most cells. */
function separatorOf(lines: string[]): string {
  const declared = lines.map((line) => /^"?sep=(.)"?$/i.exec(line)?.[1]).find((each) => each !== undefined);
  if (declared) return declared;
  const score = (separator: string) => {
    const all = lines.map((line) => cellsOf(line, separator));
    return all.filter(isRow).flat().filter(isNumber).length || all.flat().length / 1e6;
  };
  return [';', '\t', ',', ' '].map((separator) => ({ separator, score: score(separator) })).reduce((best, each) => (each.score > best.score ? each : best)).separator;
}

/**
 * Detects the format.
 *
 * @param lines of the beginning, with at least one row if the file has any
 * @param columns names of the columns, if they are given
 * @throws {LogError} where the columns are not clear
 */
export function formatOf(lines: string[], file: string, columns: string[] | undefined): Format {
  const filled = lines.map((line, i) => ({ line, number: i + 1 })).filter(({ line }) => line.trim() !== '');
  const isComment = ({ line }: { line: string }) => /^\s*(#|%|\/\/)/.test(line);
  const texts = filled.filter((each) => !isComment(each));
  if (texts.length === 0) throw new LogError({ file }, (say) => say.empty);
  const [, notation] = OTHER_TEXTS.find(([pattern]) => pattern.test(texts[0].line)) ?? [];
  if (notation !== undefined) throw new LogError({ file }, (say) => say.noTable(notation));
  const tags = CARMEN_RECORDS.filter(([tag]) => texts.some(({ line }) => line.startsWith(`${tag} `)));
  if (tags.length > 0 && texts.every(({ line }) => /^[A-Z_0-9]+ /.test(line))) return carmenFormat(tags, filled[0].number);

  const separator = separatorOf(texts.slice(0, SAMPLED_LINES).map(({ line }) => line.trim()));
  const cells = (line: string) => cellsOf(line, separator);
  const first = texts.find(({ line }, i) => isRow(cells(line)) && (i + 1 === texts.length || isRow(cells(texts[i + 1].line)))) ?? texts.findLast(({ line }) => isRow(cells(line)));
  const rows = first ? texts.filter(({ number }) => number >= first.number).slice(0, SAMPLED_LINES).map(({ line }) => cells(line)) : [];
  const hasCommas = (separator !== ',' || rows.some((_, i) => texts[i].line.includes('"'))) && rows.flat().some((cell) => DECIMAL_COMMA.test(cell));
  const width = Math.max(0, ...rows.map((row) => row.length - (row.at(-1)?.trim() === '' ? 1 : 0)));
  const common = { name: 'csv' as const, separator, hasCommas, firstLine: first?.number ?? (filled.at(-1)?.number ?? 0) + 1, isSparse: false };
  const place = { file, line: first?.number ?? filled[0].number };
  const noLog = () => new LogError({ file }, (say) => say.noLog);

  if (columns) {
    if (first && columns.length !== width) throw new LogError(place, (say) => say.given(width, columns.length));
    return { ...common, names: columns, groups: grouped(columns, rows[0]) };
  }
  // At least half of the lines must be rows: prose can also contain single rows of numbers.
  if (2 * rows.filter(isRow).length < rows.length) throw noLog();
  const above = filled.filter(({ number }) => number < common.firstLine);
  const motive = above.length > 0 && /^"?Format Version/.test(above[0].line) ? motiveFormat(above.map(({ line }) => cells(line)), place) : undefined;
  if (motive) return { ...common, ...motive };

  const header = headerOf(above, separator, width, rows[0]);
  if (header) {
    const { names, number } = header;
    // Rows with decimal commas between commas have more cells than the header.
    if (width > names.length) throw new LogError({ file, line: first?.number }, (say) => say.wide(width, names.length, number));
    const groups = grouped(names, rows[0]);
    if (!first && groups.every(({ kind }) => kind === null)) throw noLog();
    return { ...common, names, header: lines[number - 1], groups, isSparse: groups.length > 1 || names.some((name) => name.trim() === '__time') };
  }
  if (!first) throw noLog();
  const names = withoutHeader(rows);
  if (names) return { ...common, name: names === TUM_COLUMNS ? 'tum' : 'csv', names, groups: grouped(names, rows[0]) };
  if (width === KITTI_WIDTH) throw new LogError(place, (say) => say.kitti);
  if (width === TWIST_WIDTH && rows.every((row) => row.slice(1, 5).every((cell) => Number(cell) === 0))) throw new LogError(place, (say) => say.twists);
  const defaultNames = ({ 3: 't,v,omega', 4: 't,x,y,yaw' } as Record<number, string>)[width] ?? `t,x,y,yaw${',-'.repeat(Math.max(0, width - 4))}`;
  throw new LogError(place, (say) => say.noHeader(width, cut(first.line.trim().replaceAll('\t', ' '))), { what: 'columns', choices: [defaultNames], columns: rows[0].slice(0, width) });
}

/** Groups columns. A column without a name has times if the first row has a date or a fraction there. A whole number is a row number. */
function grouped(names: string[], row: string[] | undefined): Group[] {
  return groupsOf(names, (at) => {
    const cell = row?.[at]?.trim() ?? '';
    return dateOf(cell) !== undefined || /^\d+[.,]\d+$/.test(cell) || unitOfSize(Number(cell)) !== undefined;
  });
}

/** Returns the header: the last line above the rows with names of fields, or a comment with as many names as a row has cells. */
function headerOf(above: { line: string; number: number }[], separator: string, width: number, row: string[] | undefined) {
  for (const { line, number } of above.toReversed()) {
    const text = line.trim().replace(/^\/\//, '');
    const isComment = /^#|^%(?!time)/.test(text) || text !== line.trim();
    const bare = text.replace(/^[#%]+\s*(?=[^,;])/, isComment ? '' : '$&');
    // A commented header may have another separator than the rows.
    const splits = [cellsOf(bare, separator), ...(isComment ? [bare.split(/[\s,;]+(?![[(])/)] : [])];
    const names = splits.find((each) => each.length === width) ?? splits[0];
    if (!isHeader(names)) continue;
    const fields = grouped(names, row).flatMap(({ columns }) => Object.keys(columns));
    if (isComment && (fields.length < 3 || (names.length !== width && fields.length < 4))) continue;
    if (isComment || fields.length > 0 || !above.some((each) => each.number < number && !/^\s*["#%]?sep=/i.test(each.line) && grouped(cellsOf(each.line, separator), row).length > 0)) {
      return { names: names.map((name) => name.trim().replace(/^"(.*)"$/, '$1')), number };
    }
  }
  return undefined;
}

/** Returns the columns of a table without a header, by their number and content. */
function withoutHeader(rows: string[][]): string[] | undefined {
  const [row] = rows;
  const isQuaternion = (from: number) => Math.abs(Math.hypot(...row.slice(from, from + 4).map((cell) => Number(cell.replace(',', '.')))) - 1) < 0.1;
  if (row.length === TUM_COLUMNS.length && row.every(isNumber)) return TUM_COLUMNS;
  return ROS2_LAYOUTS.find((names) => {
    const at = names.indexOf('pose.orientation.x');
    return row.length === names.length && /^\d+$/.test(row[0].trim()) && /^\d{1,9}$/.test(row[1].trim()) && !isNumber(row[2]) && (at < 0 || isQuaternion(at));
  });
}

/** Returns the format of CARMEN: a group for each kind of record. */
function carmenFormat(tags: typeof CARMEN_RECORDS, firstLine: number): Format {
  const groups = tags.flatMap(([tag, name, names]) => groupsOf(names).map((group) => ({ ...group, tag, name })));
  return { name: 'csv', separator: ' ', hasCommas: false, firstLine, names: tags.map(([tag]) => tag), groups, isSparse: false };
}

/** Returns the format of Motive: a group for each rigid body, with its position and quaternion. Throws a LogError for Euler angles. */
function motiveFormat(above: string[][], place: Place): Pick<Format, 'names' | 'groups' | 'hasUnknownAxis'> | undefined {
  const rowOf = (name: string) => above.find((row) => row.slice(0, 3).some((cell) => cell.trim() === name));
  const [last, quantities] = above.toReversed();
  const bodies = rowOf('Name');
  if (!bodies || !quantities) return undefined;
  const settings = new Map(above[0].flatMap((cell, i) => (i % 2 === 0 ? [[cell.trim(), above[0][i + 1]?.trim() ?? '']] : [])));
  const rotation = settings.get('Rotation Type') ?? 'Quaternion';
  if (rotation !== 'Quaternion') throw new LogError(place, (say) => say.euler(cut(rotation)));
  const unit = (settings.get('Length Units') ?? settings.get('Units') ?? 'Meters').toLowerCase();
  const types = rowOf('Type');
  const names = last.map((axis, i) => {
    if (/^Time/.test(axis.trim())) return 't [s]';
    const isBody = types === undefined || types[i]?.trim() === 'Rigid Body';
    const body = bodies[i]?.trim() ?? '';
    if (!isBody || body === '') return '-';
    const small = axis.trim().toLowerCase();
    if (quantities[i]?.trim() === 'Rotation') return `${body}/q${small}`;
    return quantities[i]?.trim() === 'Position' ? `${body}/${small} [${unit}]` : '-';
  });
  return { names, groups: groupsOf(names), hasUnknownAxis: true };
}
