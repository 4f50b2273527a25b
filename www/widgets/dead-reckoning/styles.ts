/** Styles of Dead Reckoning. */

import { css } from 'lit';

/** The chart stays visible while scrolling, because its line is dragged. */
const chartAlone = css`
  .ratios,
  .chart {
    display: contents;
  }

  .chart .plotted {
    position: sticky;
    top: var(--top);
    z-index: 2;
    max-width: none;
    margin-bottom: 0.5em;
    box-sizing: border-box;
    background: var(--paper);
    border-inline: max(0px, (100cqi - 45svh * 1.52) / 2) solid var(--paper);
    box-shadow:
      -0.5em 0 var(--paper),
      0.5em 0 var(--paper),
      0 0.25em 0.25em var(--paper);
  }

  .floor .stage[part='picture'] {
    position: relative;
    z-index: auto;
    box-shadow: none;
  }
`;

export const styles = css`
  .chart .plotted {
    max-width: calc(var(--most, 60svh) * 1.52);
    margin-inline: auto;
  }

  /* The line at the selected step follows the pointer. */
  .chart input {
    --thumb: var(--accent);
    cursor: ew-resize;
  }

  :host([presentation]) .views {
    --most: 41svh;
  }

  :host([presentation]) .ratios {
    display: grid;
  }

  :host([presentation]) .chart {
    display: block;
  }

  :host([presentation]) .chart .plotted {
    position: relative;
    border: 0;
    box-shadow: none;
  }

  :host([presentation]) .step .stage {
    min-height: 20vh;
  }

  @container (min-width: 30em) {
    canvas {
      aspect-ratio: 1;
    }

    .step canvas {
      aspect-ratio: 2;
    }

    /* Two columns: the chart above its message, the floor above the step. */
    .views {
      grid-template: auto auto / minmax(0, 1.45fr) minmax(0, 1fr);
      grid-auto-flow: column;
      column-gap: 1em;
    }

    :host([presentation]) .views {
      grid-template-rows: 1fr auto;
    }

    .summary .caption {
      font-size: 0.95em;
      line-height: 1.25;
    }

    .summary .choices {
      grid-column: 1 / -1;
    }
  }

  /* The chart grows with the figure, but its text does not. */
  @container (min-width: 44em) {
    .chart .plot text {
      font-size: 10.8px;
    }
  }

  @container (min-width: 56em) {
    :is(canvas, .step canvas) {
      aspect-ratio: 6 / 7;
    }

    .views {
      grid-template-columns: minmax(0, 1.75fr) repeat(2, minmax(0, 1fr));
    }

    /* Sliders that have their names in the same row need wide columns: two instead of three. */
    .folded .controls {
      grid-template-columns: repeat(2, minmax(0, 1fr));
    }

    .summary {
      grid-area: 2 / 1 / auto / -1;
      grid-template-columns: fit-content(12em) 1fr auto;
      column-gap: 2em;
    }

    .summary .choices {
      grid-column: auto;
    }
  }

  @media (min-height: 22em) {
    @container (width < 30em) {
      ${chartAlone}
    }
  }

  @media (22em <= height < 40em) {
    @container (width < 56em) {
      ${chartAlone}
    }
  }
`;
