/** HTML of a figure: its content, its placeholder, or a failure message. Also keyboard focus, and reserved heights of changing texts. */

import { html, noChange, nothing } from 'lit';
import { language, useLanguageOf, words } from '../messages/registry.ts';
import { FigureController } from './controller.ts';
import type { Figure } from './figure.ts';

const RIGHT_TO_LEFT_LANGUAGES = /^(ar|ckb|dv|fa|he|ps|sd|ug|ur|yi)\b/i;

/** Returns the HTML of a figure, whose language and direction may differ from the page's. */
export function figureHtml(figure: Figure) {
  useLanguageOf(figure);
  const { gesture, notice, presentationMode, colours, presentation, headingLevel } = figure;
  const updateColours = () => colours.applyAndDraw();
  return html`
    <span class="scheme-probe" aria-hidden="true" @transitionend=${updateColours} @transitioncancel=${updateColours}></span>
    <div class="surface ${presentationMode.showsControls ? 'with-controls' : ''}" @pointerdown=${(pointerEvent: PointerEvent) => gesture.onPointerDown(pointerEvent)} @input=${stopPropagation} @change=${stopPropagation} @keydown=${(keyEvent: KeyboardEvent) => stopUsedKey(figure, keyEvent)}>
      ${slotHtml(figure, 'title', presentation ? accessibleNameOf(figure) : '', headingLevel)}
      <div class="spoken" lang=${language} dir=${RIGHT_TO_LEFT_LANGUAGES.test(language) ? 'rtl' : 'ltr'}>
        ${contentHtml(figure)} ${notice.render()} ${presentationMode.render()}
      </div>
      ${slotHtml(figure, 'caption')}
    </div>
  `;
}

function contentHtml(figure: Figure) {
  const { failureMessage } = figure.runtime;
  if (failureMessage !== undefined) return html`<p class="failure" role="alert">${words.failureMessage(failureMessage)}</p>`;
  // After a trap the previous content stays.
  if (!figure.simulation) return figure.viewModel ? noChange : placeholderHtml(figure);
  const { announcer, dropHandlers, viewModel } = figure;
  return html`<section
      class="simulation"
      aria-label=${accessibleNameOf(figure)}
      @dragover=${dropHandlers?.onDragOver}
      @dragleave=${dropHandlers?.onDragLeave}
      @drop=${dropHandlers?.onDrop}
    >
      ${figure.renderContent(viewModel)}
    </section>
    ${announcer.render()}`;
}

function placeholderHtml(figure: Figure) {
  const moveFocus = ({ relatedTarget }: FocusEvent) => void moveFocusInto(figure, relatedTarget);
  return html`<div class="reserved" tabindex="0" role="group" aria-label=${accessibleNameOf(figure)} @focus=${moveFocus}></div>`;
}

const slottedChildrenOf = (figure: Figure, slotName: string) => [...figure.children].filter(({ slot: childSlot }) => childSlot === slotName);

/** Returns the name of a figure: the page's title, or the widget's own. */
export function accessibleNameOf(figure: Figure) {
  const title = slottedChildrenOf(figure, 'title').map(({ textContent }) => textContent).join(' ').replace(/\s+/g, ' ').trim();
  return title || (words as any)[figure.definition.messageKey].title;
}

/** Returns a slot for content of the page, with a text shown while the slot is empty. With a heading level, the slot is a heading. */
function slotHtml(figure: Figure, slotName: string, fallbackText = '', headingLevel: string | null = null) {
  return html`<div
    class="${slotName}-slot"
    role=${headingLevel ? 'heading' : nothing}
    aria-level=${headingLevel ?? nothing}
    ?hidden=${!fallbackText && slottedChildrenOf(figure, slotName).length === 0}
  >
    <slot name=${slotName} @slotchange=${() => figure.requestUpdate()}>${fallbackText || nothing}</slot>
  </div>`;
}

/** Selector of text fields, which use every key. */
const TEXT_FIELD_SELECTOR = 'textarea, input:not([type=range], [type=radio], [type=checkbox])';

/** Keys that move sliders and radio buttons. */
const MOVE_KEYS = /Arrow|Page|Home|End/;

/** Keys that press a button, a checkbox or a summary. */
const PRESS_KEYS = /^( |Enter)$/;

/** Stops the propagation of a key event that a control has used, so that the shortcuts of a page, such as a slide deck, do not use the key again. */
function stopUsedKey({ notice }: Figure, keyEvent: KeyboardEvent) {
  notice.stopOnEscape(keyEvent);
  const { key: pressedKey, ctrlKey, altKey, metaKey, defaultPrevented } = keyEvent;
  const keyTarget = keyEvent.target as Element;
  const isPressKey = PRESS_KEYS.test(pressedKey) && keyTarget.matches('button, input, summary');
  const isUsedByControl = keyTarget.matches(TEXT_FIELD_SELECTOR) ? pressedKey !== 'Escape' : isPressKey || (keyTarget.matches('input') && MOVE_KEYS.test(pressedKey));
  if (defaultPrevented || (isUsedByControl && !ctrlKey && !altKey && !metaKey)) keyEvent.stopPropagation();
}

/** Stops the events of native controls, because the element fires its own. */
const stopPropagation = (event: Event) => event.stopPropagation();

const FOCUSABLE_SELECTOR = ':is(button, input, select, textarea):enabled:not([tabindex]), summary, [tabindex="0"]';

function findFocusableElements(searchRoot: ParentNode): HTMLElement[] {
  return ([...searchRoot.querySelectorAll(FOCUSABLE_SELECTOR)] as HTMLElement[]).filter((element) => element.checkVisibility());
}

/** Keyboard focus. It stays in the figure when the focused control is removed, disabled or hidden. */
export class FocusKeeper extends FigureController {
  /** Focused control and its ancestors, the nearest first. */
  #focusPath: Element[] = [];

  hostUpdate() {
    this.#focusPath = [];
    const focusedControl = (this.figure.renderRoot as ShadowRoot | undefined)?.activeElement;
    // If the placeholder has the focus, the placeholder itself moves the focus to a control.
    if (!focusedControl || focusedControl.matches('.reserved')) return;
    for (let element = focusedControl as Element | null; element; element = element.parentElement) this.#focusPath.push(element);
  }

  hostUpdated() {
    const [previousControl, ...focusAncestors] = this.#focusPath;
    if (!previousControl || (previousControl.isConnected && previousControl.checkVisibility() && !previousControl.matches(':disabled'))) return;
    const [nextControl] = focusAncestors.filter(({ isConnected }) => isConnected).flatMap(findFocusableElements);
    nextControl?.focus({ preventScroll: true });
  }
}

/** Moves the focus to the figure's first control, or to its last control if the focus comes from below the figure. */
async function moveFocusInto(figure: Figure, previousFocus: EventTarget | null) {
  await figure.runtime.startCore();
  // Waits for the controls, which are rendered after the first picture.
  while (figure.renderer.isOpening) await new Promise(requestAnimationFrame);
  await figure.updateComplete;
  // After the removal of the focused placeholder, the focus is on the body unless the user has moved it.
  if (!figure.simulation || document.activeElement !== document.body) return;
  const focusableElements = findFocusableElements(figure.renderRoot);
  // If the previous focus was below the figure, Shift+Tab was pressed.
  const isFocusFromBelow = previousFocus instanceof Node && figure.compareDocumentPosition(previousFocus) & Node.DOCUMENT_POSITION_FOLLOWING;
  focusableElements.at(isFocusFromBelow ? -1 : 0)?.focus();
}

const CHANGING_TEXT_SELECTOR = ':is(p, dl, li, .result):not(.result > *, .slider *, details *, .about, .on-paper)';

/**
 * Minimum heights of the texts above the controls, so that a control stays in its place while the user drags it. A text keeps its largest
 * height until the width of the figure or the language changes.
 */
export class TextHeights extends FigureController {
  #textElements: Set<HTMLElement> = new Set();
  #sizeObserver = new ResizeObserver((resizeEntries) => this.#keepHeights(resizeEntries));
  #lastWidth = 0;
  #shownLanguage = '';

  hostUpdated() {
    for (const textElement of this.figure.renderRoot.querySelectorAll<HTMLElement>(CHANGING_TEXT_SELECTOR)) {
      if (!this.#textElements.has(textElement)) this.#sizeObserver.observe(textElement);
      this.#textElements.add(textElement);
    }
  }

  /** Sets the height that a text has reached as its minimum height, so that what is below stays in place. After a change of width or language, all texts are measured again. */
  #keepHeights(resizeEntries: ResizeObserverEntry[]) {
    const { clientWidth } = this.figure;
    if (clientWidth === this.#lastWidth && language === this.#shownLanguage) {
      for (const { target: resizedElement, contentRect } of resizeEntries) (resizedElement as HTMLElement).style.minHeight = `${contentRect.height}px`;
      return;
    }
    [this.#lastWidth, this.#shownLanguage] = [clientWidth, language];
    // Changing a size now would call the observer again in this frame.
    requestAnimationFrame(() => this.measureAgain());
  }

  measureAgain() {
    this.#sizeObserver.disconnect();
    for (const textElement of this.#textElements) textElement.style.minHeight = '';
    this.#textElements.clear();
    this.hostUpdated();
  }
}
