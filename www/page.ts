/**
 * Script of the page around the figures: buttons that set the state of a figure, terms that highlight a line in its picture,
 * and predictions.
 *
 * @module
 */

import { prepareBet, prepareShapeBet } from './page/bet.ts';

/** Any of the elements. */
export type Figure = HTMLElement & Record<string, any>;

/** Whole state that each figure opened with. */
const openingStates: WeakMap<Element, Record<string, any>> = new WeakMap();

/** Returns the figure that an element of the page is about. */
export const figureOf = (element: Element): Figure => element.closest('article')?.querySelector('.stand > :first-child') as Figure;

/**
 * Returns a figure to the state that it opened with, and then sets values in their order. Each is a property of the element, or else a field
 * of its state. A preset has to be the first value, because it replaces the others.
 */
export async function enterState(figure: Figure, values: Record<string, unknown>) {
  if (!openingStates.has(figure)) await new Promise((resolve) => figure.addEventListener('load', resolve, { once: true }));
  const openingState = openingStates.get(figure) ?? {};
  // The text with the pressed button refers to the whole cloud, so that it is shown without growing.
  const completeCloudFields = 'shown' in openingState ? { shown: openingState.samples, playing: false } : {};
  const { widget, version } = openingState;
  figure.setState({ ...openingState, ...completeCloudFields });
  for (const [key, value] of Object.entries(values)) {
    if (key in figure) figure[key] = value;
    else figure.setState({ widget, version, [key]: value });
  }
}

async function enterTriedState(button: HTMLElement) {
  const figure = figureOf(button);
  for (const triedButton of button.closest('article')?.querySelectorAll('[data-try]') ?? []) triedButton.removeAttribute('aria-current');
  await enterState(figure, JSON.parse(button.dataset.try ?? '{}'));
  button.setAttribute('aria-current', 'true');
  figure.addEventListener('input', () => button.removeAttribute('aria-current'), { once: true });
}

/** Highlights the line that a term names while the pointer or the focus is on the term. */
function highlightTerm({ type, target }: Event) {
  const term = target instanceof Element ? (target.closest('[data-line]') as HTMLElement | null) : null;
  if (!term) return;
  figureOf(term).highlight = /over|in$/.test(type) ? term.dataset.line : null;
}

/** Keeps each figure's picture in sight while the reader scrolls through the list of things to try, if the list is below the figure. */
function keepPicturesInSight() {
  const observer = new ResizeObserver((entries) => {
    for (const { target, borderBoxSize: [{ blockSize }] } of entries) {
      (target.parentElement as HTMLElement).style.setProperty('--below', `${blockSize}px`);
    }
  });
  for (const tryList of document.querySelectorAll('.try')) observer.observe(tryList);
}

document.addEventListener('load', ({ target }) => {
  const figure = target as Figure;
  if (figure.getState && !openingStates.has(figure)) openingStates.set(figure, figure.getState());
}, { capture: true });
document.addEventListener('click', ({ target }) => {
  const button = target instanceof Element ? target.closest('button[data-try]') : null;
  if (button) void enterTriedState(button as HTMLElement);
});
for (const type of ['pointerover', 'pointerout', 'focusin', 'focusout']) document.addEventListener(type, highlightTerm);
for (const form of document.querySelectorAll('form')) (form.matches('.shape-bet') ? prepareShapeBet : prepareBet)(form, (values) => enterState(figureOf(form), values), figureOf(form));
keepPicturesInSight();
