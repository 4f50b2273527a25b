/** What happens inside of a figure and is no business of the page around it. */

/** Fields take every key. */
const FIELD = 'textarea, input:not([type=range], [type=radio], [type=checkbox])';

/** Sliders and radio buttons take those that move them. */
const MOVES = /Arrow|Page|Home|End/;

/**
 * A key that was used goes no further: a book around the figure would turn its page by it, as to the book it comes from no
 * field or slider.
 *
 * @param {KeyboardEvent} event
 */
export function keepUsed(event) {
  const { key, ctrlKey, altKey, metaKey, defaultPrevented } = event;
  const target = /** @type {Element} */ (event.target);
  const native = target.matches(FIELD) ? key !== 'Escape' : target.matches('input') && MOVES.test(key);
  if (defaultPrevented || (native && !ctrlKey && !altKey && !metaKey)) event.stopPropagation();
}

/** The native controls' own events stay inside: the element has one of its own for each gesture. @param {Event} event */
export function stop(event) {
  event.stopPropagation();
}
