/** Text that the reader typed and the figure refused. */

import { Part } from './part.ts';

export class Typing extends Part {
  #refused: { key: string, complaint: string } | undefined;

  refuse(key: string, complaint: string) {
    this.#refused = { key, complaint };
    this.host.requestUpdate();
  }

  /** Returns the message about a setting's refused text. */
  refusalOf(key: string): string | undefined {
    return this.#refused?.key === key ? this.#refused.complaint : undefined;
  }

  /** Clears the refusal. */
  forget() {
    if (!this.#refused) return;
    this.#refused = undefined;
    this.host.requestUpdate();
  }
}
