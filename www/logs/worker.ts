/** Worker that opens recordings, reads logs and calibrates. If a page cannot start a worker, `serveRequests` runs in the thread of the page. */

import type { SharedCore } from '../core.ts';
import type { AlphaCalibrator, AlphaCalibratorSettings, CalibrationLog, Motion } from '../types.d.ts';
import { german } from './de.ts';
import type { RecordingChoice, LogPlan } from './drives.ts';
import { readDrives, type Drive } from './pairs.ts';
import { english } from './en.ts';
import { LogError, type OpenOptions, type Question, type Recording, type Source } from './log.ts';
import { openRecordings } from './open.ts';

/** Recording as posted to the page: without its methods, but with its index (`place`) among the opened recordings. */
export type OpenedRecording = Recording & { place: number };

/** Error for the page. A LogError has its sentence in each language. */
export interface PostedFailure {
  name: string;
  message: string;
  sentences?: Record<'en' | 'de', string>;
  file?: string;
  ask?: Question;
}

export type OnProgress = (share: number) => void;

/** Request of the page: a method of `LogSession`, and its parameters. The page waits for the result or the failure before the next request. */
export interface WorkerRequest { method: 'open' | 'read' | 'calibrate'; parameters: unknown[] }

/** Answer to a request. Answers with progress precede the result or the failure. */
export type WorkerAnswer = { progress: number } | { result: unknown } | { failure: PostedFailure };

/** Opened recordings, and the simulation that fits logs. */
class LogSession {
  #recordings: Recording[] = [];
  #simulation: AlphaCalibrator;

  constructor(motion: Motion) {
    this.#simulation = new motion.AlphaCalibrator();
  }

  async open(_: OnProgress, sources: { file: Source; path: string }[], answers: Record<string, OpenOptions>): Promise<{ recordings: OpenedRecording[]; skipped: PostedFailure[] }> {
    const skipped: PostedFailure[] = [];
    this.#recordings = await openRecordings(sources.map(({ file, path }) => Object.assign(file, { path })), (name) => answers[name], (error) => skipped.push(failureOf(error)));
    return { recordings: this.#recordings.map(({ name, format, series }, place) => ({ name, format, series, place }) as OpenedRecording), skipped };
  }

  async read(onProgress: OnProgress, { drives, unpaired }: Pick<LogPlan, 'drives' | 'unpaired'>): Promise<Drive[]> {
    const openedChoice = ({ recording, choice }: RecordingChoice) => ({ recording: this.#recordings[(recording as OpenedRecording).place], choice });
    const plan = {
      drives: drives.map(({ odometry, reference }) => ({ odometry: openedChoice(odometry), reference: openedChoice(reference) })),
      unpaired: { odometry: unpaired.odometry.map(openedChoice), reference: unpaired.reference.map(openedChoice) },
    };
    return readDrives(plan, onProgress);
  }

  /** Returns the fit to a log, for `AlphaCalibrator.restored`. */
  calibrate(_: OnProgress, config: AlphaCalibratorSettings, { odometry, reference }: CalibrationLog): Uint8Array {
    this.#simulation.setLog(odometry, reference);
    this.#simulation.configure(config);
    return this.#simulation.save();
  }
}

function failureOf(error: unknown): PostedFailure {
  const { name, message } = error instanceof Error ? error : new Error(String(error));
  if (!(error instanceof LogError)) return { name, message };
  return { name, message, file: error.place.file, ask: error.ask, sentences: { en: error.sentence(english), de: error.sentence(german) } };
}

/** Returns the buffers of an answer, which are transferred instead of copied. */
function buffersOf(result: unknown): ArrayBuffer[] {
  if (ArrayBuffer.isView(result)) return [result.buffer as ArrayBuffer];
  return typeof result === 'object' && result ? [...new Set(Object.values(result).flatMap(buffersOf))] : [];
}

/** Minimum time between messages of progress, ms. The page renders the figure after each message. */
const PROGRESS_INTERVAL = 50;

/**
 * Answers the requests on a port. The first message has the core. `instantiate` is a parameter, because esbuild would wrap an imported module
 * in a function, which browsers parse twice.
 */
export function serveRequests(port: Pick<MessagePort, 'onmessage' | 'postMessage'>, instantiate: (core: SharedCore) => Promise<Motion>) {
  let session: LogSession;
  const postAnswer = (message: WorkerAnswer, buffers: ArrayBuffer[] = []) => port.postMessage(message, buffers);
  port.onmessage = async ({ data }: MessageEvent<WorkerRequest & { core?: SharedCore }>) => {
    const { core, method, parameters } = data;
    try {
      if (core) session = new LogSession(await instantiate(core));
      let nextProgress = 0;
      const onProgress = (progress: number) => {
        const now = performance.now();
        if (now < nextProgress) return;
        nextProgress = now + PROGRESS_INTERVAL;
        postAnswer({ progress });
      };
      const outcome = core ? null : await (session[method] as (...all: unknown[]) => unknown).call(session, onProgress, ...parameters);
      postAnswer({ result: outcome }, buffersOf(outcome));
    } catch (error) {
      postAnswer({ failure: failureOf(error) });
    }
  };
}
