/** What the Banana Machine's page has of its own. */

import { css } from 'lit';
import { layoutStyles } from '../../ui/layout.js';
import { plotStyles } from '../../ui/plot.js';

const own = css`
  canvas {
    aspect-ratio: 5 / 4;
  }

  @container (min-width: 30em) {
    .views {
      grid-template-columns: 1fr 1fr;
      gap: 1em;
    }
  }

  @container (min-width: 56em) {
    canvas {
      aspect-ratio: 2;
    }
  }

  /* The three that matter, side by side where there is room. */
  .surface .machine > .readouts {
    display: grid;
    grid-template-columns: repeat(auto-fit, minmax(min(100%, 12.5em), 1fr));
    gap: 0.2em 1.25em;
  }

  /* What the gain means for all robots is the longest line. */
  @container (min-width: 40em) {
    .surface .machine > .readouts {
      grid-template-columns: 16fr 30fr 20fr;
      column-gap: 1em;
    }
  }
`;

export const bananaStyles = [...layoutStyles, plotStyles, own];
