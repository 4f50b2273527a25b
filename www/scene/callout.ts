/** Callouts: sentences in a picture, each with a line to the point that it is about. */

import { clamp } from '../ui/clamp.ts';
import { faded } from './canvas.ts';
import { drawLeader } from './labels.ts';
import type { Box, Brush } from './canvas.ts';

/** Minimum length of the leader, line height, and margin around the text: pixels. */
const LINE = 22;
const LEADING = 15;
const ROOM = 4;

/** Distance that a sentence keeps from lines and other sentences, pixels. */
const CLEAR = 9;

/** Candidate positions of a sentence: angles (rad) relative to the direction away from the centre, and lengths of the leader, pixels. */
const TURNS = Array.from({ length: 24 }, (_, i) => (Math.PI * (i - 12)) / 12);
const LENGTHS = [LINE, 2 * LINE, 3 * LINE];

/** Costs of an angle of 1 rad and of the length of a leader, in the unit of overlap, pixels. */
const TURN_COST = 1;
const LENGTH_COST = 0.1;

/** Places of a sentence about its point, the cheapest first. */
const PLACES = LENGTHS.flatMap((length) => TURNS.map((turn) => ({ turn, length, cost: TURN_COST * Math.abs(turn) + LENGTH_COST * length })))
  .sort((one, other) => one.cost - other.cost);

/** Sentence with line breaks, the point that it is about, in the view's world, and its colour if it is not that of ink. */
export interface Callout {
  text: string;
  at: [number, number];
  colour?: string;
}

/**
 * Draws sentences about points on the outline of a shape, whose centre is `from`. They are outside of the shape, where they cover least of
 * the lines (x, y pairs) and other texts. The cost of a position is a continuous function of all points, so that a sentence seldom jumps.
 */
export function drawCallouts({ context, view, palette, font, placed }: Brush, callouts: Callout[], { from, lines }: { from: [number, number], lines: Float64Array[] }) {
  context.font = font;
  const pixels = ({ 0: x, 1: y }: ArrayLike<number>) => [view.toPixelX(x), view.toPixelY(y)];
  const [fromX, fromY] = pixels(from);
  const kept = callouts.map(({ at }) => pixels(at));
  for (const line of lines) {
    for (let i = 0; i + 3 < line.length; i += 2) kept.push(...pointsBetween(pixels(line.subarray(i)), pixels(line.subarray(i + 2))));
  }
  const { left, right, top, bottom } = view.frame;
  for (const { text, at, colour = palette.ink } of callouts) {
    const rows = text.split('\n');
    const across = Math.max(...rows.map((row) => context.measureText(row).width)) / 2 + ROOM;
    const down = (LEADING * rows.length) / 2 + ROOM;
    const [x, y] = pixels(at);
    const away = Math.atan2(y - fromY, x - fromX);
    let [place, least]: [Box, number] = [{ x, y, across, down }, Infinity];
    for (const { turn, length, cost } of PLACES) {
      if (cost >= least) break;
      const [wantedX, wantedY] = [x + (length + across) * Math.cos(away + turn), y + (length + down) * Math.sin(away + turn)];
      const box = {
        x: clamp(wantedX, left + across, Math.max(left + across, right - across)),
        y: clamp(wantedY, top + down, Math.max(top + down, bottom - down)),
        across, down,
      };
      const sum = cost + coveredBy(box, kept, placed);
      if (sum < least) [place, least] = [box, sum];
    }
    const begin = [clamp(x, place.x - across, place.x + across), clamp(y, place.y - down, place.y + down)];
    placed.push(place);
    kept.push(...pointsBetween(begin, [x, y]));

    drawLeader(context, [begin, [x, y]], colour);
    context.fillStyle = palette.paper;
    faded(context, 0.85, () => context.fillRect(place.x - across, place.y - down, 2 * across, 2 * down));
    Object.assign(context, { fillStyle: colour, textAlign: 'center', textBaseline: 'middle' });
    rows.forEach((row, i) => context.fillText(row, place.x, place.y + (i - (rows.length - 1) / 2) * LEADING));
  }
}

/** Maximum number of points between two others, because a line that leaves the picture may have any length. */
const MOST_POINTS = 200;

/** Returns the first of two points, and points between them that a sentence must not cover, pixels. */
function pointsBetween([x, y]: number[], [toX, toY]: number[]) {
  const count = Math.min(MOST_POINTS, Math.ceil(Math.hypot(toX - x, toY - y) / (2 * CLEAR)) || 1);
  return Array.from({ length: count }, (_, i) => [x + (i / count) * (toX - x), y + (i / count) * (toY - y)]);
}

/** Returns the largest depth of points and other boxes inside a box, pixels. That of boxes counts twice. */
function coveredBy({ x, y, across, down }: Box, points: number[][], others: Box[]) {
  const depth = (toX: number, toY: number, roomX = 0, roomY = 0) =>
    Math.min(across + roomX + CLEAR - Math.abs(toX - x), down + roomY + CLEAR - Math.abs(toY - y));
  let deepest = 0;
  for (const [toX, toY] of points) deepest = Math.max(deepest, depth(toX, toY));
  for (const other of others) deepest = Math.max(deepest, 2 * depth(other.x, other.y, other.across, other.down));
  return deepest;
}
