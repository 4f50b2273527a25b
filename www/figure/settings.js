/**
 * A widget's settings as a page has them: attributes, properties and events.
 *
 * @module
 */

import { WORD, isSetting, plain, propertyOf } from './attributes.js';
import { WidgetElement } from './figure.js';
import { Gesture } from './gesture.js';
import { Reflection } from './reflection.js';
import { THEMES } from './page/scheme.js';
import { embedding } from './link.js';
import { word } from './checks.js';

/**
 * @typedef {import('../types.d.ts').Motion} Motion
 * @typedef {import('./attributes.js').Attributes} Attributes
 * @typedef {import('./attributes.js').Setting} Setting
 *
 * @typedef {object} Configured
 * @property {() => void} free
 * @property {object} config
 * @property {object} stats
 * @property {(settings: any) => void} configure
 * @property {(settings: any) => void} [begin] as configure, where a large cloud may take longer than a frame
 * @property {(samples: number) => boolean} [advance] goes on with what was begun; whether it is done
 */

/** Longest work in a frame, milliseconds: with the pictures, a touch is answered within 50. */
const LONGEST_WORK = 25;

/** Samples between two looks at the clock: a millisecond's work, ten on a slow phone. */
const SLICE = 50_000;

/**
 * @template {Configured} Machine
 * @template {object} Settings
 * @extends {WidgetElement<Machine>}
 */
export class ConfigurableElement extends WidgetElement {
  /** Attributes with properties of their own. @type {Attributes} */
  static attributes = {};

  /** Settings that are no text, and have a property alone. @type {string[]} */
  static settings = [];

  /** Whether the machine has to be asked again. */
  stale = true;
  /** @type {Partial<Settings>} the reader's changes that wait for the next frame */
  #pending = {};
  /** What the page asked for before there was a machine, first by attributes. @type {Map<string, string | null>} */
  #early = new Map();
  /** @type {{ property: string, value: unknown, take: () => void }[]} */
  #wishes = [];
  #gesture = new Gesture((name) => this.done(name));
  #reflection = new Reflection(this, this.#attributes);
  #refreshing = false;
  /** Whether the machine is in the middle of what it has begun. */
  #working = false;

  static get observedAttributes() {
    return [...super.observedAttributes, ...Object.keys(this.attributes), 'theme'];
  }

  /**
   * The settings that the widget opens with.
   *
   * @param {Motion} _motion
   * @param {Settings} _config the present ones, where others depend on them
   * @returns {Settings}
   */
  opening(_motion, _config) {
    throw new Error('A widget has an opening.');
  }

  /** Called when other settings have taken effect. */
  configured() {}

  /** Asks the machine for everything that is shown. */
  read() {}

  connectedCallback() {
    this.#takeOver();
    super.connectedCallback();
  }

  machineReady() {
    this.stale = true;
    this.#working = false;
    this.#pending = {};
    // In the order of the table: what others depend on comes first.
    for (const name of Object.keys(this.#attributes)) {
      const text = this.#early.get(name);
      if (text !== undefined) this.#takeAttribute(name, text);
    }
    this.#early.clear();
    for (const { take } of this.#wishes.splice(0)) this.tolerate(() => this.attempt(take));
  }

  /** Properties that were set before the element was one. */
  #takeOver() {
    const self = /** @type {Record<string, unknown>} */ (/** @type {unknown} */ (this));
    for (const name of Object.keys(this)) {
      for (let at = Object.getPrototypeOf(this); at !== HTMLElement.prototype; at = Object.getPrototypeOf(at)) {
        if (!Object.getOwnPropertyDescriptor(at, name)?.set) continue;
        const value = self[name];
        delete self[name];
        self[name] = value;
        break;
      }
    }
  }

  get #attributes() {
    return /** @type {typeof ConfigurableElement} */ (this.constructor).attributes;
  }

  /** The settings with the changes that wait. @returns {Settings} */
  wanted() {
    const { config } = /** @type {Machine} */ (this.machine);
    return /** @type {Settings} */ ({ ...config, ...this.#pending });
  }

  /**
   * Wants other settings from the next frame on: a drag costs one configuration a frame. For what the
   * reader does.
   *
   * @param {Partial<Settings> | ((wanted: Settings) => Partial<Settings>)} change
   */
  change(change) {
    this.attempt(() => {
      if (!this.machine) return;
      Object.assign(this.#pending, typeof change === 'function' ? change(this.wanted()) : change);
      this.touch();
    });
  }

  /** The reader has changed something, and it may go on. */
  touch() {
    this.#gesture.step();
    this.wake();
  }

  /** What the reader changed has come to rest. */
  rest() {
    this.#gesture.end();
    this.wake();
  }

  /** @param {'input' | 'change'} name of what the reader has done */
  done(name) {
    if (name === 'change') this.tell();
    this.dispatchEvent(new Event(name, { bubbles: true, composed: true }));
  }

  /** Puts the changes that wait into effect. One that is refused is reported and forgotten. */
  configure() {
    this.#proceed(Infinity);
    if (!this.machine || Object.keys(this.#pending).length === 0) return;
    const pending = this.#pending;
    this.#pending = {};
    this.tolerate(() => this.#apply(pending));
  }

  /**
   * As `configure`, for no longer than a frame may take.
   *
   * @returns {boolean} whether all is in effect
   */
  settle() {
    const { machine } = this;
    if (!machine?.begin) {
      this.configure();
      return true;
    }
    if (!this.#working && Object.keys(this.#pending).length > 0) {
      const pending = this.#pending;
      this.#pending = {};
      this.tolerate(() => {
        machine.begin?.(pending);
        this.work();
        this.configured();
        this.tell();
      });
    }
    return this.#proceed(LONGEST_WORK);
  }

  /** To be called when the machine has begun something that `settle` is to go on with. */
  work() {
    this.#working = true;
  }

  /**
   * @param {number} limit milliseconds
   * @returns {boolean} whether nothing is left to do
   */
  #proceed(limit) {
    if (!this.#working) return true;
    const end = performance.now() + limit;
    while (this.machine?.advance?.(SLICE) === false) {
      if (performance.now() > end) return false;
    }
    this.#working = false;
    this.stale = true;
    return true;
  }

  /** @param {Partial<Settings>} settings */
  #apply(settings) {
    this.machine?.configure(settings);
    this.stale = true;
    this.configured();
    this.tell();
  }

  /**
   * Other settings, at once. For what the page does.
   *
   * @param {Partial<Settings>} settings
   * @throws {TypeError | RangeError} and nothing is changed
   */
  assign(settings) {
    this.attempt(() => {
      this.configure();
      this.#apply(settings);
      this.refresh();
    });
  }

  /**
   * Does something with the machine, now or as soon as there is one.
   *
   * @param {string} property
   * @param {unknown} value
   * @param {() => void} take
   */
  whenReady(property, value, take) {
    if (this.machine) this.attempt(take);
    else this.#wishes.push({ property, value, take });
  }

  /**
   * What a property will be that was set before there was a machine; undefined if it was not.
   *
   * @param {string} property
   */
  wished(property) {
    return this.#wishes.findLast((wish) => wish.property === property)?.value;
  }

  /** Shows what the page changed, also to one who listens while the element is out of sight. */
  refresh() {
    this.wake();
    if (this.inSight || this.#refreshing) return;
    this.#refreshing = true;
    queueMicrotask(() => {
      this.#refreshing = false;
      if (this.stale && !this.inSight) this.attempt(() => this.read());
    });
  }

  /** To be called when there are fresh figures. */
  refreshed() {
    const { stats } = /** @type {Machine} */ (this.machine);
    this.dispatchEvent(new CustomEvent('stats', { detail: stats, bubbles: true, composed: true }));
  }

  /** @param {() => void} work what may refuse: an error is reported, and all is as it was */
  tolerate(work) {
    try {
      work();
    } catch (error) {
      if (!(error instanceof TypeError || error instanceof RangeError)) throw error;
      this.report(error);
    }
  }

  /** The figures of the cloud as it is; null before there is one. */
  get stats() {
    return this.ask((machine) => machine.stats);
  }

  /**
   * @template Answer
   * @param {(machine: Machine) => Answer} question
   * @returns {Answer | null} null where there is no machine
   */
  ask(question) {
    const answer = this.attempt(() => {
      this.configure();
      return this.machine && question(this.machine);
    });
    return answer ?? null;
  }

  get theme() {
    return THEMES.find((theme) => theme === this.getAttribute('theme')) ?? 'auto';
  }

  set theme(theme) {
    this.setAttribute('theme', word('theme', theme, THEMES));
  }

  /**
   * @param {string} name
   * @param {string | null} old
   * @param {string | null} text
   */
  attributeChangedCallback(name, old, text) {
    super.attributeChangedCallback(name, old, text);
    if (this.#reflection.writing || old === text) return;
    if (name === 'theme') {
      if (text !== null) this.tolerate(() => word('theme', text, THEMES));
      this.requestUpdate();
      this.repaint();
    } else if (this.machine && name in this.#attributes) {
      this.#takeAttribute(name, text);
    } else if (name in this.#attributes) {
      this.#early.set(name, text);
    }
  }

  /**
   * @param {string} name
   * @param {string | null} text
   */
  #takeAttribute(name, text) {
    const { machine, motion } = this;
    const entry = this.#attributes[name];
    if (!machine || !motion) return;
    const take = () => {
      if (!isSetting(entry)) {
        Reflect.set(this, name, text === null ? this.usual[name] : entry.kind.read(text));
        return;
      }
      const config = this.wanted();
      const value = text === null ? entry.get(this.opening(motion, config), motion) : entry.kind.read(text);
      this.assign(/** @type {Partial<Settings>} */ (entry.change(value, config, motion)));
    };
    this.#reflection.hearing = name;
    this.tolerate(() => this.attempt(take));
    this.#reflection.hearing = undefined;
  }

  texts() {
    return this.#reflection.texts(this.wanted(), this.motion);
  }

  /** Lets the attributes say what has changed. */
  tell() {
    this.attempt(() => {
      if (this.machine) this.#reflection.tell(this.texts());
    });
  }

  /** Something of the element itself was changed by the page. */
  retell() {
    this.tell();
    this.wake();
  }

  /** What the attributes that are no settings say when the widget opens. @returns {Record<string, unknown>} */
  get usual() {
    return {};
  }

  /** HTML that shows the figure as it is now, on another page. @returns {string} */
  embedCode() {
    const { machine, motion, localName } = this;
    const own = ['theme', 'lang', 'dir'].map((name) => /** @type {[string, string]} */ ([name, this.getAttribute(name) ?? '']));
    const told = own.filter(([, text]) => text !== '');
    if (!machine || !motion) return embedding(localName, told);
    const usual = this.#reflection.texts(this.opening(motion, this.wanted()), motion);
    for (const [name, value] of Object.entries(this.usual)) usual.set(name, this.#attributes[name].kind.write(value));
    return embedding(localName, [...told, ...this.#reflection.needed(this.texts(), usual)]);
  }
}

/**
 * Gives a class the properties of its attributes and defines it, unless the page has it already: it may
 * carry the script twice.
 *
 * @param {string} name
 * @param {CustomElementConstructor & { attributes: Attributes, settings: string[] }} Class
 */
export function define(name, Class) {
  if (customElements.get(name)) return;
  for (const [attribute, entry] of Object.entries(Class.attributes)) {
    if (isSetting(entry)) defineSetting(Class.prototype, propertyOf(attribute, entry), entry);
  }
  for (const key of Class.settings) defineSetting(Class.prototype, key, plain(key, WORD));
  customElements.define(name, Class);
}

/**
 * @param {ConfigurableElement<any, any>} prototype
 * @param {string} property
 * @param {Setting} entry
 */
function defineSetting(prototype, property, { get, change }) {
  Object.defineProperty(prototype, property, {
    configurable: true,
    enumerable: true,
    /** @this {ConfigurableElement<any, any>} */
    get() {
      const { motion } = this;
      return motion && this.machine ? this.attempt(() => get(this.wanted(), motion)) : this.wished(property);
    },
    /** @this {ConfigurableElement<any, any>} */
    set(value) {
      this.whenReady(property, value, () => this.assign(change(value, this.wanted(), this.motion)));
    },
  });
}
