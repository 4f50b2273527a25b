/** Synchronization of attributes and properties with the settings: values of the page are applied, and changed settings are written as attributes. */

import { includesFields, withFieldRenamed } from '../data/checks.ts';
import { FigureController } from './controller.ts';
import { defaultConfigOf } from './definition.ts';
import type { Figure } from './figure.ts';
import type { StateValues } from './settings.ts';

export class Reflection extends FigureController {
  #attributes = this.host.definition.attributes;
  #properties = this.host.definition.properties;
  /** Names of properties in the order in which early assignments are applied. Properties on which others depend come first. A log comes last, because its fit takes long. */
  #applicationOrder = ['preset', 'map', ...Object.keys(this.#properties), 'log'];
  /** Assignments made before the simulation exists. The key is the name of a property, or a new object for each assigned state. */
  #earlyAssignments: Map<unknown, { value?: unknown, apply: () => void }> = new Map();
  #isWritingAttributes = false;

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
    if (this.host.simulation) this.host.runtime.attemptWork(applyState);
    else this.#earlyAssignments.set({}, { apply: applyState });
  }

  /** Sets a property to a value, which may be given as text. Null or undefined sets the default. A value that is refused is reported. */
  setProperty(name: string, value: any, apply: (value: any) => void) {
    if (this.#isWritingAttributes) return;
    const property = this.#properties[name];
    const parsedValue = typeof value === 'string' && property?.converter ? property.converter.fromAttribute(value) : value;
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
      // A JavaScript `Map` keeps the position of an existing key. Deleting the key moves the latest assignment to the end, where it is applied last.
      this.#earlyAssignments.delete(name);
      this.#earlyAssignments.set(name, { value: parsedValue, apply: applyIfChanged });
    }
  }

  /** Returns the value of a property. Before there is a simulation, that is the value assigned to it, if any. */
  getProperty(name: string) {
    const { simulation, settings } = this.host;
    if (this.#earlyAssignments.has(name)) return this.#earlyAssignments.get(name)?.value;
    return structuredClone(simulation ? this.#properties[name].get(settings.requested) : settings.elementState[name]);
  }

  /** Sets a property of the definition, as `setProperty` does. Errors have the property's name in place of the core's name of the setting. */
  assignProperty(name: string, value: unknown) {
    const { settings } = this.host;
    const { changesFor, corePath } = this.#properties[name];
    this.setProperty(name, value, (newValue) => {
      try {
        settings.assignValues(changesFor(newValue, settings.requested));
      } catch (error) {
        throw withFieldRenamed(error, name, corePath);
      }
    });
  }

  /** Default configuration. Some defaults depend on the present settings. */
  get #defaultConfig(): StateValues {
    const { definition, settings } = this.host;
    return { ...defaultConfigOf(definition.declarations), ...definition.elementDefaults, ...definition.dependentDefaultsOf?.(settings.requested) };
  }

  /** Updates the attributes, so that a new figure with them has the present settings. Removes attributes that it would not need. */
  updateAttributes() {
    const { simulation, viewModel } = this.host;
    // Before the first frame, the page's attributes still wait in `#earlyAssignments`.
    if (!simulation || !viewModel) return;
    const attributeTexts = this.findNeededAttributes(this.host.getAttributeNames());
    this.#isWritingAttributes = true;
    for (const [name, { converter: { fromAttribute, toAttribute } }] of Object.entries(this.#attributes)) {
      const currentText = this.host.getAttribute(name);
      const text = attributeTexts.get(name);
      if (text === undefined) this.host.removeAttribute(name);
      // An attribute stays as the page wrote it if it has the same value.
      else if (currentText === null || toAttribute(fromAttribute(currentText)) !== text) this.host.setAttribute(name, text);
    }
    this.#isWritingAttributes = false;
  }

  /** Returns attributes with which a new figure opens in the present state: all `givenNames`, and those whose default or preset value differs. */
  findNeededAttributes(givenNames: string[] = []): Map<string, string> {
    const { requested } = this.host.settings;
    const neededTexts = new Map<string, string>();
    let newConfig = this.#defaultConfig;
    for (const [name, { converter: { toAttribute }, get, changesFor }] of Object.entries(this.#attributes)) {
      const value = get(requested) ?? null;
      const text = toAttribute(value);
      if (text === null || (text === toAttribute(get(newConfig) ?? null) && !givenNames.includes(name.toLowerCase()))) continue;
      neededTexts.set(name, text);
      newConfig = { ...newConfig, ...changesFor(value, newConfig) };
    }
    return neededTexts;
  }
}

/** Returns the accessors of a property that is kept in the settings. */
export const settingAccessorsOf = (name: string): PropertyDescriptor & ThisType<Figure> => ({
  configurable: true,
  enumerable: true,
  get() { return this.reflection.getProperty(name); },
  set(value) { this.reflection.assignProperty(name, value); },
});

/** Defines a widget's element. Adds `furtherProperties` to its prototype. If the page loads the script twice, the second call does nothing. */
export function defineElement(Widget: typeof import('./figure.ts').FigureElement<any, any> & CustomElementConstructor, furtherProperties: PropertyDescriptorMap = {}) {
  const { prototype, definition: { tag, properties } } = Widget;
  if (customElements.get(tag)) return;
  for (const [name, property] of Object.entries(properties)) Widget.createProperty(name, property);
  Object.defineProperties(prototype, furtherProperties);
  customElements.define(tag, Widget);
}
