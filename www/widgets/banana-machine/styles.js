/** What the Banana Machine's page has of its own. */

import { css } from 'lit';
import { chartStyles } from '../../ui/chart.js';
import { layoutStyles } from '../../ui/layout.js';

const own = css`
  canvas.plane {
    aspect-ratio: 5 / 3;
  }

  @container (max-width: 34rem) {
    canvas.plane {
      aspect-ratio: 5 / 4;
    }
  }

  canvas.twist {
    aspect-ratio: 380 / 250;
    max-width: 34rem;
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

  .alphas > .toggle {
    margin-bottom: 0.4rem;
  }
`;

export const bananaStyles = [...layoutStyles, chartStyles, own];
