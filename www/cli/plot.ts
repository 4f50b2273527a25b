/** Picture of the drives: both paths, the ends of legs, and outliers, as SVG. */

import { bisectLeft, extent, ticks } from 'd3-array';
import type { Drive } from '../logs/pairs.ts';
import { alignedPath, pathOf, poseAt, svgPathData, type Path } from '../logs/path.ts';
import { escapeXml } from '../scene/svg.ts';

/** Width, maximum height and margins of a panel, in pixels. Title and axes are in the margins. */
const [WIDTH, HEIGHT, MARGIN] = [800, 800, { top: 64, right: 24, bottom: 56, left: 64 }];

/** Maximum number of points of a path. */
const MAX_POINTS = 10_000;

const INSET_PX = 12;

/** Attributes of the lines, in the colours of the page. */
const LINE_STYLES = { reference: 'stroke="#1f1e1b" stroke-width="1.5"', odometry: 'stroke="#0b61b0" stroke-width="1.5" stroke-dasharray="4 2"', outlier: 'stroke="#7a1560" stroke-width="5" stroke-linecap="round"' };

const [INK, MUTED] = ['#1f1e1b', '#57564f'];

export function drivesSvg(drives: Drive[], calibration: any): string {
  let nextPanelTop = 0;
  const panelSvgs = drives.map((drive) => {
    const { svg, height } = drivePanel(drive, calibration);
    nextPanelTop += height;
    return `<g transform="translate(0 ${nextPanelTop - height})">${svg}</g>`;
  });
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${WIDTH} ${nextPanelTop}" width="${WIDTH}" height="${nextPanelTop}" font-family="sans-serif" font-size="13">
<rect width="100%" height="100%" fill="#fff"/>
${panelSvgs.join('\n')}
</svg>
`;
}

function drivePanel({ odometry, reference }: Drive, { legs, systematicErrors }: any): { svg: string; height: number } {
  const [drivenPath, referencePath] = [odometry.data, reference.data].map((data) => pathOf(data, Math.ceil(data.t.length / MAX_POINTS)));
  // The times of legs are those of the odometry's clock.
  const clockOffset = systematicErrors.clockOffset.value ?? 0;
  const odometryPath = alignedPath(drivenPath, referencePath, clockOffset);
  const [startTime, endTime] = [odometry.data.t[0], odometry.data.t[odometry.data.t.length - 1]];
  const legsOfDrive = Array.from({ length: legs.count }, (_, leg) => ({ from: legs.times[2 * leg], to: legs.times[2 * leg + 1], isOutlier: legs.outliers[leg] === 1 })).filter((leg) => leg.from >= startTime && leg.to <= endTime);
  const outlierLegs = legsOfDrive.filter(({ isOutlier }) => isOutlier);

  const allPoses = [...referencePath.poses, ...odometryPath.poses];
  const [[left, right], [bottom, top]] = [0, 1].map((axis) => extent(allPoses, (pose) => pose[axis]) as [number, number]);
  const [spanX, spanY] = [Math.max(right - left, 0.1), Math.max(top - bottom, 0.1)];
  const pixelsPerMetre = Math.min((WIDTH - MARGIN.left - MARGIN.right - 2 * INSET_PX) / spanX, (HEIGHT - MARGIN.top - MARGIN.bottom - 2 * INSET_PX) / spanY);
  const height = Math.round(MARGIN.top + MARGIN.bottom + 2 * INSET_PX + spanY * pixelsPerMetre);
  const xPixel = (value: number) => MARGIN.left + INSET_PX + (value - left) * pixelsPerMetre;
  const yPixel = (value: number) => height - MARGIN.bottom - INSET_PX - (value - bottom) * pixelsPerMetre;
  const pixelText = (value: number) => value.toFixed(1);
  const pathData = (path: Path) => svgPathData(path, ([x, y]) => [xPixel(x), yPixel(y)]);
  const legEndDots = legsOfDrive.map((leg) => poseAt(referencePath, leg.to + clockOffset)).map((pose) => `M${pixelText(xPixel(pose[0]))} ${pixelText(yPixel(pose[1]))}h0`).join('');
  const outlierPaths = outlierLegs.map((leg) => {
    const [firstIndex, lastIndex] = [bisectLeft(referencePath.t, leg.from + clockOffset), bisectLeft(referencePath.t, leg.to + clockOffset)];
    return pathData({ t: [], poses: referencePath.poses.slice(firstIndex, lastIndex + 1), breaks: new Set() });
  }).join('');
  const axisSvg = (isX: boolean) => ticks(isX ? left : bottom, isX ? right : top, 6).map((value) => {
    const [tickPixel, label] = [isX ? xPixel(value) : yPixel(value), String(Number(value.toPrecision(6))).replace('-', '−')];
    return isX
      ? `<path d="M${pixelText(tickPixel)} ${height - MARGIN.bottom}v5" stroke="${MUTED}"/><text x="${pixelText(tickPixel)}" y="${height - MARGIN.bottom + 19}" text-anchor="middle">${label}</text>`
      : `<path d="M${MARGIN.left} ${pixelText(tickPixel)}h-5" stroke="${MUTED}"/><text x="${MARGIN.left - 9}" y="${pixelText(tickPixel + 4)}" text-anchor="end">${label}</text>`;
  }).join('');
  const legendEntries = ([['reference, with the ends of legs', 'reference'], ['odometry, aligned', 'odometry'], ...(outlierLegs.length ? [['outliers', 'outlier'] as const] : [])] as const)
    .map(([label, name], i) => `<path d="M${MARGIN.left + 260 * i} 46h24" ${LINE_STYLES[name]}/><text x="${MARGIN.left + 260 * i + 30}" y="50" fill="${INK}">${label}</text>`);
  const panelTitle = `${odometry.name} and ${reference.name}: ${legsOfDrive.length} legs, ${outlierLegs.length} ${outlierLegs.length === 1 ? 'outlier' : 'outliers'}`;
  const svg = `<title>${escapeXml(panelTitle)}</title>
<text x="${MARGIN.left}" y="26" font-size="16" fill="${INK}">${escapeXml(panelTitle)}</text>
${legendEntries.join('')}
<g fill="${MUTED}"><g fill="none" stroke="${MUTED}"><path d="M${MARGIN.left} ${MARGIN.top}V${height - MARGIN.bottom}H${WIDTH - MARGIN.right}"/></g>${axisSvg(true)}${axisSvg(false)}
<text x="${(MARGIN.left + WIDTH - MARGIN.right) / 2}" y="${height - 14}" text-anchor="middle">x (m)</text>
<text transform="translate(18 ${(MARGIN.top + height - MARGIN.bottom) / 2}) rotate(-90)" text-anchor="middle">y (m)</text></g>
<g fill="none" stroke-linejoin="round">
<path d="${pathData(odometryPath)}" ${LINE_STYLES.odometry}/>
<path d="${pathData(referencePath)}" ${LINE_STYLES.reference}/>
<path d="${legEndDots}" stroke="${INK}" stroke-width="4" stroke-linecap="round"/>
<path d="${outlierPaths}" ${LINE_STYLES.outlier}/>
</g>`;
  return { svg, height };
}
