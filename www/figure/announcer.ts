/** What a screen reader is told once a change has come to rest. */

import { html } from 'lit';

export class Announcer {
  #due = false;
  #text = '';
  /** Sentence about an outcome, which holds until another comes. */
  #outcome: string | undefined;

  /** Something has come to rest: its outcome is worth a sentence. */
  announceNext() {
    this.#due = true;
  }

  /** @param sentence of the outcome, asked for only where one is expected or was said */
  setOutcome(sentence: () => string) {
    if (!this.#due && !this.#outcome) return;
    const text = sentence();
    // Of what the page changes it says itself what there is to say.
    this.#text = this.#outcome = this.#due || text === this.#outcome ? text : '';
    this.#due = false;
  }

  /** @param text that is worth saying now */
  announce(text: string) {
    this.#outcome = undefined;
    this.#text = text;
  }

  render() {
    return html`<p class="visually-hidden" role="status">${this.#text}</p>`;
  }
}
