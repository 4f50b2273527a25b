/**
 * The ring at the end of the commanded arc, dragged by pointer or moved from the keyboard.
 *
 * @module
 */

import { html } from 'lit';
import { words } from '../../messages/registry.js';
import { fixed } from '../../ui/format.js';
import { COMMAND_SLIDERS } from './words.js';

/** What an arrow key moves the end of the arc by, metres; with Shift the longer way. */
const KEY_STEP = 0.02;
const LONG_KEY_STEP = 0.1;

const OMEGA_RANGE = COMMAND_SLIDERS[1];

/**
 * @typedef {object} Hooks what the handle asks of the element
 * @property {() => import('../../scene/view.js').View} view of the floor
 * @property {() => [number, number]} end of the arc, with every change so far in effect, metres
 * @property {(x: number, y: number) => void} reach wants the command that ends there
 * @property {() => void} commit after the last of a row of changes
 */

export class ArcHandle {
  /** Whether it is held: the views keep still under it. */
  held = false;
  #hooks;
  /** From the pointer to the ring's centre, CSS pixels: a ring taken by its edge does not jump. */
  #grip = { x: 0, y: 0 };

  /** @param {Hooks} hooks */
  constructor(hooks) {
    this.#hooks = hooks;
  }

  /** @param {import('../../types.d.ts').Command} command */
  render({ v, omega }) {
    const say = words.banana;
    return html`<div
      class="handle"
      role="slider"
      tabindex="0"
      aria-label=${say.handle}
      aria-description=${say.handleKeys}
      aria-valuemin=${OMEGA_RANGE.min}
      aria-valuemax=${OMEGA_RANGE.max}
      aria-valuenow=${omega}
      aria-valuetext="v = ${fixed(v, 2)} m/s, ω = ${fixed(omega, 2)} rad/s"
      title=${say.handleTitle}
      @pointerdown=${this.#hold}
      @pointermove=${this.#drag}
      @pointerup=${this.#release}
      @pointercancel=${this.#release}
      @keydown=${this.#key}
    ></div>`;
  }

  /**
   * Puts the ring where the arc ends.
   *
   * @param {ParentNode} root that it was rendered into
   * @param {[number, number]} end metres
   */
  place(root, [x, y]) {
    const view = this.#hooks.view();
    const handle = /** @type {HTMLElement | null} */ (root.querySelector('.handle'));
    if (handle) handle.style.translate = `${view.toPixelX(x)}px ${view.toPixelY(y)}px`;
  }

  #hold = (/** @type {PointerEvent} */ event) => {
    if (event.button !== 0) return;
    const handle = /** @type {HTMLElement} */ (event.currentTarget);
    const { left, top, width, height } = handle.getBoundingClientRect();
    this.#grip = { x: left + width / 2 - event.clientX, y: top + height / 2 - event.clientY };
    handle.setPointerCapture(event.pointerId);
    this.held = true;
  };

  #drag = (/** @type {PointerEvent} */ event) => {
    if (!this.held) return;
    const handle = /** @type {HTMLElement} */ (event.currentTarget);
    const stage = /** @type {HTMLElement} */ (handle.offsetParent).getBoundingClientRect();
    const view = this.#hooks.view();
    const x = event.clientX + this.#grip.x - stage.left;
    const y = event.clientY + this.#grip.y - stage.top;
    this.#hooks.reach(view.toWorldX(x), view.toWorldY(y));
  };

  #release = () => {
    if (!this.held) return;
    this.held = false;
    this.#hooks.commit();
  };

  #key = (/** @type {KeyboardEvent} */ event) => {
    const step = event.shiftKey ? LONG_KEY_STEP : KEY_STEP;
    const ways = /** @type {Record<string, [number, number]>} */ ({
      ArrowRight: [step, 0],
      ArrowLeft: [-step, 0],
      ArrowUp: [0, step],
      ArrowDown: [0, -step],
    });
    const way = ways[event.key];
    if (!way) return;
    event.preventDefault();
    const [x, y] = this.#hooks.end();
    this.#hooks.reach(x + way[0], y + way[1]);
    this.#hooks.commit();
  };
}
