/** Summary of what was read: numbers and decisions about each log, and a small picture of both paths. Loaded with the first log. */

import { html, nothing, svg } from 'lit';
import { guard } from 'lit/directives/guard.js';
import type { Drive } from '../../logs/drives.ts';
import { ROLES } from '../../logs/log.ts';
import { aligned, pathOf, type Path } from '../../logs/path.ts';
import { linesOf } from '../../logs/summary.ts';
import { language } from '../../messages/registry.ts';
import { fixed } from '../../ui/format.ts';
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
    <summary>${say.found.title}</summary>
    ${guard([drives, say, language], () => drives.map((drive, i) => html`<div class="drive">
      ${tableOf(drive, drives.length > 1 ? say.found.drive(i + 1) : '', say)}
      ${pathsOf(drive, say)}
    </div>`))}
  </details>`;
}

function tableOf({ odometry, reference }: Drive, caption: string, { choose, found }: LogWords) {
  const logs = [odometry, reference];
  const lines = logs.map((log) => linesOf(log, found));
  const cell = (texts: string[] = []) => html`<td>${texts.length ? texts.map((text, i) => html`${i ? html`<br />` : nothing}${text}`) : '—'}</td>`;
  const labels = (Object.keys(found.labels) as (keyof typeof found.labels)[]).filter((label) => lines.some((each) => each[label]?.length));
  return html`<table>
    ${caption ? html`<caption>${caption}</caption>` : nothing}
    <thead>
      <tr><td></td>${ROLES.map((role, i) => html`<th scope="col">${choose.roles[role]}: ${logs[i].name}</th>`)}</tr>
    </thead>
    <tbody>
      ${labels.map((label) => html`<tr><th scope="row">${found.labels[label]}</th>${lines.map((each) => cell(each[label]))}</tr>`)}
    </tbody>
  </table>`;
}

/** Returns a picture of both paths, of which the odometry is aligned with the reference. */
function pathsOf({ odometry, reference }: Drive, { found }: LogWords) {
  const [driven, truth] = [odometry.data, reference.data].map((data) => pathOf(data, Math.ceil(data.t.length / POINTS)));
  const odometryPath = aligned(driven, truth);
  const all = [...odometryPath.poses, ...truth.poses];
  const ends = ([0, 1] as const).map((axis) => [Math.min(...all.map((pose) => pose[axis])), Math.max(...all.map((pose) => pose[axis]))]);
  const [width, height] = ends.map(([low, high]) => high - low);
  const scale = Math.min((WIDTH - 2 * MARGIN) / Math.max(width, 0.1), (HEIGHT - 2 * MARGIN) / Math.max(height, 0.1));
  const coordinate = (value: number) => value.toFixed(1);
  const line = ({ poses, breaks }: Path) => poses.map(([x, y], i) =>
    `${i === 0 || breaks.has(i) ? 'M' : 'L'}${coordinate(MARGIN + (x - ends[0][0]) * scale)} ${coordinate(HEIGHT - MARGIN - (y - ends[1][0]) * scale)}`).join('');
  const text = found.paths(fixed(width, 1), fixed(height, 1));
  return html`<figure class="paths">
    <svg viewBox="0 0 ${WIDTH} ${HEIGHT}" role="img" aria-label=${text}>
      ${svg`<path class="reference" d=${line(truth)}></path><path class="odometry" d=${line(odometryPath)}></path>`}
    </svg>
    <figcaption>${text}</figcaption>
  </figure>`;
}
