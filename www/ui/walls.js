/**
 * A floor plan's walls as a layer of their own: a map may have tens of thousands, and they change
 * only with the map, the view or the colours.
 *
 * @module
 */

/**
 * @typedef {import('./view.js').View} View
 * @typedef {import('../types.d.ts').Palette} Palette
 * @typedef {import('../types.d.ts').Plan} Plan
 */

/** Width of a wall that has none, CSS pixels. */
const WALL = 2.5;

/** Width of the outline of cells: enough to keep a cell visible in a view of a whole building. */
const OUTLINE = 0.75;

export class WallLayer {
  #canvas = new OffscreenCanvas(1, 1);
  /** What the layer shows. */
  #shown = '';
  /** @type {Plan | undefined} */
  #plan;

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {View} view
   * @param {Palette} palette
   * @param {Plan} plan
   * @param {{ solid: boolean, ratio: number }} style whether the walls are the outlines of solid
   *   cells, and device pixels a CSS pixel
   */
  draw(context, view, palette, plan, style) {
    const { extent, width, height } = view;
    const wanted = JSON.stringify([extent, width, height, palette.truth, palette.rule, style]);
    if (plan !== this.#plan || wanted !== this.#shown) {
      this.#plan = plan;
      this.#shown = wanted;
      this.#paint(view, palette, plan, style);
    }
    context.drawImage(this.#canvas, 0, 0, width, height);
  }

  /**
   * @param {View} view
   * @param {Palette} palette
   * @param {Plan} plan
   * @param {{ solid: boolean, ratio: number }} style
   */
  #paint(view, palette, { bounds, walls }, { solid, ratio }) {
    // A new size clears it.
    this.#canvas.width = Math.round(view.width * ratio);
    this.#canvas.height = Math.round(view.height * ratio);
    const context = /** @type {OffscreenCanvasRenderingContext2D} */ (this.#canvas.getContext('2d'));
    context.scale(ratio, ratio);
    const [left, bottom, right, top] = bounds;
    const corner = [view.toPixelX(left), view.toPixelY(top)];
    context.strokeStyle = palette.rule;
    context.strokeRect(corner[0], corner[1], view.toPixelX(right) - corner[0], view.toPixelY(bottom) - corner[1]);
    context.fillStyle = palette.truth;
    if (solid) fillCells(context, view, walls);
    context.strokeStyle = palette.truth;
    context.lineWidth = solid ? OUTLINE : WALL;
    context.lineCap = solid ? 'butt' : 'round';
    context.beginPath();
    for (let i = 0; i < walls.length; i += 4) {
      context.moveTo(view.toPixelX(walls[i]), view.toPixelY(walls[i + 1]));
      context.lineTo(view.toPixelX(walls[i + 2]), view.toPixelY(walls[i + 3]));
    }
    context.stroke();
  }
}

/**
 * Fills what the outlines enclose. From a point outside, a ray to the left crosses an even number of
 * outlines, from one inside an odd one: so does it lie in that many of the strips that reach from
 * each outline to beyond the right edge.
 *
 * @param {OffscreenCanvasRenderingContext2D} context
 * @param {View} view
 * @param {Float64Array} walls
 */
function fillCells(context, view, walls) {
  const beyond = view.width + 1;
  context.beginPath();
  for (let i = 0; i < walls.length; i += 4) {
    const [from, to] = [view.toPixelY(walls[i + 1]), view.toPixelY(walls[i + 3])];
    if (from === to) continue;
    context.moveTo(view.toPixelX(walls[i]), from);
    context.lineTo(view.toPixelX(walls[i + 2]), to);
    context.lineTo(beyond, to);
    context.lineTo(beyond, from);
    context.closePath();
  }
  context.fill('evenodd');
}
