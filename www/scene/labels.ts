/** Callouts in pictures: texts about a point, each with a line to the point. A text may have a symbol with a subscript before it. */

import { sort } from 'd3-array';
import { clampNumber } from '../ui/format.ts';
import { drawDisc, paintWithOpacity, strokeLine, type TextBox, type DrawContext } from './canvas.ts';

/** Font size of a subscript relative to its text, and offset of the subscript below the baseline in pixels. */
const SUBSCRIPT_SIZE = 0.78;
const SUBSCRIPT_DROP = 3;

function measureTextParts({ canvasContext, font }: DrawContext, { symbol: mathSymbol = '', subscript: symbolSubscript = '', text: labelText = '' }: Pick<Callout, 'symbol' | 'subscript' | 'text'>) {
  const subscriptFont = font.replace(/[\d.]+px/, (sizeText) => `${SUBSCRIPT_SIZE * parseFloat(sizeText)}px`);
  const textParts = [
    { text: mathSymbol, style: `italic ${font}`, baselineDrop: 0 },
    { text: symbolSubscript, style: subscriptFont, baselineDrop: SUBSCRIPT_DROP },
    { text: mathSymbol && labelText ? ` ${labelText}` : labelText, style: font, baselineDrop: 0 },
  ].filter((textPart) => textPart.text);
  return textParts.map((textPart) => {
    canvasContext.font = textPart.style;
    return { ...textPart, width: canvasContext.measureText(textPart.text).width };
  });
}

const totalWidthOf = (textParts: { width: number }[]) => textParts.reduce((widthSum, { width }) => widthSum + width, 0);

/** Draws measured texts from left to right. x is the left end and y the middle of the line, in pixels. */
function drawTextParts({ canvasContext }: DrawContext, textParts: ReturnType<typeof measureTextParts>, x: number, y: number, textColour: string) {
  Object.assign(canvasContext, { textAlign: 'left', textBaseline: 'middle', fillStyle: textColour });
  let partLeft = x;
  for (const { text: partText, style: fontStyle, baselineDrop, width } of textParts) {
    canvasContext.font = fontStyle;
    canvasContext.fillText(partText, partLeft, y + baselineDrop);
    partLeft += width;
  }
}

/** Minimum length of a callout's leader (the line from its sentence to its point), line height, and margin around the text, pixels. */
const MIN_LEADER_LENGTH = 22;
const LINE_HEIGHT = 15;
const TEXT_MARGIN = 4;

/** Distance that a sentence keeps from lines and other sentences, pixels. */
const MIN_TEXT_DISTANCE = 9;

/** Candidate positions of a sentence: angles (rad) relative to the direction away from the shape's centre, and lengths of the leader, pixels. */
const CANDIDATE_ANGLES = Array.from({ length: 24 }, (_, i) => (Math.PI * (i - 12)) / 12);
const LEADER_LENGTHS = [MIN_LEADER_LENGTH, 2 * MIN_LEADER_LENGTH, 3 * MIN_LEADER_LENGTH];

/** Costs of a leader (callout line): for each radian from its preferred direction, and for each pixel of length. Each pixel of text overlap costs 1. */
const COST_PER_RADIAN = 1;
const COST_PER_PIXEL = 0.1;

/** Candidate positions of a callout's sentence around its point, with the costs of their leaders, the cheapest first. */
const CANDIDATE_POSITIONS = sort(
  LEADER_LENGTHS.flatMap((leaderLength) => CANDIDATE_ANGLES.map((leaderAngle) => ({ turn: leaderAngle, length: leaderLength, cost: COST_PER_RADIAN * Math.abs(leaderAngle) + COST_PER_PIXEL * leaderLength }))),
  ({ cost: positionCost }) => positionCost,
);

/** Text with line breaks about a point of the view's world. A symbol and its subscript stand before the text. The default colour is that of text. */
export interface Callout {
  symbol?: string;
  subscript?: string;
  text?: string;
  point: [number, number];
  colour?: string;
}

/**
 * Draws sentences about points on the outline of a shape with the centre `shapeCentre`. A sentence is outside of the shape, where it covers
 * the fewest lines (x, y pairs) and texts. The cost of a position is continuous in all points, so that a sentence seldom jumps.
 */
export function drawCallouts(drawContext: DrawContext, callouts: Callout[], { shapeCentre, avoidedLines }: { shapeCentre: [number, number], avoidedLines: Float64Array[] }) {
  const { canvasContext, pictureView, palette, placedBoxes } = drawContext;
  const [centreX, centreY] = pictureView.toPixel(...shapeCentre);
  const avoidedPoints = [...callouts.map(({ point: anchorPoint }): number[] => pictureView.toPixel(...anchorPoint)), ...avoidedLines.filter(({ length }) => length > 0).flatMap((avoidedLine) => sampleLine(pictureView.toPixels(avoidedLine)))];
  const { leftEdge, rightEdge, topEdge, bottomEdge } = pictureView.plotArea;
  for (const { point: anchorPoint, colour: textColour = palette.ink, text: labelText = '', ...symbolAndSubscript } of callouts) {
    const textLines = labelText.split('\n').map((textLine, i) => measureTextParts(drawContext, { text: textLine, ...(i === 0 && symbolAndSubscript) }));
    const halfWidth = Math.max(...textLines.map(totalWidthOf)) / 2 + TEXT_MARGIN;
    const halfHeight = (LINE_HEIGHT * textLines.length) / 2 + TEXT_MARGIN;
    const [x, y] = pictureView.toPixel(...anchorPoint);
    const outwardAngle = Math.atan2(y - centreY, x - centreX);
    let bestBox = { x, y, halfWidth, halfHeight, cost: Infinity };
    for (const { turn: leaderAngle, length: leaderLength, cost: positionCost } of CANDIDATE_POSITIONS) {
      // The candidates are sorted by the cost of their leader, to which overlaps only add. No later candidate can cost less than the best box.
      if (positionCost >= bestBox.cost) break;
      const [idealX, idealY] = [x + (leaderLength + halfWidth) * Math.cos(outwardAngle + leaderAngle), y + (leaderLength + halfHeight) * Math.sin(outwardAngle + leaderAngle)];
      const textBox = {
        x: clampNumber(idealX, leftEdge + halfWidth, Math.max(leftEdge + halfWidth, rightEdge - halfWidth)),
        y: clampNumber(idealY, topEdge + halfHeight, Math.max(topEdge + halfHeight, bottomEdge - halfHeight)),
        halfWidth, halfHeight,
      };
      const totalCost = positionCost + maxOverlapOf(textBox, avoidedPoints, placedBoxes);
      if (totalCost < bestBox.cost) bestBox = { ...textBox, cost: totalCost };
    }
    const leaderStart = [clampNumber(x, bestBox.x - halfWidth, bestBox.x + halfWidth), clampNumber(y, bestBox.y - halfHeight, bestBox.y + halfHeight)];
    placedBoxes.push(bestBox);
    avoidedPoints.push(...sampleLine([leaderStart, [x, y]]));

    strokeLine(canvasContext, [leaderStart, [x, y]], { colour: textColour, width: 1 });
    drawDisc(canvasContext, [x, y], 2.5, textColour);
    canvasContext.fillStyle = palette.paper;
    paintWithOpacity(canvasContext, 0.85, () => canvasContext.fillRect(bestBox.x - halfWidth, bestBox.y - halfHeight, 2 * halfWidth, 2 * halfHeight));
    textLines.forEach((textParts, i) => drawTextParts(drawContext, textParts, bestBox.x - totalWidthOf(textParts) / 2, bestBox.y + (i - (textLines.length - 1) / 2) * LINE_HEIGHT, textColour));
  }
}

/** Maximum number of points that are sampled on a chord (straight part of a line). A chord that leaves the picture may have any length. */
const MAX_CHORD_POINTS = 200;

/** Samples points of a line, in pixels. Their spacing is about twice the distance that a sentence keeps from lines. */
function sampleLine([firstPoint, ...otherPoints]: number[][]) {
  let [lastX, lastY] = firstPoint;
  const sampledPoints = [firstPoint];
  for (const [x, y] of otherPoints) {
    // If a chord is too short for a point, its length is added to that of the next chord.
    const pointCount = Math.min(MAX_CHORD_POINTS, Math.floor(Math.hypot(x - lastX, y - lastY) / (2 * MIN_TEXT_DISTANCE)));
    for (let i = 1; i <= pointCount; i++) sampledPoints.push([lastX + (i / pointCount) * (x - lastX), lastY + (i / pointCount) * (y - lastY)]);
    if (pointCount > 0) [lastX, lastY] = [x, y];
  }
  return sampledPoints;
}

/** Returns the maximum depth by which points and other boxes of texts reach into a box, pixels. The depth of boxes counts twice. */
function maxOverlapOf({ x, y, halfWidth, halfHeight }: TextBox, avoidedPoints: number[][], otherBoxes: TextBox[]) {
  const overlapDepthOf = (otherX: number, otherY: number, otherHalfWidth = 0, otherHalfHeight = 0) =>
    Math.min(halfWidth + otherHalfWidth + MIN_TEXT_DISTANCE - Math.abs(otherX - x), halfHeight + otherHalfHeight + MIN_TEXT_DISTANCE - Math.abs(otherY - y));
  let maxDepth = 0;
  for (const [pointX, pointY] of avoidedPoints) maxDepth = Math.max(maxDepth, overlapDepthOf(pointX, pointY));
  for (const otherBox of otherBoxes) maxDepth = Math.max(maxDepth, 2 * overlapDepthOf(otherBox.x, otherBox.y, otherBox.halfWidth, otherBox.halfHeight));
  return maxDepth;
}
