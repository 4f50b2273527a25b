/** The element's attributes and properties: taken from the page, and kept saying what the settings are. */

import { groupsOf, isSetting, renamed } from './attributes.js';
import { cloudProperties } from './cloud.js';
import { Part } from './part.js';

/**
 * @import { Attributes, Present, Setting } from './attributes.js'
 * @import { Figure } from './figure.js'
 *
 * @typedef {Map<string, string | null>} Texts of attributes; null for none
 */

export class Reflection extends Part {
  #attributes;
  /** The settings whose values decide what others open with. */
  #basis;
  /** What the page asked for before there was a machine, first by attributes. @type {Map<string, string | null>} */
  #early = new Map();
  /** @type {{ property: string, value: unknown, take: () => void }[]} */
  #wishes = [];
  /** Whether the attributes are being written, and a change of one is no news. */
  #writing = false;
  /** The attribute that is being read: what it says is not written over. @type {string | undefined} */
  #hearing;
  /** As the attributes tell it, or would. @type {Texts | undefined} */
  #told;

  /**
   * @param {Figure} host
   * @param {Attributes} attributes
   * @param {string[]} basis
   */
  constructor(host, attributes, basis) {
    super(host);
    this.#attributes = attributes;
    this.#basis = basis;
  }

  /** Takes up the properties that were set before the element was one. */
  hostConnected() {
    const host = /** @type {Record<string, unknown>} */ (/** @type {unknown} */ (this.host));
    for (const name of Object.keys(host)) {
      for (let at = Object.getPrototypeOf(host); at !== HTMLElement.prototype; at = Object.getPrototypeOf(at)) {
        if (!Object.getOwnPropertyDescriptor(at, name)?.set) continue;
        const value = host[name];
        delete host[name];
        host[name] = value;
        break;
      }
    }
  }

  /** Takes up what the page asked for before there was a machine. */
  catchUp() {
    // In the order of the table: what others depend on comes first.
    for (const name of Object.keys(this.#attributes)) {
      const text = this.#early.get(name);
      if (text !== undefined) this.#take(name, text);
    }
    this.#early.clear();
    for (const { take } of this.#wishes.splice(0)) this.host.runtime.tolerate(take);
  }

  /**
   * Does something with the machine, now or as soon as there is one.
   *
   * @param {string} property
   * @param {unknown} value
   * @param {() => void} take
   */
  whenReady(property, value, take) {
    if (this.host.machine) this.host.runtime.attempt(take);
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

  /**
   * An attribute says something else.
   *
   * @param {string} attribute in lower case
   * @param {string | null} text
   */
  hear(attribute, text) {
    const name = Object.keys(this.#attributes).find((key) => key.toLowerCase() === attribute);
    if (this.#writing || name === undefined) return;
    if (this.host.machine) this.#take(name, text);
    else this.#early.set(name, text);
  }

  /**
   * @param {string} name
   * @param {string | null} text
   */
  #take(name, text) {
    const { machine } = this.host;
    if (!machine) return;
    const entry = this.#attributes[name];
    const given = text === null ? undefined : entry.kind.parse(text);
    this.#hearing = name;
    this.host.runtime.tolerate(() => {
      if (!isSetting(entry)) Reflect.set(this.host, name, text === null ? this.#usual(name) : given);
      else this.assign(name, entry, text === null ? this.#opening((opening) => entry.get(opening)) : given);
    });
    this.#hearing = undefined;
  }

  /**
   * Gives a setting another value.
   *
   * @param {string} name that it is asked for by
   * @param {Setting} setting
   * @param {unknown} value
   * @throws {TypeError | RangeError} in that name
   */
  assign(name, setting, value) {
    try {
      this.host.settings.assign(setting.change(value, this.#present));
    } catch (error) {
      throw renamed(error, name, setting);
    }
  }

  /** @returns {Present} */
  get #present() {
    return { config: this.host.settings.wanted, machine: this.host.machine };
  }

  /** What something of the element's own is when the widget opens. @param {string} name */
  #usual(name) {
    const entry = this.#attributes[name];
    return isSetting(entry) ? undefined : (entry.opening ?? this.host.state.opening(name));
  }

  /**
   * Asks something of how the widget opens, as far as that depends on the present settings.
   *
   * @template Answer
   * @param {(opening: Present) => Answer} question
   */
  #opening(question) {
    const { wanted } = this.host.settings;
    const machine = this.host.createMachine(this.host.motion);
    try {
      machine.configure(Object.fromEntries(this.#basis.map((key) => [key, wanted[key]])));
      return question({ config: machine.config, machine });
    } finally {
      machine.free();
    }
  }

  /**
   * What the attributes should say.
   *
   * @param {Present} present
   * @param {(name: string) => unknown} own what the element itself has by that name
   */
  #texts(present, own) {
    return new Map(
      Object.entries(this.#attributes).map(([name, entry]) => {
        const value = isSetting(entry) ? entry.get(present) : own(name);
        return [name, entry.kind.print(value ?? null)];
      }),
    );
  }

  get #now() {
    return this.#texts(this.#present, (name) => Reflect.get(this.host, name));
  }

  /** Lets the attributes say what has changed. The first time nothing has: so the element opens. */
  tell() {
    this.host.runtime.attempt(() => {
      if (this.host.machine) this.#tell(this.#now);
    });
  }

  /** @param {Texts} texts */
  #tell(texts) {
    const told = this.#told;
    this.#told = texts;
    if (!told) return;
    const changed = new Set([...texts.keys()].filter((name) => texts.get(name) !== told.get(name)));
    for (const [name, entry] of Object.entries(this.#attributes)) {
      if (texts.get(name) !== null || !changed.has(name)) continue;
      for (const covered of entry.covers?.(null) ?? []) changed.add(covered);
    }
    if (this.#hearing) changed.delete(this.#hearing);
    this.#writing = true;
    for (const name of changed) {
      const text = texts.get(name) ?? null;
      if (text === null) this.host.removeAttribute(name);
      else this.host.setAttribute(name, text);
    }
    this.#writing = false;
  }

  /** The attributes that a figure needs which opens otherwise. @returns {[string, string][]} */
  needed() {
    const texts = this.#now;
    const usual = this.#opening((opening) => this.#texts(opening, (name) => this.#usual(name)));
    /** @type {Set<string>} */
    const covered = new Set();
    /** @type {[string, string][]} */
    const needed = [];
    for (const [name, entry] of Object.entries(this.#attributes)) {
      const text = texts.get(name) ?? null;
      if (text === null) continue;
      if (text !== usual.get(name) && !covered.has(name)) needed.push([name, text]);
      for (const each of entry.covers?.(text) ?? []) covered.add(each);
    }
    return needed;
  }
}

/**
 * Whether a value is, part for part, as it was given.
 *
 * @param {any} present
 * @param {any} given
 * @returns {boolean}
 */
export function has(present, given) {
  if (Object.is(present, given)) return true;
  if (typeof present !== 'object' || typeof given !== 'object' || !present || !given || present.length !== given.length) return false;
  return Object.keys(given).every((key) => has(present[key], given[key]));
}

/**
 * Gives a widget's class the properties of its settings, and of what is the element's own and has an attribute, and
 * defines it, unless the page has it already: it may carry the script twice.
 *
 * @param {string} tag
 * @param {typeof import('./figure.js').FigureElement<any, any>} Widget
 */
export function define(tag, Widget) {
  if (customElements.get(tag)) return;
  const { prototype, attributes, declared, own } = Widget;
  const property = (/** @type {string} */ name, /** @type {PropertyDescriptor & ThisType<any>} */ accessors) =>
    Object.defineProperty(prototype, name, { configurable: true, enumerable: true, ...accessors });
  for (const [name, entry] of Object.entries({ ...attributes, ...groupsOf(declared) })) {
    if (isSetting(entry)) {
      property(name, {
        get() {
          if (!this.machine) return this.reflection.wished(name);
          return this.ask((/** @type {any} */ machine) => entry.get({ config: machine.config, machine }));
        },
        set(value) {
          this.reflection.whenReady(name, value, () => this.reflection.assign(name, entry, value));
        },
      });
    } else if (name in own) {
      property(name, {
        get() {
          return this.state.copy(name);
        },
        set(value) {
          this.state.assign(name, value);
          this.reflection.tell();
          this.stage.wake();
        },
      });
    }
  }
  if ('marked' in own) Object.defineProperties(prototype, cloudProperties);
  customElements.define(tag, Widget);
}
