/** A line in the key above a picture. */

export function lineKey({ context }: import('../../scene/canvas.ts').Brush, name: string, { colour, width, dash }: { colour: string, width: number, dash: number[] }): import('../../scene/axes.ts').KeyEntry {
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
