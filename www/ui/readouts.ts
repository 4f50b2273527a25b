/** Numbers as text: a list of readouts, and tables. */

import { css, html, nothing } from 'lit';
import { formatMarkup, untranslated } from './controls.ts';

export const readoutStyles = css`
  /* Name above its number, side by side. */
  .readouts {
    display: flex;
    flex-wrap: wrap;
    align-content: start;
    gap: 0.2em 2em;
    margin: 0.1em 0 0.5em;
  }

  .summary .readouts {
    margin: 0;
  }

  /* The message of the figure beside its caption. */
  @container (min-width: 30em) {
    .summary {
      display: grid;
      grid-template-columns: fit-content(12em) 1fr;
      column-gap: 1em;
      align-items: center;
    }
  }

  /* Reserved width, so that a longer value moves no neighbour. */
  .readouts > div {
    min-width: 5em;
  }

  .readouts dt {
    color: var(--muted);
    font-size: 0.84em;
    line-height: 1.25;
  }

  .readouts dd {
    margin: 0;
    font-size: 1.1em;
    line-height: 1.25;
    white-space: nowrap;
  }

  .readouts .headline dd:not(.detail) {
    font-size: 2em;
    line-height: 1.1;
  }

  .readouts dd:has(.earlier) {
    white-space: normal;
  }

  /* An earlier value is as large as a detail, whatever the size of the value beside it. */
  .readouts .earlier {
    display: inline-block;
    color: var(--muted);
    font-size: 0.76em;
    white-space: nowrap;
  }

  .readouts .headline .earlier {
    font-size: 0.42em;
  }

  .readouts .detail {
    color: var(--muted);
    font-size: 0.84em;
    white-space: normal;
  }

  sub {
    line-height: 0;
  }

  table {
    width: 100%;
    max-width: 37em;
    margin-bottom: 1.36em;
    border-collapse: collapse;
    font-size: 0.92em;
    border-block: 1.5px solid var(--ink);
  }

  caption {
    caption-side: bottom;
    padding-top: 0.54em;
    text-align: start;
    color: var(--muted);
  }

  thead {
    border-bottom: 0.75px solid var(--ink);
  }

  th {
    font-weight: normal;
    text-align: start;
  }

  :is(th, td) {
    padding: 0.15em 0;
    padding-inline-start: 0.54em;
  }

  :is(th, td):first-child {
    padding-inline-start: 0;
  }

  thead th:not(:first-child),
  td {
    text-align: end;
  }

  /* Name of a row above its numbers, which then have the whole width. */
  @container (width < 26em) {
    table {
      font-size: 0.82em;
    }

    :where(table:not(.alphas)) > :is(caption, thead, tbody) {
      display: block;
    }

    :where(table:not(.alphas)) tr {
      display: flex;
      flex-wrap: wrap;
    }

    :where(table:not(.alphas)) tr > :is(th, td) {
      flex: 1;
      min-width: 0;
      padding: 0.17em 0;
      padding-inline-start: 0.37em;
      overflow-wrap: anywhere;
    }

    :where(table:not(.alphas)) tr > :first-child {
      flex-basis: 100%;
      padding-inline-start: 0;
    }
  }
`;

/** Returns a list of readouts. Each may have a detail below it, and an earlier value beside it. One may be the headline of the figure. */
export function readoutList(rows: [name: string, value: string, detail?: string, earlier?: string][], headline?: number) {
  return html`<dl class="readouts" part="readouts">
    ${rows.map(
      ([name, value, detail, earlier], i) => html`<div class=${i === headline ? 'headline' : nothing}>
        <dt>${formatMarkup(name)}</dt>
        <dd>${untranslated(value)}${earlier ? html` <span class="earlier">${untranslated(earlier)}</span>` : nothing}</dd>
        ${detail ? html`<dd class="detail">${formatMarkup(detail)}</dd>` : nothing}
      </div>`,
    )}
  </dl>`;
}

interface FigureTable {
  caption?: unknown;
  /** Headings of the columns. The first column has the names of the rows. */
  columns: unknown[];
  /** Rows, each as its name and its cells. A single cell after the name spans all columns. */
  rows: unknown[][];
}

export function figureTable({ caption, columns, rows }: FigureTable) {
  const rowCells = ([firstCell, ...otherCells]: unknown[]) =>
    otherCells.length === 0
      ? html`<td colspan=${columns.length - 1}>${untranslated(firstCell)}</td>`
      : [firstCell, ...otherCells].map((cell) => html`<td>${untranslated(cell)}</td>`);
  return html`<table part="table">
    ${caption ? html`<caption>${caption}</caption>` : nothing}
    <thead>
      <tr>
        ${columns.map((name) => html`<th scope="col">${name}</th>`)}
      </tr>
    </thead>
    <tbody>
      ${rows.map(
        ([name, ...row]) => html`<tr>
          <th scope="row">${name}</th>
          ${rowCells(row)}
        </tr>`,
      )}
    </tbody>
  </table>`;
}
