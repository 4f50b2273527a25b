/** Messages to the user: the latest notice, which everybody sees, and announcements for screen readers. */

import { html, nothing } from 'lit';
import { words } from '../messages/registry.ts';
import { buttonHtml } from '../ui/controls.ts';
import { FigureController } from './controller.ts';

/** Notice at the lower edge of the figure or window. It moves no other content. */
export class FigureNotice extends FigureController {
  #renderContent: (() => unknown) | undefined;
  /** Notice about long work. Until the work has ended, it hides the notice of `showNotice`. */
  #workNotice: { renderContent: () => unknown, stopWork: () => void } | undefined;

  /** Shows a notice with a button that closes it. */
  showNotice(renderContent: () => unknown) {
    this.#renderContent = renderContent;
    this.figure.requestUpdate();
  }

  /** Shows a notice about long work, with a button that calls `stopWork`, until `endWork` is called. */
  showWork(renderContent: () => unknown, stopWork: () => void) {
    this.#workNotice = { renderContent, stopWork };
    this.figure.requestUpdate();
  }

  dismissNotice() {
    if (!this.#renderContent) return;
    this.#renderContent = undefined;
    this.figure.requestUpdate();
  }

  endWork() {
    if (!this.#workNotice) return;
    this.#workNotice = undefined;
    this.figure.requestUpdate();
  }

  #stopOrClose = () => {
    const workNotice = this.#workNotice;
    if (!workNotice) return this.dismissNotice();
    workNotice.stopWork();
    this.endWork();
  };

  /** Stops the work or closes the notice when the user presses Escape. */
  stopOnEscape(event: KeyboardEvent) {
    if (!(this.#workNotice ?? this.#renderContent) || event.key !== 'Escape' || event.defaultPrevented) return;
    event.preventDefault();
    this.#stopOrClose();
  }

  render() {
    const renderContent = this.#workNotice?.renderContent ?? this.#renderContent;
    if (!renderContent) return nothing;
    const { stopLabel, stopTitle } = words.progress;
    const closeButtonHtml = this.#workNotice
      ? buttonHtml(stopLabel, this.#stopOrClose, { title: stopTitle })
      : buttonHtml(words.closeLabel, this.#stopOrClose);
    return html`<div class="notice"><div part="notice">
      <div role="alert">${renderContent()}</div> ${closeButtonHtml}
    </div></div>`;
  }
}

/** Announcements for screen readers after completed changes. */
export class Announcer {
  #isAnnouncementDue = false;
  #announcedText = '';
  #latestOutcome: string | undefined;

  /** Requests an announcement of the next outcome. */
  requestAnnouncement() {
    this.#isAnnouncementDue = true;
  }

  /** Announces the outcome of a change if an announcement was requested. Otherwise clears an announced outcome that is no longer true. */
  setOutcome(getOutcome: () => string) {
    if (!this.#isAnnouncementDue && !this.#latestOutcome) return;
    const text = getOutcome();
    // Changes by the page are not announced.
    this.#announcedText = this.#latestOutcome = this.#isAnnouncementDue || text === this.#latestOutcome ? text : '';
    this.#isAnnouncementDue = false;
  }

  announceText(text: string) {
    this.#latestOutcome = undefined;
    this.#announcedText = text;
  }

  render() {
    return html`<p class="visually-hidden" role="status">${this.#announcedText}</p>`;
  }
}
