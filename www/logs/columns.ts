/** Columns of a table, recognized by their names, in groups with a common prefix. */

import { group } from 'd3-array';
import { LogError, truncate, listNames, UNITS, type ErrorPlace, type AngleUnit, type LengthUnit, type LogKind, type Question, type Series, type TimeUnit } from './log.ts';

export type Field = 't' | 'seconds' | 'subseconds' | 'x' | 'y' | 'z' | 'yaw' | 'qx' | 'qy' | 'qz' | 'qw' | 'v' | 'omega' | 'frame' | 'child' | 'source';

export interface Column {
  index: number;
  name: string;
  /** Factor of the column's numbers: −1 if its name starts with a minus, as in "-y". */
  sign: number;
  /** Unit of time, length or angle in the column's name. A speed has the unit of its length or angle. */
  unit?: string;
  /** Priority among columns of the same field. The column with the lowest number is used. */
  rank: number;
}

export interface Clock {
  name: string;
  /** Column of times, or two columns: whole seconds and their fraction. The fraction is in ns, or in the unit that its name states. */
  columns: [Column] | [Column, Column];
  unit?: TimeUnit;
}

export interface ColumnGroup {
  name: string;
  kind: Series['kind'];
  hasCommands: boolean;
  columns: Partial<Record<Field, Column>>;
  /** Second column of each field that two columns match equally well. Such a field is ambiguous. */
  duplicateColumns: Partial<Record<Field, Column>>;
  /** Clock of the rows, and a fallback clock, which is used if the times of the first clock are mostly 0 or never change. */
  clocks: Clock[];
}

/** Patterns of the prefixes of fields in ROS messages: of a pose, of a twist, and of a header. */
const POSE_PREFIX = '(?:(?:pose|transform|odometry)\\.)*';
const TWIST_PREFIX = '(?:(?:twist|velocity|vel|cmd)\\.)*';
const HEADER_PREFIX = '(?:header\\.)?';

/**
 * Patterns of the names of each field, best first. Names are in lower case, with dots between their parts. The first pattern that matches the
 * end of a name determines its field, and the rest of the name is the prefix of a group.
 */
const FIELD_PATTERNS: [Field, string[]][] = [
  ['child', ['child\\.frame\\.id']],
  ['frame', [`${HEADER_PREFIX}frame\\.id`]],
  ['source', ['(?:topic|robot|agent|vehicle|(?:rigid\\.?)?body|subject|tracker)(?:\\.?(?:id|name))?']],
  ['subseconds', [`${HEADER_PREFIX}(?:time\\.?)?stamp\\.n(?:ano)?(?:secs?|seconds?)`, '(?:n(?:ano)?|micro|u|m(?:illi)?)(?:secs?|seconds?)']],
  ['seconds', [`${HEADER_PREFIX}(?:time\\.?)?stamp\\.(?:secs?|seconds?)`, '(?:secs?|seconds?)']],
  ['t', [`${HEADER_PREFIX}stamp`, '(?:ros|bag|rosbag|msg|epoch|unix)?\\.?time\\.?stamp', '(?:ros|bag|epoch|unix|elapsed|log|recv)?\\.?(?:time|date\\.?time)|millis|micros|nanos', 't']],
  ...Array.from('xyzw', (axis): [Field, string[]] => [`q${axis}` as Field, [`q\\..*\\.${axis}`, `${POSE_PREFIX}(?:orientation|rotation|quaternion|quat|rot|q)\\.?${axis}`]]),
  ['omega', [`${TWIST_PREFIX}(?:angular|ang)\\.(?:vel(?:ocity)?\\.)?z`, 'omega(?:\\.z)?|ω', '(?:yaw|turn|heading)\\.?(?:rate|vel(?:ocity)?)|wz?', '(?:angular|ang)(?:\\.?(?:vel(?:ocity)?|speed|rate))?', 'vel(?:ocity)?\\.(?:yaw|theta)']],
  ['v', [`${TWIST_PREFIX}(?:linear|lin)\\.(?:vel(?:ocity)?\\.)?x`, 'vx?', '(?:linear|lin|forward|fwd)?\\.?(?:vel(?:ocity)?|speed)(?:\\.x)?|linear|lin']],
  ['yaw', [`${POSE_PREFIX}(?:(?:orientation|rotation|euler|rpy|rot)\\.)?(?:yaw|theta|th|heading)(?:\\.angle)?`, 'θ|ψ|psi|phi|orientation|rotation']],
  ['x', ['east(?:ing)?']], ['y', ['north(?:ing)?']],
  ...Array.from('xyz', (axis): [Field, string[]] => [axis as Field, [`p\\..*\\.${axis}`, `${POSE_PREFIX}(?:position|translation|location|pos|loc|trans|[pt])\\.?${axis}`, `${POSE_PREFIX}${axis}(?:\\.?pos(?:ition)?)?`]]),
];

/** Patterns of whole names: an optional prefix, followed by the name of a field. The prefix is matched lazily, so that it is as short as possible. */
const PREFIXED_PATTERNS = FIELD_PATTERNS.flatMap(([field, namePatterns]) => namePatterns.map((name, rank) => ({ field, rank, pattern: new RegExp(`^(?:(.*?)\\.)??(?:${name})$`, 'u') })));

/** Pattern of a name in which the group follows the field, as in x_gt, yaw_odom and x1. */
const SUFFIXED_NAME = /^((?:pos\.|position\.)?[xy]|yaw|theta|th|heading|q\.?[xyzw]|t|time|v|omega)\.?(\d+|(?<=\.)(?!rate|dot)\p{L}.*)$/u;

/** Words in prefixes that mark columns to be ignored: uncertainties, accelerations, vectors of an IMU, and goals. */
const UNREAD_QUANTITIES = /(^|\.)(cov(ariance)?|std(dev)?|sigma|var(iance)?|err(or)?|residual|acc(el(eration)?)?|force|torque|effort|bias|mag(netic)?|dot|linear|angular|lin|ang|vel(ocity)?|twist|goal|setpoint|euler|rpy)(\.|\d|$)|^[vabw]\./;

type ParsedUnit = { quantity: 'time' | 'length' | 'angle'; unit: TimeUnit | 'min' | 'h' | LengthUnit | AngleUnit; isRate: boolean };

const UNIT_WORDS: [RegExp, ParsedUnit['quantity'], ParsedUnit['unit']][] = [
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
const EMPTY_UNIT = /^(|-|1|quat(ernion)?|unitless|none)$/;

/** Patterns of a unit at the end of a name: in brackets ("x [m]"), or after a separator ("x_m"). The "in" of "x_in" means input, not inches. */
const UNIT_IN_BRACKETS = /\s*[[({]([^\])}]*)[\])}]\s*$/;
const UNIT_AT_END = /(?:[._ ]+|\s*\/\s*|\s+in\s+)((?:m|mm|cm|ft|rad|deg)[._ /]s|(?!in_?$)[^._ /]+)_?$/;

function unitOf(text: string): ParsedUnit | undefined {
  const lowerText = text.trim().toLowerCase().replace(/^dps$/, 'deg/s');
  const withoutPerSecond = lowerText.replace(PER_SECOND, '');
  const isRate = withoutPerSecond !== lowerText && withoutPerSecond !== '' && !/^(p|m|u|n)$/.test(lowerText.replace(/s$/, ''));
  const [, quantity, unit] = UNIT_WORDS.find(([pattern]) => pattern.test(isRate ? withoutPerSecond : lowerText)) ?? [];
  return quantity && unit ? { quantity, unit, isRate } : undefined;
}

export const isUnit = (text: string) => unitOf(text) !== undefined;

/** Physical quantity of each field, and a flag: true if the field is a rate of change, such as a speed. */
const QUANTITY_OF_FIELD: Partial<Record<Field, [ParsedUnit['quantity'], boolean]>> = {
  t: ['time', false], seconds: ['time', false], subseconds: ['time', false], x: ['length', false], y: ['length', false], z: ['length', false], yaw: ['angle', false], v: ['length', true], omega: ['angle', true],
};

/** Returns the name of a column in lower case, with dots between its words: pose.x for poseX, pose_x or "pose x". */
function toDottedName(name: string): string {
  const lowerCaseName = name.replace(/^%/, '').replace(/^field\./, '').replaceAll(/(\p{Ll})(\p{Lu})/gu, '$1.$2').toLowerCase();
  return lowerCaseName.replaceAll(/[^\p{L}\p{N}°]+/gu, '.').replaceAll(/^\.+|\.+$/g, '');
}

interface ColumnMeaning { field: Field; rank: number; prefix: string; unit?: string }

/** Returns the field, the prefix and the unit that the name of a column states; undefined if the column has none of the known fields. */
function parseColumnName(name: string): ColumnMeaning | undefined {
  const [bracketedUnit = '', unitText = ''] = UNIT_IN_BRACKETS.exec(name) ?? [];
  const nameWithoutUnit = name.slice(0, name.length - bracketedUnit.length);
  const dottedPath = toDottedName(nameWithoutUnit);
  const fullNameMeaning = matchField(dottedPath);
  if (!EMPTY_UNIT.test(unitText.trim())) {
    const unit = unitOf(unitText);
    return fullNameMeaning && canHaveUnit(fullNameMeaning.field, unit) ? { ...fullNameMeaning, unit: unit?.unit ?? unitText.trim() } : undefined;
  }
  // `rostopic echo -p` prints all times in nanoseconds. Small times of a simulation would otherwise be taken for seconds.
  if (fullNameMeaning?.field === 't' && /^%time|^field\..*stamp$/.test(name)) return { ...fullNameMeaning, unit: 'ns' };
  if (fullNameMeaning) {
    // The name of a microcontroller's clock may state the unit, as in "millis".
    const unit = unitOf(dottedPath.replace(/.*\./, ''));
    return { ...fullNameMeaning, ...(unit && canHaveUnit(fullNameMeaning.field, unit) && { unit: unit.unit }) };
  }
  const [unitSuffix, unitWord] = UNIT_AT_END.exec(nameWithoutUnit) ?? [];
  const unit = unitWord === undefined ? undefined : unitOf(unitWord.replace(/[. ]/, '_'));
  const meaning = unitSuffix !== undefined && unit ? matchField(toDottedName(nameWithoutUnit.slice(0, -unitSuffix.length))) : undefined;
  if (meaning && unit && canHaveUnit(meaning.field, unit)) return { ...meaning, unit: unit.unit };
  const [, baseName, suffix] = SUFFIXED_NAME.exec(dottedPath) ?? [];
  const baseMeaning = baseName === undefined ? undefined : matchField(baseName);
  return baseMeaning && suffix !== undefined && !UNREAD_QUANTITIES.test(suffix) ? { ...baseMeaning, prefix: suffix } : undefined;
}

/** Returns the name that the user gives a column. If this name states no unit, the unit that the file states for the column is added, where it fits. */
export function withUnitInFile(givenName: string, nameInFile: string): string {
  const unitText = (UNIT_IN_BRACKETS.exec(nameInFile) ?? UNIT_AT_END.exec(nameInFile))?.[1] ?? '';
  const nameWithUnit = `${givenName} [${unitText}]`;
  return isUnit(unitText) && parseColumnName(givenName)?.unit === undefined && parseColumnName(nameWithUnit) ? nameWithUnit : givenName;
}

/** Checks that a unit fits the quantity of a field. Unknown units pass this check; `findLogLayout` refuses them. */
function canHaveUnit(field: Field, unit: ParsedUnit | undefined): boolean {
  const [quantity, isRate] = QUANTITY_OF_FIELD[field] ?? [];
  return unit === undefined || (unit.quantity === quantity && unit.isRate === isRate);
}

function matchField(path: string): ColumnMeaning | undefined {
  for (const { field, rank, pattern } of PREFIXED_PATTERNS) {
    const [matchedText, prefix = ''] = pattern.exec(path) ?? [];
    if (matchedText === undefined) continue;
    return UNREAD_QUANTITIES.test(prefix) || /^[vabw]\..*\.[xyzw]$/.test(path) ? undefined : { field, rank, prefix };
  }
  return undefined;
}

/** Groups the columns of a table that hold times, poses or commands; other columns are left out. `isTime` checks whether a column without a name holds times. */
export function groupColumnsByPrefix(names: string[], isTime: (index: number) => boolean = () => false): ColumnGroup[] {
  // PlotJuggler puts the topic before the name of each column. The topic is cut off, because topics such as /mocap/pose may look like fields of a message.
  const topics = names.flatMap((name) => /^\s*(\/.+\/)header\/stamp\s*$/.exec(name)?.[1] ?? []);
  const columnsWithMeaning = names.flatMap((name, index) => {
    const isUnnamed = /^\s*(|unnamed: \d+|index)\s*$/i.test(name);
    const topic = topics.find((topicPrefix) => name.trim().startsWith(topicPrefix)) ?? '';
    const meaning: ColumnMeaning | undefined = isUnnamed ? (isTime(index) ? { field: 't', rank: 9, prefix: '' } : undefined) : parseColumnName(name.trim().slice(topic.length));
    if (!meaning) return [];
    const { field, prefix, rank, unit } = meaning;
    // A heading in radians takes precedence over a heading in degrees in the same table, which is usually derived from it.
    const column: Column = { index, name: name.trim(), sign: /^\s*-/.test(name) ? -1 : 1, rank: rank + (unit === 'deg' ? 0.5 : 0), ...(unit !== undefined && { unit }) };
    return [{ field, prefix: toDottedName(topic + prefix), column }];
  });
  const groups = Array.from(group(columnsWithMeaning, ({ prefix }) => prefix), ([name, members]): ColumnGroup => {
    const fieldColumns = Array.from(group(members, ({ field }) => field), ([field, entries]) => [field, entries.map(({ column }) => column).toSorted((column, otherColumn) => column.rank - otherColumn.rank)] as const);
    const columns: ColumnGroup['columns'] = Object.fromEntries(fieldColumns.map(([field, [bestColumn]]) => [field, bestColumn]));
    const duplicateColumns = Object.fromEntries(fieldColumns.filter(([, [bestColumn, secondBestColumn]]) => bestColumn.rank === secondBestColumn?.rank).map(([field, [, secondBestColumn]]) => [field, secondBestColumn]));
    return { name, kind: null, hasCommands: hasFields(columns, 'v', 'omega'), columns, duplicateColumns, clocks: clocksOf(columns, Object.fromEntries(fieldColumns).t ?? []) };
  });
  const tableGroup = groups.find(({ name }) => name === '');
  const sharedClocks = tableGroup?.clocks ?? [];
  const allClocks = groups.flatMap(({ clocks }) => clocks);
  const isOdometryHeading = tableGroup?.columns.v !== undefined || tableGroup?.columns.omega !== undefined;
  const pathGroups = groups.filter(({ columns }) => hasFields(columns, 'x', 'y'));
  for (const columnGroup of groups) {
    const { columns, hasCommands } = columnGroup;
    if (tableGroup?.columns.source) columns.source ??= tableGroup.columns.source;
    // If a table has only one path, a heading without a prefix belongs to that path. Next to velocities without a prefix, the heading belongs to the odometry instead.
    if (tableGroup?.columns.yaw && !isOdometryHeading && pathGroups.length === 1 && columnGroup === pathGroups[0]) columns.yaw ??= tableGroup.columns.yaw;
    columnGroup.clocks = [...new Set([...columnGroup.clocks, ...sharedClocks])].slice(0, 2);
    // If a table has only one clock, all of its groups use it.
    if (columnGroup.clocks.length === 0 && allClocks.length === 1) columnGroup.clocks = allClocks;
    const hasPoses = hasFields(columns, 'x', 'y') && headingFieldsOf(columns).length > 0;
    if (columnGroup.clocks.length > 0) columnGroup.kind = hasPoses ? 'poses' : hasCommands ? 'commands' : hasFields(columns, 'x', 'y') ? 'positions' : null;
  }
  return groups.filter(({ columns }) => columns.x || columns.y || columns.v || columns.omega || columns.yaw || columns.qw);
}

/** Change of a table's columns: the new field of each column that gets another field, and the fields whose numbers are negated. */
export type ColumnChange = [newFields: Partial<Record<Field, Field>>, negatedFields: Field[]];

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

export function changeColumns(columns: ColumnGroup['columns'], [newFields, negatedFields]: ColumnChange): ColumnGroup['columns'] {
  return Object.fromEntries((Object.entries(columns) as [Field, Column][]).map(([field, column]) =>
    [newFields[field] ?? field, negatedFields.includes(field) ? { ...column, sign: -column.sign } : column]));
}

const hasFields = (columns: ColumnGroup['columns'], ...fields: Field[]) => fields.every((field) => columns[field]);

const headingFieldsOf = (columns: ColumnGroup['columns']): Field[] =>
  ([['qx', 'qy', 'qz', 'qw'], ['yaw'], ['qz', 'qw']] satisfies Field[][]).find((fields) => hasFields(columns, ...fields)) ?? [];

const clockOf = (column: Column): Clock => ({ name: column.name, columns: [column], ...(column.unit !== undefined && { unit: column.unit as TimeUnit }) });

/** Returns the clocks of a group; `timeColumns` are sorted by priority. The first clock is the message's stamp. The second clock, if any, may be the time of recording. */
function clocksOf({ seconds, subseconds }: ColumnGroup['columns'], timeColumns: Column[]): Clock[] {
  const singleColumnClocks = timeColumns.map(clockOf);
  if (seconds && subseconds) return [{ name: `${seconds.name}, ${subseconds.name}`, columns: [seconds, subseconds], unit: 's' }, ...singleColumnClocks];
  const timePartColumn = seconds ?? subseconds;
  return singleColumnClocks.length > 0 || !timePartColumn ? singleColumnClocks : [clockOf(timePartColumn)];
}

/** Names that columns probably have, by the number of columns. */
const LIKELY_NAMES: Record<number, string> = { 3: 't,v,omega', 4: 't,x,y,yaw', 7: 't,odom_x,odom_y,odom_yaw,ref_x,ref_y,ref_yaw' };

/** Returns a question about the columns of a table, with the names that they probably have. */
export const columnQuestionOf = (columns: string[]): Question =>
  ({ option: 'columns', choices: [LIKELY_NAMES[columns.length] ?? ['t,x,y,yaw', ...Array<string>(Math.max(0, columns.length - 4)).fill('-')].join()], columns });

/** Returns the columns of a log: x, y and heading, or v and omega. Throws a LogError if one of these columns is missing, or if two columns may be the same field. */
export function findLogLayout(columnGroup: ColumnGroup | undefined, names: string[], errorPlace: ErrorPlace, wantedKind: LogKind | undefined) {
  const columnNames = listNames(names.map((name) => name.trim()));
  const question = columnQuestionOf(names);
  if (!columnGroup) throw new LogError(errorPlace, (texts) => texts.missingColumnsReason(wantedKind === 'poses' ? wantedKind : 'either', columnNames), question);
  const { columns, duplicateColumns, clocks } = columnGroup;
  if (clocks.length === 0) throw new LogError(errorPlace, (texts) => texts.noTimeColumnReason(columnNames), question);
  const takesCommands = columnGroup.hasCommands && wantedKind !== 'poses' && (wantedKind === 'commands' || columnGroup.kind === 'commands');
  if (!takesCommands && !hasFields(columns, 'x', 'y')) throw new LogError(errorPlace, (texts) => texts.missingColumnsReason(wantedKind === 'poses' ? wantedKind : 'either', columnNames), question);
  const headingFields = headingFieldsOf(columns);
  const fields: Field[] = takesCommands ? ['v', 'omega'] : ['x', 'y', ...headingFields];
  for (const field of [...(clocks[0].columns[0] === columns.t ? ['t' as const] : []), ...fields]) {
    const [firstColumn, secondColumn] = [columns[field], duplicateColumns[field]];
    if (firstColumn && secondColumn) throw new LogError(errorPlace, (texts) => texts.ambiguousColumnReason(field, truncate(firstColumn.name), truncate(secondColumn.name)), question);
  }
  const usedColumns = fields.map((field) => columns[field] as Column);
  const usedLengthUnits = [...new Set((takesCommands ? usedColumns.slice(0, 1) : usedColumns.slice(0, 2)).map(({ unit }) => unit))];
  const angleUnit = takesCommands ? columns.omega?.unit : headingFields[0] === 'yaw' ? columns.yaw?.unit : undefined;
  for (const [units, knownUnits] of [[usedLengthUnits, UNITS.lengthUnit], [[angleUnit], UNITS.angleUnit]] as [(string | undefined)[], readonly string[]][]) {
    const isKnown = units.length === 1 && (units[0] === undefined || knownUnits.includes(units[0]));
    if (!isKnown) throw new LogError(errorPlace, (texts) => texts.unknownUnitReason(units.map((unit) => truncate(unit ?? '–')).join(', ')));
  }
  if (!takesCommands && headingFields.length === 0) throw new LogError({ file: errorPlace.file }, (texts) => texts.noHeadingReason(listNames(usedColumns.map(({ name }) => name))));
  const kind: LogKind = takesCommands ? 'commands' : 'poses';
  return { kind, clocks, columns: usedColumns, fields, lengthUnit: usedLengthUnits[0] as LengthUnit | undefined, angleUnit: angleUnit as AngleUnit | undefined };
}

/** Returns true for a header: a line with at least one cell that contains letters and is not a number. */
export const isHeader = (cells: string[]) => cells.some((cell) => /\p{L}/u.test(cell) && !/^[+-]?(nan|inf(inity)?|[\d.,]+e[+-]?\d+)$/i.test(cell.trim()));
