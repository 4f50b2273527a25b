/** Disclosures, whose content is rendered only while they are open. */

import { html, noChange, nothing } from 'lit';
import { Directive, directive } from 'lit/directive.js';

/** Returns a disclosure whose content is rendered only while it is open. Scripts can find it by its id. */
export function disclosure(name: string, content: () => unknown, id?: string) {
  return html`<details part="fold" id=${id ?? nothing} @toggle=${renderHost}>
    <summary>${name}</summary>
    <div class="folded">${whileOpen(content)}</div>
  </details>`;
}

/** Listener that renders the host element, which Lit passes as `this`. */
function renderHost(this: import('lit').LitElement) {
  this.requestUpdate();
}

const whileOpen = directive(
  class extends Directive {
    render(content: () => unknown) {
      return content();
    }

    update({ parentNode }: import('lit').ChildPart, [content]: [() => unknown]) {
      const details = (parentNode as Element).closest('details');
      return details?.open ? this.render(content) : noChange;
    }
  },
);
