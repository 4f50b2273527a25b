/** Arithmetic of the quaternions of recorded poses. */

interface Vector { x: number; y: number; z: number }
export interface Quaternion extends Vector { w: number }

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

export const hamiltonProduct = (a: Quaternion, b: Quaternion): Quaternion => ({
  x: a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
  y: a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
  z: a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w,
  w: a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
});

export function rotateVector(q: Quaternion, v: Vector): Vector {
  return hamiltonProduct(hamiltonProduct(q, { ...v, w: 0 }), { x: -q.x, y: -q.y, z: -q.z, w: q.w });
}
