/** Files of the reader, chosen or dropped on a figure. A disclosure shows the result, and a notice why dropped files were refused. */

import { html, nothing } from 'lit';
import { inputOf } from '../../ui/controls.ts';

export type Figure = import('../../figure/figure.ts').Figure;

export class FileDrop {
  #host;
  #id;
  #choose;
  #isDropped = false;

  /** Runs when something is dragged over the figure. */
  enter: (() => void) | undefined;

  /** Creates the drop target. `id` names the element that describes the files; if it is a disclosure, a drop opens it. */
  constructor(host: Figure, id: string, choose: (files: File[]) => void, enter?: () => void) {
    this.#host = host;
    this.#id = id;
    this.#choose = choose;
    this.enter = enter;
  }

  /** Element with the result, null until the figure has been drawn. */
  get #place() {
    return this.#host.renderRoot.querySelector(`#${this.#id}`);
  }

  /** Shows why files were refused; for dropped files, near the place of the drop. */
  async showRefusal(sentence: string) {
    if (this.#isDropped) this.#host.notice.show(sentence);
    await this.#host.updateComplete;
    if (!this.#isDropped) this.#place?.querySelector('.note')?.scrollIntoView({ block: 'nearest' });
  }

  /** Handles files that the reader has chosen or dropped. */
  take(files: File[], isDropped: boolean = false) {
    this.#isDropped = isDropped;
    this.#host.notice.show('');
    this.#choose(files);
  }

  over = (event: DragEvent) => {
    if (!event.dataTransfer?.types.includes('Files')) return;
    event.preventDefault();
    (event.currentTarget as HTMLElement).classList.add('dropping');
  };

  leave = (event: DragEvent) => {
    const section = event.currentTarget as HTMLElement;
    const to = event.relatedTarget as Node | null;
    if (!section.contains(to)) section.classList.remove('dropping');
  };

  drop = (event: DragEvent) => {
    (event.currentTarget as HTMLElement).classList.remove('dropping');
    if (!event.dataTransfer?.types.includes('Files')) return;
    // The browser would otherwise navigate to the file.
    event.preventDefault();
    // The disclosure shows the result.
    if (this.#place instanceof HTMLDetailsElement) this.#place.open = true;
    filesOf(event.dataTransfer).then((files) => this.take(files, true));
  };
}

/** Returns what was dropped, with the files of folders and their paths in them. */
async function filesOf({ items }: DataTransfer): Promise<File[]> {
  // All entries are read synchronously: the list is empty afterwards.
  const dropped = [...items].filter(({ kind }) => kind === 'file').map((item) => ({ entry: item.webkitGetAsEntry(), file: item.getAsFile() }));
  const files = await Promise.all(dropped.map(({ entry, file }) => (entry?.isDirectory ? filesIn(entry as FileSystemDirectoryEntry) : file ? [file] : [])));
  return files.flat();
}

async function filesIn(folder: FileSystemDirectoryEntry): Promise<File[]> {
  const reader = folder.createReader();
  const entries: FileSystemEntry[] = [];
  const more = () => new Promise<FileSystemEntry[]>((resolve, reject) => reader.readEntries(resolve, reject));
  // Browsers return a hundred entries at a time.
  for (let some = await more(); some.length > 0; some = await more()) entries.push(...some);
  const files = await Promise.all(entries.filter(({ name }) => !name.startsWith('.')).map(async (entry) => {
    if (entry.isDirectory) return filesIn(entry as FileSystemDirectoryEntry);
    const file = await new Promise<File>((resolve, reject) => (entry as FileSystemFileEntry).file(resolve, reject));
    return [Object.assign(file, { path: entry.fullPath.slice(1) })];
  }));
  return files.flat();
}

/** Returns a button that opens files with some extensions. `prepare` runs while the reader chooses. */
export const fileButton = (id: string, label: string, extensions: string[], choose: (files: File[]) => void, prepare?: () => void) => html`<label class="choice files" @click=${prepare ?? nothing}>
  ${label}
  <input
    id=${id}
    type="file"
    multiple
    accept=${extensions.join(',')}
    @change=${(event: Event) => {
      const input = inputOf(event);
      choose([...(input.files ?? [])]);
      // Reset, so that choosing the same file again after a correction fires an event.
      input.value = '';
    }}
  />
</label>`;
