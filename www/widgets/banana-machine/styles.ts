/** Styles of the Banana Machine. */

import { css } from 'lit';

export const styles = css`
  /* A narrow figure has one picture: the one with the morph, which can show both. */
  @container (width < 30em) {
    .views > .twist {
      display: none;
    }
  }

  /* On a phone the title, which judges the ellipse, stays visible with the picture. */
  @media (min-height: 40em) {
    @container (width < 30em) {
      .panel-title {
        position: sticky;
        top: var(--top);
        z-index: 3;
        background: var(--paper);
      }

      .stage[part='picture'] {
        top: calc(var(--top) + 1.3em);
      }
    }
  }

  /* Margin for the fade below the pictures. */
  .morphing {
    display: flex;
    flex-wrap: wrap;
    align-items: start;
    gap: 0.5em 1em;
    margin-top: 0.7em;
  }

  /* The ends have their names below the track. */
  .morph {
    --thumb: var(--posterior);
    flex: 1;
    display: grid;
    grid-template-columns: auto auto 1fr;
    column-gap: 0.75em;
  }

  .morph button {
    grid-row: span 2;
  }

  .morph input {
    grid-column: 2 / -1;
  }

  .morph .floor {
    grid-column: 2;
  }

  .morph .twist {
    text-align: end;
  }

  /* The three main readouts, in columns of equal width where there is room. */
  .surface .simulation > .readouts {
    display: grid;
    gap: 0.4em 1.25em;
  }

  @container (min-width: 30em) {
    .views {
      grid-template-columns: 1fr 1fr;
      column-gap: 1em;
    }

    .surface .simulation > .readouts {
      grid-template-columns: repeat(3, 1fr);
    }
  }

  @container (min-width: 38em) {
    canvas {
      aspect-ratio: 1.45;
    }
  }

  @container (min-width: 56em) {
    canvas {
      aspect-ratio: 1.6;
    }
  }
`;
