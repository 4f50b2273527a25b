/** Colours of the page around a figure, and adjustments of the figure's palette to the page's background. */

import { colourChannelsOf } from './theme.ts';

/**
 * Colours around a figure. `darkening` is the amount by which colours are darkened for this background. `mutedShare` is the share of the
 * text colour in muted text. An empty `text` keeps the figure's own colour.
 */
type PageColours = { background: string, text: string, darkening: string, mutedShare: string, scheme: 'light' | 'dark' };

/** Background assumed on a page that has light text, but neither a background nor a `color-scheme`. */
const DARK_BACKGROUND = '#121212';

/** Shares of the text colour in muted text, percent. The first one that is legible is used. */
const MUTED_SHARES = [75, 80, 85, 90, 95];

/** Minimum contrast of text: 4.5 by WCAG 2, level AA, and a margin for rounding. */
const MIN_CONTRAST = 4.55;

/** Returns a node's element and its ancestors across shadow roots, the nearest first. */
export function listElementAndAncestors(node: Node): Element[] {
  const elements = [];
  let ancestor: any = node;
  for (; ancestor; ancestor = ancestor.assignedSlot ?? ancestor.parentNode ?? ancestor.host) if (ancestor.nodeType === 1) elements.push(ancestor);
  return elements;
}

/** Reads the colours around a figure. The scheme is dark if the background is darker than legible text, or than medium grey if the text is not legible. */
export function readPageColours(colourProbe: Element): PageColours {
  const { color, borderTopColor: canvasColour, colorScheme } = getComputedStyle(colourProbe);
  const textColour = colourChannelsOf(color);
  const isDarkByDefault = colorScheme === 'normal' && lightnessOf(textColour) > 0.5;
  const ancestorBackgrounds = listElementAndAncestors(colourProbe).map((ancestor) => getComputedStyle(ancestor).backgroundColor);
  const backgroundColour = colourChannelsOf(...[...ancestorBackgrounds, isDarkByDefault ? DARK_BACKGROUND : canvasColour].reverse());
  const backgroundLightness = lightnessOf(backgroundColour);
  const isLegible = contrastRatioOf(textColour, backgroundColour) >= MIN_CONTRAST;
  const scheme = backgroundLightness < (isLegible ? lightnessOf(textColour) : 0.5) ? 'dark' : 'light';
  // Darker backgrounds need darker lines. Nearly white backgrounds need no darkening.
  const darkening = scheme === 'light' && backgroundLightness < 0.97 ? `${100 * (1 - backgroundLightness ** 2.2)}%` : '';
  const mixMutedColour = (share: number) => backgroundColour.map((channel, i) => channel + (share / 100) * (textColour[i] - channel));
  const mutedShare = isLegible ? `${MUTED_SHARES.find((share) => contrastRatioOf(mixMutedColour(share), backgroundColour) >= MIN_CONTRAST) ?? 100}%` : '';
  return { background: `rgb(${backgroundColour})`, text: isLegible ? color : '', darkening, mutedShare, scheme };
}

function contrastRatioOf(firstColour: number[], secondColour: number[]) {
  const linearizeChannel = (channel: number) => (channel > 10 ? ((channel / 255 + 0.055) / 1.055) ** 2.4 : channel / 3294.6);
  const [darkerLightness, lighterLightness] = [firstColour, secondColour].map((colour) => lightnessOf(colour.map((channel) => 255 * linearizeChannel(channel)))).sort((a, b) => a - b);
  return (lighterLightness + 0.05) / (darkerLightness + 0.05);
}

/** Returns the lightness from 0, black, to 1, with the weights of Rec. 709. */
function lightnessOf([red, green, blue]: number[]): number {
  return (0.2126 * red + 0.7152 * green + 0.0722 * blue) / 255;
}
