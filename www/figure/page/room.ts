/** Heights reserved for figures, so that the text below does not move when they load. */

import { css, unsafeCSS } from 'lit';
import { likedWidth } from '../../ui/width.ts';

/** Bounds of the width classes, em, where the layout changes. */
const WIDTHS = [20, 30, 38, 56, 80];

/** Heights by tag and width class, at both bounds of the class, in em: lines just above measurements in a window 900 px high. */
const HEIGHTS: Record<string, ([number, number] | string)[]> = {
  'banana-machine': [[85.9, 86.1], [70.9, 63.5], [51.7, 54], [50.2, 55.5]],
  'map-squeeze': [[81.7, 85], [79.7, 78.9], [43.2, 48.8], [50.3, 44.1]],
  'arc-anatomy': [[80.8, 70.7], [73.8, 68.2], [42.2, 56.5], [50.9, 47.9]],
  'odometry-decomposer': [[104.5, 108.5], [94.4, 95], 'clamp(44.8em, 100svh - 0.3em, 56.3em)', 'clamp(44.7em, 100svh - 0.4em, 51.7em)'],
  'dead-reckoning': [[95.8, 111.4], [58.4, 52.6], [51.4, 50.7], [38.7, 42.8]],
  'alpha-calibrator': [[88.7, 104.6], [100.9, 92.6], [46.8, 52.5], [36.4, 45.1]],
};

/** Returns the height for any width, as a maximum to which each class adds −10⁶ times the distance outside of it. */
function heightOf(tag: string, unit: '%' | 'cqi') {
  const heights = HEIGHTS[tag].map((height, i, { length }) => {
    const [least, next] = [WIDTHS[i], WIDTHS[i + 1]];
    const width = `min(100${unit},${next}em)`;
    const line = (from: number, to: number) => `${from}em + ${((to - from) / (next - least)).toFixed(3)}*(${width} - ${least}em)`;
    const below = i > 0 ? ` - 1e6*max(0em,${least}em - 100${unit})` : '';
    const above = i === length - 1 ? '' : ` - 1e6*max(0em,100${unit} - ${next - 0.001}em)`;
    return `${typeof height === 'string' ? height : line(...height)}${below}${above}`;
  });
  return `max(${heights})`;
}

/** Returns the style that reserves the height of a figure. */
export const reserve = (tag: string) => {
  const height = heightOf(tag, 'cqi');
  return css`
    ${unsafeCSS(`.reserved{min-height:${height}}.machine{min-height:calc(${height} + var(--motion-sticky-bottom,0px))}`)}
  `;
};

/** Returns the style sheet that reserves heights until the elements are defined. */
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
