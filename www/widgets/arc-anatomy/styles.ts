/** Styles of Arc Anatomy: the headline, the bars, and the lines of the table. */

import { css } from 'lit';

export const styles = css`
  .headline {
    margin-block: 0 0.5em;
    line-height: 1.25;
  }

  .headline strong {
    display: block;
    font-size: 2em;
    line-height: 1.15;
  }

  :is(.factors, .lines) {
    display: grid;
    margin: 0 0 0.6em;
    padding: 0;
  }

  .factors {
    gap: 0.5em;
  }

  :is(.factors, .lines) li {
    padding-left: calc(0.5em + 3px);
  }

  :is(.factors.lit li, .weakest, .lines .lit) {
    padding-left: 0.5em;
    border-left: 3px solid var(--accent);
  }

  .factors li {
    display: grid;
    grid-template-columns: 1fr auto;
    align-content: start;
  }

  .factors :is(.estimate, svg) {
    grid-column: 1 / -1;
  }

  .factors svg {
    width: 100%;
    height: 1.3em;
  }

  /* Below the picture the bars are side by side. */
  @container (22em <= width < 38em) {
    .factors {
      grid-template-columns: repeat(3, minmax(0, 1fr));
      font-size: 0.88em;
    }

    .factors li {
      grid-template-columns: 1fr;
    }
  }

  /* Likelihood next to the picture. */
  @container (min-width: 38em) {
    .views {
      grid-template-columns: minmax(0, 1fr) 16em;
      column-gap: 1.25em;
    }
  }

  @container (min-width: 52em) {
    canvas {
      aspect-ratio: 7 / 4;
    }
  }

  .stepper {
    display: grid;
    grid-template-columns: auto auto 1fr;
    gap: 0.35em;
    align-items: start;
    margin: 0.2em 0 0.5em;
  }

  .stepper p {
    min-height: 2lh;
    margin: 0.2em 0 0 0.4em;
  }

  .underway {
    display: flex;
    gap: 0.6em;
    align-items: center;
  }

  .underway .slider {
    flex: 1;
    padding-bottom: 0;
  }

  .lines li {
    display: block;
    padding-block: 0.1em;
  }

  .handle.turn {
    --ring: var(--prediction);
  }

  .handle.turn.start {
    --ring: var(--truth);
  }
`;
