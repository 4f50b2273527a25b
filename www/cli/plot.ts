/** Picture of the drives as SVG: the paths by odometry and by reference, the ends of legs, and outliers. */

import type { LoggedDrive } from '../logs/pairs.ts';
import { alignPath, pathOf, poseAt, type PlanarPose } from '../logs/path.ts';
import { drawAxes } from '../scene/axes.ts';
import { drawDisc, strokePath, type DrawContext } from '../scene/canvas.ts';
import { SvgContext, escapeXml } from '../scene/svg.ts';
import { PictureView, extentOf } from '../scene/view.ts';

/** Size of the panel of a drive, and its margin at the top, with the title and the legend, in pixels. */
const [PANEL_WIDTH, PANEL_HEIGHT, TOP_MARGIN] = [800, 700, 72];

/** Maximum number of points of a drawn path. */
const MAX_PATH_POINTS = 10_000;

/** Palette and line styles of the picture, as on a light page. */
const PLOT_COLOURS = { ink: '#1f1e1b', muted: '#57564f', rule: '#c9c7bd' };
const LINE_STYLES = {
  reference: { name: 'reference, with the ends of legs', colour: PLOT_COLOURS.ink, width: 1.5 },
  odometry: { name: 'odometry, aligned', colour: '#0b61b0', width: 1.5, dash: [4, 2] },
  outlier: { name: 'outliers', colour: '#7a1560', width: 5, lineCap: 'round' as const },
};

export const createDrivesSvg = (loggedDrives: LoggedDrive[], calibration: any): string => `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${PANEL_WIDTH} ${PANEL_HEIGHT * loggedDrives.length}" width="${PANEL_WIDTH}" height="${PANEL_HEIGHT * loggedDrives.length}">
<rect width="100%" height="100%" fill="#fff"/>
${loggedDrives.map((loggedDrive, i) => `<g transform="translate(0 ${PANEL_HEIGHT * i})">${createDrivePanel(loggedDrive, calibration, `drive-${i}`)}</g>`).join('\n')}
</svg>
`;

function createDrivePanel({ odometry: odometryLog, reference: referenceLog }: LoggedDrive, { legs, systematicErrors }: any, idPrefix: string): string {
  const [drivenPath, referencePath] = [odometryLog.motionData, referenceLog.motionData].map((motionData) => pathOf(motionData, Math.ceil(motionData.t.length / MAX_PATH_POINTS)));
  // The start and end times of legs are in the clock of the odometry. The clock of the reference differs by `clockOffset`.
  const clockOffset = systematicErrors.clockOffset.value ?? 0;
  const odometryPath = alignPath(drivenPath, referencePath, clockOffset);
  const [startTime, endTime] = [odometryLog.motionData.t[0], odometryLog.motionData.t[odometryLog.motionData.t.length - 1]];
  const legsOfDrive = Array.from({ length: legs.count }, (_, legIndex) => ({ times: [legs.times[2 * legIndex], legs.times[2 * legIndex + 1]], isOutlier: legs.outliers[legIndex] === 1 })).filter(({ times: [legStart, legEnd] }) => legStart >= startTime && legEnd <= endTime);
  const outlierLegs = legsOfDrive.filter(({ isOutlier }) => isOutlier);
  const referencePoseAt = (odometryTime: number) => poseAt(referencePath, odometryTime + clockOffset);

  const plotView = new PictureView({ leftMargin: 56, topMargin: TOP_MARGIN });
  plotView.setSize(PANEL_WIDTH, PANEL_HEIGHT);
  plotView.fitExtent(extentOf([...referencePath.poses, ...odometryPath.poses].flatMap(([x, y]) => [x, y]), 0.1));
  const svgContext = new SvgContext(idPrefix);
  const drawContext = { canvasContext: svgContext, pictureView: plotView, palette: PLOT_COLOURS, font: '13px sans-serif' } as unknown as DrawContext;
  const shownLines = [LINE_STYLES.reference, LINE_STYLES.odometry, ...(outlierLegs.length ? [LINE_STYLES.outlier] : [])];
  drawAxes(drawContext, { x: 'x (m)', y: 'y (m)' }, shownLines);
  const strokePoses = (poses: PlanarPose[], breakIndices: Set<number>, lineStyle: (typeof shownLines)[number]) => strokePath(drawContext.canvasContext, lineStyle, () => poses.forEach(([x, y], i) => {
    if (i === 0 || breakIndices.has(i)) svgContext.moveTo(...plotView.toPixel(x, y));
    else svgContext.lineTo(...plotView.toPixel(x, y));
  }));
  strokePoses(odometryPath.poses, odometryPath.breakIndices, LINE_STYLES.odometry);
  strokePoses(referencePath.poses, referencePath.breakIndices, LINE_STYLES.reference);
  for (const { times: legTimes } of outlierLegs) strokePoses(legTimes.map(referencePoseAt), new Set(), LINE_STYLES.outlier);
  for (const { times: [, endOfLeg] } of legsOfDrive) {
    const [x, y] = referencePoseAt(endOfLeg);
    drawDisc(drawContext.canvasContext, plotView.toPixel(x, y), 2, PLOT_COLOURS.ink);
  }
  const plotTitle = escapeXml(`${odometryLog.logName} and ${referenceLog.logName}: ${legsOfDrive.length} legs, ${outlierLegs.length} ${outlierLegs.length === 1 ? 'outlier' : 'outliers'}`);
  return `<title>${plotTitle}</title>\n<text x="2" y="22" style="font:16px sans-serif" fill="${PLOT_COLOURS.ink}">${plotTitle}</text>\n${svgContext.svgMarkup}`;
}
