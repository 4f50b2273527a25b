/** Client of the worker that reads and calibrates logs. If the page cannot start a worker, the session runs in the page's thread. */

import { instantiateShared, sharedCore, startWorker } from '../../core.ts';
import type { LogPlan } from '../../logs/drives.ts';
import type { OpenOptions, Recording, Source } from '../../logs/log.ts';
import type { LogSession } from '../../logs/session.ts';
import type { AlphaCalibratorSettings, CalibrationLog } from '../../types.d.ts';

/** Session, the function that ends its worker, and the function by which a callback can be called from the worker. */
interface Connection {
  session: Pick<LogSession, 'open' | 'read' | 'calibrate'>;
  end(): void;
  proxy: typeof import('comlink').proxy;
}

/** Returns true if a request was aborted, which needs no message. */
export const isAbortError = (error: unknown) => error instanceof DOMException && error.name === 'AbortError';

/** Client of the worker. A request aborts the one in progress. */
export class LogService {
  #connection: Promise<Connection> | undefined;
  /** Aborts the request in progress; undefined if there is none. */
  #request: AbortController | undefined;
  /** Recordings that the worker holds; undefined if there are none. */
  openRecordings: Recording[] | undefined;

  get isBusy() {
    return this.#request !== undefined;
  }

  /** Opens files, with the options of each by its name. */
  async open(files: Source[], answers: Record<string, OpenOptions>) {
    this.openRecordings = undefined;
    // A copied `File` has no path.
    const opened = await this.#ask(({ session }) => session.open(files.map((file) => ({ file, path: file.path ?? '' })), answers));
    this.openRecordings = opened.recordings;
    return opened;
  }

  /** Reads the drives of a plan for the opened recordings. */
  read({ drives, unpaired }: LogPlan, onProgress: (share: number) => void) {
    return this.#ask(({ session, proxy }, signal) => session.read({ drives, unpaired }, proxy((share) => void (signal.aborted || onProgress(share)))));
  }

  /** Returns the fit to a log, for `AlphaCalibrator.restored`. */
  calibrate(config: AlphaCalibratorSettings, log: CalibrationLog) {
    return this.#ask(({ session }) => session.calibrate(config, log));
  }

  /** Cancels the current request, which rejects. */
  stop() {
    if (this.isBusy) this.end();
  }

  end() {
    this.#connection?.then(({ end }) => end(), () => {});
    this.#connection = undefined;
    this.openRecordings = undefined;
    this.#request?.abort();
    this.#request = undefined;
  }

  async #ask<Result>(ask: (connection: Connection, signal: AbortSignal) => Promise<Result>): Promise<Result> {
    this.stop();
    const request = (this.#request = new AbortController());
    const connection = (this.#connection ??= connect());
    // After a failed start, the next request tries again.
    connection.catch(() => connection === this.#connection && (this.#connection = undefined));
    const { signal } = request;
    const aborted = new Promise<never>((_, reject) => signal.addEventListener('abort', () => reject(signal.reason)));
    try {
      return await Promise.race([aborted, ask(await Promise.race([aborted, connection]), signal)]);
    } finally {
      if (request === this.#request) this.#request = undefined;
    }
  }
}

/** Starts a session in a worker; in the page's thread if the browser has no workers, or the page's policy or origin forbids them. */
async function connect(): Promise<Connection> {
  // The library is loaded with the first log.
  const [core, { proxy, wrap }] = await Promise.all([sharedCore('alpha-calibrator'), import('comlink')]);
  let worker: Worker | undefined;
  const end = () => worker?.terminate();
  try {
    worker = startWorker();
    if (worker) {
      const session = await Promise.race([wrap<typeof import('../../log-worker.ts').startSession>(worker)(core), rejectOnError(worker)]);
      return { session, end, proxy };
    }
  } catch {
    // Some browsers throw where a policy forbids workers, others fire an error.
    end();
  }
  const { LogSession } = await import('../../logs/session.ts');
  return { session: new LogSession(await instantiateShared(core)), end, proxy };
}

const rejectOnError = (worker: Worker) => new Promise<never>((_, reject) => worker.addEventListener('error', (event) => {
  event.preventDefault();
  reject(event);
}));
