/** What Dead Reckoning's page has of its own. */

import { css } from 'lit';
import { layoutStyles } from '../../ui/layout.js';
import { plotStyles } from '../../ui/plot.js';

const own = css`
  canvas {
    aspect-ratio: 5 / 4;
  }

  .views {
    grid-template: 'floor' 'ratios' 'step' 'aside' / minmax(0, 1fr);
  }

  .ratios .plot-key {
    margin: 0;
  }

  .missed {
    margin: 0.2em 0 0;
    color: var(--muted);
    font-size: 0.84em;
  }

  /* The three components side by side, however narrow. */
  .surface .machine .readouts {
    display: grid;
    grid-template-columns: repeat(3, minmax(0, 1fr));
    gap: 0 0.75em;
  }

  .aside .choices {
    --name: 4.5em;

    column-gap: 0.5em;
  }

  .ratios {
    grid-area: ratios;
  }

  .stage[part='picture'] {
    grid-area: floor;
  }

  .stage.step {
    grid-area: step;
  }

  .aside {
    grid-area: aside;
  }

  @container (min-width: 30em) {
    canvas {
      aspect-ratio: 8 / 5;
    }

    .views {
      grid-template: 'floor step' 'ratios aside' / minmax(0, 1fr) minmax(0, 1fr);
      gap: 0.25em 1em;
    }

    .ratios .plot {
      max-width: 20em;
    }
  }

  @container (min-width: 56em) {
    canvas {
      aspect-ratio: 5 / 4;
    }

    .views {
      grid-template: 'floor step ratios' 'aside aside aside' / minmax(0, 1fr) minmax(0, 1fr) minmax(0, 1fr);
    }

    .ratios .plot {
      max-width: none;
    }

    .aside {
      display: grid;
      grid-template-columns: 1fr 1fr;
      gap: 2em;
    }
  }
`;

export const reckoningStyles = [...layoutStyles, plotStyles, own];
