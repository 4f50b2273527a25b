/** Handles by which the user moves walls with a pointer or keys. Edges of doorways move along their walls, and whole walls move sideways. */

import { range } from 'd3-array';
import { html, nothing } from 'lit';
import { FigureController } from '../../figure/controller.ts';
import { words } from '../../messages/registry.ts';
import { Handle, stepsOfKey, turnStepsOfKey } from '../../scene/handle.ts';
import { MemoizedResult } from '../../scene/cache.ts';
import { formatFixed } from '../../ui/format.ts';
import { gripsOf, moveWall, type Grip } from './walls.ts';

/** Displacement of a wall per key press, metres. */
const KEY_STEP = 0.05;

/** Maximum number of walls in a map whose walls have handles. */
const MAX_HANDLED_WALLS = 50;

/** Fractions of a wall's length at which the handle of the whole wall can be. The handle is at the middle one of these points that are visible. */
const SIDE_FRACTIONS = range(0.02, 0.99, 0.02);

/** Distance between the edge of a doorway and its handle, and maximum of this distance as a fraction of the wall's length. The distance keeps the handle away from a robot in the doorway. */
const EDGE_INSET_PX = 12;
const MAX_EDGE_INSET = 1 / 6;

export class WallHandles extends FigureController<import('./map-squeeze.ts').MapSqueezeElement> {
  #handlesByName: Map<string, Handle> = new Map();
  #gripsMemo: MemoizedResult<Grip[]> = new MemoizedResult();
  /** Name of the handle that is in the tab order. If this handle does not exist, the first handle is in the tab order. */
  #tabbableName = '';

  get #movableGrips() {
    const { plan, grid } = this.figure.picture;
    return this.#gripsMemo.getResult([plan], () => (grid === null && plan.walls.length <= 4 * MAX_HANDLED_WALLS ? gripsOf(plan) : []));
  }

  /** Visible grips (movable ends of walls, or whole walls), each with its handle and its point in the picture. While a handle is dragged, its grip counts as visible. */
  get #shownGrips() {
    const { plan: { walls }, pictureView } = this.figure.picture;
    const { xMin, xMax, yMin, yMax } = pictureView.shownExtent;
    const shownGrips = this.#movableGrips.flatMap((grip) => {
      const [x0, y0, x1, y1] = walls.subarray(grip.wallOffset, grip.wallOffset + 4);
      const insetFraction = Math.min(MAX_EDGE_INSET, EDGE_INSET_PX / (pictureView.scaleX * Math.hypot(x1 - x0, y1 - y0)));
      const handleFractions = { from: [insetFraction], to: [1 - insetFraction], side: SIDE_FRACTIONS }[grip.grippedPart];
      const handlePoints = handleFractions.map((fraction): [x: number, y: number] => [x0 + fraction * (x1 - x0), y0 + fraction * (y1 - y0)]);
      const visiblePoints = handlePoints.filter(([x, y]) => x > xMin && x < xMax && y > yMin && y < yMax);
      const handle = this.#handleOf(grip);
      const shownPoints = visiblePoints.length === 0 && handle.isHeld ? handlePoints : visiblePoints;
      return shownPoints.length === 0 ? [] : [{ grip, handle, name: nameOf(grip), point: shownPoints[Math.floor(shownPoints.length / 2)] }];
    });
    const tabbableGrip = shownGrips.find(({ name }) => name === this.#tabbableName) ?? shownGrips[0];
    return shownGrips.map((shownGrip) => ({ ...shownGrip, isTabbable: shownGrip === tabbableGrip }));
  }

  render() {
    const texts = words.squeeze.wallHandles;
    const { bounds: [xMin, yMin, xMax, yMax] } = this.figure.picture.plan;
    const shownGrips = this.#shownGrips;
    const hintHtml = shownGrips.length > 0 ? html`<span class="wall-hint muted small" aria-hidden="true">${texts.hint}</span>` : nothing;
    return this.figure.renderer.renderAfterFirstPicture(() => [hintHtml, ...shownGrips.map(({ grip, handle, isTabbable }) => {
      const { grippedPart, axis: [ux, uy] } = grip;
      const [x, y] = this.#gripPointOf(grip);
      return handle.handleHtml({
        handleName: grippedPart === 'side' ? texts.wallName : texts.doorwayEdgeName,
        keysHint: texts.keysHint,
        title: words.pose.moveTitle,
        valueRange: Math.abs(ux) > Math.abs(uy) ? [xMin, xMax] : [yMin, yMax],
        sliderValue: Math.abs(ux) > Math.abs(uy) ? x : y,
        valueText: `x = ${formatFixed(x, 2)} m, y = ${formatFixed(y, 2)} m`,
        tabIndex: isTabbable ? 0 : -1,
      });
    })]);
  }

  /** The handles are placed again after each rendering, because new handles are rendered after the picture was drawn. */
  hostUpdated() {
    this.placeHandles();
  }

  placeHandles() {
    const { pictureView } = this.figure.picture;
    for (const { grip: { axis, grippedPart }, handle, point: [x, y] } of this.#shownGrips) {
      handle.placeElementAt(this.figure.renderRoot, pictureView.toPixelX(x), pictureView.toPixelY(y), { angle: grippedPart === 'side' ? Math.atan(axis[0] / axis[1]) : 0 });
    }
  }

  #handleOf(grip: Grip) {
    const name = nameOf(grip);
    // Calls a function with the part of the current floor plan that this handle moves. If the plan has changed and has no such part, nothing is called.
    const callWithGrip = <Result>(useGrip: (currentGrip: Grip) => Result) => {
      const currentGrip = this.#movableGrips.find((otherGrip) => nameOf(otherGrip) === name);
      return currentGrip && useGrip(currentGrip);
    };
    const moveBy = (dx: number, dy: number) => callWithGrip((currentGrip) => {
      const axisDistance = dx * currentGrip.axis[0] + dy * currentGrip.axis[1];
      this.#tabbableName = name;
      this.figure.moveWalls(moveWall(this.figure.picture.plan, currentGrip, axisDistance));
    });
    const handle = this.#handlesByName.get(name) ?? new Handle(`${grip.grippedPart === 'side' ? 'side' : 'jamb'} ${name}`, {
      getView: () => this.figure.picture.pictureView,
      findGraspedPoint: () => callWithGrip((currentGrip) => [...this.#gripPointOf(currentGrip)]),
      dragTo: (x, y) => callWithGrip((currentGrip) => moveBy(x - this.#gripPointOf(currentGrip)[0], y - this.#gripPointOf(currentGrip)[1])),
      handleKey: (keyEvent) => {
        const [keyTurns, keySteps] = [turnStepsOfKey(keyEvent), stepsOfKey(keyEvent)];
        if (keyTurns) this.#focusHandle(name, -keyTurns);
        // Arrow keys perpendicular to the axis also move the handle, like the arrow keys of any slider.
        else if (keySteps) callWithGrip(({ axis: [ux, uy] }) => (keySteps[0] * ux + keySteps[1] * uy ? moveBy(KEY_STEP * keySteps[0], KEY_STEP * keySteps[1]) : moveBy(KEY_STEP * keySteps[1], KEY_STEP * keySteps[0])));
        return keySteps !== undefined;
      },
      commitChange: () => this.figure.gesture.commitChange(),
    });
    this.#handlesByName.set(name, handle);
    return handle;
  }

  /** Returns the end of the wall that a grip moves. For a grip that moves the whole wall, returns the first end of the wall. */
  #gripPointOf({ wallOffset, grippedPart: part }: Grip) {
    return this.figure.picture.plan.walls.subarray(part === 'to' ? wallOffset + 2 : wallOffset, wallOffset + 4);
  }

  /** Moves the focus to another handle: from the named handle, `indexOffset` places further in the list of visible handles. */
  #focusHandle(name: string, indexOffset: number) {
    const handleNames = this.#shownGrips.map((shownGrip) => shownGrip.name);
    this.#tabbableName = handleNames[(handleNames.indexOf(name) + indexOffset + handleNames.length) % handleNames.length];
    this.figure.requestUpdate();
    (this.figure.renderRoot.querySelector(`.handle.${this.#tabbableName}`) as HTMLElement | null)?.focus();
  }
}

/** Returns the name of a grip, which is also a class of its handle. */
const nameOf = ({ wallOffset, grippedPart: part }: Grip) => `${part}-${wallOffset / 4}`;
