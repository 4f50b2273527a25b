/** What a screen reader is told once a change has come to rest. */

import { html } from 'lit';

export class Announcer {
  #due = false;
  #text = '';
  /** Whether that is said of an outcome, which holds as long as there is no other. */
  #isOutcome = false;

  /** Something has come to rest: its outcome is worth a sentence. */
  expect() {
    this.#due = true;
  }

  /** @param {() => string} sentence of the outcome, asked for only where one is expected or was said */
  say(sentence) {
    if (!this.#due && !this.#isOutcome) return;
    const text = sentence();
    // Of what the page changes it says itself what there is to say.
    this.#text = this.#due || text === this.#text ? text : '';
    this.#isOutcome = this.#text !== '';
    this.#due = false;
  }

  /** @param {string} text that is worth saying now */
  tell(text) {
    this.#isOutcome = false;
    this.#text = text;
  }

  render() {
    return html`<p class="visually-hidden" role="status">${this.#text}</p>`;
  }
}
