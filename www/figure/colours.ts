/** Colours of a figure: those of the page around it, those of its own theme, or light ones in print. */

import { elementAndAncestors, readPageColours } from '../ui/page-colours.ts';
import { resolvePalette, type Palette } from '../ui/theme.ts';
import { FigureController } from './controller.ts';

export class Colours extends FigureController {
  #palette: Palette | undefined;

  hostConnected() {
    // A background has its final colour at the end of its transition.
    const onTransitionEnd = ({ target, propertyName }: TransitionEvent) => {
      if (propertyName === 'background-color' && elementAndAncestors(this.host).includes(target as Element)) this.applyAndDraw();
    };
    document.addEventListener('transitionend', onTransitionEnd, { signal: this.host.lifetime.signal });
  }

  /** Colours of the roles, for canvases. */
  get palette() {
    return (this.#palette ??= resolvePalette(this.#find('.surface')));
  }

  /** Updates the colours from the page and the theme, and draws. */
  applyAndDraw() {
    this.applyPageColours();
    this.host.renderer.requestFrame();
  }

  /** Uses the colours of the page, or the figure's own colours if its theme differs from the page's. In print the theme is light. */
  applyPageColours() {
    const surfaceStyle = this.#find('.surface')?.style;
    if (!surfaceStyle) return;
    const { renderer: { isPrinting }, theme } = this.host;
    const { scheme, ...pageColours } = readPageColours(this.#find('.scheme-probe'));
    // Forced colours override the theme.
    const followsPage = theme === 'auto' || matchMedia('(forced-colors: active)').matches;
    surfaceStyle.colorScheme = isPrinting ? 'light' : followsPage ? scheme : theme;
    const hasOwnColours = isPrinting || surfaceStyle.colorScheme !== scheme;
    for (const [name, colour] of Object.entries(pageColours)) surfaceStyle.setProperty(`--${name}`, hasOwnColours ? '' : colour);
    surfaceStyle.setProperty('--back', hasOwnColours ? 'var(--paper)' : '');
    // Colours that the page sets for its background do not fit the figure's own.
    for (const role of ['muted', 'rule']) surfaceStyle.setProperty(`--mw-${role}`, hasOwnColours ? 'initial' : '');
    this.#palette = undefined;
  }

  #find(selector: string) {
    return this.host.renderRoot?.querySelector(selector) as HTMLElement;
  }
}
