/** Sentences in a picture, each with a line to what it is about. */

import { clamp } from '../ui/clamp.js';
import { drawLeader } from './labels.js';

/** @import { Brush } from './canvas.js' */

/** Length of the line, distance of two lines of text, and room around them: pixels. */
const LINE = 22;
const LEADING = 15;
const ROOM = 4;

/**
 * Draws a sentence outside of something round, with a line to a point of it. Where point and middle move smoothly, so does the sentence.
 *
 * @param {Brush} brush
 * @param {object} callout
 * @param {string} callout.text with line breaks
 * @param {[number, number]} callout.at point that it is about, in the view's world
 * @param {[number, number]} callout.from middle that it keeps away from
 * @param {number} [callout.aside] turn out of the direction away from the middle, rad clockwise
 */
export function drawCallout({ context, view, palette, font }, { text, at, from, aside = 0 }) {
  const lines = text.split('\n');
  context.font = font;
  const width = Math.max(...lines.map((line) => context.measureText(line).width)) + 2 * ROOM;
  const height = LEADING * lines.length + 2 * ROOM;
  const [x, y] = [view.toPixelX(at[0]), view.toPixelY(at[1])];
  const away = Math.atan2(y - view.toPixelY(from[1]), x - view.toPixelX(from[0])) + aside;
  const [across, along] = [LINE + width / 2, LINE + height / 2];
  const { left, right, top, bottom } = view.frame;
  // Its middle is on an ellipse around the point. Where the frame stops it, it goes on along that ellipse.
  const middleX = clamp(x + across * Math.cos(away), left + width / 2, Math.max(left, right - width / 2));
  const down = along * Math.sqrt(Math.max(0, 1 - ((middleX - x) / across) ** 2));
  const middleY = clamp(y + (Math.sin(away) < 0 ? -down : down), top + height / 2, Math.max(top, bottom - height / 2));

  const begin = [clamp(x, middleX - width / 2, middleX + width / 2), clamp(y, middleY - height / 2, middleY + height / 2)];
  drawLeader(context, [begin, [x, y]], palette.ink);
  context.fillStyle = palette.paper;
  context.globalAlpha = 0.85;
  context.fillRect(middleX - width / 2, middleY - height / 2, width, height);
  context.globalAlpha = 1;
  context.fillStyle = palette.ink;
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  lines.forEach((line, i) => context.fillText(line, middleX, middleY + (i - (lines.length - 1) / 2) * LEADING));
}
