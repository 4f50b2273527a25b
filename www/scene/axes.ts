/** Axes of a picture with ticks, names and a key, and clipping to the plot area. */

import { ticks } from 'd3-array';
import { powerOfTen, tick } from '../ui/format.ts';
import { faded, strokeLine, type Brush, type LineStroke } from './canvas.ts';

/** Distance of ticks below which the axis has a power of ten before its unit. The zeros of the labels would not fit next to the axis. */
const NEAREST_TICKS = 9e-4;

/** Minimum distances between two ticks, CSS pixels. */
const TICK_SPACING = { x: 60, y: 48 };

/** Gap between entries of a key, width of a line sample, and line height, relative to the font size. */
const KEY = { gap: 0.8, sample: 1.5, space: 0.35, line: 1.4 };

/**
 * Draws axes with ticks at the left and the bottom, and a faint grid. Above are the name of the vertical axis and a key. Names have units in
 * brackets. Entries of the key are in the order of their importance: the last ones are omitted if there is no space.
 */
export function drawAxes(brush: Brush, names: { x: string, y: string }, key: KeyEntry[], grid: number = 0.5) {
  const { context, view, palette, font } = brush;
  const { left, right, top, bottom } = view.frame;
  const { xMin, xMax, yMin, yMax } = view.extent;
  const rule = (opacity: number, ...line: number[][]) => faded(context, opacity, () => strokeLine(context, line, { colour: palette.rule, width: 1 }));

  const xTicks = ticksOf(xMin, xMax, (right - left) / TICK_SPACING.x);
  Object.assign(context, { font, fillStyle: palette.muted, textAlign: 'center', textBaseline: 'top' });
  // The name of the axis takes the place of the last tick label.
  const xName = names.x.replace('(', `(${xTicks.unit}`);
  const free = right - context.measureText(xName).width - 10;
  for (const value of xTicks.values) {
    const x = Math.round(view.toPixelX(value)) + 0.5;
    rule(grid, [x, top], [x, bottom]);
    const text = xTicks.text(value);
    if (x + context.measureText(text).width / 2 < free) context.fillText(text, x, bottom + 6);
  }
  const yTicks = ticksOf(yMin, yMax, (bottom - top) / TICK_SPACING.y);
  Object.assign(context, { textAlign: 'right', textBaseline: 'middle' });
  for (const value of yTicks.values) {
    const y = Math.round(view.toPixelY(value)) + 0.5;
    rule(grid, [left, y], [right, y]);
    context.fillText(yTicks.text(value), left - 6, y);
  }

  rule(1, [left, bottom + 0.5], [right, bottom + 0.5]);
  rule(1, [left - 0.5, top], [left - 0.5, bottom]);
  Object.assign(context, { font: `italic ${font}`, textBaseline: 'top' });
  context.fillText(xName, right, bottom + 6);
  context.textAlign = 'left';
  drawKey(brush, names.y.replace('(', `(${yTicks.unit}`), key);
}

export interface KeyEntry {
  name: string;
  /** Draws a line sample, from left to right in the middle of the text line; CSS pixels. */
  draw: (x: number, y: number, width: number) => void;
}

/** Returns an entry of a key with a sample of a line. */
export const lineKey = ({ context }: Brush, name: string, style: LineStroke): KeyEntry => ({ name, draw: (x, y, width) => strokeLine(context, [[x, y], [x + width, y]], style) });

/** Draws a key after the name of an axis. */
function drawKey({ context, view, palette, font }: Brush, before: string, entries: KeyEntry[]) {
  const size = parseFloat(font);
  const [width, line] = [KEY.sample * size, KEY.line * size];
  let y = view.frame.top - 22;
  const [begin, last] = [2 + context.measureText(before).width, Math.floor(y / line)];
  context.font = font;
  let [x, row] = [begin, 0];
  const placed = [];
  for (const entry of entries) {
    const length = (KEY.gap + KEY.space) * size + width + context.measureText(entry.name).width;
    // The first entry of a line has no gap before it.
    if (x + length > view.width && row < last) [x, row] = [2 - KEY.gap * size, row + 1];
    if (x + length > view.width) break;
    placed.push({ ...entry, from: x + KEY.gap * size, row });
    x += length;
  }
  // The last line is nearest to the picture.
  y -= row * line;
  context.font = `italic ${font}`;
  context.fillText(before, 2, y);
  context.font = font;
  for (const { name, draw, from, row } of placed) {
    context.fillStyle = palette.ink;
    context.fillText(name, from + width + KEY.space * size, y + row * line);
    draw(from, y + row * line + size / 2, width);
  }
}

/** Returns about `count` ticks and at least two if possible, with the factor of the unit and the labels. */
function ticksOf(from: number, to: number, count: number) {
  const most = Math.max(2, Math.floor(count));
  const few = ticks(from, to, most);
  const values = few.length > 1 ? few : ticks(from, to, 2 * most);
  const step = values.length > 1 ? values[1] - values[0] : 1;
  const exponent = step < NEAREST_TICKS ? Math.floor(Math.log10(step) + 1e-9) : 0;
  return {
    values,
    /** Factor before the unit of the axis. */
    unit: exponent < 0 ? `${powerOfTen(exponent)} ` : '',
    text: (value: number) => tick(value / 10 ** exponent, step / 10 ** exponent),
  };
}

/** Clips what `paint` draws to the plot area. */
export function clipped({ context, view }: Brush, paint: () => void) {
  const { left, right, top, bottom } = view.frame;
  context.save();
  context.beginPath();
  context.rect(left, top, right - left, bottom - top);
  context.clip();
  paint();
  context.restore();
}
