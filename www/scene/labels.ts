/** Labels in pictures: a symbol with its subscript, and a text. */

import { clamp } from '../ui/clamp.ts';
import { drawDisc, faded, strokeLine, type Brush } from './canvas.ts';

/** Font size of a subscript relative to the text, and its offset below the baseline, pixels. */
const SUBSCRIPT = 0.78;
const DROP = 3;

/** Half the height of a label's background, pixels, and its opacity. */
const GROUND = { half: 9, alpha: 0.9 };

/** Candidate positions of a label: offsets in heights of its background. */
const SHIFTS = [0, 1, -1, 2, -2, 3, -3];

/** Distance between rows of labels above a picture, and gap between two labels of a row, pixels. */
const ROW = 17;
const GAP = 12;

/** Height that two rows of labels need above a picture, in addition to the name of its axis, pixels. */
export const LABELS_ABOVE = 24 + ROW;

export interface Text {
  /** Symbol in italics. */
  symbol?: string;
  /** Subscript of the symbol. */
  sub?: string;
  /** Text after the symbol. */
  text?: string;
}

/**
 * Draws a label with a background at a point in pixels, inside the axes. If another text is there, the label moves up or down. `towards` is
 * the direction in which there is space, from −1 (left) to 1 (right).
 */
export function drawLabel(brush: Brush, { x, y, towards, colour, ...text }: Text & { x: number, y: number, towards: number, colour: string }) {
  const { context, view, palette, placed } = brush;
  const parts = measured(brush, text);
  if (parts.length === 0) return;
  const width = widthOf(parts);
  const { left, right, top, bottom } = view.frame;
  const at = clamp(x - (0.5 - 0.5 * towards) * width, left + 3, Math.max(left + 3, right - width - 3));
  const [across, down] = [width / 2 + 2, GROUND.half];
  const lines = SHIFTS.map((shift) => clamp(y + 2 * down * shift, top + 10, bottom - 10));
  const isFree = (height: number) => placed.every((other) => Math.abs(other.x - at - width / 2) >= other.across + across || Math.abs(other.y - height) >= other.down + down);
  const line = lines.find(isFree) ?? lines[0];
  placed.push({ x: at + width / 2, y: line, across, down });
  context.fillStyle = palette.paper;
  faded(context, GROUND.alpha, () => context.fillRect(at - 2, line - down, 2 * across, 2 * down));
  write(brush, parts, at, line, colour);
}

/**
 * Draws labels above a picture, each with a leader to its anchor in pixels. They alternate between two rows, so that leaders of the upper row
 * pass between labels of the lower row. The view needs {@link LABELS_ABOVE} pixels at its top.
 */
export function drawLabelsAbove(brush: Brush, labels: (Text & { x: number, y: number, colour: string })[]) {
  const { context, view, palette } = brush;
  const { left, right, top } = view.frame;
  const placed = labels
    .map((label) => ({ ...label, parts: measured(brush, label) }))
    .map((label) => ({ ...label, width: widthOf(label.parts) }))
    .sort((one, other) => one.x - other.x)
    .map((label, i) => ({ ...label, row: i % 2, from: label.x - label.width / 2 }));
  for (const row of [0, 1]) {
    const inRow = placed.filter((label) => label.row === row);
    // Each label is moved to the right of the one before it. Then the last ones are moved to the left, into the picture.
    let free = left;
    for (const label of inRow) {
      label.from = Math.max(label.from, free);
      free = label.from + label.width + GAP;
    }
    free = right;
    for (const label of inRow.toReversed()) {
      label.from = Math.min(label.from, free - label.width);
      free = label.from - GAP;
    }
  }
  placed.forEach((label, i) => {
    const { from, width, row, x, y, colour, parts } = label;
    const line = top - GROUND.half - ROW * row;
    const [before, after] = [placed[i - 1], placed[i + 1]];
    const least = row === 0 ? from : before.from + before.width + GAP / 2;
    const most = row === 0 ? from + width : (after?.from ?? right) - GAP / 2;
    const leader = clamp(x, least, Math.max(least, most));
    const begin = [clamp(leader, from, from + width), line + GROUND.half];
    drawLeader(context, [begin, [leader, top - (row === 0 ? 0 : ROW)], [leader, top], [x, y]], palette.muted);
    write(brush, parts, from, line, colour);
  });
}

/** Draws a leader: a thin line through points in pixels, from a text to a point, with a dot at the point. */
export function drawLeader(context: CanvasRenderingContext2D, line: number[][], colour: string) {
  strokeLine(context, line, { colour, width: 1 });
  drawDisc(context, line[line.length - 1], 2.5, colour);
}

/** Returns the parts of a text with their widths. */
function measured({ context, font }: Brush, { symbol = '', sub = '', text = '' }: Text) {
  const small = font.replace(/[\d.]+px/, (size) => `${SUBSCRIPT * parseFloat(size)}px`);
  const parts = [
    { text: symbol, style: `italic ${font}`, drop: 0 },
    { text: sub, style: small, drop: DROP },
    { text: symbol && text ? ` ${text}` : text, style: font, drop: 0 },
  ].filter((part) => part.text);
  return parts.map((part) => {
    context.font = part.style;
    return { ...part, width: context.measureText(part.text).width };
  });
}

const widthOf = (parts: { width: number }[]) => parts.reduce((sum, { width }) => sum + width, 0);

/** Writes the parts from left to right, with a halo in the background colour. x is the left end and y the middle of the line, in pixels. */
function write({ context, palette }: Brush, parts: ReturnType<typeof measured>, x: number, y: number, colour: string) {
  context.save();
  Object.assign(context, { textAlign: 'left', textBaseline: 'middle', lineJoin: 'round', lineWidth: 4, strokeStyle: palette.paper, fillStyle: colour });
  let at = x;
  for (const { text, style, drop, width } of parts) {
    context.font = style;
    context.strokeText(text, at, y + drop);
    context.fillText(text, at, y + drop);
    at += width;
  }
  context.restore();
}
