/**
 * Substitutes for globals that libraries and elements ask for while they are imported. Where there is no DOM, as in Node, a page generator
 * may import the elements, and nothing is defined.
 */

const { HTMLElement = class {}, customElements = { get: () => true }, document = { createTreeWalker() {} } } =
  globalThis as any;

export { HTMLElement, customElements, document };
