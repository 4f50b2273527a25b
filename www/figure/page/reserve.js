/** Room for a figure that is not there yet, so that what is below it stays where it is. */

import { css, unsafeCSS } from 'lit';

/**
 * @typedef {[width: number, height: number, share: number][]} Room how high a figure is at least from a width of its own on,
 *   em, and by how many hundredths of its width more, as pictures grow with it; widths ascending from 0. A test holds it to
 *   the truth: nothing is higher as it opens, nor more than a few lines lower.
 */

/** Narrower than this, em, pictures have at most a share of the screen: see the phone's rules in ui/layout.js. */
const PHONE = 30;

/**
 * The room as a length of CSS, which is that of its one row that is meant for the width: a million of what is missing from
 * any other is taken away from it. A row ends before the width where the next begins, by less than a layout can tell.
 *
 * @param {Room} room
 * @param {(hundredths: number) => string} share of the figure's width
 * @param {boolean} [high] whether the screen is so high that a phone's pictures have 38svh each where they are 80 hundredths
 */
export function roomLength(room, share, high = false) {
  const rows = room.map(([width, height, hundredths], i) => {
    const grown = share(hundredths);
    const [all, to] = [share(100), room[i + 1]?.[0]];
    const off = [`${width}em - ${all}`, ...(to ? [`${all} - ${to}em + .01px`] : [])];
    const pictures = high && width < PHONE ? `min(${grown},${(hundredths * 38) / 80}svh)` : grown;
    return `${height}em + ${pictures} - 1e6*max(0em,${off})`;
  });
  return `max(${rows})`;
}

/** A screen that is so high. */
export const HIGH = '(min-height: 37.5em)';

/** The figure keeps it for good: it is as high as it was before it was there. @param {Room} room */
export function reserve(room) {
  const rule = (/** @type {boolean} */ high) => `.reserved, .machine { min-height: ${roomLength(room, (share) => `${share}cqi`, high)} }`;
  return css`
    ${unsafeCSS(`${rule(false)} @media ${HIGH} { ${rule(true)} }`)}
  `;
}
