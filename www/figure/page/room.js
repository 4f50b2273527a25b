/** How high figures are, as style sheets have it; also before anything else of them has come. */

import { likedWidth } from '../../ui/width.js';

/** @import { Room } from './reserve.js' */

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

/**
 * The heights of the elements before their script is there.
 *
 * @param {Record<string, Room>} rooms by the tag
 */
export function keptTillThen(rooms) {
  const waiting = (/** @type {string | string[]} */ tags) => `:is(${tags}):not(:defined)`;
  const all = waiting(Object.keys(rooms));
  return [
    `${all}{display:block;position:relative;min-width:0;max-width:100%}`,
    `${all}::before{${likedWidth}}`,
    `${all}>:not([slot]){position:absolute;top:0;margin:0}`,
    ...Object.entries(rooms).map(([tag, room]) => `${waiting(tag)}::before{padding-top:${roomLength(room, '%')}}`),
    highScreen(all),
  ].join('\n');
}
