/** Symbols of lines and marks in legends. */

import { html, nothing, svg } from 'lit';

/** Style of a line or mark, in the picture and in the legend. */
export interface LineStyle {
  role: keyof import('./theme.ts').Palette;
  /** Dash pattern, CSS pixels. */
  dash?: number[];
  /** Line width, CSS pixels. */
  width?: number;
  /** Symbol in the legend; default: line. */
  shape?: 'line' | 'dot' | 'ring' | 'area' | 'cross';
}

/** Returns the symbol of a legend item: a line, dot, ring or area in its style. */
export function swatchHtml({ role, dash, width = 2.25, shape = 'line' }: LineStyle) {
  const shapes = {
    line: svg`<line x1="1" x2="29" y1="6" y2="6" stroke-width=${width} stroke-dasharray=${dash?.join(' ') ?? nothing} />`,
    dot: svg`<circle fill="var(--role)" cx="15" cy="6" r="3" />`,
    ring: svg`<circle cx="15" cy="6" r="4" stroke-width=${width} />`,
    area: svg`<rect fill="var(--role)" x="4" y="1" width="22" height="10" opacity="0.4" />`,
    cross: svg`<path d="M11 2l8 8m0 -8l-8 8" stroke-width=${width} />`,
  };
  return html`<svg class="swatch" viewBox="0 0 30 12" aria-hidden="true" data-role=${role}>${shapes[shape]}</svg>`;
}
