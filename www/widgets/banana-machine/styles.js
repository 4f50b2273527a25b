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
      aspect-ratio: 2;
    }
  }

  /* In the column of a book the rows of buttons are one line each. */
  @container (max-width: 48rem) {
    .controls {
      column-gap: 1.5rem;
    }

    .cloud .buttons {
      gap: 0.25rem;
    }

    .cloud .buttons button {
      padding-inline: 0.25rem;
      font-size: 0.84rem;
    }

    .buttons {
      gap: 0.35rem;
    }

    .presets button {
      padding-inline: 0.4rem;
      font-size: 0.92rem;
    }
  }

  @container (max-width: 42rem) {
    .presets {
      gap: 0.25rem;
    }

    .presets button {
      padding-inline: 0.3rem;
      font-size: 0.84rem;
    }
  }

  .cloud .buttons {
    margin-bottom: 0.2rem;
  }

  /* Where the buttons leave it no room, the seed shares the line in which the help of N appears. */
  @container (max-width: 68.75rem) {
    .cloud .seed {
      position: absolute;
      right: 0;
      bottom: 0;
      font-size: 0.84rem;
      line-height: 1.25;
    }

    .cloud:has(.slider:is(:focus-within, :hover)) .seed {
      visibility: hidden;
    }
  }

  /* The three that matter, side by side where there is room. */
  .surface .machine > .readouts {
    display: grid;
    grid-template-columns: repeat(auto-fit, minmax(min(100%, 12.5rem), 1fr));
    gap: 0.2rem 1.25rem;
  }

  /* What the gain means for all robots is the longest line. */
  @container (min-width: 40rem) {
    .surface .machine > .readouts {
      grid-template-columns: 16fr 30fr 20fr;
      column-gap: 1rem;
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

  .legend :is(.ellipse, .linearized, .additive) {
    --role: var(--prediction);
  }

  .legend .exponential {
    --role: var(--posterior);
  }

`;

export const bananaStyles = [...layoutStyles, chartStyles, own];
