/**
 * Palette: one colour for each role, the same in every view, for light and dark backgrounds. The background (paper) and the text (ink) have
 * the colours of the surroundings. Muted text has a colour between them. The hues are those of Okabe and Ito. Their lightness distinguishes
 * the roles under all common forms of colour blindness, and so do dashes and shapes. Text has a contrast of at least 4.5, and lines of at least 3. A
 * page can replace the colour of a role by a custom property that begins with --motion.
 */

import { css, html, nothing, svg, unsafeCSS } from 'lit';

/**
 * Roles whose resolved colours the canvas needs. Each is a custom property of the same name. A cloud is also a prediction, but needs another
 * colour, because it consists of many dots.
 */
const COLOUR_ROLES = ['paper', 'ink', 'muted', 'rule', 'prior', 'prediction', 'cloud', 'truth', 'posterior', 'accent'] as const;

/**
 * Styles of an invisible line of two dots with a wide space between them. In a container that fits its contents, such as a float, the line
 * gives a figure the width of a book's column. In a narrower container the line breaks at the space, and the figure is as wide as the container.
 */
export const preferredWidthCss =
  "content:'. .';display:block;height:0;overflow:hidden;visibility:hidden;white-space:normal;word-spacing:44em";

/** Resolved CSS colours by role. */
export type ColourPalette = Record<(typeof COLOUR_ROLES)[number], string>;

export const themeStyles = css`
  :host {
    display: block;
    min-width: 0;
    max-width: 100%;
    margin-block: 1em;
    font-family: var(--motion-font, inherit);
    line-height: 1.4;
    font-variant-numeric: lining-nums tabular-nums;
    text-align: start;
  }

  :host::before {
    ${unsafeCSS(preferredWidthCss)}
  }

  /*
   * Set by Colours: --background and --text are the background and text colour of the page, --darkening how far the background is from white, and
   * --mutedShare the percentage of the text colour in muted text.
   */
  .scheme-probe,
  .surface {
    --paper: var(--motion-paper, var(--background, light-dark(#fffefb, #16181b)));
    --ink: var(--motion-ink, var(--text, light-dark(#1f1e1b, #ebe9e3)));
    --muted: var(--motion-muted, var(--mw-muted, color-mix(in srgb, var(--ink) var(--mutedShare, 75%), var(--paper))));
    --rule: var(--motion-rule, var(--mw-rule, color-mix(in srgb, var(--ink) 18%, var(--paper))));
    --prior: var(--motion-prior, color-mix(in srgb-linear, light-dark(#0b61b0, #5a9ff0), black var(--darkening, 0%)));
    --prediction: var(--motion-prediction, color-mix(in srgb-linear, light-dark(#b85300, #f0963a), black var(--darkening, 0%)));
    --cloud: var(--motion-cloud, color-mix(in srgb-linear, light-dark(#dd6f00, #f0963a), black var(--darkening, 0%)));
    --truth: var(--motion-truth, color-mix(in srgb-linear, light-dark(#8a8a8a, #8e8e8e), black var(--darkening, 0%)));
    --posterior: var(--motion-posterior, color-mix(in srgb-linear, light-dark(#00694a, #4fe3b0), black var(--darkening, 0%)));
    --accent: var(--motion-accent, color-mix(in srgb-linear, light-dark(#7a1560, #fbb4e0), black var(--darkening, 0%)));
    --top: var(--motion-sticky-top, var(--mw-top, 0px));
  }

  /* These colours are set in a style sheet, because extensions that darken pages do not rewrite custom properties of elements. */
  ${unsafeCSS(COLOUR_ROLES.map((colourRole) => `[data-role='${colourRole}'] { --role: var(--${colourRole}); }`).join('\n'))}

  :host([hidden]) {
    display: none;
  }

  /* Probe that inherits the page's colours. Its transition fires an event when one of these colours changes. */
  .scheme-probe {
    forced-color-adjust: none;
    transition: 1ms;
    background: var(--motion-paper, transparent);
    color: var(--motion-ink);
    border-color: Canvas var(--muted) var(--rule);
    caret-color: var(--truth);
    column-rule-color: var(--cloud);
    fill: var(--posterior);
    outline-color: var(--prior);
    stroke: var(--accent);
    text-decoration-color: var(--prediction);
  }

  .surface {
    display: flow-root;
    container-type: inline-size;
    background: var(--motion-paper, var(--back));
    /* Margin around a figure whose theme differs from the page's. */
    box-shadow: 0 0 0 0.6em var(--back, transparent);
    color: var(--ink);
  }

  /* In forced colours, background and text have the system colours that the user has chosen, because browsers do not replace all colours
     of a page. The colours of the lines keep their hues. */
  @media (forced-colors: active) {
    .scheme-probe,
    .surface {
      --paper: Canvas;
      --ink: CanvasText;
      --muted: CanvasText;
      --rule: color-mix(in srgb, CanvasText 35%, Canvas);
      background: Canvas;
      color: CanvasText;
    }
  }

  .spoken {
    display: contents;
  }

  .title-slot {
    margin: 0 0 0.27em;
    font-size: 1.1em;
  }

  .caption-slot {
    margin: 0.53em 0 0;
    font-size: 0.95em;
  }

  .failure {
    margin: 0;
    padding: 1em 0;
    border-block: 1px solid var(--rule);
  }

  .visually-hidden {
    position: absolute;
    height: 1px;
    overflow: hidden;
    clip-path: inset(50%);
  }

  .on-paper {
    display: none;
  }

  /* A printed figure has pictures and settings, but no buttons. */
  @media print {
    /* If the disclosure with more sliders is closed, the values of their settings are printed as text. */
    .folds:not(:has(> #more[open])) + .on-paper {
      display: block;
    }

    /* Without this property, browsers do not print the background behind text. */
    .options .choice {
      print-color-adjust: exact;
    }

    .simulation {
      min-height: 0 !important;
    }

    /* The printed page has another width than the window. Canvases keep the aspect ratio of their pixels. */
    .stage canvas {
      height: auto !important;
      max-height: none !important;
      aspect-ratio: auto !important;
    }

    :is(button, input, textarea, summary, .notice, .handle, .end, .effect, .marked, .visually-hidden),
    :not(th, li) > label:has(input:not(:checked)) {
      display: none !important;
    }

    /* Labels of radio buttons in a table or list name the rows, and are all printed. The label of the selected row is bold. */
    :is(th, li) > label:has(input:checked) {
      font-weight: bold;
    }

    fieldset {
      display: block !important;
    }

    .folds {
      border: 0 !important;
    }

    .slider {
      display: inline-flex !important;
      gap: 0.4em;
      margin: 0 1.5em 0 0 !important;
    }

    :is(figure, table, .stage, fieldset) {
      break-inside: avoid;
    }
  }
`;

/** Returns the palette of an element with its current style. */
export function resolvePalette(colourParent: HTMLElement) {
  // All probes, one for each role, are created before the first is read, so that the browser computes styles only once.
  const colourProbes = COLOUR_ROLES.map((colourRole) => {
    const colourProbe = document.createElement('span');
    colourProbe.hidden = true;
    colourProbe.style.color = `var(--${colourRole})`;
    // Without this property, forced colours would replace the hues of the colour roles.
    colourProbe.style.forcedColorAdjust = 'none';
    return colourProbe;
  });
  colourParent.append(...colourProbes);
  const paletteEntries = colourProbes.map((colourProbe, i) => {
    const { color } = getComputedStyle(colourProbe);
    // Browsers serialize mixed colours in notations that few programs read. These are converted to rgb().
    return [COLOUR_ROLES[i], /^rgb/.test(color) ? color : `rgb(${colourChannelsOf(color)})`];
  });
  for (const colourProbe of colourProbes) colourProbe.remove();
  return Object.fromEntries(paletteEntries) as ColourPalette;
}

let pixelContext: OffscreenCanvasRenderingContext2D | undefined;

/** Returns red, green and blue from 0 to 255 of colours in any CSS notation, each painted over the previous ones. */
export function colourChannelsOf(...cssColours: string[]): [number, number, number] {
  // An opaque colour in the notation rgb(r, g, b), the most frequent one, is read without a canvas.
  const rgbMatch = cssColours.at(-1)?.match(/^rgb\((\d+), (\d+), (\d+)\)$/);
  if (rgbMatch) return [Number(rgbMatch[1]), Number(rgbMatch[2]), Number(rgbMatch[3])];
  const canvasContext = (pixelContext ??= (
    new OffscreenCanvas(1, 1).getContext('2d', { willReadFrequently: true }) as OffscreenCanvasRenderingContext2D
  ));
  canvasContext.clearRect(0, 0, 1, 1);
  for (const cssColour of cssColours) {
    canvasContext.fillStyle = cssColour;
    canvasContext.fillRect(0, 0, 1, 1);
  }
  const [redValue, greenValue, blueValue] = canvasContext.getImageData(0, 0, 1, 1).data;
  return [redValue, greenValue, blueValue];
}

/** Style of a line or mark, in the picture and in the legend. */
export interface LineStyle {
  colourRole: keyof ColourPalette;
  /** Dash pattern, CSS pixels. */
  dash?: number[];
  /** Line width, CSS pixels. */
  width?: number;
  /** Symbol in the legend; default: line. */
  shape?: 'line' | 'dot' | 'ring' | 'area' | 'cross';
}

/** Returns the symbol of a legend item: a line, dot, ring or area in its style. */
export function swatchHtml({ colourRole, dash, width = 2.25, shape: swatchShape = 'line' }: LineStyle) {
  const svgByShape = {
    line: svg`<line x1="1" x2="29" y1="6" y2="6" stroke-width=${width} stroke-dasharray=${dash?.join(' ') ?? nothing} />`,
    dot: svg`<circle fill="var(--role)" cx="15" cy="6" r="3" />`,
    ring: svg`<circle cx="15" cy="6" r="4" stroke-width=${width} />`,
    area: svg`<rect fill="var(--role)" x="4" y="1" width="22" height="10" opacity="0.4" />`,
    cross: svg`<path d="M11 2l8 8m0 -8l-8 8" stroke-width=${width} />`,
  };
  return html`<svg class="swatch" viewBox="0 0 30 12" aria-hidden="true" data-role=${colourRole}>${svgByShape[swatchShape]}</svg>`;
}
