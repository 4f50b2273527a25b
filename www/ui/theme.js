/**
 * The palette: one colour a role, the same in every view, for light and dark paper. The hues are
 * Okabe and Ito's, with lightness spread so that the roles stay apart under every common form of
 * colour blindness; each role also has a dash or a shape of its own. Text on the paper keeps a
 * contrast of at least 4.5, and lines at least 3.
 *
 * @module
 */

import { css } from 'lit';

/** Roles that the canvas needs as resolved colours; each is a custom property of the same name. */
const ROLES = /** @type {const} */ ([
  'paper',
  'ink',
  'muted',
  'rule',
  'prior',
  'prediction',
  'cloud',
  'truth',
  'posterior',
  'accent',
]);

export const theme = css`
  :host {
    --paper: light-dark(#fffefb, #16181b);
    --ink: light-dark(#1f1e1b, #ebe9e3);
    --muted: light-dark(#5e5b54, #a8a59c);
    --rule: light-dark(#d9d5cb, #3a3d42);
    --prior: light-dark(#0b61b0, #5a9ff0);
    --prediction: light-dark(#b85300, #f0963a);
    --cloud: light-dark(#dd6f00, #f0963a);
    --truth: light-dark(#8a8a8a, #8e8e8e);
    --posterior: light-dark(#00694a, #4fe3b0);
    --accent: light-dark(#7a1560, #fbb4e0);
    --serif:
      'Iowan Old Style', 'Palatino Linotype', Palatino, 'URW Palladio L', 'Source Serif 4',
      'Times New Roman', serif;

    display: block;
    container-type: inline-size;
    font: 1rem/1.4 var(--serif);
    font-variant-numeric: lining-nums tabular-nums;
    text-align: start;
  }

  :host([hidden]) {
    display: none;
  }

  /* Paper and ink are the reader's own then, and the roles keep their hues on it. */
  @media (forced-colors: active) {
    :host {
      --paper: Canvas;
      --ink: CanvasText;
      --muted: CanvasText;
      --rule: color-mix(in srgb, CanvasText 35%, Canvas);
    }
  }

  .surface {
    background: var(--paper);
    color: var(--ink);
  }

  .failure {
    margin: 0;
    padding: 1rem 0;
    border-block: 1px solid var(--rule);
  }

  .visually-hidden {
    position: absolute;
    width: 1px;
    height: 1px;
    overflow: hidden;
    clip-path: inset(50%);
    white-space: nowrap;
  }
`;

/**
 * The palette as the element sees it now.
 *
 * @param {HTMLElement} surface
 * @returns {import('../types.d.ts').Palette}
 */
export function resolvePalette(surface) {
  const swatch = document.createElement('span');
  swatch.hidden = true;
  // In forced colours too, the roles keep their hues.
  swatch.style.forcedColorAdjust = 'none';
  surface.append(swatch);
  const style = getComputedStyle(swatch);
  const colours = ROLES.map((role) => {
    swatch.style.color = `var(--${role})`;
    return [role, style.color];
  });
  swatch.remove();
  return Object.fromEntries(colours);
}

/**
 * @param {string} colour as `getComputedStyle` prints it, "rgb(r, g, b)"
 * @returns {[number, number, number]}
 */
export function channels(colour) {
  const [red = 0, green = 0, blue = 0] = (colour.match(/[\d.]+/g) ?? []).map(Number);
  return [red, green, blue];
}
