/** What is seen of a figure: all of it, or in its place the way to it, or the sentence why it cannot run. */

import { html, noChange } from 'lit';
import { language, speak, words } from '../messages/registry.ts';
import { placeholder } from './placeholder.ts';
import type { Figure } from './figure.ts';

/** Languages that are written from right to left. */
const RIGHT_TO_LEFT = /^(ar|ckb|dv|fa|he|ps|sd|ug|ur|yi)\b/i;

/** The figure's words have a language and a direction of their own: those of the page may be others. */
export function surface(figure: Figure) {
  speak(figure);
  const { gesture, lettering, notice, presenting, progress, stage } = figure;
  const recolour = () => stage.recolour();
  return html`
    <span class="scheme-probe" aria-hidden="true" @transitionend=${recolour} @transitioncancel=${recolour}></span>
    <div class="surface ${presenting.className}" @pointerdown=${(event: PointerEvent) => gesture.press(event)} @input=${stop} @change=${stop} @keydown=${keepUsed}>
      ${lettering.title()}
      <div class="spoken" lang=${language} dir=${RIGHT_TO_LEFT.test(language) ? 'rtl' : 'ltr'}>
        ${contentOf(figure)} ${progress.render()} ${notice.render()} ${presenting.render()}
      </div>
      ${lettering.caption()}
    </div>
  `;
}

/** Former content stays while there is no machine: it is made again after a trap, or the element is not on the page. */
function contentOf(figure: Figure) {
  const { failure } = figure.runtime;
  if (failure !== undefined) return html`<p class="failure" role="alert">${words.failure(failure)}</p>`;
  if (figure.machine) return [figure.content(figure.reading), figure.announcer.render()];
  return figure.reading ? noChange : placeholder(figure);
}

/** Fields take every key. */
const FIELD = 'textarea, input:not([type=range], [type=radio], [type=checkbox])';

/** Sliders and radio buttons take those that move them. */
const MOVES = /Arrow|Page|Home|End/;

/**
 * Stops a key that the figure has used. A book that turns its page by arrow keys would use it again: outside of the shadow root the
 * key comes from the element, not from a field or slider.
 */
function keepUsed(event: KeyboardEvent) {
  const { key, ctrlKey, altKey, metaKey, defaultPrevented } = event;
  const target = event.target as Element;
  const native = target.matches(FIELD) ? key !== 'Escape' : target.matches('input') && MOVES.test(key);
  if (defaultPrevented || (native && !ctrlKey && !altKey && !metaKey)) event.stopPropagation();
}

/** The native controls' own events stay inside: the element has one of its own for each gesture. */
function stop(event: Event) {
  event.stopPropagation();
}
