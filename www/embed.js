/**
 * One widget for an iframe. The query says which, and its attributes:
 * `embed.html?widget=banana-machine&omega=0.8`. The page around the frame is told the height by
 * messages `{ type: 'motion-widgets:height', height }`, in CSS pixels.
 */

import './de.js';
import { settings } from './settings.js';

const WIDGETS = Object.keys(settings);
/** What every element of HTML has, and a widget may heed. */
const GLOBAL = ['dir', 'lang'];

/**
 * The widget that a query describes.
 *
 * @param {URLSearchParams} query
 * @throws {Error} with a sentence that names the parameter and what is allowed
 */
function widgetOf(query) {
  const name = query.get('widget');
  if (name === null || !WIDGETS.includes(name)) {
    throw new Error(`widget is ${name === null ? 'missing' : `"${name}"`}; allowed is ${WIDGETS.join(' or ')}`);
  }
  const known = [.../** @type {any} */ (customElements.get(name)).observedAttributes, ...GLOBAL];
  const widget = document.createElement(name);
  for (const [key, value] of query) {
    if (key === 'widget') continue;
    if (!known.includes(key)) {
      throw new Error(`${key} is an unknown parameter of ${name}; allowed are ${known.sort().join(', ')}`);
    }
    if (query.getAll(key).length > 1) throw new Error(`${key} is given more than once; allowed is once`);
    widget.setAttribute(key, value);
  }
  return widget;
}

function tellHeight() {
  const height = Math.ceil(document.body.getBoundingClientRect().height);
  // Whoever shows the frame may know how high it is.
  parent.postMessage({ type: 'motion-widgets:height', height }, '*');
}

try {
  document.body.append(widgetOf(new URLSearchParams(location.search)));
} catch (error) {
  const sentence = document.createElement('p');
  sentence.setAttribute('role', 'alert');
  sentence.textContent = `This address shows no figure: ${/** @type {Error} */ (error).message}.`;
  document.body.append(sentence);
}
new ResizeObserver(tellHeight).observe(document.body);
