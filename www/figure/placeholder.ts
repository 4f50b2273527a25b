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
  // The controls follow the first picture.
  while (figure.stage.opening) await new Promise(requestAnimationFrame);
  await figure.updateComplete;
  // The removal of the placeholder has dropped the focus.
  if (!figure.machine || document.activeElement !== document.body) return;
  const stops = stopsIn(figure.renderRoot);
  // Backwards from an element below.
  const below = origin instanceof Node && figure.compareDocumentPosition(origin) & Node.DOCUMENT_POSITION_FOLLOWING;
  stops.at(below ? -1 : 0)?.focus();
}
