/** Keyboard focus. It stays in the figure when the focused control is removed, disabled or hidden. */

import { Part } from './part.ts';

/** Elements that the Tab key stops at. */
const STOPS = ':is(button, input, select, textarea):enabled:not([tabindex]), summary, [tabindex="0"]';

/** Returns the visible elements that the Tab key stops at. */
export function stopsIn(root: ParentNode): HTMLElement[] {
  return ([...root.querySelectorAll(STOPS)] as HTMLElement[]).filter((stop) => stop.checkVisibility());
}

export class Focus extends Part {
  /** Focused control and its ancestors, the nearest first. */
  #held: Element[] = [];

  hostUpdate() {
    this.#held = [];
    const control = (this.host.renderRoot as ShadowRoot | undefined)?.activeElement;
    // The placeholder moves the focus itself.
    if (!control || control.matches('.reserved')) return;
    for (let at = control as Element | null; at; at = at.parentElement) this.#held.push(at);
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
