/** Commands `calibrate` and `inspect`. */

import { writeFile } from 'node:fs/promises';
import { basename, resolve } from 'node:path';
import { planDrives } from '../logs/drives.ts';
import { english } from '../logs/en.ts';
import { LogError, truncate, mirroringQuestionsOf, summarySentencesOf, type Recording } from '../logs/log.ts';
import { optionsByNameOf } from '../logs/open.ts';
import { calibrationLogOf, readDrives, type Drive } from '../logs/pairs.ts';
import { openRecordingsAt } from './files.ts';
import { inspect, formatInspection } from './inspect.ts';
import { HELP, UsageError, answerQuestion, explainWithCommand, formatCommand, parseOptions, replaceFieldByOption, type CalibrateArguments } from './options.ts';
import { createDrivesSvg } from './plot.ts';
import { formatReportJson, formatLogSummaries, formatYamlWithNotes, formatReport, formatVerdict, type CalibrationReport } from './report.ts';

interface CliEnvironment {
  load(): Promise<any>;
  print(text: string): void;
  printError(text: string): void;
  /** Shows the fraction that has been read; undefined hides it. */
  onProgress?(fraction: number | undefined): void;
  version?: string;
  isColored?: boolean;
  now?: Date;
}

const [EXIT_SUCCESS, EXIT_BAD_INPUT, EXIT_UNUSABLE] = [0, 2, 3];

/** Runs a command, and returns the exit code; rejects only for defects of the program. */
export async function run(args: string[], environment: CliEnvironment): Promise<number> {
  const { print, printError, onProgress } = environment;
  const onSkip = ({ message }: LogError) => printError(`skipped: ${message}\n`);
  try {
    const options = parseOptions(args);
    if (options === 'help') print(HELP);
    else if (options === 'version') print(`${environment.version}\n`);
    else if (options.command === 'inspect') {
      const contents = await inspect(await openInputs(options, onSkip), args, onProgress);
      print(options.isJson ? `${JSON.stringify(contents.inspection, undefined, 1)}\n` : formatInspection(contents));
      if (!contents.isUsable) {
        printError(`${contents.sentences.join('\n')}\n`);
        return EXIT_BAD_INPUT;
      }
    } else return await calibrate(options, args, environment, onSkip);
    return EXIT_SUCCESS;
  } catch (error) {
    onProgress?.(undefined);
    if (!(error instanceof LogError || error instanceof UsageError)) throw error;
    printError(`${error instanceof LogError ? explainWithCommand(error, args) : error.message}\n`);
    return EXIT_BAD_INPUT;
  }
}

/** Opens the recordings of all inputs, and returns each with the path of its input. */
async function openInputs({ inputs, optionsByFile, userChoices }: Pick<CalibrateArguments, 'inputs' | 'optionsByFile' | 'userChoices'>, onSkip: (error: LogError) => void) {
  const pathBaseNames = inputs.map(({ path }) => basename(resolve(path)));
  // A file is named by its path if another file has the same base name.
  const names = pathBaseNames.map((baseName, i) => (pathBaseNames.indexOf(baseName) === pathBaseNames.lastIndexOf(baseName) ? baseName : inputs[i].path));
  const nameByPath = new Map(inputs.map(({ path }, i) => [path, names[i]]));
  const optionsOf = optionsByNameOf(optionsByFile.map(([file, options]) => [nameByPath.get(file) ?? file, options]));
  const givenRecordings: { recording: Recording; path: string }[] = [];
  for (const [i, input] of inputs.entries()) {
    givenRecordings.push(...(await openRecordingsAt(input, names[i], optionsOf, onSkip)).map((recording) => ({ recording, path: input.path })));
  }
  const recordingNames = givenRecordings.map(({ recording }) => recording.name);
  const unknownFile = optionsByFile.map(([file]) => nameByPath.get(file) ?? file).find((file) => file !== '' && !recordingNames.some((name) => file === name || file.startsWith(`${name}, `)));
  if (unknownFile !== undefined) throw new UsageError(`an option names the file ${truncate(unknownFile)}; the files are ${recordingNames.join(', ')}.`);
  return { givenRecordings, userChoices };
}

export type OpenedInputs = Awaited<ReturnType<typeof openInputs>>;

async function calibrate({ fit: fitOptions, output: outputFormat, plot: plotPath, ...logArguments }: CalibrateArguments, args: string[], { load, print, printError, onProgress, isColored = false, now = new Date() }: CliEnvironment, onSkip: (error: LogError) => void): Promise<number> {
  const motion = await load();
  // The core checks the options in a call without drives, so that errors in options are reported before files are read.
  calibrateDrives(motion, fitOptions, []);
  const { givenRecordings, userChoices } = await openInputs(logArguments, onSkip);
  const drives = await readDrives(planDrives(givenRecordings.map(({ recording }) => recording), userChoices, onSkip), onProgress);
  onProgress?.(undefined);
  const [{ odometry: { start } }] = drives;
  const logs = drives.flatMap(({ odometry, reference }) => [odometry, reference]).map(({ name, ...log }) => ({ name, summary: log.summary, sentences: summarySentencesOf({ name, ...log }, english.found) }));
  // The summaries are printed before the fit, so that the user sees them even if the fit is refused.
  if (outputFormat === 'text') print(formatLogSummaries(logs));
  if (outputFormat === 'yaml') printError(formatLogSummaries(logs));
  const calibration = calibrateDrives(motion, fitOptions, drives);
  const answeringArgs = mirroringQuestionsOf(drives, calibration.diagnostics.checks).reduce((typedArgs, question) => answerQuestion(question, typedArgs) ?? typedArgs, args);
  const report: CalibrationReport = { calibration, command: answeringArgs === args ? '' : formatCommand(answeringArgs), options: fitOptions, logs, start, driveStarts: drives.map(({ odometry }) => odometry.data.t[0]), date: now.toISOString().slice(0, 10) };
  if (plotPath !== undefined) await saveFile(plotPath, createDrivesSvg(drives, calibration));
  const isUnusableLog = calibration.recommended === null;
  if (outputFormat === 'yaml') {
    const { yaml, notes } = formatYamlWithNotes(report);
    printError([...formatVerdict(report), ...notes, ''].join('\n'));
    print(yaml);
    return isUnusableLog ? EXIT_UNUSABLE : yaml ? EXIT_SUCCESS : EXIT_BAD_INPUT;
  }
  print(outputFormat === 'json' ? formatReportJson(report) : formatReport(report, isColored));
  return isUnusableLog ? EXIT_UNUSABLE : EXIT_SUCCESS;
}

async function saveFile(path: string, text: string): Promise<void> {
  await writeFile(path, text).catch(({ code }: NodeJS.ErrnoException) => {
    throw new UsageError(`--plot ${truncate(path)} cannot be written (${code}).`);
  });
}

function calibrateDrives(motion: any, fitOptions: CalibrateArguments['fit'], drives: Drive[]): any {
  try {
    return motion.calibrate({ ...fitOptions, ...calibrationLogOf(drives) });
  } catch (error) {
    if (!(error instanceof RangeError || error instanceof TypeError)) throw error;
    const optionError = replaceFieldByOption(error.message);
    if (optionError === undefined && drives.length === 0) return undefined;
    const logNames = drives.flatMap(({ odometry, reference }) => [odometry.name, reference.name]);
    throw new UsageError(optionError ?? `${new Intl.ListFormat('en').format(logNames)}: ${error.message}.`);
  }
}
