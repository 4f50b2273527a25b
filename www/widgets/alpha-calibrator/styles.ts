/** Styles of the Alpha Calibrator. */

import { css } from 'lit';

export const styles = css`
  .drop-zone {
    margin-bottom: 0.4em;
    padding: 0.25em 0.6em;
    border: 1px dashed var(--muted);
    border-radius: 3px;
  }

  .drop-zone p {
    margin: 0;
  }

  .choosers select {
    max-width: 100%;
    min-height: 2em;
    background: var(--paper);
    font: inherit;
  }

  /* The figure fills the screen. */
  :host([presentation]) :is(.choosers, .found) {
    display: none;
  }

  .drive {
    display: flex;
    flex-wrap: wrap;
    gap: 0.5em 1.5em;
    align-items: flex-start;
  }

  .found table {
    flex: 1 1 18em;
    margin: 0;
    line-height: 1.25;
  }

  .found :is(thead, tbody) :is(th, td) {
    text-align: start;
    vertical-align: top;
    white-space: normal;
    overflow-wrap: anywhere;
  }

  .found tbody th {
    color: var(--muted);
    white-space: nowrap;
  }

  .paths {
    flex: 0 0 14em;
  }

  .paths svg {
    display: block;
    width: 100%;
  }

  /* The second class of legs has a colour between two roles, as in the picture. */
  .legend > :nth-child(2) .swatch {
    --role: color-mix(in srgb, var(--truth), var(--cloud));
  }

  .badge {
    display: inline-block;
    margin-inline-end: 0.4em;
    padding: 0.1em 0.6em;
    border-radius: 3px;
    background: var(--role);
    color: var(--paper);
    font-weight: bold;
    line-height: 1;
    forced-color-adjust: none;
  }

  :host([presentation]) .views {
    grid-template-rows: auto 1fr;
  }

  /* The picture of the leg takes the remaining space. */
  :host([presentation]) .one {
    display: grid;
    grid-template-rows: 1fr auto;
    align-self: stretch;
  }

  .fitted .buttons {
    margin-bottom: 0.1em;
  }

  /* Results of the previous log or settings, while another log is read, or a fit takes long. */
  .spoken:has(progress) :is(.verdict, .fitted) {
    opacity: 0.4;
  }

  /* Results of the previous log, after other files were refused. */
  .spoken:has(.other-results) :is(.views, #numbers) {
    color: var(--muted);
    filter: grayscale(1);
  }

  /* The message of the copy button is in sight beside it, however long the table is. */
  .fitted .copied:not(:empty) {
    display: block;
    position: sticky;
    z-index: 1;
    bottom: 0;
    padding-block: 0.25em;
    background: var(--paper);
  }

  .fitted .panel-title {
    flex: 1 0 100%;
  }

  table {
    max-width: 48em;
    margin: 0.2em 0 0.5em;
    font-size: 0.84em;
  }

  td {
    white-space: nowrap;
  }

  .alphas {
    max-width: none;
    margin-bottom: 0.1em;
  }

  .alphas :is(th, td) {
    padding: 0 0 0 0.5em;
    line-height: 1.2;
    white-space: nowrap;
  }

  /* Rows of 32 px at a font size of 16 px. */
  .alphas tbody tr:not(.axis) {
    height: calc(2em / 0.84);
    border-top: 1px solid var(--rule);
  }

  .alphas :is(th, td):nth-child(2) {
    text-align: left;
    white-space: normal;
  }

  @container (width < 26em) {
    .alphas thead th {
      white-space: normal;
    }
  }

  .alphas .chart {
    width: 100%;
  }

  /* A name extends into the next column, in which the interval is lower. */
  .alphas .of {
    margin-inline-end: -4em;
    line-height: 1;
    overflow-wrap: anywhere;
    hyphens: auto;
  }

  .alphas svg {
    display: block;
    width: 100%;
    height: 1.2em;
  }

  .alphas .scale {
    container-type: inline-size;
    position: relative;
    flex: 1;
    height: 1.1em;
  }

  .scale > span {
    position: absolute;
    translate: -50%;
  }

  /* The first and the last label of an axis have room on any screen. */
  @container (width < 10em) {
    .scale > span:not(:first-child, :last-child) {
      visibility: hidden;
    }
  }

  .alphas .recommended {
    font-weight: bold;
  }

  .reason {
    margin: 0 0 0.3em;
  }

  /* Space for the advice of a failed check, which must not move a slider that is dragged. */
  .to-do {
    min-height: 6.5em;
    margin: 0.2em 0;
    line-height: 1.3;
  }

  @container (width < 30em) {
    .to-do {
      min-height: 7.8em;
    }
  }

  .systematic :is(th, td) {
    padding-block: 0;
  }

  .systematic .toggle {
    min-height: calc(2em / 0.84);
  }

  [part='controls'] .slider {
    grid-template: 'name value' auto 'track track' auto / 1fr auto;
  }

  .looked .slider {
    padding-bottom: 0.2em;
  }

  [part='controls'] .controls {
    grid-template-columns: repeat(auto-fit, minmax(min(100%, 13em), 1fr));
    column-gap: 1.5em;
  }

  .panels {
    display: grid;
    grid-template-columns: repeat(auto-fit, minmax(min(100%, 17em), 1fr));
    gap: 0.5em 1em;
  }

  .dropping .drop-zone {
    outline: 2px solid var(--accent);
    outline-offset: 2px;
  }

  @media print {
    :is(.drop-zone, .found) {
      display: none;
    }
  }

  @container (min-width: 38em) {
    .views {
      grid-template-columns: repeat(2, minmax(0, 1fr));
      gap: 0.25em 1.25em;
    }

    :is(.verdict, .fitted) {
      grid-column: 1 / -1;
    }

    canvas {
      aspect-ratio: 8 / 5;
    }

    .one canvas {
      aspect-ratio: 9 / 4;
    }
  }

  /* The pictures are as high as the table below them: in a low window both would leave no room for the controls. */
  @media (40em <= height < 60em) {
    @container (30em <= width < 56em) {
      .views {
        position: static;
      }
    }
  }

  /* Each α in one line, while its table has the width of the figure. */
  @container (38em <= width < 56em) {
    .fitted .panel-title {
      flex: none;
    }

    .alphas .line {
      display: flex;
      align-items: center;
      gap: 0.8em;
    }

    .alphas .of {
      flex: 0 0 16em;
      margin-inline-end: 0;
    }
  }

  /* The whole figure fits on a screen of 720 px. */
  @container (38em <= width < 42em) {
    canvas {
      aspect-ratio: 7 / 4;
    }

    .one canvas {
      aspect-ratio: 8 / 3;
    }
  }

  @container (min-width: 56em) {
    .views {
      /* The table comes after the pictures, and moves nothing. */
      grid-template-columns: minmax(0, 1.2fr) minmax(0, 1fr) clamp(24em, 34cqi, 29em);
    }

    .fitted {
      grid-column: auto;
    }

    .alphas .of {
      margin-inline-end: clamp(-4em, 36em - 50cqi, 0em);
    }

    canvas {
      aspect-ratio: 8 / 7;
    }

    .one canvas {
      aspect-ratio: 5 / 4;
    }
  }
`;
