/** Opener of files that the user chooses, or drops on a figure. If the files are refused, the figure shows the reason. */

import { html } from 'lit';
import { FigureController } from '../../figure/controller.ts';
import { inputOf } from '../../ui/controls.ts';

type Figure = import('../../figure/figure.ts').Figure;

export abstract class FileOpener<Host extends Figure> extends FigureController<Host> {
  /** Id of the element that shows the contents of the files. If this element is a disclosure, dropping files opens it. */
  abstract resultElementId: string;
  /** Error because of which the latest files were refused; undefined if they were accepted. */
  refusal: unknown;
  /** Sequence number of the latest attempt to open files. Results of earlier attempts are ignored. */
  #latestAttemptId = 0;

  /** Opens files that were chosen or dropped. */
  abstract chooseFiles(files: File[]): void;

  /** Returns a sentence on why the files were refused, in the current language. */
  abstract explainRefusal(refusal: any): string;

  get refusalNoteHtml() {
    const refusalText = this.refusal === undefined ? '' : this.explainRefusal(this.refusal);
    return html`<p class="note" id="refusal" role="alert" ?hidden=${refusalText === ''}>${refusalText}</p>`;
  }

  /** Cancels the latest attempt to open files. Its result will be ignored. */
  cancel() {
    this.#latestAttemptId++;
  }

  /** Runs an attempt to open files, which cancels any earlier attempt. Returns false if a later attempt has cancelled this attempt in the meantime. */
  async runAttempt(openFiles: (isLatest: () => boolean) => Promise<void>) {
    const attemptId = ++this.#latestAttemptId;
    const isLatest = () => attemptId === this.#latestAttemptId;
    this.refusal = undefined;
    this.figure.requestUpdate();
    try {
      await openFiles(isLatest);
    } catch (openingError) {
      if (isLatest()) await this.showRefusal(openingError);
    }
    return isLatest();
  }

  /** Shows why files were refused. `focusAnswer` moves the focus to a control by which the user can correct the cause. It returns false if there is no such control. */
  async showRefusal(error: unknown, focusAnswer: () => boolean | undefined = () => false) {
    const { figure } = this;
    this.refusal = error;
    figure.requestUpdate();
    await figure.updateComplete;
    if (!focusAnswer()) figure.renderRoot.querySelector('#refusal')?.scrollIntoView({ block: 'nearest' });
  }

  onDragOver = (dragEvent: DragEvent) => {
    if (!dragEvent.dataTransfer?.types.includes('Files')) return;
    dragEvent.preventDefault();
    (dragEvent.currentTarget as HTMLElement).classList.add('dropping');
  };

  onDragLeave = (dragEvent: DragEvent) => {
    const figureSection = dragEvent.currentTarget as HTMLElement;
    const enteredElement = dragEvent.relatedTarget as Node | null;
    if (!figureSection.contains(enteredElement)) figureSection.classList.remove('dropping');
  };

  onDrop = (dragEvent: DragEvent) => {
    (dragEvent.currentTarget as HTMLElement).classList.remove('dropping');
    if (!dragEvent.dataTransfer?.types.includes('Files')) return;
    // Without this call, the browser would leave the page and open the dropped file.
    dragEvent.preventDefault();
    const resultElement = this.figure.renderRoot.querySelector(`#${this.resultElementId}`);
    if (resultElement instanceof HTMLDetailsElement) resultElement.open = true;
    readDroppedFiles(dragEvent.dataTransfer).then((files) => files.length > 0 && this.chooseFiles(files));
  };

  /** Returns a button that opens a file dialog for files with the given extensions. */
  fileButtonHtml(id: string, label: string, extensions: string[]) {
    const openChosenFiles = (event: Event) => {
      const fileInput = inputOf(event);
      this.chooseFiles([...(fileInput.files ?? [])]);
      // The input is cleared. Otherwise, choosing a file with the same name again after a correction would not fire a `change` event.
      fileInput.value = '';
    };
    return html`<label class="choice files">
      ${label} <input id=${id} type="file" multiple accept=${extensions.join(',')} @change=${openChosenFiles} />
    </label>`;
  }
}

/** Returns the dropped files, and all files in dropped folders. Files in folders have their paths in the property `path`. */
async function readDroppedFiles({ items }: DataTransfer): Promise<File[]> {
  // All items are read before the first `await`, because the browser then empties the list.
  const droppedItems = [...items].filter(({ kind }) => kind === 'file').map((transferItem) => ({ entry: transferItem.webkitGetAsEntry(), file: transferItem.getAsFile() }));
  const foundFiles = await Promise.all(droppedItems.map(({ entry, file }) => (entry?.isDirectory ? readDirectory(entry as FileSystemDirectoryEntry) : file ? [file] : [])));
  return foundFiles.flat();
}

async function readDirectory(directoryEntry: FileSystemDirectoryEntry): Promise<File[]> {
  const directoryReader = directoryEntry.createReader();
  const entries: FileSystemEntry[] = [];
  const readEntries = () => new Promise<FileSystemEntry[]>((resolve, reject) => directoryReader.readEntries(resolve, reject));
  // In some browsers, a call of `readEntries` returns at most a hundred entries. It is called until it returns none.
  for (let entryBatch = await readEntries(); entryBatch.length > 0; entryBatch = await readEntries()) entries.push(...entryBatch);
  const foundFiles = await Promise.all(entries.filter(({ name }) => !name.startsWith('.')).map(async (entry) => {
    if (entry.isDirectory) return readDirectory(entry as FileSystemDirectoryEntry);
    const file = await new Promise<File>((resolve, reject) => (entry as FileSystemFileEntry).file(resolve, reject));
    return [Object.assign(file, { path: entry.fullPath.slice(1) })];
  }));
  return foundFiles.flat();
}
