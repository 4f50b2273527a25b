/**
 * The robot under the reader's hand: its body moves it, a handle ahead of it turns it, by pointer
 * and by keyboard.
 *
 * @module
 */

import { html } from 'lit';
import { words } from '../../messages/registry.js';
import { fixed } from '../../ui/format.js';
import { turnDistance } from './picture.js';

/**
 * @typedef {import('../../types.d.ts').Pose} Pose
 * @typedef {import('../../scene/view.js').View} View
 *
 * @typedef {object} Robot what the handles act on
 * @property {() => View} view
 * @property {() => Pose} start as wanted so far
 * @property {() => ArrayLike<number>} bounds of the map
 * @property {(start: Pose) => void} change takes effect with the next frame
 * @property {() => void} commit it has come to rest
 */

/** What a key moves the robot by, metres, and turns it by, radians. */
const KEY_STEP = 0.05;
const KEY_TURN = Math.PI / 36;

/** Least size of the body's handle, CSS pixels. */
const LEAST_BODY = 32;

/** @typedef {'body' | 'turn'} Part */

export class RobotHandles {
  /** @type {Part | undefined} the one that is held */
  held;
  #robot;
  /** From the pointer to the robot's centre, metres. */
  #grip = { x: 0, y: 0 };

  /** @param {Robot} robot */
  constructor(robot) {
    this.#robot = robot;
  }

  /** @param {Pose} start */
  render({ x, y, theta }) {
    const say = words.squeeze;
    const heading = `${fixed(theta, 2)} rad`;
    return [
      this.#handle('body', {
        name: say.robot,
        keys: say.robotKeys,
        title: say.robotTitle,
        range: this.#range(),
        now: x,
        text: say.robotText(fixed(x, 2), fixed(y, 2)),
      }),
      this.#handle('turn', {
        name: say.heading,
        keys: say.headingKeys,
        title: say.headingTitle,
        range: [-Math.PI, Math.PI],
        now: theta,
        text: heading,
      }),
    ];
  }

  #range() {
    const [left, , right] = [...Array.from(this.#robot.bounds())];
    return [left, right];
  }

  /**
   * @param {Part} part
   * @param {{ name: string, keys: string, title: string, range: number[], now: number, text: string }} words
   */
  #handle(part, { name, keys, title, range, now, text }) {
    return html`<div
      class="handle ${part}"
      role="slider"
      tabindex="0"
      aria-label=${name}
      aria-description=${keys}
      aria-valuemin=${range[0]}
      aria-valuemax=${range[1]}
      aria-valuenow=${now}
      aria-valuetext=${text}
      title=${title}
      @pointerdown=${(/** @type {PointerEvent} */ event) => this.#hold(part, event)}
      @pointermove=${(/** @type {PointerEvent} */ event) => this.#drag(event)}
      @pointerup=${() => this.#release()}
      @pointercancel=${() => this.#release()}
      @keydown=${(/** @type {KeyboardEvent} */ event) => this.#key(part, event)}
    ></div>`;
  }

  /**
   * Puts the handles where the robot is drawn.
   *
   * @param {ParentNode} root
   * @param {Pose} start
   * @param {number} clearance metres
   */
  place(root, start, clearance) {
    const view = this.#robot.view();
    const [x, y] = [view.toPixelX(start.x), view.toPixelY(start.y)];
    const ahead = view.direction(start.theta);
    const distance = turnDistance(view, clearance);
    const inside = (/** @type {number} */ at, /** @type {number} */ size) => Math.min(size - 12, Math.max(12, at));
    for (const handle of /** @type {NodeListOf<HTMLElement>} */ (root.querySelectorAll('.handle'))) {
      if (handle.classList.contains('body')) {
        const size = Math.max(LEAST_BODY, 2 * clearance * view.scaleX);
        handle.style.width = handle.style.height = `${size}px`;
        handle.style.translate = `${x - size / 2}px ${y - size / 2}px`;
      } else {
        const tipX = inside(x + distance * ahead.x, view.width);
        const tipY = inside(y + distance * ahead.y, view.height);
        handle.style.translate = `calc(${tipX}px - 50%) calc(${tipY}px - 50%)`;
      }
    }
  }

  /**
   * @param {PointerEvent} event
   * @returns {{ x: number, y: number }} metres
   */
  #at(event) {
    const handle = /** @type {HTMLElement} */ (event.currentTarget);
    const stage = /** @type {HTMLElement} */ (handle.parentElement);
    const box = stage.getBoundingClientRect();
    const view = this.#robot.view();
    return { x: view.toWorldX(event.clientX - box.left), y: view.toWorldY(event.clientY - box.top) };
  }

  /**
   * @param {Part} part
   * @param {PointerEvent} event
   */
  #hold(part, event) {
    if (event.button !== 0) return;
    const handle = /** @type {HTMLElement} */ (event.currentTarget);
    handle.setPointerCapture(event.pointerId);
    this.held = part;
    const at = this.#at(event);
    const { x, y } = this.#robot.start();
    this.#grip = { x: x - at.x, y: y - at.y };
  }

  /** @param {PointerEvent} event */
  #drag(event) {
    if (!this.held) return;
    const at = this.#at(event);
    const start = this.#robot.start();
    if (this.held === 'body') this.#move(at.x + this.#grip.x, at.y + this.#grip.y);
    else this.#turn(Math.atan2(at.y - start.y, at.x - start.x));
  }

  #release() {
    if (!this.held) return;
    this.held = undefined;
    this.#robot.commit();
  }

  /**
   * @param {Part} part
   * @param {KeyboardEvent} event
   */
  #key(part, event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const moves = /** @type {Record<string, [number, number]>} */ ({
      ArrowRight: [KEY_STEP, 0],
      ArrowLeft: [-KEY_STEP, 0],
      ArrowUp: [0, KEY_STEP],
      ArrowDown: [0, -KEY_STEP],
    });
    // To the left is counter-clockwise, as for a driver.
    const turns = /** @type {Record<string, number>} */ ({
      '[': KEY_TURN,
      ']': -KEY_TURN,
      ArrowLeft: KEY_TURN,
      ArrowUp: KEY_TURN,
      ArrowRight: -KEY_TURN,
      ArrowDown: -KEY_TURN,
    });
    const { x, y, theta } = this.#robot.start();
    const move = part === 'body' && !event.shiftKey ? moves[event.key] : undefined;
    if (move) this.#move(x + move[0], y + move[1]);
    else if (turns[event.key]) this.#turn(theta + turns[event.key]);
    else return;
    event.preventDefault();
    this.#robot.commit();
  }

  /**
   * @param {number} x metres
   * @param {number} y
   */
  #move(x, y) {
    const [left, bottom, right, top] = Array.from(this.#robot.bounds());
    const { theta } = this.#robot.start();
    this.#robot.change({ x: clamp(x, left, right), y: clamp(y, bottom, top), theta });
  }

  /** @param {number} theta radians */
  #turn(theta) {
    const { x, y } = this.#robot.start();
    this.#robot.change({ x, y, theta: Math.atan2(Math.sin(theta), Math.cos(theta)) });
  }
}

/**
 * @param {number} value
 * @param {number} min
 * @param {number} max
 */
function clamp(value, min, max) {
  return Math.min(max, Math.max(min, value));
}
