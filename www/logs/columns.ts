/** Columns of a table, recognized by their names, in groups with a common prefix. */

import { group } from 'd3-array';
import type { TableFormat } from './format.ts';
import { LogError, truncate, listNames, UNIT_NAMES, type ErrorPlace, type AngleUnit, type LengthUnit, type LogKind, type Series, type TimeUnit } from './log.ts';

export type LogField = 't' | 'seconds' | 'subseconds' | 'x' | 'y' | 'z' | 'yaw' | 'qx' | 'qy' | 'qz' | 'qw' | 'v' | 'omega' | 'frame' | 'child' | 'source';

export interface TableColumn {
  index: number;
  columnName: string;
  /** Factor of the column's numbers: −1 if its name starts with a minus, as in "-y". */
  columnSign: number;
  /** Unit of time, length or angle in the column's name. A speed has the unit of its length or angle. */
  unitName?: string;
  /** Priority among columns of the same field. The column with the lowest number is used. */
  matchRank: number;
}

export interface RowClock {
  clockName: string;
  /** Column of times, or two columns: whole seconds and their fraction. The fraction is in ns, or in the unit that its name states. */
  clockColumns: [TableColumn] | [TableColumn, TableColumn];
  timeUnit?: TimeUnit;
}

export interface ColumnGroup {
  groupName: string;
  groupKind: Series['seriesKind'];
  hasCommands: boolean;
  fieldColumns: Partial<Record<LogField, TableColumn>>;
  /** Second column of each field that two columns match equally well. Such a field is ambiguous. */
  duplicateColumns: Partial<Record<LogField, TableColumn>>;
  /** Clock of the rows, and a fallback clock, which is used if the times of the first clock are mostly 0 or never change. */
  rowClocks: RowClock[];
}

/** Patterns of the prefixes of fields in ROS messages: of a pose, of a twist, and of a header. */
const POSE_PREFIX = '(?:(?:pose|transform|odometry)\\.)*';
const TWIST_PREFIX = '(?:(?:twist|velocity|vel|cmd)\\.)*';
const HEADER_PREFIX = '(?:header\\.)?';

/**
 * Patterns of the names of each field, best first. Names are in lower case, with dots between their parts. The first pattern that matches the
 * end of a name determines its field, and the rest of the name is the prefix of a group.
 */
const FIELD_PATTERNS: [LogField, string[]][] = [
  ['child', ['child\\.frame\\.id']],
  ['frame', [`${HEADER_PREFIX}frame\\.id`]],
  ['source', ['(?:topic|robot|agent|vehicle|(?:rigid\\.?)?body|subject|tracker)(?:\\.?(?:id|name))?']],
  ['subseconds', [`${HEADER_PREFIX}(?:time\\.?)?stamp\\.n(?:ano)?(?:secs?|seconds?)`, '(?:n(?:ano)?|micro|u|m(?:illi)?)(?:secs?|seconds?)']],
  ['seconds', [`${HEADER_PREFIX}(?:time\\.?)?stamp\\.(?:secs?|seconds?)`, '(?:secs?|seconds?)']],
  ['t', [`${HEADER_PREFIX}stamp`, '(?:ros|bag|rosbag|msg|epoch|unix)?\\.?time\\.?stamp', '(?:ros|bag|epoch|unix|elapsed|log|recv)?\\.?(?:time|date\\.?time)|millis|micros|nanos', 't']],
  ...Array.from('xyzw', (axisName): [LogField, string[]] => [`q${axisName}` as LogField, [`q\\..*\\.${axisName}`, `${POSE_PREFIX}(?:orientation|rotation|quaternion|quat|rot|q)\\.?${axisName}`]]),
  ['omega', [`${TWIST_PREFIX}(?:angular|ang)\\.(?:vel(?:ocity)?\\.)?z`, 'omega(?:\\.z)?|ω', '(?:yaw|turn|heading)\\.?(?:rate|vel(?:ocity)?)|wz?', '(?:angular|ang)(?:\\.?(?:vel(?:ocity)?|speed|rate))?', 'vel(?:ocity)?\\.(?:yaw|theta)']],
  ['v', [`${TWIST_PREFIX}(?:linear|lin)\\.(?:vel(?:ocity)?\\.)?x`, 'vx?', '(?:linear|lin|forward|fwd)?\\.?(?:vel(?:ocity)?|speed)(?:\\.x)?|linear|lin']],
  ['yaw', [`${POSE_PREFIX}(?:(?:orientation|rotation|euler|rpy|rot)\\.)?(?:yaw|theta|th|heading)(?:\\.angle)?`, 'θ|ψ|psi|phi|orientation|rotation']],
  ['x', ['east(?:ing)?']], ['y', ['north(?:ing)?']],
  ...Array.from('xyz', (axisName): [LogField, string[]] => [axisName as LogField, [`p\\..*\\.${axisName}`, `${POSE_PREFIX}(?:position|translation|location|pos|loc|trans|[pt])\\.?${axisName}`, `${POSE_PREFIX}${axisName}(?:\\.?pos(?:ition)?)?`]]),
];

/** Patterns of whole names: an optional prefix, followed by the name of a field. The prefix is matched lazily, so that it is as short as possible. */
const PREFIXED_PATTERNS = FIELD_PATTERNS.flatMap(([logField, namePatterns]) => namePatterns.map((namePattern, matchRank) => ({ field: logField, rank: matchRank, namePattern: new RegExp(`^(?:(.*?)\\.)??(?:${namePattern})$`, 'u') })));

/** Pattern of a name in which the group follows the field, as in x_gt, yaw_odom and x1. */
const SUFFIXED_NAME = /^((?:pos\.|position\.)?[xy]|yaw|theta|th|heading|q\.?[xyzw]|t|time|v|omega)\.?(\d+|(?<=\.)(?!rate|dot)\p{L}.*)$/u;

/** Words in prefixes that mark columns to be ignored: uncertainties, accelerations, vectors of an IMU, and goals. */
const UNREAD_QUANTITIES = /(^|\.)(cov(ariance)?|std(dev)?|sigma|var(iance)?|err(or)?|residual|acc(el(eration)?)?|force|torque|effort|bias|mag(netic)?|dot|linear|angular|lin|ang|vel(ocity)?|twist|goal|setpoint|euler|rpy)(\.|\d|$)|^[vabw]\./;

type ParsedUnit = { quantityName: 'time' | 'length' | 'angle'; unitName: TimeUnit | 'min' | 'h' | LengthUnit | AngleUnit; isRate: boolean };

const UNIT_WORDS: [RegExp, ParsedUnit['quantityName'], ParsedUnit['unitName']][] = [
  [/^(min|minutes?)$/, 'time', 'min'],
  [/^(h|hrs?|hours?)$/, 'time', 'h'],
  [/^(s|secs?|seconds?)$/, 'time', 's'],
  [/^(ms|millis|m(illi)?(secs?|seconds?))$/, 'time', 'ms'],
  [/^(us|µs|μs|micros|(u|micro)(secs?|seconds?))$/, 'time', 'us'],
  [/^(ns|nanos|n(ano)?(secs?|seconds?))$/, 'time', 'ns'],
  [/^(m|met(er|re)s?)$/, 'length', 'm'],
  [/^(cm|centimet(er|re)s?)$/, 'length', 'cm'],
  [/^(mm|millimet(er|re)s?)$/, 'length', 'mm'],
  [/^(ft|foot|feet)$/, 'length', 'ft'],
  [/^(in|inch(es)?)$/, 'length', 'in'],
  [/^(rad|radians?)$/, 'angle', 'rad'],
  [/^(deg|degrees?|°)$/, 'angle', 'deg'],
];

/** Pattern of the part of a unit that means "per second", as in "m/s", "m s^-1", "m_s" and "mps". */
const PER_SECOND = /(\/|[ ._*]|p|per)\.?s(ec(ond)?)?(\^?-1)?$/;

/** Pattern of texts in brackets that mean "no unit". */
const EMPTY_UNIT_PATTERN = /^(|-|1|quat(ernion)?|unitless|none)$/;

/** Patterns of a unit at the end of a name: in brackets ("x [m]"), or after a separator ("x_m"). The "in" of "x_in" means input, not inches. */
const UNIT_IN_BRACKETS = /\s*[[({]([^\])}]*)[\])}]\s*$/;
const UNIT_AT_END_PATTERN = /(?:[._ ]+|\s*\/\s*|\s+in\s+)((?:m|mm|cm|ft|rad|deg)[._ /]s|(?!in_?$)[^._ /]+)_?$/;

function unitOf(unitText: string): ParsedUnit | undefined {
  const lowerText = unitText.trim().toLowerCase().replace(/^dps$/, 'deg/s');
  const withoutPerSecond = lowerText.replace(PER_SECOND, '');
  const isRate = withoutPerSecond !== lowerText && withoutPerSecond !== '' && !/^(p|m|u|n)$/.test(lowerText.replace(/s$/, ''));
  const [, quantityName, unitName] = UNIT_WORDS.find(([unitPattern]) => unitPattern.test(isRate ? withoutPerSecond : lowerText)) ?? [];
  return quantityName && unitName ? { quantityName, unitName, isRate } : undefined;
}

export const isUnit = (unitText: string) => unitOf(unitText) !== undefined;

/** Physical quantity of each field, and a flag: true if the field is a rate of change, such as a speed. */
const QUANTITY_OF_FIELD: Partial<Record<LogField, [ParsedUnit['quantityName'], boolean]>> = {
  t: ['time', false], seconds: ['time', false], subseconds: ['time', false], x: ['length', false], y: ['length', false], z: ['length', false], yaw: ['angle', false], v: ['length', true], omega: ['angle', true],
};

/** Returns the name of a column in lower case, with dots between its words: pose.x for poseX, pose_x or "pose x". */
function toDottedName(columnName: string): string {
  const lowerCaseName = columnName.replace(/^%/, '').replace(/^field\./, '').replaceAll(/(\p{Ll})(\p{Lu})/gu, '$1.$2').toLowerCase();
  return lowerCaseName.replaceAll(/[^\p{L}\p{N}°]+/gu, '.').replaceAll(/^\.+|\.+$/g, '');
}

interface ColumnMeaning { logField: LogField; matchRank: number; groupPrefix: string; unitName?: string }

/** Returns the field, the prefix and the unit that the name of a column states; undefined if the column has none of the known fields. */
export function parseColumnName(columnName: string): ColumnMeaning | undefined {
  const [bracketedUnit = '', unitText = ''] = UNIT_IN_BRACKETS.exec(columnName) ?? [];
  const nameWithoutUnit = columnName.slice(0, columnName.length - bracketedUnit.length);
  const dottedPath = toDottedName(nameWithoutUnit);
  const fullNameMeaning = matchField(dottedPath);
  if (!EMPTY_UNIT_PATTERN.test(unitText.trim())) {
    const parsedUnit = unitOf(unitText);
    return fullNameMeaning && canHaveUnit(fullNameMeaning.logField, parsedUnit) ? { ...fullNameMeaning, unitName: parsedUnit?.unitName ?? unitText.trim() } : undefined;
  }
  // `rostopic echo -p` prints all times in nanoseconds. Small times of a simulation would otherwise be taken for seconds.
  if (fullNameMeaning?.logField === 't' && /^%time|^field\..*stamp$/.test(columnName)) return { ...fullNameMeaning, unitName: 'ns' };
  if (fullNameMeaning) {
    // The name of a microcontroller's clock may state the unit, as in "millis".
    const parsedUnit = unitOf(dottedPath.replace(/.*\./, ''));
    return { ...fullNameMeaning, ...(parsedUnit && canHaveUnit(fullNameMeaning.logField, parsedUnit) && { unitName: parsedUnit.unitName }) };
  }
  const [unitSuffix, unitWord] = UNIT_AT_END_PATTERN.exec(nameWithoutUnit) ?? [];
  const parsedUnit = unitWord === undefined ? undefined : unitOf(unitWord.replace(/[. ]/, '_'));
  const columnMeaning = unitSuffix !== undefined && parsedUnit ? matchField(toDottedName(nameWithoutUnit.slice(0, -unitSuffix.length))) : undefined;
  if (columnMeaning && parsedUnit && canHaveUnit(columnMeaning.logField, parsedUnit)) return { ...columnMeaning, unitName: parsedUnit.unitName };
  const [, baseName, nameSuffix] = SUFFIXED_NAME.exec(dottedPath) ?? [];
  const baseMeaning = baseName === undefined ? undefined : matchField(baseName);
  return baseMeaning && nameSuffix !== undefined && !UNREAD_QUANTITIES.test(nameSuffix) ? { ...baseMeaning, groupPrefix: nameSuffix } : undefined;
}

/** Patterns of names of row numbers, and of positions on the globe. */
const ROW_NUMBER_NAME = /^(sub\.)?(frame|index|seq|count|row|id)/;
const GLOBE_NAME = /^(lat(itude)?|lon(g|gitude)?|lng|alt(itude)?)(\.|$)/;

/** Returns true for a column whose name says that it holds neither times nor coordinates in the plane. */
export function isOtherQuantity(columnName: string): boolean {
  const dottedName = toDottedName(columnName);
  return UNREAD_QUANTITIES.test(dottedName) || ROW_NUMBER_NAME.test(dottedName) || GLOBE_NAME.test(dottedName);
}

/** Returns the name that the user gives a column. If this name states no unit, the unit that the file states for the column is added, provided that the column may have such a unit. */
export function addUnitInFile(givenName: string, nameInFile: string): string {
  const unitText = (UNIT_IN_BRACKETS.exec(nameInFile) ?? UNIT_AT_END_PATTERN.exec(nameInFile))?.[1] ?? '';
  const nameWithUnit = `${givenName} [${unitText}]`;
  return isUnit(unitText) && parseColumnName(givenName)?.unitName === undefined && parseColumnName(nameWithUnit) ? nameWithUnit : givenName;
}

/** Checks that a unit fits the quantity of a field. Unknown units pass this check; `findLogLayout` refuses them. */
function canHaveUnit(logField: LogField, parsedUnit: ParsedUnit | undefined): boolean {
  const [quantityName, isRate] = QUANTITY_OF_FIELD[logField] ?? [];
  return parsedUnit === undefined || (parsedUnit.quantityName === quantityName && parsedUnit.isRate === isRate);
}

function matchField(dottedName: string): ColumnMeaning | undefined {
  for (const { field: logField, rank: matchRank, namePattern } of PREFIXED_PATTERNS) {
    const [matchedText, groupPrefix = ''] = namePattern.exec(dottedName) ?? [];
    if (matchedText === undefined) continue;
    return UNREAD_QUANTITIES.test(groupPrefix) || /^[vabw]\..*\.[xyzw]$/.test(dottedName) ? undefined : { logField, matchRank, groupPrefix };
  }
  return undefined;
}

/** Groups the columns of a table that hold times, poses or commands; other columns are left out. `isTime` checks whether a column without a name holds times. */
export function groupColumnsByPrefix(columnNames: string[], isTime: (index: number) => boolean = () => false): ColumnGroup[] {
  // PlotJuggler puts the topic before the name of each column. The topic is cut off, because topics such as /mocap/pose may look like fields of a message.
  const topicPrefixes = columnNames.flatMap((columnName) => /^\s*(\/.+\/)header\/stamp\s*$/.exec(columnName)?.[1] ?? []);
  const columnsWithMeaning = columnNames.flatMap((columnName, index) => {
    const isUnnamed = /^\s*(|unnamed: \d+|index)\s*$/i.test(columnName);
    const topicPrefix = topicPrefixes.find((topicPrefix) => columnName.trim().startsWith(topicPrefix)) ?? '';
    const columnMeaning: ColumnMeaning | undefined = isUnnamed ? (isTime(index) ? { logField: 't', matchRank: 9, groupPrefix: '' } : undefined) : parseColumnName(columnName.trim().slice(topicPrefix.length));
    if (!columnMeaning) return [];
    const { logField, groupPrefix, matchRank, unitName } = columnMeaning;
    // A heading in radians takes precedence over a heading in degrees in the same table, which is usually derived from it.
    const tableColumn: TableColumn = { index, columnName: columnName.trim(), columnSign: /^\s*-/.test(columnName) ? -1 : 1, matchRank: matchRank + (unitName === 'deg' ? 0.5 : 0), ...(unitName !== undefined && { unitName }) };
    return [{ field: logField, prefix: toDottedName(topicPrefix + groupPrefix), column: tableColumn }];
  });
  const columnGroups = Array.from(group(columnsWithMeaning, ({ prefix: groupPrefix }) => groupPrefix), ([groupName, groupMembers]): ColumnGroup => {
    const fieldColumns = Array.from(group(groupMembers, ({ field: logField }) => logField), ([logField, fieldEntries]) => [logField, fieldEntries.map(({ column: tableColumn }) => tableColumn).toSorted((tableColumn, otherColumn) => tableColumn.matchRank - otherColumn.matchRank)] as const);
    const bestColumns: ColumnGroup['fieldColumns'] = Object.fromEntries(fieldColumns.map(([logField, [bestColumn]]) => [logField, bestColumn]));
    const duplicateColumns = Object.fromEntries(fieldColumns.filter(([, [bestColumn, secondBestColumn]]) => bestColumn.matchRank === secondBestColumn?.matchRank).map(([logField, [, secondBestColumn]]) => [logField, secondBestColumn]));
    return { groupName, groupKind: null, hasCommands: hasFields(bestColumns, 'v', 'omega'), fieldColumns: bestColumns, duplicateColumns, rowClocks: clocksOf(bestColumns, Object.fromEntries(fieldColumns).t ?? []) };
  });
  const tableGroup = columnGroups.find(({ groupName }) => groupName === '');
  const sharedClocks = tableGroup?.rowClocks ?? [];
  const allClocks = columnGroups.flatMap(({ rowClocks }) => rowClocks);
  const isOdometryHeading = tableGroup?.fieldColumns.v !== undefined || tableGroup?.fieldColumns.omega !== undefined;
  const pathGroups = columnGroups.filter(({ fieldColumns }) => hasFields(fieldColumns, 'x', 'y'));
  for (const columnGroup of columnGroups) {
    const { fieldColumns, hasCommands } = columnGroup;
    if (tableGroup?.fieldColumns.source) fieldColumns.source ??= tableGroup.fieldColumns.source;
    // If a table has only one path, a heading without a prefix belongs to that path. Next to velocities without a prefix, the heading belongs to the odometry instead.
    if (tableGroup?.fieldColumns.yaw && !isOdometryHeading && pathGroups.length === 1 && columnGroup === pathGroups[0]) fieldColumns.yaw ??= tableGroup.fieldColumns.yaw;
    columnGroup.rowClocks = [...new Set([...columnGroup.rowClocks, ...sharedClocks])].slice(0, 2);
    // If a table has only one clock, all groups of its columns use this clock.
    if (columnGroup.rowClocks.length === 0 && allClocks.length === 1) columnGroup.rowClocks = allClocks;
    const hasPoses = hasFields(fieldColumns, 'x', 'y') && headingFieldsOf(fieldColumns).length > 0;
    if (columnGroup.rowClocks.length > 0) columnGroup.groupKind = hasPoses ? 'poses' : hasCommands ? 'commands' : hasFields(fieldColumns, 'x', 'y') ? 'positions' : null;
  }
  return columnGroups.filter(({ fieldColumns }) => fieldColumns.x || fieldColumns.y || fieldColumns.v || fieldColumns.omega || fieldColumns.yaw || fieldColumns.qw);
}

/** Change of a table's columns: the new field of each column that gets another field, and the fields whose numbers are negated. */
export type ColumnChange = [newFields: Partial<Record<LogField, LogField>>, negatedFields: LogField[]];

/** Column changes for tables whose axes or order of quaternion components differ from those of ROS. */
export const COLUMN_CHANGES = {
  /** Axes of a table in which y points up and headings are positive from x towards −z. */
  yUp: [{ y: 'z', z: 'y', qy: 'qz', qz: 'qy' }, ['z', 'qz']],
  /** Axes of a table in which y points up and headings are positive from x towards z. */
  leftHandedWithYUp: [{ y: 'z', z: 'y' }, []],
  wFirst: [{ qx: 'qw', qy: 'qx', qz: 'qy', qw: 'qz' }, []],
  swappedXAndY: [{ x: 'y', y: 'x' }, []],
  negatedY: [{}, ['y']],
  /** Mirrors the y axis, and with it the headings and rotations. */
  mirrored: [{}, ['y', 'yaw', 'qx', 'qz']],
} satisfies Record<string, ColumnChange>;

export function changeColumns(fieldColumns: ColumnGroup['fieldColumns'], [newFields, negatedFields]: ColumnChange): ColumnGroup['fieldColumns'] {
  return Object.fromEntries((Object.entries(fieldColumns) as [LogField, TableColumn][]).map(([logField, tableColumn]) =>
    [newFields[logField] ?? logField, negatedFields.includes(logField) ? { ...tableColumn, columnSign: -tableColumn.columnSign } : tableColumn]));
}

const hasFields = (fieldColumns: ColumnGroup['fieldColumns'], ...logFields: LogField[]) => logFields.every((logField) => fieldColumns[logField]);

const headingFieldsOf = (fieldColumns: ColumnGroup['fieldColumns']): LogField[] =>
  ([['qx', 'qy', 'qz', 'qw'], ['yaw'], ['qz', 'qw']] satisfies LogField[][]).find((logFields) => hasFields(fieldColumns, ...logFields)) ?? [];

const clockOf = (timeColumn: TableColumn): RowClock => ({ clockName: timeColumn.columnName, clockColumns: [timeColumn], ...(timeColumn.unitName !== undefined && { timeUnit: timeColumn.unitName as TimeUnit }) });

/** Returns the clocks of a group; `timeColumns` are sorted by priority. The first clock is the message's stamp. The second clock, if any, may be the time of recording. */
function clocksOf({ seconds: secondColumn, subseconds: subsecondColumn }: ColumnGroup['fieldColumns'], timeColumns: TableColumn[]): RowClock[] {
  const singleColumnClocks = timeColumns.map(clockOf);
  if (secondColumn && subsecondColumn) return [{ clockName: `${secondColumn.columnName}, ${subsecondColumn.columnName}`, clockColumns: [secondColumn, subsecondColumn], timeUnit: 's' }, ...singleColumnClocks];
  const timePartColumn = secondColumn ?? subsecondColumn;
  return singleColumnClocks.length > 0 || !timePartColumn ? singleColumnClocks : [clockOf(timePartColumn)];
}

/** Returns the columns of a log: x, y and heading, or v and omega. Throws a LogError if one of these columns is missing, or if two columns may be the same field. */
export function findLogLayout(columnGroup: ColumnGroup | undefined, { columnNames: rawColumnNames, columnQuestion: userQuestion }: Pick<TableFormat, 'columnNames' | 'columnQuestion'>, errorPlace: ErrorPlace, wantedKind: LogKind | undefined) {
  const columnNames = listNames(rawColumnNames.map((columnName) => columnName.trim()));
  const hasMotion = columnGroup !== undefined && (columnGroup.hasCommands || hasFields(columnGroup.fieldColumns, 'x', 'y'));
  if (!hasMotion && rawColumnNames.some((columnName) => GLOBE_NAME.test(toDottedName(columnName)))) throw new LogError(errorPlace, (errorReasons) => errorReasons.globeReason);
  if (!columnGroup) throw new LogError(errorPlace, (errorReasons) => errorReasons.missingColumnsReason(wantedKind === 'poses' ? wantedKind : 'either', columnNames), userQuestion);
  const { fieldColumns, duplicateColumns, rowClocks } = columnGroup;
  if (rowClocks.length === 0) throw new LogError(errorPlace, (errorReasons) => errorReasons.noTimeColumnReason(columnNames), userQuestion);
  const takesCommands = columnGroup.hasCommands && wantedKind !== 'poses' && (wantedKind === 'commands' || columnGroup.groupKind === 'commands');
  if (!takesCommands && !hasFields(fieldColumns, 'x', 'y')) throw new LogError(errorPlace, (errorReasons) => errorReasons.missingColumnsReason(wantedKind === 'poses' ? wantedKind : 'either', columnNames), userQuestion);
  const headingFields = headingFieldsOf(fieldColumns);
  const usedFields: LogField[] = takesCommands ? ['v', 'omega'] : ['x', 'y', ...headingFields];
  for (const logField of [...(rowClocks[0].clockColumns[0] === fieldColumns.t ? ['t' as const] : []), ...usedFields]) {
    const [firstColumn, secondColumn] = [fieldColumns[logField], duplicateColumns[logField]];
    if (firstColumn && secondColumn) throw new LogError(errorPlace, (errorReasons) => errorReasons.ambiguousColumnReason(logField, truncate(firstColumn.columnName), truncate(secondColumn.columnName)), userQuestion);
  }
  const usedColumns = usedFields.map((logField) => fieldColumns[logField] as TableColumn);
  const usedLengthUnits = [...new Set((takesCommands ? usedColumns.slice(0, 1) : usedColumns.slice(0, 2)).map(({ unitName }) => unitName))];
  const angleUnit = takesCommands ? fieldColumns.omega?.unitName : headingFields[0] === 'yaw' ? fieldColumns.yaw?.unitName : undefined;
  for (const [usedUnits, knownUnits] of [[usedLengthUnits, UNIT_NAMES.lengthUnit], [[angleUnit], UNIT_NAMES.angleUnit]] as [(string | undefined)[], readonly string[]][]) {
    const isKnown = usedUnits.length === 1 && (usedUnits[0] === undefined || knownUnits.includes(usedUnits[0]));
    if (!isKnown) throw new LogError(errorPlace, (errorReasons) => errorReasons.unknownUnitReason(usedUnits.map((unitName) => truncate(unitName ?? '–')).join(', ')));
  }
  if (!takesCommands && headingFields.length === 0) throw new LogError({ fileName: errorPlace.fileName }, (errorReasons) => errorReasons.noHeadingReason(listNames(usedColumns.map(({ columnName }) => columnName))));
  const logKind: LogKind = takesCommands ? 'commands' : 'poses';
  return { kind: logKind, clocks: rowClocks, usedColumns, fields: usedFields, lengthUnit: usedLengthUnits[0] as LengthUnit | undefined, angleUnit: angleUnit as AngleUnit | undefined };
}

/** Returns true for a header: a line with at least one cell that contains letters and is not a number. */
export const isHeader = (rowCells: string[]) => rowCells.some((cell) => /\p{L}/u.test(cell) && !/^[+-]?(nan|inf(inity)?|[\d.,]+e[+-]?\d+)$/i.test(cell.trim()));
