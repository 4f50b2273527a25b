/** Light or dark: what the element was told, else what its surroundings are. */

import { css } from 'lit';
import { channels } from '../../ui/theme.js';

/** @typedef {"light" | "dark" | ""} Surroundings empty where `color-scheme` says it */

export const THEMES = /** @type {const} */ (['auto', 'light', 'dark']);

/**
 * The probe stands outside of the surface: its colours are those that the page hands down, and the
 * transition makes every change of them an event.
 */
export const schemeStyles = css`
  .scheme-probe {
    position: absolute;
    visibility: hidden;
    forced-color-adjust: none;
    background-color: light-dark(#ffffff, #000000);
    transition: 1ms;
  }

  .surface.light {
    color-scheme: light;
  }

  .surface.dark {
    color-scheme: dark;
  }
`;

/**
 * What the surroundings are where they do not say so by `color-scheme`: dark where their text is light.
 * So it is with a page whose own switch changes colours alone.
 *
 * @param {Element} probe
 * @returns {Surroundings}
 */
export function surroundings(probe) {
  const { color, colorScheme } = getComputedStyle(probe);
  if (colorScheme !== 'normal') return '';
  return lightness(color) > 0.5 ? 'dark' : 'light';
}

/**
 * @param {string} colour in whatever notation
 * @returns {number} from 0, black, to 1
 */
function lightness(colour) {
  const [red, green, blue] = channels(colour);
  // Rec. 709 weights.
  return (0.2126 * red + 0.7152 * green + 0.0722 * blue) / 255;
}
