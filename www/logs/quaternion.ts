/** Arithmetic of the quaternions of recorded poses. */

type Quaternion = [x: number, y: number, z: number, w: number];

/** Largest deviation from length 1 that rounding explains. */
const LENGTH_TOLERANCE = 0.1;

/** Number of steps per radian to which headings are rounded. */
const HEADING_STEPS_PER_RADIAN = 1e12;

/** Returns the angle about the vertical axis, for quaternions of any length. */
export function headingOf(qx: number, qy: number, qz: number, qw: number): number {
  // The arc tangent differs between engines in its last bits. Rounding makes results equal everywhere.
  return Math.round(Math.atan2(2 * (qw * qz + qx * qy), qw * qw + qx * qx - qy * qy - qz * qz) * HEADING_STEPS_PER_RADIAN) / HEADING_STEPS_PER_RADIAN;
}

/** Returns true if a quaternion has length 1. A quaternion with NaN passes, because its row is dropped as not finite. */
export function isRotation(qx: number, qy: number, qz: number, qw: number): boolean {
  return !(Math.abs(Math.sqrt(qx * qx + qy * qy + qz * qz + qw * qw) - 1) > LENGTH_TOLERANCE);
}

export const hamiltonProduct = ([ax, ay, az, aw]: Quaternion, [bx, by, bz, bw]: Quaternion): Quaternion => [
  aw * bx + ax * bw + ay * bz - az * by,
  aw * by - ax * bz + ay * bw + az * bx,
  aw * bz + ax * by - ay * bx + az * bw,
  aw * bw - ax * bx - ay * by - az * bz,
];
