/** Wasm core of a figure: start, error reports, and replacement after a trap. The new core gets the state that was shown. */

import { abandonSimulation, instantiateFor, precompileModule } from '../core.ts';
import { FigureController } from './controller.ts';

export class CoreRuntime extends FigureController {
  motionCore: import('../types.d.ts').Motion | undefined;
  /** Simulation object of the core. */
  simulation: any;
  failureMessage: string | undefined;
  #hasLoaded = false;
  #startPromise: Promise<void> | undefined;
  /** True from a trap until the next picture is drawn. A second trap in this time ends the figure. */
  hasTrapped = false;

  hostConnected() {
    precompileModule();
  }

  /** Starts the core, if it is not running. Resolves when it has started or failed. */
  startCore(): Promise<void> {
    if (!this.simulation) this.#startPromise ??= this.#createCore();
    return this.#startPromise ?? Promise.resolve();
  }

  async #createCore() {
    try {
      const { localName, stateLink, settings, viewModel } = this.figure;
      const shownState = viewModel && this.figure.takeSnapshot();
      const [motionCore] = await Promise.all([instantiateFor(localName), shownState ?? stateLink.applyStateInAddress()]);
      this.motionCore = motionCore;
      const simulation = this.figure.createSimulation(motionCore);
      if (shownState) this.figure.enterState(simulation, shownState);
      Object.assign(this, { simulation, failureMessage: undefined });
      settings.showNewSimulation(shownState);
      await this.#showContent();
    } catch (error) {
      this.endWithError(error);
    } finally {
      this.#startPromise = undefined;
    }
    // If the core has trapped again during this start, it is started again. Otherwise this call does nothing.
    if (this.failureMessage === undefined) void this.startCore();
  }

  async #showContent() {
    this.figure.requestUpdate();
    await this.figure.updateComplete;
    // If rendering has trapped, there is no simulation that could be drawn.
    if (!this.simulation) return;
    this.figure.renderer.requestFrame();
    if (this.#hasLoaded) return;
    this.#hasLoaded = true;
    this.figure.dispatchEvent(new Event('load', { bubbles: true, composed: true }));
  }

  /** Replaces the simulation. Pending changes are dropped. */
  replaceSimulation(simulation: any) {
    this.simulation.free();
    this.simulation = simulation;
    this.figure.settings.dropPendingChanges();
    this.figure.onSimulationReplaced();
  }

  /** Calls `doWork`. After a trap, replaces the core and returns undefined. Other errors go to `handleError`, by default to the caller. */
  attemptWork<Result>(doWork: () => Result, handleError = (error: unknown): void => { throw error; }): Result | undefined {
    try {
      return doWork();
    } catch (error) {
      if (isWasmTrap(error)) this.#replaceCoreAfterTrap(error);
      else handleError(error);
    }
  }

  /** Calls `doWork` as `attemptWork` does. If it throws, the figure ends with a message. */
  attemptOrFail = <Result>(doWork: () => Result) => this.attemptWork(doWork, (error) => this.endWithError(error));

  /** Calls `doWork` as `attemptWork` does. If it throws, an `error` event is fired. */
  attemptOrReport = (doWork: () => void) => this.attemptWork(doWork, (error) => this.reportError(error));

  /** Fires an `error` event, and warns on the console if no listener prevents that. */
  reportError(error: unknown) {
    const errorMessage = errorMessageOf(error);
    const isUnhandled = this.figure.dispatchEvent(new ErrorEvent('error', { error, message: errorMessage, cancelable: true }));
    if (isUnhandled) console.warn(errorMessage, this.figure);
  }

  endWithError(error: unknown) {
    this.#abandonCore();
    this.hasTrapped = false;
    this.figure.canvases.stopObserving();
    this.failureMessage = errorMessageOf(error);
    this.reportError(error);
    this.figure.requestUpdate();
  }

  /** Replaces the core after a trap, because its memory may be damaged. */
  #replaceCoreAfterTrap(trapError: unknown) {
    if (this.hasTrapped) {
      this.endWithError(trapError);
      return;
    }
    this.hasTrapped = true;
    this.#abandonCore();
    this.reportError(trapError);
    void this.startCore();
  }

  #abandonCore() {
    if (this.simulation) abandonSimulation(this.simulation);
    this.figure.settings.dropPendingChanges();
    this.simulation = this.motionCore = undefined;
  }
}

/** Returns true for a trap, and for an error that wasm-bindgen throws for a simulation used after a trap: see writeGlue in scripts/build.mjs. */
const isWasmTrap = (error: unknown) => typeof WebAssembly !== 'undefined' && error instanceof WebAssembly.RuntimeError;

const TRUSTED_TYPES_ERROR = "This page's Content-Security-Policy forbids the figure's templates: its trusted-types directive lacks motion-widgets.";

function errorMessageOf(error: unknown) {
  const errorMessage = error instanceof Error ? error.message : String(error);
  return errorMessage.includes('TrustedHTML') ? TRUSTED_TYPES_ERROR : errorMessage;
}
