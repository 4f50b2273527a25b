/** Messages to the user: the latest notice, which everybody sees, and announcements for screen readers. */

import { html, nothing } from 'lit';
import { words } from '../messages/registry.ts';
import { button } from '../ui/controls.ts';
import { FigureController } from './controller.ts';

/** Notice beside a control, or with a button over the lower edge of the figure or the window. It moves no content. */
export class Notice extends FigureController {
  #shown: { content: () => unknown, control?: string, stop?: () => void } | undefined;

  /** Shows HTML beside the control of a name, or until the user closes it, or about work that the button stops. */
  show(content: () => unknown, { control, stop }: { control?: string, stop?: () => void } = {}) {
    this.#shown = { content, control, stop };
    this.host.requestUpdate();
  }

  /** Hides a sentence, as at the next change by the user. A notice about work stays. */
  dismiss() {
    if (this.#shown && !this.#shown.stop) this.hide();
  }

  hide() {
    this.#shown = undefined;
    this.host.requestUpdate();
  }

  /** Returns the notice beside a control, such as why a typed text was refused; undefined if there is none. */
  beside(control: string) {
    return this.#shown?.control === control ? (this.#shown.content() as string) : undefined;
  }

  #press = () => {
    this.#shown?.stop?.();
    this.hide();
  };

  /** Presses the button by the key Escape. */
  onKey(event: KeyboardEvent) {
    if (!this.#shown || this.#shown.control || event.key !== 'Escape' || event.defaultPrevented) return;
    event.preventDefault();
    this.#press();
  }

  render() {
    if (!this.#shown || this.#shown.control) return nothing;
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
