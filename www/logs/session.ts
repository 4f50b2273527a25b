/** Session that reads logs and calibrates in a worker, or in the thread of a page that cannot start one. */

import { transfer } from 'comlink';
import type { AlphaCalibratorSettings, CalibrationLog, Motion } from '../types.d.ts';
import { german } from './de.ts';
import { planDrives, type PlannedRecording, type UserChoices } from './drives.ts';
import { calibrationLogOf, readDrives, warningsOf, type LoggedDrive } from './pairs.ts';
import { english } from './en.ts';
import { LogError, choiceLabelOf, type OpenOptions, type Recording, type SourceFile, type LogWarning } from './log.ts';
import { openRecordings, createOptionsFinder } from './open.ts';

/** LogError as posted to the page, with its sentence in each language. */
export type LogFailure = Pick<LogError, 'message' | 'errorPlace' | 'userQuestion'> & { sentencesByLanguage: Record<'en' | 'de', string> };

/** Contents of files as posted to the page. */
export interface FileContents {
  /** Recordings without their methods, each with the choice of its logs. `logChoices` is missing if the logs were not chosen because of an error. */
  openedRecordings: (Pick<Recording, 'recordingName' | 'recordingFormat' | 'seriesList'> & Partial<Pick<PlannedRecording, 'logChoices'>>)[];
  /** Errors of files that were skipped. */
  skippedFiles: LogFailure[];
  /** Error because of which all files were refused. */
  refusalOfAll?: LogFailure;
  loggedDrives?: LoggedDrive[];
  /** Logs of all drives, and warnings that the α's are doubtful. */
  calibrationLog?: CalibrationLog;
  logWarnings?: LogWarning[];
}

/** Minimum time (ms) between reports of progress, because the page renders the figure after each report. */
const PROGRESS_INTERVAL_MS = 50;

/** Maximum number of files that the name of a log lists. */
const MAX_NAMED_FILES = 4;

export class LogSession {
  #simulation;

  constructor({ AlphaCalibrator }: Motion) {
    this.#simulation = new AlphaCalibrator();
  }

  /** Opens files, chooses their logs and reads them. The user's choices have precedence over guesses. */
  async readFiles(chosenFiles: { file: SourceFile; path: string }[], optionsByFile: Record<string, OpenOptions>, userChoices: UserChoices, onProgress: (progressFraction: number) => void): Promise<FileContents> {
    const skippedFiles: LogFailure[] = [];
    const onSkip = (error: LogError) => void skippedFiles.push(failureOf(error));
    const namedFiles = chosenFiles.map(({ file: chosenFile, path: pathInFolder }) => Object.assign(chosenFile, { path: pathInFolder }));
    let [openedRecordings, drivePlan]: [Recording[], PlannedRecording[] | undefined] = [[], undefined];
    const describeRecordings = () => openedRecordings.map(({ recordingName, recordingFormat, seriesList }, i) => ({ recordingName, recordingFormat, seriesList, logChoices: drivePlan?.find(({ recording }) => recording === openedRecordings[i])?.logChoices }));
    let nextProgress = 0;
    try {
      openedRecordings = await openRecordings(namedFiles, createOptionsFinder(Object.entries(optionsByFile)), onSkip);
      if (openedRecordings.length === 0) return { openedRecordings, skippedFiles, refusalOfAll: skippedFiles[0] };
      drivePlan = planDrives(openedRecordings, userChoices, onSkip);
      const loggedDrives = await readDrives(drivePlan, (progressFraction) => {
        const currentTime = performance.now();
        if (currentTime < nextProgress) return;
        nextProgress = currentTime + PROGRESS_INTERVAL_MS;
        onProgress(progressFraction);
      });
      const allLogs = loggedDrives.flatMap(({ odometry: odometryLog, reference: referenceLog }) => [odometryLog, referenceLog]);
      const dataColumns = allLogs.flatMap(({ motionData }) => Object.values(motionData) as ArrayBufferView[]);
      const fileContents = { openedRecordings: describeRecordings(), skippedFiles, loggedDrives, calibrationLog: { name: nameOf(drivePlan), ...calibrationLogOf(loggedDrives) }, logWarnings: warningsOf(allLogs.map(({ logSummary }) => logSummary)) };
      return transfer(fileContents, [...new Set(dataColumns.map(({ buffer: columnBuffer }) => columnBuffer as ArrayBuffer))]);
    } catch (error) {
      if (!(error instanceof LogError)) throw error;
      // If a file was skipped because of an open question, its log may be the missing one. That question is asked before the error is reported.
      const questionAboutSkipped = drivePlan ? undefined : skippedFiles.find(({ userQuestion }) => userQuestion);
      return { openedRecordings: describeRecordings(), skippedFiles, refusalOfAll: questionAboutSkipped ?? failureOf(error) };
    }
  }

  /** Returns the serialized fit to a log, which `AlphaCalibrator.restored` reads. */
  async calibrate(calibratorSettings: AlphaCalibratorSettings, { odometry, reference }: CalibrationLog): Promise<Uint8Array> {
    this.#simulation.setLog(odometry, reference);
    this.#simulation.configure(calibratorSettings);
    return this.#simulation.save();
  }
}

/** Returns the name of a log: the names of its files. For a single recording with odometry and reference, the topics are added. */
function nameOf(drivePlan: PlannedRecording[]): string {
  const [{ logChoices }] = drivePlan;
  const recordingNames = drivePlan.map(({ recording }) => recording.recordingName);
  return [...recordingNames.slice(0, MAX_NAMED_FILES), ...(recordingNames.length > MAX_NAMED_FILES ? ['…'] : []), ...(recordingNames.length === 1 ? Object.values(logChoices).map(choiceLabelOf) : [])].filter(Boolean).join(', ');
}

function failureOf({ message: errorMessage, errorPlace, userQuestion, composeMessage: formatMessage }: LogError): LogFailure {
  return { message: errorMessage, errorPlace, userQuestion, sentencesByLanguage: { en: formatMessage(english), de: formatMessage(german) } };
}
