/** Summary of what was read: numbers and decisions about each log, and a small picture of both paths. Loaded with the first log. */

import { html, nothing, svg } from 'lit';
import { guard } from 'lit/directives/guard.js';
import type { Drive } from '../../logs/drives.ts';
import { LOG_TIME, ROLES, framesText, type Cause, type Log } from '../../logs/log.ts';
import { aligned, pathOf, type Path } from '../../logs/path.ts';
import { notesOf } from '../../logs/summary.ts';
import { language } from '../../messages/registry.ts';
import { counted, fixed } from '../../ui/format.ts';
import type { LogOpener, LogWords } from './open.ts';

/** Size of the picture, CSS pixels, and its margin for the width of lines. */
const [WIDTH, HEIGHT, MARGIN] = [220, 150, 4];

/** Maximum number of points of a path: several for each pixel. */
const POINTS = 1500;

/** Returns what was read of each drive, shown while it is fitted and below the result. */
export function summaryOf({ chosen, say, host }: LogOpener) {
  // The page may have given another log since.
  if (!chosen?.drives || !say || (chosen.log && chosen.log !== host.log)) return nothing;
  const { drives } = chosen;
  return html`<details class="found" open>
    <summary>${say.found.labels.title}</summary>
    ${guard([drives, say, language], () => drives.map((drive, i) => html`<div class="drive">
      ${tableOf(drive, drives.length > 1 ? say.found.labels.drive(i + 1) : '', say)}
      ${pathsOf(drive, say)}
    </div>`))}
  </details>`;
}

function tableOf({ odometry, reference }: Drive, caption: string, say: LogWords) {
  const logs = [odometry, reference];
  const { labels } = say.found;
  const row = (label: string, cellOf: (log: Log) => unknown) => {
    const cells = logs.map(cellOf);
    return cells.some((cell) => cell !== '') ? html`<tr><th scope="row">${label}</th>${cells.map((cell) => html`<td>${cell === '' ? '—' : cell}</td>`)}</tr>` : nothing;
  };
  const lines = (texts: string[]) => (texts.length ? texts.map((text, i) => html`${i ? html`<br />` : nothing}${text}`) : '');
  return html`<table>
    ${caption ? html`<caption>${caption}</caption>` : nothing}
    <thead>
      <tr><td></td>${ROLES.map((role, i) => html`<th scope="col">${say.choose.roles[role]}: ${logs[i].name}</th>`)}</tr>
    </thead>
    <tbody>
      ${row(labels.rows, ({ summary: { used, rows } }) => labels.ofRows(counted(used), counted(rows)))}
      ${row(labels.leftOut, ({ summary: { dropped, columns } }) =>
        lines((Object.entries(dropped) as [Cause, { count: number; first: number }][]).map(([cause, { count, first }]) => labels.dropped(cause, counted(count), columns ? first : 0))))}
      ${row(labels.duration, ({ summary: { seconds, rate } }) => labels.at(fixed(seconds, 1), fixed(rate, 1)))}
      ${row(labels.distance, ({ summary: { distance } }) => (Number.isNaN(distance) ? '' : `${fixed(distance, 1)} m`))}
      ${row(labels.gaps, ({ summary: { gaps } }) => (gaps.count ? labels.longest(fixed(gaps.longest, 2), counted(gaps.count)) : labels.none))}
      ${row(labels.jumps, ({ summary: { jumps } }) => (jumps.count ? counted(jumps.count) : ''))}
      ${row(labels.units, ({ summary: { units } }) => say.found.units(units))}
      ${row(labels.frames, ({ summary: { frames } }) => (frames ? framesText(frames) : ''))}
      ${row(labels.columns, ({ summary: { columns } }) => (columns ? Object.values(columns).join(', ') : ''))}
      ${row(labels.clock, ({ summary: { clock, columns } }) => (columns ? '' : clock === LOG_TIME ? labels.recorded : clock))}
      ${row(labels.notes, (log) => lines(notesOf(log, say.found)))}
    </tbody>
  </table>`;
}

/** Returns a picture of both paths, of which the odometry is aligned with the reference. */
function pathsOf({ odometry, reference }: Drive, { found: { labels } }: LogWords) {
  const [driven, truth] = [odometry.data, reference.data].map((data) => pathOf(data, Math.ceil(data.t.length / POINTS)));
  const own = aligned(driven, truth);
  const all = [...own.poses, ...truth.poses];
  const ends = ([0, 1] as const).map((axis) => [Math.min(...all.map((pose) => pose[axis])), Math.max(...all.map((pose) => pose[axis]))]);
  const [width, height] = ends.map(([low, high]) => high - low);
  const scale = Math.min((WIDTH - 2 * MARGIN) / Math.max(width, 0.1), (HEIGHT - 2 * MARGIN) / Math.max(height, 0.1));
  const coordinate = (value: number) => value.toFixed(1);
  const line = ({ poses, breaks }: Path) => poses.map(([x, y], i) =>
    `${i === 0 || breaks.has(i) ? 'M' : 'L'}${coordinate(MARGIN + (x - ends[0][0]) * scale)} ${coordinate(HEIGHT - MARGIN - (y - ends[1][0]) * scale)}`).join('');
  const text = labels.paths(fixed(width, 1), fixed(height, 1));
  return html`<figure class="paths">
    <svg viewBox="0 0 ${WIDTH} ${HEIGHT}" role="img" aria-label=${text}>
      ${svg`<path class="reference" d=${line(truth)}></path><path class="odometry" d=${line(own)}></path>`}
    </svg>
    <figcaption>${text}</figcaption>
  </figure>`;
}
