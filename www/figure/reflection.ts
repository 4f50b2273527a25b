/** Synchronization of attributes and properties with the settings: values of the page are applied, and changed settings are written as attributes. */

import { includesFields, renameErrorField } from '../data/checks.ts';
import { FigureController } from './controller.ts';
import { defaultConfigOf } from './definition.ts';
import type { Figure } from './figure.ts';
import type { StateValues } from './settings.ts';

export class AttributeReflection extends FigureController {
  #attributes = this.figure.definition.attributes;
  #elementProperties = this.figure.definition.elementProperties;
  /** Names of properties in the order in which assignments made before the start are applied. Properties on which others depend come first. A log comes last, because its fit takes long. */
  #propertyOrder = ['preset', 'map', ...Object.keys(this.#elementProperties), 'log'];
  /** Assignments of the page before the simulation exists. The key is the name of a property, or a new object for each assigned state. */
  #earlyAssignments: Map<unknown, { assignedValue?: unknown, applyAssignment: () => void }> = new Map();
  #isWritingAttributes = false;

  /** Applies assignments that the page made before the simulation existed. Whole states keep their order in time. Properties assigned between two states are sorted by dependency. */
  applyEarlyAssignments() {
    let stateOffset = 0;
    const orderedAssignments = [...this.#earlyAssignments].map(([propertyName, { applyAssignment }]) =>
      ({ apply: applyAssignment, assignmentOrder: typeof propertyName === 'string' ? stateOffset + this.#propertyOrder.indexOf(propertyName) : (stateOffset += this.#propertyOrder.length) }));
    this.#earlyAssignments.clear();
    for (const { apply: applyAssignment } of orderedAssignments.sort((a, b) => a.assignmentOrder - b.assignmentOrder)) this.figure.runtime.attemptOrReport(applyAssignment);
  }

  /** Applies a state, now or as soon as there is a simulation. */
  applyWhenReady(applyState: () => void) {
    if (this.figure.simulation) this.figure.runtime.attemptWork(applyState);
    else this.#earlyAssignments.set({}, { applyAssignment: applyState });
  }

  /** Sets a property to a value, which may be given as text. Null or undefined sets the default. A value that is refused is reported. */
  setProperty(propertyName: string, propertyValue: any, applyValue: (propertyValue: any) => void) {
    if (this.#isWritingAttributes) return;
    const elementProperty = this.#elementProperties[propertyName];
    const parsedValue = typeof propertyValue === 'string' && elementProperty?.converter ? elementProperty.converter.fromAttribute(propertyValue) : propertyValue;
    const applyIfChanged = () => {
      const newValue = parsedValue ?? elementProperty?.getValue(this.#defaultConfig) ?? null;
      const currentValue = elementProperty ? elementProperty.getValue(this.figure.settings.requestedValues) : Reflect.get(this.figure, propertyName);
      // A group of settings may be given in part. A map or a log is replaced as a whole.
      const isGroup = propertyName in this.figure.settings.currentValues;
      if (!includesFields(currentValue, newValue) || (!isGroup && !includesFields(newValue, currentValue))) applyValue(newValue);
    };
    if (this.figure.simulation) {
      this.figure.runtime.attemptOrReport(applyIfChanged);
    } else {
      // A JavaScript `Map` keeps the position of an existing key. Deleting the key moves the latest assignment to the end, where it is applied last.
      this.#earlyAssignments.delete(propertyName);
      this.#earlyAssignments.set(propertyName, { assignedValue: parsedValue, applyAssignment: applyIfChanged });
    }
  }

  /** Returns the value of a property. Before there is a simulation, that is the value assigned to it, if any. */
  getProperty(propertyName: string) {
    const { simulation, settings } = this.figure;
    if (this.#earlyAssignments.has(propertyName)) return this.#earlyAssignments.get(propertyName)?.assignedValue;
    return structuredClone(simulation ? this.#elementProperties[propertyName].getValue(settings.requestedValues) : settings.elementState[propertyName]);
  }

  /** Sets a property of the definition, as `setProperty` does. Errors have the property's name in place of the core's name of the setting. */
  assignProperty(propertyName: string, propertyValue: unknown) {
    const { settings } = this.figure;
    const { changesFor, coreFieldPath } = this.#elementProperties[propertyName];
    this.setProperty(propertyName, propertyValue, (newValue) => {
      try {
        settings.assignValues(changesFor(newValue, settings.requestedValues));
      } catch (error) {
        throw renameErrorField(error, propertyName, coreFieldPath);
      }
    });
  }

  /** Default configuration. Some defaults depend on the present settings. */
  get #defaultConfig(): StateValues {
    const { definition, settings } = this.figure;
    return { ...defaultConfigOf(definition.settingDeclarations), ...definition.elementDefaults, ...definition.dependentDefaultsOf?.(settings.requestedValues) };
  }

  /** Updates the attributes, so that a new figure with the same attributes opens with the present settings. Attributes that this does not require are removed. */
  updateAttributes() {
    const { simulation, viewModel } = this.figure;
    // Before the first frame, values of the page's attributes may still wait in `#earlyAssignments`, and must not be overwritten.
    if (!simulation || !viewModel) return;
    const attributeTexts = this.findNeededAttributes(this.figure.getAttributeNames());
    this.#isWritingAttributes = true;
    for (const [propertyName, { converter: { fromAttribute, toAttribute } }] of Object.entries(this.#attributes)) {
      const currentText = this.figure.getAttribute(propertyName);
      const attributeText = attributeTexts.get(propertyName);
      if (attributeText === undefined) this.figure.removeAttribute(propertyName);
      // An attribute stays as the page wrote it if its text stands for the present value.
      else if (currentText === null || toAttribute(fromAttribute(currentText)) !== attributeText) this.figure.setAttribute(propertyName, attributeText);
    }
    this.#isWritingAttributes = false;
  }

  /** Returns attributes with which a new figure opens in the present state: all `givenNames`, and those whose default or preset value differs. */
  findNeededAttributes(givenNames: string[] = []): Map<string, string> {
    const { requestedValues } = this.figure.settings;
    const neededTexts = new Map<string, string>();
    let newConfig = this.#defaultConfig;
    for (const [propertyName, { converter: { toAttribute }, getValue, changesFor }] of Object.entries(this.#attributes)) {
      const propertyValue = getValue(requestedValues) ?? null;
      const attributeText = toAttribute(propertyValue);
      if (attributeText === null || (attributeText === toAttribute(getValue(newConfig) ?? null) && !givenNames.includes(propertyName.toLowerCase()))) continue;
      neededTexts.set(propertyName, attributeText);
      newConfig = { ...newConfig, ...changesFor(propertyValue, newConfig) };
    }
    return neededTexts;
  }
}

/** Returns the accessors of a property that is kept in the settings. */
export const settingAccessorsOf = (propertyName: string): PropertyDescriptor & ThisType<Figure> => ({
  configurable: true,
  enumerable: true,
  get() { return this.reflection.getProperty(propertyName); },
  set(propertyValue) { this.reflection.assignProperty(propertyName, propertyValue); },
});

/** Defines a widget's element. Adds `furtherProperties` to its prototype. If the page loads the script twice, the second call does nothing. */
export function defineElement(WidgetClass: typeof import('./figure.ts').FigureElement<any, any> & CustomElementConstructor, furtherProperties: PropertyDescriptorMap = {}) {
  const { prototype, definition: { widgetTag, elementProperties } } = WidgetClass;
  if (customElements.get(widgetTag)) return;
  for (const [propertyName, elementProperty] of Object.entries(elementProperties)) WidgetClass.createProperty(propertyName, elementProperty);
  Object.defineProperties(prototype, furtherProperties);
  customElements.define(widgetTag, WidgetClass);
}
