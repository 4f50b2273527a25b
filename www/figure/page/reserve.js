/** Room for a figure that is not there yet, so that what is below it stays where it is. */

import { css, unsafeCSS } from 'lit';

/**
 * @param {[width: number, height: number][]} steps about how high the figure is from a width of its own on, rem,
 *   widths ascending from 0; tests hold them to the truth within a few lines of text
 */
export function reserve(steps) {
  const rules = steps.map(([width, height]) => `@container (width >= ${width}rem) { .reserved, .opening { min-height: ${height}rem } }`);
  return css`
    ${unsafeCSS(rules.join('\n'))}
  `;
}
