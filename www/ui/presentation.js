/** How a figure looks before an audience: as in a small window, which the whole screen shows enlarged. */

import { css } from 'lit';

export const presentationStyles = css`
  :host([presentation]) {
    position: fixed !important;
    inset: 0 !important;
    z-index: 2147483647 !important;
    display: block !important;
    box-sizing: border-box !important;
    width: 100% !important;
    max-width: none !important;
    height: 100% !important;
    max-height: none !important;
    margin: 0 !important;
    padding: 0 !important;
    border: 0 !important;
    overflow: hidden !important;
    font-size: 16px !important;
  }

  :host([presentation]) .surface {
    /* Not by zoom: browsers disagree about what lengths are inside of one. */
    transform: scale(var(--zoom));
    transform-origin: 0 0;
    --top: 0px;
    background: var(--paper);
    display: flex;
    flex-direction: column;
    box-sizing: border-box;
    width: calc(100% / var(--zoom));
    height: calc(100% / var(--zoom));
    padding: 0.4em 0.8em;
    overflow: auto;
    overscroll-behavior: contain;
  }

  :host([presentation]) .machine {
    flex: 1;
    display: flex;
    flex-direction: column;
    min-height: 0;
  }

  :host([presentation]) .views {
    flex: 1;
    display: grid;
    grid-template-rows: minmax(0, 1fr);
    min-height: 0;
  }

  :host([presentation]) .stage {
    position: relative !important;
    height: 100%;
    min-height: 0;
  }

  :host([presentation]) .stage canvas {
    width: 100%;
    height: 100%;
    max-height: none;
    aspect-ratio: auto;
  }

  :host([presentation]) .surface:not(.with-controls) .machine > :not(.views, [part~='caption'], [part~='readouts']),
  :host([presentation]) .surface:not(.with-controls) .aside > :not([part~='readouts'], .told),
  :host([presentation]) .surface > .caption-slot,
  :host([presentation]) .begin {
    display: none !important;
  }

  /* All that fits is seen at once, and the pictures take what is left; what does not fit is scrolled to. */
  :host([presentation]) .with-controls .machine {
    flex: 1 0 auto;
  }

  :host([presentation]) .with-controls .views {
    flex: 1 0 auto;
    grid-template-rows: 1fr;
    align-items: stretch;
    background: var(--paper);
  }

  :host([presentation]) .with-controls .stage {
    height: auto;
    min-height: calc(42vh / var(--zoom));
  }

  /* Never what makes a row higher. */
  :host([presentation]) .with-controls .stage canvas {
    position: absolute;
    inset: 0;
  }

  /* Nor on a phone, which has no room for all that there is to say. */
  @media (max-width: 30em) or (max-height: 30em) {
    :host([presentation]) :is(.machine, .views) {
      flex: 1 0 auto;
    }

    :host([presentation]) .views {
      grid-template-rows: auto;
    }

    :host([presentation]) .stage {
      height: auto;
      min-height: calc(60vmin / var(--zoom));
    }

    :host([presentation]) .stage canvas {
      position: absolute;
      inset: 0;
    }
  }

  :host([presentation]) .with-controls .folds {
    margin-top: 0;
  }

  /* What is set in a fold is seen above it. */
  @media (min-width: 60em) and (min-height: 37.5em) {
    :host([presentation]) .with-controls {
      scroll-padding-top: calc(66vh / var(--zoom));
    }

    :host([presentation]) .with-controls .views {
      position: sticky;
      top: -0.4em;
      z-index: 1;
      /* Also over the edges of what passes behind it. */
      box-shadow:
        -0.5em 0 var(--paper),
        0.5em 0 var(--paper);
    }
  }

  /* Clear of the buttons. */
  :host([presentation]) .aside {
    padding-top: 1.6em;
  }

  /* It takes no room, and stays while what is below is scrolled to. */
  .presenting {
    position: sticky;
    top: 0;
    z-index: 2;
    order: -1;
    align-self: flex-end;
    display: flex;
    flex: none;
    align-items: start;
    gap: 0.53em;
    height: 0;
    font-size: 0.75em;
  }

  /* But on a phone, where it would hide a legend. */
  @media (max-width: 30em) or (max-height: 30em) {
    .presenting {
      height: auto;
      margin-bottom: 0.5em;
    }
  }

  .presenting button {
    min-height: 0;
    padding: 0 0.53em;
    background: var(--paper);
  }

  .presenting button[aria-pressed='true'] {
    background: var(--ink);
  }

  kbd {
    font: inherit;
    font-weight: bold;
  }
`;
