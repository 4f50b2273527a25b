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
export function listElementAndAncestors(startNode: Node): Element[] {
  const elementAndAncestors = [];
  let currentNode: any = startNode;
  for (; currentNode; currentNode = currentNode.assignedSlot ?? currentNode.parentNode ?? currentNode.host) if (currentNode.nodeType === 1) elementAndAncestors.push(currentNode);
  return elementAndAncestors;
}

/** Reads the colours around a figure. The scheme is dark if the background is darker than the text, or darker than medium grey if the text is illegible. */
export function readPageColours(colourProbe: Element): PageColours {
  const { color, borderTopColor: canvasColour, colorScheme } = getComputedStyle(colourProbe);
  const textColour = colourChannelsOf(color);
  const isDarkByDefault = colorScheme === 'normal' && lightnessOf(textColour) > 0.5;
  const ancestorBackgrounds = listElementAndAncestors(colourProbe).map((ancestorElement) => getComputedStyle(ancestorElement).backgroundColor);
  const backgroundColour = colourChannelsOf(...[...ancestorBackgrounds, isDarkByDefault ? DARK_BACKGROUND : canvasColour].reverse());
  const backgroundLightness = lightnessOf(backgroundColour);
  const isLegible = contrastRatioOf(textColour, backgroundColour) >= MIN_CONTRAST;
  const colourScheme = backgroundLightness < (isLegible ? lightnessOf(textColour) : 0.5) ? 'dark' : 'light';
  // Darker backgrounds need darker lines. Nearly white backgrounds need no darkening.
  const darkening = colourScheme === 'light' && backgroundLightness < 0.97 ? `${100 * (1 - backgroundLightness ** 2.2)}%` : '';
  const mixMutedColour = (textPercent: number) => backgroundColour.map((channelValue, i) => channelValue + (textPercent / 100) * (textColour[i] - channelValue));
  const mutedShare = isLegible ? `${MUTED_SHARES.find((textShare) => contrastRatioOf(mixMutedColour(textShare), backgroundColour) >= MIN_CONTRAST) ?? 100}%` : '';
  return { background: `rgb(${backgroundColour})`, text: isLegible ? color : '', darkening, mutedShare, scheme: colourScheme };
}

function contrastRatioOf(firstColour: number[], secondColour: number[]) {
  const linearizeChannel = (channelValue: number) => (channelValue > 10 ? ((channelValue / 255 + 0.055) / 1.055) ** 2.4 : channelValue / 3294.6);
  const [darkerLightness, lighterLightness] = [firstColour, secondColour].map((rgbColour) => lightnessOf(rgbColour.map((channelValue) => 255 * linearizeChannel(channelValue)))).sort((a, b) => a - b);
  return (lighterLightness + 0.05) / (darkerLightness + 0.05);
}

/** Returns the lightness from 0, black, to 1, with the weights of Rec. 709. */
function lightnessOf([redValue, greenValue, blueValue]: number[]): number {
  return (0.2126 * redValue + 0.7152 * greenValue + 0.0722 * blueValue) / 255;
}
