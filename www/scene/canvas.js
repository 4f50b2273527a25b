/**
 * A canvas made ready for drawing in CSS pixels.
 *
 * @module
 */

/**
 * What pictures are drawn on: a canvas, or what stands for one.
 *
 * @typedef {object} Surface
 * @property {number} width pixels
 * @property {number} height
 * @property {number} clientWidth CSS pixels
 * @property {string} [font] its own; that of its style for an element
 * @property {(kind: '2d') => CanvasRenderingContext2D | null} getContext
 */

/** Longest side of a canvas in every browser. */
export const LONGEST_SIDE = 16_384;

/**
 * Clears a canvas and gives the view its size.
 *
 * @param {HTMLCanvasElement | Surface} canvas
 * @param {import('./view.js').View} view
 * @returns {{ context: CanvasRenderingContext2D, ratio: number, font: string }} device pixels a CSS
 *   pixel, and the font of the canvas's style
 */
export function prepare(canvas, view) {
  const ratio = canvas.width / Math.max(1, canvas.clientWidth);
  view.resize(canvas.width / ratio, canvas.height / ratio);
  const context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d'));
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, view.width, view.height);
  if (!(canvas instanceof HTMLElement)) return { context, ratio, font: canvas.font ?? context.font };
  const { fontFamily, fontSize } = getComputedStyle(canvas);
  return { context, ratio, font: `${fontSize} ${fontFamily}` };
}
