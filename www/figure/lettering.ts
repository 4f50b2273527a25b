/** Title and caption of a figure, from the page's slots. */

import { html, nothing } from 'lit';
import { words } from '../messages/registry.ts';
import { Part } from './part.ts';

export class Lettering extends Part {
  /** Name of the figure: the page's title, or the widget's own. */
  get name() {
    const title = this.#slotted('title').map(({ textContent }) => textContent).join(' ').replace(/\s+/g, ' ').trim();
    return title || (words as any)[this.host.kind.vocabulary].title;
  }

  /** Returns the title as a heading of the level that the page sets. In a presentation the figure's name replaces a missing title. */
  title() {
    const { presentation, headingLevel } = this.host;
    return this.#slot('title', headingLevel, presentation && this.name);
  }

  caption() {
    return this.#slot('caption', null, false);
  }

  /** Returns the page's elements in a slot. */
  #slotted(name: string) {
    return [...this.host.children].filter(({ slot }) => slot === name);
  }

  /** Returns a slot, with a text for an empty one. */
  #slot(name: string, level: string | null, fallback: string | false) {
    return html`<div
      class="${name}-slot"
      role=${level ? 'heading' : nothing}
      aria-level=${level ?? nothing}
      ?hidden=${!fallback && this.#slotted(name).length === 0}
    >
      <slot name=${name} @slotchange=${() => this.host.requestUpdate()}>${fallback || nothing}</slot>
    </div>`;
  }
}
