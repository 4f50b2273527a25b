/** Room for a figure that is not there yet, so that what is below it stays where it is. */

import { css, unsafeCSS } from 'lit';

/**
 * @typedef {[width: number, height: number, share: number][]} Room how high a figure is at least from a width of its own on,
 *   rem, and by how many hundredths of its width more, as pictures grow with it; widths ascending from 0. A test holds it to
 *   the truth: nothing is higher as it opens, nor more than two lines lower.
 */

/** Narrower than this, rem, pictures have at most a share of the screen: see the phone's rules in ui/layout.js. */
const PHONE = 30;

/**
 * @param {Room} room
 * @param {string} selector of what keeps it, inside of an element of the figure's width
 * @returns {string} rules of CSS
 */
export function roomRules(room, selector) {
  return room
    .map(([width, height, share]) => {
      const rule = (/** @type {string} */ more) =>
        `@container (width >= ${width}rem) { ${selector} { min-height: calc(${height}rem + ${more}) } }`;
      // 38svh each, where pictures are 80cqi high.
      const lower = `@media (min-height: 37.5rem) { ${rule(`min(${share}cqi, ${(share * 38) / 80}svh)`)} }`;
      return rule(`${share}cqi`) + (width < PHONE ? lower : '');
    })
    .join('\n');
}

/** The figure keeps it for good: it is as high as it was before it was there. @param {Room} room */
export const reserve = (room) => css`
  ${unsafeCSS(roomRules(room, '.reserved, .machine'))}
`;
