/** State of a figure as plain data: settings of the simulation, and fields that the element keeps because the simulation does not have them. */

import { checkedObject, checkedWord, refusalError } from './checks.ts';
import { FigureController } from './controller.ts';

/** Settings or a state as plain data. */
export type Values = Record<string, any>;

export const STATE_VERSION = 1;

/** Settings of the simulation: those in effect, and changes that wait for the next frame. */
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

/** State as in `getState`: settings and fields of the element. After a trap, a new simulation gets the last valid state. */
export class State extends FigureController {
  lastValidState: Values | undefined;
  #openingState: Values | undefined;
  #fields = this.host.definition.elementFields;
  defaults: Values = Object.fromEntries(Object.entries(this.#fields).map(([name, { opening }]) => [name, opening]));
  /** Fields of the state that the element keeps, because the simulation does not have them. */
  elementState = { ...this.defaults };

  /** Settings of the simulation, with pending changes, and the state of the element. */
  get config(): Values {
    return { ...this.host.settings.requested, ...this.elementState };
  }

  /** Applies pending changes of the page to a new simulation that has the last valid state. */
  resume() {
    const { host } = this;
    host.settings.reset();
    host.simulationChanged();
    host.reflection.applyEarlyAssignments();
    // The simulation is missing after a trap. The settings are not stale if a pending state was shown already.
    if (host.simulation && host.settings.isStale) this.#showState(this.lastValidState);
  }

  /** Applies a state with its widget and version. Missing fields keep their values; an error changes nothing. */
  applyState(state: unknown) {
    const host = this.host;
    host.settings.applyPending();
    const { widget, version } = Object(state);
    checkedWord('state.widget', widget, [host.localName]);
    if (version !== STATE_VERSION) throw refusalError('state.version', version, String(STATE_VERSION));
    const currentState = host.snapshot();
    const checkedState = checkedObject('state', state, Object.keys(currentState));
    const wholeState: Values = { ...currentState, ...host.withDerivedFields(currentState, checkedState) };
    // Checks the settings first, because the number of samples limits other fields.
    const simulation = host.createSimulation(host.motion, wholeState);
    const selectableCount = wholeState.playing ? wholeState.samples : wholeState.shown;
    for (const [name, { check }] of Object.entries(this.#fields)) {
      if (name in checkedState) wholeState[name] = check(`state.${name}`, wholeState[name], selectableCount);
    }
    for (const name of Object.keys(this.elementState)) this.elementState[name] = wholeState[name];
    host.runtime.replace(simulation);
    host.settings.reset();
    host.simulationChanged();
    host.renderer.releaseViews(1);
    this.#showState(wholeState);
  }

  choosePreset(preset: string) {
    const { host } = this;
    host.player?.stop();
    host.settings.forgetRefusal();
    host.renderer.releaseViews(1);
    for (const [name, { isResetByPreset, opening }] of Object.entries(this.#fields)) if (isResetByPreset) this.elementState[name] = opening;
    Object.assign(host, { preset });
    host.gesture.complete();
  }

  /** Restores a state, by default the one that the figure opened with, as a change by the user. */
  restoreAsUser(state: Values | undefined = this.#openingState) {
    this.host.copyMenu.clearMessage();
    this.applyState(state);
    this.host.gesture.complete();
  }

  /** Shows a state of the simulation, by default the opening state. */
  #showState(state?: Values) {
    const { host } = this;
    host.cloud?.introduce(state);
    this.#openingState ??= { ...host.snapshot(), ...(host.cloud && { shown: 0, playing: true }) };
    host.refresh();
    host.reflection.updateAttributes();
    host.renderer.requestFrame();
  }

  /** Changes a field of the element's own state, after a check. */
  assign(name: string, value: unknown) {
    const { settings, cloud, reflection, renderer } = this.host;
    settings.applyPending();
    this.elementState[name] = this.#fields[name].check(name, value, cloud?.selectableCount ?? 0);
    reflection.updateAttributes();
    renderer.requestFrame();
  }
}
