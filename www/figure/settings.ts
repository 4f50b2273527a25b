/** Settings of the machine: those in effect, and the reader's changes that wait for the next frame. */

import { Part } from './part.ts';

/** Settings by name. */
export type Values = Record<string, any>;

export class Settings extends Part {
  /** True if the machine has changed since it was read. */
  stale: boolean | undefined;
  /** Settings in effect, as the machine gave them; undefined for a machine that was not asked yet. */
  #present: Values | undefined;
  /** Changes of the reader that wait for the next frame. */
  #pending: Values = {};
  #isShowing = false;

  /** Forgets the changes that wait, for another machine. */
  reset() {
    this.stale = true;
    this.#present = undefined;
    this.#pending = {};
  }

  /** Values of the machine's declared settings among others. */
  declared(values: Values) {
    const keys = this.host.kind.declared.filter((setting) => !setting.in && !setting.of).map(({ key }) => key);
    return Object.fromEntries(keys.map((key) => [key, values[key]]));
  }

  /** Settings in effect. */
  get present(): Values {
    const { machine, reading } = this.host;
    if (machine) this.#present ??= machine.config as Values;
    return this.#present ?? reading.config;
  }

  /** Settings in effect with the changes that wait. */
  get wanted(): Values {
    return { ...this.present, ...this.#pending };
  }

  /** True if changes are not in effect or not read yet. */
  get isWaiting() {
    return this.stale || Object.keys(this.#pending).length > 0;
  }

  /** Changes settings with the next frame, for the reader: a drag costs one configuration a frame. */
  want(change: Values | ((wanted: Values) => Values)) {
    this.host.runtime.attempt(() => {
      if (!this.host.machine) return;
      this.host.typing.forget();
      const values = () => (typeof change === 'function' ? change(this.wanted) : change);
      const given = values();
      const both = (key: string, other: string) => key in given && other in this.#pending;
      // A setting and the group that it is a part of are two changes, one after the other.
      if (this.host.kind.declared.some(({ key, of }) => of && (both(key, of) || both(of, key)))) this.settle();
      Object.assign(this.#pending, values());
      this.host.gesture.step();
      this.host.stage.requestFrame();
    });
  }

  /**
   * Changes settings at once, for the page.
   *
   * @throws {TypeError | RangeError} and nothing is changed
   */
  assign(values: Values) {
    this.host.runtime.attempt(() => {
      this.settle();
      this.#configure(values);
      this.host.reflection.updateAttributes();
      this.host.stage.release();
      this.show();
    });
  }

  /** Puts the changes that wait into effect. A change that is refused is reported and forgotten. */
  settle() {
    const pending = this.#pending;
    if (Object.keys(pending).length === 0) return;
    this.#pending = {};
    this.host.runtime.attemptOrReport(() => this.#configure(pending));
  }

  #configure(values: Values) {
    const { machine, cloud } = this.host;
    if (!machine) return;
    this.#present = Object.freeze(cloud ? cloud.configure(values) : machine.configure(values));
    this.stale = true;
  }

  /** Shows a change of the page, also to a listener while the element is out of sight. */
  show() {
    this.host.stage.requestFrame();
    if (this.#isShowing) return;
    this.#isShowing = true;
    queueMicrotask(this.#showUnseen);
  }

  #showUnseen = () => {
    const { stage, runtime } = this.host;
    this.#isShowing = false;
    if (stage.inSight) return;
    runtime.attemptOrFail(() => {
      const { machine, cloud } = this.host;
      if (!machine) return;
      this.settle();
      // Nobody sees it grow.
      if (this.host.isAwaited) cloud?.finish();
      if (cloud && !cloud.refine()) {
        this.#isShowing = true;
        setTimeout(this.#showUnseen);
      } else if (this.stale) this.host.refresh();
      this.host.resolveSettled();
    });
  };
}
