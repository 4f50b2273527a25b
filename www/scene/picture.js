/** A picture: what a canvas shows of a machine, through a view of its own. */

import { brushOn } from './canvas.js';

/**
 * @import { Brush, Surface } from './canvas.js'
 * @import { View } from './view.js'
 * @import { Palette } from '../ui/theme.js'
 *
 * @typedef {object} Easing
 * @property {number} [elapsed] milliseconds since the frame before
 * @property {boolean} [still] whether the view stays aimed at what it is aimed at
 * @property {boolean} [atOnce] whether the view goes there without easing
 */

/**
 * @template Scene what it is of
 * @template {string} [Name=string]
 */
export class Picture {
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
   * @param {Easing} [easing]
   * @returns {boolean} whether the view is still moving
   */
  draw(surface, scene, palette, { elapsed = 0, still = false, atOnce = false } = {}) {
    const brush = brushOn(surface, this.view, palette);
    if (!still || !this.view.aimed) this.fit(scene);
    const moving = this.view.ease(elapsed, atOnce);
    this.paint(brush, scene);
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
