/** What the page writes around a figure, in its slots: a title, which names it, and a caption. */

import { html, nothing } from 'lit';
import { words } from '../messages/registry.ts';
import { Part } from './part.ts';

export class Lettering extends Part {
  /** The figure's name: the title that the page gives it, or the widget's own. */
  get name() {
    const title = this.#given('title').map(({ textContent }) => textContent).join(' ').replace(/\s+/g, ' ').trim();
    return title || (words as any)[this.host.kind.vocabulary].title;
  }

  /** A heading where the page says of which level. An audience sees the figure's own name where the page gives none. */
  title() {
    const { presentation, headingLevel } = this.host;
    return this.#slot('title', headingLevel, presentation && this.name);
  }

  caption() {
    return this.#slot('caption', null, false);
  }

  /** Content that the page has put into a slot. */
  #given(name: string) {
    return [...this.host.children].filter(({ slot }) => slot === name);
  }

  /** @param otherwise text where the page has put nothing into it */
  #slot(name: string, level: string | null, otherwise: string | false) {
    return html`<div
      class="${name}-slot"
      role=${level ? 'heading' : nothing}
      aria-level=${level ?? nothing}
      ?hidden=${!otherwise && this.#given(name).length === 0}
    >
      <slot name=${name} @slotchange=${() => this.host.requestUpdate()}>${otherwise || nothing}</slot>
    </div>`;
  }
}
