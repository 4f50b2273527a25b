/** What is folded away. */

import { html, noChange, nothing } from 'lit';
import { Directive, directive } from 'lit/directive.js';

/**
 * What is folded away until it is asked for: nothing of it is made before, nor while it is closed again.
 *
 * @param {string} name
 * @param {() => unknown} content
 * @param {string} [id] where something else than the reader opens it too
 */
export function fold(name, content, id) {
  return html`<details part="fold" id=${id ?? nothing} @toggle=${renderHost}>
    <summary>${name}</summary>
    <div class="folded">${whileOpen(content)}</div>
  </details>`;
}

/** Lit calls listeners with the element that has rendered them. @this {import('lit').LitElement} */
function renderHost() {
  this.requestUpdate();
}

const whileOpen = directive(
  class extends Directive {
    /** @param {() => unknown} content */
    render(content) {
      return content();
    }

    /**
     * @param {import('lit').ChildPart} part
     * @param {[() => unknown]} content
     */
    update({ parentNode }, [content]) {
      const details = /** @type {Element} */ (parentNode).closest('details');
      return details?.open ? this.render(content) : noChange;
    }
  },
);
