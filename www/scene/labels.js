/** Labels in pictures: a symbol with its subscript, and a text. */

import { clamp } from '../ui/clamp.js';

/** @import { Brush } from './canvas.js' */

/** Size of a subscript, as a share of the letters, and its distance below the line, pixels. */
const SUBSCRIPT = 0.78;
const DROP = 3;

/** Half the height of a label's ground, pixels, and its opacity. */
const GROUND = { half: 9, alpha: 0.9 };

/**
 * Draws a label on a ground of its own, inside of the axes.
 *
 * @param {Brush} brush
 * @param {object} label
 * @param {number} label.x pixels
 * @param {number} label.y
 * @param {number} label.towards side of the point that has room, from −1 for the left to 1 for the right
 * @param {string} label.colour
 * @param {string} [label.symbol] in italics
 * @param {string} [label.sub] subscript of the symbol
 * @param {string} [label.text] after the symbol
 */
export function drawLabel({ context, view, palette, font }, { x, y, towards, colour, symbol = '', sub = '', text = '' }) {
  const small = font.replace(/[\d.]+px/, (size) => `${SUBSCRIPT * parseFloat(size)}px`);
  const parts = [
    { text: symbol, style: `italic ${font}`, drop: 0 },
    { text: sub, style: small, drop: DROP },
    { text: symbol && text ? ` ${text}` : text, style: font, drop: 0 },
  ].filter((part) => part.text);
  if (parts.length === 0) return;
  const widths = parts.map((part) => {
    context.font = part.style;
    return context.measureText(part.text).width;
  });
  const width = widths.reduce((sum, one) => sum + one);
  const { left, right, top, bottom } = view.frame;
  let at = clamp(x - (0.5 - 0.5 * towards) * width, left + 3, Math.max(left + 3, right - width - 3));
  const line = clamp(y, top + 10, bottom - 10);
  context.fillStyle = palette.paper;
  context.globalAlpha = GROUND.alpha;
  context.fillRect(at - 2, line - GROUND.half, width + 4, 2 * GROUND.half);
  context.globalAlpha = 1;
  context.textAlign = 'left';
  context.textBaseline = 'middle';
  context.lineJoin = 'round';
  context.lineWidth = 4;
  context.strokeStyle = palette.paper;
  context.fillStyle = colour;
  parts.forEach((part, i) => {
    context.font = part.style;
    context.strokeText(part.text, at, line + part.drop);
    context.fillText(part.text, at, line + part.drop);
    at += widths[i];
  });
}
