/** Events for changes by the user: an `input` event for each step and a `change` event at the end, for any number of settings. */

import { FigureController } from './controller.ts';
import type { Values } from './settings.ts';

export class Gesture extends FigureController {
  /** True between an `input` event and its `change`. */
  #isOpen = false;
  #pressListeners: AbortController | undefined;
  /** View model of the simulation (see FigureElement.viewModel) before the present or latest gesture. */
  previousViewModel: any;

  /** True while a pointer is down on the figure. Pictures with handles keep their scale meanwhile. */
  get isPressed() {
    return this.#pressListeners !== undefined;
  }

  press({ button }: PointerEvent) {
    if (button !== 0) return;
    this.#endPress();
    this.#pressListeners = new AbortController();
    const { signal } = this.#pressListeners;
    // If the pointer is released over a list or dialog of the browser, the next event is a `pointermove`.
    for (const type of ['pointerup', 'pointercancel', 'pointermove'] as const) addEventListener(type, ({ buttons }) => buttons === 0 && this.#endPress(), { capture: true, signal });
  }

  #endPress() {
    this.#pressListeners?.abort();
    this.#pressListeners = undefined;
    this.host.renderer.requestFrame();
  }

  hostDisconnected() {
    this.#endPress();
    if (this.#isOpen) this.commit();
  }

  /** Records a step of a change that may continue. */
  step() {
    if (!this.#isOpen) this.previousViewModel = this.host.viewModel;
    this.#isOpen = true;
    this.host.notice.dismiss();
    this.#dispatch('input');
  }

  /** Ends a change: applies it and announces the outcome. */
  commit() {
    const { host } = this;
    host.settings.applyPending();
    host.announcer.announceNext();
    this.#endGesture();
    if (host.settings.isStale) host.renderer.requestFrame();
    else if (host.simulation) {
      host.announceOutcome();
      host.requestUpdate();
    }
  }

  /** Records a change that was made in one step. */
  complete() {
    this.step();
    this.commit();
  }

  /** Changes settings as a complete gesture, such as a click. */
  decide(change: Values | ((requested: Values) => Values)) {
    this.host.settings.request(change);
    this.commit();
  }

  /** Changes a field of the element's state as a complete gesture. No outcome is announced. */
  choose(name: string, value: unknown) {
    this.host.settings.request({ [name]: value });
    this.#endGesture();
  }

  #endGesture() {
    if (!this.#isOpen) return;
    this.#isOpen = false;
    this.host.reflection.updateAttributes();
    this.#dispatch('change');
    void this.host.link.write();
  }

  #dispatch(name: string) {
    this.host.dispatchEvent(new Event(name, { bubbles: true, composed: true }));
  }
}
