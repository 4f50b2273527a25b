/** Messages to the user: the latest notice, which everybody sees, and announcements for screen readers. */

import { html, nothing } from 'lit';
import { words } from '../messages/registry.ts';
import { buttonHtml } from '../ui/controls.ts';
import { FigureController } from './controller.ts';

/** Notice beside a control, or over the lower edge of the figure or window with a button that closes it. Its appearance moves no other content. */
export class Notice extends FigureController {
  #currentNotice: { content: () => unknown, control?: string, stop?: () => void } | undefined;

  /** Shows a notice: beside the control named `control`, or otherwise with a button. The button calls `stop`, if given, and closes the notice. */
  show(content: () => unknown, { control, stop }: { control?: string, stop?: () => void } = {}) {
    this.#currentNotice = { content, control, stop };
    this.host.requestUpdate();
  }

  /** Hides the notice, unless it is about work that can be stopped. */
  dismiss() {
    if (this.#currentNotice && !this.#currentNotice.stop) this.hide();
  }

  hide() {
    this.#currentNotice = undefined;
    this.host.requestUpdate();
  }

  /** Returns the notice beside a control, such as why a typed text was refused; undefined if there is none. */
  textBeside(control: string) {
    return this.#currentNotice?.control === control ? (this.#currentNotice.content() as string) : undefined;
  }

  #stopOrHide = () => {
    this.#currentNotice?.stop?.();
    this.hide();
  };

  /** Stops the work or closes the notice when the user presses Escape. */
  stopOnEscape(event: KeyboardEvent) {
    if (!this.#currentNotice || this.#currentNotice.control || event.key !== 'Escape' || event.defaultPrevented) return;
    event.preventDefault();
    this.#stopOrHide();
  }

  render() {
    if (!this.#currentNotice || this.#currentNotice.control) return nothing;
    const { content, stop } = this.#currentNotice;
    return html`<div class="notice"><div part="notice">
      <div role="alert">${content()}</div> ${stop ? buttonHtml(words.progress.stop, this.#stopOrHide, { title: words.progress.stopTitle }) : buttonHtml(words.close, this.#stopOrHide)}
    </div></div>`;
  }
}

/** Announcements for screen readers after completed changes. */
export class Announcer {
  #isAnnouncementDue = false;
  #announcedText = '';
  /** Latest announced outcome. */
  #latestOutcome: string | undefined;

  /** Requests an announcement of the next outcome. */
  announceNext() {
    this.#isAnnouncementDue = true;
  }

  /** Announces an outcome if an announcement was requested. `getOutcome` is called only then, or if an earlier outcome may have changed. */
  setOutcome(getOutcome: () => string) {
    if (!this.#isAnnouncementDue && !this.#latestOutcome) return;
    const text = getOutcome();
    // Changes by the page are not announced. They clear an announced outcome that is no longer true.
    this.#announcedText = this.#latestOutcome = this.#isAnnouncementDue || text === this.#latestOutcome ? text : '';
    this.#isAnnouncementDue = false;
  }

  announce(text: string) {
    this.#latestOutcome = undefined;
    this.#announcedText = text;
  }

  render() {
    return html`<p class="visually-hidden" role="status">${this.#announcedText}</p>`;
  }
}
