/** In the place of a figure that is not there yet: who comes to it from the keyboard comes into the figure. */

import { html } from 'lit';
import { stopsIn } from './focus.ts';
import type { Figure } from './figure.ts';

export function placeholder(figure: Figure) {
  const enter = ({ relatedTarget }: FocusEvent) => void moveFocusInto(figure, relatedTarget);
  return html`<div class="reserved" tabindex="0" role="group" aria-label=${figure.lettering.name} @focus=${enter}></div>`;
}

/** @param origin what had the focus before */
async function moveFocusInto(figure: Figure, origin: EventTarget | null) {
  await figure.runtime.start();
  // What there is to stop at follows the first picture.
  while (figure.stage.opening) await new Promise(requestAnimationFrame);
  await figure.updateComplete;
  // With what was in its place, the focus has gone to nothing.
  if (!figure.machine || document.activeElement !== document.body) return;
  const stops = stopsIn(figure.renderRoot);
  // Backwards, if the reader came from what is below.
  const below = origin instanceof Node && figure.compareDocumentPosition(origin) & Node.DOCUMENT_POSITION_FOLLOWING;
  stops.at(below ? -1 : 0)?.focus();
}
