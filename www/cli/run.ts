/** Commands `calibrate` and `inspect`. */

import { writeFile } from 'node:fs/promises';
import { basename, resolve } from 'node:path';
import { planDrives } from '../logs/drives.ts';
import { english } from '../logs/en.ts';
import { LogError, truncate, mirroringQuestionsOf, summarySentencesOf, type Recording } from '../logs/log.ts';
import { createOptionsFinder } from '../logs/open.ts';
import { calibrationLogOf, readDrives, type LoggedDrive } from '../logs/pairs.ts';
import { openRecordingsAt } from './files.ts';
import { inspectInputs, formatInspection } from './inspect.ts';
import { HELP_TEXT, UsageError, answerQuestion, explainWithCommand, formatCommand, parseOptions, replaceFieldByOption, type CalibrateArguments } from './options.ts';
import { createDrivesSvg } from './plot.ts';
import { formatReportJson, formatLogSummaries, formatYamlWithNotes, formatReport, formatVerdict, type CalibrationReport } from './report.ts';

interface CliEnvironment {
  load(): Promise<any>;
  print(outputText: string): void;
  printError(errorText: string): void;
  /** Shows the fraction of a file that has been read. Undefined hides this display. */
  onProgress?(progressFraction: number | undefined): void;
  version?: string;
  isColored?: boolean;
  currentDate?: Date;
}

const [EXIT_SUCCESS, EXIT_BAD_INPUT, EXIT_UNUSABLE] = [0, 2, 3];

/** Runs a command, and returns the exit code; rejects only for defects of the program. */
export async function runCommand(args: string[], cliEnvironment: CliEnvironment): Promise<number> {
  const { print: printOutput, printError, onProgress } = cliEnvironment;
  const onSkip = ({ message: errorMessage }: LogError) => printError(`skipped: ${errorMessage}\n`);
  try {
    const commandOptions = parseOptions(args);
    if (commandOptions === 'help') printOutput(HELP_TEXT);
    else if (commandOptions === 'version') printOutput(`${cliEnvironment.version}\n`);
    else if (commandOptions.command === 'inspect') {
      const inspectionResult = await inspectInputs(await openInputs(commandOptions, onSkip), args, onProgress);
      printOutput(commandOptions.isJson ? `${JSON.stringify(inspectionResult.inspection, undefined, 1)}\n` : formatInspection(inspectionResult));
      if (!inspectionResult.isUsable) {
        printError(`${inspectionResult.sentences.join('\n')}\n`);
        return EXIT_BAD_INPUT;
      }
    } else return await calibrateInputs(commandOptions, args, cliEnvironment, onSkip);
    return EXIT_SUCCESS;
  } catch (error) {
    onProgress?.(undefined);
    if (!(error instanceof LogError || error instanceof UsageError)) throw error;
    printError(`${error instanceof LogError ? explainWithCommand(error, args) : error.message}\n`);
    return EXIT_BAD_INPUT;
  }
}

/** Opens the recordings of all inputs, and returns each with the path of its input. */
async function openInputs({ inputPaths, optionsByFile, userChoices }: Pick<CalibrateArguments, 'inputPaths' | 'optionsByFile' | 'userChoices'>, onSkip: (error: LogError) => void) {
  const pathBaseNames = inputPaths.map(({ inputPath }) => basename(resolve(inputPath)));
  // A file is named by its path if another file has the same base name.
  const inputNames = pathBaseNames.map((baseName, i) => (pathBaseNames.indexOf(baseName) === pathBaseNames.lastIndexOf(baseName) ? baseName : inputPaths[i].inputPath));
  const nameByPath = new Map(inputPaths.map(({ inputPath }, i) => [inputPath, inputNames[i]]));
  const optionsOf = createOptionsFinder(optionsByFile.map(([fileName, openOptions]) => [nameByPath.get(fileName) ?? fileName, openOptions]));
  const givenRecordings: { recording: Recording; inputPath: string }[] = [];
  for (const [i, givenInput] of inputPaths.entries()) {
    givenRecordings.push(...(await openRecordingsAt(givenInput, inputNames[i], optionsOf, onSkip)).map((recording) => ({ recording, inputPath: givenInput.inputPath })));
  }
  const recordingNames = givenRecordings.map(({ recording }) => recording.recordingName);
  const unknownFile = optionsByFile.map(([fileName]) => nameByPath.get(fileName) ?? fileName).find((fileName) => fileName !== '' && !recordingNames.some((recordingName) => fileName === recordingName || fileName.startsWith(`${recordingName}, `)));
  if (unknownFile !== undefined) throw new UsageError(`an option names the file ${truncate(unknownFile)}; the files are ${recordingNames.join(', ')}.`);
  return { givenRecordings, userChoices };
}

export type OpenedInputs = Awaited<ReturnType<typeof openInputs>>;

async function calibrateInputs({ fitOptions, outputFormat, plotPath, ...logArguments }: CalibrateArguments, args: string[], { load: loadCore, print: printOutput, printError, onProgress, isColored = false, currentDate = new Date() }: CliEnvironment, onSkip: (error: LogError) => void): Promise<number> {
  const motionCore = await loadCore();
  // The core checks the options in a call without drives, so that errors in options are reported before files are read.
  calibrateDrives(motionCore, fitOptions, []);
  const { givenRecordings, userChoices } = await openInputs(logArguments, onSkip);
  const loggedDrives = await readDrives(planDrives(givenRecordings.map(({ recording }) => recording), userChoices, onSkip), onProgress);
  onProgress?.(undefined);
  const [{ odometry: { startTime } }] = loggedDrives;
  const reportedLogs = loggedDrives.flatMap(({ odometry: odometryLog, reference: referenceLog }) => [odometryLog, referenceLog]).map(({ logName, ...otherFields }) => ({ name: logName, summary: otherFields.logSummary, sentences: summarySentencesOf({ logName, ...otherFields }, english.logSummaryTexts) }));
  // The summaries are printed before the fit, so that the user sees them even if the fit is refused.
  if (outputFormat === 'text') printOutput(formatLogSummaries(reportedLogs));
  if (outputFormat === 'yaml') printError(formatLogSummaries(reportedLogs));
  const calibration = calibrateDrives(motionCore, fitOptions, loggedDrives);
  const answeringArgs = mirroringQuestionsOf(loggedDrives, calibration.diagnostics.checks).reduce((typedArgs, userQuestion) => answerQuestion(userQuestion, typedArgs) ?? typedArgs, args);
  const calibrationReport: CalibrationReport = { calibration, command: answeringArgs === args ? '' : formatCommand(answeringArgs), options: fitOptions, logs: reportedLogs, start: startTime, driveStarts: loggedDrives.map(({ odometry: odometryLog }) => odometryLog.motionData.t[0]), date: currentDate.toISOString().slice(0, 10) };
  if (plotPath !== undefined) await saveFile(plotPath, createDrivesSvg(loggedDrives, calibration));
  const isUnusableLog = calibration.recommended === null;
  if (outputFormat === 'yaml') {
    const { yaml, notes: yamlNotes } = formatYamlWithNotes(calibrationReport);
    printError([...formatVerdict(calibrationReport), ...yamlNotes, ''].join('\n'));
    printOutput(yaml);
    return isUnusableLog ? EXIT_UNUSABLE : yaml ? EXIT_SUCCESS : EXIT_BAD_INPUT;
  }
  printOutput(outputFormat === 'json' ? formatReportJson(calibrationReport) : formatReport(calibrationReport, isColored));
  return isUnusableLog ? EXIT_UNUSABLE : EXIT_SUCCESS;
}

async function saveFile(filePath: string, fileText: string): Promise<void> {
  await writeFile(filePath, fileText).catch(({ code: errorCode }: NodeJS.ErrnoException) => {
    throw new UsageError(`--plot ${truncate(filePath)} cannot be written (${errorCode}).`);
  });
}

function calibrateDrives(motionCore: any, fitOptions: CalibrateArguments['fitOptions'], loggedDrives: LoggedDrive[]): any {
  try {
    return motionCore.calibrate({ ...fitOptions, ...calibrationLogOf(loggedDrives) });
  } catch (error) {
    if (!(error instanceof RangeError || error instanceof TypeError)) throw error;
    const optionError = replaceFieldByOption(error.message);
    if (optionError === undefined && loggedDrives.length === 0) return undefined;
    const logNames = loggedDrives.flatMap(({ odometry: odometryLog, reference: referenceLog }) => [odometryLog.logName, referenceLog.logName]);
    throw new UsageError(optionError ?? `${new Intl.ListFormat('en').format(logNames)}: ${error.message}.`);
  }
}
