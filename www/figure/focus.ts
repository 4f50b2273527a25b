/** Keyboard focus. It moves from the placeholder into the figure, and stays there when the focused control is removed, disabled or hidden. */

import { FigureController } from './controller.ts';
import type { Figure } from './figure.ts';

const FOCUSABLE = ':is(button, input, select, textarea):enabled:not([tabindex]), summary, [tabindex="0"]';

function focusableIn(root: ParentNode): HTMLElement[] {
  return ([...root.querySelectorAll(FOCUSABLE)] as HTMLElement[]).filter((element) => element.checkVisibility());
}

export class Focus extends FigureController {
  /** Focused control and its ancestors, the nearest first. */
  #focusPath: Element[] = [];

  hostUpdate() {
    this.#focusPath = [];
    const focusedControl = (this.host.renderRoot as ShadowRoot | undefined)?.activeElement;
    // The placeholder moves the focus itself.
    if (!focusedControl || focusedControl.matches('.reserved')) return;
    for (let element = focusedControl as Element | null; element; element = element.parentElement) this.#focusPath.push(element);
  }

  hostUpdated() {
    const [previousControl, ...ancestors] = this.#focusPath;
    if (!previousControl || (previousControl.isConnected && previousControl.checkVisibility() && !previousControl.matches(':disabled'))) return;
    for (const ancestor of ancestors) {
      const [nextControl] = ancestor.isConnected ? focusableIn(ancestor) : [];
      if (!nextControl) continue;
      nextControl.focus({ preventScroll: true });
      return;
    }
  }
}

/** Moves the focus into the figure, to the end that is nearer to `origin`. */
export async function moveFocusInto(figure: Figure, origin: EventTarget | null) {
  await figure.runtime.start();
  // Waits for the controls, which are rendered after the first picture.
  while (figure.renderer.isOpening) await new Promise(requestAnimationFrame);
  await figure.updateComplete;
  // After the removal of the focused placeholder, the focus is on the body unless the user has moved it.
  if (!figure.simulation || document.activeElement !== document.body) return;
  const focusableElements = focusableIn(figure.renderRoot);
  // With Shift+Tab the focus comes from an element below the figure.
  const comesFromBelow = origin instanceof Node && figure.compareDocumentPosition(origin) & Node.DOCUMENT_POSITION_FOLLOWING;
  focusableElements.at(comesFromBelow ? -1 : 0)?.focus();
}
