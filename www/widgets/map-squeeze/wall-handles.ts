/** Handles of walls, for the pointer or keys: edges of doorways move along their walls, and whole walls move across their direction. */

import { html, nothing } from 'lit';
import { FigureController } from '../../figure/controller.ts';
import { words } from '../../messages/registry.ts';
import { swatchHtml } from '../../scene/draw.ts';
import { Handle, stepsOfKey, turnStepsOfKey } from '../../scene/handle.ts';
import { Memo } from '../../scene/cache.ts';
import { clamp, formatFixed } from '../../ui/format.ts';
import { gripsOf, moveWall, type Grip } from './walls.ts';
import type { View } from '../../scene/view.ts';

/** Displacement of a wall per key press, metres. */
const KEY_STEP = 0.05;

/** Largest number of walls with handles. */
const MAX_HANDLED_WALLS = 50;

/** Distance between an end of a wall and its grip, pixels, and its maximum as a fraction of the wall. It keeps the grips of a doorway apart. */
const GRIP_INSET = 12;
const MAX_GRIP_INSET = 1 / 6;

export class WallHandles extends FigureController<import('./map-squeeze.ts').MapSqueezeElement> {
  #handles: Map<string, Handle> = new Map();
  #gripsMemo: Memo<(Grip | undefined)[]> = new Memo();
  /** Name of the handle that is in the tab order. */
  #tabbableName = '';

  get #currentGrips() {
    const { plan, hasMovableWalls: movable } = this.host.picture;
    return this.#gripsMemo.get([plan], () => (movable && plan.walls.length <= 4 * MAX_HANDLED_WALLS ? gripsOf(plan) : []));
  }

  get #walls() {
    return this.host.picture.plan.walls;
  }

  render() {
    const texts = words.squeeze.walls;
    return this.#currentGrips.map((grip) => {
      if (!grip) return nothing;
      const [x, y] = this.#grippedPointOf(grip);
      const position = x * grip.axis[0] + y * grip.axis[1];
      return this.#handleOf(grip).handleHtml({
        name: grip.part === 'side' ? texts.wall : texts.jamb,
        keysHint: texts.keys,
        title: words.pose.moveTitle,
        valueRange: grip.range.map((limit) => position + limit),
        value: position,
        valueText: `x = ${formatFixed(x, 2)} m, y = ${formatFixed(y, 2)} m`,
      });
    });
  }

  /** Returns the entry of the handles in the legend. */
  legendEntryHtml() {
    if (this.#currentGrips.every((grip) => !grip)) return nothing;
    return html`<span class="toggle grips">${swatchHtml({ role: 'truth', shape: 'box', width: 1.5 })}${words.squeeze.walls.legendEntryHtml}</span>`;
  }

  /** Places new elements, which are rendered after the picture. */
  hostUpdated() {
    this.place(this.host.picture.view);
  }

  place(view: View) {
    const root = this.host.renderRoot;
    const placedHandles = this.#currentGrips.filter((grip) => grip !== undefined).map((grip) => {
      const handleElement = root.querySelector(`.handle.${handleClassOf(grip)}`) as HTMLElement | null;
      const gripPoint = grip.part === 'side' ? this.#visibleMiddleOf(grip, view) : this.#gripPositionOf(grip, view);
      const gripPixel = gripPoint && [view.toPixelX(gripPoint[0]), view.toPixelY(gripPoint[1])];
      const { left, right, top, bottom } = view.plotArea;
      const isShown = gripPixel !== undefined && gripPixel[0] > left && gripPixel[0] < right && gripPixel[1] > top && gripPixel[1] < bottom;
      if (handleElement) {
        handleElement.style.visibility = isShown ? '' : 'hidden';
        if (grip.part === 'side') handleElement.style.rotate = `${Math.atan(grip.axis[0] / grip.axis[1])}rad`;
      }
      if (isShown) this.#handleOf(grip).placeInView(root, gripPixel[0], gripPixel[1]);
      return { name: handleClassOf(grip), element: isShown ? handleElement : null };
    });
    const shownHandles = placedHandles.filter(({ element }) => element);
    const tabbableHandle = shownHandles.find(({ name }) => name === this.#tabbableName) ?? shownHandles[0];
    for (const handle of shownHandles) (handle.element as HTMLElement).tabIndex = handle === tabbableHandle ? 0 : -1;
  }

  #handleOf(grip: Grip) {
    const gripName = handleClassOf(grip);
    // The wall may be missing in a new plan, until its handle is removed.
    const callWithGrip = <Result>(useGrip: (currentGrip: Grip) => Result) => {
      const currentGrip = this.#currentGrips.find((candidate) => candidate && handleClassOf(candidate) === gripName);
      return currentGrip && useGrip(currentGrip);
    };
    const handle = this.#handles.get(gripName) ?? new Handle(`${grip.part === 'side' ? 'side' : 'jamb'} ${gripName}`, {
      getView: () => this.host.picture.view,
      graspedPointAt: () => callWithGrip((currentGrip) => this.#grippedPointOf(currentGrip)),
      drag: (x, y) => callWithGrip((currentGrip) => this.#moveGrip(currentGrip, (point, axis) => (x - point[0]) * axis[0] + (y - point[1]) * axis[1])),
      handleKey: (event) => callWithGrip((currentGrip) => this.#onKey(event, currentGrip)) ?? false,
      commit: () => this.host.gesture.commit(),
    });
    this.#handles.set(gripName, handle);
    return handle;
  }

  #onKey(event: KeyboardEvent, grip: Grip) {
    const keyTurns = turnStepsOfKey(event);
    if (keyTurns) {
      event.preventDefault();
      this.#focusHandle(handleClassOf(grip), -keyTurns);
      return false;
    }
    const keySteps = stepsOfKey(event);
    if (!keySteps) return false;
    const [dx, dy] = keySteps;
    // Arrow keys across the axis act like those along it, as for any slider.
    return this.#moveGrip(grip, (_, [ux, uy]) => KEY_STEP * (dx * ux + dy * uy || (dx + dy) * (ux + uy)));
  }

  /** Moves the focus to another handle. */
  #focusHandle(name: string, keyTurns: number) {
    const handleElements = ([...this.host.renderRoot.querySelectorAll('.handle:is(.jamb, .side)')] as HTMLElement[]).filter(({ style }) => !style.visibility);
    const focusedIndex = handleElements.findIndex((element) => element.classList.contains(name));
    const nextHandle = handleElements[(focusedIndex + keyTurns + handleElements.length) % handleElements.length];
    this.#tabbableName = nextHandle.classList[2];
    nextHandle.focus();
    this.place(this.host.picture.view);
  }

  /** Moves a grip along its axis by the requested distance, within its range. Returns false if the distance is NaN. */
  #moveGrip(grip: Grip, distanceOf: (point: number[], axis: number[]) => number) {
    this.#tabbableName = handleClassOf(grip);
    const moveDistance = clamp(distanceOf(this.#grippedPointOf(grip), grip.axis), grip.range[0], grip.range[1]);
    if (moveDistance) this.host.moveWalls(moveWall(this.#walls, grip, moveDistance));
    return !Number.isNaN(moveDistance);
  }

  /** Returns the end of a wall that a grip moves, or its first end. */
  #grippedPointOf({ wall, part }: Grip) {
    return [...this.#walls.subarray(wall, wall + 4)].slice(...(part === 'to' ? [2] : [0, 2]));
  }

  /** Returns the position of the grip of an end. */
  #gripPositionOf(grip: Grip, view: View) {
    const [x, y] = this.#grippedPointOf(grip);
    const [ux, uy] = grip.axis;
    const insetLength = this.#insetLengthOf(grip, view);
    return [x - insetLength * ux, y - insetLength * uy];
  }

  /** Returns the distance between an end and its grip, m. */
  #insetLengthOf({ wall }: Grip, view: View) {
    const [x, y, x1, y1] = this.#walls.subarray(wall, wall + 4);
    return Math.min(MAX_GRIP_INSET * Math.hypot(x1 - x, y1 - y), GRIP_INSET / view.scaleX);
  }

  /** Returns the middle of the visible part of a wall between the grips of its ends; undefined where none is visible. */
  #visibleMiddleOf(grip: Grip, view: View) {
    const { wall } = grip;
    const { xMin, yMin, xMax, yMax } = view.extent;
    const [x, y, x1, y1] = this.#walls.subarray(wall, wall + 4);
    const [dx, dy] = [x1 - x, y1 - y];
    const fractionBeyondGrip = (part: Grip['part']) => (this.#currentGrips.some((otherGrip) => otherGrip?.wall === wall && otherGrip.part === part) ? (2 * this.#insetLengthOf(grip, view)) / Math.hypot(dx, dy) : 0);
    let [firstFraction, lastFraction] = [fractionBeyondGrip('from'), 1 - fractionBeyondGrip('to')];
    for (const [coordinate, delta, min, max] of [[x, dx, xMin, xMax], [y, dy, yMin, yMax]]) {
      if (!delta) continue;
      const boundFractions = [(min - coordinate) / delta, (max - coordinate) / delta];
      [firstFraction, lastFraction] = [Math.max(firstFraction, Math.min(...boundFractions)), Math.min(lastFraction, Math.max(...boundFractions))];
    }
    const middleFraction = (firstFraction + lastFraction) / 2;
    return firstFraction < lastFraction ? [x + middleFraction * dx, y + middleFraction * dy] : undefined;
  }
}

const handleClassOf = ({ wall, part }: Grip) => `${part}-${wall / 4}`;
