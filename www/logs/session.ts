/** Session that reads logs and calibrates in a worker, or in the thread of a page that cannot start one. */

import { transfer } from 'comlink';
import type { AlphaCalibratorSettings, CalibrationLog, Motion } from '../types.d.ts';
import { german } from './de.ts';
import { planDrives, type PlannedRecording, type UserChoices } from './drives.ts';
import { calibrationLogOf, readDrives, warningsOf, type Drive } from './pairs.ts';
import { english } from './en.ts';
import { LogError, choiceLabelOf, type OpenOptions, type Recording, type Source, type Warning } from './log.ts';
import { openRecordings, optionsByNameOf } from './open.ts';

/** LogError as posted to the page, with its sentence in each language. */
export type LogFailure = Pick<LogError, 'message' | 'place' | 'question'> & { sentences: Record<'en' | 'de', string> };

/** Contents of files as posted to the page. */
export interface FileContents {
  /** Recordings without their methods, each with the choice of its logs. `choices` is missing if the logs were not chosen because of an error. */
  recordings: (Pick<Recording, 'name' | 'format' | 'series'> & Partial<Pick<PlannedRecording, 'choices'>>)[];
  /** Errors of files that were skipped. */
  skipped: LogFailure[];
  /** Error because of which all files were refused. */
  refusal?: LogFailure;
  drives?: Drive[];
  /** Logs of all drives, and warnings that the α's are doubtful. */
  log?: CalibrationLog;
  warnings?: Warning[];
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
  async read(sources: { file: Source; path: string }[], optionsByFile: Record<string, OpenOptions>, userChoices: UserChoices, onProgress: (fraction: number) => void): Promise<FileContents> {
    const skipped: LogFailure[] = [];
    const onSkip = (error: LogError) => void skipped.push(failureOf(error));
    const files = sources.map(({ file, path }) => Object.assign(file, { path }));
    let [recordings, plan]: [Recording[], PlannedRecording[] | undefined] = [[], undefined];
    const describeRecordings = () => recordings.map(({ name, format, series }, i) => ({ name, format, series, choices: plan?.find(({ recording }) => recording === recordings[i])?.choices }));
    let nextProgress = 0;
    try {
      recordings = await openRecordings(files, optionsByNameOf(Object.entries(optionsByFile)), onSkip);
      if (recordings.length === 0) return { recordings, skipped, refusal: skipped[0] };
      plan = planDrives(recordings, userChoices, onSkip);
      const drives = await readDrives(plan, (fraction) => {
        const now = performance.now();
        if (now < nextProgress) return;
        nextProgress = now + PROGRESS_INTERVAL_MS;
        onProgress(fraction);
      });
      const logs = drives.flatMap(({ odometry, reference }) => [odometry, reference]);
      const columns = logs.flatMap(({ data }) => Object.values(data) as ArrayBufferView[]);
      const contents = { recordings: describeRecordings(), skipped, drives, log: { name: nameOf(plan), ...calibrationLogOf(drives) }, warnings: warningsOf(logs) };
      return transfer(contents, [...new Set(columns.map(({ buffer }) => buffer as ArrayBuffer))]);
    } catch (error) {
      if (!(error instanceof LogError)) throw error;
      // If a file was skipped because of an open question, its log may be the missing one. That question is asked before the error is reported.
      const questionAboutSkipped = plan ? undefined : skipped.find(({ question }) => question);
      return { recordings: describeRecordings(), skipped, refusal: questionAboutSkipped ?? failureOf(error) };
    }
  }

  /** Returns the serialized fit to a log, which `AlphaCalibrator.restored` reads. */
  async calibrate(config: AlphaCalibratorSettings, { odometry, reference }: CalibrationLog): Promise<Uint8Array> {
    this.#simulation.setLog(odometry, reference);
    this.#simulation.configure(config);
    return this.#simulation.save();
  }
}

/** Returns the name of a log: the names of its files. For a single recording with odometry and reference, the topics are added. */
function nameOf(plan: PlannedRecording[]): string {
  const [{ choices }] = plan;
  const names = plan.map(({ recording }) => recording.name);
  return [...names.slice(0, MAX_NAMED_FILES), ...(names.length > MAX_NAMED_FILES ? ['…'] : []), ...(names.length === 1 ? Object.values(choices).map(choiceLabelOf) : [])].filter(Boolean).join(', ');
}

function failureOf({ message, place, question, messageIn: formatMessage }: LogError): LogFailure {
  return { message, place, question, sentences: { en: formatMessage(english), de: formatMessage(german) } };
}
