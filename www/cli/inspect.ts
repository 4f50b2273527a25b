/** Command `inspect`: the contents of a recording, and the command to go on with. */

import { candidates, isLocalizer, isTable, usefulSeries } from '../logs/candidates.ts';
import { planDrives } from '../logs/drives.ts';
import { log as words } from '../logs/en.ts';
import { LogError } from '../logs/log-error.ts';
import { ROLES, framesOption, framesText, type Choice, type Log, type Recording, type Role, type Summary } from '../logs/log.ts';
import { summarize } from '../logs/summary.ts';
import { aligned } from './report.ts';

/** Names of the formats. */
const FORMATS: Partial<Record<Recording['format'], string>> = { mcap: 'MCAP recording', rosbag: 'ROS 1 bag', sqlite: 'rosbag2 SQLite recording', csv: 'table', tum: 'TUM table' };

/** Contents of a recording. */
export interface Inspected {
  name: string;
  format: Recording['format'];
  series: { name: string; type: string; rows: number; uses: string[]; summary?: Summary; sentences?: string[] }[];
  /** Sentences about series that cannot be read. */
  refused: string[];
  /** Sentence about what a calibration still needs. */
  missing?: string;
  /** Command to go on with; undefined where nothing can be used. */
  command?: string;
}

/** Returns the contents of a recording, with the logs that could be odometry or reference. */
export async function inspect(recording: Recording, path: string, onProgress?: (share: number | undefined) => void): Promise<Inspected> {
  const { name, format } = recording;
  const uses = new Map(recording.series.map(({ name: its }) => [its, usesOf(recording, its)]));
  const { logs, reasons } = await read(recording, usefulSeries(recording).filter(({ name: its, kind }) => kind !== 'transforms' && uses.get(its)?.length).map(({ name: its }) => its), onProgress);
  onProgress?.(undefined);
  const series = recording.series.map(({ name: its, type, count }) => {
    const log = logs.get(its);
    return { name: its, type, rows: log?.summary.rows ?? count, uses: uses.get(its) ?? [], ...(log && { summary: log.summary, sentences: summarize(log, words.found) }) };
  });
  return { name, format, series, refused: reasons, ...(reasons.length > 0 && logs.size === 0 ? {} : nextOf(recording, path)) };
}

/** Returns the contents as text. */
export function textOfContents({ name, format, series, refused, missing, command }: Inspected): string {
  const rows = series.map(({ name: its, type, rows: count, uses, summary }) => [its || '(all columns)', type, String(count || ''), summary ? `${summary.rate.toPrecision(3)} Hz` : '', uses.join(' or ')]);
  const found = series.flatMap(({ name: its, sentences = [] }) => sentences.map((line, i) => (i > 0 ? `  ${line}` : its ? `${its}: ${line}` : line)));
  return [
    `${name}: ${FORMATS[format] ?? format}`,
    ...[...aligned([[isTable({ format }) ? 'columns' : 'topic', 'type', 'rows', 'rate', 'could be'], ...rows]), ...found].map((line) => `  ${line}`),
    ...refused,
    ...(missing ? [missing] : []),
    ...(command ? ['', `  ${command}`] : []),
    '',
  ].join('\n');
}

/** Says what a series could be. */
function usesOf(recording: Recording, name: string): string[] {
  const choices = (role: Role, kind?: 'commands') => candidates(recording, role, { kind }).flat().filter((choice) => choice.series === name && (!kind || choice.kind === kind));
  const frames = ([first]: Choice[]) => (first.frames ? ` ${framesText(first.frames)}` : '');
  const [odometry, commands, reference] = [choices('odometry'), choices('odometry', 'commands'), choices('reference')];
  return [
    ...(odometry.length ? [`odometry${frames(odometry)}`] : commands.length ? ['odometry (commands)'] : []),
    ...(reference.length ? [`reference${frames(reference)}${isLocalizer(name, reference[0].frames) ? ' (a localizer)' : ''}`] : []),
  ];
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

/** Returns the command that calibrates from the recording, or what it lacks. */
function nextOf(recording: Recording, path: string): Pick<Inspected, 'command' | 'missing'> {
  const quoted = (text: string) => (/^[\w./,@%+=:-]+$/.test(text) ? text : `'${text.replaceAll("'", "'\\''")}'`);
  const optionsOf = (role: Role, { series, frames }: Choice) => [
    ...(series ? [`--${role}-topic ${quoted(series)}`] : []),
    ...(frames ? [`--${role}-frames ${quoted(framesOption(frames))}`] : []),
  ];
  const command = (...options: string[]) => ['motion-widgets calibrate', ...options, '--rule nav2'].join(' ');
  try {
    const { drives: [drive] } = planDrives([recording]);
    return { command: command(`--recording ${quoted(path)}`, ...ROLES.flatMap((role) => optionsOf(role, drive[role].choice))) };
  } catch (error) {
    if (!(error instanceof LogError)) throw error;
    const missing = error.message;
    const [role] = ROLES.filter((each) => candidates(recording, each).some(({ length }) => length > 0));
    if (error.ask?.what === 'other' && role) return { missing, command: command(`--${role} ${quoted(path)}`, role === 'odometry' ? '--reference FILE' : '--odometry FILE') };
    if (error.ask?.what === 'series') return { missing, command: command(`--recording ${quoted(path)}`, '--odometry-topic NAME', '--reference-topic NAME') };
    if (error.ask?.what === 'frames') return { missing, command: command(`--recording ${quoted(path)}`, '--odometry-frames PARENT,CHILD', '--reference-frames PARENT,CHILD') };
    return { missing };
  }
}
