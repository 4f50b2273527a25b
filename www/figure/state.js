/**
 * A widget's state as plain data: given and taken, kept over a removal and a trap, and carried by the
 * page's address where the author wants that.
 *
 * @module
 */

import { ConfigurableElement } from './settings.js';
import { addressWith, fragmentOf, goToAnchor, keyOf, writeFragment } from './link.js';
import { VERSION, object, pack, refusal, unpack, word } from './checks.js';

/**
 * @typedef {import('../types.d.ts').Motion} Motion
 *
 * @typedef {Record<string, any>} State plain data; which fields, the widget says
 */

/**
 * @template {import('./settings.js').Configured} Machine
 * @template {object} Settings
 * @extends {ConfigurableElement<Machine, Settings>}
 */
export class StatefulElement extends ConfigurableElement {
  /** The last good state. @type {State | undefined} */
  #kept;
  /** A state from the page's address that waits for the machine. @type {unknown} */
  #linked;
  #begun = false;
  /** The latest text for the address: an earlier one that is ready later is void. */
  #writing = 0;

  static get observedAttributes() {
    return [...super.observedAttributes, 'share'];
  }

  /**
   * Makes a machine in a state.
   *
   * @param {Motion} _motion
   * @param {State} [_state] that of the opening where there is none
   * @returns {Machine}
   * @throws {TypeError | RangeError} and there is none then
   */
  build(_motion, _state) {
    throw new Error('A widget builds its own machine.');
  }

  /** Everything that a reader can change, as the machine and the element have it. @returns {State} */
  snapshot() {
    return { widget: this.localName, version: VERSION };
  }

  /**
   * Checks what of a state the core does not.
   *
   * @param {State} state whole
   * @param {Machine} _machine in that state
   * @returns {State}
   * @throws {TypeError | RangeError}
   */
  checked(state, _machine) {
    return state;
  }

  /**
   * Takes up what of a state is not the machine's.
   *
   * @param {State} _state
   */
  adopt(_state) {}

  /**
   * Begins a machine's show.
   *
   * @param {State} [_state] that it is in, if it is not the opening
   */
  begin(_state) {}

  /**
   * A state that is given in part, with what follows of it for fields that are left out.
   *
   * @param {State} _present
   * @param {State} given
   * @returns {State}
   */
  completed(_present, given) {
    return given;
  }

  connectedCallback() {
    super.connectedCallback();
    addEventListener('hashchange', this.#follow);
    if (this.share) goToAnchor();
  }

  disconnectedCallback() {
    super.disconnectedCallback();
    removeEventListener('hashchange', this.#follow);
  }

  async prepare() {
    if (this.share && !this.#kept) this.#linked = await this.#readLink();
  }

  /** @param {Motion} motion */
  createMachine(motion) {
    return this.build(motion, this.#kept);
  }

  machineReady() {
    this.#begun = false;
    if (this.#kept) this.adopt(this.#kept);
    super.machineReady();
    const linked = this.#linked;
    this.#linked = undefined;
    if (linked !== undefined) this.tolerate(() => this.setState(linked));
    if (!this.machine) return;
    if (!this.#begun) this.begin(this.#kept);
    this.tell();
    this.refresh();
  }

  parting() {
    this.#kept = this.getState() ?? undefined;
  }

  refreshed() {
    this.#kept = this.snapshot();
    super.refreshed();
  }

  /** @param {'input' | 'change'} name */
  done(name) {
    super.done(name);
    if (name === 'change' && this.share) this.#writeLink();
  }

  /**
   * Everything that a reader can change, as plain data for `setState` and JSON. Of an element that is not
   * on the page, as it was when it left; null before it has come near the reader for the first time.
   *
   * @returns {State | null}
   */
  getState() {
    return this.ask(() => this.snapshot()) ?? this.#kept ?? null;
  }

  /**
   * Puts the element into a state. What is left out stays as it is.
   *
   * @param {unknown} state
   * @throws {TypeError | RangeError} that names the field, the value and what is allowed; nothing is changed then
   */
  setState(state) {
    this.whenReady('state', state, () => this.#enter(state));
  }

  /** @param {unknown} state */
  #enter(state) {
    const { machine, motion } = this;
    if (!machine || !motion) return;
    this.configure();
    const present = this.snapshot();
    const given = object('state', state, Object.keys(present));
    word('state.widget', given.widget, [this.localName]);
    if (given.version !== VERSION) throw refusal('state.version', given.version, String(VERSION));
    const whole = { ...present, ...this.completed(present, given) };
    const built = this.build(motion, whole);
    let next;
    try {
      next = this.checked(whole, built);
    } catch (error) {
      built.free();
      throw error;
    }
    this.machine = built;
    machine.free();
    this.adopt(next);
    this.stale = true;
    this.#begun = true;
    this.configured();
    this.begin(next);
    this.tell();
    this.refresh();
  }

  /** Whether the page's address carries the state. */
  get share() {
    return this.hasAttribute('share');
  }

  set share(share) {
    this.toggleAttribute('share', Boolean(share));
  }

  /**
   * @param {string} name
   * @param {string | null} old
   * @param {string | null} text
   */
  attributeChangedCallback(name, old, text) {
    super.attributeChangedCallback(name, old, text);
    if (name !== 'share') return;
    this.requestUpdate();
    if (old === null) this.#follow();
  }

  /** The page's address may carry another state. */
  #follow = async () => {
    if (!this.share || !this.machine) return;
    const linked = await this.#readLink();
    if (linked !== undefined) this.tolerate(() => this.setState(linked));
  };

  /** @returns {Promise<unknown>} undefined where the address has none */
  async #readLink() {
    const text = fragmentOf(keyOf(this));
    if (text === undefined) return undefined;
    try {
      return await unpack(text);
    } catch (error) {
      this.report(error);
      return undefined;
    }
  }

  async #writeLink() {
    const writing = ++this.#writing;
    const text = await pack(this.getState() ?? {});
    if (writing === this.#writing && this.isConnected) writeFragment(keyOf(this), text);
  }

  /**
   * The address of this page with the present state.
   *
   * @returns {Promise<string>}
   * @throws {Error} if the element does not heed the address
   */
  async shareLink() {
    if (!this.share) throw new Error('shareLink: the element lacks the attribute share, and would not heed the link.');
    return addressWith(keyOf(this), await pack(this.getState() ?? {}));
  }
}
