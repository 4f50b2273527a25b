/** Progress of long work, with a button that stops it. */

import { css, html, nothing } from 'lit';
import { words } from '../messages/registry.ts';
import { button } from '../ui/controls.ts';
import { Part } from './part.ts';

/** Delay before the progress is shown, ms. */
const DELAY = 200;

/** Styles that place the progress over the lower edge of the figure or the window, without moving content. */
export const progressStyles = css`
  .progress {
    position: sticky;
    z-index: 3;
    bottom: 0;
    height: 0;
  }

  .progress > div {
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

  progress {
    flex: 0 1 8em;
    min-width: 3em;
    accent-color: var(--posterior);
  }
`;

/** Work that can be stopped. */
export type Work = { stop(): void };

export class Progress extends Part {
  #work: Work | undefined;
  /** Start of the work. */
  #since: number | undefined;
  #shown = false;

  hostConnected() {
    // The capturing listener is called before those of the page and the figure.
    document.addEventListener('keydown', this.#key, { capture: true });
  }

  hostDisconnected() {
    document.removeEventListener('keydown', this.#key, { capture: true });
  }

  #key = (event: KeyboardEvent) => {
    if (event.key !== 'Escape' || !this.#shown || event.defaultPrevented) return;
    // The key counts if the focus is in the figure, or on the body, such as after files were dropped.
    if (event.target !== document.body && !event.composedPath().includes(this.host)) return;
    event.preventDefault();
    event.stopPropagation();
    this.#stop();
  };

  /** Updates the progress of work that continues. */
  update(work: Work) {
    this.#work = work;
    const now = performance.now();
    this.#since ??= now;
    if (now - this.#since < DELAY) return;
    if (!this.#shown) this.host.announcer.announce(words.progress.begins);
    this.#shown = true;
    this.host.requestUpdate();
  }

  end(work: Work) {
    if (work !== this.#work) return;
    this.#since = undefined;
    if (!this.#shown) return;
    this.#shown = false;
    this.host.requestUpdate();
  }

  #stop() {
    this.host.announcer.announce(words.progress.stopped);
    this.#work?.stop();
  }

  render() {
    if (!this.#shown) return nothing;
    const say = words.progress;
    return html`<div class="progress">
      <div part="progress">
        <progress aria-label=${say.label} ></progress>
        <span aria-hidden="true">${say.label}</span>
        ${button(say.stop, () => this.#stop(), { title: say.stopTitle })}
      </div>
    </div>`;
  }
}
