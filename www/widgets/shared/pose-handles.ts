/** Handles of a robot for pointer and keys: one on its body that moves it, and one ahead of it that turns it. */

import { FigureController } from '../../figure/controller.ts';
import { words } from '../../messages/registry.ts';
import { Handle, stepsOfKey, turnsOfKey } from '../../scene/handle.ts';
import { clamp, fixed } from '../../ui/format.ts';
import { turnHandleDistance } from './robot.ts';
import type { View } from '../../scene/view.ts';
import type { Pose } from '../../types.d.ts';

/** Displacement (m) and turn (rad) per key press. */
const KEY_STEP = 0.05;
const KEY_TURN = Math.PI / 36;

/** Minimum size of the body's handle, CSS pixels. */
const MIN_BODY_HANDLE_SIZE = 32;

/** Allowed positions without a map: left, bottom, right and top, m. */
const DEFAULT_BOUNDS = [-4, -4, 4, 4];

/** Minimum distance of the turning handle from the edge of the picture, CSS pixels. */
const EDGE_MARGIN = 12;

export class PoseHandles extends FigureController<import('../../figure/figure.ts').Figure> {
  #setting;
  #view;
  #bounds;
  #bodyHandle;
  #turnHandle;

  /**
   * Creates the handles of a setting that is a pose, in the view of a picture. `bounds` returns left, bottom, right and top of the allowed
   * positions, metres. The catalogue of the figure has the names of both handles under `handles`.
   */
  constructor(host: import('../../figure/figure.ts').Figure, setting: string, view: () => View, bounds: () => number[] | Float64Array = () => DEFAULT_BOUNDS) {
    super(host);
    this.#setting = setting;
    this.#view = view;
    this.#bounds = bounds;
    const callbacks = { view, commit: () => host.gesture.commit() };
    this.#bodyHandle = new Handle(`body ${setting}`, {
      ...callbacks,
      graspedPointAt: () => [this.#pose.x, this.#pose.y],
      drag: (x, y) => this.#moveTo(x, y),
      key: (event) => this.#moveBy(stepsOfKey(event)) || this.#turnBy(turnsOfKey(event)),
    });
    this.#turnHandle = new Handle(`turn ${setting}`, {
      ...callbacks,
      graspedPointAt: (pointer) => pointer,
      drag: (x, y) => this.#turnTo(Math.atan2(y - this.#pose.y, x - this.#pose.x)),
      key: (event) => {
        const steps = stepsOfKey(event);
        // The left arrow turns counter-clockwise, as a driver would steer.
        return this.#turnBy(turnsOfKey(event) ?? (steps && steps[1] - steps[0]));
      },
    });
  }

  get #pose(): Pose {
    return this.host.settings.requested[this.#setting];
  }

  render() {
    const [bodyName, headingName] = (words as any)[this.host.definition.messageKey].handles[this.#setting];
    const { keys, headingKeys, moveTitle, turnTitle, ends } = words.pose;
    const { x, y, theta } = this.#pose;
    const [left, bottom, right, top] = this.#bounds();
    return [
      this.#bodyHandle.handleHtml({
        name: bodyName,
        keys,
        title: moveTitle,
        range: [left, right],
        now: x,
        text: `x = ${fixed(x, 2)} m, y = ${fixed(y, 2)} m`,
        stop: (x <= left || x >= right || y <= bottom || y >= top) && ends,
      }),
      this.#turnHandle.handleHtml({
        name: headingName,
        keys: headingKeys,
        title: turnTitle,
        range: [-Math.PI, Math.PI],
        now: theta,
        text: `${fixed(theta, 2)} rad`,
      }),
    ];
  }

  /** Places the handles on the drawn robot, whose radius is in metres. */
  place(config: Record<string, any>, radius: number) {
    const view = this.#view();
    const root = this.host.renderRoot;
    const [[x, y], [turnX, turnY]] = view.ray(config[this.#setting], turnHandleDistance(view, radius));
    const clampToPicture = (coordinate: number, size: number) => clamp(coordinate, EDGE_MARGIN, size - EDGE_MARGIN);
    this.#bodyHandle.place(root, x, y, Math.max(MIN_BODY_HANDLE_SIZE, 2 * radius * view.scaleX));
    this.#turnHandle.place(root, clampToPicture(turnX, view.width), clampToPicture(turnY, view.height));
  }

  /** Moves the robot by steps along x and y; returns false if there are none. */
  #moveBy(steps?: [number, number]): boolean {
    if (!steps) return false;
    const { x, y } = this.#pose;
    this.#moveTo(x + KEY_STEP * steps[0], y + KEY_STEP * steps[1]);
    return true;
  }

  /** Turns the robot by steps counter-clockwise, or to a heading of ±π for ±∞ steps; returns false without steps. */
  #turnBy(steps?: number): boolean {
    if (!steps) return false;
    this.#turnTo(Number.isFinite(steps) ? this.#pose.theta + KEY_TURN * steps : Math.sign(steps) * Math.PI);
    return true;
  }

  /** Moves the robot to a point in metres, within its bounds. */
  #moveTo(x: number, y: number) {
    const [left, bottom, right, top] = this.#bounds();
    this.#requestPose({ ...this.#pose, x: clamp(x, left, right), y: clamp(y, bottom, top) });
  }

  /** Turns the robot to a heading in radians. */
  #turnTo(theta: number) {
    // Wraps to (−π, π] without sines, whose last digits differ between engines, so that equal keys give equal headings.
    this.#requestPose({ ...this.#pose, theta: theta - 2 * Math.PI * Math.ceil(theta / (2 * Math.PI) - 0.5) });
  }

  #requestPose(pose: Pose) {
    this.host.settings.request({ [this.#setting]: pose });
  }
}
