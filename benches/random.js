/**
 * A seeded generator for the baselines: Mulberry32, which is about as fast as Math.random and gives the same numbers
 * again.
 *
 * @param {number} seed
 * @returns {() => number} uniform in (0, 1)
 */
export function uniform(seed) {
  let state = seed | 0;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return (((t ^ (t >>> 14)) >>> 0) + 0.5) / 4294967296;
  };
}
