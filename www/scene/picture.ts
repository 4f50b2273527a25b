/** A picture: what a canvas shows of a machine, through a view of its own. */

import { brushOn } from './canvas.ts';
import type { Brush, Surface } from './canvas.ts';
import type { View } from './view.ts';
import type { Palette } from '../ui/theme.ts';

export interface How {
  /** Milliseconds since the frame before. */
  elapsed?: number;
  /** True if the view stays aimed at what it is aimed at. */
  still?: boolean;
  /** True if the view goes there without easing. */
  atOnce?: boolean;
  /** Reading before the present gesture: a view that zooms out after it shows its outlines too. */
  former?: any;
  /** Name of the line that is highlighted. */
  highlight?: string | null;
  /** True if it is drawn for a file, which has no page around it. */
  exported?: boolean;
  /** True if handles are painted. */
  handles?: boolean;
}

export class Picture<Scene, Name extends string = string> {
  /** Reading before the gesture that the view last zoomed out after, or may yet. */
  #former: any;

  /** Class of its canvas. */
  name: Name;
  view: View;

  constructor(name: Name, view: View) {
    this.name = name;
    this.view = view;
  }

  /** Aims the view. */
  fit(_scene: Scene) {}

  /** Paints the scene. Returns true if the next frame has more to paint. */
  paint(_brush: Brush, _scene: Scene): boolean | void {}

  /** Draws the scene. Returns true if the view is still moving, or there is more to paint. */
  draw(surface: HTMLCanvasElement | Surface, scene: Scene, palette: Palette, { elapsed = 0, still = false, atOnce = false, former, highlight, exported = false, handles = exported }: How = {}): boolean {
    const { view } = this;
    const brush = brushOn(surface, view, palette);
    if (former !== this.#former && !exported) {
      this.#former = former;
      view.widened = false;
    }
    if (!still || !view.aimed) this.fit(scene);
    const moving = view.ease(elapsed, atOnce);
    const isMore = this.paint({ ...brush, highlight, exported, handles, former: view.widened && !exported ? former : undefined }, scene);
    return moving || isMore === true;
  }

  /** Returns the index of the sample nearest to a point in CSS pixels; −1 for none. */
  nearest(_machine: any, _x: number, _y: number) {
    return -1;
  }

  /** Returns a point and its surroundings, CSS pixels, in the view's world. */
  around(x: number, y: number, reach: number): [x: number, y: number, radiusX: number, radiusY: number] {
    const { view } = this;
    return [view.toWorldX(x), view.toWorldY(y), reach / view.scaleX, reach / view.scaleY];
  }
}

/** Greatest distance from the pointer to a sample that it marks, CSS pixels. */
const REACH = 14;

/** Picture of samples that the pointer can mark, in an equal view. */
export class SamplesPicture<Scene> extends Picture<Scene> {
  nearest: Picture<any>['nearest'] = (machine, x, y) => machine.nearest(...this.around(x, y, REACH).slice(0, 3));
}
