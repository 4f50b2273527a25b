/** Opening maps of the reader: chosen, dropped or pasted. Shows why the latest one was refused. */

import { instantiate } from '../../../core.ts';
import { Part } from '../../../figure/part.ts';
import { words } from '../../../messages/registry.ts';
import { FileDrop } from '../../shared/files.ts';
import type { OwnMap } from './files.ts';

/** Extensions of map files. */
export const EXTENSIONS = ['.json', '.yaml', '.yml', '.pgm', '.png'];

/** Id of the disclosure with the current map and the reason why another one was refused. */
const DISCLOSURE_ID = 'more';

/** Size of a file in bytes above which a message is shown while it is read. */
const LARGE_BYTES = 1_000_000;

/** Decodes a PNG image with the whole core, because the core of the figure has no decoder. */
const decodePng: import('./files.ts').DecodePng = async (bytes) => (await instantiate()).readMapImage(bytes);

export class MapOpener extends Part<import('../map-squeeze.ts').MapSqueezeElement> {
  dropped = new FileDrop(this.host, DISCLOSURE_ID, (files) => this.choose(files));
  /** True while a large file is being read. */
  isReading = false;
  /** Reason why the latest map was refused. */
  #complaint: (() => string) | undefined;
  /** Number of the latest attempt to read files. Results of earlier ones are ignored. */
  #reading = 0;

  /** Message on the latest refused map, or an empty string. */
  get complaint() {
    return this.#complaint?.() ?? '';
  }

  clearRefusal() {
    this.#complaint = undefined;
  }

  async choose(files: File[]) {
    if (files.reduce((sum, { size }) => sum + size, 0) > LARGE_BYTES) {
      this.isReading = true;
      this.host.announcer.announce(words.squeeze.own.reading);
      this.host.requestUpdate();
      // Two frames: the message is on the screen when the first has been drawn.
      for (let frame = 0; frame < 2; frame++) await new Promise(requestAnimationFrame);
    }
    await this.#open(({ readMapFiles }) => readMapFiles(files, decodePng));
    this.isReading = false;
    this.host.requestUpdate();
  }

  paste(text: string) {
    this.#open(({ readPlan }) => readPlan(words.squeeze.pasted, text));
  }

  async #open(find: (reader: typeof import('./files.ts')) => OwnMap | Promise<OwnMap>) {
    const reading = ++this.#reading;
    try {
      const map = await find(await import('./files.ts'));
      if (reading === this.#reading) this.host.open(map);
    } catch (error) {
      if (reading === this.#reading) this.refuse(error);
    }
  }

  /** Stores the reason why a map was refused. */
  async refuse(error: unknown) {
    const { message, sentence } = error as Error & Partial<import('./files.ts').MapFileError>;
    this.#complaint = () => {
      const { refused } = words.squeeze;
      return sentence ? sentence(refused) : refused.cannot(message);
    };
    this.host.requestUpdate();
    await this.dropped.showRefusal(this.complaint);
  }
}
