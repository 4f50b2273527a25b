/** Picture of the drives as SVG: the paths by odometry and by reference, the ends of legs, and outliers. */

import type { Drive } from '../logs/pairs.ts';
import { alignPath, pathOf, poseAt, type Pose } from '../logs/path.ts';
import { drawAxes, createLineLegendEntry } from '../scene/axes.ts';
import { drawDisc, strokePath, type DrawContext } from '../scene/canvas.ts';
import { SvgContext, escapeXml } from '../scene/svg.ts';
import { View, extentOf } from '../scene/view.ts';

/** Size of the panel of a drive, and its margin at the top, with the title and the legend, in pixels. */
const [PANEL_WIDTH, PANEL_HEIGHT, TOP_MARGIN] = [800, 700, 72];

/** Maximum number of points of a drawn path. */
const MAX_PATH_POINTS = 10_000;

/** Palette and line styles of the picture, as on a light page. */
const PALETTE = { ink: '#1f1e1b', muted: '#57564f', rule: '#c9c7bd' };
const LINE_STYLES = {
  reference: { label: 'reference, with the ends of legs', colour: PALETTE.ink, width: 1.5 },
  odometry: { label: 'odometry, aligned', colour: '#0b61b0', width: 1.5, dash: [4, 2] },
  outlier: { label: 'outliers', colour: '#7a1560', width: 5, lineCap: 'round' as const },
};

export const createDrivesSvg = (drives: Drive[], calibration: any): string => `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${PANEL_WIDTH} ${PANEL_HEIGHT * drives.length}" width="${PANEL_WIDTH}" height="${PANEL_HEIGHT * drives.length}">
<rect width="100%" height="100%" fill="#fff"/>
${drives.map((drive, i) => `<g transform="translate(0 ${PANEL_HEIGHT * i})">${createDrivePanel(drive, calibration, `drive-${i}`)}</g>`).join('\n')}
</svg>
`;

function createDrivePanel({ odometry, reference }: Drive, { legs, systematicErrors }: any, idPrefix: string): string {
  const [drivenPath, referencePath] = [odometry.data, reference.data].map((data) => pathOf(data, Math.ceil(data.t.length / MAX_PATH_POINTS)));
  // The start and end times of legs are in the clock of the odometry. The clock of the reference differs by `clockOffset`.
  const clockOffset = systematicErrors.clockOffset.value ?? 0;
  const odometryPath = alignPath(drivenPath, referencePath, clockOffset);
  const [startTime, endTime] = [odometry.data.t[0], odometry.data.t[odometry.data.t.length - 1]];
  const legsOfDrive = Array.from({ length: legs.count }, (_, leg) => ({ times: [legs.times[2 * leg], legs.times[2 * leg + 1]], isOutlier: legs.outliers[leg] === 1 })).filter(({ times: [legStart, legEnd] }) => legStart >= startTime && legEnd <= endTime);
  const outlierLegs = legsOfDrive.filter(({ isOutlier }) => isOutlier);
  const referencePoseAt = (time: number) => poseAt(referencePath, time + clockOffset);

  const view = new View({ left: 56, top: TOP_MARGIN });
  view.resize(PANEL_WIDTH, PANEL_HEIGHT);
  view.fit(extentOf([...referencePath.poses, ...odometryPath.poses].flatMap(([x, y]) => [x, y]), 0.1));
  const context = new SvgContext(idPrefix);
  const drawContext = { context, view, palette: PALETTE, font: '13px sans-serif' } as unknown as DrawContext;
  const shownLines = [LINE_STYLES.reference, LINE_STYLES.odometry, ...(outlierLegs.length ? [LINE_STYLES.outlier] : [])];
  drawAxes(drawContext, { x: 'x (m)', y: 'y (m)' }, shownLines.map(({ label, ...style }) => createLineLegendEntry(drawContext, label, style)));
  const strokePoses = (poses: Pose[], breaks: Set<number>, lineStyle: (typeof shownLines)[number]) => strokePath(drawContext.context, lineStyle, () => poses.forEach(([x, y], i) => {
    if (i === 0 || breaks.has(i)) context.moveTo(...view.toPixel(x, y));
    else context.lineTo(...view.toPixel(x, y));
  }));
  strokePoses(odometryPath.poses, odometryPath.breaks, LINE_STYLES.odometry);
  strokePoses(referencePath.poses, referencePath.breaks, LINE_STYLES.reference);
  for (const { times } of outlierLegs) strokePoses(times.map(referencePoseAt), new Set(), LINE_STYLES.outlier);
  for (const { times: [, endOfLeg] } of legsOfDrive) {
    const [x, y] = referencePoseAt(endOfLeg);
    drawDisc(drawContext.context, view.toPixel(x, y), 2, PALETTE.ink);
  }
  const title = escapeXml(`${odometry.name} and ${reference.name}: ${legsOfDrive.length} legs, ${outlierLegs.length} ${outlierLegs.length === 1 ? 'outlier' : 'outliers'}`);
  return `<title>${title}</title>\n<text x="2" y="22" style="font:16px sans-serif" fill="${PALETTE.ink}">${title}</text>\n${context.markup}`;
}
