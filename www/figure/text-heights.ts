/** Heights of the texts above the controls, so that a control stays in its place while the user drags it. */

import { language } from '../messages/registry.ts';
import { FigureController } from './controller.ts';

const CHANGING_TEXTS = ':is(p, dl, li, .result):not(.result > *, .slider *, details *, .about, .on-paper)';

/** Keeps the largest height of each text at the present width of the figure and in the present language. */
export class TextHeights extends FigureController {
  #textElements: Set<HTMLElement> = new Set();
  #sizeObserver: ResizeObserver | undefined;
  #lastWidth = 0;
  #language = '';

  hostUpdated() {
    this.#sizeObserver ??= new ResizeObserver((entries) => this.#keepHeights(entries));
    for (const textElement of this.host.renderRoot.querySelectorAll<HTMLElement>(CHANGING_TEXTS)) {
      if (!this.#textElements.has(textElement)) this.#sizeObserver.observe(textElement);
      this.#textElements.add(textElement);
    }
  }

  /** Keeps new heights, which are never below the kept ones, or measures all texts again. */
  #keepHeights(entries: ResizeObserverEntry[]) {
    const { clientWidth } = this.host;
    if (clientWidth === this.#lastWidth && language === this.#language) {
      for (const { target, contentRect } of entries) (target as HTMLElement).style.minHeight = `${contentRect.height}px`;
      return;
    }
    [this.#lastWidth, this.#language] = [clientWidth, language];
    // Changing a size now would call the observer again in this frame.
    requestAnimationFrame(() => {
      this.#sizeObserver?.disconnect();
      for (const textElement of this.#textElements) textElement.style.minHeight = '';
      this.#textElements.clear();
      this.hostUpdated();
    });
  }
}
