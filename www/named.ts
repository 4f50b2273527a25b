/** Creates elements by name, for frames and notebooks. */

import { settings } from './settings.js';

const TAGS = Object.keys(settings);

/** Attributes of every HTML element that a widget may heed. */
export const GLOBAL = ['dir', 'lang'];

/** Returns a widget that is on no page yet. Throws an error that names what is allowed. */
export function elementNamed(name: unknown): HTMLElement {
  const tag = TAGS.find((each) => each === name);
  if (tag) return document.createElement(tag);
  throw new Error(`widget is ${name === null || name === undefined ? 'missing' : JSON.stringify(name)}; allowed is ${TAGS.join(' or ')}`);
}

/** Returns a paragraph with the error instead of a figure. `who` names the page or cell that requested the figure. */
export function sorry(who: string, error: unknown) {
  const sentence = document.createElement('p');
  sentence.setAttribute('role', 'alert');
  sentence.textContent = `${who} shows no figure: ${(error as Error).message}.`;
  return sentence;
}
