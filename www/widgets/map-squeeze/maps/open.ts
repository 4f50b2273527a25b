/** Maps of the reader's own, chosen, dropped or pasted; and why the latest was refused. */

import { instantiate } from '../../../core.ts';
import { Part } from '../../../figure/part.ts';
import { words } from '../../../messages/registry.ts';
import { FileDrop } from '../../shared/files.ts';
import type { OwnMap } from './files.ts';

/** Extensions of map files. */
export const EXTENSIONS = ['.json', '.yaml', '.yml', '.pgm', '.png'];

/** The fold that says which map is there and why another was refused. */
const FOLD = 'more';

/** Files of more bytes take longer than a moment to read. */
const LARGE = 1_000_000;

/** Decodes by the whole core: that of the figure has no decoder. */
const decodePng: import('./files.ts').DecodePng = async (bytes) => (await instantiate()).readMapImage(bytes);

export class MapOpener extends Part<import('../map-squeeze.ts').MapSqueezeElement> {
  dropped = new FileDrop(this.host, FOLD, (files) => this.choose(files));
  /** True while a large file is being read. */
  isReading = false;
  /** Why the latest map was refused. */
  #complaint: (() => string) | undefined;
  /** The latest attempt to read files: an earlier one that ends later is void. */
  #reading = 0;

  /** Empty where there is nothing to complain of. */
  get complaint() {
    return this.#complaint?.() ?? '';
  }

  forgive() {
    this.#complaint = undefined;
  }

  async choose(files: File[]) {
    if (files.reduce((sum, { size }) => sum + size, 0) > LARGE) {
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

  /** Says why a map was refused. */
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
