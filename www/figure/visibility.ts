/** Visibility of a figure, which starts near the viewport and draws only within it. */

import { FigureController } from './controller.ts';

/** Distance from the viewport at which a figure starts. Less would show empty frames; more would start unseen figures. */
const NEAR_MARGIN_CSS = '600px';

export class Visibility extends FigureController {
  #isNear = false;
  #visibleObserver: IntersectionObserver | undefined;

  hostConnected() {
    const { host } = this;
    const visibilityOf = new Map<Element, boolean>();
    const setVisible = (entries: IntersectionObserverEntry[]) => {
      for (const { target, isIntersecting } of entries) visibilityOf.set(target, isIntersecting);
      if (entries.length > 0) host.renderer.setVisible([...visibilityOf.values()].includes(true));
    };
    const visibleObserver = (this.#visibleObserver = new IntersectionObserver(setVisible));
    const updateNear = (entries: IntersectionObserverEntry[]) => {
      // A start depends on the visibility, but the order of the observers' callbacks is undefined.
      setVisible(visibleObserver.takeRecords());
      for (const { isIntersecting } of entries) this.#setNear(isIntersecting);
    };
    const nearObserver = new IntersectionObserver(updateNear, { rootMargin: NEAR_MARGIN_CSS });
    for (const observer of [visibleObserver, nearObserver]) {
      observer.observe(host);
      host.connection.signal.addEventListener('abort', () => observer.disconnect());
    }
    // The script that defines the element may still call `load(source)`.
    queueMicrotask(() => {
      this.#checkPosition();
      this.hostUpdated();
    });
  }

  hostDisconnected() {
    this.#isNear = false;
    // A later update must not make the disconnected observer observe again.
    this.#visibleObserver = undefined;
    this.host.renderer.setVisible(false);
  }

  /** Observes the content too. A sticky picture stays in sight while the page scrolls on, outside of the element's box. */
  hostUpdated() {
    const content = this.host.shadowRoot?.querySelector('.simulation');
    if (content) this.#visibleObserver?.observe(content);
  }

  /** Checks the position of the figure now: the observers report it a frame later. */
  #checkPosition() {
    const { top, bottom } = this.host.getBoundingClientRect();
    // The box of a removed element is all 0.
    if (top >= innerHeight || bottom <= 0) return;
    this.host.renderer.setVisible(true);
    this.#setNear(true);
  }

  #setNear(isNear: boolean) {
    if (isNear && !this.#isNear) void this.host.runtime.start();
    this.#isNear = isNear;
  }
}
