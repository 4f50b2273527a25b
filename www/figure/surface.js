/** What is seen of a figure: all of it, or in its place the way to it, or the sentence why it cannot run. */

import { html, noChange } from 'lit';
import { en } from '../messages/en.js';
import { speak, words } from '../messages/registry.js';
import { keepUsed, stop } from './inside.js';
import { placeholder } from './placeholder.js';

/** @import { Figure } from './figure.js' */

/** @param {Figure} figure */
export function surface(figure) {
  speak(figure);
  const { lettering, presenting, progress, stage } = figure;
  const recolour = () => stage.recolour();
  return html`
    <span class="scheme-probe" aria-hidden="true" @transitionend=${recolour} @transitioncancel=${recolour}></span>
    <div class="surface ${presenting.className}" @input=${stop} @change=${stop} @keydown=${keepUsed}>
      ${lettering.title()} ${contentOf(figure)} ${progress.render()} ${lettering.caption()} ${presenting.render()}
    </div>
  `;
}

/**
 * What was shown stays while there is no machine: it is made again after a trap, or the element is not on the page.
 *
 * @param {Figure} figure
 */
function contentOf(figure) {
  const { failure } = figure.runtime;
  if (failure !== undefined) return html`<p class="failure" role="alert">${sorry(failure)}</p>`;
  if (figure.machine) return [figure.content(figure.reading), figure.announcer.render()];
  return figure.reading ? noChange : placeholder(figure);
}

/** The sentence in the place of a figure that cannot run. @param {string} reason */
function sorry(reason) {
  try {
    return `${words.failure(reason)}`;
  } catch {
    // Another language's words come from the page.
    return en.failure(reason);
  }
}
