/** Commands `calibrate` and `inspect`. */

import { writeFile } from 'node:fs/promises';
import { planDrives } from '../logs/drives.ts';
import { english } from '../logs/en.ts';
import { LogError, truncate, summarySentencesOf, type Recording } from '../logs/log.ts';
import { calibrationLogOf, readDrives, type Drive } from '../logs/pairs.ts';
import { adviseOption } from './advice.ts';
import { openRecordingsAt } from './files.ts';
import { inspect, formatInspection } from './inspect.ts';
import { HELP, UsageError, parseOptions, replaceFieldByOption, type CalibrateArguments } from './options.ts';
import { createDrivesSvg } from './plot.ts';
import { formatReportJson, formatLogSummaries, formatYamlWithNotes, formatReport, formatVerdict, type CalibrationReport } from './report.ts';

interface CliEnvironment {
  load(): Promise<any>;
  print(text: string): void;
  printError(text: string): void;
  /** Shows the progress of reading; undefined hides it. */
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
      const contents = await inspect(await openInputs(options, onSkip), options.statedOptions, onProgress);
      print(options.isJson ? `${JSON.stringify(contents.inspection, undefined, 1)}\n` : formatInspection(contents));
      if (!contents.isUsable) {
        printError(`${contents.sentences.join('\n')}\n`);
        return EXIT_BAD_INPUT;
      }
    } else return await calibrate(options, environment, onSkip);
    return EXIT_SUCCESS;
  } catch (error) {
    onProgress?.(undefined);
    if (!(error instanceof LogError || error instanceof UsageError)) throw error;
    printError(`${error.message}${error instanceof LogError ? adviseOption(error) : ''}\n`);
    return EXIT_BAD_INPUT;
  }
}

/** Opens the recordings of all inputs, and returns each with the path of its input. */
async function openInputs({ inputs, userChoices }: Pick<CalibrateArguments, 'inputs' | 'userChoices'>, onSkip: (error: LogError) => void) {
  const givenRecordings: { recording: Recording; path: string }[] = [];
  for (const input of inputs) {
    givenRecordings.push(...(await openRecordingsAt(input, onSkip)).map((recording) => ({ recording, path: input.path })));
  }
  return { givenRecordings, userChoices };
}

export type OpenedInputs = Awaited<ReturnType<typeof openInputs>>;

async function calibrate({ fit: fitOptions, output: outputFormat, plot: plotPath, ...logArguments }: CalibrateArguments, { load, print, printError, onProgress, isColored = false, now = new Date() }: CliEnvironment, onSkip: (error: LogError) => void): Promise<number> {
  const motion = await load();
  // The core checks the options in a call without drives, so that their errors are reported before files are read.
  calibrateDrives(motion, fitOptions, []);
  const { givenRecordings, userChoices } = await openInputs(logArguments, onSkip);
  const drives = await readDrives(planDrives(givenRecordings.map(({ recording }) => recording), userChoices, onSkip), onProgress);
  onProgress?.(undefined);
  const [{ odometry: { start } }] = drives;
  const logs = drives.flatMap(({ odometry, reference }) => [odometry, reference]).map(({ name, ...log }) => ({ name, summary: log.summary, sentences: summarySentencesOf({ name, ...log }, english.found) }));
  // The summary is shown even if the fit is refused.
  if (outputFormat === 'text') print(formatLogSummaries(logs));
  if (outputFormat === 'yaml') printError(formatLogSummaries(logs));
  const calibration = calibrateDrives(motion, fitOptions, drives);
  const report: CalibrationReport = { calibration, options: fitOptions, logs, start, driveStarts: drives.map(({ odometry }) => odometry.data.t[0]), date: now.toISOString().slice(0, 10) };
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
