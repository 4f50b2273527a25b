/** The map below the arcs: p or the density of the sampler over positions, as an image and by contours of both. */

import { densityRamp, drawPixels, trace } from '../../scene/draw.js';

/**
 * @import { AnatomySurface, ArcAnatomy } from '../../types.d.ts'
 * @import { Brush } from '../../scene/canvas.js'
 * @import { Palette } from '../../ui/theme.js'
 */

/** Dash of the contours of what is not the image, CSS pixels. */
export const OTHER_DASH = [5, 4];

export class SurfaceLayer {
  #pixels = new OffscreenCanvas(1, 1);
  /** What the machine was asked for last. @type {{ settings: object, box: string, surface: AnatomySurface } | undefined} */
  #last;
  /** Colours by shade, and what they were made of. @type {{ palette: Palette, ramp: Uint8Array } | undefined} */
  #colours;

  /**
   * @param {Brush} brush
   * @param {ArcAnatomy} machine
   * @param {import('../../types.d.ts').ArcAnatomySettings} config as it was read: another object after every change
   */
  draw(brush, machine, config) {
    const { xMin, yMin, xMax, yMax } = brush.view.extent;
    const box = `${xMin} ${yMin} ${xMax} ${yMax}`;
    if (this.#last?.settings !== config || this.#last.box !== box) {
      const surface = machine.surface(xMin, yMin, xMax, yMax);
      this.#last = surface ? { settings: config, box, surface } : undefined;
    }
    if (!this.#last) return;
    const { shades, columns, prob, density } = this.#last.surface;
    drawPixels(brush, this.#pixels, this.#coloured(shades, brush.palette), columns);
    const [mapped, other] = config.map === 'prob' ? [prob, density] : [density, prob];
    this.#contour(brush, other, OTHER_DASH);
    this.#contour(brush, mapped, []);
  }

  /**
   * @param {Brush} brush
   * @param {Float64Array[]} lines
   * @param {number[]} dash
   */
  #contour(brush, lines, dash) {
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

  /**
   * @param {Uint8Array} shades
   * @param {Palette} palette
   */
  #coloured(shades, palette) {
    if (this.#colours?.palette !== palette) this.#colours = { palette, ramp: densityRamp(palette) };
    const colours = new Uint32Array(this.#colours.ramp.buffer);
    // Where there is next to nothing, there is nothing.
    const pixels = Uint32Array.from(shades, (shade) => (shade === 0 ? 0 : colours[shade]));
    return new Uint8ClampedArray(pixels.buffer);
  }
}
