/** Command `inspect`: the contents of recordings, and the command for the calibration. */

import { candidates, isLocalizer, isTable, readableSeries } from '../logs/candidates.ts';
import { planDrives, type RecordingChoice, type LogPlan } from '../logs/drives.ts';
import { english } from '../logs/en.ts';
import { LogError, cut } from '../logs/log-error.ts';
import { ROLES, framesOption, framesText, type Choice, type Log, type Recording, type Role, type Summary } from '../logs/log.ts';
import { summarySentences } from '../logs/summary.ts';
import { optionAdvice, shellQuoted } from './advice.ts';
import { alignRows } from './report.ts';

const FORMAT_NAMES: Partial<Record<Recording['format'], string>> = { mcap: 'MCAP recording', rosbag: 'ROS 1 bag', sqlite: 'rosbag2 SQLite recording', csv: 'table', tum: 'TUM table' };

/** Contents of a recording. */
export interface Contents {
  name: string;
  format: Recording['format'];
  series: { name: string; type: string; rows: number; uses: string[]; summary?: Summary; sentences?: string[] }[];
  /** Sentences about series that cannot be read. */
  refused: string[];
}

/** Contents of all recordings that are given together. */
export interface InspectionResult {
  recordings: Contents[];
  /** Sentence about a log that the calibration still needs, or an assumption that it makes. */
  missing?: string;
  /** Command for the calibration; undefined if no log can be used. */
  command?: string;
}

/** Recording with the path in the arguments. */
export interface GivenRecording { recording: Recording; path: string }

/**
 * Returns the contents of recordings, with the logs that could be odometry or reference.
 *
 * @param stated options about units and columns, which the command needs too
 */
export async function inspect(given: GivenRecording[], stated: [name: string, value: string][], onProgress?: (share: number | undefined) => void): Promise<InspectionResult> {
  const recordings: Contents[] = [];
  for (const { recording } of given) recordings.push(await contentsOf(recording, onProgress));
  onProgress?.(undefined);
  const refusedNames = recordings.flatMap(({ name, series, refused }) => (refused.length > 0 && !series.some(({ summary }) => summary) ? [name] : []));
  if (refusedNames.length === 0) return { recordings, ...nextCommand(given, stated) };
  const others = { missing: `Give two files without ${new Intl.ListFormat('en').format(refusedNames)}:`, command: commandText(stated, '--odometry FILE', '--reference FILE') };
  return { recordings, ...(refusedNames.length < recordings.length && others) };
}

async function contentsOf(recording: Recording, onProgress?: (share: number | undefined) => void): Promise<Contents> {
  const { name, format } = recording;
  // Each chain of transforms that could be a log has its own entry.
  const seriesEntries = recording.series.flatMap((entry) => {
    const possibleUses: { choice?: Choice; uses: string[] }[] = usesOfSeries(recording, entry.name);
    return (possibleUses.length > 0 ? possibleUses : [{ uses: [] }]).map((use) => ({ ...entry, ...use }));
  });
  const { logs, reasons } = await readLogs(recording, seriesEntries.flatMap(({ choice }) => choice ?? []), onProgress);
  const series = seriesEntries.map(({ name: seriesName, type, count, uses, choice }) => {
    const log = choice && logs.get(choice);
    const seriesLabel = choice?.frames ? `${seriesName} (${framesText(choice.frames)})` : seriesName;
    return { name: seriesLabel, type, rows: log?.summary.rows ?? count, uses, ...(log && { summary: log.summary, sentences: summarySentences(log, english.found) }) };
  });
  return { name, format, series, refused: [...new Set(reasons)] };
}

/** Returns the contents as text. */
export function inspectionText({ recordings, missing, command }: InspectionResult): string {
  const contentLines = recordings.flatMap(({ name, format, series, refused }) => {
    const tableRows = series.map(({ name: seriesName, type, rows: count, uses, summary }) => [seriesName || '(all columns)', isTable({ format }) ? cut(type) : type, String(count || ''), summary ? `${summary.rate.toPrecision(3)} Hz` : '', uses.join(' or ')]);
    const summaryLines = series.flatMap(({ name: seriesName, sentences = [] }) => sentences.map((line, i) => (i > 0 ? `  ${line}` : seriesName ? `${seriesName}: ${line}` : line)));
    return [`${name}: ${FORMAT_NAMES[format] ?? format}`, ...[...alignRows([[isTable({ format }) ? 'columns' : 'topic', 'type', 'rows', 'rate', 'could be'], ...tableRows]), ...summaryLines].map((line) => `  ${line}`), ...refused];
  });
  return [...contentLines, ...(missing ? [missing] : []), ...(command ? ['', `  ${command}`] : []), ''].join('\n');
}

/** Returns the logs that can be read from a series (several for transforms), each with texts about its possible roles. */
function usesOfSeries(recording: Recording, name: string): { choice: Choice; uses: string[] }[] {
  if (!readableSeries(recording).some((series) => series.name === name)) return [];
  const usesByFrames = new Map<string, { choice: Choice; uses: string[] }>();
  const addUses = (role: Role, kind?: 'commands') => {
    for (const { series, frames, kind: candidateKind } of candidates(recording, role, { kind }).flat()) {
      if (series !== name || (kind && candidateKind !== kind)) continue;
      const useText = role === 'odometry' ? `odometry${kind ? ' (commands)' : ''}` : `reference${isLocalizer(name, frames) ? ' (a localizer)' : ''}`;
      const framesKey = frames ? framesText(frames) : '';
      const knownUse = usesByFrames.get(framesKey) ?? { choice: { series, ...(frames && { frames }) }, uses: [] };
      if (!knownUse.uses.some((use) => use.startsWith(role))) knownUse.uses.push(useText);
      usesByFrames.set(framesKey, knownUse);
    }
  };
  addUses('odometry');
  addUses('odometry', 'commands');
  addUses('reference');
  return [...usesByFrames.values()];
}

/** Reads logs in one pass, or one by one if any is refused. */
async function readLogs(recording: Recording, choices: Choice[], onProgress?: (share: number) => void): Promise<{ logs: Map<Choice, Log>; reasons: string[] }> {
  const logs = new Map<Choice, Log>();
  const reasons: string[] = [];
  const readTogether = async (choicesToRead: Choice[]) => {
    try {
      for (const [i, log] of (await recording.read(choicesToRead, onProgress)).entries()) logs.set(choicesToRead[i], log);
    } catch (error) {
      if (!(error instanceof LogError)) throw error;
      if (choicesToRead.length === 1) reasons.push(`${error.message}${optionAdvice(error)}`);
      else for (const choice of choicesToRead) await readTogether([choice]);
    }
  };
  if (choices.length > 0) await readTogether(choices);
  return { logs, reasons };
}

/** Returns a sentence that the roles of two files follow only from their order. */
export const byOrder = ({ unpaired: { odometry: [first], reference: [second] } }: LogPlan): string =>
  `${first.recording.name} is taken as the odometry and ${second.recording.name} as the reference, by their order: neither name says which is which.`;

const commandText = (stated: [name: string, value: string][], ...options: string[]) =>
  ['npx motion-widgets calibrate', ...options, ...stated.map(([name, value]) => `--${name} ${shellQuoted(value)}`), '--rule nav2'].join(' ');

/** Returns the command that calibrates from the recordings, or a sentence about missing logs. */
function nextCommand(given: GivenRecording[], stated: [name: string, value: string][]): Pick<InspectionResult, 'command' | 'missing'> {
  const quotedPath = ({ recording }: Pick<RecordingChoice, 'recording'>) => shellQuoted(given.find((file) => file.recording === recording)?.path ?? recording.name);
  const command = (...options: string[]) => commandText(stated, ...new Set(options));
  const paths = given.map(({ recording }) => quotedPath({ recording }));
  try {
    const plan = planDrives(given.map(({ recording }) => recording));
    const { drives, unpaired } = plan;
    const choiceOptions = ROLES.flatMap((role) => [...drives.map((drive) => drive[role]), ...unpaired[role]].flatMap(({ choice: { series, frames } }) => [
      ...(series ? [`--${role}-topic ${shellQuoted(series)}`] : []),
      ...(frames ? [`--${role}-frames ${shellQuoted(framesOption(frames))}`] : []),
    ]));
    const files = [...drives.map(({ odometry }) => quotedPath(odometry)), ...ROLES.flatMap((role) => unpaired[role].map((part) => `--${role} ${quotedPath(part)}`))];
    // A folder with several logs has no single role.
    const isPathShared = new Set(paths).size < paths.length;
    return { ...(plan.isByOrder && { missing: byOrder(plan) }), command: command(...(isPathShared ? paths : files), ...choiceOptions) };
  } catch (error) {
    if (!(error instanceof LogError)) throw error;
    const reason = error.message;
    const role = error.ask?.role ?? ROLES.find((candidateRole) => given.some(({ recording }) => candidates(recording, candidateRole).some(({ length }) => length > 0)));
    // The odometry is chosen first.
    const openRoles = error.ask?.role === 'reference' ? ['reference'] : ROLES;
    switch (error.ask?.what) {
      case 'other': return { missing: reason, ...(role && { command: command(`--${role} ${quotedPath(given[0])}`, role === 'odometry' ? '--reference FILE' : '--odometry FILE') }) };
      case 'series': return { missing: reason, command: command(...paths, ...openRoles.map((openRole) => `--${openRole}-topic NAME`)) };
      case 'frames': return { missing: reason, command: command(...paths, ...openRoles.map((openRole) => `--${openRole}-frames PARENT,CHILD`)) };
      default: return { missing: reason };
    }
  }
}
