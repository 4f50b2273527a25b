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

export interface WidgetModel {
  /** Returns the value of a trait; undefined if the model does not have it. */
  get: (traitName: string) => any;
  set: (traitName: string, traitValue: unknown) => void;
  on: (modelEvent: string, listener: () => void) => void;
  off: (modelEvent: string, listener: () => void) => void;
  save_changes: () => void;
}

/** Renders the widget of a model. Returns a function that removes the widget. */
function renderWidget({ model: widgetModel, el: outputElement }: { model: WidgetModel, el: HTMLElement }): (() => void) | undefined {
  let element: any;
  try {
    element = createWidget(widgetModel.get('widget'));
  } catch (error) {
    outputElement.append(createErrorParagraph('This cell', error));
    return;
  }
  // Without this attribute, JupyterLab would treat letters and digits typed in a figure as shortcuts, and change the cell.
  element.dataset.lmSuppressShortcuts = 'true';
  // JupyterLab's themes change the background of a cell's output but leave its text black. The figure therefore takes the theme's text colour from this variable.
  element.style.color = 'var(--jp-content-font-color1, inherit)';

  let hasUnsavedChanges = false;
  const setTrait = (traitName: string, traitValue: unknown) => {
    const currentValue = widgetModel.get(traitName);
    if (currentValue === undefined || includesFields(currentValue, traitValue)) return;
    hasUnsavedChanges = true;
    widgetModel.set(traitName, traitValue);
  };
  const saveChanges = () => {
    if (!hasUnsavedChanges) return;
    hasUnsavedChanges = false;
    ignoreMissingKernel(() => widgetModel.save_changes());
  };

  const traitPairs = traitPairsOf(element);
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
      const ownTraits = traitPairs.filter(([, propertyName]) => !GLOBAL_ATTRIBUTES.includes(propertyName));
      const traitValues = ownTraits.map(([traitName, propertyName]) => [traitName, toJsonValue(element[propertyName])] as [string, unknown]);
      // Null values, such as "no preset", are written last. Other views of the figure apply the values in this order. A null that the other values imply then changes nothing.
      isWriting = true;
      for (const isNull of [false, true]) for (const [traitName, traitValue] of traitValues) if ((traitValue === null) === isNull) setTrait(traitName, traitValue);
      isWriting = false;
      // `_shown` has the values of all traits at one moment, and the number of the latest request that the figure has applied. The kernel ignores the
      // values of settings for which it has sent newer requests.
      setTrait('_shown', { heard: widgetModel.get('_asked'), settings: Object.fromEntries(traitValues.filter(([traitName]) => widgetModel.get(traitName) !== undefined)) });
      saveChanges();
    });
  };

  element.addEventListener('error', (errorEvent: ErrorEvent) => {
    if (widgetModel.get('error') === undefined) return;
    errorEvent.preventDefault();
    setTrait('error', errorEvent.message);
    saveChanges();
  });
  element.addEventListener('load', sendValues);
  element.addEventListener('change', () => {
    setTrait('error', '');
    sendValues();
  });
  element.addEventListener('stats', ({ detail: statsDetail }: CustomEvent) => {
    if (widgetModel.get('stats') === undefined) return;
    setTrait('stats', toJsonValue(statsDetail));
    saveChanges();
  });

  const stopFunctions = traitPairs.map(([traitName, propertyName]) => {
    const applyTrait = () => {
      if (isWriting) return;
      setTrait('error', '');
      // A global attribute such as `lang` is a string; the empty string stands for a missing attribute.
      element[propertyName] = widgetModel.get(traitName) ?? (GLOBAL_ATTRIBUTES.includes(propertyName) ? '' : null);
      sendValues();
    };
    const traitValue = widgetModel.get(traitName);
    if (traitValue !== undefined && traitValue !== null) element[propertyName] = traitValue;
    widgetModel.on(`change:${traitName}`, applyTrait);
    return () => widgetModel.off(`change:${traitName}`, applyTrait);
  });
  outputElement.append(element);

  return () => {
    for (const stopListeningToTrait of stopFunctions) ignoreMissingKernel(stopListeningToTrait);
    element.remove();
  };
}

/** Does work that needs a kernel, and ignores errors. Models without a kernel, as in MyST, throw. */
function ignoreMissingKernel(callKernel: () => void) {
  try {
    callKernel();
  } catch {
    // The error is ignored, because the figure also works without a kernel.
  }
}

/** Returns the names of all traits, in JavaScript's and in Python's spelling, each with the property that it sets. Properties on which others depend come first. */
function traitPairsOf(element: any): [trait: string, property: string][] {
  const { elementProperties } = element.constructor.definition;
  const propertiesByName: Record<string, { attribute?: boolean | string }> = { ...elementProperties, ...COMMON_PROPERTIES, ...Object.fromEntries(GLOBAL_ATTRIBUTES.map((traitName) => [traitName, {}])) };
  return Object.entries(propertiesByName).flatMap(([propertyName, { attribute: attributeName }]) => {
    const pythonName = propertyName.replaceAll(/[A-Z]/g, (capitalLetter) => `_${capitalLetter.toLowerCase()}`);
    // In Python a name that is a keyword ends with an underscore, as in `from_`.
    const traitSpellings = new Set([typeof attributeName === 'string' ? attributeName : propertyName, propertyName, pythonName, `${pythonName}_`]);
    return [...traitSpellings].map((traitName) => [traitName, propertyName] as [string, string]);
  });
}

/** Returns a value as JSON can represent it: lists for typed arrays, null for numbers that are not finite. */
function toJsonValue(propertyValue: unknown): unknown {
  if (typeof propertyValue === 'number') return Number.isFinite(propertyValue) ? propertyValue : null;
  if (typeof propertyValue !== 'object' || propertyValue === null) return propertyValue;
  if (Array.isArray(propertyValue) || ArrayBuffer.isView(propertyValue)) return Array.from(propertyValue as ArrayLike<unknown>, toJsonValue);
  return Object.fromEntries(Object.entries(propertyValue).map(([fieldKey, fieldValue]) => [fieldKey, toJsonValue(fieldValue)]));
}

export default { render: renderWidget };
