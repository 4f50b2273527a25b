/**
 * @param {number} value
 * @param {number} min
 * @param {number} max at least `min`
 */
export function clamp(value, min, max) {
  return Math.min(max, Math.max(min, value));
}
