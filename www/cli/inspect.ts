/** Command `inspect`: lists the contents of recordings, and proposes the command for the calibration. */

import { group } from 'd3-array';
import { findCandidates, isLocalizer, planDrives } from '../logs/drives.ts';
import { english } from '../logs/en.ts';
import { LogError, truncate, LOG_ROLES, formatFramesOption, formatFrames, summarySentencesOf, type LogChoice, type Recording, type LogRole, type LogSummary } from '../logs/log.ts';
import { explainWithCommand, formatCommand } from './options.ts';
import { alignRows } from './report.ts';
import type { OpenedInputs } from './run.ts';

const FORMAT_NAMES: Record<Recording['recordingFormat'], string> = { mcap: 'MCAP recording', rosbag: 'ROS 1 bag', sqlite: 'rosbag2 SQLite recording', csv: 'table' };

/**
 * Returns the contents of recordings, and the `calibrate` command for them, or sentences about the logs that this command lacks. `isUsable` is true if at
 * least one log can be read, and no log that `calibrate` needs was refused.
 */
export async function inspectInputs({ givenRecordings, userChoices }: OpenedInputs, typedArgs: string[], onProgress?: (progressFraction: number | undefined) => void) {
  const recordingContents: Awaited<ReturnType<typeof contentsOf>>[] = [];
  for (const { recording } of givenRecordings) recordingContents.push(await contentsOf(recording, typedArgs, onProgress));
  onProgress?.(undefined);
  const usableRecordings = givenRecordings.filter((_, i) => recordingContents[i].series.some(({ summary: logSummary }) => logSummary));
  const unusablePaths = givenRecordings.filter(({ inputPath }) => usableRecordings.every((usableRecording) => usableRecording.inputPath !== inputPath)).map(({ inputPath }) => inputPath);
  const refusalErrors = recordingContents.flatMap((recordingContent) => recordingContent.refused);
  const { command: calibrateCommand } = usableRecordings.length > 0 ? proposeCommand({ givenRecordings: usableRecordings, userChoices }, typedArgs.filter((argument) => !unusablePaths.includes(argument))) : {};
  // A log that was found but refused is not reported as missing.
  const { missing: missingSentence } = calibrateCommand === undefined ? proposeCommand({ givenRecordings, userChoices }, typedArgs) : {};
  const isUsable = usableRecordings.length > 0 && (calibrateCommand !== undefined || refusalErrors.length === 0);
  return { inspection: { recordings: recordingContents, command: calibrateCommand, missing: missingSentence }, sentences: [...refusalErrors, ...(missingSentence ? [missingSentence] : [])], isUsable };
}

/** Returns the series of a recording (topics or groups of columns) with their logs, and sentences about the logs that cannot be read. */
async function contentsOf(recording: Recording, typedArgs: string[], onProgress?: (progressFraction: number | undefined) => void) {
  const { recordingName, recordingFormat } = recording;
  const series: { name: string; type: string; rows: number; uses: string[]; summary?: LogSummary; sentences?: string[] }[] = [];
  const refusalErrors = new Set<string>();
  for (const { seriesName, messageType, messageCount } of recording.seriesList) {
    const possibleUses = usesOfSeries(recording, seriesName);
    if (possibleUses.length === 0) series.push({ name: seriesName, type: messageType, rows: messageCount, uses: [] });
    // If a topic has transforms, the output lists each chain of transforms that could be a log.
    for (const { choice: logChoice, uses: possibleRoles } of possibleUses) {
      const seriesEntry = { name: logChoice.framePair ? `${seriesName} (${formatFrames(logChoice.framePair)})` : seriesName, type: messageType, rows: messageCount, uses: possibleRoles };
      try {
        const [log] = await recording.readLogs([logChoice], onProgress);
        series.push({ ...seriesEntry, rows: log.logSummary.rows, summary: log.logSummary, sentences: summarySentencesOf(log, english.logSummaryTexts) });
      } catch (error) {
        if (!(error instanceof LogError)) throw error;
        series.push(seriesEntry);
        refusalErrors.add(explainWithCommand(error, typedArgs));
      }
    }
  }
  return { name: recordingName, format: recordingFormat, series, refused: [...refusalErrors] };
}

export function formatInspection({ inspection: { recordings, command: calibrateCommand }, sentences, isUsable }: Awaited<ReturnType<typeof inspectInputs>>): string {
  const recordingLines = recordings.flatMap(({ name: recordingName, format: recordingFormat, series }) => {
    const tableRows = series.map(({ name: seriesName, type: messageType, rows: count, uses: possibleRoles, summary: logSummary }) => [seriesName || '(all columns)', recordingFormat === 'csv' ? truncate(messageType) : messageType, String(count || ''), logSummary ? `${logSummary.rate.toPrecision(3)} Hz` : '', possibleRoles.join(' or ')]);
    const summaryLines = series.flatMap(({ name: seriesName, sentences = [] }) => sentences.map((summarySentence, i) => (i > 0 ? `  ${summarySentence}` : seriesName ? `${seriesName}: ${summarySentence}` : summarySentence)));
    return [`${recordingName}: ${FORMAT_NAMES[recordingFormat]}`, ...[...alignRows([[recordingFormat === 'csv' ? 'columns' : 'topic', 'type', 'rows', 'rate', 'could be'], ...tableRows]), ...summaryLines].map((reportLine) => `  ${reportLine}`)];
  });
  return [...recordingLines, ...(isUsable ? sentences : []), ...(calibrateCommand ? ['', `  ${calibrateCommand}`] : []), ''].join('\n');
}

/** Returns the logs that can be read from a topic or group of columns, each with its possible roles in words. A topic of transforms may have several logs. */
function usesOfSeries(recording: Recording, seriesName: string): { choice: LogChoice; uses: string[] }[] {
  const rolesAndKinds: [LogRole, 'commands'?][] = [['odometry'], ['odometry', 'commands'], ['reference']];
  const possibleRoles = rolesAndKinds.flatMap(([logRole, wantedKind]) => {
    const matchingChoices = findCandidates(recording, logRole, { logKind: wantedKind }).flat().filter((logChoice) => logChoice.seriesName === seriesName && (!wantedKind || logChoice.logKind === wantedKind));
    const suffixOf = ({ framePair }: LogChoice) => (wantedKind ? ' (commands)' : logRole === 'reference' && isLocalizer(seriesName, framePair) ? ' (a localizer)' : '');
    return matchingChoices.map((logChoice) => ({ framePair: logChoice.framePair, useText: `${logRole}${suffixOf(logChoice)}` }));
  });
  return Array.from(group(possibleRoles, ({ framePair }) => framePair && formatFramesOption(framePair)).values(), (usesOfLog) => ({
    choice: { seriesName, ...(usesOfLog[0].framePair && { framePair: usesOfLog[0].framePair }) }, uses: [...new Set(usesOfLog.map(({ useText }) => useText))],
  }));
}

/** Returns the command that calibrates from the recordings of an inspection, or a sentence about missing logs. */
function proposeCommand({ givenRecordings, userChoices }: OpenedInputs, typedArgs: string[]): { command?: string; missing?: string } {
  try {
    const drivePlan = planDrives(givenRecordings.map(({ recording }) => recording), userChoices);
    const valueByOption = new Map(LOG_ROLES.flatMap((logRole) => drivePlan.flatMap(({ logChoices: { [logRole]: logChoice } }): [string, string][] => [
      ...(logChoice?.seriesName ? [[`--${logRole}-topic`, logChoice.seriesName] as [string, string]] : []),
      ...(logChoice?.framePair ? [[`--${logRole}-frames`, formatFramesOption(logChoice.framePair)] as [string, string]] : []),
    ])));
    const addedOptions = [...valueByOption].filter(([optionName]) => !typedArgs.includes(optionName));
    return { command: formatCommand(['calibrate', ...typedArgs.slice(1).filter((argument) => argument !== '--json'), ...addedOptions.flat(), '--rule', 'nav2']) };
  } catch (error) {
    if (!(error instanceof LogError)) throw error;
    return { missing: explainWithCommand(error, typedArgs) };
  }
}
