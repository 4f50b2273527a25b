/**
 * Elements as in motion-widgets.js, but the WebAssembly module is a separate file. Each widget is a separate script, which is loaded when
 * its tag is found in the document or in an open shadow root.
 */

import { widgets } from '../build/widgets.js';
import { foundTags } from './core.ts';
import { createPreUpgradeCss } from './ui/reserved-height.ts';

export { load } from './core.ts';
export { setMessages } from './messages/registry.ts';

/** Returns true if a tag is that of a figure. Template compilers, such as Vue's, use this function to recognize custom elements. */
export const isFigureTag = (figureTag: string) => figureTag in widgets;

/** Tags of widgets whose scripts are not loaded yet. */
const undefinedTags = new Set(Object.keys(widgets).filter((figureTag) => !customElements.get(figureTag)));

/** Loads the widgets whose tags are in `searchRoot`. @param searchRoot a document, a shadow root, or an element with its descendants */
function defineWidgetsIn(searchRoot: ParentNode) {
  for (const element of [searchRoot, ...searchRoot.querySelectorAll('*')]) {
    if (!(element instanceof Element)) continue;
    const { localName } = element;
    if (undefinedTags.delete(localName)) {
      foundTags.add(localName);
      widgets[localName]();
    }
    // A widget contains no other widgets, so that its shadow root need not be searched.
    else if (localName in widgets) continue;
    else if (element.shadowRoot) watchRoot(element.shadowRoot);
    else if (!element.matches(':defined')) customElements.whenDefined(localName).then(() => element.shadowRoot && watchRoot(element.shadowRoot));
  }
}

const elementObserver: MutationObserver | undefined = globalThis.MutationObserver && new MutationObserver((domMutations) => {
  for (const { addedNodes } of domMutations) for (const addedNode of addedNodes) if (addedNode instanceof Element) defineWidgetsIn(addedNode);
  if (undefinedTags.size === 0) elementObserver?.disconnect();
});

const watchedRoots: WeakSet<Node> = new WeakSet();

function watchRoot(searchRoot: Document | ShadowRoot) {
  if (undefinedTags.size === 0 || watchedRoots.has(searchRoot)) return;
  watchedRoots.add(searchRoot);
  elementObserver?.observe(searchRoot, { childList: true, subtree: true });
  defineWidgetsIn(searchRoot);
}

// Without a DOM, as in Node, there is no document to search for tags.
if (elementObserver) {
  // Reserves the height of the elements, so that the page does not shift when they are defined.
  const reservedHeights = new CSSStyleSheet();
  reservedHeights.replaceSync(createPreUpgradeCss());
  document.adoptedStyleSheets.push(reservedHeights);
  watchRoot(document);
}
