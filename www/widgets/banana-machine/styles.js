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

  /* In the column of a book the rows of buttons are one line each. */
  @container (max-width: 48em) {
    .controls {
      column-gap: 1.5em;
    }

    .cloud .buttons {
      gap: 0.25em;
    }

    .cloud .buttons button {
      --size: 0.84;
      --beside: 0.25em;
    }

    .buttons {
      gap: 0.35em;
    }

    .presets button {
      --size: 0.92;
      --beside: 0.4em;
    }
  }

  @container (max-width: 42em) {
    .presets {
      gap: 0.25em;
    }

    .presets button {
      --size: 0.84;
      --beside: 0.3em;
    }
  }

  .cloud .buttons {
    margin-bottom: 0.2em;
  }

  /* Where the buttons leave it no room, the seed shares the line in which the help of N appears. */
  @container (max-width: 68.75em) {
    .cloud .seed {
      position: absolute;
      right: 0;
      bottom: 0;
      font-size: 0.84em;
      line-height: 1.25;
    }

    .cloud:has(.slider:is(:focus-within, :hover)) .seed {
      visibility: hidden;
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

  .swatch {
    flex: none;
    width: 1.9em;
    height: 0.5em;
    stroke: var(--role);
  }

  .swatch line {
    stroke-width: 2.25;
  }

  .legend .command {
    --role: var(--prior);
  }

  .legend :is(.ellipse, .linearized, .additive) {
    --role: var(--prediction);
  }

  .legend .exponential {
    --role: var(--posterior);
  }

`;

export const bananaStyles = [...layoutStyles, plotStyles, own];
