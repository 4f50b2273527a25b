/**
 * The Banana Machine's figures: the statistics of the cloud, the marked robot, and the table of the
 * worked example.
 *
 * @module
 */

import { css, html } from 'lit';
import { live } from 'lit/directives/live.js';
import { inputOf } from '../ui/controls.js';
import { fixed, percent, whole, withError } from '../ui/format.js';

/**
 * @typedef {import('../types.d.ts').Stats} Stats
 * @typedef {import('../types.d.ts').Table} Table
 * @typedef {import('../types.d.ts').Inspection} Inspection
 */

/** Share of a Gaussian in the plane inside its 2σ ellipse, 1 − e⁻². */
const NOMINAL = 1 - Math.exp(-2);

export const readoutStyles = css`
  .readouts {
    display: grid;
    column-gap: 2.5rem;
    margin: 0.7rem 0 0.5rem;
    border-bottom: 1px solid var(--rule);
  }

  @container (min-width: 43rem) {
    .readouts {
      grid: repeat(4, auto) / auto-flow minmax(0, 1fr);
    }
  }

  .readouts div {
    display: flex;
    justify-content: space-between;
    align-items: baseline;
    gap: 1rem;
    padding: 0.28rem 0;
    border-top: 1px solid var(--rule);
  }

  .readouts dd {
    margin: 0;
    white-space: nowrap;
  }

  .readouts .swatch {
    margin-right: 0.4rem;
  }

  .marked {
    display: flex;
    flex-wrap: wrap;
    align-items: center;
    gap: 0.1rem 1.1rem;
    min-height: 2.2rem;
    margin: 0.3rem 0 0;
  }

  .marked output {
    display: inline-flex;
    flex-wrap: wrap;
    gap: 0.1rem 1.1rem;
  }

  .marked label {
    color: var(--accent);
  }

  .marked input {
    width: 5.2rem;
    min-height: 1.75rem;
    margin-left: 0.3rem;
    padding: 0 0.3rem;
    background: none;
    border: 1px solid var(--muted);
    border-radius: 3px;
    color: var(--ink);
    font: inherit;
    font-variant-numeric: inherit;
  }

  sub {
    line-height: 0;
  }

  .hint {
    color: var(--muted);
    font-style: italic;
  }

  .table {
    overflow-x: auto;
  }

  table {
    width: 100%;
    max-width: 34rem;
    border-collapse: collapse;
    font-size: 0.92rem;
    border-block: 1.5px solid var(--ink);
  }

  caption {
    caption-side: bottom;
    padding-top: 0.5rem;
    text-align: left;
    color: var(--muted);
  }

  thead {
    border-bottom: 0.75px solid var(--ink);
  }

  th {
    font-weight: normal;
    text-align: left;
  }

  :is(th, td) {
    padding: 0.14rem 0 0.14rem 0.7rem;
  }

  :is(th, td):first-child {
    padding-left: 0;
  }

  thead th:not(:first-child),
  td {
    text-align: right;
    white-space: nowrap;
  }
`;

/** @param {Stats} stats */
export function readouts(stats) {
  const rows = [
    ['cross-track skew, measured', withError(stats.crossTrackSkew, stats.crossTrackSkewError, 3)],
    ['skew, exponential-coordinate Gaussian', fixed(stats.gaussianSkew, 3)],
    [html`skew, any Gaussian in <i>(x, y)</i>`, '0'],
    [html`<i>ρ</i>(cross-track, heading)`, fixed(stats.rhoCrossHeading, 3)],
    [html`robots, <i>n</i>`, whole(stats.n)],
    ['inside 2σ, exponential coordinates', percent(stats.coverage.exponential)],
    [html`inside 2σ, Gaussian in <i>(x, y)</i>`, percent(stats.coverage.ellipse)],
    ['inside 2σ, nominal', percent(NOMINAL)],
  ];
  return html`<dl class="readouts">
    ${rows.map(
      ([name, value]) => html`<div><dt>${name}</dt><dd>${value}</dd></div>`,
    )}
  </dl>`;
}

/**
 * The marked robot, and the way to it from the keyboard.
 *
 * @param {object} marked
 * @param {number} marked.index −1 for none
 * @param {number} marked.shown robots there are
 * @param {Inspection | undefined} marked.inspection
 * @param {(index: number) => void} marked.mark
 */
export function markedRobot({ index, shown, inspection, mark }) {
  return html`<p class="marked">
    <label>
      Robot
      <input
        id="robot"
        type="number"
        min="1"
        max=${shown}
        placeholder="1–${shown}"
        .value=${live(index < 0 ? '' : String(index + 1))}
        @input=${(/** @type {Event} */ event) => {
          const value = inputOf(event).valueAsNumber;
          mark(Number.isInteger(value) && value >= 1 && value <= shown ? value - 1 : -1);
        }}
      />
    </label>
    <output for="robot">
      ${inspection
        ? html`<span>${quantity('v̂', inspection.vHat, 'm/s')}</span>
            <span>${quantity('ω̂', inspection.omegaHat, 'rad/s')}</span>
            <span>${quantity('γ̂', inspection.gammaHat, 'rad/s')}</span>`
        : html`<span class="hint">Point at one in either view to mark it in both.</span>`}
    </output>
  </p>`;
}

/**
 * @param {string} symbol
 * @param {number} value
 * @param {string} unit
 */
function quantity(symbol, value, unit) {
  return html`<i>${symbol}</i> = ${fixed(value, 3)} ${unit}`;
}

/** @param {Table} table */
export function workedExample(table) {
  const columns = /** @type {const} */ (['linearized', 'exact', 'measured']);
  const sigma = (/** @type {string} */ indices) => html`<i>Σ</i><sub><i>${indices}</i></sub>`;
  /** @type {[unknown, (column: Table['exact']) => number][]} */
  const rows = [
    [html`mean <i>x</i>`, ({ mean }) => mean[0]],
    [html`mean <i>y</i>`, ({ mean }) => mean[1]],
    [sigma('xx'), ({ cov }) => cov[0][0]],
    [sigma('yy'), ({ cov }) => cov[1][1]],
    [sigma('xy'), ({ cov }) => cov[0][1]],
    [sigma('xθ'), ({ cov }) => cov[0][2]],
    [sigma('yθ'), ({ cov }) => cov[1][2]],
    [sigma('θθ'), ({ cov }) => cov[2][2]],
    ['cross-track skew', ({ crossTrackSkew }) => crossTrackSkew],
  ];
  return html`<div class="table">
    <table>
      <caption>
        Moments of the pose: linearized at the command, exact, and measured on the robots shown.
        Metres and radians.
      </caption>
      <thead>
        <tr>
          <th scope="col">quantity</th>
          ${columns.map((name) => html`<th scope="col">${name}</th>`)}
        </tr>
      </thead>
      <tbody>
        ${rows.map(
          ([name, of]) => html`<tr>
            <th scope="row">${name}</th>
            ${columns.map((column) => html`<td>${fixed(of(table[column]), 6)}</td>`)}
          </tr>`,
        )}
      </tbody>
    </table>
  </div>`;
}
