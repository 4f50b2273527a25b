/** What the reader typed and the figure refused. */

import { Part } from './part.ts';

export class Typing extends Part {
  #refused: { key: string, complaint: string } | undefined;

  /** @param key of the setting */
  refuse(key: string, complaint: string) {
    this.#refused = { key, complaint };
    this.host.requestUpdate();
  }

  /** @returns what is said of it */
  refusalOf(key: string): string | undefined {
    return this.#refused?.key === key ? this.#refused.complaint : undefined;
  }

  /** There is something else of interest. */
  forget() {
    if (!this.#refused) return;
    this.#refused = undefined;
    this.host.requestUpdate();
  }
}
