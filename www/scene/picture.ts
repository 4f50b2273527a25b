/** Picture: a canvas that shows a simulation through its own view. */

import { brushOn } from './canvas.ts';
import type { Brush, Surface } from './canvas.ts';
import type { View } from './view.ts';
import type { Palette } from '../ui/theme.ts';

interface DrawOptions extends Pick<Brush, 'exported' | 'handles' | 'highlight' | 'previousViewModel'> {
  elapsed?: number;
  /** True if the view must not zoom. */
  still?: boolean;
  /** True if the view changes without an animation. */
  atOnce?: boolean;
}

export class Picture<Scene, Name extends string = string> {
  /** `previousViewModel` of the latest drawing. Another one means that a new gesture began, which has not zoomed the view out yet. */
  #previousViewModel: any;

  declare name: Name;
  declare view: View;

  /** Sets the target of the view. */
  fit(_scene: Scene) {}

  /** Paints the scene. */
  paint(_brush: Brush, _scene: Scene) {}

  /** Draws the scene. Returns true if the view is still moving. */
  draw(surface: Surface, scene: Scene, palette: Palette, { elapsed = 0, still = false, atOnce = false, previousViewModel, exported, handles = exported, highlight }: DrawOptions = {}): boolean {
    const { view } = this;
    const brush = brushOn(surface, view, palette);
    if (previousViewModel !== this.#previousViewModel && !exported) {
      this.#previousViewModel = previousViewModel;
      view.hasZoomedOut = false;
    }
    if (!still || !view.hasTarget) this.fit(scene);
    const isViewMoving = view.ease(elapsed, atOnce);
    this.paint({ ...brush, highlight, exported, handles, previousViewModel: view.hasZoomedOut && !exported ? previousViewModel : undefined }, scene);
    return isViewMoving;
  }

  /** Returns the index of the sample nearest to a point in CSS pixels; −1 for none. */
  nearest(_simulation: any, _x: number, _y: number) {
    return -1;
  }
}

/** Maximum distance from the pointer to a sample that it selects, CSS pixels. */
const PICK_RADIUS = 14;

/** Picture of samples that the pointer can select, with the same scale on both axes. */
export class SamplesPicture<Scene> extends Picture<Scene> {
  nearest: Picture<any>['nearest'] = (simulation, x, y) => simulation.nearest(...this.view.toWorld(x, y), PICK_RADIUS / this.view.scaleX);
}
