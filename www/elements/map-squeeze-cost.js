/**
 * What each sampler costs on this device, measured.
 *
 * @module
 */

/**
 * @typedef {import('../types.d.ts').MapSqueeze} MapSqueeze
 * @typedef {import('../types.d.ts').SamplerName} SamplerName
 *
 * @typedef {object} Cost of one accepted sample
 * @property {number} micros microseconds; NaN, as the others, where the robot is wedged
 * @property {number} draws
 * @property {number} wallTests
 */

/** The particles and rate of the chapter's exercise: samples a second. */
export const DEMAND = 2000 * 20;

/** Milliseconds that a measurement lasts at least: browsers' clocks are as coarse as 1 ms. */
const LONG_ENOUGH = 20;

/** Most samples a trial: what `trial` allows. */
const MOST_SAMPLES = 100_000;

/**
 * @param {MapSqueeze} machine
 * @param {SamplerName} sampler
 * @param {number} steps
 * @returns {Cost}
 */
export function measure(machine, sampler, steps) {
  let count = 1;
  let samples = 0;
  let elapsed = 0;
  const sum = { draws: 0, wallTests: 0 };
  try {
    while (elapsed < LONG_ENOUGH) {
      const start = performance.now();
      const { draws, wallTests } = machine.trial(sampler, steps, count);
      elapsed += performance.now() - start;
      samples += count;
      sum.draws += draws;
      sum.wallTests += wallTests;
      count = Math.min(MOST_SAMPLES, 2 * count);
    }
  } catch (error) {
    if (!(error instanceof RangeError)) throw error;
    return { micros: NaN, draws: NaN, wallTests: NaN };
  }
  return {
    micros: (1000 * elapsed) / samples,
    draws: sum.draws / samples,
    wallTests: sum.wallTests / samples,
  };
}

/** Measures the samplers one after the other when things have come to rest, and tells of each. */
export class CostMeter {
  /** @type {Partial<Record<SamplerName, Cost>>} as last measured */
  costs = {};
  /** Whether the costs are those of the present settings. */
  current = false;
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  #timer;

  /** The costs are no longer those of the present settings. */
  outdate() {
    clearTimeout(this.#timer);
    this.current = false;
  }

  /**
   * Measures soon, unless `outdate` is called before.
   *
   * @param {() => MapSqueeze | undefined} machine
   * @param {SamplerName[]} samplers
   * @param {() => void} told called after each
   */
  measureSoon(machine, samplers, told) {
    this.outdate();
    const next = (/** @type {number} */ index) => {
      const measured = machine();
      if (!measured) return;
      this.costs[samplers[index]] = measure(measured, samplers[index], measured.config.steps);
      this.current = index === samplers.length - 1;
      told();
      if (!this.current) this.#timer = setTimeout(next, 0, index + 1);
    };
    this.#timer = setTimeout(next, REST, 0);
  }
}

/** Milliseconds of rest before measuring: a reader between two presses of a key is not kept waiting. */
const REST = 300;
