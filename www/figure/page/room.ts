/** Heights that are kept free for figures, so that the text below one stays in its place while the figure loads. */

import { css, unsafeCSS } from 'lit';
import { likedWidth } from '../../ui/width.ts';

/** Least widths of the width classes, em: at these figures put their pictures side by side, or their controls. */
const WIDTHS = [0, 30, 38, 56];

/**
 * Heights by the tag and the width class: in the middle of those measured as the figures open, up to a width of 80 em, in a usual
 * font. A number is in em.
 */
const HEIGHTS: Record<string, (number | string)[]> = {
  'banana-machine': [82.5, 64, 51, 51.5],
  'map-squeeze': [76, 76.5, 43, 44.5],
  'arc-anatomy': [73, 68, 45, 46],
  'odometry-decomposer': [104, 92, 'clamp(44.5em, 100svh - 0.5em, 55.5em)', 'clamp(43.5em, 100svh - 1em, 51.5em)'],
  'dead-reckoning': [101, 52, 46, 38.5],
  'alpha-calibrator': [89, 89, 44.5, 39],
};

/**
 * Height for whatever width. Outside of its class a height loses a million times the distance to it, so that the class decides.
 *
 * @param unit a hundredth of the figure's width
 */
function heightOf(tag: string, unit: '%' | 'cqi') {
  const heights = HEIGHTS[tag].map((height, i) => {
    const [least, next] = [WIDTHS[i], WIDTHS[i + 1]];
    const above = next ? ` - 1e6*max(0em,100${unit} - ${next - 0.001}em)` : '';
    return `${typeof height === 'number' ? `${height}em` : height} - 1e6*max(0em,${least}em - 100${unit})${above}`;
  });
  return `max(${heights})`;
}

/** Returns the style of a figure that is as high as the room that was kept for it. */
export const reserve = (tag: string) => {
  const height = heightOf(tag, 'cqi');
  return css`
    ${unsafeCSS(`.reserved{min-height:${height}}.machine{min-height:calc(${height} + var(--motion-sticky-bottom,0px))}`)}
  `;
};

/** Style sheet of a page: the room for elements before their script has defined them. */
export function roomBefore() {
  const tags = Object.keys(HEIGHTS);
  const waiting = (each: string | string[]) => `:is(${each}):not(:defined)`;
  return [
    `${waiting(tags)}{display:block;position:relative;min-width:0;max-width:100%}`,
    `${waiting(tags)}::before{${likedWidth}}`,
    `${waiting(tags)}>:not([slot]){position:absolute;top:0;margin:0}`,
    ...tags.map((tag) => `${waiting(tag)}::before{padding-top:${heightOf(tag, '%')}}`),
  ].join('\n');
}
