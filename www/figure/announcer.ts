/** Announcements for screen readers after completed changes. */

import { html } from 'lit';

export class Announcer {
  #isDue = false;
  #announcedText = '';
  /** Latest announced outcome. */
  #latestOutcome: string | undefined;

  /** Requests an announcement of the next outcome. */
  announceNext() {
    this.#isDue = true;
  }

  /** Announces an outcome if one was requested. `sentence` is only called if needed. */
  setOutcome(sentence: () => string) {
    if (!this.#isDue && !this.#latestOutcome) return;
    const text = sentence();
    // An outcome that the page caused clears the announced one without an announcement.
    this.#announcedText = this.#latestOutcome = this.#isDue || text === this.#latestOutcome ? text : '';
    this.#isDue = false;
  }

  announce(text: string) {
    this.#latestOutcome = undefined;
    this.#announcedText = text;
  }

  render() {
    return html`<p class="visually-hidden" role="status">${this.#announcedText}</p>`;
  }
}
