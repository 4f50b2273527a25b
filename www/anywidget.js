/**
 * The elements for notebooks and books that show widgets as anywidget has them. A model says by its trait `widget` which
 * element it is, and by others, called as the attributes, the properties, or those in Python's spelling, what that shows.
 *
 * Traits that the model has not are left alone, but for a change that comes later. What the figure shows goes back to those
 * that it has: as it opens, and where the reader or the model has changed it. `stats` get the statistics, `error` the last
 * refusal.
 */

import './de.js';
import './widgets/index.js';
import { COMMON, groupsOf } from './figure/attributes.js';
import { has } from './figure/checks.js';
import { GLOBAL, elementNamed, sorry } from './named.js';

/**
 * @typedef {object} Model as anywidget's
 * @property {(name: string) => any} get undefined where it has no such trait
 * @property {(name: string, value: unknown) => void} set
 * @property {(event: string, listener: () => void) => void} on
 * @property {(event: string, listener: () => void) => void} off
 * @property {() => void} save_changes
 */

/**
 * @param {{ model: Model, el: HTMLElement }} view
 * @returns {(() => void) | undefined} what takes the figure away again
 */
function render({ model, el }) {
  /** @type {any} */
  let element;
  try {
    element = elementNamed(model.get('widget'));
  } catch (error) {
    el.append(sorry('This cell', error));
    return;
  }
  // Digits and letters that are typed in a figure are no shortcuts of JupyterLab, by which it would change the cell.
  element.dataset.lmSuppressShortcuts = 'true';
  // Around what a cell puts out JupyterLab's themes change the ground and leave black text; the colour that they mean is here.
  element.style.color = 'var(--jp-content-font-color1, inherit)';

  let unsaved = false;
  const put = (/** @type {string} */ trait, /** @type {unknown} */ value) => {
    const present = model.get(trait);
    if (present === undefined || has(present, value)) return;
    unsaved = true;
    model.set(trait, value);
  };
  const save = () => {
    if (!unsaved) return;
    unsaved = false;
    withoutKernel(() => model.save_changes());
  };

  const traits = traitsOf(element);
  let telling = false;
  let writing = false;
  /** After all that the model changed at once. */
  const tell = () => {
    if (telling) return;
    telling = true;
    queueMicrotask(() => {
      telling = false;
      // It is on no page: what it showed last was told.
      if (!element.machine) return;
      const ours = traits.filter(([, property]) => !GLOBAL.includes(property));
      const told = ours.map(([trait, property]) => /** @type {[string, unknown]} */ ([trait, plain(element[property])]));
      // What is none follows from the others, where another view hears of both.
      writing = true;
      for (const none of [false, true]) for (const [trait, value] of told) if ((value === null) === none) put(trait, value);
      writing = false;
      // Of one moment, and of which: what a kernel has asked for since is later, however long this is on its way.
      put('_shown', { heard: model.get('_asked'), settings: Object.fromEntries(told.filter(([trait]) => model.get(trait) !== undefined)) });
      save();
    });
  };

  element.addEventListener('error', (/** @type {ErrorEvent} */ event) => {
    if (model.get('error') === undefined) return;
    event.preventDefault();
    put('error', event.message);
    save();
  });
  element.addEventListener('load', tell);
  element.addEventListener('change', () => {
    put('error', '');
    tell();
  });
  element.addEventListener('stats', (/** @type {CustomEvent} */ { detail }) => {
    if (model.get('stats') === undefined) return;
    put('stats', plain(detail));
    save();
  });

  const heard = traits.map(([trait, property]) => {
    const take = () => {
      if (writing) return;
      put('error', '');
      // What every element has is a text, and none is the empty one.
      element[property] = model.get(trait) ?? (GLOBAL.includes(property) ? '' : null);
      tell();
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

/**
 * Where a page has a model without a kernel behind it, as MyST does, nothing is kept, and nobody is there to be told: its
 * methods throw.
 *
 * @param {() => void} work
 */
function withoutKernel(work) {
  try {
    work();
  } catch {
    // The figure goes on.
  }
}

/**
 * The traits that say a property, each by what it may be called; those that others depend on come first.
 *
 * @param {any} element
 * @returns {[trait: string, property: string][]}
 */
function traitsOf(element) {
  const { attributes, declared, own } = element.constructor;
  /** @type {Record<string, { property?: string }>} */
  const names = { ...attributes, ...groupsOf(declared), ...own, ...COMMON, ...Object.fromEntries(GLOBAL.map((name) => [name, {}])) };
  return Object.entries(names).flatMap(([name, { property = name }]) => {
    if (!(property in element)) return [];
    const inPython = property.replaceAll(/[A-Z]/g, (capital) => `_${capital.toLowerCase()}`);
    // With the underscore of a keyword, as in `from_`.
    const spellings = new Set([name, property, inPython, `${inPython}_`]);
    return [...spellings].map((trait) => /** @type {[string, string]} */ ([trait, property]));
  });
}

/**
 * As JSON has it: lists for typed arrays, null for what is no number.
 *
 * @param {unknown} value
 * @returns {unknown}
 */
function plain(value) {
  if (typeof value === 'number') return Number.isFinite(value) ? value : null;
  if (typeof value !== 'object' || value === null) return value;
  if (Array.isArray(value) || ArrayBuffer.isView(value)) return Array.from(/** @type {ArrayLike<unknown>} */ (value), plain);
  return Object.fromEntries(Object.entries(value).map(([key, each]) => [key, plain(each)]));
}

export default { render };
