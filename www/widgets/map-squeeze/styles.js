/** What Map Squeeze's page has of its own: the key to its marks, and room for maps of the reader's. */

import { css } from 'lit';
import { layoutStyles } from '../../ui/layout.js';
import { fileStyles } from '../shared/files.js';
import { besideStyles, poseHandleStyles } from '../shared/styles.js';

const own = css`
  canvas {
    aspect-ratio: 5 / 4;
  }

  /* In the column of a book, two places in a row. */
  @container (width < 50em) {
    .aside .buttons button {
      --size: 0.84;
      --beside: 0.4em;
    }
  }

  /* Wider, and not higher: all of it is to fit on a screen. */
  @container (min-width: 45em) {
    canvas {
      aspect-ratio: 4 / 3;
    }
  }

  @container (min-width: 50em) {
    canvas {
      aspect-ratio: 8 / 5;
    }
  }

  @container (min-width: 60em) {
    canvas {
      aspect-ratio: 12 / 5;
    }
  }

  .aside .choices {
    column-gap: 0.6em;
  }

  .aside .readouts {
    display: block;
  }

  .aside .choices > span {
    flex: 1 0 100%;
  }

  .own-map {
    display: grid;
    gap: 0.5em 2.75em;
    grid-template-columns: repeat(auto-fit, minmax(min(100%, 20em), 1fr));
    margin: 0;
  }

  .own-map > * {
    grid-column: auto;
  }

  .dropping .stage {
    outline: 2px dashed var(--accent);
    outline-offset: 4px;
  }

  .key svg {
    stroke-width: 1.5;
  }

  .key .rejected {
    stroke: var(--muted);
  }

  .key .accepted {
    fill: var(--cloud);
    stroke: var(--cloud);
  }

  .key .through :not(.dot) {
    stroke: var(--accent);
  }

  .key .through .dot {
    fill: var(--accent);
  }

  .key .unknown {
    stroke: var(--muted);
    opacity: 0.6;
  }

  .key .commanded {
    stroke: var(--prior);
    stroke-width: 2;
  }

  .marked label {
    color: var(--ink);
  }

  .choices {
    --name: 3em;
  }

  table.outdated tbody {
    color: var(--muted);
  }

  .own-map p {
    margin: 0 0 0.6em;
  }

  .own-map .note {
    margin: 0.7em 0;
    /* Scrolled to, it brings along which map is there. */
    scroll-margin: 4em;
    overflow-wrap: anywhere;
  }

  .own-map .present {
    color: var(--muted);
  }

  label[for='map-files'] {
    display: block;
  }

  textarea {
    box-sizing: border-box;
    display: block;
    width: 100%;
    margin: 0.35em 0 0.7em;
    padding: 0.47em 0.59em;
    font-size: 0.85em;
    line-height: 1.35;
    resize: vertical;
  }

  @media print {
    .own-map :not(.present, :has(.present)) {
      display: none !important;
    }
  }
`;

export const squeezeStyles = [...layoutStyles, besideStyles, poseHandleStyles, fileStyles, own];
