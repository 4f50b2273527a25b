/** Grid lines of equal length and of equal turn, which are bent on the floor and straight in exponential coordinates. */

import { ticks } from 'd3-array';
import { placeOf } from './morph.ts';
import { addLine, stroke, type Brush } from '../../scene/canvas.ts';
import type { View } from '../../scene/view.ts';

/** Approximate number of lines of either kind, and number of chords of a line. */
const GRID_LINES = 7;
const CHORDS_PER_LINE = 32;

/** Draws the grid of exponential coordinates at a morph. `end` is the view at the end of the morph. */
export function drawLattice({ context, view, palette }: Brush, { extent: { xMin, xMax, yMin, yMax } }: View, morph: number) {
  // It becomes visible early in the morph, and ends as the straight grid of the axes.
  context.globalAlpha = 0.7 * Math.min(1, 5 * morph);
  const line = (at: (share: number) => [along: number, heading: number]) => addLine(context, Array.from({ length: CHORDS_PER_LINE + 1 }, (_, i) => {
    const [along, heading] = at(i / CHORDS_PER_LINE);
    return view.toPixel(...placeOf([along, 0, heading], morph));
  }));
  stroke(context, { colour: palette.rule, width: 1 }, () => {
    for (const along of ticks(xMin, xMax, GRID_LINES)) line((share) => [along, yMin + share * (yMax - yMin)]);
    for (const heading of ticks(yMin, yMax, GRID_LINES)) line((share) => [xMin + share * (xMax - xMin), heading]);
  });
  context.globalAlpha = 1;
}
