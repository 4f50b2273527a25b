/** Walls under the reader's hand: the edges of doorways along their walls, and walls across, by pointer and by keyboard. */

import { nothing } from 'lit';
import { Part } from '../../figure/part.js';
import { words } from '../../messages/registry.js';
import { Handle, stepsOf } from '../../scene/handle.js';
import { clamp } from '../../ui/clamp.js';
import { fixed } from '../../ui/format.js';
import { gripsOf, movedWalls } from './walls.js';

/**
 * @import { Plan } from '../../types.d.ts'
 * @import { View } from '../../scene/view.js'
 * @import { Grip } from './walls.js'
 */

/** Movement by a key, metres. */
const KEY_STEP = 0.05;

/** Largest number of walls with handles. */
const MOST_WALLS = 50;

/** Distance of the grip of an end from that end, pixels, and the largest share of the wall: grips in a narrow doorway stay apart. */
const INWARD = 12;
const MOST_INWARD = 1 / 6;

/** Keys that go to another wall. @type {Record<string, number>} */
const TURNS = { '[': -1, ']': 1 };

/** @extends {Part<import('./map-squeeze.js').MapSqueezeElement>} */
export class WallHandles extends Part {
  /** Handles by name. @type {Map<string, Handle>} */
  #handles = new Map();
  /** Plan of the grips. @type {Plan | undefined} */
  #plan;
  /** @type {(Grip | undefined)[]} */
  #grips = [];
  /** Plan whose handles were rendered, and whether they have not been placed. @type {Plan | undefined} */
  #rendered;
  #hasNew = false;
  /** Plan and view that the handles were placed in. @type {unknown[]} */
  #shown = [];
  /** Name of the handle that Tab leads to. */
  #current = '';

  /** Grips of the plan in the picture. */
  get #present() {
    const { plan, movable } = this.host.picture;
    if (plan !== this.#plan) {
      this.#plan = plan;
      this.#grips = movable && plan.walls.length <= 4 * MOST_WALLS ? gripsOf(plan) : [];
    }
    return this.#grips;
  }

  render() {
    const say = words.squeeze.walls;
    this.#hasNew ||= this.#rendered !== this.host.picture.plan;
    this.#rendered = this.host.picture.plan;
    return this.#present.map((grip) => {
      if (!grip) return nothing;
      const [x, y] = this.#pointOf(grip);
      const now = x * grip.axis[0] + y * grip.axis[1];
      return this.#handleOf(grip).element({
        name: grip.part === 'side' ? say.wall : say.jamb,
        keys: say.keys,
        title: grip.part === 'side' ? say.wallTitle : say.jambTitle,
        range: grip.range.map((each) => now + each),
        now,
        text: `x = ${fixed(x, 2)} m, y = ${fixed(y, 2)} m`,
      });
    });
  }

  /** Places new elements: they come after the picture. */
  hostUpdated() {
    if (this.#hasNew) this.#place(this.host.picture.view);
    this.#hasNew = false;
  }

  /** Puts the handles where the walls are drawn. @param {View} view */
  place(view) {
    const shown = [this.host.picture.plan, view.extent, view.frame];
    if (shown.some((each, i) => each !== this.#shown[i])) this.#place(view);
    this.#shown = shown;
  }

  /** @param {View} view */
  #place(view) {
    const root = this.host.renderRoot;
    const shown = this.#present.filter((grip) => grip !== undefined).map((grip) => {
      const element = /** @type {HTMLElement | null} */ (root.querySelector(`.handle.${nameOf(grip)}`));
      const middle = grip.part === 'side' ? this.#middleIn(grip, view) : this.#gripOf(grip, view);
      const at = middle && [view.toPixelX(middle[0]), view.toPixelY(middle[1])];
      const { left, right, top, bottom } = view.frame;
      const isShown = at !== undefined && at[0] > left && at[0] < right && at[1] > top && at[1] < bottom;
      if (element) {
        element.style.visibility = isShown ? '' : 'hidden';
        if (grip.part === 'side') element.style.rotate = `${Math.atan2(grip.axis[0], grip.axis[1])}rad`;
      }
      if (isShown) this.#handleOf(grip).place(root, at[0], at[1]);
      return { name: nameOf(grip), element: isShown ? element : null };
    });
    const present = shown.filter(({ element }) => element);
    const current = present.find(({ name }) => name === this.#current) ?? present[0];
    for (const each of present) /** @type {HTMLElement} */ (each.element).tabIndex = each === current ? 0 : -1;
  }

  /** @param {Grip} grip */
  #handleOf(grip) {
    const name = nameOf(grip);
    const present = () => /** @type {Grip} */ (this.#present.find((each) => each && nameOf(each) === name));
    const handle = this.#handles.get(name) ?? new Handle(`${grip.part === 'side' ? 'side' : 'jamb'} ${name}`, {
      view: () => this.host.picture.view,
      at: () => this.#pointOf(present()),
      drag: (x, y) => this.#move(present(), (point, axis) => (x - point[0]) * axis[0] + (y - point[1]) * axis[1]),
      key: (event) => this.#key(event, present()),
      commit: () => this.host.restWalls(),
    });
    this.#handles.set(name, handle);
    return handle;
  }

  /**
   * @param {KeyboardEvent} event
   * @param {Grip} grip
   */
  #key(event, grip) {
    const turn = TURNS[event.key];
    if (turn) {
      event.preventDefault();
      this.#go(nameOf(grip), turn);
      return false;
    }
    const steps = stepsOf(event);
    if (!steps) return false;
    const [dx, dy] = steps;
    // Keys across the axis move along it too, as with every slider.
    return this.#move(grip, (_, [ux, uy]) => KEY_STEP * (dx * ux + dy * uy || (dx + dy) * (ux + uy)));
  }

  /**
   * Moves the focus to another handle.
   *
   * @param {string} name
   * @param {number} turn
   */
  #go(name, turn) {
    const all = /** @type {HTMLElement[]} */ ([...this.host.renderRoot.querySelectorAll('.handle:is(.jamb, .side)')]).filter(({ style }) => !style.visibility);
    const from = all.findIndex((element) => element.classList.contains(name));
    const next = all[(from + turn + all.length) % all.length];
    this.#current = next.classList[2];
    next.focus();
    this.#place(this.host.picture.view);
  }

  /**
   * @param {Grip} grip
   * @param {(point: number[], axis: number[]) => number} distanceOf wanted movement along the axis
   */
  #move(grip, distanceOf) {
    if (!grip) return false;
    this.#current = nameOf(grip);
    const distance = clamp(distanceOf(this.#pointOf(grip), grip.axis), grip.range[0], grip.range[1]);
    if (distance) this.host.moveWalls(movedWalls(/** @type {Plan} */ (this.#plan).walls, grip, distance));
    return !Number.isNaN(distance);
  }

  /** Returns the end of a wall that a grip moves, or its first end. @param {Grip} grip */
  #pointOf({ wall, part }) {
    const { walls } = /** @type {Plan} */ (this.#plan);
    return part === 'to' ? [walls[wall + 2], walls[wall + 3]] : [walls[wall], walls[wall + 1]];
  }

  /**
   * Returns the place of the grip of an end, on the wall.
   *
   * @param {Grip} grip
   * @param {View} view
   */
  #gripOf(grip, view) {
    const [x, y] = this.#pointOf(grip);
    const [ux, uy] = grip.axis;
    const inward = this.#lengthOf(grip) * this.#inward(grip, view);
    return [x - inward * ux, y - inward * uy];
  }

  /** @param {Grip} grip */
  #lengthOf({ wall }) {
    const [x, y, x1, y1] = /** @type {Plan} */ (this.#plan).walls.subarray(wall, wall + 4);
    return Math.hypot(x1 - x, y1 - y);
  }

  /** Returns the share of a wall between an end and its grip. @param {Grip} grip @param {View} view */
  #inward(grip, view) {
    return Math.min(MOST_INWARD, INWARD / (this.#lengthOf(grip) * view.scaleX));
  }

  /**
   * Returns the middle of the visible part of a wall between the grips of its ends; undefined where none is visible.
   *
   * @param {Grip} grip
   * @param {View} view
   */
  #middleIn(grip, view) {
    const { wall } = grip;
    const { xMin, yMin, xMax, yMax } = view.extent;
    const [x, y, x1, y1] = /** @type {Plan} */ (this.#plan).walls.subarray(wall, wall + 4);
    const [dx, dy] = [x1 - x, y1 - y];
    const taken = (/** @type {Grip['part']} */ part) => (this.#present.some((each) => each?.wall === wall && each.part === part) ? 2 * this.#inward(grip, view) : 0);
    let [from, to] = [taken('from'), 1 - taken('to')];
    for (const [at, delta, least, most] of [[x, dx, xMin, xMax], [y, dy, yMin, yMax]]) {
      if (!delta) continue;
      const shares = [(least - at) / delta, (most - at) / delta];
      [from, to] = [Math.max(from, Math.min(...shares)), Math.min(to, Math.max(...shares))];
    }
    const share = (from + to) / 2;
    return from < to ? [x + share * dx, y + share * dy] : undefined;
  }
}

/** Returns the class of a grip's handle. @param {Grip} grip */
const nameOf = ({ wall, part }) => `${part}-${wall / 4}`;
