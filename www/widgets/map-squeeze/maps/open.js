/** Maps of the reader's own, chosen, dropped or pasted; and why the latest was refused. */

import { instantiate } from '../../../core.js';
import { Part } from '../../../figure/part.js';
import { words } from '../../../messages/registry.js';
import { FileDrop } from '../../shared/files.js';

/** @import { OwnMap } from './files.js' */

/** Extensions of map files. */
export const EXTENSIONS = ['.json', '.yaml', '.yml', '.pgm', '.png'];

/** The fold that says which map is there and why another was refused. */
const FOLD = 'more';

/** Files of more bytes take longer than a moment to read. */
const LARGE = 1_000_000;

/** Decodes by the whole core: that of the figure has no decoder. @type {import('./files.js').DecodePng} */
const decodePng = async (bytes) => (await instantiate()).readMapImage(bytes);

/** @extends {Part<import('../map-squeeze.js').MapSqueezeElement>} */
export class MapOpener extends Part {
  dropped = new FileDrop(this.host, FOLD, (files) => this.choose(files));
  /** True while a large file is being read. */
  isReading = false;
  /** Why the latest map was refused. @type {(() => string) | undefined} */
  #complaint;
  /** The latest attempt to read files: an earlier one that ends later is void. */
  #reading = 0;

  /** Empty where there is nothing to complain of. */
  get complaint() {
    return this.#complaint?.() ?? '';
  }

  forgive() {
    this.#complaint = undefined;
  }

  /** @param {File[]} files */
  async choose(files) {
    if (files.reduce((sum, { size }) => sum + size, 0) > LARGE) {
      this.isReading = true;
      this.host.announcer.tell(words.squeeze.own.reading);
      this.host.requestUpdate();
      // Two frames: the message is on the screen when the first has been drawn.
      for (let frame = 0; frame < 2; frame++) await new Promise(requestAnimationFrame);
    }
    await this.#open(({ readMapFiles }) => readMapFiles(files, decodePng));
    this.isReading = false;
    this.host.requestUpdate();
  }

  /** @param {string} text */
  paste(text) {
    this.#open(({ readPlan }) => readPlan(words.squeeze.pasted, text));
  }

  /** @param {(reader: typeof import('./files.js')) => OwnMap | Promise<OwnMap>} find */
  async #open(find) {
    const reading = ++this.#reading;
    try {
      const map = await find(await import('./files.js'));
      if (reading === this.#reading) this.host.open(map);
    } catch (error) {
      if (reading === this.#reading) this.refuse(error);
    }
  }

  /** Says why a map was refused. @param {unknown} error */
  async refuse(error) {
    const { message, sentence } = /** @type {Error & Partial<import('./files.js').MapFileError>} */ (error);
    this.#complaint = () => {
      const { refused } = words.squeeze;
      return sentence ? sentence(refused) : refused.cannot(message);
    };
    this.host.requestUpdate();
    await this.dropped.showRefusal(this.complaint);
  }
}
