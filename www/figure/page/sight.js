/**
 * Which elements are in sight, and which are near enough to be made ready: two observers for all of a
 * page.
 *
 * @module
 */

/**
 * @typedef {object} Sighted
 * @property {() => void} approach it is near enough to be made ready
 * @property {(inSight: boolean) => void} sight
 */

/**
 * How far from the window a figure is made ready. Less would show readers who scroll fast an empty
 * frame; more would compute what few of them get to.
 */
const AHEAD = '600px';

/** @type {IntersectionObserver | undefined} */
let nearness;
/** @type {IntersectionObserver | undefined} */
let presence;

/**
 * Tells an element when it comes near and, from now on, whether it is in sight.
 *
 * @param {Element & Sighted} element
 */
export function watch(element) {
  nearness ??= new IntersectionObserver(
    (entries) => {
      for (const { target, isIntersecting } of entries) if (isIntersecting) sighted(target).approach();
    },
    { rootMargin: AHEAD },
  );
  presence ??= new IntersectionObserver((entries) => {
    for (const { target, isIntersecting } of entries) sighted(target).sight(isIntersecting);
  });
  nearness.observe(element);
  presence.observe(element);
}

/** @param {Element} element */
export function unwatch(element) {
  nearness?.unobserve(element);
  presence?.unobserve(element);
}

/** @param {Element} element */
function sighted(element) {
  return /** @type {Element & Sighted} */ (element);
}
