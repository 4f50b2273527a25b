/**
 * What the reader does, as a page hears of it: `input` for each step and `change` where it ends, once
 * each, however many settings a step changed.
 */

import { Part } from './part.js';

export class Gesture extends Part {
  #step = false;
  #end = false;
  #queued = false;
  /** Whether a step was told without its end. */
  #open = false;

  /** What leaves the page is let go of. */
  hostDisconnected() {
    if (this.#open) this.host.commit();
  }

  /** Something has changed, and it may go on. */
  step() {
    this.#step = true;
    this.#end = false;
    this.#queue();
  }

  /** What has changed has come to rest. */
  end() {
    this.#end = true;
    this.#queue();
  }

  /** After the handler that is running: it may take several steps in one. */
  #queue() {
    if (this.#queued) return;
    this.#queued = true;
    queueMicrotask(() => {
      const [step, end] = [this.#step, this.#end];
      this.#queued = this.#step = this.#end = false;
      this.#open ||= step;
      if (step) this.#tell('input');
      if (!end || !this.#open) return;
      this.#open = false;
      this.host.reflection.tell();
      this.#tell('change');
      if (this.host.share) this.host.link.write();
    });
  }

  /** @param {string} name of the event */
  #tell(name) {
    this.host.dispatchEvent(new Event(name, { bubbles: true, composed: true }));
  }
}
