/** The robot under the reader's hand: its body moves it, a handle ahead of it turns it, by pointer and by keyboard. */

import { Part } from '../../figure/part.js';
import { words } from '../../messages/registry.js';
import { Handle, WAYS } from '../../scene/handle.js';
import { clamp } from '../../ui/clamp.js';
import { fixed } from '../../ui/format.js';
import { turnDistance } from './picture.js';

/** @import { Pose } from '../../types.d.ts' */

/** What a key moves the robot by, metres, and turns it by, radians. */
const KEY_STEP = 0.05;
const KEY_TURN = Math.PI / 36;

/** Which way a key turns it: to the left is counter-clockwise, as for a driver. */
const TURNS = new Map(Object.entries({ '[': 1, ']': -1, ArrowLeft: 1, ArrowUp: 1, ArrowRight: -1, ArrowDown: -1 }));

/** Least size of the body's handle, CSS pixels. */
const MIN_BODY = 32;

/** The handle that turns the robot stays this far inside of the picture, CSS pixels. */
const MARGIN = 12;

/** @extends {Part<import('./map-squeeze.js').MapSqueezeElement>} */
export class RobotHandles extends Part {
  #hooks = { view: () => this.host.picture.view, commit: () => this.host.gesture.commit() };
  #body = new Handle('body', {
    ...this.#hooks,
    at: () => [this.#start.x, this.#start.y],
    drag: (x, y) => this.#moveTo(x, y),
    key: (event) => this.#key(event, !event.shiftKey),
  });
  #turn = new Handle('turn', {
    ...this.#hooks,
    at: (pointer) => pointer,
    drag: (x, y) => this.#turnTo(Math.atan2(y - this.#start.y, x - this.#start.x)),
    key: (event) => this.#key(event, false),
  });

  /** Where the robot is wanted so far. @returns {Pose} */
  get #start() {
    return this.host.settings.wanted.start;
  }

  /** The one that is held. @returns {'body' | 'turn' | undefined} */
  get held() {
    return this.#body.held ? 'body' : this.#turn.held ? 'turn' : undefined;
  }

  render() {
    const say = words.squeeze;
    const { x, y, theta } = this.#start;
    const [left, bottom, right, top] = this.host.picture.plan.bounds;
    return [
      this.#body.element({
        name: say.robot,
        keys: say.robotKeys,
        title: say.robotTitle,
        range: [left, right],
        now: x,
        text: say.robotText(fixed(x, 2), fixed(y, 2)),
        stop: (x <= left || x >= right || y <= bottom || y >= top) && say.mapEnds,
      }),
      this.#turn.element({
        name: say.heading,
        keys: say.headingKeys,
        title: say.headingTitle,
        range: [-Math.PI, Math.PI],
        now: theta,
        text: `${fixed(theta, 2)} rad`,
      }),
    ];
  }

  /**
   * Puts the handles where the robot is drawn.
   *
   * @param {Pose} start
   * @param {number} clearance metres
   */
  place(start, clearance) {
    const { picture: { view }, renderRoot: root } = this.host;
    const [x, y] = [view.toPixelX(start.x), view.toPixelY(start.y)];
    const ahead = view.direction(start.theta);
    const distance = turnDistance(view, clearance);
    const inside = (/** @type {number} */ at, /** @type {number} */ size) => clamp(at, MARGIN, size - MARGIN);
    this.#body.place(root, x, y, Math.max(MIN_BODY, 2 * clearance * view.scaleX));
    this.#turn.place(root, inside(x + distance * ahead.x, view.width), inside(y + distance * ahead.y, view.height));
  }

  /**
   * @param {KeyboardEvent} event
   * @param {boolean} moves whether arrow keys move the robot rather than turn it
   */
  #key({ key, ctrlKey, metaKey, altKey }, moves) {
    const [way, turn] = [moves ? WAYS.get(key) : undefined, TURNS.get(key)];
    if (ctrlKey || metaKey || altKey || !(way || turn)) return false;
    const { x, y, theta } = this.#start;
    if (way) this.#moveTo(x + KEY_STEP * way[0], y + KEY_STEP * way[1]);
    else if (turn) this.#turnTo(theta + KEY_TURN * turn);
    return true;
  }

  /**
   * @param {number} x metres
   * @param {number} y
   */
  #moveTo(x, y) {
    const [left, bottom, right, top] = this.host.picture.plan.bounds;
    const { theta } = this.#start;
    this.#want({ x: clamp(x, left, right), y: clamp(y, bottom, top), theta });
  }

  /** @param {number} theta radians */
  #turnTo(theta) {
    const { x, y } = this.#start;
    // Into (−π, π], without sines: in their last digits engines differ, and the same keys are to be the same heading.
    this.#want({ x, y, theta: theta - 2 * Math.PI * Math.ceil(theta / (2 * Math.PI) - 0.5) });
  }

  /** @param {Pose} start */
  #want(start) {
    this.host.settings.want({ start });
  }
}
