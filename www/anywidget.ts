/**
 * Elements as widgets of anywidget, for notebooks and books. The trait `widget` of a model is the tag of the element. Further traits set the
 * values of the element: they have the names of its attributes or properties, in JavaScript's or Python's spelling.
 *
 * The figure writes its values into the model when it opens, and after each change. It writes its statistics into the trait `stats`, and its
 * latest error message into `error`. It never adds a trait to the model.
 */

import './de.ts';
import './widgets/index.ts';
import { COMMON_ATTRS } from './figure/attributes.ts';
import { includesFields } from './figure/checks.ts';
import { GLOBAL, elementNamed, sorry } from './named.ts';

export interface Model {
  /** Returns the value of a trait; undefined if the model does not have it. */
  get: (name: string) => any;
  set: (name: string, value: unknown) => void;
  on: (event: string, listener: () => void) => void;
  off: (event: string, listener: () => void) => void;
  save_changes: () => void;
}

/** @returns what takes the figure away again */
function render({ model, el }: { model: Model, el: HTMLElement }): (() => void) | undefined {
  let element: any;
  try {
    element = elementNamed(model.get('widget'));
  } catch (error) {
    el.append(sorry('This cell', error));
    return;
  }
  // Digits and letters that are typed in a figure are no shortcuts of JupyterLab, by which it would change the cell.
  element.dataset.lmSuppressShortcuts = 'true';
  // JupyterLab's themes change the background of a cell's output but leave its text black. This variable has the theme's text colour.
  element.style.color = 'var(--jp-content-font-color1, inherit)';

  let unsaved = false;
  const put = (trait: string, value: unknown) => {
    const current = model.get(trait);
    if (current === undefined || includesFields(current, value)) return;
    unsaved = true;
    model.set(trait, value);
  };
  const save = () => {
    if (!unsaved) return;
    unsaved = false;
    withoutKernel(() => model.save_changes());
  };

  const traits = traitsOf(element);
  let isScheduled = false;
  let writing = false;
  /** Writes the figure's values into the model, once after several changes. */
  const sendValues = () => {
    if (isScheduled) return;
    isScheduled = true;
    queueMicrotask(() => {
      isScheduled = false;
      // The element was removed. The model already has the values that it showed last.
      if (!element.machine) return;
      const ours = traits.filter(([, property]) => !GLOBAL.includes(property));
      const values = ours.map(([trait, property]) => [trait, plain(element[property])] as [string, unknown]);
      // Nulls come last: a null (no preset, for example) follows from the other values, and another view applies them in this order.
      writing = true;
      for (const none of [false, true]) for (const [trait, value] of values) if ((value === null) === none) put(trait, value);
      writing = false;
      // All values of one moment, with the number of the last request that was applied: the kernel can tell which requests are newer.
      put('_shown', { heard: model.get('_asked'), settings: Object.fromEntries(values.filter(([trait]) => model.get(trait) !== undefined)) });
      save();
    });
  };

  element.addEventListener('error', (event: ErrorEvent) => {
    if (model.get('error') === undefined) return;
    event.preventDefault();
    put('error', event.message);
    save();
  });
  element.addEventListener('load', sendValues);
  element.addEventListener('change', () => {
    put('error', '');
    sendValues();
  });
  element.addEventListener('stats', ({ detail }: CustomEvent) => {
    if (model.get('stats') === undefined) return;
    put('stats', plain(detail));
    save();
  });

  const heard = traits.map(([trait, property]) => {
    const take = () => {
      if (writing) return;
      put('error', '');
      // Global attributes are texts, and a missing one is the empty text.
      element[property] = model.get(trait) ?? (GLOBAL.includes(property) ? '' : null);
      sendValues();
    };
    const value = model.get(trait);
    if (value !== undefined && value !== null) element[property] = value;
    model.on(`change:${trait}`, take);
    return () => model.off(`change:${trait}`, take);
  });
  el.append(element);

  return () => {
    for (const end of heard) withoutKernel(end);
    element.remove();
  };
}

/** Does work that needs a kernel, and ignores errors. Models without a kernel, as in MyST, throw. */
function withoutKernel(work: () => void) {
  try {
    work();
  } catch {
    // The figure works without a kernel.
  }
}

/** Returns all spellings of traits with their properties. Properties that others depend on come first. */
function traitsOf(element: any): [trait: string, property: string][] {
  const { properties, own } = element.constructor.definition;
  const entries: Record<string, { property?: string }> = { ...properties, ...own, ...COMMON_ATTRS, ...Object.fromEntries(GLOBAL.map((name) => [name, {}])) };
  return Object.entries(entries).flatMap(([name, { property = name }]) => {
    if (!(property in element)) return [];
    const inPython = property.replaceAll(/[A-Z]/g, (capital) => `_${capital.toLowerCase()}`);
    // With the underscore of a keyword, as in `from_`.
    const spellings = new Set([name, property, inPython, `${inPython}_`]);
    return [...spellings].map((trait) => [trait, property] as [string, string]);
  });
}

/** Returns a value as JSON can represent it: lists for typed arrays, null for numbers that are not finite. */
function plain(value: unknown): unknown {
  if (typeof value === 'number') return Number.isFinite(value) ? value : null;
  if (typeof value !== 'object' || value === null) return value;
  if (Array.isArray(value) || ArrayBuffer.isView(value)) return Array.from(value as ArrayLike<unknown>, plain);
  return Object.fromEntries(Object.entries(value).map(([key, each]) => [key, plain(each)]));
}

export default { render };
