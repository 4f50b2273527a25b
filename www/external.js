/**
 * As motion-widgets.js, with the WebAssembly module in a file of its own and each widget in another, which is
 * loaded when its tag is met: in the document, or in an open shadow root.
 *
 * @module
 */
import { widgets } from '../build/widgets.js';

export { load } from './core.js';
export { setMessages } from './messages/registry.js';

/** Those that were not met yet. */
const waiting = new Set(Object.keys(widgets));

/** @param {ParentNode} root a document, a shadow root, or an element with all that is in it */
function meet(root) {
  for (const tag of waiting) {
    const met = root instanceof Element && root.localName === tag ? root : root.querySelector(tag);
    if (!met) continue;
    waiting.delete(tag);
    widgets[tag]();
  }
  const elements = root instanceof Element ? [root, ...root.querySelectorAll('*')] : root.querySelectorAll('*');
  for (const { shadowRoot } of elements) if (shadowRoot) watch(shadowRoot);
}

/** @type {MutationObserver | undefined} */
const observer =
  typeof MutationObserver === 'undefined'
    ? undefined
    : new MutationObserver((changes) => {
        for (const { addedNodes } of changes) {
          for (const node of addedNodes) if (node instanceof Element) meet(node);
        }
        if (waiting.size === 0) observer?.disconnect();
      });

/** @type {WeakSet<Node>} */
const watched = new WeakSet();

/** @param {Document | ShadowRoot} root */
function watch(root) {
  if (waiting.size === 0 || watched.has(root)) return;
  watched.add(root);
  observer?.observe(root, { childList: true, subtree: true });
  meet(root);
}

// Where there is no DOM, as in Node, no tag is met.
if (observer) watch(document);
