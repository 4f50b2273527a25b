/** The whole state as plain data: given, taken, and kept over a removal and a trap. */

import { object, refusal, word } from './checks.ts';
import { Part } from './part.ts';
import { freeOnError } from './runtime.ts';
import type { Figure } from './figure.ts';

/** Plain data; which fields, the widget says. */
export type Values = Record<string, any>;

/** Something in the state that is the element's and not its machine's. */
export interface Owned {
  /** Opening value. */
  opening: unknown;
  /** Checks a value for a figure with so many samples that can be marked; throws. */
  check: (field: string, value: any, machine: any, selectableCount: number) => any;
}

/** Version of the states that `getState` gives; `setState` refuses any other. */
const VERSION = 1;

export class State extends Part {
  /** The last good one. */
  kept: Values | undefined;
  /** Whole state that the figure opened with. */
  #opened: Values | undefined;
  /** State that is the element's own, by name. */
  own: Values;
  #owned;

  constructor(host: Figure, owned: Record<string, Owned>) {
    super(host);
    this.#owned = owned;
    this.own = Object.fromEntries(Object.keys(owned).map((name) => [name, this.opening(name)]));
  }

  /** Opening value of something that is the element's own. */
  opening(name: string) {
    return this.#owned[name]?.opening;
  }

  /** The part that every widget's state has. */
  get common(): Values {
    return { widget: this.host.localName, version: VERSION, ...this.own };
  }

  /** Something of the element's own, for the page. */
  copy(name: string) {
    return structuredClone(this.own[name]);
  }

  keep() {
    if (this.host.machine) this.kept = this.host.snapshot();
  }

  /** Goes on with a machine that was made of the last good state, and with the wishes of the page meanwhile. */
  resume() {
    const { host } = this;
    host.settings.reset();
    if (this.kept) host.complete(host.machine, this.kept);
    else host.reflection.rememberDefaults(host.settings.present);
    host.machineChanged();
    host.reflection.applyPending();
    host.link.applyPending();
    // It may have trapped, or a state that came before has introduced it.
    if (host.machine && host.settings.stale) this.#introduce(this.kept);
  }

  /**
   * Puts the element into a state, which names its widget and version. What else is left out stays as it is.
   *
   * @throws {TypeError | RangeError} that names the field, the value and what is allowed; nothing is changed then
   */
  enter(state: unknown) {
    const host = this.host;
    host.settings.settle();
    const present = host.snapshot();
    const given = object('state', state, Object.keys(present), ({ widget, version }) => {
      word('state.widget', widget, [host.localName]);
      if (version !== VERSION) throw refusal('state.version', version, String(VERSION));
    });
    const whole: Values = { ...present, ...host.completed(present, given) };
    const machine = freeOnError(host.createMachine(host.motion, whole), (made) => {
      const selectableCount = whole.playing ? made.config.samples : whole.shown;
      for (const [name, { check }] of Object.entries(this.#owned)) {
        whole[name] = check(`state.${name}`, whole[name], made, selectableCount);
      }
      host.complete(made, whole);
    });
    for (const name of Object.keys(this.own)) this.own[name] = whole[name];
    host.runtime.replace(machine);
    host.settings.reset();
    host.machineChanged();
    this.#introduce(whole);
    host.settings.show();
  }

  /** Brings back the settings, the seed and everything else as the figure opened. */
  startOver() {
    this.goBack(this.#opened);
    this.host.startedOver();
  }

  /** Brings back a whole state, as a step of the reader. */
  goBack(state: Values | undefined = this.#opened) {
    const { gesture, runtime } = this.host;
    runtime.attempt(() => {
      this.enter(state);
      gesture.step();
      gesture.commit();
    });
  }

  /** @param state that the machine is in, if it is not the opening */
  #introduce(state?: Values) {
    const { host } = this;
    host.stage.release();
    host.cloud?.introduce(state);
    this.#opened ??= { ...host.snapshot(), ...(host.cloud && { shown: 0, playing: true }) };
    host.refresh();
    host.reflection.updateAttributes();
    host.settings.show();
  }

  /** Something of the element's own is to be another; it is checked. */
  assign(name: string, value: unknown) {
    const { settings, cloud, reflection, stage } = this.host;
    settings.settle();
    const { machine } = this.host;
    this.own[name] = this.#owned[name].check(name, value, machine, cloud?.selectableCount ?? 0);
    reflection.updateAttributes();
    stage.requestFrame();
  }
}
