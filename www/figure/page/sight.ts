/** Visibility of elements. The page has two observers, one for elements near the viewport and one for those in it. */

export interface Watcher {
  /** Runs when the element comes near the viewport. */
  onNear: () => void;
  onVisible: (inSight: boolean) => void;
}

/** Distance from the viewport at which a figure starts. Less would show empty frames; more would start unseen figures. */
const NEAR_MARGIN = '600px';

const watchers: WeakMap<Element, Watcher> = new WeakMap();
const near: WeakSet<Element> = new WeakSet();
// `watch` creates both observers for the first element.
let nearObserver: IntersectionObserver;
let visibleObserver: IntersectionObserver;

const watcherOf = (watched: Element) => watchers.get(watched) as Watcher;

/** Observes when an element comes near the viewport, and when it becomes visible or hidden. */
export function watch(element: Element, watcher: Watcher) {
  watchers.set(element, watcher);
  const report = (entries: IntersectionObserverEntry[]) => {
    for (const { target, isIntersecting } of entries) watcherOf(target).onVisible(isIntersecting);
  };
  visibleObserver ??= new IntersectionObserver(report);
  nearObserver ??= new IntersectionObserver(
    (entries) => {
      // A start depends on the visibility, but the order of the observers' callbacks is undefined.
      report(visibleObserver.takeRecords());
      for (const { target, isIntersecting } of entries) {
        if (isIntersecting) markNear(target);
        else near.delete(target);
      }
    },
    { rootMargin: NEAR_MARGIN },
  );
  nearObserver.observe(element);
  visibleObserver.observe(element);
}

/** Checks the position of a watched element now: observers would report it a frame later. */
export function checkNow(element: Element) {
  const { top, bottom } = element.getBoundingClientRect();
  // The box of a removed element is all 0.
  if (top >= innerHeight || bottom <= 0) return;
  watcherOf(element).onVisible(true);
  markNear(element);
}

/** Reports an element as near, once until it is far again. */
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
