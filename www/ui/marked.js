/** The sample that is marked, and the way to it from the keyboard. */

import { css, html } from 'lit';
import { live } from 'lit/directives/live.js';
import { inputOf } from './controls.js';
import { counted } from './format.js';

export const markedStyles = css`
  .marked {
    display: flex;
    flex-wrap: wrap;
    align-items: center;
    gap: 0.1rem 1.1rem;
    min-height: 2.2rem;
    margin: 0.3rem 0 0;
  }

  .marked output {
    display: inline-flex;
    flex-wrap: wrap;
    gap: 0.1rem 1.1rem;
  }

  .marked label {
    color: var(--accent);
  }

  .marked input {
    width: 8rem;
    min-height: 1.75rem;
    margin-left: 0.3rem;
    padding: 0 0.3rem;
    font: inherit;
    font-variant-numeric: inherit;
  }

  .hint {
    color: var(--muted);
    font-style: italic;
  }
`;

/**
 * @param {{ index: number, mark: (index: number) => void }} cloud −1 for none
 * @param {object} marked
 * @param {string} marked.id
 * @param {string} marked.label
 * @param {number} marked.shown samples there are
 * @param {number} marked.beyond the index that a number above them means; −1 for none
 * @param {unknown} marked.told what is said of it; nothing where none is marked
 * @param {string} marked.hint said where none is
 */
export function markedSample(cloud, { id, label, shown, beyond, told, hint }) {
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
        .value=${live(cloud.index < 0 ? '' : String(cloud.index + 1))}
        @input=${(/** @type {Event} */ event) => {
          const number = inputOf(event).valueAsNumber;
          const valid = Number.isInteger(number) && number >= 1;
          cloud.mark(!valid ? -1 : number > shown ? beyond : number - 1);
        }}
      />
    </label>
    <output for=${id}>${told || html`<span class="hint">${hint}</span>`}</output>
  </p>`;
}
