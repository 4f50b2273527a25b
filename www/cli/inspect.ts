/** Command `inspect`: the contents of a recording, and the command to go on with. */

import { candidates, isLocalizer, isTable, usefulSeries } from '../logs/candidates.ts';
import { planDrives } from '../logs/drives.ts';
import { log as words } from '../logs/en.ts';
import { LogError } from '../logs/log-error.ts';
import { ROLES, type Choice, type Log, type Recording, type Role } from '../logs/log.ts';
import { summarize } from '../logs/summary.ts';
import { aligned } from './report.ts';

/** Names of the formats. */
const FORMATS: Partial<Record<Recording['format'], string>> = { mcap: 'MCAP recording', rosbag: 'ROS 1 bag', sqlite: 'rosbag2 SQLite recording', csv: 'table', tum: 'TUM table' };

/** Returns the report about a recording. */
export async function inspect(recording: Recording, path: string, onProgress?: (share: number | undefined) => void): Promise<string> {
  const { name, format, series } = recording;
  const uses = new Map(series.map(({ name: its }) => [its, usesOf(recording, its)]));
  const { logs, reasons } = await read(recording, usefulSeries(recording).filter(({ name: its, kind }) => kind !== 'transforms' && uses.get(its) !== '').map(({ name: its }) => its), onProgress);
  onProgress?.(undefined);
  const rows = series.map(({ name: its, type, count }) => {
    const log = logs.get(its);
    return [its || '(all columns)', type, String(log?.summary.rows ?? (count || '')), log ? `${log.summary.rate.toPrecision(3)} Hz` : '', uses.get(its) ?? ''];
  });
  const found = [...logs].flatMap(([its, log]) => summarize(log, words.found).map((line, i) => (i > 0 ? `  ${line}` : its ? `${its}: ${line}` : line)));
  return [
    `${name}: ${FORMATS[format] ?? format}`,
    ...aligned([[isTable(recording) ? 'columns' : 'topic', 'type', 'rows', 'rate', 'could be'], ...rows]).map((line) => `  ${line}`),
    ...found.map((line) => `  ${line}`),
    ...reasons,
    ...(reasons.length > 0 && logs.size === 0 ? [] : commandOf(recording, path)),
    '',
  ].join('\n');
}

/** Says what a series could be. */
function usesOf(recording: Recording, name: string): string {
  const choices = (role: Role, kind?: 'commands') => candidates(recording, role, { kind }).flat().filter((choice) => choice.series === name && (!kind || choice.kind === kind));
  const frames = ([first]: Choice[]) => (first.frames ? ` ${first.frames.parent} → ${first.frames.child}` : '');
  const [odometry, commands, reference] = [choices('odometry'), choices('odometry', 'commands'), choices('reference')];
  return [
    ...(odometry.length ? [`odometry${frames(odometry)}`] : commands.length ? ['odometry (commands)'] : []),
    ...(reference.length ? [`reference${frames(reference)}${isLocalizer(name, reference[0].frames) ? ' (a localizer)' : ''}`] : []),
  ].join(' or ');
}

/** Reads series in one pass, or one by one if any is refused. */
async function read(recording: Recording, names: string[], onProgress?: (share: number) => void): Promise<{ logs: Map<string, Log>; reasons: string[] }> {
  const logs = new Map<string, Log>();
  const reasons: string[] = [];
  const readAll = async (some: string[]) => {
    try {
      for (const [i, log] of (await recording.read(some.map((series) => ({ series })), onProgress)).entries()) logs.set(some[i], log);
    } catch (error) {
      if (!(error instanceof LogError)) throw error;
      if (some.length === 1) reasons.push(error.message);
      else for (const one of some) await readAll([one]);
    }
  };
  if (names.length > 0) await readAll(names);
  return { logs, reasons };
}

/** Returns the command that calibrates from the recording. */
function commandOf(recording: Recording, path: string): string[] {
  const quoted = (text: string) => (/^[\w./,@%+=:-]+$/.test(text) ? text : `'${text.replaceAll("'", "'\\''")}'`);
  const optionsOf = (role: Role, { series, frames }: Choice) => [
    ...(series ? [`--${role}-topic ${quoted(series)}`] : []),
    ...(frames ? [`--${role}-frames ${quoted(`${frames.parent},${frames.child}`)}`] : []),
  ];
  const start = 'motion-widgets calibrate';
  try {
    const { drives: [drive] } = planDrives([recording]);
    return ['', `  ${[`${start} --recording ${quoted(path)}`, ...ROLES.flatMap((role) => optionsOf(role, drive[role].choice))].join(' ')} --rule nav2`];
  } catch (error) {
    if (!(error instanceof LogError)) throw error;
    const [role] = ROLES.filter((each) => candidates(recording, each).some(({ length }) => length > 0));
    if (!role) return [];
    const other = role === 'odometry' ? '--reference FILE' : '--odometry FILE';
    if (usefulSeries(recording).length === 1) return ['', `  ${start} --${role} ${quoted(path)} ${other} --rule nav2`];
    return ['', `  ${start} --recording ${quoted(path)} --odometry-topic NAME --reference-topic NAME --rule nav2`];
  }
}
