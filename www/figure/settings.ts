/** Settings and state of a figure. The settings are those of the simulation. The state adds the fields of the element that the simulation does not have. */

import { checkObject, checkValue, checkWord, createRefusalError } from '../data/checks.ts';
import { FigureController } from './controller.ts';

/** Settings or a state as plain data. */
export type StateValues = Record<string, any>;

export const STATE_VERSION = 1;

export class FigureSettings extends FigureController {
  /** True if the simulation has changed since the view model was read. */
  isViewModelStale: boolean | undefined;
  #openingState: StateValues | undefined;
  #elementFields = this.figure.definition.elementFields;
  /** Values of the state fields that the simulation does not have. Changes take effect immediately. */
  elementState: StateValues = { ...this.figure.definition.elementDefaults };
  /** Cached settings that are in effect in the simulation; undefined until they are read. */
  #currentSettings: StateValues | undefined;
  /** Changes of settings by the user that wait for the next frame. */
  #pendingChanges: StateValues = {};

  /** Drops pending changes and stops the player, before the simulation is replaced. */
  dropPendingChanges() {
    this.figure.player?.stopAnimation();
    this.isViewModelStale = true;
    this.#currentSettings = undefined;
    this.#pendingChanges = {};
  }

  /** Returns those of the values that are declared settings. */
  pickSettings(settingValues: StateValues) {
    const settingKeys = this.figure.definition.settingDeclarations.filter((settingDeclaration) => !settingDeclaration.in && !settingDeclaration.of).map(({ key: settingKey }) => settingKey);
    return Object.fromEntries(settingKeys.map((settingKey) => [settingKey, settingValues[settingKey]]));
  }

  /** Settings of the simulation that are in effect, or after a trap those that were shown. */
  get currentValues(): StateValues {
    const { simulation, viewModel } = this.figure;
    if (simulation) this.#currentSettings ??= simulation.config as StateValues;
    return this.#currentSettings ?? viewModel.config;
  }

  /** Settings in effect with the pending changes, and the element's own state fields. */
  get requestedValues(): StateValues {
    return { ...this.currentValues, ...this.#pendingChanges, ...this.elementState };
  }

  /** True if changes are pending or the view model does not contain them yet. */
  get hasPendingChanges() {
    return this.isViewModelStale || Object.keys(this.#pendingChanges).length > 0;
  }

  /** Changes values for the user, with an `input` event. Settings wait for the next frame, so that a drag configures the simulation once in each frame. */
  requestChange(settingChange: StateValues | ((requestedValues: StateValues) => StateValues)) {
    const { simulation, gesture: userGesture, renderer: figureRenderer } = this.figure;
    if (!simulation) return;
    const changedFields = typeof settingChange === 'function' ? settingChange(this.requestedValues) : settingChange;
    for (const [settingKey, fieldValue] of Object.entries(changedFields)) (settingKey in this.elementState ? this.elementState : this.#pendingChanges)[settingKey] = fieldValue;
    userGesture.dispatchInput();
    figureRenderer.requestFrame();
  }

  /** Changes values for the page, immediately and without an `input` event. Throws a TypeError or RangeError, and changes nothing, if a value is invalid. */
  assignValues(settingValues: StateValues) {
    const { figure } = this;
    this.applyPending();
    const elementValues = this.#checkElementValues('', settingValues, () => figure.takeSnapshot());
    const settingEntries = Object.entries(settingValues).filter(([settingKey]) => !(settingKey in elementValues));
    if (settingEntries.length > 0) this.#configureSimulation(Object.fromEntries(settingEntries));
    Object.assign(this.elementState, elementValues);
    figure.reflection.updateAttributes();
    figure.renderer.letViewsZoomIn();
    figure.renderer.requestFrame();
  }

  /** Applies pending changes. Changes that the simulation refuses are reported and dropped. */
  applyPending() {
    const pendingValues = this.#pendingChanges;
    if (Object.keys(pendingValues).length === 0) return;
    this.#pendingChanges = {};
    this.figure.runtime.attemptOrReport(() => this.#configureSimulation(pendingValues));
  }

  #configureSimulation(settingValues: StateValues) {
    const { simulation, cloud } = this.figure;
    if (!simulation) return;
    this.#currentSettings = Object.freeze(cloud ? simulation.configureFirst(settingValues, this.elementState.shown) : simulation.configure(settingValues));
    this.isViewModelStale = true;
  }

  /** Checks the values of the element's own state fields, and returns them. Errors name a field with the prefix `statePath`. */
  #checkElementValues(statePath: string, settingValues: StateValues, getState: () => StateValues) {
    const givenFields = Object.entries(this.#elementFields).filter(([fieldName]) => fieldName in settingValues);
    return Object.fromEntries(givenFields.map(([fieldName, { maxInState, max: maxValue, ...fieldRange }]) =>
      [fieldName, checkValue(statePath + fieldName, settingValues[fieldName], { ...fieldRange, max: maxInState ? maxInState(getState()) : maxValue })]));
  }

  /** Applies properties that the page assigned before the core was loaded, and shows the new simulation. `figureState` is the state restored after a WebAssembly trap, if any. */
  showNewSimulation(figureState?: StateValues) {
    const { figure } = this;
    this.dropPendingChanges();
    figure.onSimulationReplaced();
    figure.reflection.applyEarlyAssignments();
    // The state is shown, unless an assignment has trapped, which removes the simulation, or a state that the page assigned is already shown.
    if (figure.simulation && this.isViewModelStale) this.#showState(figureState);
  }

  /** Applies a state, which must name this widget and version. Fields that the state does not have keep their values. Throws an error for an invalid state, and then changes nothing. */
  applyState(figureState: unknown) {
    const { figure } = this;
    this.applyPending();
    const { widget, version: stateVersion } = Object(figureState);
    checkWord('state.widget', widget, [figure.localName]);
    if (stateVersion !== STATE_VERSION) throw createRefusalError('state.version', stateVersion, String(STATE_VERSION));
    const currentState = figure.takeSnapshot();
    const changedFields = checkObject('state', figureState, Object.keys(currentState));
    const wholeState: StateValues = { ...currentState, ...figure.addDerivedFields(currentState, changedFields) };
    // Checks the settings first, because the number of samples limits other fields.
    const simulation = figure.createSimulation(figure.motion);
    figure.enterState(simulation, wholeState);
    const changedValues = Object.fromEntries(Object.keys(changedFields).map((settingKey) => [settingKey, wholeState[settingKey]]));
    Object.assign(wholeState, this.#checkElementValues('state.', changedValues, () => wholeState));
    for (const fieldName of Object.keys(this.elementState)) this.elementState[fieldName] = wholeState[fieldName];
    figure.runtime.replaceSimulation(simulation);
    figure.renderer.letViewsZoomIn(1);
    this.#showState(wholeState);
  }

  choosePreset(presetName: string) {
    const { figure } = this;
    figure.player?.stopAnimation();
    figure.renderer.letViewsZoomIn(1);
    for (const [fieldName, { isResetByPreset, default: openingValue }] of Object.entries(this.#elementFields)) if (isResetByPreset) this.elementState[fieldName] = openingValue;
    Object.assign(figure, { preset: presetName });
    figure.gesture.commitOneStep();
  }

  /** Restores a state for the user, with a `change` event. By default this is the state that the figure opened with. */
  restoreAsUser(figureState: StateValues | undefined = this.#openingState) {
    this.applyState(figureState);
    this.figure.gesture.commitOneStep();
  }

  /** Shows a state of the simulation, by default the opening state. */
  #showState(figureState?: StateValues) {
    const { figure } = this;
    figure.cloud?.showOrGrow(figureState);
    this.#openingState ??= { ...figure.takeSnapshot(), ...(figure.cloud && { shown: 0, playing: true }) };
    figure.updateViewModel();
    figure.reflection.updateAttributes();
    figure.renderer.requestFrame();
  }
}
