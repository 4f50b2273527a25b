/** Lines and marks that a user can hide: their state, and the legend that toggles them. */

import { html, nothing, svg } from 'lit';
import { words } from '../messages/registry.ts';
import { formatMarkup, toggle } from '../ui/controls.ts';
import type { LineStyle } from '../scene/draw.ts';

/** Returns the legend of a figure's pictures, with names from the catalogue. `extraEntries` have no toggle. */
export function legend(figure: import('./figure.ts').Figure, styles: Record<string, LineStyle>, extraEntries: unknown = nothing) {
  const { overlays } = figure.state.elementState;
  const { overlays: names } = (words as any)[figure.definition.messageKey];
  const styleNames = Object.keys(styles);
  const allOverlays = figure.definition.attributes.overlays.words as string[];
  const setShown = (name: string, shown: boolean) =>
    figure.gesture.choose('overlays', allOverlays.filter((overlay) => (overlay === name ? shown : overlays.includes(overlay))));
  const highlight = (name: string | null) => (figure.highlight = name);
  return html`<div class="legend" part="legend" role="group" aria-label=${words.legend}>
    ${styleNames.map((name) => html`<span @pointerenter=${() => highlight(name)} @pointerleave=${() => highlight(null)} @focusin=${() => highlight(name)} @focusout=${() => highlight(null)}>
      ${toggle({
        label: html`${swatchHtml(styles[name])}<span>${formatMarkup(names[name])}</span>`,
        checked: overlays.includes(name),
        change: (shown) => setShown(name, shown),
      })}
    </span>`)}
    ${extraEntries}
  </div>`;
}

/** Returns the symbol of a legend item: a line, dot, ring or area in its style. */
export function swatchHtml({ role, dash, width = 2.25, mark = 'line' }: LineStyle) {
  const markShapes = {
    line: svg`<line x1="1" x2="29" y1="6" y2="6" stroke-width=${width} stroke-dasharray=${dash?.join(' ') ?? nothing} />`,
    dot: svg`<circle fill="var(--role)" cx="15" cy="6" r="3" />`,
    ring: svg`<circle cx="15" cy="6" r="4" stroke-width=${width} />`,
    area: svg`<rect fill="var(--role)" x="4" y="1" width="22" height="10" opacity="0.4" />`,
    box: svg`<rect x="9" y="2" width="12" height="8" rx="2" stroke-width=${width} />`,
    cross: svg`<path d="M11 2l8 8m0 -8l-8 8" stroke-width=${width} />`,
  };
  return html`<svg class="swatch" viewBox="0 0 30 12" aria-hidden="true" data-role=${role}>${markShapes[mark]}</svg>`;
}
