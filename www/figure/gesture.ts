/** Events for changes by the user: an `input` event for each step and a `change` event at the end, for any number of settings. */

import { FigureController } from './controller.ts';
import type { StateValues } from './settings.ts';

export class UserGesture extends FigureController {
  /** True between an `input` event and the `change` event that follows. */
  #isOpen = false;
  #pressListenerAbort: AbortController | undefined;
  /** View model of the simulation (see FigureElement.viewModel) before the present or latest gesture. */
  previousViewModel: any;

  /** True while a pointer is down on the figure. Pictures with handles keep their scale during this time. */
  get isPressed() {
    return this.#pressListenerAbort !== undefined;
  }

  onPointerDown({ button: pressedButton }: PointerEvent) {
    if (pressedButton !== 0) return;
    this.#endPress();
    this.#pressListenerAbort = new AbortController();
    const { signal: abortSignal } = this.#pressListenerAbort;
    // No `pointerup` arrives if the pointer is released over a list or dialog of the browser. The next `pointermove` then shows that no button is pressed.
    for (const eventType of ['pointerup', 'pointercancel', 'pointermove'] as const) addEventListener(eventType, ({ buttons: pressedButtons }) => pressedButtons === 0 && this.#endPress(), { capture: true, signal: abortSignal });
  }

  #endPress() {
    this.#pressListenerAbort?.abort();
    this.#pressListenerAbort = undefined;
    this.figure.renderer.requestFrame();
  }

  hostDisconnected() {
    this.#endPress();
    if (this.#isOpen) this.commitChange();
  }

  /** Begins a gesture if none is open, and fires `input` for a step of a change that may continue. */
  dispatchInput() {
    if (!this.#isOpen) this.previousViewModel = this.figure.viewModel;
    this.#isOpen = true;
    this.figure.notice.dismissNotice();
    this.#dispatchEventOfType('input');
  }

  /** Ends a change: applies it and announces the outcome. */
  commitChange() {
    const { figure } = this;
    figure.settings.applyPending();
    figure.announcer.requestAnnouncement();
    this.#endGesture();
    if (figure.settings.isViewModelStale) figure.renderer.requestFrame();
    else if (figure.simulation) {
      figure.announceOutcome();
      figure.requestUpdate();
    }
  }

  /** Fires `input` and `change` for a change that was made in one step. */
  commitOneStep() {
    this.dispatchInput();
    this.commitChange();
  }

  /** Changes settings in one step, such as a click, and fires `input` and `change`. */
  requestAndCommit(settingChange: StateValues | ((requestedValues: StateValues) => StateValues)) {
    this.figure.settings.requestChange(settingChange);
    this.commitChange();
  }

  /** Changes a field of the element's state in one step, and fires `change`. Screen readers get no announcement of an outcome. */
  setElementField(fieldName: string, fieldValue: unknown) {
    this.figure.settings.requestChange({ [fieldName]: fieldValue });
    this.#endGesture();
  }

  #endGesture() {
    if (!this.#isOpen) return;
    this.#isOpen = false;
    this.figure.reflection.updateAttributes();
    this.#dispatchEventOfType('change');
    void this.figure.stateLink.writeToAddress();
  }

  #dispatchEventOfType(eventType: string) {
    this.figure.dispatchEvent(new Event(eventType, { bubbles: true, composed: true }));
  }
}
