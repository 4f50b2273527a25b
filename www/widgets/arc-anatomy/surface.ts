/** Map below the arcs: p, or the density of the sampler over positions, as an image; and contours of both. */

import { densityRamp, trace } from '../../scene/draw.ts';
import { Memo } from '../../scene/memo.ts';
import { Pixels } from '../../scene/pixels.ts';
import type { AnatomySurface, ArcAnatomy } from '../../types.d.ts';
import { stroke, type Brush } from '../../scene/canvas.ts';
import type { Palette } from '../../ui/theme.ts';

/** Styles of the contours, which do not depend on which of the two is the image. */
export const CONTOURS = {
  prob: { role: 'ink', width: 1, dash: [5, 4] },
  density: { role: 'ink', width: 1, dash: [] },
} satisfies Record<string, import('../../scene/draw.ts').LineStyle>;

export class SurfaceLayer {
  #pixels = new Pixels();
  #surface: Memo<AnatomySurface | null> = new Memo();
  #coloured: Memo<void> = new Memo();

  /** Draws the surface for a configuration, which is another object after every change. */
  draw(brush: Brush, machine: ArcAnatomy, config: import('../../types.d.ts').ArcAnatomySettings) {
    const { palette, view: { extent: { xMin, yMin, xMax, yMax } } } = brush;
    const surface = this.#surface.of([config, xMin, yMin, xMax, yMax], () => machine.surface(xMin, yMin, xMax, yMax));
    if (!surface) return;
    const { columns, shades, prob, density } = surface;
    this.#coloured.of([surface, palette], () => this.#pixels.put(coloured(shades, palette), columns));
    this.#pixels.draw(brush);
    brush.context.globalAlpha = 0.7;
    for (const [lines, { role, width, dash }] of [[prob, CONTOURS.prob], [density, CONTOURS.density]] as const) {
      stroke(brush.context, { colour: palette[role], width, dash }, () => {
        for (const line of lines) trace(brush, line);
      });
    }
    brush.context.globalAlpha = 1;
  }
}

function coloured(shades: Uint8Array, palette: Palette) {
  const colours = new Uint32Array(densityRamp(palette).buffer);
  // The lowest shade is transparent.
  colours[0] = 0;
  return new Uint8ClampedArray(Uint32Array.from(shades, (shade) => colours[shade]).buffer);
}
