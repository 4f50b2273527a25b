/** Settings of the simulation: those in effect, and changes that wait for the next frame. */

import { FigureController } from './controller.ts';

/** Settings or a state as plain data. */
export type Values = Record<string, any>;

export class Settings extends FigureController {
  /** True if the simulation has changed since it was read. */
  isStale: boolean | undefined;
  /** Cache of the settings in effect; undefined until the simulation is asked. */
  #current: Values | undefined;
  /** Changes of the user that wait for the next frame. */
  #pending: Values = {};
  /** Message about the text that the user typed last, if it was refused, and the setting's key. */
  #refusal: { key: string, message: string } | undefined;

  /** Drops pending changes and stops the player, for another simulation. */
  reset() {
    this.host.player?.stop();
    this.isStale = true;
    this.#current = undefined;
    this.#pending = {};
  }

  /** Returns the declared settings among other values. */
  pick(values: Values) {
    const keys = this.host.definition.declarations.filter((setting) => !setting.in && !setting.of).map(({ key }) => key);
    return Object.fromEntries(keys.map((key) => [key, values[key]]));
  }

  get current(): Values {
    const { simulation, viewModel } = this.host;
    if (simulation) this.#current ??= simulation.config as Values;
    return this.#current ?? viewModel.config;
  }

  get requested(): Values {
    return { ...this.current, ...this.#pending };
  }

  /** True if changes are pending, or not in the view model yet. */
  get isWaiting() {
    return this.isStale || Object.keys(this.#pending).length > 0;
  }

  /**
   * Changes settings in the next frame, as a change by the user, so that a drag configures the simulation once in each frame. State of the
   * element is changed at once.
   */
  request(change: Values | ((requested: Values) => Values)) {
    const { simulation, state, gesture, renderer } = this.host;
    if (!simulation) return;
    this.forgetRefusal();
    const values = typeof change === 'function' ? change(this.requested) : change;
    for (const [key, value] of Object.entries(values)) (key in state.elementState ? state.elementState : this.#pending)[key] = value;
    gesture.step();
    renderer.requestFrame();
  }

  /** Shows why a typed text is not a valid value of a setting. */
  refuse(key: string, message: string) {
    this.#refusal = { key, message };
    this.host.requestUpdate();
  }

  refusalOf(key: string): string | undefined {
    return this.#refusal?.key === key ? this.#refusal.message : undefined;
  }

  forgetRefusal() {
    if (this.#refusal) this.host.requestUpdate();
    this.#refusal = undefined;
  }

  /** Changes settings at once, as a change by the page. Throws a TypeError or RangeError, without a change, for invalid values. */
  assign(values: Values) {
    this.applyPending();
    this.#configure(values);
    this.host.reflection.updateAttributes();
    this.host.renderer.releaseViews();
    this.host.renderer.requestFrame();
  }

  /** Applies pending changes. A refused one is reported and dropped. */
  applyPending() {
    const pendingValues = this.#pending;
    if (Object.keys(pendingValues).length === 0) return;
    this.#pending = {};
    this.host.runtime.attemptOrReport(() => this.#configure(pendingValues));
  }

  #configure(values: Values) {
    const { simulation, cloud } = this.host;
    if (!simulation) return;
    this.#current = Object.freeze(cloud ? cloud.configure(values) : simulation.configure(values));
    this.isStale = true;
  }
}
