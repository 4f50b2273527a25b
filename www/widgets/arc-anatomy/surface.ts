/** The map below the arcs: p or the density of the sampler over positions, as an image and by contours of both. */

import { densityRamp, drawPixels, trace } from '../../scene/draw.ts';
import type { AnatomySurface, ArcAnatomy } from '../../types.d.ts';
import type { Brush } from '../../scene/canvas.ts';
import type { Palette } from '../../ui/theme.ts';

/** Dashes of the contours, CSS pixels: the same whichever of the two is the image. */
export const CONTOURS = { prob: [5, 4], density: [] };

export class SurfaceLayer {
  #pixels = new OffscreenCanvas(1, 1);
  /** Latest answer of the machine, with its question. */
  #last: { settings: object, box: string, surface: AnatomySurface } | undefined;
  /** It in colours, and whose they are. */
  #image: { surface: AnatomySurface, palette: Palette, pixels: Uint8ClampedArray<ArrayBuffer> } | undefined;

  /** @param config as it was read: another object after every change */
  draw(brush: Brush, machine: ArcAnatomy, config: import('../../types.d.ts').ArcAnatomySettings) {
    const { xMin, yMin, xMax, yMax } = brush.view.extent;
    const box = `${xMin} ${yMin} ${xMax} ${yMax}`;
    if (this.#last?.settings !== config || this.#last.box !== box) {
      const surface = machine.surface(xMin, yMin, xMax, yMax);
      this.#last = surface ? { settings: config, box, surface } : undefined;
    }
    if (!this.#last) return;
    const { surface } = this.#last;
    const { palette } = brush;
    if (this.#image?.surface !== surface || this.#image.palette !== palette) {
      this.#image = { surface, palette, pixels: coloured(surface.shades, palette) };
    }
    const { columns, prob, density } = surface;
    drawPixels(brush, this.#pixels, this.#image.pixels, columns);
    this.#contour(brush, prob, CONTOURS.prob);
    this.#contour(brush, density, CONTOURS.density);
  }

  #contour(brush: Brush, lines: Float64Array[], dash: number[]) {
    const { context, palette } = brush;
    context.strokeStyle = palette.ink;
    context.lineWidth = 1;
    context.globalAlpha = 0.7;
    context.setLineDash(dash);
    context.beginPath();
    for (const line of lines) trace(brush, line);
    context.stroke();
    context.setLineDash([]);
    context.globalAlpha = 1;
  }
}

function coloured(shades: Uint8Array, palette: Palette) {
  const colours = new Uint32Array(densityRamp(palette).buffer);
  // Where there is next to nothing, there is nothing.
  colours[0] = 0;
  return new Uint8ClampedArray(Uint32Array.from(shades, (shade) => colours[shade]).buffer);
}
