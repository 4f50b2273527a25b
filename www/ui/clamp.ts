/** Returns the nearest value from `min` to `max`. */
export function clamp(value: number, min: number, max: number) {
  return Math.min(max, Math.max(min, value));
}
