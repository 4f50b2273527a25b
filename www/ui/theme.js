/**
 * The palette: one colour a role, the same in every view, for light and dark paper. The hues are
 * Okabe and Ito's, with lightness spread so that the roles stay apart under every common form of
 * colour blindness; each role also has a dash or a shape of its own. Text on the paper keeps a
 * contrast of at least 4.5, and lines at least 3. A page may give each role a colour of its own, by a
 * custom property that begins with --motion.
 */

import { css } from 'lit';

/**
 * Roles that the canvas needs as resolved colours; each is a custom property of the same name. A cloud is a
 * prediction too, but a mass of dots rather than a line or text.
 */
const ROLES = /** @type {const} */ (
  ['paper', 'ink', 'muted', 'rule', 'prior', 'prediction', 'cloud', 'truth', 'posterior', 'accent']
);

/** @typedef {Record<(typeof ROLES)[number], string>} Palette resolved CSS colours */

export const theme = css`
  :host {
    --paper: var(--motion-paper, light-dark(#fffefb, #16181b));
    --ink: var(--motion-ink, light-dark(#1f1e1b, #ebe9e3));
    --muted: var(--motion-muted, light-dark(#5e5b54, #a8a59c));
    --rule: var(--motion-rule, light-dark(#d9d5cb, #3a3d42));
    --prior: var(--motion-prior, light-dark(#0b61b0, #5a9ff0));
    --prediction: var(--motion-prediction, light-dark(#b85300, #f0963a));
    --cloud: var(--motion-cloud, light-dark(#dd6f00, #f0963a));
    --truth: var(--motion-truth, light-dark(#8a8a8a, #8e8e8e));
    --posterior: var(--motion-posterior, light-dark(#00694a, #4fe3b0));
    --accent: var(--motion-accent, light-dark(#7a1560, #fbb4e0));
    display: block;
    container-type: inline-size;
    font-family: var(
      --motion-font,
      'Iowan Old Style', 'Palatino Linotype', Palatino, 'URW Palladio L', 'Source Serif 4',
      'Times New Roman', serif
    );
    font-size: 1rem;
    line-height: 1.4;
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

  /* A change of any role is an event: see schemeStyles. */
  .scheme-probe {
    border-color: var(--paper) var(--ink) var(--muted) var(--rule);
    caret-color: var(--truth);
    column-rule-color: var(--cloud);
    fill: var(--posterior);
    outline-color: var(--prior);
    stroke: var(--accent);
    text-decoration-color: var(--prediction);
  }

  .surface {
    background: var(--paper);
    color: var(--ink);
  }

  .title-slot {
    margin: 0 0 0.3rem;
    font-size: 1.1rem;
  }

  .caption-slot {
    margin: 0.5rem 0 0;
    font-size: 0.95rem;
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

  /* On paper: the figure and what it was made with, and nothing that wants to be pressed. */
  @media print {
    .surface {
      color-scheme: light !important;
    }

    .stage {
      position: static !important;
    }

    .machine {
      min-height: 0 !important;
    }

    :is(button, input, textarea, summary, .handle, .effect, .marked, .visually-hidden),
    label:has(input:not(:checked)) {
      display: none !important;
    }

    fieldset {
      display: block !important;
    }

    .folds {
      border: 0 !important;
    }

    .slider {
      display: inline-flex !important;
      gap: 0.4rem;
      margin: 0 1.5rem 0 0 !important;
    }

    .printed {
      visibility: visible !important;
    }

    .roomy::after,
    .reserved {
      display: none !important;
    }

    figure,
    table,
    .stage,
    fieldset {
      break-inside: avoid;
    }
  }
`;

/**
 * The palette as the element sees it now.
 *
 * @param {HTMLElement} surface
 */
export function resolvePalette(surface) {
  // One for each role: all are there before the first is asked, so that the browser styles them once.
  const swatches = ROLES.map((role) => {
    const swatch = document.createElement('span');
    swatch.hidden = true;
    swatch.style.color = `var(--${role})`;
    // In forced colours too, the roles keep their hues.
    swatch.style.forcedColorAdjust = 'none';
    return swatch;
  });
  surface.append(...swatches);
  const colours = swatches.map((swatch, i) => [ROLES[i], getComputedStyle(swatch).color]);
  for (const swatch of swatches) swatch.remove();
  return /** @type {Palette} */ (Object.fromEntries(colours));
}

/** @type {OffscreenCanvasRenderingContext2D | undefined} */
let pixel;

/**
 * @param {string} colour in any form that the browser knows: a page may have named it
 * @returns {[number, number, number]} red, green, blue, 0 to 255
 */
export function channels(colour) {
  // As browsers hand most colours out.
  const plain = colour.match(/^rgb\((\d+), (\d+), (\d+)\)$/);
  if (plain) return [Number(plain[1]), Number(plain[2]), Number(plain[3])];
  const context = (pixel ??= /** @type {OffscreenCanvasRenderingContext2D} */ (
    new OffscreenCanvas(1, 1).getContext('2d', { willReadFrequently: true })
  ));
  context.clearRect(0, 0, 1, 1);
  context.fillStyle = colour;
  context.fillRect(0, 0, 1, 1);
  const [red, green, blue] = context.getImageData(0, 0, 1, 1).data;
  return [red, green, blue];
}
