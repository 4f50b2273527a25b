/** Styles that only Map Squeeze has: of the headline, the overview, and the controls that open a map. */

import { css } from 'lit';

export const styles = css`
  .handle:is(.jamb, .side) {
    --ring: var(--truth);
    width: 1.75em;
    height: 1.75em;
    border-radius: 0;
  }

  .handle.jamb::after {
    inset: 0.6em;
    border-width: 1.5px;
    border-radius: 1px;
  }

  .handle.side {
    transform-origin: 0 0;
  }

  /* Name of a wall's handle, along the wall and towards the middle of the picture. */
  .handle:is(.jamb, .side):is(:hover, :focus-visible):not(.held)::before {
    content: attr(title);
    top: 100%;
    background: var(--ink);
  }

  .handle.right:is(.jamb, .side)::before {
    right: 0;
  }

  .handle.side::after {
    inset: 0.625em 0.2em;
    border-width: 1.5px;
    border-radius: 0.25em;
  }

  /* Handles of walls are visible while a pointer is over the picture, and always on touch screens. */
  @media (hover) {
    .stage:not(:hover) .handle.side:not(:focus-visible)::after {
      opacity: 0;
    }
  }

  /* Height of the longest headline and sentence, so that nothing moves when they change. */
  .result {
    display: flow-root;
    min-height: calc(12.2em - 16.5cqi);
  }

  .headline {
    margin: 0.15em 0 0;
    font-size: 1.7em;
    line-height: 1.15;
    text-wrap: balance;
  }

  .verdict.caption {
    min-height: 0;
    margin-bottom: 0.3em;
    font-size: 0.92em;
  }

  .judge .choices {
    margin-bottom: 0.2em;
  }

  .judge .effect {
    margin: 0 0 0.5em;
  }

  .about {
    margin: 0;
  }

  .overview {
    display: none;
  }

  .views {
    margin-bottom: 0.5em;
  }

  /* The picture is as high as possible, with the sentence and the presets next to it. */
  @container (min-width: 38em) {
    .views {
      grid-template-columns: minmax(0, 60svh) minmax(18.25em, 1fr);
      column-gap: 1.25em;
    }

    :host([presentation]) .views {
      grid-template-columns: minmax(0, 1fr) 17em;
    }

    canvas {
      aspect-ratio: 4 / 3;
    }
  }

  /* The samplers fit in one row, and the headline has the same number of lines for every share. */
  @container (38em <= width < 56em) {
    .result {
      min-height: 12em;
    }

    .judge .choices > span {
      flex: 1 0 100%;
    }

    .judge .choice {
      padding: 0 0.4em;
      font-size: 0.92em;
    }
  }

  @container (min-width: 56em) {
    .headline {
      font-size: 2em;
    }

    :host(:not([presentation])) .overview {
      display: block;
      width: 11em;
    }
  }

  .dropping .stage {
    outline: 2px dashed var(--accent);
    outline-offset: 4px;
  }

  .marked label {
    color: var(--ink);
  }

  .own-map p {
    margin: 0 0 0.6em;
  }

  .own-map .note {
    /* When it is scrolled into view, the name of the current map is visible too. */
    scroll-margin: 4em;
    overflow-wrap: anywhere;
  }

  textarea {
    margin: 0.35em 0 0.7em;
  }

  @media print {
    .own-map :not(.present, :has(.present)) {
      display: none !important;
    }
  }
`;
