/** Core of a figure. It is freed when the element is removed. After a trap, a new core gets the last valid state. */

import { abandonSimulation, instantiateFor, precompile } from '../core.ts';
import { FigureController } from './controller.ts';

export class Runtime extends FigureController {
  motion: import('../types.d.ts').Motion | undefined;
  /** Simulation object of the core. */
  simulation: any;
  /** Message of the error that stops the figure. */
  failure: string | undefined;
  /** True once the `load` event was fired. */
  #hasLoaded = false;
  #startPromise: Promise<void> | undefined;
  /** True from a trap to the next picture. */
  #hasTrapped = false;

  /** Starts the core, if it is not running. Resolves when it has started or failed. */
  start(): Promise<void> {
    if (!this.simulation && this.host.isConnected) this.#startPromise ??= this.#create();
    return this.#startPromise ?? Promise.resolve();
  }

  hostConnected() {
    precompile();
  }

  hostDisconnected() {
    // A moved element is connected again by then.
    queueMicrotask(() => {
      if (this.host.isConnected) return;
      this.host.renderer.setVisible(false);
      this.#stopSimulation();
    });
  }

  /** Replaces the simulation and frees the present one. */
  replace(simulation: any) {
    this.simulation.free();
    this.simulation = simulation;
  }

  /** Runs work. After a trap, replaces the core and returns undefined. Throws other errors. */
  attempt<Result>(work: () => Result): Result | undefined {
    try {
      return work();
    } catch (error) {
      if (!this.#recover(error)) throw error;
    }
  }

  /** Runs work as `attempt` does; an error ends the figure with a message. */
  attemptOrFail: Runtime['attempt'] = (work) => {
    try {
      return this.attempt(work);
    } catch (error) {
      this.fail(error);
    }
  };

  /** Runs work as `attempt` does; an error is reported. */
  attemptOrReport(work: () => void) {
    try {
      this.attempt(work);
    } catch (error) {
      if (isWasmTrap(error)) throw error;
      this.report(error);
    }
  }

  /** Marks the core as working after a picture was drawn, so that the figure recovers from a later trap again. */
  confirmHealthy() {
    this.#hasTrapped = false;
  }

  /** Fires an `error` event, and warns on the console if no listener prevents that. */
  report(error: unknown) {
    const message = messageOf(error);
    const isUnhandled = this.host.dispatchEvent(new ErrorEvent('error', { error, message, cancelable: true }));
    if (isUnhandled) console.warn(message, this.host);
  }

  /** Shows an error in the figure's place and fires it. */
  fail(error: unknown) {
    if (isWasmTrap(error)) this.#abandon();
    this.#stopSimulation();
    this.failure = messageOf(error);
    this.report(error);
  }

  /** Replaces the core after a trap, because its memory may be damaged. Returns false for other errors, and for a trap before a picture. */
  #recover(error: unknown): boolean {
    if (!isWasmTrap(error) || this.#hasTrapped) return false;
    this.#hasTrapped = true;
    this.#abandon();
    this.report(error);
    void this.start();
    return true;
  }

  #abandon() {
    if (this.simulation) abandonSimulation(this.simulation);
    this.host.settings.reset();
    this.simulation = this.motion = undefined;
  }

  async #create() {
    try {
      const [motion] = await Promise.all([instantiateFor(this.host.localName), this.host.link.prepare()]);
      if (!this.host.isConnected) return;
      const simulation = this.host.createSimulation(motion, this.host.state.lastValidState);
      Object.assign(this, { motion, simulation, failure: undefined });
      this.host.state.resume();
      await this.#showContent();
    } catch (error) {
      this.fail(error);
    } finally {
      this.#startPromise = undefined;
    }
    // The element was moved meanwhile, or the core has trapped again.
    if (this.failure === undefined) void this.start();
  }

  async #showContent() {
    this.host.requestUpdate();
    await this.host.updateComplete;
    // Rendering may have trapped, and the element may be removed.
    if (!this.simulation) return;
    this.host.renderer.requestFrame();
    if (this.#hasLoaded) return;
    this.#hasLoaded = true;
    this.host.dispatchEvent(new Event('load', { bubbles: true, composed: true }));
  }

  #stopSimulation() {
    this.#hasLoaded = false;
    this.#hasTrapped = false;
    this.host.canvases.clear();
    // An element that is removed during print gets no event at its end.
    this.host.renderer.isPrinting = false;
    this.attempt(() => {
      this.host.settings.applyPending();
      this.host.state.storeState();
    });
    this.simulation?.free();
    this.simulation = this.motion = undefined;
    this.host.requestUpdate();
  }
}

/** Runs work with a new simulation, which is freed if that throws. */
export function freeOnError<Simulation extends { free(): void }>(simulation: Simulation, work: (simulation: Simulation) => void) {
  try {
    work(simulation);
    return simulation;
  } catch (error) {
    simulation.free();
    throw error;
  }
}

/** Returns true for a trap, and for the error of a simulation used after one: see writeGlue in scripts/build.mjs. */
const isWasmTrap = (error: unknown) => typeof WebAssembly !== 'undefined' && error instanceof WebAssembly.RuntimeError;

/** Error message if Trusted Types refuse the figure's templates. */
const CSP_ERROR = "This page's Content-Security-Policy forbids the figure's templates: its trusted-types directive lacks motion-widgets.";

function messageOf(error: unknown) {
  const message = error instanceof Error ? error.message : String(error);
  return message.includes('TrustedHTML') ? CSP_ERROR : message;
}
