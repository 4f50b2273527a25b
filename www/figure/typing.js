/** What the reader typed and the figure refused. */

import { Part } from './part.js';

export class Typing extends Part {
  /** @type {{ key: string, complaint: string } | undefined} */
  #refused;

  /**
   * @param {string} key of the setting
   * @param {string} complaint
   */
  refuse(key, complaint) {
    this.#refused = { key, complaint };
    this.host.requestUpdate();
  }

  /** @param {string} key @returns {string | undefined} what is said of it */
  refusalOf(key) {
    return this.#refused?.key === key ? this.#refused.complaint : undefined;
  }

  /** There is something else of interest. */
  forget() {
    if (!this.#refused) return;
    this.#refused = undefined;
    this.host.requestUpdate();
  }
}
