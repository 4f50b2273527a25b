/** Picture: a canvas with a view, which is the visible part of the plane, and the drawing of a simulation in this view. */

import { createDrawContext } from './canvas.ts';
import type { DrawContext, DrawSurface } from './canvas.ts';
import type { PictureView } from './view.ts';
import type { ColourPalette } from '../ui/theme.ts';

interface DrawOptions extends Pick<DrawContext, 'isExported' | 'drawsHandles' | 'highlight' | 'previousViewModel'> {
  elapsedMs?: number;
  /** True if the scale of the view must not change, as during a drag. */
  keepsScale?: boolean;
  /** True if the view changes without an animation. */
  isImmediate?: boolean;
}

export class FigurePicture<Scene, Name extends string = string> {
  /** View model before the gesture of the latest drawing. If it is replaced, a new gesture has begun, in which the view has not zoomed out yet. */
  #previousViewModel: any;

  declare pictureName: Name;
  declare pictureView: PictureView;

  /** Sets the extent that the view has to show. */
  fitView(_scene: Scene) {}

  paintPicture(_drawContext: DrawContext, _scene: Scene) {}

  /** Draws the scene. Returns true if the view is still moving. */
  drawPicture(drawSurface: DrawSurface, scene: Scene, palette: ColourPalette, { elapsedMs = 0, keepsScale = false, isImmediate = false, previousViewModel, isExported, drawsHandles = isExported, highlight }: DrawOptions = {}): boolean {
    const { pictureView } = this;
    const drawContext = createDrawContext(drawSurface, pictureView, palette);
    if (previousViewModel !== this.#previousViewModel && !isExported) {
      this.#previousViewModel = previousViewModel;
      pictureView.hasZoomedOut = false;
    }
    if (!keepsScale || !pictureView.hasTarget) this.fitView(scene);
    const isViewMoving = pictureView.moveTowardsTarget(elapsedMs, isImmediate);
    this.paintPicture({ ...drawContext, highlight, isExported, drawsHandles, previousViewModel: pictureView.hasZoomedOut && !isExported ? previousViewModel : undefined }, scene);
    return isViewMoving;
  }

  /** Returns the index of the sample nearest to a point in CSS pixels; −1 for none. */
  findNearestSample(_simulation: any, _x: number, _y: number) {
    return -1;
  }
}

/** Maximum distance between the pointer and the sample that it selects, CSS pixels. */
export const SELECTION_RADIUS = 14;

/** Picture of samples that the pointer can select, with the same scale on both axes. */
export class SamplesPicture<Scene> extends FigurePicture<Scene> {
  findNearestSample: FigurePicture<any>['findNearestSample'] = (simulation, x, y) => simulation.nearest(...this.pictureView.toWorld(x, y), SELECTION_RADIUS / this.pictureView.scaleX);
}
