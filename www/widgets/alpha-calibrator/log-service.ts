/** Client of the worker that reads and calibrates logs. If the page cannot start a worker, the same module runs in the page's thread. */

import { instantiateShared, sharedCore, startWorker, type SharedCore } from '../../core.ts';
import type { LogPlan } from '../../logs/drives.ts';
import type { Drive } from '../../logs/pairs.ts';
import type { OpenOptions, Source } from '../../logs/log.ts';
import type { WorkerAnswer, PostedFailure, OnProgress, OpenedRecording, WorkerRequest } from '../../logs/worker.ts';
import type { AlphaCalibratorSettings, CalibrationLog } from '../../types.d.ts';

/** Error of a log that the worker posted, with its sentence in each language. */
export type LogFailure = Error & PostedFailure;

const logFailureOf = (failure: PostedFailure): LogFailure => Object.assign(new Error(failure.message), failure);

/** Returns true if a request was aborted, which needs no message. */
export const isAbortError = (error: unknown) => error instanceof DOMException && error.name === 'AbortError';

/** Client of the worker. It makes one request at a time. */
export class LogService {
  #tag: string;
  /** Connection to the worker, or to the same module in the page's thread. */
  #workerLink: Promise<WorkerLink> | undefined;
  /** Rejects the request in progress; undefined if there is none. */
  #rejectRequest: ((error: unknown) => void) | undefined;
  /** True while the worker holds the recordings that were opened last. */
  isOpen = false;

  /** @param tag tag of the element; the worker gets the WebAssembly module that the page has loaded for it */
  constructor(tag: string) {
    this.#tag = tag;
  }

  get isBusy() {
    return this.#rejectRequest !== undefined;
  }

  /** Opens files, with the options of each by its name, and aborts the request in progress. */
  async open(files: Source[], answers: Record<string, OpenOptions>): Promise<{ recordings: OpenedRecording[]; skipped: LogFailure[] }> {
    this.stop();
    this.isOpen = false;
    // A copied `File` has no path.
    const { recordings, skipped } = await this.#ask<{ recordings: OpenedRecording[]; skipped: PostedFailure[] }>('open', [files.map((file) => ({ file, path: file.path ?? '' })), answers]);
    this.isOpen = true;
    return { recordings, skipped: skipped.map(logFailureOf) };
  }

  /** Reads the drives of a plan for the opened recordings. */
  read({ drives, unpaired }: LogPlan, onProgress: OnProgress): Promise<Drive[]> {
    return this.#ask('read', [{ drives, unpaired }], onProgress);
  }

  /** Returns the fit to a log, for `AlphaCalibrator.restored`. */
  calibrate(config: AlphaCalibratorSettings, log: CalibrationLog): Promise<Uint8Array> {
    this.stop();
    return this.#ask('calibrate', [config, log]);
  }

  /** Cancels the current request, which rejects. */
  stop() {
    if (this.isBusy) this.end();
  }

  end() {
    this.#workerLink?.then(({ end }) => end(), () => {});
    this.#workerLink = undefined;
    this.isOpen = false;
    this.#rejectRequest?.(new DOMException('', 'AbortError'));
    this.#rejectRequest = undefined;
  }

  #ask<Result>(method: WorkerRequest['method'], parameters: unknown[], onProgress?: OnProgress): Promise<Result> {
    const workerLink = (this.#workerLink ??= connectService(this.#tag));
    let rejectRequest: (error: unknown) => void;
    const resultPromise = new Promise<Result>((resolve, reject) => {
      this.#rejectRequest = rejectRequest = reject;
      const postRequest = ({ port }: WorkerLink) => {
        // The request may have been cancelled while the worker started.
        if (workerLink !== this.#workerLink) return;
        port.onmessage = ({ data }: MessageEvent<WorkerAnswer>) => {
          if ('progress' in data) onProgress?.(data.progress);
          else if ('failure' in data) reject(logFailureOf(data.failure));
          else resolve(data.result as Result);
        };
        port.postMessage({ method, parameters } satisfies WorkerRequest);
      };
      workerLink.then(postRequest).catch((error) => {
        if (workerLink === this.#workerLink) this.#workerLink = undefined;
        reject(error);
      });
    });
    return resultPromise.finally(() => {
      if (this.#rejectRequest === rejectRequest) this.#rejectRequest = undefined;
    });
  }
}

type WorkerLink = { port: Worker | MessagePort, end: () => void };

/** Starts a worker, or if the browser has none or the page's policy or origin forbids them, the same module in the page's thread. */
async function connectService(tag: string): Promise<WorkerLink> {
  const core = await sharedCore(tag);
  let worker: Worker | undefined;
  const end = () => worker?.terminate();
  try {
    worker = startWorker();
    if (worker) return { port: await startSession(worker, core), end };
  } catch {
    // Some browsers throw where a policy forbids workers, others fire an error.
    end();
  }
  const { serveRequests } = await import('../../logs/worker.ts');
  const { port1, port2 } = new MessageChannel();
  serveRequests(port2, instantiateShared);
  return { port: await startSession(port1, core), end: () => port1.close() };
}

/** Posts the core to a port, and waits for the answer. */
const startSession = <Port extends Worker | MessagePort>(port: Port, core: SharedCore) => new Promise<Port>((resolve, reject) => {
  port.onmessage = ({ data }: MessageEvent<WorkerAnswer>) => ('failure' in data ? reject(logFailureOf(data.failure)) : resolve(port));
  Object.assign(port, { onerror: (event: ErrorEvent) => {
    event.preventDefault();
    reject(event);
  } });
  port.postMessage({ core });
});
