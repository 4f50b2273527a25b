/**
 * Substitutes for globals of the DOM that Lit and the elements read while they are imported. Without a DOM, as in Node, a page generator may import the
 * elements; no element is defined then.
 */

const { HTMLElement = class {}, customElements = { get: () => true }, document = { createTreeWalker() {} } } =
  globalThis as any;

export { HTMLElement, customElements, document };
