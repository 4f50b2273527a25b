/** Messages to the user: the latest notice, which everybody sees, and announcements for screen readers. */

import { html, nothing } from 'lit';
import { words } from '../messages/registry.ts';
import { buttonHtml } from '../ui/controls.ts';
import { FigureController } from './controller.ts';

/** Notice beside a control or, with a close button, at the lower edge of the figure or window. A notice moves no other content. */
export class Notice extends FigureController {
  #latestNotice: { renderContent: () => unknown, control?: string } | undefined;
  /** Notice about long work, shown until `endWork` is called. At the lower edge it takes the place of the latest notice. */
  #workNotice: { renderContent: () => unknown, stop: () => void } | undefined;

  /** Shows a notice beside the control named `control`, or else at the lower edge. A notice about long work has a button that calls `stop`. */
  show(renderContent: () => unknown, { control, stop }: { control?: string, stop?: () => void } = {}) {
    if (stop) this.#workNotice = { renderContent, stop };
    else this.#latestNotice = { renderContent, control };
    this.host.requestUpdate();
  }

  /** Hides the latest notice, unless it is about long work. */
  dismiss() {
    if (this.#latestNotice) this.host.requestUpdate();
    this.#latestNotice = undefined;
  }

  endWork() {
    this.#workNotice = undefined;
    this.host.requestUpdate();
  }

  /** Returns the notice beside a control, such as why a typed text was refused; undefined if there is none. */
  findTextBeside(control: string) {
    return this.#latestNotice?.control === control ? (this.#latestNotice.renderContent() as string) : undefined;
  }

  /** Notice at the lower edge. */
  get #noticeAtEdge() {
    return this.#workNotice ?? (this.#latestNotice?.control ? undefined : this.#latestNotice);
  }

  #stopOrDismiss = () => {
    if (!this.#workNotice) this.dismiss();
    this.#workNotice?.stop();
    this.endWork();
  };

  /** Stops the work or closes the notice when the user presses Escape. */
  stopOnEscape(event: KeyboardEvent) {
    if (!this.#noticeAtEdge || event.key !== 'Escape' || event.defaultPrevented) return;
    event.preventDefault();
    this.#stopOrDismiss();
  }

  render() {
    if (!this.#noticeAtEdge) return nothing;
    const { stop, stopTitle } = words.progress;
    return html`<div class="notice"><div part="notice">
      <div role="alert">${this.#noticeAtEdge.renderContent()}</div> ${this.#workNotice ? buttonHtml(stop, this.#stopOrDismiss, { title: stopTitle }) : buttonHtml(words.close, this.#stopOrDismiss)}
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
  requestAnnouncement() {
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
