/**
 * A core of the figure's own: made when the figure comes near the reader, freed when it goes, abandoned
 * at a trap and made again from the last good state.
 */

import { abandon, instantiateFor } from '../core.ts';
import { checkNow, unwatch, watch } from './page/sight.ts';
import { Part } from './part.ts';
import { isTrap } from './trap.ts';

export class Runtime extends Part {
  /** The core, once it runs. */
  motion: import('../types.d.ts').Motion | undefined;
  /** The simulation, which owns all of its state. */
  machine: any;
  /** The reason why it cannot run. */
  failure: string | undefined;
  /** Whether the page was told that it is ready: not once more after a trap. */
  #loaded = false;
  #near: boolean | undefined;
  #starting: Promise<void> | undefined;
  /** True if a core has trapped and no picture was drawn since. */
  #hasTrapped = false;

  hostConnected() {
    watch(this.host, {
      onNear: () => void this.start(),
      onVisible: (inSight) => this.host.stage.setVisible(inSight),
    });
    this.#checkVisibility();
  }

  /** The room for the figure is there, so that it has its place on the page. */
  async #checkVisibility() {
    await this.host.updateComplete;
    checkNow(this.host);
  }

  /** The reader is near, or there: starts what has not started. */
  async start() {
    this.#near = true;
    await this.#startIfNear();
  }

  hostDisconnected() {
    // An element that is being moved is back in the document by the time the microtasks run.
    queueMicrotask(() => {
      if (this.host.isConnected) return;
      unwatch(this.host);
      this.#near = false;
      this.host.stage.setVisible(false);
      this.#stop();
    });
  }

  /** @param machine that takes the place of the present one */
  replace(machine: any) {
    this.machine.free();
    this.machine = machine;
  }

  /**
   * Does what may trap: a trap is mended, anything else is thrown on.
   *
   * @returns undefined where it trapped
   */
  attempt<Result>(work: () => Result): Result | undefined {
    try {
      return work();
    } catch (error) {
      if (!this.#recover(error)) throw error;
    }
  }

  /** As `attempt`, where nobody would hear of an error: it ends in the sentence. */
  attemptOrFail: Runtime['attempt'] = (work) => {
    try {
      return this.attempt(work);
    } catch (error) {
      this.fail(error);
    }
  };

  /** @param work what may refuse: an error is reported, and all is as it was */
  attemptOrReport(work: () => void) {
    try {
      this.attempt(work);
    } catch (error) {
      if (isTrap(error)) throw error;
      this.report(error);
    }
  }

  /** A picture was drawn, so that the present core is taken for a sound one. */
  confirmHealthy() {
    this.#hasTrapped = false;
  }

  /** Tells the page of what went wrong; the console too, where no listener takes care of it. */
  report(error: unknown) {
    const message = messageOf(error);
    const unattended = this.host.dispatchEvent(new ErrorEvent('error', { error, message, cancelable: true }));
    if (unattended) console.warn(message, this.host);
  }

  /** Shows a sentence in the figure's place and tells the page. */
  fail(error: unknown) {
    if (isTrap(error)) this.#abandon();
    this.#stop();
    this.failure = messageOf(error);
    this.report(error);
  }

  /**
   * After a trap, takes a new core and the last good state: the old core's memory may be damaged, and
   * nothing of it is used again. What is shown stays until then. A second trap before a picture is not mended.
   *
   * @returns whether it was one that this mends
   */
  #recover(error: unknown): boolean {
    if (!isTrap(error) || this.#hasTrapped) return false;
    this.#hasTrapped = true;
    this.#abandon();
    this.report(error);
    this.#startIfNear();
    return true;
  }

  #abandon() {
    if (this.machine) abandon(this.machine);
    this.host.settings.reset();
    this.machine = this.motion = undefined;
  }

  /** @returns that ends when it has started, or cannot */
  #startIfNear(): Promise<void> {
    if (!this.machine && this.#near) this.#starting ??= this.#make();
    return this.#starting ?? Promise.resolve();
  }

  async #make() {
    try {
      const [motion] = await Promise.all([instantiateFor(this.host.localName), this.host.link.prepare()]);
      if (!this.#near) return;
      const machine = this.host.createMachine(motion, this.host.state.kept);
      Object.assign(this, { motion, machine, failure: undefined });
      this.host.state.resume();
      await this.#show();
    } catch (error) {
      this.fail(error);
    } finally {
      this.#starting = undefined;
    }
    // It went and came back meanwhile, or trapped again.
    if (this.failure === undefined) this.#startIfNear();
  }

  async #show() {
    this.host.requestUpdate();
    await this.host.updateComplete;
    // It may have trapped or failed, also while it was rendered, and the element may have gone.
    if (!this.machine) return;
    this.host.stage.requestFrame();
    if (this.#loaded) return;
    this.#loaded = true;
    this.host.dispatchEvent(new Event('load', { bubbles: true, composed: true }));
  }

  #stop() {
    this.#loaded = false;
    this.#hasTrapped = false;
    this.host.stage.clear();
    this.attempt(() => {
      this.host.settings.settle();
      this.host.state.keep();
    });
    this.machine?.free();
    this.machine = this.motion = undefined;
    this.host.requestUpdate();
  }
}

/** Does something with a machine that is not in its place yet: it is freed where that is refused. */
export function freeOnError<Machine extends { free(): void }>(machine: Machine, work: (machine: Machine) => void) {
  try {
    work(machine);
    return machine;
  } catch (error) {
    machine.free();
    throw error;
  }
}

/** Remedy where Trusted Types refuse the figure's templates. */
const NO_POLICY = "This page's Content-Security-Policy forbids the figure's templates: its trusted-types directive lacks motion-widgets.";

function messageOf(error: unknown) {
  const message = error instanceof Error ? error.message : String(error);
  return message.includes('TrustedHTML') ? NO_POLICY : message;
}
