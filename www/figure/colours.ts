/** Colours of a figure: those of the page around it, those of its own theme, or light ones in print. */

import { colourChannels, resolvePalette, type Palette } from '../ui/theme.ts';
import { FigureController } from './controller.ts';

export class Colours extends FigureController {
  #palette: Palette | undefined;

  hostConnected() {
    // A background has its final colour at the end of its transition.
    const backgroundChanged = ({ target, propertyName }: TransitionEvent) => {
      if (propertyName === 'background-color' && ancestors(this.host).includes(target as Element)) this.update();
    };
    document.addEventListener('transitionend', backgroundChanged, { signal: this.host.connection.signal });
  }

  /** Colours of the roles, for canvases. */
  get palette() {
    return (this.#palette ??= resolvePalette(this.#probe('.surface')));
  }

  /** Updates the colours from the page and the theme, and draws. */
  update() {
    this.resolve();
    this.host.renderer.requestFrame();
  }

  /** Uses the colours of the page, or the figure's own colours if its theme differs from the page's. In print the theme is light. */
  resolve() {
    const style = this.#probe('.surface')?.style;
    if (!style) return;
    const { renderer: { isPrinting }, theme } = this.host;
    const { scheme, ...pageColours } = readPageColours(this.#probe('.scheme-probe'));
    // Forced colours override the theme.
    const isAuto = theme === 'auto' || matchMedia('(forced-colors: active)').matches;
    style.colorScheme = isPrinting ? 'light' : isAuto ? scheme : theme;
    const isOwnTheme = isPrinting || style.colorScheme !== scheme;
    for (const [name, colour] of Object.entries(pageColours)) style.setProperty(`--${name}`, isOwnTheme ? '' : colour);
    style.setProperty('--back', isOwnTheme ? 'var(--paper)' : '');
    // Colours that the page sets for its background do not fit the figure's own.
    for (const role of ['muted', 'rule']) style.setProperty(`--mw-${role}`, isOwnTheme ? 'initial' : '');
    this.#palette = undefined;
  }

  #probe(selector: string) {
    return this.host.renderRoot?.querySelector(selector) as HTMLElement;
  }
}

/**
 * Colours around a figure. `shade` is the amount by which colours are darkened for this background. `strength` is the share of the text
 * colour in muted text. An empty `text` keeps the figure's own colour.
 */
type PageColours = { ground: string, text: string, shade: string, strength: string, scheme: 'light' | 'dark' };

/** Background assumed on a page that has light text, but neither a background nor a `color-scheme`. */
const DARK_BACKGROUND = '#121212';

/** Shares of the text colour in muted text, percent. The first one that is legible is used. */
const MUTED_SHARES = [75, 80, 85, 90, 95];

/** Minimum contrast of text: 4.5 by WCAG 2, level AA, and a margin for rounding. */
const MIN_CONTRAST = 4.55;

/** Returns a node's element and its ancestors across shadow roots, the nearest first. */
function ancestors(node: Node): Element[] {
  const elements = [];
  let ancestor: any = node;
  for (; ancestor; ancestor = ancestor.assignedSlot ?? ancestor.parentNode ?? ancestor.host) if (ancestor.nodeType === 1) elements.push(ancestor);
  return elements;
}

/** Reads the colours around a figure. The scheme is dark if the background is darker than legible text, or than medium grey if the text is not legible. */
function readPageColours(probe: Element): PageColours {
  const { color, borderTopColor: canvas, colorScheme } = getComputedStyle(probe);
  const textColour = colourChannels(color);
  const isDarkByDefault = colorScheme === 'normal' && lightness(textColour) > 0.5;
  const ancestorBackgrounds = ancestors(probe).map((ancestor) => getComputedStyle(ancestor).backgroundColor);
  const backgroundColour = colourChannels(...[...ancestorBackgrounds, isDarkByDefault ? DARK_BACKGROUND : canvas].reverse());
  const backgroundLightness = lightness(backgroundColour);
  const isLegible = contrast(textColour, backgroundColour) >= MIN_CONTRAST;
  const scheme = backgroundLightness < (isLegible ? lightness(textColour) : 0.5) ? 'dark' : 'light';
  // The darkening grows with the darkness of the background. Nearly white backgrounds need none.
  const shade = scheme === 'light' && backgroundLightness < 0.97 ? `${100 * (1 - backgroundLightness ** 2.2)}%` : '';
  const mutedColour = (share: number) => backgroundColour.map((channel, i) => channel + (share / 100) * (textColour[i] - channel));
  const mutedStrength = isLegible ? `${MUTED_SHARES.find((share) => contrast(mutedColour(share), backgroundColour) >= MIN_CONTRAST) ?? 100}%` : '';
  return { ground: `rgb(${backgroundColour})`, text: isLegible ? color : '', shade, strength: mutedStrength, scheme };
}

function contrast(first: number[], second: number[]) {
  const linearChannel = (channel: number) => (channel > 10 ? ((channel / 255 + 0.055) / 1.055) ** 2.4 : channel / 3294.6);
  const [low, high] = [first, second].map((colour) => lightness(colour.map((channel) => 255 * linearChannel(channel)))).sort((a, b) => a - b);
  return (high + 0.05) / (low + 0.05);
}

/** Returns the lightness from 0, black, to 1, with the weights of Rec. 709. */
function lightness([red, green, blue]: number[]): number {
  return (0.2126 * red + 0.7152 * green + 0.0722 * blue) / 255;
}
