/** Measured cost of each sampler on this device. */

import { FigureController } from '../../figure/controller.ts';
import { limits } from '../../settings.js';
import { SAMPLERS } from './settings.ts';
import type { MapSqueeze, SamplerName, SqueezeSettings } from '../../types.d.ts';

/** Cost of one accepted sample. */
export interface SampleCost {
  /** Microseconds. */
  micros: number;
  draws: number;
  wallTests: number;
}

/** Number of particles and rate of the chapter's exercise, samples per second. */
export const SAMPLES_PER_SECOND = 2000 * 20;

/** Minimum duration of a measured run, ms. Clocks of browsers may have steps of 1 ms. */
const MIN_RUN_MS = 12;

/** Number of runs whose median is the cost. */
const RUNS_PER_COST = 5;

/** Measures one run at a time, so that the page can handle events between two runs. Returns the cost, or the reason why there is none. */
function* measureCost(simulation: MapSqueeze, sampler: SamplerName, parts: number): Generator<undefined, SampleCost | 'wedged' | 'few'> {
  const maxCount = Math.floor(limits.trial / parts);
  let sampleCount = 1;
  const timeRun = () => {
    const startTime = performance.now();
    const { draws, wallTests } = simulation.trial(sampler, parts, sampleCount);
    return { draws, wallTests, elapsed: performance.now() - startTime };
  };
  try {
    for (;;) {
      const warmUpRun = timeRun();
      if (warmUpRun.elapsed >= MIN_RUN_MS || sampleCount === maxCount) {
        const timedRuns = [];
        while (timedRuns.length < RUNS_PER_COST) {
          yield;
          timedRuns.push(timeRun());
        }
        timedRuns.sort((one, other) => one.elapsed - other.elapsed);
        const { draws, wallTests, elapsed } = timedRuns[(RUNS_PER_COST - 1) / 2];
        // On a busy device only the warm-up may have been long. If the run was shorter, more samples are needed.
        if (elapsed >= MIN_RUN_MS / 2 || sampleCount === maxCount) {
          return { micros: (1000 * elapsed) / sampleCount, draws: draws / sampleCount, wallTests: wallTests / sampleCount };
        }
      }
      yield;
      sampleCount = Math.min(maxCount, 2 * sampleCount);
    }
  } catch (error) {
    if (!(error instanceof RangeError && error.message.includes('wedged'))) throw error;
    return sampleCount === 1 ? 'wedged' : 'few';
  }
}

/** Idle time before a measurement, ms, so that a user who presses keys repeatedly does not wait. */
const IDLE_MS = 300;

/** Measures the samplers one after the other when the figure is idle, and reports each. */
export class CostMeter extends FigureController {
  /** Latest costs, or the reasons why there are none. */
  costs: Partial<Record<SamplerName, SampleCost | 'wedged' | 'few'>> = {};
  /** True if the costs are those of the present settings. */
  current = false;
  /** Settings that were measured or will be measured, as JSON. */
  #settings = '';
  #timer: ReturnType<typeof setTimeout> | undefined;

  outdate() {
    clearTimeout(this.#timer);
    this.#timer = undefined;
    this.current = false;
  }

  /** Schedules measurements, which start when the settings have not changed for a while and nothing moves. */
  measureWhenIdle(config: SqueezeSettings, atRest: boolean) {
    const settingsKey = JSON.stringify(config);
    if (settingsKey !== this.#settings) this.outdate();
    this.#settings = settingsKey;
    if (atRest && !this.current && this.#timer === undefined) this.#measureSoon(config.steps);
  }

  #measureSoon(steps: number) {
    const { host } = this;
    const { simulation } = host;
    if (!simulation) return;
    const measurement = this.#measure(simulation, steps);
    const runStep = () => host.runtime.attempt(() => {
      // The element, with its simulation, may have been removed.
      if (host.simulation === simulation && !measurement.next().done) this.#timer = setTimeout(runStep);
    });
    this.#timer = setTimeout(runStep, IDLE_MS);
  }

  *#measure(simulation: MapSqueeze, steps: number) {
    for (const sampler of SAMPLERS) {
      this.costs[sampler] = yield* measureCost(simulation, sampler, sampler === 'sub-stepped' ? steps : 1);
      this.current = sampler === SAMPLERS.at(-1);
      this.host.requestUpdate();
      yield;
    }
  }
}
