/**
 * The Banana Machine's figures: the statistics of the cloud, the marked robot, and the tables of
 * moments.
 *
 * @module
 */

import { css, html } from 'lit';
import { live } from 'lit/directives/live.js';
import { words } from '../../messages/registry.js';
import { inputOf, rich } from '../../ui/controls.js';
import { NOTHING, fixed, percent, significant, whole, withError } from '../../ui/format.js';

/**
 * @typedef {import('../../types.d.ts').Stats} Stats
 * @typedef {import('../../types.d.ts').Table} Table
 * @typedef {import('../../types.d.ts').Inspection} Inspection
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
    flex-wrap: wrap;
    justify-content: space-between;
    align-items: baseline;
    column-gap: 0.75rem;
    padding: 0.28rem 0;
    border-top: 1px solid var(--rule);
  }

  .readouts dt {
    flex: 1;
    min-width: min-content;
  }

  .readouts dd {
    margin: 0 0 0 auto;
    text-align: right;
    white-space: nowrap;
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
    width: 8rem;
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

  table {
    width: 100%;
    max-width: 34rem;
    margin-bottom: 1.25rem;
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
    padding: 0.14rem 0 0.14rem 0.5rem;
  }

  :is(th, td):first-child {
    padding-left: 0;
  }

  thead th:not(:first-child),
  td {
    text-align: right;
  }

  /* The name of a row above its numbers, which have the whole width then. */
  @container (width < 26rem) {
    table {
      font-size: 0.82rem;
    }

    table :is(caption, thead, tbody) {
      display: block;
    }

    tr {
      display: flex;
      flex-wrap: wrap;
    }

    tr > :is(th, td) {
      flex: 1;
      min-width: 0;
      padding-left: 0.3rem;
      overflow-wrap: anywhere;
    }

    tr > :first-child {
      flex-basis: 100%;
      padding-left: 0;
    }
  }
`;

/**
 * @param {Stats} stats
 * @param {number} samples robots in the whole cloud
 */
export function readouts(stats, samples) {
  const all = whole(samples);
  const say = words.banana.readouts;
  const { nOfAll } = words.banana;
  return readoutList([
    [say.skew, withError(stats.crossTrackSkew, stats.crossTrackSkewError, 3), withError(-1, 1, 3)],
    [say.gaussian, fixed(stats.gaussianSkew, 3), fixed(-1, 3)],
    [say.plane, '0'],
    [say.rho, fixed(stats.rhoCrossHeading, 3), fixed(-1, 3)],
    [say.robots, nOfAll(whole(stats.n), all), nOfAll(all, all)],
    [say.exponential, percent(stats.coverage.exponential), percent(1)],
    [say.ellipse, percent(stats.coverage.ellipse), percent(1)],
    [say.nominal, percent(NOMINAL)],
  ]);
}

/** @param {[string, string, string?][]} rows name, value, and the longest value there is to keep room for */
export function readoutList(rows) {
  return html`<dl class="readouts" part="readouts">
    ${rows.map(
      ([name, value, room = value]) =>
        html`<div><dt>${rich(name)}</dt><dd class="roomy" data-room=${room}>${value}</dd></div>`,
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
      ${words.banana.robot}
      <input
        id="robot"
        type="number"
        min="1"
        max=${Math.max(1, shown)}
        placeholder=${shown === 0 ? '' : `1–${whole(shown)}`}
        ?disabled=${shown === 0}
        .value=${live(index < 0 ? '' : String(index + 1))}
        @input=${(/** @type {Event} */ event) => {
          const value = inputOf(event).valueAsNumber;
          mark(Number.isInteger(value) && value >= 1 ? Math.min(value, shown) - 1 : -1);
        }}
      />
    </label>
    <output for="robot">
      ${inspection
        ? html`<span>${quantity('v̂', inspection.vHat, 'm/s')}</span>
            <span>${quantity('ω̂', inspection.omegaHat, 'rad/s')}</span>
            <span>${quantity('γ̂', inspection.gammaHat, 'rad/s')}</span>`
        : html`<span class="hint">${words.banana.markHint}</span>`}
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

/** Digits of what is computed, as many as the book prints; and of what chance leaves uncertain. */
const DIGITS = 5;
const MEASURED_DIGITS = 3;

/** @param {string} indices */
const sigma = (indices) => html`<i>Σ</i><sub><i>${indices}</i></sub>`;

/**
 * @param {Table} table
 * @param {Stats} stats
 */
export function workedExample({ linearized, exact, measured }, stats) {
  const computed = [linearized, exact];
  const [skew, ...error] = withError(stats.crossTrackSkew, stats.crossTrackSkewError, 3).split(' ');
  // Of two lines also while there is none.
  const measuredSkew = html`${skew} <br />${error.join(' ') || '\u00a0'}`;
  const say = words.banana.table;
  /** @type {[unknown, (column: Table['exact']) => number, unknown?][]} */
  const rows = [
    [rich(say.mean('*x*')), ({ mean }) => mean[0]],
    [rich(say.mean('*y*')), ({ mean }) => mean[1]],
    [rich(say.mean('*θ*')), ({ mean }) => mean[2]],
    [sigma('xx'), ({ cov }) => cov[0][0]],
    [sigma('yy'), ({ cov }) => cov[1][1]],
    [sigma('xy'), ({ cov }) => cov[0][1]],
    [sigma('xθ'), ({ cov }) => cov[0][2]],
    [sigma('yθ'), ({ cov }) => cov[1][2]],
    [sigma('θθ'), ({ cov }) => cov[2][2]],
    [html`<i>ρ</i><sub><i>yθ</i></sub>`, ({ cov }) => cov[1][2] / Math.sqrt(cov[1][1] * cov[2][2])],
    [say.skew, ({ crossTrackSkew }) => crossTrackSkew, measuredSkew],
  ];
  return momentTable({
    caption: say.caption,
    columns: [say.linearized, say.exact, say.measured],
    rows: rows.map(([name, of, withItsError]) => [
      name,
      ...computed.map((column) => significant(of(column), DIGITS)),
      withItsError ?? significant(of(measured), MEASURED_DIGITS),
    ]),
  });
}

/**
 * @param {Table} table
 * @param {Stats} stats
 */
export function twistTable({ tangent }, { exponential }) {
  const say = words.banana.table;
  const rows = say.axes.flatMap((axis, i) => {
    /** @type {[string, (moments: import('../../types.d.ts').Moments) => number][]} */
    const both = [
      [say.mean(axis), ({ mean }) => mean[i]],
      [say.variance(axis), ({ cov }) => cov[i][i]],
    ];
    return both;
  });
  return momentTable({
    caption: say.twistCaption,
    columns: [say.command, say.measured],
    rows: rows.map(([name, of]) => [
      rich(name),
      tangent === null ? NOTHING : significant(of(tangent), DIGITS),
      significant(of(exponential), MEASURED_DIGITS),
    ]),
  });
}

/**
 * @param {{ caption: string, columns: string[], rows: unknown[][] }} table the name of each row first
 */
function momentTable({ caption, columns, rows }) {
  // As wide as any of what is measured: while the cloud grows, no column does.
  const room = significant(-1e-5, MEASURED_DIGITS);
  return html`<table part="table">
    <caption>${caption}</caption>
    <thead>
      <tr>
        <th scope="col">${words.banana.table.quantity}</th>
        ${columns.map((name) => html`<th scope="col">${name}</th>`)}
      </tr>
    </thead>
    <tbody>
      ${rows.map(
        ([name, ...cells]) => html`<tr>
          <th scope="row">${name}</th>
          ${cells.map((cell) => html`<td class="roomy" data-room=${room}>${cell}</td>`)}
        </tr>`,
      )}
    </tbody>
  </table>`;
}
