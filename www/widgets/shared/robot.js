/** A robot from above: a disc, and a line from its middle to the handle that turns it. */

import { drawHandle } from '../../scene/draw.js';

/**
 * @import { Pose } from '../../types.d.ts'
 * @import { Brush } from '../../scene/canvas.js'
 * @import { View } from '../../scene/view.js'
 */

/** In a view of much it is drawn no smaller than this, CSS pixels. */
const SMALLEST = 3;

/** Radius of the ring that turns it, pixels. */
const TURN = 5.5;

/**
 * How far ahead of the robot's centre the handle is that turns it.
 *
 * @param {Pick<View, 'scaleX'>} view
 * @param {number} radius metres
 * @returns {number} CSS pixels
 */
export function turnDistance(view, radius) {
  return Math.max(34, radius * view.scaleX + 22);
}

/**
 * The robot that the reader has in hand.
 *
 * @param {Brush} brush
 * @param {Pose} pose
 * @param {number} radius metres
 * @param {string} colour
 */
export function drawHeldRobot(brush, { x, y, theta }, radius, colour) {
  const { context, view, palette } = brush;
  const [atX, atY] = [view.toPixelX(x), view.toPixelY(y)];
  const ahead = view.direction(theta);
  const reach = turnDistance(view, radius);
  context.strokeStyle = colour;
  context.fillStyle = palette.paper;
  context.lineWidth = 2.25;
  context.beginPath();
  context.arc(atX, atY, radiusOn(view, radius), 0, 2 * Math.PI);
  context.fill();
  context.moveTo(atX, atY);
  context.lineTo(atX + reach * ahead.x, atY + reach * ahead.y);
  context.stroke();
  drawHandle(brush, { x: atX + reach * ahead.x, y: atY + reach * ahead.y, radius: TURN, colour });
}

/**
 * The dashed outline of a robot that is not there: where a command would bring it.
 *
 * @param {Brush} brush
 * @param {number} x metres
 * @param {number} y
 * @param {number} radius metres
 * @param {string} colour
 */
export function drawRobotOutline({ context, view }, x, y, radius, colour) {
  context.strokeStyle = colour;
  context.lineWidth = 1.5;
  context.setLineDash([3, 3]);
  context.beginPath();
  context.arc(view.toPixelX(x), view.toPixelY(y), radiusOn(view, radius), 0, 2 * Math.PI);
  context.stroke();
  context.setLineDash([]);
}

/**
 * @param {View} view
 * @param {number} radius metres
 * @returns {number} CSS pixels
 */
function radiusOn(view, radius) {
  return Math.max(SMALLEST, radius * view.scaleX);
}
