/** Lines and marks of a picture that a reader can hide: their state, and the legend whose entries are their toggles. */

import { html, nothing, svg } from 'lit';
import { words } from '../messages/registry.js';
import { rich, toggle } from '../ui/controls.js';
import { WORDS } from './attributes.js';
import { subset } from './checks.js';

/**
 * @typedef {object} LineStyle how something is drawn, in the picture and in the legend
 * @property {keyof import('../ui/theme.js').Palette} role
 * @property {number[]} [dash] CSS pixels
 * @property {number} [width] CSS pixels
 * @property {'line' | 'dot' | 'ring' | 'area' | 'cross'} [mark] a line by default
 */

/**
 * Returns the attribute and the state of what can be hidden.
 *
 * @param {readonly string[]} names
 * @param {readonly string[]} [opening] names of what is shown when the figure opens
 * @returns {{ attribute: import('./attributes.js').Attribute & import('./attributes.js').Own, state: import('./state.js').Owned }}
 */
export function overlaysOf(names, opening = names) {
  return {
    attribute: { kind: WORDS, own: true, words: names },
    state: { opening, check: (field, overlays) => subset(field, overlays, names) },
  };
}

/**
 * Returns the legend of a figure's pictures. The words are those of `overlays` in the catalogue.
 *
 * @param {import('./figure.js').Figure} figure
 * @param {Record<string, LineStyle>} styles in the order of the entries; what they leave out stays as it is
 * @param {Record<string, string>} [notes] words after the names of entries
 */
export function legend(figure, styles, notes = {}) {
  const { overlays } = figure.state.own;
  const { overlays: names } = /** @type {any} */ (words)[figure.kind.vocabulary];
  const all = Object.keys(styles);
  const every = /** @type {string[]} */ (figure.kind.attributes.overlays.words);
  const choose = (/** @type {string} */ name, /** @type {boolean} */ shown) =>
    figure.gesture.choose('overlays', every.filter((each) => (each === name ? shown : overlays.includes(each))));
  const light = (/** @type {string | null} */ name) => (figure.highlight = name);
  return html`<div class="legend" part="legend" role="group" aria-label=${words.legend}>
    ${all.map((name) => html`<span @pointerenter=${() => light(name)} @pointerleave=${() => light(null)} @focusin=${() => light(name)} @focusout=${() => light(null)}>
      ${toggle({
        label: html`${swatch(styles[name])}<span>${rich(names[name])}${notes[name] ? `: ${notes[name]}` : nothing}</span>`,
        checked: overlays.includes(name),
        change: (shown) => choose(name, shown),
      })}
    </span>`)}
  </div>`;
}

/** Returns a sample of how something is drawn. @param {LineStyle} style */
export function swatch({ role, dash, width = 2.25, mark = 'line' }) {
  const shapes = {
    line: svg`<line x1="1" x2="29" y1="6" y2="6" stroke-width=${width} stroke-dasharray=${dash?.join(' ') ?? nothing} />`,
    dot: svg`<circle class="filled" cx="15" cy="6" r="3" />`,
    ring: svg`<circle cx="15" cy="6" r="4" stroke-width=${width} />`,
    area: svg`<rect class="filled" x="4" y="1" width="22" height="10" opacity="0.4" />`,
    cross: svg`<path d="M11 2l8 8m0 -8l-8 8" stroke-width=${width} />`,
  };
  return html`<svg class="swatch" viewBox="0 0 30 12" aria-hidden="true" data-role=${role}>${shapes[mark]}</svg>`;
}
