/** Announcements for screen readers after completed changes. */

import { html } from 'lit';

export class Announcer {
  #due = false;
  #text = '';
  /** Latest announced outcome. */
  #outcome: string | undefined;

  /** Requests an announcement of the next outcome. */
  announceNext() {
    this.#due = true;
  }

  /** Announces an outcome if one was requested; the sentence is computed only if needed. */
  setOutcome(sentence: () => string) {
    if (!this.#due && !this.#outcome) return;
    const text = sentence();
    // Changes by the page are not announced.
    this.#text = this.#outcome = this.#due || text === this.#outcome ? text : '';
    this.#due = false;
  }

  /** Announces a text now. */
  announce(text: string) {
    this.#outcome = undefined;
    this.#text = text;
  }

  render() {
    return html`<p class="visually-hidden" role="status">${this.#text}</p>`;
  }
}
