/** Creates elements by name, for frames and notebooks. */

import { settings } from '../build/settings.js';

const TAGS = Object.keys(settings);

/** Attributes of every HTML element that affect a widget. */
export const GLOBAL_ATTRIBUTES = ['dir', 'lang'];

/** Creates a widget that is not in a page yet. Throws an error that lists the names of all widgets if the name is not one of them. */
export function createWidget(name: unknown): HTMLElement {
  const tag = TAGS.find((candidate) => candidate === name);
  if (tag) return document.createElement(tag);
  throw new Error(`widget is ${name === null || name === undefined ? 'missing' : JSON.stringify(name)}; allowed is ${TAGS.join(' or ')}`);
}

/** Returns a paragraph with the error instead of a figure. `requester` names the page or cell that requested the figure. */
export const createErrorParagraph = (requester: string, error: unknown) =>
  Object.assign(document.createElement('p'), { role: 'alert', textContent: `${requester} shows no figure: ${(error as Error).message}.` });
