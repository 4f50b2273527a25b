/** Events for changes by the user: an `input` event for each step and a `change` event at the end, for any number of settings. */

import { FigureController } from './controller.ts';
import type { StateValues } from './settings.ts';

export class Gesture extends FigureController {
  /** True between an `input` event and the `change` event that follows. */
  #isOpen = false;
  #pressListenerAbort: AbortController | undefined;
  /** View model of the simulation (see FigureElement.viewModel) before the present or latest gesture. */
  previousViewModel: any;

  /** True while a pointer is down on the figure. Pictures with handles keep their scale during this time. */
  get isPressed() {
    return this.#pressListenerAbort !== undefined;
  }

  onPointerDown({ button }: PointerEvent) {
    if (button !== 0) return;
    this.#endPress();
    this.#pressListenerAbort = new AbortController();
    const { signal } = this.#pressListenerAbort;
    // No `pointerup` arrives if the pointer is released over a list or dialog of the browser. The next event is then a `pointermove`.
    for (const eventType of ['pointerup', 'pointercancel', 'pointermove'] as const) addEventListener(eventType, ({ buttons }) => buttons === 0 && this.#endPress(), { capture: true, signal });
  }

  #endPress() {
    this.#pressListenerAbort?.abort();
    this.#pressListenerAbort = undefined;
    this.host.renderer.requestFrame();
  }

  hostDisconnected() {
    this.#endPress();
    if (this.#isOpen) this.commitChange();
  }

  /** Begins a gesture if none is open, and fires `input` for a step of a change that may continue. */
  dispatchInput() {
    if (!this.#isOpen) this.previousViewModel = this.host.viewModel;
    this.#isOpen = true;
    this.host.notice.dismissNotice();
    this.#dispatchEventOfType('input');
  }

  /** Ends a change: applies it and announces the outcome. */
  commitChange() {
    const { host } = this;
    host.settings.applyPending();
    host.announcer.requestAnnouncement();
    this.#endGesture();
    if (host.settings.isViewModelStale) host.renderer.requestFrame();
    else if (host.simulation) {
      host.announceOutcome();
      host.requestUpdate();
    }
  }

  /** Fires `input` and `change` for a change that was made in one step. */
  commitOneStep() {
    this.dispatchInput();
    this.commitChange();
  }

  /** Changes settings in one step, such as a click, and fires `input` and `change`. */
  requestAndCommit(change: StateValues | ((requested: StateValues) => StateValues)) {
    this.host.settings.requestChange(change);
    this.commitChange();
  }

  /** Changes a field of the element's state in one step, and fires `change`. Screen readers get no announcement of an outcome. */
  setElementField(name: string, value: unknown) {
    this.host.settings.requestChange({ [name]: value });
    this.#endGesture();
  }

  #endGesture() {
    if (!this.#isOpen) return;
    this.#isOpen = false;
    this.host.reflection.updateAttributes();
    this.#dispatchEventOfType('change');
    void this.host.stateLink.writeToAddress();
  }

  #dispatchEventOfType(eventType: string) {
    this.host.dispatchEvent(new Event(eventType, { bubbles: true, composed: true }));
  }
}
