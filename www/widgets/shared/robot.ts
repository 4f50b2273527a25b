/** Drawing of a robot from above: a disc, and a line from its middle to the handle that turns it. */

import { drawHandle } from '../../scene/draw.ts';
import type { Pose } from '../../types.d.ts';
import { drawDisc, strokeLine, type Brush } from '../../scene/canvas.ts';
import type { View } from '../../scene/view.ts';

/** Minimum radius of a drawn robot, CSS pixels. */
const MIN_RADIUS = 3;

/** Radius of the handle that turns a robot, CSS pixels. */
const TURN_HANDLE_RADIUS = 5.5;

/** Returns the distance (CSS pixels) from the centre of a robot to the handle that turns it. The radius of the robot is in metres. */
export function turnHandleDistance(view: Pick<View, 'scaleX'>, radius: number): number {
  return Math.max(34, radius * view.scaleX + 22);
}

/** Draws a robot that the user can drag and turn, with a radius in metres. Labels that are drawn later avoid it. */
export function drawDraggableRobot(brush: Brush, pose: Pose, radius: number, colour: string) {
  const { context, view, palette, placedBoxes: placed } = brush;
  const [centre, turnHandle] = view.ray(pose, turnHandleDistance(view, radius));
  const edgeStyle = { colour, width: 2.25 };
  const robotRadius = radiusInPixels(view, radius);
  drawDisc(context, centre, robotRadius, palette.paper, edgeStyle);
  strokeLine(context, [centre, turnHandle], edgeStyle);
  for (const [[x, y], size] of [[centre, robotRadius], [turnHandle, TURN_HANDLE_RADIUS + 3]] as const) placed.push({ x, y, halfWidth: size, halfHeight: size });
  drawHandle(brush, { x: turnHandle[0], y: turnHandle[1], radius: TURN_HANDLE_RADIUS, colour });
}

/** Draws the dashed outline of a robot at the end of a command. Lengths are in metres. */
export function drawRobotOutline({ context, view }: Brush, x: number, y: number, radius: number, colour: string) {
  drawDisc(context, view.toPixel(x, y), radiusInPixels(view, radius), undefined, { colour, width: 1.5, dash: [3, 3] });
}

/** Converts the radius of a robot from metres to CSS pixels. */
function radiusInPixels(view: View, radius: number): number {
  return Math.max(MIN_RADIUS, radius * view.scaleX);
}
