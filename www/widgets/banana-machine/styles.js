/** What the Banana Machine's page has of its own. */

import { css } from 'lit';
import { chartStyles } from '../../ui/chart.js';
import { layoutStyles } from '../../ui/layout.js';

const own = css`
  canvas {
    aspect-ratio: 5 / 4;
  }

  @container (min-width: 30rem) {
    .views {
      grid-template-columns: 1fr 1fr;
      gap: 1rem;
    }
  }

  @container (min-width: 56rem) {
    canvas {
      aspect-ratio: 5 / 3;
    }
  }

  .swatch {
    flex: none;
    width: 1.9rem;
    height: 0.5rem;
    stroke: var(--role);
  }

  .swatch line {
    stroke-width: 2.25;
  }

  .legend .command {
    --role: var(--prior);
  }

  .legend :is(.ellipse, .linearized) {
    --role: var(--prediction);
  }

  .legend .exponential {
    --role: var(--posterior);
  }

`;

export const bananaStyles = [...layoutStyles, chartStyles, own];
