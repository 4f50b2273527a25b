/**
 * The page's fragment as a place for states: each element has a part of its own, and leaves all others
 * as they are: `#plain-anchor&banana-machine.1=…&map-squeeze:my-id=…`.
 *
 * @module
 */

import { escaped } from '../scene/svg.js';

/**
 * The name of an element's part: its id, or where it has none, its place among its kind on the page.
 *
 * @param {Element} element
 */
export function keyOf(element) {
  const { localName, id } = element;
  if (id) return `${localName}:${encodeURIComponent(id)}`;
  const kind = [...document.querySelectorAll(localName)];
  return `${localName}.${kind.indexOf(element) + 1}`;
}

/**
 * @param {string} key
 * @returns {string | undefined} what the fragment has for it
 */
export function fragmentOf(key) {
  return parts().find((part) => part.startsWith(`${key}=`))?.slice(key.length + 1);
}

/**
 * @param {string} key
 * @param {string} text
 * @returns {string} the page's address with it
 */
export function addressWith(key, text) {
  const part = `${key}=${text}`;
  const all = parts();
  const at = all.findIndex((each) => each.startsWith(`${key}=`));
  const next = at < 0 ? [...all, part] : all.with(at, part);
  // In full: a base element of the page does not matter then.
  return `${location.href.replace(/#.*$/s, '')}#${next.join('&')}`;
}

/**
 * Puts a text into the page's address. The page does not move, and going back does not lead through it.
 *
 * @param {string} key
 * @param {string} text
 */
export function writeFragment(key, text) {
  const address = addressWith(key, text);
  if (address === location.href) return;
  try {
    history.replaceState(history.state, '', address);
  } catch {
    // A page that was put together by a script has no address to write.
  }
}

function parts() {
  return location.hash.slice(1).split('&').filter((part) => part !== '');
}

let anchored = false;

/**
 * Goes to the page's own anchor, once: a browser looks for the whole fragment, states included, and does
 * not find it.
 */
export function goToAnchor() {
  if (anchored || document.querySelector(':target')) return;
  anchored = true;
  const [first = ''] = parts();
  if (first.includes('=') || parts().length < 2) return;
  // On a reload the browser goes back to where the reader was.
  const [navigation] = /** @type {PerformanceNavigationTiming[]} */ (performance.getEntriesByType('navigation'));
  if (navigation?.type !== 'navigate') return;
  document.getElementById(decoded(first))?.scrollIntoView();
}

/** @param {string} text */
function decoded(text) {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}

/**
 * HTML for a page that has the script beside it.
 *
 * @param {string} name of the element
 * @param {[string, string][]} attributes
 */
export function embedding(name, attributes) {
  const script = tag('script', [['type', 'module'], ['src', 'motion-widgets.js']]);
  return `${script}\n${tag(name, attributes)}\n`;
}

/**
 * @param {string} name
 * @param {[string, string][]} attributes
 */
function tag(name, attributes) {
  return `<${name}${attributes.map(([key, text]) => ` ${key}="${escaped(text)}"`).join('')}></${name}>`;
}
