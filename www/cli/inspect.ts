/** Command `inspect`: lists the contents of recordings, and proposes the command for the calibration. */

import { group } from 'd3-array';
import { findCandidates, isLocalizer, planDrives } from '../logs/drives.ts';
import { english } from '../logs/en.ts';
import { LogError, truncate, ROLES, formatFramesOption, formatFrames, summarySentencesOf, type LogChoice, type Recording, type Role, type Summary } from '../logs/log.ts';
import { explainWithCommand, formatCommand } from './options.ts';
import { alignRows } from './report.ts';
import type { OpenedInputs } from './run.ts';

const FORMAT_NAMES: Record<Recording['format'], string> = { mcap: 'MCAP recording', rosbag: 'ROS 1 bag', sqlite: 'rosbag2 SQLite recording', csv: 'table' };

/**
 * Returns the contents of recordings, and the `calibrate` command for them, or sentences about the logs that this command lacks. `isUsable` is true if at
 * least one log can be read, and no log that `calibrate` needs was refused.
 */
export async function inspect({ givenRecordings, userChoices }: OpenedInputs, typedArgs: string[], onProgress?: (fraction: number | undefined) => void) {
  const recordings: Awaited<ReturnType<typeof contentsOf>>[] = [];
  for (const { recording } of givenRecordings) recordings.push(await contentsOf(recording, typedArgs, onProgress));
  onProgress?.(undefined);
  const usableRecordings = givenRecordings.filter((_, i) => recordings[i].series.some(({ summary }) => summary));
  const unusablePaths = givenRecordings.filter(({ path }) => usableRecordings.every((usable) => usable.path !== path)).map(({ path }) => path);
  const refusalErrors = recordings.flatMap((recording) => recording.refused);
  const { command } = usableRecordings.length > 0 ? proposeCommand({ givenRecordings: usableRecordings, userChoices }, typedArgs.filter((arg) => !unusablePaths.includes(arg))) : {};
  // A log that was found but refused is not reported as missing.
  const { missing } = command === undefined ? proposeCommand({ givenRecordings, userChoices }, typedArgs) : {};
  const isUsable = usableRecordings.length > 0 && (command !== undefined || refusalErrors.length === 0);
  return { inspection: { recordings, command, missing }, sentences: [...refusalErrors, ...(missing ? [missing] : [])], isUsable };
}

/** Returns the series of a recording with their logs, and sentences about the logs that cannot be read. */
async function contentsOf(recording: Recording, typedArgs: string[], onProgress?: (fraction: number | undefined) => void) {
  const { name, format } = recording;
  const series: { name: string; type: string; rows: number; uses: string[]; summary?: Summary; sentences?: string[] }[] = [];
  const refusalErrors = new Set<string>();
  for (const { name: seriesName, type, count } of recording.series) {
    const possibleUses = usesOfSeries(recording, seriesName);
    if (possibleUses.length === 0) series.push({ name: seriesName, type, rows: count, uses: [] });
    // Each chain of transforms that could be a log has its own entry.
    for (const { choice, uses } of possibleUses) {
      const seriesEntry = { name: choice.frames ? `${seriesName} (${formatFrames(choice.frames)})` : seriesName, type, rows: count, uses };
      try {
        const [log] = await recording.read([choice], onProgress);
        series.push({ ...seriesEntry, rows: log.summary.rows, summary: log.summary, sentences: summarySentencesOf(log, english.found) });
      } catch (error) {
        if (!(error instanceof LogError)) throw error;
        series.push(seriesEntry);
        refusalErrors.add(explainWithCommand(error, typedArgs));
      }
    }
  }
  return { name, format, series, refused: [...refusalErrors] };
}

export function formatInspection({ inspection: { recordings, command }, sentences, isUsable }: Awaited<ReturnType<typeof inspect>>): string {
  const recordingLines = recordings.flatMap(({ name, format, series }) => {
    const tableRows = series.map(({ name: seriesName, type, rows: count, uses, summary }) => [seriesName || '(all columns)', format === 'csv' ? truncate(type) : type, String(count || ''), summary ? `${summary.rate.toPrecision(3)} Hz` : '', uses.join(' or ')]);
    const summaryLines = series.flatMap(({ name: seriesName, sentences = [] }) => sentences.map((line, i) => (i > 0 ? `  ${line}` : seriesName ? `${seriesName}: ${line}` : line)));
    return [`${name}: ${FORMAT_NAMES[format]}`, ...[...alignRows([[format === 'csv' ? 'columns' : 'topic', 'type', 'rows', 'rate', 'could be'], ...tableRows]), ...summaryLines].map((line) => `  ${line}`)];
  });
  return [...recordingLines, ...(isUsable ? sentences : []), ...(command ? ['', `  ${command}`] : []), ''].join('\n');
}

/** Returns the logs that can be read from a series, each with its possible roles in words. A series of transforms may have several logs. */
function usesOfSeries(recording: Recording, name: string): { choice: LogChoice; uses: string[] }[] {
  const rolesAndKinds: [Role, 'commands'?][] = [['odometry'], ['odometry', 'commands'], ['reference']];
  const uses = rolesAndKinds.flatMap(([role, wantedKind]) => {
    const candidates = findCandidates(recording, role, { kind: wantedKind }).flat().filter((choice) => choice.series === name && (!wantedKind || choice.kind === wantedKind));
    const suffixOf = ({ frames }: LogChoice) => (wantedKind ? ' (commands)' : role === 'reference' && isLocalizer(name, frames) ? ' (a localizer)' : '');
    return candidates.map((choice) => ({ frames: choice.frames, text: `${role}${suffixOf(choice)}` }));
  });
  return Array.from(group(uses, ({ frames }) => frames && formatFramesOption(frames)).values(), (usesOfLog) => ({
    choice: { series: name, ...(usesOfLog[0].frames && { frames: usesOfLog[0].frames }) }, uses: [...new Set(usesOfLog.map(({ text }) => text))],
  }));
}

/** Returns the command that calibrates from the recordings of an inspection, or a sentence about missing logs. */
function proposeCommand({ givenRecordings, userChoices }: OpenedInputs, typedArgs: string[]): { command?: string; missing?: string } {
  try {
    const plan = planDrives(givenRecordings.map(({ recording }) => recording), userChoices);
    const valueByOption = new Map(ROLES.flatMap((role) => plan.flatMap(({ choices: { [role]: choice } }): [string, string][] => [
      ...(choice?.series ? [[`--${role}-topic`, choice.series] as [string, string]] : []),
      ...(choice?.frames ? [[`--${role}-frames`, formatFramesOption(choice.frames)] as [string, string]] : []),
    ])));
    const addedOptions = [...valueByOption].filter(([option]) => !typedArgs.includes(option));
    return { command: formatCommand(['calibrate', ...typedArgs.slice(1).filter((arg) => arg !== '--json'), ...addedOptions.flat(), '--rule', 'nav2']) };
  } catch (error) {
    if (!(error instanceof LogError)) throw error;
    return { missing: explainWithCommand(error, typedArgs) };
  }
}
