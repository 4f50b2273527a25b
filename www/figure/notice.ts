/** Notice over the lower edge of the figure or the window, which the reader closes. It moves no content. */

import { css, html, nothing } from 'lit';
import { words } from '../messages/registry.ts';
import { button } from '../ui/controls.ts';
import { Part } from './part.ts';

export const noticeStyles = css`
  .progress > .notice {
    width: max-content;
    border-left: 3px solid var(--accent);
    white-space: normal;
  }
`;

export class Notice extends Part {
  #sentence = '';

  get isShown() {
    return this.#sentence !== '';
  }

  /** Shows a sentence; an empty one hides the notice. */
  show(sentence: string) {
    this.#sentence = sentence;
    this.host.requestUpdate();
  }

  render() {
    if (!this.isShown) return nothing;
    return html`<div class="progress">
      <div class="notice"><span role="alert">${this.#sentence}</span> ${button(words.close, () => this.show(''))}</div>
    </div>`;
  }
}
