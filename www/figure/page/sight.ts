/** Visibility of elements, by two observers for the whole page: near the viewport, and in it. */

export interface Watcher {
  /** Called when the element comes near the viewport. */
  onNear: () => void;
  onVisible: (inSight: boolean) => void;
}

/** Distance from the viewport at which a figure starts. Less would show empty frames; more would start unseen figures. */
const NEAR_MARGIN = '600px';

const watchers: WeakMap<Element, Watcher> = new WeakMap();
const near: WeakSet<Element> = new WeakSet();
// The first watched element creates both.
let nearObserver: IntersectionObserver;
let visibleObserver: IntersectionObserver;

const watcherOf = (watched: Element) => watchers.get(watched) as Watcher;

/** Observes an element: when it comes near, and whether it is visible. */
export function watch(element: Element, watcher: Watcher) {
  watchers.set(element, watcher);
  const report = (entries: IntersectionObserverEntry[]) => {
    for (const { target, isIntersecting } of entries) watcherOf(target).onVisible(isIntersecting);
  };
  visibleObserver ??= new IntersectionObserver(report);
  nearObserver ??= new IntersectionObserver(
    (entries) => {
      // Browsers call observers in any order, and a start depends on the visibility.
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

/** Checks the position of a watched element now, as observers report a frame later. */
export function checkNow(element: Element) {
  const { top, bottom } = element.getBoundingClientRect();
  // A removed element has its bottom at 0.
  if (top >= innerHeight || bottom <= 0) return;
  watcherOf(element).onVisible(true);
  markNear(element);
}

/** Reports an element that comes near, once until it leaves. */
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
