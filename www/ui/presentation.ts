/** Styles of a figure in a presentation: it fills the screen, with a larger font. */

import { css } from 'lit';

export const presentationStyles = css`
  /* Font 1.5 times as large as the page's, larger on a large screen, and smaller on a small one. */
  :host([presentation]) {
    position: fixed !important;
    inset: 0 !important;
    width: 100% !important;
    max-width: none !important;
    height: 100% !important;
    margin: 0 !important;
    padding: 0 !important;
    border: 0;
    background: transparent;
    color: inherit;
    font-size: max(1em, min(1.5em, 100vw / 44, 100vh / 36), min(100vw / 80, 100vh / 45)) !important;
  }

  /* The font is smaller while the controls are shown, because they need space. */
  :host([presentation]) .with-controls {
    font-size: max(0.6em, min(1em, 100vw / 84, 100vh / 54));
  }

  :host([presentation]) .surface {
    --top: 0px;
    --motion-sticky-bottom: 0px;
    background: var(--paper);
    display: flex;
    flex-direction: column;
    box-sizing: border-box;
    height: 100%;
    padding: 0.4em 0.8em;
    overflow: auto;
    overscroll-behavior: contain;
  }

  :host([presentation]) .simulation {
    flex: 1 0 auto;
    display: flex;
    flex-direction: column;
    min-height: 0;
  }

  /* The pictures take the remaining space. */
  :host([presentation]) .views {
    flex: 1 0 auto;
    display: grid;
    grid-template-rows: 1fr;
  }

  :host([presentation]) :is(.panel, .stage) {
    align-self: stretch;
  }

  /* In a presentation, a narrow figure has no sticky picture, so that each picture is below its title. */
  :host([presentation]) .views > .panel:first-of-type {
    display: grid;
  }

  :host([presentation]) .panel-title + * {
    position: relative;
    top: 0;
    box-shadow: none;
  }

  :host([presentation]) .stage {
    min-height: 30vh;
  }

  :host([presentation]) .stage canvas {
    position: absolute;
    height: 100%;
    max-height: none;
    aspect-ratio: auto;
  }

  :host([presentation]) .caption {
    min-height: 0;
  }

  /* On a phone the figure scrolls, so that its pictures are large. */
  @media (width <= 30em) or (height <= 30em) {
    :host([presentation]) .views {
      grid-template-rows: auto;
    }

    :host([presentation]) .stage {
      min-height: 60vmin;
    }
  }

  /* The buttons of the presentation are in the row of the title. */
  @media (width > 30em) and (height > 30em) {
    :host([presentation]) .title-slot {
      margin-top: -1.55em;
      padding-inline-end: 10em;
    }
  }

  :host([presentation]) .surface:not(.with-controls) .simulation > :not(.views, .morphing, .presets, .about, [part~='legend'], [part~='caption'], [part~='readouts']),
  :host([presentation]) .surface:not(.with-controls) .aside > :not([part~='readouts'], .result, .presets, .judge),
  :host([presentation]) .surface:not(.with-controls) :is(.result, .looked) > :is(.slider, .choices, button),
  :host([presentation]) .surface:not(.with-controls) .start-over,
  :host([presentation]) .surface > .caption-slot,
  :host([presentation]) .begin {
    display: none !important;
  }

  .presenting {
    position: sticky;
    top: 0;
    z-index: 2;
    order: -1;
    align-self: flex-end;
    display: flex;
    gap: 0.53em;
    margin-bottom: 0.4em;
    font-size: 0.75em;
  }

  .presenting:focus {
    outline: none;
  }

  .presenting button {
    min-height: 0;
    padding: 0 0.53em;
  }

  /* The button of a preset shows the key that selects the preset. */
  :host([presentation]) .presets {
    counter-reset: key;
    margin: 0.2em 0 0;
    font-size: 0.85em;
  }

  :host([presentation]) .presets > .preset::before {
    counter-increment: key;
    content: counter(key) / '';
    margin-inline-end: 0.5em;
    font-weight: bold;
  }
`;
