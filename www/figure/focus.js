/** Keyboard focus: it stays in the figure when the control that has it goes, is disabled or hidden. */

import { Part } from './part.js';

/** Stops of the Tab key. */
const STOPS = ':is(button, input, select, textarea):enabled:not([tabindex]), summary, [tabindex="0"]';

/**
 * Returns the stops of the Tab key that are shown.
 *
 * @param {ParentNode} root
 * @returns {HTMLElement[]}
 */
export function stopsIn(root) {
  return /** @type {HTMLElement[]} */ ([...root.querySelectorAll(STOPS)]).filter((stop) => stop.checkVisibility());
}

export class Focus extends Part {
  /** The control that has the focus and what is around it, the nearest first. @type {Element[]} */
  #held = [];

  hostUpdate() {
    this.#held = [];
    const control = /** @type {ShadowRoot | undefined} */ (this.host.renderRoot)?.activeElement;
    // The placeholder has a way of its own into the figure.
    if (!control || control.matches('.reserved')) return;
    for (let at = /** @type {Element | null} */ (control); at; at = at.parentElement) this.#held.push(at);
  }

  hostUpdated() {
    const [control, ...around] = this.#held;
    if (!control || (control.isConnected && control.checkVisibility() && !control.matches(':disabled'))) return;
    for (const each of around) {
      const [stop] = each.isConnected ? stopsIn(each) : [];
      if (!stop) continue;
      stop.focus({ preventScroll: true });
      return;
    }
  }
}
