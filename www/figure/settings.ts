/** Settings and state of a figure. The settings are those of the simulation. The state adds the fields of the element that the simulation does not have. */

import { checkObject, checkValue, checkWord, createRefusalError } from '../data/checks.ts';
import { FigureController } from './controller.ts';

/** Settings or a state as plain data. */
export type StateValues = Record<string, any>;

export const STATE_VERSION = 1;

export class Settings extends FigureController {
  /** True if the simulation has changed since the view model was read. */
  isViewModelStale: boolean | undefined;
  #openingState: StateValues | undefined;
  #elementFields = this.host.definition.elementFields;
  /** Values of the state fields that the simulation does not have. Changes take effect immediately. */
  elementState: StateValues = { ...this.host.definition.elementDefaults };
  /** Cached settings that are in effect in the simulation; undefined until they are read. */
  #currentSettings: StateValues | undefined;
  /** Changes of settings by the user that wait for the next frame. */
  #pendingChanges: StateValues = {};

  /** Drops pending changes and stops the player, before the simulation is replaced. */
  dropPendingChanges() {
    this.host.player?.stop();
    this.isViewModelStale = true;
    this.#currentSettings = undefined;
    this.#pendingChanges = {};
  }

  /** Returns those of the values that are declared settings. */
  pickSettings(values: StateValues) {
    const keys = this.host.definition.declarations.filter((declaration) => !declaration.in && !declaration.of).map(({ key }) => key);
    return Object.fromEntries(keys.map((key) => [key, values[key]]));
  }

  /** Settings of the simulation that are in effect, or after a trap those that were shown. */
  get current(): StateValues {
    const { simulation, viewModel } = this.host;
    if (simulation) this.#currentSettings ??= simulation.config as StateValues;
    return this.#currentSettings ?? viewModel.config;
  }

  /** Settings in effect with the pending changes, and the element's own state fields. */
  get requested(): StateValues {
    return { ...this.current, ...this.#pendingChanges, ...this.elementState };
  }

  /** True if changes are pending or the view model does not contain them yet. */
  get hasPendingChanges() {
    return this.isViewModelStale || Object.keys(this.#pendingChanges).length > 0;
  }

  /** Changes values for the user, with an `input` event. Settings wait for the next frame, so that a drag configures the simulation once in each frame. */
  requestChange(change: StateValues | ((requested: StateValues) => StateValues)) {
    const { simulation, gesture, renderer } = this.host;
    if (!simulation) return;
    const changedFields = typeof change === 'function' ? change(this.requested) : change;
    for (const [key, value] of Object.entries(changedFields)) (key in this.elementState ? this.elementState : this.#pendingChanges)[key] = value;
    gesture.dispatchInput();
    renderer.requestFrame();
  }

  /** Changes values for the page, immediately and without an `input` event. Throws a TypeError or RangeError, and changes nothing, if a value is invalid. */
  assignValues(values: StateValues) {
    const { host } = this;
    this.applyPending();
    const elementValues = this.#checkElementValues('', values, () => host.takeSnapshot());
    const settings = Object.entries(values).filter(([key]) => !(key in elementValues));
    if (settings.length > 0) this.#configure(Object.fromEntries(settings));
    Object.assign(this.elementState, elementValues);
    host.reflection.updateAttributes();
    host.renderer.letViewsZoomIn();
    host.renderer.requestFrame();
  }

  /** Applies pending changes. Changes that the simulation refuses are reported and dropped. */
  applyPending() {
    const pendingValues = this.#pendingChanges;
    if (Object.keys(pendingValues).length === 0) return;
    this.#pendingChanges = {};
    this.host.runtime.attemptOrReport(() => this.#configure(pendingValues));
  }

  #configure(values: StateValues) {
    const { simulation, cloud } = this.host;
    if (!simulation) return;
    this.#currentSettings = Object.freeze(cloud ? cloud.configure(simulation, values) : simulation.configure(values));
    this.isViewModelStale = true;
  }

  /** Checks the values of the element's own state fields, and returns them. Errors name a field with the prefix `path`. */
  #checkElementValues(path: string, values: StateValues, getState: () => StateValues) {
    const fields = Object.entries(this.#elementFields).filter(([name]) => name in values);
    return Object.fromEntries(fields.map(([name, { maxInState, max, ...range }]) =>
      [name, checkValue(path + name, values[name], { ...range, max: maxInState ? maxInState(getState()) : max })]));
  }

  /** Applies properties that the page assigned before the core was loaded, and shows the new simulation. `state` is the state restored after a WebAssembly trap, if any. */
  showNewSimulation(state?: StateValues) {
    const { host } = this;
    this.dropPendingChanges();
    host.onSimulationReplaced();
    host.reflection.applyEarlyAssignments();
    // If an assignment has trapped, there is no simulation. If an assigned state is shown, the view model is already up to date.
    if (host.simulation && this.isViewModelStale) this.#showState(state);
  }

  /** Applies a state, which must name this widget and version. Fields that the state does not have keep their values. Throws an error for an invalid state, and then changes nothing. */
  applyState(state: unknown) {
    const { host } = this;
    this.applyPending();
    const { widget, version } = Object(state);
    checkWord('state.widget', widget, [host.localName]);
    if (version !== STATE_VERSION) throw createRefusalError('state.version', version, String(STATE_VERSION));
    const currentState = host.takeSnapshot();
    const changes = checkObject('state', state, Object.keys(currentState));
    const wholeState: StateValues = { ...currentState, ...host.withDerivedFields(currentState, changes) };
    // Checks the settings first, because the number of samples limits other fields.
    const simulation = host.createSimulation(host.motion);
    host.enterState(simulation, wholeState);
    const changedValues = Object.fromEntries(Object.keys(changes).map((key) => [key, wholeState[key]]));
    Object.assign(wholeState, this.#checkElementValues('state.', changedValues, () => wholeState));
    for (const name of Object.keys(this.elementState)) this.elementState[name] = wholeState[name];
    host.runtime.replaceSimulation(simulation);
    host.renderer.letViewsZoomIn(1);
    this.#showState(wholeState);
  }

  choosePreset(presetName: string) {
    const { host } = this;
    host.player?.stop();
    host.renderer.letViewsZoomIn(1);
    for (const [name, { isResetByPreset, default: openingValue }] of Object.entries(this.#elementFields)) if (isResetByPreset) this.elementState[name] = openingValue;
    Object.assign(host, { preset: presetName });
    host.gesture.commitOneStep();
  }

  /** Restores a state for the user, with a `change` event. By default this is the state that the figure opened with. */
  restoreAsUser(state: StateValues | undefined = this.#openingState) {
    this.applyState(state);
    this.host.gesture.commitOneStep();
  }

  /** Shows a state of the simulation, by default the opening state. */
  #showState(state?: StateValues) {
    const { host } = this;
    host.cloud?.showOrGrow(state);
    this.#openingState ??= { ...host.takeSnapshot(), ...(host.cloud && { shown: 0, playing: true }) };
    host.updateViewModel();
    host.reflection.updateAttributes();
    host.renderer.requestFrame();
  }
}
