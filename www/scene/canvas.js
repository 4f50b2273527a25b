/** Canvases, and what pictures are painted on them with. */

/**
 * What pictures are drawn on: a canvas, or what stands for one.
 *
 * @typedef {object} Surface
 * @property {number} width pixels
 * @property {number} height
 * @property {number} clientWidth CSS pixels
 * @property {{ fontFamily: string, fontSize: string }} letters those of its style for an element
 * @property {(kind: '2d') => CanvasRenderingContext2D | null} getContext
 *
 * @typedef {object} Brush what a picture is painted with, in the view's pixels: CSS pixels where the letters have 13 of them,
 *   and more in proportion, so that everything grows with the letters
 * @property {CanvasRenderingContext2D} context
 * @property {import('./view.js').View} view
 * @property {import('../ui/theme.js').Palette} palette
 * @property {number} ratio device pixels a pixel of the view
 * @property {string} font of the canvas's style
 * @property {boolean} [exported] whether a file is drawn: a picture on the page has its key beside it
 * @property {boolean} [handles] whether handles are painted: on the screen they are elements over the picture
 * @property {string | null} [highlight] name of the line that is drawn thicker, and all others faint
 * @property {any} [former] earlier reading whose outlines stay as a ghost
 */

/** Height of a picture's letters, pixels of its view; those of the figure have 16: see the style of canvases. */
const LETTERS = 13;

/** A length in the figure's own style. @param {number} pixels of a view */
export const length = (pixels) => `${pixels / 16}em`;

/** A size in pixels of a view, in CSS pixels. @param {{ width: number, height: number }} size @param {Element} canvas with letters in its style */
export const inCss = ({ width, height }, canvas) => [width, height].map((each) => (each * parseFloat(getComputedStyle(canvas).fontSize)) / LETTERS);

/**
 * A point of the window in the pixels of a view, which what is around it may enlarge.
 *
 * @param {Element} element as wide as the view
 * @param {import('./view.js').View} view
 * @param {{ clientX: number, clientY: number }} point
 */
export function pointOn(element, view, { clientX, clientY }) {
  const { left, top, width } = element.getBoundingClientRect();
  const zoom = width / view.width;
  return [(clientX - left) / zoom, (clientY - top) / zoom];
}

/**
 * Of a canvas that is copied to those that are seen. The processor draws it: a graphics card may lose what it has, and this
 * would not be back when those are drawn again.
 *
 * @param {OffscreenCanvas} canvas
 */
export function hiddenContext(canvas) {
  return /** @type {OffscreenCanvasRenderingContext2D} */ (canvas.getContext('2d', { willReadFrequently: true }));
}

/**
 * Clears a canvas, sets the view to the size of the canvas, and returns what pictures draw with.
 *
 * @param {HTMLCanvasElement | Surface} canvas
 * @param {import('./view.js').View} view
 * @param {import('../ui/theme.js').Palette} palette
 */
export function brushOn(canvas, view, palette) {
  const { fontFamily, fontSize } = canvas instanceof HTMLElement ? getComputedStyle(canvas) : canvas.letters;
  const ratio = ((canvas.width / Math.max(1, canvas.clientWidth)) * parseFloat(fontSize)) / LETTERS;
  view.resize(canvas.width / ratio, canvas.height / ratio);
  const context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d'));
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, view.width, view.height);
  // Numbers with signs, in whatever language the page is.
  context.direction = 'ltr';
  return { context, view, palette, ratio, font: `${LETTERS}px ${fontFamily}` };
}
