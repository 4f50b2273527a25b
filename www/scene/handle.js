/** Something in a picture under the reader's hand: dragged by pointer, moved from the keyboard. */

import { html, nothing } from 'lit';
import { length, pointOn } from './canvas.js';

/**
 * @typedef {object} Hooks what a handle acts on; lengths in metres
 * @property {() => import('./view.js').View} view
 * @property {(pointer: number[]) => number[]} [at] x and y of what is held by a pointer that is there; the middle of
 *   the handle where it is left out
 * @property {(x: number, y: number) => void} drag what is held is wanted there
 * @property {(event: KeyboardEvent) => boolean} key whether the key is one that moved it
 * @property {() => void} commit it has come to rest
 *
 * @typedef {object} Said of a handle
 * @property {string} name
 * @property {string} keys
 * @property {string} title
 * @property {number[]} range from and to
 * @property {number} now
 * @property {string} text the value in words
 * @property {string | false} [stop] a few words on what it has come up against, if it has
 * @property {string | false} [hint] a few words to one who has not seen it yet, while it pulses once
 */

/** Steps of keys, x and y up: Home and End go to the ends of the range along x. @type {Record<string, [number, number]>} */
const STEPS = {
  ArrowRight: [1, 0],
  ArrowLeft: [-1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
  PageUp: [0, 10],
  PageDown: [0, -10],
  Home: [-Infinity, 0],
  End: [Infinity, 0],
};

/** Steps of an arrow key with Shift. */
const LONG_STEP = 5;

/**
 * Returns the steps along x and y that a key moves something by; undefined for other keys and those of the browser.
 *
 * @param {KeyboardEvent} event
 * @returns {[number, number] | undefined}
 */
export function stepsOf({ key, shiftKey, ctrlKey, metaKey, altKey }) {
  const steps = ctrlKey || metaKey || altKey ? undefined : STEPS[key];
  if (!steps || !shiftKey || !key.startsWith('Arrow')) return steps;
  return [LONG_STEP * steps[0], LONG_STEP * steps[1]];
}

export class Handle {
  #part;
  #hooks;
  /** The pointer that holds it, and its element. @type {{ id: number, by: Element } | undefined} */
  #hold;
  /** From the pointer to what is held, metres: taken by its edge it does not jump. */
  #grip = [0, 0];
  /** Where its middle was placed, pixels of the view: on the screen it is rounded. */
  #middle = [0, 0];

  /**
   * @param {string} part classes of its element
   * @param {Hooks} hooks
   */
  constructor(part, hooks) {
    this.#part = part;
    this.#hooks = hooks;
  }

  /** Whether a pointer holds it: a browser lets go of what leaves the page, and tells nobody. */
  get held() {
    return this.#hold?.by.hasPointerCapture(this.#hold.id) ?? false;
  }

  /** @param {Said} said */
  element({ name, keys, title, range, now, text, stop, hint }) {
    // What stops it stands beside it, towards the middle of the picture.
    const side = 2 * this.#middle[0] > this.#hooks.view().width ? 'right' : '';
    return html`<div
      class="handle ${this.#part} ${side} ${this.held ? 'held' : ''}"
      role="slider"
      tabindex="0"
      aria-label=${name}
      aria-description=${keys}
      aria-valuemin=${range[0]}
      aria-valuemax=${range[1]}
      aria-valuenow=${now}
      aria-valuetext=${stop ? `${text}. ${stop}` : text}
      data-stop=${stop || nothing}
      data-hint=${hint || nothing}
      title=${title}
      @pointerdown=${this.#take}
      @pointermove=${this.#drag}
      @pointerup=${this.#release}
      @pointercancel=${this.#release}
      @keydown=${this.#key}
    ></div>`;
  }

  /**
   * @param {ParentNode} root that it was rendered into
   * @param {number} x of its middle, pixels of the view: its style has that at 0
   * @param {number} y
   * @param {number} [size] its width and height; that of its style where it is left out
   */
  place(root, x, y, size) {
    const handle = /** @type {HTMLElement | null} */ (root.querySelector(`.handle.${this.#part.replace(' ', '.')}`));
    if (!handle) return;
    this.#middle = [x, y];
    if (size !== undefined) handle.style.width = handle.style.height = length(size);
    handle.style.translate = `${length(x)} ${length(y)}`;
  }

  /**
   * @param {number[]} point pixels of the view
   * @returns {number[]} the same in metres
   */
  #world([x, y]) {
    const view = this.#hooks.view();
    return [view.toWorldX(x), view.toWorldY(y)];
  }

  /**
   * @param {PointerEvent} event on the handle
   * @returns {number[]} where the pointer is, metres
   */
  #pointer(event) {
    const { parentElement } = /** @type {Element} */ (event.currentTarget);
    return this.#world(pointOn(/** @type {Element} */ (parentElement), this.#hooks.view(), event));
  }

  #take = (/** @type {PointerEvent} */ event) => {
    if (event.button !== 0) return;
    const handle = /** @type {Element} */ (event.currentTarget);
    handle.setPointerCapture(event.pointerId);
    this.#hold = { id: event.pointerId, by: handle };
    const pointer = this.#pointer(event);
    const held = this.#hooks.at?.(pointer) ?? this.#world(this.#middle);
    this.#grip = [held[0] - pointer[0], held[1] - pointer[1]];
  };

  #drag = (/** @type {PointerEvent} */ event) => {
    if (!this.held) return;
    const [x, y] = this.#pointer(event);
    this.#hooks.drag(x + this.#grip[0], y + this.#grip[1]);
  };

  #release = () => {
    if (!this.#hold) return;
    this.#hold = undefined;
    this.#hooks.commit();
  };

  #key = (/** @type {KeyboardEvent} */ event) => {
    if (!this.#hooks.key(event)) return;
    event.preventDefault();
    this.#hooks.commit();
  };
}
