/** Elements for hosts that say by a word which they want: frames and notebooks. */

import { settings } from './settings.js';

const TAGS = Object.keys(settings);

/** What every element of HTML has, and a widget may heed. */
export const GLOBAL = ['dir', 'lang'];

/**
 * @returns a widget, on no page yet
 * @throws {Error} with a sentence that names what is allowed
 */
export function elementNamed(name: unknown): HTMLElement {
  const tag = TAGS.find((each) => each === name);
  if (tag) return document.createElement(tag);
  throw new Error(`widget is ${name === null || name === undefined ? 'missing' : JSON.stringify(name)}; allowed is ${TAGS.join(' or ')}`);
}

/**
 * The place of a figure that nobody can make.
 *
 * @param who asked for it
 */
export function sorry(who: string, error: unknown) {
  const sentence = document.createElement('p');
  sentence.setAttribute('role', 'alert');
  sentence.textContent = `${who} shows no figure: ${(error as Error).message}.`;
  return sentence;
}
