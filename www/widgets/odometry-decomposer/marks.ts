/** Marks of both pictures: turns as arcs with an arrow, and standard deviations as fans and bars. */

import type { Pose } from '../../types.d.ts';
import { addLine, fillPath, paintWithOpacity, strokePath, type Brush } from '../../scene/canvas.ts';

/** Half width and length of an arrow head, pixels. */
const ARROW_HEAD_SIZE = { half: 4, length: 9 };

/** Angle of a chord of a drawn arc, radians. */
const CHORD_ANGLE = 0.1;

/** Returns evenly spaced directions (rad) from a heading to the heading after a turn. */
export function turnDirections(heading: number, turn: number) {
  const chordCount = Math.max(1, Math.ceil(Math.abs(turn) / CHORD_ANGLE));
  return Array.from({ length: chordCount + 1 }, (_, i) => heading + (turn * i) / chordCount);
}

/** Number of points of a drawn ellipse. */
const ELLIPSE_POINTS = 64;

/** Returns the points of an ellipse about a pose with semi-axes along and across its heading, as x, y pairs. Lengths are in metres. */
export function ellipsePoints({ x, y, theta }: Pose, along: number, across: number) {
  const [cos, sin] = [Math.cos(theta), Math.sin(theta)];
  return Float64Array.from({ length: 2 * ELLIPSE_POINTS + 2 }, (_, i) => {
    const angle = (2 * Math.PI * Math.floor(i / 2)) / ELLIPSE_POINTS;
    const [ahead, left] = [along * Math.cos(angle), across * Math.sin(angle)];
    return i % 2 === 0 ? x + ahead * cos - left * sin : y + ahead * sin + left * cos;
  });
}

/** Draws a turn in radians from a pose's heading, as an arc with an arrow, with a radius in pixels. */
export function drawTurn({ context, view }: Brush, startPose: Pose, turn: number, radius: number, colour: string) {
  // In pixels y points down, so that a turn to the left is negative.
  strokePath(context, { colour, width: 1.75 }, () => context.arc(...view.toPixel(startPose.x, startPose.y), radius, -startPose.theta, -startPose.theta - turn, turn > 0));
  // The arrow head is smaller on a short arc.
  const headLength = Math.min(ARROW_HEAD_SIZE.length, radius * Math.abs(turn));
  const tip = view.ray({ ...startPose, theta: startPose.theta + turn }, radius)[1];
  const headBase = { ...startPose, theta: startPose.theta + turn - (Math.sign(turn) * headLength) / radius };
  const headScale = headLength / ARROW_HEAD_SIZE.length;
  const headCorner = (side: number) => view.ray(headBase, radius + side * headScale * ARROW_HEAD_SIZE.half)[1];
  fillPath(context, colour, () => addLine(context, [tip, headCorner(1), headCorner(-1)]));
}

/** Draws a standard deviation (rad) to either side of a heading, as a fan with a radius in pixels. */
export function drawFan({ context, view }: Brush, { x, y, theta }: Pose, deviation: number, radius: number, colour: string) {
  const halfAngle = Math.min(deviation, Math.PI);
  if (halfAngle === 0) return;
  const centre = view.toPixel(x, y);
  const addFan = () => {
    context.moveTo(...centre);
    context.arc(...centre, radius, -theta - halfAngle, halfAngle - theta);
    context.closePath();
  };
  paintWithOpacity(context, 0.14, () => fillPath(context, colour, addFan));
  paintWithOpacity(context, 0.75, () => strokePath(context, { colour, width: 1, dash: [5, 3] }, addFan));
}

/** Draws a standard deviation (m) as a bar with ends, along the heading of a pose and to either side of its position. */
export function drawBar({ context, view }: Brush, pose: Pose, deviation: number, colour: string) {
  if (deviation === 0) return;
  const barDirection = view.direction(pose.theta);
  const halfLength = deviation * view.scaleX;
  strokePath(context, { colour, width: 1.75 }, () => {
    for (const endOffset of [-halfLength, halfLength]) {
      const [barMiddle, [endX, endY]] = view.ray(pose, endOffset);
      addLine(context, [barMiddle, [endX, endY]]);
      addLine(context, [[endX - ARROW_HEAD_SIZE.half * barDirection.y, endY + ARROW_HEAD_SIZE.half * barDirection.x], [endX + ARROW_HEAD_SIZE.half * barDirection.y, endY - ARROW_HEAD_SIZE.half * barDirection.x]]);
    }
  });
}
