/** Synchronization of attributes and properties with the settings: values of the page are applied, and changed settings are written as attributes. */

import { COMMON, defaultConfig, groupsOf, isSetting } from './attributes.ts';
import { includesFields, renamed, word } from './checks.ts';
import { cloudProperties } from './cloud.ts';
import { Part } from './part.ts';
import type { Attributes, Config, Setting } from './attributes.ts';
import type { Figure } from './figure.ts';

/** Texts of attributes; null for none. */
export type Texts = Map<string, string | null>;

export class Reflection extends Part {
  #attributes = this.host.kind.attributes;
  /** Attributes, and settings that have a property but no attribute. */
  #entries: Attributes = { ...groupsOf(this.host.kind.declared), ...this.#attributes };
  /** Order in which pending properties are applied. Properties that others depend on come first, and a log, which takes long, last. */
  #order = ['preset', 'map', ...this.host.kind.declared.map(({ key }) => key), ...Object.keys(this.#attributes), 'marked', 'log'];
  /** Attributes that were set before there was a machine. */
  #pendingAttributes: Map<string, string | null> = new Map();
  /** Properties, by name, and states that were set before there was a machine. The key of a state is a new object, so that no state replaces another. */
  #pendingProperties: Map<unknown, { value?: unknown, apply: () => void }> = new Map();
  /** True from the first connection on: a figure that is moved keeps its settings. */
  #hasConnected = false;
  /** True while this class writes attributes. */
  #isWriting = false;
  /** Attribute that is being applied; its text is not overwritten. */
  #incoming: string | undefined;
  /** Texts as last written. */
  #written: Texts | undefined;

  /** Applies properties that were set before the element was upgraded, or that a server wrote as text. */
  hostConnected() {
    const host = this.host as unknown as Record<string, unknown>;
    if (!this.#hasConnected) this.#takeUpLists(host);
    this.#hasConnected = true;
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

  /** Takes lists from text as servers write it, such as `alphas="0.1,0.2"`. The property refuses and reports any other text. */
  #takeUpLists(host: Record<string, unknown>) {
    for (const name of Object.keys(this.#entries)) {
      const text = name in this.#attributes ? null : this.host.getAttribute(name);
      if (text === null || Object.hasOwn(host, name)) continue;
      const numbers = text.split(/[\s,]+/).map(Number);
      host[name] = numbers.every(Number.isFinite) ? numbers : text;
    }
  }

  /** Applies attributes and properties that were set before there was a machine. */
  applyPending() {
    for (const name of Object.keys(this.#attributes)) {
      const text = this.#pendingAttributes.get(name);
      if (text !== undefined) this.#apply(name, text);
    }
    this.#pendingAttributes.clear();
    // Properties between two states are sorted by dependency. States keep their order in time.
    let since = 0;
    const pending = [...this.#pendingProperties].map(([name, { apply }]) =>
      ({ apply, when: typeof name === 'string' ? since + this.#order.indexOf(name) : (since += this.#order.length) }));
    this.#pendingProperties.clear();
    pending.sort((one, other) => one.when - other.when);
    for (const { apply } of pending) this.host.runtime.attemptOrReport(apply);
  }

  /** Applies a state, now or as soon as there is a machine. */
  whenReady(enter: () => void) {
    if (this.host.machine) this.host.runtime.attempt(enter);
    else this.#pendingProperties.set({}, { apply: enter });
  }

  /** Sets a property to a value or to its text. Null or undefined sets the default. A value that is refused is reported. */
  setProperty(name: string, value: any, apply: (value: any) => void) {
    const entry = this.#entries[name];
    const given = typeof value === 'string' && entry?.kind ? entry.kind.parse(value) : value;
    const applyIfChanged = () => {
      const wanted = given ?? this.#defaultOf(name) ?? null;
      const setting = entry && isSetting(entry) ? entry : undefined;
      const current = setting ? setting.get(this.host.settings.wanted) : Reflect.get(this.host, name);
      // A group of settings may be given in part. A value of the element itself is replaced as a whole.
      if (!includesFields(current, wanted) || (!setting && !includesFields(wanted, current))) apply(wanted);
    };
    if (this.host.machine) {
      this.host.runtime.attemptOrReport(applyIfChanged);
    } else {
      // The latest assignment is applied last.
      this.#pendingProperties.delete(name);
      this.#pendingProperties.set(name, { value: given, apply: applyIfChanged });
    }
  }

  /** Returns the value of a property that waits for the machine; undefined for none. */
  pendingValue(name: string) {
    return this.#pendingProperties.get(name)?.value;
  }

  /** Sets an attribute that every figure has, after a check; null or undefined removes it. */
  setAttribute(attribute: string, value: unknown) {
    const { host } = this;
    const { words, property = attribute } = COMMON[attribute] as { words: readonly string[], property?: string };
    if (value === null || value === undefined) host.removeAttribute(attribute);
    else host.runtime.attemptOrReport(() => host.setAttribute(attribute, word(property, typeof value === 'number' ? String(value) : value, words)));
  }

  /** Applies an attribute's new text. The name is in lower case. */
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

  /** Changes a setting; an error names it by the name that the caller used. */
  assign(name: string, setting: Setting, value: unknown) {
    try {
      this.host.settings.assign(setting.change(value, this.host.settings.wanted));
    } catch (error) {
      throw renamed(error, name, setting.path);
    }
  }

  /** Default settings. Some depend on the present settings. */
  get #defaultConfig(): Config {
    const { kind, settings } = this.host;
    return { ...defaultConfig(kind.declared), ...kind.dependentDefaults?.(settings.wanted) };
  }

  /** Returns the default of a property. */
  #defaultOf(name: string) {
    const entry = this.#entries[name];
    if (entry && isSetting(entry)) return entry.get(this.#defaultConfig);
    return entry?.opening ?? this.host.state.opening(name);
  }

  /** Returns the texts of all attributes, of the values that `valueOf` returns. */
  #textsOf(valueOf: (name: string) => unknown): Texts {
    return new Map(Object.entries(this.#attributes).map(([name, { kind }]) => [name, kind.print(valueOf(name) ?? null)]));
  }

  get #currentTexts() {
    const { host } = this;
    const { wanted } = host.settings;
    return this.#textsOf((name) => {
      const entry = this.#attributes[name];
      return isSetting(entry) ? entry.get(wanted) : Reflect.get(host, name);
    });
  }

  /** Texts of the attributes with default settings. */
  get #defaultTexts() {
    return this.#textsOf((name) => this.#defaultOf(name));
  }

  /** Writes the attributes that have changed; the first call only remembers their texts. */
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

  /** Returns the attributes that a new figure needs to open in the present state. */
  nonDefaultAttributes(): [string, string][] {
    const texts = this.#currentTexts;
    const defaults = this.#defaultTexts;
    const covered: Set<string> = new Set();
    const attributes: [string, string][] = [];
    for (const [name, entry] of Object.entries(this.#attributes)) {
      const text = texts.get(name) ?? null;
      if (text === null) continue;
      if (text !== defaults.get(name) && !covered.has(name)) attributes.push([name, text]);
      entry.covers?.(text).forEach((each) => covered.add(each));
    }
    return attributes;
  }
}

/** Defines a widget's element with a property for each setting. If the page loads the script twice, the second call does nothing. */
export function define(tag: string, Widget: typeof import('./figure.ts').FigureElement<any, any>) {
  if (customElements.get(tag)) return;
  const { prototype, definition: { attributes, declared, own } } = Widget;
  for (const [name, entry] of Object.entries({ ...attributes, ...groupsOf(declared) })) {
    if (!isSetting(entry) && !(name in own)) continue;
    Object.defineProperty(prototype, name, {
      configurable: true,
      enumerable: true,
      get(this: Figure) {
        if (!isSetting(entry)) return this.reflection.pendingValue(name) ?? this.state.copy(name);
        return this.machine ? this.ask(() => entry.get(this.settings.present)) : this.reflection.pendingValue(name);
      },
      set(this: Figure, value) {
        this.reflection.setProperty(name, value, (given) =>
          isSetting(entry) ? this.reflection.assign(name, entry, given) : this.state.assign(name, given));
      },
    });
  }
  if ('marked' in own) Object.defineProperties(prototype, cloudProperties);
  customElements.define(tag, Widget);
}
