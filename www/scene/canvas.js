/** Canvases, and what pictures are painted on them with. */

/**
 * What pictures are drawn on: a canvas, or what stands for one.
 *
 * @typedef {object} Surface
 * @property {number} width pixels
 * @property {number} height
 * @property {number} clientWidth CSS pixels
 * @property {string} [font] its own; that of its style for an element
 * @property {(kind: '2d') => CanvasRenderingContext2D | null} getContext
 *
 * @typedef {object} Brush what a picture is painted with, in CSS pixels
 * @property {CanvasRenderingContext2D} context
 * @property {import('./view.js').View} view
 * @property {import('../ui/theme.js').Palette} palette
 * @property {number} ratio device pixels a CSS pixel
 * @property {string} font of the canvas's style
 */

/** Longest side of a canvas in every browser. */
export const LONGEST_SIDE = 16_384;

/**
 * A point of the window in an element's own CSS pixels, which what is around it may enlarge.
 *
 * @param {Element} element
 * @param {{ clientX: number, clientY: number }} point
 */
export function pointOn(element, { clientX, clientY }) {
  const { left, top, width } = element.getBoundingClientRect();
  const zoom = width / Math.max(1, element.clientWidth);
  return [(clientX - left) / zoom, (clientY - top) / zoom];
}

/**
 * Clears a canvas and gives the view its size.
 *
 * @param {HTMLCanvasElement | Surface} canvas
 * @param {import('./view.js').View} view
 * @param {import('../ui/theme.js').Palette} palette
 */
export function brushOn(canvas, view, palette) {
  const ratio = canvas.width / Math.max(1, canvas.clientWidth);
  view.resize(canvas.width / ratio, canvas.height / ratio);
  const context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d'));
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, view.width, view.height);
  const brush = { context, view, palette, ratio };
  if (!(canvas instanceof HTMLElement)) return { ...brush, font: canvas.font ?? context.font };
  const { fontFamily, fontSize } = getComputedStyle(canvas);
  return { ...brush, font: `${fontSize} ${fontFamily}` };
}
