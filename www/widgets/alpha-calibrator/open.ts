/** Opener of the user's logs, from chosen or dropped files. */

import { html, nothing } from 'lit';
import { language, words } from '../../messages/registry.ts';
import { buttonHtml } from '../../ui/controls.ts';
import { FileOpener } from '../shared/files.ts';
import { instantiateShared, moduleForWorker, startWorker } from '../../core.ts';
import type { UserChoices } from '../../logs/drives.ts';
import type { FileContents, LogFailure, LogSession } from '../../logs/session.ts';
import type { FileQuestion, OpenOptions, SourceFile } from '../../logs/log.ts';
import type { AlphaCalibratorSettings, CalibrationLog } from '../../types.d.ts';
import type { AlphaCalibratorElement as Figure } from './alpha-calibrator.ts';

export type LogWords = typeof import('../../logs/en.ts').english;

/** Reason why files were refused: an error, or the data of an error that the worker has posted. */
type Refusal = Pick<Error, 'message'> & Partial<LogFailure>;

type LogModule = typeof import('./log-choice.ts');

/** Files with their contents, and the choices of the user with which the files were read. Missing choices are guessed. */
export interface ChosenFiles extends FileContents {
  files: File[];
  /** Options for reading each file, by the name of the file. */
  answers: Record<string, OpenOptions>;
  /** Questions to the user about the files, both answered and open. */
  questions: FileQuestion[];
  userChoices: UserChoices;
  /** True if the figure has shown a fit to the logs in these files. */
  isFitted?: boolean;
}

/** Extensions that the file dialog offers. */
const LOG_FILE_EXTENSIONS = ['.csv', '.txt', '.tum', '.log', '.mcap', '.bag', '.db3', '.zst', '.zstd', '.yaml'];

export class LogOpener extends FileOpener<Figure> {
  resultElementId = 'log';
  chosenFiles: ChosenFiles | undefined;
  /** Files with the log whose results are on screen; undefined after the page or the user has set another log. */
  #fittedFiles: ChosenFiles | undefined;
  /** Module with the code and the texts for choosing and showing logs. It is loaded when the user chooses a file. */
  logModule: LogModule | undefined;
  /** Fraction of the files that has been read; undefined if no file is being read. */
  readFraction: number | undefined;

  /** Kind of log that is preferred as odometry if a file has several: commands for the velocity model. */
  get preferredKind(): 'commands' | undefined {
    return this.figure.viewModel.config.model === 'velocity' ? 'commands' : undefined;
  }

  /** Texts about logs in the current language; undefined until the module with the texts is loaded. */
  get texts(): LogWords | undefined {
    return this.logModule?.[language === 'de' ? 'de' : 'en'];
  }

  /** Reads the files again if the user has changed the model, and the new model prefers another kind of odometry. */
  hostUpdated() {
    const { chosenFiles } = this;
    if (chosenFiles?.isFitted && chosenFiles.calibrationLog === this.figure.log && this.readFraction === undefined && chosenFiles.userChoices.logKind !== this.preferredKind) this.#openFiles(chosenFiles);
  }

  /** Forgets the chosen files, and shows a log of the page, or the simulated log. */
  async closeLog(log: CalibrationLog | null = null) {
    this.#endReading();
    this.#fittedFiles = undefined;
    this.restoreResults();
    if (log === this.figure.log) return;
    await this.figure.openLog(log, []);
    this.figure.gesture.commitOneStep();
  }

  /** Forgets files that were refused or not yet fitted. The files with the results on screen become the chosen files again. */
  restoreResults() {
    this.chosenFiles = this.#fittedFiles?.calibrationLog === this.figure.log ? this.#fittedFiles : undefined;
    this.refusal = undefined;
    this.figure.requestUpdate();
  }

  /** Sentence which says that the results are those of another log, because the chosen files were refused; empty otherwise. */
  get otherResultsNote() {
    return this.refusal === undefined || isAbortError(this.refusal) ? '' : words.calibrator.logControls.otherLogNote(this.figure.logName);
  }

  stopReading() {
    this.#endReading();
    this.restoreResults();
    this.refusal = new DOMException('', 'AbortError');
  }

  #endReading() {
    this.cancel();
    this.figure.logService.stopRequest();
    this.#setIdle();
  }

  /** Ends the display of progress. The figure then applies the changes of settings that were postponed until the log was read. */
  #setIdle() {
    this.readFraction = undefined;
    this.figure.settings.isViewModelStale = true;
    this.figure.renderer.requestFrame();
    this.figure.requestUpdate();
  }

  /** Reads files. If the file that was chosen before lacks the other log of its drive, it is read again together with the new files. */
  chooseFiles(files: File[]) {
    const logFiles = files.filter(isPossibleLog);
    const newFiles = logFiles.length ? logFiles : files;
    const { files: previousFiles, answers, questions } = this.chosenFiles?.refusalOfAll?.userQuestion?.optionName === 'other' ? this.chosenFiles : { files: [], answers: {}, questions: [] };
    const loneFiles = previousFiles.filter((file) => !newFiles.some(({ name, size }) => name === file.name && size === file.size));
    this.#openFiles({ files: [...loneFiles, ...newFiles], openedRecordings: [], skippedFiles: [], answers, questions, userChoices: {} });
  }

  /** Opens the chosen files again, with answers to questions about them. The answers have the names of the files as keys. */
  answerQuestions(newAnswers: ChosenFiles['answers']) {
    const answers = { ...this.chosenFiles?.answers };
    for (const [file, answer] of Object.entries(newAnswers)) answers[file] = { ...answers[file], ...answer };
    this.changeChoices({ answers });
  }

  changeChoices(changedChoices: Partial<ChosenFiles>) {
    if (this.chosenFiles) this.#openFiles({ ...this.chosenFiles, ...changedChoices });
  }

  /** Reads files and fits their logs. An earlier attempt that is still running is cancelled. */
  async #openFiles({ files, openedRecordings, skippedFiles, answers, questions, userChoices }: ChosenFiles) {
    const openedFiles: ChosenFiles = (this.chosenFiles = { files, openedRecordings, skippedFiles, answers, questions, userChoices: { ...userChoices, logKind: this.preferredKind } });
    this.figure.logService.stopRequest();
    this.readFraction = 0;
    const isLatest = await this.runAttempt(async () => {
      this.logModule ??= await import('./log-choice.ts');
      Object.assign(openedFiles, await this.figure.logService.readLogs(files, answers, openedFiles.userChoices, (readFraction) => {
        this.readFraction = readFraction;
        this.figure.requestUpdate();
      }));
      if (openedFiles.refusalOfAll) throw openedFiles.refusalOfAll;
      await this.#fitLogs(openedFiles);
    });
    if (isLatest) this.#setIdle();
  }

  async #fitLogs(openedFiles: ChosenFiles) {
    const { calibrationLog, logWarnings, loggedDrives } = openedFiles as Required<ChosenFiles>;
    // The summary of the logs is shown while the logs are fitted.
    this.figure.requestUpdate();
    await this.figure.openLog(calibrationLog, logWarnings, ({ count, stats }) => {
      if (count === 0) throw new RangeError(words.calibrator.tooFewLegsSentence);
      for (const question of this.logModule!.mirroringQuestionsOf(loggedDrives, stats.diagnostics.checks)) askQuestion(openedFiles, question);
    });
    openedFiles.isFitted = true;
    this.#fittedFiles = openedFiles;
    this.figure.gesture.commitOneStep();
  }

  explainRefusal(refusal: Refusal) {
    if (isAbortError(refusal)) return words.progress.stoppedNotice;
    const { message, sentencesByLanguage, userQuestion } = refusal;
    const refusalReason = sentencesByLanguage?.[language === 'de' ? 'de' : 'en'] ?? words.calibrator.logControls.refusedLogSentence(message);
    return [refusalReason, ...(userQuestion?.optionName === 'other' && this.texts ? [this.texts.logChoiceTexts.bothFilesHint] : [])].join(' ');
  }

  /** Shows why files were refused, and asks the user to answer the error's question if it has one. */
  async showRefusal(error: Refusal) {
    if (isAbortError(error)) return;
    const { chosenFiles } = this;
    const newQuestion = error.userQuestion && { ...error.userQuestion, fileName: error.errorPlace?.fileName ?? '' };
    if (newQuestion && chosenFiles) askQuestion(chosenFiles, newQuestion);
    await super.showRefusal(error, () => newQuestion && this.logModule?.focusChooser(this.figure, newQuestion));
  }
}

/** Asks a question about a file. The question replaces an earlier question of the same kind. */
function askQuestion(chosenFiles: ChosenFiles, newQuestion: FileQuestion) {
  chosenFiles.questions = [...chosenFiles.questions.filter(({ fileName, optionName }) => fileName !== newQuestion.fileName || optionName !== newQuestion.optionName), newQuestion];
}

/** Returns true if a file may be a log. A dropped folder may also contain files of other kinds. */
const isPossibleLog = ({ name, path }: File & { path?: string }) => path === undefined || name === 'metadata.yaml' || [...LOG_FILE_EXTENSIONS.slice(0, -1), '-wal'].some((fileExtension) => name.endsWith(fileExtension));

/** Returns the area on which logs are dropped. Below it are the questions about logs, the progress or the name of the log, and the reason for a refusal. */
export function dropZoneHtml(figure: Figure, logOpener: LogOpener) {
  const texts = words.calibrator.logControls;
  const { readFraction, logModule } = logOpener;
  return html`<div class="drop-zone" id=${logOpener.resultElementId} part="drop">
    <p title=${texts.dropZoneTooltip}>
      ${texts.dropZoneHint}
      ${logOpener.fileButtonHtml('log-files', texts.chooseFilesLabel, LOG_FILE_EXTENSIONS)}
    </p>
    ${logModule?.logChoosersHtml(logOpener)}
    ${readFraction !== undefined
      ? html`<p><progress aria-label=${words.progress.label} .value=${readFraction}></progress> ${buttonHtml(words.progress.stopLabel, () => logOpener.stopReading())}</p>`
      : figure.log ? html`<p><span class="present">${texts.resultsOfLogNote(figure.logName)}</span> ${buttonHtml(texts.leaveLabel, () => logOpener.closeLog())}</p>` : nothing}
    ${logOpener.refusalNoteHtml}
    ${logOpener.otherResultsNote ? html`<p class="muted other-results">${logOpener.otherResultsNote} ${buttonHtml(texts.dismissFilesLabel, () => logOpener.restoreResults())}</p>` : nothing}
  </div>`;
}

/** Connection to the worker: its session, a function that ends the worker, and comlink's `proxy`, which makes a callback callable from the worker. */
interface WorkerConnection {
  session: Pick<LogSession, 'readFiles' | 'calibrate'>;
  endWorker(): void;
  proxy: typeof import('comlink').proxy;
}

/** Returns true if a request was aborted. An abort needs no message, because the user or a newer request caused it. */
export const isAbortError = (error: unknown) => error instanceof DOMException && error.name === 'AbortError';

/** Client of the worker. A new request aborts the previous one. */
export class LogService {
  #connection: Promise<WorkerConnection> | undefined;
  /** Aborts the request in progress; undefined if there is none. */
  #abortController: AbortController | undefined;

  get isBusy() {
    return this.#abortController !== undefined;
  }

  /** Reads the logs of files. `answers` has the options for each file, by the name of the file. */
  readLogs(files: SourceFile[], answers: Record<string, OpenOptions>, userChoices: UserChoices, onProgress: (fraction: number) => void) {
    // The path is posted separately, because a copy of a `File` in the worker lacks the property `path`.
    const sources = files.map((file) => ({ file, path: file.path ?? '' }));
    return this.#sendRequest(({ session, proxy }, signal) => session.readFiles(sources, answers, userChoices, proxy((fraction) => void (signal.aborted || onProgress(fraction)))));
  }

  /** Returns the serialized fit to a log, which `AlphaCalibrator.restored` reads. */
  calibrate(config: AlphaCalibratorSettings, log: CalibrationLog) {
    return this.#sendRequest(({ session }) => session.calibrate(config, log));
  }

  /** Cancels the current request. The promise of the request rejects. */
  stopRequest() {
    if (this.isBusy) this.endWorker();
  }

  endWorker() {
    this.#connection?.then(({ endWorker }) => endWorker(), () => {});
    this.#connection = undefined;
    this.#abortController?.abort();
    this.#abortController = undefined;
  }

  async #sendRequest<Result>(sendTo: (connection: WorkerConnection, signal: AbortSignal) => Promise<Result>): Promise<Result> {
    this.stopRequest();
    const abortController = (this.#abortController = new AbortController());
    const connection = (this.#connection ??= connectWorker());
    // If the worker cannot be started, the next request tries again.
    connection.catch(() => connection === this.#connection && (this.#connection = undefined));
    const { signal } = abortController;
    const abortRejection = new Promise<never>((_, reject) => signal.addEventListener('abort', () => reject(signal.reason)));
    try {
      return await Promise.race([abortRejection, sendTo(await Promise.race([abortRejection, connection]), signal)]);
    } finally {
      if (abortController === this.#abortController) this.#abortController = undefined;
    }
  }
}

/** Starts a session in a worker. If the browser has no workers, or a policy or the page's origin forbids them, the session runs in the thread of the page. */
async function connectWorker(): Promise<WorkerConnection> {
  // comlink is imported only when a log is opened, so that the page starts faster.
  const [sharedCore, { proxy, wrap }] = await Promise.all([moduleForWorker('alpha-calibrator'), import('comlink')]);
  let worker: Worker | undefined;
  const endWorker = () => worker?.terminate();
  try {
    worker = startWorker();
    if (worker) {
      const session = await Promise.race([wrap<typeof import('../../log-worker.ts').startSession>(worker)(sharedCore), rejectOnError(worker)]);
      return { session, endWorker, proxy };
    }
  } catch {
    // If a policy forbids workers, some browsers throw an error, and others fire an `error` event at the worker.
    endWorker();
  }
  const { LogSession } = await import('../../logs/session.ts');
  return { session: new LogSession(await instantiateShared(sharedCore)), endWorker, proxy };
}

const rejectOnError = (worker: Worker) => new Promise<never>((_, reject) => worker.addEventListener('error', (errorEvent) => {
  errorEvent.preventDefault();
  reject(errorEvent);
}));
