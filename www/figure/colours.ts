/** Colours of a figure: those of the page around it, of its theme, or of paper. */

import { resolvePalette, type Palette } from '../ui/theme.ts';
import { ancestors, surroundings } from './page/scheme.ts';
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
    return (this.#palette ??= resolvePalette(this.#find('.surface')));
  }

  /** Updates the colours from the page and the theme, and draws. */
  update() {
    this.resolve();
    this.host.stage.requestFrame();
  }

  /** Sets the colours of the surroundings, or those of the figure if its theme differs from the scheme around it. Paper is light. */
  resolve() {
    const style = this.#find('.surface')?.style;
    if (!style) return;
    const { stage: { printing }, theme } = this.host;
    const { scheme, ...around } = surroundings(this.#find('.scheme-probe'));
    // Forced colours override the theme.
    const isAuto = theme === 'auto' || matchMedia('(forced-colors: active)').matches;
    style.colorScheme = printing ? 'light' : isAuto ? scheme : theme;
    const isOwnTheme = printing || style.colorScheme !== scheme;
    for (const [name, colour] of Object.entries(around)) style.setProperty(`--${name}`, isOwnTheme ? '' : colour);
    style.setProperty('--back', isOwnTheme ? 'var(--paper)' : '');
    // Colours that the page sets for its background do not fit the figure's own.
    for (const name of ['muted', 'rule']) style.setProperty(`--mw-${name}`, isOwnTheme ? 'initial' : '');
    this.#palette = undefined;
  }

  #find(selector: string) {
    return this.host.renderRoot?.querySelector(selector) as HTMLElement;
  }
}
