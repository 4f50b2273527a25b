/** Callouts: sentences in a picture, each with a line to the point that it is about. */

import { least, pairs } from 'd3-array';
import { clamp } from '../ui/format.ts';
import { paintWithOpacity } from './canvas.ts';
import { drawLeader } from './labels.ts';
import type { Box, Brush } from './canvas.ts';

/** Pixels: minimum length of the leader (the line from a sentence to its point), line height, and margin around the text. */
const MIN_LEADER = 22;
const LINE_HEIGHT = 15;
const TEXT_MARGIN = 4;

/** Distance that a sentence keeps from lines and other sentences, pixels. */
const MIN_DISTANCE = 9;

/** Candidate positions of a sentence: angles (rad) relative to the direction away from the centre, and lengths of the leader, pixels. */
const CANDIDATE_ANGLES = Array.from({ length: 24 }, (_, i) => (Math.PI * (i - 12)) / 12);
const LEADER_LENGTHS = [MIN_LEADER, 2 * MIN_LEADER, 3 * MIN_LEADER];

/** Costs of a leader: for each radian from its preferred direction, and for each pixel of its length. An overlapping pixel costs 1. */
const TURN_COST = 1;
const LENGTH_COST = 0.1;

/** Candidate positions of a sentence around its point. */
const CANDIDATES = LEADER_LENGTHS.flatMap((length) => CANDIDATE_ANGLES.map((turn) => ({ turn, length, cost: TURN_COST * Math.abs(turn) + LENGTH_COST * length })));

/** Sentence with line breaks, the point that it is about (in the view's world), and its colour (default: that of text). */
export interface Callout {
  text: string;
  at: [number, number];
  colour?: string;
}

/**
 * Draws sentences about points on the outline of a shape with the centre `shapeCentre`. A sentence is outside of the shape, where it covers the
 * lines (x, y pairs) and other texts least. The cost of a position is continuous in all points, so that a sentence seldom jumps.
 */
export function drawCallouts({ context, view, palette, font, placedBoxes }: Brush, callouts: Callout[], { shapeCentre, lines }: { shapeCentre: [number, number], lines: Float64Array[] }) {
  context.font = font;
  const [fromX, fromY] = view.toPixel(...shapeCentre);
  const linePoints = lines.flatMap((line) => pairs(view.toPixels(line)).flatMap(([start, end]) => pointsBetween(start, end)));
  const avoidedPoints: number[][] = [...callouts.map(({ at }) => view.toPixel(...at)), ...linePoints];
  const { left, right, top, bottom } = view.frame;
  for (const { text, at, colour = palette.ink } of callouts) {
    const textLines = text.split('\n');
    const halfWidth = Math.max(...textLines.map((textLine) => context.measureText(textLine).width)) / 2 + TEXT_MARGIN;
    const halfHeight = (LINE_HEIGHT * textLines.length) / 2 + TEXT_MARGIN;
    const [x, y] = view.toPixel(...at);
    const outwardAngle = Math.atan2(y - fromY, x - fromX);
    const candidateBoxes = CANDIDATES.map(({ turn, length, cost }) => {
      const [idealX, idealY] = [x + (length + halfWidth) * Math.cos(outwardAngle + turn), y + (length + halfHeight) * Math.sin(outwardAngle + turn)];
      const box = {
        x: clamp(idealX, left + halfWidth, Math.max(left + halfWidth, right - halfWidth)),
        y: clamp(idealY, top + halfHeight, Math.max(top + halfHeight, bottom - halfHeight)),
        halfWidth, halfHeight,
      };
      return { ...box, cost: cost + maxOverlapOf(box, avoidedPoints, placedBoxes) };
    });
    const bestBox = least(candidateBoxes, ({ cost }) => cost) ?? candidateBoxes[0];
    const leaderStart = [clamp(x, bestBox.x - halfWidth, bestBox.x + halfWidth), clamp(y, bestBox.y - halfHeight, bestBox.y + halfHeight)];
    placedBoxes.push(bestBox);
    avoidedPoints.push(...pointsBetween(leaderStart, [x, y]));

    drawLeader(context, [leaderStart, [x, y]], colour);
    context.fillStyle = palette.paper;
    paintWithOpacity(context, 0.85, () => context.fillRect(bestBox.x - halfWidth, bestBox.y - halfHeight, 2 * halfWidth, 2 * halfHeight));
    Object.assign(context, { fillStyle: colour, textAlign: 'center', textBaseline: 'middle' });
    textLines.forEach((textLine, i) => context.fillText(textLine, bestBox.x, bestBox.y + (i - (textLines.length - 1) / 2) * LINE_HEIGHT));
  }
}

/** Maximum number of points between two others, because a line that leaves the picture may have any length. */
const MAX_POINTS = 200;

/** Returns points on the line between two points, beginning with the first one, that a sentence must not cover; pixels. */
function pointsBetween([x, y]: number[], [toX, toY]: number[]) {
  const pointCount = Math.min(MAX_POINTS, Math.ceil(Math.hypot(toX - x, toY - y) / (2 * MIN_DISTANCE)) || 1);
  return Array.from({ length: pointCount }, (_, i) => [x + (i / pointCount) * (toX - x), y + (i / pointCount) * (toY - y)]);
}

/** Returns the maximum depth by which points and other boxes reach into a box, pixels. The depth of boxes counts twice. */
function maxOverlapOf({ x, y, halfWidth, halfHeight }: Box, points: number[][], otherBoxes: Box[]) {
  const depthOf = (toX: number, toY: number, otherHalfWidth = 0, otherHalfHeight = 0) =>
    Math.min(halfWidth + otherHalfWidth + MIN_DISTANCE - Math.abs(toX - x), halfHeight + otherHalfHeight + MIN_DISTANCE - Math.abs(toY - y));
  let maxDepth = 0;
  for (const [toX, toY] of points) maxDepth = Math.max(maxDepth, depthOf(toX, toY));
  for (const otherBox of otherBoxes) maxDepth = Math.max(maxDepth, 2 * depthOf(otherBox.x, otherBox.y, otherBox.halfWidth, otherBox.halfHeight));
  return maxDepth;
}
