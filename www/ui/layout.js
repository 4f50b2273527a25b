/**
 * The page of a widget, from above: its pictures side by side, the sentence that they say, the figures that matter, the
 * controls in compact rows, and folds with everything else. So much is seen without scrolling in a column of 700 pixels.
 */

import { css } from 'lit';
import { controlStyles } from './controls.js';
import { markedStyles } from './marked.js';
import { readoutStyles } from './readouts.js';
import { sliderStyles } from './slider.js';

const layout = css`
  .views,
  .controls {
    display: grid;
    gap: 0.25rem 2rem;
    align-items: start;
  }

  .controls {
    grid-template-columns: repeat(auto-fit, minmax(min(100%, 18rem), 1fr));
    gap: 0 2.5rem;
  }

  @container (min-width: 56rem) {
    .controls {
      column-gap: 5rem;
    }
  }

  /* What is needed less often, one beside the other; an open one has the whole width. */
  .folds {
    display: flex;
    flex-wrap: wrap;
    align-items: start;
    gap: 0.1rem 1.2rem;
    margin-top: 0.4rem;
    padding-top: 0.3rem;
    border-top: 1px solid var(--rule);
  }

  .folds > details {
    min-width: 0;
  }

  .folds > details[open] {
    flex: 1 0 100%;
    padding-bottom: 0.8rem;
  }

  .begin button {
    min-height: 1.75rem;
    padding: 0 0.5rem 0.1rem;
  }

  .folded {
    padding-top: 0.4rem;
  }

  .figures {
    display: grid;
    gap: 1rem 2.75rem;
    align-items: start;
    grid-template-columns: repeat(auto-fit, minmax(min(100%, 20rem), 1fr));
  }

  figure,
  dl {
    margin: 0;
  }

  .stage {
    position: relative;
  }

  canvas {
    display: block;
    width: 100%;
    touch-action: pan-y pinch-zoom;
    font-size: 13px;
    cursor: crosshair;
  }

  .handle {
    position: absolute;
    top: 0;
    left: 0;
    width: 2.25rem;
    height: 2.25rem;
    transform: translate(-50%, -50%);
    border-radius: 50%;
    cursor: grab;
    touch-action: none;
  }

  .handle:active {
    cursor: grabbing;
  }

  .handle::after {
    content: '';
    position: absolute;
    inset: 0.55rem;
    box-sizing: border-box;
    background: var(--paper);
    border: 3px solid var(--prior);
    border-radius: 50%;
  }

  /* What stops a handle, while it is held or moved from the keyboard. */
  .handle[data-stop]:is(.held, :focus-visible)::before {
    content: attr(data-stop);
    position: absolute;
    top: 50%;
    left: calc(100% + 0.3rem);
    translate: 0 -50%;
    padding: 0.1rem 0.5rem;
    background: var(--ink);
    border-radius: 3px;
    color: var(--paper);
    font-size: 0.85rem;
    white-space: nowrap;
    pointer-events: none;
  }

  .handle.right[data-stop]:is(.held, :focus-visible)::before {
    right: calc(100% + 0.3rem);
    left: auto;
  }

  .handle:hover::after {
    background: var(--prior);
  }

  .caption {
    display: grid;
    margin: 0;
    padding: 0.25rem 0;
  }

  .caption > * {
    grid-area: 1 / 1;
  }

  /* Room for the longest note, which is indented. */
  .caption::after {
    grid-area: 1 / 1;
    height: auto;
    padding-left: calc(0.8rem + 3px);
  }

  .caption.note::after {
    padding-left: 0;
  }

  .note {
    margin: 0.5rem 0;
    padding-left: 0.8rem;
    border-left: 3px solid var(--accent);
  }

  .caption.note {
    margin: 0;
  }

  @container (max-width: 34rem) {
    .caption {
      font-size: 0.95rem;
      line-height: 1.25;
    }
  }

  .legend {
    display: grid;
    grid-template-columns: repeat(auto-fill, minmax(min(100%, 20rem), 1fr));
    gap: 0 2.5rem;
    margin-top: 0.4rem;
  }

  .buttons {
    display: flex;
    flex-wrap: wrap;
    align-items: center;
    gap: 0.5rem;
    margin-bottom: 0.7rem;
  }

  .seed {
    margin-left: auto;
    color: var(--muted);
  }

  figcaption {
    margin: 0.4rem 0 1.25rem;
    color: var(--muted);
    font-size: 0.92rem;
  }

  /* On a phone the floor stays in sight while the controls below it are used. */
  @container (width < 30rem) {
    @media (min-height: 37.5rem) {
      .stage[part='picture'] {
        position: sticky;
        top: 0;
        z-index: 1;
        background: var(--paper);
        box-shadow:
          -0.5rem 0 var(--paper),
          0.5rem 0 var(--paper),
          0 0.5rem 0.5rem var(--paper);
      }

      .views {
        display: contents;
      }

      /* Clear of the shadow. */
      .stage[part='picture'] + * {
        margin-top: 0.7rem;
      }

      .stage canvas {
        max-height: 38svh;
      }

      /* What has the focus stays clear of the floor above it. */
      :is(button, input, summary, textarea, .chart-marker) {
        scroll-margin-top: calc(38svh + 2rem);
      }
    }
  }
`;

export const layoutStyles = [readoutStyles, markedStyles, controlStyles, sliderStyles, layout];
