/**
 * The part of MyST's theme that shows widgets, alone on a page: what the parser made of the chapter, by the theme's own
 * renderer. The link takes it away and brings it back, as the theme does for another chapter.
 */

import { createElement, useState } from 'react';
import { createRoot } from 'react-dom/client';
import { ANY_RENDERERS } from '@myst-theme/anywidget';
import nodes from './nodes.json';

function Chapter() {
  const [here, setHere] = useState(true);
  const turn = createElement('button', { onClick: () => setHere(!here) }, here ? 'Next chapter' : 'Back');
  const figures = nodes.map((node) => createElement(ANY_RENDERERS.anywidget, { key: node.id, node }));
  return createElement('main', {}, turn, here ? figures : createElement('p', {}, 'Another chapter'));
}

createRoot(/** @type {HTMLElement} */ (document.querySelector('#root'))).render(createElement(Chapter));
