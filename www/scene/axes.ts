/** Axes of a picture with ticks, names and a legend, and clipping to the plot area. */

import { ticksOfAxis } from '../ui/format.ts';
import { addCross, drawDisc, fillPath, paintWithOpacity, strokeLine, strokePath, type DrawContext, type LineStroke } from './canvas.ts';
import type { LineStyle } from '../ui/theme.ts';

/** Minimum distance between two ticks of an axis, CSS pixels. */
const MIN_TICK_SPACING = { x: 60, y: 48 };

/** Lengths in a legend, relative to the font size: gap between entries, width of a line sample, and gap between the sample and its name. */
const LEGEND_LENGTHS_EM = { entryGap: 0.8, lineSampleWidth: 1.5, nameGap: 0.35 };

/**
 * Draws axes with ticks at the left and the bottom, and a faint grid. Above are the name of the vertical axis and a legend. Names have units in
 * brackets. Entries of the legend are in the order of their importance: the last ones are omitted if there is no space.
 */
export function drawAxes(drawContext: DrawContext, axisNames: { x: string, y: string }, legendEntries: LegendEntry[] = [], gridOpacity: number = 0.5) {
  const { canvasContext, pictureView, palette, font } = drawContext;
  const { leftEdge, rightEdge, topEdge, bottomEdge } = pictureView.plotArea;
  const { xMin, xMax, yMin, yMax } = pictureView.shownExtent;
  const drawHairline = (opacity: number, ...pixelPoints: number[][]) => paintWithOpacity(canvasContext, opacity, () => strokeLine(canvasContext, pixelPoints, { colour: palette.rule, width: 1 }));

  const xTicks = ticksOfAxis(axisNames.x, xMin, xMax, (rightEdge - leftEdge) / MIN_TICK_SPACING.x);
  Object.assign(canvasContext, { font, fillStyle: palette.muted, textAlign: 'center', textBaseline: 'top' });
  // The name of the x axis is at its right end, where it replaces tick labels.
  const maxLabelX = rightEdge - canvasContext.measureText(xTicks.axisName).width - 10;
  for (const tickValue of xTicks.tickValues) {
    const x = Math.round(pictureView.toPixelX(tickValue)) + 0.5;
    drawHairline(gridOpacity, [x, topEdge], [x, bottomEdge]);
    const tickLabel = xTicks.formatLabel(tickValue);
    if (x + canvasContext.measureText(tickLabel).width / 2 < maxLabelX) canvasContext.fillText(tickLabel, x, bottomEdge + 6);
  }
  const yTicks = ticksOfAxis(axisNames.y, yMin, yMax, (bottomEdge - topEdge) / MIN_TICK_SPACING.y);
  Object.assign(canvasContext, { textAlign: 'right', textBaseline: 'middle' });
  for (const tickValue of yTicks.tickValues) {
    const y = Math.round(pictureView.toPixelY(tickValue)) + 0.5;
    drawHairline(gridOpacity, [leftEdge, y], [rightEdge, y]);
    canvasContext.fillText(yTicks.formatLabel(tickValue), leftEdge - 6, y);
  }

  drawHairline(1, [leftEdge, bottomEdge + 0.5], [rightEdge, bottomEdge + 0.5]);
  drawHairline(1, [leftEdge - 0.5, topEdge], [leftEdge - 0.5, bottomEdge]);
  Object.assign(canvasContext, { font: `italic ${font}`, textBaseline: 'top' });
  canvasContext.fillText(xTicks.axisName, rightEdge, bottomEdge + 6);
  canvasContext.textAlign = 'left';
  drawLegend(drawContext, yTicks.axisName, legendEntries);
}

/** Line or mark with its name in a legend. */
export type LegendEntry = LineStroke & Pick<LineStyle, 'shape'> & { name: string };

function drawLegend(drawContext: DrawContext, axisName: string, legendEntries: LegendEntry[]) {
  const { canvasContext, pictureView, palette, font } = drawContext;
  const fontSize = parseFloat(font);
  const y = pictureView.plotArea.topEdge - 22;
  canvasContext.fillText(axisName, 2, y);
  let entryEnd = 2 + canvasContext.measureText(axisName).width;
  Object.assign(canvasContext, { font, fillStyle: palette.ink });
  for (const { name: legendLabel, ...lineStyle } of legendEntries) {
    const lineSampleX = entryEnd + LEGEND_LENGTHS_EM.entryGap * fontSize;
    const nameX = lineSampleX + (LEGEND_LENGTHS_EM.lineSampleWidth + LEGEND_LENGTHS_EM.nameGap) * fontSize;
    entryEnd = nameX + canvasContext.measureText(legendLabel).width;
    if (entryEnd > pictureView.width) break;
    canvasContext.fillText(legendLabel, nameX, y);
    drawSwatch(drawContext, lineStyle, [lineSampleX, y + fontSize / 2], LEGEND_LENGTHS_EM.lineSampleWidth * fontSize);
  }
}

/** Draws the symbol of a legend entry, as `swatchHtml` does on the page. The point is its left end, in pixels. */
function drawSwatch({ canvasContext }: DrawContext, { shape: swatchShape, ...lineStyle }: Omit<LegendEntry, 'name'>, [x, y]: [x: number, y: number], width: number) {
  const [middleX, { colour: swatchColour }] = [x + width / 2, lineStyle];
  if (swatchShape === 'area') fillPath(canvasContext, swatchColour, () => canvasContext.rect(middleX - 5.5, y - 5.5, 11, 11));
  else if (swatchShape === 'cross') strokePath(canvasContext, { colour: swatchColour, width: 1 }, () => addCross(canvasContext, middleX, y));
  else if (swatchShape === 'dot' || swatchShape === 'ring') drawDisc(canvasContext, [middleX, y], 3, swatchShape === 'dot' ? swatchColour : undefined, { colour: swatchColour, width: 1 });
  else strokeLine(canvasContext, [[x, y], [x + width, y]], lineStyle);
}

/** Clips what `paintContents` draws to the plot area. */
export function clipToPlot({ canvasContext, pictureView }: DrawContext, paintContents: () => void) {
  const { leftEdge, rightEdge, topEdge, bottomEdge } = pictureView.plotArea;
  canvasContext.save();
  canvasContext.beginPath();
  canvasContext.rect(leftEdge, topEdge, rightEdge - leftEdge, bottomEdge - topEdge);
  canvasContext.clip();
  paintContents();
  canvasContext.restore();
}
