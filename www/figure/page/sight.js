/** Which elements are in sight, and which are near enough to be made ready: two observers for all of a page. */

/**
 * @typedef {object} Watcher
 * @property {() => void} approach the element is near enough to be made ready
 * @property {(inSight: boolean) => void} sight
 */

/**
 * How far from the window a figure is made ready. Less would show readers who scroll fast an empty
 * frame; more would compute what few of them get to.
 */
const AHEAD = '600px';

/** @type {WeakMap<Element, Watcher>} */
const watchers = new WeakMap();
/** Those that are near, and have been told. @type {WeakSet<Element>} */
const near = new WeakSet();
// Both are there as soon as an element is watched.
/** @type {IntersectionObserver} */
let nearness;
/** @type {IntersectionObserver} */
let presence;

const watcherOf = (/** @type {Element} */ watched) => /** @type {Watcher} */ (watchers.get(watched));

/**
 * Tells when an element comes near and, from now on, whether it is in sight.
 *
 * @param {Element} element
 * @param {Watcher} watcher
 */
export function watch(element, watcher) {
  watchers.set(element, watcher);
  const see = (/** @type {IntersectionObserverEntry[]} */ entries) => {
    for (const { target, isIntersecting } of entries) watcherOf(target).sight(isIntersecting);
  };
  presence ??= new IntersectionObserver(see);
  nearness ??= new IntersectionObserver(
    (entries) => {
      // Both have looked by now, and browsers call them in any order: what is made ready has to know whether it is seen.
      see(presence.takeRecords());
      for (const { target, isIntersecting } of entries) {
        if (isIntersecting) approach(target);
        else near.delete(target);
      }
    },
    { rootMargin: AHEAD },
  );
  nearness.observe(element);
  presence.observe(element);
}

/**
 * Looks at once where an element is: what a page opens with need not wait for the observers, which look once a frame.
 *
 * @param {Element} element that is watched
 */
export function look(element) {
  const { top, bottom } = element.getBoundingClientRect();
  // What has gone meanwhile has no box, and so its bottom is at 0.
  if (top >= innerHeight || bottom <= 0) return;
  watcherOf(element).sight(true);
  approach(element);
}

/** Once for each time that it comes near, whoever sees it first. @param {Element} element */
function approach(element) {
  if (near.has(element)) return;
  near.add(element);
  watcherOf(element).approach();
}

/** @param {Element} element */
export function unwatch(element) {
  nearness.unobserve(element);
  presence.unobserve(element);
  near.delete(element);
}
