/** How a map of the reader's own gets in: chosen, dropped or pasted; and why the latest was refused. */

import { words } from '../../../messages/registry.js';
import { MapFileError, readMapFiles, readPlan } from './files.js';

/** @import { OwnMap } from './files.js' */

export class MapOpener {
  /** Why the latest map was refused. @type {(() => string) | undefined} */
  #complaint;
  /** The latest attempt to read files: an earlier one that ends later is void. */
  #reading = 0;
  #enter;
  #told;

  /**
   * @param {(map: OwnMap) => void} enter puts the robot into a map; throws where that is refused
   * @param {() => void} told called when there is something else to say
   */
  constructor(enter, told) {
    this.#enter = enter;
    this.#told = told;
  }

  /** Empty where there is nothing to complain of. */
  get complaint() {
    return this.#complaint?.() ?? '';
  }

  forgive() {
    this.#complaint = undefined;
  }

  /** @param {File[]} files */
  choose(files) {
    this.#open(() => readMapFiles(files));
  }

  /** @param {string} text */
  paste(text) {
    this.#open(() => readPlan(words.squeeze.pasted, text));
  }

  /** @param {() => Promise<OwnMap>} find */
  async #open(find) {
    const reading = ++this.#reading;
    try {
      const map = await find();
      if (reading === this.#reading) this.#enter(map);
    } catch (error) {
      if (reading !== this.#reading) return;
      const reason = error instanceof Error ? error.message : String(error);
      this.#complaint = () => {
        const { refused } = words.squeeze;
        return error instanceof MapFileError ? error.sentence(refused) : refused.cannot(reason);
      };
      this.#told();
    }
  }

  over = (/** @type {DragEvent} */ event) => {
    if (!event.dataTransfer?.types.includes('Files')) return;
    event.preventDefault();
    /** @type {HTMLElement} */ (event.currentTarget).classList.add('dropping');
  };

  leave = (/** @type {DragEvent} */ event) => {
    const section = /** @type {HTMLElement} */ (event.currentTarget);
    const to = /** @type {Node | null} */ (event.relatedTarget);
    if (!section.contains(to)) section.classList.remove('dropping');
  };

  drop = (/** @type {DragEvent} */ event) => {
    /** @type {HTMLElement} */ (event.currentTarget).classList.remove('dropping');
    if (!event.dataTransfer?.types.includes('Files')) return;
    // The browser would leave the page for the file.
    event.preventDefault();
    this.choose([...event.dataTransfer.files]);
  };
}
