/** Synchronization of attributes and properties with the settings: values of the page are applied, and changed settings are written as attributes. */

import { includesFields, withFieldRenamed, checkWord } from '../data/checks.ts';
import { FigureController } from './controller.ts';
import { COMMON_ATTRS, defaultConfigOf } from './definition.ts';
import type { Figure } from './figure.ts';
import type { StateValues } from './settings.ts';

export class Reflection extends FigureController {
  #attributes = this.host.definition.attributes;
  #properties = this.host.definition.properties;
  /** Names of properties in the order in which early assignments are applied. Properties on which others depend come first. A log takes long and comes last. */
  #applicationOrder = ['preset', 'map', ...Object.keys(this.#properties), 'log'];
  /** Assignments made before the simulation exists. The key is the name of a property, or a new object for each assigned state. */
  #earlyAssignments: Map<unknown, { value?: unknown, apply: () => void }> = new Map();
  #isWritingAttributes = false;
  #previousTexts: Map<string, string> | undefined;

  /** Applies properties that were set before the element was upgraded, and lists that the page gives as attributes. */
  hostConnected() {
    const host = this.host as unknown as Record<string, unknown>;
    // An element that is moved in the page keeps its settings.
    if (!host.hasUpdated) this.#applyListAttributes(host);
    for (const name of Object.keys(host)) {
      if (!(name in Object.getPrototypeOf(host))) continue;
      const assignedValue = host[name];
      delete host[name];
      Reflect.set(host, name, assignedValue);
    }
  }

  /** Reads list properties from attributes such as `alphas="0.1,0.2"` or `"[0.1, 0.2]"`. The property refuses and reports any other text. */
  #applyListAttributes(host: Record<string, unknown>) {
    for (const [name, { converter }] of Object.entries(this.#properties)) {
      const listText = converter || name in this.host.settings.elementState ? null : this.host.getAttribute(name);
      if (listText === null || Object.hasOwn(host, name)) continue;
      const numbers = (listText.match(/[^\s,[\]]+/g) ?? []).map(Number);
      host[name] = numbers.every(Number.isFinite) ? numbers : listText;
    }
  }

  /** Applies the early assignments. Whole states keep their order in time. Properties assigned between two states are sorted by dependency. */
  applyEarlyAssignments() {
    let stateOffset = 0;
    const assignments = [...this.#earlyAssignments].map(([name, { apply }]) =>
      ({ apply, order: typeof name === 'string' ? stateOffset + this.#applicationOrder.indexOf(name) : (stateOffset += this.#applicationOrder.length) }));
    this.#earlyAssignments.clear();
    for (const { apply } of assignments.sort((a, b) => a.order - b.order)) this.host.runtime.attemptOrReport(apply);
  }

  /** Applies a state, now or as soon as there is a simulation. */
  applyWhenReady(applyState: () => void) {
    if (this.host.simulation) this.host.runtime.attempt(applyState);
    else this.#earlyAssignments.set({}, { apply: applyState });
  }

  /** Sets a property to a value, which may be given as text. Null or undefined sets the default. A value that is refused is reported. */
  setProperty(name: string, value: any, apply: (value: any) => void) {
    const property = this.#properties[name];
    const parsedValue = typeof value === 'string' && property?.converter ? property.converter.parse(value) : value;
    const applyIfChanged = () => {
      const newValue = parsedValue ?? property?.get(this.#defaultConfig) ?? null;
      const currentValue = property ? property.get(this.host.settings.requested) : Reflect.get(this.host, name);
      // A group of settings may be given in part. A map or a log is replaced as a whole.
      const isGroup = name in this.host.settings.current;
      if (!includesFields(currentValue, newValue) || (!isGroup && !includesFields(newValue, currentValue))) apply(newValue);
    };
    if (this.host.simulation) {
      this.host.runtime.attemptOrReport(applyIfChanged);
    } else {
      // The latest assignment is applied last.
      this.#earlyAssignments.delete(name);
      this.#earlyAssignments.set(name, { value: parsedValue, apply: applyIfChanged });
    }
  }

  /** Returns the value of a property. Before there is a simulation, that is the value assigned to it, if any. */
  get(name: string) {
    const { simulation, settings } = this.host;
    if (this.#earlyAssignments.has(name)) return this.#earlyAssignments.get(name)?.value;
    return structuredClone(simulation ? this.#properties[name].get(settings.requested) : settings.elementState[name]);
  }

  /** Sets a property of the definition, as `setProperty` does. Errors have the property's name in place of the core's name of the setting. */
  set(name: string, value: unknown) {
    const { settings } = this.host;
    const { changesFor, corePath } = this.#properties[name];
    this.setProperty(name, value, (newValue) => {
      try {
        settings.assign(changesFor(newValue, settings.requested));
      } catch (error) {
        throw withFieldRenamed(error, name, corePath);
      }
    });
  }

  /** Applies an attribute's new text. The name is in lower case. */
  applyAttribute(attribute: string, text: string | null) {
    const { words } = COMMON_ATTRS[attribute] ?? {};
    if (words && text !== null) this.host.runtime.attemptOrReport(() => checkWord(attribute, text, words));
    const name = Object.keys(this.#attributes).find((key) => key.toLowerCase() === attribute);
    if (name !== undefined && !this.#isWritingAttributes) Reflect.set(this.host, name, text);
  }

  /** Default configuration. Some defaults depend on the present settings. */
  get #defaultConfig(): StateValues {
    const { definition, settings } = this.host;
    return { ...defaultConfigOf(definition.declarations), ...definition.elementDefaults, ...definition.dependentDefaultsOf?.(settings.requested) };
  }

  /** Updates attributes that differ from the settings. A missing attribute is added if a new figure would need it, or if a preset has changed it. */
  updateAttributes() {
    const { simulation, viewModel, settings } = this.host;
    // Before the first frame, the page's attributes still wait in `#earlyAssignments`.
    if (!simulation || !viewModel) return;
    const attributeTexts = this.#attributeTextsOf(settings.requested);
    const previousTexts = this.#previousTexts ?? attributeTexts;
    const neededTexts = this.findNeededAttributes((name, text) => text !== previousTexts.get(name));
    this.#previousTexts = attributeTexts;
    this.#isWritingAttributes = true;
    for (const [name, { converter: { parse, format } }] of Object.entries(this.#attributes)) {
      const currentText = this.host.getAttribute(name);
      const text = (currentText === null ? neededTexts : attributeTexts).get(name);
      if (text === undefined) this.host.removeAttribute(name);
      // An attribute stays as the page wrote it if it has the same value.
      else if (currentText === null || format(parse(currentText)) !== text) this.host.setAttribute(name, text);
    }
    this.#isWritingAttributes = false;
  }

  /**
   * Returns the attributes with which a new figure opens in the present state: those that differ from the defaults, without those that another
   * attribute determines, such as a preset, unless `isWanted` accepts them.
   */
  findNeededAttributes(isWanted = (_name: string, _text: string) => false): Map<string, string> {
    const attributeTexts = this.#attributeTextsOf(this.host.settings.requested);
    const defaultTexts = this.#attributeTextsOf(this.#defaultConfig);
    const coveredNames: Set<string> = new Set();
    const neededTexts = new Map<string, string>();
    for (const [name, { coveredAttributes = [] }] of Object.entries(this.#attributes)) {
      const text = attributeTexts.get(name);
      if (text === undefined) continue;
      if (text !== defaultTexts.get(name) && (!coveredNames.has(name) || isWanted(name, text))) neededTexts.set(name, text);
      for (const coveredName of coveredAttributes) coveredNames.add(coveredName);
    }
    return neededTexts;
  }

  #attributeTextsOf(stateValues: StateValues): Map<string, string> {
    const textEntries = Object.entries(this.#attributes).map(([name, { converter, get }]) => [name, converter.format(get(stateValues) ?? null)] as const);
    return new Map(textEntries.filter((entry): entry is [string, string] => entry[1] !== null));
  }
}

/** Defines a widget's element with its properties, and further ones. If the page loads the script twice, the second call does nothing. */
export function defineElement(Widget: typeof import('./figure.ts').FigureElement<any, any> & CustomElementConstructor, furtherProperties: PropertyDescriptorMap = {}) {
  const { prototype, definition: { tag, properties } } = Widget;
  if (customElements.get(tag)) return;
  for (const name of Object.keys(properties)) {
    // A widget defines a property itself if its accessors do more than read and write the value.
    if (Object.hasOwn(prototype, name)) continue;
    Object.defineProperty(prototype, name, {
      configurable: true,
      enumerable: true,
      get(this: Figure) { return this.reflection.get(name); },
      set(this: Figure, value) { this.reflection.set(name, value); },
    });
  }
  Object.defineProperties(prototype, furtherProperties);
  customElements.define(tag, Widget);
}
