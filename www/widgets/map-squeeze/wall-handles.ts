/** Handles of walls: edges of doorways are moved along their walls, and walls across, with the pointer or keys. */

import { html, nothing } from 'lit';
import { swatch } from '../../figure/overlays.ts';
import { FigureController } from '../../figure/controller.ts';
import { words } from '../../messages/registry.ts';
import { Handle, stepsOfKey, turnsOfKey } from '../../scene/handle.ts';
import { Memo } from '../../scene/memo.ts';
import { clamp } from '../../ui/clamp.ts';
import { fixed } from '../../ui/format.ts';
import { gripsOf, movedWalls, type Grip } from './walls.ts';
import type { View } from '../../scene/view.ts';

/** Distance that a key moves a wall, metres. */
const KEY_STEP = 0.05;

/** Largest number of walls with handles. */
const MAX_HANDLED_WALLS = 50;

/** Distance of the grip of an end from that end, pixels, and the largest share of the wall: grips in a narrow doorway stay apart. */
const GRIP_INSET = 12;
const MAX_GRIP_INSET = 1 / 6;

export class WallHandles extends FigureController<import('./map-squeeze.ts').MapSqueezeElement> {
  #handles: Map<string, Handle> = new Map();
  #grips: Memo<(Grip | undefined)[]> = new Memo();
  /** Plan and view that the handles were placed in. */
  #shown: unknown[] = [];
  /** Name of the handle that Tab leads to. */
  #current = '';

  /** Grips of the plan in the picture. */
  get #present() {
    const { plan, movable } = this.host.picture;
    return this.#grips.of([plan], () => (movable && plan.walls.length <= 4 * MAX_HANDLED_WALLS ? gripsOf(plan) : []));
  }

  get #walls() {
    return this.host.picture.plan.walls;
  }

  render() {
    const say = words.squeeze.walls;
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

  /** Returns the entry of the handles in the legend. */
  legend() {
    if (this.#present.every((grip) => !grip)) return nothing;
    return html`<span class="toggle grips">${swatch({ role: 'truth', mark: 'box', width: 1.5 })}${words.squeeze.walls.legend}</span>`;
  }

  /** Places new elements: they come after the picture. */
  hostUpdated() {
    this.#place(this.host.picture.view);
  }

  place(view: View) {
    const shown = [this.host.picture.plan, view.extent, view.frame];
    if (shown.some((each, i) => each !== this.#shown[i])) this.#place(view);
    this.#shown = shown;
  }

  #place(view: View) {
    const root = this.host.renderRoot;
    const shown = this.#present.filter((grip) => grip !== undefined).map((grip) => {
      const element = root.querySelector(`.handle.${nameOf(grip)}`) as HTMLElement | null;
      const middle = grip.part === 'side' ? this.#middleIn(grip, view) : this.#gripOf(grip, view);
      const at = middle && [view.toPixelX(middle[0]), view.toPixelY(middle[1])];
      const { left, right, top, bottom } = view.frame;
      const isShown = at !== undefined && at[0] > left && at[0] < right && at[1] > top && at[1] < bottom;
      if (element) {
        element.style.visibility = isShown ? '' : 'hidden';
        if (grip.part === 'side') element.style.rotate = `${Math.atan(grip.axis[0] / grip.axis[1])}rad`;
      }
      if (isShown) this.#handleOf(grip).place(root, at[0], at[1]);
      return { name: nameOf(grip), element: isShown ? element : null };
    });
    const present = shown.filter(({ element }) => element);
    const current = present.find(({ name }) => name === this.#current) ?? present[0];
    for (const each of present) (each.element as HTMLElement).tabIndex = each === current ? 0 : -1;
  }

  #handleOf(grip: Grip) {
    const name = nameOf(grip);
    // The wall may be missing in a new plan, until its handle is removed.
    const withGrip = <Result>(use: (present: Grip) => Result) => {
      const present = this.#present.find((each) => each && nameOf(each) === name);
      return present && use(present);
    };
    const handle = this.#handles.get(name) ?? new Handle(`${grip.part === 'side' ? 'side' : 'jamb'} ${name}`, {
      view: () => this.host.picture.view,
      at: () => withGrip((present) => this.#pointOf(present)),
      drag: (x, y) => withGrip((present) => this.#move(present, (point, axis) => (x - point[0]) * axis[0] + (y - point[1]) * axis[1])),
      key: (event) => withGrip((present) => this.#key(event, present)) ?? false,
      commit: () => this.host.gesture.commit(),
    });
    this.#handles.set(name, handle);
    return handle;
  }

  #key(event: KeyboardEvent, grip: Grip) {
    const turn = turnsOfKey(event);
    if (turn) {
      event.preventDefault();
      this.#go(nameOf(grip), -turn);
      return false;
    }
    const steps = stepsOfKey(event);
    if (!steps) return false;
    const [dx, dy] = steps;
    // Keys across the axis have the same effect as keys along it, as with every slider.
    return this.#move(grip, (_, [ux, uy]) => KEY_STEP * (dx * ux + dy * uy || (dx + dy) * (ux + uy)));
  }

  /** Moves the focus to another handle. */
  #go(name: string, turn: number) {
    const all = ([...this.host.renderRoot.querySelectorAll('.handle:is(.jamb, .side)')] as HTMLElement[]).filter(({ style }) => !style.visibility);
    const from = all.findIndex((element) => element.classList.contains(name));
    const next = all[(from + turn + all.length) % all.length];
    this.#current = next.classList[2];
    next.focus();
    this.#place(this.host.picture.view);
  }

  /** Moves a grip along its axis by the wanted distance, within its range. Returns false if the distance is NaN. */
  #move(grip: Grip, distanceOf: (point: number[], axis: number[]) => number) {
    this.#current = nameOf(grip);
    const distance = clamp(distanceOf(this.#pointOf(grip), grip.axis), grip.range[0], grip.range[1]);
    if (distance) this.host.moveWalls(movedWalls(this.#walls, grip, distance));
    return !Number.isNaN(distance);
  }

  /** Returns the end of a wall that a grip moves, or its first end. */
  #pointOf({ wall, part }: Grip) {
    return [...this.#walls.subarray(wall, wall + 4)].slice(...(part === 'to' ? [2] : [0, 2]));
  }

  /** Returns the place of the grip of an end, on the wall. */
  #gripOf(grip: Grip, view: View) {
    const [x, y] = this.#pointOf(grip);
    const [ux, uy] = grip.axis;
    const inward = this.#lengthOf(grip) * this.#inward(grip, view);
    return [x - inward * ux, y - inward * uy];
  }

  #lengthOf({ wall }: Grip) {
    const [x, y, x1, y1] = this.#walls.subarray(wall, wall + 4);
    return Math.hypot(x1 - x, y1 - y);
  }

  /** Returns the share of a wall between an end and its grip. */
  #inward(grip: Grip, view: View) {
    return Math.min(MAX_GRIP_INSET, GRIP_INSET / (this.#lengthOf(grip) * view.scaleX));
  }

  /** Returns the middle of the visible part of a wall between the grips of its ends; undefined where none is visible. */
  #middleIn(grip: Grip, view: View) {
    const { wall } = grip;
    const { xMin, yMin, xMax, yMax } = view.extent;
    const [x, y, x1, y1] = this.#walls.subarray(wall, wall + 4);
    const [dx, dy] = [x1 - x, y1 - y];
    const taken = (part: Grip['part']) => (this.#present.some((each) => each?.wall === wall && each.part === part) ? 2 * this.#inward(grip, view) : 0);
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

/** Returns the class of a grip's handle. */
const nameOf = ({ wall, part }: Grip) => `${part}-${wall / 4}`;
