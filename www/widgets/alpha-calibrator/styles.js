/** Styles of the Alpha Calibrator. */

import { css } from 'lit';
import { layoutStyles } from '../../ui/layout.js';
import { plotStyles } from '../../ui/plot.js';
import { fileStyles } from '../shared/files.js';

const own = css`
  canvas {
    aspect-ratio: 5 / 4;
  }

  .views table {
    margin: 0.2em 0 0.4em;
    max-width: none;
    font-size: 0.84em;
  }

  .views caption {
    padding-top: 0.2em;
    line-height: 1.25;
  }

  .views :is(th, td) {
    padding: 0.05em 0 0.05em 0.4em;
    white-space: nowrap;
  }

  .alphas .chart {
    width: 100%;
    padding: 0 0.3em;
  }

  .alphas :is(th, td) {
    vertical-align: top;
  }

  /* Above the whisker, before its grid. */
  .alphas .of {
    position: relative;
    top: 0.12em;
    margin-bottom: -1.1em;
    color: var(--muted);
    font-size: 0.9em;
    line-height: 1.1;
    text-align: left;
    width: fit-content;
    background: var(--paper);
  }

  .alphas svg {
    display: block;
    width: 100%;
    height: 1.65em;
  }

  .alphas .sample {
    display: inline-block;
    width: 0.5em;
    height: 1em;
    vertical-align: -0.1em;
  }

  .alphas path {
    fill: none;
    vector-effect: non-scaling-stroke;
  }

  .alphas .grid {
    stroke: var(--rule);
  }

  .alphas .true {
    stroke: var(--truth);
    stroke-width: 3;
  }

  .alphas .whisker {
    stroke: var(--prediction);
    stroke-width: 1.9;
  }

  .alphas .dot {
    stroke: var(--prediction);
    stroke-width: 5;
    stroke-linecap: round;
  }

  .alphas .scale {
    position: relative;
    height: 1.1em;
    color: var(--muted);
    font-size: 0.84em;
  }

  .scale > span {
    position: absolute;
    translate: -50%;
  }

  .alphas .unknown {
    display: block;
    margin-top: 1em;
    text-align: left;
    font-style: italic;
    white-space: normal;
  }

  :is(.between, .muted) {
    color: var(--muted);
  }

  /* As high as whole pixels have it: those of a table are rounded. */
  .systematic :is(th, td) {
    padding-block: 0;
  }

  .systematic .toggle {
    min-height: calc(1.5em / 0.84);
  }

  .looked {
    display: grid;
    gap: 0 0.8em;
    align-items: center;
    grid-template-columns: minmax(min-content, 1fr) auto;
  }

  .looked .readouts {
    grid-column: 1 / -1;
    gap: 0.2em 1.2em;
    margin: 0;
  }

  .looked button {
    --size: 0.84;
    --beside: 0.4em;
  }

  .models {
    display: flex;
    flex-wrap: wrap;
    align-items: center;
    column-gap: 2em;
  }

  .models .choices,
  .models .options {
    --name: auto;

    flex: none;
    column-gap: 0.8em;
    max-width: 100%;
  }

  .models .options .choice {
    flex: none;
  }

  [part='controls'] > .controls {
    grid-template-columns: repeat(auto-fit, minmax(min(100%, 11em), 1fr));
    column-gap: 1.5em;
  }

  .folded > .choices {
    --name: auto;

    column-gap: 1em;
  }

  .folded > .choices > .options,
  .folded > .choices .choice {
    flex: none;
  }

  .panels {
    display: grid;
    grid-template-columns: repeat(auto-fit, minmax(min(100%, 17em), 1fr));
    gap: 0.5em 1em;
  }

  .figcaption {
    margin: 0.3em 0 0;
    color: var(--muted);
    font-size: 0.92em;
  }

  textarea.yaml {
    width: 100%;
    box-sizing: border-box;
    font: 0.84em / 1.4 ui-monospace, monospace;
  }

  .dropping {
    outline: 2px dashed var(--accent);
    outline-offset: 4px;
  }

  @container (width < 26em) {
    .views table :is(caption, thead, tbody) {
      display: revert;
    }

    .views tr {
      display: table-row;
    }

    .views tr > :is(th, td) {
      overflow-wrap: normal;
    }
  }

  @container (min-width: 38em) {
    canvas {
      aspect-ratio: 7 / 5;
    }

    .one canvas {
      aspect-ratio: 9 / 5;
    }

    .views {
      grid-template-columns: repeat(10, minmax(0, 1fr));
      gap: 0.25em 1.25em;
    }

    .stage[part='picture'] {
      grid-area: 1 / 1 / 3 / 7;
    }

    .stage.one {
      grid-area: 1 / 7 / 2 / 11;
    }

    .looked {
      grid-area: 2 / 7 / 3 / 11;
    }

    .views > .caption {
      grid-area: 3 / 1 / 4 / 11;
    }

    .views > .tables {
      display: grid;
      grid-template-columns: minmax(min-content, 9fr) minmax(0, 11fr);
      column-gap: 1.25em;
      align-items: start;
      grid-area: 4 / 1 / 5 / 11;
    }
  }

  @container (45em <= width < 56em) {
    .stage:not(.one) canvas {
      aspect-ratio: 8 / 5;
    }
  }

  @container (min-width: 56em) {
    .stage:not(.one) canvas {
      aspect-ratio: 8 / 7;
    }

    .one canvas {
      aspect-ratio: 5 / 4;
    }

    .views {
      grid-template: auto 1fr auto auto / repeat(7, minmax(0, 1fr)) minmax(min-content, 3.6fr);
    }

    .stage[part='picture'] {
      grid-area: 1 / 1 / 4 / 5;
    }

    .stage.one {
      grid-area: 1 / 5 / 2 / 8;
    }

    .looked {
      grid-area: 2 / 5 / 4 / 8;
    }

    .views > .tables {
      display: block;
      grid-area: 1 / 8 / 4 / 9;
    }

    .views > .caption {
      grid-area: 4 / 1 / 5 / 9;
    }
  }
`;

export const calibratorStyles = [...layoutStyles, plotStyles, fileStyles, own];
