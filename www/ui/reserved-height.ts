/** Heights reserved for figures, so that the text below does not move when they load. */

import { unsafeCSS } from 'lit';
import { preferredWidthCss } from './theme.ts';

/** Bounds of the width classes, em, where the layout changes. */
const WIDTH_CLASS_BOUNDS_EM = [20, 30, 38, 46, 56, 80];

/** Heights in em by tag and width class, at the lower and the upper bound of the class. Measured in a window 900 px high, with a small margin. */
const HEIGHTS_EM: Record<string, ([number, number] | string)[]> = {
  'banana-machine': [[90, 87], [71, 60], [53, 51], [51, 50.5], [51, 56.5]],
  'map-squeeze': [[80, 75], [75, 71], [42, 42], [42, 46], [46.5, 44]],
  'arc-anatomy': [[75.5, 75.5], [75.5, 69], [41.5, 43.5], [43.5, 49.5], [49, 48.5]],
  'odometry-decomposer': [[99, 101], [97, 92.5], 'clamp(44.9em, 100svh - 0.1em, 56.1em)', 'clamp(44.9em, 100svh - 0.1em, 56.1em)', 'clamp(45.1em, 100svh + 0.1em, 52.7em)'],
  'dead-reckoning': [[93, 105], [65, 48], [48.5, 43.5], [43.5, 49], [41, 42]],
  'alpha-calibrator': [[102.5, 107.5], [105.5, 97.5], [54, 56.5], [56.5, 59.5], [42.5, 41]],
};

/** Returns the height for any width as a CSS maximum over the classes. Outside of its class, the term of a class is a large negative number. */
function heightCssOf(elementTag: string, lengthUnit: '%' | 'cqi') {
  const heightTerms = HEIGHTS_EM[elementTag].map((height, i, { length }) => {
    const [lowerBoundEm, upperBoundEm] = [WIDTH_CLASS_BOUNDS_EM[i], WIDTH_CLASS_BOUNDS_EM[i + 1]];
    const clampedWidth = `min(100${lengthUnit},${upperBoundEm}em)`;
    const interpolateHeight = (startEm: number, endEm: number) => `${startEm}em + ${((endEm - startEm) / (upperBoundEm - lowerBoundEm)).toFixed(3)}*(${clampedWidth} - ${lowerBoundEm}em)`;
    const penaltyBelow = i > 0 ? ` - 1e6*max(0em,${lowerBoundEm}em - 100${lengthUnit})` : '';
    const penaltyAbove = i === length - 1 ? '' : ` - 1e6*max(0em,100${lengthUnit} - ${upperBoundEm - 0.001}em)`;
    return `${typeof height === 'string' ? height : interpolateHeight(...height)}${penaltyBelow}${penaltyAbove}`;
  });
  return `max(${heightTerms})`;
}

export const reservedHeightCssOf = (elementTag: string) =>
  unsafeCSS(`.reserved,.simulation{--height:${heightCssOf(elementTag, 'cqi')};min-height:var(--height)}.simulation{min-height:calc(var(--height) + var(--motion-sticky-bottom,0px))}`);

/** Returns the style sheet that reserves heights until the elements are defined. */
export function createPreUpgradeCss() {
  const elementTags = Object.keys(HEIGHTS_EM);
  const composeUndefinedSelector = (elementSelectors: string | string[]) => `:is(${elementSelectors}):not(:defined)`;
  return [
    `${composeUndefinedSelector(elementTags)}{display:flow-root;position:relative;min-width:0;max-width:100%}`,
    `${composeUndefinedSelector(elementTags)}::before{${preferredWidthCss}}`,
    `${composeUndefinedSelector(elementTags)}>:not([slot]){position:absolute;top:0;margin:0}`,
    // The title and caption of an element that is not defined yet look as they do in the figure.
    `:where(${composeUndefinedSelector(elementTags)}>[slot=title]){display:block;font-size:1.1em;line-height:1.4}`,
    `:where(${composeUndefinedSelector(elementTags)}:has(>[slot=title]))::before{margin-bottom:.297em}`,
    `:where(${composeUndefinedSelector(elementTags)}>[slot=caption]){font-size:.95em;line-height:1.4}`,
    ...elementTags.map((elementTag) => `${composeUndefinedSelector(elementTag)}::before{padding-top:${heightCssOf(elementTag, '%')}}`),
  ].join('\n');
}
