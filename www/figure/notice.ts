/** Messages to the user: the latest notice, which everybody sees, and announcements for screen readers. */

import { html, nothing } from 'lit';
import { words } from '../messages/registry.ts';
import { buttonHtml } from '../ui/controls.ts';
import { FigureController } from './controller.ts';

/** Notice beside a control, or over the lower edge of the figure or window with a button that closes it. Its appearance moves no other content. */
export class Notice extends FigureController {
  #latest: { content: () => unknown, control?: string } | undefined;
  /** Notice about long work, until `endWork`. It covers another notice at the lower edge. */
  #work: { content: () => unknown, stop: () => void } | undefined;

  /** Shows a notice: beside the control named `control`, or otherwise with a button. A notice about long work has a button that calls `stop`. */
  show(content: () => unknown, { control, stop }: { control?: string, stop?: () => void } = {}) {
    if (stop) this.#work = { content, stop };
    else this.#latest = { content, control };
    this.host.requestUpdate();
  }

  /** Hides the latest notice, unless it is about long work. */
  dismiss() {
    if (this.#latest) this.host.requestUpdate();
    this.#latest = undefined;
  }

  endWork() {
    this.#work = undefined;
    this.host.requestUpdate();
  }

  /** Returns the notice beside a control, such as why a typed text was refused; undefined if there is none. */
  textBeside(control: string) {
    return this.#latest?.control === control ? (this.#latest.content() as string) : undefined;
  }

  /** Notice at the lower edge. */
  get #atEdge() {
    return this.#work ?? (this.#latest?.control ? undefined : this.#latest);
  }

  #stopOrDismiss = () => {
    if (!this.#work) this.dismiss();
    this.#work?.stop();
    this.endWork();
  };

  /** Stops the work or closes the notice when the user presses Escape. */
  stopOnEscape(event: KeyboardEvent) {
    if (!this.#atEdge || event.key !== 'Escape' || event.defaultPrevented) return;
    event.preventDefault();
    this.#stopOrDismiss();
  }

  render() {
    if (!this.#atEdge) return nothing;
    const { stop, stopTitle } = words.progress;
    return html`<div class="notice"><div part="notice">
      <div role="alert">${this.#atEdge.content()}</div> ${this.#work ? buttonHtml(stop, this.#stopOrDismiss, { title: stopTitle }) : buttonHtml(words.close, this.#stopOrDismiss)}
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
