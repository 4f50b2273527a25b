/** Picture of the drives: both paths, the ends of legs, and outliers, as SVG. */

import { bisectLeft, extent, ticks } from 'd3-array';
import type { Drive } from '../logs/drives.ts';
import { pathOf, type Path, type Point } from '../logs/path.ts';
import { escaped } from '../scene/svg.ts';

/** Width of a panel, its greatest height, and its margins for title and axes, in pixels. */
const [WIDTH, HEIGHT, MARGIN] = [800, 800, { top: 64, right: 24, bottom: 56, left: 64 }];

/** Shortest step of a line in pixels. */
const STEP = 0.5;

/** Distance of the paths from the axes, in pixels. */
const INSET = 12;

/** Lines in the colours of ink, prior and accent on the page. */
const LINES = { reference: 'stroke="#1f1e1b" stroke-width="1.5"', odometry: 'stroke="#0b61b0" stroke-width="1.5" stroke-dasharray="4 2"', outlier: 'stroke="#7a1560" stroke-width="5" stroke-linecap="round"' };

const [INK, MUTED] = ['#1f1e1b', '#57564f'];

/** Returns the picture, with a panel for each drive. */
export function plotOf(drives: Drive[], calibration: any): string {
  let top = 0;
  const panels = drives.map((drive) => {
    const { svg, height } = panelOf(drive, calibration);
    top += height;
    return `<g transform="translate(0 ${top - height})">${svg}</g>`;
  });
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${WIDTH} ${top}" width="${WIDTH}" height="${top}" font-family="sans-serif" font-size="13">
<rect width="100%" height="100%" fill="#fff"/>
${panels.join('\n')}
</svg>
`;
}

function panelOf({ odometry, reference }: Drive, { legs, systematicErrors }: any): { svg: string; height: number } {
  const truth = pathOf(reference.data);
  // Legs have the times of the odometry.
  const offset = systematicErrors.clockOffset.value ?? 0;
  const own = aligned(pathOf(odometry.data), truth, offset);
  const [from, to] = [odometry.data.t[0], odometry.data.t[odometry.data.t.length - 1]];
  const its = Array.from({ length: legs.count }, (_, leg) => ({ from: legs.times[2 * leg], to: legs.times[2 * leg + 1], isOutlier: legs.outliers[leg] === 1 })).filter((leg) => leg.from >= from && leg.to <= to);
  const outliers = its.filter(({ isOutlier }) => isOutlier);

  const all = [...truth.points, ...own.points];
  const [[left, right], [bottom, ceiling]] = [0, 1].map((axis) => extent(all, (point) => point[axis]) as [number, number]);
  const [spanX, spanY] = [Math.max(right - left, 0.1), Math.max(ceiling - bottom, 0.1)];
  const scale = Math.min((WIDTH - MARGIN.left - MARGIN.right - 2 * INSET) / spanX, (HEIGHT - MARGIN.top - MARGIN.bottom - 2 * INSET) / spanY);
  const height = Math.round(MARGIN.top + MARGIN.bottom + 2 * INSET + spanY * scale);
  const x = (value: number) => MARGIN.left + INSET + (value - left) * scale;
  const y = (value: number) => height - MARGIN.bottom - INSET - (value - bottom) * scale;
  const pixel = (value: number) => value.toFixed(1);
  const line = ({ points, breaks }: Pick<Path, 'points' | 'breaks'>) => {
    let d = '';
    let last: Point | undefined;
    for (const [i, point] of points.entries()) {
      const at: Point = [x(point[0]), y(point[1])];
      const isBroken = !last || breaks.has(i);
      if (!isBroken && i < points.length - 1 && last && Math.hypot(at[0] - last[0], at[1] - last[1]) < STEP) continue;
      d += `${isBroken ? 'M' : 'L'}${pixel(at[0])} ${pixel(at[1])}`;
      last = at;
    }
    return d;
  };
  const ends = its.map((leg) => pointAt(truth, leg.to + offset)).filter((point) => point !== undefined);
  const dots = ends.map((point) => `M${pixel(x(point[0]))} ${pixel(y(point[1]))}h0`).join('');
  const marked = outliers.map((leg) => {
    const [first, last] = [bisectLeft(truth.t, leg.from + offset), bisectLeft(truth.t, leg.to + offset)];
    return line({ points: truth.points.slice(first, last + 1), breaks: new Set() });
  }).join('');
  const axis = (isX: boolean) => ticks(isX ? left : bottom, isX ? right : ceiling, 6).map((value) => {
    const [at, label] = [isX ? x(value) : y(value), String(Number(value.toPrecision(6))).replace('-', '−')];
    return isX
      ? `<path d="M${pixel(at)} ${height - MARGIN.bottom}v5" stroke="${MUTED}"/><text x="${pixel(at)}" y="${height - MARGIN.bottom + 19}" text-anchor="middle">${label}</text>`
      : `<path d="M${MARGIN.left} ${pixel(at)}h-5" stroke="${MUTED}"/><text x="${MARGIN.left - 9}" y="${pixel(at + 4)}" text-anchor="end">${label}</text>`;
  }).join('');
  const key = ([['reference, with the ends of legs', 'reference'], ['odometry, aligned', 'odometry'], ...(outliers.length ? [['outliers', 'outlier'] as const] : [])] as const)
    .map(([label, name], i) => `<path d="M${MARGIN.left + 260 * i} 46h24" ${LINES[name]}/><text x="${MARGIN.left + 260 * i + 30}" y="50" fill="${INK}">${label}</text>`);
  const title = `${odometry.name} and ${reference.name}: ${its.length} legs, ${outliers.length} ${outliers.length === 1 ? 'outlier' : 'outliers'}`;
  const svg = `<title>${escaped(title)}</title>
<text x="${MARGIN.left}" y="26" font-size="16" fill="${INK}">${escaped(title)}</text>
${key.join('')}
<g fill="${MUTED}"><g fill="none" stroke="${MUTED}"><path d="M${MARGIN.left} ${MARGIN.top}V${height - MARGIN.bottom}H${WIDTH - MARGIN.right}"/></g>${axis(true)}${axis(false)}
<text x="${(MARGIN.left + WIDTH - MARGIN.right) / 2}" y="${height - 14}" text-anchor="middle">x (m)</text>
<text transform="translate(18 ${(MARGIN.top + height - MARGIN.bottom) / 2}) rotate(-90)" text-anchor="middle">y (m)</text></g>
<g fill="none" stroke-linejoin="round">
<path d="${line(own)}" ${LINES.odometry}/>
<path d="${line(truth)}" ${LINES.reference}/>
<path d="${dots}" stroke="${INK}" stroke-width="4" stroke-linecap="round"/>
<path d="${marked}" ${LINES.outlier}/>
</g>`;
  return { svg, height };
}

/** Interpolates a path; undefined outside of its times. */
function pointAt({ t, points }: Path, time: number): Point | undefined {
  const i = bisectLeft(t, time);
  if (i >= t.length || (i === 0 && t[0] !== time)) return undefined;
  if (i === 0) return points[0];
  const share = (time - t[i - 1]) / (t[i] - t[i - 1]);
  return [0, 1].map((axis) => points[i - 1][axis] + share * (points[i][axis] - points[i - 1][axis])) as Point;
}

/** Rotates and moves a path to the least squared distance from another one, whose times are later by an offset. */
function aligned(path: Path, target: Path, offset: number): Path {
  const pairs = path.points.flatMap((point, i): [Point, Point][] => {
    const other = pointAt(target, path.t[i] + offset);
    return other ? [[point, other]] : [];
  });
  if (pairs.length === 0) return path;
  const mean = (side: 0 | 1, axis: 0 | 1) => pairs.reduce((sum, pair) => sum + pair[side][axis], 0) / pairs.length;
  const [from, to] = ([0, 1] as const).map((side): Point => [mean(side, 0), mean(side, 1)]);
  let [cos, sin] = [0, 0];
  for (const [[x, y], [u, v]] of pairs) {
    cos += (x - from[0]) * (u - to[0]) + (y - from[1]) * (v - to[1]);
    sin += (x - from[0]) * (v - to[1]) - (y - from[1]) * (u - to[0]);
  }
  const angle = Math.atan2(sin, cos);
  const turned = ([x, y]: Point): Point => [
    to[0] + Math.cos(angle) * (x - from[0]) - Math.sin(angle) * (y - from[1]),
    to[1] + Math.sin(angle) * (x - from[0]) + Math.cos(angle) * (y - from[1]),
  ];
  return { ...path, points: path.points.map(turned) };
}
