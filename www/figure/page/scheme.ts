/** Light or dark: what the element was told, else what its surroundings are. */

import { css } from 'lit';
import { channels } from '../../ui/theme.ts';

/**
 * Colours around a figure. `shade` is the share of black that colours for white paper need to stand out as far on this ground.
 * `strength` is the share of the text's colour that muted text needs to be legible. Without `text` the figure's own colour holds.
 */
export type Surroundings = { ground: string, text: string, shade: string, strength: string, scheme: 'light' | 'dark' };

export const THEMES = ['auto', 'light', 'dark'] as const;

/**
 * The probe stands outside of the surface: its colours are those that the page hands down, and the
 * transition makes every change of them an event.
 */
export const schemeStyles = css`
  .scheme-probe {
    position: absolute;
    visibility: hidden;
    forced-color-adjust: none;
    transition: 1ms;
  }
`;

/** Of text on a page that paints no ground, as where it is an image, and says nothing by `color-scheme`. */
const DARK = '#121212';

/** Shares of the text's colour in what is muted, hundredths: the least that is legible. On most pages that is the first. */
const STRENGTHS = [75, 80, 85, 90, 95];

/** Least contrast of text by WCAG 2, level AA, is 4.5; a screen rounds colours. */
const LEGIBLE = 4.55;

/** @returns itself and what is around it, across shadow roots, the nearest first */
export function ancestors(node: Node): Element[] {
  const all = [];
  let at: any = node;
  for (; at; at = at.assignedSlot ?? at.parentNode ?? at.host) if (at.nodeType === 1) all.push(at);
  return all;
}

/**
 * The ground on which the figure stands, with the text there. They are dark where the ground is darker than the text:
 * so it is also with a page whose own switch changes colours alone. Text that is illegible on the ground is not taken.
 */
export function surroundings(probe: Element): Surroundings {
  const { color, borderTopColor: canvas, colorScheme } = getComputedStyle(probe);
  const ink = channels(color);
  const unsaid = colorScheme === 'normal' && lightness(ink) > 0.5;
  const grounds = ancestors(probe).map((each) => getComputedStyle(each).backgroundColor);
  const ground = channels(...[...grounds, unsaid ? DARK : canvas].reverse());
  const light = lightness(ground);
  const isLegible = contrast(ink, ground) >= LEGIBLE;
  const scheme = light < (isLegible ? lightness(ink) : 0.5) ? 'dark' : 'light';
  // By luminance, of which a light of 0.5 has some 0.5 ** 2.2. What is nearly white needs none.
  const shade = scheme === 'light' && light < 0.97 ? `${100 * (1 - light ** 2.2)}%` : '';
  const muted = (share: number) => ground.map((channel, i) => channel + (share / 100) * (ink[i] - channel));
  const strength = isLegible ? `${STRENGTHS.find((share) => contrast(muted(share), ground) >= LEGIBLE) ?? 100}%` : '';
  return { ground: `rgb(${ground})`, text: isLegible ? color : '', shade, strength, scheme };
}

/** WCAG 2's. */
function contrast(one: number[], other: number[]) {
  const linear = (channel: number) => (channel > 10 ? ((channel / 255 + 0.055) / 1.055) ** 2.4 : channel / 3294.6);
  const [low, high] = [one, other].map((colour) => lightness(colour.map((channel) => 255 * linear(channel)))).sort((a, b) => a - b);
  return (high + 0.05) / (low + 0.05);
}

/** @returns from 0, black, to 1 */
function lightness([red, green, blue]: number[]): number {
  // Rec. 709 weights.
  return (0.2126 * red + 0.7152 * green + 0.0722 * blue) / 255;
}
