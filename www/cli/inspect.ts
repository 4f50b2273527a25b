/** Command `inspect`: lists the contents of recordings, and proposes the command for the calibration. */

import { group } from 'd3-array';
import { findCandidates, isLocalizer, planDrives } from '../logs/drives.ts';
import { english } from '../logs/en.ts';
import { LogError, truncate, ROLES, formatFramesOption, formatFrames, summarySentencesOf, type LogChoice, type Recording, type Role, type Summary } from '../logs/log.ts';
import { adviseOption, quoteForShell } from './advice.ts';
import { alignRows } from './report.ts';
import type { OpenedInputs } from './run.ts';

const FORMAT_NAMES: Record<Recording['format'], string> = { mcap: 'MCAP recording', rosbag: 'ROS 1 bag', sqlite: 'rosbag2 SQLite recording', csv: 'table' };

/**
 * Returns the contents of recordings, and the command that calibrates from them with the stated options, or sentences about what is missing.
 * `isUsable` is true if a log can be read, and none that the command needs is refused.
 */
export async function inspect({ givenRecordings, userChoices }: OpenedInputs, statedOptions: [name: string, value: string][], onProgress?: (fraction: number | undefined) => void) {
  const recordings: Awaited<ReturnType<typeof contentsOf>>[] = [];
  for (const { recording } of givenRecordings) recordings.push(await contentsOf(recording, onProgress));
  onProgress?.(undefined);
  const usableRecordings = givenRecordings.filter((_, i) => recordings[i].series.some(({ summary }) => summary));
  const refusalErrors = recordings.flatMap((recording) => recording.refused);
  const { command } = usableRecordings.length > 0 ? proposeCommand({ givenRecordings: usableRecordings, userChoices }, statedOptions) : {};
  // A log that was found and refused does not count as missing.
  const { missing } = command === undefined ? proposeCommand({ givenRecordings, userChoices }, statedOptions) : {};
  const isUsable = usableRecordings.length > 0 && (command !== undefined || refusalErrors.length === 0);
  return { inspection: { recordings, command, missing }, sentences: [...refusalErrors, ...(missing ? [missing] : [])], isUsable };
}

/** Returns the series of a recording with their logs, and sentences about the logs that cannot be read. */
async function contentsOf(recording: Recording, onProgress?: (fraction: number | undefined) => void) {
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
        refusalErrors.add(`${error.message}${adviseOption(error)}`);
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

/** Returns the logs that can be read from a series, each with texts about its possible roles. A series of transforms may have several logs. */
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

/** Returns the command that calibrates from the recordings, or a sentence about missing logs. */
function proposeCommand({ givenRecordings, userChoices }: OpenedInputs, statedOptions: [name: string, value: string][]): { command?: string; missing?: string } {
  const quotePath = (recording: Recording) => quoteForShell(givenRecordings.find((given) => given.recording === recording)?.path ?? recording.name);
  const quotedPaths = givenRecordings.map(({ recording }) => quotePath(recording));
  try {
    const plan = planDrives(givenRecordings.map(({ recording }) => recording), userChoices);
    const choiceOptions = ROLES.flatMap((role) => plan.flatMap(({ choices: { [role]: choice } }) => [
      ...(choice?.series ? [`--${role}-topic ${quoteForShell(choice.series)}`] : []),
      ...(choice?.frames ? [`--${role}-frames ${quoteForShell(formatFramesOption(choice.frames))}`] : []),
    ]));
    const fileArguments = plan.map(({ recording, choices }) => {
      const [role, ...otherRoles] = Object.keys(choices);
      return otherRoles.length ? quotePath(recording) : `--${role} ${quotePath(recording)}`;
    });
    // The logs of one folder may have different roles, so that the folder is given without a role.
    const isPathShared = new Set(quotedPaths).size < quotedPaths.length;
    const optionTexts = [...new Set([...(isPathShared ? quotedPaths : fileArguments), ...choiceOptions]), ...statedOptions.map(([name, value]) => `--${name} ${quoteForShell(value)}`)];
    return { command: ['npx motion-widgets calibrate', ...optionTexts, '--rule nav2'].join(' ') };
  } catch (error) {
    if (!(error instanceof LogError)) throw error;
    return { missing: `${error.message}${adviseOption(error)}` };
  }
}
