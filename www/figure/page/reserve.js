/** Room for a figure that is not there yet, so that what is below it stays where it is. */

import { css, unsafeCSS } from 'lit';
import { highScreen, roomLength } from './room.js';

/**
 * @typedef {[width: number, height: number, share: number][]} Room how high a figure is at least from a width of its own on,
 *   em, and by how many hundredths of its width more, as pictures grow with it; widths ascending from 0. Lines break where the
 *   letters say, so it is the most that a usual serif, a usual sans-serif and, from 30 em on, a wide one need: a test holds it
 *   to the truth, that nothing is higher as it opens, nor many lines lower. On a phone a wide font is higher by a few lines,
 *   below what is in sight.
 */

/** The figure keeps it for good: it is as high as it was before it was there. @param {Room} room */
export const reserve = (room) => css`
  ${unsafeCSS(`.reserved,.machine{min-height:${roomLength(room, 'cqi')}}${highScreen(':host')}`)}
`;
