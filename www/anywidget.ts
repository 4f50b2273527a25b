/**
 * Elements as widgets of anywidget, for notebooks and books. The trait `widget` of a model is the tag of the element. Further traits set the
 * values of the element: they have the names of its attributes or properties, in JavaScript's or Python's spelling.
 *
 * The figure writes its values into the model when it opens, and after each change. It writes its statistics into the trait `stats`, and its
 * latest error message into `error`. It never adds a trait to the model.
 */

import './de.ts';
import './motion-widgets.ts';
import { COMMON_PROPERTIES } from './figure/definition.ts';
import { includesFields } from './data/checks.ts';
import { GLOBAL_ATTRIBUTES, createWidget, createErrorParagraph } from './named.ts';

export interface Model {
  /** Returns the value of a trait; undefined if the model does not have it. */
  get: (name: string) => any;
  set: (name: string, value: unknown) => void;
  on: (event: string, listener: () => void) => void;
  off: (event: string, listener: () => void) => void;
  save_changes: () => void;
}

/** Renders the widget of a model. @returns a function that removes it again */
function render({ model, el }: { model: Model, el: HTMLElement }): (() => void) | undefined {
  let element: any;
  try {
    element = createWidget(model.get('widget'));
  } catch (error) {
    el.append(createErrorParagraph('This cell', error));
    return;
  }
  // Without this attribute, JupyterLab would treat letters and digits typed in a figure as shortcuts, and change the cell.
  element.dataset.lmSuppressShortcuts = 'true';
  // JupyterLab's themes change the background of a cell's output but leave its text black. This variable has the theme's text colour.
  element.style.color = 'var(--jp-content-font-color1, inherit)';

  let hasUnsavedChanges = false;
  const setTrait = (trait: string, value: unknown) => {
    const currentValue = model.get(trait);
    if (currentValue === undefined || includesFields(currentValue, value)) return;
    hasUnsavedChanges = true;
    model.set(trait, value);
  };
  const saveChanges = () => {
    if (!hasUnsavedChanges) return;
    hasUnsavedChanges = false;
    withoutKernel(() => model.save_changes());
  };

  const traits = traitsOf(element);
  let isScheduled = false;
  let isWriting = false;
  /** Writes the figure's values into the model. Several calls in the same task cause one write. */
  const sendValues = () => {
    if (isScheduled) return;
    isScheduled = true;
    queueMicrotask(() => {
      isScheduled = false;
      // The figure has no values before its simulation starts. Its start calls `sendValues` again.
      if (!element.simulation) return;
      const ownTraits = traits.filter(([, property]) => !GLOBAL_ATTRIBUTES.includes(property));
      const traitValues = ownTraits.map(([trait, property]) => [trait, toJsonValue(element[property])] as [string, unknown]);
      // Null values are written last. A null such as "no preset" follows from the other values, and other views of the model apply the values in this order.
      isWriting = true;
      for (const isNull of [false, true]) for (const [trait, value] of traitValues) if ((value === null) === isNull) setTrait(trait, value);
      isWriting = false;
      // `_shown` has the values of all traits at one moment, and the number of the latest request that the figure has applied. The kernel ignores the
      // values of settings for which it has sent newer requests.
      setTrait('_shown', { heard: model.get('_asked'), settings: Object.fromEntries(traitValues.filter(([trait]) => model.get(trait) !== undefined)) });
      saveChanges();
    });
  };

  element.addEventListener('error', (event: ErrorEvent) => {
    if (model.get('error') === undefined) return;
    event.preventDefault();
    setTrait('error', event.message);
    saveChanges();
  });
  element.addEventListener('load', sendValues);
  element.addEventListener('change', () => {
    setTrait('error', '');
    sendValues();
  });
  element.addEventListener('stats', ({ detail }: CustomEvent) => {
    if (model.get('stats') === undefined) return;
    setTrait('stats', toJsonValue(detail));
    saveChanges();
  });

  const stopFunctions = traits.map(([trait, property]) => {
    const applyTrait = () => {
      if (isWriting) return;
      setTrait('error', '');
      // A global attribute such as `lang` is a string; the empty string stands for a missing attribute.
      element[property] = model.get(trait) ?? (GLOBAL_ATTRIBUTES.includes(property) ? '' : null);
      sendValues();
    };
    const value = model.get(trait);
    if (value !== undefined && value !== null) element[property] = value;
    model.on(`change:${trait}`, applyTrait);
    return () => model.off(`change:${trait}`, applyTrait);
  });
  el.append(element);

  return () => {
    for (const stopListeningToTrait of stopFunctions) withoutKernel(stopListeningToTrait);
    element.remove();
  };
}

/** Does work that needs a kernel, and ignores errors. Models without a kernel, as in MyST, throw. */
function withoutKernel(callKernel: () => void) {
  try {
    callKernel();
  } catch {
    // The error is ignored, because the figure also works without a kernel.
  }
}

/** Returns the names of all traits, in JavaScript's and in Python's spelling, each with the property that it sets. Properties on which others depend come first. */
function traitsOf(element: any): [trait: string, property: string][] {
  const { properties } = element.constructor.definition;
  const propertiesByName: Record<string, { attribute?: boolean | string }> = { ...properties, ...COMMON_PROPERTIES, ...Object.fromEntries(GLOBAL_ATTRIBUTES.map((name) => [name, {}])) };
  return Object.entries(propertiesByName).flatMap(([property, { attribute }]) => {
    const pythonName = property.replaceAll(/[A-Z]/g, (capital) => `_${capital.toLowerCase()}`);
    // In Python a name that is a keyword ends with an underscore, as in `from_`.
    const spellings = new Set([typeof attribute === 'string' ? attribute : property, property, pythonName, `${pythonName}_`]);
    return [...spellings].map((trait) => [trait, property] as [string, string]);
  });
}

/** Returns a value as JSON can represent it: lists for typed arrays, null for numbers that are not finite. */
function toJsonValue(value: unknown): unknown {
  if (typeof value === 'number') return Number.isFinite(value) ? value : null;
  if (typeof value !== 'object' || value === null) return value;
  if (Array.isArray(value) || ArrayBuffer.isView(value)) return Array.from(value as ArrayLike<unknown>, toJsonValue);
  return Object.fromEntries(Object.entries(value).map(([key, member]) => [key, toJsonValue(member)]));
}

export default { render };
