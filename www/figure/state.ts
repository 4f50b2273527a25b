/** State of the figure as plain data. It is kept after a trap. */

import { checkedObject, refusalError, checkedWord } from './checks.ts';
import { FigureController } from './controller.ts';
import { validatedValue } from './definition.ts';
import type { Values } from './settings.ts';

export const STATE_VERSION = 1;

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

  storeState() {
    if (this.host.simulation) this.lastValidState = this.host.snapshot();
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
    for (const [name, field] of Object.entries(this.#fields)) {
      if (name in checkedState) wholeState[name] = validatedValue(field, `state.${name}`, wholeState[name], selectableCount);
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
    this.elementState[name] = validatedValue(this.#fields[name], name, value, cloud?.selectableCount ?? 0);
    reflection.updateAttributes();
    renderer.requestFrame();
  }
}
