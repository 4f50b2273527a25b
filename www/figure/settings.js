/**
 * What of the machine's settings is wanted and what is in effect: what the reader does takes effect with
 * the next frame, what the page does at once.
 */

import { Part } from './part.js';

/** @typedef {Record<string, any>} Values settings by name */

/** Longest work in a frame, milliseconds: with the pictures, a touch is answered within 50. */
export const LONGEST_WORK = 25;

/** Samples between two looks at the clock: a millisecond's work, ten on a slow phone. */
const SLICE = 50_000;

export class Settings extends Part {
  /** Whether what is shown is no longer what the machine would say. */
  stale = true;
  /** The reader's changes that wait for the next frame. @type {Values} */
  #pending = {};
  /** Whether the machine is in the middle of what it has begun. */
  #working = false;
  #showing = false;

  /** Another machine is there: nothing waits for it. */
  reset() {
    this.stale = true;
    this.#working = false;
    this.#pending = {};
  }

  /** Those of some values that are declared settings of the machine. @param {Values} values */
  declared(values) {
    const keys = this.host.kind.declared.filter((setting) => !setting.in && !setting.of).map(({ key }) => key);
    return Object.fromEntries(keys.map((key) => [key, values[key]]));
  }

  /** Those in effect: a machine's copy of them takes long, and is not asked for where nothing has changed since the last. @returns {Values} */
  get present() {
    const { machine, reading } = this.host;
    return this.stale ? machine?.config : reading.config;
  }

  /** Those in effect with the changes that wait. @returns {Values} */
  get wanted() {
    return { ...this.present, ...this.#pending };
  }

  /**
   * The reader wants others, from the next frame on: a drag costs one configuration a frame.
   *
   * @param {Values | ((wanted: Values) => Values)} change
   */
  want(change) {
    this.host.runtime.attempt(() => {
      if (!this.host.machine) return;
      this.host.typing.forget();
      Object.assign(this.#pending, typeof change === 'function' ? change(this.wanted) : change);
      this.host.gesture.step();
      this.host.stage.wake();
    });
  }

  /**
   * The page wants others, at once.
   *
   * @param {Values} values
   * @throws {TypeError | RangeError} and nothing is changed
   */
  assign(values) {
    this.host.runtime.attempt(() => {
      this.settle();
      this.host.machine?.configure(values);
      this.stale = true;
      this.host.reflection.tell();
      this.show();
    });
  }

  /**
   * Puts what is wanted into effect. A change that is refused is reported and forgotten.
   *
   * @param {number} [limit] milliseconds that it may take
   * @returns {boolean} whether all is in effect
   */
  settle(limit = Infinity) {
    if (limit === Infinity) this.#proceed(limit);
    if (!this.#working && Object.keys(this.#pending).length > 0) {
      const pending = this.#pending;
      this.#pending = {};
      this.host.runtime.tolerate(() => this.#begin(pending));
    }
    return this.#proceed(limit);
  }

  /** @param {Values} values */
  #begin(values) {
    const { machine } = this.host;
    if (!machine) return;
    if (machine.begin) {
      machine.begin(values);
      this.work();
    } else {
      machine.configure(values);
    }
    this.stale = true;
  }

  /** To be called when the machine has begun something that `settle` is to go on with. */
  work() {
    this.#working = true;
  }

  /**
   * @param {number} limit milliseconds
   * @returns {boolean} whether nothing is left to do
   */
  #proceed(limit) {
    if (!this.#working) return true;
    const end = performance.now() + limit;
    while (this.host.machine?.advance?.(SLICE) === false) {
      if (performance.now() > end) return false;
    }
    this.#working = false;
    this.stale = true;
    return true;
  }

  /** Shows what the page changed, also to one who listens while the element is out of sight. */
  show() {
    const { stage, runtime } = this.host;
    stage.wake();
    if (stage.inSight || this.#showing) return;
    this.#showing = true;
    queueMicrotask(() => {
      this.#showing = false;
      if (this.stale && !stage.inSight) runtime.attemptOrFail(() => this.host.refresh());
    });
  }
}
