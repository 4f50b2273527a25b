/** Placeholder of a figure that has not started; keyboard focus moves from it into the figure. */

import { html } from 'lit';
import { stopsIn } from './focus.ts';
import type { Figure } from './figure.ts';

export function placeholder(figure: Figure) {
  const enter = ({ relatedTarget }: FocusEvent) => void moveFocusInto(figure, relatedTarget);
  return html`<div class="reserved" tabindex="0" role="group" aria-label=${figure.lettering.name} @focus=${enter}></div>`;
}

/** Moves the focus into the figure, to the end that is nearer to `origin`. */
async function moveFocusInto(figure: Figure, origin: EventTarget | null) {
  await figure.runtime.start();
  // Waits for the controls, which are rendered after the first picture.
  while (figure.stage.opening) await new Promise(requestAnimationFrame);
  await figure.updateComplete;
  // The focus was on the placeholder, and is on the body after its removal. The reader may have moved it.
  if (!figure.machine || document.activeElement !== document.body) return;
  const stops = stopsIn(figure.renderRoot);
  // With Shift+Tab the focus comes from an element below the figure.
  const below = origin instanceof Node && figure.compareDocumentPosition(origin) & Node.DOCUMENT_POSITION_FOLLOWING;
  stops.at(below ? -1 : 0)?.focus();
}
