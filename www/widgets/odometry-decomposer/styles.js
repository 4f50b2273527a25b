/** What the Odometry Decomposer's page has of its own. */

import { css } from 'lit';
import { layoutStyles } from '../../ui/layout.js';
import { plotStyles } from '../../ui/plot.js';
import { poseHandleStyles } from '../shared/styles.js';

const own = css`
  canvas {
    aspect-ratio: 5 / 4;
  }

  @container (30em <= width < 38em) {
    canvas {
      aspect-ratio: 8 / 5;
    }
  }

  /* The legs beside the world, each with what is said of it and its slider. */
  @container (min-width: 38em) {
    .views {
      grid-template: 'legs world' 'said drifting' / 3fr 2fr;
      column-gap: 1.5em;
    }

    .plays {
      display: grid;
      grid-template-columns: 3fr 2fr;
      column-gap: 1.5em;
    }

    .views > .stage {
      --high: 0.6;
      grid-area: legs;
    }

    .views > .beside {
      grid-area: world;
    }

    canvas {
      aspect-ratio: 1 / var(--high);
    }

    .beside canvas {
      /* As high as the legs, which are half as wide again. */
      aspect-ratio: 2 / calc(3 * var(--high));
    }

    .said {
      grid-area: said;
    }

    .drifting {
      grid-area: drifting;
    }
  }

  /* Wider, and not higher: all of it is to fit on a screen. */
  @container (min-width: 55em) {
    .views > .stage {
      --high: 0.52;
    }
  }

  @container (min-width: 65em) {
    .views > .stage {
      --high: 0.42;
    }
  }

  @container (38em <= width < 50em) {
    .views .caption {
      font-size: 0.92em;
      line-height: 1.25;
    }
  }

  .playable {
    grid-template-columns: auto minmax(4em, 1fr) auto auto;
    align-items: center;
  }

  .playable > .slider {
    grid-column: 1 / 4;
  }

  .playable > button {
    grid-column: 4;
    min-width: 5em;
  }

  .presets {
    margin-top: 0.2em;
  }

  .surface .machine > .readouts {
    display: grid;
    grid-template-columns: repeat(auto-fit, minmax(min(100%, 12em), 1fr));
    gap: 0.2em 1.25em;
  }

  .rules table {
    max-width: none;
    margin-bottom: 0.5em;
  }

  .rules th .choice {
    min-height: 1.6em;
  }
`;

export const decomposerStyles = [...layoutStyles, plotStyles, poseHandleStyles, own];
