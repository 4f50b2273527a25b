/** Messages to the user: the latest notice, which everybody sees, and announcements for screen readers. */

import { html, nothing } from 'lit';
import { words } from '../messages/registry.ts';
import { buttonHtml } from '../ui/controls.ts';
import { FigureController } from './controller.ts';

interface ShownNotice {
  renderContent: () => unknown;
  /** Stops the long work that the notice is about. */
  stopWork?: () => void;
}

/** Notice at the lower edge of the figure or window. It moves no other content. */
export class Notice extends FigureController {
  #notice: ShownNotice | undefined;

  /** Shows a notice with a button that closes it. A notice about long work has a button that calls `stopWork`, and stays until `endWork` is called. */
  showNotice(renderContent: () => unknown, stopWork?: () => void) {
    if (stopWork || !this.#notice?.stopWork) this.#setNotice({ renderContent, stopWork });
  }

  /** Hides the notice, unless it is about long work. */
  dismissNotice() {
    if (this.#notice && !this.#notice.stopWork) this.#setNotice();
  }

  endWork() {
    if (this.#notice?.stopWork) this.#setNotice();
  }

  #setNotice(notice?: ShownNotice) {
    this.#notice = notice;
    this.host.requestUpdate();
  }

  #stopOrClose = () => {
    this.#notice?.stopWork?.();
    this.#setNotice();
  };

  /** Stops the work or closes the notice when the user presses Escape. */
  stopOnEscape(event: KeyboardEvent) {
    if (!this.#notice || event.key !== 'Escape' || event.defaultPrevented) return;
    event.preventDefault();
    this.#stopOrClose();
  }

  render() {
    if (!this.#notice) return nothing;
    const { stopLabel: stop, stopTitle } = words.progress;
    return html`<div class="notice"><div part="notice">
      <div role="alert">${this.#notice.renderContent()}</div> ${this.#notice.stopWork ? buttonHtml(stop, this.#stopOrClose, { title: stopTitle }) : buttonHtml(words.closeLabel, this.#stopOrClose)}
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
