/**
 * Script of a page with one widget, for an iframe. The query has the tag of the widget and its attributes:
 * `embed.html?widget=banana-machine&omega=0.8`. The frame sends its height to the page around it by
 * messages `{ type: 'motion-widgets:height', height }`, in CSS pixels.
 */

import './de.ts';
import { GLOBAL_ATTRIBUTES, createWidget, createErrorParagraph } from './named.ts';

/** Returns the widget that a query describes. If a parameter is not allowed, throws an error that names it and lists the allowed ones. */
function createWidgetFromQuery(urlQuery: URLSearchParams) {
  const widget = createWidget(urlQuery.get('widget'));
  const tagName = widget.localName;
  const allowedParameters = [...(widget.constructor as any).observedAttributes, ...GLOBAL_ATTRIBUTES];
  for (const [parameterName, parameterValue] of urlQuery) {
    if (parameterName === 'widget') continue;
    if (!allowedParameters.includes(parameterName)) {
      throw new Error(`${parameterName} is an unknown parameter of ${tagName}; allowed are ${allowedParameters.sort().join(', ')}`);
    }
    if (urlQuery.getAll(parameterName).length > 1) throw new Error(`${parameterName} is given more than once; allowed is once`);
    widget.setAttribute(parameterName, parameterValue);
  }
  return widget;
}

try {
  document.body.append(createWidgetFromQuery(new URLSearchParams(location.search)));
} catch (error) {
  document.body.append(createErrorParagraph('This address', error));
}
new ResizeObserver(() => {
  const height = Math.ceil(document.body.getBoundingClientRect().height);
  // The message is sent to pages of any origin ('*'), because the height is no secret.
  parent.postMessage({ type: 'motion-widgets:height', height }, '*');
}).observe(document.body);
