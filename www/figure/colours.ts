/** Colours of a figure: those of the page around it, those of its own theme, or light ones in print. */

import { ancestors, readPageColours } from '../ui/page-colours.ts';
import { resolvePalette, type Palette } from '../ui/theme.ts';
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
