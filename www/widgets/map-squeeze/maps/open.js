/** How a map of the reader's own gets in: chosen, dropped or pasted; and why the latest was refused. */

import { Part } from '../../../figure/part.js';
import { words } from '../../../messages/registry.js';
import { FileDrop } from '../../shared/files.js';

/** @import { OwnMap } from './files.js' */

/** What the names of files may end in. */
export const EXTENSIONS = ['.json', '.yaml', '.yml', '.pgm', '.png'];

/** The fold that says which map is there and why another was refused. */
export const FOLD = 'map-fold';

/** @extends {Part<import('../map-squeeze.js').MapSqueezeElement>} */
export class MapOpener extends Part {
  dropped = new FileDrop(this.host, FOLD, (files) => this.choose(files));
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
  choose(files) {
    this.#open(({ readMapFiles }) => readMapFiles(files));
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
    await this.dropped.showRefusal();
  }
}
