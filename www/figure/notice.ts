/** Messages to the user: a notice, which everybody sees, and announcements for screen readers. */

import { html, nothing } from 'lit';
import { words } from '../messages/registry.ts';
import { button } from '../ui/controls.ts';
import { FigureController } from './controller.ts';

/** Notice with a button, over the lower edge of the figure or the window. It moves no content. */
export class Notice extends FigureController {
  #shown: { content: () => unknown, stop?: () => void } | undefined;

  /** Shows HTML until the user closes it, or about work that the button stops. */
  show(content: () => unknown, stop?: () => void) {
    this.#shown = { content, stop };
    this.host.requestUpdate();
  }

  hide() {
    this.#shown = undefined;
    this.host.requestUpdate();
  }

  #press = () => {
    this.#shown?.stop?.();
    this.hide();
  };

  /** Presses the button by the key Escape. */
  onKey(event: KeyboardEvent) {
    if (!this.#shown || event.key !== 'Escape' || event.defaultPrevented) return;
    event.preventDefault();
    this.#press();
  }

  render() {
    if (!this.#shown) return nothing;
    const { content, stop } = this.#shown;
    return html`<div class="notice"><div part="notice">
      <div role="alert">${content()}</div> ${stop ? button(words.progress.stop, this.#press, { title: words.progress.stopTitle }) : button(words.close, this.#press)}
    </div></div>`;
  }
}

/** Announcements for screen readers after completed changes. */
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
    // Changes by the page are not announced. They clear an announced outcome that is no longer true.
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
