/** Handle in a picture that the user drags with a pointer or moves with keys. */

import { html, nothing } from 'lit';
import { formatEm, toViewPixels } from './canvas.ts';

/** Callbacks of a handle; lengths in metres. */
interface HandleCallbacks {
  getView: () => import('./view.ts').PictureView;
  /** Returns the point (x, y) that a pointer at `pointerPoint` grasps; by default the middle of the handle. */
  findGraspedPoint?: (pointerPoint: number[]) => number[] | undefined;
  dragTo: (x: number, y: number) => void;
  /** Handles a key. Returns true if the key moved the handle's target. */
  handleKey: (keyEvent: KeyboardEvent) => boolean;
  commitChange: () => void;
}

interface HandleLabels {
  handleName: string;
  keysHint: string;
  title: string;
  valueRange: number[];
  sliderValue: number;
  valueText: string;
  /** Text about the limit of the range, if the handle has reached a limit. */
  limitText?: string | false;
  /** Hint for a user who has not used the handle yet, shown while the handle pulses once. */
  hintText?: string | false;
  /** Tab index of the element. The default is 0: the Tab key reaches the handle. */
  tabIndex?: number;
}

/** Steps along x (right) and y (up) by key. Home and End go to the ends of the range along x. */
const KEY_STEPS: Record<string, [number, number]> = {
  ArrowRight: [1, 0],
  ArrowLeft: [-1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
  PageUp: [0, 10],
  PageDown: [0, -10],
  Home: [-Infinity, 0],
  End: [Infinity, 0],
};

const SHIFT_STEP_FACTOR = 5;

/** Returns the steps along x and y by which a key moves the target; undefined for other keys and for key shortcuts of the browser. */
export function stepsOfKey({ key: pressedKey, shiftKey, ctrlKey, metaKey, altKey }: KeyboardEvent): [number, number] | undefined {
  const keySteps = ctrlKey || metaKey || altKey ? undefined : KEY_STEPS[pressedKey];
  if (!keySteps || !shiftKey || !pressedKey.startsWith('Arrow')) return keySteps;
  return [SHIFT_STEP_FACTOR * keySteps[0], SHIFT_STEP_FACTOR * keySteps[1]];
}

/** Steps of rotation by key, positive to the left. Comma and period are for keyboards on which brackets need a modifier key. */
const KEY_TURN_STEPS: Record<string, number> = { ',': 1, '.': -1, '[': 1, ']': -1 };

/** Returns the steps by which a key turns the target, positive to the left; undefined for other keys. */
export const turnStepsOfKey = ({ key: pressedKey, metaKey }: KeyboardEvent): number | undefined => (metaKey ? undefined : KEY_TURN_STEPS[pressedKey]);

export class Handle {
  #classNames;
  #callbacks;
  /** Id of the pointer that drags the handle, and the dragged element. */
  #heldPointer: { id: number, element: Element } | undefined;
  /** Vector (m) from the pointer to the grasped point. With it, a target that is grasped at its edge does not jump. */
  #gripOffset = [0, 0];
  /** Middle of the handle in pixels of the view, not rounded to device pixels. */
  #handleCentrePixel: [x: number, y: number] = [0, 0];

  constructor(classNames: string, callbacks: HandleCallbacks) {
    this.#classNames = classNames;
    this.#callbacks = callbacks;
  }

  /** True while a pointer drags the handle. The value is not stored, because browsers release the pointer of a removed element without an event. */
  get isHeld() {
    return this.#heldPointer?.element.hasPointerCapture(this.#heldPointer.id) ?? false;
  }

  handleHtml({ handleName, keysHint, title, valueRange, sliderValue, valueText, limitText, hintText, tabIndex = 0 }: HandleLabels) {
    // The text about a limit that the handle has reached is on the side that faces the middle of the picture.
    const limitTextSide = 2 * this.#handleCentrePixel[0] > this.#callbacks.getView().width ? 'right' : '';
    return html`<div
      class="handle ${this.#classNames} ${limitTextSide} ${this.isHeld ? 'held' : ''}"
      role="slider"
      tabindex=${tabIndex}
      aria-label=${handleName}
      aria-description=${keysHint}
      aria-valuemin=${valueRange[0]}
      aria-valuemax=${valueRange[1]}
      aria-valuenow=${sliderValue}
      aria-valuetext=${limitText ? `${valueText}. ${limitText}` : valueText}
      data-stop=${limitText || nothing}
      data-hint=${hintText || nothing}
      title=${title}
      @pointerdown=${this.#onPointerDown}
      @pointermove=${this.#onPointerMove}
      @pointerup=${this.#onPointerUp}
      @pointercancel=${this.#onPointerUp}
      @keydown=${this.#onKeyDown}
    ></div>`;
  }

  /** Moves the middle of the handle's element in `figureRoot` to a point in pixels of the view. `size` (pixels) and `angle` (rad) replace those of its style. */
  placeElementAt(figureRoot: ParentNode, x: number, y: number, { size: handleSize, angle }: { size?: number, angle?: number } = {}) {
    const handleElement = figureRoot.querySelector(`.handle.${this.#classNames.replace(' ', '.')}`) as HTMLElement | null;
    if (!handleElement) return;
    this.#handleCentrePixel = [x, y];
    if (handleSize !== undefined) handleElement.style.width = handleElement.style.height = formatEm(handleSize);
    if (angle !== undefined) handleElement.style.rotate = `${angle}rad`;
    handleElement.style.translate = `${formatEm(x)} ${formatEm(y)}`;
  }

  #worldPointOf(pointerEvent: PointerEvent) {
    const pictureView = this.#callbacks.getView();
    return pictureView.toWorld(...toViewPixels((pointerEvent.currentTarget as Element).parentElement as Element, pictureView, pointerEvent));
  }

  #onPointerDown = (pointerEvent: PointerEvent) => {
    if (pointerEvent.button !== 0) return;
    const handleElement = pointerEvent.currentTarget as Element;
    handleElement.setPointerCapture(pointerEvent.pointerId);
    this.#heldPointer = { id: pointerEvent.pointerId, element: handleElement };
    const pointerInWorld = this.#worldPointOf(pointerEvent);
    const graspedPoint = this.#callbacks.findGraspedPoint?.(pointerInWorld) ?? this.#callbacks.getView().toWorld(...this.#handleCentrePixel);
    this.#gripOffset = [graspedPoint[0] - pointerInWorld[0], graspedPoint[1] - pointerInWorld[1]];
  };

  #onPointerMove = (pointerEvent: PointerEvent) => {
    if (!this.isHeld) return;
    const [x, y] = this.#worldPointOf(pointerEvent);
    this.#callbacks.dragTo(x + this.#gripOffset[0], y + this.#gripOffset[1]);
  };

  #onPointerUp = () => {
    if (!this.#heldPointer) return;
    this.#heldPointer = undefined;
    this.#callbacks.commitChange();
  };

  #onKeyDown = (keyEvent: KeyboardEvent) => {
    if (!this.#callbacks.handleKey(keyEvent)) return;
    keyEvent.preventDefault();
    this.#callbacks.commitChange();
  };
}
