/**
 * What the reader does, and what a page hears of it: `input` for each step and `change` where it ends, once each,
 * however many settings a step changed.
 */

import { Part } from './part.ts';
import type { Values } from './settings.ts';

export class Gesture extends Part {
  #step = false;
  #end: boolean | undefined;
  /** Whether a step was told without its end. */
  #isOpen = false;
  /** Ends listening for the end of a press. */
  #press: AbortController | undefined;
  /** Reading before the present gesture, or the last. */
  former: any;

  /** True while a pointer is down on the figure: the views keep still under it. */
  get pressed() {
    return this.#press !== undefined;
  }

  /** A pointer comes down on the figure. */
  press({ button }: PointerEvent) {
    if (button !== 0) return;
    this.#release();
    this.#press = new AbortController();
    const { signal } = this.#press;
    for (const end of ['pointerup', 'pointercancel']) addEventListener(end, () => this.#release(), { capture: true, signal });
    // A list or a dialog of the browser may have taken the end.
    addEventListener('pointermove', ({ buttons }) => buttons === 0 && this.#release(), { capture: true, signal });
  }

  #release() {
    this.#press?.abort();
    this.#press = undefined;
    this.host.stage.requestFrame();
  }

  /** What leaves the page is let go of. */
  hostDisconnected() {
    this.#release();
    if (this.#isOpen || this.#step) this.commit();
  }

  /** Something has changed, and it may go on. */
  step() {
    if (!this.#isOpen && !this.#step) this.former = this.host.reading;
    this.#step = true;
    this.#end = false;
    this.#queue();
  }

  /** What the reader changed has come to rest: put it into effect and say what it led to. */
  commit() {
    const { host } = this;
    host.runtime.attempt(() => host.settings.settle());
    host.announcer.announceNext();
    this.#finish();
    if (host.settings.stale) host.stage.requestFrame();
    else if (host.machine) {
      host.finishChange();
      host.requestUpdate();
    }
  }

  /** The reader has decided on other settings. */
  decide(change: Values | ((wanted: Values) => Values)) {
    this.host.settings.want(change);
    this.commit();
  }

  /** The reader chooses something of the element's own. */
  choose(name: string, value: unknown) {
    this.host.state.own[name] = value;
    this.step();
    this.#finish();
    this.host.stage.requestFrame();
  }

  #finish() {
    this.#end = true;
    this.#queue();
  }

  /** After the handler that is running: it may take several steps, which are told once. */
  #queue() {
    queueMicrotask(() => {
      const [step, end] = [this.#step, this.#end];
      this.#step = this.#end = false;
      this.#isOpen ||= step;
      if (step) this.#dispatch('input');
      if (!end || !this.#isOpen) return;
      this.#isOpen = false;
      this.host.reflection.updateAttributes();
      this.#dispatch('change');
      this.host.link.write();
    });
  }

  /** @param name of the event */
  #dispatch(name: string) {
    this.host.dispatchEvent(new Event(name, { bubbles: true, composed: true }));
  }
}
