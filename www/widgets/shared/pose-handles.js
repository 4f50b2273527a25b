/** A robot under the reader's hand: its body moves it, a handle ahead of it turns it, by pointer and by keyboard. */

import { Part } from '../../figure/part.js';
import { words } from '../../messages/registry.js';
import { Handle, stepsOf } from '../../scene/handle.js';
import { clamp } from '../../ui/clamp.js';
import { fixed } from '../../ui/format.js';
import { turnDistance } from './robot.js';

/**
 * @import { Pose } from '../../types.d.ts'
 *
 * @typedef {object} Held what is under the hand
 * @property {() => import('../../scene/view.js').View} view of its picture
 * @property {() => number[] | Float64Array} bounds left, bottom, right and top of where it may be, metres
 * @property {() => Said} say
 *
 * @typedef {object} Said of it
 * @property {string} robot its name
 * @property {string} robotTitle
 * @property {string} heading the name of its heading
 * @property {string} headingTitle
 * @property {string} [ends] a few words where the bounds stop it
 */

/** What a key moves the robot by, metres, and turns it by, radians. */
const KEY_STEP = 0.05;
const KEY_TURN = Math.PI / 36;

/** Turns by keys at the robot itself, counter-clockwise. @type {Record<string, number>} */
const TURNS = { '[': 1, ']': -1 };

/** @param {KeyboardEvent} event */
const turnsOf = ({ key, metaKey }) => (metaKey ? undefined : TURNS[key]);

/** Least size of the body's handle, CSS pixels. */
const MIN_BODY = 32;

/** The handle that turns the robot stays this far inside of the picture, CSS pixels. */
const MARGIN = 12;

/** @extends {Part<import('../../figure/figure.js').Figure>} */
export class PoseHandles extends Part {
  #setting;
  #of;
  #body;
  #turn;

  /**
   * @param {import('../../figure/figure.js').Figure} host
   * @param {string} setting which is the pose
   * @param {Held} of
   */
  constructor(host, setting, of) {
    super(host);
    this.#setting = setting;
    this.#of = of;
    const hooks = { view: of.view, commit: () => host.gesture.commit() };
    this.#body = new Handle(`body ${setting}`, {
      ...hooks,
      at: () => [this.#pose.x, this.#pose.y],
      drag: (x, y) => this.#moveTo(x, y),
      key: (event) => this.#moveBy(stepsOf(event)) || this.#turnBy(turnsOf(event)),
    });
    this.#turn = new Handle(`turn ${setting}`, {
      ...hooks,
      at: (pointer) => pointer,
      drag: (x, y) => this.#turnTo(Math.atan2(y - this.#pose.y, x - this.#pose.x)),
      key: (event) => {
        const steps = stepsOf(event);
        // To the left is counter-clockwise, as for a driver.
        return this.#turnBy(turnsOf(event) ?? (steps && steps[1] - steps[0]));
      },
    });
  }

  /** As it is wanted so far. @returns {Pose} */
  get #pose() {
    return this.host.settings.wanted[this.#setting];
  }

  render() {
    const { robot, robotTitle, heading, headingTitle, ends } = this.#of.say();
    const { x, y, theta } = this.#pose;
    const [left, bottom, right, top] = this.#of.bounds();
    return [
      this.#body.element({
        name: robot,
        keys: words.pose.keys,
        title: robotTitle,
        range: [left, right],
        now: x,
        text: `x = ${fixed(x, 2)} m, y = ${fixed(y, 2)} m`,
        stop: (x <= left || x >= right || y <= bottom || y >= top) && ends,
      }),
      this.#turn.element({
        name: heading,
        keys: words.pose.headingKeys,
        title: headingTitle,
        range: [-Math.PI, Math.PI],
        now: theta,
        text: `${fixed(theta, 2)} rad`,
      }),
    ];
  }

  /**
   * Puts the handles where the robot is drawn.
   *
   * @param {Pose} pose
   * @param {number} radius metres
   */
  place(pose, radius) {
    const view = this.#of.view();
    const root = this.host.renderRoot;
    const [x, y] = [view.toPixelX(pose.x), view.toPixelY(pose.y)];
    const ahead = view.direction(pose.theta);
    const distance = turnDistance(view, radius);
    const inside = (/** @type {number} */ at, /** @type {number} */ size) => clamp(at, MARGIN, size - MARGIN);
    this.#body.place(root, x, y, Math.max(MIN_BODY, 2 * radius * view.scaleX));
    this.#turn.place(root, inside(x + distance * ahead.x, view.width), inside(y + distance * ahead.y, view.height));
  }

  /** @param {[number, number]} [steps] along x and y @returns {boolean} whether there are any */
  #moveBy(steps) {
    if (!steps) return false;
    const { x, y } = this.#pose;
    this.#moveTo(x + KEY_STEP * steps[0], y + KEY_STEP * steps[1]);
    return true;
  }

  /** @param {number} [steps] counter-clockwise; infinitely many for half a turn from 0 @returns {boolean} whether there are any */
  #turnBy(steps) {
    if (!steps) return false;
    this.#turnTo(Number.isFinite(steps) ? this.#pose.theta + KEY_TURN * steps : Math.sign(steps) * Math.PI);
    return true;
  }

  /**
   * @param {number} x metres
   * @param {number} y
   */
  #moveTo(x, y) {
    const [left, bottom, right, top] = this.#of.bounds();
    this.#want({ ...this.#pose, x: clamp(x, left, right), y: clamp(y, bottom, top) });
  }

  /** @param {number} theta radians */
  #turnTo(theta) {
    // Into (−π, π], without sines: in their last digits engines differ, and the same keys are to be the same heading.
    this.#want({ ...this.#pose, theta: theta - 2 * Math.PI * Math.ceil(theta / (2 * Math.PI) - 0.5) });
  }

  /** @param {Pose} pose */
  #want(pose) {
    this.host.settings.want({ [this.#setting]: pose });
  }
}
