/** Numbers as text: a list of readouts, and tables. */

import { css, html, nothing } from 'lit';
import { formatMarkup, untranslatedHtml } from './controls.ts';

export const readoutStyles = css`
  /* Readouts side by side, each with its name above its number. */
  .readouts {
    align-content: start;
    gap: 0.2em 2em;
    margin: 0.1em 0 0.5em;
  }

  .summary .readouts {
    margin: 0;
  }

  /* In a wide figure the headline readout is beside the caption. */
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

  .readouts :is(dt, .detail, .earlier) {
    color: var(--muted);
    font-size: 0.84em;
  }

  .readouts :is(dt, dd) {
    margin: 0;
    line-height: 1.25;
  }

  .readouts dd:not(.detail) > bdi {
    font-size: 1.1em;
    white-space: nowrap;
  }

  .readouts .headline dd:not(.detail) > bdi {
    font-size: 2em;
    line-height: 1.1;
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
  }

  :is(th, td) + :is(th, td) {
    padding-inline-start: 0.54em;
  }

  thead th:not(:first-child),
  td {
    text-align: end;
  }

  td:not([colspan]) > bdi {
    white-space: nowrap;
  }

  /* In a narrow table the name of a row is above the numbers, which then have the whole width. */
  @container (width < 26em) {
    table {
      font-size: 0.82em;

      > :is(caption, thead, tbody) {
        display: block;
      }

      tr {
        display: flex;
        flex-wrap: wrap;
      }

      :is(th, td) {
        flex: 1;
        overflow-wrap: anywhere;
      }

      :is(th, td):first-child {
        flex-basis: 100%;
      }
    }
  }
`;

/** Returns a list of readouts. Each may have a detail below it, and an earlier value beside it. One may be the headline of the figure. */
export function readoutsHtml(readoutRows: [name: string, value: string, detail?: string, earlier?: string][], headlineIndex?: number) {
  return html`<dl class="readouts" part="readouts">
    ${readoutRows.map(
      ([readoutName, readoutValue, readoutDetail, earlierValue], i) => html`<div class=${i === headlineIndex ? 'headline' : nothing}>
        <dt>${formatMarkup(readoutName)}</dt>
        <dd>${untranslatedHtml(readoutValue)}${earlierValue ? html` <span class="earlier">${untranslatedHtml(earlierValue)}</span>` : nothing}</dd>
        ${readoutDetail ? html`<dd class="detail">${formatMarkup(readoutDetail)}</dd>` : nothing}
      </div>`,
    )}
  </dl>`;
}

interface TableContent {
  caption?: unknown;
  /** Headings of the columns. The first column has the names of the rows. */
  columnHeadings: unknown[];
  /** Rows, each as its name and its cells. A single cell after the name spans all columns. */
  rows: unknown[][];
}

export function tableHtml({ caption, columnHeadings, rows: tableRows }: TableContent) {
  const rowCellsHtml = ([firstCell, ...otherCells]: unknown[]) =>
    otherCells.length === 0
      ? html`<td colspan=${columnHeadings.length - 1}>${untranslatedHtml(firstCell)}</td>`
      : [firstCell, ...otherCells].map((tableCell) => html`<td>${untranslatedHtml(tableCell)}</td>`);
  return html`<table part="table">
    ${caption ? html`<caption>${caption}</caption>` : nothing}
    <thead>
      <tr>
        ${columnHeadings.map((columnHeading) => html`<th scope="col">${columnHeading}</th>`)}
      </tr>
    </thead>
    <tbody>
      ${tableRows.map(
        ([rowName, ...rowCells]) => html`<tr>
          <th scope="row">${rowName}</th>
          ${rowCellsHtml(rowCells)}
        </tr>`,
      )}
    </tbody>
  </table>`;
}
