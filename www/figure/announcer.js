/** What a screen reader is told once a change has come to rest. */

import { html } from 'lit';

export class Announcer {
  #due = false;
  #text = '';

  /** Something has come to rest: its outcome is worth a sentence. */
  expect() {
    this.#due = true;
  }

  /** @param {() => string} sentence of the outcome, asked for only where one is expected */
  say(sentence) {
    if (!this.#due) return;
    this.#due = false;
    this.#text = sentence();
  }

  /** @param {string} text that is worth saying now */
  tell(text) {
    this.#text = text;
  }

  render() {
    return html`<p class="visually-hidden" role="status">${this.#text}</p>`;
  }
}
