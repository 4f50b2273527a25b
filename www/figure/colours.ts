/** Colours of a figure: those of the page around it, those of its own theme, or light ones in print. */

import { listElementAndAncestors, readPageColours } from '../ui/page-colours.ts';
import { resolvePalette, type ColourPalette } from '../ui/theme.ts';
import { FigureController } from './controller.ts';

export class FigureColours extends FigureController {
  #palette: ColourPalette | undefined;

  hostConnected() {
    // If a CSS transition changes the page's background, the figure has read a colour in between. At the end of the transition the colours are applied again.
    const onTransitionEnd = ({ target: transitionedElement, propertyName }: TransitionEvent) => {
      if (propertyName === 'background-color' && listElementAndAncestors(this.figure).includes(transitionedElement as Element)) this.applyAndDraw();
    };
    document.addEventListener('transitionend', onTransitionEnd, { signal: this.figure.lifetime.signal });
  }

  /** Resolved CSS colours by role, for drawing on canvases. */
  get palette() {
    return (this.#palette ??= resolvePalette(this.#findElement('.surface')));
  }

  /** Applies the colours of the page or theme to the figure, and redraws its pictures. */
  applyAndDraw() {
    this.applyPageColours();
    this.figure.renderer.requestFrame();
  }

  /** Sets the figure's custom properties to the page's colours, or to its own if its theme differs from the page's. In print the theme is light. */
  applyPageColours() {
    const surfaceStyle = this.#findElement('.surface')?.style;
    if (!surfaceStyle) return;
    const { renderer: { isPrinting }, theme } = this.figure;
    const { scheme: colourScheme, ...pageColours } = readPageColours(this.#findElement('.scheme-probe'));
    // Forced colours override the theme.
    const followsPage = theme === 'auto' || matchMedia('(forced-colors: active)').matches;
    surfaceStyle.colorScheme = isPrinting ? 'light' : followsPage ? colourScheme : theme;
    const hasOwnColours = isPrinting || surfaceStyle.colorScheme !== colourScheme;
    for (const [colourName, cssColour] of Object.entries(pageColours)) surfaceStyle.setProperty(`--${colourName}`, hasOwnColours ? '' : cssColour);
    surfaceStyle.setProperty('--back', hasOwnColours ? 'var(--paper)' : '');
    // The page's colours for muted text and rules would be illegible on the figure's own background, where they are not used.
    for (const colourRole of ['muted', 'rule']) surfaceStyle.setProperty(`--mw-${colourRole}`, hasOwnColours ? 'initial' : '');
    this.#palette = undefined;
  }

  #findElement(probeSelector: string) {
    return this.figure.renderRoot?.querySelector(probeSelector) as HTMLElement;
  }
}
