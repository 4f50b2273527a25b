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

  /** Announces an outcome if one was requested. `sentence` is only called if needed. */
  setOutcome(sentence: () => string) {
    if (!this.#due && !this.#outcome) return;
    const text = sentence();
    // An outcome that the page caused clears the announced one without an announcement.
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
