/** Styles of the Odometry Decomposer. */

import { css } from 'lit';

export const styles = css`
  /* On a phone, the handles of two robots need space side by side. */
  .legs canvas {
    aspect-ratio: 1;
  }

  @container (30em <= width < 38em) {
    .stage canvas {
      aspect-ratio: 8 / 5;
    }
  }

  /* The legs next to the world, each with its text. */
  @container (min-width: 38em) {
    .views {
      grid-template-columns: minmax(0, 3fr) minmax(0, 2fr);
      column-gap: 1.5em;
    }

    /* Both pictures are as high as the window allows. */
    :host(:not([presentation])) .stage {
      height: clamp(12.5em, 100svh - 32.5em, min(45svh, 24em));
    }

    canvas {
      height: 100%;
    }

    .plays {
      display: grid;
      grid-template-columns: 1fr 1fr;
      column-gap: 2.5em;
    }
  }

  @container (min-width: 56em) {
    :host(:not([presentation])) .stage {
      height: clamp(16.4em, 100svh - 28.6em, min(45svh, 24em));
    }
  }

  @container (38em <= width < 50em) {
    /* All presets are in one row. */
    .presets {
      --beside: 0.45em;
      gap: 0.35em;
    }

    .summary .readouts {
      max-width: 8.5em;
    }

    .views .caption {
      font-size: 0.92em;
      line-height: 1.25;
    }
  }

  .playable > button {
    /* The button is centred on the slider's track, not on track and hint together. */
    margin-bottom: 1em;
  }

  .rules table {
    max-width: none;
    margin-bottom: 0.5em;
  }

  .rules .choice {
    min-height: max(24px, 1.6em);
  }

  /* Bold, and on a tint. */
  .rules td:has(strong) {
    background: color-mix(in srgb, var(--prediction) 16%, var(--paper));
  }

  .rules :is(td, thead th:not(:first-child)) {
    padding-inline: clamp(0.05em, 4cqi - 1.1em, 0.54em);
  }

  @container (width < 24em) {
    .rules thead th:not(:first-child) {
      font-size: 0.86em;
    }
  }
`;
