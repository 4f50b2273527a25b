/**
 * What is asked of a page, and runs in it: everything but `machineState`, which runs in Node too.
 *
 * @module
 */

import { digest, hashOf } from '../digest/digest.js';
import { cloudPixels } from '../embeddings/looking.mjs';

/**
 * @typedef {{ x: number, y: number }} Point
 * @typedef {HTMLElement & { machine: any, pictures: { view: import('../../www/scene/view.js').View }[] }} Figure
 * @typedef {{ config: any, hash: string }} State what a machine is told, and a hash of all bits of what it tells
 */

const figureOf = (/** @type {string} */ tag) => /** @type {Figure} */ (document.querySelector(tag));
const rootOf = (/** @type {string} */ tag) => /** @type {ShadowRoot} */ (figureOf(tag).shadowRoot);
const canvasOf = (/** @type {string} */ tag) => /** @type {HTMLCanvasElement} */ (rootOf(tag).querySelector('canvas'));
const frame = () => new Promise(requestAnimationFrame);

/** Frames for which nothing has moved, until nothing will. */
const STILL = 10;

/**
 * Brings a figure into sight and waits until its cloud is complete and its picture rests.
 *
 * @param {string} tag
 * @returns {Promise<{ drawn: number, stats: number, samples: number }>} see cloudPixels
 */
export async function settled(tag) {
  const end = performance.now() + 60_000;
  // Out of sight it does not start.
  figureOf(tag).scrollIntoView({ block: 'start' });
  while (!(figureOf(tag).shadowRoot && canvasOf(tag))) {
    if (performance.now() > end) throw new Error(`<${tag}> has no picture.`);
    await frame();
  }
  canvasOf(tag).scrollIntoView({ block: 'center' });
  const seen = await cloudPixels(canvasOf(tag));
  const look = () => JSON.stringify([figureOf(tag).pictures.map(({ view }) => view.extent), canvasOf(tag).getBoundingClientRect()]);
  let before = look();
  for (let still = 0; still < STILL && performance.now() < end; still++) {
    await frame();
    const now = look();
    if (now !== before) still = 0;
    before = now;
  }
  return seen;
}

/** @param {string} tag */
export const stateOf = (tag) => machineState(figureOf(tag).machine);

/**
 * @param {{ tag: string, hash: string }} given
 * @returns {Promise<string>} the hash of the figure's state, as soon as it is another one
 */
export async function changed({ tag, hash }) {
  const end = performance.now() + 20_000;
  for (;;) {
    const { hash: now } = await stateOf(tag);
    if (now !== hash || performance.now() > end) return now;
    await frame();
  }
}

/**
 * @param {any} machine of whatever widget
 * @returns {Promise<State>}
 */
export async function machineState({ config, poses = null, stats, verdicts = null, contours = null, grid = null }) {
  return { config, hash: await hashOf({ poses, stats, verdicts, contours, grid }) };
}

/**
 * Where a handle is, and how much a pixel of the window is there.
 *
 * @param {{ tag: string, handle: string, to: number[] }} given `to` is a place in the picture, m
 * @returns {{ from: Point, to: Point, pixel: number }} in pixels of the window; `pixel` in m
 */
export function placesOf({ tag, handle, to: [x, y] }) {
  const { view } = figureOf(tag).pictures[0];
  const { left, top, width } = canvasOf(tag).getBoundingClientRect();
  const zoom = width / view.width;
  const box = /** @type {Element} */ (rootOf(tag).querySelector(`.handle.${handle}`)).getBoundingClientRect();
  return {
    from: { x: box.x + box.width / 2, y: box.y + box.height / 2 },
    to: { x: left + zoom * view.toPixelX(x), y: top + zoom * view.toPixelY(y) },
    pixel: 1 / (zoom * view.scaleX),
  };
}

/** @param {{ tag: string, selector: string }} given what is to have the focus */
export function focus({ tag, selector }) {
  const part = /** @type {HTMLElement} */ (rootOf(tag).querySelector(selector));
  part.focus();
  return rootOf(tag).activeElement === part;
}

/** From now on a figure is rendered between each step of the reader's and its frame, as anything may have it. @param {string} tag */
export function renderSteps(tag) {
  const figure = /** @type {any} */ (figureOf(tag));
  figure.addEventListener('input', () => figure.requestUpdate());
}

/** @param {string} tag @returns {Promise<string>} a hash of every pixel of the first picture */
export const pixelsOf = (tag) => hashOf(dataOf(canvasOf(tag)));

/** @param {HTMLCanvasElement} canvas */
function dataOf(canvas) {
  const context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d'));
  return context.getImageData(0, 0, canvas.width, canvas.height).data;
}

/** @param {string} tag @returns {number[]} how many colours each of its pictures has that is to be seen */
export function coloursOf(tag) {
  const canvases = [...rootOf(tag).querySelectorAll('canvas')].filter((canvas) => canvas.checkVisibility());
  return canvases.map((canvas) => new Set(new Uint32Array(dataOf(canvas).buffer)).size);
}

/**
 * @param {string} tag
 * @returns {{ key: string, value: number, shown: number, step: number, end: number }[]} its sliders that are to be seen: what the
 *   setting of each is, where the slider stands, and where it ends
 */
export function slidersOf(tag) {
  const figure = /** @type {any} */ (figureOf(tag));
  return [...rootOf(tag).querySelectorAll('input[type=range]')]
    .filter((slider) => slider.checkVisibility())
    .map((slider) => {
      const { id, value, step, max } = /** @type {HTMLInputElement} */ (slider);
      return { key: id, value: figure[id] ?? figure.getState()[id], shown: Number(value), step: Number(step), end: Number(max) };
    });
}

/**
 * Drops files on the picture of a figure. No protocol can drop what comes from outside of the page.
 *
 * @param {{ tag: string, files: { name: string, bytes: number[] }[] }} given
 */
export function drop({ tag, files }) {
  const dataTransfer = new DataTransfer();
  for (const { name, bytes } of files) dataTransfer.items.add(new File([new Uint8Array(bytes)], name));
  const event = (/** @type {string} */ name) => new DragEvent(name, { dataTransfer, bubbles: true, composed: true, cancelable: true });
  const [over, dropped] = [event('dragover'), event('drop')];
  canvasOf(tag).dispatchEvent(over);
  canvasOf(tag).dispatchEvent(dropped);
  return over.defaultPrevented && dropped.defaultPrevented;
}

/** @param {string} tag @returns {Promise<string>} what a figure says of files that it has refused, as soon as it does */
export async function refusalOf(tag) {
  const end = performance.now() + 20_000;
  for (;;) {
    const said = rootOf(tag).querySelector('.own-map .note')?.textContent?.trim();
    if (said || performance.now() > end) return said ?? '';
    await frame();
  }
}

/** The digest of all configurations, by the core that ships. */
export async function wholeDigest() {
  const [{ load }, list] = await Promise.all([
    import(new URL('/core.js', location.href).href),
    fetch('/tests/digest/configurations.json'),
  ]);
  return digest(await load(), await list.json());
}
