/** Command `inspect`: the contents of recordings, and the command to go on with. */

import { candidates, isLocalizer, isTable, usefulSeries } from '../logs/candidates.ts';
import { planDrives, type Part, type Plan } from '../logs/drives.ts';
import { english } from '../logs/en.ts';
import { LogError, cut } from '../logs/log-error.ts';
import { ROLES, framesOption, framesText, type Choice, type Log, type Recording, type Role, type Summary } from '../logs/log.ts';
import { summarize } from '../logs/summary.ts';
import { adviceOf, quoted } from './advice.ts';
import { aligned } from './report.ts';

const FORMATS: Partial<Record<Recording['format'], string>> = { mcap: 'MCAP recording', rosbag: 'ROS 1 bag', sqlite: 'rosbag2 SQLite recording', csv: 'table', tum: 'TUM table' };

/** Contents of a recording. */
export interface Contents {
  name: string;
  format: Recording['format'];
  series: { name: string; type: string; rows: number; uses: string[]; summary?: Summary; sentences?: string[] }[];
  /** Sentences about series that cannot be read. */
  refused: string[];
}

/** Contents of all recordings that are given together. */
export interface Inspected {
  recordings: Contents[];
  /** Sentence about what a calibration still needs, or assumes. */
  missing?: string;
  /** Command to go on with; undefined where nothing can be used. */
  command?: string;
}

/** Recording with the path by which it was given. */
export interface Given { recording: Recording; path: string }

/**
 * Returns the contents of recordings, with the logs that could be odometry or reference.
 *
 * @param stated options about units and columns, which the command needs too
 */
export async function inspect(given: Given[], stated: [name: string, value: string][], onProgress?: (share: number | undefined) => void): Promise<Inspected> {
  const recordings: Contents[] = [];
  for (const { recording } of given) recordings.push(await contentsOf(recording, onProgress));
  onProgress?.(undefined);
  const isRefused = recordings.some(({ series, refused }) => refused.length > 0 && !series.some(({ summary }) => summary));
  return { recordings, ...(isRefused ? {} : nextOf(given, stated)) };
}

async function contentsOf(recording: Recording, onProgress?: (share: number | undefined) => void): Promise<Contents> {
  const { name, format } = recording;
  // Each chain of transforms that could be a log has its own entry.
  const entries = recording.series.flatMap((each) => {
    const usable: { choice?: Choice; uses: string[] }[] = usesOf(recording, each.name);
    return (usable.length > 0 ? usable : [{ uses: [] }]).map((use) => ({ ...each, ...use }));
  });
  const { logs, reasons } = await read(recording, entries.flatMap(({ choice }) => choice ?? []), onProgress);
  const series = entries.map(({ name: its, type, count, uses, choice }) => {
    const log = choice && logs.get(choice);
    const label = choice?.frames ? `${its} (${framesText(choice.frames)})` : its;
    return { name: label, type, rows: log?.summary.rows ?? count, uses, ...(log && { summary: log.summary, sentences: summarize(log, english.found) }) };
  });
  return { name, format, series, refused: reasons };
}

/** Returns the contents as text. */
export function textOf({ recordings, missing, command }: Inspected): string {
  const lines = recordings.flatMap(({ name, format, series, refused }) => {
    const rows = series.map(({ name: its, type, rows: count, uses, summary }) => [its || '(all columns)', isTable({ format }) ? cut(type) : type, String(count || ''), summary ? `${summary.rate.toPrecision(3)} Hz` : '', uses.join(' or ')]);
    const found = series.flatMap(({ name: its, sentences = [] }) => sentences.map((line, i) => (i > 0 ? `  ${line}` : its ? `${its}: ${line}` : line)));
    return [`${name}: ${FORMATS[format] ?? format}`, ...[...aligned([[isTable({ format }) ? 'columns' : 'topic', 'type', 'rows', 'rate', 'could be'], ...rows]), ...found].map((line) => `  ${line}`), ...refused];
  });
  return [...lines, ...(missing ? [missing] : []), ...(command ? ['', `  ${command}`] : []), ''].join('\n');
}

/** Returns the logs that a series could be, several for transforms, each with texts about its roles. */
function usesOf(recording: Recording, name: string): { choice: Choice; uses: string[] }[] {
  if (!usefulSeries(recording).some((each) => each.name === name)) return [];
  const found = new Map<string, { choice: Choice; uses: string[] }>();
  const add = (role: Role, kind?: 'commands') => {
    for (const { series, frames, kind: its } of candidates(recording, role, { kind }).flat()) {
      if (series !== name || (kind && its !== kind)) continue;
      const use = role === 'odometry' ? `odometry${kind ? ' (commands)' : ''}` : `reference${isLocalizer(name, frames) ? ' (a localizer)' : ''}`;
      const key = frames ? framesText(frames) : '';
      const known = found.get(key) ?? { choice: { series, ...(frames && { frames }) }, uses: [] };
      if (!known.uses.some((each) => each.startsWith(role))) known.uses.push(use);
      found.set(key, known);
    }
  };
  add('odometry');
  add('odometry', 'commands');
  add('reference');
  return [...found.values()];
}

/** Reads logs in one pass, or one by one if any is refused. */
async function read(recording: Recording, choices: Choice[], onProgress?: (share: number) => void): Promise<{ logs: Map<Choice, Log>; reasons: string[] }> {
  const logs = new Map<Choice, Log>();
  const reasons: string[] = [];
  const readAll = async (some: Choice[]) => {
    try {
      for (const [i, log] of (await recording.read(some, onProgress)).entries()) logs.set(some[i], log);
    } catch (error) {
      if (!(error instanceof LogError)) throw error;
      if (some.length === 1) reasons.push(`${error.message}${adviceOf(error)}`);
      else for (const one of some) await readAll([one]);
    }
  };
  if (choices.length > 0) await readAll(choices);
  return { logs, reasons };
}

/** Returns a sentence about roles that only follow from the order of two files. */
export const byOrder = ({ unpaired: { odometry: [first], reference: [second] } }: Plan): string =>
  `${first.recording.name} is taken as the odometry and ${second.recording.name} as the reference, by their order: neither name says which is which.`;

/** Returns the command that calibrates from the recordings, or a sentence about missing logs. */
function nextOf(given: Given[], stated: [name: string, value: string][]): Pick<Inspected, 'command' | 'missing'> {
  const pathOf = ({ recording }: Pick<Part, 'recording'>) => quoted(given.find((each) => each.recording === recording)?.path ?? recording.name);
  const units = stated.map(([name, value]) => `--${name} ${quoted(value)}`);
  const command = (...options: string[]) => ['npx motion-widgets calibrate', ...new Set(options), ...units, '--rule nav2'].join(' ');
  const all = given.map(({ recording }) => pathOf({ recording }));
  try {
    const plan = planDrives(given.map(({ recording }) => recording));
    const { drives, unpaired } = plan;
    const choices = ROLES.flatMap((role) => [...drives.map((drive) => drive[role]), ...unpaired[role]].flatMap(({ choice: { series, frames } }) => [
      ...(series ? [`--${role}-topic ${quoted(series)}`] : []),
      ...(frames ? [`--${role}-frames ${quoted(framesOption(frames))}`] : []),
    ]));
    const files = [...drives.map(({ odometry }) => pathOf(odometry)), ...ROLES.flatMap((role) => unpaired[role].map((part) => `--${role} ${pathOf(part)}`))];
    // A folder with several logs has no single role.
    const isShared = new Set(all).size < all.length;
    return { ...(plan.isByOrder && { missing: byOrder(plan) }), command: command(...(isShared ? all : files), ...choices) };
  } catch (error) {
    if (!(error instanceof LogError)) throw error;
    const missing = error.message;
    const role = error.ask?.role ?? ROLES.find((each) => given.some(({ recording }) => candidates(recording, each).some(({ length }) => length > 0)));
    // The odometry is chosen first.
    const open = error.ask?.role === 'reference' ? ['reference'] : ROLES;
    switch (error.ask?.what) {
      case 'other': return { missing, ...(role && { command: command(`--${role} ${pathOf(given[0])}`, role === 'odometry' ? '--reference FILE' : '--odometry FILE') }) };
      case 'series': return { missing, command: command(...all, ...open.map((each) => `--${each}-topic NAME`)) };
      case 'frames': return { missing, command: command(...all, ...open.map((each) => `--${each}-frames PARENT,CHILD`)) };
      default: return { missing };
    }
  }
}
