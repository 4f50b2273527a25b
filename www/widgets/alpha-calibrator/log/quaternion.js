/** Quaternions of recorded poses. */

/** @typedef {{ x: number, y: number, z: number }} Vector */
/** @typedef {Vector & { w: number }} Quaternion */

/** Largest deviation from length 1 that rounding explains. */
const TOLERANCE = 0.1;

/**
 * Returns the angle about the vertical axis, for quaternions of any length.
 *
 * @param {number} qx
 * @param {number} qy
 * @param {number} qz
 * @param {number} qw
 */
export function headingOf(qx, qy, qz, qw) {
  return Math.atan2(2 * (qw * qz + qx * qy), qw * qw + qx * qx - qy * qy - qz * qz);
}

/**
 * Checks that a quaternion has length 1; one with NaN passes, and is left out as not finite.
 *
 * @param {number} qx
 * @param {number} qy
 * @param {number} qz
 * @param {number} qw
 */
export function isRotation(qx, qy, qz, qw) {
  return !(Math.abs(Math.sqrt(qx * qx + qy * qy + qz * qz + qw * qw) - 1) > TOLERANCE);
}

/** Hamilton product. @param {Quaternion} a @param {Quaternion} b @returns {Quaternion} */
export function product(a, b) {
  return {
    x: a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
    y: a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
    z: a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w,
    w: a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
  };
}

/** Rotates a vector. @param {Quaternion} q of length 1 @param {Vector} v @returns {Vector} */
export function rotated(q, v) {
  return product(product(q, { ...v, w: 0 }), { x: -q.x, y: -q.y, z: -q.z, w: q.w });
}
