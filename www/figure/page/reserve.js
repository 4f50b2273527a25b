/** Room for a figure that is not there yet, so that what is below it stays where it is. */

import { css, unsafeCSS } from 'lit';

/**
 * @param {[width: number, height: number, share: number][]} steps about how high the figure is from a width of its own on, rem,
 *   and by how many hundredths of its width more, as pictures grow with it; widths ascending from 0. A test holds them to
 *   the truth within two lines of text.
 */
export function reserve(steps) {
  const rules = steps.map(
    ([width, height, share]) =>
      `@container (width >= ${width}rem) { .reserved, .opening { min-height: calc(${height}rem + ${share}cqi) } }`,
  );
  return css`
    ${unsafeCSS(rules.join('\n'))}
  `;
}
