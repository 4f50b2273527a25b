import { generator } from '../tests/random.js';

/** @param {number} seed @returns {() => number} uniform in (0, 1): a logarithm wants no 0 */
export function uniform(seed) {
  const random = generator(seed);
  return () => random() + 2 ** -33;
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
