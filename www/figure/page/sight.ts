/** Which elements are in sight, and which are near enough to be made ready: two observers for all of a page. */

export interface Watcher {
  /** The element is near enough to be made ready. */
  onNear: () => void;
  onVisible: (inSight: boolean) => void;
}

/**
 * How far from the window a figure is made ready. Less would show readers who scroll fast an empty
 * frame; more would compute what few of them get to.
 */
const AHEAD = '600px';

const watchers: WeakMap<Element, Watcher> = new WeakMap();
/** Those that are near, and have been told. */
const near: WeakSet<Element> = new WeakSet();
// Both are there as soon as an element is watched.
let nearObserver: IntersectionObserver;
let visibleObserver: IntersectionObserver;

const watcherOf = (watched: Element) => watchers.get(watched) as Watcher;

/** Tells when an element comes near and, from now on, whether it is in sight. */
export function watch(element: Element, watcher: Watcher) {
  watchers.set(element, watcher);
  const report = (entries: IntersectionObserverEntry[]) => {
    for (const { target, isIntersecting } of entries) watcherOf(target).onVisible(isIntersecting);
  };
  visibleObserver ??= new IntersectionObserver(report);
  nearObserver ??= new IntersectionObserver(
    (entries) => {
      // Both have looked by now, and browsers call them in any order: what is made ready has to know whether it is seen.
      report(visibleObserver.takeRecords());
      for (const { target, isIntersecting } of entries) {
        if (isIntersecting) markNear(target);
        else near.delete(target);
      }
    },
    { rootMargin: AHEAD },
  );
  nearObserver.observe(element);
  visibleObserver.observe(element);
}

/**
 * Looks at once where an element is: what a page opens with need not wait for the observers, which look once a frame.
 *
 * @param element that is watched
 */
export function checkNow(element: Element) {
  const { top, bottom } = element.getBoundingClientRect();
  // What has gone meanwhile has no box, and so its bottom is at 0.
  if (top >= innerHeight || bottom <= 0) return;
  watcherOf(element).onVisible(true);
  markNear(element);
}

/** Once for each time that it comes near, whoever sees it first. */
function markNear(element: Element) {
  if (near.has(element)) return;
  near.add(element);
  watcherOf(element).onNear();
}

export function unwatch(element: Element) {
  nearObserver.unobserve(element);
  visibleObserver.unobserve(element);
  near.delete(element);
}
