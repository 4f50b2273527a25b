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

/**
 * Unit noise of `samples` robots: Box and Muller, both numbers of a pair.
 *
 * @param {number} samples
 * @param {number} seed
 */
export function drawNoise(samples, seed) {
  const random = uniform(seed);
  const pool = new Float64Array(3 * samples + 1);
  for (let i = 0; i < 3 * samples; i += 2) {
    const radius = Math.sqrt(-2 * Math.log(random()));
    const angle = 2 * Math.PI * random();
    pool[i] = radius * Math.cos(angle);
    pool[i + 1] = radius * Math.sin(angle);
  }
  return pool.subarray(0, 3 * samples);
}
