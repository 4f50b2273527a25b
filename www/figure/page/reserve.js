/** Room for a figure that is not there yet, so that what is below it stays where it is. */

import { css, unsafeCSS } from 'lit';

/**
 * @typedef {[width: number, height: number, share: number][]} Room how high a figure is at least from a width of its own on,
 *   em, and by how many hundredths of its width more, as pictures grow with it; widths ascending from 0. Lines break where the
 *   letters say, so it is the most that a usual serif, a usual sans-serif and, from 30 em on, a wide one need: a test holds it
 *   to the truth, that nothing is higher as it opens, nor many lines lower. On a phone a wide font is higher by a few lines,
 *   below what is in sight.
 */

/** Narrower than this, em, pictures have at most a share of the screen: see the phone's rules in ui/layout.js. */
const PHONE = 30;

/**
 * The room as a length of CSS, which is that of its one row that is meant for the width: a million of what is missing from
 * any other is taken away from it. A row ends before the width where the next begins, by less than a layout can tell.
 *
 * @param {Room} room
 * @param {'%' | 'cqi'} unit the hundredth of the figure's width
 */
export function roomLength(room, unit) {
  const rows = room.map(([from, height, share], i) => {
    const to = room[i + 1]?.[0];
    const off = [...(from ? [`${from}em - 100${unit}`] : []), ...(to ? [`100${unit} - ${to}em + .01px`] : [])];
    // 38svh each, where they are 80 hundredths high.
    const pictures = from < PHONE ? `min(${share}${unit},${(share * 38) / 80}*var(--svh,1e4px))` : share + unit;
    return `${height}em + ${pictures} - 1e6*max(0em,${off})`;
  });
  return `max(${rows})`;
}

/** On a low screen, a phone's pictures have all of their height. @param {string} selector of the element */
export const highScreen = (selector) => `@media (min-height:37.5em){${selector}{--svh:1svh}}`;

/** The figure keeps it for good: it is as high as it was before it was there. @param {Room} room */
export const reserve = (room) => css`
  ${unsafeCSS(`.reserved,.machine{min-height:${roomLength(room, 'cqi')}}${highScreen(':host')}`)}
`;
