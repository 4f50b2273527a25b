/** Columns of a table, recognized by their names, in groups with a common prefix. */

import { LogError, cut, listing, type Place } from './log-error.ts';
import { UNITS, type AngleUnit, type LengthUnit, type LogKind, type Question, type Series, type TimeUnit } from './log.ts';

export type Field = 't' | 'seconds' | 'subseconds' | 'x' | 'y' | 'z' | 'yaw' | 'qx' | 'qy' | 'qz' | 'qw' | 'v' | 'omega' | 'frame' | 'child' | 'source';

interface Column {
  /** Index, from 0. */
  at: number;
  name: string;
  /** Unit of time, length or angle in the name. A speed has the unit of its length or angle. */
  unit?: string;
  /** Priority among columns of the same field. The column with the lowest number is used. */
  rank: number;
}

export interface Clock {
  name: string;
  /** Column of times, or columns of seconds and of their fraction, in ns or the unit of its name. */
  columns: [Column] | [Column, Column];
  unit?: TimeUnit;
}

export interface Group {
  /** Prefix of the names. */
  name: string;
  kind: Series['kind'];
  hasCommands: boolean;
  columns: Partial<Record<Field, Column>>;
  /** Second column that fits a field as well as the first one. */
  twice: Partial<Record<Field, Column>>;
  /** Columns of times, best first. */
  times: Column[];
  /** Clock of the rows, and another one that is used if the first is mostly 0, or never changes. */
  clocks: Clock[];
  /** Cell that the group's rows have in a column, in a file with rows of several topics or robots. */
  source?: { at: number; name: string };
}

/** Pattern of the names of messages that contain a pose. */
const POSE = '(?:(?:pose|transform|odometry)\\.)*';
const TWIST = '(?:(?:twist|velocity|vel|cmd)\\.)*';
const HEADER = '(?:header\\.)?';

/**
 * Patterns of the names of each field, best first, in lower case with dots between their parts. A part before the pattern is the prefix of a
 * group. The first pattern that matches a name determines its field.
 */
const FIELD_PATTERNS: [Field, string[]][] = [
  ['child', ['child\\.frame\\.id']],
  ['frame', [`${HEADER}frame\\.id`]],
  ['source', ['(?:topic|robot|agent|vehicle|(?:rigid\\.?)?body|subject|tracker)(?:\\.?(?:id|name))?']],
  ['subseconds', [`${HEADER}(?:time\\.?)?stamp\\.n(?:ano)?(?:secs?|seconds?)`, '(?:n(?:ano)?|micro|u|m(?:illi)?)(?:secs?|seconds?)']],
  ['seconds', [`${HEADER}(?:time\\.?)?stamp\\.(?:secs?|seconds?)`, '(?:secs?|seconds?)']],
  ['t', [`${HEADER}stamp`, '(?:ros|bag|rosbag|msg|epoch|unix)?\\.?time\\.?stamp', '(?:ros|bag|epoch|unix|elapsed|log|recv)?\\.?(?:time|date\\.?time|zeit)|millis|micros|nanos', 't']],
  ...Array.from('xyzw', (axis): [Field, string[]] => [`q${axis}` as Field, [`q\\..*\\.${axis}`, `${POSE}(?:orientation|rotation|quaternion|quat|rot|q)\\.?${axis}`]]),
  ['omega', [`${TWIST}(?:angular|ang)\\.(?:vel(?:ocity)?\\.)?z`, 'omega(?:\\.z)?|ω', '(?:yaw|turn|heading)\\.?(?:rate|vel(?:ocity)?)|wz?', '(?:angular|ang)(?:\\.?(?:vel(?:ocity)?|speed|rate))?', 'vel(?:ocity)?\\.(?:yaw|theta)']],
  ['v', [`${TWIST}(?:linear|lin)\\.(?:vel(?:ocity)?\\.)?x`, 'vx?', '(?:linear|lin|forward|fwd)?\\.?(?:vel(?:ocity)?|speed)(?:\\.x)?|linear|lin']],
  ['yaw', [`${POSE}(?:(?:orientation|rotation|euler|rpy|rot)\\.)?(?:yaw|theta|heading|gier(?:winkel)?)(?:\\.angle)?`, 'θ|ψ|psi|phi|orientation']],
  ['x', ['east(?:ing)?']], ['y', ['north(?:ing)?']],
  ...Array.from('xyz', (axis): [Field, string[]] => [axis as Field, [`p\\..*\\.${axis}`, `${POSE}(?:position|translation|location|pos|loc|trans|[pt])\\.?${axis}`, `${POSE}${axis}(?:\\.?pos(?:ition)?)?`]]),
];

/**
 * Patterns with a prefix. The prefix is matched lazily, so that the name of a message belongs to the field and not to the prefix.
 */
const PREFIXED_PATTERNS = FIELD_PATTERNS.flatMap(([field, names]) => names.map((name, rank) => ({ field, rank, pattern: new RegExp(`^(?:(.*?)\\.)??(?:${name})$`, 'u') })));

/** Name in which the field comes before the group: x_gt, yaw_odom, x1. */
const SUFFIXED_NAME = /^((?:pos\.|position\.)?[xy]|yaw|theta|heading|q\.?[xyzw]|t|time|v|omega)\.?(\d+|(?<=\.)(?!rate|dot)\p{L}.*)$/u;

/** Parts of the names of columns without a pose, velocity or time: uncertainty, acceleration, vectors of an IMU, goals. */
const OTHER_QUANTITIES = /(^|\.)(cov(ariance)?|std(dev)?|sigma|var(iance)?|err(or)?|residual|acc(el(eration)?)?|force|torque|effort|bias|mag(netic)?|dot|linear|angular|lin|ang|vel(ocity)?|twist|goal|setpoint|euler|rpy)(\.|\d|$)|^[vabw]\./;

type ParsedUnit = { of: 'time' | 'length' | 'angle'; unit: TimeUnit | 'min' | 'h' | LengthUnit | AngleUnit; isRate: boolean };

const UNIT_WORDS: [RegExp, ParsedUnit['of'], ParsedUnit['unit']][] = [
  [/^(min|minutes?)$/, 'time', 'min'],
  [/^(h|hrs?|hours?)$/, 'time', 'h'],
  [/^(s|secs?|seconds?)$/, 'time', 's'],
  [/^(ms|millis|m(illi)?(secs?|seconds?))$/, 'time', 'ms'],
  [/^(us|µs|μs|micros|(u|micro)(secs?|seconds?))$/, 'time', 'us'],
  [/^(ns|nanos|n(ano)?(secs?|seconds?))$/, 'time', 'ns'],
  [/^(m|met(er|re)s?)$/, 'length', 'm'],
  [/^(cm|centimet(er|re)s?)$/, 'length', 'cm'],
  [/^(mm|millimet(er|re)s?)$/, 'length', 'mm'],
  [/^(rad|radians?)$/, 'angle', 'rad'],
  [/^(deg|degrees?|°|grad)$/, 'angle', 'deg'],
];

/** Division by a second: "m/s", "m s^-1", "m_s", "mps". */
const PER_SECOND = /(\/|[ ._*]|p|per)\.?s(ec(ond)?)?(\^?-1)?$/;

/** Texts in brackets that are not a unit. */
const EMPTY_UNIT = /^(|-|1|quat(ernion)?|unitless|none)$/;

/** Unit at the end of a name: in brackets, or as MATLAB converts a name such as "x [m]". */
const UNIT_IN_BRACKETS = /\s*[[({]([^\])}]*)[\])}]\s*$/;
const UNIT_AT_END = /(?:[._ ]+|\s*\/\s*|\s+in\s+)((?:m|mm|cm|rad|deg)[._ /]s|[^._ /]+)_?$/;

function unitOf(text: string): ParsedUnit | undefined {
  const lowerText = text.trim().toLowerCase().replace(/^dps$/, 'deg/s');
  const withoutPerSecond = lowerText.replace(PER_SECOND, '');
  const isRate = withoutPerSecond !== lowerText && withoutPerSecond !== '' && !/^(p|m|u|n)$/.test(lowerText.replace(/s$/, ''));
  const [, quantity, unit] = UNIT_WORDS.find(([pattern]) => pattern.test(isRate ? withoutPerSecond : lowerText)) ?? [];
  return quantity && unit ? { of: quantity, unit, isRate } : undefined;
}

export const isUnit = (text: string) => unitOf(text) !== undefined;

/** Quantity of each field, and true if it is a rate. */
const UNITS_OF: Partial<Record<Field, [ParsedUnit['of'], boolean]>> = {
  t: ['time', false], seconds: ['time', false], subseconds: ['time', false], x: ['length', false], y: ['length', false], z: ['length', false], yaw: ['angle', false], v: ['length', true], omega: ['angle', true],
};

/** Returns a name in lower case, with dots between its parts. */
function dottedName(name: string): string {
  const parts = name.replace(/^%/, '').replace(/^field\./, '').replaceAll(/(\p{Ll})(\p{Lu})/gu, '$1.$2').toLowerCase();
  return parts.replaceAll(/[^\p{L}\p{N}°]+/gu, '.').replaceAll(/^\.+|\.+$/g, '');
}

interface ColumnMeaning { field: Field; rank: number; prefix: string; unit?: string }

/** Returns the field of a column, or undefined for another quantity. */
function readName(name: string): ColumnMeaning | undefined {
  const [bracket, unitText] = UNIT_IN_BRACKETS.exec(name) ?? [];
  if (bracket !== undefined && unitText !== undefined && !EMPTY_UNIT.test(unitText.trim())) {
    const unit = unitOf(unitText);
    const reading = fieldOf(dottedName(name.slice(0, -bracket.length)));
    return reading && canHaveUnit(reading.field, unit) ? { ...reading, unit: unit?.unit ?? unitText.trim() } : undefined;
  }
  const bare = bracket === undefined ? name : name.slice(0, -bracket.length);
  const dottedPath = dottedName(bare);
  const wholeMeaning = fieldOf(dottedPath);
  // Times of rostopic are always in nanoseconds, also the small times of a simulation.
  if (wholeMeaning?.field === 't' && /^%time|^field\..*stamp$/.test(name)) return { ...wholeMeaning, unit: 'ns' };
  if (wholeMeaning) {
    // Clocks of microcontrollers are named after their unit.
    const unit = unitOf(dottedPath.replace(/.*\./, ''));
    return { ...wholeMeaning, ...(unit && canHaveUnit(wholeMeaning.field, unit) && { unit: unit.unit }) };
  }
  const [unitSuffix, word] = UNIT_AT_END.exec(bare) ?? [];
  const unit = word === undefined ? undefined : unitOf(word.replace(/[. ]/, '_'));
  const reading = unitSuffix !== undefined && unit ? fieldOf(dottedName(bare.slice(0, -unitSuffix.length))) : undefined;
  if (reading && unit && canHaveUnit(reading.field, unit)) return { ...reading, unit: unit.unit };
  const [, baseName, suffix] = SUFFIXED_NAME.exec(dottedPath) ?? [];
  const baseMeaning = baseName === undefined ? undefined : fieldOf(baseName);
  return baseMeaning && suffix !== undefined && !OTHER_QUANTITIES.test(suffix) ? { ...baseMeaning, prefix: suffix } : undefined;
}

/** Checks that a field can have a unit. Unknown units pass, and are refused when the column is read. */
function canHaveUnit(field: Field, unit: ParsedUnit | undefined): boolean {
  const [of, isRate] = UNITS_OF[field] ?? [];
  return unit === undefined || (unit.of === of && unit.isRate === isRate);
}

function fieldOf(path: string): ColumnMeaning | undefined {
  for (const { field, rank, pattern } of PREFIXED_PATTERNS) {
    const [match, prefix = ''] = pattern.exec(path) ?? [];
    if (match === undefined) continue;
    return OTHER_QUANTITIES.test(prefix) || /^[vabw]\..*\.[xyzw]$/.test(path) ? undefined : { field, rank, prefix };
  }
  return undefined;
}

/**
 * Groups the columns of a table.
 *
 * @param names of the columns
 * @param isTime checks whether a column without a name holds times
 * @returns groups in the order of their columns, without columns of other quantities
 */
export function groupsOf(names: string[], isTime: (index: number) => boolean = () => false): Group[] {
  const groups = new Map<string, Group>();
  for (const [index, name] of names.entries()) {
    const isIndex = /^\s*(|unnamed: \d+|index)\s*$/i.test(name);
    const reading: ColumnMeaning | undefined = isIndex ? (isTime(index) ? { field: 't', rank: 9, prefix: '' } : undefined) : readName(name);
    if (!reading) continue;
    const { field, rank, prefix, unit } = reading;
    const group = groups.get(prefix) ?? { name: prefix, kind: null, hasCommands: false, columns: {}, twice: {}, times: [], clocks: [] };
    groups.set(prefix, group);
    // If there are headings in radians and degrees, those in radians were recorded, and those in degrees are derived.
    const column = { at: index, name: name.trim(), rank: rank + (unit === 'deg' ? 0.5 : 0), ...(unit !== undefined && { unit }) };
    if (field === 't') group.times.push(column);
    const knownColumn = group.columns[field];
    if (!knownColumn || column.rank < knownColumn.rank) {
      group.columns[field] = column;
      delete group.twice[field];
    } else if (column.rank === knownColumn.rank) group.twice[field] ??= column;
  }
  const allGroups = [...groups.values()];
  const clocksByGroup = new Map(allGroups.map((group) => [group, clocksOf(group)]));
  const sharedClocks = groups.get('') ? (clocksByGroup.get(groups.get('') as Group) ?? []) : [];
  const allClocks = allGroups.flatMap((group) => clocksByGroup.get(group) ?? []);
  const { source } = groups.get('')?.columns ?? {};
  for (const group of allGroups) {
    if (source) group.columns.source ??= source;
    group.clocks = [...new Set([...(clocksByGroup.get(group) ?? []), ...sharedClocks])].slice(0, 2);
    // If a table has only one clock, all of its groups use it.
    if (group.clocks.length === 0 && allClocks.length === 1) group.clocks = allClocks;
    const has = (...fields: Field[]) => fields.every((field) => group.columns[field]);
    group.hasCommands = has('v', 'omega');
    group.kind = has('x', 'y') ? (has('yaw') || has('qz', 'qw') ? 'poses' : 'positions') : group.hasCommands ? 'commands' : null;
    if (group.clocks.length === 0) group.kind = null;
    if (group.kind === 'positions' && group.hasCommands) group.kind = 'commands';
  }
  return allGroups.filter(({ columns }) => columns.x || columns.y || columns.v || columns.omega || columns.yaw || columns.qw).map((group) => ({ ...group, name: groupName(group, names) }));
}

const clockOf = (column: Column): Clock => ({ name: column.name, columns: [column], ...(column.unit !== undefined && { unit: column.unit as TimeUnit }) });

/** Returns the clocks of a group. The stamp of the message comes first, because the other clock may be the time of recording. */
function clocksOf({ columns: { seconds, subseconds }, times }: Group): Clock[] {
  const singleClocks = times.toSorted((one, other) => one.rank - other.rank).map(clockOf);
  if (seconds && subseconds) return [{ name: `${seconds.name}, ${subseconds.name}`, columns: [seconds, subseconds], unit: 's' }, ...singleClocks];
  const partOfTime = seconds ?? subseconds;
  return singleClocks.length > 0 || !partOfTime ? singleClocks : [clockOf(partOfTime)];
}

/** Returns the common prefix or suffix of a group's columns, as written in the table. Without either, returns the names of the columns. */
function groupName({ name, columns }: Group, names: string[]): string {
  if (name === '') return '';
  const { x, v, yaw, omega } = columns;
  const [first] = [x, v, yaw, omega].filter((column) => column !== undefined);
  const raw = names[first?.at ?? 0].trim().replace(/^%?(field\.)?/, '');
  for (let end = 1; end < raw.length; end++) {
    if (/[^\p{L}\p{N}]/u.test(raw[end]) && dottedName(raw.slice(0, end)) === name) return raw.slice(0, raw[end] === '_' ? end + 1 : end);
  }
  for (let start = 1; start < raw.length; start++) if (dottedName(raw.slice(start)) === name) return raw.slice(start);
  return name;
}

/** Columns that are read for a log. */
export interface Layout {
  kind: LogKind | 'positions';
  clocks: Clock[];
  /** x, y and heading, or v and omega. */
  columns: Column[];
  fields: Field[];
  length: LengthUnit | undefined;
  angle: AngleUnit | undefined;
}

/**
 * Returns the columns of a group from which a log is read.
 *
 * @param wantedKind kind of the log: `commands` prefers commands to poses, and `poses` excludes commands; by default poses come first
 * @throws {LogError} if a field is missing, or two columns can be the same field
 */
export function layoutOf(group: Group | undefined, names: string[], place: Place, wantedKind: LogKind | undefined): Layout {
  const columnNames = listing(names.map((name) => name.trim()));
  const ask: Question = { what: 'columns', choices: [], columns: names };
  if (!group) throw new LogError(place, (say) => say.noColumns(wantedKind === 'poses' ? wantedKind : 'either', columnNames), ask);
  const { columns, twice, clocks } = group;
  const has = (...fields: Field[]) => fields.every((field) => columns[field]);
  if (clocks.length === 0) throw new LogError(place, (say) => say.noTime(columnNames), ask);
  const takesCommands = group.hasCommands && wantedKind !== 'poses' && (wantedKind === 'commands' || group.kind === 'commands');
  if (!takesCommands && !has('x', 'y')) throw new LogError(place, (say) => say.noColumns(wantedKind === 'poses' ? wantedKind : 'either', columnNames), ask);
  const headingFields: Field[] = has('qx', 'qy', 'qz', 'qw') ? ['qx', 'qy', 'qz', 'qw'] : has('yaw') ? ['yaw'] : has('qz', 'qw') ? ['qz', 'qw'] : [];
  const fields: Field[] = takesCommands ? ['v', 'omega'] : ['x', 'y', ...headingFields];
  for (const field of [...(clocks[0].columns[0] === columns.t ? ['t' as const] : []), ...fields]) {
    const [firstColumn, secondColumn] = [columns[field], twice[field]];
    if (firstColumn && secondColumn) throw new LogError(place, (say) => say.twice(field, cut(firstColumn.name), cut(secondColumn.name)), ask);
  }
  const readColumns = fields.map((field) => columns[field] as Column);
  const [lengthUnit, ...others] = new Set((takesCommands ? readColumns.slice(0, 1) : readColumns.slice(0, 2)).map(({ unit }) => unit));
  const angleUnit = takesCommands ? columns.omega?.unit : headingFields[0] === 'yaw' ? columns.yaw?.unit : undefined;
  const isUnknownUnit = (unit: string | undefined, known: readonly string[]) => unit !== undefined && !known.includes(unit);
  const unknownUnit = [lengthUnit, ...others].find((unit) => isUnknownUnit(unit, UNITS.lengthUnit)) ?? (isUnknownUnit(angleUnit, UNITS.angleUnit) ? angleUnit : undefined);
  if (unknownUnit !== undefined) throw new LogError(place, (say) => say.unknownUnit(cut(unknownUnit)));
  if (others.length > 0) throw new LogError(place, (say) => say.unknownUnit([lengthUnit, ...others].map((unit) => unit ?? '–').join(', ')));
  return {
    kind: takesCommands ? 'commands' : headingFields.length > 0 ? 'poses' : 'positions',
    clocks, columns: readColumns, fields, length: lengthUnit as LengthUnit | undefined, angle: angleUnit as AngleUnit | undefined,
  };
}

/** Returns true for a header, which has names in some cells. */
export const isHeader = (cells: string[]) => cells.some((cell) => /\p{L}/u.test(cell) && !/^[+-]?(nan|inf(inity)?|[\d.,]+e[+-]?\d+)$/i.test(cell.trim()));
