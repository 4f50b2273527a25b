// Functions that checks.mjs calls in the page; `simulationStateOf` runs in Node too.

import { computeDigest, computeHash } from '../digest/digest.js';

/**
 * @typedef {{ x: number, y: number }} Point
 * @typedef {HTMLElement & { simulation: any, pictures: { pictureView: import('../../www/scene/view.ts').PictureView }[] }} Figure
 * @typedef {{ config: any, resultHash: string }} State settings of a simulation, and a hash of all bits of its results
 */

const figureOf = (/** @type {string} */ widgetTag) => /** @type {Figure} */ (document.querySelector(widgetTag));
const shadowRootOf = (/** @type {string} */ widgetTag) => /** @type {ShadowRoot} */ (figureOf(widgetTag).shadowRoot);
const firstCanvasOf = (/** @type {string} */ widgetTag) => /** @type {HTMLCanvasElement} */ (shadowRootOf(widgetTag).querySelector('canvas'));

/**
 * Scrolls to a figure and waits until its cloud is complete and all pictures are drawn.
 *
 * @param {string} widgetTag
 * @returns {Promise<{ statisticsCount: number, requestedCount: number }>} number of samples in the statistics, and number requested
 */
export async function waitUntilSettled(widgetTag) {
  await customElements.whenDefined(widgetTag);
  const figureElement = /** @type {any} */ (figureOf(widgetTag));
  await figureElement.settled;
  firstCanvasOf(widgetTag).scrollIntoView({ block: 'center' });
  // A browser reports that a figure has come into view in a later animation frame.
  for (let i = 0; i < 3; i++) await new Promise(requestAnimationFrame);
  await figureElement.settled;
  // The number of samples is `n`, or in some figures the number of attempts. It is 0 for figures without samples.
  return { statisticsCount: figureElement.stats?.n ?? figureElement.stats?.attempts ?? figureElement.stats?.drawn ?? 0, requestedCount: figureElement.samples ?? 0 };
}

/** Returns the state of a figure. @param {string} widgetTag */
export const stateOf = (widgetTag) => simulationStateOf(figureOf(widgetTag).simulation);

/** Returns the state of a simulation of any widget. @param {any} simulation @returns {Promise<State>} */
export async function simulationStateOf({ config, poses = null, stats, verdicts = null, contours = null, grid = null }) {
  return { config, resultHash: await computeHash({ poses, stats, verdicts, contours, grid }) };
}

/**
 * Returns the position of a handle, the position to which a test drags it, and the size of a pixel.
 *
 * @param {{ widgetTag: string, handleName: string, targetPoint: number[] }} handleToMeasure `targetPoint` is a position in the picture, m
 * @returns {{ handlePoint: Point, targetPoint: Point, pixelSize: number }} points in pixels of the window; size of a pixel in m
 */
export function measureHandle({ widgetTag, handleName, targetPoint: [x, y] }) {
  const { pictureView } = figureOf(widgetTag).pictures[0];
  const { left, top, width } = firstCanvasOf(widgetTag).getBoundingClientRect();
  const pixelsPerViewPixel = width / pictureView.width;
  const handleBox = /** @type {Element} */ (shadowRootOf(widgetTag).querySelector(`.handle.${handleName}`)).getBoundingClientRect();
  return {
    handlePoint: { x: handleBox.x + handleBox.width / 2, y: handleBox.y + handleBox.height / 2 },
    targetPoint: { x: left + pixelsPerViewPixel * pictureView.toPixelX(x), y: top + pixelsPerViewPixel * pictureView.toPixelY(y) },
    pixelSize: 1 / (pixelsPerViewPixel * pictureView.scaleX),
  };
}

/** Focuses an element of a figure, and returns true if the element got the focus. @param {{ widgetTag: string, selector: string }} focusTarget */
export function focusElement({ widgetTag, selector }) {
  const focusTarget = /** @type {HTMLElement} */ (shadowRootOf(widgetTag).querySelector(selector));
  focusTarget.focus();
  return shadowRootOf(widgetTag).activeElement === focusTarget;
}

/** Makes a figure render between each input event and the next animation frame, as other events might. @param {string} widgetTag */
export function renderAfterInputs(widgetTag) {
  const figureElement = /** @type {any} */ (figureOf(widgetTag));
  figureElement.addEventListener('input', () => figureElement.requestUpdate());
}

/** Returns a hash of every pixel of a figure's first picture. @param {string} widgetTag @returns {Promise<string>} */
export const pictureHashOf = (widgetTag) => computeHash(pixelsOf(firstCanvasOf(widgetTag)));

/** Returns the pixels of a canvas. @param {HTMLCanvasElement} canvasElement */
function pixelsOf(canvasElement) {
  const drawContext = /** @type {CanvasRenderingContext2D} */ (canvasElement.getContext('2d'));
  return drawContext.getImageData(0, 0, canvasElement.width, canvasElement.height).data;
}

/** Returns the number of colours of each visible picture. @param {string} widgetTag */
export function colourCountsOf(widgetTag) {
  const visibleCanvases = [...shadowRootOf(widgetTag).querySelectorAll('canvas')].filter((canvas) => canvas.checkVisibility());
  return visibleCanvases.map((canvas) => new Set(new Uint32Array(pixelsOf(canvas).buffer)).size);
}

/** Returns the visible sliders of a figure, with the value of the setting and the position, step and end of the slider. @param {string} widgetTag */
export function sliderStatesOf(widgetTag) {
  const figureElement = /** @type {any} */ (figureOf(widgetTag));
  return [...shadowRootOf(widgetTag).querySelectorAll('input[type=range]')]
    .filter((sliderInput) => sliderInput.checkVisibility())
    .map((sliderInput) => {
      const { id, value, step, max } = /** @type {HTMLInputElement} */ (sliderInput);
      const sliderPosition = Number(value);
      // The id of a slider in a chart is not the name of a setting. The setting's value is then the slider's position.
      const settingValue = { [id]: sliderPosition, ...figureElement.getState() }[id];
      return { key: id, value: figureElement[id] ?? settingValue, position: sliderPosition, step: Number(step), end: Number(max) };
    });
}

/** Returns hashes of the results of all configurations (the digest), computed by the published core. */
export async function computeWholeDigest() {
  const [{ load }, configurationsResponse] = await Promise.all([
    import(new URL('/core.js', location.href).href),
    fetch('/tests/digest/configurations.json'),
  ]);
  return computeDigest(await load(), await configurationsResponse.json());
}
