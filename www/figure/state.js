/** The whole state as plain data: given, taken, and kept over a removal and a trap. */

import { object, refusal, word } from './checks.js';
import { Part } from './part.js';
import { orFree } from './runtime.js';
import { LONGEST_WORK } from './settings.js';

/**
 * @import { Figure } from './figure.js'
 *
 * @typedef {Record<string, any>} Values plain data; which fields, the widget says
 *
 * @typedef {object} Owned something in the state that is the element's and not its machine's
 * @property {unknown} opening what it is when the widget opens
 * @property {(field: string, value: any, machine: any, markable: number) => any} check what is taken of a value, of a figure
 *   with so many samples that can be marked; throws
 */

/** Version of the states that `getState` gives; `setState` refuses any other. */
const VERSION = 1;

export class State extends Part {
  /** The last good one. @type {Values | undefined} */
  kept;
  /** Whole state that the figure opened with. @type {Values | undefined} */
  #opened;
  /** What is the element's own, by name. @type {Values} */
  own;
  #owned;

  /**
   * @param {Figure} host
   * @param {Record<string, Owned>} owned
   */
  constructor(host, owned) {
    super(host);
    this.#owned = owned;
    this.own = Object.fromEntries(Object.keys(owned).map((name) => [name, this.opening(name)]));
  }

  /** What something of the element's own is when the widget opens. @param {string} name */
  opening(name) {
    return this.#owned[name]?.opening;
  }

  /** The part that every widget's state has. @returns {Values} */
  get common() {
    return { widget: this.host.localName, version: VERSION, ...this.own };
  }

  /** Something of the element's own, for the page. @param {string} name */
  copy(name) {
    return structuredClone(this.own[name]);
  }

  keep() {
    if (this.host.machine) this.kept = this.host.snapshot();
  }

  /** A machine was made of the last good state: the figure goes on with it, and with what the page asked for meanwhile. */
  resume() {
    const { host } = this;
    host.settings.reset();
    host.settings.work(this.#resuming());
    host.settings.settle(LONGEST_WORK);
    host.settings.show();
  }

  *#resuming() {
    const { host } = this;
    yield* host.complete(host.machine, this.kept ?? {});
    host.machineChanged();
    host.settings.reset();
    host.reflection.catchUp();
    host.link.catchUp();
    // It may have trapped, or a state that came before has introduced it.
    if (host.machine && host.settings.stale) this.#introduce(this.kept);
  }

  /**
   * Puts the element into a state, which names its widget and version. What else is left out stays as it is.
   *
   * @param {unknown} state
   * @throws {TypeError | RangeError} that names the field, the value and what is allowed; nothing is changed then
   */
  enter(state) {
    const host = this.host;
    host.settings.settle();
    const end = performance.now() + LONGEST_WORK;
    const present = host.snapshot();
    const given = object('state', state, Object.keys(present), ({ widget, version }) => {
      word('state.widget', widget, [host.localName]);
      if (version !== VERSION) throw refusal('state.version', version, String(VERSION));
    });
    const whole = { ...present, ...host.completed(present, given) };
    const machine = orFree(host.createMachine(host.motion, whole), (made) => {
      const markable = whole.playing ? made.config.samples : whole.shown;
      for (const [name, { check }] of Object.entries(this.#owned)) {
        whole[name] = check(`state.${name}`, whole[name], made, markable);
      }
    });
    host.settings.prepare(machine, this.#entering(machine, whole), (error) => host.runtime.report(error), end);
    host.settings.show();
  }

  /** Brings back the settings, the seed and everything else as the figure opened. */
  startOver() {
    this.goBack(this.#opened);
    this.host.startedOver();
  }

  /** Brings back a whole state, as a step of the reader. @param {Values} [state] */
  goBack(state = this.#opened) {
    const { gesture, runtime } = this.host;
    runtime.attempt(() => {
      this.enter(state);
      gesture.step();
      gesture.commit();
    });
  }

  /**
   * @param {any} machine in a state
   * @param {Values} whole the state
   */
  *#entering(machine, whole) {
    const { host } = this;
    yield* host.complete(machine, whole);
    for (const name of Object.keys(this.own)) this.own[name] = whole[name];
    host.runtime.replace(machine);
    host.settings.arrive();
    host.machineChanged();
    this.#introduce(whole);
  }

  /** @param {Values} [state] that the machine is in, if it is not the opening */
  #introduce(state) {
    const { host } = this;
    host.stage.release();
    host.cloud?.introduce(state);
    this.#opened ??= { ...host.snapshot(), ...(host.cloud && { shown: 0, playing: true }) };
    host.refresh();
    host.reflection.tell();
    host.settings.show();
  }

  /**
   * Something of the element's own is to be another; it is checked.
   *
   * @param {string} name
   * @param {unknown} value
   */
  assign(name, value) {
    const { settings, cloud, reflection, stage } = this.host;
    // A state on its way has another value, and would come later.
    settings.takeUp();
    const { machine } = this.host;
    this.own[name] = this.#owned[name].check(name, value, machine, cloud?.markable ?? 0);
    reflection.tell();
    stage.wake();
  }
}
