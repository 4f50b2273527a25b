/**
 * Functions that checks.mjs calls in the page; `simulationStateOf` runs in Node too.
 *
 * @module
 */

import { computeDigest, computeHash } from '../digest/digest.js';

/**
 * @typedef {{ x: number, y: number }} Point
 * @typedef {HTMLElement & { simulation: any, pictures: { view: import('../../www/scene/view.ts').View }[] }} Figure
 * @typedef {{ config: any, hash: string }} State settings of a simulation, and a hash of all bits of its results
 */

const figureOf = (/** @type {string} */ tag) => /** @type {Figure} */ (document.querySelector(tag));
const shadowRootOf = (/** @type {string} */ tag) => /** @type {ShadowRoot} */ (figureOf(tag).shadowRoot);
const firstCanvasOf = (/** @type {string} */ tag) => /** @type {HTMLCanvasElement} */ (shadowRootOf(tag).querySelector('canvas'));

/**
 * Scrolls to a figure and waits until its cloud is complete and all is drawn.
 *
 * @param {string} tag
 * @returns {Promise<{ stats: number, samples: number }>} number of samples in the statistics, and number requested
 */
export async function untilSettled(tag) {
  await customElements.whenDefined(tag);
  const figure = /** @type {any} */ (figureOf(tag));
  await figure.settled;
  firstCanvasOf(tag).scrollIntoView({ block: 'center' });
  // A browser reports in a frame of its own that the figure has come into sight.
  for (let i = 0; i < 3; i++) await new Promise(requestAnimationFrame);
  await figure.settled;
  // Statistics of some figures count attempts, and others have no samples.
  return { stats: figure.stats?.n ?? figure.stats?.attempts ?? figure.stats?.drawn ?? 0, samples: figure.samples ?? 0 };
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
 * @param {{ tag: string, handle: string, to: number[] }} given `to` is a place in the picture, m
 * @returns {{ from: Point, to: Point, pixel: number }} in pixels of the window; `pixel` in m
 */
export function handlePlacesOf({ tag, handle, to: [x, y] }) {
  const { view } = figureOf(tag).pictures[0];
  const { left, top, width } = firstCanvasOf(tag).getBoundingClientRect();
  const pixelsPerViewPixel = width / view.width;
  const box = /** @type {Element} */ (shadowRootOf(tag).querySelector(`.handle.${handle}`)).getBoundingClientRect();
  return {
    from: { x: box.x + box.width / 2, y: box.y + box.height / 2 },
    to: { x: left + pixelsPerViewPixel * view.toPixelX(x), y: top + pixelsPerViewPixel * view.toPixelY(y) },
    pixel: 1 / (pixelsPerViewPixel * view.scaleX),
  };
}

/** Focuses an element of a figure; returns true if it got the focus. @param {{ tag: string, selector: string }} given */
export function focus({ tag, selector }) {
  const focusTarget = /** @type {HTMLElement} */ (shadowRootOf(tag).querySelector(selector));
  focusTarget.focus();
  return shadowRootOf(tag).activeElement === focusTarget;
}

/** Makes a figure render between each input event and the next frame, as other events can at any time. @param {string} tag */
export function renderAfterInputs(tag) {
  const figure = /** @type {any} */ (figureOf(tag));
  figure.addEventListener('input', () => figure.requestUpdate());
}

/** Returns a hash of every pixel of a figure's first picture. @param {string} tag @returns {Promise<string>} */
export const pictureHashOf = (tag) => computeHash(pixelsOf(firstCanvasOf(tag)));

/** Returns the pixels of a canvas. @param {HTMLCanvasElement} canvas */
function pixelsOf(canvas) {
  const context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d'));
  return context.getImageData(0, 0, canvas.width, canvas.height).data;
}

/** Returns the number of colours of each visible picture. @param {string} tag */
export function colourCountsOf(tag) {
  const visibleCanvases = [...shadowRootOf(tag).querySelectorAll('canvas')].filter((canvas) => canvas.checkVisibility());
  return visibleCanvases.map((canvas) => new Set(new Uint32Array(pixelsOf(canvas).buffer)).size);
}

/** Returns the visible sliders of a figure: value of the setting, position of the slider, its step and its end. @param {string} tag */
export function sliderStatesOf(tag) {
  const figure = /** @type {any} */ (figureOf(tag));
  return [...shadowRootOf(tag).querySelectorAll('input[type=range]')]
    .filter((slider) => slider.checkVisibility())
    .map((slider) => {
      const { id, value, step, max } = /** @type {HTMLInputElement} */ (slider);
      const sliderPosition = Number(value);
      // The id of a slider in a chart is not the name of a setting.
      const settingValue = { [id]: sliderPosition, ...figure.getState() }[id];
      return { key: id, value: figure[id] ?? settingValue, shown: sliderPosition, step: Number(step), end: Number(max) };
    });
}

/** Returns the digest of all configurations, by the published core. */
export async function computeWholeDigest() {
  const [{ load }, response] = await Promise.all([
    import(new URL('/core.js', location.href).href),
    fetch('/tests/digest/configurations.json'),
  ]);
  return computeDigest(await load(), await response.json());
}
