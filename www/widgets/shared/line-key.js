/** A line in the key above a picture. */

/**
 * @param {import('../../scene/canvas.js').Brush} brush
 * @param {string} name
 * @param {{ colour: string, width: number, dash: number[] }} style
 * @returns {import('../../scene/axes.js').KeyEntry}
 */
export function lineKey({ context }, name, { colour, width, dash }) {
  return {
    name,
    draw: (x, y, length) => {
      context.strokeStyle = colour;
      context.lineWidth = width;
      context.setLineDash(dash);
      context.beginPath();
      context.moveTo(x, y);
      context.lineTo(x + length, y);
      context.stroke();
      context.setLineDash([]);
    },
  };
}
