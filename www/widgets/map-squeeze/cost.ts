/** Measured cost of each sampler on this device. */

import { limits } from '../../../build/settings.js';
import { SAMPLERS } from './settings.ts';
import type { MapSqueeze, SamplerName } from '../../types.d.ts';

/** Cost of one accepted sample, with its time in microseconds; or the reason that there is none. */
export type SampleCost = { micros: number, draws: number, wallTests: number } | 'wedged';

/** Samples per second in the chapter's exercise: 2000 particles, 20 updates per second. */
export const SAMPLES_PER_SECOND = 2000 * 20;

/** Minimum duration of the measured run, ms. Clocks of browsers may have steps of 1 ms. */
const MIN_RUN_MS = 20;

/** Measures each sampler, in less than half a second together. */
export const measureCosts = (simulation: MapSqueeze, steps: number) =>
  Object.fromEntries(SAMPLERS.map((sampler) => [sampler, measureCost(simulation, sampler, sampler === 'sub-stepped' ? steps : 1)])) as Record<SamplerName, SampleCost>;

/** Doubles the number of samples until a run is long enough to be measured. */
function measureCost(simulation: MapSqueeze, sampler: SamplerName, subStepCount: number): SampleCost {
  const maxCount = Math.floor(limits.trial / subStepCount);
  let sampleCount = 1;
  try {
    for (;;) {
      const startTime = performance.now();
      const { draws, wallTests } = simulation.trial(sampler, subStepCount, sampleCount);
      const elapsedMs = performance.now() - startTime;
      if (elapsedMs >= MIN_RUN_MS || sampleCount === maxCount) return { micros: (1000 * elapsedMs) / sampleCount, draws: draws / sampleCount, wallTests: wallTests / sampleCount };
      sampleCount = Math.min(maxCount, 2 * sampleCount);
    }
  } catch (error) {
    if (!(error instanceof RangeError && error.message.includes('wedged'))) throw error;
    return 'wedged';
  }
}
