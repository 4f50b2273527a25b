/** HTML of a figure: its content, or its placeholder, or the message of a failure. */

import { html, noChange, nothing } from 'lit';
import { language, useLanguageOf, words } from '../messages/registry.ts';
import { moveFocusInto } from './focus.ts';
import type { Figure } from './figure.ts';

const RIGHT_TO_LEFT = /^(ar|ckb|dv|fa|he|ps|sd|ug|ur|yi)\b/i;

/** Returns the HTML of a figure, whose language and direction may differ from the page's. */
export function figureHtml(figure: Figure) {
  useLanguageOf(figure);
  const { gesture, notice, presenting, colours, presentation, headingLevel } = figure;
  const updateColours = () => colours.update();
  return html`
    <span class="scheme-probe" aria-hidden="true" @transitionend=${updateColours} @transitioncancel=${updateColours}></span>
    <div class="surface ${presenting.hasControls ? 'with-controls' : ''}" @pointerdown=${(event: PointerEvent) => gesture.press(event)} @input=${stopPropagation} @change=${stopPropagation} @keydown=${stopUsedKey}>
      ${slotHtml(figure, 'title', presentation ? nameOf(figure) : '', headingLevel)}
      <div class="spoken" lang=${language} dir=${RIGHT_TO_LEFT.test(language) ? 'rtl' : 'ltr'}>
        ${contentHtml(figure)} ${notice.render()} ${presenting.render()}
      </div>
      ${slotHtml(figure, 'caption')}
    </div>
  `;
}

function contentHtml(figure: Figure) {
  const { failure } = figure.runtime;
  if (failure !== undefined) return html`<p class="failure" role="alert">${words.failure(failure)}</p>`;
  // After a trap the previous content stays.
  if (!figure.simulation) return figure.viewModel ? noChange : placeholderHtml(figure);
  const { announcer, dropHandlers, viewModel } = figure;
  return html`<section
      class="simulation"
      aria-label=${nameOf(figure)}
      @dragover=${dropHandlers?.onDragOver}
      @dragleave=${dropHandlers?.onDragLeave}
      @drop=${dropHandlers?.onDrop}
    >
      ${figure.content(viewModel)}
    </section>
    ${announcer.render()}`;
}

function placeholderHtml(figure: Figure) {
  const moveFocus = ({ relatedTarget }: FocusEvent) => void moveFocusInto(figure, relatedTarget);
  return html`<div class="reserved" tabindex="0" role="group" aria-label=${nameOf(figure)} @focus=${moveFocus}></div>`;
}

const slottedChildren = (figure: Figure, name: string) => [...figure.children].filter(({ slot }) => slot === name);

/** Returns the name of a figure: the page's title, or the widget's own. */
export function nameOf(figure: Figure) {
  const title = slottedChildren(figure, 'title').map(({ textContent }) => textContent).join(' ').replace(/\s+/g, ' ').trim();
  return title || (words as any)[figure.definition.messageKey].title;
}

/** Returns a slot for content of the page, with a text that is shown if the slot is empty. It is a heading if it has a level. */
function slotHtml(figure: Figure, name: string, fallback = '', level: string | null = null) {
  return html`<div
    class="${name}-slot"
    role=${level ? 'heading' : nothing}
    aria-level=${level ?? nothing}
    ?hidden=${!fallback && slottedChildren(figure, name).length === 0}
  >
    <slot name=${name} @slotchange=${() => figure.requestUpdate()}>${fallback || nothing}</slot>
  </div>`;
}

/** Controls that use every key. */
const TEXT_FIELDS = 'textarea, input:not([type=range], [type=radio], [type=checkbox])';

/** Keys that move sliders and radio buttons. */
const MOVE_KEYS = /Arrow|Page|Home|End/;

/** Keys that press a button, a checkbox or a summary. */
const PRESS_KEYS = /^( |Enter)$/;

/** Stops a key that a control has used. A page with key shortcuts, such as a slide deck, does not see the control in the shadow root. */
function stopUsedKey(event: KeyboardEvent) {
  const { key, ctrlKey, altKey, metaKey, defaultPrevented } = event;
  const keyTarget = event.target as Element;
  const isPress = PRESS_KEYS.test(key) && keyTarget.matches('button, input, summary');
  const isUsedByControl = keyTarget.matches(TEXT_FIELDS) ? key !== 'Escape' : isPress || (keyTarget.matches('input') && MOVE_KEYS.test(key));
  if (defaultPrevented || (isUsedByControl && !ctrlKey && !altKey && !metaKey)) event.stopPropagation();
}

/** Stops the events of native controls, because the element fires its own. */
const stopPropagation = (event: Event) => event.stopPropagation();
