/** Messages to the user: a notice, which everybody sees, and announcements for screen readers. */

import { css, html, nothing } from 'lit';
import { words } from '../messages/registry.ts';
import { button } from '../ui/controls.ts';
import { FigureController } from './controller.ts';

/** Time that work may take before the notice shows it, ms. */
const DELAY_MS = 200;

export const noticeStyles = css`
  .notice {
    position: sticky;
    z-index: 3;
    bottom: 0;
    height: 0;
  }

  .notice > div {
    position: absolute;
    bottom: 0.5em;
    left: 50%;
    display: flex;
    align-items: center;
    gap: 0.8em;
    box-sizing: border-box;
    max-width: 100%;
    padding: 0.35em 0.5em 0.35em 0.9em;
    transform: translateX(-50%);
    background: var(--paper);
    border: 1px solid var(--rule);
    border-radius: 4px;
    box-shadow: 0 2px 10px rgb(0 0 0 / 25%);
    white-space: nowrap;
    font-variant-numeric: tabular-nums;
  }

  .notice > .sentence {
    width: max-content;
    border-left: 3px solid var(--accent);
    white-space: normal;
  }

  progress {
    flex: 0 1 8em;
    min-width: 3em;
    accent-color: var(--posterior);
  }
`;

/** Notice over the lower edge of the figure or the window: the progress of long work with a button that stops it, or a sentence. It moves no content. */
export class Notice extends FigureController {
  #sentenceText = '';
  #stopWork: (() => void) | undefined;

  /** Shows a sentence until the user closes it; an empty one hides it. */
  show(sentence: string) {
    this.#sentenceText = sentence;
    this.host.requestUpdate();
  }

  /** Shows work that takes long, until it ends. `stop` is called if the user stops it. */
  async showDuring(work: Promise<unknown>, stop: () => void) {
    const { host } = this;
    const workEnded = new AbortController();
    const showWork = () => {
      this.#stopWork = () => {
        host.announcer.announce(words.progress.stopped);
        stop();
      };
      host.announcer.announce(words.progress.begins);
      host.requestUpdate();
      // A capturing listener is called before the listeners of the figure.
      document.addEventListener('keydown', this.#onKey, { capture: true, signal: workEnded.signal });
    };
    const timer = setTimeout(showWork, DELAY_MS);
    try {
      await work;
    } finally {
      clearTimeout(timer);
      workEnded.abort();
      this.#stopWork = undefined;
      host.requestUpdate();
    }
  }

  #onKey = (event: KeyboardEvent) => {
    if (event.key !== 'Escape' || event.defaultPrevented) return;
    // The key counts if the focus is in the figure, or on the body, such as after files were dropped.
    if (event.target !== document.body && !event.composedPath().includes(this.host)) return;
    event.preventDefault();
    event.stopPropagation();
    this.#stopWork?.();
  };

  render() {
    const { label, stop, stopTitle } = words.progress;
    if (this.#stopWork) {
      return html`<div class="notice"><div part="progress">
        <progress aria-label=${label}></progress>
        <span aria-hidden="true">${label}</span>
        ${button(stop, this.#stopWork, { title: stopTitle })}
      </div></div>`;
    }
    if (this.#sentenceText === '') return nothing;
    return html`<div class="notice"><div class="sentence">
      <span role="alert">${this.#sentenceText}</span> ${button(words.close, () => this.show(''))}
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
