/** Creates elements by name, for frames and notebooks. */

import { settings } from '../build/settings.js';

const WIDGET_TAGS = Object.keys(settings);

/** Attributes of every HTML element that affect a widget. */
export const GLOBAL_ATTRIBUTES = ['dir', 'lang'];

/** Creates a widget that is not in a page yet. Throws an error that lists the names of all widgets if the name is not one of them. */
export function createWidget(widgetName: unknown): HTMLElement {
  const widgetTag = WIDGET_TAGS.find((knownTag) => knownTag === widgetName);
  if (widgetTag) return document.createElement(widgetTag);
  throw new Error(`widget is ${widgetName === null || widgetName === undefined ? 'missing' : JSON.stringify(widgetName)}; allowed is ${WIDGET_TAGS.join(' or ')}`);
}

/** Returns a paragraph with the error instead of a figure. `requesterName` names the page or cell that requested the figure. */
export const createErrorParagraph = (requesterName: string, error: unknown) =>
  Object.assign(document.createElement('p'), { role: 'alert', textContent: `${requesterName} shows no figure: ${(error as Error).message}.` });
