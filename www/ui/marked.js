/** The sample that is marked, and the way to it from the keyboard. */

import { css, html, noChange, nothing } from 'lit';
import { live } from 'lit/directives/live.js';
import { inputOf } from './controls.js';
import { counted } from './format.js';

export const markedStyles = css`
  .marked {
    display: flex;
    flex-wrap: wrap;
    align-items: center;
    gap: 0.1em 1.1em;
    min-height: 2.2em;
    margin: 0.3em 0 0;
  }

  .marked output {
    display: inline-flex;
    flex-wrap: wrap;
    gap: 0.1em 1.1em;
  }

  .marked label {
    color: var(--accent);
  }

  .marked input {
    width: 8em;
    min-height: 1.75em;
    margin-left: 0.3em;
    padding: 0 0.3em;
    font: inherit;
    font-variant-numeric: inherit;
  }

  .hint {
    color: var(--muted);
    font-style: italic;
  }
`;

/**
 * The field keeps what was typed and is refused until it is right or left.
 *
 * @param {object} marked
 * @param {number} marked.index −1 for none
 * @param {string} marked.id
 * @param {string} marked.label
 * @param {number} marked.shown samples there are
 * @param {(text: string) => void} marked.type takes what was typed
 * @param {string} [marked.refusal] what is said of it where it was refused
 * @param {() => void} marked.forget it is left
 * @param {unknown} marked.told what is said of it; nothing where none is marked
 * @param {string} marked.hint said where none is
 */
export function markedSample({ index, id, label, shown, type, refusal, forget, told, hint }) {
  return html`<p class="marked">
    <label>
      ${label}
      <input
        id=${id}
        type="number"
        min="1"
        max=${Math.max(1, shown)}
        placeholder=${shown === 0 ? '' : `1–${counted(shown)}`}
        ?disabled=${shown === 0}
        .value=${refusal ? noChange : live(index < 0 ? '' : String(index + 1))}
        @input=${(/** @type {Event} */ event) => type(inputOf(event).value)}
        @blur=${forget}
      />
    </label>
    <output for=${id} role=${refusal ? 'alert' : nothing}>${refusal || told || html`<span class="hint">${hint}</span>`}</output>
  </p>`;
}
