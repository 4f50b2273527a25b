/** Robot that the user moves with a pointer or keys: its drawing from above, and its handles. */

import { FigureController } from '../../figure/controller.ts';
import { words } from '../../messages/registry.ts';
import { drawDisc, strokeLine, type DrawContext } from '../../scene/canvas.ts';
import { drawHandle } from '../../scene/draw.ts';
import { Handle, stepsOfKey, turnStepsOfKey } from '../../scene/handle.ts';
import { clampNumber, formatFixed } from '../../ui/format.ts';
import type { PictureView } from '../../scene/view.ts';
import type { Pose } from '../../types.d.ts';

/** Minimum radius of a drawn robot, CSS pixels. */
const MIN_ROBOT_RADIUS = 3;

/** Radius of the handle that turns a robot, CSS pixels. */
const TURN_HANDLE_RADIUS = 5.5;

/** Returns the distance (CSS pixels) from the centre of a robot to the handle that turns it. The radius of the robot is in metres. */
export function turnHandleDistanceOf(pictureView: Pick<PictureView, 'scaleX'>, robotRadius: number): number {
  return Math.max(34, robotRadius * pictureView.scaleX + 22);
}

/** Draws a robot that the user can drag and turn. Its radius is in metres. Labels that are drawn later do not overlap the robot. */
export function drawDraggableRobot(drawContext: DrawContext, pose: Pose, robotRadius: number, lineColour: string) {
  const { canvasContext, pictureView, palette, placedBoxes } = drawContext;
  const [centre, turnHandle] = pictureView.headingLineFrom(pose, turnHandleDistanceOf(pictureView, robotRadius));
  const edgeStyle = { colour: lineColour, width: 2.25 };
  const pixelRadius = pixelRadiusOf(pictureView, robotRadius);
  drawDisc(canvasContext, centre, pixelRadius, palette.paper, edgeStyle);
  strokeLine(canvasContext, [centre, turnHandle], edgeStyle);
  for (const [[x, y], halfSize] of [[centre, pixelRadius], [turnHandle, TURN_HANDLE_RADIUS + 3]] as const) placedBoxes.push({ x, y, halfWidth: halfSize, halfHeight: halfSize });
  drawHandle(drawContext, { x: turnHandle[0], y: turnHandle[1], radius: TURN_HANDLE_RADIUS, colour: lineColour });
}

/** Draws the dashed outline of a robot at the end of a command. Lengths are in metres. */
export function drawRobotOutline({ canvasContext, pictureView }: DrawContext, x: number, y: number, robotRadius: number, lineColour: string) {
  drawDisc(canvasContext, pictureView.toPixel(x, y), pixelRadiusOf(pictureView, robotRadius), undefined, { colour: lineColour, width: 1.5, dash: [3, 3] });
}

/** Converts the radius of a robot from metres to CSS pixels. */
function pixelRadiusOf(pictureView: PictureView, robotRadius: number): number {
  return Math.max(MIN_ROBOT_RADIUS, robotRadius * pictureView.scaleX);
}

/** Displacement (m) and turn (rad) of a robot per key press. */
const KEY_STEP = 0.05;
const KEY_TURN = Math.PI / 36;

/** Minimum size of the handle on a robot's body, CSS pixels. */
const MIN_BODY_HANDLE_SIZE = 32;

/** Bounds of the robot's position in a figure without a map: left, bottom, right and top (m). */
const DEFAULT_BOUNDS = [-4, -4, 4, 4];

/** Minimum distance between the turning handle and the edge of the picture, CSS pixels. */
const MIN_EDGE_DISTANCE = 12;

/** Handles of a robot: the handle on its body moves the robot, and the handle in front of it turns the robot. */
export class PoseHandles extends FigureController<import('../../figure/figure.ts').Figure> {
  #settingKey;
  #getRadius;
  #getBounds;
  #bodyHandle;
  #turnHandle;

  /**
   * Creates the handles for a setting whose value is a pose. `getRadius` returns the radius of the robot (m). `getBounds` returns left, bottom, right and
   * top of the allowed positions (m). The messages of the figure have the names of the handles under the key `handles`.
   */
  constructor(figure: import('../../figure/figure.ts').Figure, settingKey: string, getRadius: (config: Record<string, any>) => number, getBounds: () => number[] | Float64Array = () => DEFAULT_BOUNDS) {
    super(figure);
    this.#settingKey = settingKey;
    this.#getRadius = getRadius;
    this.#getBounds = getBounds;
    const handleCallbacks = { getView: () => figure.pictures[0].pictureView, commitChange: () => figure.gesture.commitChange() };
    this.#bodyHandle = new Handle(`body ${settingKey}`, {
      ...handleCallbacks,
      findGraspedPoint: () => [this.#requestedPose.x, this.#requestedPose.y],
      dragTo: (x, y) => this.#moveTo(x, y),
      handleKey: (keyEvent) => this.#applyKey(stepsOfKey(keyEvent), turnStepsOfKey(keyEvent)),
    });
    this.#turnHandle = new Handle(`turn ${settingKey}`, {
      ...handleCallbacks,
      findGraspedPoint: (pointerPoint) => pointerPoint,
      dragTo: (x, y) => this.#turnTo(Math.atan2(y - this.#requestedPose.y, x - this.#requestedPose.x)),
      handleKey: (keyEvent) => {
        const keySteps = stepsOfKey(keyEvent);
        // The left arrow key turns the robot counter-clockwise (to the left, from the driver's seat).
        return this.#applyKey(undefined, turnStepsOfKey(keyEvent) ?? (keySteps && keySteps[1] - keySteps[0]));
      },
    });
  }

  get #requestedPose(): Pose {
    return this.figure.settings.requestedValues[this.#settingKey];
  }

  render() {
    const [bodyName, headingName] = (words as any)[this.figure.definition.messageKey].handles[this.#settingKey];
    const { keysHint, headingKeysHint, moveTitle, turnTitle, floorEndNote } = words.pose;
    const { x, y, theta } = this.#requestedPose;
    const [xMin, yMin, xMax, yMax] = this.#getBounds();
    return [
      this.#bodyHandle.handleHtml({
        handleName: bodyName,
        keysHint,
        title: moveTitle,
        valueRange: [xMin, xMax],
        sliderValue: x,
        valueText: `x = ${formatFixed(x, 2)} m, y = ${formatFixed(y, 2)} m`,
        limitText: (x <= xMin || x >= xMax || y <= yMin || y >= yMax) && floorEndNote,
      }),
      this.#turnHandle.handleHtml({
        handleName: headingName,
        keysHint: headingKeysHint,
        title: turnTitle,
        valueRange: [-Math.PI, Math.PI],
        sliderValue: theta,
        valueText: `${formatFixed(theta, 2)} rad`,
      }),
    ];
  }

  placeHandles({ config }: { config: Record<string, any> }) {
    const { pictureView } = this.figure.pictures[0];
    const robotRadius = this.#getRadius(config);
    const figureRoot = this.figure.renderRoot;
    const [[x, y], [turnX, turnY]] = pictureView.headingLineFrom(config[this.#settingKey], turnHandleDistanceOf(pictureView, robotRadius));
    const clampToPicture = (coordinate: number, pictureSize: number) => clampNumber(coordinate, MIN_EDGE_DISTANCE, pictureSize - MIN_EDGE_DISTANCE);
    this.#bodyHandle.placeElementAt(figureRoot, x, y, { size: Math.max(MIN_BODY_HANDLE_SIZE, 2 * robotRadius * pictureView.scaleX) });
    this.#turnHandle.placeElementAt(figureRoot, clampToPicture(turnX, pictureView.width), clampToPicture(turnY, pictureView.height));
  }

  /** Moves the robot by steps along x and y, and turns it by steps counter-clockwise. ±∞ steps turn it to a heading of ±π. Returns false if no steps are given. */
  #applyKey(moveSteps: [number, number] | undefined, turnSteps: number | undefined): boolean {
    const { x, y, theta } = this.#requestedPose;
    if (moveSteps) this.#moveTo(x + KEY_STEP * moveSteps[0], y + KEY_STEP * moveSteps[1]);
    if (turnSteps) this.#turnTo(Number.isFinite(turnSteps) ? theta + KEY_TURN * turnSteps : Math.sign(turnSteps) * Math.PI);
    return moveSteps !== undefined || turnSteps !== undefined;
  }

  /** Moves the robot to a point (m). If the point is out of bounds, moves the robot to the nearest allowed position. */
  #moveTo(x: number, y: number) {
    const [xMin, yMin, xMax, yMax] = this.#getBounds();
    this.#requestPose({ ...this.#requestedPose, x: clampNumber(x, xMin, xMax), y: clampNumber(y, yMin, yMax) });
  }

  /** Turns the robot to a heading in radians. */
  #turnTo(theta: number) {
    // Wraps the heading to (−π, π] without sines. The last digits of sines differ between JavaScript engines, and equal key presses must give equal headings.
    this.#requestPose({ ...this.#requestedPose, theta: theta - 2 * Math.PI * Math.ceil(theta / (2 * Math.PI) - 0.5) });
  }

  #requestPose(pose: Pose) {
    this.figure.settings.requestChange({ [this.#settingKey]: pose });
  }
}
