/** Session that opens recordings, reads logs and calibrates in a worker, or in the thread of a page that cannot start one. */

import { transfer } from 'comlink';
import type { AlphaCalibratorSettings, CalibrationLog, Motion } from '../types.d.ts';
import { german } from './de.ts';
import type { RecordingChoice, LogPlan } from './drives.ts';
import { readDrives, type Drive } from './pairs.ts';
import { english } from './en.ts';
import { LogError, type OpenOptions, type Recording, type Source } from './log.ts';
import { openRecordings } from './open.ts';

/** Recording as posted to the page: without its methods, but with its index among the opened recordings. */
type OpenedRecording = Recording & { index: number };

/** LogError as posted to the page, with its sentence in each language. */
export type LogFailure = Pick<LogError, 'message' | 'place' | 'question'> & { sentences: Record<'en' | 'de', string> };

/** Minimum time (ms) between progress reports. The page renders the figure after each report. */
const PROGRESS_INTERVAL_MS = 50;

/** Opened recordings, and the object of the core that fits α's to them. */
export class LogSession {
  #recordings: Recording[] = [];
  #simulation;

  constructor({ AlphaCalibrator }: Motion) {
    this.#simulation = new AlphaCalibrator();
  }

  async open(sources: { file: Source; path: string }[], optionsByFile: Record<string, OpenOptions>): Promise<{ recordings: OpenedRecording[]; skipped: LogFailure[] }> {
    const skipped: LogFailure[] = [];
    const files = sources.map(({ file, path }) => Object.assign(file, { path }));
    this.#recordings = await openRecordings(files, (name) => optionsByFile[name], (error) => skipped.push(failureOf(error))).catch(throwFailure);
    return { recordings: this.#recordings.map(({ name, format, series }, index) => ({ name, format, series, index }) as OpenedRecording), skipped };
  }

  async read({ drives, unpaired }: Pick<LogPlan, 'drives' | 'unpaired'>, onProgress: (fraction: number) => void): Promise<Drive[]> {
    const openedChoiceOf = ({ recording, choice }: RecordingChoice) => ({ recording: this.#recordings[(recording as OpenedRecording).index], choice });
    const plan = {
      drives: drives.map(({ odometry, reference }) => ({ odometry: openedChoiceOf(odometry), reference: openedChoiceOf(reference) })),
      unpaired: { odometry: unpaired.odometry.map(openedChoiceOf), reference: unpaired.reference.map(openedChoiceOf) },
    };
    let nextProgress = 0;
    const driveLogs = await readDrives(plan, (fraction) => {
      const now = performance.now();
      if (now < nextProgress) return;
      nextProgress = now + PROGRESS_INTERVAL_MS;
      onProgress(fraction);
    }).catch(throwFailure);
    const columns = driveLogs.flatMap(({ odometry, reference }) => [odometry, reference]).flatMap(({ data }) => Object.values(data) as ArrayBufferView[]);
    return transfer(driveLogs, [...new Set(columns.map(({ buffer }) => buffer as ArrayBuffer))]);
  }

  /** Returns the serialized fit to a log, for `AlphaCalibrator.restored`. */
  async calibrate(config: AlphaCalibratorSettings, { odometry, reference }: CalibrationLog): Promise<Uint8Array> {
    this.#simulation.setLog(odometry, reference);
    this.#simulation.configure(config);
    return this.#simulation.save();
  }
}

function failureOf({ message, place, question, messageIn: formatMessage }: LogError): LogFailure {
  return { message, place, question, sentences: { en: formatMessage(english), de: formatMessage(german) } };
}

/** Throws a LogError as plain data, because a posted error would keep only its message. */
function throwFailure(error: unknown): never {
  throw error instanceof LogError ? failureOf(error) : error;
}
