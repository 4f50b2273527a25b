/** Callouts in pictures: texts about a point, each with a line to the point. A text may have a symbol with a subscript before it. */

import { sort } from 'd3-array';
import { clamp } from '../ui/format.ts';
import { drawDisc, paintWithOpacity, strokeLine, type TextBox, type DrawContext } from './canvas.ts';

/** Font size of a subscript relative to its text, and offset of the subscript below the baseline in pixels. */
const SUBSCRIPT_SIZE = 0.78;
const SUBSCRIPT_DROP = 3;

function measureTextParts({ context, font }: DrawContext, { symbol = '', subscript = '', text = '' }: Pick<Callout, 'symbol' | 'subscript' | 'text'>) {
  const subscriptFont = font.replace(/[\d.]+px/, (sizeText) => `${SUBSCRIPT_SIZE * parseFloat(sizeText)}px`);
  const textParts = [
    { text: symbol, style: `italic ${font}`, baselineDrop: 0 },
    { text: subscript, style: subscriptFont, baselineDrop: SUBSCRIPT_DROP },
    { text: symbol && text ? ` ${text}` : text, style: font, baselineDrop: 0 },
  ].filter((textPart) => textPart.text);
  return textParts.map((textPart) => {
    context.font = textPart.style;
    return { ...textPart, width: context.measureText(textPart.text).width };
  });
}

const totalWidthOf = (textParts: { width: number }[]) => textParts.reduce((sum, { width }) => sum + width, 0);

/** Draws measured texts from left to right. x is the left end and y the middle of the line, in pixels. */
function drawTextParts({ context }: DrawContext, textParts: ReturnType<typeof measureTextParts>, x: number, y: number, colour: string) {
  Object.assign(context, { textAlign: 'left', textBaseline: 'middle', fillStyle: colour });
  let partLeft = x;
  for (const { text, style, baselineDrop, width } of textParts) {
    context.font = style;
    context.fillText(text, partLeft, y + baselineDrop);
    partLeft += width;
  }
}

/** Minimum length of a callout's leader (the line from its sentence to its point), line height, and margin around the text, pixels. */
const MIN_LEADER_LENGTH = 22;
const LINE_HEIGHT = 15;
const TEXT_MARGIN = 4;

/** Distance that a sentence keeps from lines and other sentences, pixels. */
const MIN_TEXT_DISTANCE = 9;

/** Candidate positions of a sentence: angles (rad) relative to the direction away from the centre, and lengths of the leader, pixels. */
const CANDIDATE_ANGLES = Array.from({ length: 24 }, (_, i) => (Math.PI * (i - 12)) / 12);
const LEADER_LENGTHS = [MIN_LEADER_LENGTH, 2 * MIN_LEADER_LENGTH, 3 * MIN_LEADER_LENGTH];

/** Costs of a leader (callout line): for each radian from its preferred direction, and for each pixel of length. Each pixel of text overlap costs 1. */
const COST_PER_RADIAN = 1;
const COST_PER_PIXEL = 0.1;

/** Candidate positions of a callout's sentence around its point, with the costs of their leaders, the cheapest first. */
const CANDIDATE_POSITIONS = sort(
  LEADER_LENGTHS.flatMap((length) => CANDIDATE_ANGLES.map((turn) => ({ turn, length, cost: COST_PER_RADIAN * Math.abs(turn) + COST_PER_PIXEL * length }))),
  ({ cost }) => cost,
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
export function drawCallouts(drawContext: DrawContext, callouts: Callout[], { shapeCentre, lines }: { shapeCentre: [number, number], lines: Float64Array[] }) {
  const { context, view, palette, placedBoxes } = drawContext;
  const [centreX, centreY] = view.toPixel(...shapeCentre);
  const avoidedPoints = [...callouts.map(({ point }): number[] => view.toPixel(...point)), ...lines.filter(({ length }) => length > 0).flatMap((avoidedLine) => sampleLine(view.toPixels(avoidedLine)))];
  const { left, right, top, bottom } = view.plotArea;
  for (const { point, colour = palette.ink, text = '', ...symbolAndSubscript } of callouts) {
    const textLines = text.split('\n').map((textLine, i) => measureTextParts(drawContext, { text: textLine, ...(i === 0 && symbolAndSubscript) }));
    const halfWidth = Math.max(...textLines.map(totalWidthOf)) / 2 + TEXT_MARGIN;
    const halfHeight = (LINE_HEIGHT * textLines.length) / 2 + TEXT_MARGIN;
    const [x, y] = view.toPixel(...point);
    const outwardAngle = Math.atan2(y - centreY, x - centreX);
    let bestBox = { x, y, halfWidth, halfHeight, cost: Infinity };
    for (const { turn, length, cost } of CANDIDATE_POSITIONS) {
      // The candidates are sorted by the cost of their leader, to which overlaps only add. No later candidate can cost less than the best box.
      if (cost >= bestBox.cost) break;
      const [idealX, idealY] = [x + (length + halfWidth) * Math.cos(outwardAngle + turn), y + (length + halfHeight) * Math.sin(outwardAngle + turn)];
      const textBox = {
        x: clamp(idealX, left + halfWidth, Math.max(left + halfWidth, right - halfWidth)),
        y: clamp(idealY, top + halfHeight, Math.max(top + halfHeight, bottom - halfHeight)),
        halfWidth, halfHeight,
      };
      const totalCost = cost + maxOverlapOf(textBox, avoidedPoints, placedBoxes);
      if (totalCost < bestBox.cost) bestBox = { ...textBox, cost: totalCost };
    }
    const leaderStart = [clamp(x, bestBox.x - halfWidth, bestBox.x + halfWidth), clamp(y, bestBox.y - halfHeight, bestBox.y + halfHeight)];
    placedBoxes.push(bestBox);
    avoidedPoints.push(...sampleLine([leaderStart, [x, y]]));

    strokeLine(context, [leaderStart, [x, y]], { colour, width: 1 });
    drawDisc(context, [x, y], 2.5, colour);
    context.fillStyle = palette.paper;
    paintWithOpacity(context, 0.85, () => context.fillRect(bestBox.x - halfWidth, bestBox.y - halfHeight, 2 * halfWidth, 2 * halfHeight));
    textLines.forEach((textParts, i) => drawTextParts(drawContext, textParts, bestBox.x - totalWidthOf(textParts) / 2, bestBox.y + (i - (textLines.length - 1) / 2) * LINE_HEIGHT, colour));
  }
}

/** Maximum number of points that are sampled on a chord, because a line that leaves the picture may have any length. */
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
function maxOverlapOf({ x, y, halfWidth, halfHeight }: TextBox, points: number[][], otherBoxes: TextBox[]) {
  const overlapDepthOf = (otherX: number, otherY: number, otherHalfWidth = 0, otherHalfHeight = 0) =>
    Math.min(halfWidth + otherHalfWidth + MIN_TEXT_DISTANCE - Math.abs(otherX - x), halfHeight + otherHalfHeight + MIN_TEXT_DISTANCE - Math.abs(otherY - y));
  let maxDepth = 0;
  for (const [pointX, pointY] of points) maxDepth = Math.max(maxDepth, overlapDepthOf(pointX, pointY));
  for (const otherBox of otherBoxes) maxDepth = Math.max(maxDepth, 2 * overlapDepthOf(otherBox.x, otherBox.y, otherBox.halfWidth, otherBox.halfHeight));
  return maxDepth;
}
