/**
 * Layout of a widget from top to bottom: pictures side by side, the caption, the main numbers, controls in compact rows, and disclosures.
 * In a column of 700 pixels most of it is visible without scrolling.
 */

import { css } from 'lit';
import { controlStyles } from './controls.ts';
import { readoutStyles } from './readouts.ts';
import { sliderStyles } from './slider.ts';

/** Style of a figure in which only the first picture or chart stays visible while scrolling. All pictures would leave no space for the controls. */
const stickyPicture = css`
  :where(.views > .panel:first-of-type) > .panel-title + * {
    --most: 45svh;
    position: sticky;
    top: var(--top);
    z-index: 2;
    background: var(--paper);
    box-shadow: var(--fade);
  }

  .views,
  .views > .panel:first-of-type {
    display: contents;
  }

  /* Margin for the gradient that fades scrolled text below the pictures. */
  .views > .panel:first-of-type + *,
  .stage + * {
    margin-top: 0.7em;
  }
`;

const figureLayout = css`
  /* Sticky pictures stay visible within this box, which extends below text of the page that follows the figure. */
  .simulation {
    text-wrap: pretty;
    margin-bottom: calc(-1 * var(--motion-sticky-bottom, 0px));
  }

  .simulation::after {
    content: '';
    display: block;
    height: var(--motion-sticky-bottom, 0);
    visibility: hidden;
  }

  /* Outline while the user drags files over the figure. */
  .dropping {
    outline: 2px dashed var(--accent);
    outline-offset: 4px;
  }

  .views,
  .controls {
    display: grid;
    gap: 0.25em 1.25em;
    align-items: start;
  }

  .controls {
    grid-template-columns: repeat(auto-fit, minmax(min(100%, 17em), 1fr));
    gap: 0.5em 2.5em;
  }

  /* Disclosures of less frequent controls stand side by side; an open one has the whole width. */
  .folds {
    display: flex;
    flex-wrap: wrap;
    align-items: start;
    gap: 0.1em 1.2em;
    margin-top: 0.4em;
    padding-top: 0.3em;
    border-top: 1px solid var(--rule);
  }

  .folds > details[open] {
    flex: 1 0 100%;
    padding-bottom: 0.8em;
  }

  /* Open tables and charts cover the sticky pictures when the page scrolls, unless a handle of a picture has the focus. */
  .simulation:not(:has(.views :focus-visible)) #numbers[open] {
    position: relative;
    z-index: 3;
    background: var(--paper);
    box-shadow: -0.5em 0 var(--paper), 0.5em 0 var(--paper);
  }

  .notice {
    position: sticky;
    z-index: 3;
    bottom: 0;
    height: 0;
  }

  .notice > div {
    position: absolute;
    bottom: 0.5em;
    left: 50%;
    display: flex;
    align-items: center;
    gap: 0.8em;
    box-sizing: border-box;
    width: max-content;
    max-width: 100%;
    padding: 0.35em 0.5em 0.35em 0.9em;
    transform: translateX(-50%);
    background: var(--paper);
    border: 1px solid var(--rule);
    border-left: 3px solid var(--accent);
    border-radius: 4px;
    box-shadow: 0 2px 10px rgb(0 0 0 / 25%);
  }

  progress {
    width: 8em;
    accent-color: var(--posterior);
  }

  .begin {
    display: flex;
    gap: 0.5em;
    margin-inline-start: auto;
  }

  @container (width < 56em) {
    /* In narrow columns, texts below sliders have two lines. The margin keeps these texts above the rule. */
    .folds {
      margin-top: 1.3em;
    }
  }

  .folded {
    padding-top: 0.4em;
  }

  .figures {
    display: grid;
    gap: 1em 2.75em;
    align-items: start;
    grid-template-columns: repeat(auto-fit, minmax(min(100%, 20em), 1fr));
  }

  .panel-title,
  figure,
  dl {
    margin: 0;
  }

  .stage {
    position: relative;
    /* After a change of the width, handles may lie outside of the picture until the next frame. Without clipping, they would make the page wider. */
    overflow-x: clip;
  }

  canvas {
    display: block;
    width: 100%;
    aspect-ratio: 5 / 4;
    touch-action: pan-y pinch-zoom;
    /* At a font size of 16 px, text in pictures has 13 px. It scales with the page's font size, see FONT_SIZE_PX in scene/canvas.ts. */
    font-size: 0.8125em;
    cursor: crosshair;
  }

  @container (min-width: 38em) {
    canvas {
      aspect-ratio: 8 / 5;
    }

    /* A group of sliders is a row of three columns. */
    .simulation > .controls:has(> fieldset) {
      grid-template-columns: repeat(3, minmax(min-content, 1fr));
      column-gap: 1.25em;
    }

    .simulation > .controls > fieldset {
      grid-column: 1 / -1;
      grid-auto-flow: column;
      grid-auto-columns: minmax(min-content, 1fr);
      column-gap: inherit;
    }

    .simulation > .controls > :is(.single, .pair + .cloud) {
      grid-column: auto;
    }

    .simulation > .controls > .single + .cloud {
      grid-column: 2 / -1;
      grid-template-columns: minmax(min-content, 1fr) minmax(0, 1.7fr);
      align-items: start;
    }

    .simulation > .controls > .pair {
      grid-column: span 2;
    }
  }

  .handle {
    position: absolute;
    top: 0;
    left: 0;
    width: 2.25em;
    height: 2.25em;
    transform: translate(-50%, -50%);
    border-radius: 50%;
    cursor: grab;
    touch-action: none;
  }

  .handle:active {
    cursor: grabbing;
  }

  .handle::after {
    content: '';
    position: absolute;
    inset: 0.55em;
    box-sizing: border-box;
    background: var(--paper);
    border: 3px solid var(--ring, var(--prior));
    border-radius: 50%;
  }

  .handle::before {
    position: absolute;
    padding: 0.12em 0.6em;
    border-radius: 3px;
    color: var(--paper);
    font-size: 0.85em;
    white-space: nowrap;
    pointer-events: none;
  }

  /* Text about a limit that a handle has reached, shown while the handle is dragged or moved with keys. */
  .handle[data-stop]:is(.held, :focus-visible)::before {
    content: attr(data-stop);
    top: 50%;
    left: calc(100% + 0.35em);
    translate: 0 -50%;
    background: var(--ink);
  }

  .handle.right[data-stop]:is(.held, :focus-visible)::before {
    right: calc(100% + 0.35em);
    left: auto;
  }

  .handle:hover::after {
    background: var(--ring, var(--prior));
  }

  /* The handle of a robot's body is invisible, because the picture shows the robot. */
  .handle.body::after {
    content: none;
  }

  .handle.turn {
    width: 1.75em;
    height: 1.75em;
  }

  .handle.turn::after {
    inset: 0.45em;
    border-width: 2.5px;
  }

  .handle[data-hint]::after {
    animation: pulsing 1.2s ease-in-out;
  }

  @keyframes pulsing {
    50% {
      box-shadow: 0 0 0 0.9em color-mix(in srgb, var(--prior) 35%, transparent);
    }
  }

  .handle[data-hint]::before {
    content: attr(data-hint);
    top: 100%;
    left: 50%;
    translate: -50% 0;
    background: var(--prior);
    animation: hinted 2.4s ease-in-out both;
  }

  @keyframes hinted {
    from,
    to {
      opacity: 0;
    }

    20%,
    80% {
      opacity: 1;
    }
  }

  .note {
    margin: 0.5em 0;
    padding-left: 0.8em;
    border-left: 3px solid var(--accent);
  }

  /* Two lines are reserved even for a short caption, so that a longer one moves nothing. */
  .caption {
    min-height: 2lh;
    margin: 0;
    padding-block: 0.25em;
  }

  @container (max-width: 34em) {
    .caption {
      min-height: 4lh;
      font-size: 0.95em;
      line-height: 1.25;
    }
  }

  .panel {
    display: grid;
    grid-template-rows: auto 1fr;
  }

  :is(.legend, .plot-key) {
    gap: 0 1.2em;
    margin: 0.2em 0;
    font-size: 0.92em;
  }

  .swatch {
    flex: none;
    width: 1.9em;
    fill: none;
    stroke: var(--role);
  }

  .buttons {
    align-items: center;
    gap: 0.5em;
    margin-bottom: 0.5em;
  }

  .start-over {
    margin-inline-start: auto;
  }

  figcaption {
    margin: 0.43em 0 1.36em;
    color: var(--muted);
    font-size: 0.92em;
  }

  /* The pictures stay visible while the controls below them are used. */
  @media (min-height: 22em) {
    .stage canvas {
      max-height: 45svh;
    }

    :is(button, input, summary, textarea) {
      scroll-margin-top: calc(45svh + 2em + var(--top));
    }

    /* Shadow that covers handles at the sides of a sticky picture, and fades text that scrolls below the picture. */
    .simulation {
      --fade: -0.5em 0 var(--paper), 0.5em 0 var(--paper), 0 0.4em 0.4em var(--paper);
    }

    @container (width >= 30em) {
      .views {
        position: sticky;
        top: var(--top);
        z-index: 2;
        background: var(--paper);
        box-shadow: var(--fade);
      }
    }

    @container (width < 30em) {
      ${stickyPicture}
    }
  }

  /* Low windows, such as those of desktop browsers at a zoom of 200 %. */
  @media (22em <= height < 40em) {
    @container (width < 56em) {
      ${stickyPicture}
    }
  }
`;

export const layoutStyles = [readoutStyles, controlStyles, sliderStyles, figureLayout];
