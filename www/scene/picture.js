/** A picture: what a canvas shows of a machine, through a view of its own. */

import { brushOn } from './canvas.js';

/**
 * @import { Brush, Surface } from './canvas.js'
 * @import { View } from './view.js'
 * @import { Palette } from '../ui/theme.js'
 *
 * @typedef {object} How
 * @property {number} [elapsed] milliseconds since the frame before
 * @property {boolean} [still] whether the view stays aimed at what it is aimed at
 * @property {boolean} [atOnce] whether the view goes there without easing
 * @property {any} [former] reading before the present gesture: a view that zooms out after it shows its outlines too
 * @property {string | null} [highlight] name of the line that is highlighted
 * @property {boolean} [exported] whether it is drawn for a file, which has no page around it
 * @property {boolean} [handles] whether handles are painted
 */

/**
 * @template Scene what it is of
 * @template {string} [Name=string]
 */
export class Picture {
  /** Reading before the gesture that the view last zoomed out after, or may yet. @type {any} */
  #former;

  /**
   * @param {Name} name class of its canvas
   * @param {View} view
   */
  constructor(name, view) {
    this.name = name;
    this.view = view;
  }

  /** Aims the view. @param {Scene} _scene */
  fit(_scene) {}

  /**
   * @param {Brush} _brush
   * @param {Scene} _scene
   */
  paint(_brush, _scene) {}

  /**
   * @param {HTMLCanvasElement | Surface} surface
   * @param {Scene} scene
   * @param {Palette} palette
   * @param {How} [how]
   * @returns {boolean} whether the view is still moving
   */
  draw(surface, scene, palette, { elapsed = 0, still = false, atOnce = false, former, highlight, exported = false, handles = exported } = {}) {
    const { view } = this;
    const brush = brushOn(surface, view, palette);
    if (former !== this.#former && !exported) {
      this.#former = former;
      view.widened = false;
    }
    if (!still || !view.aimed) this.fit(scene);
    const moving = view.ease(elapsed, atOnce);
    this.paint({ ...brush, highlight, exported, handles, former: view.widened && !exported ? former : undefined }, scene);
    return moving;
  }

  /**
   * Index of the sample nearest to a point; −1 for none.
   *
   * @param {any} _machine
   * @param {number} _x CSS pixels of the canvas
   * @param {number} _y
   */
  nearest(_machine, _x, _y) {
    return -1;
  }

  /**
   * @param {number} x CSS pixels of the canvas
   * @param {number} y
   * @param {number} reach CSS pixels
   * @returns {[x: number, y: number, radiusX: number, radiusY: number]} the surroundings of a point, in the view's world
   */
  around(x, y, reach) {
    const { view } = this;
    return [view.toWorldX(x), view.toWorldY(y), reach / view.scaleX, reach / view.scaleY];
  }
}

/** Greatest distance from the pointer to a sample that it marks, CSS pixels. */
const REACH = 14;

/**
 * Picture of samples that the pointer can mark, in an equal view.
 *
 * @template Scene
 * @extends {Picture<Scene>}
 */
export class SamplesPicture extends Picture {
  /** @type {Picture<any>['nearest']} */
  nearest = (machine, x, y) => machine.nearest(...this.around(x, y, REACH).slice(0, 3));
}
