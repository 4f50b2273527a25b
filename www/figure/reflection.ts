/** The element's attributes and properties: taken from the page, and kept saying what the settings are. */

import { COMMON, groupsOf, isSetting } from './attributes.ts';
import { includesFields, renamed, word } from './checks.ts';
import { cloudProperties } from './cloud.ts';
import { Part } from './part.ts';
import type { Attributes, Config, Setting } from './attributes.ts';
import type { Figure } from './figure.ts';

/** Texts of attributes; null for none. */
export type Texts = Map<string, string | null>;

export class Reflection extends Part {
  #attributes;
  /** With the settings that have no attribute. */
  #entries: Attributes;
  /** Names in the order of the table, a group before its parts. */
  #order;
  /** The settings whose values decide what others open with. */
  #defaultsDependOn;
  /** Settings that the widget opens with, by those of the basis. */
  #defaultConfigs: Map<string, Config> = new Map();
  /** Attributes that the page gave before there was a machine. */
  #pendingAttributes: Map<string, string | null> = new Map();
  /** By their properties; whole states under keys of their own. */
  #pendingProperties: Map<unknown, { value?: unknown, take: () => void }> = new Map();
  /** Whether the attributes are being written, and a change of one is no news. */
  #isWriting = false;
  /** The attribute that is being read: what it says is not written over. */
  #incoming: string | undefined;
  /** As the attributes tell it, or would. */
  #written: Texts | undefined;

  constructor(host: Figure, attributes: Attributes, defaultsDependOn: string[]) {
    super(host);
    this.#attributes = attributes;
    this.#entries = { ...groupsOf(host.kind.declared), ...attributes };
    // A preset leaves a map, a map puts the robot somewhere, and a sample is marked of as many as there are; a log
    // takes long, and whatever comes while it does would wait for it.
    this.#order = ['preset', 'map', ...host.kind.declared.map(({ key }) => key), ...Object.keys(attributes), 'marked', 'log'];
    this.#defaultsDependOn = defaultsDependOn;
  }

  /** Takes up the properties that were set before the element was one. */
  hostConnected() {
    const host = this.host as unknown as Record<string, unknown>;
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
  applyPending() {
    // In the order of the table: what others depend on comes first.
    for (const name of Object.keys(this.#attributes)) {
      const text = this.#pendingAttributes.get(name);
      if (text !== undefined) this.#apply(name, text);
    }
    this.#pendingAttributes.clear();
    // Properties too, in whatever order they were given; but a state is entered when it came.
    let since = 0;
    const pending = [...this.#pendingProperties].map(([name, { take }]) =>
      ({ take, when: typeof name === 'string' ? since + this.#order.indexOf(name) : (since += this.#order.length) }));
    this.#pendingProperties.clear();
    pending.sort((one, other) => one.when - other.when);
    for (const { take } of pending) this.host.runtime.attemptOrReport(take);
  }

  /** Enters a state, now or as soon as there is a machine. */
  whenReady(enter: () => void) {
    if (this.host.machine) this.host.runtime.attempt(enter);
    else this.#pendingProperties.set({}, { take: enter });
  }

  /**
   * The page gives a property a value, as a text too where an attribute says it; null or undefined for what the figure opens
   * with. What it has already changes nothing, so that a page may give it again and again. What is refused is reported, and
   * the last good value stays.
   */
  setProperty(name: string, value: any, take: (value: any) => void) {
    const entry = this.#entries[name];
    const given = typeof value === 'string' && entry?.kind ? entry.kind.parse(value) : value;
    const taken = () => {
      const wanted = given ?? this.#defaultOf(name) ?? null;
      const setting = entry && isSetting(entry) ? entry : undefined;
      const present = setting ? setting.get(this.host.settings.wanted) : Reflect.get(this.host, name);
      // A part of a setting's group leaves the others as they are; of the element's own a part is another whole.
      if (!includesFields(present, wanted) || (!setting && !includesFields(wanted, present))) take(wanted);
    };
    if (this.host.machine) {
      this.host.runtime.attemptOrReport(taken);
    } else {
      // The latest is the last: what others depend on may have been given meanwhile.
      this.#pendingProperties.delete(name);
      this.#pendingProperties.set(name, { value: given, take: taken });
    }
  }

  /** Value of a property that was given before there was a machine; undefined if none was. */
  pendingValue(name: string) {
    return this.#pendingProperties.get(name)?.value;
  }

  /** Says a property that every figure has by its attribute, or by none. */
  setAttribute(attribute: string, value: unknown) {
    const { host } = this;
    const { words, property = attribute } = COMMON[attribute] as { words: readonly string[], property?: string };
    if (value === null || value === undefined) host.removeAttribute(attribute);
    else host.runtime.attemptOrReport(() => host.setAttribute(attribute, word(property, typeof value === 'number' ? String(value) : value, words)));
  }

  /**
   * An attribute says something else.
   *
   * @param attribute in lower case
   */
  attributeChanged(attribute: string, text: string | null) {
    const { words } = COMMON[attribute] ?? {};
    if (words && text !== null) this.host.runtime.attemptOrReport(() => word(attribute, text, words));
    const name = Object.keys(this.#attributes).find((key) => key.toLowerCase() === attribute);
    if (this.#isWriting || name === undefined) return;
    if (this.host.machine) this.#apply(name, text);
    else this.#pendingAttributes.set(name, text);
  }

  #apply(name: string, text: string | null) {
    this.#incoming = name;
    try {
      Reflect.set(this.host, name, text);
    } finally {
      this.#incoming = undefined;
    }
  }

  /**
   * Gives a setting another value.
   *
   * @param name that it is asked for by
   * @throws {TypeError | RangeError} in that name
   */
  assign(name: string, setting: Setting, value: unknown) {
    try {
      this.host.settings.assign(setting.change(value, this.host.settings.wanted));
    } catch (error) {
      throw renamed(error, name, setting.path);
    }
  }

  /** Opening value of a property. */
  #defaultOf(name: string) {
    const entry = this.#entries[name];
    if (entry && isSetting(entry)) return entry.get(this.#defaultConfig(this.#defaultsDependOn.includes(name) ? [] : this.#defaultsDependOn));
    return entry?.opening ?? this.host.state.opening(name);
  }

  /** Learns the settings that the widget opens with, of a machine that has just opened. */
  rememberDefaults(opening: Config) {
    for (const basis of [[], this.#defaultsDependOn]) this.#defaultConfigs.set(partOf(opening, basis), opening);
  }

  /**
   * Returns the settings that the widget opens with.
   *
   * @param basis settings that are as they are at present, and that others depend on
   */
  #defaultConfig(basis: string[]): Config {
    const { settings, motion } = this.host;
    const part = partOf(settings.wanted, basis);
    const known = this.#defaultConfigs.get(part);
    if (known) return known;
    const machine = this.host.createMachine(motion);
    const given = JSON.parse(part);
    // Nobody sees its samples.
    const opening = this.host.cloud ? machine.configureFirst(given, 0) : machine.configure(given);
    machine.free();
    this.#defaultConfigs.set(part, opening);
    return opening;
  }

  /**
   * What the attributes should say.
   *
   * @param own what the element itself has by that name
   */
  #texts(config: Config, own: (name: string) => unknown) {
    return new Map(
      Object.entries(this.#attributes).map(([name, entry]) => {
        const value = isSetting(entry) ? entry.get(config) : own(name);
        return [name, entry.kind.print(value ?? null)];
      }),
    );
  }

  get #currentTexts() {
    return this.#texts(this.host.settings.wanted, (name) => Reflect.get(this.host, name));
  }

  /** Lets the attributes say what has changed. The first time nothing has: so the element opens. */
  updateAttributes() {
    this.host.runtime.attempt(() => {
      if (this.host.machine) this.#write(this.#currentTexts);
    });
  }

  #write(texts: Texts) {
    const written = this.#written;
    this.#written = texts;
    if (!written) return;
    const changed = new Set([...texts.keys()].filter((name) => texts.get(name) !== written.get(name)));
    for (const [name, entry] of Object.entries(this.#attributes)) {
      if (!entry.covers || texts.get(name) !== null || !changed.has(name)) continue;
      const defaults = this.#defaultTexts;
      for (const covered of entry.covers(null)) if (texts.get(covered) !== defaults.get(covered)) changed.add(covered);
    }
    this.#isWriting = true;
    for (const name of changed) {
      if (name === this.#incoming) continue;
      const text = texts.get(name) ?? null;
      if (text === null) this.host.removeAttribute(name);
      else this.host.setAttribute(name, text);
    }
    this.#isWriting = false;
  }

  /** Texts of the attributes when the widget opens. */
  get #defaultTexts() {
    const defaults = this.#texts(this.#defaultConfig(this.#defaultsDependOn), (name) => this.#defaultOf(name));
    for (const name of this.#defaultsDependOn) defaults.set(name, this.#attributes[name].kind.print(this.#defaultOf(name)));
    return defaults;
  }

  /** The attributes that a figure needs which opens otherwise. */
  nonDefaultAttributes(): [string, string][] {
    const texts = this.#currentTexts;
    const defaults = this.#defaultTexts;
    const covered: Set<string> = new Set();
    const needed: [string, string][] = [];
    for (const [name, entry] of Object.entries(this.#attributes)) {
      const text = texts.get(name) ?? null;
      if (text === null) continue;
      if (text !== defaults.get(name) && !covered.has(name)) needed.push([name, text]);
      entry.covers?.(text).forEach((each) => covered.add(each));
    }
    return needed;
  }
}

/** Returns some of the settings as JSON. */
const partOf = (config: Config, keys: string[]) => JSON.stringify(Object.fromEntries(keys.map((key) => [key, config[key]])));

/**
 * Gives a widget's class the properties of its settings, and of what is the element's own and has an attribute, and
 * defines it, unless the page has it already: it may carry the script twice.
 */
export function define(tag: string, Widget: typeof import('./figure.ts').FigureElement<any, any>) {
  if (customElements.get(tag)) return;
  const { prototype, attributes, declared, own } = Widget;
  const property = (name: string, accessors: PropertyDescriptor & ThisType<any>) =>
    Object.defineProperty(prototype, name, { configurable: true, enumerable: true, ...accessors });
  for (const [name, entry] of Object.entries({ ...attributes, ...groupsOf(declared) })) {
    if (isSetting(entry)) {
      property(name, {
        get() {
          if (!this.machine) return this.reflection.pendingValue(name);
          // That is known before anything is computed with it.
          return this.runtime.attempt(() => {
            this.settings.settle();
            return this.machine && entry.get(this.settings.present);
          }) ?? null;
        },
        set(value) {
          this.reflection.setProperty(name, value, (given: unknown) => this.reflection.assign(name, entry, given));
        },
      });
    } else if (name in own) {
      property(name, {
        get() {
          return this.reflection.pendingValue(name) ?? this.state.copy(name);
        },
        set(value) {
          this.reflection.setProperty(name, value, (given: unknown) => this.state.assign(name, given));
        },
      });
    }
  }
  if ('marked' in own) Object.defineProperties(prototype, cloudProperties);
  customElements.define(tag, Widget);
}
