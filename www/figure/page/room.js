/** Heights that are kept free for figures, so that the text below one stays in its place while the figure loads. */

import { css, unsafeCSS } from 'lit';
import { likedWidth } from '../../ui/width.js';

/**
 * Heights by the tag, em: below a width of 30 em, from there on, and from 56 em on. They are measured as the figures open,
 * in a usual font.
 *
 * @type {Record<string, [narrow: number, middle: number, wide: number]>}
 */
const HEIGHTS = {
  'banana-machine': [84, 40.5, 38],
  'map-squeeze': [63, 39.5, 37],
  'arc-anatomy': [60, 48, 46],
  'odometry-decomposer': [78, 37.5, 37.5],
  'dead-reckoning': [90, 42, 33],
  'alpha-calibrator': [90, 42.5, 35],
};

/**
 * Height for whatever width: a million times the excess is subtracted from the height of a narrower class.
 *
 * @param {string} tag
 * @param {'%' | 'cqi'} unit a hundredth of the figure's width
 */
function heightOf(tag, unit) {
  const [narrow, middle, wide] = HEIGHTS[tag];
  const below = (/** @type {number} */ height, /** @type {number} */ width) => `${height}em - 1e6*max(0em,100${unit} - ${width - 0.001}em)`;
  return `max(${wide}em,${below(middle, 56)},${below(narrow, 30)})`;
}

/** Style of a figure: it is as high as the room that was kept for it. @param {string} tag */
export const reserve = (tag) => css`
  ${unsafeCSS(`.reserved,.machine{min-height:${heightOf(tag, 'cqi')}}`)}
`;

/** Style sheet of a page: the room for elements before their script has defined them. */
export function roomBefore() {
  const tags = Object.keys(HEIGHTS);
  const waiting = (/** @type {string | string[]} */ each) => `:is(${each}):not(:defined)`;
  return [
    `${waiting(tags)}{display:block;position:relative;min-width:0;max-width:100%}`,
    `${waiting(tags)}::before{${likedWidth}}`,
    `${waiting(tags)}>:not([slot]){position:absolute;top:0;margin:0}`,
    ...tags.map((tag) => `${waiting(tag)}::before{padding-top:${heightOf(tag, '%')}}`),
  ].join('\n');
}
