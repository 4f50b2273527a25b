/** What Arc Anatomy's page has of its own: the bars, the lines of the table, and the key to its lines. */

import { css } from 'lit';
import { layoutStyles } from '../../ui/layout.js';
import { plotStyles } from '../../ui/plot.js';
import { besideStyles, poseHandleStyles } from '../shared/styles.js';

const own = css`
  canvas {
    aspect-ratio: 5 / 4;
  }

  .factors {
    display: grid;
    gap: 0.5em;
    margin: 0 0 0.6em;
    padding: 0;
    list-style: none;
  }

  .factors li {
    display: grid;
    grid-template: 'estimate off' 'bar bar' 'keeps keeps' / 1fr auto;
    align-content: start;
    padding-left: 0.5em;
    border-left: 3px solid transparent;
  }

  .factors.lit li,
  .factors .weakest {
    border-color: var(--accent);
  }

  .factors .estimate {
    grid-area: estimate;
  }

  .factors .off {
    grid-area: off;
    align-self: end;
    font-size: 0.84em;
  }

  .factors svg {
    grid-area: bar;
    width: 100%;
    height: 1.3em;
  }

  .factors rect {
    fill: var(--prediction);
  }

  .factors .tick {
    stroke: var(--muted);
    vector-effect: non-scaling-stroke;
  }

  .factors .beyond {
    fill: none;
    stroke: var(--prediction);
    stroke-width: 3;
  }

  .factors .keeps {
    grid-area: keeps;
    color: var(--muted);
    font-size: 0.84em;
    line-height: 1.25;
  }

  /* Below the picture the bars stand side by side. */
  @container (22em <= width < 38em) {
    .factors {
      grid-template-columns: repeat(3, minmax(0, 1fr));
      font-size: 0.88em;
    }

    .factors li {
      grid-template: 'estimate' 'bar' 'off' 'keeps' / 1fr;
    }
  }

  /* As high as the factors beside it. */
  @container (38em <= width < 45em) {
    canvas {
      aspect-ratio: 1;
    }
  }

  /* Wider, and not higher: all of it is to fit on a screen. */
  @container (min-width: 52em) {
    canvas {
      aspect-ratio: 3 / 2;
    }
  }

  @container (min-width: 60em) {
    .views {
      grid-template-columns: minmax(0, 1fr) 18em;
    }

    canvas {
      aspect-ratio: 7 / 4;
    }
  }

  .drawn .choices {
    --name: 3em;
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
    margin-bottom: 0.5em;
  }

  .underway input {
    flex: 1;
    --thumb: var(--truth);
    min-width: 4em;
  }

  .underway output {
    min-width: 4em;
    text-align: right;
  }

  .lines {
    margin: 0 0 0.6em;
    padding: 0;
    list-style: none;
  }

  .lines li {
    padding: 0.1em 0.5em;
    border-left: 3px solid transparent;
  }

  .lines .lit {
    border-color: var(--accent);
  }

  .handle.turn {
    --ring: var(--prediction);
  }

  .handle.turn.start {
    --ring: var(--truth);
  }

  .handle.turn::after {
    border-color: var(--ring);
  }

  .handle.turn:hover::after {
    background: var(--ring);
  }

  .key svg {
    stroke-width: 2;
  }

  .key .commanded {
    stroke: var(--prior);
    stroke-dasharray: 2.5 3.5;
  }

  .key .inverted {
    stroke: var(--prediction);
  }

  .key .wedge {
    fill: var(--accent);
    fill-opacity: 0.3;
    stroke: var(--accent);
    stroke-width: 1;
  }

  .key .chord {
    stroke: var(--ink);
    stroke-width: 1;
    stroke-dasharray: 2 3;
  }

  .key .twist {
    stroke: var(--posterior);
    stroke-width: 1.5;
  }
`;

export const anatomyStyles = [...layoutStyles, plotStyles, besideStyles, poseHandleStyles, own];
