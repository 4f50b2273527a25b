// Functions that checks.mjs calls in the page; `simulationStateOf` runs in Node too.

import { computeDigest, computeHash } from '../digest/digest.js';

/**
 * @typedef {{ x: number, y: number }} Point
 * @typedef {HTMLElement & { simulation: any, pictures: { pictureView: import('../../www/scene/view.ts').PictureView }[] }} Figure
 * @typedef {{ config: any, hash: string }} State settings of a simulation, and a hash of all bits of its results
 */

const figureOf = (/** @type {string} */ widgetTag) => /** @type {Figure} */ (document.querySelector(widgetTag));
const shadowRootOf = (/** @type {string} */ widgetTag) => /** @type {ShadowRoot} */ (figureOf(widgetTag).shadowRoot);
const firstCanvasOf = (/** @type {string} */ tag) => /** @type {HTMLCanvasElement} */ (shadowRootOf(tag).querySelector('canvas'));

/**
 * Scrolls to a figure and waits until its cloud is complete and all pictures are drawn.
 *
 * @param {string} tag
 * @returns {Promise<{ statisticsCount: number, requestedCount: number }>} number of samples in the statistics, and number requested
 */
export async function waitUntilSettled(tag) {
  await customElements.whenDefined(tag);
  const figureElement = /** @type {any} */ (figureOf(tag));
  await figureElement.settled;
  firstCanvasOf(tag).scrollIntoView({ block: 'center' });
  // A browser reports that a figure has come into view in a later animation frame.
  for (let i = 0; i < 3; i++) await new Promise(requestAnimationFrame);
  await figureElement.settled;
  // The number of samples is `n`, or in some figures the number of attempts. It is 0 for figures without samples.
  return { statisticsCount: figureElement.stats?.n ?? figureElement.stats?.attempts ?? figureElement.stats?.drawn ?? 0, requestedCount: figureElement.samples ?? 0 };
}

/** Returns the state of a figure. @param {string} tag */
export const stateOf = (tag) => simulationStateOf(figureOf(tag).simulation);

/** Returns the state of a simulation of any widget. @param {any} simulation @returns {Promise<State>} */
export async function simulationStateOf({ config, poses = null, stats, verdicts = null, contours = null, grid = null }) {
  return { config, hash: await computeHash({ poses, stats, verdicts, contours, grid }) };
}

/**
 * Returns the position of a handle, the position to which a test drags it, and the size of a pixel.
 *
 * @param {{ tag: string, handle: string, target: number[] }} given `target` is a position in the picture, m
 * @returns {{ position: Point, target: Point, pixelSize: number }} points in pixels of the window; size of a pixel in m
 */
export function measureHandle({ tag, handle, target: [x, y] }) {
  const { pictureView } = figureOf(tag).pictures[0];
  const { left, top, width } = firstCanvasOf(tag).getBoundingClientRect();
  const pixelsPerViewPixel = width / pictureView.width;
  const handleBox = /** @type {Element} */ (shadowRootOf(tag).querySelector(`.handle.${handle}`)).getBoundingClientRect();
  return {
    position: { x: handleBox.x + handleBox.width / 2, y: handleBox.y + handleBox.height / 2 },
    target: { x: left + pixelsPerViewPixel * pictureView.toPixelX(x), y: top + pixelsPerViewPixel * pictureView.toPixelY(y) },
    pixelSize: 1 / (pixelsPerViewPixel * pictureView.scaleX),
  };
}

/** Focuses an element of a figure, and returns true if the element got the focus. @param {{ tag: string, selector: string }} given */
export function focusElement({ tag, selector }) {
  const focusTarget = /** @type {HTMLElement} */ (shadowRootOf(tag).querySelector(selector));
  focusTarget.focus();
  return shadowRootOf(tag).activeElement === focusTarget;
}

/** Makes a figure render between each input event and the next animation frame, as other events might. @param {string} tag */
export function renderAfterInputs(tag) {
  const figure = /** @type {any} */ (figureOf(tag));
  figure.addEventListener('input', () => figure.requestUpdate());
}

/** Returns a hash of every pixel of a figure's first picture. @param {string} tag @returns {Promise<string>} */
export const pictureHashOf = (tag) => computeHash(pixelsOf(firstCanvasOf(tag)));

/** Returns the pixels of a canvas. @param {HTMLCanvasElement} canvasElement */
function pixelsOf(canvasElement) {
  const drawContext = /** @type {CanvasRenderingContext2D} */ (canvasElement.getContext('2d'));
  return drawContext.getImageData(0, 0, canvasElement.width, canvasElement.height).data;
}

/** Returns the number of colours of each visible picture. @param {string} tag */
export function colourCountsOf(tag) {
  const visibleCanvases = [...shadowRootOf(tag).querySelectorAll('canvas')].filter((canvas) => canvas.checkVisibility());
  return visibleCanvases.map((canvas) => new Set(new Uint32Array(pixelsOf(canvas).buffer)).size);
}

/** Returns the visible sliders of a figure, with the value of the setting and the position, step and end of the slider. @param {string} tag */
export function sliderStatesOf(tag) {
  const figure = /** @type {any} */ (figureOf(tag));
  return [...shadowRootOf(tag).querySelectorAll('input[type=range]')]
    .filter((sliderInput) => sliderInput.checkVisibility())
    .map((slider) => {
      const { id, value, step, max } = /** @type {HTMLInputElement} */ (slider);
      const sliderPosition = Number(value);
      // The id of a slider in a chart is not the name of a setting. The setting's value is then the slider's position.
      const settingValue = { [id]: sliderPosition, ...figure.getState() }[id];
      return { key: id, value: figure[id] ?? settingValue, position: sliderPosition, step: Number(step), end: Number(max) };
    });
}

/** Returns the digest of all configurations, computed by the published core. */
export async function computeWholeDigest() {
  const [{ load }, configurationsResponse] = await Promise.all([
    import(new URL('/core.js', location.href).href),
    fetch('/tests/digest/configurations.json'),
  ]);
  return computeDigest(await load(), await configurationsResponse.json());
}
